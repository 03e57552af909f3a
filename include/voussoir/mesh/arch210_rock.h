// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch210_rock_h
#define voussoir_arch210_rock_h

#include <voussoir/mesh/arch210.h>

namespace Voussoir
{
  class Entries;

  /** The rock around arch210: a block with a valley along x, whose section is the profile of the dam's foot.
   *  Subsection "Mesh/Arch210/Rock". */
  struct Arch210RockParameters
  {
    bool         enabled = false;
    double       upstream = 210, downstream = 210; ///< [m] from the dam's outermost foot
    double       sides = 210, depth = 210;         ///< [m] likewise
    double       element_size = 22;                ///< [m], far from the dam
    unsigned int n_layers = 6;                     ///< of equal elements along the artificial boundary

    void add_parameters(Entries &prm);

    /** Throws InputError if a number is out of range. */
    void check() const;
  };

  /** Adds the rock to the mesh of make_arch210(): volume PhysicalId::first_rock, surfaces free_surface and
   *  artificial. The foot is shared, and 'base' is then the surface between dam and rock; the dam's two end
   *  walls leave it and are free. Nodes and cells of the dam keep their numbers.
   *
   *  The rock's grid is the dam's, prolonged: columns to the sides, layers up- and downstream, and rows down
   *  along vertical lines. In the layers at the artificial boundary all grid lines are straight, equidistant
   *  and normal to it: the boundary can be a transmitting one. The valley's section and its grid are the same
   *  at the up- and the downstream end; the ground beside the valley is level with the foot of the dam's
   * ends.
   */
  void add_arch210_rock(const Arch210Parameters &dam, const Arch210RockParameters &rock, HexMesh &mesh);
} // namespace Voussoir

#endif
