// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_source_h
#define voussoir_mesh_source_h

#include <voussoir/mesh/arch210_rock.h>
#include <voussoir/mesh/mesh.h>

#include <string>

namespace Voussoir
{
  class Entries;

  /** Where the mesh comes from: subsection "Mesh" of the scene. */
  struct MeshParameters
  {
    std::string           source = "arch210"; ///< "arch210" or "file"
    std::string           file = "";          ///< gmsh file, relative to the scene's directory
    std::string           axes = "x y z";     ///< the file's axes downstream, to the left bank, up
    std::string           length_unit = "m";  ///< of the file: see metres()
    bool                  subdivide = false;  ///< every cell of the file into hexahedra: wedges become three
    Arch210Parameters     arch210;
    Arch210RockParameters arch210_rock;

    void add_parameters(Entries &prm);

    /** Throws InputError for source "file" without a file, and for axes that are not three different ones. */
    void check() const;
  };

  /** One of our axes in the file: coordinate and sign. */
  struct FileAxis
  {
    unsigned int coordinate;
    double       sign;
  };

  /** The file's axes downstream, to the left bank and up, from "y -x z". Throws InputError if they are not
   * three different ones. */
  std::array<FileAxis, 3> file_axes(const std::string &text);

  /** A length unit (m, cm, mm, km, ft, in) [m]. */
  double metres(const std::string &unit);

  /** Generates or reads the mesh, turns it to x downstream, y to the left bank, z up, in metres, and checks
   *  it. The joints are left as they are: see open_joints() and close_joints().
   *  Throws InputError as MeshParameters::check(), read_gmsh() and check_mesh(). */
  HexMesh make_mesh(const MeshParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
