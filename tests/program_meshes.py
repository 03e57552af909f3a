#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of other programs and of other elements: .inp, .med, wedges, second order.

    program_meshes.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
import meshes  # noqa: E402
from compare import scene  # noqa: E402
from run_program import run_cases, expect, refused, runs, summary, voussoir, write  # noqa: E402

CELLS = ((1, 1, 2, 2), 2, 3)
WATER = {"Density": 1000, "Water level": 25}
HEXAHEDRON = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))  # S1 to S6


def crest(name, mesh, **entries):
    """Displacement of the crest under water."""
    runs(scene(name, mesh, Reservoir=WATER, Joints={"Model": "FJA"}, **entries), "--output", name)
    return summary(name)["static"]["crest_displacement"]


def alike(a, b, limit=1e-9):
    print(f"    {a} {b}")
    expect(math.dist(a, b) <= limit * math.hypot(*b), f"{a} {b}")


def has_meshio():
    if os.system("/usr/bin/python3 -c 'import meshio' 2> /dev/null"):
        print("skipped: no meshio")
        sys.exit(77)


def blocks_of(nodes, hexes):
    lines = ["*HEADING", "*NODE, NSET=NALL"] + [f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(nodes)]
    number = 0
    for m in sorted({m for m, _ in hexes}):
        lines.append(f"*ELEMENT, TYPE=C3D8, ELSET=MONOLITH_{m}")
        for volume, corners in hexes:
            if volume == m:
                number += 1
                lines.append(", ".join(str(n) for n in (number, *(c + 1 for c in corners))))
    return lines, number


def inp():
    """Surfaces by shells, by *SURFACE with sets and with single elements, by NSETs: all the same dam."""
    has_meshio()
    meshes.arch("arch.msh", *CELLS)
    expected = crest("gmsh", "arch.msh")
    nodes, hexes, quads = meshes.arch_block(*CELLS)
    surfaces = {meshes.NAMES[tag]: [q for t, q in quads if t == tag] for tag in (1, 2, 3, 4)}
    lines, number = blocks_of(nodes, hexes)
    shells = list(lines)
    for name, faces in surfaces.items():
        shells.append(f"*ELEMENT, TYPE=S4, ELSET={name.upper()}")
        for face in faces:
            number += 1
            shells.append(", ".join(str(n) for n in (number, *(c + 1 for c in face))))
    by_set, by_nodes = list(lines) + ["*ELSET, ELSET=EALL", "1, 2"], list(lines)
    order = [corners for m in (1, 2) for volume, corners in hexes if volume == m]
    for name, faces in surfaces.items():
        wanted = {frozenset(face) for face in faces}
        rows = [(k + 1, j + 1) for k, corners in enumerate(order) for j, f in enumerate(HEXAHEDRON)
                if frozenset(corners[i] for i in f) in wanted]
        if name == "upstream":
            labels = sorted({j for _, j in rows})
            for j in labels:
                by_set += [f"*ELSET, ELSET=_upstream_S{j}", *(str(k) for k, label in rows if label == j)]
            rows = [(f"_upstream_S{j}", j) for j in labels]
        by_set += [f"*SURFACE, NAME={name}, TYPE=ELEMENT", *(f"{of}, S{j}" for of, j in rows)]
        by_nodes += [f"*NSET, NSET={name}", *(str(n + 1) for n in sorted({n for face in faces for n in face}))]
    for name, text in (("shells", shells), ("surfaces", by_set), ("nodes", by_nodes)):
        write(f"{name}.inp", "\n".join(text) + "\n")
        alike(crest(name, f"{name}.inp"), expected)
    # Blocks of elements that share a set's name, and one without a set.
    first = lines.index("*ELEMENT, TYPE=C3D8, ELSET=MONOLITH_1")
    shared = [*by_nodes[:first + 4], by_nodes[first], *by_nodes[first + 4:]]
    unnamed = [line.replace(", ELSET=MONOLITH_1", "") for line in shells]
    unnamed += ["*ELSET, ELSET=Monolith_1, GENERATE", f"1, {sum(m == 1 for m, _ in hexes)}, 1"]
    for name, text in (("shared", shared), ("unnamed", unnamed)):
        write(f"{name}.inp", "\n".join(text) + "\n")
        alike(crest(name, f"{name}.inp"), expected)
    # Water that shares its nodes with the dam.
    meshes.with_water("arch.msh", "wet.msh", [30.] * 3, 60.)
    places, elements, _ = meshes.read("wet.msh")
    more = [", ".join(map(str, (n, *places[n]))) for n in range(len(nodes) + 1, len(places) + 1)]
    last = next(k for k, line in enumerate(by_nodes) if line.startswith("*ELEMENT"))
    cells = [", ".join(map(str, (1000 + k, *c))) for k, (_, tag, c) in enumerate(elements) if tag == 2000]
    write("water.inp", "\n".join([*by_nodes[:last], *more, "*ELEMENT, TYPE=C3D8, ELSET=WATER", *cells, *by_nodes[last:]]) + "\n")
    alike(crest("water", "water.inp"), expected)
    expect(f"{len(cells)} hexahedra" in runs("water.prm", "--validate"), "hexahedra of the water")
    write("parts.inp", "\n".join([*lines[:5], "*NODE", *lines[5:]]) + "\n")
    refused([scene("parts", "parts.inp"), "--validate"], "parts.inp", "*NODE", "flat file")
    write("bare.inp", "\n".join(lines).replace("MONOLITH_", "BLOCK") + "\n")
    refused([scene("bare", "bare.inp"), "--validate"], "bare.inp", "no volumes are in a group", "'BLOCK1'")
    write("broken.inp", "*NODE\n1, 2\n*ELEMENT, TYPE=C3D8\n1, 2, 3\n")
    refused([scene("broken", "broken.inp"), "--validate"], "broken.inp", "cannot be converted", "Expected number of data items")
    write("label.inp", "\n".join(by_set).replace(f"_upstream_S{labels[0]}, S{labels[0]}", f"_upstream_S{labels[0]}, SNEG") + "\n")
    refused([scene("label", "label.inp"), "--validate"], "label.inp", "'upstream'", "SNEG")
    refused([scene("none", "none.inp"), "--validate"], "none.inp", "does not exist")
    file = scene("shells", "shells.inp")
    for variable, value, part in (("VOUSSOIR_PYTHON", "/bin/false", "cannot be converted"),
                                  ("VOUSSOIR_SCRIPTS", "/", "VOUSSOIR_SCRIPTS")):
        result = voussoir(file, "--validate", environment={variable: value})
        expect(result.returncode == 2 and part in result.stderr, result.stderr)
    write("lacks", "#!/bin/sh\nexit 3\n")
    os.chmod("lacks", 0o755)
    result = voussoir(file, "--validate", environment={"VOUSSOIR_PYTHON": os.path.abspath("lacks")})
    expect(result.returncode == 2 and "python3-meshio" in result.stderr, result.stderr)
    print("   ", result.stderr.strip())


def med():
    """Groups of volumes and of faces in a file as Salome writes it."""
    has_meshio()
    meshes.arch("arch.msh", *CELLS)
    nodes, hexes, quads = meshes.arch_block(*CELLS)
    write("make.py", f"""
import meshio, numpy as np
nodes, hexes, quads = {nodes!r}, {hexes!r}, {quads!r}
names = {meshes.NAMES!r}
mesh = meshio.Mesh(np.array(nodes), [("hexahedron", np.array([c for _, c in hexes])), ("quad", np.array([c for _, c in quads]))],
                   cell_data={{"cell_tags": [np.array([-m for m, _ in hexes]), np.array([-100 - t for t, _ in quads])]}})
mesh.cell_tags = {{**{{-m: [f"monolith_{{m}}"] for m, _ in hexes}}, **{{-100 - t: [names[t]] for t, _ in quads}}}}
meshio.write("arch.med", mesh)
""")
    expect(os.system("/usr/bin/python3 make.py > make.log 2>&1") == 0, Path("make.log").read_text())
    alike(crest("med", "arch.med"), crest("gmsh", "arch.msh"))


def wedges():
    """A wall whose ends close to a point, of wedges there: refused as it is, with the way out; subdivided it is the wall of
    cells half as large. Tetrahedra are refused."""
    nodes, hexes, quads = meshes.block(lambda i, j, k: (5. * j, 10. * (i - 2), 10. * k), (1, 1, 2, 2), 2, 3, meshes.DAM)
    meshes.write("box.msh", nodes, hexes, quads)
    fine = meshes.block(lambda i, j, k: (2.5 * j, 5. * i - 20., 5. * k), (1,) * 4 + (2,) * 4, 4, 6, meshes.DAM)
    meshes.write("fine.msh", *fine)
    alike(crest("subdivided", "box.msh", Mesh={"Source": "file", "File": "box.msh", "Subdivide": "true"}), crest("fine", "fine.msh"))
    # the cell at the foot of each end becomes a wedge: its outer lower edge is gone
    number = {tuple(x): n for n, x in enumerate(nodes)}
    def moved(corners, collapse):
        return [number[nodes[c][0], -10. if collapse and nodes[c][1] == -20. else 10. if collapse and nodes[c][1] == 20. else nodes[c][1], 0.]
                if nodes[c][2] == 0. and abs(nodes[c][1]) == 20. else c for c in corners]
    hexes = [(m, moved(c, True)) for m, c in hexes]
    quads = [(t, moved(c, True)) for t, c in quads]
    quads = [(t, c) for t, c in quads if len(set(c)) > 2]
    with open("wedges.msh", "w") as out:
        write_mixed(out, nodes, hexes, quads)
    file = scene("wedges", "wedges.msh", Reservoir=WATER)
    refused([file, "--validate"], "wedge", "Mesh/Subdivide")
    shown = runs(file, "--validate", "--set", "Mesh/Subdivide=true")
    expect(f"{8 * 20 + 6 * 4} cells" in shown, shown)
    alike(crest("wedges", "wedges.msh", Mesh={"Source": "file", "File": "wedges.msh", "Subdivide": "true"}), crest("fine", "fine.msh"), .2)
    corners = hexes[5][1]
    write("tetra.msh", Path("wedges.msh").read_text().replace(f" 5 2 {hexes[5][0]} {hexes[5][0]} " + " ".join(str(n + 1) for n in corners),
                                                              f" 4 2 {hexes[5][0]} {hexes[5][0]} " + " ".join(str(n + 1) for n in corners[:4])))
    refused([scene("tetra", "tetra.msh"), "--validate"], "Tetrahedron", "lock", "Recombine")


def write_mixed(out, nodes, hexes, quads):
    """MSH 2.2 with triangles where quadrilaterals have a double corner; collapsed hexahedra stay."""
    names = [(3, 1, "monolith 1"), (3, 2, "monolith 2"), *((2, t, meshes.NAMES[t]) for t in (1, 2, 3, 4))]
    print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), sep="\n", file=out)
    for dimension, tag, name in names:
        print(dimension, tag, f'"{name}"', file=out)
    print("$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=out)
    for i, x in enumerate(nodes):
        print(i + 1, *x, file=out)
    print("$EndNodes\n$Elements", len(hexes) + len(quads), sep="\n", file=out)
    for i, (tag, corners) in enumerate(hexes + quads):
        around = corners if i < len(hexes) else list(dict.fromkeys(corners))
        print(i + 1, {(True, 8): 5, (True, 20): 17, (False, 4): 3, (False, 3): 2, (False, 8): 16}[i < len(hexes), len(around)], 2, tag, tag, *(n + 1 for n in around), file=out)
    print("$EndElements", file=out)


def second_order():
    """Hexahedra of 20 nodes and faces of 8 are read by their corners."""
    meshes.arch("arch.msh", *CELLS)
    nodes, hexes, quads = meshes.arch_block(*CELLS)
    edges = {8: ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)),
             4: ((0, 1), (1, 2), (2, 3), (3, 0))}
    middles = {}

    def with_middles(corners):
        result = list(corners)
        for a, b in edges[len(corners)]:
            ends = frozenset((corners[a], corners[b]))
            if ends not in middles:
                middles[ends] = len(nodes)
                nodes.append(tuple((x + y) / 2 for x, y in zip(nodes[corners[a]], nodes[corners[b]])))
            result.append(middles[ends])
        return result

    with open("quadratic.msh", "w") as out:
        write_mixed(out, nodes, [(m, with_middles(c)) for m, c in hexes], [(t, with_middles(c)) for t, c in quads])
    alike(crest("quadratic", "quadratic.msh"), crest("gmsh", "arch.msh"))


def joints():
    """A joint that ends above the base, so that a monolith hangs in it, and one across which the nodes of both sides do not coincide."""
    n_through, n_up = CELLS[1:]
    nodes, hexes, quads = meshes.arch_block((1, 2, 3), n_through, n_up)
    first = min(i for i, (m, _) in enumerate(hexes) if m == 2)
    half = [(1 if m == 2 and (i - first) % n_up == 0 else m, c) for i, (m, c) in enumerate(hexes)]
    meshes.write("half.msh", nodes, half, quads)
    warned = voussoir(scene("half", "half.msh", Joints={"Model": "FJA"}), "--validate").stdout
    expect(any("warning" in line and "monolith 2" in line for line in warned.splitlines()), warned)  # only the joint holds it
    runs(scene("half", "half.msh", Joints={"Model": "tied"}, Statics={"Self-weight": "monolithic"}), "--validate")

    nodes, hexes, quads = meshes.arch_block(*CELLS)
    of_second = sorted({c for m, corners in hexes if m == 2 for c in corners})
    renumbered = {c: len(nodes) + k for k, c in enumerate(of_second)}
    apart = nodes + [(x, y + .2, z) for x, y, z in (nodes[c] for c in of_second)]
    of_face = lambda corners: all(c in renumbered for c in corners)
    new = lambda corners: [renumbered[c] for c in corners]
    meshes.write("apart.msh", apart, [(m, new(c) if m == 2 else c) for m, c in hexes],
                 [(t, new(c) if of_face(c) else c) for t, c in quads])
    refused([scene("apart", "apart.msh", Joints={"Model": "FJA"})], "apart.msh", "monoliths 1 and 2", "coincide")


if __name__ == "__main__":
    run_cases(inp, med, wedges, second_order, joints)
