// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/joints/dense_kernels.h>
#include <voussoir/joints/joint_block.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns true if the row gives a component of the gap directly: it does not depend on the force. */
    bool gives_gap(const PairEquations &e, const unsigned int row)
    {
      for (unsigned int c = 0; c < 3; ++c)
        if (e.d_force[3 * row + c] != 0. || (e.d_gap[3 * row + c] != 0.) != (c == row))
          return false;
      return true;
    }

    enum class Row : unsigned char
    {
      force,
      gap,
      unknown
    };

    Row kind_of(const PairEquations &e, const unsigned int row)
    {
      return row_is_trivial(e, row) ? Row::force : gives_gap(e, row) ? Row::gap : Row::unknown;
    }

    /** Inverts a symmetric matrix in place; only the lower triangle is used. Returns false if it is not
     * positive definite, or too ill-conditioned for single precision. */
    bool invert(std::vector<double> &A, const int n)
    {
      constexpr double    worst = 1e4; // largest A_ii A^-1_ii; 76 is the largest value seen in a dam
      std::vector<double> diagonal(n);
      for (int i = 0; i < n; ++i)
        diagonal[i] = A[std::size_t(i) * n + i];
      int info = 0;
      dpotrf_("L", &n, A.data(), &n, &info);
      if (info == 0)
        dpotri_("L", &n, A.data(), &n, &info);
      for (int i = 0; i < n && info == 0; ++i)
        if (!(diagonal[i] * A[std::size_t(i) * n + i] < worst))
          info = 1;
      return info == 0;
    }
  } // namespace

  void JointBlock::initialise(const InterfaceOperator &W_, const unsigned int group_)
  {
    W = &W_;
    group = group_;
    n = W->size(group);
    leading = padded(n);
  }

  /** Returns whether F exists. Computes F at the first call. */
  bool JointBlock::has_inverse()
  {
    if (!tried_inverse)
      make_inverse();
    tried_inverse = true;
    return !F.empty();
  }

  void JointBlock::make_inverse()
  {
    std::vector<double> inverse = W->own_block(group);
    if (n == 0 || !invert(inverse, n))
      return;
    F.assign(leading * n, 0.f);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = j; i < n; ++i)
        F[j * leading + i] = F[i * leading + j] = static_cast<float>(inverse[j * n + i]);
    check_inverse();
  }

  /** Checks y = W_jj F y in single precision, with vectors of both signs. */
  void JointBlock::check_inverse()
  {
    constexpr double          enough = 1e-6; // relative error that the solver assumes
    std::vector<float>        y(n), z(n);
    std::vector<double>       exact(n);
    const std::vector<double> block = W->own_block(group);
    is_accurate = true;
    for (unsigned int trial = 0; trial < 3; ++trial)
    {
      for (unsigned int i = 0; i < n; ++i)
        y[i] = static_cast<float>(std::cos((1. + 1.7 * trial) * i * i));
      std::fill(z.begin(), z.end(), 0.f);
      add_symmetric(F.data(), leading, n, y.data(), z.data());
      std::fill(exact.begin(), exact.end(), 0.);
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i)
          exact[i] += block[j * n + i] * z[j];
      double error = 0., square = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        error += (exact[i] - y[i]) * (exact[i] - y[i]);
        square += double(y[i]) * y[i];
      }
      is_accurate = is_accurate && error <= enough * enough * square;
    }
  }

  /** Returns true if the current factors precondition the equations well: the same rows are unknown, and the
   * directions of slip have changed little. */
  bool JointBlock::is_similar(const PairEquations *present) const
  {
    constexpr double tolerated = .3;
    if (factor.equations.empty())
      return false;
    for (std::size_t i = 0; i < factor.equations.size(); ++i)
    {
      const PairEquations &a = factor.equations[i], &b = present[i];
      for (unsigned int k = 0; k < 3; ++k)
        if (kind_of(a, k) != kind_of(b, k))
          return false;
      for (unsigned int k = 0; k < 9; ++k)
        if (!(std::abs(a.d_force[k] - b.d_force[k]) <= tolerated)) // or not a number
          return false;
    }
    return true;
  }

  bool JointBlock::update(const PairEquations *present)
  {
    if (is_similar(present))
      return false;
    factor.equations.assign(present, present + n / 3);
    find_rows();
    // Two thirds: chosen when both products with F read all of it.
    for_gap =
        given_force.size() + unknown.size() < 2 * (given_gap.size() + unknown.size()) / 3 && has_inverse();
    if (for_gap)
      factorise();
    else
    {
      factor.find_active(*W, group, present);
      factor.assemble(*W, group);
      factor.factorise();
    }
    return true;
  }

  void JointBlock::find_rows()
  {
    given_force.clear();
    given_gap.clear();
    unknown.clear();
    for (unsigned int i = 0; i < n; ++i)
    {
      const Row kind = kind_of(factor.equations[i / 3], i % 3);
      (kind == Row::force ? given_force : kind == Row::gap ? given_gap : unknown).push_back(i);
    }
  }

  /** Factorises d_force F + d_gap in the rows and columns without given gap. */
  void JointBlock::factorise()
  {
    std::vector<unsigned int> &rows = factor.active;
    rows.resize(given_force.size() + unknown.size());
    std::merge(given_force.begin(), given_force.end(), unknown.begin(), unknown.end(), rows.begin());
    const std::size_t size = rows.size();
    near_rows.clear();
    for (const unsigned int i : rows)
      for (unsigned int c = 0; c < 3 && (near_rows.empty() || near_rows.back() < i - i % 3 + 2); ++c)
        near_rows.push_back(i - i % 3 + c);
    factor.lu.resize(size * size);
    factor.pivots.resize(size);
    for (std::size_t column = 0; column < size; ++column)
    {
      const float *F_j = F.data() + rows[column] * leading;
      float       *out = factor.lu.data() + column * size;
      for (std::size_t row = 0; row < size; ++row)
      {
        const unsigned int   pair = rows[row] / 3, c = 3 * (rows[row] % 3);
        const PairEquations &e = factor.equations[pair];
        const double        *f = e.d_force.data() + c;
        out[row] =
            static_cast<float>(f[0] * F_j[3 * pair] + f[1] * F_j[3 * pair + 1] + f[2] * F_j[3 * pair + 2] +
                               (rows[column] / 3 == pair ? e.d_gap[c + rows[column] % 3] : 0.));
      }
    }
    factor.factorise();
  }

  void JointBlock::solve(const float *r, float *z, float *y) const
  {
    if (for_gap)
      solve_for_gap(r, z, y);
    else
      solve_for_force(r, z, y);
  }

  void JointBlock::solve_for_gap(const float *r, float *z, float *y) const
  {
    std::fill(y, y + n, 0.f);
    for (const unsigned int i : given_gap)
      y[i] = r[i] / static_cast<float>(factor.equations[i / 3].d_gap[4 * (i % 3)]);
    const std::vector<unsigned int> &rows = factor.active;
    take_products(F.data(), leading, n, near_rows, y, z);
    std::vector<float> x(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      const unsigned int   i = rows[k], first = i - i % 3;
      const PairEquations &e = factor.equations[i / 3];
      double               sum = r[i];
      for (unsigned int c = 0; c < 3; ++c)
        sum -= e.d_force[3 * (i % 3) + c] * z[first + c] + e.d_gap[3 * (i % 3) + c] * y[first + c];
      x[k] = static_cast<float>(sum);
    }
    factor.solve(x.data(), 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      y[rows[k]] = x[k];
    std::fill(z, z + n, 0.f);
    add_symmetric(F.data(), leading, n, y, z);
    for (const unsigned int i : given_force)
      z[i] = r[i];
    if (!is_accurate)
      multiply_by_W(z, y);
  }

  /** Computes y = W_jj z. */
  void JointBlock::multiply_by_W(const float *z, float *y) const
  {
    std::fill(y, y + n, 0.f);
    W->add_single(group, group, z, y);
  }

  void JointBlock::solve_for_force(const float *r, float *z, float *y) const
  {
    std::copy(r, r + n, z);
    const std::vector<unsigned int> &rows = factor.active;
    std::vector<float>               x(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      x[k] = r[rows[k]];
    factor.solve(x.data(), 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      z[rows[k]] = x[k];
    multiply_by_W(z, y);
  }
} // namespace Voussoir
