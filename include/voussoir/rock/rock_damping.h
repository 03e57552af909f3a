// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_damping_h
#define voussoir_rock_damping_h

#include <voussoir/solid/damping.h>

#include <array>

namespace Voussoir
{
  /** Damping of the rock: Rayleigh damping C = mass M + stiffness K, and a quality factor that is about
   * constant in a band of frequencies. */
  struct RockDamping
  {
    double mass = 0., stiffness = 0.;  ///< [1/s], [s]
    double quality = 0.;               ///< quality factor of P and S waves [-]; 0: none
    double lowest = .5, highest = 10.; ///< band of the quality factor [Hz]

    static constexpr double least_quality = 10.;     ///< smallest quality factor that is accepted [-]
    static constexpr double error_of_quality = .013; ///< largest relative error in the band [-]

    /** Returns true if the rock has a quality factor. */
    bool has_quality() const { return quality > 0.; }
  };

  /** Returns the relaxation for the quality factor of the rock, elastic without it. The velocity of harmonic waves in the
   * middle of the band (on the logarithmic scale) is that of the given moduli. */
  Relaxation relaxation_of(const RockDamping &damping);

  /** Displacements x whose elastic forces are those of the damped rock, except for mass-proportional damping:
   * x = u + stiffness w without a quality factor, where w is the velocity half a step before u. With a
   * quality factor u is replaced as in Relaxation; the memory variables follow by the trapezoidal rule. */
  class DampedMotion
  {
  public:
    static constexpr unsigned int n = 3; ///< number of mechanisms

    DampedMotion() = default;
    /** Creates the state of rest of @p n_values displacements. */
    DampedMotion(const RockDamping &damping, double dt, std::size_t n_values);

    /** Advances the memory variables to the time of @p u [m], and computes @p x [m], of the values @p first
     * to @p last - 1. @p w: velocity half a step before [m/s]. */
    void advance(const double *u, const double *w, double *x, std::size_t first, std::size_t last);

    /** Returns the modulus at infinite frequency over the given modulus. */
    double unrelaxed_modulus() const { return unrelaxed; }

    /** Enables elastic(). */
    void keep_energy();

    /** Replaces the elastic forces @p f of the previous time by those of u without damping, multiplied by s.
     * Returns twice the energy of the mechanisms half a step before, a negative number [J]: with it, the strain
     * energy is that of the springs of the Maxwell body, and the rest is dissipated.
     * @p K_x: elastic forces of x [N]; @p u, @p w: as in advance(). @p n values from @p first; the arrays begin
     * there. */
    double elastic(const double *K_x, const double *u, const double *w, double *f, std::size_t first,
                   std::size_t n);

    /** Copies the memory variables of nodes of another motion. */
    void copy(const DampedMotion &other, const std::vector<unsigned int> &nodes);

    /** Returns the memory variables and their forces, for checkpoints. They are empty without a quality
     * factor. */
    std::vector<std::vector<double> *> state();

  private:
    double                dt = 0., stiffness = 0., unrelaxed = 1.;
    std::array<double, n> weight{}, kept{}, added{};  ///< xi(t + dt) = kept xi + added (u(t) + u(t + dt))
    std::array<std::vector<double>, n> memory, force; ///< xi_l [m], and s K xi_l [N]
  };

  /** Returns the critical time step of the explicit scheme with lagged damping [s]: w dt =
   * 2 (sqrt(1 + xi^2) - xi) with the Rayleigh damping ratio xi at the circular frequency w (Hughes and Liu 1978).
   * @p given: circular frequency with the given moduli [1/s]; w is larger by the square root of
   * Relaxation::unrelaxed. */
  double critical_time_step(double given, const RockDamping &damping);
} // namespace Voussoir

#endif
