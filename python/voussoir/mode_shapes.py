# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the natural modes that `voussoir modes --output DIR` writes."""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .drawing import plt
from .picture import creases, normals, outer_faces, read_solution, view_of
from .runs import read_table

PER_PAGE = 12


def draw_shape(axes, data, part=.09):
    """The shape with its largest displacement drawn as a part of the dam's size, coloured by the displacement along x."""
    points, moved = data["Points"].astype(float), data["displacement"].astype(float)
    faces = outer_faces(points, 0. * points, data["connectivity"])
    corners = (points + part * max(np.ptp(points, axis=0)) * moved)[faces]
    view = view_of(points, -8., 30.)
    place, depth = view(corners)
    n, eye = normals(corners), view.centre + view.distance * view.back
    seen = np.einsum("ij,ij->i", n, eye - corners.mean(axis=1)) > 0
    order = np.argsort(depth.mean(axis=1))
    order = order[seen[order]]
    colours = plt.get_cmap("RdBu_r")(.5 + .45 * moved[faces][order, :, 0].mean(axis=1))
    axes.add_collection(PolyCollection(place[order], facecolors=colours, edgecolors=(.3, .3, .3, .35), linewidths=.2))
    still = [view(ends)[0] for ends, _ in creases(faces, points[faces])]
    axes.add_collection(LineCollection(still, colors=".55", linewidths=.5, linestyles=(0, (3, 2))))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")


def draw_modes(directory):
    """DIR/modes.png: the first modes, with their frequencies and effective masses."""
    table = read_table(directory / "modes.csv")
    count = min(len(table["mode"]), PER_PAGE)
    columns = min(3, count)
    rows = -(-count // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(4.2 * columns, 2.5 * rows), squeeze=False, constrained_layout=True)
    for axes in grid.ravel()[count:]:
        axes.set_visible(False)
    for k, axes in enumerate(grid.ravel()[:count]):
        draw_shape(axes, read_solution(directory / f"mode-{k + 1:03d}.vtu", displacement=3))
        shares = ", ".join(f"{d} {100 * table[f'share_{d}'][k]:.0f} %" for d in "xyz")
        axes.set_title(f"{k + 1}: {table['frequency'][k]:.2f} Hz; effective mass {shares}", fontsize=9)
    figure.savefig(directory / "modes.png", dpi=130)
    plt.close(figure)
