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

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
import meshes  # noqa: E402
from compare import E, GRAVITY, STRESS, at_places, read_vtu as read_fields, scene  # noqa: E402
from run_program import run_cases, expect, runs, summary, table, write_scene  # noqa: E402
from voussoir.vtu import read_vtu  # noqa: E402


def rows(name):
    with open(name) as file:
        return list(csv.DictReader(file))


def place(row):
    return row["face"], *(round(float(row[c]), 3) for c in "xyz")


def base_of(nodes, quads):
    """Places of the base: outer edges of both faces below the crest."""
    edges = Counter(tuple(sorted((place(nodes[int(q[f"n{a}"])]), place(nodes[int(q[f"n{(a + 1) % 4}"])]))))
                    for q in quads for a in range(4))
    return {p[1:] for edge, n in edges.items() if n == 1 and min(p[3] for p in edge) < 209.9 for p in edge}


def faces():
    """The headline leaves the foot out; the area above a strength; what the faces carry."""
    write_scene()
    strength = 5e5
    shown = runs("scene.prm", "--output", "run", "--set", f"Output/Tensile strength={strength}", "--set",
                 "Output/Solution interval=25", "--set", "Mesh/Arch210/Elements up=14")  # of 15 m: the foot of 21 m has a row inside
    result, nodes, quads = summary("run"), rows("run/faces.csv"), rows("run/faces_cells.csv")
    base = base_of(nodes, quads)
    for face in ("upstream", "downstream"):
        mine = [n for n in nodes if n["face"] == face]
        away = [float(n["max_principal"]) for n in mine if min(math.dist(place(n)[1:], b) for b in base) > 21.]
        above, whole = (result["extremes"][f"max_tension_{face}{end}"] for end in ("_away_from_base", ""))
        print(f"    {face}: {above['value']:.6g} Pa away from the base, expected {max(away):.6g}; {whole['value']:.6g} Pa in all")
        expect(abs(above["value"] - max(away)) < 1e-5 * max(away), f"tension away from the base, {face}")
        expect(result["extremes"][f"max_tension_{face}_above_foot"] == above, "the name of earlier versions")
        expect(above["value"] < whole["value"] or whole["place"] == above["place"], "the foot has more")
        expect(min(math.dist(above["place"], b) for b in base) > 21., "its place is not at the foot")
        part = result["tension_above_strength"][face]
        cracked = [n for n in mine if float(n["max_principal"]) > strength]
        expect(0 < len(cracked) < len(mine), f"{len(cracked)} of {len(mine)} nodes above the strength")
        expect(0 < part["share"] < 1 and abs(part["area"] / part["share"] / (210 * 500) - 1) < .5, f"{part}")
        expect(abs(part["share"] - len(cracked) / len(mine)) < .25, f"share {part['share']}, nodes {len(cracked)}/{len(mine)}")
    expect(result["tension_above_strength"]["strength"] == strength, "the strength")
    points = read_vtu("run/envelope.vtu")
    least = min(s for i, s in enumerate(points["min_principal"])
                if min(math.dist(points["Points"][3 * i:3 * i + 3], b) for b in base) > 21.)
    found = result["extremes"]["max_compression_away_from_base"]
    print(f"    compression {found['value']:.6g} Pa away from the base, expected {least:.6g}; {result['extremes']['max_compression']['value']:.6g} Pa in all")
    expect(abs(found["value"] - least) < 1e-5 * abs(least), "compression away from the base")
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


def normals(nodes, quads):
    """Normal of each row of faces.csv: integral of its bilinear shape function times the normal, by 2 x 2 Gauss points."""
    sums = [[0., 0., 0.] for _ in nodes]
    gauss = [.5 - .5 / math.sqrt(3), .5 + .5 / math.sqrt(3)]
    for quad in quads:
        corners = [int(quad[f"n{k}"]) for k in range(4)]
        p = [[float(nodes[n][c]) for c in "xyz"] for n in corners]
        for s in gauss:
            for t in gauss:
                a = [(1 - t) * (p[1][c] - p[0][c]) + t * (p[2][c] - p[3][c]) for c in range(3)]
                b = [(1 - s) * (p[3][c] - p[0][c]) + s * (p[2][c] - p[1][c]) for c in range(3)]
                n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
                sign = 1 if (n[0] < 0) == (quad["face"] == "upstream") else -1
                for node, shape in zip(corners, ((1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t)):
                    for c in range(3):
                        sums[node][c] += sign * shape * n[c]
    return sums


def along(s, t):
    """Stress in the direction t. s: xx yy zz xy yz zx."""
    return sum(a * b for a, b in zip(traction(s, t), t)) / sum(a * a for a in t)


def directions():
    """Arch, cantilever and vertical stresses of every step against the six components and the normals of faces.csv: fields,
    envelopes, and extremes away from the base."""
    write_scene()
    shown = runs("scene.prm", "--output", "run", "--set", "Output/Solution interval=1", "--set", "Motion/Duration=0.3",
                 "--set", "Mesh/Arch210/Elements up=14", "--set", "Mesh/Arch210/Elements through=2")
    nodes, quads, result = rows("run/faces.csv"), rows("run/faces_cells.csv"), summary("run")["extremes"]
    times = [row[0] for row in table("run/history.csv")[1]]
    solutions = [read_vtu(f"run/solution-{k:05d}.vtu") for k in range(len(times))]
    envelope, points = read_vtu("run/envelope.vtu"), solutions[0]["Points"]
    places = [points[3 * i:3 * i + 3] for i in range(len(points) // 3)]
    near = lambda x: [i for i, p in enumerate(places) if math.dist(p, x) < .02]
    size = max(max(map(abs, s["stress_zz"])) for s in solutions)
    worst, base = dict.fromkeys(("fields", "faces.csv", "envelope.vtu"), 0.), base_of(nodes, quads)
    for row, n in zip(nodes, normals(nodes, quads)):
        arch = (-n[1], n[0], 0.)
        tangents = {"arch": arch, "cantilever": (-n[2] * arch[1], n[2] * arch[0], n[0] * arch[1] - n[1] * arch[0]), "vertical": (0, 0, 1)}
        own = near(place(row)[1:])  # two nodes at a joint: the one with the smaller difference counts
        found = {}
        for name, t in tangents.items():
            over_time = [[along([s[c][i] for c in STRESS], t) for s in solutions] for i in own]
            for end, choose in (("max", max), ("min", min)):
                value, column = float(row[f"{name}_stress_{end}"]), f"{name}_stress_{end}"
                found[column] = min(abs(choose(values) - value) for values in over_time)
                worst["envelope.vtu"] = max(worst["envelope.vtu"], min(abs(envelope[column][i] - value) for i in own) / size)
            if name != "vertical":
                worst["fields"] = max(worst["fields"], min(max(abs(s[f"{name}_stress"][i] - x) for s, x in zip(solutions, values))
                                                           for i, values in zip(own, over_time)) / size)
        worst["faces.csv"] = max(worst["faces.csv"], max(found.values()) / size)
    print(f"    differences, of {size / 1e6:.3g} MPa: {worst}")
    expect(max(worst.values()) < 1e-5, f"{worst}")
    on_faces = {i for row in nodes for i in near(place(row)[1:])}
    expect(0 < len(on_faces) < len(places), f"{len(on_faces)} of {len(places)} points are on faces")
    expect(all((x == 0.) == (i not in on_faces) for i, x in enumerate(envelope["arch_stress_max"])), "values away from the faces")
    for name in ("arch", "cantilever", "vertical"):
        for face in ("upstream", "downstream"):
            for end, choose in (("max", max), ("min", min)):
                extreme, column = result[f"{name}_stress_{end}_{face}_away_from_base"], f"{name}_stress_{end}"
                expected = choose(float(n[column]) for n in nodes if n["face"] == face and min(math.dist(place(n)[1:], b) for b in base) > 21.)
                expect(abs(extreme["value"] - expected) < 1e-5 * size, f"{column}, {face}: {extreme['value']}, {expected}")
                (k,) = [k for k, t in enumerate(times) if abs(t - extreme["time"]) < 1e-6]
                field = "stress_zz" if name == "vertical" else f"{name}_stress"
                expect(min(abs(solutions[k][field][i] - expected) for i in near(extreme["place"])) < 1e-5 * size, f"{column}, {face}: place and time")
    for name in ("arch", "cantilever"):
        low, high = (1e-6 * result[f"{name}_stress_{end}_upstream_away_from_base"]["value"] for end in ("min", "max"))
        expect(f"{name} stress away from the base from {low:.2f} to {high:.2f} MPa upstream, from " in shown, shown)


def block(lean_upstream, lean_downstream):
    """Two monoliths of 10 m, 60 m high, 10 m thick at the foot, their joint at y = 0; the faces lean inwards."""
    def place(i, j, k):
        z, s = 5. * k, j / 2
        return ((1 - s) * lean_upstream * z + s * (10 - lean_downstream * z), 10. * (i - 1), z)
    meshes.write("block.msh", *meshes.block(place, (1, 2), 2, 12, {**meshes.DAM, "right": None, "left": None}))


def stresses(name, **entries):
    """Static stresses in Pa at places in 10 mm, one row for each monolith there. Loads__Silt__Level=3: that entry; _ is a blank."""
    file = scene(name, "block.msh", Concrete={"Young's modulus": E, "Poisson's ratio": .2, "Density": 2500}, Joints={"Model": "FJA"})
    runs(file, "--output", name, *(x for entry, value in entries.items()
                                   for x in ("--set", f"{entry.replace('__', '/').replace('_', ' ')}={value}")))
    (solution,) = Path(name).glob("solution-*.vtu")
    return at_places(read_fields(solution), STRESS)


def traction(s, n):
    return tuple(sum(s[c] * x for c, x in zip(row, n)) for row in ((0, 3, 5), (3, 1, 4), (5, 4, 2)))


def temperature():
    """Cooled, two monoliths part, and far above their foot they are free: no stress, inside, on faces and at the joint, with the
    known tractions as without."""
    block(0, 0)
    for faces in ((-10, -10), (-15, -5)):
        for recovery in ("tractions", "elements"):
            name = f"{recovery}{faces[0]}"
            found = stresses(name, Output__Stress_recovery=recovery, Loads__Temperature__Upstream_face=faces[0],
                             Loads__Temperature__Downstream_face=faces[1])
            worst = max(abs(s) for (_, _, z), rows in found.items() if z > 4000 for row in rows for s in row) / (E * 1e-5 * 10)
            print(f"    {name}: {worst:.1e} E alpha dT")
            expect(worst < 1e-4, f"a free dam has no stress: {worst}")


def loads():
    """Water, silt, tail water and the water in an open joint, each with its factor, and a temperature: the stress has their
    tractions on both faces and on both sides of the joint."""
    block(.1, .05)
    found = stresses("loads", Loads__Combination="all", Loads__Combinations="all: water 1.5, silt 2, tail water 0.5, temperature, uplift 0.8",
                     Reservoir__Density=1000, Reservoir__Water_level=52, Loads__Silt__Level=37, Loads__Silt__Density=900,
                     Loads__Silt__Coefficient=.4, Loads__Tail_water__Level=28, Loads__Tail_water__Density=1200, Loads__Uplift__Joints="true",
                     Loads__Temperature__Upstream_face=-30, Loads__Temperature__Downstream_face=-30)
    of = lambda density, level, z: density * GRAVITY * max(0, level - z)
    worst, n = dict.fromkeys(("upstream", "downstream", "joint"), 0), dict.fromkeys(("upstream", "downstream", "joint"), 0)
    for place, rows in found.items():
        x, y, z = (c / 100 for c in place)
        if z < 1:  # held
            continue
        water, silt, tail = of(1500, 52, z), of(1800, 37, z), of(600, 28, z)
        cases = [("upstream", abs(x - .1 * z) < .02, (-1, 0, .1), (water + .4 * silt, 0, -.1 * (water + silt))),
                 ("downstream", abs(x - 10 + .05 * z) < .02, (1, 0, .05), (-tail, 0, -.05 * tail)),
                 ("joint", y == 0, (0, 1, 0), (0, -.8 * water, 0))]
        for face, is_there, normal, known in cases:  # normals are not of length 1: nor are the tractions per area
            for row in rows if is_there else ():
                n[face] += 1
                worst[face] = max(worst[face], math.dist(traction(row, normal), known) / of(1500, 52, 0))
    print(f"    {n}; tractions missed, of the water's at the foot: {worst}")
    expect(all(x >= 36 for x in n.values()), f"{n}")
    for face, error in worst.items():
        expect(error < 1e-4, f"{face}: {error}")


def moving_water():
    """A squat wall in a strong motion, elements of degree 2, four through the thickness, whose own stresses know the water's
    pressure by themselves: far from the singular foot they have that of the known tractions, the moving water's with it."""
    height, water = 60., 60.
    meshes.write("squat.msh", *meshes.block(lambda i, j, k: (10. * j, 20. * i, 7.5 * k), (1,), 4, 8,
                                            {**meshes.DAM, "right": None, "left": None}))
    write_scene()
    found, peak = {}, {}
    for recovery in ("tractions", "elements"):
        file = scene("squat", "squat.msh", Concrete={"Young's modulus": 21e9, "Poisson's ratio": .3, "Density": 2400},
                     Damping={"Ratio": .05}, Elements={"Degree": 2},
                     Reservoir={"Density": 1000, "Water level": water, "Model": "Westergaard"},
                     Motion={"Source": "file", "File": "motion.txt", "Unit": "g", "Duration": .35, "Time step": .005},
                     Output={"Stress recovery": recovery, "Solution interval": 64})
        runs(file, "--output", recovery)
        found[recovery] = at_places(read_fields(Path(recovery, "solution-00064.vtu")), STRESS)
        peak[recovery] = max(float(row["max_principal"]) for row in rows(f"{recovery}/faces.csv")
                             if row["face"] == "upstream" and float(row["z"]) > height / 3)
    ratios = []
    for place, (known,) in found["tractions"].items():
        x, z = place[0] / 100, place[2] / 100
        if x == 0 and height / 3 < z < .9 * height:
            still = -1000 * GRAVITY * (water - z)
            (own,) = found["elements"][place]
            expect(known[0] < 1.3 * still, f"the moving water presses little at z = {z}: {known[0]} Pa, still {still}")
            ratios.append((own[0] - still) / (known[0] - still))
    print(f"    pressure of the moving water by the elements, over the known one: {min(ratios):.3f} to {max(ratios):.3f} at {len(ratios)} nodes")
    print(f"    peak tension upstream {peak['tractions'] / 1e6:.4f} MPa, by the elements {peak['elements'] / 1e6:.4f} MPa")
    expect(len(ratios) > 10 and .95 < min(ratios) and max(ratios) < 1.25, f"{ratios}")
    expect(abs(peak["tractions"] / peak["elements"] - 1) < .01, f"peak tension {peak}")


if __name__ == "__main__":
    run_cases(faces, directions, pressures, temperature, loads, moving_water)
