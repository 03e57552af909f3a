// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_resample_h
#define voussoir_resample_h

#include <cstddef>
#include <vector>

namespace Voussoir
{
  /** Returns true if resampling from the step @p dt to @p new_dt [s] requires a low-pass filter. Steps that
   * differ by less than 0.1 % are regarded as equal, because files give times with few digits. */
  bool is_coarser(double new_dt, double dt);

  /** Returns a record at other times.
   *
   * For a finer or equal step the record is interpolated linearly, as the time integration assumes. For a
   * coarser step it is filtered first. The low-pass filter is symmetric, without phase shift: a sinc function
   * with the window of Kaiser (Oppenheim and Schafer, Discrete-Time Signal Processing, 7.6). The Nyquist
   * frequency of the new step is 0.5 / new_dt. Up to 0.8 of this frequency, amplitudes change by less than
   * 2e-4. Above the Nyquist frequency they are reduced to less than 2e-4. For the filter, the record is
   * continued beyond its ends by point reflection, which leaves a straight line unchanged.
   *
   * @param a samples at the times k @p dt
   * @param dt step of the samples [s]
   * @param new_dt step of the result [s]
   * @param n number of values in the result. Times beyond the record have its last value.
   * @param begin time of the first value of the result [s] */
  std::vector<double> resample(const std::vector<double> &a, double dt, double new_dt, std::size_t n,
                               double begin = 0.);
} // namespace Voussoir

#endif
