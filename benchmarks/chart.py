#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against cost of numerical and modelling choices in the same axes, for the quick start, rigid28 and rock28: doc/figures/chart.png.

    benchmarks/chart.py [SCENE...] [--seconds 5] [--output output/chart] [--only GROUP,...] [--voussoir PROGRAM]

For each scene the script runs `voussoir accuracy` and `voussoir needs`; existing runs are not repeated. The error of a point is the larger one of
openings and tension.

- The scene: the estimate of `voussoir accuracy` for its mesh and time step.
- Numerical choice: the estimate with another level of this choice. The error of the present level is replaced in the sum of squares.
- Modelling choice: the larger change of the largest opening and of the tension of both faces, added to the error of the scene by squares.
- Band: the same change by the other motions of the spectrum. An error below its lower edge cannot be seen in the answer for one motion.
- Front: the points that no other point beats in cost and error.

Prints the points of the front as a Markdown table. Marks on the axis: other programs, CPU seconds per second of an earthquake of a dam with five joints
and 1,134 to 5,040 unknowns, on a loaded machine (penalty contact; the exact node-to-node program).
"""

import argparse
import csv
import json
import math
import os
import sys
from pathlib import Path

import matplotlib

from program import ROOT, add_program_argument, run

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from voussoir.palette import COLOURS  # noqa: E402

SCENES = ("quickstart", "rigid28", "rock28")
PEERS = {"node-to-node program in Python": 22, "OpenSees": 102, "CalculiX": 440}
COLUMNS = ("opening", "tension_upstream", "tension_downstream")


def results(scene, options):
    """accuracy.json, the rows of accuracy.csv, needs.json."""
    file, folders = ROOT / "prm" / f"{scene}.prm", [options.output / f"{scene}-{command}" for command in ("accuracy", "needs")]
    only = ["--only", options.only] if options.only else []
    for command, folder, more in zip(("accuracy", "needs"), folders, ([], only)):
        if not (folder / f"{command}.json").exists():
            print(f"{scene}: voussoir {command}", file=sys.stderr, flush=True)
            run(options.voussoir, command, file, "--seconds", options.seconds, "--output", folder, *more)
    with open(folders[0] / "accuracy.csv", encoding="utf-8") as table:
        levels = list(csv.DictReader(table))
    return json.loads((folders[0] / "accuracy.json").read_text()), levels, json.loads((folders[1] / "needs.json").read_text())


def change_of(row):
    """Largest change of opening and tensions that count; None without a result."""
    changes = [abs(row["changes"][column]) for column in COLUMNS if row.get("changes") and row["changes"].get(column) is not None
               and row["counts"][column]]
    return max(changes) if changes else None


def points_of(accuracy, levels, needs):
    """(kind, name, cost, error) of the scene, of numerical and of modelling choices; the band of the motions, or None."""
    error, cost = max(accuracy["error"].values()), accuracy["cost"]
    worst = max(accuracy["error"], key=accuracy["error"].get)
    points = [("scene", "the scene", cost, error)]
    now = {level["choice"]: float(level[f"error_{worst}"]) for level in levels if abs(float(level["cost"]) / cost - 1) < 1e-5}
    for level in levels:
        own, of_level = now.get(level["choice"], 0.), float(level[f"error_{worst}"])
        if abs(float(level["cost"]) / cost - 1) >= 1e-5:
            name = f"{level['choice']}: " + ", ".join(part.split("/")[-1] for part in level["setting"].split("; "))
            points.append(("numerical", name, float(level["cost"]), math.sqrt(max(error**2 - own**2, 0.) + of_level**2)))
    scatter = []
    for row in needs["rows"]:
        change = change_of(row)
        if change is None or row["group"] == "numerics":
            continue
        if row["name"].startswith("scatter"):
            scatter.append(change)
        else:
            points.append(("modelling", f"{row['group']}: {row['name']}", cost * row["cost"], math.hypot(error, change)))
    return points, (min(scatter), max(scatter)) if scatter else None


def front_of(points):
    """The points that no other point beats, by ascending cost."""
    result = []
    for point in sorted(points, key=lambda p: (p[2], p[3])):
        if not result or point[3] < result[-1][3]:
            result.append(point)
    return result


def draw(axes, scene, points, band):
    marks = {"scene": ("*", "k", 14), "numerical": ("o", COLOURS[0], 6), "modelling": ("s", COLOURS[1], 5)}
    for kind, (mark, colour, size) in marks.items():
        chosen = [p for p in points if p[0] == kind]
        axes.plot([p[2] for p in chosen], [100 * p[3] for p in chosen], mark, color=colour, markersize=size,
                  label=scene if kind == "scene" else f"{kind} choice")
    front = front_of(points)
    axes.step([p[2] for p in front], [100 * p[3] for p in front], "-", where="post", color="0.3", linewidth=1, label="front")
    for k, (_, name, cost, error) in enumerate(front):
        axes.annotate(str(k + 1), (cost, 100 * error), textcoords="offset points", xytext=(4, 4), fontsize=8)
    if band:
        axes.axhspan(100 * band[0], 100 * band[1], color="0.85", zorder=0, label="scatter of motions")
    for name, cost in PEERS.items():
        axes.axvline(cost, color="0.6", linewidth=.7, linestyle=":")
        axes.annotate(name, (cost, 1), xycoords=("data", "axes fraction"), rotation=90, fontsize=6, ha="right", va="top", color="0.4")
    axes.set(xscale="log", yscale="log", title=scene, xlabel="cost [s of one thread per s of earthquake]")
    axes.grid(True, which="both", linewidth=.3, color="0.9")
    return front


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--only", default="", help="groups of `voussoir needs`")
    parser.add_argument("--output", type=Path, default=Path("output/chart"))
    add_program_argument(parser)
    options = parser.parse_args()
    scenes = options.scenes or SCENES
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    figure, all_axes = plt.subplots(1, len(scenes), figsize=(5.5 * len(scenes), 5), squeeze=False)
    for scene, axes in zip(scenes, all_axes[0]):
        points, band = points_of(*results(scene, options))
        front = draw(axes, scene, points, band)
        print(f"\n| {scene}, front | Cost [s/s] | Error |\n|---|---|---|")
        for k, (_, name, cost, error) in enumerate(front):
            print(f"| {k + 1}: {name} | {cost:.3g} | {100 * error:.2g} % |")
        if band:
            print(f"\nScatter between motions: {100 * band[0]:.2g} to {100 * band[1]:.2g} %.")
    all_axes[0][0].set_ylabel("error of openings or tension, the larger [%]")
    all_axes[0][0].legend(fontsize=8, frameon=False)
    file = ROOT / "doc" / "figures" / "chart.png" if not options.scenes else options.output / "chart.png"
    figure.savefig(file, dpi=140, bbox_inches="tight")
    print(f"\n{file}")


if __name__ == "__main__":
    main()
