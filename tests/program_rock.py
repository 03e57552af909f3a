#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program on rock.

    program_rock.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import os
import re
import shutil
from math import pi, sin
from pathlib import Path

from program_monitor import ROCK
from run_program import expect, refused, run_cases, runs, same_to_the_bit, settings, summary, table, voussoir, write_scene


def sections():
    """Sections beside a boundary that does not absorb end at mtf3: what it needs is asked for before the run."""
    write_scene()
    fixed = [*ROCK, *settings("Foundation/Boundary=fixed")]
    runs("scene.prm", "--validate", *fixed)
    beside = "sections of the free field beside the artificial boundary fixed", "mtf3", "Foundation/Free field"
    for needs, entries in (("Poisson's ratio", ["Foundation/Poisson's ratio=0.4", "Foundation/Stiffness damping=0", "Dynamics/Steps per sample=3"]),
                           ("Gauss points", ["Foundation/Nodal quadrature everywhere=false",
                                             "Foundation/Nodal layers=2", "Foundation/Stiffness damping=0"])):
        refused(["scene.prm", "--validate", *fixed, *settings(*entries)], *beside, needs)
        runs("scene.prm", "--validate", *fixed, *settings(*entries, "Foundation/Free field=columns"))


def at_dam():
    """With the dam's elements in all of the rock its static state is that of massless rock, which has them; layers at the dam
    bring it near, layers at the boundary stay nodal."""
    write_scene()
    still = settings("Motion/Source=none", "Joints/Model=FJA")

    def crest(directory, *entries):
        runs("scene.prm", "--output", directory, *ROCK, *still, *settings(*entries))
        names, rows = table(f"{directory}/history.csv")
        return [rows[0][names.index(name)] for name in ("crest_x", "crest_z", "base_x")]

    alike = "Foundation/Boundary=fixed", "Foundation/Free field=columns", "Foundation/Nodal layers=0"
    truth = crest("massless", "Foundation/Model=massless")
    off = {}
    for name, entries in (("nodal", ("Foundation/Layers at the dam=0",)), ("two", ("Foundation/Layers at the dam=2",)), ("all", ("Foundation/Layers at the dam=1000",))):
        found = crest(name, *alike, *entries)
        off[name] = max(abs(a - b) for a, b in zip(found, truth)) / max(map(abs, truth))
    print(f"    crest and base off by {off}")
    expect(off["all"] < 1e-8, "all of the rock has the dam's elements")
    expect(off["two"] < .5 * off["nodal"], "layers at the dam")
    plain = "Elements/Incompatible modes=false",
    truth, found = (crest(f"plain_{name}", *plain, *entries) for name, entries in
                    (("massless", ("Foundation/Model=massless",)), ("all", (*alike, "Foundation/Layers at the dam=1000"))))
    without = max(abs(a - b) for a, b in zip(found, truth)) / max(map(abs, truth))
    print(f"    without modes {without:.1e}")
    expect(without < 1e-8, "elements without modes in dam and rock")
    same_as_nodal = crest("none", *alike[:2], "Foundation/Nodal layers=1000", "Foundation/Layers at the dam=1000")
    expect(same_as_nodal == crest("plain", *alike, "Foundation/Layers at the dam=0"), "layers at the boundary stay nodal")
    logs = {name: Path(name, "log.txt").read_text() for name in ("nodal", "two", "all", "none")}
    expect("have the dam's element type" not in logs["nodal"], "no layers")
    expect("elements of rock in" not in logs["two"] + logs["all"], "all of the layers")
    expect(re.search(r"warning: (\d+) of \1 elements of rock in .*too stiff", logs["none"]) is not None, "none of the layers")
    expect("of nodal quadrature at the artificial boundary, not" not in "".join(logs.values()), "as many layers as set")
    crest("raised", "Foundation/Nodal layers=2")
    expect("6 layers of nodal quadrature at the artificial boundary, not the 2 of" in Path("raised", "log.txt").read_text(), "raised")
    expect([summary(name)["rock"]["nodal_layers"] for name in ("raised", "two", "none")] == [6, 0, 1000], "layers in the summary")
    expect(summary("none")["rock"]["elements_at_dam"] == 0 < summary("two")["rock"]["elements_at_dam"], "how many there are")


def damping():
    """A quality factor reduces the motion. It is refused where it is not available, before any work."""
    write_scene()
    largest = {}
    for name, quality in (("without", 0), ("with", 10)):
        log = runs("scene.prm", "--output", name, *ROCK, *settings(f"Foundation/Quality factor={quality}", "Motion/Duration=1"))
        expect(("quality factor 10 from 0.5 to 10 Hz" in log) == (quality == 10), log)
        names, rows = table(f"{name}/history.csv")
        k = names.index("crest_x")
        largest[name] = max(abs(row[k] - rows[0][k]) for row in rows)
        expect(summary(name)["rock"]["energy_balance_error"] < 1e-9, f"{summary(name)['rock']}")
    print(f"    largest motion of the crest {largest}")
    expect(.5 * largest["without"] < largest["with"] < .98 * largest["without"], f"{largest}")
    for entries, needs in ((("Foundation/Quality factor=5",), "10 or more"),
                           (("Foundation/Quality factor=50", "Foundation/Incidence=SV 15 90"), "Foundation/Incidence"),
                           (("Foundation/Quality factor=50", "Foundation/Boundary=viscous-spring"), "without dashpots")):
        refused(["scene.prm", "--validate", *ROCK, *settings(*entries)], "Foundation/Quality factor", needs)
    runs("scene.prm", "--validate", *ROCK, *settings("Foundation/Quality factor=50", "Foundation/Boundary=fixed"))


def end_of_motion():
    """Motion/Duration = -1 adds the travel time, in whole steps of the motion: a record with zeros after its end gives the same run.
    A given duration ends the run. A run that is resumed after the end of the motion, or goes on from a given duration, is the same."""
    write_scene()
    for name, n in (("short", 24), ("padded", 60)):
        with open(f"{name}.txt", "w") as file:
            for i in range(n + 1):  # a pulse in the last 0.06 s of the short one
                print(.01 * i, .5 * sin(pi * (i - 18) / 3) if 18 <= i <= 24 else 0., 0., 0., file=file)

    def entries_of(file, duration):
        return [*ROCK, *settings(f"Motion/File={file}.txt", f"Motion/Duration={duration}")]

    log = runs("scene.prm", "--output", "whole", *entries_of("short", -1))
    whole = summary("whole")
    arrival, after = whole["rock"]["arrival"], -(-whole["rock"]["arrival"] // .01)
    print(f"    arrival after {arrival:.3f} s, {after:.0f} steps of the motion")
    expect(whole["steps"] == 5 * (24 + after) and whole["time_step"] == .002, f"{whole['steps']} steps")
    expect(f"the run continues for {.01 * after:.2f} s after the motion" in log, log)
    runs("scene.prm", "--output", "padded", *entries_of("padded", round(.24 + .01 * after, 2)))
    for name, columns in (("history", ("crest_x", "crest_z", "base_x")), ("energy", ("kinetic", "rock_kinetic"))):
        (names, rows), (_, padded) = table(f"whole/{name}.csv"), table(f"padded/{name}.csv")
        for k in map(names.index, columns):
            apart = max(abs(a[k] - b[k]) for a, b in zip(rows, padded)) / max(abs(row[k]) for row in rows)
            expect(len(rows) == len(padded) and apart < 1e-9, f"{names[k]} of a record with zeros after its end differs by {apart}")
    log = runs("scene.prm", "--output", "given", *entries_of("short", .24))
    expect(summary("given")["steps"] == 120 and f"the last {arrival:.3f} s of the motion do not reach the dam" in log, log)
    names, rows = table("whole/history.csv")
    moved = [max(abs(row[1] - rows[0][1]) for row in part) for part in (rows[:121], rows)]
    print(f"    crest moves by {moved[0]:.1e} m until the end of the motion, by {moved[1]:.1e} m in all")
    expect(moved[1] > 3 * moved[0], "the pulse at the end of the motion reaches the dam")
    for duration in (-1, .24):  # the checkpoint is of a step after the end of the motion, and of the last one before
        stop_at_end("resumed", *entries_of("short", duration), "--set", f"Output/Checkpoint interval={150 if duration < 0 else 119}")
        runs("scene.prm", "--output", "resumed", *entries_of("short", -1), "--resume")
        same_to_the_bit("whole", "resumed")


def stop_at_end(directory, *entries):
    """Runs to the end, and leaves the checkpoint before it."""
    shutil.rmtree(directory, ignore_errors=True)
    Path(directory, "summary.json").mkdir(parents=True)
    expect("is kept" in voussoir("scene.prm", "--output", directory, "--overwrite", *entries).stderr, "summary.json is in the way")
    Path(directory, "summary.json").rmdir()
    os.replace(f"{directory}/checkpoint.bin.before", f"{directory}/checkpoint.bin")


if __name__ == "__main__":
    run_cases(sections, at_dam, damping, end_of_motion)
