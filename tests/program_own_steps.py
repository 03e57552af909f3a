#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: rock at steps of its own ("Foundation/Substeps" above 1, coupled by mean tractions).

    program_own_steps.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import re
import signal
import subprocess
import time
from pathlib import Path

import run_program
from program_watch import settings
from run_program import expect, refused, run_cases, runs, same, same_to_the_bit, summary, table, write_scene

ROCK = settings("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                "Motion/Duration=1", "Output/Envelope interval=0", "Output/Figures=false")
OWN = [*ROCK, *settings("Foundation/Substeps=4", "Dynamics/Steps per sample=2")]


def closes(directory):
    """The accounts of dam and rock close, and the coupling neither gives nor takes energy."""
    expect(summary(directory)["energy_balance_error"] < 1e-8, f"energy of the dam in {directory}")
    expect(summary(directory)["rock"]["energy_balance_error"] < 1e-10, f"energy of the rock in {directory}")
    names, rows = table(f"{directory}/energy.csv")
    made, feet = (max(abs(row[names.index(name)]) for row in rows) for name in ("interface", "rock_feet"))
    print(f"    {directory}: work at the feet {feet:.3g} J, made by the coupling {made:.2g} J")
    expect(feet > 0. and made < 1e-9 * feet, f"the coupling makes {made} of {feet} J in {directory}")
    parts = [[row[names.index(name)] for name in ("rock_kinetic", "rock_strain", "rock_damping", "transmitted", "rock_feet")] for row in rows]
    missed, size = max(abs(sum(row[:4]) - row[4]) for row in parts), max(abs(x) for row in parts for x in row)
    expect(missed < 1e-7 * size, f"the columns of the rock's energies do not add up: {missed} J of {size} J in {directory}")  # of eight digits


def laws():
    """FJA, KSM, cohesive and tied joints; every joint problem solved by Newton's method."""
    write_scene()
    for law in ("FJA", "FJB", "KSM", "cohesive", "tied"):
        runs("scene.prm", "--output", law, *OWN, *settings(f"Joints/Model={law}"))
        closes(law)
        expect(summary(law)["contact_path"]["smaller_step"] == 0, f"halved steps of {law}")


def joints():
    """Five joints, of which the feet couple also those that share no monolith: what they open follows the law."""
    write_scene()
    runs("scene.prm", "--output", "five", *OWN, *settings("Mesh/Arch210/Joints=5", "Mesh/Arch210/Elements along=12",
                                                         "Mesh/Arch210/Elements up=5", "Joints/Model=FJA"))
    closes("five")
    names, rows = table("five/joint_history.csv")
    openings = [x for row in rows for name, x in zip(names, row) if "opening" in name]
    print(f"    openings from {min(openings)} to {max(openings)} m; Newton steps {summary('five')['newton_iterations']}")
    expect(max(openings) > 1e-4 and min(openings) > -1e-9 * max(openings), "joints do not overlap")
    expect(summary("five")["contact_residual"] < 1e-10, "residual")


def halved():
    """Steps of joints with rigid keys are halved, also an odd number of steps of the rock; the accounts close."""
    write_scene()
    for m in (4, 5):
        name = f"halved_{m}"
        runs("scene.prm", "--output", name, *ROCK, *settings(
            f"Foundation/Substeps={m}", "Dynamics/Steps per sample=1", "Motion/Duration=2", "Motion/Factor=1",
            "Joints/Model=KSM", "Joints/Keys/Seat compliance=0", "Contact/Maximum iterations=15",
            "Mesh/Arch210/Smallest height=0", "Foundation/Layers at the dam=0"))  # a mesh on which the contact of some steps is not found
        print("   ", summary(name)["contact_path"])
        expect(summary(name)["contact_path"]["smaller_step"] > 0, f"no step was halved with m = {m}")
        closes(name)


def accuracy():
    """Four steps of the rock in one of the dam differ little from one step for all."""
    write_scene()
    runs("scene.prm", "--output", "fine", *ROCK, *settings("Dynamics/Steps per sample=8"))
    runs("scene.prm", "--output", "own", *OWN)
    crest = {}
    for name, every in (("fine", 4), ("own", 1)):
        names, rows = table(f"{name}/history.csv")
        crest[name] = [row[names.index("crest_x")] for row in rows][::every]
    size = sum(x * x for x in crest["fine"])
    off = (sum((x - y)**2 for x, y in zip(crest["own"], crest["fine"])) / size)**.5
    print(f"    crest off by {off}")
    expect(off < .002, f"crest off by {off}")  # 0.0010; 0.0033 if the earthquake is half a step early


def resume():
    """Killed in the middle, it goes on as if it had not been, to the last bit."""
    write_scene()
    for law in ("tied", "FJA"):
        whole, killed = f"whole_{law}", f"killed_{law}"
        chosen = [*OWN, *settings(f"Joints/Model={law}", "Output/Checkpoint interval=20")]
        runs("scene.prm", "--output", whole, *chosen)
        process = subprocess.Popen([run_program.VOUSSOIR, "scene.prm", "--output", killed, *chosen],
                                   stdout=subprocess.DEVNULL)
        while process.poll() is None and not Path(killed, "checkpoint.txt").exists():
            time.sleep(.001)
        process.send_signal(signal.SIGKILL)
        expect(process.wait() == -signal.SIGKILL, "it ended before it could be killed")
        runs("scene.prm", "--output", killed, *chosen, "--resume")
        same_to_the_bit(whole, killed)


def threads():
    """The same to the last bit for any number of threads; the static state is that of tied feet."""
    write_scene()
    for n in ("1", "2"):
        runs("scene.prm", "--output", f"threads_{n}", *OWN, *settings("Joints/Model=FJA"), environment={"OMP_NUM_THREADS": n})
    same("threads_1", "threads_2", 0., ("history", "joint_history", "energy"))
    crest = []
    for coupling, m in (("auto", 4), ("partition", 1)):
        runs("scene.prm", "--output", coupling, *ROCK, *settings(
            "Dynamics/Steps per sample=2", f"Foundation/Substeps={m}", "Motion/Source=none", f"Foundation/Coupling={coupling}",
            "Joints/Model=FJA"))
        crest.append(summary(coupling)["static"]["crest_displacement"][0])
    print(f"    crest under water {crest} m")
    expect(abs(crest[0]) > 1e-4 and abs(crest[0] / crest[1] - 1.) < 1e-7, f"static state: {crest}")


def entries():
    """What does not fit is refused before the run; --validate names the coupling."""
    write_scene()
    expect("mean tractions" in runs("scene.prm", "--validate", *OWN), "--validate names the coupling")
    expect("mean tractions" not in runs("scene.prm", "--validate", *ROCK, *settings("Dynamics/Steps per sample=8")),
           "one step for all is the partition")
    refused(["scene.prm", "--validate", *OWN, *settings("Dynamics/Impact=paper")], "mean-force", "Dynamics/Impact")
    for coupling, m in (("auto", 4), ("partition", 1)):
        refused(["scene.prm", "--validate", *ROCK, *settings("Contact/Write problems=true", f"Foundation/Coupling={coupling}",
                                                             f"Foundation/Substeps={m}")], "Foundation/Model")
    refused(["scene.prm", "--validate", *ROCK, *settings("Foundation/Substeps=50", "Dynamics/Steps per sample=1")],
            "layers", "Foundation/Substeps")
    large = settings("Foundation/Substeps=1", "Dynamics/Steps per sample=1")
    refused(["scene.prm", "--validate", *ROCK, *large], "Steps per sample", "\"Foundation/Substeps\" to")
    for other in ("Dynamics/Impact=paper", "Foundation/Coupling=partition"):  # these exclude substeps
        message = refused(["scene.prm", "--validate", *ROCK, *large, *settings(other)], "Steps per sample")
        expect("Substeps" not in message and "Coupling" not in message, message)
    near = [*ROCK, *settings("Mesh/Arch210/Joints=2", "Mesh/Arch210/Elements along=9", "Mesh/Arch210/Elements up=4", "Mesh/Arch210/Elements through=2",
                             *(f"Mesh/Arch210/Rock/{side}=100" for side in ("Upstream", "Downstream", "Sides", "Depth")))]
    shown = runs("scene.prm", "--validate", *near, *settings("Foundation/Substeps=0", "Dynamics/Steps per sample=1"))
    steps = int(re.search(r"(\d+) rock steps", shown).group(1))  # the boundary requires more of them than the critical time step
    refused(["scene.prm", "--validate", *near, *settings(f"Foundation/Substeps={steps - 1}", "Dynamics/Steps per sample=1")],
            "artificial boundary", "node spacing", f"\"Foundation/Substeps\" to {steps}")


if __name__ == "__main__":
    run_cases(laws, joints, halved, accuracy, resume, threads, entries)
