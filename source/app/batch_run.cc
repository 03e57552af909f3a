// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/batch_run.h>
#include <voussoir/base/lanes.h>
#include <voussoir/output/assessment.h>
#include <voussoir/output/stability_monitor.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Displacements lose digits when many small increments are added [s]. */
    constexpr double shortest_step = 3e-4;

    /** Limit of the error of the energy balance in single precision, relative to the largest energy of a motion, or to this
     * part of the strain energy of the static state if that is larger [-]. */
    constexpr double largest_error_of_batch = 1e-3;
  } // namespace

  std::string why_no_batch(const RunState &run)
  {
    const Scene            &scene = run.scene();
    const UpliftParameters &uplift = scene.loads.uplift;
    if (!scene.is_explicit())
      return "\"Dynamics/Scheme\" is not explicit";
    if (scene.foundation.model != "rigid")
      return "\"Foundation/Model\" is not rigid";
    if (run.dam->neighbours.size() > 1 || (uplift.acts() && uplift.in_earthquake != "unchanged"))
      return "water or another part reacts to the motion";
    if (!run.dam->forces.empty() || !scene.initial_velocities().empty() || run.n_steps == 0)
      return "the motion of the base is not the only load in time";
    if (scene.limits.sliding_safety > 0. || !scene.limits.wedges.empty())
      return "the limits include forces on the base";
    if (run.motion.dt < shortest_step * scene.n_explicit)
      return "single precision does not suffice for explicit steps below " +
             number_text(1e3 * shortest_step) + " ms";
    return BatchModel::why_not(run.dam->structure, run.dam->layout.laws);
  }

  /** State and observers of a motion. */
  struct BatchRun::Lane
  {
    RunState                         run;
    LaneIntegrator                  *integrator; ///< RunState::integrator
    std::optional<JointObserver>     joints;
    std::optional<StressObserver>    stresses;
    std::optional<StabilityObserver> stability;
    std::string                      failure;
    double                           imbalance = 0.; ///< largest so far [J]

    Lane(const RunState &start, const BatchModel &model, const StressObserver &like, const MotionBatch &batch,
         const GroundMotion &motion, const unsigned int lane)
    {
      run.dam = start.dam;
      run.motion = motion;
      run.statics = start.statics;
      run.n_steps = motion.acceleration.size() - 1;
      run.pairs_at_start = start.pairs_at_start;
      auto own =
          std::make_unique<LaneIntegrator>(batch, model, run.dam->layout.laws, run.statics.force, lane);
      integrator = own.get();
      run.integrator = std::move(own);
      joints.emplace(run);
      stresses.emplace(run, joints->joints, like);
      stability.emplace(run);
      joints->record();
    }

    double reference_energy() const ///< [J]
    {
      return std::max(integrator->largest_energy(),
                      largest_error_of_batch * std::abs(integrator->initial_energy().strain));
    }

    bool is_done() const { return run.is_last() || !failure.empty(); }

    /** Records the state after a step. An exception must not leave the parallel region of BatchRun::advance(). */
    void follow()
    {
      try
      {
        record();
      }
      catch (const std::exception &error)
      {
        failure = error.what();
      }
    }

    /** Adds the state after a step to the results, or sets #failure. */
    void record()
    {
      ++run.step;
      const bool is_balanced = run.is_due(NeighbourMonitor::interval) || run.is_last(); // as StabilityMonitor
      if (is_balanced)
        integrator->read_all();
      else
        integrator->read();
      const Energy &energy = integrator->state().energy;
      if (is_balanced)
        imbalance = std::max(imbalance, std::abs(energy.balance(integrator->initial_energy())));
      if (!std::isfinite(energy.input + energy.kinetic))
        failure = "the displacements are not finite at t = " + number_text(integrator->state().time) + " s";
      else if (run.is_last() && imbalance > largest_error_of_batch * reference_energy())
        failure = "the energy balance has an error of " + number_text(imbalance / reference_energy());
      if (!failure.empty())
        return;
      joints->record();
      stability->record();
    }
  };

  namespace
  {
    std::vector<Vector3> first_accelerations(const std::vector<const GroundMotion *> &motions)
    {
      std::vector<Vector3> result;
      for (const GroundMotion *motion : motions)
        result.push_back(motion->sample(0));
      return result;
    }
  } // namespace

  BatchRun::BatchRun(const RunState &start, const BatchModel &model, const StressObserver &observer,
                     const std::vector<const GroundMotion *> &motions)
      : batch(model, first_accelerations(motions)),
        envelope_interval(start.scene().output.envelope_interval.samples)
  {
    for (const GroundMotion *motion : motions)
    {
      lanes.push_back(std::make_unique<Lane>(start, model, observer, batch, *motion, lanes.size()));
      most_steps = std::max(most_steps, lanes.back()->run.n_steps);
    }
    if (envelope_interval > 0)
      stresses.emplace(start, observer, batch).record(recorders(), {});
  }

  BatchRun::~BatchRun() = default;

  /** Returns the recorders of the motions that last, null for the others. */
  std::vector<EnvelopeRecorder *> BatchRun::recorders() const
  {
    std::vector<EnvelopeRecorder *> result;
    for (const auto &lane : lanes)
      result.push_back(lane->is_done() ? nullptr : &lane->stresses->envelope);
    return result;
  }

  void BatchRun::advance()
  {
    const bool           has_stresses = envelope_interval > 0 && (step + 1) % envelope_interval == 0;
    std::vector<Vector3> before(n_lanes()), after(n_lanes()), mean(n_lanes());
    const double         weight = lanes.front()->integrator->weight_of_end();
    for (std::size_t k = 0; k < lanes.size(); ++k)
      if (!lanes[k]->is_done())
      {
        before[k] = lanes[k]->run.motion.sample(step);
        after[k] = lanes[k]->run.motion.sample(step + 1);
        for (unsigned int c = 0; c < 3; ++c)
          mean[k][c] = (1. - weight) * before[k][c] + weight * after[k][c];
      }
    if (has_stresses)
      stresses->begin_step();
    batch.advance(before, after);
    ++step;
    if (has_stresses)
      stresses->record(recorders(), mean);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < lanes.size(); ++k)
      if (!lanes[k]->is_done())
      {
        lanes[k]->follow();
        if (stresses && lanes[k]->run.is_last())
          stresses->finish(lanes[k]->stresses->envelope, k);
      }
  }

  MotionResult BatchRun::result(const std::size_t motion) const
  {
    const Lane &lane = *lanes[motion];
    if (lane.failure.empty())
      return result_of(*lane.joints, *lane.stresses, assess(lane.run, *lane.joints, *lane.stresses));
    MotionResult result;
    result.failure = lane.failure;
    return result;
  }
} // namespace Voussoir
