#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect of base or lift joints on openings, slips, tension, base forces and cost of the quick start and rigid28.

    benchmarks/base_joint.py [SCENE...] [--lifts] [--duration 6] [--output output/base_joint] [--voussoir PROGRAM]

Variants: base bonded; base joint with the law of the joints (FJA); base joint without slip (FJB); all joints elastic (20 and 10 GPa/m);
full water pressure in open pairs of the base in the static state. With --lifts: three lift joints per monolith, tied, with the law of the joints,
without slip, and together with a base joint. Finished runs are not repeated. Prints a Markdown table. Cost: CPU time of the steps.
"""

import argparse
import csv
import json
from pathlib import Path

from program import ROOT, add_program_argument, run

BASE = "Mesh/Arch210/Base joint=true"
VARIANTS = {
    "bonded": (),
    "base joint": (BASE,),
    "base joint, no slip": (BASE, "Joints/Overrides=base: FJB"),
    "all joints elastic": (BASE, "Joints/Normal stiffness=20 GPa/m", "Joints/Tangential stiffness=10 GPa/m"),
    "base joint, water in open pairs": (BASE, "Loads/Uplift/Joints=true"),
}

LIFTS = "Mesh/Arch210/Lift joints=3"
VARIANTS_OF_LIFTS = {
    "lift joints tied": (LIFTS, "Joints/Overrides=lift: tied"),
    "lift joints": (LIFTS,),
    "lift joints, no slip": (LIFTS, "Joints/Overrides=lift: FJB"),
    "lift and base joints": (LIFTS, BASE),
}


def of_joints(folder, names, kind):
    """Largest opening and slip of the joints of a kind, "12.3; 4.5" [mm]; "" without such joints."""
    with open(folder / "joint_points.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if names[int(row["joint"]) - 1].startswith(kind)]
    largest = [1e3 * max((float(row[column]) for row in rows), default=0.) for column in ("max_opening", "max_slip")]
    return "; ".join(f"{value:.1f}" for value in largest) if rows else ""


def largest_shear(folder):
    """Largest shear force on the base of a monolith in the run [MN]."""
    with open(folder / "blocks.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    numbers = {name.rsplit("_", 1)[1] for name in rows[0] if name.startswith("V_stream_")}
    return max((float(row[f"V_stream_{n}"])**2 + float(row[f"V_arch_{n}"])**2)**.5 for row in rows for n in numbers) / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("scenes", nargs="*", default=["quickstart", "rigid28"])
    parser.add_argument("--lifts", action="store_true", help="the variants with lift joints")
    parser.add_argument("--duration", default="6")
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "base_joint")
    options = parser.parse_args()
    kinds = {"joint": "Joints", "lift": "Lifts", "base": "Base"}
    if not options.lifts:
        del kinds["lift"]
    columns = ["Scene", "Variant", *(f"{text}: opening; slip [mm]" for text in kinds.values()), "Tension up; down [MPa]", "Base shear [MN]",
               "Newton steps", "Cost"]
    print("|", " | ".join(columns), "|")
    print("|" + "---|" * len(columns))
    for scene in options.scenes:
        cost = None
        for name, entries in (VARIANTS_OF_LIFTS if options.lifts else VARIANTS).items():
            folder = options.output / f"{scene}-{name.replace(' ', '-').replace(',', '')}"
            if not (folder / "summary.json").exists():
                settings = [word for entry in (f"Motion/Duration={options.duration}", "Output/Figures=false", *entries) for word in ("--set", entry)]
                run(options.voussoir, ROOT / "prm" / f"{scene}.prm", "--output", folder, "--overwrite", *settings)
            summary = json.loads((folder / "summary.json").read_text())
            extremes, names = summary["extremes"], summary["mesh"]["joint_names"]
            seconds = summary["seconds"]["shaking_cpu"]
            cost = cost or seconds
            tension = "; ".join(f"{extremes[f'max_tension_{face}_away_from_base']['value'] / 1e6:.2f}" for face in ("upstream", "downstream"))
            of_kinds = [of_joints(folder, names, kind) for kind in kinds]
            print("|", " | ".join([scene, name, *of_kinds, tension, f"{largest_shear(folder):.0f}", f"{summary['newton_iterations']['mean']:.2f}",
                                   f"{seconds / cost:.2f}"]), "|", flush=True)


if __name__ == "__main__":
    main()
