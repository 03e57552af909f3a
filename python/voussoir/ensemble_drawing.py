# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings of many motions, one axes at a time, for figures.py and report.py: each motion thin, the median heavy, 16 to 84 % as a band."""

import numpy as np

from .drawing import LIMIT, show_limit
from .palette import COLOURS
from .runs import Skip

BAND, MOTION = COLOURS[0], {"color": "0.62", "linewidth": .5, "zorder": 1}
MEASURES = {"max_opening": ("largest opening", 1e3, "mm", "Opening"), "max_slip": ("largest slip", 1e3, "mm", "Slip"),
            "tension": ("largest tension away from the base", 1e-6, "MPa", "Tension")}
FACES = tuple(f"max_tension_{face}_away_from_base" for face in ("upstream", "downstream"))


def measured(ensemble, measure, factor=None):
    """Values of a measure in its unit, motion by motion; of tension the larger one of the two faces."""
    scale = MEASURES[measure][1]
    if measure != "tension":
        return scale * ensemble.values(measure, factor)
    columns = [column for name in FACES if len(column := ensemble.values(name, factor))]
    return scale * np.max(columns, axis=0) if columns and len({len(column) for column in columns}) == 1 else np.zeros(0)


def draw_joint_band(axes, run, quantity):
    """Largest openings or slips of the joints along the crest."""
    joints = run.ensemble.joints
    if joints is None or run.tied:
        raise Skip("the dam has no joints that open")
    x = np.arange(1, len(joints["joint"]) + 1)
    curves = 1e3 * run.ensemble.curves(quantity)
    if len(curves):
        axes.plot(x, curves.T, **MOTION)
        axes.plot([], [], **MOTION, label="each motion")
    median, low, high = (1e3 * joints[f"{quantity}_{end}"] for end in ("median", "p16", "p84"))
    axes.fill_between(x, low, high, color=BAND, alpha=.22, linewidth=0, label="16 to 84 %")
    axes.plot(x, median, color=BAND, linewidth=2., marker="o", markersize=3.5, label="median")
    top = max(high.max(), curves.max(initial=0.))
    show_limit(axes, 1e3 * run.limit(quantity.capitalize()), "mm", top)
    names = [run.joint_name(int(joint), short=True) for joint in joints["joint"]]
    every = -(-len(x) // 15)
    axes.set_xticks(x[::every], names[::every])
    order = "right bank to the left" if joints["s"][0] <= joints["s"][-1] else "left bank to the right"
    axes.set(xlabel=f"joint, from the {order}", ylabel=f"largest {quantity} [mm]", ylim=(0, 1.3 * top or 1.))
    axes.margins(x=.03)
    axes.legend(loc="upper left", ncol=2, borderaxespad=.2)


def draw_distribution(axes, run, measure="max_opening"):
    """Share of the motions up to a value: empirical distribution, with median and band."""
    title, scale, unit, limit = MEASURES[measure]
    values = np.sort(measured(run.ensemble, measure))
    if len(values) < 2 or run.tied and measure != "tension":
        raise Skip(f"ensemble.csv has no {title} of two motions")
    found = run.ensemble.extremes.get(measure)  # of the tension of both faces there is none
    low, median, high = np.quantile(values, (.16, .5, .84)) if found is None else (scale * found[end] for end in ("p16", "median", "p84"))
    axes.axvspan(low, high, color=BAND, alpha=.18, linewidth=0, label=f"16 to 84 %: {low:.3g} to {high:.3g} {unit}")
    axes.axvline(median, color=BAND, linewidth=1., linestyle=(0, (4, 2)), label=f"median {median:.3g} {unit}")
    n = len(values)
    axes.step(np.concatenate([values[:1], values]), np.concatenate([[0.], np.arange(1, n + 1) / n]), where="post", color=BAND, linewidth=1.6)
    axes.plot(values, np.arange(1, n + 1) / n, "o", color=BAND, markersize=3)
    bound = scale * run.limit(limit)
    if 0. < bound < 2. * values[-1]:
        axes.axvline(bound, **LIMIT, label=f"limit {bound:g} {unit}")
    axes.set(xlabel=f"{title} [{unit}]", ylabel="share of the motions [-]", ylim=(0., 1.02), yticks=np.arange(0., 1.01, .2))
    axes.legend(loc="lower right", borderaxespad=.2, frameon=True, framealpha=.85, edgecolor="none")


def draw_dynamic_analysis(axes, run, measure="max_opening"):
    """Incremental dynamic analysis: factor over the measure, median and fractiles, each motion thin."""
    title, _, unit, _ = MEASURES[measure]
    ensemble, factors = run.ensemble, run.ensemble.factors
    if len(factors) < 2 or run.tied and measure != "tension":
        raise Skip("the motions have one factor")
    table = ensemble.motions
    column = MEASURES[measure][1] * (np.fmax(*(table[name] for name in FACES)) if measure == "tension" else table[measure])
    for name in dict.fromkeys(table["name"]):
        mine = np.flatnonzero((table["name"] == name) & np.isfinite(column))
        mine = mine[np.argsort(table["factor"][mine])]
        axes.plot(np.append(0., column[mine]), np.append(0., table["factor"][mine]), **MOTION)
    axes.plot([], [], **MOTION, label="each motion")
    if not np.isfinite(column).any():
        raise Skip(f"ensemble.csv has no {title}")
    samples = [np.where(np.isfinite(mine := column[table["factor"] == factor]), mine, np.inf) for factor in factors]  # without a result: beyond all others
    styles = {.5: {"linewidth": 2., "marker": "o", "markersize": 3.5, "label": "median"},
              .16: {"linewidth": 1.2, "linestyle": (0, (4, 1.5)), "label": "16 and 84 %"}, .84: {"linewidth": 1.2, "linestyle": (0, (4, 1.5))}}
    for share, style in styles.items():
        with np.errstate(invalid="ignore"):
            curve = np.array([np.quantile(values, share) for values in samples])
        axes.plot([0., *np.where(np.isfinite(curve), curve, np.nan)], [0., *factors], color=BAND, **style)
    if bound := MEASURES[measure][1] * run.limit(MEASURES[measure][3]):
        if bound < 2. * np.nanmax(column):
            axes.axvline(bound, **LIMIT, label=f"limit {bound:g} {unit}")
    axes.set(xlabel=f"{title} [{unit}]", ylabel="factor of the motion [-]", xlim=(0., None), ylim=(0., 1.05 * factors[-1]))
    axes.legend(loc="lower right", borderaxespad=.2, frameon=True, framealpha=.85, edgecolor="none")
