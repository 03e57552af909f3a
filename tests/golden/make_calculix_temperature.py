#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX's golden numbers of a dam under temperatures: writes calculix_temperature.json. Voussoir has no part in it.

    make_calculix_temperature.py        needs ccx (Debian package calculix-ccx) and numpy

Static displacements and stresses of meshes.arch() with the cells of scenes.CALCULIX, warmed alike everywhere with 8-node
elements (whose temperature CalculiX takes as constant), and linearly through the thickness with 20-node elements: node j of
the n through the thickness at j/n between the faces of scenes.TEMPERATURES, between nodes linear."""

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


class Heated(calculix.CalculiX):
    def model(self):
        lines, t = super().model(), scenes.TEMPERATURES
        at = lines.index("*DENSITY")
        lines[at:at] = [f"*EXPANSION, ZERO={t['grouting']}", f"{t['expansion']:.12g}"]
        return lines + ["*INITIAL CONDITIONS, TYPE=TEMPERATURE", f"ALL, {t['grouting']}"]


def node_temperatures(mesh, faces):
    """Of the corners of the cells, the mean of its ends in the middle of an edge."""
    monoliths, n_through, n_up = scenes.CALCULIX["cells"]
    nodes, _, _ = meshes.arch_block(monoliths, n_through, n_up)
    place = {tuple(np.round(x, 4)): k // (n_up + 1) % (n_through + 1) / n_through for k, x in enumerate(nodes)}
    result = np.full(len(mesh.nodes), np.nan)
    for cell in mesh.hexahedra:
        for node in cell[:8]:
            result[node] = faces[0] + place[tuple(np.round(mesh.nodes[node], 4))] * (faces[1] - faces[0])
        for node, (a, b) in zip(cell[8:], calculix.HEX_EDGES):
            result[node] = (result[cell[a]] + result[cell[b]]) / 2
    return result


def compute(element, faces, directory):
    meshes.arch(directory / "arch.msh", *scenes.CALCULIX["cells"])
    mesh = calculix.read_mesh(directory / "arch.msh")
    n_corners = len(mesh.nodes)
    probe = calculix.crown_crest(mesh, "upstream", 0)
    if element == "C3D20":
        mesh = calculix.add_midside_nodes(mesh)
    options = argparse.Namespace(element=element, young=21e9, poisson=.17, density=2400., mass="consistent",
                                 damping=[0., 0.], ccx="ccx")
    job = Heated(mesh, probe, options, directory)
    temperatures = [f"{i + 1}, {t:.15g}" for i, t in enumerate(node_temperatures(mesh, faces))]
    job.run("static", ["*STEP", "*STATIC", "*TEMPERATURE", *temperatures, "*NODE FILE", "U", "*EL FILE", "S",
                       "*NODE PRINT, NSET=CREST", "U", "*END STEP"])
    u, s = read_frd(directory / "static.frd")
    return [[*mesh.nodes[i - 1], *u[i], *s[i]] for i in sorted(s) if i <= n_corners][::scenes.CALCULIX["every_node"]]


def main():
    table, t = {}, scenes.TEMPERATURES
    for element, faces in (("C3D8", "uniform"), ("C3D8I", "uniform"), ("C3D20", "linear")):
        with tempfile.TemporaryDirectory() as temporary:
            table[element] = compute(element, t[faces], Path(temporary))
    (HERE / "calculix_temperature.json").write_text(json.dumps(table).replace("], [", "],\n["))


if __name__ == "__main__":
    main()
