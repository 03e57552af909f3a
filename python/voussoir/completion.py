# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir completion bash`: the completion of all commands, options, files and entries, from the help of the program."""

import re

from .command import Parser
from .program import call, declarations

FUNCTIONS = r"""
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
"""


def kind_of(usage):
    """Returns what bash offers for a value or an argument such as DIR, FILE.msh, 4.1|2.2: the word directories, files and their
    extension, or the choices; nothing for a number."""
    if usage.startswith("DIR"):
        return "directories"
    if "|" in usage:
        return usage.split("]")[0].strip("[").replace("|", " ")
    if found := re.search(r"\.([a-z0-9]+)", usage):
        return "files " + found[1]
    return usage if usage == "bash" else ""


def script(text, entries):
    """Returns the script for the commands in the help @p text of the program, and the entries of an input file."""
    names, arguments, values = [], "", ""
    for name, rest in re.findall(r"^voussoir (?!-)([a-z]+(?= ))? ?(.*)$", text, re.M):
        options = re.findall(r"(--[a-z-]+)(?: ([^]\s]+))?", rest)
        names += [name] * bool(name)
        offered = " ".join(["--help", *["--version"] * (not name), *(option for option, _ in options)])
        words = re.split(r" \[?--", rest)[0]
        arguments += f"    '{name}') arguments='{kind_of(words)}' options='{offered}' ;;\n"
        for option, value in options:
            if value:
                kind = "entries" if option == "--set" and name != "study" else kind_of(value)
                values += f"    {name}:{option}) kind='{kind}' ;;\n"
    return (f"# Completion of voussoir for bash, written by `voussoir completion bash`.\n\n_voussoir_commands='{' '.join(names)} '\n"
            "mapfile -t _voussoir_entries <<'END'\n" + "".join(f"{entry}\n" for entry in entries) +
            "END\n\n_voussoir_table() # command, option\n{\n  case $1 in\n" + arguments + "  esac\n  case $1:$2 in\n" + values +
            "    *) kind=$arguments is_argument=1 ;;\n  esac\n}\n" + FUNCTIONS)


def main():
    parser = Parser(prog="voussoir completion", description=__doc__)
    parser.add_argument("shell", choices=["bash"])
    parser.parse_args()
    print(script(call("--help"), declarations()), end="")
