#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program with its ground motion: durations, records, factors, what is refused, what is warned of.

    program_motion.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
import os
from pathlib import Path

from run_program import run_cases, expect, refused, runs, table, voussoir, write, write_scene

QUICKSTART = str(Path(__file__).resolve().parent.parent / "prm" / "quickstart.prm")


def artificial():
    """The quick start with another duration, factor and spectrum."""
    motions = {}
    for name, settings in {"one": [], "three": ["Motion/Factor=3"], "short": ["Motion/Duration=5"]}.items():
        arguments = [word for setting in settings for word in ("--set", setting)]
        shown = runs("motion", QUICKSTART, "--output", f"{name}.csv", *arguments)
        expect("warning" not in shown, shown)
        names, motions[name] = table(f"{name}.csv")
        expect(names == ["t", "a_x", "a_y", "a_z"], f"columns of {name}.csv")
        expect(all(math.isfinite(x) for row in motions[name] for x in row), f"{name}.csv is not finite")
    expect(len(motions["one"]) == 1537 and len(motions["short"]) == 501, "lengths")
    # The envelope of 15 s and more stays as it was.
    expect(abs(max(abs(row[1]) for row in motions["one"]) - 0.5575 * 9.80665) < 1e-9, "peak acceleration")
    expect(all(abs(3 * a - b) < 1e-9 for p, q in zip(motions["one"], motions["three"]) for a, b in zip(p[1:], q[1:])),
           "Motion/Factor of an artificial motion")
    shown = runs(QUICKSTART, "--validate", "--set", "Motion/Duration=5")
    expect("1000 of 0.005 s" in shown, shown)
    Path("none.csv").unlink(missing_ok=True)
    for entry, parts in {"Motion/Peak acceleration=1e308": ("Motion/Peak acceleration", "1e+308"),
                         "Motion/Maximum beta=1e308": ("Motion/Maximum beta",),
                         "Motion/Factor=1e308": ("Motion/Factor",),
                         "Motion/Factor=1e5": ("1000 g", "Factor"),
                         "Motion/Scale y=nan": ("Motion/Scale y", "nan"),
                         "Motion/Seed=-1": ("Motion/Seed", "-1"),
                         "Motion/Matching iterations=-1": ("Motion/Matching iterations", "-1"),
                         "Motion/Decay begin=20": ("Motion/Duration is 15.36", "Decay begin, 20 s"),
                         "Motion/Rise end=16": ("Rise end, 16 s",)}.items():
        refused(["motion", QUICKSTART, "--output", "none.csv", "--set", entry], *parts)
        expect(not Path("none.csv").exists(), f"{entry}: a file was written")


def records():
    """Records of unequal length and step, records that are none, and what they leave at their end."""
    write_scene()
    scene = Path("scene.prm").read_text()
    write("scene.prm", scene.replace("  set Duration = 0.5\n", ""))
    shown = runs("scene.prm", "--validate")
    expect("300 of 0.01 s" in shown and "duration 3 s, that of the record 'motion.txt'" in shown, shown)
    shown = runs("scene.prm", "--validate", "--set", "Motion/Time step=0.02")
    expect("150 of 0.02 s" in shown and "low-pass filtered at 25 Hz" in shown, shown)
    for name, dt, last in (("x", .005, 2.), ("y", .01, 1.5)):
        write(f"{name}.txt", "".join(f"{k * dt:.3f} {math.sin(4 * math.pi * k * dt):.9f}\n"
                                     for k in range(round(last / dt) + 1)))
    components = ["--set", "Motion/File=", "--set", "Motion/File x=x.txt", "--set", "Motion/File y=y.txt"]
    shown = runs("motion", "scene.prm", "--output", "two.csv", *components)
    names, rows = table("two.csv")
    expect(len(rows) == 151 and "the shortest record, 'y.txt'" in shown, shown)
    expect(all(abs(row[1] - row[2]) < 3e-4 * 9.81 and row[3] == 0 for row in rows), "components of unequal step")
    expect("warning: the motion does not end at rest" in shown and "in x displacement" in shown, shown)
    shown = runs("scene.prm", "--validate", *components)
    expect("warning: the motion does not end at rest" in shown, shown)
    refused(["scene.prm", "--validate", "--set", "Motion/Duration=2", *components], "y.txt", "1.5 s", "Motion/Duration")

    os.mkfifo("pipe")
    Path("folder").mkdir()
    write("endless.txt", "1" * 2000000)
    write("decimal.txt", "0,00;0;0;0\n0,01;1;1;1\n")
    for name, parts in {"/dev/zero": ("device",), "pipe": ("pipe",), "folder": ("directory",),
                        "endless.txt": ("million characters",), "decimal.txt": ("line 1", "5 columns")}.items():
        for command in (["scene.prm", "--validate"], ["motion", "scene.prm", "--output", "none.csv"]):
            refused([*command, "--set", f"Motion/File={name}"], name, *parts)
    expect(not Path("none.csv").exists(), "a motion was written")


def units():
    """A unit that is not the file's: what headings say, numbers that are too large, and small ones in a scene that names no unit."""
    write_scene()
    unitless = Path("scene.prm").read_text().replace("  set Unit = g\n", "").replace("motion.txt", "table.csv")
    expect("Unit" not in unitless, unitless)
    write("unitless.prm", unitless)

    def table_of(headings, peak):
        write("table.csv", headings + "".join(f"{.01 * k:.2f},{peak * math.sin(.4 * k):.6f},0,0\n" for k in range(60)))

    def asked(*options):
        return ["motion", "unitless.prm", "--output", "m.csv", *options]

    for headings, unit in (("t,X (g),Y (g),Z (g)\n", "g"), ("# Time [s], acceleration [cm/s2]\n", "cm/s^2"), ("t ax/gal ay/gal az/gal\n", None),
                           ("Time;AX[m/s/s];AY[m/s/s];AZ[m/s/s]\n", "m/s^2"), ("# record in Gal\nt,x,y,z\n", "cm/s^2"), ("t,a_x,a_y,a_z\n", None),
                           ("# g, cm/s2 and m/s2\n", None)):
        table_of(headings, 2.)
        for given in ("g", "cm/s^2", "m/s^2"):
            options = asked("--set", f"Motion/Unit={given}")
            if unit in (None, given):
                runs(*options)
            else:
                refused(options, "table.csv", f"headings with the unit {unit}, but Motion/Unit is {given}", f"Set Motion/Unit = {unit}")
    table_of("", 380.)  # in cm/s2
    expect("the peak acceleration of the motion is 38.7 g" in runs(*asked()), "a record in cm/s2 that is taken in m/s2")
    expect("the peak" not in runs(*asked("--set", "Motion/Unit=cm/s^2")), "a record in cm/s2")
    table_of("", .45)  # in g
    for command in (asked(), ["unitless.prm", "--validate"]):
        result = voussoir(*command)
        expect(result.returncode == 0 and "the input file has no Motion/Unit" in result.stdout + result.stderr, f"{result}")
    for unit in ("g", "m/s^2"):
        result = voussoir(*asked("--set", f"Motion/Unit={unit}"))
        expect("Motion/Unit" not in result.stdout + result.stderr, f"{unit}: {result}")
    table_of("t,X (m/s2),Y,Z\n", .45)
    expect("no Motion/Unit" not in voussoir(*asked()).stderr, "the headings say the unit")
    write("table.csv", "0,00;0,1;0,2;0,3\n0,01;0,1;0,2;0,3\n")
    refused(asked(), "table.csv', line 1", "Decimals have a point")


if __name__ == "__main__":
    run_cases(artificial, records, units)
