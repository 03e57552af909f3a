# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the scripts, and their exit status.

`voussoir COMMAND` starts scripts/COMMAND.py with its options, then "--", then the files. The environment variable VOUSSOIR_PROGRAM
names the program. Bad input ends with status 2, a failed computation with 1.
"""

import argparse
import re
import sys

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
