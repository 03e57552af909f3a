#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the scripts' own functions, against values by hand and against the files of a small run.

    program_scripts.py VOUSSOIR CASE...
"""

import csv
import math
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

from program_physics import close
from run_program import VOUSSOIR, expect, run_cases, runs, settings, summary, write_scene

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))

LIMITS = ("Limits/Static tensile strength=0.4 MPa", "Limits/Demand-capacity ratio=2", "Limits/Overstress duration=0.4", "Limits/Overstressed share=0.2",
          "Limits/Opening=1e-6", "Limits/Slip=10", "Limits/Base friction=1", "Limits/Sliding safety=50", "Joints/Friction=0.3")


def table(name):
    with open(name, newline="") as file:
        return list(csv.DictReader(file))


def equal(found, expected, what):
    expect(found == expected, f"{what}: {found!r}, not {expected!r}")


def numbers():
    """Numbers of the report as an engineer writes them: three digits, the unit's scale, powers of ten, the typographic minus."""
    from voussoir.drawing import energy_unit
    from voussoir.report_tables import number, unit_of, with_unit
    for value, unit, text in ((.00123456, "mm", "1.23"), (.0123456, "mm", "12.3"), (.123456, "mm", "123"), (1.2344, "mm", "1234"),
                              (.000123456, "mm", "0.123"), (5e-7, "mm", "5.0 × 10⁻⁴"), (5e-8, "mm", "0"), (-2.5e6, "MPa", "−2.50"),
                              (.125, "%", "12.5"), (1.5e6, "", "1.5 × 10⁶"), (-2e-4, "", "−2.0 × 10⁻⁴"), (7.25, "s", "7.25"),
                              (3e7, "MN", "30.0"), (float("nan"), "", "none"), (0., "mm", "0")):
        equal(number(value, unit), text, f"{value} in {unit or 'no unit'}")
    equal(number(.0123456, "mm", 2), "12", "two digits")
    for value, unit, text in ((.06, "mm", "60 mm"), (.2, "%", "20 %"), (1.3, "", "1.3"), (1e6, "MPa", "1 MPa"), (.4, "s", "0.4 s"), (10., "mm", "10000 mm")):
        equal(with_unit(value, unit), text, "a limit")
    for name, unit in (("max_opening", "mm"), ("max_gap", "mm"), ("max_tension", "MPa"), ("max_pressure", "MPa"), ("max_ratio", "")):
        equal(unit_of(name), unit, f"unit of {name}")
    for value, unit in ((3e9, ("GJ", 1e9)), (1e6, ("MJ", 1e6)), (999e3, ("kJ", 1e3)), (12., ("J", 1.))):
        equal(energy_unit(value), unit, f"unit of {value} J")


def tables():
    """Tables and scenes of a run as they are read: half a line at the end is none, a damaged row is named, defaults are told."""
    from voussoir.errors import InputError
    from voussoir.prm import read_entries
    from voussoir.runs import read_table
    Path("sound.csv").write_text("time,value\n0,1\n0.1,2\n0.2")
    equal({name: list(column) for name, column in read_table(Path("sound.csv")).items()}, {"time": [0., .1], "value": [1., 2.]}, "a table without its end")
    for text, part in (("time,value\n0,1\n0.1\n0.2,3\n", "line 3 has 1 values for 2 columns"), ("time,value\n0,one\n0.1,2\n", "one")):
        Path("bad.csv").write_text(text)
        try:
            read_table(Path("bad.csv"))
            raise AssertionError(f"{text!r} is taken")
        except InputError as error:
            expect("bad.csv is damaged" in str(error) and part in str(error), f"{error}")
    equal(read_entries("subsection A\n  subsection B\n    set c d = 1 # default: 2\n  end\n  set e = f\nend\nset g = # default: h\n"),
          {"A/B/c d": ("1", "2"), "A/e": ("f", None), "g": ("", "h")}, "entries")


def results():
    """The report's results and words are those of the files of the run."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings(*LIMITS))
    runs("scene.prm", "--output", "tied", *settings("Joints/Model=tied"))
    runs("scene.prm", "--output", "still", *settings("Motion/Source=none", "Motion/File=", "Motion/Unit=m/s^2", "Limits/Static tensile strength=0.4 MPa"))
    from voussoir.report_tables import differences, extremes, items, verdict
    from voussoir.prm import prm_text
    from voussoir.runs import Run, name_apart
    run, tied, still = Run("run"), Run("tied"), Run("still")
    found, known, history = items(run), summary("run"), table("run/history.csv")
    for name, largest in (("downstream", max), ("upstream", min)):
        row = largest(history, key=lambda row: float(row["crest_x"]))
        equal((found[f"crest_{name}"].value, found[f"crest_{name}"].time), (float(row["crest_x"]), float(row["time"])), f"crest {name}")
    safety = min((block["min_sliding_safety"]["value"], block["centroid"]) for block in known["blocks"].values())
    equal((found["sliding_safety"].value, found["sliding_safety"].place), safety, "least safety against sliding")
    expect("not reached" in extremes([run]) and not known["limits"]["sliding_safety"]["satisfied"], "a safety below what is asked for is not named so")
    for key, name in (("demand_capacity", "demand_capacity_away_from_base"), ("demand_capacity_with_base", "demand_capacity")):
        demands = [known["overstress"][face][name] for face in ("upstream", "downstream")]
        expect(demands[0] != demands[1], "both faces have the same demand")
        equal(found[key].value, max(demands), f"demand over capacity, {key}")
    limit = known["limits"]["overstress_duration"]
    expect(f"above {2. - limit['limit'] / .4:.2g} times the strength" in found["overstress_duration"].title, found["overstress_duration"].title)
    allowed = known["limits"]["overstressed_share"]["limit"]
    k = round(10. * (1. - allowed / .2))  # number of the level that decides
    for face in ("upstream", "downstream"):
        share = known["overstress"][face]["share_away_from_base"][k]
        equal((found[f"share_{face}"].value, found[f"share_{face}"].state), (share, "satisfied" if share <= allowed else "exceeded"), f"share of the {face} face")
        equal(found[f"share_{face}_with_base"].value, known["overstress"][face]["share"][k], f"share of the {face} face, with the base")
    equal({found[key].state for key in ("max_opening", "max_slip")}, {"exceeded", "satisfied"}, "states")
    expect("overstress_duration" not in items(still) and "max_opening" not in items(tied), "a duration of a static state, openings of a tied dam")
    n_exceeded = sum(not limit["satisfied"] for limit in known["limits"].values())
    state, sentence = verdict(run)
    expect(state == "exceeded" and f"{n_exceeded} of {len(known['limits'])} limits" in sentence, sentence)
    expect(verdict(tied)[0] == "" and "no limits" in verdict(tied)[1], f"{verdict(tied)}")
    expect(not {"Limits", "Tension", "Figures"} & {title for title in still.facts}, f"results among the facts: {list(still.facts)}")
    expect(not still.moves and run.moves and tied.tied and not run.tied, "what kind of run it is")
    expect("<tr class=differs>" in differences([run, tied]) and "<tr class=differs>" not in differences([run]), "entries that differ")
    name_apart(three := [run, Run("run"), tied])
    expect(len({one.name for one in three}) == 3, f"three runs have the names {[one.name for one in three]}")
    Path("again.prm").write_text(prm_text({entry: value for entry, (value, default) in run.entries.items() if default is not None}))
    equal(runs("scene", "again.prm").splitlines()[1:], runs("scene", "scene.prm", *settings(*LIMITS)).splitlines()[1:], "the scene of the report")
    joints(run)


def joints(run):
    """Which joints open most, and how much, by joints.csv."""
    from voussoir.drawing import FACES, common_top, crest_values, worst_joints
    rows = table("run/joints.csv")
    largest = {int(row["joint"]): max(float(row[f"opening_{face}"]) for face in FACES) for row in rows}
    equal(worst_joints(run, 2), sorted(largest, key=lambda joint: -largest[joint]), "the worst joints")
    half = SimpleNamespace(joints={name: .5 * column for name, column in run.joints.items()}, joint_name=run.joint_name)
    for several in ([run, half], [half, run]):
        equal(common_top(several, "opening"), 1e3 * max(largest.values()), "the highest bar")
    equal(list(crest_values(run, "slip")["upstream"]), [1e3 * float(row["slip_upstream"]) for row in rows], "slips at the crest")


def shapes():
    """Outer faces of two cubes that stay together or part; places between corners; the picture with the widest opening; a film's picture."""
    import numpy as np
    from voussoir.errors import InputError
    from voussoir.film import Picture
    from voussoir.picture import FACES, View, below, bilinear, creases, normals, outer, outer_faces, read_solution, widest
    from voussoir.vtu import read_vtu, write_vtu
    corners = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
    points, cells = np.concatenate([corners, corners + [1, 0, 0]]), np.arange(16).reshape(2, 8)
    moved = np.zeros((16, 3))
    equal(len(outer(points, moved, cells)), 10, "outer faces of two cubes that stay together")
    moved[8:, 0] = 2e-6
    equal(len(outer(points, moved, cells)), 12, "outer faces of two cubes that part by 2 micrometres")
    outward = normals(points[outer_faces(points, moved, cells)])
    expect(np.allclose(sorted(map(tuple, outward)), sorted(2 * [tuple(sign * row) for row in np.eye(3) for sign in (-1., 1.)])), f"normals {outward}")
    equal(len(creases(outer_faces(points[:8], moved[:8], cells[:1]), corners[FACES])), 12, "creases of a cube")
    values = np.array([[0., 1., 5., 2.]])
    expect(np.allclose(bilinear(values, 2)[0], [[0., 1., 2.], [.5, 2., 3.5], [1., 3., 5.]]), f"{bilinear(values, 2)}")
    camera = View(0., 0., np.zeros(3), 10.)
    place, depth = camera(np.array([[5., 1., 2.]]))
    expect(np.allclose(place, [[2., 4.]]) and np.allclose(depth, 5.), f"a point half-way to the camera is seen at {place}, {depth}")
    equal(len(below(np.array([[0., 0., 0.], [0., 1., 0.], [0., 1., 2.], [0., 0., 2.]]), -1.)), 0, "corners below the water of a dry face")
    write_vtu("two.vtu", points, cells, 12, {"displacement": moved})
    equal(list(read_vtu("two.vtu")["offsets"]), [8, 16], "offsets of two hexahedra")
    equal(read_solution("two.vtu", displacement=3)["connectivity"].tolist(), cells.tolist(), "cells of two hexahedra")
    for what, last in (("below", -1), ("above", 16)):
        write_vtu("bad.vtu", points, np.concatenate([cells.ravel()[:-1], [last]]).reshape(2, 8), 12, {"displacement": moved})
        try:
            read_solution("bad.vtu", displacement=3)
            raise AssertionError(f"a cell with a point {what} the last one is taken")
        except InputError as error:
            expect("bad.vtu is damaged" in str(error), f"{error}")
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=1", "Joints/Friction=0.3"))
    rows = table("run/joint_history.csv")
    openings = [max(float(value) for name, value in row.items() if name.startswith("opening")) for row in rows]
    equal(widest(Path("run")).name, f"solution-{openings.index(max(openings)):05d}.vtu", "the solution with the widest opening")
    path = widest(Path("run"))
    data, picture, large = read_vtu(path), Picture(path, 0.), Picture(path, 100.)
    close(picture.opening, 1e3 * max(value for value in data["opening"] if value == value), 1e-6, "opening of a film's picture [mm]")
    expect(-1e-6 * max(map(abs, data["max_principal"])) <= picture.stress.min() and picture.stress.max() <= 1e-6 * max(data["max_principal"]) and
           picture.stress.max() > .3e-6 * max(data["max_principal"]), f"stress up to {picture.stress.max()} MPa")
    close(np.abs(large.corners - picture.corners).max(), 100. * max(map(abs, data["displacement"])), 1e-5, "way of the corners, magnified [m]")


def films():
    """How many pictures, how long the film lasts."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=5"))
    for options, pictures, seconds in ((("--from", "0.1", "--until", "0.35"), 6, 6 * 4 * .05), (("--from", "0.3", "--slower", "2"), 5, 5 * 2 * .05)):
        words = [str(Path(__file__).resolve().parent.parent / "scripts" / "film.py"), "run", "film.gif", "--width", "200", "--slower", "4", *options]
        result = subprocess.run(words, capture_output=True, text=True, check=False)
        expect(result.returncode == 0 and result.stdout.startswith(f"{pictures} pictures, {seconds:.1f} s -> film.gif"), f"{options}: {result}")


def studies():
    """What a study says in units and lists."""
    from voussoir.errors import InputError
    from voussoir.study_file import combined, edit_distance, nearest, number_with_unit, value_in, values_of
    for text, unit, value in (("3 MPa", "Pa", 3e6), ("2.5kPa", "Pa", 2500.), ("1 GPa", "Pa", 1e9), ("20 mm", "m", .02), ("2 cm", "m", .02), ("5 %", "-", .05), ("7", "m", 7.)):
        close(number_with_unit(text, unit, "here"), value, 1e-12, text)
    equal(values_of("3 ... 6", "here"), ["3", "4", "5", "6"], "a range")
    equal(values_of("a | b | c", "here"), ["a", "b", "c"], "a list")
    for text in ("0.5 | 0.50", "1 |", "6 ... 3", "a ... b"):
        try:
            values_of(text, "here")
        except InputError:
            continue
        raise AssertionError(f"{text} is taken")
    expect(value_in("Motion/File", "1") != value_in("Motion/File", "01") and value_in("Motion/Factor", "1") == value_in("Motion/Factor", "1.0"), "equal values")
    equal(combined([[1, 2], [3, 4, 5]], "all"), [(1, 3), (1, 4), (1, 5), (2, 3), (2, 4), (2, 5)], "all combinations")
    equal(combined([[1, 2], [3, 4, 5]], "one by one"), [(1, 3), (2, 3), (1, 4), (1, 5)], "one by one")
    equal([edit_distance(*pair) for pair in (("kitten", "sitting"), ("", "abc"), ("abc", "abc"))], [3, 3, 0], "edit distances")
    motion_of_study()
    equal(nearest("Joints/Friktion", ["Joints/Friction", "Motion/Factor", "Keys/Friction"]), "Joints/Friction", "the nearest name")


def motion_of_study():
    """The crest's way from its static place, and the largest acceleration of the base in any direction."""
    from voussoir.study_results import motion_of
    Path("run").mkdir(exist_ok=True)
    Path("run/history.csv").write_text("time,crest_x,base_acceleration_x,base_acceleration_y,base_acceleration_z\n"
                                       "0,0.5,0,0,0\n0.1,0.4,1,-3,2\n0.2,0.75,-2,1,0\n")
    found = motion_of(Path("run"))
    for name, value in (("peak_acceleration", 3.), ("crest_upstream", .1), ("crest_downstream", .25)):
        close(found[name], value, 1e-12, name)


def zones():
    """Means over zones of two plane faces with a linear tension, away from the base, by hand."""
    from voussoir.zone_tension import zone_means
    n, height, width = 24, 30., 60.  # elements each way
    with open("faces.csv", "w") as nodes, open("faces_cells.csv", "w") as cells:
        nodes.write("face,monolith,x,y,z,s,max_principal,min_principal\n")
        cells.write("face,monolith,n0,n1,n2,n3\n")
        for f, (name, slope) in enumerate((("upstream", 1e5), ("downstream", 2e5))):
            for j in range(n + 1):
                for i in range(n + 1):
                    y, z = width * (i / n - .5), height * j / n
                    nodes.write(f"{name},1,{10 * f},{y},{z},{y},{slope * z + 1e4 * y},0\n")
            for j in range(n):
                for i in range(n):
                    a = f * (n + 1)**2 + j * (n + 1) + i
                    cells.write(f"{name},1,{a},{a + 1},{a + n + 2},{a + n + 1}\n")
    means, areas = zone_means(Path("."))
    # Nine zones of 20 m x 10 m, from y = -30 m on, up first. A tenth of the height, 3 m from base and abutments, is in none.
    for f, slope in enumerate((1e5, 2e5)):
        for k, (wide, y) in enumerate(((17., -18.5), (20., 0.), (17., 18.5))):
            for j, (tall, z) in enumerate(((7., 6.5), (10., 15.), (10., 25.))):
                found, area = means[9 * f + 3 * k + j], areas[9 * f + 3 * k + j]
                expect(abs(area / (wide * tall) - 1.) < .04, f"face {f}, zone {k} {j}: area {area}, not {wide * tall}")
                expect(abs(found - slope * z - 1e4 * y) < 2e4, f"face {f}, zone {k} {j}: mean {found}, not {slope * z + 1e4 * y}")


if __name__ == "__main__":
    run_cases(numbers, tables, results, shapes, films, studies, zones)
