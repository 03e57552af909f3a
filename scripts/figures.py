#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes OUTPUT_DIR/figures/*.png from the output directory of one run of voussoir.

    scripts/figures.py OUTPUT_DIR

envelope_{upstream,downstream}[_compression].png   principal stress over the run, developed elevation views
openings.png, slips.png                            maxima at the crest, joint by joint
history.png, joint_history.png                     crest and base; the joints that open most
energy.png                                         energies and their balance

Figures whose data are missing are skipped with a message.
Exit status: 0 done, 1 some data could not be understood, 2 not an output directory, 3 no numpy or matplotlib.
"""

import csv
import json
import re
import sys
from collections import Counter
from pathlib import Path

try:
    import numpy as np
    import matplotlib
except ImportError as error:
    print(f"{sys.executable}: {error}")
    sys.exit(3)

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (after the choice of the backend)
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402

UPSTREAM, DOWNSTREAM = "#0b5394", "#cc4125"
COLOURS = ["#0b5394", "#cc4125", "#38761d", "#b45f06", "#674ea7", "#45818e", "#7f6000"]
N_WORST_JOINTS = 4

plt.rcParams.update({
    "font.size": 11, "axes.titlesize": 12, "axes.labelsize": 11, "legend.fontsize": 10, "legend.frameon": False,
    "axes.grid": True, "grid.linewidth": 0.4, "grid.color": "0.85", "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 180, "savefig.bbox": "tight"})


class Skip(Exception):
    """A figure that cannot be made because its data are not there."""


def minus(text):
    """With the typographic minus of the axes."""
    return text.replace("-", "\N{MINUS SIGN}")


def read_table(path, text_columns=()):
    """Columns of a .csv file by name; numbers, but for the named text columns."""
    if not path.exists():
        raise Skip(f"no {path.name}")
    with open(path, newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 2:
        raise Skip(f"{path.name} is empty")
    width = len(rows[0])
    if len(rows[-1]) < width:  # a run that was stopped while it wrote
        rows.pop()
    columns = {name.strip(): column for name, column in zip(rows[0], zip(*rows[1:]))}
    return {name: np.array(column) if name in text_columns else np.array(column, dtype=float)
            for name, column in columns.items()}


def read_history(path):
    """The same, of a table over time."""
    table = read_table(path)
    if len(table["time"]) < 2:
        raise Skip(f"{path.name} holds a single time")
    return table


# ---------------------------------------------------------------- envelopes

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


def round_levels(values):
    """Round contour levels between the 1st and 99th percentile (a heel is singular), and zero among them."""
    low, high = np.percentile(values, [1, 99])
    low, high = min(low, 0.), max(high, 0.)
    if high - low < 1e-3:
        low, high = low - 0.1, high + 0.1
    return MaxNLocator(nbins=10, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)


def draw_envelope(face, cells, levels, tension, title, path):
    """One face: s, z [m] and the stress [MPa] at the nodes."""
    s, z, stress = face["s"], face["z"], face["stress"]
    points, corners = triangles(np.stack([s, z], axis=1), cells)
    values = np.concatenate([stress, stress[cells].mean(axis=1)])

    # Red is tension, blue compression, white zero, whatever the range; colours beyond it for `extend`.
    step = levels[1] - levels[0]
    middles = np.append(levels - step / 2, levels[-1] + step / 2)
    colours = plt.get_cmap("RdBu_r")(0.5 + 0.5 * middles / np.abs(middles).max())

    width, height = np.ptp(s), np.ptp(z)
    figure, axes = plt.subplots(figsize=(10, 2.3 + 8.8 * height / width))
    contours = axes.tricontourf(points[:, 0], points[:, 1], corners, values, levels=levels, colors=colours,
                                extend="both")
    axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=levels, colors="0.35", linewidths=0.25,
                    linestyles="solid")
    outline, joints = edges(np.stack([s, z], axis=1), np.stack([face["x"], face["y"], z], axis=1), cells)
    axes.add_collection(LineCollection(joints, colors="k", linewidths=0.6))
    axes.add_collection(LineCollection(outline, colors="k", linewidths=1.3, capstyle="round"))

    worst = np.argmax(stress) if tension else np.argmin(stress)
    name = "max" if tension else "min"
    axes.plot(s[worst], z[worst], marker="o", markersize=7, markerfacecolor="#ffd966", markeredgecolor="k",
              clip_on=False, zorder=5, linestyle="none",
              label=minus(f"{name} {stress[worst]:.2f} MPa at s = {s[worst]:.0f} m, z = {z[worst]:.0f} m"))
    axes.legend(loc="upper center", handletextpad=0.1, borderaxespad=0)
    right_first = np.cov(s, face["y"])[0, 1] > 0  # y points to the left bank
    banks = ("right bank", "left bank") if right_first else ("left bank", "right bank")
    for bank, place, side in zip(banks, (0.01, 0.99), ("left", "right")):
        axes.text(place, 0.98, bank, transform=axes.transAxes, ha=side, va="top", color="0.35", style="italic")
    view = "downstream" if right_first else "upstream"
    axes.set(aspect="equal", xlabel=f"developed arc length s [m], seen from {view}", ylabel="elevation z [m]",
             xlim=(s.min() - 0.015 * width, s.max() + 0.015 * width),
             ylim=(z.min() - 0.03 * height, z.max() + 0.14 * height))
    axes.set_title(title, pad=10)
    axes.grid(False)
    bar = figure.colorbar(contours, ax=axes, orientation="horizontal", fraction=0.05, pad=0.16, aspect=45,
                          ticks=levels)
    bar.set_label("principal stress, tension positive [MPa]")
    figure.savefig(path)
    plt.close(figure)


def envelopes(output, figures, heading):
    nodes = read_table(output / "faces.csv", ["face"])
    cells = read_table(output / "faces_cells.csv", ["face"])
    quads = np.stack([cells[f"n{i}"] for i in range(4)], axis=1).astype(int)
    for column, tension, suffix in (("max_principal", True, ""), ("min_principal", False, "_compression")):
        stress = nodes[column] / 1e6
        if not np.isfinite(stress).all():
            raise ValueError(f"faces.csv: column {column} holds values that are not numbers")
        levels = round_levels(stress)  # the same for both faces, so that they can be compared
        for name in ("upstream", "downstream"):
            mine = nodes["face"] == name
            if not mine.any():
                print(f"figures: skipped envelope_{name}{suffix}.png: no such face in faces.csv")
                continue
            number = np.cumsum(mine) - 1  # line in the file -> number on this face
            face = {key: nodes[key][mine] for key in ("x", "y", "z", "s")}
            face["stress"] = stress[mine]
            kind = "maximum principal stress" if tension else "minimum principal stress"
            draw_envelope(face, number[quads[cells["face"] == name]], levels, tension,
                          f"{heading}\n{name.capitalize()} face: envelope of {kind}",
                          figures / f"envelope_{name}{suffix}.png")


# ---------------------------------------------------------------- joints

def crest_maxima(output, figures, heading):
    joints = read_table(output / "joints.csv")
    order = np.argsort(joints["s"])
    s, number = joints["s"][order], joints["joint"][order].astype(int)
    for quantity, name in (("opening", "openings"), ("slip", "slips")):
        figure, axes = plt.subplots(figsize=(8, 4))
        largest = 0.
        for face, colour, marker in (("upstream", UPSTREAM, "o"), ("downstream", DOWNSTREAM, "s")):
            value = 1e3 * np.abs(joints[f"{quantity}_{face}"][order])
            largest = max(largest, value.max())
            axes.plot(s, value, color=colour, marker=marker, markersize=5, linewidth=1.4,
                      label=f"{face}: {value.max():.1f} mm at joint {number[value.argmax()]}")
        axes.set(xlabel="arc length along the crest s [m]", ylabel=f"maximum {quantity} [mm]")
        axes.set_ylim(0, 1.25 * largest if largest > 0 else 1)
        axes.legend(loc="upper left", ncol=2, handletextpad=0.4, columnspacing=1.2)
        top = axes.secondary_xaxis("top")
        every = -(-len(number) // 15)
        top.set_xticks(s[::every], [str(n) for n in number[::every]])
        top.set_xlabel("joint")
        axes.set_title(f"{heading}\nMaximum joint {quantity} at the crest")
        figure.savefig(figures / f"{name}.png")
        plt.close(figure)


def joint_history(output, figures, heading):
    table = read_history(output / "joint_history.csv")
    numbers = [int(match[1]) for name in table if (match := re.fullmatch(r"opening_upstream_(\d+)", name))]
    if not numbers:
        raise Skip("joint_history.csv names no joints")

    def openings(joint):
        return [1e3 * table[f"opening_{face}_{joint}"] for face in ("upstream", "downstream")]

    worst = sorted(numbers, key=lambda joint: -np.max(openings(joint)))[:N_WORST_JOINTS]
    largest = max(np.max(openings(joint)) for joint in worst)
    figure, rows = plt.subplots(len(worst), 1, sharex=True, sharey=True, squeeze=False,
                                figsize=(9, 1.2 + 1.5 * len(worst)))
    for axes, joint in zip(rows[:, 0], worst):
        upstream, downstream = openings(joint)
        axes.plot(table["time"], upstream, color=UPSTREAM, linewidth=1.1, label="upstream")
        axes.plot(table["time"], downstream, color=DOWNSTREAM, linewidth=1.1, label="downstream")
        axes.text(0.995, 0.93, f"joint {joint}: {max(upstream.max(), downstream.max()):.1f} mm",
                  transform=axes.transAxes, ha="right", va="top",
                  bbox={"facecolor": "w", "edgecolor": "none", "pad": 1})
        axes.yaxis.set_major_locator(MaxNLocator(4))
    rows[0, 0].set_ylim(-0.04 * largest, 1.3 * largest if largest > 0 else 1)
    rows[0, 0].set_xlim(table["time"][0], table["time"][-1])
    rows[0, 0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2)
    rows[0, 0].set_title(f"{heading}\nOpenings at the crest, the joints that open most", loc="left")
    rows[-1, 0].set_xlabel("time [s]")
    figure.supylabel("opening [mm]", fontsize=11, x=0.06)
    figure.savefig(figures / "joint_history.png")
    plt.close(figure)


# ---------------------------------------------------------------- histories

def history(output, figures, heading):
    table = read_history(output / "history.csv")
    time, crest = table["time"], 1e3 * table["crest_x"]
    base = {}  # direction -> acceleration
    for name, column in table.items():
        match = re.fullmatch(r"(?:base_a|base_acceleration_|a_)([xyz])", name.lower())
        if match and np.any(column):
            base[match[1]] = column
    figure, rows = plt.subplots(1 + len(base), 1, sharex=True, squeeze=False, figsize=(9, 3.4 + 1.5 * len(base)),
                                gridspec_kw={"height_ratios": [2] + [1] * len(base)})
    axes = rows[0, 0]
    axes.plot(time, crest, color=UPSTREAM, linewidth=1.1)
    for peak, place in ((crest.argmax(), "bottom"), (crest.argmin(), "top")):
        axes.plot(time[peak], crest[peak], "o", color="k", markersize=4)
        axes.annotate(minus(f"{crest[peak]:.1f} mm"), (time[peak], crest[peak]), ha="center", va=place,
                      xytext=(0, 5 if place == "bottom" else -5), textcoords="offset points")
    axes.margins(y=0.15)
    axes.set_ylabel("crest, relative\nto the base [mm]")
    axes.set_title(f"{heading}\nCrown crest, downstream positive, and base acceleration", loc="left")
    names = {"x": "stream", "y": "cross", "z": "vertical"}
    largest = max((np.abs(column).max() for column in base.values()), default=0)
    for axes, direction in zip(rows[1:, 0], sorted(base)):
        axes.plot(time, base[direction], color="0.25", linewidth=0.8)
        axes.set_ylim(-1.15 * largest, 1.15 * largest)
        axes.set_ylabel(f"{names[direction]}\n[m/s²]")
        axes.text(0.995, 0.95, f"peak {np.abs(base[direction]).max():.2f} m/s²", transform=axes.transAxes,
                  ha="right", va="top", bbox={"facecolor": "w", "edgecolor": "none", "pad": 1})
    rows[0, 0].set_xlim(time[0], time[-1])
    rows[-1, 0].set_xlabel("time [s]")
    figure.align_ylabels(rows[:, 0])
    figure.savefig(figures / "history.png")
    plt.close(figure)


def energy(output, figures, heading):
    table = read_history(output / "energy.csv")
    time, balance = table["time"], table["balance"]
    parts = [name for name in ("input", "strain", "kinetic", "added_mass", "damping", "friction", "impact")
             if name in table]
    largest = max(np.abs(table[name]).max() for name in parts) or 1.
    summary = json.loads((output / "summary.json").read_text())
    scale_of_balance = summary.get("largest_energy") or largest  # as the log and the summary define it
    unit, scale = next((pair for pair in (("GJ", 1e9), ("MJ", 1e6), ("kJ", 1e3)) if largest >= pair[1]), ("J", 1.))
    figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(9, 6), gridspec_kw={"height_ratios": [3, 1]})
    for name, colour in zip(parts, ["k"] + COLOURS):
        if np.any(table[name]):
            above.plot(time, table[name] / scale, color=colour, linewidth=1.8 if name == "input" else 1.1,
                       label=name.replace("_", " "))
    above.set_ylabel(f"energy [{unit}]")
    above.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    above.set_title(f"{heading}\nEnergies", loc="left")
    below.plot(time, 100 * balance / scale_of_balance, color="k", linewidth=1)
    below.text(1.02, 0.95, f"at most\n{np.abs(balance).max() / scale_of_balance:.1e}", transform=below.transAxes, va="top")
    below.set(xlabel="time [s]", ylabel="balance [% of\nlargest energy]", xlim=(time[0], time[-1]))
    below.ticklabel_format(axis="y", scilimits=(-2, 3), useMathText=True)
    figure.align_ylabels([above, below])
    figure.savefig(figures / "energy.png")
    plt.close(figure)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if "--help" in sys.argv or "-h" in sys.argv else 2
    output = Path(sys.argv[1])
    if not (output / "summary.json").exists():
        print(f"figures: error: {output} holds no summary.json, so it is not the output directory of a finished run.\n"
              "Give the directory that voussoir was told to write to with --output.", file=sys.stderr)
        return 2
    try:
        summary = json.loads((output / "summary.json").read_text())
    except ValueError as error:
        print(f"figures: error: {output / 'summary.json'} is not valid JSON: {error}", file=sys.stderr)
        return 2
    scene, law = str(summary.get("scene", output.name)), str(summary.get("law", ""))
    scene = Path(scene).stem if scene.endswith(".prm") else scene
    heading = f"{scene}, {law}" if law else scene
    figures = output / "figures"
    figures.mkdir(exist_ok=True)

    todo = [envelopes, history, energy]
    if law.lower() == "tied":
        print("figures: tied dam, no figures of joints")
    else:
        todo += [crest_maxima, joint_history]
    status = 0
    for make in todo:
        try:
            make(output, figures, heading)
        except Skip as reason:
            print(f"figures: skipped {make.__name__}: {reason}")
        except (KeyError, ValueError, IndexError) as error:
            print(f"figures: error: {make.__name__}: {type(error).__name__}: {error}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
