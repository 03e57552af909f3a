#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the mesh of examples/section: a slice of a monolith of Koyna Dam (103 m high) for plane strain. Gmsh MSH 2.2.

    meshes/koyna.py [--output meshes/koyna.msh] [--cells 8 20] [--along 1] [--thickness 1]

x points downstream, from the vertical upstream face; y to the left bank; z up, from the base.
"""

import argparse
import pathlib

FACE = ((0., 70.2), (66.5, 19.25), (103., 14.8))  # downstream face, as usual in the literature: z, x [m]
SURFACES = {1: "base", 2: "upstream", 3: "downstream", 4: "crest"}


def section(n_through, n_up):
    """The nodes (x, z) [m] of the section, from the upstream face to the downstream face in each row, and the cells: four
    numbers of nodes, counterclockwise. Of n_up rows, 3/5 are below the change of the slope."""
    lower = round(.6 * n_up)
    heights = [FACE[1][0] * k / lower for k in range(lower)]
    heights += [FACE[1][0] + (FACE[2][0] - FACE[1][0]) * k / (n_up - lower) for k in range(n_up - lower + 1)]
    nodes = []
    for z in heights:
        (z1, x1), (z2, x2) = FACE[:2] if z < FACE[1][0] else FACE[1:]
        width = x1 + (x2 - x1) * (z - z1) / (z2 - z1)
        nodes += [(width * i / n_through, z) for i in range(n_through + 1)]
    row = n_through + 1
    return nodes, [(k * row + i, k * row + i + 1, (k + 1) * row + i + 1, (k + 1) * row + i)
                   for k in range(n_up) for i in range(n_through)]


def write(file, n_through, n_up, along=1, thickness=1., monolith=lambda i, k: 1):
    """Writes the section with `along` elements over the thickness [m]. monolith: number of the monolith of column i, row k."""
    plane, cells = section(n_through, n_up)
    n = len(plane)
    elements = []  # type, physical id, nodes
    for j in range(along):
        for c, cell in enumerate(cells):
            i, k = c % n_through, c // n_through
            a, b, d, e = (v + j * n for v in cell)
            elements.append((5, monolith(i, k), (a, e, d, b, a + n, e + n, d + n, b + n)))
            sides = {1: (k == 0, a, b), 2: (i == 0, a, e), 3: (i == n_through - 1, b, d), 4: (k == n_up - 1, e, d)}
            elements += [(3, tag, (p, q, q + n, p + n)) for tag, (outside, p, q) in sides.items() if outside]
    names = {(2, tag): name for tag, name in SURFACES.items()}
    names.update({(3, tag): f"monolith {tag}" for kind, tag, _ in elements if kind == 5})
    with open(file, "w") as f:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), sep="\n", file=f)
        for (dimension, tag), name in sorted(names.items()):
            print(dimension, tag, f'"{name}"', file=f)
        print("$EndPhysicalNames\n$Nodes", n * (along + 1), sep="\n", file=f)
        for j in range(along + 1):
            for v, (x, z) in enumerate(plane):
                print(j * n + v + 1, f"{x:.10g}", f"{thickness * j / along:.10g}", f"{z:.10g}", file=f)
        print("$EndNodes\n$Elements", len(elements), sep="\n", file=f)
        for e, (kind, tag, corners) in enumerate(sorted(elements, key=lambda element: element[0])):
            print(e + 1, kind, 2, tag, tag, *(v + 1 for v in corners), file=f)
        print("$EndElements", file=f)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", default=pathlib.Path(__file__).resolve().parent / "koyna.msh", help="a file")
    parser.add_argument("--cells", default=(8, 20), nargs=2, type=int, help="numbers of elements through the dam and over its height")
    parser.add_argument("--along", default=1, type=int, help="number of elements over the thickness")
    parser.add_argument("--thickness", default=1., type=float, help="[m]")
    options = parser.parse_args()
    write(options.output, *options.cells, options.along, options.thickness)


if __name__ == "__main__":
    main()
