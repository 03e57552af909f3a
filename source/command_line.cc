#include <deal.II/base/config.h>
#include <deal.II/base/parameter_handler.h>

#include <voussoir/command_line.h>
#include <voussoir/contact_command.h>
#include <voussoir/error.h>
#include <voussoir/gmsh_io.h>
#include <voussoir/mesh_joints.h>
#include <voussoir/modes.h>
#include <voussoir/simulation.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <sstream>

extern "C" void openblas_set_num_threads(int);

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    constexpr const char *help =
        R"(voussoir SCENE.prm [--output DIR] [--set 'Section/Entry=value']... [--resume] [--validate] [--quiet]
    Static state and earthquake of the dam of a scene.
voussoir mesh SCENE.prm --output FILE.msh [--format 4.1|2.2]
    The scene's mesh, for gmsh.
voussoir modes SCENE.prm [--count 10]
    Natural frequencies of the tied dam, with added mass [Hz].
voussoir motion SCENE.prm --output FILE.csv
    The scene's ground motion, t, a_x, a_y, a_z [s, m/s^2], and a report about it.
voussoir contact FILE.hdf5... [--tolerance 1e-12] [--solver NAME] [--max-seconds 10] [--write-solutions DIR]
    Solves frictional contact problems in FCLib's format; a JSON object per file, seconds are CPU seconds.
    Solvers: newton (the default, with its fallbacks), proximal, sweeps, paper, fischer-burmeister.
voussoir parameters [prm|json|markdown]
    All entries of a scene file with their defaults and meaning.
voussoir --help, voussoir --version

--set overrides an entry of the scene, and may be given several times, with every command that reads a scene.
Exit status: 0 done; 1 the computation failed; 2 bad input.
)";

    struct Arguments
    {
      std::vector<std::string> positional, overrides;
      std::string              output, format = "4.1", count = "10";
      RunOptions               run;
      ContactOptions           contact;
    };

    Arguments read_arguments(const std::vector<std::string> &words)
    {
      Arguments arguments;
      for (std::size_t i = 0; i < words.size(); ++i)
      {
        const auto value = [&]() -> const std::string &
        {
          if (i + 1 == words.size())
            throw InputError("The option " + words[i] +
                             " needs a value after it. `voussoir --help` shows how.");
          return words[++i];
        };
        if (words[i] == "--output")
          arguments.output = value();
        else if (words[i] == "--set")
          arguments.overrides.push_back(value());
        else if (words[i] == "--format")
          arguments.format = value();
        else if (words[i] == "--count")
          arguments.count = value();
        else if (words[i] == "--tolerance")
          arguments.contact.tolerance = value();
        else if (words[i] == "--solver")
          arguments.contact.solver = value();
        else if (words[i] == "--max-seconds")
          arguments.contact.max_seconds = value();
        else if (words[i] == "--write-solutions")
          arguments.contact.solutions = value();
        else if (words[i] == "--resume")
          arguments.run.resume = true;
        else if (words[i] == "--validate")
          arguments.run.validate = true;
        else if (words[i] == "--overwrite")
          arguments.run.overwrite = true;
        else if (words[i] == "--quiet")
          arguments.run.quiet = true;
        else if (words[i].compare(0, 1, "-") == 0)
          throw InputError("There is no option " + words[i] + ". `voussoir --help` shows all.");
        else
          arguments.positional.push_back(words[i]);
      }
      return arguments;
    }

    void print_markdown(ParameterHandler &prm)
    {
      // LaTeX and XML are deal.II's; engineers read tables.
      std::ostringstream text;
      prm.print_parameters(text, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);
      std::istringstream       in(text.str());
      std::vector<std::string> section;
      std::string              documentation;
      std::cout << "| entry | default | meaning |\n|---|---|---|\n";
      for (std::string line; std::getline(in, line);)
      {
        const auto first = line.find_first_not_of(' ');
        line = first == std::string::npos ? "" : line.substr(first);
        if (line.rfind("#", 0) == 0)
          documentation +=
              (documentation.empty() ? "" : " ") +
              line.substr(line.find_first_not_of("# ") == std::string::npos ? line.size()
                                                                            : line.find_first_not_of("# "));
        else if (line.rfind("subsection ", 0) == 0)
          section.push_back(line.substr(11)), documentation.clear();
        else if (line == "end")
          section.pop_back();
        else if (line.rfind("set ", 0) == 0)
        {
          const auto  equals = line.find('=');
          std::string name = line.substr(4, equals - 4), path;
          name.erase(name.find_last_not_of(' ') + 1);
          for (const std::string &s : section)
            path += s + "/";
          std::string value = equals + 2 < line.size() ? line.substr(equals + 2) : "";
          for (std::string *s : {&value, &documentation})
            for (std::size_t i = 0; (i = s->find('|', i)) != std::string::npos; i += 2)
              s->insert(i, "\\");
          std::cout << "| `" << path << name << "` | " << (value.empty() ? "" : "`" + value + "`") << " | "
                    << documentation << " |\n";
          documentation.clear();
        }
      }
    }

    void print_parameters(const std::string &format)
    {
      ParameterHandler prm;
      Scene            scene;
      scene.add_parameters(prm);
      if (format == "markdown")
        print_markdown(prm);
      else if (format == "prm" || format == "json")
        prm.print_parameters(std::cout, (format == "prm" ? ParameterHandler::PRM : ParameterHandler::JSON) |
                                            ParameterHandler::KeepDeclarationOrder);
      else
        throw InputError("`voussoir parameters` prints prm, json or markdown, not \"" + format + "\".");
    }

    void print_mesh(const HexMesh &mesh)
    {
      std::printf("%zu nodes, %zu hexahedra\n", mesh.nodes.size(), mesh.cells.size());
      for (const bool of_rock : {false, true})
      {
        const auto n_cells =
            std::count_if(mesh.cells.begin(), mesh.cells.end(),
                          [&](const auto &cell) { return is_monolith(cell.volume) != of_rock; });
        if (n_cells == 0)
          continue;
        const MeshQuality quality = mesh_quality(mesh, of_rock);
        std::printf("%s: %td hexahedra, edges %.3g to %.3g m, smallest height %.3g m at %s, smallest scaled "
                    "Jacobian %.2f\n",
                    of_rock ? "rock" : "dam ", n_cells, quality.shortest_edge, quality.longest_edge,
                    quality.smallest_height, place(quality.smallest_height_at).c_str(),
                    quality.smallest_scaled_jacobian);
      }
    }

    void print_modes(const Scene &scene, const std::string &count_text)
    {
      unsigned int count = 0;
      if (std::sscanf(count_text.c_str(), "%u", &count) != 1 || count == 0)
        throw InputError("--count must be a positive number, not \"" + count_text + "\".");
      if (scene.foundation.model == "rock")
        throw InputError(
            "`voussoir modes` finds the frequencies of a dam on a rigid base or on massless rock: rock with "
            "mass radiates. Give --set Foundation/Model=massless or rigid.");
      Dam dam(scene, true);
      std::printf("mode  frequency [Hz]\n");
      const std::vector<double> frequencies = natural_frequencies(dam.structure, count);
      for (unsigned int i = 0; i < frequencies.size(); ++i)
        std::printf("%4u  %10.5f\n", i + 1, frequencies[i]);
    }
  } // namespace

  int run_command(const std::vector<std::string> &words)
  {
    openblas_set_num_threads(1); // bodies and joints are what runs in parallel
    const Arguments arguments = read_arguments(
        [&]
        {
          std::vector<std::string> w = words;
          for (std::string &word : w)
            if (word == "-h" || word == "--help")
              word = "help";
            else if (word == "--version")
              word = "version";
          return w;
        }());
    const auto &p = arguments.positional;
    if (p.empty() || std::find(p.begin(), p.end(), "help") != p.end())
    {
      std::cout << help;
      if (p.empty())
        throw InputError("which scene? Give a .prm file, for example prm/quickstart.prm.");
      return 0;
    }
    if (p[0] == "version")
    {
      std::cout << "Voussoir " VOUSSOIR_VERSION " (" VOUSSOIR_REVISION "), deal.II " DEAL_II_PACKAGE_VERSION
                   "\n";
      return 0;
    }
    if (p[0] == "parameters")
    {
      print_parameters(p.size() > 1 ? p[1] : "prm");
      return 0;
    }
    if (p[0] == "contact")
    {
      run_contact(std::vector<std::string>(p.begin() + 1, p.end()), arguments.contact);
      return 0;
    }

    const bool is_command = p[0] == "mesh" || p[0] == "modes" || p[0] == "motion";
    if (p.size() != (is_command ? 2 : 1))
      throw InputError(is_command
                           ? "`voussoir " + p[0] + "` needs one scene file. `voussoir --help` shows how."
                           : "\"" + (p.size() > 1 ? p[1] : p[0]) +
                                 "\" is one word too many. `voussoir --help` shows how.");
    Scene              scene;
    ParameterHandler   prm;
    std::ostringstream text;
    read_scene(p.back(), arguments.overrides, scene, prm);
    prm.print_parameters(text, ParameterHandler::PRM | ParameterHandler::KeepDeclarationOrder);

    if (!is_command)
    {
      RunOptions options = arguments.run;
      options.scene_file = p.back();
      options.output = arguments.output;
#ifdef DEBUG
      std::cerr << "voussoir: warning: this is a Debug build, many times slower than Release.\n";
#endif
      Simulation(scene, text.str(), options).run();
      return 0;
    }
    if (p[0] == "modes")
      print_modes(scene, arguments.count);
    else
    {
      if (arguments.output.empty())
        throw InputError("`voussoir " + p[0] + "` needs --output FILE.");
      if (p[0] == "mesh")
      {
        if (arguments.format != "4.1" && arguments.format != "2.2")
          throw InputError("--format must be 4.1 or 2.2, not \"" + arguments.format + "\".");
        const HexMesh mesh = make_mesh(scene.mesh, scene.directory);
        write_gmsh(mesh, arguments.output, arguments.format == "2.2" ? 2.2 : 4.1);
        print_mesh(mesh);
      }
      else
      {
        const GroundMotion motion = make_motion(scene.motion, scene.directory);
        write_motion(motion, arguments.output);
        for (const std::string &note : motion.notes)
          std::cout << note << '\n';
        print_report(report_motion(motion, scene.motion), std::cout);
      }
    }
    return 0;
  }
} // namespace Voussoir
