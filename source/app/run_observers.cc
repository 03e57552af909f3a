// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/run_observers.h>

namespace Voussoir
{
  RunObservers::RunObservers(const RunState &run)
      : history(run), joints(run), stresses(run, joints.joints), stability(run), fields(run, stresses),
        frames(run, stresses), list{&stability, &joints, &history}
  {
    if (run.scene().output.block_forces)
      list.push_back(&blocks.emplace(run));
    if (!run.scene().limits.wedges.empty())
      list.push_back(&wedges.emplace(run));
    if (run.dam->water && run.n_steps > 0)
    {
      list.push_back(&water.emplace(run));
      stresses.water = &*water;
    }
    list.insert(list.end(), {&stresses, &fields, &frames});
  }
} // namespace Voussoir
