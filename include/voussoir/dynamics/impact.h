// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_impact_h
#define voussoir_impact_h

#include <voussoir/dynamics/pair_clusters.h>
#include <voussoir/joints/joint_system.h>

#include <string>

namespace Voussoir
{
  /** Rule that corrects the velocity of closed pairs after the displacements of a step are known. */
  enum class ImpactRule
  {
    mean_force, ///< joint forces are means over the step; their impulses satisfy Coulomb's law; default
    paper,      ///< Taylor and Papadopoulos: closed rows and sticking rows get the relative velocity zero
    none        ///< no correction (plain Newmark); joint forces oscillate; for comparison
  };

  /** Rows of a closed pair that the correction changes. */
  enum class ImpactRows
  {
    none,
    normal, ///< along n, with the mean friction of the step
    all
  };

  /** Returns the rule @p name. Throws InputError for an unknown name. */
  ImpactRule impact_rule(const std::string &name);

  /** Returns the names of the rules as a Selection pattern. */
  std::string impact_rule_names();

  /** Velocity correction of a step. It computes velocities and accelerations that are consistent with the
   * displacements, pair by pair. Without it, the force of a closed pair oscillates from step to step
   * (doc/failures.md, Plain Newmark).
   *
   * The impulses of a cluster are computed together by Gauss-Seidel iterations. If their sum would add energy, only the
   * normal velocities of the cluster are corrected. The structure and the laws must outlive the object. */
  class Impact : PairClusters
  {
  public:
    /** Inverts the masses. Throws InputError if pairs share nodes and the rule is paper. */
    Impact(const Structure &structure, const JointLaws &laws, ImpactRule rule);

    /** Corrects the velocities and impulses of all pairs at the end of a step.
     * @param system joint system that has solved the step
     * @param histories data of the pairs in the equations of the step
     * @param dt time step [s]
     * @param change change of the jumps in the step, three values per pair [m]
     * @param v velocity at the end of the step, three values per node [m/s]
     * @param impulse impulses of the joint forces, three values per pair [N s] */
    void correct_velocity(const JointSystem &system, const std::vector<PairHistory> &histories, double dt,
                          const Unknowns &change, Unknowns &v, Unknowns &impulse) const;

    /** Returns the joint forces at the end of the step from the accelerations there, three values per pair
     * [N]. For the rule paper.
     * @param system joint system that has solved the step
     * @param force joint forces of the displacements, three values per pair [N]
     * @param nodal_force all nodal forces except the joint forces, three values per node [N] */
    Unknowns end_force(const JointSystem &system, const Unknowns &force, const Unknowns &nodal_force) const;

  private:
    struct ClusterStep;
    void correct_cluster(const JointSystem &system, const std::vector<PairHistory> &histories, double dt,
                         const Cluster &cluster, const Unknowns &change, Unknowns &v,
                         Unknowns &impulse) const;

    /** Computes the impulses of a cluster. Returns false without convergence. */
    bool solve_cluster(const Cluster &cluster, const std::vector<PairHistory> &histories,
                       ClusterStep &step) const;
    void correct_pair(const JointSystem &system, const PairHistory &history, double dt, std::size_t p,
                      const Unknowns &change, Unknowns &v, Unknowns &impulse) const;
    const Structure &structure;
    const JointLaws &laws;
    const ImpactRule rule;
  };
} // namespace Voussoir

#endif
