// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/command_options.h>
#include <voussoir/app/completion.h>
#include <voussoir/app/declared_entries.h>
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/dam/scene.h>

#include <algorithm>
#include <ostream>

namespace Voussoir
{
  namespace
  {
    /** Returns what the script offers for a value or an argument such as "DIR", "FILE.msh", "4.1|2.2": the
     * word directories, files and their extension, or the choices. Empty: nothing, as for a number. */
    std::string kind_of(const std::string &usage)
    {
      if (usage.rfind("DIR", 0) == 0)
        return "directories";
      if (usage.find('|') != std::string::npos)
      {
        const auto  from = usage.find('[') + 1; // 0 without brackets
        std::string choices = usage.substr(from, usage.find(']') - from);
        std::replace(choices.begin(), choices.end(), '|', ' ');
        return choices;
      }
      const auto point = usage.find('.');
      if (point == std::string::npos)
        return usage == "bash" ? usage : "";
      const auto end = usage.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789", point + 1);
      return "files " + usage.substr(point + 1, end - point - 1);
    }

    constexpr const char *functions = R"(
# Adds the entries that begin with $1, up to the next section.
_voussoir_add_entries()
{
  local entry rest start=''
  [[ $1 == */* ]] && start=${1%/*}/
  for entry in "${_voussoir_entries[@]}"; do
    [[ $entry == "$1"* ]] || continue
    rest=${entry#"$start"}
    if [[ $rest == */* ]]; then entry=$start${rest%%/*}/; else entry+='='; fi
    [[ ${#COMPREPLY[@]} -gt 0 && $entry == "${COMPREPLY[-1]}" ]] || COMPREPLY+=("$entry")
  done
  compopt -o nospace 2>/dev/null
}

_voussoir()
{
  local word words=() command='' option='' options='' arguments='' kind='' is_argument='' joins=''
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do # bash makes three words of --output=DIR
    if [[ ${#words[@]} -gt 0 && ( $word == '=' || $joins ) ]]; then words[-1]+=$word; else words+=("$word"); fi
    joins=''
    [[ $word == '=' ]] && joins=1
  done
  word=${words[-1]}
  unset 'words[-1]'
  for command in "${words[@]}" ''; do
    [[ " $_voussoir_commands " == *" $command "* || ! $command ]] && break
  done
  if [[ $word == --*=* ]]; then
    option=${word%%=*} word=${word#*=}
  elif [[ ${#words[@]} -gt 0 ]]; then
    option=${words[-1]}
  fi
  [[ $option == -o ]] && option=--output
  word=${word#[\"\']} word=${word//\\/}
  _voussoir_table "$command" "$option"
  COMPREPLY=()
  case $kind in
    entries) _voussoir_add_entries "$word" ;;
    directories) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    files*) mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X "!*.${kind#files }" -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$kind" -- "$word") ;;
  esac
  if [[ $is_argument ]]; then
    if [[ $word == -* ]]; then
      mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    elif [[ ${#words[@]} -eq 0 ]]; then
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$_voussoir_commands" -- "$word")
    fi
  fi
}
complete -o filenames -F _voussoir voussoir
)";
  } // namespace

  void print_completion(const std::vector<std::string> &words, std::ostream &out)
  {
    if (words != std::vector<std::string>{"bash"})
      throw InputError("The completion exists for bash only. Write `voussoir completion bash`.");
    std::string names, arguments, values;
    for (const Command &command : command_table())
    {
      const std::string name = command.name;
      std::string       options = name.empty() ? "--help --version" : "--help";
      names += name.empty() ? "" : name + " ";
      for (const CommandOption &option : command.options)
      {
        options += std::string(" ") + option.name;
        if (*option.value != '\0')
          values += "    " + name + ":" + option.name + ") kind='" +
                    (sets_entry(option) ? "entries" : kind_of(option.value)) + "' ;;\n";
      }
      arguments +=
          "    '" + name + "') arguments='" + kind_of(command.words) + "' options='" + options + "' ;;\n";
    }
    Entries prm;
    Scene   scene;
    scene.add_parameters(prm);
    out << "# Completion of voussoir for bash, written by `voussoir completion bash`.\n\n_voussoir_commands='"
        << names << "'\nmapfile -t _voussoir_entries <<'END'\n";
    for (const DeclaredEntry &entry : declared_entries(prm))
      out << entry.name() << '\n';
    out << "END\n\n_voussoir_table() # command, option\n{\n  case $1 in\n"
        << arguments << "  esac\n  case $1:$2 in\n"
        << values << "    *) kind=$arguments is_argument=1 ;;\n  esac\n}\n"
        << functions;
  }
} // namespace Voussoir
