// SPDX-License-Identifier: GPL-3.0-or-later
// What is kept of each step: by every rank, and by the first one for all.

#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/face_pressure.h>

#include <algorithm>
#include <sys/resource.h>

namespace Voussoir
{
  /** The first rank gets all that is to be kept. */
  void Simulation::collect()
  {
    dam->foundation->collect();
    collect_stresses();
  }

  /** An error of the first rank finds the whole state there, to be kept. */
  void Simulation::record_on_first(const std::function<void()> &action)
  {
    try
    {
      Ranks::on_first(action);
    }
    catch (...)
    {
      collect();
      throw;
    }
  }

  /** After a step, from these displacements and this velocity of the base. */
  void Simulation::follow_blocks(const Unknowns &u_before, const Vector3 &base_before)
  {
    if (!blocks)
      return;
    const Vector3 base = newmark->state().base_velocity, first = ground_acceleration(step),
                  last = ground_acceleration(step + 1);
    Vector3 velocity, ground;
    for (unsigned int c = 0; c < 3; ++c)
    {
      velocity[c] = .5 * (base_before[c] + base[c]);
      ground[c] = .5 * (first[c] + last[c]);
    }
    Unknowns force = newmark->impulses();
    for (double &f : force)
      f /= motion.dt;
    blocks->follow({u_before, newmark->state().u, acceleration, force, ground, velocity, motion.dt});
  }

  /** Of this rank's nodes; of all where the first rank is about to read them. */
  void Simulation::record_stresses()
  {
    if (scene.output.envelope_interval == 0)
      return;
    const Stopwatch watch;
    if (step % scene.output.envelope_interval == 0)
      envelope->record(newmark->state().time, newmark->state().u, known_tractions());
    if (step % scene.output.progress_interval == 0 || step == n_steps)
      collect_stresses();
    count.seconds_stresses += watch.seconds();
  }

  void Simulation::collect_stresses()
  {
    envelope->collect();
    if (companion)
      companion->collect();
  }

  /** Those that the recovery takes. */
  std::vector<Vector3> Simulation::known_tractions()
  {
    return scene.output.knows_tractions() ? tractions->at(newmark->state().force, acceleration)
                                          : std::vector<Vector3>();
  }

  void Simulation::record()
  {
    const Stopwatch watch;
    joints->record(*newmark);
    if (const std::string trouble = stability->trouble(*newmark, *joints, step, step == n_steps);
        !trouble.empty())
    {
      joints->history.rows.pop_back(); // like the other tables
      write_tables();
      throw ComputationError(trouble + " The tables in " + directory + " end before it.");
    }
    history_columns->record();
    energy_columns->record();
    history_file.append(history);
    energy_file.append(energy);
    joint_file.append(joints->history);
    if (blocks)
    {
      blocks->record(newmark->state().time);
      block_file.append(blocks->history);
    }
    if (scene.output.solution_interval > 0 && step % scene.output.solution_interval == 0)
      write_solution();
    count.seconds_output += watch.seconds();
  }

  void Simulation::gather_per_rank()
  {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double n = std::max(1u, step - first_step);
    per_rank.work = Ranks::of_all(Ranks::work() - per_rank.work_before);
    per_rank.rock_work = Ranks::of_all(dam->foundation->work());
    per_rank.messages = Ranks::of_all((Ranks::n_messages() - per_rank.messages_before) / n);
    per_rank.memory = Ranks::of_all(1024. * usage.ru_maxrss);
  }
} // namespace Voussoir
