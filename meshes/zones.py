#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the mesh meshes/zones.msh of the tests: two monoliths of a gravity dam of three concretes on flat ground of three rocks. Gmsh
MSH 2.2, shared nodes: the program opens the joint.

    meshes/zones.py [--output meshes]

The lowest cells of the dam are its "heel", the highest its "crown", the rest has no zone. In the rock a horizontal "weak
layer" lies below the dam, and a vertical "fault zone" across the valley downstream of it, which cuts the layer.
"""

import argparse
import pathlib

WIDE, TALL, CREST = 24.0, 40.0, 8.0  # of the dam: its foot and crest along x, its height [m]
ACROSS, UP, ALONG = 3, 5, 4  # its cells along x, z and y; monoliths are half of it
CELL, SIDE, LAYERS = 8.0, 5, 6  # rock: edge of its cells [m], cells beside the dam, below it
NAMES = {1: "monolith 1", 2: "monolith 2", 11: "monolith 1 heel", 12: "monolith 2 heel", 21: "monolith 1 crown",
         22: "monolith 2 crown", 1000: "rock", 1001: "rock weak layer", 1002: "rock fault zone"}
SURFACES = {1: "base", 2: "upstream", 3: "downstream", 4: "crest", 5: "free surface", 6: "artificial boundary"}
NX, NY = ACROSS + 2 * SIDE, ALONG + 2 * SIDE


def is_dam(i, j, k):
    return SIDE <= i < SIDE + ACROSS and SIDE <= j < SIDE + ALONG and 0 <= k < UP


def is_rock(i, j, k):
    return 0 <= i < NX and 0 <= j < NY and -LAYERS <= k < 0


def volume(i, j, k):
    if k < 0:
        return 1002 if i in (SIDE + ACROSS + 1, SIDE + ACROSS + 2) else 1001 if k == -2 else 1000
    return (10 if k == 0 else 20 if k == UP - 1 else 0) + (1 if j < SIDE + ALONG // 2 else 2)


def place(i, j, k):
    x, z = CELL * (i - SIDE), CELL * k
    if k > 0:  # vertical upstream, leaning downstream
        x *= 1 - (1 - CREST / WIDE) * k / UP
    return x, CELL * (j - NY / 2), z


def surface(axis, upper, of_rock, beyond):
    """Of a side of a cell; None inside, and of the dam's ends, which are free."""
    if of_rock and beyond == "dam":
        return 1
    if beyond:
        return None
    if of_rock:
        return 5 if axis == 2 and upper else 6
    return 4 if axis == 2 else {(0, False): 2, (0, True): 3}.get((axis, upper))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", default=pathlib.Path(__file__).resolve().parent, type=pathlib.Path, help="a directory")
    ids, elements = {}, []  # type, physical id, nodes
    node = lambda *at: ids.setdefault(at, len(ids) + 1)
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    for k in range(-LAYERS, UP):
        for j in range(NY):
            for i in range(NX):
                cell = (i, j, k)
                if not (is_dam(*cell) or is_rock(*cell)):
                    continue
                elements.append((5, volume(*cell), [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ring]))
                for axis in range(3):
                    for upper in (False, True):
                        to = list(cell)
                        to[axis] += 1 if upper else -1
                        beyond = "dam" if is_dam(*to) else "rock" if is_rock(*to) else ""
                        group = surface(axis, upper, k < 0, beyond)
                        if group is None:
                            continue
                        corners = []
                        for a, b in ring:
                            at = list(cell)
                            at[axis] += upper
                            one, two = [d for d in range(3) if d != axis]
                            at[one], at[two] = at[one] + a, at[two] + b
                            corners.append(node(*at))
                        elements.append((3, group, corners))
    with open(parser.parse_args().output / "zones.msh", "w") as f:
        groups = [(2, *group) for group in SURFACES.items()] + [(3, *group) for group in NAMES.items()]
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(groups), sep="\n", file=f)
        for dimension, tag, name in groups:
            print(dimension, tag, f'"{name}"', file=f)
        print("$EndPhysicalNames\n$Nodes", len(ids), sep="\n", file=f)
        for at, number in ids.items():
            print(number, *(f"{x:.10g}" for x in place(*at)), file=f)
        print("$EndNodes\n$Elements", len(elements), sep="\n", file=f)
        for number, (kind, group, nodes) in enumerate(sorted(elements), 1):
            print(number, kind, 2, group, group, *nodes, file=f)
        print("$EndElements", file=f)


if __name__ == "__main__":
    main()
