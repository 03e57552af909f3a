#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: shear keys (KSM) at their limits.

    program_keys.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
from pathlib import Path

from run_program import contact_program, run_cases, expect, refused, runs, same, same_to_the_bit, succeeds, summary, table, voussoir, write_scene

# Factors in double precision: tests of round-off
SHORT = [x for e in ("Motion/Duration=1", "Output/Envelope interval=0", "Joints/Model=KSM", "Dynamics/Factors=double") for x in ("--set", e)]


def keys(angle, *others):
    return [x for e in (f"Flank angle={angle}", *others) for x in ("--set", f"Joints/Keys/{e}")]


def tight():
    """Tight keys, on which earlier versions failed: every step by Newton's method alone, in few steps."""
    write_scene()
    for angle in (0, 20, 45, 60):
        for direction in ("both", "radial"):
            runs("scene.prm", "--output", "x", "--overwrite", *SHORT, *keys(angle, f"Direction={direction}"))
            result = summary("x")
            print(f"    {angle} degrees, {direction}: {result['newton_iterations']['max']} Newton steps at most, balance "
                  f"{result['energy_balance_error']:.1e}")
            path = result["contact_path"]
            expect(path["proximal"] == path["smaller_step"] == 0, f"Newton's method alone: {path}")
            expect(result["newton_iterations"]["max"] <= 20, "at most 20 Newton steps")
            expect(result["energy_balance_error"] < 1e-9, "energy balance")
    names, rows = table("x/energy.csv")
    seats = [row[names.index("joint_stored")] for row in rows]
    # Counted from the static state, in which they hold a little already.
    expect(max(seats) > 0. and min(seats) > -.01 * max(seats), f"the seats hold energy: {min(seats)} to {max(seats)} J")


def energies():
    """Each energy in its column: friction is that of faces and flanks alone, the seats' is apart from that of bonds."""
    write_scene()
    smooth = ["--set", "Joints/Friction=0", *keys(45, "Friction=0")]
    for name, *others in (("smooth", *smooth), ("rough", "--set", "Joints/Friction=0.3", *keys(30, "Friction=0.2")),
                          ("rigid_smooth", *smooth, *keys(45, "Seat compliance=0"))):
        runs("scene.prm", "--output", name, *SHORT, *others)
        names, rows = table(f"{name}/energy.csv")
        energy, size = {column: [row[names.index(column)] for row in rows] for column in names}, summary(name)["largest_energy"]
        friction, has_seats = energy["friction"], "rigid" not in name
        steps = [b - a for a, b in zip(friction, friction[1:])]
        print(f"    {name}: friction {friction[-1]:.4g} J, in a step at least {min(steps):.2g} J; impact {energy['impact'][-1]:.4g} J of {size:.4g} J")
        if "smooth" in name:
            expect(max(map(abs, friction)) < 1e-9 * size, f"friction without friction: {max(map(abs, friction))} J")
        else:
            expect(friction[-1] > 1e-3 * size and min(steps) > -1e-9 * size, f"friction never gives energy: {min(steps)} J in a step")
        expect("joint_fracture" not in names and ("joint_stored" in names or not has_seats), f"columns {names}")
        expect(not has_seats or energy["joint_stored"] == energy["bond"] and max(energy["bond"]) > 1e-6 * size, "the name of earlier versions")
        expect(summary(name)["energy_balance_error"] < 1e-9, "energy balance")
    runs("scene.prm", "--output", "both", *SHORT, "--set", "Joints/Overrides=2: cohesive", "--set", "Joints/Strength=5e5", "--set",
         "Joints/Fracture energy=200")
    names, rows = table("both/energy.csv")
    seats, bonds, both = ([row[names.index(column)] for row in rows] for column in ("joint_stored", "joint_fracture", "bond"))
    print(f"    at most {max(seats):.4g} J in seats, {max(bonds):.4g} J in bonds")
    expect(max(seats) > 0. < max(bonds) and all(abs(a + b - c) <= 1e-6 * (abs(a) + abs(b)) for a, b, c in zip(seats, bonds, both)), "seats and bonds")
    expect(min(bonds) >= 0., "bonds only take energy")


def rigid():
    """A seat of little compliance is a rigid one, where forces are unique: with friction they depend on the past."""
    write_scene()
    for name, compliance in (("rigid", "0"), ("stiff", "2e-12"), ("soft", "1e-9")):
        runs("scene.prm", "--output", name, *SHORT, *keys(0, "Clearance=0.002", "Friction=0", f"Seat compliance={compliance}"))
    same("rigid", "stiff", 1e-2, ("history",))
    opening = [summary(name)["extremes"]["max_slip"]["value"] for name in ("rigid", "stiff", "soft")]
    print("    largest slips [m]:", *opening)
    expect(abs(opening[1] / opening[0] - 1.) < 1e-2, "rigid and nearly rigid seats slip alike")
    expect(opening[2] > opening[0], "soft seats give")
    for name, clearances in (("each", "1: 2 mm, 2: 2 mm"), ("one", "1: 2 mm")):
        runs("scene.prm", "--output", name, *SHORT, *keys(0, "Clearance=0.05", "Friction=0", "Seat compliance=0", f"Clearances={clearances}"))
    same_to_the_bit("rigid", "each")
    expect(summary("one")["extremes"]["max_slip"]["value"] > opening[0], "the other joint has more play")


    refused(["scene.prm", "--output", "x", *SHORT, *keys(0, "Seat compliance=1e-15"), "--validate"],
            "Joints/Keys/Seat compliance")


def problems():
    """Any solver of frictional contact can check a step: one contact per surface."""
    write_scene()
    runs("scene.prm", "--output", "x", *SHORT, *keys(45), "--set", "Contact/Write problems=true", "--set",
         "Contact/Write interval=17")
    files = sorted(Path("x").rglob("problem-*.txt"))
    expect(len(files) > 3, f"problems: {len(files)}")
    refused(["scene.prm", "--validate", *SHORT, "--set", "Joints/Model=FJB", "--set", "Contact/Write problems=true"], "Coulomb friction")
    lines = contact_program(*files[:4], "--tolerance", "1e-9").stdout.splitlines()
    for line in lines:
        result = json.loads(line)
        print("    ", line[:160])
        expect(result["converged"], "solved")
        expect(result["contacts"] > summary("x")["mesh"]["pairs"], "more contacts than pairs")
    succeeds(contact_program(*files[:2], "--tolerance", "1e-9", "--write-fclib", "fclib"))
    again = succeeds(contact_program(*(Path("fclib", f"{file.stem}.hdf5") for file in files[:2]), "--tolerance", "1e-9")).splitlines()
    texts, converted = ([{k: x for k, x in json.loads(line).items() if k not in ("file", "seconds")} for line in some] for some in (lines[:2], again))
    expect(texts == converted, f"as FCLib files: {converted} instead of {texts}")


def branches():
    write_scene()
    text = voussoir("scene.prm", "--validate", *SHORT, *keys(60, "Friction=0")).stdout
    expect("two solutions" in text, "keys with two branches are warned of")
    text = voussoir("scene.prm", "--validate", *SHORT, *keys(60)).stdout
    expect("two solutions" not in text, "others are not")


if __name__ == "__main__":
    run_cases(tight, energies, rigid, problems, branches)
