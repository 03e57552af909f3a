# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of what a scene would run, before anything is run.

    voussoir view SCENE.prm [--output DIR] [--set 'Section/Entry=value']...

DIR/view.png      the dam from downstream and from upstream with the water, its plan, the section at the crown, and the rock
DIR/mesh.vtu      the cells, with monolith (rock: 1000 and above), for ParaView
DIR/surfaces.vtu  the faces in groups, with the number of the group (doc/mesh.md), for ParaView
DIR/mesh.msh      the mesh as the program has it, for gmsh
"""

import json
from pathlib import Path

import numpy as np
from matplotlib.collections import PolyCollection

from .command import Parser
from .errors import InputError, VoussoirError
from .program import call, entries_of, set_options
from .drawing import plt
from .picture import CONCRETE, FACES, draw_mesh, view_of
from .vtu import write_vtu

FIRST_ROCK, BASE, UPSTREAM, DOWNSTREAM, CREST, FREE, ARTIFICIAL = 1000, 1, 2, 3, 4, 5, 6
WATER, ROCK, EARTH = (.62, .76, .86), (.70, .66, .58), (.80, .84, .70)
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


class Mesh:
    """A mesh in gmsh's format 2.2: points, cells with their volumes, faces with their surfaces, and names."""

    def __init__(self, path):
        lines = Path(path).read_text().splitlines()
        self.names = {}
        if "$PhysicalNames" in lines:
            start = lines.index("$PhysicalNames") + 1
            for line in lines[start + 1:start + 1 + int(lines[start])]:
                dimension, number, name = line.split(" ", 2)
                self.names[int(dimension), int(number)] = name.strip('"')
        start = lines.index("$Nodes") + 1
        rows = [line.split() for line in lines[start + 1:start + 1 + int(lines[start])]]
        index = {int(row[0]): i for i, row in enumerate(rows)}
        self.points = np.array([[float(x) for x in row[1:4]] for row in rows])
        start = lines.index("$Elements") + 1
        cells, quads = [], []
        for line in lines[start + 1:start + 1 + int(lines[start])]:
            words = [int(word) for word in line.split()]
            nodes = [index[node] for node in words[3 + words[2]:]]
            (cells if words[1] == 5 else quads if words[1] == 3 else []).append((words[3], nodes))
        self.volume, self.cells = np.array([row[0] for row in cells]), np.array([row[1] for row in cells])
        self.surface, self.quads = np.array([row[0] for row in quads]), np.array([row[1] for row in quads])

    def on(self, surface):
        """The corners of the faces of a surface: (face, 4, 3)."""
        return self.points[self.quads[self.surface == surface]] if len(self.quads) else np.zeros((0, 4, 3))

    def tints(self, level):
        """Function for draw_mesh() of cells and their volumes. It returns the colours of the outer faces with the boundaries of the rock,
        and the upstream faces with the water."""
        kind = {tuple(sorted(quad)): number for number, quad in zip(self.surface, self.quads)}

        def of(cells, volume):
            faces = cells[:, FACES].reshape(-1, 4)

            def colours(which):
                result = np.array(CONCRETE)[volume[which // 6] % 2]
                result[volume[which // 6] >= FIRST_ROCK] = ROCK
                for k, face in enumerate(which):
                    if kind.get(tuple(sorted(faces[face]))) == FREE:
                        result[k] = EARTH
                return result

            def wet(which):
                return [k for k, face in enumerate(which) if kind.get(tuple(sorted(faces[face]))) == UPSTREAM], level, WATER
            return colours, wet
        return of


# ---------------------------------------------------------------- panels

def banks(axes, view, points):
    """Names at the two ends of the crest."""
    top = points[points[:, 2] > points[:, 2].max() - .02 * np.ptp(points[:, 2])]
    for name, end in (("right bank", top[:, 1].argmin()), ("left bank", top[:, 1].argmax())):
        place, _ = view(top[end] + [0., 0., .06 * np.ptp(points[:, 2])])
        axes.text(*place, name, ha="right" if place[0] < 0. else "left", va="bottom", fontsize=8, style="italic", color=".3")


def number_joints(axes, view, mesh):
    """The joints' numbers over the crest: joint j is between monoliths j and j + 1."""
    nodes = {v: set(mesh.cells[mesh.volume == v].ravel()) for v in np.unique(mesh.volume) if v < FIRST_ROCK}
    key = {v: {tuple(np.round(mesh.points[n], 3)) for n in found} for v, found in nodes.items()}
    joints = [(v, np.array(sorted(key[v] & key[v + 1]))) for v in key if v + 1 in key]
    every = -(-len(joints) // 15) or 1
    for number, shared in joints[::every]:
        if len(shared):
            place, _ = view(shared[shared[:, 2].argmax()] + [0., 0., .02 * np.ptp(mesh.points[:, 2])])
            axes.text(*place, str(number), ha="center", va="bottom", fontsize=7, color=".15")


def triad(axes, view, points):
    """The axes, at the lower left: x downstream, y to the left bank, z up."""
    places, _ = view(points)
    middle, size = points.mean(axis=0), .13 * max(np.ptp(points, axis=0))
    start = places.min(axis=0) + [.5 * size, -.2 * size]
    for name, d in (("x", 0), ("y", 1), ("z", 2)):
        along = view(middle + size * np.eye(3)[d])[0] - view(middle)[0]
        axes.annotate("", start + along, start, arrowprops={"arrowstyle": "-|>", "color": ".2", "lw": .9, "shrinkA": 0, "shrinkB": 0},
                      annotation_clip=False)
        axes.text(*(start + 1.22 * along), name, ha="center", va="center", fontsize=8, color=".2")


def space(axes, mesh, cells, azimuth, elevation, tints, title):
    own = mesh.cells[cells]
    points = mesh.points[np.unique(own)]
    view = view_of(points, azimuth, elevation)
    draw_mesh(axes, mesh.points, own, mesh.volume[cells], view, *tints(own, mesh.volume[cells]))
    dam = mesh.points[np.unique(mesh.cells[mesh.volume < FIRST_ROCK])]
    banks(axes, view, dam)
    triad(axes, view, points)
    axes.set_title(title, loc="left", fontsize=9, pad=14)
    return view


def plan(axes, mesh):
    """Base and crest from above; downstream is down the page, the right bank at the left."""
    for surface, colour, label in ((BASE, ROCK, "base"), (CREST, CONCRETE[0], "crest")):
        quads = mesh.on(surface)
        axes.add_collection(PolyCollection(quads[:, :, [1, 0]], facecolors=[colour], edgecolors=".35", linewidths=.3, label=label))
    axes.set(aspect="equal", xlabel="y [m], to the left bank", ylabel="x [m], downstream")
    axes.autoscale_view()
    axes.invert_yaxis()
    axes.legend(loc="lower center", fontsize=8)
    axes.set_title("Plan: crest and base", loc="left", fontsize=9)


def cut(mesh, y):
    """Intersections of the cells with a plane of constant y: polygons (x, z), and their volumes."""
    corners = mesh.points[mesh.cells]
    found, volumes = [], []
    for k in np.flatnonzero((corners[:, :, 1].min(axis=1) < y) & (corners[:, :, 1].max(axis=1) > y)):
        places = []
        for a, b in EDGES:
            p, q = corners[k, a], corners[k, b]
            if (p[1] - y) * (q[1] - y) < 0.:
                places.append((p + (y - p[1]) / (q[1] - p[1]) * (q - p))[[0, 2]])
        if len(places) > 2:
            places = np.array(places)
            around = places - places.mean(axis=0)
            found.append(places[np.argsort(np.arctan2(around[:, 1], around[:, 0]))])
            volumes.append(mesh.volume[k])
    return found, np.array(volumes)


def section(axes, mesh, level, wet):
    """The section through the middle of the crest, with the water."""
    crest = mesh.on(CREST)
    y = (crest[:, :, 1].min() + crest[:, :, 1].max()) / 2. + 1e-3 * np.ptp(crest[:, :, 1])
    polygons, volumes = cut(mesh, y)
    colours = [ROCK if volume >= FIRST_ROCK else CONCRETE[0] for volume in volumes]
    axes.add_collection(PolyCollection(polygons, facecolors=colours, edgecolors=".35", linewidths=.3))
    dam = np.concatenate([p for p, volume in zip(polygons, volumes) if volume < FIRST_ROCK])
    low, high, size = dam.min(axis=0), dam.max(axis=0), np.ptp(dam[:, 1])
    if wet:
        axes.plot([low[0] - .6 * size, low[0] - .02 * size], [level, level], color="#2b6a99", linewidth=1.1)
        axes.plot(low[0] - .4 * size, level + .02 * size, marker="v", color="#2b6a99", markersize=5)
        axes.text(low[0] - .05 * size, level - .025 * size, f"water {level:g} m", color="#2b6a99", fontsize=8, ha="right", va="top")
    axes.set(aspect="equal", xlabel="x [m], downstream", ylabel="z [m]", xlim=(low[0] - .65 * size, high[0] + .35 * size),
             ylim=(low[1] - .18 * size, high[1] + .12 * size))
    axes.set_title(f"Section at y = {y:.1f} m, {len(volumes[volumes < FIRST_ROCK])} cells".replace("-", "\N{MINUS SIGN}"), loc="left", fontsize=9)


def sheet(mesh, level, wet, title, path):
    """All panels on one page."""
    dam = mesh.volume < FIRST_ROCK
    has_rock = not dam.all()
    plt.rcParams["font.size"] = plt.rcParams["axes.labelsize"] = 9
    figure = plt.figure(figsize=(12, 12 if has_rock else 7))
    grid = figure.add_gridspec(3 if has_rock else 2, 2, height_ratios=[1, 1, 1.35][:3 if has_rock else 2], hspace=.22, wspace=.12)
    tints = mesh.tints(level if wet else -np.inf)
    view = space(axes := figure.add_subplot(grid[0, 0]), mesh, dam, -12., 34., tints, "From downstream; joints are numbered from the right bank")
    number_joints(axes, view, mesh)
    space(figure.add_subplot(grid[0, 1]), mesh, dam, 168., 28., tints, "From upstream" + ("; blue: under water" if wet else "; no water"))
    plan(figure.add_subplot(grid[1, 0]), mesh)
    section(figure.add_subplot(grid[1, 1]), mesh, level, wet)
    if has_rock:
        space(figure.add_subplot(grid[2, :]), mesh, dam | True, -35., 30., tints, "Dam and rock; green: the free surface")
    figure.suptitle(title, fontsize=11, y=.93 if has_rock else .96)
    figure.savefig(path, dpi=150)
    plt.close(figure)


def critical_step(scene, overrides):
    """The critical step of the explicit scheme for the dam with its place, in words. InputError if the scene cannot be run."""
    facts = json.loads(call(scene, "--validate", "--json", *set_options(overrides)))
    return f"critical step {1e3 * facts['critical_step']:.4g} ms at {facts['critical_place']}" if "critical_step" in facts else "no critical step: no motion"


def main():
    parser = Parser(prog="voussoir view", description=__doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE.prm")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--set", action="append", default=[], dest="overrides")
    options = parser.parse_args()
    if len(options.scenes) != 1:
        raise InputError("`voussoir view` needs one scene: voussoir view SCENE.prm")
    scene = Path(options.scenes[0])
    entries = entries_of(scene, options.overrides)
    output = options.output or Path("output") / f"{scene.stem}-view"
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The directory {output} cannot be made: {error.strerror}. Choose another one with --output.") from error
    print(call("mesh", scene, "--format", "2.2", "--output", output / "mesh.msh", *set_options(options.overrides)), end="")
    mesh = Mesh(output / "mesh.msh")
    level, density = float(entries["Reservoir/Water level"]), float(entries["Reservoir/Density"])
    for surface, name in ((UPSTREAM, "upstream"), (CREST, "crest")):
        if not len(mesh.on(surface)):
            raise InputError(f"The mesh of {scene} has no surface \"{name}\" (id {surface}), so it cannot be run: mark it (doc/mesh.md). "
                             f"{output / 'mesh.msh'} is the mesh as it is.")
    upstream = mesh.on(UPSTREAM)
    wet = density > 0. and len(upstream) > 0 and level > upstream[:, :, 2].min()
    try:
        critical, failure = critical_step(scene, options.overrides), None
    except VoussoirError as error:
        critical, failure = "no critical step: the scene cannot be run", error
    sheet(mesh, level, wet, f"{scene.stem}: {(mesh.volume < FIRST_ROCK).sum()} cells of the dam, {len(set(mesh.volume[mesh.volume < FIRST_ROCK]))} "
          f"monoliths, joints {entries['Joints/Model']}{'; ' + critical if critical.startswith('critical') else ''}", output / "view.png")
    write_vtu(output / "mesh.vtu", mesh.points, mesh.cells, 12, cell_data={"monolith": mesh.volume})
    write_vtu(output / "surfaces.vtu", mesh.points, mesh.quads, 9, cell_data={"group": mesh.surface})
    groups = ", ".join(f"{name} {number}" for (dimension, number), name in sorted(mesh.names.items()) if dimension == 2)
    print(f"Groups    {groups}\nExplicit  {critical}\n"
          f"Picture   {output / 'view.png'}\n"
          f"ParaView  {output / 'mesh.vtu'}, {output / 'surfaces.vtu'}")
    if failure:
        raise failure  # after the pictures, which may show the reason
    return 0
