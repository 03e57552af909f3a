#ifndef voussoir_mesh_source_h
#define voussoir_mesh_source_h

#include <voussoir/arch210_rock.h>
#include <voussoir/mesh.h>

#include <string>

namespace Voussoir
{
  /** Where the mesh comes from: subsection "Mesh" of the scene. */
  struct MeshParameters
  {
    std::string           source = "arch210"; ///< "arch210" or "file"
    std::string           file = "";          ///< gmsh file, relative to the scene's directory
    std::string           axes = "x y z";     ///< the file's axes downstream, to the left bank, up
    std::string           length_unit = "m";  ///< of the file: "m", "mm" or "ft"
    Arch210Parameters     arch210;
    Arch210RockParameters arch210_rock;

    void add_parameters(dealii::ParameterHandler &prm);

    /** Throws InputError for source "file" without a file, and for axes that are not three different ones. */
    void check() const;
  };

  /** Generates or reads the mesh, turns it to x downstream, y to the left bank, z up, in metres, and checks
   *  it. The joints are left as they are: see open_joints() and close_joints().
   *  Throws InputError as MeshParameters::check(), read_gmsh() and check_mesh(). */
  HexMesh make_mesh(const MeshParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
