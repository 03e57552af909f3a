// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/checkpoint.h>
#include <voussoir/base/error.h>
#include <voussoir/base/internal_error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/version.h>
#include <voussoir/output/archive.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the first @p n samples of a motion, three components each, with zeros after its end. */
    std::vector<double> beginning(const GroundMotion &motion, const std::size_t n)
    {
      std::vector<double> samples;
      for (std::size_t k = 0; k < n; ++k)
        for (const double a : motion.sample(k))
          samples.push_back(a);
      return samples;
    }
  } // namespace

  Checkpoint::Checkpoint(const Scene &scene, const std::string &scene_text, const std::string &directory)
      : scene(scene), scene_text(scene_text), directory(directory), file(directory + "/checkpoint.bin"),
        provenance(provenance_now())
  {
  }

  Provenance Checkpoint::provenance_now() const
  {
    const std::string revision = Voussoir::revision();
    Provenance        result = decisive_entries(scene_text);
    result["the program's revision"] = revision;
    if (revision == "unknown" || revision.find("dirty") != std::string::npos) // does not identify the program
      result["the program"] = digest_of_file("/proc/self/exe");
    for (const auto &input : scene.input_files())
      if (std::error_code error;
          std::filesystem::is_regular_file(input.second, error)) // other files: an error of the reader
        result["the file of " + input.first + " (" + std::filesystem::path(input.second).filename().string() +
               ")"] = digest_of_file(input.second);
    return result;
  }

  void Checkpoint::save(const RunState &run, const RunObservers &observers, const RunCounters &counters) const
  {
    std::ostringstream out(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(out);
      const DynamicState              state = run.integrator->state();
      const Energy                    first = run.integrator->initial_energy();
      const double wall = counters.wall(), cpu = counters.cpu(), largest = run.integrator->largest_energy();
      const std::vector<double> samples = beginning(run.motion, run.step + 1);
      std::vector<int>          pairs;
      for (const PairState state : run.pairs())
        pairs.push_back(static_cast<int>(state));
      archive << provenance << run.step << pairs << run.n_steps << run.motion.acceleration.size()
              << run.motion.dt << samples << wall << cpu << state << first << largest << counters
              << run.acceleration;
      for (const Observer *observer : observers)
        observer->save(archive);
      for (Neighbour *neighbour : run.dam->neighbours)
        for (const std::vector<double> *array : neighbour->state())
          archive << *array;
    }
    write_checkpoint_file(file, out.str());
    OutputFile note(directory + "/checkpoint.txt");
    note << "scene " << scene.name << "\nstep " << run.step << " of " << run.n_steps << "\ntime "
         << run.integrator->state().time << " s\nrevision " << revision() << "\n";
    note.check();
  }

  std::string Checkpoint::keep_last_state(const RunState &run, const RunObservers &observers,
                                          const RunCounters &counters) const
  {
    try
    {
      save(run, observers, counters);
      return " The state after step " + std::to_string(run.step) + " of " + std::to_string(run.n_steps) +
             " is kept in " + file + ". Remove the cause of the error, then continue with --resume.";
    }
    catch (const WriteError &)
    {
      if (!std::filesystem::is_directory(directory))
        return " The output directory " + directory +
               " no longer exists. If it was renamed and has a checkpoint, continue this with --resume and its new name "
               "as --output. Otherwise start the run again.";
      return exists()
                 ? " The checkpoint could not be written either. The previous checkpoint is intact. Free disk "
                   "space, then continue with --resume."
                 : " The checkpoint could not be written either. Free disk space, then start the run again.";
    }
  }

  void Checkpoint::remove() const
  {
    std::error_code ignored;
    for (const char *ending : {"", ".before", ".new"})
      std::filesystem::remove(file + ending, ignored);
    std::filesystem::remove(directory + "/checkpoint.txt", ignored);
  }

  bool Checkpoint::exists() const
  {
    return std::filesystem::exists(file) || std::filesystem::exists(file + ".before");
  }

  unsigned int Checkpoint::open(Log &log)
  {
    if (!exists())
      throw InputError(
          "There is no checkpoint " + file +
          " to resume from: the run is complete, or was stopped before its first checkpoint. Run "
          "without --resume, or set the output directory of the run with --output.");
    std::string warning;
    payload = read_checkpoint_file(file, warning);
    if (!warning.empty())
      log.line("warning: %s", warning.c_str());
    try
    {
      Provenance                      then;
      unsigned int                    step = 0;
      std::istringstream              in(payload, std::ios::binary);
      boost::archive::binary_iarchive archive(in);
      archive >> then;
      check_provenance(then, provenance, file);
      archive >> step;
      return step;
    }
    catch (const boost::archive::archive_exception &)
    {
      throw InputError(
          "The checkpoint " + file +
          " was written by another build of the program. Start again with --overwrite instead of "
          "--resume.");
    }
  }

  /** Throws InputError if the state of the rock is invalid for the present length of the motion. The run of
   * the checkpoint had @p n_steps_then steps, and its motion @p samples_then samples. */
  void Checkpoint::check_longer_motion(const RunState &run, const unsigned int n_steps_then,
                                       const std::size_t samples_then) const
  {
    if (!run.dam->foundation->resumes_longer_only())
      return;
    if (run.n_steps < n_steps_then)
      throw InputError(
          "The checkpoint " + file +
          " has a longer motion. On rock the free field has the length of the motion, so a run can only be "
          "resumed with a longer motion. Increase \"Motion/Duration\", or start again with --overwrite instead "
          "of --resume.");
    constexpr unsigned int ahead = 1; // steps of the rock ahead of the dam
    if (run.motion.acceleration.size() > samples_then && run.step + ahead + 1 >= samples_then)
      throw InputError(
          "The checkpoint " + file +
          " lies in the last two steps of the motion. The rock has already received the end, so the motion "
          "cannot be lengthened. Set the previous \"Motion/Duration\", or start again with --overwrite instead "
          "of --resume.");
  }

  void Checkpoint::check_motion(const RunState &run, const double dt,
                                const std::vector<double> &samples) const
  {
    if (dt != run.motion.dt || samples != beginning(run.motion, run.step + 1))
      throw InputError("The ground motion up to t = " + number_text(run.step * dt) +
                       " s differs from that of the checkpoint " + file +
                       ". An artificial motion depends on its duration from the first sample. Set the "
                       "previous \"Motion/Duration\", or start again with --overwrite instead of --resume.");
  }

  void Checkpoint::load_neighbours(const RunState &run, const unsigned int n_steps_then,
                                   boost::archive::binary_iarchive &archive) const
  {
    for (Neighbour *neighbour : run.dam->neighbours)
      for (std::vector<double> *array : neighbour->state())
      {
        std::vector<double> saved;
        archive >> saved;
        // With a longer motion the columns of the free field are longer; the added part is at rest.
        ensure(saved.size() == array->size() || (run.n_steps > n_steps_then && saved.size() < array->size()),
               "A saved array has another size.");
        std::fill(std::copy(saved.begin(), saved.end(), array->begin()), array->end(), 0.);
      }
  }

  void Checkpoint::load(RunState &run, const RunObservers &observers, RunCounters &counters, Log &log)
  {
    std::istringstream              in(payload, std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    Provenance                      then;
    unsigned int                    n_steps_then = 0;
    std::size_t                     samples_then = 0;
    double                          dt = 0., largest = 0.;
    std::vector<double>             samples;
    DynamicState                    state;
    Energy                          first;
    std::vector<int>                pairs;
    archive >> then >> run.step >> pairs >> n_steps_then >> samples_then >> dt >> samples;
    if (run.step > run.n_steps)
      throw InputError("The checkpoint " + file + " was written at t = " + number_text(run.step * dt) +
                       " s, but the motion now ends at " + number_text(run.n_steps * run.motion.dt) +
                       " s. Set \"Motion/Duration\" to at least " + number_text(run.step * dt) +
                       " s, or start again with --overwrite instead of --resume.");
    check_longer_motion(run, n_steps_then, samples_then);
    check_motion(run, dt, samples);
    archive >> counters.wall_before >> counters.cpu_before >> state >> first >> largest >> counters >>
        run.acceleration;
    run.integrator->resume(state, first, largest, run.statics.closed);
    for (Observer *observer : observers)
      observer->load(archive);
    load_neighbours(run, n_steps_then, archive);
    for (std::size_t p = 0; p < pairs.size() && p < run.pairs_at_start.size(); ++p)
      run.pairs_at_start[p] = static_cast<PairState>(pairs[p]);
    payload.clear();
    log.line("Resumed   at t = %.2f s, step %u of %u", run.integrator->state().time, run.step, run.n_steps);
  }
} // namespace Voussoir
