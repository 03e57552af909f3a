#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <deal.II/base/exceptions.h>

#include <voussoir/simulation.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  template <class Archive> void serialize(Archive &archive, Energy &e, unsigned int)
  {
    archive &e.kinetic &e.added_mass &e.strain &e.damping &e.friction &e.impact &e.input;
  }

  template <class Archive> void serialize(Archive &archive, DynamicState &s, unsigned int)
  {
    archive &s.time &s.u &s.v &s.force &s.load &s.Ku &s.base_velocity &s.energy;
  }

  namespace
  {
    /** The first @p n samples in a row. */
    std::vector<double> beginning(const GroundMotion &motion, const std::size_t n)
    {
      std::vector<double> samples;
      for (std::size_t k = 0; k < std::min(n, motion.acceleration.size()); ++k)
        samples.insert(samples.end(), motion.acceleration[k].begin(), motion.acceleration[k].end());
      return samples;
    }

    constexpr const char *revision_name = "the program's revision";
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
      archive << provenance << step << n_steps << motion.dt << samples << wall << cpu << state << first
              << largest << count << history << energy << *joints << *envelope << solutions;
      if (dam->foundation && n_steps > 0)
        for (const std::vector<double> *array : dam->foundation->state())
          archive << *array;
    }
    write_checkpoint_file(checkpoint_name(), out.str());
    OutputFile note(directory + "/checkpoint.txt");
    note << "scene " << scene.name << "\nstep " << step << " of " << n_steps << "\ntime "
         << newmark->state().time << " s\nrevision " << VOUSSOIR_REVISION << "\n";
    note.check();
  }

  void Simulation::stop_if_asked() const
  {
    if (const char *signal = interrupt.received())
      throw Interrupted(signal +
                        std::string(" came before the shaking began: there is nothing to go on from") +
                        (options.resume ? " but the checkpoint that is there." : "."));
  }

  void Simulation::keep_and_stop()
  {
    save_checkpoint();
    write_tables();
    std::ostringstream message;
    message << interrupt.received() << " at t = " << newmark->state().time << " s, after step " << step
            << " of " << n_steps << ". The tables so far and a checkpoint are in " << directory
            << ": the same command with --resume goes on.";
    throw Interrupted(message.str());
  }

  /** After a file could not be written. */
  std::string Simulation::keep_last_state()
  {
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
    std::string warning;
    checkpoint = read_checkpoint_file(checkpoint_name(), warning);
    if (!warning.empty())
      log.line("warning: %s", warning.c_str());
    Provenance                      then;
    std::istringstream              in(checkpoint, std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    archive >> then;
    check_provenance(then, provenance, checkpoint_name());
  }

  void Simulation::load_checkpoint()
  {
    std::istringstream              in(checkpoint, std::ios::binary);
    boost::archive::binary_iarchive archive(in);
    Provenance                      then;
    unsigned int                    n_steps_then = 0;
    double                          dt = 0., largest = 0.;
    std::vector<double>             samples;
    DynamicState                    state;
    Energy                          first;
    archive >> then >> step >> n_steps_then >> dt >> samples;
    if (step > n_steps)
      throw InputError("The checkpoint " + checkpoint_name() + " was written after step " +
                       std::to_string(step) + ", but the motion now ends after " + std::to_string(n_steps) +
                       ". Raise \"Motion/Duration\", or run without --resume.");
    if (dam->foundation && n_steps < n_steps_then)
      throw InputError(
          "The checkpoint " + checkpoint_name() +
          " is of a longer motion: on rock, whose free field is made for its length, a run can be "
          "resumed with a longer one only. Raise \"Motion/Duration\", or run without --resume.");
    if (dt != motion.dt || samples != beginning(motion, step + 1))
      throw InputError(
          "The motion differs from that of the checkpoint " + checkpoint_name() +
          " before the time at which it was written; an artificial motion depends on its duration "
          "from the beginning. Set \"Motion/Duration\" as it was, or run without --resume.");
    archive >> clock_before >> cpu_before >> state >> first >> largest >> count >> history >> energy >>
        *joints >> *envelope >> solutions;
    if (dam->foundation && n_steps > 0)
      for (std::vector<double> *array : dam->foundation->state())
      {
        std::vector<double> saved;
        archive >> saved;
        // Of a longer motion the free field's endless columns are longer, and still at rest there.
        AssertThrow(saved.size() == array->size() || (n_steps > n_steps_then && saved.size() < array->size()),
                    dealii::ExcInternalError());
        std::fill(std::copy(saved.begin(), saved.end(), array->begin()), array->end(), 0.);
      }
    newmark->resume(state, first, largest, Unknowns(state.force.size(), 0.));
    checkpoint.clear();
    log.line("Resumed   at t = %.2f s, step %u of %u", newmark->state().time, step, n_steps);
    // What a full disk kept from being written.
    if (scene.output.solution_interval > 0 && step % scene.output.solution_interval == 0 &&
        (solutions.empty() || solutions.back().first != newmark->state().time))
      write_solution();
  }

  void Simulation::note_provenance()
  {
    provenance = decisive_entries(scene_text);
    provenance[revision_name] = VOUSSOIR_REVISION;
    for (const std::string &file : scene.input_files())
      if (std::filesystem::is_regular_file(file)) // else reading it will say so
        provenance["the file " + file] = digest_of_file(file);
  }
} // namespace Voussoir
