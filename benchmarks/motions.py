#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ensembles of artificial motions of one spectrum: their scatter for several dams, and their cost.

    benchmarks/motions.py scatter [--motions 16] [--only NAME]     tables of doc/ensembles.md
    benchmarks/motions.py speed --before OTHER/voussoir --scenes-before OTHER/prm [--repeat 3]

`speed` compares the processor time of an ensemble on one thread, with setup and all results, with that of one run of another version
with its own scenes, in turn. Take a quiet machine."""

import argparse
import csv
import random
import statistics
import tempfile
from pathlib import Path

from program import ROOT, add_program_argument, run, simulate

EXPLICIT = {"Dynamics/Scheme": "explicit", "Dynamics/Steps per sample": "1"}
DAMS = {  # scene, settings, and motions relative to --motions
    "arch210, 5 joints": ("prm/quickstart.prm", EXPLICIT, 4),
    "arch210, 5 joints, without matching in time": ("prm/quickstart.prm", {**EXPLICIT, "Motion/Matching iterations": "0"}, 4),
    "arch210, 28 joints": ("prm/rigid28.prm", EXPLICIT, 1),
    "arch210, 5 joints with keys": ("prm/coarse.prm", {"Joints/Model": "KSM"}, 1),
    "arch210, 5 joints, massless rock": ("prm/massless_fja.prm", {}, 1),
    "arch210, 5 joints, rock with mass": ("prm/rock_fja.prm", EXPLICIT, 1),
    "Pacoima from its table of arcs, 10 joints": ("benchmarks/pacoima.prm", {
        **EXPLICIT, "Joints/Model": "FJA", "Foundation/Model": "rigid", "Motion/Source": "artificial", "Statics/Self-weight": "staged"}, 1),
}
SPEED = (("quickstart", 16), ("quickstart", 64), ("rigid28", 8), ("rigid28", 16))


def openings(program, scene, settings, motions):
    """max_opening, max_slip and tension of all motions, and summary.json."""
    with tempfile.TemporaryDirectory() as directory:
        summary = simulate(program, ROOT / scene, {**settings, "Motion/Ensemble": f"1-{motions}"}, output=directory)
        with open(Path(directory, "ensemble.csv"), encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
    return summary, {name: [float(row[name]) for row in rows] for name in ("max_opening", "max_slip")}


def half_width(values, n, share, samples=4000):
    """Half width of the interval around the median of all values that has this share of the medians of n values, over the median."""
    draw = random.Random(1)
    middle = statistics.median(values)
    errors = sorted(abs(statistics.median(draw.choices(values, k=n)) / middle - 1) for _ in range(samples))
    return errors[int(share * samples)]


def scatter(arguments):
    print("| dam | motions | opening: median, 16 to 84 %, range [mm] | motions for 10 % | slip: median, 16 to 84 % [mm] | CPU s |")
    print("|---|---|---|---|---|---|")
    largest = []
    for name, (scene, settings, times) in DAMS.items():
        if arguments.only and arguments.only not in name:
            continue
        summary, values = openings(arguments.voussoir, scene, settings, times * arguments.motions)
        o, s = summary["ensemble"]["max_opening"], summary["ensemble"]["max_slip"]
        print(f"| {name} | {summary['ensemble']['n']} | {1e3 * o['median']:.1f}, {1e3 * o['p16']:.1f} to {1e3 * o['p84']:.1f}, {1e3 * o['min']:.1f} to "
              f"{1e3 * o['max']:.1f} | {o['motions_for_10_percent']:.0f} | {1e3 * s['median']:.0f}, {1e3 * s['p16']:.0f} to {1e3 * s['p84']:.0f} | "
              f"{summary['seconds']['cpu']:.0f} |", flush=True)
        largest = max(largest, values["max_opening"], key=len)
    print(f"\nFrom {len(largest)} motions of the first dam, the largest opening:\n| motions | median known within, 68 % | 95 % |\n|---|---|---|")
    for n in (1, 3, 7, 11, 16, 32):
        print(f"| {n} | {100 * half_width(largest, n, .68):.0f} % | {100 * half_width(largest, n, .95):.0f} % |")


def speed(arguments):
    print("| scene | motions | CPU of all over CPU of one run before | range |\n|---|---|---|---|")
    for name, motions in SPEED:
        if arguments.only and arguments.only != name:
            continue
        ratios = []
        for _ in range(arguments.repeat):
            with tempfile.TemporaryDirectory() as directory:
                _, before = run(arguments.before, Path(arguments.scenes_before, f"{name}.prm"), "--output", Path(directory, "before"), "--quiet",
                                settings={"Output/Figures": "false"})
                _, after = run(arguments.voussoir, ROOT / f"prm/{name}.prm", "--output", Path(directory, "after"), "--quiet",
                               settings={"Output/Figures": "false", **EXPLICIT, "Motion/Ensemble": f"1-{motions}"})
            ratios.append(after / before)
        print(f"| {name} | {motions} | {statistics.median(ratios):.2f} | {min(ratios):.2f} to {max(ratios):.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("scatter", "speed"))
    parser.add_argument("--motions", type=int, default=16)
    parser.add_argument("--only", help="one dam or scene")
    parser.add_argument("--before", help="the other program")
    parser.add_argument("--scenes-before", help="its scenes")
    parser.add_argument("--repeat", type=int, default=3)
    add_program_argument(parser)
    arguments = parser.parse_args()
    if arguments.what == "speed" and not (arguments.before and arguments.scenes_before):
        parser.error("speed requires --before and --scenes-before")
    {"scatter": scatter, "speed": speed}[arguments.what](arguments)


if __name__ == "__main__":
    main()
