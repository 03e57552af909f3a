// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>
#ifdef VOUSSOIR_WITH_TRILINOS

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wcpp" // Trilinos 16 announces the removal of ML and Epetra
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/vector.h>

#include <Epetra_BasicRowMatrix.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#pragma GCC diagnostic pop
#include <voussoir/base/error.h>
#include <voussoir/base/reason.h>
#include <voussoir/foundation/coarse_rock.h>

#include <cstdlib>

namespace Voussoir
{
  namespace
  {
    /** MPI for this process only, as Trilinos' ML requires MPI. Finalised at the end of the program. */
    class LoneProcess
    {
    public:
      LoneProcess()
      {
        int there = 0;
        MPI_Initialized(&there);
        if (there != 0)
          return;
        std::vector<const char *> names;
        // Open MPI must not search for networks, which may take longer than the static solution.
        const std::pair<const char *, const char *> settings[] = {{"OMPI_MCA_pml", "ob1"},
                                                                  {"OMPI_MCA_btl", "self"},
                                                                  {"OMPI_MCA_osc", "^ucx"},
                                                                  {"OMPI_MCA_ess_singleton_isolated", "1"}};
        for (const auto &[name, value] : settings)
          if (std::getenv(name) == nullptr)
          {
            setenv(name, value, 0);
            names.push_back(name);
          }
        MPI_Init(nullptr, nullptr);
        for (const char *name : names) // not for child processes
          unsetenv(name);
        started = true;
      }

      ~LoneProcess()
      {
        int over = 0;
        MPI_Finalized(&over);
        if (started && over == 0)
          MPI_Finalize();
      }

    private:
      bool started = false;
    };

    /** Stiffness matrix of the aggregates with the interface of ML, without a copy of the blocks. */
    class BlockRows : public Epetra_BasicRowMatrix
    {
    public:
      /** @p given: blocks, contiguous for each row, with the rows in any order. */
      BlockRows(std::vector<CoarseBlock> &&given, const unsigned int n_aggregates)
          : Epetra_BasicRowMatrix(Epetra_MpiComm(MPI_COMM_SELF)), blocks(std::move(given)),
            row(n_aggregates, {0, 0})
      {
        const Epetra_Map map(static_cast<int>(6 * n_aggregates), 0, Epetra_MpiComm(MPI_COMM_SELF));
        SetMaps(map, map);
        const float shift = coarse_shift(blocks);
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          auto &[begin, end] = row[blocks[b].row];
          begin = begin == end ? b : begin;
          end = b + 1;
          for (unsigned int k = 0; k < 6 && blocks[b].row == blocks[b].column; ++k)
            blocks[b].value[7 * k] += shift;
        }
      }

      int NumMyRowEntries(const int i, int &n) const override
      {
        n = 6 * static_cast<int>(row[i / 6].second - row[i / 6].first);
        return 0;
      }

      int MaxNumEntries() const override
      {
        std::size_t most = 0;
        for (const auto &[begin, end] : row)
          most = std::max(most, end - begin);
        return 6 * static_cast<int>(most);
      }

      int ExtractMyRowCopy(const int i, const int length, int &n, double *values, int *columns) const override
      {
        NumMyRowEntries(i, n);
        if (length < n)
          return -1;
        for (std::size_t b = row[i / 6].first; b < row[i / 6].second; ++b)
          for (unsigned int k = 0; k < 6; ++k)
          {
            *values++ = blocks[b].value[6 * (i % 6) + k];
            *columns++ = static_cast<int>(6 * blocks[b].column + k);
          }
        return 0;
      }

      int Multiply(const bool transposed, const Epetra_MultiVector &x, Epetra_MultiVector &y) const override
      {
        AssertThrow(!transposed, dealii::ExcNotImplemented()); // symmetric matrix
        for (int v = 0; v < x.NumVectors(); ++v)
#pragma omp parallel for schedule(static)
          for (std::size_t a = 0; a < row.size(); ++a)
          {
            std::array<double, 6> sum{};
            for (std::size_t b = row[a].first; b < row[a].second; ++b)
              for (unsigned int c = 0; c < 6; ++c)
                for (unsigned int k = 0; k < 6; ++k)
                  sum[c] += double(blocks[b].value[6 * c + k]) * x[v][6 * blocks[b].column + k];
            std::copy(sum.begin(), sum.end(), y[v] + 6 * a);
          }
        return 0;
      }

      int ExtractDiagonalCopy(Epetra_Vector &diagonal) const override
      {
        for (const CoarseBlock &block : blocks)
          for (unsigned int k = 0; k < 6 && block.row == block.column; ++k)
            diagonal[6 * block.row + k] = block.value[7 * k];
        return 0;
      }

      /** Not implemented: views require double precision. @{ */
      int ExtractMyEntryView(int, double *&, int &, int &) override
      {
        return no_view();
      }
      int ExtractMyEntryView(int, const double *&, int &, int &) const override
      {
        return no_view();
      }
      /** @} */

    private:
      static int no_view()
      {
        AssertThrow(false, dealii::ExcNotImplemented());
        return -1;
      }

      std::vector<CoarseBlock>                         blocks;
      std::vector<std::pair<std::size_t, std::size_t>> row; ///< first block, and end
    };

    /** Returns the parameters that deal.II sets for elliptic equations, with the rigid body @p modes. */
    Teuchos::ParameterList level_parameters(std::vector<double> &modes)
    {
      Teuchos::ParameterList parameters;
      ML_Epetra::SetDefaults("SA", parameters);
      parameters.set("ML output", 0);
      parameters.set("PDE equations", 6);
      parameters.set("null space: type", "pre-computed");
      parameters.set("null space: dimension", 6);
      parameters.set("null space: vectors", modes.data());
      parameters.set("aggregation: type", "Uncoupled");
      parameters.set("aggregation: threshold", 1e-4);
      parameters.set("smoother: type", "Chebyshev");
      parameters.set("smoother: sweeps", 2);
      parameters.set("smoother: Chebyshev alpha", 10.);
      parameters.set("coarse: type", "Amesos-KLU");
      parameters.set("coarse: max size", 2000);
      return parameters;
    }

    class MultigridCoarseRock : public CoarseRock
    {
    public:
      MultigridCoarseRock(const RockAggregates &aggregates, std::vector<CoarseBlock> &&stiffness)
          : matrix(std::move(stiffness), aggregates.n())
      {
        std::vector<double> modes; // those of deal.II have the values 0 and 1 only
        for (unsigned int mode = 0; mode < 6; ++mode)
          for (const RigidMotion &motion : aggregates.rigid(mode))
            modes.insert(modes.end(), motion.begin(), motion.end());
        try
        {
          levels.initialize(matrix, level_parameters(modes));
        }
        catch (const dealii::ExceptionBase &error)
        {
          throw ComputationError(
              "The static solution of the rock failed before its first iteration (multigrid of Trilinos: " +
              reason(error) +
              "). Look for distorted or unconnected rock elements with `voussoir mesh`. If there are none, report "
              "the failure with scene.prm.");
        }
      }

      void solve(const std::vector<double> &forces, std::vector<double> &motions) const override
      {
        dealii::Vector<double>       x(forces.size());
        const dealii::Vector<double> b(forces.begin(), forces.end());
        levels.vmult(x, b);
        motions.assign(x.begin(), x.end());
      }

    private:
      BlockRows                                 matrix;
      dealii::TrilinosWrappers::PreconditionAMG levels;
    };
  } // namespace

  std::unique_ptr<CoarseRock> make_multigrid_coarse_rock(const RockAggregates      &aggregates,
                                                         std::vector<CoarseBlock> &&stiffness)
  {
    static LoneProcess mpi;
    return std::make_unique<MultigridCoarseRock>(aggregates, std::move(stiffness));
  }
} // namespace Voussoir

#endif
