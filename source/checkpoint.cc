#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <voussoir/error.h>
#include <voussoir/simulation.h>

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
    /** The part of a scene that decides its results: without outputs, and without the settings of the solver,
     * which one may want to change to get past a step that failed. */
    std::string decisive_part(std::string scene_text)
    {
      constexpr const char *format = "\ncheckpoint format 3\n"; // of what follows
      for (const char *section : {"subsection Output", "subsection Contact"})
        if (const auto begin = scene_text.find(section); begin != std::string::npos)
          scene_text.erase(begin, scene_text.find("\nend", begin) - begin);
      return scene_text + format;
    }
  } // namespace

  void Simulation::save_checkpoint()
  {
    const std::string file = directory + "/checkpoint.bin";
    try
    {
      std::ofstream                   out(file + ".new", std::ios::binary);
      boost::archive::binary_oarchive archive(out);
      const std::string               decisive = decisive_part(scene_text);
      DynamicState                    state = newmark->state();
      Energy                          first = newmark->initial_energy();
      double wall = clock_before + clock.seconds(), cpu = cpu_before + double(std::clock()) / CLOCKS_PER_SEC,
             largest = newmark->largest_energy();
      archive << decisive << step << wall << cpu << state << first << largest << count << history << energy
              << *joints << *envelope << solutions;
      if (dam->foundation)
        for (const std::vector<double> *array : dam->foundation->state())
          archive << *array;
      if (!out.flush())
        throw boost::archive::archive_exception(boost::archive::archive_exception::output_stream_error);
    }
    catch (const boost::archive::archive_exception &)
    {
      log.line("warning: the checkpoint %s cannot be written; the run goes on without it.", file.c_str());
      return;
    }
    std::filesystem::rename(file + ".new", file);
    std::ofstream(directory + "/checkpoint.txt") << "scene " << scene.name << "\nstep " << step << " of "
                                                 << n_steps << "\ntime " << newmark->state().time << " s\n";
  }

  void Simulation::load_checkpoint()
  {
    const std::string file = directory + "/checkpoint.bin";
    std::ifstream     in(file, std::ios::binary);
    try
    {
      boost::archive::binary_iarchive archive(in);
      std::string                     decisive;
      DynamicState                    state;
      Energy                          first;
      double                          largest = 0.;
      archive >> decisive;
      if (decisive != decisive_part(scene_text))
        throw InputError("The checkpoint " + file +
                         " belongs to another scene: an entry outside \"Output\" and \"Contact\" differs. "
                         "Compare scene.prm "
                         "there with yours, or run without --resume.");
      const std::vector<std::string> columns = history.columns;
      archive >> step >> clock_before >> cpu_before >> state >> first >> largest >> count >> history >>
          energy >> *joints >> *envelope >> solutions;
      if (dam->foundation)
        for (std::vector<double> *array :
             n_steps > 0 ? dam->foundation->state() : std::vector<std::vector<double> *>())
        {
          const std::size_t size = array->size();
          archive >> *array;
          if (array->size() != size)
            throw InputError("The checkpoint " + file +
                             " belongs to another rock mesh. Run without --resume.");
        }
      if (state.u.size() != statics.u.size() || state.force.size() != statics.force.size() ||
          step > n_steps || envelope->maximum.size() != dam->model->n_nodes())
        throw InputError(
            "The checkpoint " + file +
            " belongs to another mesh or motion: a file that the scene names has changed. Run without "
            "--resume.");
      if (history.columns != columns)
        throw InputError(
            "The checkpoint " + file +
            " has other probes than the scene: entry \"Output/Probes\" must not change on --resume.");
      newmark->resume(state, first, largest, Unknowns(state.force.size(), 0.));
    }
    catch (const boost::archive::archive_exception &)
    {
      throw InputError("The checkpoint " + file +
                       " cannot be read: it is damaged, or of another version. Run without "
                       "--resume.");
    }
    log.line("Resumed   at t = %.2f s, step %u of %u", newmark->state().time, step, n_steps);
  }
} // namespace Voussoir
