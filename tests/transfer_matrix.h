// SPDX-License-Identifier: GPL-3.0-or-later
// Harmonic plane waves in a layer on a half-space, by transfer matrices (Thomson 1950, Haskell 1953).

#ifndef voussoir_tests_transfer_matrix_h
#define voussoir_tests_transfer_matrix_h

#include <voussoir/rock/plane_wave.h>

#include <array>
#include <cmath>
#include <complex>

namespace TransferMatrix
{
  using namespace Voussoir;
  using Complex = std::complex<double>;
  using State = std::array<Complex, 4>; ///< u_s, u_z, stress s-z, stress z-z
  using Matrix = std::array<State, 4>;

  inline Matrix operator*(const Matrix &a, const Matrix &b)
  {
    Matrix c{};
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int j = 0; j < 4; ++j)
          c[i][j] += a[i][k] * b[k][j];
    return c;
  }

  inline State operator*(const Matrix &a, const State &b)
  {
    State c{};
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int k = 0; k < 4; ++k)
        c[i] += a[i][k] * b[k];
    return c;
  }

  /** Matrix exponential by scaling, Taylor series and squaring. */
  inline Matrix exponential(Matrix a)
  {
    constexpr unsigned int n_squares = 5;
    Matrix                 sum{}, term{};
    for (unsigned int i = 0; i < 4; ++i)
    {
      sum[i][i] = term[i][i] = 1.;
      for (Complex &value : a[i])
        value *= std::pow(.5, n_squares);
    }
    for (unsigned int k = 1; k < 18; ++k)
    {
      term = term * a;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          sum[i][j] += (term[i][j] /= double(k));
    }
    for (unsigned int k = 0; k < n_squares; ++k)
      sum = sum * sum;
    return sum;
  }

  struct Moduli
  {
    explicit Moduli(const Material &m)
        : mu(m.young / (2. * (1. + m.poisson))), lambda(2. * mu * m.poisson / (1. - 2. * m.poisson)),
          rho(m.density), alpha(std::sqrt((lambda + 2. * mu) / rho)), beta(std::sqrt(mu / rho))
    {
    }
    double mu, lambda, rho, alpha, beta;
  };

  /** Displacement (s, n, z) of the surface of a layer of thickness @p h on a half-space, for a wave of unit
   * amplitude and the circular frequency @p w that rises in the half-space. */
  inline std::array<Complex, 3> surface(const PlaneWave &wave, const Material &layer, const double h,
                                        const Material &half_space, const double w)
  {
    const Moduli  m(layer), below(half_space);
    const double  p = wave.slowness(half_space);
    const Complex i(0., 1.), a = i * w * p;
    const double  q_p = std::sqrt(std::max(0., 1. / (below.alpha * below.alpha) - p * p)),
                 q_s = std::sqrt(1. / (below.beta * below.beta) - p * p);
    if (wave.type == PlaneWave::SH)
    {
      const double k = w * std::sqrt(1. / (m.beta * m.beta) - p * p), ratio = m.mu * k / (below.mu * w * q_s);
      return {{0., 2. / (std::cos(k * h) + i * ratio * std::sin(k * h)), 0.}};
    }
    const double M = m.lambda + 2. * m.mu, lambda = m.lambda;
    Matrix       A{};
    A[0] = {{0., a, 1. / m.mu, 0.}};
    A[1] = {{a * lambda / M, 0., 0., 1. / M}};
    A[2] = {{-m.rho * w * w - a * a * (M - lambda * lambda / M), 0., 0., a * lambda / M}};
    A[3] = {{0., -m.rho * w * w, a, 0.}};
    for (State &row : A)
      for (Complex &value : row)
        value *= h;
    const Matrix through = exponential(A);
    const auto   of_wave = [&](const double u, const double v, const double q) // (u, v) f(t - p s - q z)
    {
      return through * State{{u, v, below.mu * (-i * w * q * u - a * v),
                              -below.lambda * a * u - (below.lambda + 2. * below.mu) * i * w * q * v}};
    };
    const double alpha = below.alpha, beta = below.beta;
    const State  in = wave.type == PlaneWave::P ? of_wave(alpha * p, alpha * q_p, q_p)
                                                : of_wave(beta * q_s, -beta * p, q_s),
                p_out = of_wave(alpha * p, -alpha * q_p, -q_p), s_out = of_wave(beta * q_s, beta * p, -q_s);
    // No traction of the surface
    const Complex determinant = p_out[2] * s_out[3] - p_out[3] * s_out[2],
                  of_p = (in[3] * s_out[2] - in[2] * s_out[3]) / determinant,
                  of_s = (in[2] * p_out[3] - in[3] * p_out[2]) / determinant;
    return {{in[0] + of_p * p_out[0] + of_s * s_out[0], 0., in[1] + of_p * p_out[1] + of_s * s_out[1]}};
  }
} // namespace TransferMatrix

#endif
