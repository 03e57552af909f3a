#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against cost of the choices that a scene has, each against the best of its kind.

    benchmarks/choices.py [GROUP...] [--rows LABEL...] [--seconds 3] [--seed N] [--set ENTRY=VALUE] [--voussoir PROGRAM]

Groups: quickstart, joints28 (mesh and time step together), steps (time step and rule of impact), elements, box (its sizes), box_static,
rock28_cells, rock_layers. On rock the motion ends in 0.2 s, and half a second of rest follows: what rises from the bottom is all at the
dam before the end, whatever the depth.
The measures are those of `voussoir accuracy`: largest openings of the joints (root of the sum of squares), means of the
tension envelope over nine zones of each face; over the strongest seconds of the scene's motion. Each group has a
reference: the finest step, mesh or box. Prints Markdown tables, and draws doc/figures/choices_steps.png. Cost: seconds of processor
time of one thread per second of earthquake, without set-up.
"""

import argparse
import sys
import tempfile
from math import floor, log10
from pathlib import Path

import matplotlib
import numpy as np

from program import ROOT, add_program_argument, run, simulate
from voussoir.accuracy import strongest
from voussoir.tables import read_table
from voussoir.zone_tension import zone_means

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator

RIGID, ROCK, MANY, ROCK_MANY = (ROOT / "prm" / f"{name}.prm" for name in ("coarse", "rock_fja", "rigid28", "rock28"))
STEPS = "Dynamics/Steps per sample"
CHARTS = ("steps",)  # that doc/accuracy.md shows
SIDES = ("Upstream", "Downstream", "Sides", "Depth")
FADE, REST = 20, 50  # samples at the end of a motion on rock


def mesh(along, up, through):
    return {"Mesh/Arch210/Elements along": along, "Mesh/Arch210/Elements up": up, "Mesh/Arch210/Elements through": through}


def box(reach, sides=SIDES):
    return {f"Mesh/Arch210/Rock/{side}": reach for side in sides}


def name(sizes):
    return " x ".join(map(str, sizes))


def steps_of(rules, counts):
    return [(rule, f"{10 / n:g} ms", {STEPS: n, "Dynamics/Impact": rule}) for rule in rules for n in counts]


def groups():
    """Name -> scene, settings of all, rows (curve, label, settings), settings of the reference, what it is."""
    linear, quadratic = [(30, 8, 1), (60, 16, 2), (90, 24, 3)], [(18, 6, 1), (30, 8, 1), (48, 12, 1)]
    modes, degree = "Elements/Incompatible modes", "Elements/Degree"
    rock = {**mesh(30, 10, 1), STEPS: 6, "Mesh/Arch210/Rock/Boundary layers": 9}
    layers = "Foundation/Layers at the dam"
    at_dam = [(name(m), f"{n} layers", {**mesh(*m), layers: n})
              for m, some in (((30, 10, 1), (0, 1, 2, 3, 4, 8)), ((60, 20, 2), (0, 3, 4)), ((90, 30, 3), (0, 3)))
              for n in some]
    nested = {**mesh(30, 10, 1), STEPS: 6}
    boxes = [("mtf3", label, settings) for label, settings in
             (("210 m", {}), ("depth 315 m", box(315, ("Depth",))), ("depth 420 m", box(420, ("Depth",))),
              ("sides 420 m", box(420, ("Sides",))), ("upstream, downstream 420 m", box(420, ("Upstream", "Downstream"))),
              ("all 315 m", box(315)), ("all 420 m", box(420)))]
    nested_far = "a box of 630 m, the same elements at the dam"
    whole = [(f"{name(m)}, {10 / n:g} ms", {**mesh(*m), STEPS: n}) for m, n in
             (((60, 16, 2), 1), ((60, 16, 2), 2), ((60, 20, 3), 2), ((72, 24, 3), 2), ((60, 24, 4), 2))]
    whole28 = [(f"{name(m)}, {10 / n:.3g} ms", {**mesh(*m), STEPS: n}) for m, n in
               (((145, 21, 4), 1), ((58, 21, 2), 2), ((58, 21, 3), 4), ((58, 14, 4), 2), ((58, 14, 4), 4), ((58, 14, 6), 2), ((58, 14, 8), 2),
                ((116, 21, 2), 4), ((116, 14, 4), 2), ((116, 14, 4), 3), ((232, 14, 4), 2),
                ((116, 21, 4), 2), ((116, 18, 5), 3), ((116, 42, 4), 4))]
    return {
        "quickstart": (RIGID, {}, [("5 joints", label, settings) for label, settings in whole], {**mesh(120, 32, 6), STEPS: 4},
                       "120 x 32 x 6 elements at 2.5 ms"),
        "joints28": (MANY, {}, [("28 joints", label, settings) for label, settings in whole28], {**mesh(232, 21, 6), STEPS: 4},
                     "232 x 21 x 6 elements at 2.5 ms"),
        "steps": (RIGID, {}, steps_of(("mean-force", "paper", "none"), (1, 2, 4)), {STEPS: 8},
                  "mean-force at 1.25 ms, on the same mesh"),
        "elements": (RIGID, {STEPS: 2},
                     [("degree 1, modes", name(m), mesh(*m)) for m in linear]
                     + [("degree 1, plain", name(m), {**mesh(*m), modes: "false"}) for m in linear]
                     + [("degree 2", name(m), {**mesh(*m), degree: 2}) for m in quadratic],
                     mesh(120, 32, 4), "degree 1 with modes, 120 x 32 x 4"),
        "box": (ROCK, nested, boxes, box(630), nested_far),
        "box_static": (ROCK, {**nested, "Motion/Source": "none"}, boxes, box(630), nested_far + ", the static state alone"),
        "rock28_cells": (ROCK_MANY, {"Foundation/Substeps": 0},
                         [("cells", f"{size} m", {"Mesh/Arch210/Rock/Element size": size}) for size in (12, 14, 16, 22, 26)],
                         {"Mesh/Arch210/Rock/Element size": 9}, "cells of 9 m"),
        "rock_layers": (ROCK, {**rock, STEPS: 8}, at_dam, {**mesh(90, 30, 3), layers: 4}, "90 x 30 x 3 elements, 4 layers"),
    }


def at_rest_after(motion):
    """The motion (t, a_x, a_y, a_z), faded out, and a while without any."""
    motion, rest = motion.copy(), np.zeros((REST, 4))
    motion[-FADE:, 1:] *= np.arange(FADE, 0, -1)[:, None] / FADE
    rest[:, 0] = motion[-1, 0] + motion[1, 0] * np.arange(1, REST + 1)
    return np.vstack([motion, rest])


class Runs:
    def __init__(self, options, scene, common, directory):
        self.options, self.scene, self.directory, self.n, self.areas = options, scene, Path(directory), 0, None
        seed = [] if options.seed is None else ["--set", f"Motion/Seed={options.seed}"]
        run(options.voussoir, "motion", scene, "--output", self.directory / "whole.csv", *seed)
        part, _ = strongest(np.loadtxt(self.directory / "whole.csv", delimiter=",", skiprows=1), options.seconds)
        if scene in (ROCK, ROCK_MANY):
            part = at_rest_after(part)
        np.savetxt(self.directory / "motion.csv", part, delimiter=",")
        self.common = {"Motion/Source": "file", "Motion/File": self.directory / "motion.csv", "Output/Checkpoint interval": 0, "Motion/Duration": -1,
                       **common}
        self.duration = part[-1, 0]

    def measure(self, settings):
        self.n += 1
        directory = self.directory / str(self.n)
        summary = simulate(self.options.voussoir, self.scene, {**self.common, **settings}, directory)
        joints = read_table(directory / "joints.csv")
        openings = np.maximum(joints["opening_upstream"], joints["opening_downstream"])
        print(".", end="", file=sys.stderr, flush=True)
        means, areas = zone_means(directory)
        if self.areas is None:
            self.areas = areas  # of the reference
        return openings, np.sqrt(self.areas / self.areas.sum()) * means, summary


def error(value, reference):
    size = np.linalg.norm(reference)
    return float(np.linalg.norm(value - reference) / size) if size > 1e-9 else float("nan")  # joints that stay closed, or none


def study(name, options):
    scene, common, rows, best, what = groups()[name]
    rows = [row for row in rows if not options.rows or str(row[1]) in options.rows]
    common = {**common, **dict(text.split("=", 1) for text in options.set)}
    with tempfile.TemporaryDirectory() as directory:
        runs = Runs(options, scene, common, directory)
        reference = runs.measure(best)
        results, each = [], []
        for curve, label, settings in rows:
            openings, tensions, summary = runs.measure(settings)
            each.append(openings)
            results.append((curve, str(label), summary["seconds"]["shaking_cpu"] / runs.duration,
                            error(openings, reference[0]), error(tensions, reference[1]),
                            summary["newton_iterations"]["mean"],
                            summary["energy_balance_error"]))
    print(f"\n### {name}: against {what}\n\n| choice | | s per s | openings | tension | Newton steps | energy account |\n|"
          + "---|" * 7)
    for curve, label, cost, o, t, newton, balance in results:
        print(f"| {curve} | {label} | {cost:.2f} | {100 * o:.2g} % | {100 * t:.2g} % | {newton:.2f} | {balance:.0e} |")
    if name.startswith("box"):
        print("\nLargest openings [mm]; the last row is the reference\n")
        for label, openings in [(label, o) for (_, label, _), o in zip(rows, each)] + [("", reference[0])]:
            print(f"| {label} | " + " | ".join(f"{1e3 * x:.3f}" for x in openings) + " |")
    if name in CHARTS:
        draw(name, what, results)


def draw(name, what, results):
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for mark, curve in zip("os^vDP", dict.fromkeys(r[0] for r in results)):
        rows = [r for r in results if r[0] == curve]
        axes.plot([r[2] for r in rows], [100 * max(r[3:5]) for r in rows], mark + "-", label=curve)
        for i, r in enumerate(rows):  # above and below in turn, for neighbours
            axes.annotate(r[1], (r[2], 100 * max(r[3:5])), textcoords="offset points", xytext=(5, (4, -11)[i % 2]), fontsize=7.5)
    axes.set(xscale="log", yscale="log", xlabel="cost: seconds of one thread per second of earthquake",
             ylabel="error of openings or zone tension, the larger [%]", title=f"{name}: against {what}")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_locator(LogLocator(subs=range(2, 10)))
        axis.set_minor_formatter(lambda x, _: f"{x:g}" if round(x / 10 ** floor(log10(x))) in (2, 5) else "")
    axes.title.set_fontsize(9.5)
    axes.grid(True, which="both", linewidth=0.4, color="0.88")
    axes.legend(frameon=False, fontsize=9)
    figure.savefig(ROOT / "doc" / "figures" / f"choices_{name}.png", dpi=110, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("groups", nargs="*", choices=list(groups()) + [[]])
    parser.add_argument("--rows", nargs="+", metavar="LABEL", help="only these, such as \"all 420 m\"")
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--seed", type=int, help="of the motion, instead of the scene's")
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="for all runs")
    options = parser.parse_args()
    for group in options.groups or groups():
        study(group, options)


if __name__ == "__main__":
    main()
