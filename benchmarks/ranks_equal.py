#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Are the results of whole scenes the same bits on one rank and on several?

Usage: benchmarks/ranks_equal.py [--voussoir build/voussoir] [--ranks 1 2 4] [--only WORD ...] [--seconds MOST]
Runs quickstart, rigid28, rock_fja with each artificial boundary, keys_law and massless_fja, and compares all tables and fields byte
by byte, and the numbers of summary.json but for times and memory. Prints a table for benchmarks/README.md; status 1 if anything differs.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MACHINE = ("second", "memory", "gib", "time_", "directory", "command", "threads", "rank", "cpu", "wall", "date")
BOUNDARIES = ("mtf3", "viscous-spring", "mtf2", "viscous", "fixed", "mtf1", "mtf4", "mtf2-plain")
# Scene, seconds of shaking (None: the scene's own), settings.
CASES = [("quickstart", 4., []), ("rigid28", 2., [])]
NEEDS = {"mtf4": ["Mesh/Arch210/Rock/Boundary layers=9"]}
CASES += [("rock_fja", 4., [f"Foundation/Boundary={name}", *NEEDS.get(name, [])]) for name in BOUNDARIES]  # 2000 steps
CASES += [("../benchmarks/keys_law", 1., []), ("massless_fja", 2., [])]


def run(program, scene, settings, directory, ranks):
    command = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    command += [program, os.path.join(ROOT, "prm", f"{scene}.prm"), "--output", directory, "--quiet"]
    command += [word for setting in ["Output/Figures=false", *settings] for word in ("--set", setting)]
    environment = {**os.environ, "OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", "1")}
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    subprocess.run(command, check=True, env=environment)


def numbers(value):
    """What does not depend on the machine."""
    if not isinstance(value, dict):
        return value
    return {key: numbers(x) for key, x in value.items() if not any(word in key for word in MACHINE)}


def results(directory):
    """File names and contents; of .vtu without their date."""
    found = {}
    for name in sorted(os.listdir(directory)):
        if name.endswith((".csv", ".vtu", ".pvd")):
            with open(os.path.join(directory, name), "rb") as file:
                found[name] = [line for line in file if not line.startswith(b"#")]
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    found["summary.json"] = numbers(summary)
    return found, summary["steps"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--voussoir", default=os.path.join(ROOT, "build", "voussoir"))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--only", nargs="+", metavar="WORD", help="cases whose name or settings have one of these")
    parser.add_argument("--seconds", type=float, default=1e9, help="of shaking at most")
    arguments = parser.parse_args()
    print("| scene | steps | files | " + " | ".join(f"{n} ranks" for n in arguments.ranks[1:]) + " |")
    print("|" + "---|" * (2 + len(arguments.ranks)), flush=True)
    equal = True
    for scene, duration, settings in CASES:
        name = ", ".join([scene, *settings])
        if arguments.only and not any(word in name for word in arguments.only):
            continue
        settings = [*settings, f"Motion/Duration={min(duration, arguments.seconds)}"]
        with tempfile.TemporaryDirectory() as directory:
            first, steps, cells = None, 0, []
            for n in arguments.ranks:
                run(arguments.voussoir, scene, settings, f"{directory}/{n}", n)
                found, steps = results(f"{directory}/{n}")
                if first is None:
                    first = found
                    continue
                different = [file for file in sorted({*first, *found}) if first.get(file) != found.get(file)]
                cells.append("differ: " + ", ".join(different) if different else "the same bits")
                equal = equal and not different
        print(f"| {name} | {steps} | {len(first)} | " + " | ".join(cells) + " |", flush=True)
    return 0 if equal else 1


if __name__ == "__main__":
    sys.exit(main())
