#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What other programs cost at which error, by their time steps, on the same mesh as Voussoir.

    OPENBLAS_NUM_THREADS=1 benchmarks/peer_cost.py [calculix] [node-to-node] [--data DIRECTORY] [--voussoir PROGRAM]
                                                   [--ccx PROGRAM]

calculix: the tied arch210 on 30 x 8 x 1 elements (benchmarks/calculix_arch210.prm), 2 s of shaking; the error is that of the
crest's displacement in the root of the mean square over time, against the program's own run at 1.25 ms ("of the step") and
against Voussoir on 90 x 24 x 3 elements at 1.25 ms ("in all").
node-to-node: the jointed arch of peers.py (--data), 2 s, FJA, lumped mass and mean forces; the error is that of the
joints' largest openings at the crest (root of the sum of squares), against such a limit of the same program.
Costs are CPU seconds of one thread per second of motion, set-up included. Prints Markdown tables.
"""

import argparse
import os
import resource
import shutil
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import calculix
import node_to_node
from peers import COLUMNS, SCENE as JOINTED, write_motion
from program import ROOT, add_program_argument, run, simulate
from choices import error, mesh
from voussoir.tables import read_table

TIED = ROOT / "benchmarks" / "calculix_arch210.prm"
COARSE, FINE = mesh(30, 8, 1), mesh(60, 16, 2)
STEPS = [1, 2, 4]  # per 10 ms
SECONDS = 2.
TIMES = np.arange(0, SECONDS + .005, .01)


def cpu_of_children():
    use = resource.getrusage(resource.RUSAGE_CHILDREN)
    return use.ru_utime + use.ru_stime


def sampled(history):
    """Columns t, x, y, z at all TIMES, less the first row."""
    return np.concatenate([np.interp(TIMES, history[:, 0], history[:, k] - history[0, k]) for k in (1, 2, 3)])


def shake(options, settings):
    """Voussoir's crest, its CPU seconds and its summary."""
    with tempfile.TemporaryDirectory() as directory:
        summary = simulate(options.voussoir, TIED, settings, directory)
        table = np.genfromtxt(Path(directory) / "history.csv", delimiter=",", names=True)
    return sampled(np.stack([table[c] for c in ("time", "crest_x", "crest_y", "crest_z")], axis=1)), summary["seconds"]["cpu"], summary


def print_rows(rows, fine=None):
    """rows: program, step [ms], cost [s], value."""
    for name in dict.fromkeys(r[0] for r in rows):
        own = [r for r in rows if r[0] == name]
        limit = own[-1][3] + (own[-1][3] - own[-2][3]) / 3
        for _, step, cost, value in own:
            errors = [error(value, limit)] + ([] if fine is None else [error(value, fine)])
            print(f"| {name} | {step:g} ms | {cost / SECONDS:.2f} | " + " | ".join(f"{100 * e:.2g} %" for e in errors) + " |", flush=True)


def with_calculix(options, directory):
    if shutil.which(options.ccx) is None:
        print(f"SKIPPED: {options.ccx} not found (Debian package calculix-ccx)")
        return
    os.environ["OMP_NUM_THREADS"] = "1"
    rows = []
    for n in STEPS:
        value, cost, summary = shake(options, {**COARSE, "Dynamics/Steps per sample": n})
        rows.append(("Voussoir", 10 / n, cost, value))
    fine, _, _ = shake(options, {**FINE, "Dynamics/Steps per sample": STEPS[-1]})
    run(options.voussoir, "mesh", TIED, "--output", directory / "dam.msh", settings=COARSE)
    run(options.voussoir, "motion", TIED, "--output", directory / "motion.csv", settings=COARSE)
    run(options.voussoir, TIED, "--output", directory / "scene", settings=COARSE)
    dam = calculix.read_mesh(directory / "dam.msh")
    probe = np.argmin(np.linalg.norm(dam.nodes - summary["static"]["crest_point"], axis=1))
    motion = calculix.read_motion(directory / "motion.csv")
    for mass in ("lumped", "consistent"):
        for n in STEPS:
            o = argparse.Namespace(ccx=options.ccx, element="C3D8I", mass=mass)
            calculix.take_from_scene(o, directory / "scene" / "scene.prm")
            o.dt, o.steps = .01 / n, round(SECONDS * n / .01)
            before = cpu_of_children()
            history = calculix.CalculiX(dam, probe, o, directory).history(motion)
            history = np.vstack([np.zeros(4), history])
            rows.append((f"CalculiX, C3D8I, {mass} mass", 10 / n, cpu_of_children() - before, sampled(history)))
    print("\n| program | step | CPU s per s | of the step | in all |\n" + "|---" * 5 + "|")
    print_rows(rows, fine)


def with_node_to_node(options, directory):
    data = options.data.resolve()
    if not (data / "motion.txt").exists():
        print(f"SKIPPED: no reference data in {options.data} (option --data)")
        return
    write_motion(data / "motion.txt", directory / "motion.txt")
    rows = []
    for n in STEPS:
        settings = {"Mesh/File": data / "s1k.v41.msh", "Motion/File": directory / "motion.txt", "Motion/Time step": .01 / n}
        summary = simulate(options.voussoir, JOINTED, settings, directory / "run")
        joints = read_table(directory / "run" / "joints.csv")
        value = np.array([joints[column] for column, _ in COLUMNS[:2]])
        rows.append(("Voussoir", 10 / n, summary["seconds"]["cpu"], value))
    for n in STEPS:
        before = time.process_time()
        _, openings, _ = node_to_node.simulate(data, "fja", .01 / n, "lumped", "mean-force")
        rows.append(("node_to_node.py", 10 / n, time.process_time() - before, openings / 1e3))
    print("\n| program | step | CPU s per s | openings |\n" + "|---" * 4 + "|")
    print_rows(rows)


PARTS = {"calculix": with_calculix, "node-to-node": with_node_to_node}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []])
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/reference/data/peers", help="reference data")
    parser.add_argument("--ccx", default="ccx", help="the CalculiX program")
    options = parser.parse_args()
    for part in options.parts or PARTS:
        with tempfile.TemporaryDirectory() as directory:
            PARTS[part](options, Path(directory))
    return 0


if __name__ == "__main__":
    sys.exit(main())
