// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>

#include <voussoir/base/error.h>
#include <voussoir/joints/condensed_body.h>

#include <cholmod.h>

#include <algorithm>
#include <map>
#include <new>
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
  namespace
  {
    /** What CHOLMOD says of its memory as an exception. */
    void check_memory(const cholmod_common &common)
    {
      if (common.status == CHOLMOD_OUT_OF_MEMORY)
        throw std::bad_alloc();
      if (common.status == CHOLMOD_TOO_LARGE)
        throw ComputationError("A monolith is too large: its factors have more than 2^31 entries. Use fewer "
                               "elements, or more joints.");
    }

    /** A matrix of CHOLMOD that frees itself. */
    class SparseMatrix
    {
    public:
      SparseMatrix(const std::size_t n, const std::size_t n_entries, const int type, cholmod_common &common)
          : matrix(cholmod_allocate_sparse(n, n, n_entries, 1, 1, -1, type, &common)), common(common)
      {
        check_memory(common);
      }
      SparseMatrix(const SparseMatrix &) = delete;
      ~SparseMatrix() { cholmod_free_sparse(&matrix, &common); }

      cholmod_sparse *matrix;

    private:
      cholmod_common &common;
    };
  } // namespace

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
      check_memory(common);
    }
  };

  namespace
  {
    /** A of the class, its lower triangle, in the matrix @p A. */
    void fill(const Structure &structure, const Body &body, const double mass_factor,
              const double stiffness_factor, const double dashpot_factor, const Unknowns &springs,
              cholmod_sparse *A)
    {
      const BlockSparseMatrix &K = body.stiffness;
      const unsigned int       n = 3 * K.n_rows();
      int                     *p = static_cast<int *>(A->p), *index = static_cast<int *>(A->i);
      double                  *x = static_cast<double *>(A->x);
      int                      k = 0;
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
    }

    /** A fill-reducing order in which the interface comes last. */
    std::vector<int> order(cholmod_sparse *A, const std::vector<bool> &is_interface, cholmod_common &common)
    {
      std::vector<int> group(is_interface.begin(), is_interface.end()), permutation(is_interface.size());
      cholmod_camd(A, nullptr, 0, group.data(), permutation.data(), &common);
      check_memory(common);
      return permutation;
    }
  } // namespace

  CondensedBody::CondensedBody(const Structure &structure, const Body &body, const double mass_factor,
                               const double stiffness_factor, const double dashpot_factor,
                               const Unknowns &springs)
      : factor(std::make_unique<Factor>())
  {
    AssertIndexRange(body.first_node + body.n_nodes(), structure.n_nodes() + 1);
    const std::size_t  n = 3 * body.n_nodes();
    cholmod_common    &common = factor->common;
    const SparseMatrix A(n, 9 * body.stiffness.value.size() / 2 + 3 * n, CHOLMOD_REAL, common);
    fill(structure, body, mass_factor, stiffness_factor, dashpot_factor, springs, A.matrix);
    std::vector<bool> is_interface(n, false);
    for (const unsigned int node : body.interface)
      for (unsigned int c = 0; c < 3; ++c)
        is_interface[3 * node + c] = true;

    if (!body.interface.empty()) // otherwise CHOLMOD's own choice of orderings is the best
    {
      std::vector<int> permutation = order(A.matrix, is_interface, common);
      common.nmethods = 1;
      common.method[0].ordering = CHOLMOD_GIVEN;
      factor->L = cholmod_analyze_p(A.matrix, permutation.data(), nullptr, 0, &common);
    }
    else
      factor->L = cholmod_analyze(A.matrix, &common);
    check_memory(common);
    cholmod_factorize(A.matrix, factor->L, &common);
    check_memory(common);
    const cholmod_factor *L = factor->L;
    if (common.status != CHOLMOD_OK || L == nullptr || L->minor < L->n)
      throw ComputationError(
          "The stiffness of monolith " + std::to_string(body.number) +
          " is not positive definite: nothing holds it (does its foot lie on the surface \"base\"?), or "
          "its elements are badly shaped.");
    find_interface(body, is_interface);
    copy_interface_factor();
    factor->b = cholmod_zeros(L->n, 1, CHOLMOD_REAL, &common);
    factor->x = cholmod_zeros(L->n, 1, CHOLMOD_REAL, &common);
    check_memory(common);
  }

  /** The interface must really stand last; the elimination tree is a chain there, so its postorder keeps it
   * so. */
  void CondensedBody::find_interface(const Body &body, const std::vector<bool> &is_interface)
  {
    const unsigned int n = factor->L->n, m = 3 * body.interface.size();
    const int         *permutation = static_cast<const int *>(factor->L->Perm);
    tail.assign(permutation + n - m, permutation + n);
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
  }

  /** L_GG out of the supernodes. */
  void CondensedBody::copy_interface_factor()
  {
    const cholmod_factor *L = factor->L;
    const unsigned int    m = n_interface(), first = L->n - m;
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

  double entries_of_factor(const std::vector<std::vector<unsigned int>> &neighbours,
                           const std::vector<bool>                      &is_interface)
  {
    constexpr double merged = 1.1; // CHOLMOD's supernodes hold some zeros
    cholmod_common   common;
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    std::size_t n_entries = 0;
    for (const auto &row : neighbours)
      n_entries += row.size();
    const std::size_t n = neighbours.size();
    double            entries = 0.;
    {
      const SparseMatrix A(n, n_entries, CHOLMOD_PATTERN, common);
      int               *p = static_cast<int *>(A.matrix->p), *index = static_cast<int *>(A.matrix->i);
      std::size_t        k = 0;
      for (std::size_t row = 0; row < n; ++row)
      {
        p[row] = k;
        for (const unsigned int column : neighbours[row])
          if (column >= row)
            index[k++] = column;
      }
      p[n] = k;
      cholmod_factor *L = nullptr;
      if (std::find(is_interface.begin(), is_interface.end(), true) != is_interface.end())
      {
        std::vector<int> permutation = order(A.matrix, is_interface, common);
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_GIVEN;
        L = cholmod_analyze_p(A.matrix, permutation.data(), nullptr, 0, &common);
      }
      else
        L = cholmod_analyze(A.matrix, &common);
      entries = 9. * common.lnz * merged; // of 3 x 3
      cholmod_free_factor(&L, &common);
    }
    cholmod_finish(&common);
    return entries;
  }
} // namespace Voussoir
