#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Largest gain of local time steps in the rock of a scene.

    benchmarks/local_steps.py [SCENE ...] [--set Section/Entry=value] [--voussoir PROGRAM]

Each rock cell has a critical time step by the largest frequency of its own elements with nodal quadrature, a lower bound of that
of the mesh. One step for all cells is the smallest; with local steps each cell has the largest power of two times the smallest step
that its neighbours allow, too. Gain: cell steps per second of one step over those of local steps, without the cost of the interfaces.
All rock has the same wave speed and nodal quadrature, also at the dam. Prints a Markdown table.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

from program import ROOT, add_program_argument, run

FIRST_ROCK = 1000  # physical id of rock volumes
CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


def read_mesh(path):
    """Nodes [m] and nodes of the hexahedra of a file in the format 2.2, and their physical ids."""
    lines = path.read_text().split("\n")
    begin = lines.index("$Nodes") + 1
    n = int(lines[begin])
    nodes = np.array([line.split()[1:] for line in lines[begin + 1:begin + 1 + n]], dtype=float)
    number = {int(line.split(" ", 1)[0]): i for i, line in enumerate(lines[begin + 1:begin + 1 + n])}
    begin = lines.index("$Elements") + 1
    cells, ids = [], []
    for line in lines[begin + 1:begin + 1 + int(lines[begin])]:
        entry = line.split()
        if entry[1] == "5":
            ids.append(int(entry[3]))
            cells.append([number[int(k)] for k in entry[-8:]])
    return nodes, np.array(cells), np.array(ids)


def critical_steps(x, speed, poisson):
    """Critical time steps of cells with the corners x and the P wave speed [s], in batches."""
    result = []
    for part in np.array_split(x, max(1, len(x) // 2000)):
        stiffness, mass = np.zeros((len(part), 24, 24)), np.zeros((len(part), 8))
        mu = (1 - 2 * poisson) / (2 - 2 * poisson)  # over lambda + 2 mu
        law = np.diag([1, 1, 1, mu, mu, mu]).astype(float)
        law[:3, :3] += (1 - 2 * mu) * (1 - np.eye(3))
        for corner in CORNERS:
            gradient = np.array([[s[d] * np.prod([1 + s[e] * corner[e] for e in range(3) if e != d]) / 8 for d in range(3)] for s in CORNERS])
            jacobian = np.einsum("cki,kj->cij", part, gradient)
            volume = np.linalg.det(jacobian)
            g = np.einsum("kj,cji->cki", gradient, np.linalg.inv(jacobian))
            strain = np.zeros((len(part), 6, 24))
            for row, pairs in enumerate((((0, 0),), ((1, 1),), ((2, 2),), ((0, 1), (1, 0)), ((1, 2), (2, 1)), ((0, 2), (2, 0)))):
                for component, derivative in pairs:
                    strain[:, row, component::3] += g[:, :, derivative]
            stiffness += volume[:, None, None] * np.einsum("cai,ab,cbj->cij", strain, law, strain, optimize=True)
            mass[:, (CORNERS == corner).all(axis=1).argmax()] += volume
        scale = 1 / np.sqrt(np.repeat(mass, 3, axis=1))
        largest = np.linalg.eigvalsh(stiffness * scale[:, :, None] * scale[:, None, :])[:, -1]
        result.append(2 / (speed * np.sqrt(largest)))
    return np.concatenate(result)


def levels_of(cells, n_nodes, steps):
    """Power of two of the step of each cell, limited by the cells at its nodes."""
    of_node = np.full(n_nodes, np.inf)
    for corner in cells.T:
        np.minimum.at(of_node, corner, steps)
    return np.floor(np.log2(of_node[cells].min(axis=1) / steps.min() * (1 + 1e-12)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("scenes", nargs="*", default=["rock_fja", "rock28"])
    parser.add_argument("--set", action="append", default=[], metavar="Section/Entry=value")
    parser.add_argument("--speed", type=float, default=2582., help="of P waves [m/s]; default: that of the default rock")
    parser.add_argument("--poisson", type=float, default=.25)
    options = parser.parse_args()
    print("| Scene | Rock cells | Smallest; median; largest critical step [ms] | Cells with twice the step [%] | Gain |\n|---|---|---|---|---|")
    for scene in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            mesh = Path(folder, "scene.msh")
            run(options.voussoir, "mesh", ROOT / "prm" / f"{scene}.prm", "--output", mesh, "--format", "2.2",
                *(word for entry in options.set for word in ("--set", entry)))
            nodes, cells, ids = read_mesh(mesh)
        cells = cells[ids >= FIRST_ROCK]
        steps = critical_steps(nodes[cells], options.speed, options.poisson)
        levels = levels_of(cells, len(nodes), steps)
        gain = len(cells) / np.sum(2. ** -levels)
        low, middle, high = 1e3 * steps.min(), 1e3 * np.median(steps), 1e3 * steps.max()
        print(f"| {scene} | {len(cells)} | {low:.2f}; {middle:.2f}; {high:.2f} | {100 * np.mean(levels > 0):.0f} | {gain:.2f} |", flush=True)


if __name__ == "__main__":
    main()
