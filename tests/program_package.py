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
import subprocess
import sys
from pathlib import Path

from run_program import VOUSSOIR, expect, refused, run_cases, runs, write, write_scene

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scripts")]


def package():
    """run() and load() give what is in the files."""
    import numpy as np
    import voussoir
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


def arcs():
    """Dams from tables of arcs: volumes against closed forms, and the two of meshes/."""
    mesher = str(ROOT / "scripts" / "arch_from_table.py")

    def mesh(table, *options, status=0):
        result = subprocess.run([sys.executable, mesher, table, "--output", "dam.msh", *options], capture_output=True, text=True)
        expect(result.returncode == status, f"status {result.returncode}: {result.stdout}{result.stderr}")
        print("   ", (result.stdout + result.stderr).strip())
        return result.stdout + result.stderr

    head = "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"
    # A part of a ring, 30 and 40 degrees, without a valley: half angle times (R^2 - r^2) times height
    write("ring.csv", head + "0,0,100,20,80,30,40\n60,0,100,20,80,30,40\n")
    text = mesh("ring.csv", "--joints", "3", "--along", "120", "--up", "2")
    volume = math.radians(70) / 2 * (100**2 - 80**2) * 60
    found = float(re.search(r"volume (\d+) m3", text)[1])
    expect(abs(found / volume - 1) < 1e-4, f"volume {found}, ring {volume}")
    expect(abs(float(re.search(r"crest ([\d.]+) m", text)[1]) - math.radians(70) * 100) < .06, text)
    scene = write("ring.prm", "subsection Mesh\nset Source = file\nset File = dam.msh\nend\nsubsection Reservoir\nset Water level = 50\nend\n")
    expect("4 monoliths" in runs(scene, "--validate"), "the ring's monoliths")
    for name, rows, part in (("few", "0,0,100,20,80,30,40\n", "two arcs"), ("text", "0,0,100,20,80,30,40\n60,a,100,20,80,30,40\n", "numbers"),
                             ("thick", "0,0,100,20,80,30,40\n60,0,10,20,80,30,40\n", "thicker"),
                             ("valley", "0,0,100,20,80,30,40\n60,0,100,20,80,20,40\n", "right_angle"),
                             ("meet", "0,0,100,20,20,60,60\n60,0,100,20,20,60,60\n", "meet")):
        write(f"{name}.csv", head + rows)
        expect(part in mesh(f"{name}.csv", status=2), name)
    write("column.csv", "elevation,thickness\n1,2\n")
    expect("upstream_x" in mesh("column.csv", status=2), "a missing column")
    # Morrow Point on a rigid base, empty: 3.81 and 4.27 Hz are quoted (doc/mesh.md); the table has its outer dimensions and its volume
    text = mesh(str(ROOT / "meshes" / "morrow_point.csv"), "--joints", "9", "--along", "40", "--up", "12")
    expect(abs(float(re.search(r"volume (\d+) m3", text)[1]) / 275e3 - 1) < .03, text)
    text = runs("modes", scene, "--count", "2", "--set", "Reservoir/Density=0", "--set", "Concrete/Young's modulus=27.6 GPa",
                "--set", "Concrete/Density=2483", "--set", "Concrete/Poisson's ratio=0.2")
    frequencies = [float(line.split()[1]) for line in text.splitlines()[1:]]
    print(f"    Morrow Point: {frequencies} Hz")
    expect(abs(frequencies[0] / 3.81 - 1) < .05 and abs(frequencies[1] / 4.27 - 1) < .05, f"{frequencies}")


if __name__ == "__main__":
    run_cases(package, arcs)
