// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_command_options_h
#define voussoir_command_options_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Voussoir
{
  /** The words of a command line, sorted out. */
  struct Arguments
  {
    std::string                        command;   ///< "mesh", "modes", ...; empty: run a scene
    std::vector<std::string>           words;     ///< files and the like, in their order
    std::map<std::string, std::string> values;    ///< of options with a value: "--output" -> "a.msh"
    std::set<std::string>              flags;     ///< options without a value
    std::vector<std::string>           overrides; ///< of --set
    bool                               help = false, version = false;

    bool        has(const std::string &flag) const { return flags.count(flag) > 0; }
    std::string value(const std::string &option, const std::string &standard = "") const
    {
      const auto found = values.find(option);
      return found == values.end() ? standard : found->second;
    }
  };

  /** Throws InputError for options that there are not, or that the command does not have, for options without
   *  their value and for those that are given twice. "--" ends the options. */
  Arguments read_arguments(const std::vector<std::string> &words);

  /** The help about one command, empty: running a scene. */
  std::string help_about(const std::string &command);

  /** All commands in short. */
  std::string help_about_all();

  /** The script in Python that does what the command asks for; empty: the program itself does. */
  std::string script_of(const std::string &command);

  /** The words that read_arguments() would sort out like this, without the command. */
  std::vector<std::string> words_of(const Arguments &arguments);

  /** What to say of a first word that is no scene when there are others: the nearest command. */
  std::string nearest_command(const std::string &word);
} // namespace Voussoir

#endif
