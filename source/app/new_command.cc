// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/new_command.h>
#include <voussoir/app/scene_ranges.h>
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/dam/dam.h>
#include <voussoir/foundation/foundation_names.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <unistd.h>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Questions on standard output, and the scene of the answers. */
    class NewScene
    {
    public:
      explicit NewScene(const std::string &file);

      void ask_dam();
      void ask_water();
      void ask_joints();
      void ask_foundation();
      void ask_motion();

      /** Returns the scene: answers, and the entries that depend on the dam. */
      std::string text();

    private:
      const DeclaredEntry *find(const std::string &name) const;
      void                 set(const std::string &name, const std::string &value);
      void ask(const std::string &name, const std::string &standard, const std::function<void()> &check = {});
      void ask(const std::string &name) { ask(name, find(name)->default_value); }
      void ask_file(const std::string &name, bool needed);
      void clear(const std::string &name);
      void add(const std::string &name) { values.emplace(name, find(name)->default_value); }
      void set_rock();

      Entries                            prm;
      Scene                              scene;
      std::vector<DeclaredEntry>         known;
      std::map<std::string, std::string> values; ///< as written, by entry
      HexMesh                            mesh;
    };

    NewScene::NewScene(const std::string &file)
    {
      scene.add_parameters(prm);
      known = declared_entries(prm);
      scene.name = fs::path(file).stem().string();
      scene.directory = fs::path(file).parent_path().string();
    }

    /** Repeats questions until the answers are valid. At the end of the input an error is final. */
    void until_valid(const std::function<void()> &questions)
    {
      for (;;)
        try
        {
          return questions();
        }
        catch (const InputError &error)
        {
          if (!std::cin)
            throw;
          std::cout << "   " << error.what() << "\n";
        }
    }

    /** Returns the choices of an entry, or an empty text. */
    std::string choices_of(const DeclaredEntry &entry)
    {
      return entry.pattern.rfind("[Selection", 0) == 0 ? ", " + pattern_in_words(entry.pattern) : "";
    }

    /** Returns a comment on an entry: the first sentence of its help text, with the unit and the choices, and the
     * sentence about the value -1. */
    std::string comment_of(const DeclaredEntry &entry, const std::string &value)
    {
      const std::string &help = entry.documentation;
      const auto         sentence = [&help](const std::size_t from)
      {
        const std::string text = help.substr(from, help.find(". ", from) - from);
        return text.substr(0, text.find_last_not_of('.') + 1);
      };
      const auto automatic = value == "-1" ? help.find("-1: ") : std::string::npos;
      return sentence(0) + choices_of(entry) + "." +
             (automatic == std::string::npos ? "" : " " + sentence(automatic) + ".");
    }

    /** Returns the declaration of an entry, or null. */
    const DeclaredEntry *NewScene::find(const std::string &name) const
    {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&](const DeclaredEntry &entry) { return entry.name() == name; });
      return found == known.end() ? nullptr : &*found;
    }

    /** Sets an entry. Throws InputError for an invalid or unusual value. */
    void NewScene::set(const std::string &name, const std::string &value)
    {
      const DeclaredEntry &declared = *find(name);
      if (value.find('#') != std::string::npos)
        throw InputError("An input file cannot contain \"#\" in \"" + value + "\". Rename the file.");
      const std::string converted = set_entry(prm, declared, value, "\"" + name + "\"");
      const UsedValue   used = {name, name, declared.unit(), std::strtod(converted.c_str(), nullptr)};
      if (const std::string warning = implausible(used, prm.usual_ranges()); !warning.empty())
        throw InputError(warning);
      values[name] = value;
    }

    /** Asks for an entry until its value is valid. @p check: throws InputError for a value that does not fit the
     * other answers. */
    void NewScene::ask(const std::string &name, const std::string &standard,
                       const std::function<void()> &check)
    {
      std::cout << find(name)->documentation << "\n";
      until_valid(
          [&]
          {
            std::cout << "   " << name << choices_of(*find(name)) << " [" << standard << "]: " << std::flush;
            std::string answer;
            std::getline(std::cin, answer);
            answer.erase(0, answer.find_first_not_of(" \t\r"));
            answer.erase(answer.find_last_not_of(" \t\r") + 1);
            if (answer.empty())
              answer = standard;
            if (isatty(STDIN_FILENO) == 0 || !std::cin)
              std::cout << answer << "\n";
            set(name, answer);
            if (check)
              check();
          });
    }

    /** Asks for a file that exists, or an empty answer if no file is @p needed. */
    void NewScene::ask_file(const std::string &name, const bool needed)
    {
      ask(name, "",
          [&]
          {
            std::error_code   error;
            const std::string file = values[name];
            if (!file.empty() && !fs::is_regular_file(fs::path(scene.directory) / file, error))
              throw InputError("The file " + (fs::path(scene.directory) / file).string() +
                               " does not exist. Correct the name.");
            if (file.empty() && needed)
              throw InputError("Name a file.");
            if (file.empty())
              values.erase(name);
          });
    }

    /** Sets a text to "", and removes it from the scene. */
    void NewScene::clear(const std::string &name)
    {
      set(name, "");
      values.erase(name);
    }

    void NewScene::ask_dam()
    {
      std::cout << "\n1. Dam\n";
      until_valid(
          [&]
          {
            values.clear(); // of a previous attempt
            ask("Mesh/Source");
            const std::string source = values["Mesh/Source"];
            if (source == "file")
            {
              ask_file("Mesh/File", true);
              ask("Mesh/Axes");
              ask("Mesh/Length unit");
            }
            else if (source == "arcs")
            {
              ask("Mesh/Arcs/Kind");
              ask_file("Mesh/Arcs/Table", true);
              for (const char *entry : {"Joints", "Elements along", "Elements up", "Elements through"})
                add("Mesh/Arcs/" + std::string(entry));
            }
            else
              for (const char *entry : {"Joints", "Elements along", "Elements up", "Elements through"})
                add("Mesh/Arch210/" + std::string(entry));
            mesh = make_mesh(scene.mesh, scene.directory);
            check_axes_and_units(mesh, scene.mesh, scene.mesh.file);
          });
    }

    void NewScene::ask_water()
    {
      double low = 1e300, high = -1e300; // of the dam
      for (const HexMesh::Cell &cell : mesh.cells)
        for (const unsigned int node : cell.nodes)
          if (is_monolith(cell.volume))
          {
            low = std::min(low, mesh.nodes[node][2]);
            high = std::max(high, mesh.nodes[node][2]);
          }
      std::ostringstream range, standard;
      range << "The dam is from z = " << low << " to " << high << " m. Choose a level between.";
      standard << std::floor(low + .93 * (high - low));
      std::cout << "\n2. Water\n";
      ask("Reservoir/Water level", standard.str(),
          [&]
          {
            if (scene.reservoir.level <= low || scene.reservoir.level > high)
              throw InputError(range.str());
          });
    }

    void NewScene::ask_joints()
    {
      std::cout << "\n3. Joints\n";
      ask("Joints/Model");
      if (scene.joints.model == "cohesive")
      {
        ask("Joints/Strength", "1 MPa");
        ask("Joints/Fracture energy", "150 N/m");
      }
      for (const DeclaredEntry &entry : known)
        if (entry.name().rfind("Joints/", 0) == 0 && entry.unit() != "" &&
            scene.joints.any_reads(entry.name()))
          add(entry.name());
    }

    void NewScene::ask_foundation()
    {
      std::cout << "\n4. Foundation\n";
      ask("Foundation/Model", find("Foundation/Model")->default_value, [this] { set_rock(); });
      for (const char *entry : {"Young's modulus", "Poisson's ratio", "Density"})
        if (const std::string name = std::string("Foundation/") + entry;
            foundation_reads(scene.foundation.model, name))
          add(name);
    }

    /** Adds rock to the mesh of a foundation that needs it, and chooses its time step. */
    void NewScene::set_rock()
    {
      for (const char *entry :
           {"Mesh/Arch210/Rock/Enabled", "Mesh/Arcs/Rock/Enabled", "Dynamics/Steps per sample"})
        values.erase(entry); // of a previous attempt
      if (scene.foundation.model == "rigid")
        return;
      const std::string enabled =
          scene.mesh.source == "arcs" ? "Mesh/Arcs/Rock/Enabled" : "Mesh/Arch210/Rock/Enabled";
      const bool is_file = scene.mesh.source == "file";
      if (is_file ? std::all_of(mesh.cells.begin(), mesh.cells.end(),
                                [](const HexMesh::Cell &cell) { return is_monolith(cell.volume); })
                  : find(enabled) == nullptr)
        throw InputError("The mesh has no volumes of rock. Choose rigid.");
      if (!is_file)
        set(enabled, "true");
      if (scene.foundation.model != "rock")
        return;
      std::cout << "   The critical time step of the rock is computed." << std::endl;
      const Dam dam(scene);
      for (const unsigned int steps : {1, 2, 5, 10, 20, 50})
        try
        {
          dam.foundation->check({scene.motion.time_step / steps, scene.foundation.n_substeps(), 1}, steps);
          set("Dynamics/Steps per sample", std::to_string(steps));
          return;
        }
        catch (const InputError &)
        {
          if (steps == 50)
            throw;
        }
    }

    void NewScene::ask_motion()
    {
      std::cout << "\n5. Ground motion\n";
      ask("Motion/Source");
      if (scene.motion.source == "artificial")
        ask("Motion/Peak acceleration");
      else if (scene.motion.source == "file")
        until_valid(
            [&]
            {
              for (const char *entry : {"File", "File x", "File y", "File z"})
                clear("Motion/" + std::string(entry)); // of a previous attempt
              ask_file("Motion/File", false);
              if (scene.motion.file.empty())
                for (const char *entry : {"Motion/File x", "Motion/File y", "Motion/File z"})
                  ask_file(entry, false);
              ask("Motion/Unit");
              MotionParameters measures_only = scene.motion;
              if (const std::string warning =
                      size_warning(report_motion(make_motion(scene.motion, scene.directory), measures_only));
                  !warning.empty())
                throw InputError(warning);
            });
      if (scene.motion.source == "none")
      {
        values.erase("Dynamics/Steps per sample");
        return;
      }
      for (const char *entry : {"Motion/Duration", "Motion/Time step", "Damping/Ratio", "Damping/Frequency 1",
                                "Damping/Frequency 2"})
        add(entry);
    }

    std::string NewScene::text()
    {
      for (const char *entry : {"Young's modulus", "Poisson's ratio", "Density"})
        add("Concrete/" + std::string(entry));
      scene.check();
      std::ostringstream       out;
      std::vector<std::string> section;
      const auto               indent = [&] { return std::string(2 * section.size(), ' '); };
      const auto               close = [&](const std::size_t depth)
      {
        while (section.size() > depth)
        {
          section.pop_back();
          out << indent() << "end\n";
        }
      };
      for (const DeclaredEntry &entry : known)
      {
        const auto value = values.find(entry.name());
        if (value == values.end())
          continue;
        std::size_t common = 0;
        while (common < section.size() && common + 1 < entry.path.size() &&
               section[common] == entry.path[common])
          ++common;
        close(common);
        for (std::size_t i = common; i + 1 < entry.path.size(); ++i)
        {
          out << (section.empty() ? "\n" : "") << indent() << "subsection " << entry.path[i] << "\n";
          section.push_back(entry.path[i]);
        }
        out << indent() << "# " << comment_of(entry, value->second) << "\n"
            << indent() << "set " << entry.path.back() << " = " << value->second << "\n";
      }
      close(0);
      return out.str();
    }
  } // namespace

  void write_new_scene(const std::vector<std::string> &words)
  {
    const std::string file = words.empty() ? "dam.prm" : words[0];
    if (words.size() > 1)
      throw InputError("`voussoir new` writes one file. Remove the argument \"" + words[1] + "\".");
    const auto expect_new = [&file]
    {
      std::error_code error;
      if (fs::exists(fs::symlink_status(file, error)))
        throw InputError(
            "The file " + file +
            " exists. `voussoir new` does not replace it: name another file, as `voussoir new other.prm`.");
    };
    expect_new();
    std::cout << "Enter takes the value in brackets. The end of the input takes all remaining ones.\n";
    NewScene scene(file);
    scene.ask_dam();
    scene.ask_water();
    scene.ask_joints();
    scene.ask_foundation();
    scene.ask_motion();
    const std::string text = scene.text();
    expect_new();
    OutputFile out(file);
    out << "# Scene of a dam, written by `voussoir new`. All other entries have their defaults.\n"
           "# Check each value: `voussoir parameters SECTION` describes all entries of a section.\n"
        << text;
    out.check();
    std::cout << "\n"
              << file << " is written. Check each value, then\n    voussoir " << file
              << " --validate\n    voussoir " << file << "\n";
  }
} // namespace Voussoir
