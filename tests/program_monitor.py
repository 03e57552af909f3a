#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: what becomes unstable is refused, or seen and stopped; balances; warnings of joints.

    program_monitor.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import re
from pathlib import Path

from run_program import expect, refused, run_cases, runs, settings, summary, table, voussoir, write_scene

ROCK = [x for e in ("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                    "Dynamics/Steps per sample=5", "Joints/Model=tied", "Motion/Duration=0.3",
                    "Output/Envelope interval=0") for x in ("--set", e)]


def layers():
    """mtf4 needs 9 layers: with 6 it took a tied dam to 6 km, with status 0; with 8 it grows at bent elements (test_boundary_stability)."""
    write_scene()
    for n in (6, 8):
        refused(["scene.prm", "--output", "few", *ROCK, *settings("Foundation/Boundary=mtf4", f"Mesh/Arch210/Rock/Boundary layers={n}")],
                "mtf4", "9 layers", "Mesh/Arch210/Rock/Boundary layers", "mtf3")
    nine = settings("Foundation/Boundary=mtf4", "Mesh/Arch210/Rock/Boundary layers=9", "Motion/Duration=1")
    runs("scene.prm", "--output", "nine", *ROCK, *nine)
    names, rows = table("nine/history.csv")
    crest = max(abs(row[names.index("crest_x")]) for row in rows)
    print(f"    mtf4 with 9 layers: crest at most {crest} m")
    expect(.05 < crest < 1., "mtf4 with 9 layers")
    runs("mesh", "scene.prm", "--output", "rock.msh", *ROCK)
    refused(["scene.prm", "--validate", *ROCK, *settings("Foundation/Boundary=mtf4", "Mesh/Source=file",
                                                         "Mesh/File=rock.msh")], "mtf4", "9 layers", "rock.msh")


def rock_checks():
    """What would grow at the boundary is refused before the run, with the damping that mends it."""
    write_scene()
    for boundary in ("mtf2", "mtf3"):
        high = settings(f"Foundation/Boundary={boundary}", "Foundation/Poisson's ratio=0.4",
                        "Foundation/Stiffness damping=0")
        near = settings("Dynamics/Steps per sample=3")  # 0.86 of the critical time step
        refused(["scene.prm", "--validate", *ROCK, *high, *near], boundary, "Poisson's ratio is 0.4", "grows by 0.",
                "Foundation/Stiffness damping", "1.66667e-05 s")
        runs("scene.prm", "--validate", *ROCK, *high, *near, *settings("Foundation/Stiffness damping=1.67e-5"))
        runs("scene.prm", "--validate", *ROCK, *high)  # 0.52 of the critical time step
    runs("scene.prm", "--validate", *ROCK, *settings("Foundation/Poisson's ratio=0.4", "Foundation/Stiffness damping=0",
                                                     "Foundation/Boundary=viscous-spring"))
    runs("scene.prm", "--validate", *ROCK, *settings("Foundation/Poisson's ratio=0.3", "Foundation/Stiffness damping=0"))
    gauss = settings("Foundation/Nodal quadrature everywhere=false", "Foundation/Boundary=mtf2")
    refused(["scene.prm", "--validate", *ROCK, *gauss, *settings("Foundation/Nodal layers=3")], "Gauss points",
            "Foundation/Nodal layers", "Foundation/Nodal quadrature everywhere")
    runs("scene.prm", "--validate", *ROCK, *gauss, *settings("Foundation/Nodal layers=6"))


def balance():
    """One definition of the balance in log, summary and figure (test_stability_monitor: what too large a one does)."""
    write_scene()
    runs("scene.prm", "--output", "sound", *ROCK, *settings("Joints/Model=FJA"))
    result, log = summary("sound"), Path("sound/log.txt").read_text()
    names, rows = table("sound/energy.csv")
    column = [abs(row[names.index("balance")]) for row in rows]
    error = max(column) / result["largest_energy"]
    print(f"    energy balance: {result['energy_balance_error']:.3e}; from energy.csv {error:.3e}")
    expect(abs(error / result["energy_balance_error"] - 1) < 1e-6, "balance of energy.csv and summary.json")
    shown = float(re.search(r"error of the energy balance (\S+) of", log)[1])
    expect(abs(shown / error - 1) < .06, f"balance in log.txt: {shown}")
    shown = float(re.search(r"energy balance of the rock (\S+)", log)[1])
    expect(abs(shown / result["rock"]["energy_balance_error"] - 1) < .06, f"balance of the rock in log.txt: {shown}")


def static_state():
    """Metres of static displacement are no matter of the impact rule."""
    write_scene()
    for model in ("FJA", "tied"):
        soft = ["scene.prm", "--output", "soft", *settings("Concrete/Young's modulus=21e6", f"Joints/Model={model}")]
        result = voussoir(*soft)
        expect("mean-force" not in result.stderr, result.stderr)
        refused(soft, "static state", "Concrete/Young's modulus", "Mesh/Length unit", "Reservoir")
    # On rock the log and the summary show the crest against the base, as history.csv does.
    runs("scene.prm", "--output", "rock", *ROCK)
    names, rows = table("rock/history.csv")
    first = [rows[0][names.index(f"crest_{c}")] for c in "xyz"]
    crest = summary("rock")["static"]["crest_displacement"]
    expect(all(abs(a - b) < 1e-7 for a, b in zip(first, crest)), f"crest: {first} in history, {crest} in summary")
    shown = float(re.search(r"crest (\S+) mm downstream of the base", Path("rock/log.txt").read_text())[1])
    expect(abs(shown - 1e3 * first[0]) < .051, f"crest in log: {shown}")
    expect(abs(rows[0][names.index("base_x")]) > 1e-3, "the base of a dam on rock moves under the water")


def joint_reach():
    """A joint that slips more than half an element is named, once."""
    write_scene()
    sound = runs("scene.prm", "--output", "sound")
    expect("warning: joint" not in sound, "no warning without reason")
    shown = re.findall("^warning: (.*)", sound, re.M)
    expect(shown and [w["text"] for w in summary("sound")["warnings"]] == shown, f"the summary has the warnings of the log: {shown}")
    # Three times the motion, almost no friction, and 16 thin elements through the dam.
    far = settings("Motion/Factor=3", "Joints/Friction=0.05", "Mesh/Arch210/Elements through=16")
    shown = runs("scene.prm", "--output", "far", *far)
    warnings = [w["text"] for w in summary("far")["warnings"] if w["text"].startswith("joint ")]
    print("   ", *warnings, sep="\n    ")
    expect(warnings and all("nodes no longer face" in w for w in warnings), f"{warnings}")
    expect(shown.count("warning: joint") == len(warnings) <= 2, "one warning for each joint, in the log too")


if __name__ == "__main__":
    run_cases(layers, rock_checks, balance, static_state, joint_reach)
