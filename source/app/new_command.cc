// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/new_command.h>
#include <voussoir/app/scene_text.h>
#include <voussoir/base/error.h>
#include <voussoir/dam/dam.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <sstream>
#include <unistd.h>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Questions on standard output, and the scene of the answers. */
    class NewScene : public SceneText
    {
    public:
      using SceneText::SceneText;

      void ask_dam();
      void ask_water();
      void ask_joints();
      void ask_foundation();
      void ask_motion();

    private:
      void ask(const std::string &name, const std::string &standard, const std::function<void()> &check = {});
      void ask(const std::string &name) { ask(name, find(name)->default_value); }
      void ask_file(const std::string &name, bool needed);
      void clear(const std::string &name);
      void set_rock();

      HexMesh mesh;
    };

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
      add_joints();
    }

    void NewScene::ask_foundation()
    {
      std::cout << "\n4. Foundation\n";
      ask("Foundation/Model", find("Foundation/Model")->default_value, [this] { set_rock(); });
      add_foundation();
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
      for (const char *entry : {"Motion/Duration", "Motion/Time step"})
        add(entry);
    }
  } // namespace

  void write_new_scene(const std::vector<std::string> &words)
  {
    const std::string file = words.empty() ? "dam.prm" : words[0];
    if (words.size() > 1)
      throw InputError("`voussoir new` writes one file. Remove the argument \"" + words[1] + "\".");
    NewScene scene(file);
    scene.expect_new();
    std::cout << "Enter takes the value in brackets. The end of the input takes all remaining ones.\n";
    scene.ask_dam();
    scene.ask_water();
    scene.ask_joints();
    scene.ask_foundation();
    scene.ask_motion();
    scene.add_materials();
    scene.write("# Scene of a dam, written by `voussoir new`. All other entries have their defaults.\n"
                "# Check each value: `voussoir parameters SECTION` describes all entries of a section.\n");
    std::cout << "\n"
              << file << " is written. Check each value, then\n    voussoir " << file
              << " --validate\n    voussoir " << file << "\n";
  }
} // namespace Voussoir
