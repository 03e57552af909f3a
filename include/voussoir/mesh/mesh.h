// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_h
#define voussoir_mesh_h

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Ids of physical groups: of surfaces, and of the first rock volume. See doc/mesh.md. A group without a
   * name has the meaning of its id; the name of a group has priority (physical_id()). */
  namespace PhysicalId
  {
    constexpr int base = 1, upstream = 2, downstream = 3, crest = 4, free_surface = 5, artificial = 6,
                  base_joint = 7, water_end = 8;              ///< water_end: upstream end of the water
    constexpr int joint_side_1 = 10000, joint_side_2 = 20000; ///< plus the number of the joint (1, 2, ...)
    constexpr int max_joints = 9999;                          ///< keeps the ids of the two sides disjoint
    constexpr int first_rock = 1000;                          ///< this and larger volume ids are rock

    constexpr int water = 0; ///< volume "water", which requires its name

    /** Lift l of monolith m, from the base, is the volume m + (l - 1) per_lift. */
    constexpr int per_lift = 10000000, max_lifts = 99;

    /** Joints 1 to 99 have these ids in files, for groups without names. */
    constexpr int side_1_in_files = 100, side_2_in_files = 200, max_in_files = 99;
  } // namespace PhysicalId

  /** Mesh of hexahedra with eight nodes, and the quadrilaterals of its named surfaces. The corners have the
   * order of gmsh, which is also that of VTK. */
  struct HexMesh
  {
    struct Cell
    {
      std::array<unsigned int, 8> nodes;
      int                         volume;   ///< physical id: monolith 1 to 999 and its lifts, rock from 1000
      unsigned int                zone = 0; ///< index into zones (material); 0: no zone
    };
    struct Face
    {
      std::array<unsigned int, 4> nodes;   ///< around the face, in either sense
      int                         surface; ///< physical id
    };
    std::vector<std::array<double, 3>>         nodes; ///< [m]; after read_gmsh() in the unit of the file
    std::vector<Cell>                          cells;
    std::vector<Face>                          faces;
    std::map<std::pair<int, int>, std::string> names;        ///< (dimension, physical id) -> physical name
    std::vector<std::string>                   zones = {""}; ///< names as by zone_name(); the first: no zone
    std::shared_ptr<const HexMesh> water;  ///< water volumes of the file, see split_water(); or null
    std::string                    remark; ///< of the generator of the mesh, for the log; or empty
  };

  /** Corners of the six faces of a hexahedron, counter-clockwise seen from outside. */
  constexpr unsigned int hex_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

  /** Returns the monolith of a block of concrete: a monolith, or one of its lifts. @p volume: physical id of the
   * block. */
  inline int monolith_of(const int volume)
  {
    return volume % PhysicalId::per_lift;
  }

  /** Returns the lift of a block of concrete, from 1 at the base. */
  inline int lift_of(const int volume)
  {
    return volume / PhysicalId::per_lift + 1;
  }

  /** Returns the physical id of the footing of a block, see with_footings(). */
  inline int footing_of(const int volume)
  {
    return volume + 100 * PhysicalId::per_lift;
  }

  /** Returns true if the physical id @p volume is that of a footing. */
  inline bool is_footing(const int volume)
  {
    return lift_of(volume) > PhysicalId::max_lifts;
  }

  /** Returns true if the physical id @p volume is that of a block of concrete, false for rock. */
  inline bool is_monolith(const int volume)
  {
    return monolith_of(volume) < PhysicalId::first_rock;
  }

  /** Returns true if the physical id @p surface is that of the base, bonded or as a joint. */
  inline bool is_base(const int surface)
  {
    return surface == PhysicalId::base || surface == PhysicalId::base_joint;
  }

  /** Returns true if the physical id @p surface is that of a side of a joint. */
  inline bool is_joint_side(const int surface)
  {
    return surface > PhysicalId::joint_side_1;
  }

  /** Returns the number of the joint of which the physical id @p surface is a side. */
  inline int number_of_joint(const int surface)
  {
    return surface > PhysicalId::joint_side_2 ? surface - PhysicalId::joint_side_2
                                              : surface - PhysicalId::joint_side_1;
  }

  /** Table of all cell faces. Finds the cells on the two sides of a face by the nodes of the face. */
  class FaceTable
  {
  public:
    struct Entry
    {
      std::array<unsigned int, 4> key;       ///< nodes of the face, ascending
      unsigned int                cell;      ///< index of the cell
      unsigned int                cell_face; ///< row of hex_faces
    };

    explicit FaceTable(const HexMesh &mesh);

    /** Returns the cells that have the face with these nodes, in any order of the nodes. One cell: the second
     * pointer is null. No cell: both pointers are null. */
    std::pair<const Entry *, const Entry *> owners(std::array<unsigned int, 4> nodes) const;

    /** Returns all faces of all cells, sorted by key. The two entries of an interior face are neighbours. */
    const std::vector<Entry> &entries() const { return table; }

  private:
    std::vector<Entry> table;
  };

  /** Returns the standard name of a physical group: "monolith 7", "monolith 7 lift 2", "rock 1000", "base", "joint 3
   * side 1", ... The lowest lift of a monolith has the name of the monolith.
   * @param dimension 3: volume, 2: surface
   * @param id physical id */
  std::string physical_name(int dimension, int id);

  /** Returns the id of a physical name, or -1 if the name is unknown.
   *
   * Case, blanks, '_' and '-' are ignored ("monolith7", "Free surface"). The words "minus" and "plus" mean
   * side 1 and side 2 of a joint. All names that begin with "rock" give PhysicalId::first_rock. A name with a
   * zone, as "monolith 3 heel" or "monolith 3 lift 2 heel", gives the id of the monolith or its lift. */
  int physical_id(int dimension, const std::string &name);

  /** Returns the zone in the name of a physical volume, in the form of zone_name(): "heel" for "Monolith_3
   * Heel", "weak layer" for "rock weak layer". Returns an empty string if the name has no zone, as "monolith
   * 3", "rock" or "rock 1000". */
  std::string zone_of(const std::string &volume_name);

  /** Returns the name of a zone in lower case, with single blanks between words and numbers: "weak layer 2"
   * for "Weak_layer2". */
  std::string zone_name(const std::string &text);

  /** Returns true if all characters of @p name are ASCII. Other characters are ignored by zone_name(). */
  bool is_plain(const std::string &name);

  /** Returns the index of @p zone, a result of zone_name(), in HexMesh::zones. Adds a missing zone. */
  unsigned int zone_index(HexMesh &mesh, const std::string &zone);

  /** Returns the mean position of the given nodes [m]: the centre of a face or a cell. */
  template <std::size_t n>
  std::array<double, 3> centre(const HexMesh &mesh, const std::array<unsigned int, n> &nodes)
  {
    std::array<double, 3> sum{};
    for (const unsigned int node : nodes)
      for (unsigned int d = 0; d < 3; ++d)
        sum[d] += mesh.nodes[node][d] / n;
    return sum;
  }

  /** Returns the text of a position for messages: "(1.5, -20, 210) m". */
  std::string place(const std::array<double, 3> &point);

  /** Removes the nodes that belong to no cell and no face. If all cells are mirrored, reorders the corners of
   * all cells: the file then has another convention or left-handed axes, which is not an error. */
  void normalize(HexMesh &mesh);

  /** Moves the cells of the volume "water" and the faces of the surface "water end" to HexMesh::water, with nodes of
   * their own. @p mesh: dam, rock and water; keeps dam and rock. */
  void split_water(HexMesh &mesh);

  /** Checks that the mesh can be used for an analysis.
   *
   * Throws InputError, with @p source (the file) at the beginning of the message, in these cases:
   *  - coordinates that are not finite, inverted or degenerate cells, or three cells at one face, also in the water;
   *  - volume ids below 1, or monoliths that are not numbered 1, 2, ...;
   *  - a surface face without a cell, inside the body (joints and base excepted), or in two surfaces;
   *  - two monoliths that lie face to face without common nodes and without a joint;
   *  - no base of the dam, or with rock no artificial boundary;
   *  - with rock: the surface 'base' is not exactly the set of faces between dam and rock. */
  void check_mesh(const HexMesh &mesh, const std::string &source);

  /** Returns the number of monoliths: the largest number of a monolith. */
  unsigned int n_monoliths(const HexMesh &mesh);

  /** Returns the smallest determinant of the Jacobian of the map from the unit cube to a cell, at the corners
   * and at the centre of the cell [m^3]. */
  double min_jacobian(const HexMesh &mesh, const HexMesh::Cell &cell);

  /** Measures of element quality, evaluated at the corners of the cells. They affect the accuracy and the
   * time step. */
  struct MeshQuality
  {
    double                shortest_edge, longest_edge; ///< [m]
    double                smallest_height;             ///< smallest distance of opposite faces of a cell [m]
    std::array<double, 3> smallest_height_at;          ///< centre of the cell with the smallest height [m]
    double                smallest_scaled_jacobian;    ///< [-]; 1: right angles, 0: flat cell

    /** Mean over the cells of the ratio of the smallest to the largest Jacobian [-]. It is 1 for
     * parallelepipeds. It is 2/27 for a tetrahedron of any shape that was split into four hexahedra. */
    double mean_jacobian_ratio;
  };

  /** Returns the quality of the rock cells (@p of_rock) or of the dam cells. The mesh must have at least one
   * such cell. */
  MeshQuality mesh_quality(const HexMesh &mesh, bool of_rock);

  /** Returns the volume of each physical volume [m^3], by its id. It is exact for trilinear cells. */
  std::map<int, double> volumes(const HexMesh &mesh);

  /** Returns the volume of all cells, rock included [m^3]. */
  double volume(const HexMesh &mesh);

  /** Returns the smallest and the largest coordinates of the nodes [m]. */
  std::pair<std::array<double, 3>, std::array<double, 3>> bounding_box(const HexMesh &mesh);

  /** Returns the length of the centre line of the crest [m]: the mean length of the upstream and the
   * downstream edge of the crest. Each edge is the set of element edges that the crest shares with the
   * upstream or the downstream face. The edge of a missing surface has zero length. */
  double crest_length(const HexMesh &mesh);
} // namespace Voussoir

#endif
