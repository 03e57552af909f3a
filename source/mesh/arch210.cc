// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch210.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double H = arch210_height;

    /** Returns the root of @p f by bisection, to the last digit. @p f is negative at @p lower and positive at
     * @p upper. */
    template <typename Function> double root(const Function &f, double lower, double upper)
    {
      for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = 0.5 * (lower + upper);
        (f(middle) < 0 ? lower : upper) = middle;
      }
      return 0.5 * (lower + upper);
    }

    // Geometry at the height z, in metres. t is the slope dx/dy of the centre line at y. w runs from -1 at
    // the upstream face to 1 at the downstream face.
    double crown_thickness(const double z)
    {
      const double zeta = (H - z) / H;
      return 10 + zeta * (86 + zeta * (-66 + zeta * 22));
    }
    double abutment_thickness(const double z)
    {
      const double zeta = (H - z) / H;
      return crown_thickness(z) * (1 + zeta * (0.60 - zeta * 0.42));
    }
    double crown_centre(const double z)
    {
      const double zeta = (H - z) / H;
      return zeta * (-62.0 + zeta * (35.7 + zeta * 12.3)) + crown_thickness(z) / 2;
    }
    double radius(const double z)
    {
      return 115 + (250.760 - 115) * z / H;
    }
    double half_width(const double z)
    {
      return 50 + (267.032 - 50) * std::pow(z / H, 0.577);
    }

    double arc_length(const double y, const double z)
    {
      const double t = y / radius(z);
      return radius(z) / 2 * (t * std::hypot(1, t) + std::asinh(t));
    }

    /** Returns the point P(y, z, w) [m]. */
    std::array<double, 3> point(const double y, const double z, const double w)
    {
      const double share = arc_length(y, z) / arc_length(half_width(z), z);
      const double T = crown_thickness(z) + (abutment_thickness(z) - crown_thickness(z)) * share * share;
      const double t = y / radius(z), q = std::hypot(1, t);
      return {crown_centre(z) + y * y / (2 * radius(z)) + w * T / (2 * q), y - w * T * t / (2 * q), z};
    }

    /** Column of nodes in the left half of the dam. It lies in the vertical plane normal to the centre line
     * of the crest at y = crest_y >= 0. Its height is at least smallest_height [m]. */
    class Column
    {
    public:
      Column(const double crest_y, const double smallest_height)
          : crest(point(crest_y, H, 0)), slope(crest_y / radius(H)), highest_base(H - smallest_height)
      {
      }

      /** Returns the distance of @p p from the plane times sqrt(1 + slope^2) [m]. It increases with y. */
      double distance(const std::array<double, 3> &p) const
      {
        return slope * (p[0] - crest[0]) + p[1] - crest[1];
      }

      /** Returns the height z of the base [m]: that of the abutment, 0 at the floor of the valley, or less
       * than the abutment where the dam would be lower than the smallest height. */
      double base(const double w) const { return std::min(abutment(w), highest_base); }

      /** Returns the node at height @p z, which is at or above the base. */
      std::array<double, 3> node(const double z, const double w) const
      {
        const double reach = z < abutment(w) ? 1.1 * half_width(H) : half_width(z);
        return point(root([&](const double y) { return distance(point(y, z, w)); }, 0, reach), z, w);
      }

    private:
      double abutment(const double w) const
      {
        const auto inside = [&](const double z) { return distance(point(half_width(z), z, w)); };
        return inside(0) >= 0 ? 0 : root(inside, 0, H);
      }

      std::array<double, 3> crest;
      double                slope, highest_base;
    };

    double crest_y(const double s)
    {
      return root([&](const double y) { return arc_length(y, H) - s; }, 0, half_width(H));
    }

    double half_crest_length()
    {
      return arc_length(half_width(H), H);
    }

    /** Returns the arc length s > 0 on the crest at which the abutment is @p wall below the crest [m]. */
    double end_of_crest(const double wall)
    {
      const auto end = point(half_width(H - wall), H - wall, 0);
      return arc_length(root([&](const double y) { return -Column(y, 0).distance(end); }, 0, half_width(H)),
                        H);
    }

    /** Returns the arc length s of the columns on the crest [m], from the right bank to the left. */
    std::vector<double> columns(const Arch210Parameters &parameters)
    {
      const unsigned int n_monoliths = parameters.n_joints + 1;
      const unsigned int per_monolith = (parameters.elements_along + n_monoliths - 1) / n_monoliths;
      const double       L = 2 * half_crest_length(), end = end_of_crest(parameters.end_wall_height);
      const auto         joint = [&](const unsigned int j)
      { return j == 0 ? -end : (j == n_monoliths ? end : -L / 2 + j * L / n_monoliths); };

      std::vector<double> result = {joint(0)};
      for (unsigned int m = 0; m < n_monoliths; ++m)
        for (unsigned int i = 1; i <= per_monolith; ++i)
          result.push_back(joint(m) + (joint(m + 1) - joint(m)) * i / per_monolith);
      return result;
    }
  } // namespace

  void Arch210Parameters::add_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.enter_subsection("Arch210");
    prm.add_parameter("Joints", n_joints,
                      "Number of contraction joints [-], with equal spacing along the crest. The dam has one "
                      "monolith more. The paper of Hu, Zhang and Lin (2008) uses 5, 17 and 28.",
                      Integer(0, 60));
    prm.add_parameter(
        "Elements along", elements_along,
        "Total number of elements along the crest [-]. Rounded up to a multiple of the number of monoliths.",
        Integer(1, 10000));
    prm.add_parameter("Elements up", elements_up, "Number of elements from the base to the crest [-].",
                      Integer(1, 1000));
    prm.add_parameter("Elements through", elements_through,
                      "Number of elements from the upstream to the downstream face [-].", Integer(1, 100));
    prm.add_parameter("End wall height", end_wall_height,
                      "Depth of the abutment below the two ends of the crest [m], at the centre line. With a "
                      "longer crest, the height of the dam would decrease to zero.",
                      Double(0.01, 20));
    prm.add_parameter(
        "Smallest height", smallest_height,
        "Smallest height of the dam [m]. Near the banks, where the abutment is nearer to the crest, the dam "
        "is embedded in the bank. All rows of elements share this height. With 0, the elements at the ends "
        "would be as flat as \"End wall height\" divided by \"Elements up\".",
        Double(0, 20));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void Arch210Parameters::check() const
  {
    const std::string entry = "Entry \"Mesh/Arch210/";
    if (n_joints > 60)
      throw InputError(entry + "Joints\" is " + std::to_string(n_joints) + ". Choose 0 to 60.");
    if (elements_along == 0 || elements_up == 0 || elements_through == 0)
      throw InputError(entry +
                       (elements_along == 0 ? "Elements along"
                        : elements_up == 0  ? "Elements up"
                                            : "Elements through") +
                       "\" is 0. Choose at least 1.");
    const double monolith = 2 * half_crest_length() / (n_joints + 1);
    const auto   spoils = [&](const double height)
    { return !(height < H / 2) || end_of_crest(height) < half_crest_length() - monolith / 2; };
    if (!(end_wall_height > 0) || spoils(end_wall_height))
      throw InputError(entry + "End wall height\" is " + number_text(end_wall_height) +
                       " m. Choose a height above 0 that leaves at least half of the end monoliths' crest.");
    if (!(smallest_height >= 0) || spoils(smallest_height))
      throw InputError(
          entry + "Smallest height\" is " + number_text(smallest_height) +
          " m. Choose a height that the dam exceeds over at least half of the crest of the end monoliths.");
  }

  HexMesh make_arch210(const Arch210Parameters &parameters)
  {
    parameters.check();
    const std::vector<double> s = columns(parameters);
    const unsigned int        n_along = s.size() - 1, n_up = parameters.elements_up,
                       n_through = parameters.elements_through;
    HexMesh mesh;

    for (unsigned int i = 0; i <= n_along; ++i)
    {
      const double        bank = s[i] < 0 ? -1 : 1;
      const Column        column(crest_y(std::abs(s[i])), parameters.smallest_height);
      std::vector<double> base;
      for (unsigned int l = 0; l <= n_through; ++l)
        base.push_back(column.base(2. * l / n_through - 1));
      for (unsigned int k = 0; k <= n_up; ++k)
        for (unsigned int l = 0; l <= n_through; ++l)
        {
          auto node = column.node(base[l] + (H - base[l]) * k / n_up, 2. * l / n_through - 1);
          node[1] *= bank;
          mesh.nodes.push_back(node);
        }
    }

    const auto node = [&](const unsigned int i, const unsigned int k, const unsigned int l)
    { return (i * (n_up + 1) + k) * (n_through + 1) + l; };
    const unsigned int per_monolith = n_along / (parameters.n_joints + 1);
    for (unsigned int i = 0; i < n_along; ++i)
      for (unsigned int k = 0; k < n_up; ++k)
        for (unsigned int l = 0; l < n_through; ++l)
        {
          const HexMesh::Cell cell{{node(i, k, l), node(i, k, l + 1), node(i + 1, k, l + 1),
                                    node(i + 1, k, l), node(i, k + 1, l), node(i, k + 1, l + 1),
                                    node(i + 1, k + 1, l + 1), node(i + 1, k + 1, l)},
                                   static_cast<int>(i / per_monolith + 1)};
          mesh.cells.push_back(cell);

          // In the order of hex_faces: base, crest, right bank, downstream, left bank, upstream.
          const bool outside[6] = {k == 0,           k + 1 == n_up, i == 0, l + 1 == n_through,
                                   i + 1 == n_along, l == 0};
          const int  surface[6] = {PhysicalId::base,       PhysicalId::crest, PhysicalId::base,
                                   PhysicalId::downstream, PhysicalId::base,  PhysicalId::upstream};
          for (unsigned int f = 0; f < 6; ++f)
            if (outside[f])
            {
              HexMesh::Face face{{}, surface[f]};
              for (unsigned int v = 0; v < 4; ++v)
                face.nodes[v] = cell.nodes[hex_faces[f][v]];
              mesh.faces.push_back(face);
            }
        }

    for (const auto &cell : mesh.cells)
      mesh.names[{3, cell.volume}] = physical_name(3, cell.volume);
    for (const auto &face : mesh.faces)
      mesh.names[{2, face.surface}] = physical_name(2, face.surface);
    return mesh;
  }

  std::vector<std::array<double, 2>> arch210_valley(const Arch210Parameters &parameters)
  {
    std::vector<std::array<double, 2>> valley;
    for (const double s : columns(parameters))
    {
      const Column column(crest_y(std::abs(s)), parameters.smallest_height);
      const auto   base = column.node(column.base(0), 0);
      valley.push_back({s < 0 ? -base[1] : base[1], base[2]});
    }
    return valley;
  }

  double arch210_half_width(const double z)
  {
    return half_width(z);
  }
} // namespace Voussoir
