// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  BlockObserver::BlockObserver(const RunState &run) : blocks(*run.dam, run.statics.joint_water), run(run)
  {
    const Unknowns u = run.statics.elastic(run.statics.u);
    blocks.follow({u, u, {}, run.statics.force});
  }

  void BlockObserver::follow()
  {
    const DynamicState &state = run.newmark->state();
    const Vector3 first = run.ground_acceleration(run.step - 1), last = run.ground_acceleration(run.step);
    Vector3       velocity, ground;
    for (unsigned int c = 0; c < 3; ++c)
    {
      velocity[c] = .5 * (run.base_velocity_before[c] + state.base_velocity[c]);
      ground[c] = .5 * (first[c] + last[c]);
    }
    Unknowns force = run.newmark->impulses();
    for (double &f : force)
      f /= run.motion.dt;
    const StaticState &statics = run.statics;
    blocks.follow({statics.elastic(run.u_before), statics.elastic(state.u), run.acceleration, force, ground,
                   velocity, run.motion.dt,
                   run.dam->water ? run.dam->water->mean_force() : std::vector<Vector3>()});
  }

  void BlockObserver::report(Log &log) const
  {
    if (const auto [safety, monolith] = blocks.last_safety(); blocks.has_safety() && run.n_steps > 0)
      log.line("Residual  at the end: sliding safety %.3g (monolith %d)", safety, monolith);
  }

  void BlockObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << blocks;
  }

  void BlockObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> blocks;
  }
} // namespace Voussoir
