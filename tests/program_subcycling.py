#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: rock at steps of its own ("Foundation/Substeps" above 1, coupled by mean tractions).

    program_subcycling.py VOUSSOIR CASE...     cases: see the functions with that name below
"""


from run_program import expect, run_cases, runs, same, settings, summary, table, write_scene

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


if __name__ == "__main__":
    run_cases(laws, joints, halved, accuracy, threads)
