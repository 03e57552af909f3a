# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a report, as images inside the page. All runs have the same scales."""

import base64
import io
import re

import numpy as np

from . import picture
from .errors import InputError
from .drawing import (DIRECTIONS, LIMIT, aspect, common_levels, common_top, demand_bar, draw_base, draw_crest, draw_crest_bars, draw_demand,
                      draw_energy, draw_face, draw_joint_history, draw_spectra, energy_parts, energy_unit, moving, note, plt, show_periods,
                      stress_bar, worst_joints)
from .mode_shapes import draw_shape
from .palette import line
from .runs import NotComputed, Skip

NARROW, WIDE = 4.3, 9.0  # inches: a telephone or half a page, and a whole page
SMALL = {"font.size": 8.5, "axes.titlesize": 9, "axes.labelsize": 8.5, "legend.fontsize": 8, "xtick.labelsize": 8,
         "ytick.labelsize": 8, "lines.linewidth": 1.}


def image(figure, kind="svg"):
    """The figure as an address that holds it."""
    data = io.BytesIO()
    options = {"metadata": {"Date": None}} if kind == "svg" else {"dpi": 190}
    figure.savefig(data, format=kind, bbox_inches="tight", pad_inches=0.04, **options)
    plt.close(figure)
    mime = "image/svg+xml" if kind == "svg" else "image/png"
    return f"data:{mime};base64,{base64.b64encode(data.getvalue()).decode()}"


def panel(height, kind="svg", rows=1, **grid):
    """Calls the decorated function with a narrow figure and its axes; the image."""
    def made(draw):
        with plt.rc_context(SMALL):
            figure, axes = plt.subplots(rows, 1, figsize=(NARROW, height), sharex=True, squeeze=False, constrained_layout=True, **grid)
            draw(figure, axes[:, 0])
            return image(figure, kind)
    return made


def both_widths(draw, height, rows):
    """The same drawing for a whole page and for a telephone: two images."""
    images = []
    with plt.rc_context(SMALL):
        for width in (WIDE, NARROW):
            figure, axes = plt.subplots(rows, 1, figsize=(width, height), sharex=True, squeeze=False, constrained_layout=True)
            draw(axes[:, 0])
            figure.align_ylabels(axes[:, 0])
            images.append(image(figure))
    return images


# ---------------------------------------------------------------- the dam

def dam(run):
    """The mesh, seen from downstream, monoliths in two tones."""
    file = next((file for file in [run.directory / "envelope.vtu", *sorted(run.directory.glob("solution-*.vtu"))] if file.exists()), None)
    if file is None:
        raise Skip("no envelope.vtu: Output/Envelope interval is 0")
    try:
        data = picture.read_solution(file, monolith=1)
    except InputError as error:
        raise Skip(error) from error
    with plt.rc_context(SMALL):
        figure, axes = plt.subplots(figsize=(NARROW * 1.25, NARROW * 0.85))
        points, cells = data["Points"].astype(float), data["connectivity"]
        monolith = data["monolith"][cells[:, 0]].astype(int)
        picture.draw_mesh(axes, points, cells, monolith, picture.view_of(points))
        return image(figure, "png")


def open_dam(run):
    """The displaced dam at its widest opening: image, and time, scale and opening in words."""
    if not any(run.directory.glob("solution-*.vtu")):
        raise NotComputed("a run with --set 'Output/Solution interval=4'")
    try:
        file = picture.widest(run.directory)
        with plt.rc_context(SMALL):
            figure, axes = plt.subplots(figsize=(WIDE, 4.8))
            text = picture.draw_open(figure, axes, file)
            return image(figure, "png"), text
    except InputError as error:
        raise Skip(error) from error


def mode(directory, k):
    """The shape of mode k + 1 of `voussoir modes --output`."""
    try:
        data = picture.read_solution(directory / f"mode-{k + 1:03d}.vtu", displacement=3)
    except (InputError, OSError) as error:
        raise Skip(error) from error
    with plt.rc_context(SMALL):
        figure, axes = plt.subplots(figsize=(NARROW, 2.4))
        draw_shape(axes, data)
        return image(figure, "png")


# ---------------------------------------------------------------- the motion

def accelerations(run):
    """Base acceleration, on a page and on a telephone."""
    base = run.base_acceleration
    if not base:
        raise Skip("the base is at rest")
    largest = max(np.abs(column).max() for column in base.values())

    def draw(rows):
        for axes, direction in zip(rows, sorted(base)):
            draw_base(axes, run, direction, largest)
        rows[-1].set_xlabel("time [s]")
    return both_widths(draw, 0.4 + 1.05 * len(base), len(base))


def spectra(run, top):
    """Response spectra of the components that move, each with its target, and of both horizontal ones with RotD50 and RotD100: name -> image."""
    table = run.table("spectrum.csv")
    images, shown = {}, moving(table)
    for directions in [*shown, *(["xy"] if {"x", "y"} <= set(shown) and "rotd50" in table else [])]:
        @panel(2.9)
        def made(_, axes, directions=directions):
            draw_spectra(axes[0], table, directions)
            axes[0].set_ylabel("pseudo-acceleration [m/s²]")
            axes[0].set_ylim(top / 60., 1.4 * top)
        images[DIRECTIONS.get(directions, "RotD50 and RotD100")] = made
    return images


def motion_spectrum(run):
    """Response spectra of all components of the motion."""
    table = run.table("spectrum.csv")
    if not (shown := moving(table)):
        raise Skip("the base is at rest")

    @panel(2.3)
    def made(_, axes):
        draw_spectra(axes[0], table, shown)
        axes[0].set_ylabel("pseudo-acceleration [m/s²]")
        note(axes[0], f"damping {100. * table['damping'][0]:g} %")
    return made


def deviation(table):
    """Smallest and largest ratio of the motion's spectra to their targets between 0.1 and 2 s, or None."""
    near = (table["period"] >= 0.1) & (table["period"] <= 2.)
    ratios = [table[f"spectrum_{d}"][near] / table[f"target_{d}"][near] for d in DIRECTIONS
              if f"target_{d}" in table and near.any() and (table[f"target_{d}"][near] > 0.).all()]
    return (min(r.min() for r in ratios), max(r.max() for r in ratios)) if ratios else None


def highest_spectrum(runs):
    tables = [run.table("spectrum.csv") for run in runs]
    return max(table[name].max() for table in tables for name in table if name.startswith(("spectrum", "target", "rotd")))


# ---------------------------------------------------------------- the response

def crest(runs):
    def draw(rows):
        draw_crest(rows[0], runs)
        rows[0].set(xlabel="time [s]", ylabel="downstream [mm]")
    return both_widths(draw, 2.5, 1)


def points_with_acceleration(run):
    """Points of history.csv with absolute accelerations, in its columns NAME_acceleration_x, y, z; not the base."""
    return sorted({match[1] for name in run.history if (match := re.fullmatch(r"(.+)_acceleration_[xyz]", name)) and match[1] != "base"})


def point_accelerations(run):
    """Absolute accelerations of crest and probes over time."""
    points = points_with_acceleration(run)
    directions = [d for d in DIRECTIONS if any(f"{point}_acceleration_{d}" in run.history for point in points)]

    def draw(rows):
        for axes, direction in zip(rows, directions):
            for number, point in enumerate(points):
                if (column := run.history.get(f"{point}_acceleration_{direction}")) is not None:
                    axes.plot(run.history["time"], column, **line(number), linewidth=0.8,
                              label=f"{point.replace('_', ' ')}: {np.abs(column).max():.2f} m/s²")
            axes.set_ylabel(f"{DIRECTIONS[direction]}\n[m/s²]")
            axes.margins(x=0)
            axes.legend(loc="upper right", ncol=2)
        rows[-1].set_xlabel("time [s]")
    return both_widths(draw, 0.4 + 1.5 * len(directions), len(directions))


def floor_spectra(run):
    """Every column of floor_spectra.csv over its first column, period or frequency."""
    table = run.table("floor_spectra.csv")
    over = next((name for name in ("period", "frequency") if name in table), None)
    columns = [name for name in table if name not in ("period", "frequency", "damping")]
    if over is None or not columns:
        raise Skip("floor_spectra.csv has no column period or frequency, or no spectrum")

    def draw(rows):
        for number, name in enumerate(columns):
            rows[0].loglog(table[over], table[name], **line(number), label=name.replace("_", " "))
        rows[0].set(xlabel=f"{over} [{'s' if over == 'period' else 'Hz'}]", ylabel="pseudo-acceleration [m/s²]")
        if over == "period":
            show_periods(rows[0], table[over])
        rows[0].legend(loc="lower left", ncol=2)
    return both_widths(draw, 3., 1)


def crest_bars(run, quantity, runs):
    top = common_top(runs, quantity)

    @panel(2.5)
    def made(_, axes):
        draw_crest_bars(axes[0], run, quantity, top, run.limit(quantity.capitalize()))
    return made


def over_time(run, quantity, top):
    """Opening or slip at the crest, of the joints that open most."""
    worst = worst_joints(run, 3)

    @panel(0.5 + 1.15 * len(worst), rows=len(worst), sharey=True)
    def made(_, axes):
        for row, joint in zip(axes, worst):
            draw_joint_history(row, run, joint, quantity)
            row.set_ylim(-0.04 * top, 1.3 * top or 1.)
        axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2, borderaxespad=0.1)
        axes[len(axes) // 2].set_ylabel(f"{quantity} [mm]")
        axes[-1].set_xlabel("time [s]")
    return made


def highest_at_crest(runs, quantity):
    return max(1e3 * run.joint_history[name].max() for run in runs for name in run.joint_history if name.startswith(quantity))


def over_height(run, quantity, top):
    """The largest opening or slip of each joint over the height, at the upstream face."""
    table = run.table("joint_points.csv")
    edge = table["depth"] < 1e-6
    numbers = np.unique(table["joint"]).astype(int)
    values = {j: 1e3 * table[f"max_{quantity}"][edge & (table["joint"] == j)] for j in numbers}
    if not any(len(v) for v in values.values()):
        raise Skip("the joints have no edge on the upstream face")
    shown = sorted(numbers, key=lambda j: -max(values[j], default=0.))[:6]

    @panel(2.9)
    def made(_, axes):
        for number, joint in enumerate(sorted(shown)):
            z = table["z"][edge & (table["joint"] == joint)]
            order = np.argsort(z)
            axes[0].plot(values[joint][order], z[order], **line(number), marker="osv^D*"[number], markersize=2.6, label=run.joint_name(joint))
        axes[0].set(xlabel=f"maximum {quantity} at the upstream face [mm]", ylabel="elevation z [m]", xlim=(0, 1.08 * top or 1.))
        axes[0].legend(loc="lower right", borderaxespad=0.2)
    return made


def highest_point(runs, quantity):
    return max(1e3 * run.table("joint_points.csv")[f"max_{quantity}"].max() for run in runs)


# ---------------------------------------------------------------- stresses

def face(run, name, column, runs):
    levels = common_levels(runs, column)

    @panel(1.15 + 0.98 * NARROW * aspect(run), "png")
    def made(figure, axes):
        contours = draw_face(axes[0], run, name, column, levels, 1e-6 * run.limit("Tensile strength"))
        stress_bar(figure, contours, axes[0], levels, aspect=42, fraction=0.06, pad=0.02)
    return made


DIRECTED = {"arch_stress_max": "arch", "cantilever_stress_max": "cantilever"}  # columns of faces.csv


def directed(runs):
    """Runs whose faces have the largest arch and cantilever stresses (not those of earlier versions)."""
    return [run for run in runs if run.faces and all(column in face for face in run.faces.values() for column in DIRECTED)]


def directed_face(run, name, column, runs):
    levels = common_levels(runs, column)

    @panel(1.15 + 0.98 * NARROW * aspect(run), "png")
    def made(figure, axes):
        contours = draw_face(axes[0], run, name, column, levels)
        stress_bar(figure, contours, axes[0], levels, DIRECTED[column], aspect=42, fraction=0.06, pad=0.02)
    return made


def demand(run, name):
    @panel(1.15 + 0.98 * NARROW * aspect(run), "png")
    def made(figure, axes):
        demand_bar(figure, draw_demand(axes[0], run, name, run.static_strength), axes[0], aspect=42, fraction=0.06, pad=0.02)
    return made


def drawn(height, draw, *arguments):
    """A figure with one drawing, such as draw_overstress(axes, run)."""
    @panel(height)
    def made(_, axes):
        draw(axes[0], *arguments)
    return made


# ---------------------------------------------------------------- the bases

def sliding(run, runs):
    """Safety against sliding over time, of the three monoliths that have the least."""
    least = lambda one: {name: column.min() for name, column in one.blocks.items() if name.startswith("safety_")}
    limit = run.limit("Sliding safety")
    limits = [one.limit("Sliding safety") for one in runs]
    top = 3. * max([0.5, *limits, *(x for one in runs for x in [min(least(one).values())] if np.isfinite(x))])

    @panel(2.5)
    def made(_, axes):
        axes = axes[0]
        for number, name in enumerate(sorted(least(run), key=least(run).get)[:3]):
            axes.plot(run.blocks["time"], run.blocks[name], **line(number), linewidth=0.9, label=f"monolith {name[7:]}")
        if limit > 0.:
            axes.axhline(limit, **LIMIT, label="asked for")
        axes.set(xlabel="time [s]", ylabel="safety against sliding [-]", ylim=(0, top))
        axes.margins(x=0)
        axes.legend(loc="upper right", borderaxespad=0.2)
    return made


# ---------------------------------------------------------------- energy

def energies(run, runs):
    largest = max(energy_parts(one)[1] for one in runs)

    @panel(2.7)
    def made(_, axes):
        draw_energy(axes[0], run, largest)
        low, high = axes[0].get_ylim()
        axes[0].set_ylim(min(low, -0.05 * largest / energy_unit(largest)[1]), max(high, 1.5 * largest / energy_unit(largest)[1]))  # room for the legend
        axes[0].set_xlabel("time [s]")
        axes[0].legend(loc="upper left", ncol=2, borderaxespad=0.2, handlelength=1.4, columnspacing=1.)
    return made
