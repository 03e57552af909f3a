// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_system_h
#define voussoir_joint_system_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/joints/foot_elimination.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

namespace Voussoir
{
  /** Wall seconds spent in the stages of a linear solution with joints. */
  struct SystemTimes
  {
    double substitutions = 0., joints = 0.;
  };

  /** What a support says of a step, see FootElimination: three values per foot. */
  struct FeetOfStep
  {
    Unknowns place; ///< of the feet without forces on them [m]
    Unknowns force; ///< of the solution, on the feet, of the same meaning as those of the joints [N]
  };

  /** The bodies condensed for one operator A = mass_factor M + stiffness_factor K + dashpot_factor D +
   * springs, and the joints between them: solves A u = load + G^T force, gap = G u + offset, with the joint
   * laws between force and gap. */
  class JointSystem
  {
  public:
    /** @p meaning: of the forces of this system, for the laws; @p springs: to the ground, per component
     * [N/m], or empty; @p feet: on a support that gives way, compliance for forces of this meaning, or null;
     * @p single_factors: of the bodies, see CondensedBody; W is in double precision all the same. */
    JointSystem(const Structure &structure, const PairLaws &laws, const ContactParameters &parameters,
                double mass_factor, double stiffness_factor, double dashpot_factor,
                ForceMeaning meaning = ForceMeaning(), const Unknowns &springs = Unknowns(),
                const FootElimination::Feet *feet = nullptr, bool single_factors = false);
    JointSystem(const JointSystem &) = delete; // the solver knows the joint operator by its place

    /** @p start: gap at the start of the step, 3 per pair [m]; @p memory: of the pairs, as committed before
     * the step; receives the events of the step, after each of which it is solved once more; @p force: guess
     * (zeros in a static system: none), then solution, 3 per pair [N]; @p gap, 3 per pair [m]; @p u, 3 per
     * node [m]; @p feet: null where there are none, or their place is zero and nobody asks for the force. */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &memory,
                        Unknowns &force, Unknowns &gap, Unknowns &u, FeetOfStep *feet = nullptr);

    /** The same with the laws' initial memory, which is not kept. */
    ContactResult solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start, Unknowns &force,
                        Unknowns &gap, Unknowns &u)
    {
      Unknowns memory = laws.initial_memory();
      return solve(load, offset, start, memory, force, gap, u);
    }

    /** What the equations of a step from @p start see of the pairs; points into @p memory. */
    std::vector<PairPast> pasts(const Unknowns &start, const Unknowns &memory) const
    {
      return laws.pasts(start, meaning, memory);
    }

    /** The step from @p start with the solution @p force, @p gap is accepted: the laws bring the memory up to
     * date. */
    void commit(const Unknowns &start, const Unknowns &force, const Unknowns &gap, Unknowns &memory) const
    {
      laws.commit(start, meaning, force, gap, memory);
    }

    /** Part of the work of a step's forces that friction takes, less the work along the joints [J]:
     * PairLaws::friction_correction(). */
    double friction_correction(const Unknowns &start, const Unknowns &force, const Unknowns &gap,
                               const Unknowns &memory) const
    {
      return laws.friction_correction(start, meaning, force, gap, memory);
    }

    /** The bodies without joint forces: A u = load. */
    void solve_free(const Unknowns &load, Unknowns &u);

    const std::vector<PairState>     &states() const { return solver->states(); }
    const std::vector<unsigned char> &touching() const { return solver->touching(); }
    double                            memory() const; ///< of factors and joint operator [bytes]
    const InterfaceOperator          &joint_operator() const { return W; }

    SystemTimes times;

  private:
    struct Side ///< one node of a pair: its body, and its number among the interface nodes
    {
      unsigned int body = rigid_ground, node = 0;
    };
    template <class Action> void for_each_own_body(const Action &action); ///< action(b) by all threads
    std::vector<double>
    flexibility_of(unsigned int b, const std::vector<std::pair<unsigned int, unsigned int>> &sides_of_body);
    void          condense();
    void          make_whole();
    Unknowns      gaps_without_forces(const Unknowns &offset, const Unknowns &foot_force) const;
    void          release_joints(FeetOfStep &of_step) const;
    void          put_on_interface(const Unknowns &force);
    ContactResult solve_pairs(const Unknowns &b, const Unknowns &start, Unknowns &memory, Unknowns &force,
                              Unknowns &gap);
    void          write_problem(const Unknowns &b, const Unknowns &start, const Unknowns &memory,
                                const Unknowns &force) const;

    const Structure                            &structure;
    const ContactParameters                     parameters;
    const PairLaws                              laws;
    const ForceMeaning                          meaning;
    const bool                                  is_static; ///< without masses
    std::vector<std::unique_ptr<CondensedBody>> bodies;    ///< null where another rank has it
    std::vector<std::array<Side, 2>>            sides;     ///< per pair
    InterfaceOperator                           W;
    std::shared_ptr<FootElimination>            feet; ///< or null
    std::unique_ptr<ContactSolver>              solver;
    InterfaceValues                             interface; ///< work space
    unsigned int                                n_solved;  ///< also before this object was made
  };
} // namespace Voussoir

#endif
