// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/names.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/solid/for_faces.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  void ReservoirParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Reservoir");
    prm.add_parameter("Water level", level,
                      "Height z of the water surface in the axes of the input file [m].", {-500., 9000.});
    prm.add_parameter("Density", density, "Density of the water [kg/m^3]. 0: empty reservoir.",
                      {900., 1300., true}, Patterns::Double(0.));
    prm.add_parameter("Added mass", added_mass,
                      "Hydrodynamic added mass on the upstream face. " + added_mass_docs() + ".",
                      Patterns::Selection(added_mass_names()));
    prm.add_parameter(
        "Depth", depth,
        "Depth of the reservoir in Westergaard's formula. global: deepest point. local: vertical section "
        "through the node (generalised formula).",
        Patterns::Selection("global|local"));
    prm.add_parameter(
        "Factor", factor,
        "Factor of the added mass [-]. 0.5 is common in Chinese practice, and closer to an incompressible "
        "reservoir.",
        {.1, 1.5, true}, Patterns::Double(0.));
    prm.add_parameter(
        "Model", model,
        "Water in the earthquake. Westergaard: added mass, see Added mass. acoustic: compressible water "
        "in a channel with the section of the upstream face, on a rigid base or massless rock.",
        Patterns::Selection("Westergaard|acoustic"));
    prm.add_parameter("Sound speed", sound_speed, "Model acoustic: speed of sound in the water [m/s].",
                      {1300., 1550.}, Patterns::Double(1.));
    prm.add_parameter(
        "Reflection", reflection,
        "Model acoustic: reflection coefficient of bed and banks [-]. 1: rigid. 0: absorbs all waves.",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Length", length,
        "Model acoustic: length of the channel before its absorbing end [m], at least one depth. 0: two "
        "depths.",
        {50., 5000., true}, Patterns::Double(0.));
    prm.add_parameter(
        "Element size", element_size,
        "Model acoustic: size of the water elements at the dam [m]. 0: a sixteenth of the depth.",
        {1., 50., true}, Patterns::Double(0.));
    prm.leave_subsection();
  }

  void ReservoirParameters::add_choices(ModelChoices &choices) const
  {
    if (density == 0. || level <= choices.bottom)
      return;
    choices.add("water", "empty reservoir", "Reservoir/Density", 0., true);
    choices.add("water", "water level 10 % lower", "Reservoir/Water level",
                level - .1 * (level - choices.bottom));
    if (is_acoustic())
    {
      choices.add("water", "Westergaard", {{"Reservoir/Model", "Westergaard"}}, true);
      for (const double alpha : {1., .75, .5})
        if (alpha != reflection)
          choices.add("water", "reflection of the banks " + number_text(alpha), "Reservoir/Reflection",
                      alpha);
      return;
    }
    // Elements whose critical time step fits that of the dam: the mass increases by 11 % at most.
    const double size = std::max((level - choices.bottom) / 16., 1.1 * choices.time_step * sound_speed);
    choices.add("water", "compressible water",
                {{"Reservoir/Model", "acoustic"}, {"Reservoir/Element size", number_text(size)}});
    if (added_mass == "none" || factor == 0.)
      return choices.add("water", "Westergaard",
                         {{"Reservoir/Added mass", "Westergaard"}, {"Reservoir/Factor", "1"}});
    choices.add("water", "no added mass", {{"Reservoir/Added mass", "none"}}, true);
    if (factor != 1.)
      choices.add("water", "Westergaard", "Reservoir/Factor", 1.);
    if (factor != .5)
      choices.add("water", "half of Westergaard", "Reservoir/Factor", .5);
  }

  void add_water_pressure(const SolidModel &model, const ReservoirParameters &reservoir, const double gravity,
                          Unknowns &load)
  {
    // More points than for a smooth pressure, because the water line intersects faces.
    for_faces(model, PhysicalId::upstream, 8,
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
    /** Lower edge of the upstream face, as height over y. */
    class UpstreamHeel
    {
    public:
      explicit UpstreamHeel(const SolidModel &model)
      {
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (model.on_surface(i, PhysicalId::upstream) && model.on_surface(i, PhysicalId::base))
            heel.emplace_back(model.points[i][1], model.points[i][2]);
        std::sort(heel.begin(), heel.end());
        if (heel.empty())
          throw InputError(
              "The surfaces \"upstream\" and \"base\" of the mesh have no common edge, so the depth of the "
              "reservoir is unknown. Correct them in the mesh, or set \"Reservoir/Added mass\" to none.");
        for (const auto &p : heel)
          lowest = std::min(lowest, p.second);
      }

      double at(const double y) const
      {
        const auto right = std::lower_bound(heel.begin(), heel.end(), std::make_pair(y, -1e300));
        if (right == heel.begin())
          return right->second;
        const auto left = right - 1;
        if (right == heel.end() || right->first <= left->first)
          return left->second;
        const double t = (y - left->first) / (right->first - left->first);
        return (1. - t) * left->second + t * right->second;
      }

      double lowest = 1e300;

    private:
      std::vector<std::pair<double, double>> heel;
    };
  } // namespace

  namespace
  {
    /** Westergaard's added mass per area of the upstream face [kg/m^2]. */
    class Westergaard
    {
    public:
      Westergaard(const SolidModel &model, const ReservoirParameters &reservoir)
          : reservoir(reservoir), heel(model)
      {
      }

      double at(const Point<3> &x) const
      {
        const double h = reservoir.level - x[2];
        const double depth = reservoir.level - (reservoir.depth == "local" ? heel.at(x[1]) : heel.lowest);
        return h <= 0. ? 0.
                       : reservoir.factor * 7. / 8. * reservoir.density * std::sqrt(std::max(depth, h) * h);
      }

    private:
      const ReservoirParameters &reservoir;
      const UpstreamHeel         heel;
    };

    /** Adds m n n^T. Returns its part along x, for fixed nodes, too. */
    double add_mass(const unsigned int equation, const double m, const Tensor<1, 3> &n, Structure &structure)
    {
      if (equation != rigid_ground)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            structure.mass[equation][3 * a + b] += m * n[a] * n[b];
            structure.added_mass[equation][3 * a + b] += m * n[a] * n[b];
          }
      return m * n[0] * n[0];
    }

    /** Returns the nodal masses of a face by hat functions between neighbouring nodes. Shape functions of
     * degree 2 can give negative masses if the water line intersects the face. */
    std::vector<double> hat_masses(const SolidModel &model, const FEFaceValues<3> &values,
                                   const Westergaard &westergaard)
    {
      std::vector<double> mass(model.fe.n_dofs_per_cell(), 0.);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const Point<3> &x = values.quadrature_point(q);
        const Point<3>  unit = values.get_mapping().transform_real_to_unit_cell(values.get_cell(), x);
        for (unsigned int i = 0; i < mass.size(); ++i)
        {
          double hat = 1.;
          for (unsigned int d = 0; d < 3; ++d)
            hat *= std::max(0., 1. - model.fe.degree * std::abs(unit[d] - model.fe.unit_support_point(i)[d]));
          mass[i] += hat * westergaard.at(x) * values.JxW(q);
        }
      }
      return mass;
    }
  } // namespace

  double add_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                              Structure &structure)
  {
    const Westergaard         westergaard(model, reservoir);
    double                    total = 0.;
    std::vector<double>       mass;
    std::vector<Tensor<1, 3>> normal;
    // More points than for a smooth mass, because the water line intersects faces.
    for_faces(model, PhysicalId::upstream, 8,
              [&](const FEFaceValues<3> &values, const auto &dofs)
              {
                mass.assign(dofs.size(), 0.);
                normal.assign(dofs.size(), Tensor<1, 3>());
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  const double m = westergaard.at(values.quadrature_point(q)) * values.JxW(q);
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                  {
                    mass[i] += values.shape_value(i, q) * m;
                    normal[i] += std::abs(values.shape_value(i, q)) * m * values.normal_vector(q);
                  }
                }
                if (*std::min_element(mass.begin(), mass.end()) < 0.)
                  mass = hat_masses(model, values, westergaard);
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  if (const double size = normal[i].norm(); mass[i] > 0. && size > 0.)
                    total += add_mass(model.equation[dofs[i]], mass[i], normal[i] / size, structure);
              });
    return total;
  }

  double add_nodal_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                                    Structure &structure)
  {
    std::vector<Tensor<1, 3>> area(model.n_nodes());
    for_faces(model, PhysicalId::upstream, model.fe.degree + 1,
              [&](const FEFaceValues<3> &values, const auto &dofs)
              {
                for (const unsigned int q : values.quadrature_point_indices())
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    area[dofs[i]] += values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
              });
    const Westergaard westergaard(model, reservoir);
    double            total = 0.;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (const double size = area[i].norm(); size > 0.)
        total +=
            add_mass(model.equation[i], westergaard.at(model.points[i]) * size, area[i] / size, structure);
    return total;
  }

  namespace
  {
    /** Row of the table of added masses. */
    struct AddedMassRow
    {
      const char *name, *doc;
      double (*add)(const SolidModel &, const ReservoirParameters &,
                    Structure &); ///< returns the mass in x [kg]
      std::vector<double> (*per_area)(const SolidModel &, const ReservoirParameters &);
    };

    std::vector<double> westergaard_per_area(const SolidModel &model, const ReservoirParameters &reservoir)
    {
      const Westergaard   westergaard(model, reservoir);
      std::vector<double> result(model.n_nodes(), 0.);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.on_surface(i, PhysicalId::upstream))
          result[i] = westergaard.at(model.points[i]);
      return result;
    }

    std::vector<double> no_mass(const SolidModel &, const ReservoirParameters &)
    {
      return {};
    }

    const AddedMassRow added_masses[] = {
        {"Westergaard",
         "Westergaard's formula in the normal direction of the upstream face, integrated over the elements",
         add_westergaard_mass, westergaard_per_area},
        {"Westergaard-nodal",
         "the same formula at the nodes times their areas, less accurate, for comparison",
         add_nodal_westergaard_mass, westergaard_per_area},
        {"none", "the water is a static load only",
         [](const SolidModel &, const ReservoirParameters &, Structure &) { return 0.; }, no_mass}};

    const AddedMassRow &row_of_added_mass(const ReservoirParameters &reservoir)
    {
      return row_of(added_masses, reservoir.is_acoustic() ? "none" : reservoir.added_mass, "is no added mass",
                    "Entry \"Reservoir/Added mass\" may be");
    }
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
    return row_of_added_mass(reservoir).add(model, reservoir, structure);
  }

  std::vector<double> added_mass_per_area(const SolidModel &model, const ReservoirParameters &reservoir)
  {
    return row_of_added_mass(reservoir).per_area(model, reservoir);
  }
} // namespace Voussoir
