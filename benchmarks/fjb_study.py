#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper finds that on a rigid base with five joints FJB opens less than FJA. Which assumption could make it so?

    benchmarks/fjb_study.py [--voussoir PROGRAM] [--motions 3] [--output output/fjb_study] [--only WORD]

Five seconds of strong shaking of prm/coarse.prm with 36 x 12 x 2 elements, one assumption changed at a time, FJA and
FJB with several motions each. Prints a Markdown table; what has been run is kept in OUTPUT/results.json and not run
again. Openings are the largest over time at the crest, of both faces, of each joint.

Penalty contact is emulated by layers of 0.5 m of soft concrete at both sides of every joint: f times E/h, h = 17 m the
width of an element, is their stiffness per area; f = 1 is the usual first choice of programs with penalty contact.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

from program import ROOT, add_program_argument, run as program_output, simulate
from paper import scatter
from voussoir.tables import read_table

SCENE = ROOT / "prm" / "coarse.prm"
STRONG = {"Motion/Duration": 5.12, "Motion/Rise end": 0.5, "Motion/Decay begin": 4.5, "Output/Envelope interval": 0}
MESH = "Mesh/Arch210/"
SIZE = {MESH + "Elements along": 36, MESH + "Elements up": 12}
LAYER, WIDTH, YOUNG = 0.5, 17., 21e9  # of the soft layers, of an element [m]; [Pa]


class Mesh:
    """The quick start's dam with nodes that can be moved. Gmsh MSH 2.2."""

    def __init__(self, program, settings):
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory) / "dam.msh"
            program_output(program, "mesh", SCENE, "--output", file, "--format", "2.2", settings={**SIZE, **settings})
            lines = file.read_text().splitlines()
        names, nodes, elements = (lines.index(f"${word}") for word in ("PhysicalNames", "Nodes", "Elements"))
        self.names = lines[names + 2:names + 2 + int(lines[names + 1])]
        rows = [line.split() for line in lines[nodes + 2:nodes + 2 + int(lines[nodes + 1])]]
        self.index = {row[0]: i for i, row in enumerate(rows)}
        self.nodes = np.array([row[1:] for row in rows], dtype=float)
        self.elements = [line.split() for line in lines[elements + 2:elements + 2 + int(lines[elements + 1])]]
        self.cells = [e for e in self.elements if e[1] == "5"]

    def chains(self, edges, within_monoliths=False):
        """Rows of nodes along edges of the cells: (row, node). `edges`: pairs of corners of a cell, one row each."""
        after = {}
        for cell in self.cells:
            corners = [self.index[tag] for tag in cell[3 + int(cell[2]):]]
            for a, b in edges:
                after[(cell[3] if within_monoliths else "", corners[a])] = corners[b]
        ends = {(m, b) for (m, _), b in after.items()}
        rows = []
        for m, a in sorted(key for key in after if key not in ends):
            row = [a]
            while (m, row[-1]) in after:
                row.append(after[m, row[-1]])
            rows.append(row)
        return rows

    def thicken(self, extra):
        """By `extra` at the crest, nothing below the middle of the height [m]."""
        for row in self.chains([(0, 1), (3, 2), (4, 5), (7, 6)]):
            first, last = self.nodes[row[0]].copy(), self.nodes[row[-1]].copy()
            z = (first[2] + last[2]) / 2
            factor = 1 + extra * max(0., 2 * z / 210 - 1) / np.linalg.norm(last - first)
            for i in row:
                self.nodes[i, :2] = ((first + last) / 2 + factor * (self.nodes[i] - (first + last) / 2))[:2]

    def thin_layers(self):
        """The first and last cells of each monolith become LAYER wide and the zone "soft"."""
        moved, ends = self.nodes.copy(), set()
        for row in self.chains([(0, 3), (1, 2), (4, 7), (5, 6)], within_monoliths=True):
            points = self.nodes[row]
            along = np.append(0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
            layer = min(LAYER, along[-1] / len(row))
            where = np.append(np.append(0, np.linspace(layer, along[-1] - layer, len(row) - 2)), along[-1])
            moved[row] = np.stack([np.interp(where, along, points[:, c]) for c in range(3)], axis=1)
            ends |= {row[0], row[-1]}
        self.nodes = moved
        monoliths = sorted({int(cell[3]) for cell in self.cells})
        self.names += [f'3 {500 + m} "monolith {m} soft"' for m in monoliths]
        for cell in self.cells:
            if any(self.index[tag] in ends for tag in cell[3 + int(cell[2]):]):
                cell[3] = str(500 + int(cell[3]))
                cell[4] = str(500 + int(cell[4]))

    def write(self, file):
        tags = list(self.index)
        file.write_text("\n".join(
            ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.names)), *self.names,
             "$EndPhysicalNames", "$Nodes", str(len(tags))] +
            [f"{tag} " + " ".join(f"{x:.12g}" for x in place) for tag, place in zip(tags, self.nodes)] +
            ["$EndNodes", "$Elements", str(len(self.elements)), *(" ".join(e) for e in self.elements), "$EndElements"])
            + "\n")


def thicker_crest(extra):
    def make(program, file):
        mesh = Mesh(program, {})
        mesh.thicken(extra)
        mesh.write(file)
    return make


def soft_layers(program, file):
    mesh = Mesh(program, {MESH + "Elements along": 48})
    mesh.thin_layers()
    mesh.write(file)


def penalty(factor):
    young = 2 * LAYER * factor * YOUNG / WIDTH if factor else YOUNG
    return {"Concrete/Zones": f"soft: {young:.6g} {0. if factor else .17} 2400"}


def friction(mu):
    return {"FJA": {"Joints/Friction": mu}}


def rough(mu=0.8):
    """No slip while closed, free when open, instead of FJB."""
    return {"FJB": {"Joints/Model": "FJA", "Joints/Friction": 10}, "FJA": {"Joints/Friction": mu}}


def one(entry, value):
    return {"both": {entry: value}}


def with_both(changes, entry, value):
    return {**changes, "both": {entry: value}}


# name -> settings of both laws and of each, and what makes the mesh, if it is a file
VARIANTS = {
    "as it is": ({}, None),
    "friction 0.2 (FJA)": (friction(0.2), None),
    "friction 0 (FJA)": (friction(0.), None),
    "friction 0.5 (FJA)": (friction(0.5), None),
    "friction 1.2 (FJA)": (friction(1.2), None),
    "'rough' contact for FJB: no slip while closed, free when open": (rough(), None),
    "'rough' contact for FJB, FJA with friction 0.2": (rough(0.2), None),
    "penalty contact's mesh, concrete as it is": ({"both": penalty(None)}, soft_layers),
    "penalty contact, f = 1": ({"both": penalty(1.)}, soft_layers),
    "penalty contact, f = 0.1": ({"both": penalty(.1)}, soft_layers),
    "penalty contact, f = 0.01": ({"both": penalty(.01)}, soft_layers),
    "time step 2.5 ms": (one("Dynamics/Steps per sample", 4), None),
    "plain Newmark (impact rule `none`)": (one("Dynamics/Impact", "none"), None),
    "impact rule `paper`": (one("Dynamics/Impact", "paper"), None),
    "crest 5 m thick": ({}, thicker_crest(-5.)),
    "crest 15 m thick": ({}, thicker_crest(5.)),
    "60 x 16 x 2 elements": ({"both": {MESH + "Elements along": 60, MESH + "Elements up": 16}}, None),
    "1 element through": (one(MESH + "Elements through", 1), None),
    "4 elements through": (one(MESH + "Elements through", 4), None),
    "18 x 8 x 1 elements": ({"both": {MESH + "Elements along": 18, MESH + "Elements up": 8, MESH + "Elements through": 1}}, None),
    "plain trilinear elements": (one("Elements/Incompatible modes", "false"), None),
    "no added mass": (one("Reservoir/Model", "none"), None),
    "half of the added mass": (one("Reservoir/Factor", 0.5), None),
    "damping 2 %": (one("Damping/Ratio", 0.02), None),
    "damping 10 %": (one("Damping/Ratio", 0.1), None),
    "half of the added mass, damping 10 %": ({"both": {"Reservoir/Factor": 0.5, "Damping/Ratio": 0.1}}, None),
    "weight on the finished dam": (one("Statics/Self-weight", "monolithic"), None),
    "no weight": (one("Statics/Self-weight", "none"), None),
    "no static loads": (one("Statics/Gravity", 1e-6), None),
    "no static loads, friction 0.2 (FJA)": (with_both(friction(0.2), "Statics/Gravity", 1e-6), None),
    "no static loads, friction 1.2 (FJA)": (with_both(friction(1.2), "Statics/Gravity", 1e-6), None),
    "no static loads, 'rough' contact for FJB": (with_both(rough(), "Statics/Gravity", 1e-6), None),
    "no static loads, time step 2.5 ms": ({"both": {"Statics/Gravity": 1e-6, "Dynamics/Steps per sample": 4}}, None),
    "no static loads, damping 10 %": ({"both": {"Statics/Gravity": 1e-6, "Damping/Ratio": 0.1}}, None),
    "no static loads, half of the added mass": ({"both": {"Statics/Gravity": 1e-6, "Reservoir/Factor": 0.5}}, None),
    "no static loads, shaking up- and downstream only": (
        {"both": {"Statics/Gravity": 1e-6, "Motion/Scale y": 0, "Motion/Scale z": 0}}, None),
    "no static loads, 17 joints": (
        {"both": {"Statics/Gravity": 1e-6, MESH + "Joints": 17, MESH + "Elements along": 36}}, None),
    "empty reservoir": (one("Reservoir/Water level", 1.), None),
    "half of the shaking": (one("Motion/Factor", 0.5), None),
    "a quarter of the shaking": (one("Motion/Factor", 0.25), None),
    "shaking up- and downstream only": ({"both": {"Motion/Scale y": 0, "Motion/Scale z": 0}}, None),
    "no vertical shaking": (one("Motion/Scale z", 0), None),
    "massless rock": ({"both": {"Foundation/Model": "massless", MESH + "Rock/Enabled": "true", MESH + "Rock/Element size": 30}}, None),
    "3 joints": (one(MESH + "Joints", 3), None),
    "9 joints": (one(MESH + "Joints", 9), None),
    "17 joints": ({"both": {MESH + "Joints": 17, MESH + "Elements along": 36}}, None),
    "28 joints": ({"both": {MESH + "Joints": 28, MESH + "Elements along": 58}}, None),
}


def openings(program, settings):
    """Of each joint [mm]"""
    with tempfile.TemporaryDirectory() as directory:
        simulate(program, SCENE, settings, directory)
        joints = read_table(Path(directory) / "joints.csv")
    return [1e3 * max(pair) for pair in zip(joints["opening_upstream"], joints["opening_downstream"])]


def settle(program, name, seed, law, output):
    """The run's settings, with its mesh made."""
    changes, make_mesh = VARIANTS[name]
    settings = {**STRONG, **SIZE, "Motion/Seed": seed, "Joints/Model": law, **changes.get("both", {}), **changes.get(law, {})}
    if make_mesh:
        file = (output / f"{list(VARIANTS).index(name)}.msh").resolve()
        if not file.exists():
            make_mesh(program, file)
        settings.update({"Mesh/Source": "file", "Mesh/File": str(file)})
        settings = {key: value for key, value in settings.items() if not key.startswith(MESH)}
    return {key: str(value) for key, value in settings.items()}


def row(name, results):
    seeds = sorted({seed for seed, law in results if (seed, "FJA") in results and (seed, "FJB") in results})
    if not seeds:
        return None
    fja, fjb = (np.array([results[seed, law] for seed in seeds]) for law in ("FJA", "FJB"))
    ratio = fjb.mean(axis=1) / fja.mean(axis=1)
    return (f"| {name} | {len(seeds)} | {fja.mean():.1f} | {fjb.mean():.1f} | {scatter(ratio, 2)} | {(ratio < 1).sum()} | "
            f"{fja.max(axis=1).mean():.1f}, {fjb.max(axis=1).mean():.1f} | {(fjb < fja).sum()} of {fja.size} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--motions", type=int, default=3)
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "fjb_study")
    parser.add_argument("--only", default="", help="variants with this word in their names")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    kept = options.output / "results.json"
    table = json.loads(kept.read_text()) if kept.exists() else {}
    print("| variant | motions | mean opening, FJA [mm] | FJB | FJB/FJA, mean and scatter over the motions | motions with "
          "FJB < FJA | widest joint, FJA, FJB [mm] | joints with FJB < FJA |\n" + "|---" * 8 + "|")
    status = 0
    for name in VARIANTS:
        results = {}
        for seed in range(1, options.motions + 1):
            for law in ("FJA", "FJB"):
                settings = settle(options.voussoir, name, seed, law, options.output)
                key = json.dumps(settings, sort_keys=True)
                if key not in table and options.only in name:
                    try:
                        table[key] = openings(options.voussoir, settings)
                    except SystemExit as failure:
                        print(f"{name}, {law}, motion {seed}: {str(failure).strip().splitlines()[-1]}", file=sys.stderr)
                        table[key] = None
                        status = 1
                    kept.write_text(json.dumps(table, indent=0))
                if table.get(key):
                    results[seed, law] = table[key]
        line = row(name, results)
        if line and options.only in name:
            print(line, flush=True)
    return status


if __name__ == "__main__":
    sys.exit(main())
