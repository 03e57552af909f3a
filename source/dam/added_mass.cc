// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/solid/for_faces.h>
#include <voussoir/solid/solid_grid.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Lower edge of the upstream face, as height over y. */
    class UpstreamHeel
    {
    public:
      explicit UpstreamHeel(const SolidModel &model)
      {
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (model.on_surface(i, PhysicalId::upstream) && model.is_at_base(i))
            heel.emplace_back(model.points[i][1], model.points[i][2]);
        std::sort(heel.begin(), heel.end());
        if (heel.empty())
          throw InputError(
              "The surfaces \"upstream\" and \"base\" of the mesh have no common edge, so the depth of the "
              "reservoir is unknown. Correct them in the mesh, or set \"Reservoir/Model\" to none.");
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

    /** Added mass per area of the upstream face at a place [kg/m^2]. */
    using MassPerArea = std::function<double(const Vector3 &)>;

    MassPerArea westergaard(const SolidModel &model, const ReservoirParameters &reservoir)
    {
      return [&reservoir, heel = UpstreamHeel(model)](const Vector3 &x)
      {
        const double h = reservoir.level - x[2];
        const double depth = reservoir.level - (reservoir.depth == "local" ? heel.at(x[1]) : heel.lowest);
        return h <= 0. ? 0.
                       : reservoir.factor * 7. / 8. * reservoir.density * std::sqrt(std::max(depth, h) * h);
      };
    }

    MassPerArea table_of_mass(const SolidModel &model, const ReservoirParameters &reservoir)
    {
      if (reservoir.table.empty())
        throw InputError("\"Reservoir/Model\" = added mass table requires a file. Set \"Reservoir/Table\".");
      const std::string file = (std::filesystem::path(reservoir.directory) / reservoir.table).string();
      const Curve       curve = read_curve(file, {"The table of Reservoir/Table, ", "depth", "depths", "[m]",
                                                  "added mass per area [kg/m^2]",
                                                  "Its path is relative to the directory of the scene file."});
      double            deepest = 0.;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.on_surface(i, PhysicalId::upstream))
          deepest = std::max(deepest, reservoir.level - model.points[i][2]);
      if (deepest > curve.x.back() * (1. + 1e-9))
        throw InputError("The table of Reservoir/Table, " + file + ", ends at the depth " +
                         number_text(curve.x.back()) + " m, but the upstream face has " +
                         number_text(deepest) + " m. Extend the table, or correct Reservoir/Water level.");
      if (deepest > 0. && (curve.x.back() > 2. * deepest || curve.at(0.) > curve.at(deepest)))
        throw InputError(
            "The table of Reservoir/Table, " + file + ", has depths to " + number_text(curve.x.back()) +
            " m, and the masses " + number_text(curve.at(0.)) + " kg/m^2 at the surface and " +
            number_text(curve.at(deepest)) + " kg/m^2 at the bottom of the reservoir, " +
            number_text(deepest) +
            " m below. Are its columns exchanged, or its depths elevations? Write depths below the "
            "water level, to twice this depth at most, then masses.");
      return [&reservoir, curve](const Vector3 &x)
      {
        const double depth = reservoir.level - x[2];
        return depth <= 0. ? 0. : curve.at(depth);
      };
    }

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
                                   const MassPerArea &per_area)
    {
      std::vector<double> mass(model.grid->fe.n_dofs_per_cell(), 0.);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const Point<3> &x = values.quadrature_point(q);
        const Point<3>  unit = values.get_mapping().transform_real_to_unit_cell(values.get_cell(), x);
        for (unsigned int i = 0; i < mass.size(); ++i)
        {
          double hat = 1.;
          for (unsigned int d = 0; d < 3; ++d)
            hat *=
                std::max(0., 1. - model.degree * std::abs(unit[d] - model.grid->fe.unit_support_point(i)[d]));
          mass[i] += hat * per_area(to_vector(x)) * values.JxW(q);
        }
      }
      return mass;
    }

    /** Integrates the mass over the submerged part of the face. Returns the total along x [kg]. */
    double add_integrated(const SolidModel &model, const MassPerArea &per_area, Structure &structure)
    {
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
                    const double m = per_area(to_vector(values.quadrature_point(q))) * values.JxW(q);
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                    {
                      mass[i] += values.shape_value(i, q) * m;
                      normal[i] += std::abs(values.shape_value(i, q)) * m * values.normal_vector(q);
                    }
                  }
                  if (*std::min_element(mass.begin(), mass.end()) < 0.)
                    mass = hat_masses(model, values, per_area);
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    if (const double size = normal[i].norm(); mass[i] > 0. && size > 0.)
                      total += add_mass(model.equation[dofs[i]], mass[i], normal[i] / size, structure);
                });
      return total;
    }

    /** Multiplies the mass at the nodes by their areas. Returns the total along x [kg]. */
    double add_nodal(const SolidModel &model, const MassPerArea &per_area, Structure &structure)
    {
      std::vector<Tensor<1, 3>> area(model.n_nodes());
      for_faces(model, PhysicalId::upstream, model.degree + 1,
                [&](const FEFaceValues<3> &values, const auto &dofs)
                {
                  for (const unsigned int q : values.quadrature_point_indices())
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                      area[dofs[i]] += values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
                });
      double total = 0.;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (const double size = area[i].norm(); size > 0.)
          total += add_mass(model.equation[i], per_area(model.points[i]) * size, area[i] / size, structure);
      return total;
    }

    /** Row of the table of the models of water. */
    struct WaterRow
    {
      const char *name, *doc;
      MassPerArea (*per_area)(const SolidModel &, const ReservoirParameters &); ///< null: no added mass
      double (*add)(const SolidModel &, const MassPerArea &, Structure &);
    };

    const WaterRow models[] = {
        {"none", "the water is a static load only", nullptr, nullptr},
        {"Westergaard",
         "added mass by Westergaard's formula in the normal direction of the upstream face, integrated over the "
         "elements",
         westergaard, add_integrated},
        {"Westergaard-nodal",
         "the same formula at the nodes times their areas, less accurate, for comparison", westergaard,
         add_nodal},
        {"added mass table", "added mass per area over the depth, of the file Table", table_of_mass,
         add_integrated},
        {"incompressible",
         "full mass of incompressible water in a channel with the section of the upstream face, for voussoir "
         "modes",
         nullptr, nullptr},
        {"acoustic", "compressible water in such a channel", nullptr, nullptr}};

    const WaterRow &row_of_water(const ReservoirParameters &reservoir)
    {
      return row_of(models, reservoir.kind(), "is no model of water", "Entry \"Reservoir/Model\" may be");
    }
  } // namespace

  std::string ReservoirParameters::name_of_mass() const
  {
    if (kind() == "added mass table")
      return "of " + table;
    return kind() == "none" ? "none" : kind() + " x " + number_text(factor);
  }

  std::string water_model_names()
  {
    return names_of(models);
  }

  std::string water_model_docs()
  {
    return docs_of(models);
  }

  double add_added_mass(const SolidModel &model, const ReservoirParameters &reservoir, Structure &structure)
  {
    const WaterRow &row = row_of_water(reservoir);
    return row.per_area == nullptr ? 0. : row.add(model, row.per_area(model, reservoir), structure);
  }

  std::string added_mass_warning(const SolidModel &model, const ReservoirParameters &reservoir)
  {
    if (row_of_water(reservoir).per_area != table_of_mass)
      return "";
    ReservoirParameters usual = reservoir;
    usual.factor = 1.;
    const MassPerArea of_table = table_of_mass(model, reservoir), formula = westergaard(model, usual);
    double            total = 0., of_formula = 0.;
    for_faces(model, PhysicalId::upstream, 8,
              [&](const FEFaceValues<3> &values, const auto &)
              {
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  const Vector3 x = to_vector(values.quadrature_point(q));
                  total += of_table(x) * values.JxW(q);
                  of_formula += formula(x) * values.JxW(q);
                }
              });
    if (total <= 3. * of_formula && of_formula <= 3. * total)
      return "";
    return "The added mass of Reservoir/Table is " + number_text(total / of_formula) +
           " times that of Westergaard's formula, usually 1/3 to 3 times. Check its unit, kg/m^2.";
  }

  std::vector<double> added_mass_per_area(const SolidModel &model, const ReservoirParameters &reservoir)
  {
    const WaterRow &row = row_of_water(reservoir);
    if (row.per_area == nullptr)
      return {};
    const MassPerArea   per_area = row.per_area(model, reservoir);
    std::vector<double> result(model.n_nodes(), 0.);
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.on_surface(i, PhysicalId::upstream))
        result[i] = per_area(model.points[i]);
    return result;
  }
} // namespace Voussoir
