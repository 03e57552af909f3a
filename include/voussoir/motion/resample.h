// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_resample_h
#define voussoir_resample_h

#include <cstddef>
#include <vector>

namespace Voussoir
{
  /** Would resampling from steps of @p dt to steps of @p new_dt [s] lose what the record has above the new
   *  Nyquist frequency? Steps that differ by less than 0.1 % are the same: times are printed with few digits.
   */
  bool is_coarser(double new_dt, double dt);

  /** A record with the samples @p a at k @p dt, at the @p n times k @p new_dt [s].
   *
   *  To a finer or equal step: linear interpolation, as the time stepping assumes. To a coarser one a
   * low-pass filter comes first: a symmetric one, which delays nothing, with a sinc under Kaiser's window
   * (Oppenheim and Schafer, Discrete-Time Signal Processing, 7.6). Up to 0.8 of the new Nyquist frequency
   * 0.5/new_dt it changes amplitudes by less than 2e-4, above that frequency less than 2e-4 is left. At its
   * ends the record is continued by its reflection through the end point, so that a straight line stays what
   * it is. Times beyond the record have its last value. */
  std::vector<double> resample(const std::vector<double> &a, double dt, double new_dt, std::size_t n);
} // namespace Voussoir

#endif
