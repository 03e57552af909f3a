// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <voussoir/base/error.h>
#include <voussoir/foundation/coarse_rock.h>

#include <cmath>
#include <cstdlib>

namespace Voussoir
{
  namespace
  {
    /** MPI for this process alone: Trilinos' ML does not work without. */
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
        // Open MPI need not look for networks, which takes longer than many a static state.
        for (const auto &[name, value] : {std::make_pair("OMPI_MCA_pml", "ob1"),
                                          {"OMPI_MCA_btl", "self"},
                                          {"OMPI_MCA_osc", "^ucx"},
                                          {"OMPI_MCA_ess_singleton_isolated", "1"}})
          if (std::getenv(name) == nullptr)
          {
            setenv(name, value, 0);
            names.push_back(name);
          }
        MPI_Init(nullptr, nullptr);
        for (const char *name : names) // programs that are started later know nothing of this
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

    /** With a trace on the diagonal for motions that an aggregate has not: rotations of one or two nodes. */
    dealii::TrilinosWrappers::SparseMatrix matrix_of(const std::vector<CoarseBlock> &blocks,
                                                     const unsigned int              n_aggregates)
    {
      constexpr double          trace = 1e-10;
      double                    largest = 0.;
      std::vector<unsigned int> length(6 * n_aggregates, 0);
      for (const CoarseBlock &block : blocks)
        for (unsigned int k = 0; k < 6; ++k)
        {
          length[6 * static_cast<unsigned int>(block.row) + k] += 6;
          largest = std::max(largest, block.row == block.column ? block.value[7 * k] : 0.);
        }
      dealii::TrilinosWrappers::SparseMatrix matrix(dealii::complete_index_set(length.size()), MPI_COMM_SELF,
                                                    length);
      for (const CoarseBlock &block : blocks)
      {
        std::array<dealii::types::global_dof_index, 6> columns;
        for (unsigned int k = 0; k < 6; ++k)
          columns[k] = 6 * static_cast<unsigned int>(block.column) + k;
        for (unsigned int k = 0; k < 6; ++k)
        {
          std::array<double, 6> values;
          std::copy_n(block.value.begin() + 6 * k, 6, values.begin());
          values[k] += block.row == block.column ? trace * largest : 0.;
          matrix.set(6 * static_cast<unsigned int>(block.row) + k, 6, columns.data(), values.data());
        }
      }
      matrix.compress(dealii::VectorOperation::insert);
      return matrix;
    }

    /** Those that deal.II gives to ML for elliptic equations, and the @p modes. */
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
  } // namespace

  struct CoarseRock::Multigrid
  {
    explicit Multigrid(dealii::TrilinosWrappers::SparseMatrix &&matrix) : matrix(std::move(matrix)) {}

    dealii::TrilinosWrappers::SparseMatrix    matrix;
    dealii::TrilinosWrappers::PreconditionAMG levels;
  };

  CoarseRock::CoarseRock(const RockAggregates &aggregates, std::vector<CoarseBlock> &&stiffness)
  {
    static LoneProcess mpi;
    multigrid = std::make_unique<Multigrid>(matrix_of(stiffness, aggregates.n()));
    std::vector<CoarseBlock>().swap(stiffness); // its memory
    std::vector<double> modes;                  // deal.II's own take ones and zeros only
    for (unsigned int mode = 0; mode < 6; ++mode)
      for (const RigidMotion &motion : aggregates.rigid(mode))
        modes.insert(modes.end(), motion.begin(), motion.end());
    try
    {
      multigrid->levels.initialize(multigrid->matrix, level_parameters(modes));
    }
    catch (const dealii::ExceptionBase &)
    {
      throw ComputationError("The multigrid levels for the static state of the rock cannot be made: its "
                             "elements may be badly shaped (see voussoir mesh).");
    }
  }

  CoarseRock::~CoarseRock() = default;

  void CoarseRock::solve(const std::vector<double> &forces, std::vector<double> &motions) const
  {
    dealii::Vector<double>       x(forces.size());
    const dealii::Vector<double> b(forces.begin(), forces.end());
    multigrid->levels.vmult(x, b);
    motions.assign(x.begin(), x.end());
  }
} // namespace Voussoir
