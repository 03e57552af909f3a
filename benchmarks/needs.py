#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir needs` on five scenes that no rule was tuned on: does the smallest scene keep its promise, and what does it cost?

    benchmarks/needs.py [SCENE...] [--for 5%] [--seed 33] [--jobs 2] [--output build/needs] [--voussoir PROGRAM]

The dams are of arcs of random heights, radii and thicknesses, with 1 to 20 joints, on a rigid base, massless rock or rock; water, materials, friction
and the artificial motions are random as well. Meshes follow doc/accuracy.md. Acceptance: at least 90 % of the quantities are within the target, and
the cost is at most a third. Prints a Markdown table. Existing runs are not repeated. SCENE: numbers from 1 to 5.
"""

import argparse
import os
import random
from pathlib import Path

from program import ROOT, add_program_argument
from voussoir.needs_command import Needs
from voussoir.needs_verdicts import COLUMNS
from voussoir.prm import prm_text

# Joints, foundation, heights [m]. The cost of a scene limits its joints and its rock.
KINDS = ((4, "rigid", (60, 120)), (9, "massless", (90, 160)), (1, "rigid", (60, 100)), (20, "rigid", (180, 250)), (6, "rock", (110, 180)))
ARCS = ((0, -4, 60, 14, 42, 25, 27), (1 / 3, -8, 75, 12, 58, 38, 41), (2 / 3, -7, 90, 9, 76, 47, 49), (1, 0, 100, 4, 96, 53, 55))  # of 90 m


def write_arcs(file, height, draw):
    """Writes a table of arcs: that of doc/tutorials/2_own_dam.md with other sizes."""
    size, thickness, width = height / 90, draw.uniform(0.85, 1.4), draw.uniform(-4, 4)
    lines = ["elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle"]
    for z, x, upstream, t, downstream, right, left in ARCS:
        values = (height * z, size * x, size * upstream, size * t * thickness, size * (downstream + t * (1 - thickness)), right + width, left - width)
        lines.append(",".join(f"{value:.4g}" for value in values))
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_scene(directory, number, seed):
    """Writes the scene with this number; returns its file and a description."""
    draw = random.Random(1000 * seed + number)
    joints, foundation, heights = KINDS[number - 1]
    height = round(draw.uniform(*heights))
    write_arcs(directory / f"arcs{number}.csv", height, draw)
    along = max(4, round(24 / (joints + 1))) * (joints + 1)
    arcs = {"Table": f"arcs{number}.csv", "Joints": joints, "Elements along": along, "Elements up": draw.choice((14, 16, 18)),
            "Elements through": 2 if foundation == "rock" else 3}
    spectrum = draw.choice(("DL5073-2000", "NB35047-2015"))
    entries = {"Mesh/Source": "arcs", **{f"Mesh/Arcs/{name}": value for name, value in arcs.items()},
               "Concrete/Young's modulus": f"{draw.uniform(18, 30):.1f} GPa", "Reservoir/Water level": round(height * draw.uniform(0.8, 0.97), 1),
               "Joints/Friction": round(draw.uniform(0.6, 1.), 2), "Motion/Source": "artificial", "Motion/Duration": 16, "Motion/Time step": 0.01,
               "Motion/Spectrum": spectrum, "Motion/Characteristic period": round(draw.uniform(0.2, 0.4), 2),
               "Motion/Peak acceleration": round(draw.uniform(0.2, 0.45), 2), "Motion/Seed": draw.randrange(100, 10000),
               "Foundation/Model": foundation, "Dynamics/Steps per sample": 2}
    if foundation != "rigid":
        entries["Foundation/Young's modulus"] = f"{draw.uniform(12, 30):.1f} GPa"
    file = directory / f"scene{number}.prm"
    file.write_text(prm_text(dict(sorted(entries.items()))), encoding="utf-8")
    return file, f"{height} m, {joints} joint{'s' if joints > 1 else ''}, {foundation}"


def largest(smallest):
    """Largest change of the smallest scene against the scene, and the result that has it."""
    changes, counts = smallest.get("changes"), smallest.get("counts")
    if not changes:
        return "-"
    name = max(COLUMNS, key=lambda column: abs(changes[column] or 0.) if counts[column] else 0.)
    return f"{100 * (changes[name] or 0.):+.1f} % ({COLUMNS[name].title})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("scenes", nargs="*", type=int, choices=range(1, len(KINDS) + 1), default=[])
    parser.add_argument("--for", dest="target", default="5%")
    parser.add_argument("--seed", type=int, default=33)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "needs")
    options = parser.parse_args()
    os.environ["VOUSSOIR_PROGRAM"] = str(Path(options.voussoir).resolve())
    options.output.mkdir(parents=True, exist_ok=True)
    lines, within, of = [], 0, 0
    for number in options.scenes or range(1, len(KINDS) + 1):
        file, words = write_scene(options.output, number, options.seed)
        result = Needs(file, float(options.target.rstrip("%")) / 100, 5., options.jobs, {"output": options.output / f"scene{number}-needs"}).compute()
        smallest = result["smallest"]
        within, of = within + smallest.get("within", 0), of + smallest.get("of", len(COLUMNS))
        rows = "; ".join(name.split(": ", 1)[1] for name in smallest["rows"]) or "none"
        cost = f"{smallest['cost']:.2f}" if "cost" in smallest else "-"
        holds = {True: "yes", False: "no", None: "not tested"}[smallest["holds"]]
        lines.append(f"| {number} | {words} | {rows} | {largest(smallest)} | {smallest.get('within', 0)} of {smallest.get('of', len(COLUMNS))} | {cost} | "
                     f"{holds} | {result['total_cost']:.1f} |")
    print("\n| Scene | Dam, foundation | Adopted rows | Largest change | Within | Cost | Holds | Total |\n|---|---|---|---|---|---|---|---|")
    print("\n".join(lines) + f"\n\n{within} of {of} quantities are within {options.target} ({100 * within / of:.0f} %).")


if __name__ == "__main__":
    main()
