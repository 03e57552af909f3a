// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch210_rock_h
#define voussoir_arch210_rock_h

#include <voussoir/mesh/arch210.h>

namespace Voussoir
{
  class Entries;

  /** Parameters of the rock around arch210, subsection "Mesh/Arch210/Rock". The rock is a block with a valley
   * along x. The cross section of the valley is arch210_valley(). */
  struct Arch210RockParameters
  {
    bool   enabled = false;
    double upstream = 210, downstream = 210; ///< distance of the boundary from the outermost base node [m]
    double sides = 210, depth = 210;         ///< likewise; depth: below the base [m]
    double element_size = 22;                ///< far from the dam [m]
    unsigned int n_layers = 6;               ///< layers of equal elements along the artificial boundary

    void add_parameters(Entries &prm);

    /** Throws InputError if a number is out of range. */
    void check() const;
  };

  /** Adds the rock to the mesh of make_arch210(): the volume PhysicalId::first_rock and the surfaces
   * free_surface and artificial.
   *
   * Dam and rock share the base nodes. The surface 'base' becomes the surface between dam and rock. The two
   * end walls of the dam are removed from it and are free. Nodes and cells of the dam keep their numbers.
   *
   * The grid of the dam continues into the rock: the columns to the sides, the layers upstream and
   * downstream, the rows down along vertical lines. In the layers at the artificial boundary the grid lines
   * are straight, normal to the boundary and have equal spacing, as a transmitting boundary requires. The
   * upstream and the downstream end of the block have the same cross section and the same grid. The ground at
   * the sides of the valley is horizontal, at the level of the base at the ends of the dam. */
  void add_arch210_rock(const Arch210Parameters &dam, const Arch210RockParameters &rock, HexMesh &mesh);
} // namespace Voussoir

#endif
