#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX's golden numbers: writes calculix.json beside this script. Voussoir has no part in it.

    make_calculix.py                    needs ccx (Debian package calculix-ccx) and numpy

The mesh is meshes.arch() with the cells of scenes.CALCULIX; elements C3D8 (plain trilinear) and C3D8I (with modes). Static
displacements and stresses under water and weight together, frequencies, and a damped history of the crest from rest
without water. The mass is lumped: a weightless solid with a point mass at each node (benchmarks/calculix.py writes the
decks). Point masses have no mass-proportional damping, so the history's damping is proportional to stiffness."""

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


def read_frd(file):
    """Displacements and stresses (xx yy zz xy yz zx) of the nodes, by number."""
    fields, current = {}, None
    for line in Path(file).read_text().splitlines():
        if line.startswith(" -4"):
            current = fields.setdefault(line.split()[1], {})
        elif line.startswith(" -3"):
            current = None
        elif line.startswith(" -1") and current is not None:
            current[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range((len(line) - 13) // 12)]
    return fields["DISP"], fields["STRESS"]


def compute(element, directory):
    c = scenes.CALCULIX
    meshes.arch(directory / "arch.msh", *c["cells"])
    mesh = calculix.read_mesh(directory / "arch.msh")
    probe = calculix.crown_crest(mesh, "upstream", 0)
    options = argparse.Namespace(element=element, young=21e9, poisson=.17, density=2400., gravity=9.81, mass="lumped",
                                 damping=[0., c["ratio"] / np.pi / c["frequency"]], ccx="ccx", modes=6, dt=c["dt"],
                                 steps=c["steps"])
    job = calculix.CalculiX(mesh, probe, options, directory)
    forces = calculix.water_forces(mesh, c["level"], 1000., 9.81, 8)
    forces[:, 2] -= 9.81 * calculix.lumped_masses(mesh, 2400.)
    loads = [f"{i + 1}, {k + 1}, {forces[i, k]:.15g}" for i, k in zip(*np.nonzero(forces))]
    job.run("static", ["*STEP", "*STATIC", "*CLOAD", *loads, "*NODE FILE", "U", "*EL FILE", "S",
                       "*NODE PRINT, NSET=CREST", "U", "*END STEP"])
    u, s = read_frd(directory / "static.frd")
    nodes = [[*mesh.nodes[i - 1], *u[i], *s[i]] for i in sorted(s)][::c["every_node"]]
    motion = np.array([[k * c["dt"], *(scenes.G * a for a in scenes.shape(k * c["dt"]))] for k in range(c["steps"] + 1)])
    history = job.history(motion)
    return {"nodes": nodes, "frequencies": job.frequencies(), "crest": list(mesh.nodes[probe]),
            "history": history[::c["every"]].tolist()}


def main():
    table = {}
    for element in ("C3D8", "C3D8I"):
        with tempfile.TemporaryDirectory() as temporary:
            table[element] = compute(element, Path(temporary))
    (HERE / "calculix.json").write_text(json.dumps(table).replace("], [", "],\n["))


if __name__ == "__main__":
    main()
