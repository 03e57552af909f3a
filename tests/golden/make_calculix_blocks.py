#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX's golden numbers of forces on bases: writes calculix_blocks.json. Voussoir has no part in it.

    make_calculix_blocks.py             needs ccx (Debian package calculix-ccx) and numpy

meshes.arch() with the cells of scenes.BLOCKS, under water and weight. The monoliths have nodes of their own, equations tie
these above the base, so that the reactions at the foot of a joint are told apart. Of each monolith: force on its base and
moment about the origin, from CalculiX's nodal forces there less the loads that act on the same nodes."""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "benchmarks"))
import calculix  # noqa: E402
import meshes  # noqa: E402
import scenes  # noqa: E402

YOUNG, POISSON, DENSITY, GRAVITY = 21e9, .17, 2400., 9.81


class Tied(calculix.CalculiX):
    """With equations between nodes at the same place, the held ones excepted."""

    def model(self):
        lines, first, held = super().model(), {}, set(self.mesh.surface_nodes("base"))
        for i, x in enumerate(self.mesh.nodes):
            j = first.setdefault(tuple(np.round(x, 6)), i)
            if i != j and i not in held:
                for c in (1, 2, 3):
                    lines += ["*EQUATION", "2", f"{i + 1}, {c}, 1, {j + 1}, {c}, -1"]
        return lines


def apart(mesh, monoliths):
    """The mesh with nodes of its own for each monolith, and the monolith of each node."""
    number, nodes, owner = {}, [], []

    def own(node, monolith):
        if (node, monolith) not in number:
            number[node, monolith] = len(nodes)
            nodes.append(mesh.nodes[node])
            owner.append(monolith)
        return number[node, monolith]
    cells = np.array([[own(n, m) for n in cell] for cell, m in zip(mesh.hexahedra, monoliths)])
    owners = [(set(cell), m) for cell, m in zip(mesh.hexahedra, monoliths)]
    surfaces = {name: np.array([[own(n, next(m for cell, m in owners if cell.issuperset(quad))) for n in quad] for quad in quads])
                for name, quads in mesh.surfaces.items()}
    return calculix.Mesh(np.array(nodes), cells, surfaces), np.array(owner)


def compute(element, directory):
    level, cells = scenes.BLOCKS["level"], scenes.BLOCKS["cells"]
    meshes.arch(directory / "arch.msh", *cells)
    mesh = calculix.read_mesh(directory / "arch.msh")
    monoliths = [tag for tag, _ in meshes.arch_block(*cells)[1]]
    mesh, owner = apart(mesh, monoliths)
    options = argparse.Namespace(element=element, young=YOUNG, poisson=POISSON, density=DENSITY, mass="consistent",
                                 damping=[0., 0.], ccx="ccx")
    job = Tied(mesh, calculix.crown_crest(mesh, "upstream", 0), options, directory)
    forces = calculix.water_forces(mesh, level, 1000., GRAVITY, 8)
    forces[:, 2] -= GRAVITY * calculix.lumped_masses(mesh, DENSITY)
    loads = [f"{i + 1}, {k + 1}, {forces[i, k]:.15g}" for i, k in zip(*np.nonzero(forces))]
    dat = job.run("static", ["*STEP", "*STATIC", "*CLOAD", *loads, "*NODE PRINT, NSET=BASE", "RF", "*END STEP"])
    start = next(i for i, line in enumerate(dat) if line.strip().startswith("forces (fx,fy,fz)"))
    table, whole = {}, np.zeros(3)
    for line in dat[start + 1:]:
        words = line.split()
        if len(words) == 4:
            node = int(words[0]) - 1
            reaction = np.array([float(x) for x in words[1:]]) - forces[node]
            whole += reaction
            row = table.setdefault(int(owner[node]), np.zeros(6))
            row += np.append(reaction, np.cross(mesh.nodes[node], reaction))
    error = np.abs(whole + forces.sum(axis=0)).max() / np.abs(forces.sum(axis=0)).max()
    print(f"{element}: the reactions balance the loads to {error:.1e}")
    assert error < 1e-6
    return {number: list(row) for number, row in sorted(table.items())}


def main():
    table = {}
    for element in ("C3D8", "C3D8I"):
        with tempfile.TemporaryDirectory() as temporary:
            table[element] = compute(element, Path(temporary))
    (HERE / "calculix_blocks.json").write_text(json.dumps(table, indent=1) + "\n")


if __name__ == "__main__":
    main()
