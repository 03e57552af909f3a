// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_parameters_h
#define voussoir_rock_parameters_h

#include <voussoir/rock/plane_wave.h>
#include <voussoir/rock/rock_damping.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace Voussoir
{
  class ArtificialBoundary;

  /** Discretisation of the rock. */
  struct RockParameters
  {
    std::map<int, Material> materials; ///< by volume id; cells of other volumes are not part of the region

    /** Nodal (Gauss-Lobatto) quadrature of the stiffness: true: in all cells; false: in nodal_layers layers
     * of cells at the artificial boundary, and 2x2x2 Gauss points elsewhere. Gauss points at a transmitting
     * boundary are unstable (Zhang, Liao and Xie 2015, Chin. J. Geophys. 58(10)). */
    bool         nodal_everywhere = false;
    unsigned int nodal_layers = 6;

    /** Number of layers of cells around the base of the dam that have the stiffness of the dam elements:
     * Gauss points and, if the dam has them, incompatible modes. Nodal quadrature is too stiff where
     * stresses vary from cell to cell. Cells in the layers at the artificial boundary are excluded. */
    unsigned int layers_at_dam = 0;
    bool         incompatible_modes = true; ///< incompatible modes in these layers, as in the dam

    bool plane_strain = false; ///< the region is a slice of cells without displacements along y

    std::array<double, 3> centre = {
        {0., 0., 0.}}; ///< source point of the scattered waves: base of the dam [m]
  };

  /** Parameters of the explicit rock in the input file. */
  struct RockRegionParameters
  {
    RockParameters rock;
    RockDamping    damping;
    double         dt = .001;         ///< time step of the rock [s]
    std::string    boundary = "mtf3"; ///< name of a row in boundary_table.cc

    /** Creates the artificial boundary in place of the row of the table, if it is set. */
    std::function<std::unique_ptr<ArtificialBoundary>()> boundary_maker;

    /** Free field: "columns" or "sections". columns: columns of layered ground with the local height of the
     * ground at the side faces. sections: slices of the mesh where the upstream and downstream faces
     * cut the valley. */
    std::string free_field = "sections";

    Incidence incidence; ///< directions of the incident waves, with delays by timed()

    /** Width of the zone around a section that carries the scattered motion only, relative to the height of
     * the section [-]. A wider zone changes the motion of the valley of arch210 by less than 1 %
     * (doc/boundary.md). */
    double width_of_zone = .75;
  };
} // namespace Voussoir

#endif
