#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Is the physics of arch210 right? The tied dam against response-spectrum values; joints open and relieve the arches.

    benchmarks/physics.py [--voussoir PROGRAM]

Prints Markdown tables. Exit status: 0 if the mean crest amplitude of the tied dam lies within 20 % of the response
spectrum's, 1 if not.
"""

import argparse
import csv
import math
import sys
import tempfile
from pathlib import Path

from program import ROOT, add_program_argument, simulate

SCENE = ROOT / "prm" / "coarse.prm"
SEEDS = [1, 2, 3, 4]
SPECTRUM = {1.0: 168.6, 0.5: 146.8}  # crest, stream direction, 24 modes, SRSS [mm]


def measure(program, settings):
    with tempfile.TemporaryDirectory() as directory:
        summary = simulate(program, SCENE, settings, directory)
        with open(Path(directory) / "history.csv") as file:
            crest = [float(row["crest_x"]) for row in csv.DictReader(file)]
        with open(Path(directory) / "joints.csv") as file:
            openings = [1e3 * max(float(row["opening_upstream"]), float(row["opening_downstream"]))
                        for row in csv.DictReader(file)]
        upper = {}
        if (Path(directory) / "faces.csv").exists():
            with open(Path(directory) / "faces.csv") as file:
                rows = list(csv.DictReader(file))
            upper = {face: sum(tensions) / len(tensions) for face in ("upstream", "downstream") for tensions in
                     [[float(row["max_principal"]) / 1e6 for row in rows if row["face"] == face
                       and float(row["z"]) >= 150 and abs(float(row["s"])) <= 150]]}
    print(".", end="", file=sys.stderr, flush=True)
    moves = [1e3 * (x - crest[0]) for x in crest]
    return summary, min(moves), max(moves), openings, upper


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    options = parser.parse_args()
    good = True

    print("### Tied dam, stream-wise shaking alone: crest amplitude [mm]\n")
    print("| Westergaard | response spectrum | " + " | ".join(f"seed {s}" for s in SEEDS) + " | mean, difference |")
    print("|---" * (len(SEEDS) + 3) + "|")
    for factor, target in SPECTRUM.items():
        amplitudes = []
        for seed in SEEDS:
            _, low, high, _, _ = measure(options.voussoir, {
                "Joints/Model": "tied", "Reservoir/Factor": factor, "Motion/Seed": seed, "Motion/Scale y": 0,
                "Motion/Scale z": 0, "Output/Envelope interval": 0})
            amplitudes.append(max(-low, high))
        mean = sum(amplitudes) / len(amplitudes)
        good = good and abs(mean / target - 1) <= 0.2
        print(f"| x {factor} | {target} | " + " | ".join(f"{a:.0f}" for a in amplitudes) +
              f" | {mean:.0f}, {mean / target - 1:+.0%} |", flush=True)

    print("\n### Joints, three components, seed 1\n")
    print("Upper tension: the envelope's mean over the face above z = 150 m, within 150 m of the crown.\n")
    print("| joints | law | crest upstream / downstream [mm] | largest opening [mm] | mean of the joints [mm] | "
          "end joints [mm] | largest slip [mm] | upper tension upstream / downstream [MPa] | "
          "largest tension upstream / downstream [MPa] | compression [MPa] | energy balance | CPU s |")
    print("|---" * 12 + "|")
    for joints, law in [(5, "tied")] + [(n, law) for law in ("FJA", "FJB") for n in (5, 17, 28)]:
        along = math.ceil(60 / (joints + 1)) * (joints + 1)
        summary, low, high, openings, upper = measure(options.voussoir, {
            "Mesh/Arch210/Joints": joints, "Mesh/Arch210/Elements along": along, "Joints/Model": law})
        extremes = {name: value["value"] for name, value in summary["extremes"].items()}
        ends = f"{openings[0]:.1f}, {openings[-1]:.1f}"
        print(f"| {joints} | {law} | {low:.0f} / {high:+.0f} | {1e3 * extremes['max_opening']:.1f} | "
              f"{sum(openings) / len(openings):.1f} | {ends} | {1e3 * extremes['max_slip']:.0f} | "
              f"{upper['upstream']:.1f} / {upper['downstream']:.1f} | "
              f"{extremes['max_tension_upstream'] / 1e6:.1f} / {extremes['max_tension_downstream'] / 1e6:.1f} | "
              f"{extremes['max_compression'] / 1e6:.1f} | {summary['energy_balance_error']:.0e} | "
              f"{summary['seconds']['cpu']:.0f} |", flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
