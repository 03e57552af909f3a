// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_observers_h
#define voussoir_run_observers_h

#include <voussoir/output/frame_observer.h>
#include <voussoir/output/stability_monitor.h>
#include <voussoir/output/wedge_observer.h>

#include <optional>

namespace Voussoir
{
  /** Observers of a run, in the order of their calls. */
  class RunObservers
  {
  public:
    /** @p run: state after RunState::start(). It must outlive the observers. */
    explicit RunObservers(const RunState &run);

    auto begin() const { return list.begin(); }
    auto end() const { return list.end(); }

    HistoryObserver              history;
    JointObserver                joints;
    StressObserver               stresses;
    std::optional<WaterObserver> water;  ///< if the water is acoustic
    std::optional<BlockObserver> blocks; ///< if the scene requests it
    std::optional<WedgeObserver> wedges; ///< if the scene has rock wedges

  private:
    StabilityObserver       stability;
    FieldObserver           fields;
    FrameObserver           frames;
    std::vector<Observer *> list;
  };
} // namespace Voussoir

#endif
