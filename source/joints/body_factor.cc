// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/base/cholmod_objects.h>
#include <voussoir/base/error.h>
#include <voussoir/joints/body_factor.h>
#include <voussoir/joints/packed_factor.h>

#include <omp.h>

#include <algorithm>
#include <cassert>
#include <new>
#include <string>

namespace Voussoir
{
  namespace
  {
    /** Throws an exception if CHOLMOD reports a lack of memory. */
    void check_memory(const cholmod_common &common)
    {
      if (common.status == CHOLMOD_OUT_OF_MEMORY)
        throw std::bad_alloc();
      if (common.status == CHOLMOD_TOO_LARGE)
        throw FactorTooLarge();
    }

    /** Matrix of CHOLMOD with automatic release of its memory. */
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
    /** Assembles the lower triangle of the operator A in the matrix @p A. */
    void fill(const Structure &structure, const Body &body, const StepOperator &step, const Unknowns &springs,
              cholmod_sparse *A)
    {
      const BlockSparseMatrix &K = body.stiffness;
      const unsigned int       n = 3 * K.n_rows();
      int                     *p = static_cast<int *>(A->p), *index = static_cast<int *>(A->i);
      double                  *x = static_cast<double *>(A->x);
      int                      k = 0;
      BlockSparseMatrix        damped; // on the pattern of K, which has further blocks with rock or water
      if (step.damped != 0.)
      {
        std::vector<std::vector<unsigned int>> columns;
        for (unsigned int row = 0; row < K.n_rows(); ++row)
          columns.emplace_back(K.column.begin() + K.start[row], K.column.begin() + K.start[row + 1]);
        damped = body.damped;
        damped.extend(std::move(columns));
      }
      // The matrix is symmetric: rows of the upper part of K are columns of the lower part.
      for (unsigned int row = 0; row < K.n_rows(); ++row)
        for (unsigned int i = 0; i < 3; ++i)
        {
          p[3 * row + i] = k;
          for (std::size_t e = K.start[row]; e < K.start[row + 1]; ++e)
            for (unsigned int j = 0; j < 3; ++j)
              if (3 * K.column[e] + j >= 3 * row + i)
              {
                double            a = step.stiffness * K.value[e][3 * i + j];
                const std::size_t node = body.first_node + row;
                if (step.damped != 0.)
                  a += step.damped * damped.value[e][3 * i + j];
                if (!body.reaction.empty())
                  a += step.reaction * body.reaction[e][3 * i + j];
                if (K.column[e] == row)
                  a += (step.mass + step.proximal) * structure.mass[node][3 * i + j];
                if (K.column[e] == row && i == j && !springs.empty())
                  a += springs[3 * node + i];
                index[k] = 3 * K.column[e] + j;
                x[k++] = a;
              }
        }
      p[n] = k;
    }

    /** Returns a fill-reducing order with the interface last: minimum degree, or nested dissection. */
    std::vector<int> order(cholmod_sparse *A, const std::vector<bool> &is_interface, const bool dissect,
                           cholmod_common &common)
    {
      std::vector<int> group(is_interface.begin(), is_interface.end()), permutation(is_interface.size());
      if (dissect && cholmod_metis(A, nullptr, 0, 1, permutation.data(), &common) != 0)
        std::stable_partition(permutation.begin(), permutation.end(),
                              [&](const int i) { return !is_interface[i]; });
      else
        cholmod_camd(A, nullptr, 0, group.data(), permutation.data(), &common);
      check_memory(common);
      return permutation;
    }

    /** Returns the symbolic factor in this order. */
    cholmod_factor *interface_last(cholmod_sparse *A, const std::vector<bool> &is_interface,
                                   const bool dissect, cholmod_common &common)
    {
      std::vector<int> permutation = order(A, is_interface, dissect, common);
      common.nmethods = 1;
      common.method[0].ordering = CHOLMOD_GIVEN;
      cholmod_factor *L = cholmod_analyze_p(A, permutation.data(), nullptr, 0, &common);
      check_memory(common);
      return L;
    }

    /** Chooses the order of elimination of @p A: interface last, or any order if @p is_interface is empty. */
    cholmod_factor *analysed(cholmod_sparse *A, const std::size_t n_unknowns,
                             const std::vector<bool> &is_interface, cholmod_common &common)
    {
      constexpr std::size_t large = 20000; // METIS is tried above this size
      common.supernodal = CHOLMOD_SUPERNODAL;
      common.postorder = is_interface.empty(); // it could move parts of an interface
      if (is_interface.empty())
      {
        common.nmethods = n_unknowns < large ? 1 : 0; // 0: chosen by CHOLMOD
        common.method[0].ordering = n_unknowns < large ? CHOLMOD_AMD : CHOLMOD_GIVEN;
        return cholmod_analyze(A, &common);
      }
      cholmod_factor *L = interface_last(A, is_interface, false, common);
      if (n_unknowns < large)
        return L;
      const double    work = common.fl;
      cholmod_factor *dissected = interface_last(A, is_interface, true, common);
      if (common.fl < work)
        std::swap(L, dissected);
      cholmod_free_factor(&dissected, &common);
      return L;
    }

    /** Returns the number of entries in the first @p n_columns columns of a supernodal factor. */
    double entries_of(const cholmod_factor *L, const std::size_t n_columns)
    {
      const int *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi);
      double     sum = 0.;
      for (std::size_t s = 0; s < L->nsuper && static_cast<std::size_t>(super[s]) < n_columns; ++s)
      {
        const double rows = pi[s + 1] - pi[s],
                     columns = std::min<std::size_t>(super[s + 1], n_columns) - super[s];
        sum += columns * (rows - .5 * (columns - 1.));
      }
      return sum;
    }

    /** Switches off the threads of CHOLMOD. It starts four threads for every supernode, also if the program
     * has one thread or one body. Starting them costs more than they save. */
    class NoThreads
    {
    public:
      NoThreads() : levels(omp_in_parallel() ? -1 : omp_get_max_active_levels())
      {
        if (levels >= 0)
          omp_set_max_active_levels(0);
      }
      ~NoThreads()
      {
        if (levels >= 0)
          omp_set_max_active_levels(levels);
      }
      NoThreads(const NoThreads &) = delete;
      NoThreads &operator=(const NoThreads &) = delete;

    private:
      const int levels; ///< previous number of levels; -1: unchanged
    };
  } // namespace

  struct BodyFactor::Cholmod : CholmodObjects
  {
  };

  BodyFactor::BodyFactor(const Structure &structure, const Body &body, const StepOperator &step,
                         const Unknowns &springs)
      : body(body), cholmod(std::make_unique<Cholmod>())
  {
    assert(body.first_node + body.n_nodes() < structure.n_nodes() + 1);
    cholmod->A = cholmod_allocate_sparse(n(), n(), 9 * body.stiffness.value.size() / 2 + 3 * n(), 1, 1, -1,
                                         CHOLMOD_REAL, &cholmod->common);
    check_memory(cholmod->common);
    fill(structure, body, step, springs, cholmod->A);
  }

  BodyFactor::~BodyFactor() = default;

  void BodyFactor::analyse(const Order which)
  {
    order = which;
    std::vector<bool> is_interface;
    if (order == Order::interface_last)
    {
      is_interface.assign(n(), false);
      for (const unsigned int node : body.interface)
        for (unsigned int c = 0; c < 3; ++c)
          is_interface[3 * node + c] = true;
    }
    cholmod_free_factor(&cholmod->L, &cholmod->common);
    try
    {
      cholmod->L = analysed(cholmod->A, n(), is_interface, cholmod->common);
      check_memory(cholmod->common);
    }
    catch (const FactorTooLarge &)
    {
      throw FactorTooLarge("The factor of " + body.name() + " (" + std::to_string(n()) + " unknowns)");
    }
  }

  void BodyFactor::factorise()
  {
    const NoThreads threads;
    cholmod_factorize(cholmod->A, cholmod->L, &cholmod->common);
    check_memory(cholmod->common);
    const cholmod_factor *L = cholmod->L;
    if (cholmod->common.status != CHOLMOD_OK || L == nullptr || L->minor < L->n)
      throw ComputationError(
          "The stiffness of " + body.name() +
          " is not positive definite. Either its nodes on the surface \"base\" do not hold it: at least three "
          "that are not on a line are needed. Or its elements are distorted; `voussoir mesh` prints their "
          "quality.");
  }

  double BodyFactor::n_entries() const
  {
    return entries_of(cholmod->L, order == Order::interface_last ? n() - n_interface() : n());
  }

  std::unique_ptr<PackedFactor> BodyFactor::take_leading_columns(const bool single)
  {
    return std::make_unique<PackedFactor>(cholmod->L,
                                          order == Order::interface_last ? n() - n_interface() : n(), single);
  }

  std::vector<unsigned int> BodyFactor::permutation() const
  {
    const int *p = static_cast<const int *>(cholmod->L->Perm);
    return {p, p + n()};
  }

  /** Returns L_GG from the supernodes, by column. */
  std::vector<double> BodyFactor::trailing_block() const
  {
    const cholmod_factor *L = cholmod->L;
    const unsigned int    m = n_interface(), first = n() - m;
    std::vector<double>   dense(std::size_t(m) * m, 0.);
    const int            *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi),
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
    return dense;
  }

  /** Returns a symmetric matrix in natural order. @p S: its lower triangle in the order of the factor. */
  std::vector<double> BodyFactor::in_natural_order(const std::vector<double> &S) const
  {
    const unsigned int              m = n_interface();
    const std::vector<unsigned int> unknown = permutation();
    std::vector<unsigned int>       place(m); // position of each row in natural order
    for (unsigned int i = 0; i < m; ++i)
    {
      const unsigned int k = unknown[n() - m + i];
      const auto         at = std::lower_bound(body.interface.begin(), body.interface.end(), k / 3);
      place[i] = 3 * (at - body.interface.begin()) + k % 3;
    }
    std::vector<double> result(S.size());
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = j; i < m; ++i)
        result[std::size_t(place[j]) * m + place[i]] = result[std::size_t(place[i]) * m + place[j]] =
            S[j * m + i];
    return result;
  }

  std::vector<double> BodyFactor::condensed_stiffness() const
  {
    std::vector<double> S;
    {
      const std::vector<double> L = trailing_block();
      const int                 m = n_interface();
      const double              one = 1., zero = 0.;
      S.resize(L.size());
      if (m > 0)
        dsyrk_("L", "N", &m, &m, &one, L.data(), &m, &zero, S.data(), &m);
    }
    return in_natural_order(S);
  }

  std::vector<double> BodyFactor::flexibility() const
  {
    std::vector<double> S = trailing_block();
    const int           m = n_interface();
    int                 info = 0;
    if (m > 0)
      dpotri_("L", &m, S.data(), &m, &info);
    return in_natural_order(S);
  }

  bool prefer_free_order(const double free, const double leading, const double n_interface)
  {
    return 4. * free < 2. * leading + n_interface * n_interface;
  }

  namespace
  {
    /** Returns the number of entries of the factor of a graph. */
    double fill_in(cholmod_sparse *A, const std::vector<bool> &is_interface, cholmod_common &common)
    {
      cholmod_factor *L = analysed(A, 3 * A->nrow, is_interface, common);
      check_memory(common);
      const double entries = entries_of(L, L->n);
      cholmod_free_factor(&L, &common);
      return entries;
    }

    /** Returns the lower triangle of the matrix of a graph. */
    cholmod_sparse *matrix_of(const std::vector<std::vector<unsigned int>> &neighbours,
                              cholmod_common                               &common)
    {
      std::size_t n_entries = 0;
      for (const auto &row : neighbours)
        n_entries += row.size();
      const std::size_t n = neighbours.size();
      cholmod_sparse   *A = cholmod_allocate_sparse(n, n, n_entries, 1, 1, -1, CHOLMOD_PATTERN, &common);
      check_memory(common);
      int        *p = static_cast<int *>(A->p), *index = static_cast<int *>(A->i);
      std::size_t k = 0;
      for (std::size_t row = 0; row < n; ++row)
      {
        p[row] = k;
        for (const unsigned int column : neighbours[row])
          if (column >= row)
            index[k++] = column;
      }
      p[n] = k;
      return A;
    }
  } // namespace

  FactorSize factor_size(const std::vector<std::vector<unsigned int>> &neighbours,
                         const std::vector<bool> &is_interface, const bool single)
  {
    const double   entry = single ? .5 : 1.;
    cholmod_common common;
    cholmod_start(&common);
    common.print = 0;
    cholmod_sparse *A = matrix_of(neighbours, common);
    const double    m = std::count(is_interface.begin(), is_interface.end(), true);
    FactorSize      size;
    size.entries = 9. * entry * fill_in(A, {}, common); // 3x3 values per entry
    if (m > 0.)
    {
      size.leading = 9. * entry * (fill_in(A, is_interface, common) - .5 * m * (m + 1.));
      size.interface = 9. * m * m;
      if (!prefer_free_order(size.entries, size.leading, 3. * m))
      {
        size.entries = size.leading;
        size.kept = size.interface;
      }
    }
    cholmod_free_sparse(&A, &common);
    cholmod_finish(&common);
    return size;
  }
} // namespace Voussoir
