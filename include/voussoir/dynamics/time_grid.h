// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_time_grid_h
#define voussoir_time_grid_h

namespace Voussoir
{
  /** Time steps of a run: steps of the dam, and substeps of explicit rock in each of them. */
  struct TimeGrid
  {
    double       dt = 0.;      ///< time step of the dam [s]
    unsigned int substeps = 1; ///< rock steps per step of the dam
    unsigned int n = 0;        ///< number of steps of the dam

    double       duration() const { return n * dt; }         ///< duration of the run [s]
    double       substep() const { return dt / substeps; }   ///< time step of the rock [s]
    unsigned int n_substeps() const { return substeps * n; } ///< total number of rock steps
  };
} // namespace Voussoir

#endif
