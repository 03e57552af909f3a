// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  void StabilityObserver::record()
  {
    const std::string instability = monitor.instability(*run.integrator, run.step, run.is_last());
    if (!instability.empty())
      throw ComputationError(instability);
  }
} // namespace Voussoir
