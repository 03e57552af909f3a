#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Natural frequencies of the section of Koyna Dam in plane strain: Voussoir, and CalculiX (ccx) if it is installed.

    benchmarks/plane_strain.py [--cells 8 20] [--voussoir build/voussoir] [--ccx ccx]

Voussoir: a slice of 1 m of one element. CalculiX: CPE4 and CPE8 on the same section, and CPE8 on one of four times as many
cells in each direction (the reference). Rigid base, empty reservoir.
"""

import argparse
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "tests" / "golden")]
import koyna  # noqa: E402
from plane_elements import all_nodes  # noqa: E402

YOUNG, POISSON, DENSITY, COUNT = 31.027e9, .2, 2643., 4


def of_voussoir(program, cells, settings, directory):
    """The lowest natural frequencies [Hz]."""
    koyna.write(directory / "koyna.msh", *cells)
    entries = ["Mesh/Source=file", "Mesh/File=koyna.msh", "Mesh/Plane strain=true", "Reservoir/Density=0", "Motion/Source=none",
               f"Concrete/Young's modulus={YOUNG}", f"Concrete/Poisson's ratio={POISSON}", f"Concrete/Density={DENSITY}", *settings]
    (directory / "koyna.prm").write_text("")
    subprocess.run([program, "modes", "koyna.prm", "--count", str(COUNT), "--output", "modes",
                    *(x for entry in entries for x in ("--set", entry))], cwd=directory, check=True, capture_output=True)
    with open(directory / "modes" / "modes.csv") as file:
        result = [float(row["frequency"]) for row in csv.DictReader(file)]
    shutil.rmtree(directory / "modes")
    return result


def of_calculix(ccx, cells, element, directory):
    """The lowest natural frequencies [Hz] with elements CPE4 or CPE8."""
    degree = 2 if element == "CPE8" else 1
    points, table = all_nodes(*koyna.section(*cells), degree)
    order = (0, 2, 8, 6, 1, 5, 7, 3) if degree == 2 else (0, 1, 3, 2)
    used = sorted({nodes[k] for nodes in table for k in order})
    lines = ["*NODE, NSET=ALL"] + [f"{n + 1}, {points[n][0]:.12g}, {points[n][1]:.12g}, 0" for n in used]
    lines += [f"*ELEMENT, TYPE={element}, ELSET=DAM"]
    lines += [", ".join(str(n + 1) for n in (e, *(nodes[k] for k in order))) for e, nodes in enumerate(table)]
    lines += ["*NSET, NSET=BASE", *(f"{n + 1}," for n in used if points[n][1] < 1e-6), "*MATERIAL, NAME=CONCRETE", "*ELASTIC",
              f"{YOUNG}, {POISSON}", "*DENSITY", f"{DENSITY}", "*SOLID SECTION, ELSET=DAM, MATERIAL=CONCRETE", "1.",
              "*BOUNDARY", "BASE, 1, 2", "*STEP", "*FREQUENCY", str(COUNT), "*END STEP"]
    (directory / "job.inp").write_text("\n".join(lines) + "\n")
    subprocess.run([ccx, "job"], cwd=directory, check=True, stdout=subprocess.DEVNULL)
    rows = [line.split() for line in (directory / "job.dat").read_text().splitlines()]
    return [float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()][:COUNT]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cells", default=(8, 20), nargs=2, type=int, help="numbers of elements through the dam and over its height")
    parser.add_argument("--voussoir", default=ROOT / "build" / "voussoir", type=pathlib.Path, help="the program")
    parser.add_argument("--ccx", default="ccx", help="CalculiX")
    options = parser.parse_args()
    program, rows = options.voussoir.resolve(), []
    with tempfile.TemporaryDirectory() as temporary:
        directory = pathlib.Path(temporary)
        for name, settings in (("8 nodes", ["Elements/Incompatible modes=false"]), ("8 nodes, incompatible modes", []),
                               ("27 nodes", ["Elements/Degree=2"])):
            rows.append((f"Voussoir, {name}", of_voussoir(program, options.cells, settings, directory)))
        if shutil.which(options.ccx):
            fine = [4 * n for n in options.cells]
            for name, cells, element in (("CPE4", options.cells, "CPE4"), ("CPE8", options.cells, "CPE8"),
                                         (f"CPE8, {fine[0]} x {fine[1]}", fine, "CPE8")):
                rows.append((f"CalculiX, {name}", of_calculix(options.ccx, cells, element, directory)))
    reference = rows[-1][1]
    print(f"{'Frequencies [Hz]':36}" + "".join(f"{f'f{k + 1}':>10}" for k in range(COUNT)) + "   largest difference from the last row")
    for name, values in rows:
        off = max(abs(a / b - 1) for a, b in zip(values, reference))
        print(f"{name:36}" + "".join(f"{f:10.5f}" for f in values) + f"{100 * off:10.3f} %")


if __name__ == "__main__":
    main()
