// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of a mesh mean: groups by name, axes and units, the arc length along the crest, probes.
// Writes its files into the working directory.

#include "mesh_testing.h"

#include <voussoir/dam/dam_geometry.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/solid/solid_grid.h>

#include <fstream>

using namespace MeshTesting;

namespace
{
  /** Returns an upright arch, 10 m high, with @p n cells along, one through and one up. The nodes are on
   * circles of radius 40 m (upstream) and 30 m around the origin. The upstream face looks along -x. */
  HexMesh arch(const unsigned int n)
  {
    HexMesh mesh;
    for (unsigned int j = 0; j <= n; ++j)
    {
      const double angle = (double(j) / n - .5) * 1.8; // from the right bank to the left
      for (const double z : {0., 10.})
        for (const double r : {40., 30.})
          mesh.nodes.push_back({-r * std::cos(angle), r * std::sin(angle), z});
    }
    for (unsigned int j = 0; j < n; ++j)
    {
      const unsigned int a = 4 * j, b = a + 4;
      mesh.cells.push_back({{a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2}, j < n / 2 ? 1 : 2});
      mesh.faces.push_back({{a, a + 1, b + 1, b}, PhysicalId::base});
      mesh.faces.push_back({{a, b, b + 2, a + 2}, PhysicalId::upstream});
      mesh.faces.push_back({{a + 1, b + 1, b + 3, a + 3}, PhysicalId::downstream});
      mesh.faces.push_back({{a + 2, a + 3, b + 3, b + 2}, PhysicalId::crest});
    }
    return mesh;
  }

  std::string check(const HexMesh &mesh, const std::string &axes = "x y z", const std::string &unit = "m")
  {
    MeshParameters parameters;
    parameters.source = "file";
    parameters.axes = axes;
    parameters.length_unit = unit;
    return check_axes_and_units(mesh, parameters, "some.msh");
  }

  /** Returns the arch as a file with other axes or units has it. @p to: coordinates in the file. */
  HexMesh moved(const std::function<std::array<double, 3>(const std::array<double, 3> &)> &to)
  {
    HexMesh mesh = arch(8);
    for (auto &node : mesh.nodes)
      node = to(node);
    normalize(mesh);
    return mesh;
  }

  void test_axes()
  {
    using P = std::array<double, 3>;
    check(arch(8));
    check(moved([](const P &p) { return P{p[0], -p[1], p[2]}; })); // the mirror image
    // In the file: x to the right bank, y downstream, and as the peers' meshes
    expect_error(
        [] {
          check(moved([](const P &p) { return P{-p[1], p[0], p[2]}; }));
        },
        {"some.msh", "downstream face", "\"Mesh/Axes\" = y -x z", "now it is x y z"});
    // z across, y up
    expect_error(
        [] {
          check(moved([](const P &p) { return P{p[0], p[2], -p[1]}; }));
        },
        {"crest", "along y", "\"Mesh/Axes\" = x -z y"});
    // x up, y downstream
    expect_error(
        [] {
          check(moved([](const P &p) { return P{p[2], p[0], p[1]}; }));
        },
        {"crest", "along x", "\"Mesh/Axes\" = y z x"});
    // Turned by half a turn: the monoliths' numbers tell it from exchanged faces.
    expect_error(
        [] {
          check(moved([](const P &p) { return P{-p[0], -p[1], p[2]}; }));
        },
        {"'downstream' faces upstream", "\"Mesh/Axes\" = -x -y z", "the axes are wrong"});
    // The scene turns already, but wrongly: what is proposed is in the axes of the file.
    expect_error(
        [] {
          check(moved([](const P &p) { return P{-p[1], p[0], p[2]}; }), "y -x z");
        },
        {"\"Mesh/Axes\" = -x -y z", "now it is y -x z"});
    HexMesh exchanged = arch(8);
    for (auto &face : exchanged.faces)
      if (face.surface == PhysicalId::upstream || face.surface == PhysicalId::downstream)
        face.surface = PhysicalId::upstream + PhysicalId::downstream - face.surface;
    expect_error([&] { check(exchanged); },
                 {"'downstream' faces upstream", "Exchange the names", "the names are wrong"});
    HexMesh upside_down = arch(8);
    for (auto &face : upside_down.faces)
      if (face.surface == PhysicalId::crest || face.surface == PhysicalId::base)
        face.surface = PhysicalId::crest + PhysicalId::base - face.surface;
    expect_error([&] { check(upside_down); }, {"crest", "along -z"});
    HexMesh no_crest = upside_down;
    no_crest.faces.erase(std::remove_if(no_crest.faces.begin(), no_crest.faces.end(),
                                        [](const auto &face) { return face.surface == PhysicalId::crest; }),
                         no_crest.faces.end());
    expect_error([&] { check(no_crest); }, {"base faces up"});
    // Turned about z: a valley whose sides differ looks 30 degrees off x, by 50 degrees it is the mesh. And a
    // block that leans.
    check(moved([](const P &p) { return P{.866 * p[0] - .5 * p[1], .5 * p[0] + .866 * p[1], p[2]}; }));
    expect_error(
        [&] {
          check(moved(
              [](const P &p) {
                return P{.643 * p[0] - .766 * p[1], .766 * p[0] + .643 * p[1], p[2]};
              }));
        },
        {"50 degrees to x", "Turn the mesh about z"});
    check(moved([](const P &p) { return P{p[0] + p[2], p[1], p[2]}; }));
  }

  void test_units()
  {
    using P = std::array<double, 3>;
    const auto scaled = [](const double s) {
      return moved([s](const P &p) { return P{s * p[0], s * p[1], s * p[2]}; });
    };
    check(scaled(.51));
    check(scaled(39.));
    expect_error([&] { check(scaled(1e3)); },
                 {"10000 m high", "5 to 400 m", "\"Mesh/Length unit\" is m", "mm (then it is 10 m"});
    expect_error([&] { check(scaled(1e2)); }, {"1000 m high", "cm (then it is 10 m"});
    for (const std::string unit : {"m", "mm"})
    {
      const std::string warning = check(scaled(1e-3), "x y z", unit);
      for (const std::string part :
           {"0.01 m high", unit == "m" ? "km (then it is 10 m" : " m (then it is 10 m"})
        expect(warning.find(part) != std::string::npos, "'" + part + "' is missing: " + warning);
    }
    MeshParameters parameters;
    for (const auto &unit : {std::pair<const char *, double>{"m", 1.},
                             {"cm", .01},
                             {"mm", .001},
                             {"km", 1e3},
                             {"ft", .3048},
                             {"in", .0254}})
      expect_close(metres(unit.first), unit.second, 1e-15, unit.first);
  }

  /** A file of a bar of two cells with these lines of $PhysicalNames and the ids of its groups. */
  HexMesh named(const std::vector<std::string> &names, const int volume_1, const int volume_2,
                const int surface)
  {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    if (!names.empty())
      text << "$PhysicalNames\n" << names.size() << "\n";
    for (const std::string &name : names)
      text << name << "\n";
    text << (names.empty() ? "" : "$EndPhysicalNames\n") << "$Nodes\n12\n";
    const HexMesh mesh = bar(2);
    for (unsigned int n = 0; n < 12; ++n)
      text << n + 1 << " " << mesh.nodes[n][0] << " " << mesh.nodes[n][1] << " " << mesh.nodes[n][2] << "\n";
    text << "$EndNodes\n$Elements\n3\n1 3 2 " << surface << " 1 1 2 6 5\n2 5 2 " << volume_1
         << " 1 1 2 6 5 3 4 8 7\n3 5 2 " << volume_2 << " 2 5 6 10 9 7 8 12 11\n$EndElements\n";
    std::ofstream("groups.msh") << text.str();
    return read_gmsh("groups.msh");
  }

  void test_groups()
  {
    expect_error(
        [] {
          named({"2 1 \"gallery wall\"", "3 1 \"monolith 1\"", "3 2 \"monolith 2\""}, 1, 2, 1);
        },
        {"groups.msh", "surface 'gallery wall' (id 1)", "unknown name", "Did you mean '", "'upstream'",
         "'crest'"});
    expect_error(
        [] {
          named({"2 1 \"base\"", "3 1 \"monolith 1\"", "3 4 \"foundation\""}, 1, 4, 1);
        },
        {"volume 'foundation' (id 4)", "unknown name", "'monolith 1'", "'rock'"});
    expect_error([] { named({"2 3 \"donwstream\""}, 1, 2, 3); },
                 {"'donwstream'", "Did you mean 'downstream'?"});
    expect_error([] { named({"3 3 \"monolth 7\""}, 1, 3, 3); }, {"Did you mean 'monolith 7'?"});
    // An id counts for a group without a name, but not beside a group with the name of this id.
    expect_error([] { named({"3 5 \"monolith 1\""}, 5, 1, 1); }, {"'monolith 1'", "no name", "both"});
    HexMesh mesh = named({"3 5 \"Monolith_1\""}, 5, 2, 1);
    expect(mesh.cells[0].volume == 1 && mesh.cells[1].volume == 2 && mesh.faces[0].surface == 1,
           "names and ids");
    expect(group_table(mesh) == "Monolith_1           ->  monolith 1  1 hexahedra\n"
                                "volume 2 (no name)   ->  monolith 2  1 hexahedra\n"
                                "surface 1 (no name)  ->  base        1 faces",
           group_table(mesh));
    // Rocks of several names
    mesh = named({"3 3 \"rock left bank\"", "3 4 \"Rock-2\""}, 3, 4, 6);
    expect(!is_monolith(mesh.cells[0].volume) && !is_monolith(mesh.cells[1].volume) &&
               mesh.cells[0].volume != mesh.cells[1].volume,
           "two rocks");
    expect(group_table(mesh).find("rock left bank") != std::string::npos &&
               group_table(mesh).find("Rock-2") != std::string::npos,
           group_table(mesh));
    // Many monoliths are one line.
    const std::string table = group_table(bar(5));
    expect(table.find("monolith 1 to monolith 5  5 hexahedra") != std::string::npos &&
               std::count(table.begin(), table.end(), '\n') == 1,
           table);
  }

  void test_arc_length()
  {
    const HexMesh     mesh = arch(8);
    const SolidModel  model(mesh, 1);
    const DamGeometry geometry(model, {}, 0, "of the test");
    // The edge is a regular polygon: s is the number of sides from the middle times their length.
    const double side = 2. * 40. * std::sin(.5 * 1.8 / 8);
    const auto   corner = [](const double j)
    {
      const double angle = (j / 8 - .5) * 1.8;
      return dealii::Point<3>(-40. * std::cos(angle), 40. * std::sin(angle), 10.);
    };
    const auto expect_at = [&](const dealii::Point<3> &p, const double s, const std::string &what)
    {
      std::ostringstream text;
      text << what << ": s = " << geometry.arc_length(to_vector(p)) << " m, not " << s << " m";
      expect(std::abs(geometry.arc_length(to_vector(p)) - s) < 1e-9, text.str());
    };
    for (unsigned int j = 0; j < 8; ++j)
      for (const double t : {0., .25, .5, .9})
      {
        const auto             along = corner(j + 1) - corner(j);
        const dealii::Point<3> normal(along[1] / side, -along[0] / side, 0.);
        for (const double off : {0., 2., -2.}) // a little up- and downstream, also of the corners' sectors
          if (off == 0. || (t > .2 && t < .8))
            expect_at(corner(j) + t * along + off * normal, (j + t - 4.) * side, "side " + std::to_string(j));
      }
    for (const double beyond : {.5, 3.}) // the end sides continue
    {
      expect_at(corner(0) + beyond * (corner(0) - corner(1)), (-4. - beyond) * side, "beyond the right end");
      expect_at(corner(8) + beyond * (corner(8) - corner(7)), (4. + beyond) * side, "beyond the left end");
    }
    // Points before the last side that lie on its line do not belong to it, nor after the first one.
    for (const double before : {2., 4., 6.})
      for (const bool left : {true, false})
      {
        const auto p = left ? corner(8) + (1. + before) * (corner(7) - corner(8))
                            : corner(0) + (1. + before) * (corner(1) - corner(0));
        double     nearest = 1e300, s = 0.; // by brute force
        const int  n = 8000;
        for (int i = 0; i <= n; ++i)
        {
          const double           j = std::min(7, int(8. * i / n)), t = 8. * i / n - j;
          const dealii::Point<3> q = corner(j) + t * (corner(j + 1) - corner(j));
          if (q.distance(p) < nearest)
            nearest = q.distance(p), s = (8. * i / n - 4.) * side;
        }
        expect(std::abs(geometry.arc_length(to_vector(p)) - s) < 2. * 8. * side / n,
               "a point on the line of an end side: s = " +
                   std::to_string(geometry.arc_length(to_vector(p))) + " m, not " + std::to_string(s) + " m");
      }
  }

  void test_probes()
  {
    const SolidModel model(arch(8), 1);
    const PlaceInDam node = probe_place(model, "crown", {{-40., 0., 10.}});
    expect(node.parts.size() == 1 && node.parts[0].second == 1. &&
               distance_between(model.points[node.parts[0].first], {{-40., 0., 10.}}) < 1e-9,
           "the node of a probe");
    // Two nodes are at the same distance from the middle: the last digit of a coordinate must not decide.
    const SolidModel even(arch(7), 1);
    for (const double y : {-1e-9, 0., 1e-9, .5, 3., 7.})
    {
      const auto at = [&](const Vector3 &p, const std::function<Vector3(unsigned int)> &at_node)
      { return probe_place(even, "between", p).interpolated(at_node); };
      const auto linear = [&](const unsigned int i) { return even.points[i]; };
      const auto square = [&](const unsigned int i) {
        return Vector3{{even.points[i][0] * even.points[i][0], even.points[i][2], 0.}};
      };
      const Vector3 p = {{-36., y, 4.}}, mirrored = {{-36., -y, 4.}};
      expect(distance_between(at(p, linear), p) < 1e-9, "a linear field at a probe");
      expect(distance_between(at(p, square), at(mirrored, square)) < 1e-8, "a mirrored probe");
    }
    // At half a metre before the middle of a side
    const PlaceInDam outside = probe_place(model, "outside", {{-39.993, 4.518, 9.}});
    expect(outside.parts.size() == 4 && distance_between(outside.point, {{-39.496, 4.462, 9.}}) < .01,
           "the point of the face at a probe outside");
    expect_error(
        [&] {
          probe_place(model, "far", {{-40., 0., 200.}});
        },
        {"Output/Probes", "\"far\"", "(-40, 0, 200) m", "190 m from the dam", "(-40, 0, 10) m"});
  }
} // namespace

int main()
{
  return run({{"axes", test_axes},
              {"units", test_units},
              {"groups", test_groups},
              {"arc length", test_arc_length},
              {"probes", test_probes}});
}
