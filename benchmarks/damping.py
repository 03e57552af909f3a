#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Openings and slips under other damping than uniform 5 %, paired: the same motions, the same dam.

    benchmarks/damping.py [SCENE...] [--motions 8] [--set ENTRY=VALUE] [--voussoir PROGRAM]

SCENE: scenes of prm/ or files (default: coarse, and benchmarks/pacoima.prm on a rigid base
with open joints and a coarser mesh). Motions are artificial, with seeds from 1. Prints a Markdown
table: the median of the ratio of the largest opening (of the largest slip) to that under uniform 5 %, with the range of all motions."""

import argparse
import sys
from pathlib import Path
from statistics import median

from program import ROOT, add_program_argument, simulate

UNIFORM = {"Damping/Model": "uniform", "Damping/Reference frequency": 2.7}
MODELS = {
    "uniform 5 % from 0.5 to 20 Hz, modulus kept at 2.7 Hz": UNIFORM,
    "uniform 3 %": {**UNIFORM, "Damping/Ratio": .03},
    "uniform 10 %": {**UNIFORM, "Damping/Ratio": .1},
    "uniform 5 % from 1 to 10 Hz": {**UNIFORM, "Damping/Band begin": 1, "Damping/Band end": 10},
    "uniform 5 %, modulus kept at the first frequency": {"Damping/Model": "uniform"},
    "Rayleigh, 5 % at 1.2 and 6 Hz (default)": {},
    "its mass term alone": {"Damping/Mass coefficient": .6283185, "Damping/Stiffness coefficient": 0},
    "its stiffness term alone": {"Damping/Mass coefficient": 0, "Damping/Stiffness coefficient": .002210485},
    "stiffness term alone, 5 % at 1.2 Hz": {"Damping/Mass coefficient": 0, "Damping/Stiffness coefficient": .0132629},
}
EXTREMES = ("opening", "slip")
PACOIMA = ROOT / "benchmarks" / "pacoima.prm"
OF_PACOIMA = {"Foundation/Model": "rigid", "Mesh/Arcs/Rock/Enabled": "false", "Joints/Model": "FJA", "Statics/Self-weight": "staged",
              "Motion/Source": "artificial", "Motion/Duration": 10.24, "Dynamics/Steps per sample": 2,
              "Mesh/Arcs/Elements along": 22, "Mesh/Arcs/Elements up": 8}


def ratio_text(values):
    return f"{median(values):.2f} ({min(values):.2f} to {max(values):.2f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=["coarse", str(PACOIMA)])
    parser.add_argument("--motions", type=int, default=8)
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE")
    add_program_argument(parser)
    options = parser.parse_args()
    common = dict(word.split("=", 1) for word in options.set)
    columns = []
    for scene in options.scenes:
        file = ROOT / "prm" / f"{scene}.prm" if not Path(scene).exists() else Path(scene)
        found, base = {}, OF_PACOIMA if file == PACOIMA else {}
        for model, settings in MODELS.items():
            for seed in range(1, options.motions + 1):
                summary = simulate(options.voussoir, file, {**base, "Motion/Seed": seed, **common, **settings})
                found[model, seed] = [abs(summary["extremes"][f"max_{name}"]["value"]) for name in EXTREMES]
            print(f"{file.stem}, {model}: {[round(1e3 * found[model, seed][0], 1) for seed in range(1, options.motions + 1)]} mm", file=sys.stderr, flush=True)
        first = next(iter(MODELS))
        columns.append((file.stem, {model: [ratio_text([found[model, seed][k] / found[first, seed][k] for seed in range(1, options.motions + 1)])
                                            for k in range(len(EXTREMES))] for model in MODELS}))
    print("| Damping |", " | ".join(f"{name}: {extreme}" for name, _ in columns for extreme in EXTREMES), "|")
    print("|---|" + "---|" * (len(EXTREMES) * len(columns)))
    for model in MODELS:
        print(f"| {model} |", " | ".join(text for _, found in columns for text in found[model]), "|")


if __name__ == "__main__":
    main()
