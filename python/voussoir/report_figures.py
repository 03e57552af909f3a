# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a report, as images inside the page. All runs have the same scales."""

import base64
import io

import numpy as np

from . import picture
from .errors import InputError
from .drawing import (COLOURS, DIRECTIONS, DOWNSTREAM, LIMIT, UPSTREAM, aspect, common_levels, common_top, draw_base,
                      draw_crest, draw_crest_bars, draw_energy, draw_face, draw_joint_history, draw_spectrum, energy_parts, energy_unit,
                      plt, stress_bar, worst_joints)
from .runs import Skip

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
    """Response spectra of the components that move, each with its target: direction -> image."""
    table = run.table("spectrum.csv")
    images = {}
    for direction in DIRECTIONS:
        if np.any(table[f"spectrum_{direction}"]):
            @panel(2.9)
            def made(_, axes, direction=direction):
                draw_spectrum(axes[0], table, direction)
                axes[0].set_ylabel("pseudo-acceleration [m/s²]")
                axes[0].set_ylim(top / 60., 1.4 * top)
            images[direction] = made
    return images


def highest_spectrum(runs):
    tables = [run.table("spectrum.csv") for run in runs]
    return max(table[name].max() for table in tables for name in table if name.startswith(("spectrum", "target")))


# ---------------------------------------------------------------- the response

def crest(runs):
    def draw(rows):
        draw_crest(rows[0], runs)
        rows[0].set(xlabel="time [s]", ylabel="downstream [mm]")
    return both_widths(draw, 2.5, 1)


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
        for joint, colour in zip(sorted(shown), COLOURS):
            z = table["z"][edge & (table["joint"] == joint)]
            order = np.argsort(z)
            axes[0].plot(values[joint][order], z[order], color=colour, marker="o", markersize=2.2, label=f"joint {joint}")
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


def overstress(run):
    """Cumulative duration of overstress over the demand-capacity ratio, against what is allowed."""
    found = run.summary.get("overstress")
    if not found:
        raise Skip("no tensile strength is given (Limits/Tensile strength)")
    allowed = run.limit("Overstress duration")

    @panel(2.5)
    def made(_, axes):
        axes = axes[0]
        for name, colour in (("upstream", UPSTREAM), ("downstream", DOWNSTREAM)):
            duration = found[name].get("duration_away_from_base", found[name]["duration"])  # the latter of earlier versions
            axes.plot(found["levels"], duration, color=colour, marker="o", markersize=3, label=name)
        if allowed > 0.:
            axes.plot([1., 2.], [allowed, 0.], **LIMIT, label="allowed")
        axes.set(xlabel="principal stress over tensile strength [-]", ylabel="cumulative duration [s]", xlim=(0.98, 2.02))
        axes.set_ylim(bottom=0.)
        axes.legend(loc="upper right")
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
        for name, colour in zip(sorted(least(run), key=least(run).get)[:3], COLOURS):
            axes.plot(run.blocks["time"], run.blocks[name], color=colour, linewidth=0.9, label=f"monolith {name[7:]}")
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
