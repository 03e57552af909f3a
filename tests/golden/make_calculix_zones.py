#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX's golden numbers of a dam of three concretes: writes calculix_zones.json. Voussoir has no part in it.

    make_calculix_zones.py              needs ccx (Debian package calculix-ccx) and numpy

As make_calculix.py, on meshes.zoned_arch() with the materials scenes.CONCRETES: static displacements and stresses under water
and weight together, and frequencies. CalculiX averages stresses at a node over all its cells: those of nodes between two
concretes are left out."""

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
from make_calculix import read_frd  # noqa: E402


class Zoned(calculix.CalculiX):
    """Cells of several materials: options.zone has the number of each cell's."""

    def masses(self):
        density = np.array([[scenes.CONCRETES[z][2]] for z in self.options.zone])
        return calculix.lumped_masses(self.mesh, density)

    def model(self):
        lines = super().model()
        begin, end = lines.index("*MATERIAL, NAME=CONCRETE"), lines.index("*SOLID SECTION, ELSET=DAM, MATERIAL=CONCRETE")
        materials = []
        for z, (young, poisson, density) in enumerate(scenes.CONCRETES):
            materials += [f"*ELSET, ELSET=ZONE{z}"] + [str(c + 1) for c, zone in enumerate(self.options.zone) if zone == z]
            materials += [f"*MATERIAL, NAME=CONCRETE{z}", "*ELASTIC", f"{young:.12g}, {poisson:.12g}", "*DENSITY",
                          f"{1e-9 * density:.12g}", f"*SOLID SECTION, ELSET=ZONE{z}, MATERIAL=CONCRETE{z}"]
        lines[begin:end + 1] = materials
        first = len(self.mesh.hexahedra) + 1
        for i, mass in enumerate(self.masses()):
            lines += [f"*ELEMENT, TYPE=MASS, ELSET=MASS{i + 1}", f"{first + i}, {i + 1}", f"*MASS, ELSET=MASS{i + 1}",
                      f"{mass:.12g}"]
        return lines


def compute(element, directory):
    c = scenes.CALCULIX
    zone = meshes.zoned_arch(directory / "arch.msh", *c["cells"])
    mesh = calculix.read_mesh(directory / "arch.msh")
    options = argparse.Namespace(element=element, zone=zone, young=0, poisson=0, density=0, mass="zoned", damping=[0., 0.],
                                 ccx="ccx", modes=6)
    job = Zoned(mesh, calculix.crown_crest(mesh, "upstream", 0), options, directory)
    forces = calculix.water_forces(mesh, c["level"], 1000., 9.81, 8)
    forces[:, 2] -= 9.81 * job.masses()
    loads = [f"{i + 1}, {k + 1}, {forces[i, k]:.15g}" for i, k in zip(*np.nonzero(forces))]
    job.run("static", ["*STEP", "*STATIC", "*CLOAD", *loads, "*NODE FILE", "U", "*EL FILE", "S",
                       "*NODE PRINT, NSET=CREST", "U", "*END STEP"])
    u, s = read_frd(directory / "static.frd")
    zones_of_node = {}
    for z, cell in zip(zone, mesh.hexahedra):
        for node in cell:
            zones_of_node.setdefault(node + 1, set()).add(z)
    nodes = [[*mesh.nodes[i - 1], *u[i], *(s[i] if len(zones_of_node[i]) == 1 else [])] for i in sorted(s)][::c["every_node"]]
    return {"nodes": nodes, "frequencies": job.frequencies()}


def main():
    table = {}
    for element in ("C3D8", "C3D8I"):
        with tempfile.TemporaryDirectory() as temporary:
            table[element] = compute(element, Path(temporary))
    (HERE / "calculix_zones.json").write_text(json.dumps(table).replace("], [", "],\n["))


if __name__ == "__main__":
    main()
