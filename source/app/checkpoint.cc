// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <deal.II/base/exceptions.h>

#include <voussoir/app/simulation.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  template <class Archive> void serialize(Archive &archive, Energy &e, unsigned int)
  {
    archive &e.kinetic &e.added_mass &e.strain &e.damping &e.friction &e.impact &e.input;
    archive &e.joint_stored &e.joint_fracture;
  }

  template <class Archive> void serialize(Archive &archive, DynamicState &s, unsigned int)
  {
    archive &s.time &s.u &s.v &s.force &s.load &s.Ku &s.base_velocity &s.energy &s.memory;
    archive &s.carried.left &s.carried.moved &s.carried.resisted &s.carried.dt;
  }

  namespace
  {
    /** The first @p n samples in a row, zero after the end of the motion. */
    std::vector<double> beginning(const GroundMotion &motion, const std::size_t n)
    {
      std::vector<double> samples;
      for (std::size_t k = 0; k < n; ++k)
        for (const double a : motion.sample(k))
          samples.push_back(a);
      return samples;
    }
  } // namespace

  void Simulation::save_checkpoint()
  {
    std::ostringstream out(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(out);
      DynamicState                    state = newmark->state();
      const Energy                    first = newmark->initial_energy();
      const double                    wall = clock_before + clock.seconds(),
                   cpu = cpu_before + double(std::clock()) / CLOCKS_PER_SEC,
                   largest = newmark->largest_energy();
      const std::vector<double> samples = beginning(motion, step + 1);
      std::vector<int>          pairs;
      for (const PairState state : step == start_step ? pairs_at_start : newmark->pair_states())
        pairs.push_back(static_cast<int>(state));
      archive << provenance << step << pairs << n_steps << motion.acceleration.size() << motion.dt << samples
              << wall << cpu << state << first << largest << count << history << energy << *joints
              << *envelope << solutions << acceleration;
      if (blocks)
        archive << *blocks;
      const bool is_estimating = companion != nullptr;
      archive << is_estimating;
      if (is_estimating)
      {
        const DynamicState beside = companion->newmark.state();
        archive << beside << *companion;
      }
      for (const std::vector<double> *array : dam->foundation->state())
        archive << *array;
    }
    write_checkpoint_file(checkpoint_name(), out.str());
    OutputFile note(directory + "/checkpoint.txt");
    note << "scene " << scene.name << "\nstep " << step << " of " << n_steps << "\ntime "
         << newmark->state().time << " s\nrevision " << VOUSSOIR_REVISION << "\n";
    note.check();
  }

  /** The signal to stop that has come to this process or another one of the run, or null. */
  const char *Simulation::signal() const
  {
    const char *own = interrupt->received();
    if (Ranks::any(own != nullptr ? 1 : 0) == 0)
      return nullptr;
    return own != nullptr ? own : "A signal to another process";
  }

  void Simulation::stop_if_asked() const
  {
    if (const char *signal = this->signal())
      throw Interrupted(signal +
                        std::string(" came before the shaking began: there is nothing to go on from") +
                        (options.resume ? " but the checkpoint that is there." : "."));
  }

  void Simulation::keep_and_stop(const char *signal)
  {
    collect();
    Ranks::on_first(
        [this]
        {
          save_checkpoint();
          write_tables();
        });
    std::ostringstream message;
    message << signal << " at t = " << newmark->state().time << " s, after step " << step << " of " << n_steps
            << ". The tables so far and a checkpoint are in " << directory
            << ": the same command with --resume goes on.";
    throw Interrupted(message.str());
  }

  /** After a file could not be written. */
  std::string Simulation::keep_last_state()
  {
    if (inside_step)
      return "";
    try
    {
      save_checkpoint();
      return " The state after step " + std::to_string(step) + " of " + std::to_string(n_steps) +
             " is kept in " + checkpoint_name() +
             ": make room, or clear the way, and the same command with --resume goes on.";
    }
    catch (const WriteError &)
    {
      return std::filesystem::exists(checkpoint_name()) ? " Nor can a checkpoint, but the one before is "
                                                          "there: make room, and --resume goes on from it."
                                                        : " Nor can a checkpoint.";
    }
  }

  /** Before anything is computed: is there a checkpoint, and is it this scene's? */
  void Simulation::open_checkpoint()
  {
    if (!std::filesystem::exists(checkpoint_name()) &&
        !std::filesystem::exists(checkpoint_name() + ".before"))
      throw InputError("There is no checkpoint " + checkpoint_name() +
                       " to resume from: the run has ended, or never reached one. Run "
                       "without --resume, or name the output directory of the run with --output.");
    if (options.overwrite)
      throw InputError("--resume goes on with what is in " + directory +
                       ", and --overwrite replaces it: give one of the two.");
    std::string warning;
    checkpoint = read_checkpoint_file(checkpoint_name(), warning);
    if (!warning.empty())
      log.line("warning: %s", warning.c_str());
    try
    {
      Provenance                      then;
      std::istringstream              in(checkpoint, std::ios::binary);
      boost::archive::binary_iarchive archive(in);
      archive >> then;
      check_provenance(then, provenance, checkpoint_name());
      archive >> start_step;
    }
    catch (const boost::archive::archive_exception &)
    {
      throw InputError("The checkpoint " + checkpoint_name() +
                       " is of another build of the program. Run without --resume.");
    }
  }

  /** InputError where the rock of the checkpoint, whose run had @p n_steps_then and whose motion had
   * @p samples_then, does not allow for the run and the motion of now. */
  void Simulation::check_longer_motion(const unsigned int n_steps_then, const std::size_t samples_then) const
  {
    if (!dam->foundation->resumes_longer_only())
      return;
    if (n_steps < n_steps_then)
      throw InputError(
          "The checkpoint " + checkpoint_name() +
          " is of a longer motion: on rock, whose free field is made for its length, a run can be "
          "resumed with a longer one only. Raise \"Motion/Duration\", or run without --resume.");
    constexpr unsigned int ahead = 1; // steps by which the rock knows the motion before the dam
    if (motion.acceleration.size() > samples_then && step + ahead + 1 >= samples_then)
      throw InputError(
          "The checkpoint " + checkpoint_name() +
          " was written at the end of its motion, after it, or a step before it: the rock, ahead of the "
          "dam, has felt that end already. It cannot be run on with a longer one. Set \"Motion/Duration\" as "
          "it "
          "was, or run without --resume.");
  }

  void Simulation::load_checkpoint()
  {
    std::istringstream              in(checkpoint, std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    Provenance                      then;
    unsigned int                    n_steps_then = 0;
    std::size_t                     samples_then = 0;
    double                          dt = 0., largest = 0.;
    std::vector<double>             samples;
    DynamicState                    state;
    Energy                          first;
    std::vector<int>                pairs;
    archive >> then >> step >> pairs >> n_steps_then >> samples_then >> dt >> samples;
    if (step > n_steps)
      throw InputError("The checkpoint " + checkpoint_name() + " was written after step " +
                       std::to_string(step) + ", but the motion now ends after " + std::to_string(n_steps) +
                       ". Raise \"Motion/Duration\", or run without --resume.");
    check_longer_motion(n_steps_then, samples_then);
    if (dt != motion.dt || samples != beginning(motion, step + 1))
      throw InputError(
          "The motion differs from that of the checkpoint " + checkpoint_name() +
          " before the time at which it was written; an artificial motion depends on its duration "
          "from the beginning. Set \"Motion/Duration\" as it was, or run without --resume.");
    archive >> clock_before >> cpu_before >> state >> first >> largest >> count >> history >> energy >>
        *joints >> *envelope >> solutions >> acceleration;
    if (blocks)
      archive >> *blocks;
    bool was_estimating = false;
    archive >> was_estimating;
    if (!was_estimating)
      companion.reset();
    if (companion)
    {
      DynamicState beside;
      archive >> beside >> *companion;
      companion->newmark.resume(beside, first, largest, statics.closed);
    }
    for (std::vector<double> *array : dam->foundation->state())
    {
      std::vector<double> saved;
      archive >> saved;
      // Of a longer motion the free field's endless columns are longer, and still at rest there.
      AssertThrow(saved.size() == array->size() || (n_steps > n_steps_then && saved.size() < array->size()),
                  dealii::ExcInternalError());
      std::fill(std::copy(saved.begin(), saved.end(), array->begin()), array->end(), 0.);
    }
    for (std::size_t p = 0; p < pairs.size() && p < pairs_at_start.size(); ++p)
      pairs_at_start[p] = static_cast<PairState>(pairs[p]);
    newmark->resume(state, first, largest, statics.closed);
    checkpoint.clear();
    log.line("Resumed   at t = %.2f s, step %u of %u", newmark->state().time, step, n_steps);
  }

  Provenance Simulation::provenance_now() const
  {
    const std::string revision = VOUSSOIR_REVISION;
    Provenance        result = decisive_entries(scene_text);
    result["the program's revision"] = revision;
    if (revision == "unknown" || revision.find("dirty") != std::string::npos) // says little
      result["the program"] = digest_of_file("/proc/self/exe");
    for (const auto &input : scene.input_files())
      if (std::error_code error;
          std::filesystem::is_regular_file(input.second, error)) // else reading it says so
        result["the file of " + input.first + " (" + std::filesystem::path(input.second).filename().string() +
               ")"] = digest_of_file(input.second);
    return result;
  }
} // namespace Voussoir
