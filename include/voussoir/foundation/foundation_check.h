// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_check_h
#define voussoir_foundation_check_h

#include <voussoir/dynamics/time_grid.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  // Checks of explicit rock before the run: see doc/boundary.md.

  /** Throws InputError if the mesh has fewer layers of equal, straight elements than the artificial boundary
   * requires. @p source: name of the mesh in messages; @p generated_in: FoundationSite. */
  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source, const std::string &generated_in);

  /** Throws InputError if the quality factor is too small, or if it cannot be combined with the incident waves or
   * with the artificial boundary. */
  void check_damping(const RockRegionParameters &region);

  /** Returns the largest time step that the artificial boundaries of the rock and of the sections of the free
   * field accept [s]. */
  double largest_boundary_step(const FoundationParameters &parameters, const RockModel &model);

  /** Throws InputError if the time step of the rock exceeds the critical one or that of the boundary.
   *
   * @param parameters parameters of the input file
   * @param grid time steps of dam and rock
   * @param steps_per_sample time steps of the dam per sample of the ground motion
   * @param dt_critical critical time step of the rock [s]
   * @param dt_boundary largest_boundary_step() [s] */
  void check_rock_step(const FoundationParameters &parameters, const TimeGrid &grid,
                       unsigned int steps_per_sample, double dt_critical, double dt_boundary);

  /** Throws InputError if the artificial boundary would be unstable (ArtificialBoundary::check()) or is too
   * close to the base.
   *
   * @param parameters parameters of the input file
   * @param region region_parameters() for the run
   * @param model rock model
   * @param base_nodes numbers of the base nodes in the rock
   * @param dt_critical critical time step of the rock [s] */
  void check_boundary(const FoundationParameters &parameters, const RockRegionParameters &region,
                      const RockModel &model, const std::vector<unsigned int> &base_nodes,
                      double dt_critical);
} // namespace Voussoir

#endif
