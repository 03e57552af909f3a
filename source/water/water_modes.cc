// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/water/water_modes.h>

#include <algorithm>
#include <boost/numeric/ublas/lu.hpp>
#include <boost/numeric/ublas/matrix.hpp>
#include <cmath>
#include <complex>

namespace Voussoir
{
  namespace
  {
    namespace ublas = boost::numeric::ublas;
    using Complex = std::complex<double>;
    using ComplexMatrix = ublas::matrix<Complex>;
    using ComplexVector = ublas::vector<Complex>;
    using Vectors = std::vector<std::vector<double>>;

    double product(const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }

    /** Solves A x = b. A singular matrix leaves b: the solution of the eigenvalue problem is then exact. */
    ComplexMatrix solve(ComplexMatrix A, ComplexMatrix b)
    {
      ublas::permutation_matrix<std::size_t> pivots(A.size1());
      if (ublas::lu_factorize(A, pivots) == 0)
        ublas::lu_substitute(A, pivots, b);
      return b;
    }

    /** Water in a basis V: V^T K V, V^T C V, V^T M V and V^T R with the sources R. */
    class ReducedWater
    {
    public:
      /** The basis begins with the potentials of incompressible water. */
      ReducedWater(const WaterModel &model, const Vectors &R) : R(R), model(model), C(model.bed_damping)
      {
        for (std::size_t i = 0; i < C.size(); ++i)
          C[i] += model.end_damping[i];
        for (const std::vector<double> &source : R)
          extend(model.solve(source));
      }

      /** Adds the potential of the whole model for a motion q of the modes at the circular frequency s. */
      void add_solution(const Complex s, const ComplexMatrix &q)
      {
        std::vector<Complex> source(C.size(), 0.);
        for (std::size_t k = 0; k < R.size(); ++k)
          for (std::size_t i = 0; i < source.size(); ++i)
            source[i] += R[k][i] * q(k, 0);
        std::vector<double> real, imaginary;
        for (const Complex x : model.solve(s, source))
        {
          real.push_back(x.real());
          imaginary.push_back(x.imag());
        }
        extend(std::move(real));
        extend(std::move(imaginary));
      }

      /** Returns R^T (K + s C + s^2 M)^-1 R. */
      ComplexMatrix mass(const Complex s) const
      {
        return prod(trans(sources), solve(K + s * Cr + s * s * M, sources));
      }

    private:
      /** Adds a vector to the basis, orthonormalised twice. Dependent vectors are left out. */
      void extend(std::vector<double> v)
      {
        const double first = std::sqrt(product(v, v));
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (const std::vector<double> &b : basis)
          {
            const double share = product(b, v);
            for (std::size_t i = 0; i < v.size(); ++i)
              v[i] -= share * b[i];
          }
        const double length = std::sqrt(product(v, v));
        if (!(length > 1e-10 * first))
          return;
        for (double &x : v)
          x /= length;
        basis.push_back(std::move(v));
        const std::size_t n = basis.size();
        for (ComplexMatrix *matrix : {&K, &Cr, &M})
          matrix->resize(n, n, true);
        sources.resize(n, R.size(), true);
        std::vector<double> Kv, Cv(C.size()), Mv(C.size());
        model.multiply(basis.back(), Kv);
        for (std::size_t i = 0; i < C.size(); ++i)
        {
          Cv[i] = C[i] * basis.back()[i];
          Mv[i] = model.mass[i] * basis.back()[i];
        }
        for (std::size_t a = 0; a < n; ++a)
        {
          K(a, n - 1) = K(n - 1, a) = product(basis[a], Kv);
          Cr(a, n - 1) = Cr(n - 1, a) = product(basis[a], Cv);
          M(a, n - 1) = M(n - 1, a) = product(basis[a], Mv);
        }
        for (std::size_t k = 0; k < R.size(); ++k)
          sources(n - 1, k) = product(basis.back(), R[k]);
      }

      const Vectors      &R;
      const WaterModel   &model;
      std::vector<double> C;
      Vectors             basis;
      ComplexMatrix       K, Cr, M, sources;
    };
  } // namespace

  namespace
  {
    /** Solves (Lambda + s^2 (rest + B(i |s|))) q = 0 by inverse iteration with the Rayleigh quotient, from the given s
     * and q. Returns false if the iteration does not converge. */
    bool iterate(const ReducedWater &water, const ComplexMatrix &Lambda, const ComplexMatrix &rest,
                 Complex &s, ComplexMatrix &q)
    {
      double change = 1.;
      bool   is_fixed = true; // the shape is that of the mode until the frequency is near
      for (unsigned int iteration = 0; change > 1e-8; ++iteration)
      {
        if (iteration == 100)
          return false;
        const ComplexMatrix mass = rest + water.mass(Complex(0., std::abs(s))), mass_q = prod(mass, q);
        const Complex       square =
            -prod(trans(q), ComplexMatrix(prod(Lambda, q)))(0, 0) / prod(trans(q), mass_q)(0, 0);
        Complex next = std::sqrt(square);
        next = .5 * (s + (next.imag() < 0. ? -next : next)); // the whole change may alternate
        change = std::abs(next - s) / std::abs(s);
        s = next;
        is_fixed = is_fixed && change > 1e-3;
        if (is_fixed)
          continue;
        q = solve(Lambda + square * mass, mass_q);
        Complex largest = 0.;
        for (std::size_t i = 0; i < q.size1(); ++i)
          if (std::abs(q(i, 0)) > std::abs(largest))
            largest = q(i, 0);
        q /= largest;
      }
      return true;
    }

    /** Returns the complex circular frequency of the mode that begins as mode k; zero: not converged. The basis of the
     * water receives the potential of the whole model for each iterate, until the frequency does not change. */
    Complex frequency_of(ReducedWater &water, const ComplexMatrix &Lambda, const ComplexMatrix &rest,
                         const std::size_t k)
    {
      Complex       s(0., std::sqrt(Lambda(k, k).real()));
      ComplexMatrix q(Lambda.size1(), 1, 0.);
      q(k, 0) = 1.;
      for (unsigned int pass = 0; pass < 20; ++pass)
      {
        const Complex before = s;
        try
        {
          water.add_solution(Complex(0., std::abs(s)), q);
        }
        catch (const ComputationError &)
        {
          return 0.;
        }
        if (!iterate(water, Lambda, rest, s, q))
          return 0.;
        if (std::abs(s - before) < 1e-6 * std::abs(s))
          return s;
      }
      return 0.;
    }
  } // namespace

  std::vector<double> make_compressible(const AcousticWater &water, const WaterModel &model,
                                        std::vector<NaturalMode> &modes, const unsigned int count)
  {
    const std::size_t m = modes.size();
    Vectors           R;
    ComplexMatrix     Lambda(m, m, 0.), rest(m, m, 0.);
    for (std::size_t k = 0; k < m; ++k)
    {
      R.push_back(water.with_dam().source(model, modes[k].shape));
      Lambda(k, k) = std::pow(2. * M_PI * modes[k].frequency, 2);
      rest(k, k) = 1.;
    }
    ReducedWater reduced(model, R);
    rest -= reduced.mass(0.);
    std::vector<Complex>                        found;
    std::vector<std::pair<double, NaturalMode>> result; // with the damping
    for (std::size_t k = 0; k < m && result.size() < count; ++k)
    {
      const Complex s = frequency_of(reduced, Lambda, rest, k);
      const bool    is_found = std::abs(s) > 0.;
      if (is_found &&
          std::any_of(found.begin(), found.end(),
                      [&](const Complex other) { return std::abs(s - other) < 1e-4 * std::abs(s); }))
        continue;
      result.emplace_back(is_found ? -s.real() / std::abs(s) : std::nan(""), std::move(modes[k]));
      if (!is_found)
        continue;
      found.push_back(s);
      result.back().second.frequency = std::abs(s) / (2. * M_PI);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto &a, const auto &b) { return a.second.frequency < b.second.frequency; });
    modes.clear();
    std::vector<double> damping;
    for (auto &[of_mode, mode] : result)
    {
      damping.push_back(of_mode);
      modes.push_back(std::move(mode));
    }
    return damping;
  }
} // namespace Voussoir
