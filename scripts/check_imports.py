#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the imports of the Python files. A module of the package imports only modules of its own layer and of the layers above in
LAYERS. Commands and benchmarks import no command. There are no circular imports. Imports within functions count.

    scripts/check_imports.py     exit status 1 with a line for each violation
"""

import ast
import sys
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "python" / "voussoir"
LAYERS = (("errors",), ("palette", "prm", "tables", "units", "vtu", "chromium"), ("ensembles", "error_bars", "results"), ("program",),
          ("command", "runs", "zone_tension"),
          ("drawing", "frames", "picture", "report_places", "scene_text", "study_file", "study_scene"),
          ("ensemble_drawing", "mode_shapes", "needs_verdicts", "report_scene", "report_tables", "study_figures", "study_results"),
          ("report_answers", "report_figures", "report_needs"), ("report_ensemble", "report_view3d"),
          ("accuracy", "arcs", "completion", "figures", "film", "needs_command", "needs_output", "needs_runs", "new", "report", "study", "view"),
          ("__init__",))
FLOOR = {name: floor for floor, names in enumerate(LAYERS) for name in names}


def imports_of(path):
    """Returns the files of the project that a file imports: modules of the package, or neighbours in its directory."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            module = ("voussoir." if node.level else "") + (node.module or "")
            names = [module, *(f"{module.rstrip('.')}.{alias.name}" for alias in node.names)]
        else:
            continue
        for name in names:
            inner = name.removeprefix("voussoir.")
            found.add(PACKAGE / f"{inner}.py" if inner != name else path.with_name(f"{name}.py"))
    return {file for file in found if file.is_file() and file != path}


def main():
    files = [path for folder in (PACKAGE, ROOT / "scripts", ROOT / "benchmarks", ROOT / "tests", ROOT / "tests" / "golden")
             for path in sorted(folder.glob("*.py"))]
    graph = {path: imports_of(path) for path in files}
    errors = [f"{path.name} is in no layer of scripts/check_imports.py" for path in files if path.parent == PACKAGE and path.stem not in FLOOR]
    for path, others in graph.items():
        for other in others:
            if path.parent == PACKAGE and FLOOR.get(other.stem, 0) > FLOOR.get(path.stem, 0):
                errors.append(f"{path.name} imports {other.name}, which is in a layer below")
            if other.parent == ROOT / "scripts":
                errors.append(f"{path.relative_to(ROOT)} imports the command {other.name}: move what it needs into the package")
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        errors.append("files that import each other: " + ", ".join(file.name for file in error.args[1]))
    print("\n".join(f"imports: {error}" for error in errors), end="\n" if errors else "")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
