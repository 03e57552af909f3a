// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_impact_h
#define voussoir_impact_h

#include <voussoir/joints/joint_system.h>

#include <string>

namespace Voussoir
{
  /** What happens to velocity and acceleration where faces touch, after the displacements of a step are
   * known. */
  enum class ImpactRule
  {
    mean_force, ///< joint forces are means over the step; Coulomb's law for their impulse: the default
    impulse_consistent, ///< joint forces at the end of the step; Coulomb's law for impulse and acceleration
    paper,              ///< Taylor and Papadopoulos: closed and sticking rows move together
    none                ///< plain Newmark: oscillates, for comparison
  };

  ImpactRule  impact_rule(const std::string &name); ///< throws InputError for an unknown name
  std::string impact_rule_names();                  ///< as a ParameterHandler selection

  /** Impact and release: velocity and acceleration that fit the displacements of a step, pair by pair;
   *  without it, the force of a closed pair oscillates in every step (doc/failures.md, Plain Newmark). Lumped
   * mass, one 3x3 block per node; a node may belong to one pair only. */
  class Impact
  {
  public:
    /** Throws InputError where a node belongs to two pairs. */
    Impact(const Structure &structure, const JointLaws &laws, ImpactRule rule);

    /** @p system has solved the step, in which the jumps have changed by @p change, 3 per pair [m]; @p pasts:
     *  those of the pairs in its equations. Corrects the velocity @p v at its end and the impulses of its
     *  joint forces, 3 per pair [N s]. */
    void correct_velocity(const JointSystem &system, const std::vector<PairPast> &pasts, double dt,
                          const Unknowns &change, Unknowns &v, Unknowns &impulse) const;

    /** The joint forces at the end of the step, 3 per pair [N], from the accelerations there, for the rules
     *  that need them. @p force: those of the displacements, 3 per pair; @p v: the corrected velocity; @p
     *  nodal_force: all forces on the nodes but the joints', 3 per node [N]. */
    Unknowns end_force(const JointSystem &system, const std::vector<PairPast> &pasts, const Unknowns &force,
                       const Unknowns &v, const Unknowns &nodal_force) const;

  private:
    void correct_pair(const JointSystem &system, const PairPast &past, double dt, std::size_t p,
                      const Unknowns &change, Unknowns &v, Unknowns &impulse) const;
    /** v += M^-1 G^T f of one pair. */
    void add_kick(const Pair &pair, const Vector3 &f, Unknowns &v) const;

    const Structure     &structure;
    const JointLaws     &laws;
    const ImpactRule     rule;
    std::vector<Matrix3> inverse_mass; ///< per node
    std::vector<Matrix3> pair_inverse; ///< G M^-1 G^T per pair
  };
} // namespace Voussoir

#endif
