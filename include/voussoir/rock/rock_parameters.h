#ifndef voussoir_rock_parameters_h
#define voussoir_rock_parameters_h

#include <voussoir/solid/material.h>

#include <array>
#include <map>

namespace Voussoir
{
  /** How the rock is discretised. */
  struct RockParameters
  {
    std::map<int, Material> materials; ///< by volume id; cells of other volumes do not belong to the region

    /** Nodal (Gauss-Lobatto) quadrature of the stiffness in all cells, or in that many layers at the
     * artificial boundary, and 2x2x2 Gauss points elsewhere. Gauss points at a transmitting boundary are
     * unstable (Zhang, Liao and Xie 2015, Chin. J. Geophys. 58(10)). */
    bool         nodal_everywhere = false;
    unsigned int nodal_layers = 6;

    std::array<double, 3> centre = {
        {0., 0., 0.}}; ///< where the scattered waves come from: base of the dam [m]
  };
} // namespace Voussoir

#endif
