// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/solid/damping.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns the product of a - a_rest and b - b_rest. */
    double product_of_changes(const double *a, const double *a_rest, const double *b, const double *b_rest,
                              const std::size_t n)
    {
      double sum = 0.;
#pragma omp simd reduction(+ : sum)
      for (std::size_t k = 0; k < n; ++k)
        sum += (a[k] - a_rest[k]) * (b[k] - b_rest[k]);
      return sum;
    }

    /** Values of a range of components, before and after a step: u, K u and the memory variable d with K d. */
    struct MechanismStep
    {
      const double *u_old, *Ku_old, *u, *Ku;
      double       *d, *Kd;
    };

    /** Advances a mechanism. @p r: step over relaxation time [-], @p share: half of its part of the modulus [-]. Adds the
     * stored and the dissipated energy to @p sums [J]. */
    void advance_mechanism(const double r, const double share, const MechanismStep &step, const std::size_t n,
                           std::array<double, 2> &sums)
    {
      const double kept = std::exp(-r), added = -std::expm1(-r) / r;
      double       stored = 0., dissipated = 0.;
#pragma omp simd reduction(+ : stored, dissipated)
      for (std::size_t k = 0; k < n; ++k)
      {
        const double d_old = step.d[k], Kd_old = step.Kd[k];
        const double d = kept * d_old + added * (step.u[k] - step.u_old[k]),
                     Kd = kept * Kd_old + added * (step.Ku[k] - step.Ku_old[k]);
        const double lost = share * r * d * (Kd + Kd_old);
        dissipated += lost;
        stored += share / added * d_old * Kd - lost;
        step.d[k] = d;
        step.Kd[k] = Kd;
      }
      sums[0] += stored;
      sums[1] += dissipated;
    }

    constexpr double       two_pi = 6.283185307179586;
    constexpr unsigned int n_points = 40; ///< frequencies of a fit

    using Rows = std::vector<std::vector<double>>;

    /** Returns the circular frequency at a @p share of the way from a to b on a logarithmic scale. @p a, @p b [Hz]. */
    double between(const double a, const double b, const double share)
    {
      return two_pi * a * std::pow(b / a, share);
    }

    /** Solves normal equations, which are symmetric and positive definite. The last column is the right-hand side. */
    std::vector<double> solved(Rows a)
    {
      const unsigned int n = a.size();
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int i = 0; i < n; ++i)
          if (i != k)
          {
            const double factor = a[i][k] / a[k][k];
            for (unsigned int j = k; j <= n; ++j)
              a[i][j] -= factor * a[k][j];
          }
      std::vector<double> result(n);
      for (unsigned int k = 0; k < n; ++k)
        result[k] = a[k][n] / a[k][k];
      return result;
    }

    double ratio_of(const std::complex<double> pole)
    {
      return -pole.real() / std::abs(pole);
    }

    /** Factors of a mechanism in a step: d_new = kept d + added (u_new - u). */
    struct StepOfMechanism
    {
      double half, kept, added;
      StepOfMechanism(const double dt, const double tau)
          : half(.5 * dt / tau), kept((1. - half) / (1. + half)), added(1. / (1. + half))
      {
      }
    };
  } // namespace

  Relaxation::Relaxation(const double quality, const double lowest, const double highest,
                         const unsigned int n, const double beyond)
      : frequency(n)
  {
    for (unsigned int l = 0; l < n; ++l)
      frequency[l] = between(lowest / beyond, beyond * highest, n > 1 ? double(l) / (n - 1) : .5);
    // Im(modulus) = Re(modulus)/quality is linear in the weights.
    Rows normal(n, std::vector<double>(n + 1, 0.));
    for (unsigned int k = 0; k < n_points; ++k)
    {
      const double        w = between(lowest, highest, double(k) / (n_points - 1));
      std::vector<double> row(n + 1, 1.);
      for (unsigned int l = 0; l < n; ++l)
        row[l] = frequency[l] * (quality * w + frequency[l]) / (frequency[l] * frequency[l] + w * w);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= n; ++j)
          normal[i][j] += row[i] * row[j];
    }
    weight = solved(normal);
  }

  Relaxation Relaxation::of_ratio(const double ratio, const double lowest, const double highest,
                                  const unsigned int n)
  {
    constexpr unsigned int n_trials = 40;
    Relaxation             best;
    double                 least = 1e300;
    for (unsigned int trial = 0; trial < n_trials; ++trial)
    {
      const double beyond = between(.5, 4., double(trial) / (n_trials - 1)) / two_pi;
      double       wanted = ratio; // of forced oscillations: free ones are damped a little more
      for (unsigned int pass = 0; pass < 4; ++pass)
      {
        const Relaxation law(.5 / wanted, lowest, highest, n, beyond);
        if (*std::min_element(law.weight.begin(), law.weight.end()) <= 0.)
          break;
        const auto   error = law.error_of(ratio, lowest, highest);
        const double largest = std::max(-error.first, error.second);
        if (largest < least)
        {
          least = largest;
          best = law;
        }
        wanted /= 1. + .5 * (error.first + error.second);
      }
    }
    return best;
  }

  std::complex<double> Relaxation::modulus(const std::complex<double> w) const
  {
    std::complex<double> result = 1.;
    for (std::size_t l = 0; l < weight.size(); ++l)
      result -= weight[l] * frequency[l] / (frequency[l] + std::complex<double>(0., 1.) * w);
    return unrelaxed * result;
  }

  Relaxation Relaxation::scaled(const double scale) const
  {
    Relaxation result = *this;
    result.unrelaxed = 1. - scale + scale * unrelaxed;
    for (double &y : result.weight)
      y *= scale * unrelaxed / result.unrelaxed;
    return result;
  }

  double Relaxation::scale_of(const double ratio, const double lowest, const double highest) const
  {
    const auto error = [&](const double scale) // of the mean
    {
      const auto ends = scaled(scale).error_of(ratio, lowest, highest);
      return ends.first + ends.second;
    };
    double     low = 0., high = 1.;
    const auto at_rest = [&](const double scale) { return scaled(scale).modulus(0.).real(); };
    while (error(high) < 0. && at_rest(1.2 * high) > least_static)
    {
      low = high;
      high *= 1.2;
    }
    if (error(high) < 0.)
      return 0.;
    for (unsigned int pass = 0; pass < 40; ++pass)
      (error(.5 * (low + high)) < 0. ? low : high) = .5 * (low + high);
    return .5 * (low + high);
  }

  std::complex<double> Relaxation::pole(const double w) const
  {
    const std::complex<double> i(0., 1.);
    std::complex<double>       lambda = i * w;
    for (unsigned int k = 0; k < 60; ++k)
      lambda = i * w * std::sqrt(modulus(-i * lambda));
    return lambda;
  }

  std::pair<double, double> Relaxation::error_of(const double ratio, const double lowest,
                                                 const double highest) const
  {
    std::pair<double, double> result(1e300, -1e300);
    for (unsigned int k = 0; k < 2 * n_points; ++k)
    {
      const double error = ratio_of(pole(between(lowest, highest, k / (2. * n_points - 1.)))) / ratio - 1.;
      result = {std::min(result.first, error), std::max(result.second, error)};
    }
    return result;
  }

  Damping::Damping(const Relaxation &relaxation) : law(relaxation)
  {
    modulus = law.unrelaxed;
    for (const double y : law.weight)
      modulus -= law.unrelaxed * y;
    for (std::size_t l = 0; l < law.weight.size(); ++l)
    {
      c.push_back(law.unrelaxed * law.weight[l] / modulus);
      tau.push_back(1. / law.frequency[l]);
    }
  }

  double Damping::more_stiffness(const double dt) const
  {
    double factor = modulus;
    for (std::size_t l = 0; l < c.size(); ++l)
      factor += modulus * c[l] * StepOfMechanism(dt, tau[l]).added;
    return 2. / dt * stiffness + (factor - 1.);
  }

  DampingMemory Damping::memory_of(const Unknowns &u, const Unknowns &Ku, const Unknowns &damped) const
  {
    const std::vector<Unknowns> zeros(c.size(), Unknowns(u.size(), 0.));
    return relaxes() ? DampingMemory{u, damped.empty() ? Ku : damped, zeros, zeros, zeros[0], {}, damped}
                     : DampingMemory();
  }

  void Damping::add_known_forces(const double dt, const DampingMemory &memory, const Unknowns &Ku,
                                 Unknowns &rhs) const
  {
    const int       n = relaxes() ? rhs.size() : 0;
    const Unknowns &damped = memory.damped(Ku);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < n; ++k)
      rhs[k] += 2. * (1. - modulus) * (damped[k] - memory.Ku_static[k]);
    for (std::size_t l = 0; l < c.size(); ++l)
    {
      const double factor = modulus * c[l] * (1. + StepOfMechanism(dt, tau[l]).kept);
#pragma omp parallel for schedule(static)
      for (int k = 0; k < n; ++k)
        rhs[k] -= factor * memory.Kd[l][k];
    }
  }

  double Damping::advance(const double dt, const Unknowns &u_old, const Unknowns &Ku_old, const Unknowns &u,
                          const Unknowns &Ku, DampingMemory &memory, Unknowns damped) const
  {
    if (!relaxes())
      return 0.;
    const Unknowns &before = memory.damped(Ku_old), &after = damped.empty() ? Ku : damped;
    const auto      advance_values = [&](const std::size_t begin, const std::size_t end)
    {
      double dissipated = 0.;
      for (std::size_t k = begin; k < end; ++k)
        memory.mean[k] = (modulus - 1.) * (.5 * (u_old[k] + u[k]) - memory.u_static[k]);
      for (std::size_t l = 0; l < c.size(); ++l)
      {
        const StepOfMechanism s(dt, tau[l]);
        const double          share = modulus * c[l];
        for (std::size_t k = begin; k < end; ++k)
        {
          const double d = s.kept * memory.d[l][k] + s.added * (u[k] - u_old[k]),
                       Kd = s.kept * memory.Kd[l][k] + s.added * (after[k] - before[k]);
          const double mean = .5 * (memory.d[l][k] + d);
          dissipated += share * s.half * mean * (memory.Kd[l][k] + Kd);
          memory.mean[k] += share * mean;
          memory.d[l][k] = d;
          memory.Kd[l][k] = Kd;
        }
      }
      return std::array<double, 1>{{dissipated}};
    };
    const double dissipated = sum_of_ranges<std::array<double, 1>>(u.size(), advance_values)[0];
    memory.Ku.swap(damped);
    return dissipated;
  }

  Damping::Energies Damping::advance_leapfrog(const double dt, const Unknowns &u_old, const Unknowns &Ku_old,
                                              const Unknowns &u, const Unknowns &Ku, DampingMemory &memory,
                                              Unknowns damped) const
  {
    if (!relaxes())
      return {0., 0.};
    const Unknowns &before = memory.damped(Ku_old), &after = damped.empty() ? Ku : damped;
    const auto      advance_values = [&](const std::size_t begin, const std::size_t end)
    {
      std::array<double, 2> sums = {
          {-.5 * (1. - modulus) *
               product_of_changes(&u_old[begin], &memory.u_static[begin], &after[begin],
                                  &memory.Ku_static[begin], end - begin),
           0.}};
      for (std::size_t l = 0; l < c.size(); ++l)
        advance_mechanism(dt / tau[l], .5 * modulus * c[l],
                          {&u_old[begin], &before[begin], &u[begin], &after[begin], &memory.d[l][begin],
                           &memory.Kd[l][begin]},
                          end - begin, sums);
      return sums;
    };
    const auto sums = sum_of_ranges<std::array<double, 2>>(u.size(), advance_values);
    memory.Ku.swap(damped);
    return {sums[0], sums[1]};
  }

  double Damping::more_energy(const DampingMemory &memory, const Unknowns &u, const Unknowns &Ku) const
  {
    if (!relaxes())
      return 0.;
    const Unknowns &damped = memory.damped(Ku);
    const auto      energy = [&](const std::size_t begin, const std::size_t end)
    {
      double sum = 0.;
      for (std::size_t k = begin; k < end; ++k)
      {
        sum -= .5 * (1. - modulus) * (u[k] - memory.u_static[k]) * (damped[k] - memory.Ku_static[k]);
        for (std::size_t l = 0; l < c.size(); ++l)
          sum += .5 * modulus * c[l] * memory.d[l][k] * memory.Kd[l][k];
      }
      return std::array<double, 1>{{sum}};
    };
    return sum_of_ranges<std::array<double, 1>>(u.size(), energy)[0];
  }

  void Damping::relaxed(const DampingMemory &memory, const Unknowns &u, const Unknowns &Ku,
                        const std::size_t begin, const std::size_t end, double *w, double *Kw) const
  {
    const std::size_t n = end - begin;
    const Unknowns   &damped = memory.damped(Ku);
    std::copy_n(u.begin() + begin, n, w);
    std::copy_n(damped.begin() + begin, n, Kw);
    if (!relaxes())
      return;
    const double  kept = modulus, rest = 1. - modulus;
    const double *u_rest = memory.u_static.data() + begin, *Ku_rest = memory.Ku_static.data() + begin;
#pragma omp simd
    for (std::size_t k = 0; k < n; ++k)
    {
      w[k] = kept * w[k] + rest * u_rest[k];
      Kw[k] = kept * Kw[k] + rest * Ku_rest[k];
    }
    for (std::size_t l = 0; l < c.size(); ++l)
    {
      const double  share = modulus * c[l];
      const double *d = memory.d[l].data() + begin, *Kd = memory.Kd[l].data() + begin;
#pragma omp simd
      for (std::size_t k = 0; k < n; ++k)
      {
        w[k] += share * d[k];
        Kw[k] += share * Kd[k];
      }
    }
    for (std::size_t k = 0; &damped != &Ku && k < n; ++k)
      Kw[k] += Ku[begin + k] - damped[begin + k];
  }

  double Damping::more_force(const DampingMemory &memory, const Unknowns &Ku, const std::size_t k) const
  {
    if (!relaxes())
      return 0.;
    double force = (modulus - 1.) * (memory.damped(Ku)[k] - memory.Ku_static[k]);
    for (std::size_t l = 0; l < c.size(); ++l)
      force += modulus * c[l] * memory.Kd[l][k];
    return force;
  }

  std::pair<double, double> Damping::of_mode(const double w, const double scale) const
  {
    if (!relaxes())
      return {.5 * (mass / w + stiffness * w), 1.};
    const std::complex<double> pole = law.scaled(scale).pole(w);
    return {ratio_of(pole), std::abs(pole) / w};
  }
} // namespace Voussoir
