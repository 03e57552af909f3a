// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/ensemble.h>
#include <voussoir/app/run_report.h>
#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/base/lanes.h>
#include <voussoir/output/archive.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <filesystem>
#include <mutex>
#include <omp.h>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    std::vector<MotionParameters> motions_of(const std::vector<EnsembleMember> &members)
    {
      std::vector<MotionParameters> result;
      for (const EnsembleMember &member : members)
        result.push_back(member.motion);
      return result;
    }

    /** Returns the first sentence of a message. */
    std::string first_sentence(const std::string &message)
    {
      return message.substr(0, message.find(". "));
    }
  } // namespace

  EnsembleRun::EnsembleRun(const Scene &scene, const std::string &scene_text, const RunOptions &options,
                           const SceneOf &scene_of)
      : RunSetup(scene, scene_text, options), scene_of(scene_of), members(scene.motion.members()),
        is_done(members.size(), false)
  {
    for (const EnsembleMember &member : members)
    {
      results.motions.emplace_back();
      results.motions.back().name = member.name;
      results.motions.back().factor = member.factor;
    }
  }

  void EnsembleRun::run()
  {
    if (Ranks::size() > 1)
      throw InputError(
          "\"Motion/Ensemble\" runs in one process. Use threads (OMP_NUM_THREADS), or remove the entry.");
    const auto of_setup =
        std::find_if(members.begin(), members.end(),
                     [&](const EnsembleMember &member) { return member.factor == results.factor(); });
    prepare(motions_of(members), of_setup - members.begin());
    log.line("Ensemble  %zu motions; the motion above is the first one, %s", members.size(),
             of_setup->name.c_str());
    for (std::size_t k = 0; k < members.size(); ++k)
      if (members[k].factor == of_setup->factor && &members[k] != &*of_setup)
        report_motion_warnings(all_motions[k], scene, members[k].name + ": ", log);
    if (options.validate)
      return;
    if (options.resume)
      load();
    begin_files();
    loop_clock = Stopwatch();
    n_before = std::count(is_done.begin(), is_done.end(), true);
    const double before = double(std::clock()) / CLOCKS_PER_SEC;
    find_static_state();
    if (const std::string reason = why_no_batch(state); reason.empty())
      run_batches();
    else
      run_one_by_one(reason);
    counters.shaking = loop_clock.seconds() - counters.statics;
    counters.shaking_cpu = double(std::clock()) / CLOCKS_PER_SEC - before;
    finish();
  }

  std::string EnsembleRun::directory_of(const std::size_t number) const
  {
    return directory + "/motion-" + std::to_string(number + 1);
  }

  void EnsembleRun::load()
  {
    std::istringstream              in(checkpoint.take_payload(), std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    Provenance                      then;
    unsigned int                    n_done = 0;
    archive >> then >> n_done >> is_done >> results.motions;
    log.line("Resumed   %u of %zu motions are complete", n_done, members.size());
  }

  void EnsembleRun::save()
  {
    std::ostringstream out(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(out);
      const unsigned int              n_done = std::count(is_done.begin(), is_done.end(), true);
      archive << checkpoint.provenance << n_done << is_done << results.motions;
    }
    write_checkpoint_file(directory + "/checkpoint.bin", out.str());
  }

  void EnsembleRun::begin_files()
  {
    run_directory.begin(options.resume, false);
    log.open(directory + "/log.txt", options.resume);
    OutputFile out(directory + "/scene.prm");
    out << scene_text;
    out.check();
    write_tables_of_start(state, directory);
    run_directory.expect_tables();
  }

  /** Runs one motion in a directory of its own. */
  void EnsembleRun::run_one(const std::size_t number, const bool keep_tables)
  {
    auto [own, text] = scene_of(members[number]);
    own.output.figures = own.output.figures && keep_tables;
    RunOptions of_run;
    of_run.output = directory_of(number);
    of_run.quiet = true;
    of_run.resume = options.resume && std::filesystem::exists(of_run.output + "/checkpoint.bin");
    of_run.overwrite = !of_run.resume;
    MotionResult result;
    try
    {
      Simulation simulation(own, text, of_run);
      simulation.run();
      result = simulation.result();
    }
    catch (const Interrupted &)
    {
      save(); // also if no motion is complete: the motion has a checkpoint of its own
      throw_interrupted();
    }
    catch (const WriteError &)
    {
      throw;
    }
    catch (const ComputationError &error)
    {
      result.failure = error.what();
    }
    if (!is_done[number])
      add(number, std::move(result));
    else if (!result.failure.empty())
      log.line("warning: the tables of motion %zu end early: %s", number + 1,
               first_sentence(result.failure).c_str());
    if (!keep_tables)
      RunDirectory::remove_results(of_run.output);
  }

  /** Adds the result of a motion, and prints a line. */
  void EnsembleRun::add(const std::size_t number, MotionResult result)
  {
    result.name = members[number].name;
    result.factor = members[number].factor;
    result.failure = first_sentence(result.failure);
    is_done[number] = true;
    const std::size_t n_done = std::count(is_done.begin(), is_done.end(), true);
    const double      elapsed = loop_clock.seconds();
    const std::string name =
        result.name + (result.factor == 1. ? "" : " times " + number_text(result.factor));
    const std::string left = clock_time(elapsed / (n_done - n_before) * (members.size() - n_done));
    if (result.failure.empty())
      log.line("%5zu of %zu  %-20s  opening %8.2f mm  slip %8.2f mm  elapsed %s  left %s", number + 1,
               members.size(), name.c_str(), 1e3 * result.extremes[0].second, 1e3 * result.extremes[1].second,
               clock_time(elapsed).c_str(), left.c_str());
    else
      log.line("%5zu of %zu  %-20s  failed: %s", number + 1, members.size(), name.c_str(),
               result.failure.c_str());
    results.motions[number] = std::move(result);
  }

  void EnsembleRun::run_one_by_one(const std::string &reason)
  {
    log.line("\nEnsemble  %zu motions, one after another, because %s", members.size(), reason.c_str());
    for (std::size_t k = 0; k < members.size(); ++k)
      if (!is_done[k])
      {
        if (signal() != nullptr)
        {
          save();
          throw_interrupted();
        }
        run_one(k, members[k].has_output);
        save();
      }
  }

  /** Runs a batch. @p numbers: of its motions. @p is_first: prints the progress. */
  void EnsembleRun::run_batch(BatchRun &batch, const std::vector<std::size_t> &numbers, const bool is_first)
  {
    constexpr double report_interval = 10.; // [s]
    for (unsigned int step = 0; step < batch.n_steps(); ++step)
    {
      if (InterruptGuard::received() != nullptr)
        return;
      batch.advance();
      if (is_first && report_clock.seconds() > report_interval)
      {
        report_clock = Stopwatch();
        const std::lock_guard<std::mutex> lock(results_mutex);
        log.line("          t = %.2f s of %.2f s", (step + 1) * state.motion.dt,
                 batch.n_steps() * state.motion.dt);
      }
    }
    const std::lock_guard<std::mutex> lock(results_mutex);
    for (const std::size_t number : numbers)
      is_done[number] = true;
    for (std::size_t k = 0; k < numbers.size(); ++k)
      add(numbers[k], batch.result(k));
    save();
  }

  void EnsembleRun::run_batches()
  {
    const BatchModel model(
        state.dam->structure, state.dam->layout.laws, state.motion.dt, scene.n_explicit,
        {state.dam->inertia, state.statics.u, state.statics.constant_load(), state.statics.closed});
    const JointObserver  joints(state);
    const StressObserver stresses(state, joints.joints);
    lanes = n_lanes();
    std::vector<std::vector<std::size_t>> batches;
    for (std::size_t k = 0; k < members.size(); ++k)
      if (!is_done[k])
      {
        if (batches.empty() || batches.back().size() == lanes)
          batches.emplace_back();
        batches.back().push_back(k);
      }
    log.line("\nEnsemble  %zu motions in batches of %u, %zu of %zu batches left", members.size(), lanes,
             batches.size(), (members.size() + lanes - 1) / lanes);
    std::exception_ptr error;
#pragma omp parallel for schedule(dynamic) if (int(batches.size()) >= omp_get_max_threads())
    for (std::size_t b = 0; b < batches.size(); ++b)
      try
      {
        std::vector<const GroundMotion *> motions;
        for (const std::size_t number : batches[b])
          motions.push_back(&all_motions[number]);
        BatchRun batch(state, model, stresses, motions);
        run_batch(batch, batches[b], b == 0);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(results_mutex);
        error = std::current_exception();
      }
    if (error)
      std::rethrow_exception(error);
    if (InterruptGuard::received() != nullptr)
    {
      save();
      throw_interrupted();
    }
    for (std::size_t k = 0; k < members.size(); ++k)
      if (members[k].has_output)
        run_one(k, true);
  }

  /** Throws Interrupted with the number of complete motions. */
  void EnsembleRun::throw_interrupted() const
  {
    const std::size_t n_done = std::count(is_done.begin(), is_done.end(), true);
    throw Interrupted(InterruptGuard::received() + std::string(" was received when ") +
                      std::to_string(n_done) + " of " + std::to_string(members.size()) +
                      " motions were complete. Continue with the same command and "
                      "--resume" +
                      (options.overwrite ? " instead of --overwrite." : "."));
  }

  void EnsembleRun::finish()
  {
    results.write(directory, *state.dam);
    results.report(log);
    write_ensemble_summary(directory, state, results.json(lanes), counters, log);
    checkpoint.remove();
    report_error_bars(scene, directory, log);
    if (scene.output.figures)
      report_figures(directory, log);
    log.line("Results   %s", directory.c_str());
    if (const std::vector<std::string> failures = results.failures(); !failures.empty())
      throw ComputationError(
          std::to_string(failures.size()) + " of " + std::to_string(members.size()) +
          " motions have no results: " + failures.front() + (failures.size() > 1 ? " and others" : "") +
          ". The statistics are of the other motions. The results are in " + directory + ".");
  }
} // namespace Voussoir
