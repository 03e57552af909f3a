// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/foreign_mesh.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_source.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace Voussoir
{

  std::array<FileAxis, 3> file_axes(const std::string &text)
  {
    std::array<FileAxis, 3> axes{};
    std::array<bool, 3>     used{};
    std::istringstream      stream(text);
    std::string             word;
    unsigned int            n = 0;
    for (; stream >> word; ++n)
    {
      const bool        is_signed = word[0] == '-' || word[0] == '+';
      const std::string letter = word.substr(is_signed ? 1 : 0);
      const std::size_t coordinate = letter.size() == 1 ? std::string("xyz").find(letter) : std::string::npos;
      if (n == 3 || coordinate == std::string::npos || used[coordinate])
        throw InputError("Entry \"Mesh/Axes\" is \"" + text +
                         "\". Give the axes of the file that point downstream, to the " +
                         "left bank and up: each of x, y and z once, with a minus sign for the opposite " +
                         "direction, as in \"y -x z\".");
      used[coordinate] = true;
      axes[n] = {static_cast<unsigned int>(coordinate), word[0] == '-' ? -1. : 1.};
    }
    if (n != 3)
      throw InputError("Entry \"Mesh/Axes\" is \"" + text +
                       "\", but must name three axes of the file: those that point downstream, to the left "
                       "bank and up, as in \"y -x z\".");
    return axes;
  }

  double metres(const std::string &unit)
  {
    const std::map<std::string, double> units = {{"m", 1.},   {"cm", 1e-2},   {"mm", 1e-3},
                                                 {"km", 1e3}, {"ft", 0.3048}, {"in", 0.0254}};
    return units.at(unit);
  }

  MeshParameters::MeshParameters()
  {
    arch210_rock.upstream = arch210_rock.downstream = arch210_rock.sides = arch210_rock.depth =
        arch210_height;
    arch210_rock.element_size = 22;
  }

  void MeshParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.add_parameter(
        "Source", source,
        "Source of the mesh. arch210: built-in dam. arcs: dam from a table of arcs, \"Arcs/Table\". "
        "file: the mesh file of the entry \"File\".",
        Selection("arch210|arcs|file"));
    prm.add_parameter(
        "File", file,
        "Mesh file with hexahedra, relative to the directory of the input file. Formats: gmsh (MSH 4.1 or "
        "2.2), and with the Python package meshio .inp of Abaqus and CalculiX and .med of Salome "
        "(doc/mesh.md). The physical volumes are 'monolith 1', 'monolith 2', ... and 'rock ...'. The "
        "physical surfaces are 'base', 'upstream', 'downstream' and 'crest', and with rock 'free surface' "
        "and 'artificial boundary'. The mesh may be conforming at the joints. With doubled nodes, the sides "
        "of the joints are the surfaces 'joint 1 side 1', 'joint 1 side 2' and so on. The volume 'water' is the "
        "mesh of the water for Reservoir/Model acoustic and incompressible (doc/water.md).",
        Anything());
    prm.add_parameter(
        "Axes", axes,
        "Axes of the mesh file that point downstream, to the left bank and up: each of x, y and z once. A "
        "minus sign means the opposite direction. Example: 'y -x z' for a file with x to the right bank, y "
        "downstream and z up. A left-handed choice mirrors the dam.",
        Anything());
    prm.add_parameter("Subdivide", subdivide,
                      "true: all cells of the file are divided at their midpoints. A hexahedron becomes "
                      "eight hexahedra, a wedge six. Required for a mesh with wedges.");
    prm.add_parameter(
        "Plane strain", plane_strain,
        "true: plane strain. The displacement along y is zero at all nodes. The mesh is a slice of the "
        "dam between two planes y = constant, with the same section at each y.");
    prm.add_parameter("Length unit", length_unit, "Unit of the coordinates in the mesh file.",
                      Selection("m|cm|mm|km|ft|in"));
    prm.leave_subsection();
    arch210.add_parameters(prm);
    arcs.add_parameters(prm);
    const auto add_rock = [&](const std::string &dam, ArchRockParameters &rock)
    {
      prm.enter_subsection("Mesh");
      prm.enter_subsection(dam);
      rock.add_parameters(prm, dam == "Arcs");
      prm.leave_subsection();
      prm.leave_subsection();
    };
    add_rock("Arch210", arch210_rock);
    add_rock("Arcs", arcs_rock);
  }

  void MeshParameters::add_choices(const bool uses_rock, ModelChoices &choices) const
  {
    if (source == "file")
      return;
    (source == "arcs" ? arcs.grid : ArchGrid(arch210)).add_choices(section(), choices);
    if (uses_rock)
      generated_rock()->add_choices(section(), choices);
  }

  void MeshParameters::check() const
  {
    file_axes(axes);
    if (source == "arch210")
    {
      arch210.check();
      arch210_rock.check("Mesh/Arch210", arch210_height);
    }
    else if (source == "arcs")
      arcs.check();
    else if (file.empty())
      throw InputError(
          "Entry \"Mesh/Source\" is file, but the entry \"Mesh/File\" is empty. Give the path of a gmsh "
          "mesh, relative to the directory of the input file.");
  }

  std::string MeshParameters::name() const
  {
    return source == "file" ? file : source == "arcs" ? arcs.table : source;
  }

  const ArchRockParameters *MeshParameters::generated_rock() const
  {
    return source == "arch210" ? &arch210_rock : source == "arcs" ? &arcs_rock : nullptr;
  }

  namespace
  {
    /** Throws InputError for rock beside a dam whose end walls are high: the rock supports the base only. */
    void check_ends(const ArchShape &shape, const ArchGrid &grid, const std::string &source)
    {
      const auto   valley = arch_valley(shape, grid);
      const double height = shape.top() - shape.bottom();
      for (const bool is_left : {false, true})
        if (const double wall = shape.top() - (is_left ? valley.back() : valley.front())[1];
            wall > std::max(grid.smallest_height, grid.end_wall_height) + 0.05 * height)
          throw InputError(
              source + ": the dam ends with a wall of " + number_text(wall) + " m at the " +
              (is_left ? "left" : "right") +
              " bank. The generated rock supports only the base of the dam, not such a wall. Let "
              "the abutment rise to the crest, use a mesh file with rock, or set "
              "\"Foundation/Model\" to rigid.");
    }

    HexMesh generate(const MeshParameters &parameters, const std::string &scene_directory)
    {
      const bool                       is_arch210 = parameters.source == "arch210";
      const std::unique_ptr<ArchShape> table = is_arch210 ? nullptr : parameters.arcs.shape(scene_directory);
      const ArchShape                 &shape = is_arch210 ? arch210_shape() : *table;
      const ArchGrid                   grid =
          is_arch210 ? static_cast<const ArchGrid &>(parameters.arch210) : parameters.arcs.complete_grid();
      const double             height = shape.top() - shape.bottom();
      const ArchRockParameters rock = parameters.generated_rock()->complete(height);
      check_grid(shape, grid, parameters.section());
      rock.check(parameters.section(), height);
      if (rock.enabled)
        check_ends(shape, grid, parameters.name());
      ArchMesh result = make_arch(shape, grid);
      if (rock.enabled)
        add_arch_rock(shape, grid, rock, result);
      check_mesh(result.mesh, parameters.name());
      return std::move(result.mesh);
    }
  } // namespace

  HexMesh make_mesh(const MeshParameters &parameters, const std::string &scene_directory)
  {
    parameters.check();
    if (parameters.source != "file")
      return generate(parameters, scene_directory);

    // The operator / of a path does not change absolute paths.
    const std::string file = (std::filesystem::path(scene_directory) / parameters.file).string();
    HexMesh           mesh = is_foreign_mesh(file) ? read_foreign_mesh(file, parameters.subdivide)
                                                   : read_gmsh(file, parameters.subdivide);
    const auto        axes = file_axes(parameters.axes);
    const double      unit = metres(parameters.length_unit);
    for (auto &node : mesh.nodes)
    {
      const auto from = node;
      for (unsigned int d = 0; d < 3; ++d)
        node[d] = axes[d].sign * unit * from[axes[d].coordinate];
    }
    normalize(mesh); // left-handed axes mirror the cells
    split_water(mesh);
    check_mesh(mesh, file);
    return mesh;
  }
} // namespace Voussoir
