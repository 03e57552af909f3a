#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The columns, fields and keys of small runs against scripts/columns.txt: each written name has a row, and each row a name.

    program_columns.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import json
import re
import sys
from pathlib import Path

from program_wedges import HEAD
from run_program import MESH, VOUSSOIR, expect, run_cases, runs, settings, write

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "python")]
import reference
from voussoir.study_results import NUMBERS

SCENE = MESH + """
subsection Motion
  set Source = artificial
  set Duration = 0.2
end
subsection Output
  set Figures = false
  set Solution interval = 20
end
"""
ROCK = "Mesh/Arch210/Rock/Element size=60"
RUNS = {  # directory: entries
    "keys": ["Joints/Model=KSM", "Output/Block forces=true", "Statics/Stages=fill 60, grout 210", "Output/Probes=name_1: 0 0 200",
             "Limits/Wedges=wedges.csv", "Limits/Static tensile strength=2 MPa", "Limits/Opening=20 mm", "Limits/Tension=1 MPa",
             "Limits/Sliding safety=1.3", "Limits/Base friction=1"],
    "water": ["Reservoir/Model=acoustic", "Reservoir/Element size=40", "Output/Pressure depths=20", "Foundation/Model=rock", ROCK,
              "Dynamics/Steps per sample=2", "Mesh/Arch210/Base joint=true", "Joints/Overrides=base: cohesive", "Joints/Strength=1 MPa"],
    "sequence": ["Foundation/Model=massless", ROCK, "Mesh/Arch210/Joints=1", "Loads/Uplift/Base=true", "Motion/Sequence=1; 2", "Motion/Rest=0.1",
                 "Output/Probes=name_1: 0 0 200", "Output/Tensile strength=2 MPa", "Limits/Demand-capacity ratio=2"],
    "ensemble": ["Motion/Ensemble=1-3", "Motion/Ensemble factors=0.5, 1", "Dynamics/Scheme=explicit", "Output/Solution interval=0",
                 "Limits/Opening=1 mm", "Limits/Demand-capacity ratio=2"]}
WATER = settings("Reservoir/Model=acoustic", "Reservoir/Element size=40")


def pattern(name):
    """Regular expression of a name of the table."""
    text = re.escape(name).replace(r"\*\*", ".*").replace(r"\*", r"\d+").replace("DEPTH", r"[\d.]+").replace("K", r"\d+")
    return re.compile(text.replace("NAME", r"[^.]+" if "." in name else r"name_\w+"))


def paths(value, path=()):
    """Paths of all values of a JSON object."""
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) and value and isinstance(value[0], dict) else None
    if children is None:
        yield ".".join(path)
    for name, child in children or ():
        yield from paths(child, (*path, str(name)))


def names(path):
    """Columns of a table, fields of a VTU file, or paths of a JSON file."""
    if path.suffix == ".csv":
        return next(csv.reader(path.open()))
    if path.suffix == ".json":
        return list(paths(json.loads(path.read_text())))
    return [name for name in re.findall(r'<DataArray[^>]*Name="([^"]*)"', path.read_bytes().decode("latin1"))
            if name not in ("connectivity", "offsets", "types")]


def rows():
    """Each row of the table has a column, and each column a row."""
    write("scene.prm", SCENE)
    write("wedges.csv", HEAD + "name_left, bottom, 0, 120, 60, 25, -60, 4500, 0.65, 2e5, 3e5, 1.2e5, 2650\n")
    for directory, entries in RUNS.items():
        runs("scene.prm", "--output", directory, *settings(*entries))
    for directory, words in (("modes", ["--count", "1", *WATER]), ("spectrum", ["--count", "1", "--spectrum", "design"])):
        runs("modes", "scene.prm", "--output", directory, *words)
    Path("suite").mkdir()
    write("record.csv", "".join(f"{.02 * k:.2f} {k % 7 - 3} {k % 5 - 2} {k % 3 - 1}\n" for k in range(100)))
    runs("motion", "scene.prm", "--output", "suite/motion.txt", *settings("Motion/Source=file", "Motion/Ensemble=record.csv"))
    explicit = settings("Dynamics/Scheme=explicit", "Joints/Overrides=2: FJB")
    for file, words in (("keys/validate", ["scene.prm", "--validate"]), ("sequence/validate", ["scene.prm", "--validate", *explicit]),
                        ("water/modes", ["modes", "scene.prm", "--count", "1", *WATER])):
        write(f"{file}.json", runs(*words, "--json"))
    write("keys/results.csv", ",".join(["scene", "law", "foundation", *NUMBERS, "revision"]) + "\n")
    table = {file: {name: pattern(name) for row, *_ in of_file for name in reference.expanded(row)}
             for file, (_, of_file) in reference.columns().items()}
    errors, seen = [], set()
    for path in sorted(path for path in Path().glob("*/*.*") if path.suffix in (".csv", ".json", ".vtu")):
        file = re.sub(r"-\d+\.vtu", "-*.vtu", path.name)
        files = [name for name in (file, "summary.json" if file == "validate.json" else "") if name in table]
        for name in names(path):
            found = [(of, row) for of in files for row, expression in table[of].items() if expression.fullmatch(name)]
            found = found or [(of, row) for of in files for row in table[of] if row.startswith(f"{name}.")]  # of an empty list
            seen.update(found)
            errors += [] if found else [f"{file}: {name} has no row in scripts/columns.txt"]
    errors += [f"{file}: no run writes {name} of scripts/columns.txt" for file, of_file in table.items() for name in of_file
               if (file, name) not in seen]
    print(f"    {len(seen)} names of {len(table)} files")
    expect(not errors, "\n".join(sorted(set(errors))))


def pages():
    """The pages of doc/generated are those of the program."""
    errors = reference.stale(VOUSSOIR)
    expect(not errors, "\n".join(errors))


def selections(tree, path=()):
    """Entries with a list of choices."""
    for name, child in tree.items():
        if "pattern_description" not in child:
            yield from selections(child, (*path, name))
        elif choices := re.match(r"\[Selection (.*?) ?\]", child["pattern_description"]):
            yield "/".join((*path, name)), choices[1].split("|")


def named():
    """Pages name all laws, loads, models and commands of the program, and no others."""
    files = [path for path in (ROOT / "doc").rglob("*.md") if "generated" not in path.parts and path.name != "changes.md"] + [ROOT / "README.md"]
    text, errors = "\n".join(file.read_text() for file in files), []
    choices = dict(selections(json.loads(runs("parameters", "json"))))
    for entry in ("Joints/Model", "Foundation/Model", "Foundation/Boundary", "Reservoir/Model", "Dynamics/Scheme", "Dynamics/Impact", "Damping/Model"):
        errors += [f"no page names {entry} = {name}" for name in choices[entry] if not re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", text)]
    for file, entry in (("method", "Joints/Model"), ("rock", "Foundation/Model")):
        listed = re.search(rf"\| `{entry}` \|.*\n.*\n((?:\| `.*\n)+)", (ROOT / f"doc/{file}.md").read_text())[1]
        listed = re.findall(r"^\| `([\w-]+)`", listed, re.M)
        errors += [] if set(listed) == set(choices[entry]) else [f"doc/{file}.md lists {listed} of {entry}, the program {choices[entry]}"]
    errors += [f"a page has {entry} = {value}" for entry, value in re.findall(r"(\w+/[\w/ ]+?) ?= ?([\w-]+)['`]", text)
               if value not in choices.get(entry, [value])]
    loads = re.search(r"Loads: (.*?)\.$", runs("parameters", "markdown", "Loads/Combinations").strip().rstrip(" |"), re.M)[1]
    stated = re.search(r"The loads are (.*?), with", (ROOT / "doc/loads.md").read_text())[1]
    loads, stated = {re.sub(r" \(.*", "", name) for name in loads.split(", ")} - {"earthquake"}, set(re.findall("`(.*?)`", stated))
    errors += [] if loads == stated else [f"doc/loads.md names the loads {stated}, the program {loads}"]
    known, used = (set(re.findall(rf"{before}voussoir ([a-z]+)\b(?![./])", page, re.M)) for before, page in (
        ("^", runs("--help")), ("(?:`|<\\(|^|^    )(?:build/)?", text)))
    errors += [] if known - {"--help"} == used else [f"commands in pages only or in the program only: {known ^ used}"]
    expect(not errors, "\n".join(errors))


if __name__ == "__main__":
    run_cases(rows, pages, named)
