#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds of wall time per second of earthquake of the benchmark dam, jointed and tied, in one run.

Usage: benchmarks/speed.py [--voussoir build/voussoir] [--duration 2.56] [SCENE.prm ...]     (default: rigid28 with FJA, FJB, tied)
       benchmarks/speed.py --before OTHER/voussoir [--repeat 3] [--duration 1.28] SCENE.prm ...
Prints a table for doc/performance.md; with --before the medians of both programs, run in turn, and their ratios with the range of the pairs.
Input files of the other version, where they differ: --scenes-before OTHER/prm (the files with the same names).
Two settings of one program: --before build/voussoir --set-now Reservoir/Model=acoustic --set-now "Reservoir/Element size=16" prm/rigid28.prm
Take a quiet machine: stages are wall times.
"""
import argparse
import json
import os
import statistics
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def run(voussoir, scene, settings):
    with tempfile.TemporaryDirectory() as directory:
        subprocess.run([voussoir, scene, "--output", directory, "--quiet", "--set", "Output/Figures=false"]
                       + [word for setting in settings for word in ("--set", setting)], check=True)
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
    summary["seconds"].setdefault("substitutions", summary["seconds"]["sweeps"])  # the name until version 0.3
    return summary


STAGES = ("substitutions", "joints", "rock", "stepping", "stresses", "output")


def compare(programs, scenes, settings, now, repeat):
    """Rows of a table: the medians of each program, and what the second one's are of the first one's."""
    measured = [[], []]
    for _ in range(repeat):
        for program, scene, runs, more in zip(programs, scenes, measured, ([], now)):
            s = run(program, scene, settings + more)
            seconds = s["seconds"]
            runs.append([seconds["per_second_of_earthquake"], seconds["setup"] + seconds["static"]]
                        + [1e3 * seconds.get(stage, 0) / s["steps"] for stage in STAGES]
                        + [s["newton_iterations"]["mean"], s["newton_iterations"].get("linear_iterations_mean", 0), s["memory_bytes"] / 2**30])
    medians = [[statistics.median(column) for column in zip(*runs)] for runs in measured]
    name = " ".join([os.path.splitext(os.path.basename(scenes[1]))[0], *(s.split("/", 1)[-1] for s in settings[1:])])
    for label, row in zip(("before", "now"), medians):
        print(f"| {name}, {label} | " + " | ".join(f"{x:.2f}" for x in row) + " |")
    print(f"| {name}, ratio | " + " | ".join(f"{b / a:.2f}" if a else "" for a, b in zip(*medians)) + " |")
    columns = [zip(*runs) for runs in measured]
    pairs = [[b / a if a else None for a, b in zip(before, after)] for before, after in zip(*columns)]
    print(f"| {name}, ratio of each pair | " + " | ".join("" if None in pair else f"{min(pair):.2f} to {max(pair):.2f}" for pair in pairs) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--voussoir", default=os.path.join(ROOT, "build", "voussoir"))
    parser.add_argument("--before", help="another program to compare with")
    parser.add_argument("--scenes-before", metavar="DIRECTORY", help="with --before: its input files")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--duration", help="of the motion [s]; default: of the scene, with --before 1.28")
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="with --before")
    parser.add_argument("--set-now", action="append", default=[], metavar="ENTRY=VALUE",
                        help="with --before, which may be the same program: of the second one only")
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    if not arguments.before and (arguments.scenes_before or arguments.set or arguments.set_now):
        parser.error("--scenes-before, --set and --set-now require --before")
    if arguments.before:
        print("| medians of " + str(arguments.repeat) + " | s per s | set-up and static [s] | "
              + " | ".join(("ms per step: " if stage == STAGES[0] else "") + stage for stage in STAGES)
              + " | Newton | GMRES | memory [GiB] |")
        print("|" + "---|" * (len(STAGES) + 6))
        for scene in arguments.scenes:
            scenes = (os.path.join(arguments.scenes_before or os.path.dirname(scene), os.path.basename(scene)), scene)
            compare((arguments.before, arguments.voussoir), scenes,
                    ["Motion/Duration=" + (arguments.duration or "1.28"), *arguments.set], arguments.set_now, arguments.repeat)
        return
    cases = [(scene, []) for scene in arguments.scenes]
    if not cases:
        dam = os.path.join(ROOT, "prm", "rigid28.prm")
        cases = [(dam, ["Joints/Model=" + law]) for law in ("FJA", "FJB", "tied")]
    more = ["Motion/Duration=" + arguments.duration] if arguments.duration else []
    print("| scene | law | unknowns | pairs | s per s | set-up and static [s] | ms per step: substitutions | joints | stepping | stresses | output "
          "| Newton mean (max) | GMRES per step | memory [GiB] |")
    print("|" + "---|" * 14)
    for scene, settings in cases:
        s = run(arguments.voussoir, scene, settings + more)
        seconds, newton = s["seconds"], s["newton_iterations"]
        step = [f"{1e3 * seconds[stage] / s['steps']:.1f}"
                for stage in ("substitutions", "joints", "stepping", "stresses", "output")]
        print("|", " | ".join(
            [s["scene"], s["law"], str(s["mesh"]["dofs"]), str(s["mesh"]["pairs"]),
             f"{seconds['per_second_of_earthquake']:.2f}", f"{seconds['setup'] + seconds['static']:.1f}", *step, f"{newton['mean']:.2f} ({newton['max']:.0f})",
             f"{newton['linear_iterations_mean']:.1f}", f"{s['memory_bytes'] / 2**30:.2f}"]), "|", flush=True)


if __name__ == "__main__":
    main()
