// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  void StabilityObserver::record()
  {
    const std::string trouble = watch.trouble(*run.newmark, run.step, run.is_last());
    if (!trouble.empty())
      throw ComputationError(trouble);
  }
} // namespace Voussoir
