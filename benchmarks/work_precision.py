#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy against cost of prm/coarse.prm: time steps on one mesh, then elements and meshes at one time step.

    benchmarks/work_precision.py [--duration 6] [--law FJA] [--voussoir PROGRAM]

All runs shake the dam with the same motion, sampled at 0.01 s and interpolated linearly. Errors are differences from
the finest run of each study; seconds are CPU seconds of one thread, with set-up, static state and stresses.
Writes doc/work_precision.png and prints Markdown tables.
"""

import argparse
import csv
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

from program import ROOT, add_program_argument, run, simulate

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SCENE = ROOT / "prm" / "coarse.prm"
TIME_STEPS = [0.01, 0.005, 0.0025, 0.00125, 0.000625]  # the last is the reference
# Elements along, up, through; the last is the reference.
MESHES = [("trilinear, modes", 1, [(30, 8, 1), (30, 8, 2), (60, 16, 2), (60, 16, 4), (96, 32, 4)]),
          ("trilinear, plain", 1, [(30, 8, 2), (60, 16, 2), (60, 16, 4), (96, 32, 4)]),
          ("triquadratic", 2, [(12, 4, 1), (18, 6, 1), (30, 8, 1), (30, 8, 2), (48, 16, 2)])]
MARKS = {"time step": "o", "trilinear, modes": "s", "trilinear, plain": "x", "triquadratic": "^"}


def measure(options, motion, settings):
    with tempfile.TemporaryDirectory() as directory:
        summary = simulate(options.voussoir, SCENE, output=directory, settings={
            "Motion/Source": "file", "Motion/File": motion, "Motion/Duration": options.duration,
            "Joints/Model": options.law, **settings})
        history = np.genfromtxt(Path(directory) / "history.csv", delimiter=",", names=True)
        with open(Path(directory) / "joints.csv") as file:
            openings = [max(float(row["opening_upstream"]), float(row["opening_downstream"]))
                        for row in csv.DictReader(file)]
    times = np.arange(0, options.duration + 0.005, 0.01)
    print(".", end="", file=sys.stderr, flush=True)
    return {"crest": np.stack([np.interp(times, history["time"], history[f"crest_{c}"]) for c in "xyz"]),
            "openings": 1e3 * np.array(openings),
            "tension": summary["extremes"]["max_tension_downstream"]["value"] / 1e6,
            "compression": summary["extremes"]["max_compression"]["value"] / 1e6,
            "newton": summary["newton_iterations"]["mean"], "dofs": int(summary["mesh"]["dofs"]),
            "seconds": summary["seconds"]["cpu"]}


def errors(run, reference):
    """Relative L2 error of the crest's history; mean error of the joints' largest opening [mm]."""
    motion = reference["crest"] - reference["crest"][:, :1]
    return (np.linalg.norm(run["crest"] - reference["crest"]) / np.linalg.norm(motion),
            np.abs(run["openings"] - reference["openings"]).mean())


def row(name, run, reference):
    crest, opening = errors(run, reference)
    return (f"| {name} | {run['dofs']:,} | {1e3 * np.abs(run['crest'][0] - run['crest'][0, 0]).max():.1f} | "
            f"{' '.join(f'{o:.1f}' for o in run['openings'])} | {run['tension']:.2f} | {run['compression']:.2f} | "
            f"{crest:.1%} | {opening:.2f} | {run['newton']:.2f} | {run['seconds']:.1f} |")


HEAD = ("| run | unknowns | crest move [mm] | largest openings [mm] | tension downstream [MPa] | compression [MPa] | "
        "error of crest history | error of openings [mm] | Newton | CPU s |\n" + "|---" * 10 + "|")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--duration", type=float, default=6., help="of the shaking [s]")
    parser.add_argument("--law", default="FJA", choices=["tied", "FJA", "FJB"], help="of the joints")
    parser.add_argument("--figure", type=Path, default=ROOT / "doc" / "work_precision.png")
    options = parser.parse_args()

    curves = {}
    with tempfile.TemporaryDirectory() as temporary:
        motion = Path(temporary) / "motion.csv"
        run(options.voussoir, "motion", SCENE, "--output", motion)

        print(f"### Time step, trilinear with modes, 60 x 16 x 2, {options.law}\n\n{HEAD}")
        runs = [measure(options, motion, {"Motion/Time step": dt}) for dt in TIME_STEPS]
        for dt, result in zip(TIME_STEPS, runs):
            print(row(f"{1e3 * dt:g} ms", result, runs[-1]))
        curves["time step"] = [(r["seconds"], *errors(r, runs[-1])) for r in runs[:-1]]

        print(f"\n### Elements at a time step of 10 ms, {options.law}\n\n{HEAD}")
        results = {}
        for name, degree, meshes in MESHES:
            for along, up, through in meshes:
                results[name, along, up, through] = measure(options, motion, {
                    "Elements/Degree": degree, "Elements/Incompatible modes": str("plain" not in name).lower(),
                    "Mesh/Arch210/Elements along": along, "Mesh/Arch210/Elements up": up,
                    "Mesh/Arch210/Elements through": through})
        reference = list(results.values())[-1]
        for (name, *mesh), result in results.items():
            print(row(f"{name} {' x '.join(map(str, mesh))}", result, reference))
            if result is not reference:
                curves.setdefault(name, []).append((result["seconds"], *errors(result, reference)))

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    labels = ("relative error of the crest's history", "error of largest openings [mm]")
    for axis, column, label in zip(axes, (1, 2), labels):
        for name, points in curves.items():
            points = np.array(sorted(points))
            axis.loglog(points[:, 0], points[:, column], MARKS[name] + "-", label=name)
        axis.set_xlabel(f"CPU seconds for {options.duration:g} s of shaking")
        axis.set_ylabel(label)
        axis.grid(True, which="both", alpha=0.3)
    axes[0].legend()
    figure.suptitle(f"coarse.prm, 5 joints, {options.law}: differences from the finest run of each study")
    figure.tight_layout()
    options.figure.parent.mkdir(exist_ok=True)
    figure.savefig(options.figure, dpi=130)
    return 0


if __name__ == "__main__":
    sys.exit(main())
