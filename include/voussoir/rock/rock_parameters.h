// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_parameters_h
#define voussoir_rock_parameters_h

#include <voussoir/solid/material.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace Voussoir
{
  class ArtificialBoundary;

  /** How the rock is discretised. */
  struct RockParameters
  {
    std::map<int, Material> materials; ///< by volume id; cells of other volumes do not belong to the region

    /** Nodal (Gauss-Lobatto) quadrature of the stiffness in all cells, or in that many layers at the
     * artificial boundary, and 2x2x2 Gauss points elsewhere. Gauss points at a transmitting boundary are
     * unstable (Zhang, Liao and Xie 2015, Chin. J. Geophys. 58(10)). */
    bool         nodal_everywhere = false;
    unsigned int nodal_layers = 6;

    /** Of that many layers of cells about the base of a dam the stiffness is that of the dam's elements:
     * Gauss points and, if they have them, incompatible modes. Nodal quadrature is too stiff where stresses
     * change from cell to cell. Not in the layers at the artificial boundary. */
    unsigned int layers_at_dam = 0;
    bool         incompatible_modes = true; ///< those of the dam's elements, so of these layers, too

    std::array<double, 3> centre = {
        {0., 0., 0.}}; ///< where the scattered waves come from: base of the dam [m]
  };

  /** What a scene says of the rock. */
  struct RockRegionParameters
  {
    RockParameters  rock;
    RayleighDamping damping;
    double          dt = .001;         ///< [s]
    std::string     boundary = "mtf3"; ///< name of a row of boundary_table.cc

    /** Makes the boundary instead of the row with that name, if given. */
    std::function<std::unique_ptr<ArtificialBoundary>()> boundary_maker;

    /** Motion without dam: "columns" (layers, with the ground's local height at the side faces), or
     * "sections" (slices of the mesh where the upstream and downstream faces cut the valley). */
    std::string free_field = "sections";
  };
} // namespace Voussoir

#endif
