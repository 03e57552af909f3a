#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of lift joints: stacked, sliding and crossing blocks against closed forms; an arch dam with lifts on its base joint.

    program_lift.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes  # noqa: E402
from compare import scene  # noqa: E402
from program_base import ARCH, BASE, G, RIGID, pulse, sections  # noqa: E402
from program_physics import settings  # noqa: E402
import run_program  # noqa: E402
from run_program import expect, refused, run_cases, runs, same_to_the_bit, summary, table, write_scene  # noqa: E402

LIFTS = settings("Mesh/Arch210/Lift joints=2")


def wall(file, monoliths, across, lifts, *, bottom=1, width=8., depth=4., height=3., named=True, shift=lambda i: 0):
    """A wall of blocks: monoliths of the width along y, each of lifts of the height, with one cell along y and two up per block.
    shift: number of rows by which the lifts of a monolith are higher."""
    up = 2 * lifts
    place = lambda i, j, k: (depth * j / across, width * (i - monoliths / 2), height * k / 2)
    nodes, hexes, quads = meshes.block(place, tuple(range(1, monoliths + 1)), across, up,
                                       {"upstream": 2, "downstream": 3, "bottom": bottom, "top": 4})
    names, cells = {}, []
    for n, (monolith, corners) in enumerate(hexes):
        k = n % up
        lift = max(0, k - shift(monolith)) // 2 + 1
        volume = 100 * lift + monolith if named else monolith
        names[volume] = f"monolith {monolith} lift {lift}" if named else f"monolith {monolith}"
        cells.append((volume, corners))
    meshes.write(file, nodes, cells, quads, volumes=names)


def rows_by_joint(name, quantity):
    names, rows = table(f"{name}/joint_pressures.csv")
    return {int(row[names.index("joint")]): row[names.index(quantity)] for row in rows}


def no_energy_made(name, limit=1e-9):
    error = summary(name)["energy_balance_error"]
    expect(error < limit, f"{name}: energy balance {error:.1e}")
    names, rows = table(f"{name}/energy.csv")
    lost = [row[names.index("friction")] + row[names.index("impact")] for row in rows]
    expect(min(b - a for a, b in zip(lost, lost[1:])) >= -1e-9 * max(lost), f"{name}: energy from the joints")
    return error


def stack():
    """Each lift joint of a tower carries the weight above it, with monolithic and with staged self-weight."""
    wall("tower.msh", 1, 4, 3)
    for weight in ("monolithic", "staged"):
        entries = sections({"joints": {"Friction": .5}, "young": 2e10})
        entries["Statics"]["Self-weight"] = weight
        runs(scene(weight, "tower.msh", **entries), "--output", weight)
        names = summary(weight)["mesh"]["joint_names"]
        expect(names == ["lift 1.1", "lift 1.2"], f"joints {names}")
        carried = rows_by_joint(weight, "mean_pressure")
        for joint, lifts_above in ((1, 2), (2, 1)):
            exact = 2400 * G * 3. * lifts_above
            print(f"    {weight}: {names[joint - 1]} carries {carried[joint]:.1f} Pa, by hand {exact:.1f} Pa")
            expect(abs(carried[joint] / exact - 1) < 1e-7, f"{weight}: pressure {carried[joint]} Pa instead of {exact} Pa")


def slide():
    """A rigid lift slides on the lift below after a rectangular pulse."""
    mu, duration = .4, .2
    peak = 1.5 * G * mu
    exact = (peak - G * mu) * duration**2 / 2 * peak / (G * mu)
    wall("two.msh", 1, 6, 2, depth=12., height=2.5)
    motion = pulse("pulse.txt", -peak, (1, 0, 0), duration, 1.2, .002)
    runs(scene("slide", "two.msh", **sections({"joints": {"Friction": mu}, "young": RIGID, "Motion": motion})), "--output", "slide")
    names, rows = table("slide/joint_points.csv")
    slips = [row[names.index("residual_slip")] for row in rows]
    print(f"    slip {exact:.5f} m, error {max(slips) / exact - 1:.1e}")
    expect(abs(max(slips) / exact - 1) < 2e-3 and max(slips) - min(slips) < 1e-6 * exact, f"slips {min(slips)} to {max(slips)} m")
    no_energy_made("slide", 1e-7)


def tied():
    """Tied lift joints are concrete: the mesh without lifts gives the same motion."""
    motion = pulse("pulse.txt", 4., (1, .5, .3), .1, .4, .005)
    for named in (True, False):
        wall(f"{named}.msh", 2, 2, 2, named=named)
        given = {"joints": {"Friction": .5, **({"Overrides": "lift: tied"} if named else {})}, "young": 2e10, "Motion": motion}
        entries = sections(given)
        entries["Statics"]["Self-weight"] = "staged"
        runs(scene(f"tied{named}", f"{named}.msh", **entries), "--output", f"tied{named}")
    pairs = [summary(f"tied{named}")["mesh"]["pairs"] for named in (True, False)]
    expect(pairs[0] == pairs[1], f"numbers of pairs: {pairs}")
    (names, one), (others, two) = (table(f"tied{named}/history.csv") for named in (True, False))
    largest = [max(abs(row[c]) for row in two) for c in range(len(names))]
    worst = max(abs(a - b) / scale for row, other in zip(one, two) for a, b, scale in zip(row, other, largest) if scale > 0)
    print(f"    largest difference {worst:.1e}")
    expect(names == others and len(one) == len(two) and worst < 1e-8, f"difference {worst}")


def cross():
    """Blocks that only contact holds settle, shake, and come to rest; where joints cross, no step is reduced."""
    motion = pulse("pulse.txt", 5., (1, .6, -.4), .15, 4., .005)
    for name, bottom, shift in (("straight", 1, lambda i: 0), ("staggered", 1, lambda i: i % 2), ("loose", 7, lambda i: 0)):
        wall(f"{name}.msh", 3, 2, 3, bottom=bottom, shift=shift)
        entries = sections({"joints": {"Friction": .6}, "young": 2e10, "Motion": motion, "Damping": {"Ratio": .05}})
        runs(scene(name, f"{name}.msh", **entries), "--output", name)
        result = summary(name)
        names = result["mesh"]["joint_names"]
        error, path, rest = no_energy_made(name), result["contact_path"], result["end_kinetic_energy"]
        opening = result["extremes"]["max_opening"]["value"]
        print(f"    {name}: {len(names)} joints, opening {1e3 * opening:.2f} mm, energy balance {error:.1e}, at the end {rest:.1e} of the energy, {path}")
        expect(path["smaller_step"] == 0, f"reduced steps: {path}")
        expect(opening > 1e-4, "no joint opens")
        expect(rest < 1e-3, f"{name} moves at the end: {rest}")
        wanted = {"straight": {"joint 1", "joint 1.2", "joint 2.3", "lift 3.2"}, "staggered": {"joint 1.1-2", "joint 2.2", "lift 2.2"},
                  "loose": {"base 1", "base 3", "lift 1.1"}}[name]
        expect(wanted <= set(names), f"{name}: joints {names}")


def arch():
    """An arch dam with lifts on its base joint; the base carries what the bonded base of the dam without lifts carries."""
    write_scene()
    for name, more in (("lifts", ()), ("base", BASE), ("bond", settings("Joints/Overrides=lift: cohesive", "Joints/Strength=1 MPa", "Motion/Duration=0.5")),
                       ("tied", settings("Joints/Overrides=contraction: tied")),
                       ("stages", settings("Statics/Stages=grout 100, fill 150", "Motion/Duration=0.2"))):
        shown = runs("scene.prm", "--output", name, *ARCH, *LIFTS, *more)
        expect("lift joints" in shown, shown[:800])
        result = summary(name)
        opening = 1e3 * result["extremes"]["max_opening"]["value"]
        print(f"    {name}: largest opening {opening:.3f} mm, energy balance {no_energy_made(name):.1e}, {result['contact_path']}")
        expect(result["contact_path"]["smaller_step"] == 0, "reduced steps")
    names, rows = table("lifts/joint_points.csv")
    heights = {}
    for row in rows:
        joint = summary("lifts")["mesh"]["joint_names"][int(row[names.index("joint")]) - 1]
        if joint.startswith("lift"):
            heights.setdefault(joint.split(".")[1], set()).add(round(row[names.index("z")], 6))
    expect(heights == {"1": {140.}}, f"lift joints at the heights {heights}")
    shown = runs("scene.prm", "--output", "probe", "--validate", *ARCH, *LIFTS, *settings("Joints/Overrides=lift 2.1: tied, joint 2.2: FJB, 1: tied"))
    expect("lift 2.1: tied" in shown, shown)
    choices = runs("scene", "scene.prm", "--choices", *ARCH, *LIFTS)
    expect("tied lift joints" in choices, choices)


def resume():
    """Two threads, and a run that goes on from its checkpoint, give the same bits."""
    write_scene()
    more = [*ARCH, *LIFTS, *settings("Motion/Duration=0.6", "Output/Checkpoint interval=20", "Output/Progress interval=10")]
    runs("scene.prm", "--output", "whole", *more)
    runs("scene.prm", "--output", "threads", *more, environment={"OMP_NUM_THREADS": "2"})
    same_to_the_bit("whole", "threads")
    run_program.interrupted("scene.prm", "parts", *more)
    runs("scene.prm", "--resume", "--output", "parts", *more)
    same_to_the_bit("whole", "parts")


def refusals():
    """Lift joints where they cannot be, and names that are wrong."""
    write_scene()
    refused(["scene.prm", *ARCH, *LIFTS, *settings("Foundation/Model=massless")], "lift joints", "rigid", "lift: tied")
    refused(["scene.prm", *ARCH, *LIFTS, *settings("Joints/Model=KSM")], "KSM", "keys")
    refused(["scene.prm", *ARCH, *LIFTS, *settings("Dynamics/Impact=paper")], "mean-force")
    refused(["scene.prm", *ARCH, *LIFTS, *settings("Joints/Overrides=lift 2.7: tied")], "lift 2.7")
    refused(["scene.prm", *ARCH, *settings("Mesh/Arch210/Lift joints=6")], "Lift joints", "6 rows")
    wall("gap.msh", 1, 2, 3)
    text = Path("gap.msh").read_text().replace("lift 3", "lift 4")
    Path("gap.msh").write_text(text)
    refused([scene("gap", "gap.msh", **sections({"joints": {}}))], "lifts of monolith 1", "gaps")


if __name__ == "__main__":
    run_cases(stack, slide, tied, cross, arch, resume, refusals)
