#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what the program says of its own error: the estimate of a run, `voussoir accuracy`.

    program_accuracy.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import signal
from math import sqrt
from pathlib import Path

from program_safety import failed, stopped_by
from run_program import expect, refused, run_cases, runs, same, summary, table, write_scene

DURATION = ["--set", "Motion/Duration=1.5"]


def openings(directory):
    names, rows = table(f"{directory}/joints.csv")
    up, down = names.index("opening_upstream"), names.index("opening_downstream")
    return [max(row[up], row[down]) for row in rows]


def error(coarse, fine):
    a, b = openings(coarse), openings(fine)
    return sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / sum(y * y for y in b))


def estimate():
    """The error of the time step is estimated within a factor of 2, and a resumed run says the same."""
    write_scene()
    run = ["scene.prm", *DURATION]
    runs(*run, "--output", "fine", "--set", "Dynamics/Steps per sample=16")
    text = runs(*run, "--output", "steps2", "--set", "Dynamics/Steps per sample=2", "--set", "Dynamics/Error estimate=true")
    expect("error by the time step, by estimate" in text, text)
    told, true = summary("steps2")["error_estimate"], error("steps2", "fine")
    print(f"    estimate {told['openings']:.4f}, true {true:.4f}")
    expect(true / 2 < told["openings"] < 2 * true, f"the estimate {told} is not within a factor of 2 of {true}")
    expect(told["tension_upstream"] > 0 and told["tension_downstream"] > 0, f"{told}")
    runs(*run, "--output", "plain", "--set", "Dynamics/Steps per sample=2")
    same("plain", "steps2", 0., ("history", "joint_history", "energy"))
    settings = [*DURATION, "--set", "Dynamics/Error estimate=true", "--set", "Dynamics/Steps per sample=2"]
    failed(stopped_by(signal.SIGTERM, "kept", *settings), "SIGTERM")
    runs("scene.prm", *settings, "--resume", "--output", "kept")
    for name, value in summary("kept")["error_estimate"].items():
        expect(abs(value - told[name]) <= 1e-6 * told[name], f"a resumed run estimates {name} = {value}, not {told[name]}")
    refused(["scene.prm", "--set", "Dynamics/Error estimate=true", "--set", "Foundation/Model=rock", "--set",
             "Mesh/Arch210/Rock/Enabled=true"], "Dynamics/Error estimate", "voussoir accuracy")


def command():
    """`voussoir accuracy` on the small dam: the chart, the table, the proposal; nothing is run twice."""
    write_scene()
    arguments = ["accuracy", "scene.prm", "--seconds", "1", "--output", "out", "--for", "60%"]
    text = runs(*arguments)
    for part in ("time step", "along", "up", "through", "s per s", "The scene as it is: error", "For 60 %:"):
        expect(part in text, f"'{part}' is missing: {text}")
    result = json.loads(Path("out/accuracy.json").read_text())
    expect(result["proposal"]["meets"] and result["proposal"]["predicted"] <= 0.6, f"{result}")
    names, rows = table_of_text("out/accuracy.csv")
    expect(names[:3] == ["choice", "setting", "cost"] and len(rows) == 12, f"{names}, {len(rows)} rows")
    expect(Path("out/accuracy.png").stat().st_size > 10000, "the chart is empty")
    before = {p: p.stat().st_mtime for p in Path("out/runs").glob("*/summary.json")}
    expect(runs(*arguments).count("s per s") > 3, "the second time")
    expect(before == {p: p.stat().st_mtime for p in Path("out/runs").glob("*/summary.json")}, "runs are repeated")
    refused([*arguments[:-1], "0"], "--for", "positive")
    refused(["accuracy"], "one scene file")
    refused(["accuracy", "nothing.prm"], "nothing.prm")
    refused(["accuracy", "scene.prm", "--set", "Motion/Source=none"], "has no motion")
    refused(["accuracy", "scene.prm", "--set", "Motion/Fatcor=2"], "Motion/Factor")


def table_of_text(name):
    lines = Path(name).read_text().splitlines()
    return lines[0].split(","), lines[1:]


if __name__ == "__main__":
    run_cases(estimate, command)
