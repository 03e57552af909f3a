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
  /** Work of a run: iterations and seconds. Those of resumed runs include the work before. */
  struct RunCounters
  {
    std::array<unsigned int, 4> path{}; ///< number of steps by ContactPath
    double newton = 0., newton_max = 0., krylov = 0., factorisations = 0., gauss_seidel = 0., residual = 0.;
    /** Seconds of wall time, by part. */
    double setup = 0., statics = 0., substitutions = 0., joints = 0., rock = 0., stepping = 0., output = 0.,
           shaking = 0.;
    double shaking_cpu = 0.; ///< of all threads [s]

    Stopwatch clock;                             ///< of this process
    double    wall_before = 0., cpu_before = 0.; ///< of the processes that this one continues [s]

    double wall() const { return wall_before + clock.seconds(); }
    double cpu() const { return cpu_before + double(std::clock()) / CLOCKS_PER_SEC; }

    void add(const ContactResult &result);

    Json json_of_times(const RunState &run, double stresses) const;
    Json json_of_newton(unsigned int n_steps) const;
    Json json_of_path() const;

    /** Prints the wall time per step, by part. @p stresses: of their recovery [s]. */
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
    void start();
    void gather(const RunState &run); ///< all ranks, at the end of the time loop
    Json json() const;

  private:
    double              work_before = 0., messages_before = 0.;
    std::vector<double> work, rock_work, messages, memory; ///< [s], [s], per step, [bytes]
  };

  double largest_memory_consumption(); ///< of this process so far [bytes]
} // namespace Voussoir

#endif
