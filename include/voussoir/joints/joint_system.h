// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_system_h
#define voussoir_joint_system_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/joints/base_elimination.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

namespace Voussoir
{
  /** Wall-clock times of JointSystem::solve(), summed over all calls [s]. */
  struct SystemTimes
  {
    double substitutions = 0.; ///< forward and backward substitutions of the bodies
    double joints = 0.;        ///< joint problem
  };

  /** Base nodes on a compliant support in one step, see BaseElimination. Three values x, y, z per base node,
   * in the order of BaseElimination::Nodes. */
  struct BaseOfStep
  {
    /** Displacement that the support alone would give the base nodes, with no force between dam and support
     * [m]; empty: zero. */
    Unknowns displacement;

    /** Forces of the support on the base nodes in the solution [N]. They are means over the step if the joint
     * forces are means (StepOperator::has_mean_forces()). */
    Unknowns force;
  };

  /** Bodies, condensed to their interfaces, and the joints between them, for the operator A of a step. G is
   * the matrix of all jumps (Structure::jump()). The class solves A u = load + share G^T force and
   * gap = G u + offset, where the joint laws relate force and gap. The share is 1 for forces at the end of the
   * step, and 2 for means over it (StepOperator). */
  class JointSystem
  {
  public:
    // Values per node have the components x, y, z of free nodes, values per pair the components (n, a, b) of
    // Pair::frame. All ranks call the constructor, solve() and solve_free(), with equal arguments.

    /** Factorises the bodies and builds the joint operator.
     * @param structure bodies and pairs; must outlive the object
     * @param laws joint laws of the pairs
     * @param parameters parameters of the contact solver
     * @param step operator A, and its definition of the joint forces
     * @param springs springs from the nodes to the ground, three values per node [N/m]; empty: none
     * @param base base nodes and compliance of the support, which are copied; nullptr: no support
     * @param single_factors true: the factors of the bodies are in single precision (CondensedBody). The joint
     * operator is always in double precision.
     *
     * Throws ComputationError if a body cannot be factorised. */
    JointSystem(const Structure &structure, const PairLaws &laws, const ContactParameters &parameters,
                const StepOperator &step, const Unknowns &springs = Unknowns(),
                const BaseElimination::Nodes *base = nullptr, bool single_factors = false);
    JointSystem(const JointSystem &) = delete; // the solver has a pointer to the joint operator

    /** Solves a step. After events of the joint laws (JointLaw::apply_event()) the step is solved again.
     * @param load nodal loads, three values per node [N]
     * @param offset gap for zero displacement, three values per pair [m]
     * @param start gap at the start of the step, three values per pair [m]
     * @param memory history variables before the step; receives the events of the step
     * @param force initial guess; receives the joint forces on side 2, three values per pair [N]. In a static
     * system with zeros, the solver computes a guess that keeps all gaps closed, except with the method
     * "sweeps".
     * @param gap receives the gaps, three values per pair [m]
     * @param u receives the displacements, three values per node [m]
     * @param base displacement that the support alone would give the base nodes (BaseOfStep); receives the
     * forces of the support. nullptr: no support, or zero displacement
     *
     * Returns convergence and costs. If ContactResult::converged is false, the results are those of the best
     * iterate. The history variables of the laws are not updated: call commit() if the step is accepted. */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &memory,
                        Unknowns &force, Unknowns &gap, Unknowns &u, BaseOfStep *base = nullptr);

    /** Solves a step with the initial history variables of the laws, and discards the events of the step. The
     * arguments are those of the other function. */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &force,
                        Unknowns &gap, Unknowns &u)
    {
      Unknowns memory = laws.initial_memory();
      return solve(load, offset, start, memory, force, gap, u);
    }

    /** Updates the history variables after a step is accepted.
     * @param start gap at the start of the step, three values per pair [m]
     * @param force joint forces of the solution, three values per pair [N]
     * @param gap gaps of the solution, three values per pair [m]
     * @param memory history variables after solve(); receives those for the next step */
    void commit(const Unknowns &start, const Unknowns &force, const Unknowns &gap, Unknowns &memory) const
    {
      laws.commit(start, step.has_mean_forces(), force, gap, memory);
    }

    /** Changes ContactParameters::tolerance for the next solutions. */
    void set_tolerance(const double tolerance) { solver->set_tolerance(tolerance); }

    /** Solves A u = load without forces of joints and support. The results of solve() are unchanged.
     * @param load nodal loads, three values per node [N]
     * @param u receives the displacements, three values per node [m] */
    void solve_free(const Unknowns &load, Unknowns &u);

    /** Returns the contact states of the pairs in the last solution. Before the first one, all are open. */
    const std::vector<PairState> &states() const { return solver->states(); }
    /** Returns the active surfaces of the pairs in the last solution, see PairEquations::active. */
    const std::vector<unsigned char> &active_surfaces() const { return solver->active_surfaces(); }
    /** Returns the memory consumption of factors and joint operator on this rank [bytes]. */
    double memory_consumption() const;
    /** Returns the operator W of the contact problem gap = W force + b [m/N]. With a support, the base nodes
     * are eliminated from W. With several ranks it holds only the blocks in the rows and columns of the joints
     * of this rank. */
    const InterfaceOperator &joint_operator() const { return W; }

    SystemTimes times; ///< wall-clock times of solve() since the construction

  private:
    struct Side ///< node of a pair: body, and number among its interface nodes
    {
      unsigned int body = rigid_ground, node = 0;
    };
    template <class Action> void for_each_own_body(const Action &action); ///< calls action(b), in parallel
    std::vector<double>
    flexibility_of(unsigned int b, const std::vector<std::pair<unsigned int, unsigned int>> &sides_of_body);
    void          condense();
    void          couple_footings();
    void          make_whole();
    Unknowns      gaps_without_forces(const Unknowns &offset, const Unknowns &base_force) const;
    void          release_joints(BaseOfStep &of_step) const;
    void          put_on_interface(const Unknowns &force, BaseOfStep &of_step);
    ContactResult solve_pairs(const Unknowns &b, const Unknowns &start, Unknowns &memory, Unknowns &force,
                              Unknowns &gap);
    void          write_problem(const Unknowns &b, const Unknowns &start, const Unknowns &memory,
                                const Unknowns &force) const;

    const Structure                            &structure;
    const ContactParameters                     parameters;
    const PairLaws                              laws;
    const StepOperator                          step;
    const bool                                  is_static; ///< without mass
    std::vector<std::unique_ptr<CondensedBody>> bodies;    ///< nullptr for bodies of other processes
    std::vector<std::array<Side, 2>>            sides;     ///< nodes of each pair
    std::vector<unsigned int>                   group;     ///< block of W of each pair
    InterfaceOperator                           W;
    std::shared_ptr<BaseElimination>            base; ///< or nullptr
    std::unique_ptr<ContactSolver>              solver;
    InterfaceValues                             interface; ///< work array
    unsigned int n_solved; ///< number of problems, including those before this object
  };

  /** Returns a sentence with the joint and the position of the largest error of a solution, after a space.
   * Returns an empty string if there is none. */
  std::string largest_error(const Structure &structure, const ContactResult &result);
} // namespace Voussoir

#endif
