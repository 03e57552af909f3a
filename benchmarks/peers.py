#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The jointed arch of six monoliths against a node-to-node reference run that another program made.

    benchmarks/peers.py [--data DIRECTORY] [--voussoir PROGRAM]

The reference: plain trilinear elements, consistent mass, plain Newmark, 2 s of shaking at 0.01 s, FJA with friction 1
and FJB.  Voussoir's mass is lumped and its impacts do not ring, so that the openings differ much on this coarse mesh:
the reference is a plausibility check.  node_to_node.py bridges the gap: with a lumped mass and mean forces it must
repeat Voussoir, with a consistent mass and plain Newmark the reference's openings.
Exit status: 0 if it does so within 0.1 mm (every opening and slip) and 2 mm, the static crest agrees within 0.2 % and the
largest crest displacement within 15 %; 1 if not; 77 skipped (no reference data).
"""

import argparse
import csv
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

import node_to_node
from program import ROOT, add_program_argument, simulate

SCENE = ROOT / "benchmarks" / "peers.prm"
COLUMNS = [("opening_upstream", "max_open_us_mm"), ("opening_downstream", "max_open_ds_mm"),
           ("slip_upstream", "max_slip_us_mm"), ("slip_downstream", "max_slip_ds_mm")]
RUNS = [("mean-force", "s1k", {}), ("none", "s1k", {"Dynamics/Impact": "none"}),
        ("mean-force, dt 2.5 ms", "s1k", {"Motion/Time step": 0.0025}),
        ("incompatible modes", "s1k", {"Elements/Incompatible modes": "true"}),
        ("finer mesh, incompatible modes", "s5k", {"Elements/Incompatible modes": "true"}),
        ("finer mesh, triquadratic", "s5k", {"Elements/Degree": 2})]


def write_motion(source, target):
    """The reference's x is across the valley to the right bank and y downstream."""
    rows = [[float(word) for word in line.split()] for line in source.read_text().splitlines() if line[0] not in "#%"]
    target.write_text("".join(f"{t:.4f} {y:.9g} {-x:.9g} {z:.9g}\n" for t, x, y, z in rows))


def read_crest(path):
    """Time and downstream displacement [m] of the crown's crest, upstream, on one side of joint 3."""
    rows = [line.split() for line in path.read_text().splitlines() if line[0] != "#"]
    return [(float(row[0]), float(row[2])) for row in rows]


def largest_move(history, start):
    """Largest displacement upstream and downstream of the static state [mm]."""
    moves = [1e3 * (u - start) for _, u in history]
    return min(moves), max(moves)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/reference/data/peers", help="reference data")
    options = parser.parse_args()
    data = options.data.resolve()
    if not (data / "motion.txt").exists():
        print(f"SKIPPED: no reference data in {options.data} (option --data)")
        return 77

    good = True
    for law in ("fja", "fjb"):
        reference = json.loads((data / f"s1k_{law}_mu1.0_a0_n200.json").read_text())
        static = reference["grav+hydro"]["crown"]["US-"][1:]
        crest_file = data / f"s1k_{law}_mu1.0_a0_n200_crest.txt"
        rows = {"reference": [reference["dyn"][theirs] for _, theirs in COLUMNS]}
        crest = {"reference": (1e3 * static[0], 1e3 * static[1],
                               *(largest_move(read_crest(crest_file), static[0]) if crest_file.exists() else ()))}
        for name, mesh, entries in RUNS:
            with tempfile.TemporaryDirectory() as temporary:
                directory = Path(temporary)
                write_motion(data / "motion.txt", directory / "motion.txt")
                summary = simulate(options.voussoir, SCENE, output=directory / "run", settings={
                    "Mesh/File": data / f"{mesh}.v41.msh", "Motion/File": directory / "motion.txt",
                    "Joints/Model": law.upper(), **entries})
                with open(directory / "run" / "joints.csv") as file:
                    joints = list(csv.DictReader(file))
                with open(directory / "run" / "history.csv") as file:
                    history = [(float(row["time"]), float(row["crest_x"])) for row in csv.DictReader(file)]
            ours = summary["static"]["crest_displacement"]
            rows[name] = [[1e3 * float(joint[mine]) for joint in joints] for mine, _ in COLUMNS]
            crest[name] = (1e3 * ours[0], 1e3 * ours[2], *largest_move(history, ours[0]))
            if not name.startswith("mean-force"):
                continue
            good = good and abs(ours[0] / static[0] - 1) < 0.002
            if len(crest["reference"]) == 4:
                good = good and abs(max(map(abs, crest[name][2:])) / max(map(abs, crest["reference"][2:])) - 1) < 0.15

        for name, dt, mass, impact, limit in [("reference", 0.01, "consistent", "none", 2.),
                                              ("mean-force", 0.01, "lumped", "mean-force", 0.1),
                                              (RUNS[2][0], 0.0025, "lumped", "mean-force", 0.1)]:
            _, openings, slips = node_to_node.simulate(data, law, dt, mass, impact)
            small = f"node_to_node.py, {mass}, {impact}, {1e3 * dt:g} ms"
            rows[small] = [*openings, *slips]
            difference = np.abs(np.array(rows[small]) - np.array(rows[name])).max(axis=1)
            print(f"{law.upper()}, {small}: largest difference to '{name}' {difference[:2].max():.3f} mm in openings, "
                  f"{difference[2:].max():.3f} mm in slips")
            good = good and difference[:2].max() < limit and (difference[2:].max() < limit or name == "reference")

        print(f"\n### {law.upper()}: largest opening and slip at the crest [mm], joints 1 to 5\n")
        print("| run | opening, upstream | opening, downstream | slip, upstream | slip, downstream |")
        print("|---" * 5 + "|")
        for name, values in rows.items():
            print(f"| {name} | " + " | ".join(" ".join(f"{v:.1f}" for v in column) for column in values) + " |")
        print("\n| run | static crest, downstream | static crest, up | move upstream | move downstream |")
        print("|---" * 5 + "|")
        for name, values in crest.items():
            print(f"| {name} | " + " | ".join([f"{v:.2f}" for v in values] + ["-"] * (4 - len(values))) + " |")
    print(f"\n{'Agrees' if good else 'DIFFERS'}.")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
