#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often the error bars of `voussoir accuracy` contain the truth, on dams and motions that no estimate was tuned on.

    benchmarks/coverage.py [--voussoir PROGRAM] [--jobs 1] [--first 100] [--cases 8] [--output DIRECTORY]

A number, the seed of a case, gives the dam (a table of arcs), its joints, mesh, materials and motion. The rule of the bars was set with
seven cases below 10, on coarser meshes. The default seeds, from 100 on, had no part in it. The truth has three times as many elements each
way and four times as many time steps. Every third case is a mesh from a file, whose geometry is taken as given: its truth has elements of
degree 2, each divided into eight, and four times as many time steps.

Prints for each case and quantity the true value, the bar and whether it contains the truth; then the share of bars that contain it, and
medians over the cases: half the width of a bar over the true error, and the errors of the value and of the combined value. Runs that are in
DIRECTORY already are not repeated.
"""

import argparse
import json
import os
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy import signal

from program import ROOT, add_program_argument, run
from voussoir.error_bars import HEADLINES, headlines
from voussoir.results import Results

FINER = 3  # times as many elements each way has the truth
STEPS = 4  # times as many time steps
SECONDS = 2.5  # of motion
HEAD = "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"


def noise(n, dt, seed, lowest, highest, peak_time):
    """Noise between two frequencies [Hz], swelling to its peak and decaying; largest value 1."""
    white = np.random.default_rng(seed).standard_normal(n)
    band = signal.butter(3, [lowest, min(highest, .45 / dt)], "band", fs=1 / dt, output="sos")
    t = np.arange(n) * dt / peak_time
    a = signal.sosfilt(band, white) * t**2 * np.exp(2 * (1 - t))
    return a / np.abs(a).max()


def table_of(draw):
    """Table of arcs (circles of constant thickness) of a seeded dam, and its height [m]."""
    height = draw.uniform(50., 200.)
    crest, base = draw.uniform(.025, .05), draw.uniform(.12, .25)  # thickness over height
    radius, overhang = draw.uniform(.7, 1.3) * height, draw.uniform(0., .12) * height
    angles, power = (draw.uniform(42., 56., 2), draw.uniform(10., 22., 2)), draw.uniform(.8, 1.1)
    rows = []
    for share in np.linspace(0., 1., 5):
        thickness = height * (base + (crest - base) * share ** power)
        outer = radius * (.55 + .45 * share)
        right, left = angles[1] + (angles[0] - angles[1]) * share ** .8
        rows.append((height * share, -4. * overhang * share * (1. - share), outer, thickness, outer - thickness, right, left))
    return HEAD + "".join(",".join(f"{value:.6g}" for value in row) + "\n" for row in rows), height


def scene_of(seed, directory):
    """Writes the table, the motion and the scene of a seed; returns its settings, and the elements along a monolith, up and through."""
    draw = np.random.default_rng(seed)
    text, height = table_of(draw)
    (directory / "arcs.csv").write_text(text)
    joints = int(draw.integers(2, 11))
    elements = [(joints + 1) * int(draw.integers(2, 5 if joints < 6 else 3)), int(draw.integers(6, 10)), 2]
    law = draw.choice(["FJA", "FJA", "FJB", "KSM"])
    peak, period = draw.uniform(2., 6.), draw.uniform(.2, 1.)
    if seed % 2:
        parts = [peak * share * noise(round(100 * SECONDS), .01, 10 * seed + k, .5 / period, 12. / period, 1.) for k, share in enumerate((1., .8, .6))]
        np.savetxt(directory / "motion.csv", np.column_stack([np.arange(len(parts[0])) * .01, *parts]), delimiter=",", fmt="%.8g")
        motion = {"Motion/Source": "file", "Motion/File": "motion.csv", "Motion/Unit": "m/s^2"}
    else:
        motion = {"Motion/Source": "artificial", "Motion/Seed": seed, "Motion/Duration": 10.24, "Motion/Factor": round(peak / 4., 3)}
    settings = {"Concrete/Young's modulus": f"{draw.uniform(20., 36.):.4g} GPa", "Concrete/Density": f"{draw.uniform(2300., 2500.):.5g} kg/m3",
                "Reservoir/Water level": f"{draw.uniform(.75, .97) * height:.5g}", "Joints/Model": law, "Joints/Friction": f"{draw.uniform(.4, 1.):.3g}",
                "Damping/Ratio": f"{draw.uniform(.03, .07):.3g}", "Dynamics/Steps per sample": int(draw.integers(1, 3)), **motion,
                "Output/Figures": "false", "Output/Envelope interval": 1}
    return settings, elements, joints


def mesh_of(elements, joints):
    counts = {f"Mesh/Arcs/Elements {name}": count for name, count in zip(("along", "up", "through"), elements)}
    return {"Mesh/Source": "arcs", "Mesh/Arcs/Table": "arcs.csv", "Mesh/Arcs/Joints": joints, **counts}


def write_scene(settings, file):
    sections = {}
    for entry, value in settings.items():
        *path, name = entry.split("/")
        sections.setdefault(tuple(path), []).append(f"  set {name} = {value}\n")
    file.write_text("".join("".join(f"subsection {part}\n" for part in path) + "".join(lines) + "end\n" * len(path)
                            for path, lines in sections.items()))


def case(program, directory, seed):
    """Error bars of the case, the true values, and the seconds of the runs. Every third mesh is read from a file."""
    began, directory = time.monotonic(), directory / f"case{seed}"
    directory.mkdir(exist_ok=True)
    settings, elements, joints = scene_of(seed, directory)
    foreign, scene, accuracy, truth = seed % 3 == 0, directory / "scene.prm", directory / "accuracy", directory / "truth"
    mesh, fine = mesh_of(elements, joints), mesh_of([FINER * count for count in elements], joints)
    if foreign:
        write_scene({**settings, **mesh}, directory / "arcs.prm")
        run(program, "mesh", directory / "arcs.prm", "--output", directory / "dam.msh")
        mesh = {"Mesh/Source": "file", "Mesh/File": "dam.msh"}
        fine = {"Elements/Degree": 2, "Mesh/Subdivide": "true"}
    write_scene({**settings, **mesh}, scene)
    if not (accuracy / "accuracy.json").exists():
        run(program, "accuracy", scene, "--output", accuracy, "--seconds", SECONDS, "--for", "1000%")
    if not (truth / "summary.json").exists():
        steps = {"Dynamics/Steps per sample": STEPS * settings["Dynamics/Steps per sample"]}
        motion = {"Motion/Source": "file", "Motion/File": accuracy / "motion.csv", "Motion/Unit": "m/s^2", "Motion/Duration": -1, "Motion/Factor": 1}
        run(program, scene, "--output", truth, "--overwrite", settings={**fine, **steps, **motion})
    about = f"{seed}: {'file' if foreign else 'arcs'}, {joints} joints, {' x '.join(map(str, elements))}, {settings['Joints/Model']}"
    bars, exact = json.loads((accuracy / "accuracy.json").read_text())["error_bars"], Results(truth)
    return about, bars, headlines(exact.summary, exact.history), time.monotonic() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time, of one thread each")
    parser.add_argument("--first", type=int, default=100, help="seed of the first case")
    parser.add_argument("--cases", type=int, default=8, help="number of cases")
    parser.add_argument("--output", type=Path, help="directory of the runs, kept")
    options = parser.parse_args()
    os.environ["VOUSSOIR_SCRIPTS"] = str(ROOT / "scripts")
    seeds = range(options.first, options.first + options.cases)
    found = {name: [] for name in HEADLINES}
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(options.jobs) as pool:
        directory = (options.output or Path(temporary)).resolve()
        directory.mkdir(parents=True, exist_ok=True)
        for done, (about, bars, truth, seconds) in enumerate(pool.map(lambda seed: case(options.voussoir, directory, seed), seeds), 1):
            print(f"{about}; {done} of {len(seeds)}, {seconds:.0f} s", flush=True)
            for name, bar in bars.items():
                exact = truth.get(name, 0.)
                error, inside, half = bar["value"] - exact, bar["low"] <= exact <= bar["high"], (bar["high"] - bar["low"]) / 2
                found[name].append((inside, half / max(abs(error), 1e-300), abs(error) / abs(exact), abs(bar["combined"] - exact) / abs(exact)))
                print(f"    {name:40s} {bar['value']:11.4g}, truth {exact:11.4g}, bar {bar['low']:11.4g} to {bar['high']:11.4g}"
                      f"{'' if inside else '  OUTSIDE'}, half of it over the true error {half / max(abs(error), 1e-300):.2f}", flush=True)
    print("\n| Quantity | Truth inside | Half of the bar over the true error | Error of the value | Error of the combined value |\n|---|---|---|---|---|")
    for title, rows in [*((HEADLINES[name][0], rows) for name, rows in found.items() if rows), ("all", sum(found.values(), []))]:
        inside, *columns = zip(*rows)
        ratio, error, combined = (np.median(column) for column in columns)
        print(f"| {title} | {sum(inside)} of {len(rows)} | {ratio:.2g} | {100 * error:.2g} % | {100 * combined:.2g} % |")


if __name__ == "__main__":
    main()
