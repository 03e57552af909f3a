#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the gallery of failures: does what doc/failures.md shows fail, and does benchmarks/README.md have what its script prints?

    program_failures.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import re
import subprocess
import sys
from pathlib import Path

from run_program import expect, run_cases, summary, table, voussoir

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))
SCRIPT, PAGE, FIGURES = ROOT / "benchmarks" / "failures.py", ROOT / "doc" / "failures.md", ROOT / "doc" / "figures"
EVIDENCE = ROOT / "benchmarks" / "README.md"
WITHOUT_PROGRAM = ["velocity", "substeps", "penalty"]


def page():
    """Each failure has a small picture on its page, and its command and numbers in the evidence; the tables that need no program are those of now."""
    text, evidence = PAGE.read_text(), EVIDENCE.read_text()
    known = re.search(r"NAME: ([a-z, ]+);", SCRIPT.read_text()).group(1).split(", ")
    expect(len(known) == 9, f"{known}")
    for name in known:
        expect(f"benchmarks/failures.py {name}\n" in evidence, f"no command for {name}")
        expect(f"(figures/failure_{name}.png)" in text, f"no picture of {name}")
        size = (FIGURES / f"failure_{name}.png").stat().st_size
        expect(1000 < size < 80000, f"the picture of {name} has {size} bytes")
    run = subprocess.run([sys.executable, SCRIPT, "--figures", ".", *WITHOUT_PROGRAM], text=True, capture_output=True)
    expect(run.returncode == 0, run.stderr)
    rows = [line for line in run.stdout.splitlines() if line.startswith("| ")]
    expect(len(rows) >= 15, run.stdout)
    for row in rows:
        expect(row in evidence, f"the evidence does not have: {row}")
    for name in WITHOUT_PROGRAM:
        expect(Path(f"failure_{name}.png").exists(), f"no picture of {name}")
    wrong = subprocess.run([sys.executable, SCRIPT, "newton"], text=True, capture_output=True)
    expect(wrong.returncode == 2 and "newmark" in wrong.stderr, wrong.stderr)


def models():
    """The models fail as measured in other programs, and the rule of the program does not."""
    from failure_models import PHASES, ColumnOnRock, bar_errors, bar_on_wall

    def bar(rule, elements=100, **how):
        rows = [bar_errors(*bar_on_wall(rule, elements, phase=p, **how), phase=p, elements=elements,
                           mean=rule == "mean-force") for p in PHASES]
        return [sum(column) / len(rows) for column in zip(*rows)], max(row[3] for row in rows)

    (plain, worst), (velocity, _), (mean, gain) = bar("none"), bar("velocity"), bar("mean-force")
    expect(plain[0] > 1 and 0.8 < worst < 1, f"plain Newmark: {plain}, energy {worst}")
    expect(0.5 < velocity[0] < 0.65 and bar("velocity", 200)[0][0] > 0.5, f"velocity alone: {velocity}")
    expect(mean[0] < 0.026 and mean[1] < 4e-3 and gain < 0, f"mean-force: {mean}, energy {gain}")
    expect(bar("mean-force", 200)[0][0] < mean[0] / 1.6, "mean-force does not converge")
    soft, stiff = bar("penalty", penalty=0.1)[0], bar("penalty", penalty=100.)[0]
    expect(soft[4] > 0.3 and stiff[1] > 1, f"penalty: {soft}, {stiff}")
    for m in (1, 2, 4, 6):
        light, heavy = (ColumnOnRock(m, heavier).largest_eigenvalue() - 1 for heavier in (False, True))
        expect(heavy < 1e-9 and (light > 0.01 if m > 1 else light < 1e-9), f"m = {m}: {light}, {heavy}")


def dam():
    """In a dam plain Newmark's joints give more energy than the earthquake; the angle as printed costs Newton steps."""
    coarse = [ROOT / "prm" / "coarse.prm", *(word for entry in (
        "Mesh/Arch210/Elements along=18", "Mesh/Arch210/Elements up=8", "Mesh/Arch210/Elements through=1",
        "Motion/Duration=5.12", "Motion/Rise end=0.5", "Motion/Decay begin=4.5", "Output/Figures=false") for word in
        ("--set", entry))]
    for name, entry in (("default", "Dynamics/Impact=mean-force"), ("none", "Dynamics/Impact=none"),
                        ("paper", "Joints/Equations=paper")):
        result = voussoir(*coarse, "--set", entry, "--output", name)
        # Plain Newmark may be stopped for what it does: the tables end there.
        expect(result.returncode == 0 or name == "none" and "has become unstable" in result.stderr, f"{name}: {result.stderr}")
    taken = {}
    for name in ("default", "none"):
        names, rows = table(f"{name}/energy.csv")
        last = dict(zip(names, rows[-1]))
        largest = max(abs(row[names.index("input")]) for row in rows)  # of a run gone wild the last one may be negative
        taken[name] = (last["friction"] + last["impact"]) / largest
    print(f"    taken by the joints, over the largest input: {taken}")
    expect(0 < taken["default"] < 1 and taken["none"] < -1, f"{taken}")
    steps = {name: summary(name)["newton_iterations"]["mean"] for name in ("default", "paper")}
    print(f"    Newton steps: {steps}")
    expect(steps["paper"] > 3 * steps["default"], f"{steps}")


if __name__ == "__main__":
    run_cases(page, models, dam)
