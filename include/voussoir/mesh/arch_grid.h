// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch_grid_h
#define voussoir_arch_grid_h

#include <voussoir/mesh/arch_shape.h>
#include <voussoir/mesh/mesh.h>

#include <string>
#include <vector>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  /** Mesh of an arch dam: joints, numbers of elements, and the dam's lowest parts. */
  struct ArchGrid
  {
    unsigned int        n_joints = 28; ///< contraction joints; the dam has n_joints + 1 monoliths
    std::vector<double> joint_places;  ///< chainages [m], see make_arch(); empty: equal distances
    unsigned int elements_along = 58;  ///< in total along the crest; each monolith has at least its share
    unsigned int elements_up = 20;     ///< from the base to the crest, in the highest column
    unsigned int elements_through = 2; ///< from the upstream to the downstream face
    std::vector<double> rows;          ///< ends of the rows of elements, see make_arch(); empty: equal
    bool                equal_rows = false;  ///< all columns have elements_up rows, see make_arch()
    double              end_wall_height = 0; ///< depth of the abutment below the two ends of the crest [m]
    bool                base_joint = false;  ///< the base is a joint
    unsigned int        lift_joints = 0;     ///< in each monolith, between rows of elements
    double smallest_height = 5; ///< [m]; where the abutment is higher, the dam is embedded in the bank

    /** Declares the entries of the current subsection that all dams have. */
    void add_parameters(Entries &prm);

    /** Adds coarser and finer meshes. @p section: subsection of the entries, as "Mesh/Arcs". */
    void add_choices(const std::string &section, ModelChoices &choices) const;

    /** Returns the number of monoliths. */
    unsigned int n_monoliths() const { return n_joints + 1; }
  };

  /** Throws InputError if the numbers do not fit the dam. @p section: the subsection of the entries, for
   * messages, as "Mesh/Arch210". */
  void check_grid(const ArchShape &shape, const ArchGrid &grid, const std::string &section);

  /** Mesh of an arch dam. */
  struct ArchMesh
  {
    HexMesh mesh; ///< its remark: why rows are equal though grid.equal_rows is false
    std::vector<unsigned int>
        base; ///< upstream base node of each column, followed by those of the other layers
  };

  /** Returns a conforming mesh of an arch dam.
   *
   * Axes: x downstream, y to the left bank, z up. The monoliths 1 to n_joints + 1 are numbered from the right
   * bank to the left. The surface 'base' includes the two end walls. The other surfaces are 'upstream',
   * 'downstream' and 'crest'.
   *
   * The joints are vertical planes normal to the centre line of the crest. They divide the crest into equal
   * parts, or lie at the chainages grid.joint_places: lengths of the centre line from the right end of the crest.
   * The other columns of nodes lie in such planes too. The rows of nodes are those of rows_from_crest(). With
   * grid.equal_rows, lift joints, grid.rows or a scaled Jacobian below .1, all columns have elements_up rows, with equal
   * spacing or the ends grid.rows: shares of the height between 0 and 1.
   *
   * Throws InputError if the valley does not open upwards, or if the faces of an arc meet. */
  ArchMesh make_arch(const ArchShape &shape, const ArchGrid &grid);

  /** Returns the cross section of the valley: (y, z) of the lowest point of the dam's centre surface at each
   * column of nodes [m], from the right bank to the left. */
  std::vector<std::array<double, 2>> arch_valley(const ArchShape &shape, const ArchGrid &grid);
} // namespace Voussoir

#endif
