#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do shear keys (KSM) make the joints behave like plain ones (FJA) or like ones that do not slip (FJB)?

    benchmarks/keys.py [--voussoir PROGRAM] [--mesh paper|coarse] [--duration 20.48] [--motions 3]

The dam of prm/rigid_base_ksm.prm with one parameter of the keys changed at a time, then some together. Prints Markdown
tables. Openings and slips are the largest over time at the crest, on both faces of every joint ("profile"); distances
are root mean squares of the difference of two profiles. "share of FJB" is the slip profile's distance to FJA over the
sum of its distances to FJA and FJB: 0 % is FJA, 100 % FJB. FJA with a slightly different friction and with half the
time step shows how much of a distance means nothing. Upper tension: the envelope's mean over the face above z = 150 m,
within 150 m of the crown.

Newton: steps per time step, mean (largest); halved: time steps that were solved in smaller ones.

Exit status: 0 if tight rectangular keys with rigid seats give FJB's profiles to 0.1 mm, as they must while no joint
opens by the height of the keys, and every run converges; 1 if not.
"""

import argparse
import csv
import math
import sys
import tempfile
from pathlib import Path

from program import ROOT, add_program_argument, run as program_output, simulate

SCENE = ROOT / "prm" / "rigid_base_ksm.prm"
COARSE = {"Mesh/Arch210/Elements along": 60, "Mesh/Arch210/Elements up": 16, "Mesh/Arch210/Elements through": 2}
RIGID = {"Seat compliance": 0}
KEYS = [
    ("rectangular, 20 cm, tight, both", {}),
    ("rigid seats", RIGID),
    ("radial slip restrained only", {"Direction": "radial"}),
    ("vertical slip restrained only", {"Direction": "vertical"}),
    ("clearance 1 mm", {"Clearance": 0.001}),
    ("clearance 5 mm", {"Clearance": 0.005}),
    ("clearance 20 mm", {"Clearance": 0.02}),
    ("flanks 20 deg", {"Flank angle": 20}),
    ("flanks 45 deg", {"Flank angle": 45}),
    ("height 2 cm", {"Height": 0.02}),
    ("flank friction 0.5", {"Friction": 0.5}),
    ("vertical, 5 mm", {"Direction": "vertical", "Clearance": 0.005}),
    ("radial, 20 mm", {"Direction": "radial", "Clearance": 0.02}),
    ("2 cm, clearance 5 mm", {"Height": 0.02, "Clearance": 0.005}),
    ("2 cm, flanks 45 deg", {"Height": 0.02, "Flank angle": 45}),
    ("flanks 45 deg, friction 0.5", {"Flank angle": 45, "Friction": 0.5}),
]
COLUMNS = ["law or keys", "largest opening [mm]", "largest slip [mm]", "mean opening [mm]", "end joints' opening [mm]",
           "upper tension u/s, d/s [MPa]", "opening: to FJA, FJB [mm]", "slip: to FJA, FJB [mm]", "share of FJB",
           "Newton", "halved", "energy balance"]


class Run:
    def __init__(self, program, settings):
        with tempfile.TemporaryDirectory() as directory:
            self.summary = simulate(program, SCENE, settings, directory)
            with open(Path(directory) / "joints.csv") as file:
                joints = list(csv.DictReader(file))
            with open(Path(directory) / "faces.csv") as file:
                faces = list(csv.DictReader(file))
        self.openings, self.slips = ([1e3 * abs(float(joint[f"{quantity}_{face}"])) for joint in joints
                                      for face in ("upstream", "downstream")] for quantity in ("opening", "slip"))
        self.upper = []
        for name in ("upstream", "downstream"):
            values = [float(row["max_principal"]) / 1e6 for row in faces if row["face"] == name
                      and float(row["z"]) >= 150 and abs(float(row["s"])) <= 150]
            self.upper.append(sum(values) / len(values))
        print(".", end="", file=sys.stderr, flush=True)

    def line(self, name, fja, fjb):
        wide = [max(pair) for pair in zip(self.openings[::2], self.openings[1::2])]
        to = [distance(self.openings, fja.openings), distance(self.openings, fjb.openings),
              distance(self.slips, fja.slips), distance(self.slips, fjb.slips)]
        share = to[2] / (to[2] + to[3])
        newton = self.summary["newton_iterations"]
        print(f"| {name} | {max(wide):.1f} | {max(self.slips):.1f} | {sum(wide) / len(wide):.1f} | "
              f"{wide[0]:.1f}, {wide[-1]:.1f} | {self.upper[0]:.2f}, {self.upper[1]:.2f} | "
              f"{to[0]:.1f}, {to[1]:.1f} | {to[2]:.1f}, {to[3]:.1f} | {share:.0%} | "
              f"{newton['mean']:.2f} ({newton['max']}) | {self.summary['contact_path']['smaller_step']} | "
              f"{self.summary['energy_balance_error']:.0e} |", flush=True)


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))


def head(columns):
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--mesh", choices=("paper", "coarse"), default="coarse",
                        help="coarse: 60 x 16 x 2 elements instead of the scene's")
    parser.add_argument("--duration", type=float, default=20.48, help="of the motion [s]")
    parser.add_argument("--motions", type=int, default=3, help="seeds of the second table")
    options = parser.parse_args()
    common = {"Motion/Duration": options.duration, **(COARSE if options.mesh == "coarse" else {})}
    if options.duration <= 11.:
        common["Motion/Decay begin"] = options.duration * 11. / 20.48

    def run(law, settings=None):
        return Run(options.voussoir, {**common, "Joints/Model": law, **(settings or {})})

    fja, fjb = run("FJA"), run("FJB")
    print(f"### One motion ({options.mesh} mesh, {options.duration} s)\n")
    head(COLUMNS)
    fja.line("FJA", fja, fjb)
    fjb.line("FJB", fja, fjb)
    run("FJA", {"Joints/Friction": 0.78}).line("FJA, friction 0.78", fja, fjb)
    with tempfile.TemporaryDirectory() as directory:
        motion = Path(directory) / "motion.csv"
        program_output(options.voussoir, "motion", SCENE, "--output", motion, settings=common)
        run("FJA", {"Motion/Source": "file", "Motion/File": motion, "Motion/Time step": 0.005}).line(
            "FJA, half the time step", fja, fjb)
    good = True
    for name, keys in KEYS:
        try:
            keyed = run("KSM", {f"Joints/Keys/{entry}": value for entry, value in keys.items()})
        except SystemExit as failure:  # the program's last words
            print(f"| KSM, {name} | {str(failure).strip().splitlines()[-1]} |" + " |" * (len(COLUMNS) - 2), flush=True)
            good = False
            continue
        keyed.line(f"KSM, {name}", fja, fjb)
        if keys == RIGID:
            good = good and max(distance(keyed.openings, fjb.openings), distance(keyed.slips, fjb.slips)) < 0.1

    print("\n### Other motions: largest opening of joints 1 to 5 [mm]\n")
    head(["motion", "FJA", "FJB", "KSM, clearance 20 mm"])
    for seed in range(1, options.motions + 1):
        cells = []
        for law, keys in (("FJA", {}), ("FJB", {}), ("KSM", {"Joints/Keys/Clearance": 0.02})):
            openings = run(law, {"Motion/Seed": seed, **keys}).openings
            cells.append(" ".join(f"{max(pair):.0f}" for pair in zip(openings[::2], openings[1::2])))
        print(f"| seed {seed} | " + " | ".join(cells) + " |", flush=True)
    print(file=sys.stderr)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
