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
from run_program import expect, run_cases, runs, same_to_the_bit, settings, summary, table, write_scene  # noqa: E402

LIFTS = settings("Mesh/Arch210/Lift joints=2")
EXACT = settings("Dynamics/Factors=double")  # tests of round-off


def wall(file, monoliths, across, lifts, *, bottom=1, width=8., depth=4., height=3., named=True, shift=lambda i: 0, step=0, lowest=1):
    """A wall of blocks: monoliths of the width along y, each of lifts of the height, with one cell along y and two up per block.
    shift: number of rows by which the lifts of a monolith are higher. step: number of lifts below which the last monolith has no
    cells; it stands there. lowest: number of lifts that are one."""
    up = 2 * lifts
    place = lambda i, j, k: (depth * j / across, width * (i - monoliths / 2), height * k / 2)
    nodes, hexes, quads = meshes.block(place, tuple(range(1, monoliths + 1)), across, up,
                                       {"upstream": 2, "downstream": 3, "bottom": bottom, "top": 4})
    names, cells = {}, []
    for n, (monolith, corners) in enumerate(hexes):
        k = n % up
        lift = max(lowest, max(0, k - shift(monolith)) // 2 + 1) - lowest + 1
        if step and monolith == monoliths:
            if lift <= step:
                continue
            lift -= step
        volume = 100 * lift + monolith if named else monolith
        names[volume] = f"monolith {monolith} lift {lift}" if named else f"monolith {monolith}"
        cells.append((volume, corners))
    if step:
        used = {node for _, corners in cells for node in corners}
        quads = [(surface, corners) for surface, corners in quads if set(corners) <= used and surface != bottom]
        number = lambda i, j, k: (i * (across + 1) + j) * (up + 1) + k
        for i in range(monoliths):
            k = 2 * step if i == monoliths - 1 else 0
            quads += [(bottom, [number(i, j, k), number(i, j + 1, k), number(i + 1, j + 1, k), number(i + 1, j, k)]) for j in range(across)]
        place = sorted(used)
        new = {node: n for n, node in enumerate(place)}
        nodes = [nodes[node] for node in place]
        cells, quads = ([(tag, [new[node] for node in corners]) for tag, corners in list_] for list_ in (cells, quads))
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
    """Tied lift joints are concrete: the mesh without these lifts gives the same motion."""
    motion = pulse("pulse.txt", 4., (1, .5, .3), .1, .4, .005)
    for name, lifts, overrides, without in (("all", 2, "lift: tied", {"named": False}),
                                            ("some", 3, "lift 1.1: tied, lift 2.1: tied", {"lowest": 2})):
        for mesh, given in (("tied", {}), ("without", without)):
            wall(f"{name}_{mesh}.msh", 2, 2, lifts, **given)
            joints = {"Friction": .5, **({"Overrides": overrides} if mesh == "tied" else {})}
            entries = sections({"joints": joints, "young": 2e10, "Motion": motion})
            entries["Statics"]["Self-weight"] = "staged"
            runs(scene(f"{name}_{mesh}", f"{name}_{mesh}.msh", **entries), "--output", f"{name}_{mesh}")
        pairs = [summary(f"{name}_{mesh}")["mesh"]["pairs"] for mesh in ("tied", "without")]
        (names, one), (others, two) = (table(f"{name}_{mesh}/history.csv") for mesh in ("tied", "without"))
        largest = [max(abs(row[c]) for row in two) for c in range(len(names))]
        worst = max(abs(a - b) / scale for row, other in zip(one, two) for a, b, scale in zip(row, other, largest) if scale > 0)
        print(f"    {name}: largest difference {worst:.1e}, pairs {pairs}")
        expect(pairs[0] == pairs[1], f"{name}: numbers of pairs {pairs}")
        expect(names == others and len(one) == len(two) and worst < 1e-6, f"{name}: difference {worst}")


def stepped():
    """A monolith that stands on a step beside the upper lift of its neighbour."""
    wall("stepped.msh", 2, 2, 2, step=1)
    for name, more in (("stepped", {}), ("priority", {"Overrides": "1: tied, joint 1.2-1: FJB"})):
        entries = sections({"joints": {"Friction": .5, **more}, "young": 2e10, "Motion": pulse("pulse.txt", 4., (1, .5, .3), .1, .4, .005)})
        runs(scene(name, "stepped.msh", **entries), "--output", name, *EXACT)
        names = summary(name)["mesh"]["joint_names"]
        expect(names == ["joint 1", "lift 1.1", "joint 1.2-1"], f"joints {names}")
        no_energy_made(name)
    points, rows = table("priority/joint_points.csv")
    slips = {int(row[points.index("joint")]): row[points.index("max_slip")] for row in rows}
    opened = max(row[points.index("max_opening")] for row in rows if row[points.index("joint")] == 3)
    print(f"    joint 1.2-1, FJB by its name: opening {1e3 * opened:.3f} mm, slip {1e3 * slips[3]:.1e} mm")
    expect(opened > 1e-6, "the name of a part does not precede the number of its joint")


def cross():
    """Blocks that only contact holds settle, shake, and come to rest; where joints cross, no step is reduced."""
    motion = pulse("pulse.txt", 5., (1, .6, -.4), .15, 4., .005)
    for name, bottom, shift in (("straight", 1, lambda i: 0), ("staggered", 1, lambda i: i % 2), ("loose", 7, lambda i: 0)):
        wall(f"{name}.msh", 3, 2, 3, bottom=bottom, shift=shift)
        entries = sections({"joints": {"Friction": .6}, "young": 2e10, "Motion": motion, "Damping": {"Ratio": .05}})
        runs(scene(name, f"{name}.msh", **entries), "--output", name, *EXACT)
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
                       ("water", settings("Reservoir/Model=acoustic", "Dynamics/Steps per sample=4", "Motion/Duration=0.2")),
                       ("stages", settings("Statics/Stages=grout 100, fill 150", "Motion/Duration=0.2"))):
        shown = runs("scene.prm", "--output", name, *ARCH, *LIFTS, *more)
        expect("lift joints" in shown, shown[:800])
        result = summary(name)
        opening = 1e3 * result["extremes"]["max_opening"]["value"]
        print(f"    {name}: largest opening {opening:.3f} mm, energy balance {no_energy_made(name):.1e}, {result['contact_path']}")
        expect(result["contact_path"]["smaller_step"] == 0, "reduced steps")
    linear = summary("base")["newton_iterations"]["linear_iterations_mean"]
    print(f"    base: {linear:.2f} linear iterations per step")
    expect(linear < 7.15, "the ends of contraction joints on the base are no clusters")  # 7.55
    names, rows = table("lifts/joint_points.csv")
    heights = {}
    for row in rows:
        joint = summary("lifts")["mesh"]["joint_names"][int(row[names.index("joint")]) - 1]
        if joint.startswith("lift"):
            heights.setdefault(joint.split(".")[1], set()).add(round(row[names.index("z")], 6))
    expect(heights == {"1": {140.}}, f"lift joints at the heights {heights}")
    shown = runs("scene.prm", "--output", "probe", "--validate", *ARCH, *LIFTS, *settings("Joints/Overrides=lift 2.1: tied, joint 2.2: FJB, 1: tied"))
    expect("lift 2.1: tied" in shown, shown)
    # All lift joints are tied, and one part of a contraction joint: the other parts open.
    runs("scene.prm", "--output", "part", *ARCH, *LIFTS, *settings("Joints/Overrides=lift: tied, joint 2.2: tied", "Motion/Duration=0.5"))
    expect("joint 2.2" in summary("part")["mesh"]["joint_names"], "the tied part is no part any more")
    # Every monolith that is high enough has the joint, also where its height has a round-off.
    shown = runs("scene.prm", "--output", "all", "--validate", *ARCH, *settings("Mesh/Arch210/Joints=11", "Mesh/Arch210/Lift joints=1",
                 "Mesh/Arch210/Elements along=24", "Mesh/Arch210/Elements up=20"))
    expect("6 lift joints" in shown, shown)
    # Where joints cross, a law has the entries that it reads, and no others.
    for name, more in (("keys", ()), ("keys_glued", ("Joints/Adhesion=2e5", "Joints/Tangential stiffness=1e10"))):
        runs("scene.prm", "--output", name, *ARCH, *LIFTS, *settings("Joints/Model=KSM", "Motion/Duration=0.3", *more))
    same_to_the_bit("keys", "keys_glued")
    choices = runs("scene", "scene.prm", "--choices", *ARCH, *LIFTS)
    expect("tied lift joints" in choices, choices)


if __name__ == "__main__":
    run_cases(stack, slide, tied, stepped, cross, arch)
