# SPDX-License-Identifier: GPL-3.0-or-later
"""What the commands in Python share: the program, scenes run by it, and errors in its words.

`voussoir COMMAND` starts scripts/COMMAND.py with its options, then "--", then the files; this program's path is in the
environment variable VOUSSOIR_PROGRAM (by default build/voussoir). Bad input ends with status 2, a failed computation with 1.
"""

import argparse
import json
import os
import re
import subprocess
import sys
from pathlib import Path

PROGRAM = os.environ.get("VOUSSOIR_PROGRAM") or str(Path(__file__).resolve().parent.parent / "build" / "voussoir")


class InputError(Exception):
    """What the user must mend; status 2."""


class ComputationError(Exception):
    """What could not be computed; status 1."""


class Parser(argparse.ArgumentParser):
    """Of a command line; what it does not understand is an InputError."""

    def __init__(self, **options):
        super().__init__(formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message):
        message = message.removeprefix("argument ")
        if found := re.fullmatch(r"(\S+): invalid (int|float|Path) value: (.*)", message, re.S):
            message = f"{found[1]} must be a {'whole ' if found[2] == 'int' else ''}number, not {found[3]}"
        raise InputError(f"{message}. `{self.prog} --help` shows how.")


def end_with(main):
    """Ends the script with the status of main(), errors in the program's words."""
    try:
        sys.exit(main())
    except InputError as error:
        print(f"voussoir: error: {error}", file=sys.stderr)
        sys.exit(2)
    except ComputationError as error:
        print(f"voussoir: failed: {error}", file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        print("voussoir: stopped.", file=sys.stderr)
        sys.exit(1)


def voussoir(*arguments, log=None):
    """The result of the program with these arguments: status, output and error as text; the output also goes to a file."""
    result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if log is not None:
        Path(log).write_text(result.stdout + result.stderr)
    return result


def settings(pairs):
    """The words --set for entries and their values."""
    return [word for entry, value in dict(pairs).items() for word in ("--set", f"{entry}={value}")]


def entries_of(scene, overrides=()):
    """All entries of a scene with their values as text, "Section/Entry" -> value, defaults included."""
    result = voussoir("scene", scene, *[word for entry in overrides for word in ("--set", entry)])
    if result.returncode != 0:
        raise InputError(result.stderr.strip().removeprefix("voussoir: error: "))
    entries, path = {}, []
    for line in result.stdout.splitlines():
        words = line.split("#", 1)[0].strip()
        if words.startswith("subsection "):
            path.append(words.split(" ", 1)[1].strip())
        elif words == "end":
            path.pop()
        elif words.startswith("set "):
            name, value = words[4:].split("=", 1)
            entries["/".join([*path, name.strip()])] = value.strip()
    return entries


def results_of(directory):
    """summary.json of a run."""
    return json.loads((Path(directory) / "summary.json").read_text())
