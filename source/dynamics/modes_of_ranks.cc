// SPDX-License-Identifier: GPL-3.0-or-later
// natural_modes() by several ranks.
#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#include <deal.II/lac/slepc_solver.h>
#include <deal.II/lac/slepc_spectral_transformation.h>

#include <voussoir/base/error.h>
#include <voussoir/dynamics/modes.h>

#include <cmath>
#include <exception>
#include <slepcsys.h>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** SLEPc while it lives; MPI is there. */
    class Slepc
    {
    public:
      Slepc()
      {
        SlepcInitializeNoArguments();
        PetscPopSignalHandler();                                 // the program has its own
        PetscPushErrorHandler(PetscReturnErrorHandler, nullptr); // and its own words
        PetscOptionsSetValue(nullptr, "-st_pc_type", "cholesky");
        PetscOptionsSetValue(nullptr, "-st_pc_factor_mat_solver_type", "mumps");
      }
      ~Slepc()
      {
        if (std::uncaught_exceptions() == n_exceptions) // else the others may wait elsewhere
          SlepcFinalize();
      }
      Slepc(const Slepc &) = delete;

    private:
      const int n_exceptions = std::uncaught_exceptions();
    };

    /** Nodes of each rank: about the same number of blocks of the stiffness. */
    std::vector<std::size_t> shares_of_nodes(const Structure &structure)
    {
      std::vector<double> work;
      for (const Body &body : structure.bodies)
        for (unsigned int i = 0; i < body.n_nodes(); ++i)
          work.push_back(double(body.stiffness.start[i + 1] - body.stiffness.start[i]));
      std::vector<unsigned int> number(structure.n_nodes() + 1);
      for (unsigned int i = 0; i <= structure.n_nodes(); ++i)
        number[i] = i;
      return Shares(work).parts(number);
    }

    /** Rows from @p begin to @p end of a matrix whose blocks @p each visits by node, column and block. */
    template <class Each>
    void fill(PETScWrappers::MPI::SparseMatrix &matrix, const unsigned int n, const IndexSet &owned,
              const Each &each)
    {
      DynamicSparsityPattern pattern(3 * n, 3 * n, owned);
      each(
          [&](const unsigned int i, const unsigned int j, const Matrix3 &)
          {
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                pattern.add(3 * i + c, 3 * j + d);
          });
      matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
      each(
          [&](const unsigned int i, const unsigned int j, const Matrix3 &block)
          {
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                matrix.set(3 * i + c, 3 * j + d, block[3 * c + d]);
          });
      matrix.compress(VectorOperation::insert);
      MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE);
    }

    std::vector<NaturalMode> solve(const Structure &structure, const unsigned int n_modes)
    {
      const unsigned int             n = structure.n_nodes();
      const std::vector<std::size_t> parts = shares_of_nodes(structure);
      const unsigned int             begin = parts[Ranks::rank()], end = parts[Ranks::rank() + 1];
      IndexSet                       owned(3 * n);
      owned.add_range(3 * begin, 3 * end);
      PETScWrappers::MPI::SparseMatrix K, M;
      fill(K, n, owned,
           [&](const auto &visit)
           {
             for (const Body &body : structure.bodies)
               for (unsigned int i = 0; i < body.n_nodes(); ++i)
                 if (const unsigned int node = body.first_node + i; node >= begin && node < end)
                   for (std::size_t k = body.stiffness.start[i]; k < body.stiffness.start[i + 1]; ++k)
                     visit(node, body.first_node + body.stiffness.column[k], body.stiffness.value[k]);
           });
      fill(M, n, owned,
           [&](const auto &visit)
           {
             for (unsigned int i = begin; i < end; ++i)
               visit(i, i, structure.mass[i]);
           });

      SolverControl                                            control(1000, 1e-10);
      SLEPcWrappers::SolverKrylovSchur                         solver(control, MPI_COMM_WORLD);
      SLEPcWrappers::TransformationShiftInvert::AdditionalData at_zero(0.);
      SLEPcWrappers::TransformationShiftInvert                 inverse(MPI_COMM_WORLD, at_zero);
      solver.set_problem_type(EPS_GHEP);
      solver.set_transformation(inverse);
      solver.set_target_eigenvalue(0.);
      solver.set_which_eigenpairs(EPS_TARGET_MAGNITUDE);
      std::vector<double>                     eigenvalues(n_modes);
      std::vector<PETScWrappers::MPI::Vector> shapes(n_modes,
                                                     PETScWrappers::MPI::Vector(owned, MPI_COMM_WORLD));
      solver.solve(K, M, eigenvalues, shapes, n_modes);

      std::vector<std::size_t> entries;
      for (const std::size_t part : parts)
        entries.push_back(3 * part);
      std::vector<NaturalMode> modes;
      for (unsigned int k = 0; k < n_modes; ++k)
      {
        Unknowns shape(3 * std::size_t(n));
        for (unsigned int i = 3 * begin; i < 3 * end; ++i)
          shape[i] = shapes[k](i);
        Ranks::gather(shape.data(), entries);
        modes.push_back({std::sqrt(eigenvalues[k]) / (2. * 3.14159265358979323846), std::move(shape)});
      }
      return modes;
    }
  } // namespace

  std::vector<NaturalMode> modes_of_ranks(const Structure &structure, const unsigned int n_modes)
  {
    const Slepc slepc;
    try
    {
      return solve(structure, n_modes);
    }
    catch (const ExceptionBase &)
    {
      throw ComputationError("The natural frequencies did not converge: is the dam held by its base?");
    }
  }
} // namespace Voussoir
