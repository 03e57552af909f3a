// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/base/names.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  void ReservoirParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Reservoir");
    prm.add_parameter("Water level", level, "z of the water surface, in the axes of the scene [m].");
    prm.add_parameter("Density", density, "Density of the water; 0 means an empty reservoir [kg/m^3].",
                      Patterns::Double(0.));
    prm.add_parameter("Added mass", added_mass,
                      "Hydrodynamic added mass on the upstream face. " + added_mass_docs() + ".",
                      Patterns::Selection(added_mass_names()));
    prm.add_parameter(
        "Depth", depth,
        "Depth of the reservoir in Westergaard's formula: global (deepest point) or local (generalised "
        "formula: the vertical section through the node).",
        Patterns::Selection("global|local"));
    prm.add_parameter(
        "Factor", factor,
        "Factor of the added mass; 0.5 is common in Chinese practice, and closer to an incompressible "
        "reservoir [-].",
        Patterns::Double(0.));
    prm.leave_subsection();
  }

  namespace
  {
    /** Calls f(values, dofs) for each face of the surface "upstream". */
    template <class Function>
    void for_upstream_faces(const SolidModel &model, const unsigned int n_points, const Function &f)
    {
      FEFaceValues<3>                      values(model.fe, QGauss<2>(n_points),
                                                  update_values | update_normal_vectors | update_JxW_values |
                                                      update_quadrature_points);
      std::vector<types::global_dof_index> dofs(model.fe.n_dofs_per_cell());
      for (const auto &cell : model.dof_handler.active_cell_iterators())
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary() && cell->face(face)->boundary_id() == PhysicalId::upstream)
          {
            values.reinit(cell, face);
            cell->get_dof_indices(dofs);
            f(values, dofs);
          }
    }
  } // namespace

  void add_water_pressure(const SolidModel &model, const ReservoirParameters &reservoir, const double gravity,
                          Unknowns &load)
  {
    // More points than the pressure needs: the water line cuts through faces.
    for_upstream_faces(model, 8,
                       [&](const FEFaceValues<3> &values, const auto &dofs)
                       {
                         for (const unsigned int q : values.quadrature_point_indices())
                         {
                           const double depth = reservoir.level - values.quadrature_point(q)[2];
                           if (depth > 0.)
                             for (unsigned int i = 0; i < dofs.size(); ++i)
                               if (const unsigned int e = model.equation[dofs[i]]; e != rigid_ground)
                                 for (unsigned int c = 0; c < 3; ++c)
                                   load[3 * e + c] -= reservoir.density * gravity * depth *
                                                      values.normal_vector(q)[c] * values.shape_value(i, q) *
                                                      values.JxW(q);
                         }
                       });
  }

  namespace
  {
    /** The foot of the upstream face, as elevation over y. */
    class UpstreamFoot
    {
    public:
      explicit UpstreamFoot(const SolidModel &model)
      {
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (model.on_surface(i, PhysicalId::upstream) && model.on_surface(i, PhysicalId::base))
            foot.emplace_back(model.points[i][1], model.points[i][2]);
        std::sort(foot.begin(), foot.end());
        if (foot.empty())
          throw InputError(
              "The surfaces \"upstream\" and \"base\" of the mesh do not meet, so that the depth of the "
              "reservoir is not known. Mark both in the mesh, or set \"Reservoir/Added mass\" to none.");
        for (const auto &p : foot)
          lowest = std::min(lowest, p.second);
      }

      double at(const double y) const
      {
        const auto right = std::lower_bound(foot.begin(), foot.end(), std::make_pair(y, -1e300));
        if (right == foot.begin())
          return right->second;
        const auto left = right - 1;
        if (right == foot.end() || right->first <= left->first)
          return left->second;
        const double t = (y - left->first) / (right->first - left->first);
        return (1. - t) * left->second + t * right->second;
      }

      double lowest = 1e300;

    private:
      std::vector<std::pair<double, double>> foot;
    };
  } // namespace

  double add_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                              Structure &structure)
  {
    std::vector<Tensor<1, 3>> area(model.n_nodes());
    for_upstream_faces(model, model.fe.degree + 1,
                       [&](const FEFaceValues<3> &values, const auto &dofs)
                       {
                         for (const unsigned int q : values.quadrature_point_indices())
                           for (unsigned int i = 0; i < dofs.size(); ++i)
                             area[dofs[i]] +=
                                 values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
                       });
    const UpstreamFoot foot(model);
    double             total = 0.;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      const unsigned int e = model.equation[i];
      const double       h = reservoir.level - model.points[i][2], size = area[i].norm();
      if (h <= 0. || size == 0.)
        continue;
      const double depth =
          reservoir.level - (reservoir.depth == "local" ? foot.at(model.points[i][1]) : foot.lowest);
      const double m =
          reservoir.factor * 7. / 8. * reservoir.density * std::sqrt(std::max(depth, h) * h) / size;
      total += m * area[i][0] * area[i][0];
      if (e != rigid_ground)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            structure.mass[e][3 * a + b] += m * area[i][a] * area[i][b];
            structure.added_mass[e][3 * a + b] += m * area[i][a] * area[i][b];
          }
    }
    return total;
  }

  namespace
  {
    /** What moves with the dam, by name. */
    struct AddedMassRow
    {
      const char *name, *doc;
      double (*add)(const SolidModel &, const ReservoirParameters &, Structure &); ///< in x [kg]
    };

    const AddedMassRow added_masses[] = {
        {"Westergaard", "his formula, in the normal direction of the upstream face", add_westergaard_mass},
        {"none", "the water is a static load only",
         [](const SolidModel &, const ReservoirParameters &, Structure &) { return 0.; }}};
  } // namespace

  std::string added_mass_names()
  {
    return names_of(added_masses);
  }

  std::string added_mass_docs()
  {
    return docs_of(added_masses);
  }

  double add_added_mass(const SolidModel &model, const ReservoirParameters &reservoir, Structure &structure)
  {
    return row_of(added_masses, reservoir.added_mass, "is no added mass",
                  "Entry \"Reservoir/Added mass\" may be")
        .add(model, reservoir, structure);
  }
} // namespace Voussoir
