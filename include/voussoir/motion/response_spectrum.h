// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_response_spectrum_h
#define voussoir_response_spectrum_h

#include <array>
#include <cstddef>
#include <vector>

namespace Voussoir
{
  /** Linear oscillator under base acceleration a: u'' + 2 zeta w u' + w^2 u = -a, initially at rest.
   *
   * The acceleration is linear between the samples, and the solution is exact (Nigam and Jennings 1969).
   * Short periods have several substeps per sample, at least 20 per period, so that peaks between the samples
   * are included. */
  class Oscillator
  {
  public:
    /** @param period natural period [s], positive
     * @param damping damping ratio zeta in [0, 1) [-]
     * @param dt sampling interval of the acceleration [s], positive */
    Oscillator(double period, double damping, double dt);

    /** Largest response. */
    struct Peak
    {
      double      value = 0.;   ///< w^2 u of largest absolute value, with its sign [unit of a]
      std::size_t substep = 0;  ///< number of the substep at the end of which it occurs
      double      sampled = 0.; ///< largest absolute value at the samples only [unit of a]
    };

    /** Returns the largest response during the record. */
    Peak peak(const std::vector<double> &acceleration) const;

    /** Returns peak() for each of several oscillators. Four successive oscillators with the same number of
     * substeps are computed together, which takes a third of the time. */
    static std::vector<Peak> peaks(const std::vector<Oscillator> &oscillators,
                                   const std::vector<double>     &acceleration);

    /** Returns w^2 u at all substeps [unit of the acceleration]. */
    std::vector<double> response(const std::vector<double> &acceleration) const;

    /** Returns the derivatives of w^2 u at a substep with respect to the accelerations at @p n_samples
     * samples [-]: the time-reversed impulse response. The response w^2 u is the scalar product of the
     * derivatives and the record. */
    std::vector<double> sensitivity(std::size_t substep, std::size_t n_samples) const;

  private:
    static void find_four_peaks(const Oscillator *oscillator, const std::vector<double> &acceleration,
                                Peak *peak);

    std::size_t           n_substeps;    // per sample
    double                stiffness;     // w^2
    double                a[2][2];       // maps (u, v) to those of the next substep
    std::array<double, 2> start, finish; // factors of the accelerations at start and finish of a substep
  };

  /** Returns the pseudo-acceleration spectrum w^2 max |u| [unit of the acceleration] at @p periods [s].
   * @param acceleration samples
   * @param dt sampling interval [s]
   * @param periods natural periods [s]
   * @param damping damping ratio [-] */
  std::vector<double> pseudo_acceleration_spectrum(const std::vector<double> &acceleration, double dt,
                                                   const std::vector<double> &periods, double damping);

  /** Returns RotD50 and RotD100: the median and the maximum over the directions of a horizontal oscillator, in steps
   * of 1 degree, of its largest w^2 |u| [unit of the acceleration] (Boore 2010, Bulletin of the Seismological
   * Society of America 100).
   * @param x, y samples of the two horizontal components, at intervals of @p dt [s]
   * @param period natural period [s]
   * @param damping damping ratio [-] */
  std::array<double, 2> rotated_response(const std::vector<double> &x, const std::vector<double> &y,
                                         double dt, double period, double damping);

  /** Returns periods from @p first to @p last, both included [s]. Successive periods have a constant ratio,
   * with at least @p n_per_decade periods per decade. */
  std::vector<double> logarithmic_periods(double first, double last, unsigned int n_per_decade);
} // namespace Voussoir

#endif
