// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_checkpoint_h
#define voussoir_checkpoint_h

#include <voussoir/app/run_counters.h>
#include <voussoir/app/run_observers.h>
#include <voussoir/output/checkpoint_file.h>

namespace Voussoir
{
  /** The saved state of a run in its output directory, with which --resume continues the run. */
  class Checkpoint
  {
  public:
    /** Reads what the run depends on: entries, files, program. @p scene_text: the scene with all defaults. */
    Checkpoint(const Scene &scene, const std::string &scene_text, const std::string &directory);

    /** Entries, files and program as they are now. */
    Provenance provenance_now() const;

    bool exists() const; ///< the checkpoint or the one before it

    /** Reads the checkpoint before anything is computed. Throws InputError if there is none, or if it belongs
     *  to another scene. Returns the number of steps done. */
    unsigned int open(Log &log);

    /** Restores the state that open() read, on all ranks. Throws InputError if the ground motion differs. */
    void load(RunState &run, const RunObservers &observers, RunCounters &counters, Log &log);

    /** Writes the state between two steps, on the first rank. Throws WriteError. */
    void save(const RunState &run, const RunObservers &observers, const RunCounters &counters) const;

    /** Writes the state after a file could not be written. Returns a sentence about the result. */
    std::string keep_last_state(const RunState &run, const RunObservers &observers,
                                const RunCounters &counters) const;

    void remove() const; ///< the run is complete

  private:
    void check_longer_motion(const RunState &run, unsigned int n_steps_then, std::size_t samples_then) const;
    void check_motion(const RunState &run, double dt, const std::vector<double> &samples) const;
    void load_foundation(const RunState &run, unsigned int n_steps_then,
                         boost::archive::binary_iarchive &archive) const;

    const Scene      &scene;
    const std::string scene_text, directory, file;
    std::string       payload; ///< from open() to load()

  public:
    const Provenance provenance; ///< entries, files and program when the object was made
  };
} // namespace Voussoir

#endif
