#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what a run says of stresses on faces and of pressures of joints, on a small dam.

    program_stress.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import math
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scripts"))
from run_program import run_cases, expect, runs, summary, table, write_scene  # noqa: E402
from vtu import read_vtu  # noqa: E402


def rows(name):
    with open(name) as file:
        return list(csv.DictReader(file))


def place(row):
    return row["face"], *(round(float(row[c]), 3) for c in "xyz")


def faces():
    """The headline leaves the foot out; the area above a strength; what the faces carry."""
    write_scene()
    strength = 5e5
    shown = runs("scene.prm", "--output", "run", "--set", f"Output/Tensile strength={strength}", "--set",
                 "Output/Solution interval=25")
    result, nodes, quads = summary("run"), rows("run/faces.csv"), rows("run/faces_cells.csv")
    edges = Counter(tuple(sorted((place(nodes[int(q[f"n{a}"])]), place(nodes[int(q[f"n{(a + 1) % 4}"])]))))
                    for q in quads for a in range(4))
    base = {p[1:] for edge, n in edges.items() if n == 1 and min(p[3] for p in edge) < 209.9 for p in edge}
    for face in ("upstream", "downstream"):
        mine = [n for n in nodes if n["face"] == face]
        away = [float(n["max_principal"]) for n in mine if min(math.dist(place(n)[1:], b) for b in base) > 21.]
        above, whole = (result["extremes"][f"max_tension_{face}{end}"] for end in ("_above_foot", ""))
        print(f"    {face}: {above['value']:.6g} Pa above the foot, expected {max(away):.6g}; {whole['value']:.6g} Pa in all")
        expect(abs(above["value"] - max(away)) < 1e-5 * max(away), f"tension above the foot, {face}")
        expect(above["value"] < whole["value"] or whole["place"] == above["place"], "the foot has more")
        expect(min(math.dist(above["place"], b) for b in base) > 21., "its place is not at the foot")
        part = result["tension_above_strength"][face]
        cracked = [n for n in mine if float(n["max_principal"]) > strength]
        expect(0 < len(cracked) < len(mine), f"{len(cracked)} of {len(mine)} nodes above the strength")
        expect(0 < part["share"] < 1 and abs(part["area"] / part["share"] / (210 * 500) - 1) < .5, f"{part}")
        expect(abs(part["share"] - len(cracked) / len(mine)) < .25, f"share {part['share']}, nodes {len(cracked)}/{len(mine)}")
    expect(result["tension_above_strength"]["strength"] == strength, "the strength")
    expect("Tension   largest" in shown and "above the strength of 0.50 MPa" in shown, shown)
    data = read_vtu("run/solution-00025.vtu")
    crest = [i for i in range(len(data["stress_zz"])) if data["Points"][3 * i + 2] > 209.99]
    worst = max(max(abs(data[f"stress_{c}"][i]) for c in ("zz", "yz", "zx")) for i in crest
                if abs(data["Points"][3 * i + 1]) < 150)
    print(f"    {worst:.3g} Pa on the crest")
    expect(worst < 1., "the crest is free")


def pressures():
    """joint_pressures.csv against the fields of every step."""
    write_scene()
    runs("scene.prm", "--output", "run", "--set", "Output/Solution interval=1")
    columns, joints = table("run/joint_pressures.csv")
    expect(columns == ["joint", "s", "max_pressure", "x", "y", "z", "time_of_max_pressure", "mean_pressure"], f"{columns}")
    times = [row[0] for row in table("run/history.csv")[1]]
    solutions = [read_vtu(f"run/solution-{k:05d}.vtu") for k in range(len(times))]
    points = solutions[0]["Points"]
    at = [tuple(points[3 * i:3 * i + 3]) for i in range(len(points) // 3)]
    envelope = read_vtu("run/envelope.vtu")["max_joint_pressure"]
    for row in joints:
        side = -1 if row[1] < 0 else 1
        mine = [i for i, p in enumerate(at) if solutions[0]["joint_state"][i] >= 0 and p[1] * side > 0]
        largest = [max(s["joint_pressure"][i] for i in mine) for s in solutions]
        expect(abs(row[2] - max(largest)) < 1e-5 * max(largest), f"{row}, expected {max(largest)}")
        expect(abs(row[6] - times[largest.index(max(largest))]) < 1e-6, f"time {row[6]}")
        expect(any(math.dist(at[i], row[3:6]) < 1e-3 for i in mine), "its place is on the joint")
        expect(abs(max(envelope[i] for i in mine) - row[2]) < 1e-5 * row[2], "envelope.vtu")
        expect(0 < row[7] < row[2], f"mean pressure {row[7]}")
        for s in solutions:
            expect(all(s["joint_pressure"][i] == 0 for i in mine if s["joint_state"][i] == 0), "an open pair has none")


if __name__ == "__main__":
    run_cases(faces, pressures)
