// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectral_matching_h
#define voussoir_spectral_matching_h

#include <vector>

namespace Voussoir
{
  /** What a record of acceleration is to satisfy. */
  struct SpectralTarget
  {
    std::vector<double> periods;             ///< [s]
    std::vector<double> pseudo_acceleration; ///< at these periods [m/s^2]
    double              damping;
    double              peak_acceleration; ///< [m/s^2]
  };

  /** Relative errors of a record's pseudo-acceleration: the largest and the mean of their magnitudes. At each
   *  period it is the greater of two, that of the true peak and that of the peak seen at the samples alone.
   */
  struct SpectralError
  {
    double maximum = 0.;
    double mean = 0.;
  };

  SpectralError spectral_error(const std::vector<double> &acceleration, double dt,
                               const SpectralTarget &target);

  /** Correct a record in the time domain until its spectrum matches.
   *
   *  The response of an oscillator at the time of its peak is linear in the record: a scalar product with the
   *  time-reversed impulse response (Lilhanand and Tseng 1988). Each pass finds the smallest change of
   *  the record, in the norm weighted by 1/envelope, that moves all these peaks onto the target while
   *  velocity and displacement end at zero and the largest sample is the peak acceleration. As peaks may
   *  change place, passes are repeated until the maximum error is below the tolerance or n_passes are done.
   *
   *  @param acceleration [m/s^2], changed only where the envelope is positive
   *  @param envelope     one value for each sample, not negative
   *  @return the best record met; its end velocity, end displacement and peak are exact to rounding. */
  std::vector<double> match_spectrum(std::vector<double> acceleration, double dt,
                                     const std::vector<double> &envelope, const SpectralTarget &target,
                                     double tolerance, unsigned int n_passes);
} // namespace Voussoir

#endif
