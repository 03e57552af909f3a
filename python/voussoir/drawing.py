# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings of results, one axes at a time, for figures.py and report.py: the same colours, signs and words in all
figures. Stresses in MPa, tension positive; openings and slips in mm."""

from collections import Counter

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # after the choice of the backend
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator, NullFormatter

from .palette import COLOURS, line
from .runs import Skip

UPSTREAM, DOWNSTREAM = COLOURS[:2]
FACES = {"upstream": UPSTREAM, "downstream": DOWNSTREAM}
DIRECTIONS = {"x": "stream", "y": "cross", "z": "vertical"}
LIMIT = {"color": "#111111", "linewidth": 1., "linestyle": (0, (5, 2))}
ENERGIES = ("input", "strain", "kinetic", "added_mass", "damping", "friction", "impact", "joint_stored", "joint_fracture", "bond", "transmitted")

plt.rcParams.update({
    "font.size": 11, "axes.titlesize": 12, "axes.labelsize": 11, "legend.fontsize": 10, "legend.frameon": False,
    "axes.grid": True, "grid.linewidth": 0.4, "grid.color": "0.85", "axes.axisbelow": True, "axes.linewidth": 0.7,
    "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 180, "savefig.bbox": "tight",
    "svg.hashsalt": "voussoir"})  # the same file for the same data


def minus(text):
    """Text with the typographic minus of the axes."""
    return text.replace("-", "\N{MINUS SIGN}")


def note(axes, text, place=(0.995, 0.95)):
    """A remark in a corner of the axes."""
    axes.text(*place, text, transform=axes.transAxes, ha="right", va="top", fontsize="small",
              bbox={"facecolor": "w", "edgecolor": "none", "pad": 1, "alpha": 0.8})


# ---------------------------------------------------------------- stresses on the faces

def triangles(nodes, cells):
    """Every quadrilateral as four triangles around its centre: coordinates and corners of the triangles."""
    n = len(nodes)
    centres = n + np.arange(len(cells))
    corner = [np.stack([cells[:, i], cells[:, (i + 1) % 4], centres], axis=1) for i in range(4)]
    return np.vstack([nodes, nodes[cells].mean(axis=1)]), np.vstack(corner)


def edges(drawn, places, cells):
    """The face's outline, and the edges where two monoliths meet (their nodes coincide, but are not the same).
    `drawn`: the nodes on paper; `places`: in space."""
    count = Counter(tuple(sorted((cell[i], cell[(i + 1) % 4]))) for cell in cells for i in range(4))
    border = [edge for edge, n in count.items() if n == 1]
    rounded = [tuple(place) for place in np.round(places, 3) + 0.]  # no negative zeros
    keys = [tuple(sorted(rounded[node] for node in edge)) for edge in border]
    shared = Counter(keys)
    outline = [drawn[list(edge)] for edge, key in zip(border, keys) if shared[key] == 1]
    joints = [drawn[list(edge)] for edge, key in zip(border, keys) if shared[key] > 1]
    return outline, joints


def away_from_base(run):
    """Face -> which of its nodes are farther from the base than a tenth of the height of the dam: closer to it, stresses grow with refinement."""
    places = {name: np.stack([face[c] for c in "xyz"], axis=1) for name, face in run.faces.items()}
    top = max(x[:, 2].max() for x in places.values())
    height = top - min(x[:, 2].min() for x in places.values())
    sides = [side for name, face in run.faces.items() for side in edges(places[name], places[name], face["quads"])[0]]
    base = np.array([node for side in sides if side[:, 2].min() < top - .005 * height for node in side])
    if not len(base):
        return {name: np.ones(len(x), dtype=bool) for name, x in places.items()}
    base = np.unique(np.round(base, 6), axis=0)
    return {name: np.array([((base - node)**2).sum(axis=1).min() for node in x]) > (.1 * height)**2 for name, x in places.items()}


def common_levels(runs, column):
    """Round contour levels [MPa] for both faces of all runs, so that they can be compared: between the 1st and 99th
    percentile (a heel is singular), and zero among them."""
    pairs = [np.percentile(1e-6 * np.concatenate([face[column] for face in run.faces.values()]), [1, 99]) for run in runs]
    low, high = min(0., *(pair[0] for pair in pairs)), max(0., *(pair[1] for pair in pairs))
    if high - low < 1e-3:
        low, high = low - 0.1, high + 0.1
    return MaxNLocator(nbins=10, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)


def aspect(run):
    """Height over width of a developed face, at most 2: a slice in plane strain is narrow."""
    face = next(iter(run.faces.values()))
    return min(2., 1.17 * np.ptp(face["z"]) / max(1.03 * np.ptp(face["s"]), 1e-9))


def draw_face(axes, run, name, column, levels, strength=0.):
    """One developed face with its stress; the contour of the tensile strength [MPa] as a heavy line. The contours, for a bar."""
    if name not in run.faces:
        raise Skip(f"no {name} face in faces.csv")
    face = run.faces[name]
    s, z, cells, stress = face["s"], face["z"], face["quads"], 1e-6 * face[column]
    points, corners = triangles(np.stack([s, z], axis=1), cells)
    values = np.concatenate([stress, stress[cells].mean(axis=1)])
    # Red is tension, blue compression, white zero, whatever the range; colours beyond it for `extend`.
    step = levels[1] - levels[0]
    middles = np.append(levels - step / 2, levels[-1] + step / 2)
    colours = plt.get_cmap("RdBu_r")(0.5 + 0.5 * middles / np.abs(middles).max())
    contours = axes.tricontourf(points[:, 0], points[:, 1], corners, values, levels=levels, colors=colours, extend="both")
    if np.any((values.min() < levels) & (levels < values.max())):  # on common scales, a face may lie between two
        axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=levels, colors="0.35", linewidths=0.25,
                        linestyles="solid")
    if values.min() < strength < values.max() and column == "max_principal" and strength > 0.:
        axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=[strength], colors="k", linewidths=1.4)
    finish_face(axes, run, name, stress if "max" in column else -stress, lambda k: f"{'max' if 'max' in column else 'min'} {stress[k]:.2f} MPa")
    return contours


def draw_demand(axes, run, name, strength):
    """One developed face with the largest principal stress over the static tensile strength [Pa]; heavy lines at 1 and 2. The contours."""
    if name not in run.faces:
        raise Skip(f"no {name} face in faces.csv")
    face = run.faces[name]
    ratio = face["max_principal"] / strength
    points, corners = triangles(np.stack([face["s"], face["z"]], axis=1), face["quads"])
    values = np.concatenate([ratio, ratio[face["quads"]].mean(axis=1)])
    contours = axes.tricontourf(points[:, 0], points[:, 1], corners, values, levels=DEMANDS, colors=["#f4f4f2", "#e3e3df", "#fff0b3", "#fed976", "#fdae61",
                                "#f46d43", "#d73027", "#a50026", "#67001f"][:len(DEMANDS) - 1], extend="both")
    contours.cmap.set_under("#f4f4f2")
    contours.cmap.set_over("#4a0016")
    for level in (1., 2.):
        if values.min() < level < values.max():
            axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=[level], colors="k", linewidths=1.2)
    finish_face(axes, run, name, ratio, lambda k: f"max {ratio[k]:.2f}")
    return contours


def finish_face(axes, run, name, values, words):
    """Draws the outline and the joints of a face, and marks the largest of the values away from the base with words(its node), the banks and the
    side of the view."""
    face = run.faces[name]
    s, z = face["s"], face["z"]
    outline, joints = edges(np.stack([s, z], axis=1), np.stack([face["x"], face["y"], z], axis=1), face["quads"])
    axes.add_collection(LineCollection(joints, colors="k", linewidths=0.5))
    axes.add_collection(LineCollection(outline, colors="k", linewidths=1.1, capstyle="round"))
    width, height = np.ptp(s), np.ptp(z)
    away = away_from_base(run)[name]
    if away.any():
        worst = np.flatnonzero(away)[values[away].argmax()]
        text = f"{words(worst)} at s = {s[worst] + 0.:.0f} m, z = {z[worst] + 0.:.0f} m"
        axes.plot(s[worst], z[worst], marker="o", markersize=6, markerfacecolor="#ffd966", markeredgecolor="k", clip_on=False, zorder=5,
                  linestyle="none", label=minus(text).replace("\N{MINUS SIGN}0 m", "0 m"))
        axes.legend(loc="upper center", handletextpad=0.1, borderaxespad=0)
    right_first = np.cov(s, face["y"])[0, 1] > 0  # y points to the left bank
    banks = ("right bank", "left bank") if right_first else ("left bank", "right bank")
    for bank, place, side in zip(banks, (0.01, 0.99), ("left", "right")):
        axes.text(place, 0.985, bank, transform=axes.transAxes, ha=side, va="top", color="0.35", style="italic", fontsize="small")
    view = "downstream" if right_first else "upstream"
    axes.set(aspect="equal", xlabel=f"developed arc length s [m], seen from {view}", ylabel="elevation z [m]",
             xlim=(s.min() - 0.015 * width, s.max() + 0.015 * width),
             ylim=(z.min() - 0.03 * height, z.max() + 0.14 * height))
    axes.grid(False)


def stress_bar(figure, contours, axes, levels, kind="principal", **place):
    bar = figure.colorbar(contours, ax=axes, orientation="horizontal", ticks=levels, **place)
    bar.set_label(f"{kind} stress, tension positive [MPa]")
    return bar


def demand_bar(figure, contours, axes, **place):
    bar = figure.colorbar(contours, ax=axes, orientation="horizontal", ticks=DEMANDS, **place)
    bar.set_label("largest principal stress over static tensile strength [-]")
    return bar


DEMANDS = np.array([0., .5, 1., 1.2, 1.4, 1.6, 1.8, 2., 3., 4.])


def draw_overstress(axes, run):
    """Cumulative duration of overstress over the demand-capacity ratio, against what is allowed: by the scene, else by the guide."""
    found = run.summary.get("overstress")
    if not found or not run.moves:
        raise Skip("no static tensile strength is given (Limits/Static tensile strength)" if run.moves else "the run is of the static state alone")
    for name, colour in FACES.items():
        duration = found[name].get("duration_away_from_base", found[name]["duration"])  # the latter of earlier versions
        axes.plot(found["levels"], duration, color=colour, marker="o", markersize=3, label=name)
    allowed = run.limit("Overstress duration")
    axes.plot([1., 2.], [allowed or .4, 0.], **LIMIT, label="allowed" if allowed > 0. else "USACE EM 1110-2-6053")
    axes.set(xlabel="principal stress over static tensile strength [-]", ylabel="cumulative duration [s]", xlim=(0.98, 2.02))
    axes.set_ylim(bottom=0.)
    axes.legend(loc="upper right")


# ---------------------------------------------------------------- joints

def crest_values(run, quantity):
    """Face -> the largest at the crest [mm], joint by joint; of lift joints the largest of all points."""
    values = {face: 1e3 * np.abs(run.joints[f"{quantity}_{face}"]) for face in FACES}
    is_lift = np.array([run.joint_name(joint).startswith("lift") for joint in run.joints["joint"]])
    if is_lift.any():
        points = run.table("joint_points.csv")
        for row in np.flatnonzero(is_lift):
            largest = 1e3 * points[f"max_{quantity}"][points["joint"] == run.joints["joint"][row]].max(initial=0.)
            for face in FACES:
                values[face][row] = largest
    return values


def common_top(runs, quantity):
    return max(max(values.max() for values in crest_values(run, quantity).values()) for run in runs)


def draw_crest_bars(axes, run, quantity, top, limit=0.):
    """The largest openings or slips at the crest, bars on both faces of each joint."""
    of_part = [run.joint_name(joint, short=True) for joint in run.joints["joint"].astype(int)]
    names = list(dict.fromkeys(name.split(".")[0] for name in of_part))  # of joints whose parts have one bar
    number = np.arange(1, len(names) + 1)
    for k, (face, of_parts) in enumerate(crest_values(run, quantity).items()):
        values = np.array([max(v for v, part in zip(of_parts, of_part) if part.split(".")[0] == name) for name in names])
        axes.bar(number + (k - 0.5) * 0.4, values, 0.38, color=FACES[face],
                 label=f"{face}: {values.max():.1f} mm at {run.joint_name(run.joints['joint'][of_parts.argmax()])}")
        if (bar := run.error_bars[0].get(f"max_{quantity}")) and values.max() == common_top([run], quantity):
            show_error_bar(axes, number[values.argmax()] + (k - 0.5) * 0.4, values.max(), bar)
            top = max(top, values.max() * bar["high"] / bar["value"])
    show_limit(axes, 1e3 * limit, "mm", top)
    every = -(-len(number) // 15)
    axes.set_xticks(number[::every], names[::every])
    last = sum(name[0].isdigit() for name in of_part if "." not in name) - 1  # of the contraction joints
    order = "right bank to the left" if run.joints["s"][0] <= run.joints["s"][max(last, 0)] else "left bank to the right"
    kinds = {"l": "lift joints, largest of all points", "b": "base joint"}
    others = "".join(f"; {kind}: {text}" for kind, text in kinds.items() if any(name[0] == kind for name in names))
    axes.set(xlabel=f"joint, from the {order}" + others, ylabel=f"maximum {quantity} [mm]")
    axes.set_ylim(0, 1.42 * max(top, 1e3 * limit if 1e3 * limit < 2. * top else 0.) or 1)
    axes.grid(False, axis="x")
    axes.legend(loc="upper left", handletextpad=0.4, borderaxespad=0.2)


def show_error_bar(axes, x, value, bar):
    """The relative error bar of a largest value (see error_bars.py) at a point of a figure."""
    below, above = (abs(value) * abs(bar[end] / bar["value"] - 1.) for end in ("low", "high"))
    axes.errorbar([x], [value], [[below], [above]] if value >= 0. else [[above], [below]], color="black", capsize=3, linewidth=1.2, zorder=5)


def show_limit(axes, limit, unit, top):
    """A dashed line at a limit that there is; where it is far above, in words."""
    if 0. < limit < 2. * top:
        axes.axhline(limit, **LIMIT, zorder=1, label=f"limit {limit:g} {unit}")
    elif limit > 0.:
        axes.plot([], [], **LIMIT, label=f"limit {limit:g} {unit}, above the figure")


def worst_joints(run, count):
    """Numbers of the joints that open most at the crest, the worst first."""
    table = run.joint_history
    largest = {int(name.rsplit("_", 1)[1]): max(table[name].max(), table[name.replace("upstream", "downstream")].max())
               for name in table if name.startswith("opening_upstream_")}
    if not largest:
        raise Skip("joint_history.csv names no joints")
    return sorted(largest, key=lambda joint: -largest[joint])[:count]


def draw_joint_history(axes, run, joint, quantity="opening"):
    """Opening or slip of one joint at the crest, both faces."""
    table, largest = run.joint_history, 0.
    for face, colour in FACES.items():
        values = 1e3 * table[f"{quantity}_{face}_{joint}"]
        largest = max(largest, values.max())
        axes.plot(table["time"], values, color=colour, linewidth=0.9, label=face)
    note(axes, f"{run.joint_name(joint)}: {largest:.1f} mm")
    axes.yaxis.set_major_locator(MaxNLocator(4))
    axes.set_xlim(table["time"][0], table["time"][-1])
    return largest


# ---------------------------------------------------------------- histories

def draw_crest(axes, runs):
    """Displacement of the crown's crest over time, of all runs; the extremes of a single one."""
    for number, run in enumerate(runs):
        time, crest = run.history["time"], 1e3 * run.history["crest_x"]
        axes.plot(time, crest, **line(number), linewidth=0.9, label=run.name)
        if bar := run.error_bars[0].get("crest_displacement"):
            peak = abs(crest).argmax()
            show_error_bar(axes, time[peak], crest[peak], bar)
        for peak, place in ((crest.argmax(), "bottom"), (crest.argmin(), "top")) if len(runs) == 1 else ():
            axes.plot(time[peak], crest[peak], "o", color="k", markersize=3.5)
            axes.annotate(minus(f"{crest[peak]:.1f} mm at {time[peak]:.2f} s"), (time[peak], crest[peak]), ha="center", va=place,
                          xytext=(0, 4 if place == "bottom" else -4), textcoords="offset points", fontsize="small")
    axes.margins(x=0, y=0.17)
    axes.set_ylabel("crest [mm]")
    if len(runs) > 1:
        axes.legend(loc="lower right", ncol=3, bbox_to_anchor=(1, 1), borderaxespad=0.2)


def draw_base(axes, run, direction, largest):
    column = run.base_acceleration[direction]
    axes.plot(run.history["time"], column, color="0.25", linewidth=0.6)
    axes.set_ylim(-1.15 * largest, 1.15 * largest)
    axes.set_ylabel(f"{DIRECTIONS[direction]}\n[m/s²]")
    note(axes, f"peak {np.abs(column).max():.2f} m/s²")
    axes.margins(x=0)


def moving(table):
    """Components of the motion that are not at rest: letters of DIRECTIONS."""
    return [direction for direction in DIRECTIONS if np.any(table[f"spectrum_{direction}"])]


def draw_spectra(axes, table, directions):
    """Response spectra of components of the motion in one axes, with RotD50 and RotD100 if these are both horizontal ones, and their targets."""
    rotated = {name: name.lower() for name in ("RotD50", "RotD100") if {"x", "y"} <= set(directions) and name.lower() in table}
    for number, (name, column) in enumerate([*((name, f"spectrum_{d}") for d, name in DIRECTIONS.items()), *rotated.items()]):
        if name in rotated or column[-1] in directions:
            axes.loglog(table["period"], table[column], **{**line(number), "linewidth": 0.7 if rotated and column[-1] in "xy" else 1.3}, label=name)
    targets = {column.tobytes(): column for d in directions if (column := table.get(f"target_{d}")) is not None}
    for number, target in enumerate(targets.values()):
        axes.loglog(table["period"], target, color="k", linewidth=1.3, linestyle=(0, (4, 2)), zorder=3, label=None if number else "target")
    show_periods(axes, table["period"])
    axes.legend(loc="lower left", borderaxespad=0.2, ncol=1 + bool(rotated))


def draw_floor_spectra(axes, table, direction):
    """Response spectra of the crest and the probes in a direction, that of the ground as a thin line."""
    period = table["period"]
    names = [name[:-2] for name in table if name.endswith(f"_{direction}") and name != f"ground_{direction}"]
    for name, colour in zip(names, COLOURS * len(names)):
        axes.loglog(period, table[f"{name}_{direction}"], color=colour, linewidth=1.1, label=name.replace("_", " "))
    axes.loglog(period, table[f"ground_{direction}"], color="k", linewidth=0.5, label="ground")
    show_periods(axes, period)
    note(axes, DIRECTIONS[direction])


def show_periods(axes, period):
    axes.set(xlabel="period [s]", xlim=(period[0], period[-1]))
    axes.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    axes.xaxis.set_minor_formatter(NullFormatter())


def energy_parts(run):
    parts = [name for name in ENERGIES if name in run.energy]
    return parts, max(np.abs(run.energy[name]).max() for name in parts) or 1.


def energy_unit(largest):
    return next((pair for pair in (("GJ", 1e9), ("MJ", 1e6), ("kJ", 1e3)) if largest >= pair[1]), ("J", 1.))


def draw_energy(axes, run, largest):
    """Energies over time; on rock also what has gone through the artificial boundary."""
    unit, scale = energy_unit(largest)
    for number, name in enumerate(energy_parts(run)[0]):
        if np.any(run.energy[name]):
            label = "radiated" if name == "transmitted" else name.replace("_", " ")
            style = {"color": "k", "linewidth": 1.6} if name == "input" else {**line(number - 1), "linewidth": 1.}
            if name in ("damping", "friction", "impact"):
                style["linestyle"] = "--"
            axes.plot(run.energy["time"], run.energy[name] / scale, label=label, **style)
    axes.set_ylabel(f"energy [{unit}]")
    axes.margins(x=0)


def imbalance(run):
    """Largest |balance| over the largest energy, as the log and the summary define it."""
    scale = run.summary.get("largest_energy") or energy_parts(run)[1]
    return run.energy["balance"] / scale
