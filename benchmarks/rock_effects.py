#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect of the direction of the incident waves, or of the quality factor of the rock, on openings and tension of rock28.

    benchmarks/rock_effects.py incidence|quality [SCENE] [--duration 6] [--output output/rock_effects] [--voussoir PROGRAM]

incidence: all components of the motion rise at the same angle: SV, SH and P waves with the same azimuth. Finished runs are not
repeated. Prints a Markdown table. Cost: CPU time of the steps.
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


def variants_of(study):
    """Name of each variant and its entry."""
    if study == "quality":
        return {"none": "Foundation/Quality factor=0", **{f"Q = {q}": f"Foundation/Quality factor={q}" for q in (100, 50, 20)}}
    entries = {"vertical": "vertical", **{f"{angle} degrees from {name}": waves(angle, azimuth)
                                          for angle in (15, 30) for name, azimuth in FROM.items()}}
    return {name: f"Foundation/Incidence={value}" for name, value in entries.items()}


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
    parser.add_argument("study", choices=("incidence", "quality"))
    parser.add_argument("scene", nargs="?", default="rock28")
    parser.add_argument("--duration", default="6")
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "rock_effects")
    options = parser.parse_args()
    print("| Variant | Largest opening, right; left half [mm] | Tension up; down [MPa] | Cost |\n|---|---|---|---|")
    cost = None
    for name, entry in variants_of(options.study).items():
        folder = options.output / f"{options.scene}-{name.replace(' ', '-')}"
        if not (folder / "summary.json").exists():
            run(options.voussoir, ROOT / "prm" / f"{options.scene}.prm", "--output", folder, "--overwrite", "--set",
                f"Motion/Duration={options.duration}", "--set", "Output/Figures=false", "--set", entry)
        right, left, up, down, seconds = row_of(folder)
        cost = cost or seconds
        print(f"| {name} | {right:.1f}; {left:.1f} | {up:.2f}; {down:.2f} | {seconds / cost:.2f} |", flush=True)


if __name__ == "__main__":
    main()
