// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_counters_h
#define voussoir_run_counters_h

#include <voussoir/base/log.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/output/run_state.h>

#include <array>
#include <ctime>

namespace Voussoir
{
  /** Iterations and wall times of a run. For a resumed run they include those of the previous processes. */
  struct RunCounters
  {
    std::array<unsigned int, 4> path{}; ///< number of steps by ContactPath
    /** Iterations, summed over the steps; largest number in a step; largest residual of the joints [-]. */
    double newton = 0., newton_max = 0., krylov = 0., factorisations = 0., gauss_seidel = 0., residual = 0.;
    /** Wall time of each part of the run [s]. */
    double setup = 0., statics = 0., substitutions = 0., joints = 0., rock = 0., stepping = 0., output = 0.,
           shaking = 0.;
    double shaking_cpu = 0.; ///< CPU time of the time loop, all threads [s]

    Stopwatch clock;                             ///< wall time of this process
    double    wall_before = 0., cpu_before = 0.; ///< of the previous processes of a resumed run [s]

    /** Returns the wall time of the run [s]. */
    double wall() const { return wall_before + clock.seconds(); }

    /** Returns the CPU time of the run, all threads [s]. */
    double cpu() const { return cpu_before + double(std::clock()) / CLOCKS_PER_SEC; }

    /** Adds the iterations of a step. */
    void add(const ContactResult &result);

    /** Returns "seconds" of summary.json. @p stresses: wall time of the stress recovery [s]. */
    Json json_of_times(const RunState &run, double stresses) const;

    /** Returns "newton_iterations" of summary.json. */
    Json json_of_newton(unsigned int n_steps) const;

    /** Returns "contact_path" of summary.json: number of steps by ContactPath. */
    Json json_of_path() const;

    /** Prints the wall time per step of each part. @p stresses: wall time of the stress recovery [s]. */
    void report(const RunState &run, double stresses, Log &log) const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      for (unsigned int &n : path)
        archive &n;
      archive &newton &newton_max &krylov &factorisations &gauss_seidel               &residual;
      archive &setup &statics &substitutions &joints &rock &stepping &output &shaking &shaking_cpu;
    }
  };

  /** CPU time, messages and memory of the ranks during the time loop. */
  class RankCounters
  {
  public:
    /** Stores the counters at the start of the time loop. */
    void start();

    /** Gathers the counters at the end of the time loop. All ranks. */
    void gather(const RunState &run);

    /** Returns "per_rank" of summary.json. */
    Json json() const;

  private:
    double              work_before = 0., messages_before = 0.;
    std::vector<double> work, rock_work, messages, memory; ///< per rank: [s], [s], per step, [bytes]
  };

  /** Returns the largest memory consumption of this process so far [bytes]. */
  double largest_memory_consumption();
} // namespace Voussoir

#endif
