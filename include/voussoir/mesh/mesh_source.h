// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_source_h
#define voussoir_mesh_source_h

#include <voussoir/mesh/arch210_rock.h>
#include <voussoir/mesh/mesh.h>

#include <string>

namespace Voussoir
{
  class Entries;

  /** Source of the mesh: subsection "Mesh" of the input file. */
  struct MeshParameters
  {
    std::string           source = "arch210"; ///< "arch210" or "file"
    std::string           file = "";          ///< mesh file, relative to the directory of the input file
    std::string           axes = "x y z"; ///< axes of the file that point downstream, to the left bank and up
    std::string           length_unit = "m"; ///< of the coordinates in the file: see metres()
    bool                  subdivide = false; ///< divide every cell of the file: subdivide()
    Arch210Parameters     arch210;
    Arch210RockParameters arch210_rock;

    void add_parameters(Entries &prm);

    /** Throws InputError if source is "file" and file is empty, if axes is not three different axes, or if
     * the parameters of arch210 are wrong. */
    void check() const;
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
