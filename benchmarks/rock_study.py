#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigid base, massless rock, rock that radiates: what do 0, 5, 17 and 28 joints do on each? Five seconds of strong
shaking of prm/rock_fja.prm.

    benchmarks/rock_study.py [--voussoir PROGRAM] [--jobs 2] [--foundations rigid massless rock]

Prints a Markdown table, row by row.
"""

import argparse
import csv
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from program import ROOT, add_program_argument, simulate

SCENE = ROOT / "prm" / "rock_fja.prm"
STRONG = {"Motion/Duration": 5.12, "Motion/Rise end": 0.5, "Motion/Decay begin": 4.5}
STEPS = {"rigid": 1, "massless": 1, "rock": 5}
ELEMENTS = {0: 60, 5: 60, 17: 54, 28: 58}


def row(program, model, joints, law):
    settings = {**STRONG, "Foundation/Model": model, "Dynamics/Steps per sample": STEPS[model],
                "Mesh/Arch210/Joints": max(joints, 1), "Mesh/Arch210/Elements along": ELEMENTS[joints],
                "Joints/Model": law}
    with tempfile.TemporaryDirectory() as directory:
        summary = simulate(program, SCENE, settings, directory)
        with open(Path(directory) / "history.csv") as file:
            crest = [1e3 * float(line["crest_x"]) for line in csv.DictReader(file)]
        with open(Path(directory) / "joints.csv") as file:
            openings = [1e3 * max(float(line["opening_upstream"]), float(line["opening_downstream"]))
                        for line in csv.DictReader(file)]
        with open(Path(directory) / "faces.csv") as file:
            nodes = list(csv.DictReader(file))
    upper = {face: [float(n["max_principal"]) / 1e6 for n in nodes if n["face"] == face and float(n["z"]) >= 150
                    and abs(float(n["s"])) <= 150] for face in ("upstream", "downstream")}
    extremes = {name: value["value"] for name, value in summary["extremes"].items()}
    if law == "tied":
        joint_columns = "- | - | - | -"
    else:
        joint_columns = (f"{1e3 * extremes['max_opening']:.1f} | {sum(openings) / len(openings):.1f} | "
                         f"{openings[0]:.1f}, {openings[-1]:.1f} | {1e3 * extremes['max_slip']:.0f}")
    return (f"| {model} | {joints} | {law} | {min(crest) - crest[0]:.0f} / {max(crest) - crest[0]:+.0f} | "
            f"{joint_columns} | " + " / ".join(f"{sum(u) / len(u):.1f}" for u in upper.values()) +
            f" | {extremes['max_tension_upstream'] / 1e6:.1f} / {extremes['max_tension_downstream'] / 1e6:.1f} | "
            f"{extremes['max_compression'] / 1e6:.1f} | {summary['energy_balance_error']:.0e} | "
            f"{summary['seconds']['wall']:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, of one thread each")
    parser.add_argument("--foundations", nargs="+", choices=STEPS, default=list(STEPS))
    options = parser.parse_args()
    print("| foundation | joints | law | crest upstream / downstream [mm] | largest opening [mm] | mean of the joints "
          "[mm] | end joints [mm] | largest slip [mm] | upper tension upstream / downstream [MPa] | largest tension "
          "[MPa] | compression [MPa] | energy balance | s |")
    print("|---" * 13 + "|")
    cases = [(model, joints, law) for model in options.foundations
             for joints, law in ((0, "tied"), (5, "FJA"), (5, "FJB"), (17, "FJA"), (28, "FJA"))]
    with ThreadPoolExecutor(options.jobs) as pool:
        rows = {case: pool.submit(row, options.voussoir, *case) for case in cases}
        for case in cases:
            print(rows[case].result(), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
