// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/coarse_rock.h>

#include <cholmod.h>

#include <new>

namespace Voussoir
{
  namespace
  {
    class DirectCoarseRock : public CoarseRock
    {
    public:
      DirectCoarseRock(const std::vector<CoarseBlock> &stiffness, const unsigned int n)
      {
        cholmod_start(&common);
        common.print = 0;
        std::size_t n_entries = 0;
        for (const CoarseBlock &block : stiffness)
          n_entries += block.row >= block.column ? 36 : 0;
        cholmod_triplet *lower = cholmod_allocate_triplet(n, n, n_entries, -1, CHOLMOD_REAL, &common);
        check_memory();
        const double shift = coarse_shift(stiffness);
        for (const CoarseBlock &block : stiffness)
          for (unsigned int k = 0; k < 36; ++k)
            if (const unsigned int i = 6 * block.row + k / 6, j = 6 * block.column + k % 6; i >= j)
            {
              static_cast<int *>(lower->i)[lower->nnz] = static_cast<int>(i);
              static_cast<int *>(lower->j)[lower->nnz] = static_cast<int>(j);
              static_cast<double *>(lower->x)[lower->nnz++] = block.value[k] + (i == j ? shift : 0.);
            }
        cholmod_sparse *A = cholmod_triplet_to_sparse(lower, lower->nnz, &common);
        cholmod_free_triplet(&lower, &common);
        check_memory();
        factor = cholmod_analyze(A, &common);
        cholmod_factorize(A, factor, &common);
        cholmod_free_sparse(&A, &common);
        check_memory();
        if (common.status != CHOLMOD_OK || factor->minor < n)
          throw ComputationError(
              "The coarse problem of the static solution of the rock is not positive definite. "
              "The elements of the rock may be distorted. Check the mesh with voussoir mesh.");
      }

      ~DirectCoarseRock() override
      {
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
      }

      DirectCoarseRock(const DirectCoarseRock &) = delete;

      void solve(const std::vector<double> &forces, std::vector<double> &motions) const override
      {
        cholmod_dense *b = cholmod_allocate_dense(forces.size(), 1, forces.size(), CHOLMOD_REAL, &common);
        check_memory();
        std::copy(forces.begin(), forces.end(), static_cast<double *>(b->x));
        cholmod_dense *x = cholmod_solve(CHOLMOD_A, factor, b, &common);
        cholmod_free_dense(&b, &common);
        check_memory();
        const double *values = static_cast<double *>(x->x);
        motions.assign(values, values + forces.size());
        cholmod_free_dense(&x, &common);
      }

    private:
      void check_memory() const
      {
        if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
          throw std::bad_alloc();
      }

      mutable cholmod_common common;
      cholmod_factor        *factor = nullptr;
    };
  } // namespace

  float coarse_shift(const std::vector<CoarseBlock> &stiffness)
  {
    float largest = 0.f;
    for (const CoarseBlock &block : stiffness)
      for (unsigned int k = 0; k < 6 && block.row == block.column; ++k)
        largest = std::max(largest, block.value[7 * k]);
    return 1e-6f * largest;
  }

  std::unique_ptr<CoarseRock> make_direct_coarse_rock(const RockAggregates      &aggregates,
                                                      std::vector<CoarseBlock> &&stiffness)
  {
    return std::make_unique<DirectCoarseRock>(stiffness, 6 * aggregates.n());
  }

  std::unique_ptr<CoarseRock> make_coarse_rock(const RockAggregates      &aggregates,
                                               std::vector<CoarseBlock> &&stiffness)
  {
#ifdef VOUSSOIR_WITH_TRILINOS
    return make_multigrid_coarse_rock(aggregates, std::move(stiffness));
#else
    return make_direct_coarse_rock(aggregates, std::move(stiffness));
#endif
  }
} // namespace Voussoir
