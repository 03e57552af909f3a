// SPDX-License-Identifier: GPL-3.0-or-later
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
    constexpr int max_joints = 99;                        ///< so that the two sides' ids do not meet
    constexpr int first_rock = 1000;                      ///< volume ids from here on are rock
  }                                                       // namespace PhysicalId

  /** Eight-node hexahedra and the quadrilaterals of named surfaces, in gmsh's (= VTK's) corner order. */
  struct HexMesh
  {
    struct Cell
    {
      std::array<unsigned int, 8> nodes;
      int                         volume;   ///< physical id: monolith 1..999, rock from 1000
      unsigned int                zone = 0; ///< index into zones: which concrete or rock; 0 = none
    };
    struct Face
    {
      std::array<unsigned int, 4> nodes;   ///< around the face, in either sense
      int                         surface; ///< physical id
    };
    std::vector<std::array<double, 3>>         nodes; ///< [m]
    std::vector<Cell>                          cells;
    std::vector<Face>                          faces;
    std::map<std::pair<int, int>, std::string> names;        ///< (dimension, physical id) -> physical name
    std::vector<std::string>                   zones = {""}; ///< zone_name()s; the first is no zone
  };

  /** Corners of the six faces of a hexahedron, counter-clockwise seen from outside. */
  constexpr unsigned int hex_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

  inline bool is_monolith(const int volume)
  {
    return volume < PhysicalId::first_rock;
  }
  inline bool is_joint_side(const int surface)
  {
    return surface > PhysicalId::joint_side_1;
  }

  /** Finds the cells on the two sides of a face, by the face's nodes. */
  class FaceTable
  {
  public:
    struct Entry
    {
      std::array<unsigned int, 4> key;       ///< the face's nodes, ascending
      unsigned int                cell;      ///< owner
      unsigned int                cell_face; ///< row of hex_faces
    };

    explicit FaceTable(const HexMesh &mesh);

    /** The (none, one, two) owners of the face with these nodes, in any order. */
    std::pair<const Entry *, const Entry *> owners(std::array<unsigned int, 4> nodes) const;

    /** All faces of all cells, sorted by key: the two entries of an interior face are neighbours. */
    const std::vector<Entry> &entries() const { return table; }

  private:
    std::vector<Entry> table;
  };

  /** The name of a physical group by its id: "monolith 7", "rock 1000", "base", "joint 3 side 1", ... */
  std::string physical_name(int dimension, int id);

  /** The id that a physical name stands for, -1 if the name is none of ours. Case, spaces, '_' and '-' do
   *  not count ("monolith7", "Free surface"); "minus" and "plus" stand for side 1 and side 2 of a joint.
   *  All names that begin with "rock" give PhysicalId::first_rock; "monolith 3 heel" is monolith 3. */
  int physical_id(int dimension, const std::string &name);

  /** The zone that a name of a physical volume says, as zone_name(): "heel" of "Monolith_3 Heel", "weak
   *  layer" of "rock weak layer"; empty if it says none, as "monolith 3", "rock" or "rock 1000" (its id). */
  std::string zone_of(const std::string &volume_name);

  /** A zone's name without what does not count in it: "Weak_layer2" is "weak layer 2". */
  std::string zone_name(const std::string &text);

  /** Has a name characters of ASCII only? Others would not count in zone_name(). */
  bool is_plain(const std::string &name);

  /** Index of a zone_name() in HexMesh::zones, where it is added if it is not there. */
  unsigned int zone_index(HexMesh &mesh, const std::string &zone);

  /** Mean of the places of some nodes [m]: the centre of a face or a cell. */
  template <std::size_t n>
  std::array<double, 3> centre(const HexMesh &mesh, const std::array<unsigned int, n> &nodes)
  {
    std::array<double, 3> sum{};
    for (const unsigned int node : nodes)
      for (unsigned int d = 0; d < 3; ++d)
        sum[d] += mesh.nodes[node][d] / n;
    return sum;
  }

  /** A point for messages: "(1.5, -20, 210) m". */
  std::string place(const std::array<double, 3> &point);

  /** Drops the nodes that belong to no cell, and reorders the corners of all cells if every single one is
   *  mirrored (which is a matter of the file's conventions or axes, not an error). */
  void normalize(HexMesh &mesh);

  /** Throws InputError, beginning with @p source (the file), if the mesh cannot be computed with: nodes that
   *  are not finite, inverted or degenerate cells, monoliths not numbered 1, 2, ..., faces of no cell, inside
   *  the dam or in two surfaces, monoliths that lie face to face unconnected, or nothing that fixes the dam.
   *  With rock, 'base' must be all faces between dam and rock, and nothing else. */
  void check_mesh(const HexMesh &mesh, const std::string &source);

  /** Number of monoliths (the largest volume id below PhysicalId::first_rock). */
  unsigned int n_monoliths(const HexMesh &mesh);

  /** Smallest determinant of the Jacobian of a cell's map from the unit cube, over its corners and its
   *  centre [m^3]. */
  double min_jacobian(const HexMesh &mesh, const HexMesh::Cell &cell);

  /** What a set of hexahedra does to accuracy and to the time step. All are taken at the cells' corners. */
  struct MeshQuality
  {
    double                shortest_edge, longest_edge; ///< [m]
    double                smallest_height;             ///< [m], between opposite faces
    std::array<double, 3> smallest_height_at;          ///< centre of that cell
    double                smallest_scaled_jacobian;    ///< 1 for right angles, 0 for flat cells

    /** Mean over the cells of the smallest over the largest Jacobian: 1 for parallelepipeds, 2/27 where a
     * tetrahedron, of whatever shape, was split into four hexahedra [-]. */
    double mean_jacobian_ratio;
  };

  /** Of the rock or of the dam, which must have cells. */
  MeshQuality mesh_quality(const HexMesh &mesh, bool of_rock);

  /** Volume of each physical volume [m^3], exact for the trilinear cells. */
  std::map<int, double> volumes(const HexMesh &mesh);

  /** Volume of all cells together, rock included [m^3]. */
  double volume(const HexMesh &mesh);

  /** The smallest and the largest coordinates [m]. */
  std::pair<std::array<double, 3>, std::array<double, 3>> bounding_box(const HexMesh &mesh);

  /** Length of the crest's centre line [m]: the mean of the lengths of the edges that the crest shares with
   *  the upstream and with the downstream face; zero if a surface is missing. */
  double crest_length(const HexMesh &mesh);
} // namespace Voussoir

#endif
