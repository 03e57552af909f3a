#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's figures, several runs in one, for doc/rigid_base.md and doc/rock.md:

    benchmarks/paper_figures.py rigid_base FJA=DIR FJB=DIR KSM=DIR        [--output doc/figures]
    benchmarks/paper_figures.py rock 'rigid base=DIR' FJA=DIR FJB=DIR

DIR are the output directories; the first word begins the names of the figures.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import figures  # noqa: E402
from figures import plt, LineCollection  # noqa: E402

STYLES = [("#0b5394", "o", "-"), ("#cc4125", "s", "-"), ("k", "x", "--")]
LEVELS = np.arange(0., 13., 2.)


def stress(runs, name, path):
    """The envelopes of one face, one law below the other."""
    colours = plt.get_cmap("RdBu_r")(0.5 + 0.5 * np.append(LEVELS - 1., 13.) / 13.)
    figure, rows = plt.subplots(len(runs), 1, figsize=(7.5, 8.8), sharex=True, squeeze=False)
    rows = rows[:, 0]
    for axes, (law, run) in zip(rows, runs.items()):
        nodes = figures.read_table(run / "faces.csv", ["face"])
        cells = figures.read_table(run / "faces_cells.csv", ["face"])
        mine = nodes["face"] == name
        quads = np.stack([cells[f"n{i}"] for i in range(4)], axis=1).astype(int)[cells["face"] == name]
        quads = (np.cumsum(mine) - 1)[quads]
        x, y, z, s = (nodes[key][mine] for key in ("x", "y", "z", "s"))
        value = nodes["max_principal"][mine] / 1e6
        points, corners = figures.triangles(np.stack([s, z], axis=1), quads)
        values = np.concatenate([value, value[quads].mean(axis=1)])
        contours = axes.tricontourf(points[:, 0], points[:, 1], corners, values, levels=LEVELS, colors=colours,
                                    extend="both")
        axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=LEVELS, colors="0.35", linewidths=0.25)
        outline, joints = figures.edges(np.stack([s, z], axis=1), np.stack([x, y, z], axis=1), quads)
        axes.add_collection(LineCollection(joints, colors="k", linewidths=0.6))
        axes.add_collection(LineCollection(outline, colors="k", linewidths=1.2))
        worst, upper = value.argmax(), value[(z >= 150) & (np.abs(s) <= 150)].mean()
        axes.set_title(figures.minus(f"{law}: largest {value[worst]:.1f} MPa at s = {round(s[worst])} m, "
                                     f"z = {round(z[worst])} m; mean of the upper part {upper:.1f} MPa"),
                       fontsize=10, loc="left")
        axes.set(aspect="equal", ylabel="z [m]", xlim=(s.min() - 8, s.max() + 8), ylim=(-6, 216))
        axes.grid(False)
    rows[-1].set_xlabel("developed arc length s [m], seen from downstream")
    figure.suptitle(f"{name.capitalize()} face: envelope of the maximum principal stress", fontsize=11, y=0.94)
    bar = figure.colorbar(contours, ax=list(rows), orientation="horizontal", fraction=0.03, pad=0.1, aspect=45,
                          ticks=LEVELS)
    bar.set_label("principal stress, tension positive [MPa]")
    figure.savefig(path, dpi=90)
    plt.close(figure)


def crest(runs, quantity, path):
    figure, both = plt.subplots(1, 2, figsize=(8.5, 3.2), sharey=True)
    for face, axes in zip(("upstream", "downstream"), both):
        for (law, run), (colour, marker, line) in zip(runs.items(), STYLES):
            joints = figures.read_table(run / "joints.csv")
            axes.plot(joints["s"], 1e3 * np.abs(joints[f"{quantity}_{face}"]), color=colour, marker=marker,
                      linestyle=line, linewidth=1.4, markersize=7, label=law)
        axes.set(xlabel="arc length along the crest s [m]", title=face)
    top = both[0].get_ylim()[1]
    both[0].set_ylim(-0.03 * top, 1.03 * top)
    both[0].set_ylabel(f"largest {quantity} [mm]")
    figure.legend(*both[0].get_legend_handles_labels(), loc="lower center", ncol=3, bbox_to_anchor=(0.5, 0.98))
    figure.savefig(path, dpi=90)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name")
    parser.add_argument("runs", nargs="+", metavar="LABEL=DIR")
    parser.add_argument("--output", type=Path, default=ROOT / "doc" / "figures")
    options = parser.parse_args()
    if len(options.runs) > len(STYLES) or any("=" not in run for run in options.runs):
        parser.error(f"give one to {len(STYLES)} runs as LABEL=DIR")
    runs = {label: Path(directory) for label, directory in (run.split("=", 1) for run in options.runs)}
    options.output.mkdir(parents=True, exist_ok=True)
    for face in ("upstream", "downstream"):
        stress(runs, face, options.output / f"{options.name}_stress_{face}.png")
    for quantity in ("opening", "slip"):
        crest(runs, quantity, options.output / f"{options.name}_{quantity}s.png")


if __name__ == "__main__":
    main()
