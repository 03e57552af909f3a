// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_response_spectrum_h
#define voussoir_response_spectrum_h

#include <array>
#include <cstddef>
#include <vector>

namespace Voussoir
{
  /** A linear oscillator under base acceleration a, u'' + 2 zeta w u' + w^2 u = -a, at rest at first.
   *  Between samples a is linear and the solution exact (Nigam and Jennings 1969). Short periods take
   *  several substeps per sample, at least 20 per period, so that no peak is missed between samples. */
  class Oscillator
  {
  public:
    /** period [s] and sampling interval dt [s] positive, damping ratio zeta in [0, 1). */
    Oscillator(double period, double damping, double dt);

    struct Peak
    {
      double      value = 0.;   ///< w^2 u, signed, where its magnitude is largest [unit of a]
      std::size_t substep = 0;  ///< when
      double      sampled = 0.; ///< the largest magnitude seen at the samples alone
    };

    /** The largest response while the record lasts. */
    Peak peak(const std::vector<double> &acceleration) const;

    /** Of several: four that have the same substeps move together, which takes a third of the time. */
    static std::vector<Peak> peaks(const std::vector<Oscillator> &oscillators,
                                   const std::vector<double>     &acceleration);

    /** The derivatives of w^2 u at a substep with respect to each of n_samples accelerations (the response
     *  is their scalar product with the record): the time-reversed impulse response. */
    std::vector<double> sensitivity(std::size_t substep, std::size_t n_samples) const;

  private:
    template <unsigned int n>
    static void find_peaks(const Oscillator *oscillator, const std::vector<double> &acceleration, Peak *peak);

    std::size_t           n_substeps;    // per sample
    double                stiffness;     // w^2
    double                a[2][2];       // (u, v) of the next substep from (u, v),
    std::array<double, 2> start, finish; // and from the accelerations at its start and its finish
  };

  /** Pseudo-acceleration spectrum w^2 max |u| [unit of the acceleration] at the given periods [s]. */
  std::vector<double> pseudo_acceleration_spectrum(const std::vector<double> &acceleration, double dt,
                                                   const std::vector<double> &periods, double damping);

  /** Periods [s] from first to last, both included, at equal ratios, at least so many in a decade. */
  std::vector<double> logarithmic_periods(double first, double last, unsigned int n_per_decade);
} // namespace Voussoir

#endif
