// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/index_set.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>
#include <voussoir/foundation/rock_statics.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace Voussoir
{
  namespace
  {
    using Vector = dealii::Vector<double>;

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

    /** The stiffness of the free nodes; what is nothing but round-off is left out. */
    dealii::TrilinosWrappers::SparseMatrix reduced(const BlockSparseMatrix         &K,
                                                   const std::vector<unsigned int> &free_node)
    {
      constexpr double          nothing = 1e-15;
      constexpr unsigned int    held = static_cast<unsigned int>(-1);
      const unsigned int        n = 3 * free_node.size();
      std::vector<unsigned int> number(K.n_rows(), held), length;
      std::vector<double>       diagonal(3 * std::size_t(K.n_rows()));
      for (unsigned int i = 0; i < free_node.size(); ++i)
        number[free_node[i]] = i;
      for (unsigned int row = 0; row < K.n_rows(); ++row)
        for (std::size_t k = K.start[row]; k < K.start[row + 1]; ++k)
          for (unsigned int c = 0; K.column[k] == row && c < 3; ++c)
            diagonal[3 * row + c] = std::sqrt(std::abs(K.value[k][4 * c]));
      std::vector<dealii::types::global_dof_index> columns;
      std::vector<double>                          values;
      const auto                                   gather = [&](const unsigned int i, const unsigned int c)
      {
        columns.clear();
        values.clear();
        const unsigned int row = free_node[i];
        for (std::size_t k = K.start[row]; k < K.start[row + 1]; ++k)
          for (unsigned int d = 0; number[K.column[k]] != held && d < 3; ++d)
            if (const double a = K.value[k][3 * c + d];
                std::abs(a) > nothing * diagonal[3 * row + c] * diagonal[3 * K.column[k] + d])
            {
              columns.push_back(3 * number[K.column[k]] + d);
              values.push_back(a);
            }
      };
      for (unsigned int k = 0; k < n; ++k)
      {
        gather(k / 3, k % 3);
        length.push_back(columns.size());
      }
      dealii::TrilinosWrappers::SparseMatrix matrix(dealii::complete_index_set(n), MPI_COMM_SELF, length);
      for (unsigned int k = 0; k < n; ++k)
      {
        gather(k / 3, k % 3);
        matrix.set(k, columns.size(), columns.data(), values.data());
      }
      matrix.compress(dealii::VectorOperation::insert);
      return matrix;
    }

    /** Motions of a rigid body at the free nodes, six one after the other. */
    std::vector<double> rigid_motions(const std::vector<std::array<double, 3>> &points,
                                      const std::vector<unsigned int>          &free_node)
    {
      const std::size_t     n = 3 * free_node.size();
      std::array<double, 3> centre{}, size{};
      for (const unsigned int node : free_node)
        for (unsigned int c = 0; c < 3; ++c)
          centre[c] += points[node][c] / free_node.size();
      for (const unsigned int node : free_node)
        for (unsigned int c = 0; c < 3; ++c)
          size[c] = std::max(size[c], std::abs(points[node][c] - centre[c]));
      const double        scale = std::max({size[0], size[1], size[2]});
      std::vector<double> modes(6 * n, 0.);
      for (std::size_t i = 0; i < free_node.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int d = (c + 1) % 3, e = (c + 2) % 3;
          const auto        &p = points[free_node[i]];
          modes[c * n + 3 * i + c] = 1.;
          modes[(3 + c) * n + 3 * i + d] = -(p[e] - centre[e]) / scale; // about axis c
          modes[(3 + c) * n + 3 * i + e] = (p[d] - centre[d]) / scale;
        }
      return modes;
    }

    /** Those that deal.II gives to ML for elliptic equations, and the @p modes. */
    Teuchos::ParameterList level_parameters(std::vector<double> &modes)
    {
      Teuchos::ParameterList parameters;
      ML_Epetra::SetDefaults("SA", parameters);
      parameters.set("ML output", 0);
      parameters.set("PDE equations", 3);
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

  struct RockStatics::Multigrid
  {
    Multigrid(const BlockSparseMatrix &stiffness, const std::vector<unsigned int> &free_node)
        : matrix(reduced(stiffness, free_node))
    {
    }

    dealii::TrilinosWrappers::SparseMatrix    matrix;
    dealii::TrilinosWrappers::PreconditionAMG levels;
    std::vector<Vector>                       solutions; ///< A-orthonormal
  };

  RockStatics::RockStatics(const BlockSparseMatrix                  &stiffness,
                           const std::vector<std::array<double, 3>> &points, const std::vector<bool> &held)
  {
    const Stopwatch watch;
    for (unsigned int i = 0; i < points.size(); ++i)
      if (!held[i])
        free_node.push_back(i);
    Ranks::on_first([&] { make_levels(stiffness, points); });
    setup = watch.seconds();
  }

  void RockStatics::make_levels(const BlockSparseMatrix                  &stiffness,
                                const std::vector<std::array<double, 3>> &points)
  {
    static LoneProcess mpi;
    multigrid = std::make_unique<Multigrid>(stiffness, free_node);
    std::vector<double> modes = rigid_motions(points, free_node); // deal.II's own take ones and zeros only
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

  RockStatics::~RockStatics() = default;

  unsigned int RockStatics::solve(const Unknowns &b, Unknowns &x, Log &log, const double tolerance)
  {
    x.assign(b.size(), 0.);
    double iterations = 0.;
    Ranks::on_first([&] { iterations = solve_here(b, x, log, tolerance); });
    Ranks::broadcast(x.data(), x.size(), 0);
    Ranks::broadcast(&iterations, 1, 0);
    return static_cast<unsigned int>(iterations);
  }

  unsigned int RockStatics::solve_here(const Unknowns &b, Unknowns &x, Log &log, const double tolerance)
  {
    constexpr unsigned int most = 1000, most_kept = 60;
    constexpr double       interval = 10.; // [s]
    const unsigned int     n = n_unknowns();
    Vector                 load(n), guess(n), u(n);
    for (unsigned int k = 0; k < n; ++k)
      load[k] = b[3 * std::size_t(free_node[k / 3]) + k % 3];
    for (const Vector &before : multigrid->solutions)
      guess.add(before * load, before);
    u = guess;
    dealii::SolverControl    control(most, tolerance * load.l2_norm());
    dealii::SolverCG<Vector> cg(control);
    const Stopwatch          watch;
    double                   next = interval;
    cg.connect(
        [&](const unsigned int iteration, const double residual, const Vector &)
        {
          if (watch.seconds() > next)
          {
            log.line("          iteration %u, residual %.1e of the load, after %.0f s", iteration,
                     residual / load.l2_norm(), watch.seconds());
            next += interval;
          }
          return dealii::SolverControl::success;
        });
    try
    {
      cg.solve(multigrid->matrix, u, load, multigrid->levels);
    }
    catch (const dealii::ExceptionBase &) // no convergence, or a breakdown
    {
      throw ComputationError("The static state of the rock did not converge in " +
                             std::to_string(control.last_step()) +
                             " steps: its elements may be badly shaped (see voussoir mesh).");
    }
    for (unsigned int k = 0; k < n; ++k)
      x[3 * std::size_t(free_node[k / 3]) + k % 3] = u[k];
    guess -= u;
    Vector &A_guess = load; // no longer needed
    multigrid->matrix.vmult(A_guess, guess);
    if (const double square = guess * A_guess; square > 0. && multigrid->solutions.size() < most_kept)
    {
      guess /= std::sqrt(square);
      multigrid->solutions.push_back(guess);
    }
    return control.last_step();
  }
} // namespace Voussoir
