#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the ways in: the Python package, the mesher of arcs, the tutorials.

    program_package.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from browser import Browser, find_browser
from run_program import VOUSSOIR, expect, frequencies, refused, run_cases, runs, summary, write, write_scene

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))


def package():
    """run() and load() give what is in the files."""
    import numpy as np
    import voussoir
    from voussoir import program
    os.environ["VOUSSOIR_PROGRAM"] = VOUSSOIR
    write_scene()
    run = voussoir.run("scene.prm", "out", {"Joints/Model": "FJB", "Motion/Duration": 0.3, "Output/Figures": False}, threads=1)
    expect(run.summary == json.loads(Path("out/summary.json").read_text()) and run.summary["law"] == "FJB", f"{run.summary}")
    for name in ("history", "joints", "joint_history", "energy", "faces"):
        table = getattr(run, name)
        with open(f"out/{name}.csv", newline="") as file:
            rows = list(csv.reader(file))
        expect(list(table) == rows[0], f"{name}: {list(table)}")
        for i, column in enumerate(rows[0]):
            texts = [row[i] for row in rows[1:]]
            same = list(table[column]) == (texts if column == "face" else [float(text) for text in texts])
            expect(same, f"{name}: {column}")
    expect(len(run.history["time"]) == 31 and run.faces["face"].dtype.kind == "U", "types")
    try:
        import meshio  # noqa: F401
    except ImportError:
        print("    without meshio")
    else:
        mesh = run.mesh()
        expect(len(mesh.points) > 0 and np.isfinite(mesh.points).all(), "no points")
    Path("failing").write_text('#!/bin/sh\necho "voussoir: failed: no result" >&2\nexit "$1"\n')
    Path("failing").chmod(0o755)
    for status, kind in (("1", voussoir.ComputationError), ("2", voussoir.InputError)):
        try:
            program.call(status, program=Path("failing").resolve())
            raise AssertionError(f"status {status} is no error")
        except (voussoir.InputError, voussoir.ComputationError) as error:
            expect(type(error) is kind and str(error) == "no result", f"status {status}: {error!r}")
    again = voussoir.load("out")
    expect((again.history["crest_x"] == run.history["crest_x"]).all(), "load")
    expect(voussoir.scene("scene.prm", {"Joints/Friction": 0.5})["Joints/Friction"] == "0.5", "scene")
    for call, kind, parts in ((lambda: voussoir.run("scene.prm", "bad", {"Joints/Frictoin": 1}), voussoir.InputError, ("Joints/Friction",)),
                              (lambda: voussoir.run("nowhere.prm", "bad"), voussoir.InputError, ("nowhere.prm",)),
                              (lambda: voussoir.load("nowhere"), voussoir.InputError, ("nowhere",)),
                              (lambda: run.table("nothing"), voussoir.InputError, ("nothing.csv",)),
                              (lambda: voussoir.run("scene.prm", "bad", program="/nowhere"), voussoir.InputError, ("/nowhere",))):
        try:
            call()
        except kind as error:
            expect(all(part in str(error) for part in parts), f"{error}")
            print("   ", error)
        else:
            raise AssertionError(f"no error: {parts}")
    damaged(run, voussoir)


def damaged(run, voussoir):
    """Files that are damaged are InputErrors, with file and line; the last line of a run that was killed is left out."""
    shutil.copytree("out", "broken")
    broken = voussoir.load("broken")
    lines = Path("out/history.csv").read_text().splitlines()
    write("broken/history.csv", "\n".join([*lines[:5], lines[5][:9]]))
    expect((broken.history["time"] == run.history["time"][:4]).all(), f"{broken.history['time']}")
    write("broken/short.csv", "\n".join([*lines[:3], "1,2", *lines[3:]]) + "\n")
    write("broken/long.csv", "\n".join([*lines[:3], lines[3] + ",7"]) + "\n")
    Path("broken/binary.csv").write_bytes(b"\xff\xfe\x00")
    write("broken/endless.csv", "a,b\n1," + 200000 * "x" + "\n")
    write("broken/summary.json", Path("out/summary.json").read_text()[:40])
    write("broken/bad.vtu", "no mesh")
    calls = [(lambda: broken.table("short"), ("short.csv is damaged", "line 4 has 2 values")), (lambda: broken.table("long"), ("long.csv is damaged", "line 4")),
             (lambda: broken.table("binary"), ("binary.csv", "no table")),
             (lambda: broken.table("endless"), ("endless.csv", "no table")), (lambda: broken.summary, ("summary.json", "not valid JSON"))]
    try:
        import meshio  # noqa: F401
        calls.append((lambda: broken.mesh("bad.vtu"), ("bad.vtu", "mesh")))
    except ImportError:
        pass
    for call, parts in calls:
        try:
            call()
        except voussoir.InputError as error:
            expect(all(part in str(error) for part in parts), f"{error}")
            print("   ", error)
        else:
            raise AssertionError(f"no error: {parts}")


def arcs():
    """`voussoir arcs`: the scene of a table runs on every foundation; the two measured dams of meshes/."""
    def write_scene_of(table, *options, status=0):
        result = subprocess.run([VOUSSOIR, "arcs", table, *options], capture_output=True, text=True)
        expect(result.returncode == status, f"status {result.returncode}: {result.stdout}{result.stderr}")
        print("   ", (result.stdout + result.stderr).strip())
        return result.stdout + result.stderr

    head = "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"
    # A part of a ring, 30 and 40 degrees, without a valley: half angle times (R^2 - r^2) times height
    write("ring.csv", head + "0,0,100,20,80,30,40\n60,0,100,20,80,30,40\n")
    Path("scenes").mkdir()
    text = write_scene_of("ring.csv", "--output", "scenes/own.prm")
    volume = math.radians(70) / 2 * (100**2 - 80**2) * 60
    found = float(re.search(r"volume (\d+) m3", text)[1])
    expect(abs(found / volume - 1) < 2e-3, f"volume {found}, ring {volume}")
    expect(abs(float(re.search(r"crest ([\d.]+) m", text)[1]) - math.radians(70) * 90) < .2, text)
    expect("../ring.csv" in Path("scenes/own.prm").read_text() and "5 joints" in text, "the scene")
    # The generated rock supports the base only, not walls at the ends
    refused(["scenes/own.prm", "--validate", "--set", "Foundation/Model=massless"], "wall of 60 m", "right bank", "rigid")
    write("valley.csv", head + "0,-4,60,14,42,25,27\n30,-8,75,12,58,38,41\n60,-7,90,9,76,47,49\n90,0,100,4,96,53,55\n")
    write_scene_of("valley.csv", "--output", "scenes/valley.prm")
    coarse = ["--set", "Mesh/Arcs/Elements up=4", "--set", "Mesh/Arcs/Rock/Element size=30"]
    shown = {model: runs("scenes/valley.prm", "--validate", "--set", f"Foundation/Model={model}", *coarse) for model in ("rigid", "massless", "rock")}
    for model, text in shown.items():
        expect("10 monoliths" in text and ("rock 1000" in text) == (model != "rigid"), f"{model}: {text}")
    # A low, wide dam: its end monoliths are low
    write("low.csv", head + "100,0,60,20,40,20,22\n115,0,60,14,46,33,30\n128,0,60,8.5,51.5,35,32\n130,0,60,8,52,45,42\n")
    expect("height 30.0 m" in write_scene_of("low.csv"), "a low dam")
    expect("Smallest height = 1.25" in Path("low.prm").read_text(), Path("low.prm").read_text())
    runs("low.prm", "--validate")
    expect("#" in write_scene_of("a#b.csv", status=2), "a comment in the name")
    expect("exists" in write_scene_of("ring.csv", "--output", "scenes/own.prm", status=2), "no file is replaced")
    expect("no directory nowhere" in write_scene_of("ring.csv", "--output", "nowhere/own.prm", status=2), "no directory")
    expect("--kind" in write_scene_of("ring.csv", "--kind", "round", status=2), "an unknown kind")
    expect("upstream_x" in write_scene_of("column.csv" if write("column.csv", "elevation,thickness\n1,2\n") else "", status=2), "a missing column")
    first = [frequencies(runs("modes", "scenes/valley.prm", *coarse, "--count", "1", "--set", "Foundation/Model=massless", "--set",
                              f"Foundation/Young's modulus={young:g}"))[0] for young in (1e15, 1e10)]
    print("    first frequency on rock of 1e15 and of 1e10 Pa:", first)
    expect(first[1] < .9 * first[0], f"soft rock does not show: {first}")
    # Morrow Point on a rigid base, empty: 3.81 and 4.27 Hz are quoted (doc/mesh.md); the table has its outer dimensions and its volume
    text = write_scene_of(str(ROOT / "meshes" / "morrow_point.csv"), "--output", "morrow_point.prm")
    expect(abs(float(re.search(r"volume (\d+) m3", text)[1]) / 275e3 - 1) < .03, text)
    text = runs("modes", "morrow_point.prm", "--count", "2", "--set", "Reservoir/Density=0", "--set", "Concrete/Young's modulus=27.6 GPa",
                "--set", "Concrete/Density=2483", "--set", "Concrete/Poisson's ratio=0.2")
    found = frequencies(text)
    print(f"    Morrow Point: {found} Hz")
    expect(abs(found[0] / 3.81 - 1) < .05 and abs(found[1] / 4.27 - 1) < .05, f"{found}")
    # Pacoima on massless rock, empty: 5.1 and 5.2 Hz are published for another model (doc/mesh.md); dimensions and volume are its own
    text = write_scene_of(str(ROOT / "meshes" / "pacoima.csv"), "--output", "pacoima.prm")
    expect(abs(float(re.search(r"volume (\d+) m3", text)[1]) / 168.2e3 - 1) < .03, text)
    expect(abs(float(re.search(r"crest ([\d.]+) m", text)[1]) - 179.5 * (98 - 3.17 / 2) / 98) < .5, "the crest of Pacoima")  # 179.5 m upstream
    text = runs("modes", str(ROOT / "benchmarks" / "pacoima.prm"), "--count", "2", "--set", "Mesh/Arcs/Elements along=22", "--set",
                "Mesh/Arcs/Elements up=7", "--set", "Reservoir/Density=0")
    found = frequencies(text)
    print(f"    Pacoima: {found} Hz")
    expect(abs(found[0] / 5.1 - 1) < .1 and abs(found[1] / 5.2 - 1) < .1, f"{found}")


def blocks(page):
    """(remarks, text) of each fenced block: remarks are the HTML comments right above it, {"file": NAME, "small": OPTIONS...}."""
    found, remarks, lines = [], {}, iter(page.read_text().splitlines())
    for line in lines:
        if match := re.fullmatch(r"<!-- (file|small|not run): (.*) -->", line):
            remarks[match[1]] = match[2]
        elif line.startswith("```"):
            text = []
            for inner in lines:
                if inner == "```":
                    break
                text.append(inner)
            found.append(({**remarks, "language": line[3:]}, "\n".join(text) + "\n"))
            remarks = {}
        elif line.strip():
            remarks = {}
    return found


ARCS = r"--set Mesh/Arcs/Elements\ along=16 --set Mesh/Arcs/Elements\ up=3 --set Mesh/Arcs/Elements\ through=1 --set Motion/Duration=0.24"
ROCK = r"--set Mesh/Arcs/Rock/Element\ size=60"
SMALLER = {"2_own_dam": f"{ARCS} {ROCK}"}  # of commands with a scene, after those of the page


def shortened(text, page, options, drawn):
    """The commands of a block with the options that make them small, before a redirection. drawn: if not empty, the runs are without figures,
    except on the first page."""
    lines = []
    for line in text.splitlines():
        more = options
        if re.match(r"voussoir (\w+ )?\w+\.prm", line) and "Source=none" not in line:
            more += " " + SMALLER.get(page, "")
        if re.match(r"voussoir \w+\.prm.* --output", line):
            more += " --set Output/Figures=false" if drawn and page != "1_first_run" else ""
            drawn.append(line)
        lines.append(re.sub(r"^(voussoir [^>]*)", lambda m: f"{m[1]} {more}", line))
    return "\n".join(lines)


def tutorial(name):
    """Runs a page's blocks one after the other, in a directory that looks like that of the sources."""
    for folder in ("prm", "meshes", "scripts", "studies", "include", "python"):
        Path(folder).symlink_to(ROOT / folder)
    Path("build").symlink_to(Path(VOUSSOIR).parent)
    if name == "studies" and shutil.which("snakemake") is None:
        print("Snakemake is not installed")
        sys.exit(77)
    Path("bin").mkdir()
    Path("bin/python3").symlink_to(sys.executable)
    environment = {**os.environ, "PATH": f"{Path('bin').absolute()}:{Path(VOUSSOIR).parent}:{os.environ['PATH']}"}
    n, taken = 0, set()
    drawn = [] if name in ("1_first_run", "2_own_dam") else [name]
    for remarks, text in blocks(next((ROOT / "doc").rglob(f"{name}.md"))):
        if "not run" in remarks:
            continue
        if "file" in remarks:
            write(remarks["file"], text)
            continue
        expect(remarks["language"] == "sh", f"a block of {name} is neither a file nor commands: {text}")
        options = remarks.get("small", "").replace("|", r"\|")
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", shortened(text, name, options, drawn)], capture_output=True, text=True, env=environment)
        expect(result.returncode == 0, f"{text}{result.stdout[-2000:]}{result.stderr}")
        print("    " + text.strip().replace("\n", "\n    "))
        if "small" in remarks or name in SMALLER:
            would_run(text, environment, taken)
        n += 1
    expect(n > 0, f"{name} has no commands")


def would_run(text, environment, taken):
    """The commands as the page has them, at full size but for massless rock: the program takes each scene. `voussoir needs` would run it.
    taken: the scenes so far."""
    for line in text.strip().splitlines():
        scene = re.sub(r" --(output \S+|validate)", "", line)
        if scene in taken or not re.match(r"voussoir (study |motion )?\w+\.prm", line):
            continue
        taken.add(scene)
        check = "--dry-run" if line.startswith("voussoir study ") else "--validate"
        if line.startswith("voussoir motion ") or check in line:
            check = ""
        if "massless" in line or " water.prm" in line:
            check += " " + ROCK
        result = subprocess.run(["bash", "-c", f"{line} {check}"], capture_output=True, text=True, env=environment)
        expect(result.returncode == 0, f"{line} {check}: {result.stdout[-2000:]}{result.stderr}")


def states(page, output, *arguments):
    """Runs a scene at full size: the page states its largest opening and slip [mm] and the stresses of both faces [MPa], to their digits or 1 %."""
    runs(*arguments, "--output", output, "--set", "Output/Figures=false")
    text, found = " ".join(page.read_text().split()), summary(output)["extremes"]
    values = [found[f"max_{name}"]["value"] for name in ("opening", "slip", "tension_upstream_away_from_base", "tension_downstream_away_from_base")]
    values = [1e3 * values[0], 1e3 * values[1], 1e-6 * values[2], 1e-6 * values[3]]
    number = r"(\d+(?:\.\d+)?)"
    stated = [[float(x) for x in match] for match in re.findall(rf"open\w* [a-z ]*{number} mm,?[a-z ]* {number} mm[^;]*? {number} MPa upstream(?:,| and) "
                                                                rf"{number} MPa downstream", text)]
    print(f"    {page.name}: {[float(f'{value:.4g}') for value in values]} of {stated}")
    expect(any(all(abs(x - value) < max(.01 * value, .06) for x, value in zip(row, values)) for row in stated), f"{values} are not in {stated}")


def readme():
    """README has the results of the quick start, and command and table of examples/ensemble, which a test of the examples runs."""
    Path("prm").symlink_to(ROOT / "prm")
    states(ROOT / "README.md", "quickstart", "prm/quickstart.prm")
    text, example = ((ROOT / name).read_text() for name in ("README.md", "examples/ensemble/README.md"))
    lines = re.findall(r"^(?:\| .* \[(?:mm|MPa)\] .*|    build/voussoir examples.*)$", text, re.M)
    expect(len(lines) == 4, f"{lines}")
    for line in lines:
        expect(line.replace("build/", "") in example, f"examples/ensemble/README.md does not have: {line}")


def tutorial_1_first_run():
    tutorial("1_first_run")
    states(ROOT / "doc/tutorials/1_first_run.md", "full", "first.prm")
    expect(json.loads(Path("output/first_fjb/summary.json").read_text())["law"] == "FJB", "the law")
    expect(len(list(Path("output/first/figures").glob("*.png"))) >= 5, "figures")


def tutorial_2_own_dam():
    tutorial("2_own_dam")
    states(ROOT / "doc/tutorials/2_own_dam.md", "full", "own.prm")
    expect(json.loads(Path("output/own/summary.json").read_text())["mesh"]["joints"] == 7, "joints")
    found = [json.loads(Path(f"output/{name}/summary.json").read_text())["foundation"] for name in ("own", "massless", "rock")]
    expect(found == ["rigid", "massless", "rock"], f"{found}")
    expect([name for name in ("water", "westergaard") if "water" in json.loads(Path(f"output/{name}/summary.json").read_text())] == ["water"],
           "the model of the water")
    expect("Westergaard" in Path("output/water-needs/needs.csv").read_text(), "rows of the water")


def tutorial_3_own_records():
    tutorial("3_own_records")
    with open("record.csv") as one, open("as_run.csv") as two:
        before, after = ([[float(x) for x in row] for row in list(csv.reader(file))[1:]] for file in (one, two))
    worst = max(abs(1.2 * x - y) for p, q in zip(before, after) for x, y in zip(p[1:], q[1:]))
    expect(len(before) == len(after) and worst < 1e-9, f"the record as run differs by {worst}")


def tutorial_4_own_law():
    tutorial("4_own_law")


def studies():
    tutorial("studies")
    expect(len(list(Path("output/openings/runs").iterdir())) == 4, "runs")


def notebook():
    """The cells of python/paper.ipynb run in order, without Jupyter; their numbers are of FJA, FJB and keys."""
    try:
        import matplotlib  # noqa: F401
        import numpy  # noqa: F401
    except ImportError as error:
        print(f"the notebook is not tried: {error}")
        sys.exit(77)
    Path("prm").symlink_to(ROOT / "prm")
    Path("python").symlink_to(ROOT / "python")
    page = json.loads((ROOT / "python" / "paper.ipynb").read_text())
    try:
        import nbformat
        nbformat.validate(nbformat.from_dict(page))
    except ImportError:
        print("    without nbformat")
    cells = ["".join(cell["source"]) for cell in page["cells"] if cell["cell_type"] == "code"]
    expect(len(cells) > 4 and all(not cell.get("outputs") for cell in page["cells"]), f"{len(cells)} cells, with outputs?")
    write("cells.py", "space = {'__name__': '__main__'}\nfor number, cell in enumerate(" + repr(cells) + ", 1):\n"
          "    exec(compile(cell, f'cell {number}', 'exec'), space)\n")
    result = subprocess.run([sys.executable, "cells.py"], capture_output=True, text=True,
                            env={**os.environ, "MPLBACKEND": "Agg", "VOUSSOIR_PROGRAM": VOUSSOIR})
    print("    " + result.stdout.replace("\n", "\n    "))
    expect(result.returncode == 0, result.stderr)
    distance = re.search(r"KSM from FJB ([\d.]+) mm, KSM from FJA ([\d.]+) mm", result.stdout)
    expect(distance and float(distance[1]) < 1 < float(distance[2]), "tight keys are not like FJB")
    expect(all(Path(f"output/notebook/{name}/summary.json").is_file() for name in ("fja", "fjb", "ksm", "play")), "runs")


def report():
    tutorial("report")
    page = Path("report.html").read_text()
    expect(all(f"motion_{n}" in page for n in (1, 2, 3)), "a run is not in the report")
    limits = summary("output/motion_1")["limits"]
    expect({"demand_capacity", "waterstop_opening"} <= set(limits), f"{limits}")


def editor():
    """Snippets are scenes, and the schema takes the defaults and refuses what the program refuses."""
    result = subprocess.run([sys.executable, str(ROOT / "scripts" / "editor.py"), "--output", "editor", "--voussoir", VOUSSOIR], capture_output=True, text=True)
    expect(result.returncode == 0, result.stderr)
    snippets = json.loads(Path("editor/voussoir.code-snippets").read_text())
    schema = json.loads(Path("editor/voussoir-scene.schema.json").read_text())
    expect(list(snippets) == list(schema["properties"]) and len(snippets) > 80, f"{len(snippets)} entries")
    scene = []
    for snippet in snippets.values():  # every default typed, the first choice taken
        for line in snippet["body"]:
            scene.append(re.sub(r"\$\{1\|([^,|]*).*\|\}", r"\1", re.sub(r"\$\{1:(.*)\}$", r"\1", line)))
    runs("scene", write("all.prm", "\n".join(scene) + "\n"))
    expect(runs("scene", "all.prm") == runs("scene", write("none.prm", "")), "the snippets are not the defaults")
    try:
        import jsonschema
    except ImportError:
        print("    without jsonschema")
        return
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    for value in ({name: entry["default"] for name, entry in schema["properties"].items()}, {"Joints/Friction": .5, "Joints/Model": "FJB"},
                  {"Concrete/Young's modulus": "21 GPa", "Output/Figures": False}):
        expect(validator.is_valid(value), f"{[error.message for error in validator.iter_errors(value)]}")
    for value in ({"Joints/Friction": -1}, {"Joints/Friction": "much"}, {"Joints/Model": "FJC"}, {"Joints/Frictoin": 1}, {"Motion/Seed": 1.5}):
        expect(not validator.is_valid(value), f"{value} is valid")
        entry, text = next(iter(value.items()))
        refused(["scene", "none.prm", "--set", f"{entry}={text}"], entry.split("/")[0])


def site():
    """Every page of doc/ and examples/ is in the site, no link is broken (MkDocs is strict), every list is a list, and the search finds words."""
    words = [sys.executable, str(ROOT / "scripts" / "site.py"), "--output", "site"]
    result = subprocess.run(words, capture_output=True, text=True)
    if "theme Material is not there" in result.stderr:
        print("MkDocs or its theme Material is not installed")
        sys.exit(77)
    expect(result.returncode == 0, f"{result.stdout}{result.stderr}")
    for page in (ROOT / "doc").rglob("*.md"):
        name = page.relative_to(ROOT / "doc").with_suffix(".html")
        if name.name == "mainpage.html":
            continue
        name = "pages.html" if str(name) == "index.html" else name
        expect(Path("site", name).is_file(), f"{name} is missing")
        text = re.sub(r"^( *)```.*?^\1```", "", page.read_text(), flags=re.S | re.M)
        listed = len(re.findall(r"^ *(?:-|\d+\.) ", text, re.M))
        article = Path("site", name).read_text().partition("<article")[2].partition("</article>")[0]
        expect(article.count("<li>") == listed, f"{name}: {article.count('<li>')} entries of lists, {page} has {listed}")
    for page in (ROOT / "examples").glob("*/README.md"):
        name = page.relative_to(ROOT).with_name("index.html")
        article = Path("site", name).read_text().partition("<article")[2].partition("</article>")[0]
        expect('src="figure.png"' in article and "subsection " in article and Path("site", name).with_name("figure.png").is_file(), f"{name}")
    found = json.loads(Path("site/search/search_index.json").read_text())["docs"]
    expect(any("Joints/Friction" in page["text"] for page in found), "the search does not know Joints/Friction")
    outside = re.findall(r'<(?:script|link)[^>]*(?:src|href)="(https?:[^"]*\.(?:js|css)[^"]*)"', Path("site/index.html").read_text())
    expect(not outside, f"the site needs {outside}")
    site_search()


class SiteHandler(SimpleHTTPRequestHandler):
    """The files of site/; what is not there."""

    missing = []

    def __init__(self, *arguments):
        super().__init__(*arguments, directory="site")

    def send_error(self, code, *arguments):
        self.missing.append((int(code), self.path))
        super().send_error(code, *arguments)

    def log_message(self, *_):
        pass


def within_30_s(get):
    """The first result that is true, or the last one after 30 s."""
    deadline = time.monotonic() + 30.
    while not (result := get()) and time.monotonic() < deadline:
        time.sleep(.1)
    return result


def found_all(browser, word):
    """The pages that the search lists, if each of them has the word."""
    listed = browser.value("[...document.querySelectorAll('.md-search-result__item > a')].map(a => new URL(a.href).pathname.slice(1))")
    return {name for name in listed if all(word in Path("site", name).read_text().lower() for name in listed)}


def site_search():
    """In a browser: a typed word has results that hold it, on a desk and on a telephone; every file of a page is there."""
    if find_browser() is None:
        print("SKIPPED: no Chromium, so the search is not tried (on Debian: apt-get install chromium)")
        sys.exit(77)
    with ThreadingHTTPServer(("127.0.0.1", 0), SiteHandler) as server, Browser() as browser:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        here = f"http://127.0.0.1:{server.server_port}/"
        for width in (1280, 390):
            browser.open(f"{here}mesh.html", width)
            within_30_s(lambda: "Type to start" in browser.value("document.querySelector('.md-search-result__meta').textContent"))
            scroll = browser.value("document.documentElement.scrollWidth")
            expect(scroll <= width, f"mesh.html scrolls sideways at {width}: {scroll}")
            browser.value("document.querySelector('input[name=query]').focus()")
            for letter in "waterstop":
                browser.call("Input.dispatchKeyEvent", type="keyDown", text=letter, key=letter)
                browser.call("Input.dispatchKeyEvent", type="keyUp", key=letter)
            found = within_30_s(lambda: found_all(browser, "waterstop"))  # it searches after each letter
            expect("report.html" in found, f"the search for waterstop finds {found}")
            print(f"    at {width} px: {sorted(found)}")
            complaints = [text for text in browser.complaints() if not text.startswith(f"asks for {here}")]
            expect(not complaints and not SiteHandler.missing, f"{complaints}, {SiteHandler.missing}")
        server.shutdown()


if __name__ == "__main__":
    run_cases(package, arcs, notebook, editor, site, readme, tutorial_1_first_run, tutorial_2_own_dam, tutorial_3_own_records,
              tutorial_4_own_law, studies, report)
