// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_static_state_h
#define voussoir_rock_static_state_h

#include <voussoir/foundation/base_nodes.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/rock_statics.h>

namespace Voussoir
{
  /** Returns the springs of the outer boundary of the rock for static loads near the @p centre [m]. Their stiffness is
   * that of an infinite elastic space under a force in the centre: traction over displacement at the distance r, along
   * and across r (Kelvin's solution). */
  NodeSprings springs_of_far_rock(const RockModel &model, const Vector3 &centre);

  /** Static state of dam and explicit rock: fixed-point iteration for the displacements of the base nodes,
   * with Anderson acceleration (Walker and Ni 2011, SIAM J. Numer. Anal. 49). An iteration computes the dam
   * on stiff springs under the loads and the forces of the previous iteration. It then computes the rock
   * under the resulting base forces (RockStatics). At convergence the springs are free of force. */
  class RockStaticState
  {
  public:
    /** Stores the references, which must outlive the object.
     *
     * @param model rock model with its stiffness matrix
     * @param base_nodes base nodes of the dam
     * @param ratio factor of the stiffness matrix: sustained over Young's modulus [-]
     * @param has_footings the dam has footings, see with_footings()
     * @param is_held true: the outer boundary is fixed, not on springs_of_far_rock()
     * @param is_slice true: no displacement along y, and none that differs across the slice, as their round-off would
     * grow in the iteration */
    RockStaticState(const RockModel &model, const std::vector<BaseNode> &base_nodes, double ratio,
                    bool has_footings, bool is_held, bool is_slice);

    /** Returns the springs at the base nodes, see BaseSupport::static_springs(). They are ten times as stiff
     * as the stiffest base node of the monoliths in x. */
    Unknowns springs(const Structure &structure) const;

    /** Computes the static state of dam and rock. Arguments, result and exceptions are those of
     * BaseSupport::solve_static(). The first call creates the solver of the rock, which later calls use
     * again. Must be called by all ranks. */
    ContactResult solve(const DamSolve &solve_dam, const Unknowns &springs, const Unknowns &u, Unknowns &load,
                        std::string &failure, Log &log);

  private:
    /** Computes the static displacements @p u_base of the base nodes [m] for the forces @p r on the rock,
     * three values per node of the dam [N]. @p part: see RockStatics::solve(). */
    void solve_rock(const Unknowns &r, double part, Unknowns &u_base, Log &log);

    /** Returns the load of the dam on springs whose other end has the displacement @p base [m]. @p r: forces
     * on the rock of the previous iteration [N]. */
    Unknowns with_springs(const Unknowns &external, const Unknowns &springs, const Unknowns &base,
                          const Unknowns &r) const;

    /** Adds the spring forces to the forces @p r on the rock. Returns the largest spring elongation [m]. */
    double add_spring_forces(const Unknowns &springs, const Unknowns &u, const Unknowns &base,
                             Unknowns &r) const;

    const RockModel             &model;
    const std::vector<BaseNode> &base_nodes;
    const double                 ratio;
    const bool                   has_footings, is_held, is_slice;
    std::vector<unsigned int> across; ///< per base node: the first one with its x and z in a slice, or itself
    std::unique_ptr<RockStatics> rock;            ///< solver of the rock, from the first solve() on
    unsigned int                 n_solutions = 0; ///< number of solutions of the rock so far
  };
} // namespace Voussoir

#endif
