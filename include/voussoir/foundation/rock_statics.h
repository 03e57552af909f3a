// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_statics_h
#define voussoir_rock_statics_h

#include <voussoir/base/log.h>
#include <voussoir/foundation/coarse_rock.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Solver for static displacements of the rock: conjugate gradients with smoothed aggregation (Vanek,
   * Mandel and Brezina 1996, Computing 56). The finest level has RockOperator and a Chebyshev smoother. The
   * first coarse level has groups of nodes as rigid bodies (RockAggregates). CoarseRock solves the
   * coarse problem. The number of iterations grows slowly with the number of nodes.
   *
   * The initial guess is the A-orthogonal projection of the solution on the previous solutions (Fischer 1998,
   * Comput. Methods Appl. Mech. Engrg. 163).
   *
   * Nodes and aggregates are distributed to the ranks as in the time steps of the rock (RockSplit). CoarseRock
   * runs on the first rank. Aggregates are independent of the ranks, and sums are formed over chunks of nodes in a
   * fixed order. The results are therefore bitwise identical for any number of ranks. */
  class RockStatics
  {
  public:
    /** Creates the multigrid levels. @p held: nodes of the @p model with zero displacement. @p springs: added to its
     * stiffness. The @p model must outlive the object. @p make_coarse_solver: solver of the coarse problem. Throws
     * ComputationError if the stiffness matrix is not positive definite, or if the coarse solver fails. Must be called by all ranks. */
    RockStatics(const RockModel &model, const std::vector<bool> &held, NodeSprings springs,
                const MakeCoarseRock &make_coarse_solver = make_coarse_rock);
    ~RockStatics();

    /** Returns the number of unknowns. */
    unsigned int n_unknowns() const { return n_free; }

    /** Returns the wall time of the constructor [s]. */
    double seconds_setup() const { return setup; }

    /** Computes the displacements of all nodes. Must be called by all ranks.
     *
     * @param b nodal forces, three values per node [N]
     * @param x displacements, three values per node [m]
     * @param log receives a progress line every ten seconds
     * @param tolerance largest residual, relative to |b| [-]
     * @param part alternative tolerance, relative to the residual of the previous solution under @p b [-]
     *
     * Returns the number of iterations. Throws ComputationError if the iteration does not converge. */
    unsigned int solve(const Unknowns &b, Unknowns &x, Log &log, double tolerance = 1e-11, double part = 0.);

  private:
    void   find_inverse(const RockModel &model); ///< of the diagonal blocks
    double largest_eigenvalue() const;           ///< estimate for D^-1 K
    /** Creates the coarse problem. */
    void         make_coarse(const RockModel &model, const MakeCoarseRock &make_coarse_solver);
    void         multiply(const Unknowns &x, Unknowns &y) const;      ///< y = K x, zero at held nodes
    double       product(const Unknowns &a, const Unknowns &b) const; ///< scalar product
    void         smooth(bool is_last, Unknowns &residual, Unknowns &z) const;
    void         correct(Unknowns &residual, Unknowns &z) const;     ///< coarse-grid correction
    void         precondition(const Unknowns &r, Unknowns &z) const; ///< z = approximate K^-1 r
    unsigned int iterate(const Unknowns &b, Unknowns &x, Log &log, double tolerance, double goal) const;
    void         keep(const Unknowns &guess, const Unknowns &x); ///< stores the solution for later guesses
    template <class Action> void everywhere(const Action &action) const; ///< for components of this rank

    RockAggregates                   aggregates;
    NodeSprings                      springs;
    unsigned int                     n_nodes, n_free = 0; ///< n_free: number of unknowns
    RockSplit                        split;
    std::unique_ptr<RockOperator>    stiffness;
    std::vector<std::pair<int, int>> pieces;  ///< ranges of nodes of this rank
    std::vector<Matrix3>             inverse; ///< of the diagonal blocks [m/N], zero at held nodes
    std::vector<unsigned int>        seeds;   ///< of the aggregates; the owner of the seed owns the aggregate
    double                           eigenvalue = 0.; ///< upper bound of those of D^-1 K
    std::unique_ptr<CoarseRock>      coarse;          ///< on the first rank only
    std::vector<std::vector<double>> solutions;       ///< at @p pieces, nearly A-orthonormal
    Unknowns                         last;            ///< previous solution
    mutable Unknowns                 correction, work, rest;
    double                           setup = 0.; ///< wall time of the constructor [s]
  };
} // namespace Voussoir

#endif
