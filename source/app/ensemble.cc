// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/ensemble.h>
#include <voussoir/app/run_report.h>
#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/output/archive.h>

#include <algorithm>
#include <filesystem>
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
      throw InputError("\"Motion/Ensemble\" runs in one process. Use threads (OMP_NUM_THREADS), or remove the entry.");
    prepare(motions_of(members));
    if (options.validate)
      return;
    if (options.resume)
      load();
    begin_files();
    loop_clock = Stopwatch();
    n_before = std::count(is_done.begin(), is_done.end(), true);
    run_one_by_one();
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
      const std::size_t n_done = std::count(is_done.begin(), is_done.end(), true);
      throw Interrupted(InterruptGuard::received() + std::string(" was received in motion ") +
                        std::to_string(number + 1) + ". " + std::to_string(n_done) + " of " +
                        std::to_string(members.size()) + " motions are complete. Continue with the same command and --resume" +
                        (options.overwrite ? " instead of --overwrite." : "."));
    }
    catch (const WriteError &)
    {
      throw;
    }
    catch (const ComputationError &error)
    {
      result.failure = first_sentence(error.what());
    }
    if (!is_done[number])
      add(number, std::move(result));
    if (!keep_tables)
      std::filesystem::remove_all(of_run.output);
  }

  /** Adds the result of a motion, and prints a line. */
  void EnsembleRun::add(const std::size_t number, MotionResult result)
  {
    result.name = members[number].name;
    result.factor = members[number].factor;
    is_done[number] = true;
    const std::size_t n_done = std::count(is_done.begin(), is_done.end(), true);
    const double      elapsed = loop_clock.seconds();
    const std::string name =
        result.name + (result.factor == 1. ? "" : " times " + number_text(result.factor));
    const std::string left = clock_time(elapsed / (n_done - n_before) * (members.size() - n_done));
    if (result.failure.empty())
      log.line("%5zu of %zu  %-20s  opening %8.2f mm  slip %8.2f mm  elapsed %s  left %s", number + 1, members.size(),
               name.c_str(), 1e3 * result.extremes[0].second, 1e3 * result.extremes[1].second,
               clock_time(elapsed).c_str(), left.c_str());
    else
      log.line("%5zu of %zu  %-20s  failed: %s", number + 1, members.size(), name.c_str(), result.failure.c_str());
    results.motions[number] = std::move(result);
  }

  void EnsembleRun::run_one_by_one()
  {
    log.line("\nEnsemble  %zu motions, one after another", members.size());
    for (std::size_t k = 0; k < members.size(); ++k)
      if (!is_done[k])
      {
        stop_if_asked();
        run_one(k, members[k].has_output);
        save();
      }
  }

  void EnsembleRun::finish()
  {
    results.write(directory, *state.dam);
    results.report(log);
    write_ensemble_summary(directory, state, results.json(lanes), counters, log);
    checkpoint.remove();
    if (scene.output.figures)
      report_figures(directory, log);
    log.line("Results   %s", directory.c_str());
    if (const std::vector<std::string> failures = results.failures(); !failures.empty())
      throw ComputationError(std::to_string(failures.size()) + " of " + std::to_string(members.size()) +
                             " motions have no results: " + failures.front() +
                             (failures.size() > 1 ? " and others" : "") +
                             ". The statistics are of the other motions. The results are in " + directory + ".");
  }
} // namespace Voussoir
