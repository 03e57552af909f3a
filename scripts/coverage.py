#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Line coverage of the tests: sums the results of gcov for a build with --coverage whose tests have run.

    scripts/coverage.py DIRECTORY [--missed FILE]

Prints a Markdown table with a row for each folder: lines with code, lines that a test reached, and their share. --missed writes the
other lines to a file, as "file:line". scripts/full.sh makes the build.
"""

import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def lines_of(data):
    """(file in the sources, line) -> was it reached, of one .gcda file; templates count as reached by any of their instances."""
    result = subprocess.run(["gcov", "--json-format", "--stdout", str(data)], capture_output=True, text=True, cwd=data.parent, check=True)
    found = defaultdict(bool)
    for text in filter(None, result.stdout.splitlines()):
        for file in json.loads(text)["files"]:
            path = Path(os.path.normpath(data.parent / file["file"]))
            if not path.is_relative_to(ROOT / "source") and not path.is_relative_to(ROOT / "include"):
                continue
            for line in file["lines"]:
                found[str(path.relative_to(ROOT)), line["line_number"]] |= line["count"] > 0
    return found


def room_of(file):
    """source/ROOM/... or include/voussoir/ROOM/..."""
    return Path(file).parts[2 if file.startswith("include") else 1]


def reached_lines(directory):
    """The same, of all files of a build."""
    files = sorted(directory.rglob("*.gcda"))
    if not files:
        sys.exit(f"coverage: there are no .gcda files in {directory}: build with --coverage, and run the tests.")
    total = defaultdict(bool)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lines_of, files):
            for key, reached in found.items():
                total[key] |= reached
    return total


def table_of(total):
    """The rows of the table, the whole last."""
    rooms = defaultdict(lambda: [0, 0])
    for (file, _), reached in total.items():
        for name in (room_of(file), "all"):
            rooms[name][0] += 1
            rooms[name][1] += reached
    order = [*sorted(name for name in rooms if name != "all"), "all"]
    return ["| folder | lines | reached | share |", "|---|---|---|---|",
            *(f"| {name} | {rooms[name][0]} | {rooms[name][1]} | {100. * rooms[name][1] / rooms[name][0]:.1f} % |" for name in order)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--missed", type=Path, help="the lines that no test reached")
    options = parser.parse_args()
    total = reached_lines(options.directory.resolve())
    print("\n".join(table_of(total)))
    if options.missed:
        options.missed.write_text("".join(f"{file}:{line}\n" for (file, line), reached in sorted(total.items()) if not reached))
    return 0


if __name__ == "__main__":
    sys.exit(main())
