#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of scripts/paraview_state.py on a run: the arrays that it names are in the run's files; ParaView draws a picture of them.

    program_paraview.py VOUSSOIR CASE...

Where pvpython or Xvfb is missing, or /usr/bin/python3 has no matplotlib to look at the picture, the case picture is skipped (status 77), and says so.
"""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from run_program import expect, run_cases, runs, settings, write_scene

SCRIPTS = Path(__file__).resolve().parent.parent / "scripts"
STATE = SCRIPTS / "paraview_state.py"
sys.path.insert(0, str(SCRIPTS.parent / "python"))
from voussoir.vtu import read_vtu  # noqa: E402

NEEDED = {0: {"displacement": 3, "max_principal": 1}, 1: {"displacement": 3, "opening": 1}}  # part -> arrays, their components


def run():
    """A small run with fields; its files by part of solution.pvd."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=10", "Motion/Duration=0.5"))
    sets = [entry.attrib for entry in ElementTree.parse("run/solution.pvd").iter("DataSet")]
    files = {part: [Path("run", entry["file"]) for entry in sets if int(entry.get("part", 0)) == part] for part in (0, 1)}
    expect(len(files[0]) == len(files[1]) == 6 and len(sets) == 12, f"parts of solution.pvd: {sets}")
    return files


def point_arrays(path):
    """Of a file's points, with their numbers of components."""
    data = next(ElementTree.fromstring(Path(path).read_text()).iter("PointData"))
    return {array.get("Name"): int(array.get("NumberOfComponents") or 1) for array in data.iter("DataArray")}


def arrays():
    """What the script colours and warps by is in each file of its part, with values; the tables that it reads have its columns."""
    script = STATE.read_text()
    for name in {name for part in NEEDED.values() for name in part}:
        expect(f'"{name}"' in script, f"the script no longer names {name}: mend NEEDED of this test")
    named = set(re.findall(r'coloured\(.*?view, "(\w+)"', script)) | set(re.findall(r'"POINTS", "(\w+)"\]', script))
    expect(named == {"displacement", "max_principal", "opening"}, f"the script names {named}: mend NEEDED of this test")
    largest = {}
    for part, files in run().items():
        for path in files:
            expect(path.is_file(), f"{path} is missing")
            there, values = point_arrays(path), read_vtu(path)
            for name, components in NEEDED[part].items():
                expect(there.get(name) == components, f"{path}: {name} has {there.get(name)} components instead of {components}")
                expect(len(values[name]) == components * len(values["Points"]) // 3, f"{path}: length of {name}")
                largest[part, name] = max([largest.get((part, name), 0.), *(abs(v) for v in values[name] if v == v)])
    print("    largest values:", {name: f"{value:.3g}" for (_, name), value in largest.items()})
    expect(min(largest.values()) > 0., f"nothing to see: {largest}")
    header = Path("run/joint_history.csv").read_text().splitlines()[0].split(",")
    expect("time" in header and any(name.startswith("opening") for name in header), f"joint_history.csv: {header}")


def pvpython(*arguments):
    """On a screen of its own, that no other X server of this machine has; its standard output."""
    screen = ["xvfb-run", "-a", "-n", str(200 + os.getpid() % 30000), "-s", "-screen 0 1600x1000x24 -noreset"]
    result = subprocess.run([*screen, "pvpython", str(STATE), *arguments], capture_output=True, text=True, timeout=240)
    expect(result.returncode == 0, f"pvpython: status {result.returncode}: {result.stdout[-2000:]}{result.stderr[-2000:]}")
    return result.stdout


def colours(path):
    """Share of pixels that are not white, and the share of those of them that are coloured (no grey), within the middle of the picture."""
    code = ("import sys, matplotlib.image as i; p = 255 * i.imread(sys.argv[1])[:, :, :3]; h, w = p.shape[:2]; "
            "p = p[h // 8:-h // 8, w // 5:-w // 5].reshape(-1, 3); d = p[p.min(1) < 250]; "
            "print(w, h, len(d) / len(p), (d.max(1) - d.min(1) > 40).mean() if len(d) else 0.)")
    words = subprocess.run(["/usr/bin/python3", "-c", code, path], capture_output=True, text=True, check=True).stdout.split()
    return int(words[0]), int(words[1]), float(words[2]), float(words[3])


def picture():
    """ParaView draws dam and joints: the picture shows much, in colour, and changes with the time; the state names this run and its arrays."""
    for need in ("pvpython", "xvfb-run", "Xvfb"):
        if not shutil.which(need):
            print(f"SKIPPED: no {need} (apt-get install paraview python3-paraview xvfb): the picture of scripts/paraview_state.py is not tested")
            sys.exit(77)
    if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True).returncode:
        print("SKIPPED: no matplotlib for /usr/bin/python3: the picture of scripts/paraview_state.py is not tested")
        sys.exit(77)
    run()
    said = pvpython("run", "--magnify", "500", "--tension", "1", "--time", "0.5", "--picture", "late.png", "--state", "run.pvsm")
    expect("late.png: t = 0.5 s" in said and "run.pvsm" in said, said)
    width, height, drawn, coloured = colours("late.png")
    print(f"    {width} x {height}, {drawn:.0%} of the middle drawn, {coloured:.0%} of that in colour")
    expect((width, height) == (1600, 900), "size of the picture")
    expect(.05 < drawn < .9, f"{drawn:.1%} of the picture's middle is drawn: blank, or all of it")
    expect(coloured > .1, f"only {coloured:.1%} of what is drawn is coloured: the stresses do not show")
    pvpython("run", "--magnify", "500", "--tension", "1", "--time", "0", "--picture", "early.png")
    expect(Path("early.png").read_bytes() != Path("late.png").read_bytes(), "the picture does not change with the time")
    state = ElementTree.parse("run.pvsm")
    texts = {entry.get("value", "") for entry in state.iter("Element")} | {entry.get("text", "") for entry in state.iter("String")}
    for name in ("displacement", "max_principal", "opening", str(Path("run/solution.pvd").resolve())):
        expect(name in texts, f"the state does not name {name}")
    shown = [proxy.get("type") for proxy in state.iter("Proxy") if proxy.get("group") == "filters"]
    expect(shown.count("WarpVector") == 2 and shown.count("ExtractBlock") == 2, f"filters of the state: {shown}")


if __name__ == "__main__":
    run_cases(arrays, picture)
