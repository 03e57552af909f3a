# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir arcs`: meshes the dam of a table of arcs, prints its measures and writes a commented input file."""

import math
import os

from .command import Parser
from .errors import InputError
from .scene_text import SceneText


def choose_mesh(scene):
    """Returns entries of the mesh and its measures: joints at distances of about 18 m, elements of about a tenth of the height.

    Reduces the smallest height if the end monoliths are low."""
    fine = scene.mesh_facts(Joints=0, Elements_along=200, Elements_up=2, Elements_through=1)
    length, height = fine["crest"], fine["top"] - fine["bottom"]
    joints = max(0, min(9999, math.floor(length / 18. + .5) - 1))
    along = (joints + 1) * max(2, math.ceil(length / (joints + 1) / (height / 10) - 1e-6))
    grid = {"Joints": joints, "Elements_along": along}
    smallest = float(scene.default("Mesh/Arcs/Smallest height"))
    while True:
        try:
            return grid, scene.mesh_facts(**grid)
        except InputError:
            if smallest <= 0.5:
                raise
        smallest = grid["Smallest_height"] = smallest / 2


def main(words=None):
    """The command."""
    parser = Parser(prog="voussoir arcs", description=__doc__)
    parser.add_argument("--output")
    parser.add_argument("--kind")
    parser.add_argument("table", nargs="*")
    options = parser.parse_args(words)
    if len(options.table) != 1:
        raise InputError("`voussoir arcs` needs one table of arcs. `voussoir arcs --help` shows the usage.")
    table = options.table[0]
    scene = SceneText(options.output or os.path.splitext(table)[0] + ".prm")
    kinds = scene.choices("Mesh/Arcs/Kind").removeprefix(", one of: ").split(", ")
    kind = options.kind or scene.default("Mesh/Arcs/Kind")
    if kind not in kinds:
        raise InputError(f'--kind must be {"|".join(kinds)}, not "{kind}".')
    scene.set("Mesh/Source", "arcs")
    scene.set("Mesh/Arcs/Kind", kind)
    scene.set("Mesh/Arcs/Table", os.path.relpath(os.path.realpath(table), os.path.realpath(scene.directory or ".")))
    grid, dam = choose_mesh(scene)
    for name, value in grid.items():
        scene.values[f"Mesh/Arcs/{name.replace('_', ' ')}"] = f"{value:.9g}"
    scene.add("Mesh/Arcs/Elements up", "Mesh/Arcs/Elements through")
    height = dam["top"] - dam["bottom"]
    scene.set("Reservoir/Water level", f"{math.floor(dam['top'] - 0.05 * height):.9g}")
    scene.set("Motion/Source", "artificial")
    scene.add("Joints/Model", "Foundation/Model", "Motion/Peak acceleration", "Motion/Duration")
    scene.add_materials()
    scene.write(f"# A dam from a table of arcs: {round(height, 1):.9g} m high, crest {round(dam['crest'], 1):.9g} m, "
                f"{round(dam['volume']):.9g} m^3.\n# Check every entry. All others have the defaults of `voussoir parameters`.\n")
    print(f"{scene.file}: height {height:.1f} m, crest {dam['crest']:.1f} m, volume {dam['volume']:.0f} m3; {grid['Joints']} joints, "
          f"{grid['Elements_along']} x {scene.values['Mesh/Arcs/Elements up']} x {scene.values['Mesh/Arcs/Elements through']} elements, "
          f"smallest scaled Jacobian {dam['jacobian']}")
    print(f"Next: voussoir view {scene.file}, voussoir {scene.file} --validate")
    return 0
