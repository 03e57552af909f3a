#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: law cohesive in a dam, between FJA and tied; energy, checkpoints, entries.

    program_cohesive.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
import random
from pathlib import Path

import run_program
from run_program import arch_mesh, double, expect, from_file, read_mesh, run_cases, runs, same, summary, table, write_mesh, write_scene

EXACT = ("--set", "Dynamics/Factors=double")  # tests of round-off
SHORT = [*EXACT, *(x for e in ("Motion/Duration=1", "Output/Envelope interval=0") for x in ("--set", e))]


def cohesive(strength, energy):
    return [x for e in ("Joints/Model=cohesive", f"Joints/Strength={strength}", f"Joints/Fracture energy={energy}")
            for x in ("--set", e)]


def limits():
    """No strength is FJA, any strength is the monolithic dam."""
    write_scene()
    runs("scene.prm", "--output", "fja", *SHORT, "--set", "Joints/Model=FJA")
    runs("scene.prm", "--output", "tied", *SHORT, "--set", "Joints/Model=tied")
    runs("scene.prm", "--output", "none", *SHORT, *cohesive("0 Pa", "0"))
    runs("scene.prm", "--output", "any", *SHORT, *cohesive("1e20 Pa", "100"))
    same("none", "fja", 0.)
    same("any", "tied", 1e-9, ("history",))
    expect(summary("any")["extremes"]["max_opening"]["value"] < 1e-9, "a joint of any strength does not open")


def energy():
    """What the bonds take is in its own column, less than all of them could, and the balance closes."""
    write_scene()
    openings = []
    for name, strength, fracture in (("brittle", "1 MPa", "0"), ("tough", "1 MPa", "300 J/m^2")):
        runs("scene.prm", "--output", name, *SHORT, *cohesive(strength, fracture))
        names, rows = table(f"{name}/energy.csv")
        bond = [row[names.index("joint_fracture")] for row in rows]
        print(f"    {name}: bonds took at most {max(bond):.6g} J; balance {summary(name)['energy_balance_error']:.1e}")
        expect(summary(name)["energy_balance_error"] < 1e-9, f"energy balance of {name}")
        expect((max(bond) == 0.) if fracture == "0" else (bond[-1] > 0. and min(bond) >= 0.), f"energy of the bonds of {name}")
        openings.append(summary(name)["extremes"]["max_opening"]["value"])
    runs("scene.prm", "--output", "fja", *SHORT, "--set", "Joints/Model=FJA")
    names, _ = table("fja/energy.csv")
    expect("joint_fracture" not in names and "bond" not in names, "no column of bonds without bonds")
    expect(all(1e-4 < opening for opening in openings), f"the joints open: {openings}")


def shuffled(mesh, seed):
    """The mesh with its nodes and elements in another order."""
    order = list(range(len(mesh["nodes"])))
    random.Random(seed).shuffle(order)
    place = {node: k for k, node in enumerate(order)}
    elements = [(kind, tag, [place[n] for n in corners]) for kind, tag, corners in mesh["elements"]]
    random.Random(seed + 1).shuffle(elements)
    return {**mesh, "nodes": [mesh["nodes"][n] for n in order], "elements": elements}


def numbers():
    """A small arch dam on a bonded base, its mirror image and the same mesh with shuffled nodes: the same openings in few Newton steps,
    for bonds that soften and bonds that are brittle in the time step."""
    write_scene()
    arc = "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n0,-1,28,5,22,25,25\n30,0,38,2.5,35.5,48,48\n"
    Path("arcs.csv").write_text(arc)
    common = [x for entry in ("Mesh/Source=arcs", "Mesh/Arcs/Table=arcs.csv", "Mesh/Arcs/Joints=3", "Mesh/Arcs/Elements along=16", "Mesh/Arcs/Elements up=5",
                              "Mesh/Arcs/Elements through=1", "Mesh/Arcs/Base joint=true", "Joints/Overrides=base: cohesive", "Joints/Strength=2 MPa",
                              "Reservoir/Water level=27", "Motion/Unit=m/s^2", "Motion/Duration=1.6", "Output/Envelope interval=0", "Dynamics/Factors=double")
              for x in ("--set", entry)]
    runs("mesh", "scene.prm", *common, "--output", "plain.msh", "--format", "2.2")
    mesh = read_mesh("plain.msh")
    turned = [3, 2, 1, 0, 7, 6, 5, 4]
    mirrored = [(kind, tag if kind == 3 else 5 - tag, [corners[k] for k in turned[:len(corners)]]) for kind, tag, corners in mesh["elements"]]
    write_mesh("mirror.msh", {**mesh, "nodes": [[x, -y, z] for x, y, z in mesh["nodes"]], "elements": mirrored})
    write_mesh("shuffled.msh", shuffled(mesh, 1))
    for sign, name in ((1, "plain"), (-1, "mirror")):
        rows = [(.01 * i, min(1., math.exp(-((.01 * i - 1) / .6) ** 2) if i < 100 else 1.)) for i in range(200)]
        Path(f"{name}.txt").write_text("".join(
            f"{t} {6 * s * math.sin(17 * t):.12g} {sign * 4.8 * s * math.sin(23 * t + 1):.12g} {3 * s * math.sin(29 * t + 2):.12g}\n" for t, s in rows))
    for energy in (300, 1200):
        opening = []
        for name, motion in (("plain", "plain"), ("mirror", "mirror"), ("shuffled", "plain")):
            runs("scene.prm", "--output", f"{name}{energy}", *common, *from_file(f"{name}.msh"), "--set", f"Motion/File={motion}.txt",
                 "--set", f"Joints/Fracture energy={energy}")
            result = summary(f"{name}{energy}")
            opening.append(result["extremes"]["max_opening"]["value"])
            steps = result["newton_iterations"]["mean"]
            expect(steps < 10 and result["contact_path"]["smaller_step"] == 0, f"{name}, {energy} N/m: {steps} Newton steps, {result['contact_path']}")
        print(f"    {energy} N/m: largest openings {opening} m")
        expect(max(opening) - min(opening) < 1e-6 * opening[0] and opening[0] > 1e-3, f"largest openings with {energy} N/m: {opening}")
    # The base joint of a dam without contraction joints ends at the same height on both banks: its history is that of the right one.
    whole = [*common, "--set", "Mesh/Arcs/Joints=0", "--set", "Joints/Overrides=base: FJA", "--set", "Motion/Source=none"]
    runs("mesh", "scene.prm", *whole, "--output", "whole.msh", "--format", "2.2")
    ends = []
    for seed in (1, 2, 3, 4):
        write_mesh("whole_shuffled.msh", shuffled(read_mesh("whole.msh"), seed))
        runs("scene.prm", "--output", f"whole{seed}", *whole, *from_file("whole_shuffled.msh"))
        ends.append(table(f"whole{seed}/joints.csv")[1][0][1])
    expect(all(abs(s - ends[0]) < 1e-6 and s < 0 for s in ends), f"upper end of the base joint: {ends}")


def entries():
    write_scene()
    expect("Joints/Strength" in run_program.voussoir("scene.prm", "--validate", "--set", "Joints/Strength=1 MPa").stdout,
           "a strength without effect is warned of")
    expect("Joints/Strength is 0" in run_program.voussoir("scene.prm", "--validate", "--set", "Joints/Model=cohesive").stdout,
           "a bond without strength is warned of")
    # Joints whose nodes are further apart than E G_f / f_t^2, here with 24 GPa. The longest edge on a joint:
    mesh = double(arch_mesh())
    length = max(math.dist(*(mesh["nodes"][nodes[i - k]] for k in (0, 1))) for _, tag, nodes in mesh["elements"] if 100 < tag < 200 for i in range(4))
    energy = length * 1e12 / 24e9  # with 1 MPa

    def warned(*settings):
        lines = runs("scene.prm", "--validate", "--set", "Concrete/Young's modulus=24 GPa", *settings).splitlines()
        return [line for line in lines if line.startswith("warning: nodes of cohesive joints")]

    lines = warned(*cohesive("2 MPa", "150 N/m"))
    print("   ", lines)
    expect(len(lines) == 1 and f"up to {length:.2g} m apart" in lines[0] and "limit is 0.9 m" in lines[0] and "to 0.9 m" in lines[0], f"{lines}")
    expect("Set Joints/Fracture energy" in warned(*cohesive("2 MPa", "0"))[0], "no fracture energy")
    finer = ["--set", "Elements/Degree=2"]
    for share, n in ((.999, 1), (1.001, 0)):
        expect(len(warned(*cohesive("1 MPa", share * energy))) == n, f"degree 1, {share} of the energy")
        expect(len(warned(*finer, *cohesive("1 MPa", share * energy / 2))) == n, f"degree 2, {share} of the energy")
        soft = ["--set", "Concrete/Young's modulus=12 GPa"]
        expect(len(warned(*cohesive("1 MPa", 2 * share * energy), *soft)) == n, f"12 GPa, {share} of the energy")
    expect(warned(*cohesive("2 MPa", "150 N/m"), "--set", "Joints/Overrides=1: FJA, 2: FJA") == [], "no cohesive joint")
    # Each kind of joint by its name, and joints by their numbers.
    others = [x for entry in ("Mesh/Source=arch210", "Mesh/File=", "Mesh/Arch210/Joints=3", "Mesh/Arch210/Base joint=true", "Mesh/Arch210/Lift joints=1",
                              "Joints/Strength=2 MPa", "Joints/Fracture energy=150") for x in ("--set", entry)]
    for chosen, n in (("base: cohesive", 1), ("lift: cohesive", 1), ("contraction: cohesive", 1), ("base 2: cohesive", 1), ("3: cohesive", 1),
                      ("lift 2.1: cohesive", 1), ("1: FJB", 0)):
        expect(len(warned(*others, "--set", f"Joints/Overrides={chosen}")) == n, f"warnings with {chosen}")


if __name__ == "__main__":
    run_cases(limits, energy, numbers, entries)
