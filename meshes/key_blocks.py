#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the meshes of benchmarks/keys_meshed.prm and keys_law.prm: two blocks side by side with a vertical joint, which has
a vertical shear key that is meshed, or is flat. Gmsh MSH 2.2, shared nodes: the program opens the joint.

    meshes/key_blocks.py [--output meshes] [--angle 45] [--height 0.2] [--refine 1]

Block 1 (y < 0) is held at its foot and at its far end, block 2 at its foot only: water pushes it downstream, past block 1.
"""

import argparse
import math
import pathlib

THICK, LONG, TALL, HALF_CREST = 2.0, 4.0, 12.0, 0.25  # x, y, z of a block; half the width of the key's crest [m]


def divisions(corners, counts):
    points = [corners[0]]
    for a, b, n in zip(corners, corners[1:], counts):
        points += [a + (b - a) * k / n for k in range(1, n + 1)]
    return points


def write_mesh(path, angle, height, meshed_height, refine):
    foot = HALF_CREST + height * math.tan(math.radians(angle))
    if not foot < 0.5 * THICK:
        raise SystemExit(f"Keys with flanks at {angle} degrees are wider than the blocks.")
    half = 0.5 * THICK
    counts = [n * refine for n in (2, 1, 2, 1, 2)]
    xs = divisions([-half, -foot, -HALF_CREST, HALF_CREST, foot, half], counts)
    joint = [meshed_height * min(1.0, max(0.0, (foot - abs(x)) / (foot - HALF_CREST))) for x in xs]
    n_y, zs = 6 * refine, divisions([0.0, TALL], [8 * refine])
    ts = [j / n_y for j in range(-n_y, n_y + 1)]
    ids, nodes = {}, []
    for j, t in enumerate(ts):
        s = abs(t) ** 1.5  # finer at the joint
        for i, x in enumerate(xs):
            for k, z in enumerate(zs):
                nodes.append((x, math.copysign(s, t) * LONG + (1.0 - s) * joint[i], z))
                ids[i, j, k] = len(nodes)
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    elements = []  # type, physical id, nodes

    def face(surface, place, first, second):
        for a in range(len(first) - 1):
            for b in range(len(second) - 1):
                elements.append((3, surface, [ids[place(a + p, b + q)] for p, q in corners]))

    nx, ny, nz = len(xs) - 1, len(ts) - 1, len(zs) - 1
    face(1, lambda i, j: (i, j, 0), xs, ts)  # base: the feet, and the far end of block 1
    face(1, lambda i, k: (i, 0, k), xs, zs)
    face(2, lambda j, k: (0, j, k), ts, zs)  # upstream
    face(3, lambda j, k: (nx, j, k), ts, zs)  # downstream
    face(4, lambda i, j: (i, j, nz), xs, ts)  # crest
    for j in range(ny):
        for i in range(nx):
            for k in range(nz):
                block = 1 if j < n_y else 2
                elements.append((5, block, [ids[i + p, j + q, k + r] for r in (0, 1) for p, q in corners]))
    with open(path, "w") as f:
        f.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}\n")
        for number, x in enumerate(nodes, 1):
            f.write(f"{number} {x[0]:.16g} {x[1]:.16g} {x[2]:.16g}\n")
        f.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        for number, (kind, group, corner) in enumerate(elements, 1):
            f.write(f"{number} {kind} 2 {group} {group} {' '.join(map(str, corner))}\n")
        f.write("$EndElements\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = pathlib.Path(__file__).resolve().parent
    parser.add_argument("--output", type=pathlib.Path, default=here, help="directory")
    parser.add_argument("--angle", type=float, default=45.0, help="of the flanks to the joint's normal [degrees], not 0")
    parser.add_argument("--height", type=float, default=0.2, help="of the key [m]")
    parser.add_argument("--refine", type=int, default=1)
    arguments = parser.parse_args()
    for name, height in (("keys_meshed.msh", arguments.height), ("keys_law.msh", 0.0)):
        write_mesh(arguments.output / name, arguments.angle, arguments.height, height, arguments.refine)


if __name__ == "__main__":
    main()
