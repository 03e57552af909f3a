// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_contact.h"

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <limits>

extern "C"
{
  void dgetrf_(const int *, const int *, double *, const int *, int *, int *);
  void dgetrs_(const char *, const int *, const int *, const double *, const int *, const int *, double *,
               const int *, int *);
}

namespace Voussoir
{
  namespace
  {
    /** Direct solver of Newton's linear systems. Rows that determine a single force component are eliminated.
     * The remaining matrix is factorised for each set of equations. The factorisation is dense if the matrix
     * is small or has few zeros. */
    class DirectJacobian : public ContactJacobian
    {
    public:
      explicit DirectJacobian(const SparseContactOperator &op)
          : op(op), W(op.matrix()), position(3 * W.n_rows())
      {
      }
      ~DirectJacobian() override { umfpack_di_free_numeric(&numeric); }

      unsigned int update(const std::vector<PairEquations> &new_equations) override
      {
        equations = &new_equations;
        active.clear();
        for (unsigned int i = 0; i < equations->size(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
          {
            position[3 * i + c] = is_trivial(i, c) ? -1 : static_cast<int>(active.size());
            if (position[3 * i + c] >= 0)
              active.push_back(3 * i + c);
          }
        assemble();
        factorise();
        return 1;
      }

      unsigned int solve(double, Unknowns &step, Unknowns &d_gap) override
      {
        const std::size_t n_pairs = equations->size();
        step.assign(3 * n_pairs, 0.);
        for (unsigned int i = 0; i < n_pairs; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            if (position[3 * i + c] < 0)
              step[3 * i + c] = -(*equations)[i].residual[c];
        op.multiply(step, d_gap);
        std::vector<double> x(active.size()), y(active.size());
        for (std::size_t k = 0; k < active.size(); ++k)
        {
          const unsigned int   i = active[k] / 3, c = active[k] % 3;
          const PairEquations &e = (*equations)[i];
          x[k] = -e.residual[c];
          for (unsigned int j = 0; j < 3; ++j)
            x[k] -= e.d_force[3 * c + j] * step[3 * i + j] + e.d_gap[3 * c + j] * d_gap[3 * i + j];
        }
        back_substitute(x, y);
        for (std::size_t k = 0; k < active.size(); ++k)
          step[active[k]] = y[k];
        op.multiply(step, d_gap);
        return 0;
      }

    private:
      bool is_trivial(const unsigned int i, const unsigned int c) const
      {
        const PairEquations &e = (*equations)[i];
        for (unsigned int j = 0; j < 3; ++j)
          if (e.d_gap[3 * c + j] != 0. || e.d_force[3 * c + j] != (c == j ? 1. : 0.))
            return false;
        return true;
      }

      /** Assembles the active rows and columns, row by row. */
      void assemble()
      {
        start.assign(1, 0);
        column.clear();
        value.clear();
        for (const unsigned int row : active)
        {
          const unsigned int   i = row / 3, c = row % 3;
          const PairEquations &e = (*equations)[i];
          for (std::size_t k = W.start[i]; k < W.start[i + 1]; ++k)
            for (unsigned int j = 0; j < 3; ++j)
            {
              const unsigned int other = W.column[k];
              if (position[3 * other + j] < 0)
                continue;
              double a = other == i ? e.d_force[3 * c + j] : 0.;
              for (unsigned int l = 0; l < 3; ++l)
                a += e.d_gap[3 * c + l] * W.value[k][3 * l + j];
              column.push_back(position[3 * other + j]);
              value.push_back(a);
            }
          start.push_back(static_cast<int>(column.size()));
        }
      }

      void factorise()
      {
        umfpack_di_free_numeric(&numeric);
        numeric = nullptr;
        singular = false;
        const int n = static_cast<int>(active.size());
        dense = n <= 150 || value.size() > .25 * n * n;
        if (n == 0)
          return;
        if (dense)
        {
          lu.assign(std::size_t(n) * n, 0.);
          pivots.resize(n);
          for (int row = 0; row < n; ++row)
            for (int k = start[row]; k < start[row + 1]; ++k)
              lu[std::size_t(column[k]) * n + row] = value[k];
          int info = 0;
          dgetrf_(&n, &n, lu.data(), &n, pivots.data(), &info);
          singular = info != 0;
          return;
        }
        // The matrix by rows is its transpose by columns.
        void *symbolic = nullptr;
        int   status =
            umfpack_di_symbolic(n, n, start.data(), column.data(), value.data(), &symbolic, nullptr, nullptr);
        if (status == UMFPACK_OK)
          status = umfpack_di_numeric(start.data(), column.data(), value.data(), symbolic, &numeric, nullptr,
                                      nullptr);
        umfpack_di_free_symbolic(&symbolic);
        singular = status != UMFPACK_OK;
      }

      void back_substitute(std::vector<double> &x, std::vector<double> &y) const
      {
        const int n = static_cast<int>(active.size()), one = 1;
        if (singular)
          y.assign(n, std::numeric_limits<double>::quiet_NaN());
        else if (dense && n > 0)
        {
          int info = 0;
          y = x;
          dgetrs_("N", &n, &one, lu.data(), &n, pivots.data(), y.data(), &n, &info);
        }
        else if (n > 0)
          umfpack_di_solve(UMFPACK_At, start.data(), column.data(), value.data(), y.data(), x.data(), numeric,
                           nullptr, nullptr);
      }

      const SparseContactOperator      &op;
      const BlockSparseMatrix          &W;
      const std::vector<PairEquations> *equations = nullptr;
      std::vector<int>                  position; ///< index of each unknown among the active ones, or -1
      std::vector<unsigned int>         active;
      std::vector<int>                  start, column, pivots;
      std::vector<double>               value, lu;
      void                             *numeric = nullptr;
      bool                              dense = true, singular = false;
    };
  } // namespace

  Matrix3 SparseContactOperator::diagonal(const unsigned int pair) const
  {
    for (std::size_t k = W.start[pair]; k < W.start[pair + 1]; ++k)
      if (W.column[k] == pair)
        return W.value[k];
    return {};
  }

  void SparseContactOperator::multiply(const Unknowns &x, Unknowns &y) const
  {
    y.resize(x.size());
    W.multiply(x.data(), y.data());
  }

  void SparseContactOperator::sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const
  {
    Unknowns b;
    multiply(force, b);
    for (std::size_t k = 0; k < b.size(); ++k)
      b[k] = gap[k] - b[k];
    for (unsigned int i = 0; i < W.n_rows(); ++i)
    {
      Vector3 free = {{b[3 * i], b[3 * i + 1], b[3 * i + 2]}};
      Matrix3 H{};
      for (std::size_t k = W.start[i]; k < W.start[i + 1]; ++k)
        if (W.column[k] == i)
          H = W.value[k];
        else
        {
          const double *f = force.data() + 3 * std::size_t(W.column[k]);
          const Vector3 x = W.value[k] * Vector3{{f[0], f[1], f[2]}};
          for (unsigned int c = 0; c < 3; ++c)
            free[c] += x[c];
        }
      const Vector3 f = solve_pair(i, H, free);
      std::copy(f.begin(), f.end(), force.begin() + 3 * i);
    }
    multiply(force, gap);
    for (std::size_t k = 0; k < b.size(); ++k)
      gap[k] += b[k];
  }

  std::unique_ptr<ContactJacobian> SparseContactOperator::make_jacobian() const
  {
    return std::make_unique<DirectJacobian>(*this);
  }

  bool is_symmetric(const BlockSparseMatrix &W)
  {
    double largest = 0., difference = 0.;
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      for (std::size_t k = W.start[i]; k < W.start[i + 1]; ++k)
      {
        const unsigned int j = W.column[k];
        const auto         begin = W.column.begin() + W.start[j], end = W.column.begin() + W.start[j + 1];
        const auto         found = std::lower_bound(begin, end, i);
        if (found == end || *found != i)
          return false;
        const Matrix3 &a = W.value[k], &b = W.value[found - W.column.begin()];
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
          {
            largest = std::max(largest, std::abs(a[3 * r + c]));
            difference = std::max(difference, std::abs(a[3 * r + c] - b[3 * c + r]));
          }
      }
    return difference <= 1e-13 * largest;
  }
} // namespace Voussoir
