#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads through the whole program: temperature, stages, combinations, uplift.

    program_loads.py VOUSSOIR CASE...     cases: see the functions with that name below

Closed forms of the single loads: loads.cc."""

import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
import meshes  # noqa: E402
from voussoir import vtu  # noqa: E402
import scenes  # noqa: E402
from compare import STRESS, Worst, at_places, key, read_vtu, scene  # noqa: E402
from run_program import (MESH, run_cases, expect, refused, runs, same, summary, table, voussoir, write,  # noqa: E402
                         write_scene)

STATIC = MESH + """
subsection Motion
  set Source = none
end
subsection Output
  set Figures = false
end
"""


def settings(**entries):
    """Loads__Silt__Level=3 -> --set Loads/Silt/Level=3; _ is a blank."""
    return [x for name, value in entries.items()
            for x in ("--set", f"{name.replace('__', '/').replace('_', ' ').replace('Self w', 'Self-w')}={value}")]


def result(name, *arguments):
    """What a run of the static state gives."""
    shown = runs("static.prm", "--output", name, *arguments)
    return summary(name), shown


def temperature():
    """Cooling opens the joints and moves the crest downstream, warming shuts them; a table is the same as its values; on a
    dam that is free at its ends but for its foot a uniform temperature leaves the crest without stress."""
    write("static.prm", STATIC)
    plain, shown = result("plain")
    expect("temperature" not in shown, "no temperature unless a scene has one")
    opening, crest = {}, {}
    for t in (-10, 15):
        found, shown = result(f"t{t}", *settings(Loads__Temperature__Upstream_face=t, Loads__Temperature__Downstream_face=t))
        expect(f"temperature x 1: {t} degC upstream, {t} downstream, 0 when grouted" in shown, shown)
        opening[t], crest[t] = found["extremes"]["max_opening"]["value"], found["static"]["crest_displacement"]
    print(f"    openings {opening}, crest {crest}, without temperature {plain['static']['crest_displacement']}")
    empty = [result(f"empty{t}", *settings(Reservoir__Density=0, Loads__Temperature__Upstream_face=t,
                                           Loads__Temperature__Downstream_face=t))[0]["extremes"]["max_opening"]["value"]
             for t in (-5, -10)]
    print(f"    without water {empty}")
    expect(plain["static"]["open_pairs"] == 0 < opening[-10] < empty[1] and opening[15] < 1e-9, f"cooling opens the joints: {opening}")
    expect(1e-3 < empty[0] < empty[1], f"the colder the wider: {empty}")
    expect(crest[-10][0] > plain["static"]["crest_displacement"][0] > crest[15][0], "an arch that cools sinks downstream")
    write("seasons.csv", "day,upstream,downstream\n0,0,0\n180,-10,-10\n360,0,0\n")
    found, _ = result("table", *settings(Loads__Temperature__Table="seasons.csv", Loads__Temperature__Day=180))
    expect(found["static"]["crest_displacement"] == crest[-10], "the table's temperatures")
    write("heights.csv", "day,elevation,upstream,downstream\n0,0,-10,-10\n0,500,-10,-10\n9,0,-10,-4\n9,500,-2,-4\n")
    found, _ = result("heights", *settings(Loads__Temperature__Table="heights.csv"))
    expect(found["static"]["crest_displacement"] == crest[-10], "the same temperature at all elevations")
    _, shown = result("profile", *settings(Loads__Temperature__Table="heights.csv", Loads__Temperature__Day=9))
    expect("temperature x 1: -10 to -2 degC upstream, -4 downstream, 0 when grouted" in shown, shown)
    refused(["static.prm", "--validate", *settings(Loads__Temperature__Table="seasons.csv", Loads__Temperature__Day=400)],
            "seasons.csv", "day 400", "0 to 360")
    expect("no effect" in voussoir("static.prm", "--validate", *settings(Loads__Temperature__Day=4)).stdout, "a day without table")
    # Half the difference has half the effect where nothing opens.
    tied = settings(Joints__Model="tied", Reservoir__Density=0, Statics__Self_weight="none")
    one, _ = result("one", *tied, *settings(Loads__Temperature__Downstream_face=-8))
    two, _ = result("two", *tied, *settings(Loads__Temperature__Downstream_face=-16, Loads__Temperature__Expansion=5e-6))
    for a, b in zip(one["static"]["crest_displacement"], two["static"]["crest_displacement"]):
        expect(abs(a - b) < 1e-9 * abs(one["static"]["crest_displacement"][0]), f"{one['static']} {two['static']}")
    expect(abs(one["extremes"]["max_tension_downstream"]["value"] / two["extremes"]["max_tension_downstream"]["value"] - 1)
           < 1e-5, "stresses")
    # A load by temperature is in the earthquake, too: the energies close.
    write_scene()
    runs("scene.prm", "--output", "shaken", *settings(Loads__Temperature__Upstream_face=-10,
                                                      Loads__Temperature__Downstream_face=-10, Dynamics__Factors="double"))
    expect(summary("shaken")["energy_balance_error"] < 1e-9, "energy")


def calculix():
    """CalculiX on the same arch (golden/make_calculix_temperature.py): plain elements and those with modes under a uniform
    temperature; 20-node elements under a linear one, against ours of degree 2. Stresses not on joints, where each monolith has its own, nor, of
    elements that differ, at the held base, where they are singular. Limits: displacements, stresses."""
    golden = json.loads((Path(__file__).resolve().parent / "golden" / "calculix_temperature.json").read_text())
    t = scenes.TEMPERATURES
    meshes.arch("arch.msh", *scenes.CALCULIX["cells"])
    nodes, _, quads = meshes.arch_block(*scenes.CALCULIX["cells"])
    held = {key(nodes[c]) for tag, corners in quads if tag == 1 for c in corners}
    for element, faces, limits in (("C3D8", "uniform", (5e-6, 1e-4)), ("C3D8I", "uniform", (.01, .06)),
                                   ("C3D20", "linear", (.01, .03))):
        file = scene(element, "arch.msh", Elements={"Incompatible modes": str(element != "C3D8").lower(), "Degree": 2 if element == "C3D20" else 1},
                     Concrete={"Young's modulus": 21e9, "Poisson's ratio": .17, "Density": 2400},
                     Output={"Stress recovery": "elements"})  # as CalculiX
        runs(file, "--output", element, *settings(
            Loads__Temperature__Upstream_face=t[faces][0], Loads__Temperature__Downstream_face=t[faces][1],
            Loads__Temperature__Grouting=t["grouting"], Loads__Temperature__Expansion=t["expansion"]))
        (solution,) = Path(element).glob("solution-*.vtu")
        fields, check, theirs = at_places(read_vtu(solution), ["displacement", *STRESS]), Worst(element), golden[element]
        stresses = []
        sizes = [max(math.hypot(*row[3:6]) for row in theirs), max(abs(x) for row in theirs for x in row[6:])]
        for row in theirs:
            rows = fields[key(row[:3])]
            for a, b in zip(rows[0][:3], row[3:6]):
                check.close("displacement", a, b, limits[0], sizes[0])
            if len(rows) == 1 and (element == "C3D8" or key(row[:3]) not in held):
                stresses += [(a, b) for a, b in zip(rows[0][3:], row[6:])]
        if element == "C3D20":
            error = math.sqrt(sum((a - b)**2 for a, b in stresses) / len(stresses)) / sizes[1]
            print(f"    {element}: stress: root of mean squares {error:.1e}, limit {limits[1]}")
            expect(len(stresses) > 100 and error < limits[1], f"stresses of {element}: {error}")
        else:
            for a, b in stresses:
                check.close("stress", a, b, limits[1], sizes[1])
        check.done()


def stages():
    """Filling in stages ends where filling at once does, but for friction's memory; stages.csv has every step. Lifts: while
    joints are not grouted the monoliths stand alone, and what they have moved is no opening afterwards."""
    write("static.prm", STATIC + "subsection Joints\n  set Model = FJB\nend\n")
    once, _ = result("once", *settings(Statics__Water_increments=4))
    found, shown = result("filled", *settings(Statics__Stages="fill 80, fill 140", Statics__Water_increments=2))
    names, rows = table("filled/stages.csv")
    expect(len(rows) == 6 and [row[names.index("level")] for row in rows] == [80, 80, 140, 140, 195, 195], f"{names} {rows}")
    expect("Stage     fill 140 m: crest" in shown and not Path("once/stages.csv").exists(), shown)
    # Once more into the same directory: the same; then without stages: none are left of the run before.
    stages_then, summary_then = Path("filled/stages.csv").read_bytes(), found["static"]
    again, _ = result("filled", *settings(Statics__Stages="fill 80, fill 140", Statics__Water_increments=2))
    expect(again["static"] == summary_then and Path("filled/stages.csv").read_bytes() == stages_then, "the run repeated")
    result("filled", *settings(Statics__Water_increments=4))
    expect(not Path("filled/stages.csv").exists(), "stages.csv of the run before is left")
    expect(summary("filled")["static"]["crest_displacement"] == once["static"]["crest_displacement"], "the run without stages")
    crests = [row[names.index("crest_x")] for row in rows]
    expect(all(a < b for a, b in zip(crests[2:], crests[3:])), f"the crest goes downstream: {crests}")
    a, b = (x["static"]["crest_displacement"] for x in (once, found))
    print(f"    crest at once {a}, in stages {b}")
    expect(math.dist(a, b) < .05 * math.hypot(*a), "the same end")
    # Down again: from full to empty the tied dam comes back.
    down, _ = result("down", *settings(Statics__Stages="fill 195", Reservoir__Water_level=20, Joints__Model="tied"))
    low, _ = result("low", *settings(Reservoir__Water_level=20, Joints__Model="tied"))
    expect(math.dist(down["static"]["crest_displacement"], low["static"]["crest_displacement"]) < 1e-12, f"{down['static']}")
    # A tied dam is linear: in the middle of a stage it is half-way between the levels.
    result("linear", *settings(Statics__Stages="fill 80, fill 140", Statics__Water_increments=2, Joints__Model="tied"))
    names, rows = table("linear/stages.csv")
    crests = [row[names.index("crest_x")] for row in rows]
    expect(abs(crests[2] - .5 * (crests[1] + crests[3])) < 1e-6 * crests[3], f"half-way from 80 to 140 m: {crests}")
    # Lifts. Nothing is grouted at first: monoliths alone.
    lifts, _ = result("lifts", *settings(Statics__Stages="fill 100, grout 210"))
    names, rows = table("lifts/stages.csv")
    alone = rows[0][names.index("crest_x")]
    together, _ = result("together", *settings(Reservoir__Water_level=100, Reservoir__Added_mass="none"))
    print(f"    crest at 100 m: monoliths alone {1e3 * alone:.4f} mm, together {1e3 * together['static']['crest_displacement'][0]:.4f} mm")
    expect(alone > 1.2 * together["static"]["crest_displacement"][0], "monoliths alone move more")
    # The pairs that are open and that slip, by the fields of the static state.
    result("sliding", *settings(Statics__Stages="fill 100", Joints__Model="FJA", Joints__Friction=.05, Output__Solution_interval=1))
    names, rows = table("sliding/stages.csv")
    data = vtu.read_vtu("sliding/solution-00000.vtu")
    state = {tuple(round(x, 3) for x in data["Points"][3 * i:3 * i + 3]): s for i, s in enumerate(data["joint_state"]) if s >= 0}
    counts = [sum(s == value for s in state.values()) for value in (0, 2)]
    print(f"    {counts} of {len(state)} pairs are open, slip")
    expect(0 < counts[1] != len(state) - sum(counts) and [rows[-1][names.index(f"{n}_pairs")] for n in ("open", "slip")] == counts,
           f"{counts} of {len(state)}, stages.csv {rows[-1]}")
    # Joints of law tied are not cut by lifts.
    overrides = settings(Statics__Stages="fill 100, grout 210", Joints__Overrides="1: tied")
    result("tied_in_part", *overrides)
    names, rows = table("tied_in_part/stages.csv")
    held = rows[0][names.index("crest_x")]
    print(f"    the first joint tied: {1e3 * held:.4f} mm")
    expect(held < .95 * alone, "a tied joint holds before it is grouted")
    expect(lifts["extremes"]["max_opening"]["value"] < 2e-3, "openings count from the grouting")
    # Where nothing is loaded after the grouting, nothing opens.
    at_rest, _ = result("at_rest", *settings(Statics__Stages="fill 100, grout 210", Reservoir__Water_level=100))
    expect(at_rest["extremes"]["max_opening"]["value"] < 1e-9, f"opened after the grouting: {at_rest['extremes']['max_opening']}")
    names, rows = table("at_rest/stages.csv")
    crests = [row[names.index("crest_x")] for row in rows]
    print(f"    grouted at rest: crest {crests}")
    expect(abs(crests[-1] - alone) < 1e-7 * alone, f"the grouting moves the crest from {alone}: {crests}")
    at_first, shown = result("at_first", *settings(Statics__Stages="grout 1000, fill 100"))
    expect("1000 m of a lift is above the joints" in shown, shown)
    filled, _ = result("not_lifted", *settings(Statics__Stages="fill 100"))
    expect(math.dist(at_first["static"]["crest_displacement"], filled["static"]["crest_displacement"]) < 1e-12, "all grouted at first")
    # Through an earthquake, and from a checkpoint, openings still count from the grouting.
    write_scene()
    lifts = settings(Statics__Stages="fill 100, grout 100, fill 150", Dynamics__Factors="double")
    runs("scene.prm", "--output", "shaken", *lifts)
    expect(summary("shaken")["energy_balance_error"] < 1e-9, "energy")
    names, rows = table("shaken/joint_history.csv")
    first = max(abs(x) for x in rows[0][1:])
    expect(first < 5e-3, f"opening and slip at first: {first}")
    write("seasons.csv", "day,upstream,downstream\n0,0,0\n180,-10,-10\n360,0,0\n")
    for day, stages_of_days, warned in (("180", "day 90, fill 100, day 180, grout 210", False), ("0", "day 90, fill 100, day 180", True),
                                        ("180", "day 180, day 90", True), ("0", "fill 100", False)):
        shown = voussoir("static.prm", "--validate", *settings(Loads__Temperature__Table="seasons.csv", Loads__Temperature__Day=day,
                                                               Statics__Stages=stages_of_days))
        said = f"Statics/Stages ends with day {stages_of_days.split('day ')[-1].split(',')[0]}" in shown.stdout + shown.stderr
        expect(shown.returncode == 0 and said == warned, f"{stages_of_days}, then day {day}: {shown.stdout[-500:]}{shown.stderr}")
    for value, *parts in (("fill", "fill Z"), ("flood 100", "flood 100"), ("fill 300", "above the dam"),
                          ("fill -5", "below the upstream face"), ("grout -5, fill 100", "below all joints", "not a depth"),
                          ("grout 100, grout 90", "not above"), ("day 4", "Loads/Temperature/Table")):
        refused(["static.prm", "--output", "x", *settings(Statics__Stages=value)], "Statics/Stages", *parts)
    refused(["static.prm", "--output", "x", *settings(Statics__Stages="grout 100", Joints__Model="tied")], "tied")
    refused(["static.prm", "--output", "x", *settings(Statics__Stages="fill 100", Reservoir__Density=0)], "Reservoir/Density")
    refused(["static.prm", "--output", "x", *settings(Statics__Stages="grout 100", Statics__Self_weight="monolithic")], "monolithic")
    dry = settings(Loads__Combinations="dry: weight", Loads__Combination="dry")
    refused(["static.prm", "--output", "x", *settings(Statics__Stages="fill 100"), *dry], "leaves the water out")
    expect("does not reach" not in runs("static.prm", "--validate", *dry), "no warning of water that the combination leaves out")


def combinations():
    """A factor is as good as so much more of the load; what is not named does not act, the earthquake neither."""
    write_scene()
    loads = settings(Loads__Tail_water__Level=60, Loads__Silt__Level=80, Loads__Concentrated="crane: 0 0 210 1e6 0 -2e6",
                     Loads__Crest_line="1e4 0 0")
    runs("scene.prm", "--output", "all", *loads)
    runs("scene.prm", "--output", "extreme", *loads, *settings(Loads__Combination="extreme"))
    same("all", "extreme", 0.)
    shown = runs("scene.prm", "--output", "usual", *loads, *settings(Loads__Combination="usual"))
    expect("combination usual: weight, water" in shown and summary("usual")["steps"] == 0, shown)
    found = summary("usual")["loads"]
    print(f"    {found}")
    expect(found["silt"]["resultant"][0] > 0 > found["tail water"]["resultant"][0], f"{found}")
    expect(found["concentrated"]["resultant"] == [1e6, 0, -2e6], f"{found}")
    expect("Loads     concentrated x 1: 1 0 -2 MN" in shown, shown)
    expect(summary("usual")["static"]["crest_displacement"] == summary("all")["static"]["crest_displacement"], "statics")
    # 1.5 x water is water of 1.5 times the density; without the weight it is not there.
    flood = settings(Loads__Combinations="flood: water 1.5, earthquake 2", Loads__Combination="flood", Reservoir__Added_mass="none")
    runs("scene.prm", "--output", "flood", *flood)
    runs("scene.prm", "--output", "by_hand", *settings(Reservoir__Density=1500, Reservoir__Added_mass="none", Motion__Factor=2,
                                                       Statics__Self_weight="none"))
    same("flood", "by_hand", 1e-9)
    shown = runs("scene.prm", "--output", "dry", *settings(Loads__Combinations="dry: weight", Loads__Combination="dry"))
    runs("scene.prm", "--output", "empty", *settings(Reservoir__Density=0, Motion__Source="none"))
    expect("Water     none" in shown and summary("dry")["static"]["crest_displacement"] ==
           summary("empty")["static"]["crest_displacement"], shown)
    for value, *parts in (("rare: weight, watre", "watre", "\"water\""), ("rare: weight, weight 2", "twice")):
        refused(["scene.prm", "--validate", *settings(Loads__Combinations=value)], "Loads/Combinations", *parts)
    refused(["scene.prm", "--validate", *settings(Loads__Combination="usul")], "Loads/Combination", "\"usual\"")
    expect("silt is zero" in runs("scene.prm", "--validate", *settings(Loads__Silt__Level=-50)), "silt below the dam")


def uplift():
    """Water opens joints further that cooling has opened, from the upstream face only; the uplift at the base is told, and
    moves nothing."""
    write("static.prm", STATIC)
    cold = settings(Loads__Temperature__Upstream_face=-12, Loads__Temperature__Downstream_face=-12)
    cold += settings(Reservoir__Water_level=120)
    dry, _ = result("dry", *cold)
    wet, shown = result("wet", *cold, *settings(Loads__Uplift__Joints="true"))
    line = next(x for x in shown.splitlines() if x.startswith("Stage "))
    print("   ", line, "; dry", dry["static"]["open_pairs"], "open")
    n_open, n_wet = (int(line.split(word)[0].split()[-1]) for word in (" pairs open", " pairs under"))
    expect(0 < n_wet <= n_open and wet["static"]["open_pairs"] >= dry["static"]["open_pairs"], line)
    openings = [x["extremes"]["max_opening"]["value"] for x in (dry, wet)]
    expect(wet["static"]["crest_displacement"] != dry["static"]["crest_displacement"], f"{openings}")
    warm, shown = result("warm", *settings(Loads__Uplift__Joints="true", Loads__Temperature__Upstream_face=20,
                                           Loads__Temperature__Downstream_face=20))
    # Joints that were not grouted while the water rose stay dry: nothing opens afterwards.
    lifts = settings(Statics__Stages="grout 100, fill 190, grout 210")
    crests = [result(f"lifts{joints}", *lifts, *settings(Loads__Uplift__Joints=joints))[0]["static"]["crest_displacement"]
              for joints in ("false", "true")]
    expect(crests[0] == crests[1], f"no water in joints that are grouted later: {crests}")
    # In a joint that cooling has opened down to its foot, water with the factor 0.5 does half of what it does with 1.
    meshes.wall("parted.msh", monoliths=(1, 1, 2, 2), width=20.)
    file, opening = scene("parted", "parted.msh", Reservoir={"Density": 1000, "Water level": 50}, Joints={"Model": "FJA"}), []
    for factor in (0, .5, 1):
        runs(file, "--output", f"parted{factor}", *settings(
            Loads__Temperature__Upstream_face=-20, Loads__Temperature__Downstream_face=-20, Loads__Uplift__Joints="true",
            Loads__Combinations=f"all: weight, water, temperature, uplift {factor}", Loads__Combination="all"))
        found = summary(f"parted{factor}")
        expect(found["static"]["open_pairs"] == found["mesh"]["pairs"], f"{found['static']}: not all are open")
        names, rows = table(f"parted{factor}/joint_points.csv")
        opening.append([row[names.index("max_opening")] for row in rows])
    missed, size = max(abs(b - .5 * (a + c)) for a, b, c in zip(*opening)), max(opening[2])
    print(f"    largest openings with factors 0, 0.5, 1: {[max(x) for x in opening]}; not linear by {missed} m")
    expect(size > 2 * max(opening[0]) and missed < 1e-6 * size, f"{opening}")
    for entry in ("Tail water", "Silt"):
        refused(["static.prm", "--validate", "--set", f"Loads/{entry}/Level=500"], f"Loads/{entry}/Level", "above the top of the dam")
    meshes.wall("wall.msh", monoliths=(1, 1, 2, 2), width=20.)
    file = scene("wall", "wall.msh", Reservoir={"Density": 1000, "Water level": 50})
    runs(file, "--output", "without")
    runs(file, "--output", "with", *settings(Loads__Uplift__Base="true", Loads__Tail_water__Level=10))
    runs(file, "--output", "tail", *settings(Loads__Tail_water__Level=10))
    found = summary("with")["loads"]["base uplift"]
    print(f"    {found}")
    for monolith in ("monolith 1", "monolith 2"):  # 10 m thick and wide each, gravity 10
        expect(abs(found[monolith][2] / (1e4 * 100 * (50 + 10) / 2) - 1) < 1e-12, f"{found}")
    expect(summary("with")["static"] == summary("tail")["static"] != summary("without")["static"], "nothing moves")
    expect("base uplift" not in summary("without")["loads"], "unless it is asked for")
    water = summary("without")["loads"]["water"]
    push = 1e4 * 50**2 / 2 * 20  # the nodes of the base are fixed
    print(f"    {water}, by hand {push} N")
    expect(abs(water["resultant"][0] / push - 1) < 1e-12 and max(map(abs, water["resultant"][1:])) < 1e-9 * push, f"{water}")
    expect(.9 * push < water["resultant_on_free_nodes"][0] < push, f"{water}")
    # `needs`: the row without the uplift of a bonded base keeps the staged self-weight, and so changes no table.
    lifted = settings(Loads__Uplift__Base="true")
    row, = (x for x in json.loads(runs("scene", "static.prm", "--choices", *lifted))["choices"] if x["name"] == "without uplift")
    result("lifted", *lifted)
    result("row", *lifted, *(x for name, value in row["set"].items() for x in ("--set", f"{name}={value}")))
    tables = sorted(file.name for file in Path("lifted").glob("*.csv"))
    expect("history.csv" in tables and tables == sorted(file.name for file in Path("row").glob("*.csv")), f"{tables}")
    for name in tables:
        expect(Path("lifted", name).read_bytes() == Path("row", name).read_bytes(), f"without uplift: {name}")


if __name__ == "__main__":
    run_cases(temperature, stages, combinations, uplift, calculix)
