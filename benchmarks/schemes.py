#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against cost of both time schemes over meshes and time steps: doc/figures/schemes.png.

    benchmarks/schemes.py [SCENE...] [--sizes 0.67,1] [--steps 1,2,4] [--reference 2,1.5] [--output output/schemes] [--figure FILE]
    benchmarks/schemes.py --before OTHER/voussoir --scenes-before OTHER/prm [--repeat 3]

SCENE: of prm/ (default: quickstart rigid28), with uniform damping, because the explicit scheme has no Rayleigh damping. Sizes multiply the numbers
of elements in the three directions; steps are `Dynamics/Steps per sample` of the trapezoidal rule. The explicit scheme has its own step, and
records twice per sample.
Error of the openings: largest openings of all joints, 2-norm of the differences from the reference over its 2-norm. Error of the tension: the
larger one of the largest tensions of both faces, without the singular foot. Reference of each scene: explicit scheme, `--reference` times the elements.
Cost: CPU seconds of the shaking on one thread per second of the earthquake. Prints a Markdown table. Finished runs are not repeated.

--before: cost of this program over that of another version with its own scenes and settings, in turn; the cost of a second is the
difference of runs of 2.56 and 0.64 s, so that set-up does not count."""

import argparse
import csv
import math
import re
from pathlib import Path
from statistics import median

import matplotlib

from program import ROOT, add_program_argument, simulate

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from voussoir.palette import COLOURS  # noqa: E402
from voussoir.results import read_summary  # noqa: E402

COMMON = {"Damping/Model": "uniform", "Damping/Reference frequency": 2, "Output/Checkpoint interval": 0}
EXPLICIT = {"Dynamics/Scheme": "explicit", "Dynamics/Steps per sample": 1}
LIFTS = {"Mesh/Arch210/Lift joints": 3, "Mesh/Arch210/Base joint": "true"}
COMPARED = (("quickstart", {}, EXPLICIT), ("rigid28", {}, EXPLICIT), ("rigid28", {"Joints/Model": "KSM"}, EXPLICIT), ("rigid28", LIFTS, EXPLICIT),
            ("rock28", {}, EXPLICIT), ("quickstart", {}, {}), ("rigid28", {}, {}))  # scene, settings of both programs, and of this one
FACES = ("max_tension_upstream_above_foot", "max_tension_downstream_above_foot")


def elements(scene, size):
    """Entries of a mesh with `size` times the elements of the scene in each direction."""
    text = (ROOT / "prm" / f"{scene}.prm").read_text(encoding="utf-8")
    return {f"Mesh/Arch210/Elements {name}": max(1, round(size * int(number)))
            for name, number in re.findall(r"set Elements (\w+) *= (\d+)", text)}


def result(scene, size, steps, options):
    """Openings of all joints [m], tensions of both faces [Pa], CPU seconds per second. Zero steps: the explicit scheme."""
    directory = options.output / f"{scene}-{size:g}-{steps or 'explicit'}"
    scheme = {"Dynamics/Scheme": "trapezoidal" if steps else "explicit", "Dynamics/Steps per sample": steps or 2}
    if not (directory / "summary.json").exists():
        simulate(options.voussoir, ROOT / "prm" / f"{scene}.prm", {**COMMON, **scheme, **elements(scene, size)}, directory)
    summary = read_summary(directory)
    with open(directory / "joints.csv", encoding="utf-8", newline="") as file:
        openings = [max(float(row[f"opening_{face}"]) for face in ("upstream", "downstream")) for row in csv.DictReader(file)]
    seconds = summary["seconds"]["shaking_cpu"] / (summary["steps"] * summary["time_step"])
    return openings, [summary["extremes"][face]["value"] for face in FACES], seconds


def points(scene, reference, options):
    """Rows: size, steps, cost, error of the openings [%], error of the tension [%]."""
    exact, tension, _ = result(scene, reference, 0, options)
    for size in options.sizes:
        for steps in (0, *options.steps):
            found, stress, seconds = result(scene, size, steps, options)
            yield (size, steps, seconds, 100 * math.dist(found, exact) / math.hypot(*exact),
                   100 * max(abs(a / b - 1) for a, b in zip(stress, tension)))


def seconds_of(program, scene, settings):
    """CPU seconds per second of the earthquake."""
    long, short = (simulate(program, scene, {**settings, "Motion/Duration": duration, "Output/Checkpoint interval": 0})["seconds"]["cpu"]
                   for duration in (2.56, .64))
    return (long - short) / 1.92


def compare(options):
    print("| scene | scheme | CPU s per s: before | now | ratio | range |\n|---|---|---|---|---|---|")
    for scene, common, more in COMPARED:
        pairs = [(seconds_of(options.before, options.scenes_before / f"{scene}.prm", common),
                  seconds_of(options.voussoir, ROOT / "prm" / f"{scene}.prm", {**common, **more})) for _ in range(options.repeat)]
        before, now, ratios = *map(median, zip(*pairs)), [b / a for a, b in pairs]
        print(f"| {scene} {' '.join(str(value) for value in common.values())} | {'explicit' if more else 'trapezoidal'} | {before:.2f} | {now:.2f} | "
              f"{median(ratios):.2f} | {min(ratios):.2f} to {max(ratios):.2f} |", flush=True)


def draw(panel, scene, rows, sizes):
    for size, colour in zip(sizes, COLOURS):
        implicit = [row for row in rows if row[0] == size and row[1]]
        panel.loglog([row[2] for row in implicit], [row[3] for row in implicit], "o-", color=colour, label=f"trapezoidal, {size:g} times the elements")
        for row in implicit:
            panel.annotate(f"{10 / row[1]:g} ms", row[2:4], xytext=(6, 4), textcoords="offset points", fontsize=8)
        explicit = next(row for row in rows if row[0] == size and not row[1])
        panel.loglog(explicit[2], explicit[3], "*", color=colour, markersize=14, label=f"explicit, {size:g} times the elements")
    panel.set(title=scene, xlabel="CPU seconds per second of the earthquake", ylabel="error of the largest openings [%]",
              ylim=(None, 2.2 * max(row[3] for row in rows)), xlim=(None, 1.5 * max(row[2] for row in rows)))
    for axis in (panel.xaxis, panel.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(lambda x, _: f"{x:g}" if f"{x:e}"[0] in "235" else "")
    panel.grid(True, which="both", alpha=.3)
    panel.legend(fontsize=8, loc="upper right")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scenes", nargs="*", default=["quickstart", "rigid28"])
    numbers = lambda kind: lambda text: [kind(word) for word in text.split(",")]  # noqa: E731
    parser.add_argument("--sizes", type=numbers(float), default=[.67, 1])
    parser.add_argument("--steps", type=numbers(int), default=[1, 2, 4])
    parser.add_argument("--reference", type=numbers(float), default=[2, 1.5])
    parser.add_argument("--output", type=Path, default=Path("output/schemes"))
    parser.add_argument("--figure", type=Path)
    parser.add_argument("--before", help="another program to compare with")
    parser.add_argument("--scenes-before", type=Path, help="its input files")
    parser.add_argument("--repeat", type=int, default=3)
    add_program_argument(parser)
    options = parser.parse_args()
    if options.before:
        return compare(options)
    figure, panels = plt.subplots(1, len(options.scenes), figsize=(6 * len(options.scenes), 4.6), squeeze=False)
    print("| Scene | elements | scheme | CPU s per s | openings % | tension % |\n|---|---|---|---|---|---|")
    for panel, scene, reference in zip(panels[0], options.scenes, options.reference):
        rows = []
        for row in points(scene, reference, options):
            size, steps, seconds, opening, tension = row
            rows.append(row)
            print(f"| {scene} | {size:g} | {f'trapezoidal, {10 / steps:g} ms' if steps else 'explicit'} | {seconds:.2f} | {opening:.1f} | {tension:.1f} |",
                  flush=True)
        draw(panel, scene, rows, options.sizes)
    figure.tight_layout()
    figure.savefig(options.figure or options.output / "schemes.png", dpi=110)
    return None


if __name__ == "__main__":
    main()
