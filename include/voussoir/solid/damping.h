// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_damping_h
#define voussoir_damping_h

#include <voussoir/base/tensor3.h>

#include <complex>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Generalised Maxwell body (Emmerich and Korn 1987, Geophysics 52, 1252-1264). All moduli have the same relaxation,
   * so the stress of a displacement u is that of the elastic body for the displacement
   *
   *     unrelaxed (u - sum_l Y_l xi_l),    d xi_l / dt = omega_l (u - xi_l),
   *
   * and the memory variables xi_l belong to nodes. */
  struct Relaxation
  {
    /** Smallest static modulus over the given one that scale_of() allows [-]. */
    static constexpr double least_static = .05;

    std::vector<double> frequency, weight; ///< omega_l [1/s] and Y_l [-] of each mechanism
    double              unrelaxed = 1.;    ///< modulus at infinite frequency over the given modulus [-]

    /** Elastic body. */
    Relaxation() = default;

    /** Fits the weights of @p n mechanisms to a quality factor by least squares, at 40 frequencies between @p lowest
     * and @p highest [Hz]. The mechanisms extend beyond this band by the factor @p beyond. */
    Relaxation(double quality, double lowest, double highest, unsigned int n, double beyond);

    /** Returns the body of @p n mechanisms whose free oscillations have the damping ratio @p ratio in the band, with
     * the smallest largest error that a choice of the mechanisms' frequencies gives. */
    static Relaxation of_ratio(double ratio, double lowest, double highest, unsigned int n);

    /** Returns the complex modulus at the complex circular frequency @p w [1/s], relative to the given modulus. */
    std::complex<double> modulus(std::complex<double> w) const;

    /** Returns the root lambda with positive imaginary part of lambda^2 + w^2 modulus(-i lambda) = 0: the free
     * oscillation exp(lambda t) of an oscillator that has the circular frequency @p w [1/s] with the given modulus. Its
     * damping ratio is -Re(lambda)/|lambda|. */
    std::complex<double> pole(double w) const;

    /** Returns the body whose modulus differs from the given one by @p scale times as much. */
    Relaxation scaled(double scale) const;

    /** Returns the scale of the body with the damping ratio @p ratio in the band, with errors of equal size of both
     * signs. Zero: the static modulus of such a body would be below #least_static. */
    double scale_of(double ratio, double lowest, double highest) const;

    /** Returns the smallest and the largest relative error of the damping ratio in a band [-]. */
    std::pair<double, double> error_of(double ratio, double lowest, double highest) const;
  };

  /** State of the relaxation: displacement [m], three values per node, and stiffness matrix times displacement [N]. It
   * is empty without relaxation. */
  struct DampingMemory
  {
    Unknowns              u_static, Ku_static; ///< static state, in which the body is relaxed
    std::vector<Unknowns> d, Kd;               ///< of each mechanism: u - xi in Relaxation
    Unknowns mean; ///< mean of w in Damping over the last time step, minus the mean of u at its ends [m]
    Unknowns lag;  ///< mean of w - u over the last time step of several steps h, with zones; or empty [m]
    Unknowns Ku;   ///< K_c u [N]; empty if all zones have the same ratio: K_c = K

    /** Returns K_c u. @p of_body: K u. */
    const Unknowns &damped(const Unknowns &of_body) const { return Ku.empty() ? of_body : Ku; }
  };

  /** Damping of the dam: Rayleigh damping C = mass M + stiffness K, and relaxation of the stiffness. The elastic force
   * of a displacement u after the static state u_s is K w with
   *
   *     w = u_s + modulus (u - u_s + sum_l c_l d_l),    d d_l / dt = du / dt - d_l / tau_l.
   *
   * The memory variables d_l follow by the rule of the time integration, so all works of a step are exact. With r =
   * dt/tau_l and the change U of u, d_l becomes ((1 - r/2) d_l + U)/(1 + r/2) by the trapezoidal rule, exp(-r) d_l +
   * (1 - exp(-r)) U/r by leapfrog. So does K d_l with that of K u. Without mechanisms (#c is empty), w = u.
   *
   * Zones with ratios of their own: the force is K u + K_c (w - u), where K_c (Body::damped) is the stiffness matrix of
   * cells multiplied by the scales of their zones. Then d has K_c d, and the memory K_c u. */
  struct Damping
  {
    struct Zone
    {
      std::string               name;         ///< empty: cells without zone
      double                    ratio, scale; ///< [-], Relaxation::scale_of()
      std::pair<double, double> error;        ///< Relaxation::error_of()
    };

    double              mass = 0., stiffness = 0.; ///< [1/s], [s]
    double              modulus = 1.;              ///< static modulus over the given one [-]
    std::vector<double> c, tau;                    ///< of each mechanism: [-], [s]
    std::vector<Zone>   zones;                     ///< of the dam, if they have entries
    Relaxation          law;

    Damping() = default;
    Damping(double mass, double stiffness) : mass(mass), stiffness(stiffness) {}
    explicit Damping(const Relaxation &relaxation);

    bool relaxes() const { return !c.empty(); }

    /** Returns the factor of K in the operator of a step of length @p dt [s] by the trapezoidal rule, minus that of the
     * elastic body, 1 [-]. */
    double more_stiffness(double dt) const;

    /** Returns the memory of the static state. @p damped: K_c u, or empty. */
    DampingMemory memory_of(const Unknowns &u, const Unknowns &Ku, const Unknowns &damped) const;

    /** Adds the forces of the relaxation to the known forces @p rhs of a step of length @p dt, without the term of K u
     * with more_stiffness(). @p Ku: at the start of the step [N]. */
    void add_known_forces(double dt, const DampingMemory &memory, const Unknowns &Ku, Unknowns &rhs) const;

    /** Advances the memory by a step of length @p dt [s] from @p u_old and @p Ku_old to @p u and @p Ku. Returns the
     * energy that the mechanisms dissipate [J]. @p damped: K_c u at the end, or empty. */
    double advance(double dt, const Unknowns &u_old, const Unknowns &Ku_old, const Unknowns &u,
                   const Unknowns &Ku, DampingMemory &memory, Unknowns damped) const;

    struct Energies ///< [J]
    {
      double stored, dissipated;
    };

    /** Advances the memory by a step of the leapfrog rule, exactly for a constant velocity. Returns the energy that the
     * body stores in the middle of the step, minus u_old K u / 2, and what it dissipates in the step. The rule needs
     * the factor sqrt(modulus (1 + sum c)) for its critical step. */
    Energies advance_leapfrog(double dt, const Unknowns &u_old, const Unknowns &Ku_old, const Unknowns &u,
                              const Unknowns &Ku, DampingMemory &memory, Unknowns damped) const;

    /** Returns the energy stored by the relaxing body minus u K u / 2 [J], zero in the static state. */
    double more_energy(const DampingMemory &memory, const Unknowns &u, const Unknowns &Ku) const;

    /** Sets @p w [m] and @p Kw [N] to the components from @p begin to @p end, without the last one, of w and of the
     * elastic force. */
    void relaxed(const DampingMemory &memory, const Unknowns &u, const Unknowns &Ku, std::size_t begin,
                 std::size_t end, double *w, double *Kw) const;

    /** Returns component @p k of the elastic force minus K u [N]. */
    double more_force(const DampingMemory &memory, const Unknowns &Ku, std::size_t k) const;

    /** Returns the damping ratio of a mode of the circular frequency @p w [1/s] and the factor by which relaxation
     * changes this frequency. @p scale: mean of the zones, weighted by strain energy; NaturalMode::scale(). */
    std::pair<double, double> of_mode(double w, double scale = 1.) const;
  };
} // namespace Voussoir

#endif
