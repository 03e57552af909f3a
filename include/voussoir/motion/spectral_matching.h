// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectral_matching_h
#define voussoir_spectral_matching_h

#include <vector>

namespace Voussoir
{
  /** Target of match_spectrum(): response spectrum and peak acceleration. */
  struct SpectralTarget
  {
    std::vector<double> periods;             ///< [s]
    std::vector<double> pseudo_acceleration; ///< at these periods [m/s^2]
    double              damping;             ///< damping ratio [-]
    double              peak_acceleration;   ///< of the record [m/s^2]
  };

  /** Relative error of the pseudo-acceleration of a record, over all periods of a target [-].
   *
   * The error at a period is the larger of two values: the excess of the peak over the target, and the
   * deficit of the peak at the samples only (Oscillator::Peak). */
  struct SpectralError
  {
    double maximum = 0.; ///< largest error
    double mean = 0.;    ///< mean error
  };

  /** Computes the error of a record. @p acceleration: samples [m/s^2]. @p dt: sampling interval [s]. */
  SpectralError spectral_error(const std::vector<double> &acceleration, double dt,
                               const SpectralTarget &target);

  /** Corrects a record in the time domain to match a response spectrum.
   *
   * The response of an oscillator at the time of its peak is linear in the record: a scalar product with the
   * time-reversed impulse response (Lilhanand and Tseng 1988). Each pass computes the smallest change of the
   * record, in the norm weighted by 1/envelope, under three conditions. All peaks reach the target, velocity
   * and displacement end at zero, and the largest sample is the peak acceleration. The change may shift the
   * times of the peaks. Therefore the passes are repeated.
   *
   * @param acceleration record [m/s^2], changed only where the envelope is positive
   * @param dt sampling interval [s]
   * @param envelope one value per sample [-], not negative
   * @param target spectrum and peak acceleration
   * @param tolerance maximum error at which the passes end [-]
   * @param n_passes largest number of passes
   * @return the record with the smallest maximum error. Its end velocity, end displacement and peak are exact
   * up to round-off. */
  std::vector<double> match_spectrum(std::vector<double> acceleration, double dt,
                                     const std::vector<double> &envelope, const SpectralTarget &target,
                                     double tolerance, unsigned int n_passes);
} // namespace Voussoir

#endif
