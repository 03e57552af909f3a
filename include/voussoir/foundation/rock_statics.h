// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_statics_h
#define voussoir_rock_statics_h

#include <voussoir/base/log.h>
#include <voussoir/foundation/coarse_rock.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Static displacements of the rock: conjugate gradients, preconditioned by smoothed aggregation (Vanek,
   * Mandel and Brezina 1996, Computing 56). On the nodes: products of RockOperator, and Chebyshev's
   * polynomial as smoother; below, groups of nodes as rigid bodies (RockAggregates), and Trilinos' ML for
   * them (CoarseRock). The number of iterations hardly depends on the size of the elements.
   *
   * A solve begins with the A-orthogonal projection of its solution on the solutions so far (Fischer 1998,
   * Comput. Methods Appl. Mech. Engrg. 163), since the loads of an iteration differ by less and less.
   *
   * With several ranks each has its share of the nodes, as in the steps of the rock (RockSplit), and of the
   * aggregates; the first has ML. Aggregates do not know of ranks, and sums are taken by chunks of nodes in
   * the order of the chunks: the same bits on any number of ranks, which ML by itself would not give, since
   * its aggregates end where a rank does. */
  class RockStatics
  {
  public:
    /** The nodes of @p model that are @p held do not move. It is to live longer than this. Throws
     * ComputationError where ML cannot make its levels. To be called by all ranks at once. */
    RockStatics(const RockModel &model, const std::vector<bool> &held);
    ~RockStatics();

    unsigned int n_unknowns() const { return n_free; }
    double       seconds_setup() const { return setup; }

    /** Displacements @p x of all nodes [m] under the forces @p b [N], until the residual is less than
     * @p tolerance times |b|, or @p part of what the solution before leaves of them; returns the number of
     * iterations, few where the forces are much as they were before. Says where it stands in @p log every ten
     * seconds. Throws ComputationError if it does not converge. */
    unsigned int solve(const Unknowns &b, Unknowns &x, Log &log, double tolerance = 1e-11, double part = 0.);

  private:
    void         find_inverse(const RockModel &model);
    double       largest_eigenvalue() const;
    void         make_coarse(const RockModel &model);
    void         multiply(const Unknowns &x, Unknowns &y) const; ///< y = K x where nothing is held
    double       product(const Unknowns &a, const Unknowns &b) const;
    void         smooth(bool is_last, Unknowns &residual, Unknowns &z) const;
    void         correct(Unknowns &residual, Unknowns &z) const;
    void         precondition(const Unknowns &r, Unknowns &z) const;
    unsigned int iterate(const Unknowns &b, Unknowns &x, Log &log, double tolerance, double goal) const;
    void         keep(const Unknowns &guess, const Unknowns &x);
    template <class Action> void everywhere(const Action &action) const; ///< that this rank steps

    RockAggregates                   aggregates;
    unsigned int                     n_nodes, n_free = 0; ///< free: unknowns
    RockSplit                        split;
    std::unique_ptr<RockOperator>    stiffness;
    std::vector<std::pair<int, int>> pieces;          ///< nodes that this rank steps, in ranges
    std::vector<Matrix3>             inverse;         ///< of the diagonal's blocks [m/N]; zero where held
    std::vector<unsigned int>        seeds;           ///< of each aggregate, whose owner has it
    double                           eigenvalue = 0.; ///< above those of D^-1 K
    std::unique_ptr<CoarseRock>      coarse;          ///< of the first rank
    std::vector<std::vector<double>> solutions;       ///< at the pieces, about A-orthonormal
    Unknowns                         last;            ///< solution
    mutable Unknowns                 correction, work, rest;
    double                           setup = 0.; ///< [s]
  };
} // namespace Voussoir

#endif
