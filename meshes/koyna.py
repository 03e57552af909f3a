#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the mesh of examples/koyna and examples/snap_back: a slice of a monolith of Koyna Dam (103 m high) for plane strain. Gmsh MSH 2.2.

    meshes/koyna.py [--output meshes/koyna.msh] [--cells 8 20] [--along 1] [--thickness 1] [--rock 0 0] [--no-lift]

x points downstream, from the vertical upstream face; y to the left bank; z up, from the base.
"""

import argparse
import pathlib

FACE = ((0., 70.2), (66.5, 19.25), (103., 14.8))  # downstream face, as usual in the literature: z, x [m]
SURFACES = {1: "base", 2: "upstream", 3: "downstream", 4: "crest", 5: "free surface", 6: "artificial boundary"}
ROCK = 1000


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


def rock_below(plane, n_through, beside, below):
    """The nodes (x, z) of rock below and beside the section, in columns as wide as those at its base, and the cells with the
    surfaces of their lower, upstream, downstream and upper sides (or None). Nodes of the base are those of the section."""
    size = FACE[0][1] / n_through
    row = n_through + 2 * beside + 1
    nodes, number, cells = list(plane), {}, []
    for k in range(below + 1):
        for i in range(row):
            at_base = k == below and 0 <= i - beside <= n_through
            number[i, k] = i - beside if at_base else len(nodes)
            if not at_base:
                nodes.append((size * (i - beside), size * (k - below)))
    for k in range(below):
        for i in range(row - 1):
            top = None if k + 1 < below else 1 if 0 <= i - beside < n_through else 5
            cells.append((tuple(number[at] for at in ((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1))),
                          (6 if k == 0 else None, 6 if i == 0 else None, 6 if i == row - 2 else None, top)))
    return nodes, cells


def write(file, n_through, n_up, along=1, thickness=1., monolith=lambda i, k: 1, rock=(0, 0), names=None):
    """Writes the section with `along` elements over the thickness [m]. monolith: number of the monolith of column i, row k.
    rock: numbers of elements beside and below the section. names: of the monoliths, where they are not the usual ones."""
    plane, cells = section(n_through, n_up)
    parts = []  # volume, corners, surfaces of the lower, upstream, downstream and upper sides
    for c, cell in enumerate(cells):
        i, k = c % n_through, c // n_through
        parts.append((monolith(i, k), cell, (1 if k == 0 and not rock[1] else None, 2 if i == 0 else None,
                                             3 if i == n_through - 1 else None, 4 if k == n_up - 1 else None)))
    if rock[1]:
        plane, cells = rock_below(plane, n_through, *rock)
        parts += [(ROCK, *part) for part in cells]
    n = len(plane)
    elements = []  # type, physical id, nodes
    for j in range(along):
        for volume, cell, surfaces in parts:
            a, b, d, e = (v + j * n for v in cell)
            elements.append((5, volume, (a, e, d, b, a + n, e + n, d + n, b + n)))
            for tag, p, q in zip(surfaces, (a, a, b, e), (b, e, d, d)):
                if tag:
                    elements.append((3, tag, (p, q, q + n, p + n)))
    labels = {ROCK: "rock", **(names or {})}
    names = {(2, tag): SURFACES[tag] for kind, tag, _ in elements if kind == 3}
    names.update({(3, tag): labels.get(tag, f"monolith {tag}") for kind, tag, _ in elements if kind == 5})
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
    parser.add_argument("--rock", default=(0, 0), nargs=2, type=int, help="numbers of rock elements beside and below the dam; 0: none")
    parser.add_argument("--no-lift", action="store_true", help="without the lift joint where the slope of the downstream face changes")
    options = parser.parse_args()
    lower = round(.6 * options.cells[1])
    write(options.output, *options.cells, options.along, options.thickness,
          (lambda i, k: 1) if options.no_lift else lambda i, k: 1 + (k >= lower), options.rock,
          None if options.no_lift else {1: "monolith 1 lift 1", 2: "monolith 1 lift 2"})


if __name__ == "__main__":
    main()
