// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_system_h
#define voussoir_joint_system_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/joints/base_elimination.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

namespace Voussoir
{
  /** Wall-clock times of the linear solutions with joints [s]. */
  struct SystemTimes
  {
    double substitutions = 0., joints = 0.; ///< substitutions of the bodies; joint problem
  };

  /** Base nodes on a compliant support in one step, see BaseElimination. Three values per base node. */
  struct BaseOfStep
  {
    Unknowns displacement; ///< displacement of the base nodes without forces on them [m]
    Unknowns force; ///< forces of the solution on the base nodes, means or values as the joint forces [N]
  };

  /** Condensed bodies for one operator A and the joints between them. It solves A u = load + share G^T force
   * (StepOperator) and gap = G u + offset with the joint laws between force and gap. */
  class JointSystem
  {
  public:
    /** Factorises the bodies and builds the joint operator.
     * @param structure bodies and pairs; must outlive the object
     * @param laws joint laws of the pairs
     * @param parameters parameters of the contact solver
     * @param step factors of the operator, and what the joint forces are
     * @param springs springs to the ground, per component [N/m]; empty: none
     * @param base base nodes and compliance of the support, or nullptr
     * @param single_factors factors of the bodies in single precision (CondensedBody). The joint operator is
     * in double precision in either case.
     *
     * Throws InputError if a problem file is requested for a law without Coulomb friction, and
     * ComputationError if a body cannot be factorised. */
    JointSystem(const Structure &structure, const PairLaws &laws, const ContactParameters &parameters,
                const StepOperator &step, const Unknowns &springs = Unknowns(),
                const BaseElimination::Nodes *base = nullptr, bool single_factors = false);
    JointSystem(const JointSystem &) = delete; // the solver has a pointer to the joint operator

    /** Solves a step. It is solved again after each crack event.
     * @param load nodal loads, three values per node [N]
     * @param offset gap for zero displacement, three values per pair [m]
     * @param start gap at the start of the step, three values per pair [m]
     * @param memory history variables before the step; receives the events of the step
     * @param force first guess (zeros in a static system: none), then solution, three values per pair [N]
     * @param gap receives three values per pair [m]
     * @param u receives three values per node [m]
     * @param base displacement of the base nodes without forces, receives their forces; nullptr: no support,
     * or zero displacement */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &memory,
                        Unknowns &force, Unknowns &gap, Unknowns &u, BaseOfStep *base = nullptr);

    /** Solves a step with the initial history variables of the laws, and discards them. */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &force,
                        Unknowns &gap, Unknowns &u)
    {
      Unknowns memory = laws.initial_memory();
      return solve(load, offset, start, memory, force, gap, u);
    }

    /** Returns the data of the pairs in the equations of a step. @p start: gap at the start of the step [m].
     * The result points into @p memory. */
    std::vector<PairHistory> histories(const Unknowns &start, const Unknowns &memory) const
    {
      return laws.histories(start, step.has_mean_forces(), memory);
    }

    /** Updates the history variables @p memory for an accepted step with the solution @p force [N], @p gap
     * [m]. @p start: gap at the start of the step [m]. */
    void commit(const Unknowns &start, const Unknowns &force, const Unknowns &gap, Unknowns &memory) const
    {
      laws.commit(start, step.has_mean_forces(), force, gap, memory);
    }

    /** Returns PairLaws::friction_correction() [J]: work of friction on inclined surfaces, beyond the work of
     * the tangential forces along the joints. */
    double friction_correction(const Unknowns &start, const Unknowns &force, const Unknowns &gap,
                               const Unknowns &memory) const
    {
      return laws.friction_correction(start, step.has_mean_forces(), force, gap, memory);
    }

    /** Solves A u = load without joint forces, three values per node. */
    void solve_free(const Unknowns &load, Unknowns &u);

    /** Returns the contact states of the pairs in the last solution. */
    const std::vector<PairState> &states() const { return solver->states(); }
    /** Returns the active surfaces of the pairs in the last solution, one bit per surface; bit 0:
     * the face. */
    const std::vector<unsigned char> &touching() const { return solver->touching(); }
    double                   memory() const; ///< memory consumption of factors and joint operator [bytes]
    const InterfaceOperator &joint_operator() const { return W; }

    SystemTimes times; ///< since the construction

  private:
    struct Side ///< node of a pair: body, and number among its interface nodes
    {
      unsigned int body = rigid_ground, node = 0;
    };
    template <class Action> void for_each_own_body(const Action &action); ///< calls action(b), in parallel
    std::vector<double>
    flexibility_of(unsigned int b, const std::vector<std::pair<unsigned int, unsigned int>> &sides_of_body);
    void          condense();
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
    InterfaceOperator                           W;
    std::shared_ptr<BaseElimination>            base; ///< or nullptr
    std::unique_ptr<ContactSolver>              solver;
    InterfaceValues                             interface; ///< work array
    unsigned int n_solved; ///< number of problems, including those before this object
  };
} // namespace Voussoir

#endif
