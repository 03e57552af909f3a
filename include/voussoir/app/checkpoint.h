// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_checkpoint_h
#define voussoir_checkpoint_h

#include <voussoir/app/run_counters.h>
#include <voussoir/app/run_observers.h>
#include <voussoir/output/checkpoint_file.h>

namespace Voussoir
{
  /** Saved state of a run in the output directory, from which --resume continues the run. */
  class Checkpoint
  {
  public:
    /** Reads the provenance. @p scene must outlive the object. @p scene_text: the scene with all defaults. */
    Checkpoint(const Scene &scene, const std::string &scene_text, const std::string &directory);

    /** Returns entries of the scene, digests of the input files and revision of the program at present. */
    Provenance provenance_now() const;

    /** Returns true if there is a checkpoint or a previous one. */
    bool exists() const;

    /** Reads the checkpoint file and returns the number of steps done. Throws InputError if there is no
     *  checkpoint, or if the checkpoint belongs to another scene. */
    unsigned int open(Log &log);

    /** Returns the content of the file that open() read, once. */
    std::string take_payload() { return std::move(payload); }

    /** Restores the state that open() read, on all ranks. Throws InputError if the ground motion differs. */
    void load(RunState &run, const RunObservers &observers, RunCounters &counters, Log &log);

    /** Writes the state between two steps, on the first rank. Throws WriteError. */
    void save(const RunState &run, const RunObservers &observers, const RunCounters &counters) const;

    /** Writes the state after a WriteError. Returns a sentence about the result for the message. */
    std::string keep_last_state(const RunState &run, const RunObservers &observers,
                                const RunCounters &counters) const;

    /** Removes the files of the checkpoint after a complete run. */
    void remove() const;

  private:
    void check_longer_motion(const RunState &run, unsigned int n_steps_then, std::size_t samples_then) const;
    void check_motion(const RunState &run, double dt, const std::vector<double> &samples) const;
    void load_neighbours(const RunState &run, unsigned int n_steps_then,
                         boost::archive::binary_iarchive &archive) const;

    const Scene      &scene;
    const std::string scene_text, directory, file;
    std::string       payload; ///< content of the file, from open() to load()

  public:
    const Provenance provenance; ///< entries, files and program at construction
  };
} // namespace Voussoir

#endif
