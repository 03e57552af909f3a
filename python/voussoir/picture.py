# SPDX-License-Identifier: GPL-3.0-or-later
"""Paints the dam with its joints open from one of the solution-*.vtu of a run, displacements magnified, coloured by the
largest principal stress or by the opening of the joints.

    scripts/picture.py SOLUTION.vtu PICTURE.png [--magnify 250] [--azimuth -10] [--elevation 38] [--title TEXT]

The picture of doc/report.md, from coarse.prm:

    scripts/run.sh prm/coarse.prm --set 'Output/Solution interval=1'
    scripts/picture.py output/coarse doc/figures/dam.png

With a directory, the solution whose joints are widest open is taken.
"""

import re
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # after the choice of the backend
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from .command import Parser
from .errors import InputError
from .runs import Skip, read_table
from .vtu import read_vtu

# The corners of the faces of a hexahedron of VTK, seen from outside counter-clockwise.
FACES = np.array([[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]])
COLOURS = LinearSegmentedColormap.from_list(
    "concrete", ["#5b8fb9", "#a9c4d6", "#e9e4da", "#f0c27b", "#dd7a3b", "#a92b1f"])
CONCRETE = [(.90, .88, .83), (.76, .79, .82)]  # monoliths in turn
FINE = 3  # each side of a face is painted in so many parts


def widest(directory):
    """The solution of a run whose joints are widest open, by joint_history.csv."""
    try:
        table = read_table(directory / "joint_history.csv")
    except Skip as reason:
        raise InputError(f"{directory}: {reason}, so its widest opening is not known. Repeat the run, or name a solution-*.vtu.") from reason
    columns = [column for name, column in table.items() if name.startswith("opening")]
    openings = np.max([0. * table["time"], *columns], axis=0)  # no joints: the first
    steps = {int(path.stem[9:]): path for path in directory.glob("solution-*.vtu") if path.stem[9:].isdecimal()}
    if not any(k < len(openings) for k in steps):
        raise InputError(f"{directory} has no solution-*.vtu: run the scene with --set 'Output/Solution interval=1'.")
    return steps[max((k for k in steps if k < len(openings)), key=lambda k: openings[k])]


def times_of(directory):
    """Time [s] and file of each solution, by solution.pvd; empty if the file does not exist."""
    pvd = directory / "solution.pvd"
    found = re.findall(r'timestep="([^"]*)" file="(solution-[^"]*)"', pvd.read_text(errors="replace")) if pvd.exists() else []
    try:
        return [(float(time), directory / name) for time, name in found]
    except ValueError as error:
        raise InputError(f"{pvd} is damaged: {error}. Repeat the run.") from error


def read_solution(path, **widths):
    """Arrays of a file of hexahedra by name, a row for each point or cell; widths: numbers in a row of those that the caller needs.
    Throws InputError for a damaged file."""
    data = {name: np.asarray(values) for name, values in read_vtu(path).items()}
    for name, width in {"Points": 3, "connectivity": 8, **widths}.items():
        values = data.get(name, np.zeros(0))
        rows = len(data["Points"]) if name in widths else len(values) // width
        if rows == 0 or len(values) != rows * width or name != "opening" and not np.isfinite(values).all():
            raise InputError(f"{path} is damaged: the array {name} is missing, or has values that are not finite, or not {width} in each row. "
                             "Repeat the run.")
        data[name] = values.reshape((rows, width) if width > 1 else rows)
    if data["connectivity"].min() < 0 or data["connectivity"].max() >= len(data["Points"]):
        raise InputError(f"{path} is damaged: the array connectivity names points that are not there. Repeat the run.")
    return data


def outer(points, moved, cells):
    """Which faces are not between two cells that move as one: numbers into the six faces of each cell, one cell after the other."""
    faces = cells[:, FACES].reshape(-1, 4)
    key = np.concatenate([np.round(points * 1e3), np.round(moved * 1e7)], axis=1).astype(np.int64)
    _, same = np.unique(key, axis=0, return_inverse=True)
    _, where, count = np.unique(np.sort(same.reshape(-1)[faces], axis=1), axis=0, return_index=True, return_counts=True)
    return where[count == 1]


def outer_faces(points, moved, cells):
    """These faces: (face, corner) of points."""
    return cells[:, FACES].reshape(-1, 4)[outer(points, moved, cells)]


def bilinear(values, n):
    """Corner values (face, 4, ...) on the (n+1)^2 points of a grid: (face, n+1, n+1, ...)."""
    t = np.linspace(0, 1, n + 1)
    s, r = np.meshgrid(t, t, indexing="ij")
    weights = np.stack([(1 - s) * (1 - r), s * (1 - r), s * r, (1 - s) * r], axis=-1)
    return np.einsum("ijk,fk...->fij...", weights, values)


def parts(grid):
    """The quadrilaterals of such grids: (quadrilateral, 4, ...)."""
    corners = [grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]]
    stacked = np.stack(corners, axis=3)
    return stacked.reshape(-1, *stacked.shape[3:])


class View:
    """A camera downstream of the dam, @p azimuth degrees to its left bank and @p elevation above."""

    def __init__(self, azimuth, elevation, centre, distance):
        a, e = np.radians([azimuth, elevation])
        self.back = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        self.right = np.array([-np.sin(a), np.cos(a), 0.])
        self.up = np.cross(self.back, self.right)
        self.centre, self.distance = centre, distance

    def __call__(self, x):
        """Places on the picture, and depths."""
        x = x - self.centre
        depth = x @ self.back
        scale = self.distance / (self.distance - depth)
        return np.stack([x @ self.right * scale, x @ self.up * scale], axis=-1), depth


def normals(quads):
    n = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    return n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)


def creases(faces, corners, angle=35.):
    """Edges at which the surface of the moved dam bends: pairs of places, and the normal of either face."""
    n = normals(corners)
    edges = {}
    for f, face in enumerate(corners):
        for k in range(4):
            ends = np.round(face[[k, (k + 1) % 4]] * 1e3).astype(np.int64)
            edges.setdefault(tuple(sorted(map(tuple, ends))), []).append((f, k))
    lines = []
    for sides in edges.values():
        if len(sides) != 2 or n[sides[0][0]] @ n[sides[1][0]] < np.cos(np.radians(angle)):
            f, k = sides[0]
            lines.append((corners[f, [k, (k + 1) % 4]], n[[side[0] for side in sides[:2]]]))
    return lines


def paint(axes, view, quads, values, lines, limits):
    """Paints quadrilaterals and lines from the farthest to the nearest."""
    place, depth = view(quads)
    n = normals(quads)
    eye = view.centre + view.distance * view.back
    visible = np.einsum("ij,ij->i", n, eye - quads.mean(axis=1)) > 0
    light = .5 * view.back + .75 * view.up - .5 * view.right
    light /= np.linalg.norm(light)
    brightness = .70 + .36 * np.clip(n @ light, 0, 1) + .05 * np.clip(n[:, 2], 0, 1)
    colours = COLOURS(np.clip((values.mean(axis=1) - limits[0]) / (limits[1] - limits[0]), 0, 1))[:, :3]
    colours = np.clip(colours * brightness[:, None], 0, 1)
    items = [(d, p, c, .6) for d, p, c, v in zip(depth.mean(axis=1), place, colours, visible) if v]
    for ends, sides in lines:
        if any(side @ (eye - ends[0]) > 0 for side in sides):
            t = np.linspace(0, 1, FINE + 1)[:, None]
            path, far = view(ends[0] + t * (ends[1] - ends[0]))
            items += [(far[i:i + 2].mean() + 6., path[i:i + 2], (.16, .17, .2), .8) for i in range(FINE)]
    items.sort(key=lambda item: item[0])
    _, shapes, rgb, widths = zip(*items)
    axes.add_collection(PolyCollection(shapes, facecolors=rgb, edgecolors=rgb, linewidths=widths, joinstyle="round",
                                       capstyle="round"))


def mesh_lines(corners, monolith):
    """Edges between two faces of different monoliths, or where the surface bends; as creases() gives them."""
    n, owners = normals(corners), {}
    for f, face in enumerate(corners):
        for k in range(4):
            ends = np.round(face[[k, (k + 1) % 4]] * 1e3).astype(np.int64)
            owners.setdefault(tuple(sorted(map(tuple, ends))), []).append((f, k))
    return [(corners[sides[0][0], [sides[0][1], (sides[0][1] + 1) % 4]], n[[side[0] for side in sides[:2]]])
            for sides in owners.values() if len({monolith[side[0]] for side in sides}) > 1
            or n[sides[0][0]] @ n[sides[-1][0]] < np.cos(np.radians(35.))]


def below(polygon, level):
    """The part of a polygon that lies below a level; empty, or its corners."""
    part = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0)):
        if p[2] <= level:
            part.append(p)
        if (p[2] <= level) != (q[2] <= level):
            part.append(p + (level - p[2]) / (q[2] - p[2]) * (q - p))
    return np.array(part)


def draw_mesh(axes, points, cells, monolith, view, tones=None, wet=None):
    """The undeformed mesh, edges of the elements thin and joints heavy, neighbouring monoliths in two tones. `monolith`: of each cell;
    `tones`: None, or a function of the numbers of the faces (six of each cell) that gives their colours; `wet`: None, or one that
    gives those that may be under water, with its level and its colour."""
    which = outer(points, 0. * points, cells)
    corners = points[cells[:, FACES].reshape(-1, 4)[which]]
    number = monolith[which // 6]
    n, eye = normals(corners), view.centre + view.distance * view.back
    place, depth = view(corners)
    light = .5 * view.back + .75 * view.up - .5 * view.right
    brightness = .72 + .34 * np.clip(n @ (light / np.linalg.norm(light)), 0, 1)
    tints = np.array(CONCRETE)[number % 2] if tones is None else tones(which)
    colours = np.clip(tints * brightness[:, None], 0, 1)
    visible = np.einsum("ij,ij->i", n, eye - corners.mean(axis=1)) > 0
    items = [(d, p, (*c, 1.), (.45, .47, .5, .55), .25) for d, p, c, v in zip(depth.mean(axis=1), place, colours, visible) if v]
    reach = .02 * max(np.ptp(points, axis=0))
    under, level, colour = wet(which) if wet else ([], 0., 0.)
    for k in under:
        if visible[k] and len(part := below(corners[k], level)) > 2:
            items.append((depth[k].mean() + 1e-6 * reach, view(part)[0], (*np.clip(np.array(colour) * brightness[k], 0, 1), 1.),
                          (.45, .47, .5, .55), .25))
    for ends, sides in mesh_lines(corners, number):
        if any(side @ (eye - ends[0]) > 0 for side in sides):
            path, far = view(ends)
            items.append((far.mean() + reach, path, (0, 0, 0, 0), (.13, .14, .17, 1.), .8))
    items.sort(key=lambda item: item[0])
    _, shapes, fills, lines, widths = zip(*items)
    axes.add_collection(PolyCollection(shapes, facecolors=fills, edgecolors=lines, linewidths=widths, joinstyle="round",
                                       capstyle="round"))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")


def view_of(points, azimuth=-12., elevation=34.):
    """A camera for these points."""
    return View(azimuth, elevation, .5 * (points.max(axis=0) + points.min(axis=0)), 3.2 * max(np.ptp(points, axis=0)))


def draw_open(figure, axes, path, magnify=250., azimuth=-10., elevation=38., largest=60000):
    """Draws the displaced dam of a solution-*.vtu with a bar of colours; returns time, scale and widest opening as text. Throws Skip for a
    dam with more than @p largest outer faces of elements; dams with more than a third are painted coarsely."""
    time = next((time for time, file in times_of(path.parent) if file.name == path.name), None)
    data = read_solution(path, displacement=3, max_principal=1, opening=1)
    points, moved, cells = data["Points"].astype(float), data["displacement"].astype(float), data["connectivity"]
    stress = 1e-6 * data["max_principal"]
    faces = outer_faces(points, moved, cells)
    if len(faces) > largest:
        raise Skip(f"its {len(faces)} outer faces of elements take too long to paint")
    fine = FINE if len(faces) <= largest // 3 else 1
    x = points + magnify * moved
    quads = parts(bilinear(x[faces], fine))
    values = parts(bilinear(stress[faces], fine))
    view = View(azimuth, elevation, .5 * (points.max(axis=0) + points.min(axis=0)), 3.2 * max(np.ptp(points, axis=0)))
    top = float(np.ceil(np.quantile(values, .998)))
    limits = (-.4 * top, top)
    paint(axes, view, quads, values, creases(faces, x[faces]), limits)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")
    bar = figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(*limits), COLOURS), ax=axes, orientation="horizontal",
                          shrink=.32, aspect=32, pad=.01, ticks=range(int(np.ceil(limits[0])), int(top) + 1, 2))
    bar.set_label("largest principal stress [MPa]", fontsize=9, color=".25")
    bar.ax.tick_params(labelsize=9, colors=".25")
    bar.outline.set_visible(False)
    text = [f"t = {time:.2f} s"] if time is not None else []
    text += [f"displacements × {magnify:g}"]
    if np.isfinite(data["opening"]).any():
        text += [f"widest opening {1e3 * np.nanmax(data['opening']):.0f} mm"]
    return ", ".join(text)


def main():
    parser = Parser(description=__doc__)
    parser.add_argument("solution", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--magnify", type=float, default=250., help="displacements, from the state at rest")
    parser.add_argument("--azimuth", type=float, default=-10.)
    parser.add_argument("--elevation", type=float, default=38.)
    parser.add_argument("--title", default="")
    options = parser.parse_args()
    if options.solution.is_dir():
        options.solution = widest(options.solution)
    if not options.solution.is_file():
        raise InputError(f"There is no {options.solution}: give a solution-*.vtu, or the output directory of a run.")
    figure, axes = plt.subplots(figsize=(11, 6))
    text = draw_open(figure, axes, options.solution, options.magnify, options.azimuth, options.elevation)
    axes.set_title(options.title or text, fontsize=11, color=".25")
    try:
        options.picture.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(options.picture, dpi=120, bbox_inches="tight", facecolor="white")
    except (OSError, ValueError) as error:
        raise InputError(f"The picture {options.picture} cannot be written: {error}. Choose another name, such as dam.png.") from error
    print(f"{options.solution} -> {options.picture}")
    return 0
