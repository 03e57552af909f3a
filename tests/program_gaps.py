#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of gaps, grout pressure, saw cuts and the contact of ungrouted joints: two bars between fixed ends against closed forms,
which are in golden/grout_two_bars.csv and golden/saw_cut_bar.csv; an arch dam with gaps.

    program_gaps.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes  # noqa: E402
from compare import at_places, key, read_vtu, scene  # noqa: E402
from run_program import expect, run_cases, runs, settings, summary, table, write, write_scene  # noqa: E402

EXPANSION = 1e-5  # coefficient of thermal expansion [1/K]


def rows_of(name):
    """The rows of a table of closed forms by column; the stiffness inf is 0 (rigid)."""
    with open(GOLDEN / name) as file:
        return [{k: 0. if v == "inf" else float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def bars(name, length, modulus, temperatures, stages, *arguments, n_up=1, **joints):
    """Two bars of a length and 1 m x 5 m between fixed ends, with the temperatures of the days 0, 1 and 2; the last day is 2.
    Compression [Pa] and opening [m] of their joint at the end, and the rows of stages.csv by column."""
    def place(i, j, k):
        return (j, length * (i / 10 - 1), 5 * k / n_up)

    meshes.write("bars.msh", *meshes.block(place, 10 * (1,) + 10 * (2,), 1, n_up, {"right": 1, "left": 1, "upstream": 2, "downstream": 3, "top": 4}))
    write("days.csv", "day,upstream,downstream\n" + "".join(f"{day},{t:.17g},{t:.17g}\n" for day, t in enumerate(temperatures)))
    temperature = settings("Loads/Temperature/Table=days.csv", "Loads/Temperature/Day=2", f"Loads/Temperature/Expansion={EXPANSION}")
    model = {"Model": "FJA", **{k.replace("_", " "): v for k, v in joints.items()}}
    file = scene(name, "bars.msh", Joints=model, Concrete={"Young's modulus": modulus}, Statics={"Stages": stages})
    runs(file, "--output", name, *temperature, *arguments)
    names, rows = table(f"{name}/joint_pressures.csv")
    steps, values = table(f"{name}/stages.csv")
    return (rows[0][names.index("mean_pressure")], summary(name)["extremes"]["max_opening"]["value"], [dict(zip(steps, row)) for row in values])


def check(what, found, exact, size, limit=1e-6):
    expect(abs(found - exact) <= limit * size, f"{what} is {found}, not {exact}")


def grout():
    """Two bars whose joint is filled by grout under pressure, then cool: the table, with rigid and elastic joints."""
    for i, row in enumerate(rows_of("grout_two_bars.csv")):
        name, pressure, gap = f"grout{i}", row["grout_pressure_Pa"], row["initial_gap_m"]
        compression, opening, steps = bars(
            name, row["bar_length_m"], row["modulus_Pa"], (0, 0, -row["thermal_strain"] / EXPANSION),
            "day 0, grout 100" + (f" at {1e-6 * pressure} MPa" if pressure else ""), Normal_stiffness=row["joint_stiffness_Pa_per_m"],
            **({"Initial_gaps": f"1: {1e3 * gap} mm"} if gap else {}))
        # The faces move apart equally.
        set_at, end = (gap + 2 * abs(step["crest_y"]) for step in steps[-2:])
        check(f"{name}: opening when the grout sets", set_at, row["opening_when_grout_sets_m"], 1e-3)
        check(f"{name}: distance of the faces", end, row["distance_of_faces_m"], 1e-3)
        check(f"{name}: compression", compression, row["compression_after_cooling_Pa"], 1e6)
        check(f"{name}: gap", max(opening, 0.), max(row["gap_after_cooling_m"], 0.), 1e-3)
        names, pairs = table(f"{name}/joint_points.csv")
        for pair in (dict(zip(names, values)) for values in pairs):
            check(f"{name}: pressure of a pair", pair["static_pressure"], row["compression_after_cooling_Pa"], 1e6)
            check(f"{name}: distance at a pair", pair["static_distance"], row["distance_of_faces_m"], 1e-3)
            check(f"{name}: opening of a pair", max(pair["static_opening"], 0.), max(row["gap_after_cooling_m"], 0.), 1e-3)
    print(f"    {i + 1} rows; the last: {compression:.3f} Pa, {end:.10f} m")
    # The pressure acts where the stage grouts: from 0 to 4 m, on 7/8 of the joint. The force of the grout remains when it sets.
    compression, _, steps = bars("lift", 10., 2.4e10, (0, 0, 0), "day 0, grout 4 at 1 MPa, grout 5", n_up=4)
    print(f"    grout in 7/8 of the joint: mean compression {compression:.3f} Pa")
    check("compression by grout in a part of the joint", compression, 7e6 / 8, 1e6)


def cut():
    """A bar with a joint is compressed and cut: the table, rigid and elastic, with the gap as a cut and as an initial gap."""
    for i, row in enumerate(rows_of("saw_cut_bar.csv")):
        hot = row["end_displacement_m"] / row["length_m"] / EXPANSION
        for kind, stages, gap in (("cut", f"day 1, cut 1 by {1e3 * row['cut_m']} mm", {}), ("gap", "day 1", {"Initial_gaps": f"contraction: {row['cut_m']}"})):
            if kind == "cut" and row["cut_m"] == 0.:
                continue
            name = f"{kind}{i}"
            compression, opening, steps = bars(name, row["length_m"] / 2, row["modulus_Pa"], (0, hot, hot), stages,
                                               Normal_stiffness=row["joint_stiffness_Pa_per_m"], **gap)
            print(f"    {name}: compression {compression:.3f} Pa, closed form {row['compression_Pa']} Pa")
            check(f"{name}: compression", compression, row["compression_Pa"], 1e6)
            if row["gap_m"] > 0:
                check(f"{name}: gap", opening, row["gap_m"], 1e-6)
    # The width of the cut is removed in the increments of its stage.
    _, opening, steps = bars("increments", 10., 2.4e10, (0, 0, 0), "cut 1 by 3 mm", *settings("Statics/Water increments=3"), Initial_gaps="1: 1 mm")
    found = [step["max_opening"] for step in steps]
    print(f"    gap and cut in three increments: openings {found} m")
    expect(max(abs(a - b) for a, b in zip(found, (2e-3, 3e-3, 4e-3, 4e-3, 4e-3, 4e-3))) < 1e-12 and abs(opening - 4e-3) < 1e-9, f"openings {found}")


def bond():
    """A cut and a gap have no bond: a cohesive joint that holds two cooling bars loses its tension; grout restores it."""
    tension, cold = -2.4e10 * 1e-5 * EXPANSION * 1e5, -1.
    for name, stages, more, compression, opened in (
            ("held", "day 1", {}, tension, 0.), ("cut", "day 1, cut 1 by 1e-6 m", {}, 0., 1e-6 + 20 * EXPANSION),
            ("gap", "day 1", {"Initial_gaps": "joint 1: 1e-6"}, 0., 1e-6 + 20 * EXPANSION),
            ("filled", "day 0, grout 5, day 1", {"Initial_gaps": "1: 1e-6"}, tension, 0.)):
        for law, entries in (("cohesive", {"Strength": 1e6, "Fracture_energy": 1e3}), ("adhesive", {"Adhesion": 1e6}),
                             ("elastic", {"Strength": 1e6, "Fracture_energy": 1e3, "Normal_stiffness": 1e15})):
            given = {"Model": "FJA" if law == "adhesive" else "cohesive", **entries, **more}
            found, opening, _ = bars(name + law, 10., 2.4e10, (0, cold, cold), stages, **given)
            print(f"    {name}, {law}: compression {found:.1f} Pa, opening {1e6 * opening:.3f} um")
            check(f"{name}, {law}: compression", found, compression, 1e6, 1e-5)
            check(f"{name}, {law}: opening", max(opening, 0.), opened, 1e-4, 1e-5)


def ungrouted():
    """Bars that warm meet before grouting, and carry contact; grouted then, the force goes on, and cooling opens their joint."""
    for stiffness in (0, 1e10):
        for gap in (0., 5e-4):
            more = {"Normal_stiffness": stiffness, **({"Initial_gaps": f"1: {gap}"} if gap else {})}
            pressure = 2.4e10 * (20 * 5 * EXPANSION - gap) / 20
            found, _, steps = bars("warm", 10., 2.4e10, (0, 5, 5), "day 0, day 1, grout 5", **more)
            print(f"    gap {gap}, stiffness {stiffness}: {found:.3f} Pa, by hand {pressure:.3f} Pa; open pairs {[s['open_pairs'] for s in steps]}")
            check("compression of ungrouted bars", found, pressure, 1e6)
            expect(steps[1]["open_pairs"] == 0, f"{steps}")
            found, opening, _ = bars("cooled", 10., 2.4e10, (0, 5, 0), "day 0, day 1, grout 5", **more)
            opened = max(0., gap - pressure / stiffness) if stiffness else gap
            check("opening after cooling", max(opening, 0.), opened, 1e-3)
    found, _, _ = bars("alone", 10., 2.4e10, (0, 5, 5), "day 0, day 1", Initial_gaps="1: 0.5 mm")
    check("compression with a gap that is never grouted", found, 2.4e10 * 5e-4 / 20, 1e6)
    # Opposite forces on the two bars: ungrouted faces slide without friction as if they were apart, grouted ones stick.
    shear = settings("Loads/Concentrated=one: 0 -1 5 1e5 0 0; two: 0 1 5 -1e5 0 0")
    moved = []
    for name, stages, more in (("apart", "day 1, grout 5", {"Initial_gaps": "1: 10 mm"}), ("closed", "day 1, grout 5", {}), ("stuck", "day 1", {})):
        _, _, steps = bars(name, 10., 2.4e10, (0, 5, 5), stages, *shear, Friction=10, **more)
        moved.append(abs(steps[0]["crest_x"]))
    print(f"    displacement along the joint: apart {moved[0]:.8g} m, closed {moved[1]:.8g} m, grouted {moved[2]:.2g} m")
    check("displacement of ungrouted faces", moved[1], moved[0], moved[0])
    expect(moved[2] < .01 * moved[0], f"grouted faces slide by {moved[2]} m")


ARCH = settings("Joints/Initial gaps=contraction: 2 mm, 2: 0", "Joints/Model=cohesive", "Joints/Strength=1e6", "Joints/Fracture energy=100",
                "Joints/Normal stiffness=1e11", "Statics/Stages=fill 60, grout 90 at 0.1 MPa, cut 1 by 1 mm, fill 100, grout 150")


def blocks():
    """Grout of 50 kPa between two blocks on a rigid base: published openings (ssnp143a and b: plane, in 3-D, another program). Their source
    gives the height of the blocks, 10 m; the width of 5 m, 3e12 Pa and no lateral strain are assumptions."""
    width, height = 5., 10.
    meshes.write("blocks.msh", *meshes.block(lambda i, j, k: (j, width * (i / 8 - 1), height * k / 20), 8 * (1,) + 8 * (2,), 1, 20, {
        "upstream": 2, "downstream": 3, "bottom": 1, "top": 4}))
    runs(scene("blocks", "blocks.msh", Joints={"Model": "FJA"}, Concrete={"Young's modulus": 3e12}, Statics={"Stages": "grout 20 at 50 kPa"}),
         "--output", "blocks")
    (solution,) = Path("blocks").glob("solution-*.vtu")
    moved = at_places(read_vtu(solution), ["displacement"])
    for z, published in ((2, (6.02e-7, 6.17e-7, 6.38e-7)), (5, (2.00e-6, 2.05e-6, 2.14e-6)), (8, (3.62e-6, 3.76e-6, 3.88e-6))):
        sides = [u[1] for u in moved[key((0, 0, z))]]
        opening = max(sides) - min(sides)
        print(f"    opening at {z} m: {1e6 * opening:.4f} um, published {', '.join(f'{1e6 * x:.2f}' for x in published)} um")
        expect(.99 * published[0] < opening < 1.01 * published[2], f"opening at {z} m: {opening} m is outside of the published values")


def shaken():
    """An arch dam with gaps in an earthquake: the energy account is closed, and openings count from closed faces."""
    write_scene()
    for name, more in (("gaps", settings("Joints/Initial gaps=contraction: 2 mm, 2: 0")), ("keys", settings("Joints/Initial gaps=1: 2 mm", "Joints/Model=KSM")),
                       ("none", ()), ("stages", ARCH)):
        runs("scene.prm", "--output", name, *more, *settings("Dynamics/Factors=double"))
        error, opening = summary(name)["energy_balance_error"], summary(name)["extremes"]["max_opening"]["value"]
        print(f"    {name}: largest opening {1e3 * opening:.3f} mm, energy balance {error:.1e}")
        expect(error < 1e-9, f"energy balance of {name}")
    # Without loads nothing moves, also where the foundation ties the joints at the base.
    gaps = "Joints/Initial gaps=contraction: 2 mm, 2: 0"
    for name, more in (("rest", (gaps,)), ("rest_cut", ("Statics/Stages=cut 1 by 2 mm",)),
                       ("rest_on_rock", (gaps, "Foundation/Model=rock", "Foundation/Coupling=partition"))):
        runs("scene.prm", "--output", name, *settings("Reservoir/Density=0", "Motion/Source=none", *more))
        names, rows = table(f"{name}/joint_history.csv")
        for joint, gap in ((1, 2e-3), (2, 0.)):
            check(f"opening of joint {joint} at rest", rows[0][names.index(f"opening_downstream_{joint}")], gap, 1e-3, 1e-9)
    expect(table("gaps/joint_history.csv")[1][-1] != table("none/joint_history.csv")[1][-1], "the gaps have an effect")


if __name__ == "__main__":
    run_cases(grout, cut, bond, ungrouted, blocks, shaken)
