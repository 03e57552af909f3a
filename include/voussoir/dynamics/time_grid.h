// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_time_grid_h
#define voussoir_time_grid_h

namespace Voussoir
{
  /** The steps of a run: those of the dam, and the smaller ones of explicit rock in each of them. */
  struct TimeGrid
  {
    double       dt = 0.;      ///< of the dam [s]
    unsigned int substeps = 1; ///< of the rock in one of the dam
    unsigned int n = 0;        ///< steps of the dam

    double       duration() const { return n * dt; }       ///< [s]
    double       substep() const { return dt / substeps; } ///< time step of the rock [s]
    unsigned int n_substeps() const { return substeps * n; }
  };
} // namespace Voussoir

#endif
