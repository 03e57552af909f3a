// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch_grid.h>
#include <voussoir/mesh/arch_rows.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Voussoir
{
  namespace
  {
    using Point = std::array<double, 3>;

    /** Column of nodes in one half of the dam. It lies in the vertical plane normal to the centre line of the
     * crest at the parameter @p u. Its height is at least smallest_height [m]. */
    class Column
    {
    public:
      Column(const ArchShape &shape, const Bank bank, const double u, const double smallest_height)
          : shape(shape), bank(bank), crest(shape.point(bank, u, shape.top(), 0)),
            slope(shape.slope(bank, u)), highest_base(shape.top() - smallest_height)
      {
      }

      /** Returns the distance of @p p from the plane times sqrt(1 + slope^2) [m]. It increases with y. */
      double distance(const Point &p) const { return slope * (p[0] - crest[0]) + p[1] - crest[1]; }

      /** Returns the height z of the base [m]: that of the abutment, the bottom at the floor of the valley, or
       * less than the abutment where the dam would be lower than the smallest height. */
      double base(const double w) const { return std::min(abutment(w), highest_base); }

      /** Returns the node at height @p z, which is at or above the base. */
      Point node(const double z, const double w) const
      {
        const auto place = [&](const double u) { return distance(shape.point(bank, u, z, w)); };
        double     last = shape.end(bank, z);
        if (z < abutment(w) || place(last) < -1e-6)
          last = shape.reach(bank, z);
        if (place(0) > 1e-6)
          throw InputError("The plane of a column of nodes crosses y = 0 at z = " + number_text(z) +
                           " m. Put y = 0 at the crown, where the crest is normal to the stream.");
        if (place(last) < -1e-6)
          throw InputError("The arc at z = " + number_text(z) +
                           " m cannot be continued into the bank. Reduce \"Smallest height\", or correct the "
                           "arcs near the crest.");
        return shape.point(bank, bisect(place, 0, last), z, w);
      }

      /** Throws InputError if the plane of the column leaves the valley and enters it again further down.
       * @p is_end: the column is at the end of the crest, and must not be in the valley anywhere. */
      void check_valley(const bool is_end) const
      {
        constexpr unsigned int n = 100;
        for (const double w : {-1., 1.})
        {
          const double foot = is_end ? shape.top() : abutment(w);
          const double allowed = 1e-6 + (is_end ? inside(foot, w) : 0.);
          for (unsigned int i = 0; i < n; ++i)
            if (const double z = shape.bottom() + (foot - shape.bottom()) * i / n;
                z < foot - 0.01 && inside(z, w) > allowed)
              throw InputError("The valley is wider at z = " + number_text(z) + " m than at z = " +
                               number_text(foot) + " m, on the " + (bank == Bank::left ? "left" : "right") +
                               " bank. The valley must open upwards. Correct the ends of the arcs there.");
        }
      }

    private:
      /** Returns the distance of the abutment beyond the plane, as distance(). At the crest it is not negative: an
       * abutment that is not normal to the crest is shifted for the columns that it cuts. */
      double inside(const double z, const double w) const
      {
        const auto at = [&](const double height)
        { return distance(shape.point(bank, shape.end(bank, height), height, w)); };
        return at(z) - std::min(0., at(shape.top()));
      }
      double abutment(const double w) const
      {
        const double bottom = shape.bottom();
        return inside(bottom, w) > -1e-6
                   ? bottom
                   : bisect([&](const double z) { return inside(z, w); }, bottom, shape.top());
      }

      const ArchShape &shape;
      const Bank       bank;
      const Point      crest;
      const double     slope, highest_base;
    };

    /** Crest of a dam. s is the length of its centre line from the crown, negative on the right bank [m]. */
    class Crest
    {
    public:
      explicit Crest(const ArchShape &shape) : shape(shape) {}

      double end(const Bank bank) const { return shape.crest_length(bank, shape.end(bank, shape.top())); }
      double length() const { return end(Bank::right) + end(Bank::left); }

      /** Returns the length |s| at which the abutment is @p wall below the crest [m]. */
      double end(const Bank bank, const double wall) const
      {
        if (wall == 0)
          return end(bank);
        const double z = shape.top() - wall, last = shape.end(bank, shape.top());
        const Point  foot = shape.point(bank, shape.end(bank, z), z, 0);
        const auto   before = [&](const double u) { return -Column(shape, bank, u, 0).distance(foot); };
        return shape.crest_length(bank, bisect(before, 0, last));
      }

      Column column(const double s, const double smallest_height) const
      {
        const Bank bank = s < 0 ? Bank::right : Bank::left;
        const auto before = [&](const double u) { return shape.crest_length(bank, u) - std::abs(s); };
        return Column(shape, bank, bisect(before, 0, shape.end(bank, shape.top())), smallest_height);
      }

      /** Throws InputError if the valley is wider somewhere than at the crest. */
      void check_valley() const
      {
        for (const Bank bank : {Bank::right, Bank::left})
          Column(shape, bank, shape.end(bank, shape.top()), 0).check_valley(true);
      }

      /** Returns s of the ends of the monoliths. */
      std::vector<double> joints(const ArchGrid &grid) const
      {
        const unsigned int  n = grid.n_monoliths();
        const double        L = length(), right = end(Bank::right);
        std::vector<double> s = {-end(Bank::right, grid.end_wall_height)};
        for (unsigned int j = 1; j < n; ++j)
          s.push_back(-right + (grid.joint_places.empty() ? j * L / n : grid.joint_places[j - 1]));
        s.push_back(end(Bank::left, grid.end_wall_height));
        return s;
      }

    private:
      const ArchShape &shape;
    };

    /** Lift joints: horizontal where the dam is high enough. Elsewhere the row of nodes follows the base, and the
     * monolith has no joint there. */
    class Lifts
    {
    public:
      Lifts(const ArchShape &shape, const ArchGrid &grid)
          : top(shape.top()), n(grid.lift_joints), n_up(grid.elements_up)
      {
        for (unsigned int i = 1; i <= n; ++i)
        {
          levels.push_back(shape.bottom() + (top - shape.bottom()) * i / (n + 1));
          rows.push_back((i * n_up + (n + 1) / 2) / (n + 1));
        }
      }

      /** Returns the heights of the nodes above a point of the base [m]. */
      std::vector<double> heights(const double base) const
      {
        // Near the banks, lifts whose level is little above the base or below it are lower than others.
        constexpr double    least = .5; // share of their usual height
        std::vector<double> ends(n + 2, base), result(n_up + 1, base);
        ends[n + 1] = top;
        for (unsigned int i = n; i >= 1; --i)
        {
          const double above = 2. * (n + 1) * (base - levels[i - 1]) / (top - levels[0]),
                       share = least + (1. - least) * std::clamp(above, 0., 1.);
          ends[i] = std::max(levels[i - 1], base + share * i / (i + 1) * (ends[i + 1] - base));
        }
        for (unsigned int i = 0, first = 0; i <= n; ++i)
        {
          const unsigned int last = i < n ? rows[i] : n_up;
          for (unsigned int k = first + 1; k <= last; ++k)
            result[k] =
                k == last ? ends[i + 1] : ends[i] + (ends[i + 1] - ends[i]) * (k - first) / (last - first);
          first = last;
        }
        return result;
      }

      /** Returns the lifts below the lift joint or row @p k that begin above a base, for each row of elements: counted
       * from 0 at the base. @p base: highest point of the base of the monolith [m]. */
      int lift_of_row(const unsigned int k, const double base) const
      {
        const std::vector<double> z = heights(base);
        int                       lift = 0;
        for (unsigned int i = 0; i < n; ++i)
          lift += rows[i] <= k && z[rows[i]] == levels[i];
        return lift;
      }

    private:
      const double              top;
      const unsigned int        n, n_up;
      std::vector<double>       levels; ///< of the joints [m]
      std::vector<unsigned int> rows;   ///< of nodes in the joints
    };

    /** Returns the columns without their bases. */
    ArchColumns places(const ArchShape &shape, const ArchGrid &grid)
    {
      const Crest               crest(shape);
      const std::vector<double> joint = crest.joints(grid);
      const unsigned int        n_monoliths = grid.n_monoliths();
      ArchColumns               result{{joint[0]}, {}, {}, shape.top()};
      for (unsigned int m = 0; m < n_monoliths; ++m)
      {
        const double       width = joint[m + 1] - joint[m], element = crest.length() / grid.elements_along;
        const unsigned int n = grid.joint_places.empty()
                                   ? (grid.elements_along + n_monoliths - 1) / n_monoliths
                                   : std::max(1., std::ceil(width / element - 1e-6));
        for (unsigned int i = 1; i <= n; ++i)
        {
          result.s.push_back(joint[m] + width * i / n);
          result.monolith.push_back(m + 1);
        }
      }
      return result;
    }

    /** Returns the mesh with the same number of rows in all columns, with lift joints. */
    ArchPlane mesh_of_equal_rows(const ArchShape &shape, const ArchGrid &grid, const ArchColumns &columns)
    {
      const Lifts         lifts(shape, grid);
      const unsigned int  n_up = grid.elements_up, n_along = columns.monolith.size();
      const double        top = shape.top();
      ArchPlane           plane;
      std::vector<double> highest; // of the bases
      for (unsigned int i = 0; i <= n_along; ++i)
      {
        const auto &base = columns.base[i];
        highest.push_back(*std::max_element(base.begin(), base.end()));
        plane.columns.emplace_back();
        for (unsigned int k = 0; k <= n_up; ++k)
        {
          plane.columns[i].push_back(plane.s.size());
          plane.s.push_back(columns.s[i]);
          plane.z.emplace_back();
          const bool is_end = k == 0 || k == n_up || grid.rows.empty();
          for (const double z : base)
            plane.z.back().push_back(grid.lift_joints > 0 ? lifts.heights(z)[k]
                                     : is_end             ? z + (top - z) * k / n_up
                                                          : z + (top - z) * grid.rows[k - 1]);
        }
      }
      for (unsigned int i = 0; i < n_along; ++i)
      {
        const auto [first, last] =
            std::equal_range(columns.monolith.begin(), columns.monolith.end(), columns.monolith[i]);
        const double base = *std::max_element(highest.begin() + (first - columns.monolith.begin()),
                                              highest.begin() + (last - columns.monolith.begin()) + 1);
        const auto  &a = plane.columns[i], &b = plane.columns[i + 1];
        for (unsigned int k = 0; k < n_up; ++k)
          plane.quads.push_back({{a[k], b[k], b[k + 1], a[k + 1]},
                                 columns.monolith[i] + PhysicalId::per_lift * lifts.lift_of_row(k, base)});
      }
      return plane;
    }

    /** Returns the hexahedra of the layers. The node n of @p plane in the layer l is n (elements_through + 1) + l. */
    ArchMesh extruded(const ArchShape &shape, const ArchGrid &grid, const ArchPlane &plane)
    {
      ArchMesh              result;
      HexMesh              &mesh = result.mesh;
      const unsigned int    n_through = grid.elements_through;
      std::optional<Column> column;
      for (unsigned int n = 0; n < plane.s.size(); ++n)
      {
        if (n == 0 || plane.s[n] != plane.s[n - 1])
          column.emplace(Crest(shape).column(plane.s[n], grid.smallest_height));
        for (unsigned int l = 0; l <= n_through; ++l)
        {
          mesh.nodes.push_back(column->node(plane.z[n][l], 2. * l / n_through - 1));
          mesh.nodes.back()[1] *= plane.s[n] < 0 ? -1 : 1;
        }
      }
      for (const auto &nodes : plane.columns)
        result.base.push_back(nodes.front() * (n_through + 1));
      for (const auto &[q, volume, middle] : plane.quads)
        for (unsigned int l = 0; l < n_through; ++l)
        {
          const auto node = [&](const unsigned int v) { return q[v] * (n_through + 1) + l; };
          mesh.cells.push_back(
              {{node(0), node(0) + 1, node(1) + 1, node(1), node(3), node(3) + 1, node(2) + 1, node(2)},
               volume});
        }
      const FaceTable table(mesh);
      const int       base = grid.base_joint ? PhysicalId::base_joint : PhysicalId::base;
      const int       surface[6] = {base, PhysicalId::crest,   base, PhysicalId::downstream,
                                    base, PhysicalId::upstream}; // in the order of hex_faces
      for (const auto &cell : mesh.cells)
        for (unsigned int f = 0; f < 6; ++f)
        {
          HexMesh::Face face{{}, surface[f]};
          for (unsigned int v = 0; v < 4; ++v)
            face.nodes[v] = cell.nodes[hex_faces[f][v]];
          if (table.owners(face.nodes).second == nullptr)
            mesh.faces.push_back(face);
        }
      for (const auto &cell : mesh.cells)
        mesh.names[{3, cell.volume}] = physical_name(3, cell.volume);
      for (const auto &face : mesh.faces)
        mesh.names[{2, face.surface}] = physical_name(2, face.surface);
      return result;
    }

    /** Returns the mesh with rows counted from the crest, or an empty mesh if elements would be too distorted. */
    ArchMesh mesh_from_crest(const ArchShape &shape, const ArchGrid &grid, const ArchColumns &columns)
    {
      constexpr double  least_wide = .25, least = .1; // scaled Jacobians
      std::vector<bool> refused(columns.s.size(), false);
      for (bool again = true, is_bad = false; again;)
      {
        const ArchPlane plane = rows_from_crest(columns, grid.elements_up, refused);
        ArchMesh        result = extruded(shape, grid, plane);
        HexMesh         part{result.mesh.nodes, {}, {}, {}, {}, nullptr, ""};
        auto            cell = result.mesh.cells.begin();
        again = is_bad = false;
        for (const auto &quad : plane.quads)
        {
          part.cells.assign(cell, cell + grid.elements_through);
          cell += grid.elements_through;
          const double jacobian = mesh_quality(part, false).smallest_scaled_jacobian;
          if (quad.middle > 0 && jacobian < least_wide)
            refused[quad.middle] = again = true;
          is_bad = is_bad || jacobian < least;
        }
        if (!again && !is_bad)
          return result;
      }
      return {};
    }
  } // namespace

  void ArchGrid::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Elements along", elements_along,
        "Total number of elements along the crest [-]. Rounded up such that each monolith has a whole number.",
        Integer(1, 10000));
    prm.add_parameter("Elements up", elements_up,
                      "Number of elements from the base to the crest in the highest column [-].",
                      Integer(1, 1000));
    prm.add_parameter("Elements through", elements_through,
                      "Number of elements from the upstream to the downstream face [-].", Integer(1, 100));
    prm.add_parameter(
        "Equal rows", equal_rows,
        "true: all columns of nodes have \"Elements up\" rows of elements, which are flat at the banks. false: rows "
        "are about as high as in the highest column, and low columns have fewer. With lift joints or \"Rows\", or where "
        "elements would be too distorted, all columns have equal numbers of rows; the log says so.");
    prm.add_parameter("Base joint", base_joint,
                      "true: the base is a joint with the law of section Joints, on every foundation.");
    prm.add_parameter(
        "Lift joints", lift_joints,
        "Number of horizontal lift joints, at equal distances between bottom and crest [-]. A monolith has those that "
        "lie above its base.",
        Integer(0, PhysicalId::max_lifts - 1));
    prm.add_parameter(
        "Smallest height", smallest_height,
        "Smallest height of the dam [m]. Near the banks, where the abutment is nearer to the crest, the dam "
        "is embedded in the bank. With 0 and equal rows, the elements at the ends would be as flat as "
        "\"End wall height\" divided by \"Elements up\".",
        Double(0, 20));
  }

  void ArchGrid::add_choices(const std::string &section, ModelChoices &choices) const
  {
    const unsigned int monoliths = choices.n_joints + 1;
    const auto         add = [&](const std::string &name, const unsigned int now, const unsigned int unit,
                         const unsigned int least)
    {
      const auto add_number = [&](const unsigned int n)
      {
        choices.add("numerics", std::to_string(unit * n) + " elements " + name, section + "/Elements " + name,
                    unit * n, n < now);
      };
      const unsigned int half = std::max(least, now / 2), three_quarters = std::max(least, (3 * now + 1) / 4);
      if (half < now)
        add_number(half);
      if (three_quarters > half && three_quarters < now)
        add_number(three_quarters);
      add_number((3 * now + 1) / 2);
    };
    add("along", std::max(1u, (elements_along + monoliths - 1) / monoliths), monoliths, 1);
    if (rows.empty())
      add("up", elements_up, 1, 4);
    add("through", elements_through, 1, 1);
  }

  void check_grid(const ArchShape &shape, const ArchGrid &grid, const std::string &section)
  {
    const std::string entry = "Entry \"" + section + "/";
    if (grid.lift_joints > 0 && !grid.rows.empty())
      throw InputError(entry + "Lift joints\" is " + std::to_string(grid.lift_joints) +
                       ", but \"Rows\" gives the rows of elements. Set one of the two entries only.");
    if (grid.lift_joints >= grid.elements_up)
      throw InputError(entry + "Lift joints\" is " + std::to_string(grid.lift_joints) +
                       ", but the dam has only " + std::to_string(grid.elements_up) +
                       " rows of elements. Choose fewer lift joints or more rows.");
    if (grid.elements_along == 0 || grid.elements_up == 0 || grid.elements_through == 0)
      throw InputError(entry +
                       (grid.elements_along == 0 ? "Elements along"
                        : grid.elements_up == 0  ? "Elements up"
                                                 : "Elements through") +
                       "\" is 0. Choose at least 1.");
    const Crest  crest(shape);
    const double length = crest.length();
    double       before = 0;
    for (const double place : grid.joint_places)
    {
      if (!(place >= before + 1 && place <= length - 1)) // monoliths of at least 1 m
        throw InputError(entry + "Joint chainages\" has " + number_text(place) + " m after " +
                         number_text(before) +
                         " m. Give lengths that increase by at least 1 m, up to the length of the crest, " +
                         number_text(length) + " m, measured from its right end.");
      before = place;
    }
    const auto spoils = [&](const double height)
    {
      if (!(height < (shape.top() - shape.bottom()) / 2))
        return true;
      const double right =
          grid.joint_places.empty() ? length / grid.n_monoliths() : grid.joint_places.front();
      const double left =
          grid.joint_places.empty() ? length / grid.n_monoliths() : length - grid.joint_places.back();
      return crest.end(Bank::right, height) < crest.end(Bank::right) - right / 2 ||
             crest.end(Bank::left, height) < crest.end(Bank::left) - left / 2;
    };
    if (!(grid.end_wall_height >= 0) || (grid.end_wall_height > 0 && spoils(grid.end_wall_height)))
      throw InputError(entry + "End wall height\" is " + number_text(grid.end_wall_height) +
                       " m. Choose a height above 0 that leaves at least half of the end monoliths' crest.");
    if (!(grid.smallest_height >= 0) || (grid.smallest_height > 0 && spoils(grid.smallest_height)))
      throw InputError(
          entry + "Smallest height\" is " + number_text(grid.smallest_height) +
          " m. Choose a height that the dam exceeds over at least half of the crest of the end monoliths.");
    if (grid.end_wall_height == 0 && grid.smallest_height == 0)
      throw InputError(entry +
                       "Smallest height\" is 0, but the dam has no end walls: its last elements would "
                       "be flat. Choose a height above 0, such as 5 m.");
  }

  ArchMesh make_arch(const ArchShape &shape, const ArchGrid &grid)
  {
    ArchColumns columns = places(shape, grid);
    Crest(shape).check_valley();
    for (const double s : columns.s)
    {
      const Column column = Crest(shape).column(s, grid.smallest_height);
      column.check_valley(false);
      columns.base.emplace_back();
      for (unsigned int l = 0; l <= grid.elements_through; ++l)
        columns.base.back().push_back(column.base(2. * l / grid.elements_through - 1));
    }
    std::string reason = grid.lift_joints > 0 ? "\"Lift joints\" is set"
                         : !grid.rows.empty() ? "\"Rows\" is set"
                                              : "";
    if (!grid.equal_rows && reason.empty())
    {
      if (ArchMesh mesh = mesh_from_crest(shape, grid, columns); !mesh.base.empty())
        return mesh;
      reason = "elements between different numbers of rows would be too distorted";
    }
    const ArchPlane plane = mesh_of_equal_rows(shape, grid, columns);
    ArchMesh        result = extruded(shape, grid, plane);
    if (!grid.equal_rows)
      result.mesh.remark = "all columns have equal numbers of rows: " + reason;
    return result;
  }

  std::vector<std::array<double, 2>> arch_valley(const ArchShape &shape, const ArchGrid &grid)
  {
    std::vector<std::array<double, 2>> valley;
    for (const double s : places(shape, grid).s)
    {
      const Column column = Crest(shape).column(s, grid.smallest_height);
      const auto   base = column.node(column.base(0), 0);
      valley.push_back({s < 0 ? -base[1] : base[1], base[2]});
    }
    return valley;
  }
} // namespace Voussoir
