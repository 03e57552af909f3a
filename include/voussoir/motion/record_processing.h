// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_record_processing_h
#define voussoir_record_processing_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/motion/spectral_matching.h>

namespace Voussoir
{
  /** Returns a record without its baseline: the polynomial of the smallest integral of the squared difference
   * from the record, both linear between the samples.
   *
   * The corrected record is orthogonal to constants and straight lines. Its velocity and displacement at the
   * end are therefore zero, since they are the integrals of a and of (T - t) a over the duration T. A permanent
   * displacement of the ground is lost. A straight line in the acceleration is removed exactly, from the
   * velocity a parabola. Least-squares line of the acceleration: first step of Chiu 1997 (Bulletin of the
   * Seismological Society of America 87); polynomials: Boore 2001 (91).
   *
   * With @p has_zero_ends the first and the last sample become zero, and the polynomial is not subtracted there.
   * Without acceleration before and after the record, velocity and displacement at the end are then zero, too.
   * @param a samples [m/s^2], at least degree + 2, with @p has_zero_ends degree + 4
   * @param degree 1: straight line; 2: parabola
   * @param has_zero_ends for a record with a rest, or another record, before or after it */
  std::vector<double> without_baseline(const std::vector<double> &a, unsigned int degree,
                                       bool has_zero_ends = false);

  /** Returns a record that matches a response spectrum.
   *
   * The record is multiplied by the factor for which its spectrum up to 3 s has the mean logarithm of the target. Then
   * match_spectrum() adds time-reversed impulse responses (Lilhanand and Tseng 1988; compare Al Atik and
   * Abrahamson 2010), in proportion to the envelope of the record: the root of its mean square over one
   * second, relative to the largest. Phases and the times of strong motion therefore stay close to those of
   * the record.
   * @param a record [m/s^2]
   * @param dt sampling interval [s]
   * @param target spectrum and peak acceleration
   * @param least_envelope smallest value of the envelope [-]
   * @param n_passes largest number of passes of match_spectrum() */
  std::vector<double> matched_record(const std::vector<double> &a, double dt, const SpectralTarget &target,
                                     double least_envelope, unsigned int n_passes);

  /** Corrects the components of a record as "Motion/Baseline" and "Motion/Match" require. "scale" multiplies all
   * components by the same factor f, which makes the misfit (TargetFit) smallest:
   *
   *      ln f = mean of ln(target_c(T) / S_c(T)) over c = x, y and the periods T of MotionParameters::band()
   *
   * with z instead if x and y are zero. Adds notes with the values before and after. Components that are zero stay zero. If the error of a matched component exceeds
   * MotionCriteria::maximum_error, it is matched again with other smallest values of the envelope, at most four
   * times in all, and the best result is used.
   * @param motion record [m/s^2]
   * @param parameters section "Motion"
   * @param factors later factors of the components, for the notes [-]
   * @param has_zero_ends see without_baseline()
   *
   * Throws InputError if the record is too short or too long to be matched. */
  void process_record(GroundMotion &motion, const MotionParameters &parameters,
                      const std::array<double, 3> &factors, bool has_zero_ends);
} // namespace Voussoir

#endif
