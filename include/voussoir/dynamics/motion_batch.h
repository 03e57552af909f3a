// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_batch_h
#define voussoir_motion_batch_h

#include <voussoir/dynamics/batch_view.h>
#include <voussoir/dynamics/integrator.h>

#include <deal.II/base/aligned_vector.h>

namespace Voussoir
{
  /** Structure and static state for batches of ground motions, in single precision. Displacements are increments from
   * the static state, whose joint forces are the only loads besides inertia. */
  class BatchModel
  {
  public:
    /** Returns the reason why a structure has no batches, for a sentence after "because", or an empty text. */
    static std::string why_not(const Structure &structure, const JointLaws &laws);

    /** Static state and loads of a structure. */
    struct Start
    {
      const std::array<Unknowns, 3> &inertia; ///< loads of a unit acceleration of the base in x, y and z [kg]
      const Unknowns                &u;       ///< displacement [m]
      Unknowns                       load;    ///< constant loads [N]
      const Unknowns                &closed;  ///< jumps at which the pairs are closed [m]
    };

    /** @param structure, laws as in Leapfrog, which batches agree with; why_not() is empty. The structure must outlive
     * the object.
     * @param dt time step of MotionBatch::advance() [s]
     * @param n_steps number of steps h in dt
     * @param start static state */
    BatchModel(const Structure &structure, const JointLaws &laws, double dt, unsigned int n_steps,
               const Start &start);

    BatchView view() const; ///< arrays for the kernels

    std::vector<unsigned int> nodes_of_pairs;

    const Structure   &structure;
    const double       dt;
    const unsigned int n_steps;
    const Unknowns     u_static, closed;
    double             static_strain = 0.; ///< strain energy of the static state [J]

  private:
    void add_stiffness();
    void add_nodes(const Start &start);
    void add_pair(const Pair &pair, const JointLaw &law, const std::vector<Matrix3> &inverse_mass);

    BatchView                  sizes; ///< without arrays
    std::vector<unsigned int>  body, column;
    std::vector<std::size_t>   row;
    std::vector<float>         block, diagonal, inverse_mass, residual, of_ground;
    std::vector<unsigned char> is_full;
    std::vector<BatchPair>     pairs;
  };

  /** Explicit time integration of several ground motions of one structure with the leapfrog rule of Leapfrog: a lane of
   * each vector of the processor is a motion. The processor reads each coefficient of the stiffness matrix once for all
   * lanes. The result of a lane does not depend on the motions of the other lanes. */
  class MotionBatch
  {
  public:
    /** Starts all lanes in the static state. @p model must outlive the object. @p ground: accelerations of the base at
     * the start, one entry per lane [m/s^2]; empty: zero. */
    explicit MotionBatch(const BatchModel &model, const std::vector<Vector3> &ground = {});

    /** Advances all lanes by BatchModel::dt. The accelerations of the base at the start and at the end of the step
     * [m/s^2] have one entry per lane. */
    void advance(const std::vector<Vector3> &before, const std::vector<Vector3> &after);

    /** Returns the state of a lane: displacement, velocity at the middle of the last step h, mean joint forces of the
     * last time step and works. The kinetic energy is that of kinetic_energy(). @p only: nodes whose displacements and
     * velocities are set; null: all. */
    void read(unsigned int lane, DynamicState &state, const std::vector<unsigned int> *only = nullptr) const;

    double kinetic_energy(unsigned int lane) const; ///< [J]
    double time() const { return now; }             ///< [s]

    const float *displacements() const
    {
      return u.data();
    } ///< since the static state: a value per lane for each component [m]
    const float *velocities() const { return v.data(); } ///< in the same order [m/s]

    /** Computes the mean joint forces of the last time step in the frames of the pairs, in the same order [N]. */
    void find_joint_forces(float *force) const;

  private:
    const BatchModel            &model;
    const BatchView              view;
    const unsigned int           lanes;
    dealii::AlignedVector<float> u, v, w, f, d, gap, moved, impulse;
    double                       works[4][16] = {}; ///< see BatchState
    double                       now = 0.;
  };

  /** Lane of a batch as the state of a run: for observers of results. */
  class LaneIntegrator : public Integrator
  {
  public:
    /** @p force: joint forces of the static state [N]. The other arguments must outlive the object. */
    LaneIntegrator(const MotionBatch &batch, const BatchModel &model, const JointLaws &laws,
                   const Unknowns &force, unsigned int lane);

    /** Reads the state of the lane, with displacements and velocities of the pairs only. */
    void read();

    void read_all(); ///< also all displacements and velocities, and the kinetic energy

    ContactResult                 advance(const Unknowns &, const Vector3 &) override;
    const std::vector<PairState> &pair_states() const override { return states; }
    SystemTimes                   times() const override { return {}; }
    double                        memory() const override { return 0.; }
    double weight_of_end() const override { return .5 * (model.n_steps - 1) / model.n_steps; }

  private:
    const MotionBatch     &batch;
    const BatchModel      &model;
    const unsigned int     lane;
    std::vector<PairState> states;
    void                   read_forces();
  };
} // namespace Voussoir

#endif
