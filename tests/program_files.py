#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program with files of others that are damaged, and with entries that would hang it.

    program_files.py VOUSSOIR
"""

import json
import os
import struct
from pathlib import Path

from run_program import contact_program, run_cases, expect, from_file, refused, runs, voussoir, write, write_scene


def meshes():
    """Sizes and tags that gmsh's library believes, and that made it crash."""
    write_scene()
    for version in ("2.2", "4.1"):
        runs("mesh", "scene.prm", "--output", f"sound_{version}.msh", "--format", version)
        lines = Path(f"sound_{version}.msh").read_text().splitlines()
        for section in ("$Nodes", "$Elements", "$Entities"):
            if section not in lines:
                continue
            head = lines.index(section) + 1
            for word in ("99999999999", "-1"):
                for position in range(min(2, len(lines[head].split()))):
                    words = lines[head].split()
                    words[position] = word
                    name = f"{version}_{section[1:]}_{word}_{position}.msh"
                    write(name, "\n".join([*lines[:head], " ".join(words), *lines[head + 1:]]) + "\n")
                    result = voussoir("scene.prm", "--validate", *from_file(name))
                    what = f"{name}: status {result.returncode}: {result.stderr.strip()}"
                    expect(result.returncode in (0, 2), what)
                    expect(result.returncode == 0 or result.stderr.startswith("voussoir: error: "), what)
                    expect(len(result.stderr.splitlines()) <= 1, what)
    # A tag of an entity that is not there: gmsh's library crashes.
    lines = Path("sound_4.1.msh").read_text().splitlines()
    refusals = 0
    for i in range(lines.index("$Elements") + 2, lines.index("$EndElements")):
        words = lines[i].split()
        if len(words) == 4 and words[2] in ("3", "5"):  # dimension, tag, type, number of elements
            write("tag.msh", "\n".join([*lines[:i], " ".join([words[0], "77777", *words[2:]]), *lines[i + 1:]]) + "\n")
            result = voussoir("scene.prm", "--validate", *from_file("tag.msh"))
            expect(result.returncode in (0, 2) and result.stderr.count("\n") <= 1, f"{result}")
            refusals += result.returncode == 2
    expect(refusals > 0, "no mesh was refused")
    if hasattr(os, "mkfifo"):
        os.mkfifo("fifo.msh")
        refused(["scene.prm", "--validate", *from_file("fifo.msh")], "fifo.msh")


def fclib_files():
    """The sound files are solved, whatever the others are."""
    samples = Path(__file__).resolve().parent / "fclib"
    sound = str(samples / "FC3D_Example1.hdf5")
    data = (samples / "damS-quake3-mu0.75-gap.hdf5").read_bytes()
    names = []
    for i in range(24):  # the lists of entries, and sizes, of HDF5
        place = 8 + i * (min(len(data), 6000) // 24)
        names.append(write(f"damaged_{i}.hdf5", "").strip())
        Path(names[-1]).write_bytes(data[:place] + struct.pack("<q", (-1, 2**62, 0)[i % 3]) + data[place + 8:])
    result = contact_program(*names, sound, "--max-seconds", "2", "--tolerance", "1e-8")
    solved = [json.loads(line)["file"] for line in result.stdout.splitlines()]
    errors = result.stderr.splitlines()
    print("\n".join("    " + line for line in errors))
    expect(result.returncode == 2 and sound in solved, f"{result}")
    expect(all(line.startswith(("voussoir: error: ", "voussoir: failed: ")) for line in errors), result.stderr)
    expect(len(solved) + len(errors) == len(names) + 2, "one line for each file, and the last")
    os.mkfifo("fifo.hdf5")
    refused(["fifo.hdf5"], "fifo.hdf5", run=contact_program)


def keys():
    write_scene("scene.prm", "subsection Joints\n  set Model = KSM\nend\n")
    for entry, parts in {"Height=1e-6": ("Joints/Keys/Height", "0.001 m"),
                         "Height=0.9 mm": ("Joints/Keys/Height", "0.0009 m"),
                         "Clearance=-0.001": ("Joints/Keys/Clearance",),
                         "Friction=1000": ("Joints/Keys/Friction", "10"),
                         "Friction=-0.5": ("Joints/Keys/Friction",),
                         "Flank angle=90": ("Flank angle", "90")}.items():
        refused(["scene.prm", "--validate", "--set", f"Joints/Keys/{entry}"], *parts)
    for entry in ("Height=0", "Height=1e-3"):
        runs("scene.prm", "--output", entry, "--set", f"Joints/Keys/{entry}", "--set", "Motion/Duration=0.2")


if __name__ == "__main__":
    run_cases(meshes, fclib_files, keys)
