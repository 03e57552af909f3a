// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/run_counters.h>
#include <voussoir/base/ranks.h>

#include <sys/resource.h>

#include <algorithm>

namespace Voussoir
{
  void RunCounters::add(const ContactResult &result)
  {
    ++path[static_cast<unsigned int>(result.path)];
    newton += result.iterations;
    newton_max = std::max<double>(newton_max, result.iterations);
    krylov += result.krylov;
    factorisations += result.factorisations;
    gauss_seidel += result.sweeps;
    residual = std::max(residual, result.residual);
  }

  Json RunCounters::json_of_times(const RunState &run, const double stresses) const
  {
    Json json;
    json.add("wall", wall())
        .add("cpu", cpu())
        .add("setup", setup)
        .add("static", statics)
        .add("shaking", shaking)
        .add("shaking_cpu", shaking_cpu)
        .add("substitutions", substitutions)
        .add("sweeps", substitutions) // the name until 0.3
        .add("joints", joints)
        .add("stepping", stepping)
        .add("rock", rock)
        .add("stresses", stresses)
        .add("output", output)
        .add("per_second_of_earthquake", run.n_steps > 0 ? shaking / run.grid().duration() : 0.);
    return json;
  }

  Json RunCounters::json_of_newton(const unsigned int n_steps) const
  {
    const double n = std::max(1u, n_steps);
    Json         json;
    json.add("mean", newton / n)
        .add("max", newton_max)
        .add("linear_iterations_mean", krylov / n)
        .add("joint_factorisations_mean", factorisations / n)
        .add("gauss_seidel_iterations", gauss_seidel)
        .add("sweeps", gauss_seidel); // the name until 0.3
    return json;
  }

  Json RunCounters::json_of_path() const
  {
    Json json;
    for (unsigned int i = 0; i < path.size(); ++i)
      json.add(name(static_cast<ContactPath>(i)), path[i]);
    return json;
  }

  void RunCounters::report(const RunState &run, const double stresses, Log &log) const
  {
    const double ms = 1e3 / run.n_steps;
    log.line("Speed     %.2f s of wall time per second of shaking; per step %.1f ms: substitutions %.1f, "
             "joints %.1f, stepping %.1f, stresses %.1f, output %.1f",
             shaking / run.grid().duration(), ms * shaking, ms * substitutions, ms * joints, ms * stepping,
             ms * stresses, ms * output);
  }

  void RankCounters::start()
  {
    work_before = Ranks::work();
    messages_before = Ranks::n_messages();
  }

  void RankCounters::gather(const RunState &run)
  {
    const double n = std::max(1u, run.step - run.start_step);
    work = Ranks::of_all(Ranks::work() - work_before);
    double of_neighbours = 0.;
    for (const Neighbour *neighbour : run.dam->neighbours)
      of_neighbours += neighbour->work();
    rock_work = Ranks::of_all(of_neighbours);
    messages = Ranks::of_all((Ranks::n_messages() - messages_before) / n);
    memory = Ranks::of_all(largest_memory_consumption());
  }

  Json RankCounters::json() const
  {
    Json json;
    json.add_list("work_seconds", work)
        .add_list("rock_work_seconds", rock_work)
        .add_list("messages_per_step", messages)
        .add_list("memory_bytes", memory);
    return json;
  }

  double largest_memory_consumption()
  {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * usage.ru_maxrss;
  }
} // namespace Voussoir
