#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of water on the dam arch210: results, frequencies and cost against Westergaard's added mass. Draws doc/figures/water.png.

    benchmarks/water.py [--scenes quickstart rigid28 ...] [--seconds 5] [--seeds 1 2 3] [--output output/water] [--figure FILE.png] [--voussoir PROGRAM]

Each row is a run over the strongest seconds of the motion of the scene, as in `voussoir needs`. Tension: largest value on the face,
away from the base. Frequencies: `voussoir modes` of the tied dam, on massless rock for scenes on rock. Cost: counted work per second of
earthquake, as in `voussoir needs`. The elements of acoustic water fit the time step of the dam: the larger one of a sixteenth of the depth
and 1.1 dt c. A model that the program refuses is a row with the reason.

Prints a Markdown table: means over the motions (seeds), and the smallest and largest change against Westergaard under the same motion. Existing runs
are not repeated; refused ones are. After a change of the program choose another --output.
"""

import argparse
import json
import os
from pathlib import Path

import matplotlib
import numpy as np

from program import ROOT, add_program_argument
from voussoir.errors import VoussoirError
from voussoir.needs_runs import Runs, slug
from voussoir.needs_verdicts import COLUMNS
from voussoir.palette import COLOURS
from voussoir.program import call, entries_of, set_options
from voussoir.results import Results
from voussoir.tables import read_table

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

TIED = {"Joints/Model": "tied"}
SCENES = {"quickstart": ("quickstart", {}), "quickstart, tied": ("quickstart", TIED), "rigid28": ("rigid28", {}), "rigid28, tied": ("rigid28", TIED),
          "rock28": ("rock28", {}), "rock28, tied": ("rock28", TIED)}
ACOUSTIC = {"Reservoir/Model": "acoustic"}
SIX_DEPTHS = 6 * 195  # of arch210 [m]; with reflection 1 the default of two depths has errors of 11 to 24 % (doc/water.md)
REFERENCE = "Westergaard"
MODELS = {REFERENCE: {},
          "none": {"Reservoir/Model": "none"},
          "half of Westergaard": {"Reservoir/Factor": 0.5},
          "acoustic, six depths": {**ACOUSTIC, "Reservoir/Length": SIX_DEPTHS},
          "acoustic, reflection 0.75": {**ACOUSTIC, "Reservoir/Reflection": 0.75}}
RESULTS = {"opening": "opening", "slip": "slip", "tension_upstream": "tension upstream", "tension_downstream": "tension downstream",
           "crest": "crest displacement"}
MODES = 2


def element_size(entries, directory):
    """Size of the water elements whose critical step fits the time step of a run (add_choices() in source/dam/reservoir.cc) [m]."""
    nodes = read_table(directory / "faces.csv")
    depth = float(entries["Reservoir/Water level"]) - nodes["z"][nodes["face"] == "upstream"].min()
    return max(depth / 16, 1.1 * Results(directory).summary["time_step"] * float(entries["Reservoir/Sound speed"]))


def frequencies(file, entries, settings, record):
    """First natural frequencies of the tied dam [Hz]; a text with the reason if the program refuses them."""
    if not record.exists():
        rock = {"Foundation/Model": "massless"} if entries["Foundation/Model"] == "rock" else {}
        words = set_options({**settings, **rock, "Joints/Model": "tied"})
        try:
            record.write_text(call("modes", file, "--count", MODES, "--json", *words), encoding="utf-8")
        except VoussoirError as error:
            return str(error)
    return [mode["frequency"] for mode in json.loads(record.read_text())["modes"]]


def results_of(name, seed, options):
    """Rows of a scene and a motion: model -> measures of the run, or "failure" and the reason."""
    stem, given = SCENES[name]
    file, given = ROOT / "prm" / f"{stem}.prm", {**given, "Motion/Seed": seed}
    entries = entries_of(file, given)
    directory = options.output.resolve() / f"{slug(name)}-{seed}"
    for folder in ("runs", "records", "motions"):
        (directory / folder).mkdir(parents=True, exist_ok=True)
    runs = Runs(file, entries, directory, {**given, "Output/Figures": "false", "Output/Frames": 0, "Output/Solution interval": 0}, 1, [{}])
    runs.seconds = runs.length = options.seconds
    rows = {}
    for model, settings in MODELS.items():
        if settings.get("Reservoir/Model") == "acoustic":
            settings = {**settings, "Reservoir/Element size": f"{element_size(entries, directory / 'runs' / slug(f'{REFERENCE}, motion 1')):.4g}"}
        run = rows[model] = runs.run(model, settings, limited=False)
        if "failure" not in run:
            run.update(values=run["motions"][0], cost=run["pace"])
        if "failure" in run:
            (directory / "records" / f"{slug(f'{model}, motion 1')}.json").unlink(missing_ok=True)
            if model == REFERENCE:
                raise SystemExit(f"{name}: {run['failure']}")
        run["frequencies"] = frequencies(file, entries, {**given, **settings}, options.output / f"modes-{slug(name)}-{slug(model)}.json")
        print(f"{name}, seed {seed}, {model}: {run.get('failure') or format(run['cost'], '.3g') + ' s of work per second of earthquake'}", flush=True)
    return rows


def numbers(run):
    """Results by name, in their units; frequencies as f1, f2. None: no value."""
    values = {RESULTS[key]: None if "failure" in run else run["values"][key] * COLUMNS[key].scale for key in RESULTS}
    found = run["frequencies"] if isinstance(run["frequencies"], list) else [None] * MODES
    return {**values, **{f"f{k + 1}": value for k, value in enumerate(found)}}


class Row:
    """A model of water on a scene: values as means over the motions, and the change of each motion against Westergaard [%]."""

    def __init__(self, model, motions):
        self.model = model
        self.failure = next((rows[model]["failure"] for rows in motions if "failure" in rows[model]), None)
        self.values, self.changes = {}, {}
        for key in numbers(motions[0][model]):
            pairs = [(numbers(rows[model])[key], numbers(rows[REFERENCE])[key]) for rows in motions]
            if None not in (value for pair in pairs for value in pair):
                self.values[key] = sum(value for value, _ in pairs) / len(pairs)
                if all(before > 0 for _, before in pairs):
                    self.changes[key] = [100 * (value / before - 1) for value, before in pairs]
            elif None not in (value for value, _ in pairs):
                self.values[key] = pairs[0][0]
        self.cost = None if self.failure else sum(rows[model]["cost"] / rows[REFERENCE]["cost"] for rows in motions) / len(motions)

    def mean(self, key):
        return sum(self.changes[key]) / len(self.changes[key])

    def cell(self, key):
        if key not in self.values:
            return "-"
        if self.model == REFERENCE or key not in self.changes:
            return f"{self.values[key]:.3g}"
        ends = sorted({f"{end:+.0f}" for end in (min(self.changes[key]), max(self.changes[key]))}, key=float)
        return f"{self.values[key]:.3g} ({' to '.join(ends)} %)"


def table(scenes):
    """The rows as Markdown."""
    names = [f"{title} [{COLUMNS[key].unit}]" for key, title in RESULTS.items()] + [f"f{k + 1} [Hz]" for k in range(MODES)]
    lines = ["| scene | water | " + " | ".join(names) + " | cost |", "|" + "---|" * (len(names) + 3)]
    for scene, rows in scenes.items():
        for row in rows:
            cells = [row.cell(key) for key in [*RESULTS.values(), *(f"f{k + 1}" for k in range(MODES))]]
            cost = f"{row.cost:.2f}" if row.cost else row.failure.split(". ")[0].rstrip(".").replace("|", "/")
            lines.append(f"| {scene} | {row.model} | " + " | ".join(cells) + f" | {cost} |")
    return "\n".join(lines)


def panel(axes, name, rows):
    """Changes of one scene, in percent of Westergaard: mean of the motions, and their range."""
    rows = [row for row in rows if row.model != REFERENCE and row.changes]
    keys = [key for key in [*RESULTS.values(), *(f"f{k + 1}" for k in range(MODES))] if any(key in row.changes for row in rows)]
    width = 0.8 / max(1, len(rows))
    for k, row in enumerate(rows):
        at = [i - 0.4 + (k + 0.5) * width for i, key in enumerate(keys) if key in row.changes]
        means = [row.mean(key) for key in keys if key in row.changes]
        ends = [[abs(row.mean(key) - end(row.changes[key])) for key in keys if key in row.changes] for end in (min, max)]
        label = f"{row.model} ({f'cost {row.cost:.2f}' if row.cost else 'frequencies only'})"
        axes.bar(at, means, width, yerr=ends if np.max(ends) > 0 else None, color=COLOURS[list(MODELS).index(row.model) - 1], ecolor="0.2", label=label)
    axes.axhline(0, color="0.3", linewidth=0.8)
    axes.set_xticks(range(len(keys)), [key.replace(" ", "\n") for key in keys], fontsize=7)
    axes.set(title=name, ylabel="change against Westergaard [%]")
    axes.grid(True, axis="y", linewidth=0.4, color="0.88")
    axes.set_axisbelow(True)
    axes.legend(frameon=False, fontsize=8, ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.14))


def draw(scenes, file):
    columns = min(2, len(scenes))
    lines = -(-len(scenes) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(6.2 * columns, 4.4 * lines), squeeze=False)
    for place in axes.flat[len(scenes):]:
        place.set_visible(False)
    for place, (name, rows) in zip(axes.flat, scenes.items()):
        panel(place, name, rows)
    figure.tight_layout()
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_program_argument(parser)
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--seconds", type=float, default=5., help="of the strongest motion")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1], help="of the artificial motions")
    parser.add_argument("--output", type=Path, default=Path("output/water"))
    parser.add_argument("--figure", type=Path, default=ROOT / "doc" / "figures" / "water.png")
    options = parser.parse_args()
    os.environ["VOUSSOIR_PROGRAM"] = str(Path(options.voussoir).resolve())
    scenes = {}
    for name in options.scenes:
        motions = [results_of(name, seed, options) for seed in options.seeds]
        scenes[name] = [Row(model, motions) for model in MODELS]
    print(table(scenes))
    draw(scenes, options.figure)


if __name__ == "__main__":
    main()
