// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  BlockObserver::BlockObserver(const RunState &run) : blocks(*run.dam, run.statics.joint_water), run(run)
  {
    follow();
  }

  void BlockObserver::follow()
  {
    const std::vector<double> water = run.crack_water ? run.crack_water->acting() : std::vector<double>();
    run.with_last_step([&](const StepOfDam &step) { blocks.follow(step, water); });
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
