#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: shear keys (KSM) at their limits.

    program_keys.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
from pathlib import Path

from run_program import run_cases, expect, refused, runs, same, summary, table, voussoir, write_scene

SHORT = [x for e in ("Motion/Duration=1", "Output/Envelope interval=0", "Joints/Model=KSM") for x in ("--set", e)]


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
    seats = [row[names.index("bond")] for row in rows]
    # Counted from the static state, in which they hold a little already.
    expect(max(seats) > 0. and min(seats) > -.01 * max(seats), f"the seats hold energy: {min(seats)} to {max(seats)} J")


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


    refused(["scene.prm", "--output", "x", *SHORT, *keys(0, "Seat compliance=1e-15"), "--validate"],
            "Joints/Keys/Seat compliance")


def problems():
    """Any solver of frictional contact can check a step: one contact per surface."""
    write_scene()
    runs("scene.prm", "--output", "x", *SHORT, *keys(45), "--set", "Contact/Write problems=true", "--set",
         "Contact/Write interval=17")
    files = sorted(Path("x").rglob("problem-*.hdf5"))
    expect(len(files) > 3, f"problems: {len(files)}")
    lines = voussoir("contact", *files[:4], "--tolerance", "1e-9").stdout.splitlines()
    for line in lines:
        result = json.loads(line)
        print("    ", line[:160])
        expect(result["converged"], "solved")
        expect(result["contacts"] > summary("x")["mesh"]["pairs"], "more contacts than pairs")


def branches():
    write_scene()
    text = voussoir("scene.prm", "--validate", *SHORT, *keys(60, "Friction=0")).stdout
    expect("two solutions" in text, "keys with two branches are warned of")
    text = voussoir("scene.prm", "--validate", *SHORT, *keys(60)).stdout
    expect("two solutions" not in text, "others are not")


if __name__ == "__main__":
    run_cases(tight, rigid, problems, branches)
