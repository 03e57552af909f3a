#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: monoliths on massless rock, which is a body of its own.

    program_massless.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import re

from run_program import expect, read_mesh, refused, run_cases, runs, same, settings, stop_and_resume, summary, table, write_mesh, write_scene

MASSLESS = settings("Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                    "Motion/Duration=1", "Output/Figures=false", "Contact/Tolerance=1e-12")
SUSTAINED = ("Concrete/Sustained modulus=14e9", "Foundation/Sustained modulus=9e9")
ONE_BODY = settings("Contact/Write problems=true", "Dynamics/Factors=double")  # these have the operator of the joints whole


def monoliths():
    """A tied dam of monoliths on rock moves as the same mesh with one monolith: its displacements are relative to base nodes that count once."""
    write_scene()
    # A joint and free columns stand on the level bottom of the valley.
    common = [*MASSLESS, *settings("Joints/Model=tied", "Dynamics/Factors=double", "Motion/Duration=0.1", "Mesh/Arch210/Joints=3", "Mesh/Arch210/Elements along=24")]
    runs("mesh", "scene.prm", "--output", "parts.msh", "--format", "2.2", *common)
    mesh = read_mesh("parts.msh")
    mesh["elements"] = [(kind, 1 if kind == 5 and tag < 1000 else tag, corners) for kind, tag, corners in mesh["elements"]]
    head = [line for line in mesh["head"] if not re.match(r'3 \d+ "monolith', line) or line.endswith('"monolith 1"')]
    place = head.index("$PhysicalNames") + 1
    head[place] = str(len(head) - place - 2)
    mesh["head"] = head
    write_mesh("one.msh", mesh)
    runs("scene.prm", "--output", "parts", *common)
    runs("scene.prm", "--output", "one", *common, *settings("Mesh/Source=file", "Mesh/File=one.msh"))
    (titles, a), (others, b) = table("parts/history.csv"), table("one/history.csv")
    for title in ("crest_x", "crest_y", "crest_z"):
        x, y = ([row[names.index(title)] for row in rows] for names, rows in ((titles, a), (others, b)))
        off = max(abs(p - q) for p, q in zip(x, y)) / max(map(abs, x))
        expect(len(x) == len(y) and off < 1e-6, f"{title} of monoliths and of one body differ by {off}")


def column(directory, *names):
    header, rows = table(f"{directory}/energy.csv")
    return [sum(row[header.index(name)] for name in names) for row in rows]


def one_body():
    """Monoliths that stand on the rock's compliance move as they do in one body with the rock: static state with water in
    open joints and in stages, motion, joints, forces on the bases, and energies, the rock's included."""
    write_scene()
    for name, entries in (("FJA", ("Joints/Model=FJA", "Loads/Uplift/Joints=true", "Statics/Stages=grout 50, fill 60, grout 300")),
                          ("KSM", ("Joints/Model=KSM", *SUSTAINED))):
        both = [f"{name}_{which}" for which in ("own", "one")]
        for directory, more in zip(both, ([], ONE_BODY)):
            runs("scene.prm", "--output", directory, *MASSLESS, *settings(*entries), *more)
            expect(summary(directory)["energy_balance_error"] < 1e-8, f"energy of {directory}")
        same(*both, 1e-9, ("history", "blocks"))
        (names, own), (_, one) = (table(f"{directory}/joint_history.csv") for directory in both)
        size = max(abs(x) for row in one for x in row[1:])  # of all joints: some hardly move
        off = max(abs(x - y) for a, b in zip(own, one) for x, y in zip(a, b)) / size
        print(f"    {name}: openings and slips up to {size:.3g} m, off by {off:.1e} of that")
        expect(names[0] == "time" and len(own) == len(one) and off < 1e-8, f"joints of {name} differ")  # Contact/Tolerance
        for whole, parts in (("strain", ("strain", "rock_strain")), ("damping", ("damping", "rock_damping")),
                             ("kinetic", ("kinetic",)), ("friction", ("friction",))):
            a, b = column(both[0], *parts), column(both[1], whole)
            size = max(map(abs, b))
            off = max(abs(x - y) for x, y in zip(a, b)) / size
            print(f"    {name}: {whole} {size:.3g} J, off by {off:.1e}")
            expect(off < 1e-7, f"{whole} of {name} differs")
        share = max(map(abs, column(both[0], "rock_strain"))) / max(map(abs, column(both[0], "strain")))
        expect(.01 < share < 10., f"the rock's strain energy is {share} of the dam's")
        balance = max(map(abs, column(both[0], "rock_balance"))) / max(map(abs, column(both[0], "rock_feet")))
        print(f"    {name}: the rock's account closes to {balance:.1e}")
        expect(balance < 1e-9, "the rock's account")


def halved():
    """Steps that the joints ask to halve, of the rock, too: the accounts of both close."""
    write_scene()
    runs("scene.prm", "--output", "halved", *MASSLESS, *settings(
        "Mesh/Arch210/Smallest height=0", "Motion/Duration=1.5", "Joints/Model=KSM", "Joints/Keys/Seat compliance=0",
        "Contact/Maximum iterations=15", "Dynamics/Steps per sample=1"))
    path = summary("halved")["contact_path"]
    print("   ", path)
    expect(path["smaller_step"] > 0, "no step was halved")
    expect(summary("halved")["energy_balance_error"] < 1e-8, "energy of the dam")
    balance = max(map(abs, column("halved", "rock_balance"))) / max(map(abs, column("halved", "rock_feet")))
    expect(balance < 1e-9, f"the rock's account closes to {balance:.1e}")


def records(**files):
    """Writes records of 1 s: name -> factor of three smooth components, from rest to rest."""
    from math import pi, sin
    for name, factor in files.items():
        with open(name + ".txt", "w", encoding="ascii") as file:
            for k in range(101):
                t = .01 * k
                print(t, *(factor * sin(pi * t) ** 2 * sin(w * t + p) for w, p in ((17, 0), (23, 1), (29, 2))), file=file)


def abutments():
    """Different motions of the banks. Equal records at the banks and no motion of the base are the uniform motion: the dam is
    strained alike, but for the discretisation of the ground's displacement, which is of second order. One body and monoliths on
    the rock agree. The rock's account closes, and a killed run goes on as if it had not been."""
    write_scene()
    records(strong=.6, still=0, other=.9)
    bottom = 0  # all base nodes are at or above it
    damping = settings("Damping/Frequency 1=1e-6", "Joints/Model=FJA", "Motion/Source=file", "Motion/Duration=-1", "Motion/Unit=m/s^2")
    off = []
    for steps in (2, 4):
        common = [*MASSLESS, *damping, *settings(f"Dynamics/Steps per sample={steps}")]
        runs("scene.prm", "--output", f"uniform{steps}", *common, "--set", "Motion/File=strong.txt")
        banks = f"Motion/Abutments=right {bottom}: strong.txt; left {bottom}: strong.txt"
        runs("scene.prm", "--output", f"banks{steps}", *common, "--set", "Motion/File=still.txt", "--set", banks)
        names, a = table(f"uniform{steps}/joint_history.csv")
        _, b = table(f"banks{steps}/joint_history.csv")
        size = max(abs(x) for row in a for x in row[1:])
        off.append(max(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q)) / size)
        expect(size > 1e-4, f"the joints hardly move: {size} m")
        expect(summary(f"banks{steps}")["energy_balance_error"] < 1e-8, "energy of the dam")
        balance = max(map(abs, column(f"banks{steps}", "rock_balance"))) / max(map(abs, column(f"banks{steps}", "rock_feet")))
        expect(balance < 1e-9, f"the rock's account closes to {balance:.1e}")
    print(f"    openings and slips differ by {off[0]:.1e} and, with half the step, {off[1]:.1e}")
    expect(off[1] < 1e-3 and off[1] < .35 * off[0], f"not of second order: {off}")
    different = [*MASSLESS, *damping, *settings("Motion/File=strong.txt", "Motion/Abutments=right 120: other.txt; left 90: other.txt; "
                                                "left 200: strong.txt", "Dynamics/Steps per sample=2")]
    runs("scene.prm", "--output", "own", *different)
    runs("scene.prm", "--output", "one", *different, *ONE_BODY)
    (_, own), (_, one) = (table(f"{directory}/joint_history.csv") for directory in ("own", "one"))
    size = max(abs(x) for row in one for x in row[1:])
    apart = max(abs(x - y) for a, b in zip(own, one) for x, y in zip(a, b)) / size
    print(f"    one body: off by {apart:.1e} of {size:.3g} m")
    expect(apart < 1e-4, "one body and monoliths on the rock differ")
    changed = table("uniform2/joint_history.csv")[1]
    expect(max(abs(x - y) for a, b in zip(own, changed) for x, y in zip(a, b)) > .05 * size, "the banks do not matter")
    for directory, more in (("own", []), ("one", ONE_BODY)):
        stop_and_resume(directory, [*different, *more, *settings("Output/Checkpoint interval=20")])
    refused(["scene.prm", *different, "--set", "Foundation/Model=rigid"], "Motion/Abutments", "massless", "one body")
    refused(["scene.prm", *different, "--set", "Motion/Abutments=middle 3: other.txt"], "middle 3", "right 95")
    refused(["scene.prm", *different, "--set", "Motion/Abutments=left 3: nowhere.txt"], "nowhere.txt")


if __name__ == "__main__":
    run_cases(one_body, monoliths, halved, abutments)
