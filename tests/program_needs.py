#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of `voussoir needs`: verdicts, the table, the smallest scene, resumed commands, bad input, the section of the report.

    program_needs.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from run_program import VOUSSOIR, expect, run_cases, runs, settings, summary, voussoir, write, write_scene

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
ROWS = [{"group": "joints", "name": "tied", "set": {"Joints/Model": "tied"}, "simpler": True},
        {"group": "joints", "name": "weaker friction", "set": {"Joints/Friction": "0.45"}, "simpler": False},
        {"group": "motion", "name": "no vertical component", "set": {"Motion/Scale z": "0"}, "simpler": False},
        {"group": "material", "name": "no such material", "set": {"Concrete/Density": "-1"}, "simpler": False},
        {"group": "numerics", "name": "contact tolerance 1e-6", "set": {"Contact/Tolerance": "1e-6"}, "simpler": True}]
LONG = ["--set", "Motion/Duration=2"]


def stand_in(rows):
    """A program that declares these rows for every scene, and otherwise is the program under test."""
    write("rows.json", json.dumps({"choices": rows}))
    write("program", f"""#!{sys.executable}
import os, subprocess, sys
if sys.argv[1] == "scene" and "--choices" in sys.argv:
    sys.exit(subprocess.call(["cat", "{Path.cwd()}/rows.json"]))
os.execv("{VOUSSOIR}", ["{VOUSSOIR}", *sys.argv[1:]])
""")
    os.chmod("program", 0o755)
    return str(Path("program").resolve())


def needs(*arguments, status=0, program="program"):
    """Output and messages of the command, started as the program starts it, with the rows of stand_in()."""
    result = subprocess.run([sys.executable, ROOT / "scripts" / "needs.py", *arguments], capture_output=True, text=True, timeout=200,
                            env={**os.environ, "VOUSSOIR_PROGRAM": str(Path(program).resolve())})
    expect(result.returncode == status, f"status {result.returncode} of needs {arguments}: {result.stdout[-3000:]}{result.stderr}")
    return result.stdout, result.stderr


def rows_of(directory):
    return {row["name"]: row for row in json.loads(Path(directory, "needs.json").read_text())["rows"]}


def verdicts():
    """Changes, verdicts, the sum of changes and the change to take back, on made-up numbers."""
    from voussoir import needs_verdicts as n
    base = {"opening": 0.02, "slip": 0.1, "tension_upstream": 2e6, "tension_downstream": 1e6, "base_shear": 1e10, "sliding_safety": 0.5, "crest": 0.05}

    def row(name, cost, simpler=True, entry=None, **factors):
        found = n.paired({0: {key: value * factors.get(key, 1.) for key, value in base.items()}}, {0: base})
        return {"group": "x", "name": name, "simpler": simpler, "set": {entry or name: "1"}, "cost": cost, "reference": "coarse", **found}

    changes, counts = n.changes_of({**base, "opening": 0.023, "slip": None}, base)
    expect(abs(changes["opening"] - 0.15) < 1e-12 and changes["slip"] == -1. and changes["crest"] == 0. and not counts["crest"], f"{changes}")
    changes, counts = n.changes_of({"opening": 9e-5}, {"opening": 1e-5})  # relative to 0.1 mm, and negligible
    expect(abs(changes["opening"] - 0.8) < 1e-12 and not counts["opening"] and changes["slip"] is None and not counts["slip"], f"{changes}, {counts}")
    a, b, c, d = (row("a", 0.52, opening=1.03, crest=0.99), row("b", 0.6, opening=0.97), row("c", 0.94, crest=1.02), row("d", 0.4, entry="a", crest=1.09))
    e, f = row("e", 0.1, simpler=False), row("f", 0.96)
    failed = {**row("g", 0.1), "failure": "no"}
    rows = [a, b, c, d, e, f, failed]
    n.judge(rows, {}, 0.05, {})
    expect([r["verdict"] for r in rows] == [n.UNIMPORTANT] * 3 + [n.MATTERS] + [n.UNIMPORTANT] * 2 + [n.UNKNOWN], f"{[r['verdict'] for r in rows]}")
    expect(d["reason"] == "crest displacement" and failed["reason"] == "no", f"{d['reason']}")
    candidates = n.candidates_of(rows)
    expect([r["name"] for r in candidates] == ["a", "b", "c"], f"{[r['name'] for r in candidates]}")
    # a and b: the sum of the openings is 0, half of the root of the sum of squares 2.12 %. a, b and c: crest 1 %, half of the root 1.12 %.
    expect(abs(n.together([a, b], "opening") - 0.5 * 0.03 * 2**0.5) < 1e-12 and abs(n.together([a, c], "crest") - 0.01118) < 1e-5, "together")
    expect([r["name"] for r in n.cheapest(candidates, 0.05)] == ["a", "b", "c"], "cheapest at 5 %")
    expect([r["name"] for r in n.cheapest(candidates, 0.021)] == ["c"], "cheapest at 2.1 %")
    expect(abs(n.together([a, row("h", 0.5, opening=1.01)], "opening") - 0.04) < 1e-12, "equal signs add up")
    expect(n.cheapest(candidates, 0.001) == [], "nothing at 0.1 %")
    d["verdict"] = n.UNIMPORTANT
    expect([r["name"] for r in n.cheapest(n.candidates_of(rows), 0.1)] == ["d", "b"], "of two rows with the same entry only one")
    changes, counts = n.changes_of({**base, "crest": 0.06, "opening": 0.0201}, base)
    expect(n.to_take_back([b, c], changes, counts) is c, "the column that misses the target most decides")
    changes, counts = n.changes_of({**base, "crest": 0.054}, base)
    expect(n.to_take_back([d, c], changes, counts) is c, "2 % for a factor of 0.94 are more than 9 % for 0.4")
    # Numerical error: the larger of that of the column and the root mean square, times twice the root of the size of the row, at most 1
    wide, narrow = row("wide", 1., slip=1.6, opening=1.1), row("narrow", 1., slip=1.01)
    error = {**dict.fromkeys(n.COLUMNS, 0.), "opening": 0.2, "slip": -0.5, "sliding_safety": 9.}
    typical = ((0.04 + 0.25) / 6) ** 0.5
    n.judge([wide, narrow], error, 0.05, {})
    expect(abs(wide["errors"]["opening"] - typical) < 1e-12 and wide["errors"]["slip"] == 0.5 and abs(wide["errors"]["crest"] - typical) < 1e-12, f"{wide}")
    expect(wide["verdict"] == n.MATTERS and wide["reason"] == "largest slip", f"{wide}")
    expect(abs(narrow["errors"]["slip"] - 0.1) < 1e-9 and narrow["verdict"] == n.UNKNOWN and "largest slip" in narrow["reason"], f"{narrow}")
    own = {**row("own mesh", 1., slip=1.01), "reference": "scene"}
    n.judge([own], error, 0.05, {})
    expect(own["verdict"] == n.UNIMPORTANT and own["errors"] == {}, f"{own}")
    motions(n, base)
    work(n, base)
    attempts(n, base)


def motions(n, base):
    """Paired changes over motions: exactly 1 without effect, the same in any order; a change below the scatter; a median that is not known."""
    from voussoir.needs_command import Needs
    sizes = (1., 3., 0.2, 7., 1.7, 0.9, 2.3, 1.1)
    scene = {k: {name: size * value for name, value in base.items()} for k, size in enumerate(sizes)}
    found = n.paired(scene, scene)
    expect(found["n"] == 8 and all(ratio == 1. for ratios in found["ratios"].values() for ratio in ratios), f"{found}")
    expect(not any(found["counts"].values()) and all(change == 0. for change in found["changes"].values()), f"{found}")
    ratios = (1.12, 1.1, 1.08, 1.11, 1.09, 1.3, 1.1, 0.9)
    changed = {k: {**values, "opening": ratios[k] * values["opening"]} for k, values in scene.items()}
    found = n.paired(changed, scene)
    expect(abs(found["changes"]["opening"] - 0.1) < 1e-12 and found["changes"]["slip"] == 0. and found["counts"]["opening"], f"{found}")
    order = (5, 2, 7, 0, 1, 6, 3, 4)
    shuffled = n.paired({k: changed[old] for k, old in enumerate(order)}, {k: scene[old] for k, old in enumerate(order)})
    for key in ("changes", "low", "high", "counts", "n"):
        expect(shuffled[key] == found[key], f"{key} depends on the order: {shuffled}, {found}")
    few = n.paired({k: changed[k] for k in (1, 4)}, scene)  # a row that has fewer motions than the scene
    expect(few["n"] == 2 and abs(few["changes"]["opening"] - 0.095) < 1e-12 and few["low"]["opening"] is None, f"{few}")
    none = n.paired({0: {**base, "slip": None}}, {0: base})
    expect(none["changes"]["slip"] == -1. and none["counts"]["slip"], f"{none}")
    scatter = n.scatter_of(scene)
    expect(abs(scatter["opening"] - (2.916 - 0.912) / 2 / 1.4) < 1e-12 and n.scatter_of({0: base, 1: base})["opening"] is None, f"{scatter}")
    row = {"group": "x", "name": "x", "set": {}, "reference": "scene", "motions": {0: scene[0]}, **found}
    run = {"motions": {k: scene[k] for k in (1, 3)}, "where": {}, "pace": 1., "changes": {}}
    Needs.adopt(row, run, {"motions": scene, "pace": 1.}, "batch")
    n.judge([row], {}, 0.05, {})
    expect(row["reason"] == "largest opening; the batch has no results of motions 1, 3, 5, 6, 7, 8", f"{row}")
    del row["missing"]
    for of, verdict in ((scatter, n.BELOW), ({"opening": 0.05}, n.MATTERS), ({}, n.MATTERS), ({"slip": 0.05}, n.MATTERS), ({"slip": 0.2}, n.BELOW)):
        n.judge([row], {}, 0.05, of)
        expect(row["verdict"] == verdict and row["reason"] == "largest opening", f"{row}")
    wild = {k: {**values, "opening": (0.5 if k % 2 else 1.52) * values["opening"]} for k, values in scene.items()}
    row = {**row, **n.paired(wild, scene)}
    n.judge([row], {}, 0.05, scatter)
    expect(abs(row["changes"]["opening"]) < 0.05 and row["verdict"] == n.UNKNOWN and "largest opening" in row["reason"], f"{row}")
    expect(abs(row["errors"]["opening"] - 1.2533 * 0.51 / 8 ** .5) < 1e-4, f"{row['errors']}")


def work(n, base):
    """Rows that the smallest scene may adopt get all motions before the others; an attempt has half of the work that is left."""
    from types import SimpleNamespace
    from voussoir.needs_command import Needs
    command, order = Needs.__new__(Needs), []
    kinds = {"dear": (True, "single", 1.1), "batch": (True, "batch", 0.5), "cheap": (True, "single", 0.5), "other": (False, "single", 0.5)}
    command.rows = [{"group": "x", "name": name, "simpler": simpler, "mode": mode, "cost": cost, "reference": "coarse", "motions": {}}
                    for name, (simpler, mode, cost) in kinds.items()]

    def run_row(row, motion):
        order.append(f"{row['name']} {motion}")
        if (row["name"], motion) == ("other", 1):
            return {"failure": "not run: cost limit"}
        row["motions"][motion] = base
        return {"work": 1.}

    command.run_row, command.jobs, command.numbers, command.done, command.began = run_row, 1, range(3), 1, 0.
    command.run_all()
    expect(order == ["dear 0", "batch 0", "cheap 0", "other 0", "cheap 1", "cheap 2", "dear 1", "other 1", "dear 2"], f"{order}")
    spent = SimpleNamespace(spent=0., length=1.)

    def run(cost, motion):
        spent.spent += cost
        return {"motions": {motion: base}, "where": {}, "setup": 0., "pace": cost}

    def reference(mesh, motion, whole):
        key = (mesh, motion, whole)
        if key not in command.found:
            command.found[key] = run(1., motion)
        return command.found[key]

    spent.run = lambda name, changes, motion, whole, limited: run(0.5, motion)
    command.runs, command.reference, command.predicted, command.total, command.found, command.target = spent, reference, 1., 20., {}, 0.05
    for n_motions, left in ((6, 11.), (7, 6.5), (6, 3.5), (3, 2.)):  # the scene itself is run once with each motion
        found = command.compare_by("single", "x", [{"cost": 0.5}], {}, range(8))
        expect(found["n"] == n_motions and found["holds"] and found["cost"] == 0.5 and 20. - spent.spent == left, f"{found}, {spent.spent}")
    expect("failure" in command.compare_by("single", "x", [{"cost": 3.}], {}, [0]), "an attempt above the limit")


def attempts(n, base):
    """Rows are added up to 1.5 times the target above the measured changes, if this holds and is cheaper; a row that is taken back does not return."""
    from unittest import mock
    from voussoir import needs_command

    def row(name, cost, opening):
        found = n.paired({0: {**base, "opening": opening * base["opening"]}}, {0: base})
        return {"group": "x", "name": name, "simpler": True, "set": {name: "1"}, "cost": cost, "verdict": n.UNIMPORTANT, "errors": {}, **found}

    rows = [row("a", 0.5, 0.96), row("b", 0.6, 0.97), row("c", 0.7, 0.975)]
    expect([r["name"] for r in n.cheapest(rows, 0.05)] == ["a"], "a alone: b and c change the opening by 5.5 %")
    expect([r["name"] for r in n.cheapest(rows[1:], 0.05, row("a", 9., 0.99))] == ["b"] and n.cheapest(rows, 0.05, {**rows[2], "set": {"b": 1}}) == [], "measured")
    unsure = [{**row(name, 0.6, opening), "verdict": n.BELOW, "errors": {"opening": 0.02}} for name, opening in (("d", 0.94), ("e", 0.92))]
    expect(n.candidates_of([*unsure, *rows]) == rows and n.candidates_of([*unsure, *rows], 0.05) == [rows[0], unsure[0], *rows[1:]], "5 % and an error of 2 %")
    for results, tried, final in ((((True, -0.01, 0.5), (True, -0.04, 0.3)), ["a", "a b c"], "a b c"),
                                  (((True, -0.01, 0.5), (False, -0.06, 0.3), (True, -0.03, 0.4)), ["a", "a b c", "a b"], "a b"),
                                  (((True, -0.021, 0.5), (True, -0.051, 0.4)), ["a", "a b"], "a b"),  # c would be 7.6 %
                                  (((True, -0.021, 0.5), (False, -0.06, 0.4), (False, -0.06, 0.4)), ["a", "a b", "a c"], "a"),
                                  (((True, -0.021, 0.5), (True, -0.01, 0.6), (True, -0.01, 0.45)), ["a", "a b", "a c"], "a c"),
                                  (((True, -0.021, 0.5), (None, 0., 0.4)), ["a", "a b"], "a"), (((True, -0.051, 0.5),), ["a"], "a"), (((None, 0., 0.5),), ["a"], "a"),
                                  (((False, -0.06, 0.5), (True, -0.01, 0.6), (True, -0.02, 0.5)), ["a", "b", "b c"], "b c"),
                                  (((True, -0.01, 0.5), (True, -0.03, 0.4)), ["a", "a d"], "a d"),  # with the rows that are not sure
                                  (((False, -0.06, 0.5), (False, -0.06, 0.6), (False, -0.06, 0.7)), ["a", "b", "c"], "")):
        command, left, seen = needs_command.Needs.__new__(needs_command.Needs), list(results), []
        command.rows = [rows[0], *unsure] if "a d" in tried else rows
        command.target, command.scene, command.settings, command.directory = 0.05, Path("scene.prm"), [], Path(".")

        def compare(name, chosen, changes):
            holds, opening, cost = left.pop(0)
            seen.append(" ".join(r["name"] for r in chosen))
            changed = n.paired({0: {**base, "opening": (1. + opening) * base["opening"]}}, {0: base})
            return {"holds": holds, "cost": cost, **(changed if holds is not None else {"failure": "not run"})}

        command.compare = compare
        text_of = lambda scene, settings, chosen, target, directory: ("|".join(r["name"] for r in chosen) + "\n# Entries", {r["name"]: "1" for r in chosen})
        with mock.patch.object(needs_command, "smallest_text", text_of):
            found = command.smallest()
        text = Path("smallest.prm").read_text()
        expect(seen == tried and not left and found["rows"] == [f"x: {name}" for name in final.split()], f"{results}: {seen}, {found['rows']}")
        expect(text.startswith(final.replace(" ", "|") + "\n# The promise of 5 % ") and len(found["attempts"]) == len(tried) + (not final), f"{text}")


def table():
    """A table of few rows: a row that fails has its reason, the changes are those of separate runs, a second command runs nothing."""
    import voussoir as package
    write_scene()
    stand_in(ROWS)
    arguments = ["--seconds", "1", "--jobs", "2", "--output", "out", *LONG, "--", "scene.prm"]
    text, _ = needs(*arguments)
    print(text)
    for part in ("tied", "largest opening", "matters", "times one run of the scene", "needs.csv", "One motion: the effects"):
        expect(part in text, f"'{part}' is missing: {text}")
    rows = rows_of("out")
    expect(list(rows) == [row["name"] for row in ROWS], f"{list(rows)}")
    expect(rows["tied"]["verdict"] == "matters" and rows["tied"]["changes"]["opening"] == -1., f"{rows['tied']}")
    expect(rows["no such material"]["verdict"] == "not known" and "Concrete/Density" in rows["no such material"]["reason"], f"{rows['no such material']}")
    expect(rows["contact tolerance 1e-6"]["verdict"] == "does not matter" and rows["tied"]["n"] == 1, f"{rows['contact tolerance 1e-6']}")
    # Of separate runs over the same part of the motion
    part = next(Path("out/motions").glob("????????????????.csv"))
    same = ["scene.prm", "--set", f"Motion/File={part.resolve()}", "--set", "Motion/Unit=m/s^2", "--set", "Motion/Duration=-1"]
    runs(*same, "--output", "base")
    runs(*same, "--set", "Motion/Scale z=0", "--output", "flat")
    before, after = (summary(d)["extremes"]["max_opening"]["value"] for d in ("base", "flat"))
    told = rows["no vertical component"]["changes"]["opening"]
    print(f"    no vertical component: {told}, separate runs {after / before - 1}")
    expect(abs(told - (after / before - 1)) < 1e-6, "the change is not that of separate runs")
    with open("out/needs.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    expect(len(lines) == len(ROWS) and abs(float(lines[2]["change_opening"]) - told) < 1e-5 * abs(told) + 1e-9, f"{lines[2]}")
    expect(Path("out/tornado_opening.png").stat().st_size > 5000, "the chart is empty")
    # From Python, with fewer groups: the same rows, and no run is repeated.
    stamps = {path: path.stat().st_mtime_ns for path in Path("out/runs").glob("*/summary.json")}
    os.environ["VOUSSOIR_PROGRAM"] = str(Path("program").resolve())
    again = package.needs("scene.prm", 0.05, 1., 2, only="numerics, motion", output="out", settings=["Motion/Duration=2"])
    expect([row["group"] for row in again] == ["motion", "numerics"] and again[0]["changes"] == rows["no vertical component"]["changes"], f"{again}")
    expect(len(stamps) >= 5 and stamps == {path: path.stat().st_mtime_ns for path in Path("out/runs").glob("*/summary.json")}, "runs are repeated")
    report()


def report():
    """The report of a run of the same scene has the table; of another scene it has a remark."""
    from voussoir import report_needs, runs as package_runs
    os.rename("out", "scene-needs")
    runs("scene.prm", *LONG, "--output", "run")
    result = subprocess.run([sys.executable, ROOT / "scripts" / "report.py", "--", "run"], capture_output=True, text=True, timeout=100)
    expect(result.returncode == 0, result.stderr)
    page = Path("run/report.html").read_text()
    expect("What the scene needs" in page and "no vertical component" in page, "the table is not in the report")
    runs("scene.prm", *LONG, "--set", "Joints/Friction=0.7", "--output", "run")
    try:
        report_needs.needs_of(package_runs.Run("run"))
        raise AssertionError("a run with another friction has the table of this scene")
    except package_runs.Skip as reason:
        expect("Joints/Friction differs" in str(reason), f"{reason}")


def smallest():
    """The smallest scene is written with a comment for each changed line; its comparison is that of its own run over the whole motion."""
    write_scene()
    finer = {"Dynamics/Steps per sample": "32", "Mesh/Arch210/Elements along": "12"}
    rows = [{"group": "numerics", "name": "longer time step", "set": {"Dynamics/Steps per sample": "4"}, "simpler": True},
            {"group": "numerics", "name": "elements along half", "set": {"Mesh/Arch210/Elements along": "6"}, "simpler": True}]
    stand_in(rows)
    settings = [word for entry, value in finer.items() for word in ("--set", f"{entry}={value}")]
    text, _ = needs("--for", "90%", "--seconds", "1", "--output", "out", *LONG, *settings, "--", "scene.prm")
    print(text)
    found = json.loads(Path("out/needs.json").read_text())["smallest"]
    expect(found["rows"] and found["holds"] is True, f"{found}")
    lines = Path("out/smallest.prm").read_text().splitlines()
    place = next(i for i, line in enumerate(lines) if "set Steps per sample" in line)
    remark = " ".join(line.strip("# ") for line in lines[place - 3:place])
    expect("# The promise of 90 % holds at " in "\n".join(lines[:3]), f"{lines[:3]}")
    expect("= 4" in lines[place] and 'longer time step, instead of "32"' in remark and "cost x" in remark, f"{lines}")
    # The file can be run as it is, and gives what the table says.
    runs("out/smallest.prm", "--output", "again")
    runs("scene.prm", *LONG, *settings, "--output", "full")
    small, full = (summary(d)["extremes"]["max_opening"]["value"] for d in ("again", "full"))
    expect(abs(small / full - 1 - found["changes"]["opening"]) < 1e-6, f"{small / full - 1}, {found['changes']}")


def ensemble():
    """Eight motions in batches: a row without effect has the ratio 1 and the cost 1; a motion of the scene's own ensemble has
    the same ratio beside others; a law without batches is compared motion by motion."""
    write_scene()
    stand_in([{"group": "joints", "name": "without effect", "set": {"Limits/Opening": "1"}, "simpler": True},
              {"group": "joints", "name": "weaker friction", "set": {"Joints/Friction": "0.45"}, "simpler": False},
              {"group": "material", "name": "KSM", "set": {"Joints/Model": "KSM"}, "simpler": False}])
    artificial = ["--seconds", "0.6", "--set", "Motion/Source=artificial", "--set", "Motion/File=", "--set", "Motion/Duration=1.28"]
    text, _ = needs(*artificial, "--only", "joints", "--output", "eight", "--", "scene.prm")
    print(text)
    found = json.loads(Path("eight/needs.json").read_text())
    none, friction = found["rows"]
    expect(none["mode"] == friction["mode"] == "batch" and none["n"] == friction["n"] == 8, f"{found['rows']}")
    expect(none["ratios"]["opening"] == [1.] * 8 and none["cost"] == 1. and none["verdict"] == "does not matter", f"{none}")
    expect(found["scatter"]["opening"] > 0.01 and found["scatter"]["crest"] is None and "scatter between the motions" in text, f"{found['scatter']}")
    expect(len(set(friction["ratios"]["opening"])) > 4 and friction["ratios"]["crest"][1:] == [], f"{friction}")
    needs(*artificial, "--set", "Motion/Ensemble=3; 1-2", "--output", "mixed", "--", "scene.prm")
    mixed, ksm = rows_of("mixed")["weaker friction"], rows_of("mixed")["KSM"]
    expect(ksm["mode"] == "single" and ksm["n"] == len(ksm["ratios"]["crest"]) == 3, f"{ksm}")
    expect(mixed["n"] == 3 and mixed["ratios"]["slip"] == [friction["ratios"]["slip"][k] for k in (2, 0, 1)], f"{mixed} depends on other motions: {friction}")


def own_scheme():
    """The smallest scene of rows in batches is also compared with the scheme of the scene and one motion: the changes are those of separate runs with
    this scheme, and decide the promise."""
    from voussoir.needs_command import Needs
    command = Needs.__new__(Needs)
    command.entries, command.numbers = {"Dynamics/Scheme": "implicit"}, range(3)
    shown = {"batch": {"holds": True, "cost": 0.3, "within": 7, "changes": 1}, "single": {"holds": False, "cost": 0.4, "within": 6, "changes": 2}}
    command.compare_by = lambda mode, name, chosen, changes, numbers: dict(shown[mode], numbers=numbers)
    row, expected = {"mode": "batch"}, {**shown["single"], "numbers": [0]}
    expect(command.compare("x", [row], {}) == {**expected, "changes": 1, "numbers": [None], "own_scheme": expected}, "the scheme of the scene decides")
    expect("own_scheme" not in command.compare("x", [row], {"Dynamics/Scheme": "explicit"}), "a smallest scene with the explicit scheme")
    expect(command.compare("x", [row, {"mode": "single"}], {}) == {**shown["single"], "numbers": [0, 1, 2]}, "a row without batches")
    shown["batch"]["holds"] = False
    expect(command.compare("x", [row], {})["cost"] == 0.3, "a promise that does not hold already")
    write_scene()
    stand_in([{"group": "numerics", "name": "elements through half", "set": {"Mesh/Arch210/Elements through": "1"}, "simpler": True}])
    words = settings("Motion/Source=artificial", "Motion/File=", "Motion/Duration=1.28", "Motion/Ensemble=2-4", "Mesh/Arch210/Elements through=2")
    text, _ = needs("--for", "150%", "--seconds", "0.6", "--output", "out", *words, "--", "scene.prm")
    print(text)
    found = json.loads(Path("out/needs.json").read_text())
    smallest, own = found["smallest"], found["smallest"]["own_scheme"]
    expect(found["rows"][0]["mode"] == "batch" and smallest["n"] == 3 and own["n"] == 1 and "with the scheme of the scene:" in text, f"{smallest}")
    expect(smallest["holds"] is own["holds"] is True and smallest["cost"] == own["cost"], f"{smallest}")
    alone = settings("Motion/Ensemble=", "Motion/Seed=2")
    runs("scene.prm", *words, *alone, "--output", "full")
    runs("out/smallest.prm", *alone, "--output", "small")
    for column, extreme in (("opening", "max_opening"), ("slip", "max_slip")):
        small, full = (summary(d)["extremes"][extreme]["value"] for d in ("small", "full"))
        expect(abs(small / full - 1 - own["changes"][column]) < 1e-6 and own["changes"][column] != smallest["changes"][column],
               f"{column}: {small / full - 1}, {own['changes']}, batch {smallest['changes']}")


def stopped():
    """A command that is stopped goes on: finished runs stay, the others follow."""
    write_scene()
    stand_in(ROWS)
    words = [sys.executable, ROOT / "scripts" / "needs.py", "--seconds", "1", "--jobs", "1", "--output", "out", *LONG, "--", "scene.prm"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, "VOUSSOIR_PROGRAM": str(Path("program").resolve())}) as process:
        end = time.monotonic() + 60
        while not list(Path("out/records").glob("joints-*.json")) and time.monotonic() < end:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=60)
    expect(process.returncode == 1 and "the same command goes on" in messages, messages)
    stamps = {path: path.stat().st_mtime_ns for path in Path("out/runs").glob("*/summary.json")}
    expect(0 < len(stamps) < 5, f"{list(stamps)}")
    needs(*words[2:])
    after = {path: path.stat().st_mtime_ns for path in Path("out/runs").glob("*/summary.json")}
    finished = {path for path in stamps if "result" in json.loads(Path("out/records", f"{path.parent.name}.json").read_text())}
    kept = [path for path in finished if stamps[path] == after[path]]
    expect(len(after) >= 6 and kept == list(finished) and len(kept) >= len(stamps) - 1, f"kept {kept} of {list(stamps)}")


def declared():
    """`voussoir needs` with the rows that the program itself declares."""
    write_scene()
    result = voussoir("scene", "scene.prm", "--choices")
    expect(result.returncode == 0, result.stderr)
    rows = json.loads(result.stdout)["choices"]
    groups = {row["group"] for row in rows}
    print(f"    {len(rows)} rows in the groups {', '.join(sorted(groups))}")
    expect({"joints", "water", "numerics"} <= groups, f"{groups}")
    base = ("Mesh/Arch210/Base joint=true", "Joints/Overrides=base: FJA")
    of_base = json.loads(runs("scene", "scene.prm", "--choices", *settings(*base)))["choices"]
    keys = next(row["set"] for row in of_base if row["name"] == "KSM")
    runs("scene.prm", "--validate", *settings(*base, *(f"{entry}={value}" for entry, value in keys.items())))  # the base has no keys
    staged = json.loads(runs("scene", "scene.prm", "--choices", *settings("Statics/Stages=fill 60, grout 210")))["choices"]
    impossible = {"empty reservoir", "self-weight monolithic", "tied"}
    expect(impossible <= {row["name"] for row in rows} and not impossible & {row["name"] for row in staged}, f"{staged}")
    text = runs("needs", "scene.prm", "--only", "joints", "--seconds", "0.5", "--output", "out", *LONG)
    found = json.loads(Path("out/needs.json").read_text())
    expect({row["group"] for row in found["rows"]} == {"joints"} and "tied" in text, text)
    expect(found["total_cost"] <= 10, f"{found['total_cost']} times one run")


def on_rock():
    """Scenes on massless rock and on rock with mass: rows of the foundation and of cheaper numerics. A row has the substeps that it requires."""
    write_scene()
    rows = {"massless": [{"group": "foundation", "name": "rigid", "set": {"Foundation/Model": "rigid"}, "simpler": True},
                         {"group": "numerics", "name": "larger rock elements", "set": {"Mesh/Arch210/Rock/Element size": "84"}, "simpler": True}],
            "rock": [{"group": "foundation", "name": "massless", "set": {"Foundation/Model": "massless"}, "simpler": True},
                     {"group": "foundation", "name": "stiffer rock", "set": {"Foundation/Young's modulus": "6e10"}, "simpler": False}]}
    changes = {}
    for model, declared_rows in rows.items():
        stand_in([*declared_rows, {"group": "joints", "name": "tied", "set": {"Joints/Model": "tied"}, "simpler": True}])
        settings = [word for entry in (f"Foundation/Model={model}", "Mesh/Arch210/Rock/Element size=60", "Motion/Duration=0.5",
                                       "Dynamics/Steps per sample=4", "Foundation/Substeps=1") for word in ("--set", entry)]
        text, _ = needs("--only", "rock, numerics", "--seconds", "0.3", "--output", model, *settings, "--", "scene.prm")
        print(text)
        found = rows_of(model)
        expect(list(found) == [row["name"] for row in declared_rows], f"{list(found)}")
        expect(all(row["verdict"] != "not known" and row["cost"] > 0. for row in found.values()), f"{found}")
        changes[model] = {name: row["changes"]["slip"] for name, row in found.items()}
    expect(abs(changes["massless"]["rigid"]) > 0.05 and abs(changes["rock"]["massless"]) > 0.05, f"{changes}")
    extra = rows_of("rock")["stiffer rock"]["extra"]
    expect(int(extra.get("Foundation/Substeps", 0)) > 1, f"{extra}")


def bad_input():
    """One paragraph each."""
    write_scene()
    stand_in(ROWS)
    for arguments, parts in ((["--only", "wood"], ("--only", "wood", "water")), (["--only", "water"], ("no choice", "water")),
                             (["--for", "0%"], ("--for", "positive")), (["--for", "5"], ("--for", "with its %")), (["--seconds", "no"], ("--seconds", "no")),
                             (["--jobs", "0"], ("--jobs", "0")), (["--mesh", "fine"], ("--mesh", "fine")),
                             (["--set", "Motion/Source=none"], ("no motion", "Motion/Source")),
                             (["--output", "scene.prm"], ("scene.prm", "--output")),
                             (["--set", "Joints/Friction=-1"], ("Joints/Friction",)),
                             (["--set", "Contact/Tolerance=1e-15", "--set", "Contact/Maximum iterations=1"],
                              ("scene.prm failed", "static"))):
        output = [] if "--output" in arguments else ["--output", "out"]
        _, messages = needs("--seconds", "1", *LONG, *arguments, *output, "--", "scene.prm", status=1 if "static" in parts else 2)
        lines = [line for line in messages.splitlines() if not line.startswith("voussoir: warning: ")]
        expect(len(lines) == 1 and re.match("voussoir: (error|failed): ", lines[0]), f"{messages}")
        for part in parts:
            expect(part in lines[0], f"'{part}' is missing: {lines[0]}")
        print("   ", lines[0])
    _, messages = needs(status=2)
    expect("one scene file" in messages, messages)
    Path("taken").mkdir()
    with open("taken/.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        _, messages = needs("--output", "taken", "--", "scene.prm", status=2)
    expect("Another `voussoir needs` is running in" in messages and "--output" in messages and not list(Path("taken/runs").glob("*")), messages)


if __name__ == "__main__":
    run_cases(verdicts, table, smallest, ensemble, own_scheme, stopped, declared, on_rock, bad_input)
