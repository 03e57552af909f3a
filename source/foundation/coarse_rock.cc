// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/cholmod_objects.h>
#include <voussoir/base/error.h>
#include <voussoir/foundation/coarse_rock.h>

#include <algorithm>
#include <new>

namespace Voussoir
{
  namespace
  {
    struct Cholmod : CholmodObjects
    {
      explicit Cholmod(const unsigned int n) : n(n)
      {
        common.supernodal = CHOLMOD_SUPERNODAL; // L L^T, which an indefinite matrix does not have
      }

      void check_memory() const
      {
        if (common.status == CHOLMOD_OUT_OF_MEMORY)
          throw std::bad_alloc();
        if (common.status == CHOLMOD_TOO_LARGE)
          throw ComputationError(
              "The rock is too large for a build without Trilinos (static solution, " + std::to_string(n) +
              " coarse unknowns). Use larger rock elements, or build with -DVOUSSOIR_WITH_TRILINOS=ON.");
      }

      const unsigned int n; ///< number of unknowns
    };

    class DirectCoarseRock : public CoarseRock
    {
    public:
      DirectCoarseRock(std::vector<CoarseBlock> &&stiffness, const unsigned int n) : cholmod(n)
      {
        cholmod.A = lower_part(stiffness, n);
        std::vector<CoarseBlock>().swap(stiffness); // releases the memory
        cholmod.L = cholmod_analyze(cholmod.A, &cholmod.common);
        cholmod.check_memory();
        cholmod_factorize(cholmod.A, cholmod.L, &cholmod.common);
        cholmod.check_memory();
        cholmod_free_sparse(&cholmod.A, &cholmod.common);
        if (cholmod.common.status < CHOLMOD_OK || cholmod.L->minor < n)
          throw ComputationError(
              "The coarse problem of the static solution of the rock is not positive definite. "
              "Improve distorted rock elements; `voussoir mesh` prints their quality.");
      }

      void solve(const std::vector<double> &forces, std::vector<double> &motions) const override
      {
        std::vector<double> copy = forces;
        cholmod_dense       b{};
        b.nrow = b.d = b.nzmax = forces.size();
        b.ncol = 1;
        b.x = copy.data();
        b.xtype = CHOLMOD_REAL;
        b.dtype = CHOLMOD_DOUBLE;
        cholmod_dense *x = cholmod_solve(CHOLMOD_A, cholmod.L, &b, &cholmod.common);
        cholmod.check_memory();
        if (!x)
          throw ComputationError("The static solution of the rock failed (CHOLMOD, " +
                                 std::to_string(cholmod.n) +
                                 " coarse unknowns). Look for distorted or unconnected rock elements with "
                                 "`voussoir mesh`. If there are none, report the failure with scene.prm.");
        const double *values = static_cast<double *>(x->x);
        motions.assign(values, values + forces.size());
        cholmod_free_dense(&x, &cholmod.common);
      }

    private:
      /** Returns the lower triangle of the n x n matrix of the blocks @p stiffness. */
      cholmod_sparse *lower_part(const std::vector<CoarseBlock> &stiffness, const unsigned int n) const
      {
        std::size_t n_entries = 0;
        for (const CoarseBlock &block : stiffness)
          n_entries += block.row >= block.column ? 36 : 0;
        cholmod_triplet *lower = cholmod_allocate_triplet(n, n, n_entries, -1, CHOLMOD_REAL, &cholmod.common);
        cholmod.check_memory();
        const double shift = coarse_shift(stiffness);
        for (const CoarseBlock &block : stiffness)
          for (unsigned int k = 0; k < 36; ++k)
            if (const unsigned int i = 6 * block.row + k / 6, j = 6 * block.column + k % 6; i >= j)
            {
              static_cast<int *>(lower->i)[lower->nnz] = static_cast<int>(i);
              static_cast<int *>(lower->j)[lower->nnz] = static_cast<int>(j);
              static_cast<double *>(lower->x)[lower->nnz++] = block.value[k] + (i == j ? shift : 0.);
            }
        cholmod_sparse *result = cholmod_triplet_to_sparse(lower, lower->nnz, &cholmod.common);
        cholmod_free_triplet(&lower, &cholmod.common);
        cholmod.check_memory();
        return result;
      }

      Cholmod cholmod;
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
    return std::make_unique<DirectCoarseRock>(std::move(stiffness), 6 * aggregates.n());
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

  double strong_coupling()
  {
#ifdef VOUSSOIR_WITH_TRILINOS
    return 5e-4; // measured: benchmarks/README.md, set-up
#else
    return 1e-8; // the factors of CHOLMOD are smaller than with 5e-4
#endif
  }
} // namespace Voussoir
