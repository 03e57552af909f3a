#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the error bars of a run, and adds them to its summary.json; exit status 3 without numpy (python/voussoir/error_bars.py).

    error_bars.py DIR     the program calls it at the end of a run whose scene has results of `voussoir accuracy`
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
try:
    from voussoir.command import write_whole
    from voussoir.error_bars import bar_text
    from voussoir.errors import InputError
    from voussoir.runs import Run
except ImportError as error:
    print(f"{sys.executable}: {error}")
    sys.exit(3)


def main():
    try:
        run = Run(sys.argv[1])
    except InputError as error:
        print(error)
        return 2
    bars, reason = run.error_bars
    if not bars:
        print(reason or "no error bar: the values are too small")
        return 0
    print("\n".join(bar_text(name, bar) for name, bar in bars.items()))
    file = run.directory / "summary.json"
    text = file.read_text(encoding="utf-8").rstrip()
    if "error_bars" not in json.loads(text):
        added = json.dumps(bars, indent=2).replace("\n", "\n  ")
        write_whole(file, text[:-1].rstrip() + f',\n  "error_bars": {added}\n}}\n')
    return 0


if __name__ == "__main__":
    sys.exit(main())
