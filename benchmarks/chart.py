#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against cost of numerical and modelling choices in the same axes, for the quick start, rigid28 and rock28: doc/figures/chart.png.

    benchmarks/chart.py [SCENE...] [--seconds 5] [--output output/chart] [--figure FILE] [--only GROUP,...] [--voussoir PROGRAM]

For each scene the script runs `voussoir accuracy` and `voussoir needs`; finished runs in the output directory are not repeated. The error of a
point is the larger one of openings and tension.

- The scene: the estimate of `voussoir accuracy` for its mesh and time step.
- Numerical choice: the estimate with another level of this choice. The error of the present level is replaced in the sum of squares.
  Coarser levels are those of `voussoir needs`: error of the present level plus the change of the largest values, or if larger, the error of the
  present level with the order of convergence (needs compares single values, accuracy all joints and zones).
- Simpler model: the larger change of the largest opening and of the tension of both faces, added to the error of the scene by squares.
- Other model (hollow): the same; the change is the error of the scene if the other model is the better one. Not in the front.
- Other motions: half of the range of the results from 16 to 84 % over motions of the spectrum, from the smallest to the largest.
- Front: the points that no other point beats in cost and error; errors that differ by less than 2 % of their value are equal.

A modelling choice is one that can be made for the same dam, water and earthquake: model of the water, foundation, model and number of the joints,
self-weight in stages. Other values of the input (water level, friction, damping, modulus, components of the motion) are left out.
Degree, tolerance and precision are left out too, since neither command estimates their error.

Prints the points of the front as a Markdown table. Lines in the first panel: other programs, CPU seconds per second of an earthquake of a dam with five
joints and 1,134 to 5,040 unknowns, on a loaded machine (penalty contact; the exact node-to-node program).
"""

import argparse
import csv
import itertools
import json
import math
import os
import sys
from pathlib import Path

import matplotlib
import numpy as np

from program import ROOT, add_program_argument, run

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from voussoir.palette import COLOURS  # noqa: E402

SCENES = ("quickstart", "rigid28", "rock28")
PEERS = {"node-to-node program in Python": 22, "OpenSees": 102, "CalculiX": 440}
MEASURES = {"openings": ("opening",), "tension": ("tension_upstream", "tension_downstream")}
INPUTS = ("Reservoir/Water level", "Reservoir/Density", "Joints/Friction")  # entries of the groups below that are no models
GROUPS = {"water", "foundation", "joints", "loads"}
SHORT = {"self-weight monolithic": "weight at once", "half of Westergaard": "half the added mass", "massless": "massless rock"}
MARKS = {"scene": ("*", "k", "k", 15), "numerical": ("o", COLOURS[0], COLOURS[0], 6), "simpler": ("s", COLOURS[1], COLOURS[1], 6),
         "other": ("s", COLOURS[1], "white", 6)}
KINDS = {"scene": "the scene", "numerical": "numerical choice", "simpler": "simpler model", "other": "other model"}


def results(scene, options):
    """accuracy.json, the rows of accuracy.csv, and needs.json."""
    file, folders = ROOT / "prm" / f"{scene}.prm", [options.output / f"{scene}-{command}" for command in ("accuracy", "needs")]
    only = ["--only", options.only] if options.only else []
    for command, folder, more in zip(("accuracy", "needs"), folders, ([], only)):
        if not (folder / f"{command}.json").exists():
            print(f"{scene}: voussoir {command}", file=sys.stderr, flush=True)
            run(options.voussoir, command, file, "--seconds", options.seconds, "--output", folder, *more)
    with open(folders[0] / "accuracy.csv", encoding="utf-8") as table:
        levels = list(csv.DictReader(table))
    return json.loads((folders[0] / "accuracy.json").read_text()), levels, json.loads((folders[1] / "needs.json").read_text())


def change_of(row, columns=sum(MEASURES.values(), ())):
    """Largest change of these columns that counts; None without a result."""
    changes = [abs(row["changes"][column]) * row["counts"][column] for column in columns if (row.get("changes") or {}).get(column) is not None]
    return max(changes) if changes else None


def name_of(choice, entry, value, entries):
    """Short name of a level: 30 elements up; time step 2.5 ms."""
    if entry == "Dynamics/Steps per sample":
        return f"time step {1e3 * float(entries['Motion/Time step']) / float(value):.3g} ms"
    if choice in ("along", "up", "through"):
        return f"{value} element{'s' * (int(value) > 1)} {choice}"
    return f"{choice} {value}"


def numerical_points(accuracy, levels, needs):
    """Points of other levels: of the command accuracy, then coarser ones of the command needs."""
    cost, found = accuracy["cost"], []
    now, entry_of = {}, {}
    for level in levels:
        settings = dict(part.split(" = ") for part in level["setting"].split("; "))
        entry, value = next(iter(settings.items()))
        if abs(float(level["cost"]) / cost - 1) < 1e-5:
            now[level["choice"]] = level
        else:
            found.append((level["choice"], entry, value, float(level["cost"]), {m: float(level[f"error_{m}"]) for m in MEASURES}))
        entry_of[entry] = level["choice"]
    for row in needs["rows"]:
        entry, value = next(iter(row["set"].items()))
        known = any(level[1] == entry and float(level[2]) == float(value) for level in found) if entry in entry_of else True
        if row["group"] == "numerics" and row["simpler"] and not known and change_of(row) is not None and entry_of[entry] in now:
            present = now[entry_of[entry]]
            ratio = float(dict(part.split(" = ") for part in present["setting"].split("; "))[entry]) / float(value)
            growth, error = max(ratio, 1 / ratio)**float(present["order"]), {m: float(present[f"error_{m}"]) for m in MEASURES}
            errors = {m: max(error[m] + (change_of(row, columns) or 0.), error[m] * growth) for m, columns in MEASURES.items()}
            found.append((entry_of[entry], entry, value, cost * row["cost"], errors))
    for choice, entry, value, of_level, errors in found:
        own = {m: float(now[choice][f"error_{m}"]) if choice in now else 0. for m in MEASURES}
        error = max(math.sqrt(max(accuracy["error"][m]**2 - own[m]**2, 0.) + errors[m]**2) for m in MEASURES)
        yield "numerical", name_of(choice, entry, value, accuracy["entries"]), of_level, error


def points_of(accuracy, levels, needs):
    """(kind, name, cost, error) of the scene, of numerical and of modelling choices; smallest and largest scatter of a result over motions, or None."""
    error, cost = max(accuracy["error"].values()), accuracy["cost"]
    points = [("scene", "the scene", cost, error), *numerical_points(accuracy, levels, needs)]
    for row in needs["rows"]:
        change = change_of(row)
        if change is not None and row["group"] in GROUPS and not set(INPUTS) & set(row["set"]):
            points.append(("simpler" if row["simpler"] else "other", SHORT.get(row["name"], row["name"]), cost * row["cost"], math.hypot(error, change)))
    scatter = [needs["scatter"][column] for columns in MEASURES.values() for column in columns if needs["scatter"][column]]
    return points, (min(scatter), max(scatter)) if scatter else None


def front_of(points):
    """The points that no other point beats, by ascending cost; the scene comes first if costs are equal within 2 %."""
    result = []
    for point in sorted((p for p in points if p[0] != "other"), key=lambda p: (p[2] * (.98 if p[0] == "scene" else 1.), p[3])):
        if not result or point[3] < .98 * result[-1][3]:
            result.append(point)
    return result


def two_digits(value):
    return f"{float(f'{value:.2g}'):g}"


def place_labels(axes, labels, marks, line):
    """Writes each label (text, x, y, style) beside its point, where it covers least of marks, line and other labels."""
    renderer = axes.figure.canvas.get_renderer()
    scale, inside = axes.figure.dpi / 72., axes.get_window_extent(renderer)
    taken = [(x - r * scale, y - r * scale, x + r * scale, y + r * scale)
             for points, r in ((marks, 5), (line, 1.5)) for x, y in axes.transData.transform(points)]
    shared = lambda a, b: max(0., min(a[2], b[2]) - max(a[0], b[0])) * max(0., min(a[3], b[3]) - max(a[1], b[1]))
    for text, x, y, style in labels:
        best = None
        for distance, k in itertools.product((7, 11, 16, 23, 32, 44), range(16)):
            dx, dy = distance * math.cos(math.pi * k / 8), distance * math.sin(math.pi * k / 8)
            note = axes.annotate(text, (x, y), textcoords="offset points", xytext=(dx, dy), va="center", fontsize=7.5,
                                 ha="left" if dx > 1 else "right" if dx < -1 else "center", **style)
            box = note.get_window_extent(renderer).extents
            area = (box[2] - box[0]) * (box[3] - box[1])
            bad = sum(shared(box, other) for other in taken) + 3 * (area - shared(box, inside.extents)) + .012 * area * distance
            loser = note
            if best is None or bad < best[0]:
                loser, best = best and best[1], (bad, note, box, distance, (dx, dy))
            if loser:
                loser.remove()
        if best[3] > 12:
            arrow = {"arrowstyle": "-", "color": "0.6", "linewidth": .6, "shrinkA": 0, "shrinkB": 3}
            axes.annotate("", (x, y), textcoords="offset points", xytext=best[4], arrowprops=arrow)
        taken.append(best[2])


def draw(axes, scene, points, band, with_peers):
    front = front_of(points)
    if band:
        low, high = (100 * band[0] / 1.01, 100 * band[1] * 1.01)
        axes.axhspan(low, high, color="0.91", zorder=0, label="other motions")
    axes.step([p[2] for p in front], [100 * p[3] for p in front], "-", where="post", color="0.45", linewidth=1.1, zorder=1, label="smallest error for the cost")
    for kind, (mark, edge, face, size) in MARKS.items():
        chosen = [p for p in points if p[0] == kind]
        axes.plot([p[2] for p in chosen], [100 * p[3] for p in chosen], mark, color=edge, markerfacecolor=face, markersize=size,
                  zorder=4 if kind == "scene" else 3, label=KINDS[kind])
    axes.set(xscale="log", yscale="log", title=scene, xlabel="cost [s of one thread per s of earthquake]")
    axes.margins(.12, .08)
    if with_peers:
        axes.set_xlim(right=700)
        for name, cost in PEERS.items():
            axes.axvline(cost, color="0.6", linewidth=.8, linestyle=":", zorder=0)
            axes.annotate(name, (cost, .5), xycoords=("data", "axes fraction"), xytext=(-3, 0), textcoords="offset points", rotation=90, fontsize=7.5,
                          ha="right", va="center", color="0.35")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.grid(True, which="major", linewidth=.5, color="0.9")
    numbers = {p: k + 1 for k, p in enumerate(front)}
    style = lambda p: {"color": MARKS[p[0]][1], "weight": "bold" if p in numbers else "normal"}
    labels = [(f"{numbers[p]}: {p[1]}" if p in numbers else p[1], p[2], 100 * p[3], style(p))
              for p in front + [p for p in points if p not in numbers and p[0] in ("simpler", "other")]]
    line = [point for a, b in zip(front, front[1:]) for w in np.linspace(0, 1, 25)
            for point in ((a[2] * (b[2] / a[2])**w, 100 * a[3]), (b[2], 100 * a[3] * (b[3] / a[3])**w))]
    place_labels(axes, labels, [(p[2], 100 * p[3]) for p in points], line)
    return front


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--only", default="", help="groups of `voussoir needs`")
    parser.add_argument("--output", type=Path, default=Path("output/chart"))
    parser.add_argument("--figure", type=Path, help="default: doc/figures/chart.png, with SCENE chart.png in the output directory")
    add_program_argument(parser)
    options = parser.parse_args()
    scenes = options.scenes or SCENES
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    figure, all_axes = plt.subplots(1, len(scenes), figsize=(6.2 * len(scenes), 6.2), squeeze=False, dpi=130)
    figure.tight_layout(rect=(.01, .065, 1, .98))
    drawn = []
    for scene, axes in zip(scenes, all_axes[0]):
        points, band = points_of(*results(scene, options))
        drawn.append((axes, scene, points, band))
        front = front_of(points)
        print(f"\n| {scene}, front | Cost [s/s] | Error |\n|---|---|---|")
        for k, (_, name, cost, error) in enumerate(front):
            print(f"| {k + 1}: {name} | {two_digits(cost)} | {two_digits(100 * error)} % |")
        if band:
            print(f"\nOther motions: {two_digits(100 * band[0])} to {two_digits(100 * band[1])} %.")
    all_axes[0][0].set_ylabel("error of openings or tension, the larger [%]")
    for k, (axes, *rest) in enumerate(drawn):
        draw(axes, *rest, with_peers=k == 0)
    handles, labels = all_axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=len(labels), fontsize=9, frameon=False)
    file = options.figure or (options.output if options.scenes else ROOT / "doc" / "figures") / "chart.png"
    figure.savefig(file)
    print(f"\n{file}")


if __name__ == "__main__":
    main()
