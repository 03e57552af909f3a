#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the stress envelopes of prm/coarse.prm, node by node, with and without the known tractions.

    benchmarks/stress_error.py [--duration 4] [--fine 2] [--voussoir PROGRAM]

Static state, then shaking, on 60 x 16 x 2 elements; the reference is the mesh with --fine times as many each way, with the
known tractions. Its nodes are the coarse mesh's, too. Nodes nearer to the base than a tenth of the height are left out.
"rms" is relative to the rms of the reference over the same nodes. Prints a Markdown table."""

import argparse
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

from program import ROOT, add_program_argument, run, simulate

SCENE = ROOT / "prm" / "coarse.prm"
MESH = (60, 16, 2)
RECOVERIES = ("elements", "tractions")


def envelopes(program, mesh, recovery, entries):
    """{(face, monolith, x, y, z): (largest, smallest principal stress)} [MPa], and the places of the base."""
    names = ("Elements along", "Elements up", "Elements through")
    with tempfile.TemporaryDirectory() as directory:
        simulate(program, SCENE, output=directory, settings={
            **{f"Mesh/Arch210/{name}": n for name, n in zip(names, mesh)}, **entries, "Output/Stress recovery": recovery})
        nodes, quads = (np.genfromtxt(Path(directory) / name, delimiter=",", names=True, dtype=None, encoding=None)
                        for name in ("faces.csv", "faces_cells.csv"))
    places = [(n["face"], *(round(float(n[c]), 2) for c in "xyz")) for n in nodes]
    values = {(p[0], int(n["monolith"]), *p[1:]): (n["max_principal"] / 1e6, n["min_principal"] / 1e6)
              for p, n in zip(places, nodes)}
    edges = Counter(tuple(sorted((places[q[f"n{a}"]], places[q[f"n{(a + 1) % 4}"]]))) for q in quads for a in range(4))
    top = max(p[3] for p in places)
    outline = {p for edge, n in edges.items() if n == 1 and min(p[3] for p in edge) < top - .1 for p in edge}
    return values, np.array([p[1:] for p in outline])


def row(name, coarse, fine, base, column):
    keys = [k for k in coarse if k in fine]
    place = np.array([k[2:] for k in keys])
    ours, theirs = (np.array([values[k][column] for k in keys]) for values in (coarse, fine))
    height = place[:, 2].max() - place[:, 2].min()
    above = np.array([np.linalg.norm(base - p, axis=1).min() for p in place]) >= .1 * height
    sides = Counter((k[0], *k[2:]) for k in keys)
    joint = np.array([sides[k[0], *k[2:]] > 1 for k in keys])
    crest = place[:, 2] > place[:, 2].max() - .1
    error = ours - theirs

    def rms(nodes):
        return np.sqrt(np.mean(error[nodes]**2)), np.sqrt(np.mean(theirs[nodes]**2))

    cells = []
    for nodes in (above, above & joint, above & crest, above & ~joint & ~crest):
        e, size = rms(nodes)
        cells.append(f"{e:.3f} ({e / size:.1%})")
    return f"| {name} | " + " | ".join(cells) + f" | {np.abs(error[above]).max():.2f} | {error[above].mean():+.3f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--duration", type=float, default=4., help="of the shaking [s]")
    parser.add_argument("--fine", type=int, default=2, help="refinement of the reference")
    options = parser.parse_args()
    print("| envelope | rms, all [MPa] | at joints | at the crest | elsewhere | worst [MPa] | mean [MPa] |\n" + "|---" * 7 + "|")
    with tempfile.TemporaryDirectory() as temporary:
        motion = Path(temporary) / "motion.csv"
        run(options.voussoir, "motion", SCENE, "--output", motion)
        for state, entries in (("static", {"Motion/Source": "none"}),
                               (f"{options.duration:g} s", {"Motion/Source": "file", "Motion/File": motion,
                                                            "Motion/Duration": options.duration})):
            fine, _ = envelopes(options.voussoir, [options.fine * n for n in MESH], "tractions", entries)
            for recovery in RECOVERIES:
                coarse, base = envelopes(options.voussoir, MESH, recovery, entries)
                for column, what in enumerate(("tension", "compression")):
                    print(row(f"{state}, {what}, {recovery}", coarse, fine, base, column), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
