#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: monoliths on massless rock, which is a body of its own.

    program_massless.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import signal
import subprocess
import time
from pathlib import Path

import run_program
from program_watch import settings
from run_program import expect, run_cases, runs, same, same_to_the_bit, summary, table, write_scene

MASSLESS = settings("Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                    "Motion/Duration=1", "Output/Figures=false", "Contact/Tolerance=1e-12")
SUSTAINED = ("Concrete/Sustained modulus=14e9", "Foundation/Sustained modulus=9e9")
ONE_BODY = settings("Contact/Write problems=true")  # these have the operator of the joints whole


def column(directory, *names):
    header, rows = table(f"{directory}/energy.csv")
    return [sum(row[header.index(name)] for name in names) for row in rows]


def one_body():
    """Monoliths that stand on the rock's compliance move as they do in one body with the rock: static state with water in
    open joints and in stages, motion, joints, forces on the bases, and energies, the rock's included."""
    write_scene()
    for name, entries in (("FJA", ("Joints/Model=FJA", "Loads/Uplift/Joints=true", "Statics/Stages=grout 50, fill 60, grout 300")),
                          ("KSM", ("Joints/Model=KSM", "Dynamics/Error estimate=true", *SUSTAINED))):
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
    estimates = [summary(f"KSM_{which}")["error_estimate"] for which in ("own", "one")]
    print(f"    estimates {estimates}")
    for key, value in estimates[1].items():
        expect(abs(estimates[0][key] - value) <= 1e-5 * abs(value), f"estimate of the time error: {key}")


def halved():
    """Steps that the joints ask to halve, of the rock, too: the accounts of both close."""
    write_scene()
    runs("scene.prm", "--output", "halved", *MASSLESS, *settings(
        "Mesh/Arch210/Smallest height=0", "Motion/Duration=2", "Joints/Model=cohesive", "Joints/Strength=1 MPa", "Joints/Fracture energy=20",
        "Contact/Maximum iterations=30", "Dynamics/Steps per sample=1"))
    path = summary("halved")["contact_path"]
    print("   ", path)
    expect(path["smaller_step"] > 0, "no step was halved")
    expect(summary("halved")["energy_balance_error"] < 1e-8, "energy of the dam")
    balance = max(map(abs, column("halved", "rock_balance"))) / max(map(abs, column("halved", "rock_feet")))
    expect(balance < 1e-9, f"the rock's account closes to {balance:.1e}")


def resume():
    """Killed in the middle, it goes on as if it had not been."""
    write_scene()
    chosen = [*MASSLESS, *settings("Joints/Model=FJA", "Output/Checkpoint interval=20", "Dynamics/Error estimate=true", *SUSTAINED)]
    runs("scene.prm", "--output", "whole", *chosen)
    process = subprocess.Popen([run_program.VOUSSOIR, "scene.prm", "--output", "killed", *chosen], stdout=subprocess.DEVNULL)
    while process.poll() is None and not Path("killed", "checkpoint.txt").exists():
        time.sleep(.001)
    process.send_signal(signal.SIGKILL)
    expect(process.wait() == -signal.SIGKILL, "it ended before it could be killed")
    runs("scene.prm", "--output", "killed", *chosen, "--resume")
    same_to_the_bit("whole", "killed")


if __name__ == "__main__":
    run_cases(one_body, halved, resume)
