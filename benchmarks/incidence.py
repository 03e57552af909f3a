#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect of the direction of the incident waves on openings, tension and crest of rock28.

    benchmarks/incidence.py [SCENE] [--duration 6] [--output output/incidence] [--voussoir PROGRAM]

All components of the motion rise at the same angle: SV, SH and P waves with the same azimuth. Finished runs are not repeated. Prints a
Markdown table. Cost: CPU time of the steps.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from program import ROOT, add_program_argument, run
from voussoir.tables import read_table

FROM = {"right bank": 90, "left bank": -90, "upstream": 0, "downstream": 180}


def waves(angle, azimuth):
    return ", ".join(f"{kind} {angle} {azimuth}" for kind in ("SV", "SH", "P"))


def row_of(folder):
    summary = json.loads((folder / "summary.json").read_text())
    joints, extremes = read_table(folder / "joints.csv"), summary["extremes"]
    openings = 1e3 * np.maximum(joints["opening_upstream"], joints["opening_downstream"])
    half = len(openings) // 2
    tension = [extremes[f"max_tension_{face}_away_from_base"]["value"] / 1e6 for face in ("upstream", "downstream")]
    return openings[:half].max(), openings[half:].max(), *tension, summary["seconds"]["shaking_cpu"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("scene", nargs="?", default="rock28")
    parser.add_argument("--duration", default="6")
    parser.add_argument("--angles", default="15,30", help="from the vertical [deg]")
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "incidence")
    options = parser.parse_args()
    variants = {"vertical": "vertical"}
    for angle in options.angles.split(","):
        for name, azimuth in FROM.items():
            variants[f"{angle} degrees from {name}"] = waves(angle, azimuth)
    print("| Waves | Largest opening, right; left half [mm] | Tension up; down [MPa] | Cost |\n|---|---|---|---|")
    cost = None
    for name, incidence in variants.items():
        folder = options.output / f"{options.scene}-{name.replace(' ', '-')}"
        if not (folder / "summary.json").exists():
            run(options.voussoir, ROOT / "prm" / f"{options.scene}.prm", "--output", folder, "--overwrite", "--set",
                f"Motion/Duration={options.duration}", "--set", "Output/Figures=false", "--set", f"Foundation/Incidence={incidence}")
        right, left, up, down, seconds = row_of(folder)
        cost = cost or seconds
        print(f"| {name} | {right:.1f}; {left:.1f} | {up:.2f}; {down:.2f} | {seconds / cost:.2f} |", flush=True)


if __name__ == "__main__":
    main()
