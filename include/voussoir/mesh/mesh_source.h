// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_source_h
#define voussoir_mesh_source_h

#include <voussoir/mesh/arch210.h>
#include <voussoir/mesh/arch_rock.h>
#include <voussoir/mesh/arcs.h>
#include <voussoir/mesh/mesh.h>

#include <string>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  /** Source of the mesh: subsection "Mesh" of the input file. */
  struct MeshParameters
  {
    std::string        source = "arch210"; ///< "arch210", "arcs" or "file"
    std::string        file = "";          ///< mesh file, relative to the directory of the input file
    std::string        axes = "x y z";    ///< axes of the file that point downstream, to the left bank and up
    std::string        length_unit = "m"; ///< of the coordinates in the file: see metres()
    bool               subdivide = false; ///< divide every cell of the file: subdivide()
    bool               plane_strain = false; ///< no displacements along y: Structure::plane_strain
    Arch210Parameters  arch210;
    ArcsParameters     arcs;
    ArchRockParameters arch210_rock, arcs_rock;

    MeshParameters();

    void add_parameters(Entries &prm);

    /** Adds the changes of a generated mesh. @p uses_rock: true if the foundation uses rock. */
    void add_choices(bool uses_rock, ModelChoices &choices) const;

    /** Throws InputError if the file or the table of the source is not named, if axes is not three different axes, or
     * if the parameters of arch210 are wrong. */
    void check() const;

    /** Returns the name of the mesh for messages: arch210, or the path of the file or table. */
    std::string name() const;

    /** Returns the rock of a generated mesh; a null pointer for a file. */
    const ArchRockParameters *generated_rock() const;

    /** Returns the subsection of a generated mesh, "Mesh/Arch210" or "Mesh/Arcs". */
    std::string section() const { return source == "arcs" ? "Mesh/Arcs" : "Mesh/Arch210"; }
  };

  /** Axis of the file that corresponds to an axis of the program: coordinate and sign. */
  struct FileAxis
  {
    unsigned int coordinate; ///< 0, 1 or 2
    double       sign;       ///< 1 or -1
  };

  /** Converts a text such as "y -x z" to the axes of the file that point downstream, to the left bank and up.
   * Throws InputError if the text is not three different axes. */
  std::array<FileAxis, 3> file_axes(const std::string &text);

  /** Returns the length of a unit (m, cm, mm, km, ft, in) [m]. */
  double metres(const std::string &unit);

  /** Generates or reads the mesh, transforms it to metres with x downstream, y to the left bank and z up, and
   * checks it with check_mesh(). The joints are unchanged: see open_joints() and close_joints().
   *
   * @param parameters subsection "Mesh"
   * @param scene_directory directory of the input file
   *
   * Throws InputError like MeshParameters::check(), read_gmsh(), read_foreign_mesh() and check_mesh(). */
  HexMesh make_mesh(const MeshParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
