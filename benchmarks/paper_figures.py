# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures laid out as the paper's, for benchmarks/paper.py."""

import numpy as np

from paper_run import FACES, LIMIT, upper_part
from voussoir.drawing import LineCollection, edges, plt, triangles
from voussoir.tables import read_table

COLOURS = {"FJA": "#0b5394", "FJB": "#cc4125", "KSM": "#6aa84f"}
BENEATH = {"color": "#e6a194", "linewidth": 3.2}  # FJB where KSM is drawn over it, and may cover it
OTHERS = ["#7f7f7f", "#b45f06", "#674ea7"]
LEVELS = [0., .5, 1., 1.5, 2., 3., 4., 6., 8., 12.]  # MPa, in all figures


def colour_of(law, number):
    return COLOURS.get(law[:3], OTHERS[number % len(OTHERS)])


class Envelope:
    """The largest tension [MPa] on one face."""

    def __init__(self, nodes, quads, tension, face):
        mine = nodes["face"] == face
        self.x, self.y, self.z, self.s = (nodes[key][mine] for key in ("x", "y", "z", "s"))
        self.value, self.face = tension[mine], face
        self.quads = (np.cumsum(mine) - 1)[quads[mine[quads[:, 0]]]]

    def draw(self, axes):
        drawn = np.stack([self.s, self.z], axis=1)
        points, corners = triangles(drawn, self.quads)
        values = np.concatenate([self.value, self.value[self.quads].mean(axis=1)])
        reds = plt.get_cmap("YlOrRd")(np.linspace(0., 1., len(LEVELS)))
        contours = axes.tricontourf(points[:, 0], points[:, 1], corners, values, levels=LEVELS,
                                    colors=np.vstack([[[.75, .85, .95, 1.]], reds]), extend="both")
        axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=LEVELS, colors="0.35", linewidths=0.2)
        axes.tricontour(points[:, 0], points[:, 1], corners, values, levels=[LIMIT], colors="k", linewidths=0.9)
        outline, joints = edges(drawn, np.stack([self.x, self.y, self.z], axis=1), self.quads)
        axes.add_collection(LineCollection(joints, colors="k", linewidths=0.5, capstyle="projecting"))
        axes.add_collection(LineCollection(outline, colors="k", linewidths=1.1, capstyle="projecting"))
        margin = .03 * np.ptp(self.z)
        axes.set(aspect="equal", xlim=(self.s.min() - margin, self.s.max() + margin), ylim=(self.z.min() - margin, self.z.max() + margin))
        axes.grid(False)
        return contours

    def upper(self):
        return self.value[upper_part(self.z, self.s)].mean()


def envelopes(rows, title, path):
    """`rows`: law -> envelopes side by side. The same levels in all of them."""
    n, m = len(rows), max(len(row) for row in rows.values())
    figure, grid = plt.subplots(n, m, figsize=(6.2 * m, 2.55 * n + 1.3), sharex=True, sharey=True, squeeze=False,
                                constrained_layout=True)
    for axes_row, (law, row) in zip(grid, rows.items()):
        for axes, envelope in zip(axes_row, row):
            contours = envelope.draw(axes)
            axes.set_title(f"{law}, {envelope.face}; mean of the upper part {envelope.upper():.1f} MPa", fontsize=9, loc="left")
        axes_row[0].set_ylabel("z [m]")
    for axes in grid[-1]:
        axes.set_xlabel("developed arc length s [m], from the right bank to the left")
    figure.suptitle(title, fontsize=11)
    bar = figure.colorbar(contours, ax=grid.ravel().tolist(), orientation="horizontal", aspect=50, ticks=LEVELS)
    bar.set_label("largest principal stress, tension positive [MPa]; heavy line: 1.5 MPa")
    figure.savefig(path, dpi=80)
    plt.close(figure)


def bars(values, names, ylabel, path, xlabel="joint", spread=True):
    """`values`: law -> (motion, joint, face) [mm]: bars of the means, from the smallest to the largest as a line."""
    values = {law: np.asarray(v) for law, v in values.items()}
    figure, both = plt.subplots(1, 2, figsize=(max(8., .56 * len(names) + 3.), 3.1), sharey=True)
    width = .8 / len(values)
    for f, axes in enumerate(both):
        for k, (law, v) in enumerate(values.items()):
            place = np.arange(len(names)) + (k - (len(values) - 1) / 2) * width
            mean = v[:, :, f].mean(axis=0)
            axes.bar(place, mean, .92 * width, color=colour_of(law, k), label=law)
            if spread and len(v) > 1:
                reach = [mean - v[:, :, f].min(axis=0), v[:, :, f].max(axis=0) - mean]
                axes.errorbar(place, mean, np.maximum(reach, 0.), fmt="none", ecolor="0.25", elinewidth=.9, capsize=1.5)
        axes.set_xticks(range(len(names)), names)
        axes.set(title=f"({'ab'[f]}) {FACES[f]}", xlabel=xlabel)
        axes.grid(False, axis="x")
    both[0].set_ylabel(ylabel)
    both[0].set_ylim(bottom=0)
    figure.legend(*both[0].get_legend_handles_labels(), loc="lower center", ncol=len(values), bbox_to_anchor=(.5, .98))
    figure.subplots_adjust(wspace=.06)
    figure.savefig(path, dpi=80)
    plt.close(figure)


def crest(runs, what):
    """case -> the runs' openings or slips, (motion, joint, face)"""
    return np.array([getattr(run, what) for run in runs.values()])


def profiles(directories, title, path):
    """`directories`: law -> of a run with profile.csv. Opening over height, a panel for each joint."""
    tables = {law: read_table(directory / "profile.csv") for law, directory in directories.items()
              if (directory / "profile.csv").exists()}
    if not tables:
        return
    joints = np.unique(next(iter(tables.values()))["joint"]).astype(int)
    names = [chr(ord("A") + j) for j in range(len(joints))] if len(joints) > 5 else [str(j) for j in joints]
    columns = min(len(joints), 9)
    rows = -(-len(joints) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(1.25 * columns + 1.5, 2.9 * rows), sharex=True, sharey=True,
                                squeeze=False, constrained_layout=True)
    for axes in grid.ravel()[len(joints):]:
        axes.set_visible(False)
    for axes, joint, name in zip(grid.ravel(), joints, names):
        for k, (law, table) in enumerate(tables.items()):
            style = BENEATH if law == "FJB" and "KSM" in tables else {"color": colour_of(law, k), "linewidth": 1.2}
            for face, line in zip(FACES, ("-", "--")):
                mine = (table["joint"] == joint) & (table["face"] == face)
                order = np.argsort(table["z"][mine])
                axes.plot(1e3 * table["opening"][mine][order], table["z"][mine][order], line, label=f"{law}, {face}", **style)
        axes.set_title(name, fontsize=10)
    grid[0, 0].set_xlim(left=0)
    for axes in grid[:, 0]:
        axes.set_ylabel("z [m]")
    figure.supxlabel("largest opening [mm]", fontsize=11)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="lower center", ncol=len(tables), fontsize=9, title=title,
                  bbox_to_anchor=(.5, 1.01))
    figure.savefig(path, dpi=80)
    plt.close(figure)


def layout(run, path):
    """The joints and their letters on the upstream face, with the mesh."""
    envelope = Envelope(run.nodes, run.quads, run.tension, "upstream")
    drawn = np.stack([envelope.s, envelope.z], axis=1)
    figure, axes = plt.subplots(figsize=(8, 3.6))
    outline, joints = edges(drawn, np.stack([envelope.x, envelope.y, envelope.z], axis=1), envelope.quads)
    axes.add_collection(LineCollection(drawn[np.vstack([envelope.quads.T, envelope.quads[:, 0]]).T], colors="0.7", linewidths=.4))
    axes.add_collection(LineCollection(joints, colors=COLOURS["FJB"], linewidths=1.6))
    axes.add_collection(LineCollection(outline, colors="k", linewidths=1.3))
    height, top = np.ptp(drawn[:, 1]), drawn[:, 1].max()
    tops = sorted({round(float(edge[np.argmax(edge[:, 1]), 0]), 1) for edge in joints if edge[:, 1].max() > top - 5e-4 * height})
    for k, s in enumerate(tops):
        axes.text(s, top + .03 * height, chr(ord("A") + k), ha="center", color=COLOURS["FJB"])
    axes.set(aspect="equal", xlim=(drawn[:, 0].min() - .04 * height, drawn[:, 0].max() + .04 * height),
             ylim=(drawn[:, 1].min() - .03 * height, top + .11 * height), ylabel="z [m]",
             xlabel="developed arc length s [m], from the right bank to the left")
    axes.grid(False)
    figure.savefig(path, dpi=80)
    plt.close(figure)


def key_sketch(path):
    """Sections through a joint, not to scale: flat, and with the rectangular key of 20 cm."""
    figure, both = plt.subplots(1, 2, figsize=(7, 2.4))
    for axes, key, title in zip(both, (0., 1.), ("flat joint: FJA slides, FJB does not", "KSM: one key, 20 cm high")):
        joint = np.array([[0, 0], [0, 1.], [key, 1.], [key, 2.], [0, 2.], [0, 3.]])
        for gap, side in ((-.06, -3.), (.06, 3.)):
            edge = joint + [gap, 0.]
            axes.fill(np.append(edge[:, 0], [side, side]), np.append(edge[:, 1], [3., 0.]), color="0.85")
            axes.plot(edge[:, 0], edge[:, 1], color="k", linewidth=1.2)
        if key:
            axes.annotate("", (0, 2.25), (key, 2.25), arrowprops={"arrowstyle": "<->"})
            axes.text(1.1, 2.33, "20 cm")
        axes.text(-2.9, .1, "upstream")
        axes.text(-2.9, 2.7, "downstream")
        axes.set_title(title, fontsize=10)
        axes.axis("off")
    figure.savefig(path, dpi=80)
    plt.close(figure)


def mean_envelopes(runs, faces=FACES):
    """Of the runs of one case, which have one mesh."""
    first, tension = next(iter(runs.values())), np.mean([run.tension for run in runs.values()], axis=0)
    return [Envelope(first.nodes, first.quads, tension, face) for face in faces]


def draw(runs, output, directory):
    """All figures of doc/paper.md that can be made of these runs (of paper.py: case -> motion -> Run)."""
    directory.mkdir(parents=True, exist_ok=True)
    rock = {law: runs[f"3.1_{law.lower()}"] for law in ("FJA", "FJB") if f"3.1_{law.lower()}" in runs}
    rigid = {law: runs[f"3.2_{law.lower()}"] for law in ("FJA", "FJB", "KSM") if f"3.2_{law.lower()}" in runs}
    rock_labelled, rigid_labelled = ({f"{law} ({len(by_seed)} motion{'s' * (len(by_seed) > 1)})": by_seed
                                      for law, by_seed in laws.items()} for laws in (rock, rigid))
    key_sketch(directory / "paper_fig5.png")
    if rock:
        letters = [chr(ord("A") + j) for j in range(17)]
        layout(next(iter(next(iter(rock.values())).values())), directory / "paper_fig1.png")
        envelopes({law: mean_envelopes(by_seed) for law, by_seed in rock_labelled.items()},
                  "Section 3.1, 17 joints on rock: envelopes, means over the motions", directory / "paper_fig2_3.png")
        bars({law: crest(by_seed, "openings") for law, by_seed in rock_labelled.items()}, letters, "largest opening [mm]",
             directory / "paper_fig4.png")
        profiles({law: output / f"3.1_{law.lower()}" / "seed_1" for law in rock},
                 "Section 3.1: opening over height, motion 1", directory / "paper_profile_3_1.png")
    if rigid:
        names = [str(j) for j in range(1, 6)]
        for face, name in zip(FACES, ("paper_fig6_8.png", "paper_fig6_8_downstream.png")):
            envelopes({law: mean_envelopes(by_seed, [face]) for law, by_seed in rigid_labelled.items()},
                      "Section 3.2, 5 joints, rigid base: means over the motions", directory / name)
        for what, name in (("openings", "paper_fig9.png"), ("slips", "paper_fig10.png")):
            bars({law: crest(by_seed, what) for law, by_seed in rigid_labelled.items()}, names, f"largest {what[:-1]} [mm]",
                 directory / name)
        profiles({law: output / f"3.2_{law.lower()}" / "seed_1" for law in rigid},
                 "Section 3.2: opening over height, motion 1", directory / "paper_profile_3_2.png")
