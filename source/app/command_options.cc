// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/command_options.h>
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    const CommandOption overrides = {"--set", "'Section/Entry=value'",
                                     "override an entry of the scene; may be given several times"};

    const std::vector<Command> commands = {
        {"",
         "SCENE.prm",
         "Runs a scene: static state and earthquake of a dam.",
         {{"--output", "DIR", "directory for the results, by default output/SCENE"},
          overrides,
          {"--resume", "", "continue from the last checkpoint in the directory"},
          {"--overwrite", "", "replace the results in the directory"},
          {"--validate", "", "check scene, mesh and motion, print a summary, and stop"},
          {"--json", "", "with --validate: print the summary as a JSON object"},
          {"--quiet", "", "print only errors; with --validate also warnings"}}},
        {"scene",
         "SCENE.prm",
         "Prints the complete scene, with included files and all defaults.",
         {{"--choices", "", "print changes of modelling and numerical choices as a JSON object instead"},
          overrides}},
        {"needs",
         "SCENE.prm",
         "Changes one choice of a scene at a time: which parts of the model matter, and the smallest scene.",
         {{"--for", "X%", "target error, by default 5%"},
          {"--seconds", "X", "duration of the strongest motion [s], by default 5"},
          {"--jobs", "N", "number of simultaneous runs, by default the number of cores"},
          {"--only", "GROUP,...", "groups of changes, such as water,joints; by default all"},
          {"--mesh", "coarse|scene",
           "mesh of the runs: coarse if the limit of work requires it (default), or always that of the scene"},
          {"--output", "DIR", "directory for runs, tables and charts, by default output/SCENE-needs"},
          overrides},
         "needs.py"},
        {"arcs",
         "TABLE.csv",
         "Writes a commented scene for a dam from a table of arcs.",
         {{"--output", "FILE.prm", "the file to write, by default TABLE.prm"},
          {"--kind", "KIND", "circular (default), parabolic, elliptical, three-centred or points"}},
         "arcs.py",
         ""},
        {"mesh",
         "SCENE.prm",
         "Writes the mesh of a scene as a file of gmsh.",
         {{"--output", "FILE.msh", "the file to write", true},
          {"--format", "4.1|2.2", "MSH format, by default 4.1"},
          overrides}},
        {"modes",
         "SCENE.prm",
         "Prints natural frequencies [Hz] and damping ratios of the tied dam.",
         {{"--count", "N", "number of modes, by default 10"},
          {"--output", "DIR",
           "directory for mode shapes, participation factors, effective masses and a picture"},
          {"--spectrum", "design|FILE.csv",
           "also print the response to a spectrum (CQC): that of section Motion, or a table as for Motion/Target "
           "spectrum, in the unit of its headings"},
          {"--json", "", "print frequencies, participation factors and effective masses as a JSON object"},
          overrides}},
        {"new",
         "[FILE.prm]",
         "Asks for dam, water, joints, foundation and motion. Writes a commented scene, by default dam.prm.",
         {},
         "new.py",
         ""},
        {"motion",
         "SCENE.prm",
         "Writes the ground motion of a scene, t, a_x, a_y, a_z [s, m/s^2], and prints a report.",
         {{"--output", "FILE.csv", "the file to write", true}, overrides}},
        {"accuracy",
         "SCENE.prm",
         "Runs a scene with several meshes and time steps: error and cost, and the cheapest setting that "
         "meets a target error.",
         {{"--for", "X%", "target error, by default 1%"},
          {"--seconds", "X", "duration of the strongest motion [s], by default 5"},
          {"--output", "DIR", "directory for runs, table and chart, by default output/SCENE-accuracy"},
          overrides},
         "accuracy.py"},
        {"view",
         "SCENE.prm",
         "Draws a scene: mesh, groups, joints, water, axes, rock.",
         {{"--output", "DIR", "directory for the pictures, by default output/SCENE-view"}, overrides},
         "view.py"},
        {"report",
         "DIR...",
         "Writes a self-contained HTML page about a run, or about several runs side by side.",
         {{"--output", "FILE.html", "the file to write, by default DIR/report.html"},
          {"--pdf", "", "also write the page as PDF in the same directory, by headless Chromium"},
          {"--title", "TEXT", "title of the study, by default with the name of the scene"},
          {"--owner", "TEXT", "owner of the dam"},
          {"--author", "TEXT", "author of the study"},
          {"--date", "TEXT", "date of the study, by default today"}},
         "report.py"},
        {"study",
         "STUDY.prm",
         "Runs many scenes under Snakemake. Writes one table of their results, and figures.",
         {{"--jobs", "N", "number of simultaneous scenes, by default the number of cores"},
          {"--output", "DIR", "directory for the runs and results, by default output/STUDY"},
          {"--profile", "PROFILE", "profile of Snakemake, for a cluster such as Slurm"},
          {"--keep-going", "", "continue with the other scenes if a scene fails"},
          {"--dry-run", "", "print the scenes without a run"},
          {"--set", "'Section/Entry=value'", "override an entry of the study; may be given several times"}},
         "study.py"},
        {"parameters",
         "[prm|json|markdown] [SECTION]",
         "Prints all entries of a scene file or of a section, with defaults and meaning.",
         {}},
        {"completion",
         "bash",
         "Prints the completion of commands, options and entries for bash.",
         {},
         "completion.py",
         ""}};

    constexpr const char *spelling =
        "--output=DIR and -o DIR mean --output DIR; all options with a value accept \"=\".\n";
    constexpr const char *status = "Exit status: 0 done; 1 the computation failed; 2 bad input.\n";

    const Command *find_command(const std::string &name)
    {
      const auto found = std::find_if(commands.begin(), commands.end(),
                                      [&](const Command &command) { return name == command.name; });
      return found == commands.end() ? nullptr : &*found;
    }

    const CommandOption *find_option(const Command &command, const std::string &name)
    {
      const auto found = std::find_if(command.options.begin(), command.options.end(),
                                      [&](const CommandOption &option) { return name == option.name; });
      return found == command.options.end() ? nullptr : &*found;
    }

    std::string called(const Command &command)
    {
      return "voussoir " + (*command.name == '\0' ? command.words : std::string(command.name));
    }

    std::string synopsis(const Command &command)
    {
      std::string text = called(command);
      if (*command.name != '\0')
        text += " " + std::string(command.words);
      for (const CommandOption &option : command.options)
      {
        const std::string usage =
            option.name + (*option.value == '\0' ? "" : " " + std::string(option.value));
        text += option.needed ? " " + usage
                              : " [" + usage + "]" + (option.name == std::string("--set") ? "..." : "");
      }
      return text + "\n    " + command.summary + "\n";
    }

    /** Returns the option of any command. An option has a value in all commands or in none. */
    const CommandOption *find_anywhere(const std::string &name)
    {
      for (const Command &command : commands)
        if (const CommandOption *option = find_option(command, name))
          return option;
      return nullptr;
    }

    [[noreturn]] void refuse_option(const Command &command, const std::string &word)
    {
      std::vector<std::string> names;
      for (const CommandOption &option : command.options)
        names.push_back(option.name);
      std::string owner;
      for (const Command &other : commands)
        if (find_option(other, word) != nullptr)
          owner += (owner.empty() ? "" : ", ") + ("`" + called(other)) + "`";
      std::string text = "`" + called(command) + "` has no option " + word;
      if (!owner.empty())
        text += "; it belongs to " + owner;
      else if (!names.empty())
        text += ". Did you mean " + nearest_name(names, word) + "?";
      throw InputError(text + (owner.empty() && !names.empty() ? "" : ".") + " `" + called(command) +
                       " --help` shows all options.");
    }

    /** Word of the command line, with its value if it is an option of any command. */
    struct Word
    {
      std::string          text, value;
      const CommandOption *option = nullptr;
      bool                 is_option = false;
    };

    /** Returns the name of the option in a word such as "--output=DIR" or "-o". */
    std::string option_name(const std::string &word)
    {
      const std::string name = word.substr(0, word.find('='));
      return name == "-o" ? "--output" : name;
    }

    /** Reads the value of the option in words[i], after "=" or in the next word. Moves @p i to the last word
     * of the option. */
    void read_value(const std::vector<std::string> &words, std::size_t &i, Word &word)
    {
      const std::string &given = words[i];
      const auto         equals = given.find('=');
      if (*word.option->value == '\0')
      {
        if (equals != std::string::npos)
          throw InputError("The option " + word.text + " has no value. Remove \"" + given.substr(equals) +
                           "\".");
        return;
      }
      if (equals != std::string::npos)
        word.value = given.substr(equals + 1);
      else if (i + 1 < words.size() && find_anywhere(option_name(words[i + 1])) == nullptr)
        word.value = words[++i];
      if (word.value.empty())
        throw InputError("The option " + word.text + " needs a value, " + word.option->value +
                         ". `voussoir --help` shows the usage.");
    }

    std::vector<Word> sort_out(const std::vector<std::string> &words)
    {
      std::vector<Word> result;
      bool              options_end = false;
      for (std::size_t i = 0; i < words.size(); ++i)
      {
        Word word{words[i], "", nullptr, !options_end && words[i].size() > 1 && words[i][0] == '-'};
        if (!options_end && words[i] == "--")
        {
          options_end = true;
          continue;
        }
        if (word.is_option)
        {
          word.text = option_name(words[i]);
          word.option = find_anywhere(word.text);
        }
        if (word.option != nullptr)
          read_value(words, i, word);
        result.push_back(word);
      }
      return result;
    }
  } // namespace

  Arguments read_arguments(const std::vector<std::string> &words)
  {
    if (!words.empty() && words[0] == "contact")
      throw InputError("`voussoir contact` is now the program `voussoir-contact`, with the same options; "
                       "`cmake --build build --target voussoir-contact` builds it.");
    Arguments               arguments;
    const std::vector<Word> sorted = sort_out(words);
    for (const Word &word : sorted)
    {
      if (word.text == "--version" || word.text == "version")
        arguments.version = true;
      else if (word.text == "--help" || word.text == "-h" || word.text == "help")
        arguments.help = true;
      else if (!word.is_option && arguments.command.empty() && arguments.words.empty() &&
               find_command(word.text) != nullptr)
        arguments.command = word.text;
      else if (!word.is_option)
        arguments.words.push_back(word.text);
    }
    for (const Word &word : sorted)
      if (word.is_option && word.option == nullptr && word.text != "--version" && word.text != "--help" &&
          word.text != "-h")
        refuse_option(*find_command(arguments.command), word.text);
    if (arguments.help || arguments.version)
      return arguments;
    const Command &command = *find_command(arguments.command);
    for (const Word &word : sorted)
    {
      if (!word.is_option)
        continue;
      if (find_option(command, word.text) == nullptr)
        refuse_option(command, word.text);
      if (word.text == overrides.name)
        arguments.overrides.push_back(word.value);
      else if (*word.option->value == '\0')
        arguments.flags.insert(word.text);
      else if (!arguments.values.emplace(word.text, word.value).second)
        throw InputError("The option " + word.text + " is given twice. Remove one.");
    }
    return arguments;
  }

  std::string help_about(const std::string &name)
  {
    const Command &command = *find_command(name);
    std::string    text = synopsis(command);
    for (const CommandOption &option : command.options)
    {
      const std::string usage = "  " + std::string(option.name) + " " + option.value;
      text += usage + std::string(usage.size() < 30 ? 30 - usage.size() : 1, ' ') + option.meaning + "\n";
    }
    if (name == "parameters")
      text += "  SECTION is a path such as Joints/Keys, or a single entry such as Joints/Friction.\n";
    return text + (command.options.empty() ? "" : spelling) + status;
  }

  std::string help_about_all()
  {
    std::string text;
    for (const Command &command : commands)
      text += synopsis(command);
    return text + "voussoir --help, voussoir --version, voussoir COMMAND --help\n\n" +
           "--set overrides an entry of the scene, and may be given several times.\n" + spelling + status;
  }

  const Command &command_of(const std::string &name)
  {
    return *find_command(name);
  }

  std::vector<std::string> words_of(const Arguments &arguments)
  {
    std::vector<std::string> words;
    for (const auto &[option, value] : arguments.values)
      words.insert(words.end(), {option, value});
    words.insert(words.end(), arguments.flags.begin(), arguments.flags.end());
    for (const std::string &entry : arguments.overrides)
      words.insert(words.end(), {overrides.name, entry});
    words.push_back("--");
    words.insert(words.end(), arguments.words.begin(), arguments.words.end());
    return words;
  }

  std::string nearest_command(const std::string &word)
  {
    std::vector<std::string> names;
    for (const Command &command : commands)
      if (*command.name != '\0')
        names.push_back(command.name);
    return nearest_name(names, word);
  }
} // namespace Voussoir
