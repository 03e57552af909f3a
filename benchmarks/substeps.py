#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dam and rock at steps of their own: how far is the crest from where one step for both has it, and at what cost?

    benchmarks/substeps.py [--voussoir PROGRAM] [--scenes rock_fja rock28] [--set ENTRY=VALUE ...]

Five seconds of strong shaking of prm/rock_fja.prm, 2.56 s of prm/rock28.prm; prints a Markdown table for doc/verification.md. Differences
are root mean squares over the samples of the motion (10 ms), over that of the reference's way from its static place. Cost:
seconds of processor time of one thread per second of shaking, without set-up and static state.
"""

import argparse
import csv
import tempfile
from pathlib import Path

import numpy as np

from program import ROOT, add_program_argument, simulate

STEPS, SUBSTEPS, COUPLING = "Dynamics/Steps per sample", "Foundation/Substeps", "Foundation/Coupling"
SCENES = {
    "rock_fja": ({"Motion/Duration": 5.12, "Motion/Rise end": 0.5, "Motion/Decay begin": 4.5}, [
        ("partition", 5, 1, {}), ("mean traction", 5, 1, {}), ("mean traction", 2, 3, {}),
        ("mean traction", 1, 5, {})]),
    "rock28": ({"Motion/Duration": 2.56, "Motion/Decay begin": 2.4}, [
        ("partition", 7, 1, {}), ("mean traction", 2, 3, {}), ("mean traction", 1, 6, {})]),
}


def crest(directory):
    """Way of the crest from its static place at the motion's samples, (n, 3) [m]."""
    with open(Path(directory) / "history.csv", encoding="utf-8") as file:
        rows = [[float(row[name]) for name in ("time", "crest_x", "crest_y", "crest_z")] for row in csv.DictReader(file)]
    rows = np.array(rows)
    times = np.arange(0., rows[-1, 0] + 1e-6, .01)
    place = np.column_stack([np.interp(times, rows[:, 0], column) for column in rows[:, 1:].T])
    return place - place[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="for all runs")
    options = parser.parse_args()
    for_all = dict(text.split("=", 1) for text in options.set)
    print("| scene | coupling | dam's step [ms], m | crest x, y, z off by [%] | largest opening [mm] | Newton per step | s per s |\n|" + "---|" * 7)
    for scene in options.scenes:
        common, rows = SCENES[scene]
        reference = None
        for coupling, steps, substeps, more in rows:
            with tempfile.TemporaryDirectory() as directory:
                summary = simulate(options.voussoir, ROOT / "prm" / f"{scene}.prm",
                                   {**common, **for_all, COUPLING: coupling, STEPS: steps, SUBSTEPS: substeps, **more}, directory)
                way = crest(directory)
            if reference is None:
                reference, off = way, ""
            else:
                size = np.sqrt(np.mean(reference ** 2, axis=0))
                off = ", ".join(f"{100 * x:.2f}" for x in np.sqrt(np.mean((way - reference) ** 2, axis=0)) / size)
            opening = summary["extremes"]["max_opening"]["value"]
            words = coupling + "".join(f", {name.rsplit('/', 1)[1].lower()} {value:g}" for name, value in more.items())
            print(f"| {scene} | {words} | {10 / steps:.3g}, {substeps} | {off} | {1e3 * opening:.2f} | "
                  f"{summary['newton_iterations']['mean']:.1f} | {summary['seconds']['shaking_cpu'] / common['Motion/Duration']:.1f} |", flush=True)


if __name__ == "__main__":
    main()
