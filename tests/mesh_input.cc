// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh module with what users give it: names, axes, units, entries; and every kind of bad input.
// Writes its files into the working directory.

#include "mesh_testing.h"

#include <voussoir/base/entries.h>
#include <voussoir/base/output_file.h>
#include <voussoir/dam/mesh_warnings.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/mesh/subdivide.h>

#include <filesystem>
#include <fstream>

using namespace MeshTesting;

namespace
{
  void test_names()
  {
    const std::pair<std::string, int> surfaces[] = {{"base", 1},
                                                    {"Up-stream", -1},
                                                    {"UPSTREAM", 2},
                                                    {"free_surface", 5},
                                                    {"joint3_minus", 10003},
                                                    {"joint 3 side 2", 20003},
                                                    {"Joint-12 Plus", 20012},
                                                    {"joint 100 side 1", 10100},
                                                    {"joint 10000 side 1", -1}};
    for (const auto &name : surfaces)
      expect(physical_id(2, name.first) == name.second, "the surface " + name.first);
    expect(physical_id(3, "monolith7") == 7 && physical_id(3, "Monolith 12") == 12 &&
               physical_id(3, "rock left") == 1000 && physical_id(3, "monolith") == -1,
           "names of volumes");
    for (const int id : {1, 2, 3, 4, 5, 6, 7, 8, 10001, 10099, 19999, 20001, 29999})
      expect(physical_id(2, physical_name(2, id)) == id, "the name of surface " + std::to_string(id));

    // In a file, names decide and ids are what is left: here all are shifted.
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n3 11 \"monolith1\"\n"
                       "3 12 \"Monolith 2\"\n2 7 \"base\"\n2 8 \"upstream\"\n$EndPhysicalNames\n$Nodes\n12\n";
    const auto  mesh = bar(2);
    for (unsigned int n = 0; n < 12; ++n)
      text += std::to_string(n + 1) + " " + std::to_string(mesh.nodes[n][0]) + " " +
              std::to_string(mesh.nodes[n][1]) + " " + std::to_string(mesh.nodes[n][2]) + "\n";
    text += "$EndNodes\n$Elements\n4\n1 3 2 7 1 1 2 6 5\n2 3 2 8 2 1 3 7 5\n3 5 2 11 1 1 2 6 5 3 4 8 7\n"
            "4 5 2 12 2 5 6 10 9 7 8 12 11\n$EndElements\n";
    write_text("names.msh", text);
    const auto named = read_gmsh("names.msh");
    expect(named.cells[0].volume == 1 && named.cells[1].volume == 2 && named.faces[0].surface == 1 &&
               named.faces[1].surface == 2 && named.names.at({3, 2}) == "Monolith 2",
           "names decide");
  }

  void test_axes_and_units()
  {
    // A file with x to the right bank, y downstream, z up, in millimetres; and its mirror image.
    HexMesh    file = bar(2);
    const auto ours = file;
    for (auto &node : file.nodes)
      node = {-1000 * node[1], 1000 * node[0], 1000 * node[2]};
    write_gmsh(file, "axes.msh");
    MeshParameters parameters;
    parameters.source = "file";
    parameters.file = "axes.msh";
    parameters.axes = "y -x z";
    parameters.length_unit = "mm";
    HexMesh mesh = make_mesh(parameters, ".");
    for (unsigned int n = 0; n < 12; ++n)
      expect(rounded(mesh.nodes[n]) == rounded(ours.nodes[n]), "axes");
    parameters.axes = "y x z";
    mesh = make_mesh(parameters, std::filesystem::current_path().string());
    expect(mesh.nodes[11][1] < -1.9 && smallest_jacobian(mesh) > 0, "mirrored axes");
    for (const std::string axes : {"x y", "x y y", "x y z z", "a b c", "--x y z", "- x y"})
    {
      parameters.axes = axes;
      expect_error([&] { parameters.check(); }, {"\"Mesh/Axes\""});
    }
  }

  void test_parameters()
  {
    MeshParameters parameters;
    Entries        prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(
        "subsection Mesh\nset Axes = y x z\nsubsection Arch210\nset Joints = 5\nend\nend\n");
    expect(parameters.axes == "y x z" && parameters.arch210.n_joints == 5, "entries");
    parameters.axes = "x y z";
    expect(n_monoliths(make_mesh(parameters, "")) == 6, "make_mesh");
    parameters.arch210.n_joints = 28;
    parameters.arch210.end_wall_height = 50;
    expect_error([&] { parameters.check(); }, {"End wall height"});
    parameters.arch210.end_wall_height = 0.5;
    for (const double height : {-1., 20., 150.})
    {
      parameters.arch210.smallest_height = height;
      expect_error([&] { parameters.check(); }, {"\"Mesh/Arch210/Smallest height\""});
    }
    parameters.arch210.smallest_height = 12; // the outermost of 28 joints is 30.6 m high
    parameters.arch210.check();
    parameters.source = "file";
    expect_error([&] { parameters.check(); }, {"\"Mesh/File\""});
  }

  void test_bad_files()
  {
    expect_error([] { read_gmsh("no_such_file.msh"); }, {"no_such_file.msh", "does not exist"});
    write_text("script.msh", "Point(1) = {0, 0, 0};\n");
    expect_error([] { read_gmsh("script.msh"); }, {"not a gmsh mesh"});
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const std::string names = "$PhysicalNames\n1\n3 1 \"monolith 1\"\n$EndPhysicalNames\n";
    const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    write_text("tetrahedra.msh", head + names + nodes + "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
    expect_error([] { read_gmsh("tetrahedra.msh"); },
                 {"Tetrahedron", "monolith 1", "hexahedra", "lock", "SubdivisionAlgorithm"});
    write_text("empty.msh", head + nodes + "$Elements\n0\n$EndElements\n");
    expect_error([] { read_gmsh("empty.msh"); }, {"no hexahedra"});
    write_text("truncated.msh", head + names + nodes + "$Elements\n3\n1 4 2 1 1 1 2");
    expect_error([] { read_gmsh("truncated.msh"); }, {"truncated.msh"});

    std::ostringstream quadratic;
    quadratic << head << names << "$Nodes\n20\n";
    const double corners[20][3] = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},
                                   {1, 0, 1},  {1, 1, 1},  {0, 1, 1},  {.5, 0, 0}, {0, .5, 0},
                                   {0, 0, .5}, {1, .5, 0}, {1, 0, .5}, {.5, 1, 0}, {1, 1, .5},
                                   {0, 1, .5}, {.5, 0, 1}, {0, .5, 1}, {1, .5, 1}, {.5, 1, 1}};
    for (unsigned int n = 0; n < 20; ++n)
      quadratic << n + 1 << " " << corners[n][0] << " " << corners[n][1] << " " << corners[n][2] << "\n";
    quadratic << "$EndNodes\n$Elements\n1\n1 17 2 1 1";
    for (unsigned int n = 1; n <= 20; ++n)
      quadratic << " " << n;
    quadratic << "\n$EndElements\n";
    write_text("quadratic.msh", quadratic.str());
    const HexMesh cube = read_gmsh("quadratic.msh"); // its corners
    expect(cube.cells.size() == 1 && cube.nodes.size() == 8, "hexahedron of 20 nodes");
    expect_close(volume(cube), 1., 1e-12, "volume of its corners");

    expect_error<WriteError>([] { write_gmsh(bar(1), "no_such_directory/a.msh"); },
                             {"no_such_directory/a.msh", "cannot be written"});
    expect_error([] { write_gmsh(bar(1), "a.txt"); }, {".msh"});
    HexMesh unknown = bar(1);
    unknown.faces[0].surface = 77;
    write_gmsh(unknown, "unknown.msh");
    expect_error([] { read_gmsh("unknown.msh"); }, {"surface 77", "unknown"});
  }

  /** A cube and beside it half a cube, as a wedge or as a hexahedron with two edges collapsed. */
  std::string wedge_file(const bool collapsed)
  {
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"monolith 1\"\n2 1 \"base\"\n"
        "$EndPhysicalNames\n$Nodes\n10\n";
    const double nodes[10][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}};
    for (unsigned int n = 0; n < 10; ++n)
      text += std::to_string(n + 1) + " " + std::to_string(nodes[n][0]) + " " + std::to_string(nodes[n][1]) +
              " " + std::to_string(nodes[n][2]) + "\n";
    text += "$EndNodes\n$Elements\n4\n1 3 2 1 1 1 2 3 4\n2 2 2 1 1 2 9 3\n3 5 2 1 2 1 2 3 4 5 6 7 8\n";
    text += collapsed ? "4 5 2 1 2 2 9 9 3 6 10 10 7\n" : "4 6 2 1 2 2 9 3 6 10 7\n";
    return text + "$EndElements\n";
  }

  void test_wedges()
  {
    for (const bool collapsed : {false, true})
    {
      write_text("wedge.msh", wedge_file(collapsed));
      expect_error([] { read_gmsh("wedge.msh"); },
                   {"element 4 of monolith 1", "wedge", "\"Mesh/Subdivide\" = true"});
      const HexMesh mesh = read_gmsh("wedge.msh", true);
      expect(mesh.cells.size() == 14 && mesh.faces.size() == 7, "cells and faces");
      expect_close(volume(mesh), 1.5, 1e-12, "volume");
      check_mesh(mesh, "wedge.msh");
      for (const HexMesh::Cell &cell : mesh.cells)
        expect(min_jacobian(mesh, cell) > .02, "shape");
      double base = 0.;
      for (const HexMesh::Face &face : mesh.faces)
        base += centre(mesh, face.nodes)[2];
      expect(base == 0., "faces of the base");
    }
    const std::vector<unsigned int> cube = {0, 1, 2, 3, 4, 5, 6, 7};
    expect(without_double_corners(cube) == cube, "a hexahedron is one");
  }

  void test_bad_meshes()
  {
    const auto bad = [](const std::function<void(HexMesh &)> &spoil, const std::vector<std::string> &parts)
    {
      HexMesh mesh = bar(3);
      spoil(mesh);
      expect_error([&] { check_mesh(mesh, "some.msh"); }, parts);
    };
    bad([](HexMesh &m) { m.nodes[3][1] = std::nan(""); }, {"some.msh", "node 4"});
    bad([](HexMesh &m) { std::swap(m.cells[1].nodes[0], m.cells[1].nodes[1]); },
        {"hexahedron 2", "monolith 2", "(0.5, 1.5, 0.5)", "inverted"});
    bad([](HexMesh &m) { m.cells[2].volume = 5; }, {"no monolith 3"});
    bad([](HexMesh &m) { m.cells[2].volume = 0; }, {"out of range"});
    bad([](HexMesh &m) { m.faces.push_back({{0, 1, 6, 7}, 2}); }, {"'upstream'", "no hexahedron"});
    bad([](HexMesh &m) { m.faces.push_back({{4, 5, 7, 6}, 2}); }, {"'upstream'", "inside"});
    bad([](HexMesh &m) { m.faces.push_back({{0, 1, 5, 4}, 2}); }, {"'upstream'", "'base'"});
    bad([](HexMesh &m) { m.cells.push_back(m.cells[1]), m.cells.push_back(m.cells[1]); },
        {"three hexahedra"});
    bad(
        [](HexMesh &m)
        {
          m = open_joints(m);
          m.faces.erase(std::remove_if(m.faces.begin(), m.faces.end(),
                                       [](const auto &face) { return is_joint_side(face.surface); }),
                        m.faces.end());
        },
        {"face to face", "(0.5, 1, 0.5)"});

    HexMesh mirrored = bar(3);
    for (auto &cell : mirrored.cells)
      std::swap_ranges(cell.nodes.begin(), cell.nodes.begin() + 4, cell.nodes.begin() + 4);
    normalize(mirrored);
    check_mesh(mirrored, "mirrored");

    HexMesh     apart = bar(3); // the third cube belongs to the first one's monolith, which it does not touch
    const Scene scene;
    apart.cells[2].volume = 1;
    const std::vector<std::string> warnings = mesh_warnings(open_joints(apart), scene, {Zone()});
    expect(warnings.size() == 1 && warnings[0].find("monolith 1 has 2 parts") == 0,
           "a monolith in two parts");
    expect(mesh_warnings(open_joints(bar(3)), scene, {Zone()}).empty(), "monoliths in one part each");

    HexMesh gap = open_joints(bar(3));
    for (const auto &face : gap.faces)
      if (face.surface == PhysicalId::joint_side_2 + 2)
        gap.nodes[*std::max_element(face.nodes.begin(), face.nodes.end())][1] += 0.01;
    expect_error([&] { open_joints(gap); }, {"joint 2", "side 1", "(1, 2, 1)", "0.01 m away"});
    HexMesh half = open_joints(bar(3));
    half.faces.erase(std::remove_if(half.faces.begin(), half.faces.end(),
                                    [](const auto &face)
                                    { return face.surface == PhysicalId::joint_side_2 + 1; }),
                     half.faces.end());
    expect_error([&] { close_joints(half); }, {"joint 1", "no side 2", "'joint 1 side 2'"});
  }

} // namespace

int main()
{
  return run({{"names", test_names},
              {"axes and units", test_axes_and_units},
              {"parameters", test_parameters},
              {"bad files", test_bad_files},
              {"wedges", test_wedges},
              {"bad meshes", test_bad_meshes}});
}
