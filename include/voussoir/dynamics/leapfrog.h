// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_leapfrog_h
#define voussoir_leapfrog_h

#include <voussoir/dynamics/integrator.h>
#include <voussoir/dynamics/pair_clusters.h>
#include <voussoir/dynamics/support.h>
#include <voussoir/solid/packed_stiffness.h>

namespace Voussoir
{
  /** Largest stable step of the leapfrog rule, and what limits it. */
  struct CriticalStep
  {
    double       length = 0.; ///< [s]
    unsigned int node = 0;    ///< free node that moves most in the highest mode
  };

  /** Returns the mass of a node without the added mass of the water and without @p without [kg]. An empty vector is no
   * mass. The result is the mean of the directions. */
  double mass_of(const Structure &structure, const std::vector<Matrix3> &without, std::size_t node);

  /** Returns the critical step of a structure with the moduli of Structure::damping. Mass damping is neglected.
   * @param without masses of nodes that do not count, such as those of the rock [kg] */
  CriticalStep critical_step(const Structure &structure, const std::vector<Matrix3> &without);

  /** Explicit time integration of a structure with joints by the leapfrog rule. The joint forces satisfy the joint laws
   * at the end of each step (Carpenter, Taylor, Katona 1991, Int. J. Numer. Methods Eng. 32, 103-128). Without damping:
   *
   *     v(k + 1/2) = v(k - 1/2) + h M^-1 (F(k) - K w(k) + G^T f(k)),   u(k + 1) = u(k) + h v(k + 1/2).
   *
   * The mass matrix is lumped, so each pair is solved alone, and so is each cluster of pairs that share nodes. The
   * displacement w has the memory of the damping (Damping). advance() divides a time step into equal steps h below the
   * critical step. The load is linear in the time step. DynamicState::v is the velocity at the middle of the last
   * step h. The kinetic energy v M v / 2 and the strain energy u(k) K u(k + 1) / 2 belong to the same time, and their
   * balance is exact. If advance() throws, the state is that of the step h that failed. */
  class Leapfrog : public Integrator
  {
  public:
    /** start() or resume() must follow.
     * @param structure masses, stiffness matrices, damping without a stiffness term, and pairs
     * @param laws joint laws of the pairs
     * @param dt time step of advance() [s]
     * @param n_steps number of steps h in dt, below the critical step
     * @param neighbours take the steps h, too
     *
     * There must be one process, and the structure must have no stiffness term of the damping and no reactions of water. */
    Leapfrog(const Structure &structure, const JointLaws &laws, double dt, unsigned int n_steps,
             std::vector<StepNeighbour *> neighbours = {});

    void          start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                        const Unknowns &reference, const Unknowns &memory = {},
                        const Unknowns &elastic_force = {}) override;
    ContactResult advance(const Unknowns &load, const Vector3 &base_velocity = {{0., 0., 0.}}) override;
    const std::vector<PairState> &pair_states() const override { return states; }
    SystemTimes                   times() const override { return spent; }
    double                        memory() const override;
    double                        weight_of_end() const override { return .5 * (n_steps - 1) / n_steps; }

  private:
    struct Work ///< works of one step h [J]
    {
      double input = 0., damping = 0., opening = 0., friction = 0.;
    };
    void         predict(double share, const Unknowns &load);
    Vector3      predicted(std::size_t p) const;
    PairHistory  history_of(std::size_t p) const;
    Vector3      without_gain(std::size_t p, const Matrix3 &H, const Vector3 &b, const Vector3 &f) const;
    void         apply(std::size_t p, const Vector3 &f);
    bool         apply_event(std::size_t p, const Vector3 &force, const Vector3 &at, double limit);
    unsigned int solve_cluster(const PairClusters::Cluster &cluster, const std::vector<Vector3> &b,
                               std::vector<Vector3> &f, std::vector<Vector3> &at) const;
    unsigned int solve_with_events(const PairClusters::Cluster &cluster);
    void         solve_joints(bool is_last, ContactResult &result, Work &work);
    void         add_work_of_joints(Work &work) const;
    void         move(double share, const Unknowns &load, bool is_last, Work &work);
    void         account(double more);

    const double       dt;
    const unsigned int n_steps; ///< steps h in dt
    const double       h;       ///< [s]
    const double       gain;    ///< change of momentum per force, with the damping of the mass [s]
    const std::vector<StepNeighbour *> neighbours;
    const PackedStiffness              stiffness;
    Unknowns                           outer; ///< forces of the neighbours at the start of the step h [N]
    const PairClusters                 clusters;
    std::vector<PairState>             states;
    SystemTimes                        spent;
    Unknowns                           next;       ///< velocity at the end of the step h [m/s]
    Unknowns                           u, Ku;      ///< displacement at this time [m], and K u [N]
    Unknowns                           pair_force; ///< joint forces of the step h [N]
    Unknowns                           gap_before, gap, gap_after; ///< of the steps k - 1, k and k + 1 [m]
  };
} // namespace Voussoir

#endif
