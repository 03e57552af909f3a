// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch_rock_h
#define voussoir_arch_rock_h

#include <voussoir/mesh/arch_grid.h>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  /** Parameters of the rock around an arch dam, subsections "Mesh/Arch210/Rock" and "Mesh/Arcs/Rock". The rock is a
   * block with a valley along x. The cross section of the valley is arch_valley(). */
  struct ArchRockParameters
  {
    bool   enabled = false;
    double upstream = 0,
           downstream =
               0; ///< distance of the boundary from the outermost base node [m]; 0: height of the dam
    double       sides = 0, depth = 0; ///< likewise; depth: below the base [m]
    double       element_size = 0;     ///< far from the dam [m]; 0: 22/210 of the height
    double       height = 0;           ///< of the dam [m]; set by complete()
    unsigned int n_layers = 6;         ///< layers of equal elements along the artificial boundary

    /** Declares the subsection "Rock" of the current subsection. Lengths of 0 are allowed if @p or_from_height. */
    void add_parameters(Entries &prm, bool or_from_height);

    /** Adds other sizes of the rock. @p section: as "Mesh/Arch210"; the heights are those of the dam. */
    void add_choices(const std::string &section, ModelChoices &choices) const;

    /** Throws InputError if a number is out of range. @p section: as "Mesh/Arch210", for messages; @p height:
     * height of the dam [m]. */
    void check(const std::string &section, double height) const;

    /** Returns the parameters with lengths instead of zeros, for a dam with the given height [m]. */
    ArchRockParameters complete(double height) const;
  };

  /** Adds the rock to the mesh of make_arch(): the volume PhysicalId::first_rock and the surfaces free_surface and
   * artificial.
   *
   * Dam and rock share the base nodes. The surface 'base' becomes the surface between dam and rock. The two
   * end walls of the dam are removed from it and are free. Nodes and cells of the dam keep their numbers.
   *
   * The grid of the dam continues into the rock: the columns to the sides, the layers upstream and
   * downstream, the rows down along vertical lines. In the layers at the artificial boundary the grid lines
   * are straight, normal to the boundary and have equal spacing, as a transmitting boundary requires. The
   * upstream and the downstream end of the block have the same cross section and the same grid. The ground at
   * the sides of the valley is horizontal, at the level of the base at the ends of the dam.
   *
   * @param shape dam
   * @param grid mesh of the dam
   * @param rock complete parameters
   * @param arch mesh of make_arch(shape, grid) */
  void add_arch_rock(const ArchShape &shape, const ArchGrid &grid, const ArchRockParameters &rock,
                     ArchMesh &arch);
} // namespace Voussoir

#endif
