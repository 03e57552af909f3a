#ifndef voussoir_mesh_h
#define voussoir_mesh_h

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Physical groups of a mesh without names (design/interfaces: mesh conventions). */
  namespace PhysicalId
  {
    constexpr int base = 1, upstream = 2, downstream = 3, crest = 4, free_surface = 5, artificial = 6;
    constexpr int joint_side_1 = 100, joint_side_2 = 200; ///< + joint number (1, 2, ...)
    constexpr int first_rock = 1000;                      ///< volume ids from here on are rock
  } // namespace PhysicalId

  /** Eight-node hexahedra and the quadrilaterals of named surfaces, in gmsh's (= VTK's) corner order. */
  struct HexMesh
  {
    struct Cell
    {
      std::array<unsigned int, 8> nodes;
      int                         volume; ///< physical id: monolith 1..999, rock from 1000
    };
    struct Face
    {
      std::array<unsigned int, 4> nodes;
      int                         surface; ///< physical id
    };
    std::vector<std::array<double, 3>>         nodes; ///< [m]
    std::vector<Cell>                          cells;
    std::vector<Face>                          faces;
    std::map<std::pair<int, int>, std::string> names; ///< (dimension, physical id) -> physical name
  };
} // namespace Voussoir

#endif
