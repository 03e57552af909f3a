#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How good is Dynamics/Error estimate on dams and motions that are in no scene of prm/? Three dams from tables of arcs (a thin
one of 110 m with 9 joints, an unsymmetrical one of 60 m with one, one of 270 m with 40), five invented motions, laws and steps; the
truth is the same run with eight steps per sample.

    benchmarks/held_back.py [--voussoir PROGRAM] [--jobs 2] [--output DIRECTORY] [--ladder]

Prints a line for each case (estimate over true error of the openings, the largest opening, and the tension on both faces), and
how many are within a factor of 2. Runs that are in DIRECTORY already are not repeated.

With --ladder: the same question for `voussoir accuracy`, which refines the mesh, too. Two of the dams, with the meshes that they
have and others; the truth has three times as many elements each way and four times as many steps.
"""

import argparse
import csv
import json
import math
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy import signal

from program import add_program_argument, run
from voussoir.zone_tension import zone_means

G = 9.80665  # m/s^2
HEAD = "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"
# the table of arcs; joints, elements along and up; level of the water
DAMS = {
    "thin": ("1180,0,92,11.5,80.5,16,21\n1200,0,92,10.2,81.8,27,33\n1230,0,92,8.0,84.0,38,46\n"
             "1260,0,92,5.5,86.5,46,55\n1290,0,92,3.2,88.8,52,62\n", 9, 40, 6, 1280),
    "small": ("72,0,48,2.4,45.6,33,62\n57,-1.6,45,4.1,40.5,30,57\n42,-2.4,41,5.6,34.8,25,48\n27,-2.0,37,6.8,29.4,19,35\n"
              "12,-0.4,33,7.7,24.5,8,14\n", 1, 16, 6, 68),
    "high": ("600,-6,120,52,70,20,18\n660,-38,165,50,112,33,30\n720,-52,205,44,155,42,38\n780,-48,245,34,203,48,43\n"
             "840,-22,280,20,256,51,46\n870,0,300,11,287,52,47\n", 40, 82, 10, 862)}
TRUTH = 8  # steps per sample
NUMBERS = ("openings", "largest_opening", "tension_upstream", "tension_downstream")


def noise(n, dt, seed, lowest, highest, peak_time):
    """Noise between two frequencies [Hz], swelling to its peak and decaying; largest value 1."""
    white = np.random.default_rng(seed).standard_normal(n)
    band = signal.butter(3, [lowest, min(highest, .45 / dt)], "band", fs=1 / dt, output="sos")
    t = np.arange(n) * dt / peak_time
    a = signal.sosfilt(band, white) * t**2 * np.exp(2 * (1 - t))
    return a / np.abs(a).max()


def velocity_pulse(t, period, at, speed):
    velocity = speed * np.exp(-((t - at) / (.7 * period))**2) * np.cos(2 * np.pi * (t - at) / period + .6)
    return np.gradient(velocity, t)


def motions():
    """name -> (dt, components [m/s^2], seconds)."""
    t = np.arange(1000) * .01
    near = [2. * noise(1000, .01, 30, .5, 18, 2.) + velocity_pulse(t, 1.1, 3., .7),
            2. * noise(1000, .01, 31, .5, 18, 2.) + velocity_pulse(t, .9, 3.3, .35), 1.5 * noise(1000, .01, 32, .5, 18, 2.)]
    w = (4. * np.pi * (np.arange(300) * .005 - .4))**2
    ricker = (1. - 2. * w) * np.exp(-w)
    return {"far": (.005, [p * G * noise(2400, .005, 11 + k, .3, 20, 3.) for k, p in enumerate((.45, .38, .3))], 8),
            "coarse": (.02, [p * noise(600, .02, 20 + k, .4, 15, 2.5) for k, p in enumerate((3.8, 4.2, 2.5))], 6),
            "near": (.01, near, 6),
            "ricker": (.005, [6. * ricker, 2. * np.roll(ricker, 10), 0. * ricker], 1.49),
            "tiny": (.01, [.01 * noise(400, .01, 40 + k, .2, 15, 2.) for k in range(3)], 2)}


def cases():
    """name of the case, dam, motion, settings, steps per sample."""
    for dam in ("small", "thin"):
        for motion in ("far", "coarse", "near", "ricker", "tiny"):
            for steps in (1, 2):
                yield f"{dam}, {motion}, {steps}", dam, motion, {}, steps
    for law in ("FJB", "KSM", "cohesive"):
        bond = {"Joints/Strength": 1.5e6, "Joints/Fracture energy": 200} if law == "cohesive" else {}
        yield f"thin, near, 1, {law}", "thin", "near", {"Joints/Model": law, **bond}, 1
    yield "thin, far, at 20 ms", "thin", "far", {"Motion/Time step": .02}, 1
    yield "small, coarse, at 20 ms", "small", "coarse", {"Motion/Time step": .02}, 1
    yield "high, near, 1", "high", "near", {"Motion/Duration": 4.5}, 1
    yield "high, ricker, 1", "high", "ricker", {}, 1


def write_mesh(program, directory, dam, name, elements):
    counts = {f"Mesh/Arcs/Elements {way}": count for way, count in zip(("along", "up", "through"), elements)}
    run(program, "mesh", directory / f"{dam}.prm", "--output", directory / f"{name}.msh",
        settings={"Mesh/Source": "arcs", "Mesh/Arcs/Table": f"{dam}.csv", "Mesh/Arcs/Joints": DAMS[dam][1], "Mesh/Arcs/Smallest height": .5,
                  "Motion/Source": "none", **counts})


def write_scene(program, directory, dam):
    table, _, along, up, level = DAMS[dam]
    (directory / f"{dam}.csv").write_text(HEAD + table)
    entries = {"Mesh": {"Source": "file", "File": f"{dam}.msh"}, "Concrete": {"Young's modulus": "27 GPa", "Density": "2400 kg/m3"},
               "Reservoir": {"Water level": level}, "Joints": {"Friction": .75},
               "Motion": {"Source": "file", "Unit": "m/s^2"}, "Output": {"Figures": "false"}}
    (directory / f"{dam}.prm").write_text("".join(
        f"subsection {section}\n" + "".join(f"  set {entry} = {value}\n" for entry, value in values.items()) + "end\n"
        for section, values in entries.items()))
    write_mesh(program, directory, dam, dam, (along, up, 2))


def result(program, directory, dam, settings):
    """summary.json and the largest openings of the joints at both edges of the crest [m]."""
    if not (directory / "summary.json").exists():
        run(program, directory.parent / f"{dam}.prm", "--output", directory, "--overwrite", settings=settings)
    with open(directory / "joints.csv", encoding="utf-8") as file:
        openings = [float(row[f"opening_{face}"]) for row in csv.DictReader(file) for face in ("upstream", "downstream")]
    return json.loads((directory / "summary.json").read_text()), np.array(openings)


def ratios(program, directory, case):
    """Estimates over true errors, in the order of NUMBERS; the error of the openings and its estimate."""
    name, dam, motion, settings, steps = case
    settings = {"Motion/File": f"{motion}.csv", "Motion/Duration": motions()[motion][2], **settings}
    label = name.replace(", ", "_").replace(" ", "_")
    coarse, openings = result(program, directory / label, dam, {**settings, "Dynamics/Steps per sample": steps,
                                                                "Dynamics/Error estimate": "true"})
    fine, truth = result(program, directory / f"{label}_truth", dam, {**settings, "Dynamics/Steps per sample": TRUTH})
    off = [np.linalg.norm(openings - truth) / max(np.linalg.norm(truth), 1e-30)]
    for key in ("max_opening", "max_tension_upstream_away_from_base", "max_tension_downstream_away_from_base"):
        off.append(abs(coarse["extremes"][key]["value"] - fine["extremes"][key]["value"]))
    estimates = [coarse["error_estimate"][key] for key in NUMBERS]
    return [e / o if o > 0 else math.inf for e, o in zip(estimates, off)], off[0], estimates[0]


# dam; elements along, up and through; motion
LADDER = (("small", (16, 6, 2), "near"), ("small", (8, 4, 1), "far"), ("thin", (40, 6, 2), "far"), ("thin", (20, 10, 1), "near"))
FINER = 3  # times as many elements each way has the truth


def ladder(program, directory, case):
    """Errors of a scene as `voussoir accuracy` says them, and as they are: openings, tension."""
    dam, elements, motion = case
    name = "_".join(map(str, (dam, *elements, motion)))
    for mesh, factor in (("", 1), ("_fine", FINER)):
        write_mesh(program, directory, dam, f"{name}{mesh}", [factor * n for n in elements])
    settings = {"Mesh/File": directory / f"{name}.msh", "Motion/File": directory / f"{motion}.csv", "Motion/Unit": "m/s^2"}
    of_ladder = directory / f"{name}_ladder"
    if not (of_ladder / "accuracy.json").exists():
        run(program, "accuracy", directory / f"{dam}.prm", "--output", of_ladder, "--seconds", 5, settings=settings)
    said = json.loads((of_ladder / "accuracy.json").read_text())["error"]
    base = of_ladder / "runs" / "base"
    truth = directory / f"{name}_truth"
    _, exact = result(program, truth, dam, {"Mesh/File": directory / f"{name}_fine.msh", "Motion/File": of_ladder / "motion.csv",
                                            "Dynamics/Steps per sample": 4})
    _, openings = result(program, base, dam, {})
    (tension, _), (exact_tension, areas) = zone_means(base), zone_means(truth)
    off = (np.linalg.norm(openings - exact) / np.linalg.norm(exact),
           np.linalg.norm(np.sqrt(areas) * (tension - exact_tension)) / np.linalg.norm(np.sqrt(areas) * exact_tension))
    return off, (said["openings"], said["tension"])


def report_ladders(options, directory):
    print("| dam, elements, motion | openings off by | by `accuracy` | zone means of tension off by | by `accuracy` |\n|---|---|---|---|---|")
    good = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for case, (off, said) in zip(LADDER, pool.map(lambda c: ladder(options.voussoir, directory, c), LADDER)):
            good += [.5 <= s / o <= 2 for o, s in zip(off, said)]
            dam, elements, motion = case
            print(f"| {dam}, {' x '.join(map(str, elements))}, {motion} | " + " | ".join(
                f"{100 * o:.2g} % | {100 * s:.2g} %" for o, s in zip(off, said)) + " |", flush=True)
    print(f"within a factor of 2: {sum(good)} of {len(good)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, of one thread each")
    parser.add_argument("--output", type=Path, help="directory of the runs, kept")
    parser.add_argument("--ladder", action="store_true", help="of `voussoir accuracy`")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        directory = (options.output or Path(temporary)).resolve()
        directory.mkdir(parents=True, exist_ok=True)
        for name, (dt, components, _) in motions().items():
            t = np.arange(len(components[0])) * dt
            np.savetxt(directory / f"{name}.csv", np.column_stack([t, *components]), delimiter=",", fmt="%.8g")
        for dam in DAMS:
            write_scene(options.voussoir, directory, dam)
        if options.ladder:
            report_ladders(options, directory)
            return
        print("| dam, motion, steps per sample | openings off by | by estimate | estimate over true: openings | largest opening | "
              "tension upstream | downstream |\n|---|---|---|---|---|---|---|")
        found = []
        with ThreadPoolExecutor(options.jobs) as pool:
            listed = list(cases())
            for case, (ratio, off, estimate) in zip(listed, pool.map(lambda c: ratios(options.voussoir, directory, c), listed)):
                found.append(ratio)
                print(f"| {case[0]} | {100 * off:.3g} % | {100 * estimate:.3g} % | " + " | ".join(f"{r:.2f}" for r in ratio) + " |",
                      flush=True)
        for k, name in enumerate(NUMBERS):
            column = [ratio[k] for ratio in found]
            print(f"{name}: within a factor of 2 in {sum(.5 <= r <= 2 for r in column)} of {len(column)}, too small in "
                  f"{sum(r < .5 for r in column)}, too large in {sum(r > 2 for r in column)}")


if __name__ == "__main__":
    main()
