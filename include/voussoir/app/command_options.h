// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_command_options_h
#define voussoir_command_options_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Option of a command. */
  struct CommandOption
  {
    const char *name, *value, *meaning; ///< empty value: a flag
    bool        needed = false;
  };

  /** Command of the program; the name of a run is empty. */
  struct Command
  {
    const char                *name, *words, *summary;
    std::vector<CommandOption> options;
    const char                *script = "";                   ///< Python script that executes it
    const char                *modules = "numpy, matplotlib"; ///< Python modules that the script requires
  };

  /** Words of a command line by meaning. */
  struct Arguments
  {
    std::string                        command;   ///< "mesh", "modes", ...; empty: run a scene
    std::vector<std::string>           words;     ///< files and other words, in sequence
    std::map<std::string, std::string> values;    ///< options with a value: "--output" -> "a.msh"
    std::set<std::string>              flags;     ///< options without a value
    std::vector<std::string>           overrides; ///< values of --set
    bool                               help = false, version = false;

    /** Returns true if the option @p flag is given. */
    bool has(const std::string &flag) const { return flags.count(flag) > 0; }

    /** Returns the value of @p option, or @p standard if the option is not given. */
    std::string value(const std::string &option, const std::string &standard = "") const
    {
      const auto found = values.find(option);
      return found == values.end() ? standard : found->second;
    }
  };

  /** Returns the words of a command line by meaning. "--output=DIR" and "-o DIR" are "--output DIR". "--" ends
   * the options. Throws InputError for options that are unknown to the command, that lack their value, that
   * have a value but are flags, or that are given twice. */
  Arguments read_arguments(const std::vector<std::string> &words);

  /** Returns the help text of a command. Empty: the run of a scene. */
  std::string help_about(const std::string &command);

  /** Returns a summary of all commands. */
  std::string help_about_all();

  /** Returns a command of the table. */
  const Command &command_of(const std::string &name);

  /** Returns words from which read_arguments() makes @p arguments, without the command. */
  std::vector<std::string> words_of(const Arguments &arguments);

  /** Returns the command with the name most similar to @p word. */
  std::string nearest_command(const std::string &word);
} // namespace Voussoir

#endif
