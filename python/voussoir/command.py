# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the scripts, and their exit status.

`voussoir COMMAND` starts scripts/COMMAND.py with its options, then "--", then the files. The environment variable VOUSSOIR_PROGRAM
names the program. Bad input ends with status 2, a failed computation with 1.
"""

import argparse
import fcntl
import os
import re
import sys
from pathlib import Path

from .errors import ComputationError, InputError


class Parser(argparse.ArgumentParser):
    """A command line. Throws InputError for arguments that it does not accept."""

    def __init__(self, **options):
        super().__init__(formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message):
        message = message.removeprefix("argument ")
        if found := re.fullmatch(r"(\S+): invalid (int|float|Path) value: (.*)", message, re.S):
            message = f"{found[1]} must be a {'whole ' if found[2] == 'int' else ''}number, not {found[3]}"
        raise InputError(f"{message}. `{self.prog} --help` shows how.")


def lock_directory(directory, what, folders=()):
    """Creates an output directory with folders, and returns its lock: a file that is open as long as the command writes there.

    what: name of the command in the message. Throws InputError if the directory cannot be written to, or another command has its lock."""
    directory = Path(directory)
    try:
        for folder in ("", *folders):
            (directory / folder).mkdir(parents=True, exist_ok=True)
        lock = open(directory / ".lock", "w", encoding="utf-8")  # pylint: disable=consider-using-with
    except OSError as error:
        raise InputError(f"The directory {directory} cannot be written to: {error.strerror}. Choose another with --output.") from None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        lock.close()
        raise InputError(f"Another {what} is running in {directory}. Wait until it has ended, or choose another with --output.") from None
    return lock


def write_whole(path, data):
    """The file gets all of the text or bytes, or keeps what it has. A link is replaced; its target is not written. Throws OSError."""
    path = Path(path)
    new = path.with_name(f".{path.name}.{os.getpid()}.new")
    new.unlink(missing_ok=True)
    try:
        with open(os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode("utf-8"))
        os.replace(new, path)
    finally:
        new.unlink(missing_ok=True)


def end_with(main):
    """Ends the script with the status of main(); prints errors as the program does."""
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
