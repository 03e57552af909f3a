#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What factors in single precision change, for doc/method.md: each scene with Dynamics/Factors double and single.

Usage: benchmarks/factors.py [--voussoir build/voussoir] [--seconds 5.12] [SCENE.prm ...]
The differences of histories are those of a column over its largest value, for columns that exceed 10 micrometres.
"""
import argparse
import csv
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ("coarse", "rigid28", "rigid28_tied", "rock_fja", "paper_3_2_ksm")


def columns(path):
    if not path.exists():
        return {}
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0]) if name != "time"}


def difference(first, second):
    """The largest of all columns, 0 where there are none."""
    worst = 0.
    for name, values in first.items():
        size = max(map(abs, values))
        if size > 1e-5:
            worst = max(worst, max(abs(a - b) for a, b in zip(values, second[name])) / size)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--voussoir", default=ROOT / "build/voussoir")
    parser.add_argument("--seconds", default="5.12", help="of the motion")
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="of all runs")
    parser.add_argument("scenes", nargs="*", default=[ROOT / f"prm/{name}.prm" for name in SCENES])
    arguments = parser.parse_args()
    print("| scene | balance of energy, double, single | histories, off by | joints' histories | largest opening [m] |")
    print("|---|---|---|---|---|")
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as scratch:
            runs = []
            for factors in ("double", "single"):
                directory = Path(scratch, factors)
                subprocess.run([arguments.voussoir, scene, "--output", directory, "--quiet", "--set", "Output/Figures=false", "--set",
                                f"Motion/Duration={arguments.seconds}", "--set", f"Dynamics/Factors={factors}",
                                *(x for entry in arguments.set for x in ("--set", entry))], check=True)
                runs.append((json.loads((directory / "summary.json").read_text()), columns(directory / "history.csv"),
                             columns(directory / "joint_history.csv")))
        (one, history, joints), (two, history_2, joints_2) = runs
        opening = [s["extremes"].get("max_opening", {"value": 0.})["value"] for s in (one, two)]
        print(f"| {Path(scene).stem} | {one['energy_balance_error']:.1e}, {two['energy_balance_error']:.1e} | "
              f"{difference(history, history_2):.1e} | {difference(joints, joints_2):.1e} | "
              f"{opening[0]:.5f}, off by {abs(opening[1] - opening[0]):.1e} |", flush=True)


if __name__ == "__main__":
    main()
