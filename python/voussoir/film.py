# SPDX-License-Identifier: GPL-3.0-or-later
"""A film of the opening dam from the solution-*.vtu of a run, as GIF: displacements magnified, coloured by the largest principal stress.

    voussoir SCENE.prm --output DIR --set 'Output/Solution interval=4'
    scripts/film.py DIR FILM.gif [--magnify 250] [--from T] [--until T] [--slower 3] [--width 640]

Each solution is a picture; --slower says how many times longer the film lasts than the earthquake.
"""

from pathlib import Path

import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.collections import PolyCollection

from .command import Parser
from .errors import InputError
from .drawing import plt
from .picture import COLOURS, normals, outer_faces, read_solution, times_of, view_of


class Picture:
    """One time: corners of the outer faces, moved, and their stress [MPa]."""

    def __init__(self, path, magnify):
        data = read_solution(path, displacement=3, max_principal=1, opening=1)
        self.points, moved = data["Points"].astype(float), data["displacement"].astype(float)
        faces = outer_faces(self.points, moved, data["connectivity"])
        self.corners = (self.points + magnify * moved)[faces]
        self.stress = 1e-6 * data["max_principal"][faces].mean(axis=1)
        known = data["opening"][np.isfinite(data["opening"])]
        self.opening = 1e3 * known.max() if len(known) else 0.


def draw(axes, picture, view, limits):
    axes.clear()
    place, depth = view(picture.corners)
    n, eye = normals(picture.corners), view.centre + view.distance * view.back
    seen = np.einsum("ij,ij->i", n, eye - picture.corners.mean(axis=1)) > 0
    order = np.argsort(depth.mean(axis=1))
    order = order[seen[order]]
    light = .5 * view.back + .75 * view.up - .5 * view.right
    brightness = .72 + .34 * np.clip(n @ (light / np.linalg.norm(light)), 0, 1)
    colours = COLOURS(np.clip((picture.stress - limits[0]) / (limits[1] - limits[0]), 0, 1))[:, :3] * brightness[:, None]
    axes.add_collection(PolyCollection(place[order], facecolors=np.clip(colours[order], 0, 1), edgecolors=(.2, .2, .2, .25), linewidths=.25))
    axes.set_aspect("equal")
    axes.axis("off")


def main():
    parser = Parser(description=__doc__)
    parser.add_argument("directory", type=Path)
    parser.add_argument("film", type=Path)
    parser.add_argument("--magnify", type=float, default=250.)
    parser.add_argument("--from", type=float, default=0., dest="begin")
    parser.add_argument("--until", type=float, default=np.inf)
    parser.add_argument("--slower", type=float, default=3.)
    parser.add_argument("--width", type=int, default=640, help="pixels")
    options = parser.parse_args()
    if options.film.suffix != ".gif":
        raise InputError(f"The film is a GIF: give a name that ends in .gif, instead of {options.film}.")
    if not (options.slower > 0. and options.width > 0):
        raise InputError("--slower and --width must be greater than 0.")
    if not options.film.absolute().parent.is_dir():
        raise InputError(f"The film {options.film} cannot be written: there is no directory {options.film.parent}.")
    if not (options.directory / "solution.pvd").is_file():
        raise InputError(f"{options.directory} holds no solution.pvd: run the scene with --set 'Output/Solution interval=4'.")
    chosen = [(time, file) for time, file in times_of(options.directory) if options.begin <= time <= options.until]
    for _, file in chosen:
        if not file.is_file():
            raise InputError(f"{file} of solution.pvd is not there. Repeat the run, or choose other times with --from and --until.")
    if len(chosen) < 2 or not chosen[-1][0] > chosen[0][0]:
        raise InputError(f"There are {len(chosen)} solutions in {options.directory} between these times, too few for a film.")
    pictures = [Picture(file, options.magnify) for _, file in chosen]
    top = max(1., float(np.ceil(np.quantile(np.concatenate([picture.stress for picture in pictures]), .998))))
    view = view_of(pictures[0].points, -10., 38.)
    spans = np.concatenate([view(picture.corners)[0].reshape(-1, 2) for picture in pictures])
    low, high = spans.min(axis=0), spans.max(axis=0)
    size = options.width / 100.
    figure = plt.figure(figsize=(size, size * (high - low)[1] / (high - low)[0] + .35), facecolor="white")
    axes = figure.add_axes([.01, .01, .98, .90])
    interval = (chosen[-1][0] - chosen[0][0]) / (len(chosen) - 1)
    writer = PillowWriter(fps=min(50., 1. / (options.slower * interval)))
    with writer.saving(figure, options.film, dpi=100), plt.rc_context({"savefig.bbox": "standard"}):
        for (time, _), picture in zip(chosen, pictures):
            draw(axes, picture, view, (-.4 * top, top))
            axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
            axes.set_title(f"t = {time:5.2f} s     displacements × {options.magnify:g}     widest opening {picture.opening:3.0f} mm"
                           f"     red: tension up to {top:.0f} MPa", fontsize=.0135 * options.width, color=".25")
            writer.grab_frame(facecolor="white")
    print(f"{len(pictures)} pictures, {1. / writer.fps * len(pictures):.1f} s -> {options.film}, {options.film.stat().st_size / 1e6:.1f} MB")
    return 0
