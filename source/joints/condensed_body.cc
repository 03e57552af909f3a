// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/joints/condensed_body.h>

#include <cholmod.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

extern "C"
{
  void dtrsv_(const char *, const char *, const char *, const int *, const double *, const int *, double *,
              const int *);
  void dsyrk_(const char *, const char *, const int *, const int *, const double *, const double *,
              const int *, const double *, double *, const int *);
  void dpotri_(const char *, const int *, double *, const int *, int *);
}

namespace Voussoir
{
  struct CondensedBody::Factor
  {
    cholmod_common  common;
    cholmod_factor *L = nullptr;
    cholmod_dense  *b = nullptr, *x = nullptr, *work_1 = nullptr, *work_2 = nullptr;

    Factor()
    {
      cholmod_start(&common);
      common.supernodal = CHOLMOD_SUPERNODAL;
      common.print = 0;
    }
    ~Factor()
    {
      for (cholmod_dense **d : {&b, &x, &work_1, &work_2})
        cholmod_free_dense(d, &common);
      cholmod_free_factor(&L, &common);
      cholmod_finish(&common);
    }

    /** x = L^-1 x or L^-T x, in the permuted numbering. */
    void solve(const int system)
    {
      cholmod_solve2(system, L, b, nullptr, &x, nullptr, &work_1, &work_2, &common);
    }
  };

  namespace
  {
    cholmod_sparse *upper_triangle(const Structure &structure, const Body &body, const double mass_factor,
                                   const double stiffness_factor, const double dashpot_factor,
                                   const Unknowns &springs, cholmod_common &common)
    {
      const BlockSparseMatrix &K = body.stiffness;
      const unsigned int       n = 3 * K.n_rows();
      cholmod_sparse          *A =
          cholmod_allocate_sparse(n, n, 9 * K.value.size() / 2 + 3 * n, 1, 1, -1, CHOLMOD_REAL, &common);
      int    *p = static_cast<int *>(A->p), *index = static_cast<int *>(A->i);
      double *x = static_cast<double *>(A->x);
      int     k = 0;
      // The matrix is symmetric: row by row of K's upper part is column by column of its lower part.
      for (unsigned int row = 0; row < K.n_rows(); ++row)
        for (unsigned int i = 0; i < 3; ++i)
        {
          p[3 * row + i] = k;
          for (std::size_t e = K.start[row]; e < K.start[row + 1]; ++e)
            for (unsigned int j = 0; j < 3; ++j)
              if (3 * K.column[e] + j >= 3 * row + i)
              {
                double            a = stiffness_factor * K.value[e][3 * i + j];
                const std::size_t node = body.first_node + row;
                if (K.column[e] == row)
                  a += mass_factor * structure.mass[node][3 * i + j];
                if (K.column[e] == row && i == j && !structure.dashpots.empty())
                  a += dashpot_factor * structure.dashpots[3 * node + i];
                if (K.column[e] == row && i == j && !springs.empty())
                  a += springs[3 * node + i];
                index[k] = 3 * K.column[e] + j;
                x[k++] = a;
              }
        }
      p[n] = k;
      return A;
    }

    /** A fill-reducing order in which the interface comes last. */
    std::vector<int> order(cholmod_sparse *A, const std::vector<bool> &is_interface, cholmod_common &common)
    {
      std::vector<int> group(is_interface.begin(), is_interface.end()), permutation(is_interface.size());
      cholmod_camd(A, nullptr, 0, group.data(), permutation.data(), &common);
      return permutation;
    }
  } // namespace

  CondensedBody::CondensedBody(const Structure &structure, const Body &body, const double mass_factor,
                               const double stiffness_factor, const double dashpot_factor,
                               const Unknowns &springs)
      : factor(std::make_unique<Factor>())
  {
    cholmod_common &common = factor->common;
    cholmod_sparse *A =
        upper_triangle(structure, body, mass_factor, stiffness_factor, dashpot_factor, springs, common);
    std::vector<bool> is_interface(A->nrow, false);
    for (const unsigned int node : body.interface)
      for (unsigned int c = 0; c < 3; ++c)
        is_interface[3 * node + c] = true;

    if (!body.interface.empty()) // otherwise CHOLMOD's own choice of orderings is the best
    {
      std::vector<int> permutation = order(A, is_interface, common);
      common.nmethods = 1;
      common.method[0].ordering = CHOLMOD_GIVEN;
      factor->L = cholmod_analyze_p(A, permutation.data(), nullptr, 0, &common);
    }
    else
      factor->L = cholmod_analyze(A, &common);
    cholmod_factorize(A, factor->L, &common);
    cholmod_free_sparse(&A, &common);
    cholmod_factor *L = factor->L;
    if (common.status != CHOLMOD_OK || L == nullptr || L->minor < L->n)
      throw ComputationError(
          "The stiffness of monolith " + std::to_string(body.number) +
          " is not positive definite: nothing holds it (does its foot lie on the surface \"base\"?), or "
          "its elements are badly shaped.");

    // The interface must really stand last; the elimination tree is a chain there, so its postorder keeps it
    // so.
    const unsigned int n = L->n, m = 3 * body.interface.size(), first = n - m;
    const int         *permutation = static_cast<const int *>(L->Perm);
    tail.assign(permutation + first, permutation + n);
    std::map<unsigned int, unsigned int> place;
    for (unsigned int i = 0; i < m; ++i)
    {
      if (!is_interface[tail[i]])
        throw ComputationError("Monolith " + std::to_string(body.number) +
                               " is not in one piece: the elements of a monolith must be connected.");
      place[tail[i]] = i;
    }
    slot.resize(m);
    for (unsigned int i = 0; i < body.interface.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        slot[3 * i + c] = place.at(3 * body.interface[i] + c);

    // Copy L_GG out of the supernodes.
    dense.assign(std::size_t(m) * m, 0.);
    const int *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi),
              *px = static_cast<const int *>(L->px), *rows = static_cast<const int *>(L->s);
    const double *values = static_cast<const double *>(L->x);
    for (std::size_t s = 0; s < L->nsuper; ++s)
      for (int column = std::max<int>(super[s], first); column < super[s + 1]; ++column)
      {
        const int n_rows = pi[s + 1] - pi[s], j = column - super[s];
        for (int i = j; i < n_rows; ++i)
          dense[std::size_t(column - first) * m + (rows[pi[s] + i] - first)] =
              values[px[s] + std::size_t(j) * n_rows + i];
      }

    factor->b = cholmod_zeros(n, 1, CHOLMOD_REAL, &common);
    factor->x = cholmod_zeros(n, 1, CHOLMOD_REAL, &common);
  }

  CondensedBody::~CondensedBody() = default;
  CondensedBody::CondensedBody(CondensedBody &&) noexcept = default;

  void CondensedBody::forward(const double *b)
  {
    const int *permutation = static_cast<const int *>(factor->L->Perm);
    double    *p = static_cast<double *>(factor->b->x);
    for (std::size_t i = 0; i < factor->L->n; ++i)
      p[i] = b[permutation[i]];
    factor->solve(CHOLMOD_L);
  }

  void CondensedBody::interface_displacement(double *u) const
  {
    const int     m = n_interface(), one = 1;
    const double *y = static_cast<const double *>(factor->x->x) + factor->L->n - m;
    std::copy(y, y + m, u);
    if (m > 0)
      dtrsv_("L", "T", "N", &m, dense.data(), &m, u, &one);
  }

  void CondensedBody::add_interface_forces(const double *f)
  {
    const int           m = n_interface(), one = 1;
    double             *y = static_cast<double *>(factor->x->x) + factor->L->n - m;
    std::vector<double> z(f, f + m);
    if (m > 0)
      dtrsv_("L", "N", "N", &m, dense.data(), &m, z.data(), &one);
    for (int i = 0; i < m; ++i)
      y[i] += z[i];
  }

  void CondensedBody::backward(double *u)
  {
    std::swap(factor->b, factor->x);
    factor->solve(CHOLMOD_Lt);
    const int    *permutation = static_cast<const int *>(factor->L->Perm);
    const double *x = static_cast<const double *>(factor->x->x);
    for (std::size_t i = 0; i < factor->L->n; ++i)
      u[permutation[i]] = x[i];
  }

  namespace
  {
    /** Fills the upper triangle of the m x m matrix from the lower one. */
    void mirror(std::vector<double> &S, const int m)
    {
      for (int j = 0; j < m; ++j)
        for (int i = j + 1; i < m; ++i)
          S[std::size_t(i) * m + j] = S[std::size_t(j) * m + i];
    }
  } // namespace

  std::vector<double> CondensedBody::stiffness() const
  {
    std::vector<double> S(dense.size());
    const int           m = n_interface();
    const double        one = 1., zero = 0.;
    if (m > 0)
      dsyrk_("L", "N", &m, &m, &one, dense.data(), &m, &zero, S.data(), &m);
    mirror(S, m);
    return S;
  }

  std::vector<double> CondensedBody::flexibility() const
  {
    std::vector<double> S = dense;
    const int           m = n_interface();
    int                 info = 0;
    if (m > 0)
      dpotri_("L", &m, S.data(), &m, &info);
    mirror(S, m);
    return S;
  }

  double CondensedBody::memory() const
  {
    return 8. * (factor->L->xsize + dense.size());
  }
} // namespace Voussoir
