// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/config.h>

#include <voussoir/app/command_line.h>
#include <voussoir/app/command_options.h>
#include <voussoir/app/declared_entries.h>
#include <voussoir/app/ensemble.h>
#include <voussoir/app/memory_need.h>
#include <voussoir/app/modes_command.h>
#include <voussoir/app/simulation.h>
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/python_script.h>
#include <voussoir/base/version.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>

extern "C" void openblas_set_num_threads(int);

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Prints all entries, or those of a section. The format is optional. */
    void print_parameters(const std::vector<std::string> &words)
    {
      const bool has_format =
          !words.empty() && (words[0] == "prm" || words[0] == "json" || words[0] == "markdown");
      if (words.size() > (has_format ? 2 : 1))
        throw InputError(
            "`voussoir parameters` accepts one format (prm, json or markdown) and one section. Remove the "
            "argument \"" +
            words.back() + "\".");
      Entries prm;
      Scene   scene;
      scene.add_parameters(prm);
      const std::string  section = words.empty() ? "" : words.back();
      std::ostringstream text; // deal.II does not accept streams that fail
      print_entries(prm, has_format ? words[0] : "prm", has_format && words.size() == 1 ? "" : section, text);
      std::cout << text.str();
    }

    void print_mesh(const HexMesh &mesh)
    {
      std::printf("%zu nodes, %zu hexahedra\n", mesh.nodes.size(), mesh.cells.size());
      if (!mesh.remark.empty())
        std::printf("%s\n", mesh.remark.c_str());
      const HexMesh dam = monoliths_only(mesh);
      double        bottom = 1e300, top = -1e300;
      for (const auto &node : dam.nodes)
      {
        bottom = std::min(bottom, node[2]);
        top = std::max(top, node[2]);
      }
      std::printf("dam : z from %s to %s m, crest %s m, volume %s m3\n", number_text(bottom).c_str(),
                  number_text(top).c_str(), number_text(crest_length(dam)).c_str(),
                  number_text(volume(dam)).c_str());
      for (const bool of_rock : {false, true})
      {
        const auto n_cells =
            std::count_if(mesh.cells.begin(), mesh.cells.end(),
                          [&](const auto &cell) { return is_monolith(cell.volume) != of_rock; });
        if (n_cells == 0)
          continue;
        const MeshQuality quality = mesh_quality(mesh, of_rock);
        std::printf("%s: %td hexahedra, edges %.3g to %.3g m, smallest height %.3g m at %s, smallest scaled "
                    "Jacobian %.2f, mean ratio of Jacobians %.2f\n",
                    of_rock ? "rock" : "dam ", n_cells, quality.shortest_edge, quality.longest_edge,
                    quality.smallest_height, place(quality.smallest_height_at).c_str(),
                    quality.smallest_scaled_jacobian, quality.mean_jacobian_ratio);
      }
    }
  } // namespace

  namespace
  {
    /** Returns the input file of the command line. */
    std::string scene_file(const Arguments &arguments)
    {
      const auto &words = arguments.words;
      if (arguments.command.empty() && !words.empty() && words[0].find_first_of("./") == std::string::npos &&
          (words.size() > 1 || !std::filesystem::exists(words[0])))
        throw InputError("There is no command \"" + words[0] + "\". Did you mean `voussoir " +
                         nearest_command(words[0]) +
                         "`? `voussoir --help` shows all. Names of scene files end in .prm.");
      if (words.size() > 1)
        throw InputError("There are too many arguments: \"" + words[1] +
                         "\". `voussoir --help` shows the usage.");
      if (words.empty())
        throw InputError("`voussoir " + arguments.command + "` needs one scene file. `voussoir " +
                         arguments.command + " --help` shows the usage.");
      return words[0];
    }

    void write_mesh(const Scene &scene, const Arguments &arguments)
    {
      const std::string format = arguments.value("--format", "4.1");
      if (format != "4.1" && format != "2.2")
        throw InputError("--format must be 4.1 or 2.2, not \"" + format + "\".");
      const ArchRockParameters *rock = scene.mesh.generated_rock();
      const HexMesh             mesh =
          rock != nullptr && rock->enabled ? make_mesh(scene.mesh, scene.directory) : scene.hex_mesh();
      if (const std::string warning = check_axes_and_units(mesh, scene.mesh, scene.mesh.file);
          !warning.empty())
        std::cerr << "voussoir: warning: " << warning << '\n';
      write_gmsh(mesh, arguments.value("--output"), format == "2.2" ? 2.2 : 4.1);
      print_mesh(mesh);
    }

    void run_scene(const Scene &scene, const std::string &text, const Arguments &arguments)
    {
      RunOptions options;
      options.output = arguments.value("--output");
      options.resume = arguments.has("--resume");
      options.overwrite = arguments.has("--overwrite");
      options.validate = arguments.has("--validate");
      options.quiet = arguments.has("--quiet");
      options.json = arguments.has("--json");
      if (options.json && !options.validate)
        throw InputError("--json requires --validate. A run writes summary.json into its directory.");
#ifdef DEBUG
      std::cerr << "voussoir: warning: this is a Debug build, many times slower than Release.\n";
#endif
      const auto scene_of = [&](const EnsembleMember &member)
      {
        std::vector<std::string> overrides = arguments.overrides;
        for (const auto &[entry, value] : member.entries)
          overrides.push_back(entry + "=" + value);
        std::pair<Scene, std::string> result;
        Entries                       prm;
        std::ostringstream            text_of_member;
        read_scene(scene_file(arguments), overrides, result.first, prm);
        prm.print_parameters(text_of_member, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
        result.second = text_of_member.str();
        return result;
      };
      try
      {
        if (scene.motion.ensemble.empty())
          Simulation(scene, text, options).run();
        else
          EnsembleRun(scene, text, options, scene_of).run();
      }
      catch (const std::bad_alloc &)
      {
        throw ComputationError(not_enough_memory(scene));
      }
      catch (const ExcOutOfMemory &) // of deal.II
      {
        throw ComputationError(not_enough_memory(scene));
      }
    }

    /** Returns the changes of a scene as a JSON object. */
    std::string json_of_choices(const Scene &scene)
    {
      std::vector<Json> list;
      for (const ModelChoice &choice : scene.model_choices())
      {
        Json entries, row;
        for (const auto &[entry, value] : choice.entries)
          entries.add(entry, value);
        row.add("group", choice.group).add("name", choice.name);
        row.add("set", entries).add_flag("simpler", choice.is_simpler);
        list.push_back(row);
      }
      return Json().add("choices", list).text() + "\n";
    }

    void run_with_scene(const Arguments &arguments)
    {
      Scene              scene;
      Entries            prm;
      std::ostringstream text;
      const std::string &command = arguments.command, file = scene_file(arguments);
      if ((command == "mesh" || command == "motion") && arguments.value("--output").empty())
        throw InputError("`voussoir " + command + "` requires --output FILE.");
      scene.is_for_modes = command == "modes";
      read_scene(file, arguments.overrides, scene, prm);
      if (!command.empty() && !arguments.value("--output").empty())
        scene.check_output(arguments.value("--output"));
      prm.print_parameters(text, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
      if (command.empty())
        return run_scene(scene, text.str(), arguments);
      if (command == "scene")
        std::cout << (arguments.has("--choices") ? json_of_choices(scene) : text.str());
      else if (command == "modes")
        print_modes(scene, arguments.value("--count", "10"), arguments.value("--output"),
                    arguments.value("--spectrum"), arguments.has("--json"));
      else if (command == "mesh")
        write_mesh(scene, arguments);
      else
      {
        if (const auto members = scene.motion.members(); !members.empty())
        {
          if (scene.motion.source == "file")
          {
            const std::filesystem::path output = arguments.value("--output");
            const std::string           suite = (output.parent_path() / "suite.csv").string();
            if (output.filename() == "suite.csv")
              throw InputError(
                  "--output suite.csv: the table of all motions has this name. Choose another one.");
            scene.check_output(suite);
            write_suite(members, scene.directory, suite);
            std::cout << "Factors, misfits and measures of all motions: " << suite << '\n';
          }
          scene.motion = members.front().motion;
          std::cout << "Motion/Ensemble has " << members.size() << " motions. This is the first one, "
                    << members.front().name << ".\n";
        }
        const GroundMotion motion = make_motion(scene.motion, scene.directory);
        write_motion(motion, arguments.value("--output"));
        for (const std::string &note : motion.notes)
          std::cout << note << '\n';
        print_report(report_motion(motion, scene.motion), std::cout);
        print_spectra(motion, scene.motion, std::cout);
        if (const double factor = scene.loads.factor("earthquake"); factor != 1.)
          std::cout << "The load combination multiplies this motion by " << factor
                    << " (Loads/Combination). These numbers do not include the factor.\n";
      }
      for (const Warning &warning : scene.warnings) // an error would come first
        std::cerr << "voussoir: warning: " << warning.text << "\n";
    }

    /** Returns the optional parts of this program. */
    std::string features()
    {
#ifdef VOUSSOIR_WITH_TRILINOS
      std::string result = "coarse solver of the rock: Trilinos";
#else
      std::string result = "coarse solver of the rock: CHOLMOD";
#endif
#ifndef VOUSSOIR_WITH_MPI
      result += "; no MPI";
#endif
#ifndef VOUSSOIR_WITH_ARPACK
      result += "; no natural frequencies (ARPACK)";
#endif
      return result;
    }
  } // namespace

  bool runs_scene(const std::vector<std::string> &words)
  {
    try
    {
      const Arguments arguments = read_arguments(words);
      return arguments.command.empty() && !arguments.words.empty() && !arguments.version && !arguments.help;
    }
    catch (const InputError &)
    {
      return false;
    }
  }

  int run_command(const std::vector<std::string> &words)
  {
    openblas_set_num_threads(1); // parallelism is over bodies and joints
    const Arguments arguments = read_arguments(words);
    if (arguments.version)
      std::cout << "Voussoir " << version() << " (" << revision() << "), deal.II " DEAL_II_PACKAGE_VERSION
                << ", " << features() << "\n";
    else if (arguments.help)
      std::cout << (arguments.command.empty() && arguments.words.empty() ? help_about_all()
                                                                         : help_about(arguments.command));
    else if (arguments.command == "parameters")
      print_parameters(arguments.words);
    else if (const Command &command = command_of(arguments.command); *command.script != '\0')
      become_script(command.script, words_of(arguments), command.modules);
    else if (arguments.command.empty() && arguments.words.empty())
    {
      std::cout << help_about_all();
      throw InputError("which scene? The argument is missing: a .prm file, for example prm/quickstart.prm.");
    }
    else
      run_with_scene(arguments);
    return 0;
  }
} // namespace Voussoir
