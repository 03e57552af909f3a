# SPDX-License-Identifier: GPL-3.0-or-later
"""Error and cost of a scene with several meshes and time steps, and the cheapest setting that meets a target error.

    voussoir accuracy SCENE.prm [--for 1%] [--seconds 5] [--output DIR] [--set 'Section/Entry=value']...

Each choice of a scene (time step, elements along, up and through, degree, rock, compressible water) is refined separately, over the
strongest seconds of the scene's motion. The other choices are those of the scene.

There are two relative measures. The first is the largest openings of every joint at the crest, upstream and downstream.
The second is the means of the tension envelope over nine zones of each face, weighted by area. Nodes nearer to the base
than a tenth of the height are excluded, since the stress of an elastic dam is singular there. Both measures are the root
of a sum of squares.

With three levels of a choice, the order is fitted and the limit is extrapolated (Richardson). With two levels, the order
is 2, also of the degree: order 3 gave half of the error of degree 2 on an unseen dam. The error of a level is the distance
to the limit. Errors of several choices are added as vectors, joint by joint and zone by zone.

An ensemble is represented by its first motion.
The largest opening, slip, tensions and crest displacement get error bars (error_bars.py). `voussoir report` applies their
relative width to the whole run. The geometry of a mesh file is taken as given.

Existing runs of this version of the program are not repeated. Cost: CPU time of each thread per second of earthquake, without setup. accuracy.csv,
accuracy.json, accuracy.png and the runs are written to DIR.
"""

import csv
import hashlib
import itertools
import json
import math
import re
import shutil
import time
from pathlib import Path

import numpy as np

from .command import Parser, lock_directory
from .error_bars import UNITS, bar_text, bars_of_choices, beside, headlines, relevant, signed, solve_order
from .ensembles import members_of
from .errors import ComputationError, InputError
from .program import call, entries_of, message_of, program_key, set_options, start
from .results import Results, read_summary
from .study_file import AS_IT_IS, is_file_entry
from .tables import read_table
from .zone_tension import zone_means

EXPLICIT_STEP = "Dynamics/Explicit step"
STEPS, SUBSTEPS, DEGREE = "Dynamics/Steps per sample", "Foundation/Substeps", "Elements/Degree"
SUBDIVIDE = "Mesh/Subdivide"
WATER_SIZE, WATER_LENGTH, WATER_LEVEL = "Reservoir/Element size", "Reservoir/Length", "Reservoir/Water level"
ROCK_SHARE = 22 / 210  # default size of rock elements in a dam of arcs, as a share of the height
UNCHANGED_MASS = 1.02  # factor of the mass of the water: above, the program prints a warning
TAPER = 0.2  # of the motion's beginning [s]
RUNS = b"2"  # what this script reads of a run: those of another kind are made again
CLOCK = 0.01  # shortest processor time of a run [s]
FIRST, LAST = "base", "wish"  # names of the runs of the scene as it is, and of what is proposed


class Choice:
    """One thing that a scene may refine: levels from coarse to fine, each {entry: value}; sizes fall with them."""

    def __init__(self, name, levels, sizes, current, order=2.0):
        self.name, self.levels, self.sizes, self.current, self.order = name, levels, sizes, current, order
        self.cautious = 2. if name in ("time step", "rock size") else 1.  # order of error bars, where none can be fitted
        self.limit, self.fitted = None, False  # measures at size zero; is the order a fit?

    def key(self, level):
        return FIRST if level == self.current else f"{self.name} " + " ".join(map(str, self.levels[level].values()))

    def fit(self, values):
        """Order and limit from the measures (vectors) of all levels."""
        if len(values) > 2:
            first, last = (np.linalg.norm(values[k] - values[k + 1]) for k in (-3, -2))
            if last > 0 and first > 0:
                self.order = solve_order(first / last, self.sizes[-3] / self.sizes[-2], self.sizes[-2] / self.sizes[-1])
                self.fitted = 1 < self.order < 4
        coarsest = max(-3, -len(values))  # the widest pair, whose scatter is enlarged least
        gain = 1 / ((self.sizes[coarsest] / self.sizes[-1]) ** self.order - 1)
        self.limit = values[-1] + gain * (values[-1] - values[coarsest])


def n_monoliths(entries, section):
    """Number of monoliths of a generated dam."""
    chainages = entries.get(section + "Joint chainages", "")
    return 1 + (len(chainages.split(",")) if chainages else int(entries[section + "Joints"]))


def height_of(table):
    """Height of the dam of a table of arcs [m]."""
    with open(table, encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))
    levels = [float(row["elevation"]) for row in rows]
    return max(levels) - min(levels)


def choices_of(entries, directory=Path(".")):
    """Choices that can be refined in a scene, with the present level. directory: that of the scene."""
    result = []
    steps = int(entries[STEPS])
    on_rock = entries["Foundation/Model"] == "rock"
    limited = on_rock or entries.get("Reservoir/Model") == "acoustic"  # by a critical time step
    counts = ([steps // 2] if steps % 2 == 0 and not limited else []) + [steps, 2 * steps] + ([] if on_rock else [4 * steps])
    result.append(Choice("time step", [{STEPS: n} for n in counts], [1 / n for n in counts], counts.index(steps)))
    section = {"arch210": "Mesh/Arch210/", "arcs": "Mesh/Arcs/"}.get(entries["Mesh/Source"])
    if section:
        monoliths = n_monoliths(entries, section)
        per_monolith = max(1, math.ceil(int(entries[section + "Elements along"]) / monoliths))
        for name, now, unit in (("along", per_monolith, monoliths), ("up", int(entries[section + "Elements up"]), 1),
                                ("through", int(entries[section + "Elements through"]), 1)):
            if name == "up" and entries.get(section + "Rows"):
                continue  # the rows are the user's
            numbers = [now, math.ceil(1.5 * now), max(2 * now, math.ceil(1.5 * now) + 1)]
            result.append(Choice(name, [{f"{section}Elements {name}": unit * n} for n in numbers], [1 / n for n in numbers], 0))
        if entries["Foundation/Model"] != "rigid":
            entry = section + "Rock/Element size"
            size = float(entries[entry]) or ROCK_SHARE * height_of(directory / entries["Mesh/Arcs/Table"])
            result.append(Choice("rock size", [{entry: s} for s in (size, round(size / 1.4, 3))], [1.4, 1], 0))
    elif int(entries[DEGREE]) == 1:
        result.append(Choice("degree", [{DEGREE: 1}, {DEGREE: 2}], [1, 0.5], 0))
    elif entries[SUBDIVIDE] == "false":
        result.append(Choice("mesh", [{SUBDIVIDE: "false"}, {SUBDIVIDE: "true"}], [1, 0.5], 0))
    return result


def water_choices(entries, depth, mass_factor):
    """Choices of the compressible water: size of its elements, and length of the channel. depth [m]; mass_factor(size): factor of the whole mass of
    the water that the time step of the scene requires, infinity if the program refuses the size.

    The size is refined if the time step of the scene suffices for half of it. Otherwise it is coarsened, so that time step and mass are those of the
    scene in all levels. If a monolith has no water node with coarser elements, the size is refined with smaller time steps."""
    size, length = float(entries[WATER_SIZE]) or depth / 16, float(entries[WATER_LENGTH]) or 2 * depth
    finer, coarser = ([round(size * factor, 3) for factor in factors] for factors in ((1 / 1.4, 1 / 2), (2, 1.4)))
    if mass_factor(finer[-1]) > UNCHANGED_MASS and (coarser := [h for h in coarser if mass_factor(h) < math.inf]):
        sizes = [*coarser, size]
    else:
        sizes = [size, *finer]
    return [Choice("water size", [{WATER_SIZE: h} for h in sizes], sizes, sizes.index(size)),
            Choice("water length", [{WATER_LENGTH: factor * length} for factor in (1, 2, 4)], [1, 1 / 2, 1 / 4], 0)]


def water_mass_factor(scene, settings):
    """Factor of the mass of the water that the time step requires, from --validate; infinity for a scene that the program refuses."""
    result = start(scene, "--validate", *set_options(settings))
    found = re.search(r"mass increased by the factor ([0-9.]+)", result.stdout.replace("\n", " "))
    return float(found[1]) if result.returncode == 0 and found else math.inf


def water_depth(scene, settings):
    """Depth of the water at the dam [m], from the row of a water level that is 10 % lower; 0 if there is no water in the earthquake."""
    rows = json.loads(call("scene", scene, "--choices", *set_options(settings)))["choices"]
    lower = next((float(row["set"][WATER_LEVEL]) for row in rows if list(row["set"]) == [WATER_LEVEL]), None)
    return 0. if lower is None else 10 * (float(entries_of(scene, settings)[WATER_LEVEL]) - lower)


def explicit_steps(scene, settings, now):
    """Time steps of the explicit scheme: that of the scene, whose length --validate prints, and half of it."""
    step = re.search(r"^Explicit +\d+ steps? of ([0-9.]+) ms", call(scene, "--validate", *set_options(settings)), re.M)
    return Choice("time step", [{EXPLICIT_STEP: now}, {EXPLICIT_STEP: f"{5e-4 * float(step[1]):.4g}"}], [1, 1 / 2], 0)


def strongest(motion, seconds):
    """The part of a motion (t, a_x, a_y, a_z) with the largest Arias intensity, tapered in, from t = 0 on."""
    dt = motion[1, 0]
    length = min(len(motion) - 1, round(seconds / dt))
    power = np.concatenate([[0], np.cumsum((motion[:, 1:] ** 2).sum(axis=1))])
    ends = power[length + 1:] - power[:len(power) - length - 1]
    first = int(np.argmax(ends))
    part = motion[first:first + length + 1].copy()
    if first > 0:
        part[:, 1:] *= np.minimum(1, np.arange(len(part)) * dt / TAPER)[:, None]
    part[:, 0] = np.arange(len(part)) * dt
    return part, motion[first, 0]


class Ladder:
    """The runs, each in a directory of its own; measures and costs by their names."""

    def __init__(self, scene, common, directory, n_expected, seconds=0.):
        self.scene, self.common, self.directory = scene, common, directory
        self.n_expected, self.began, self.spent = n_expected, time.monotonic(), 0
        self.openings, self.tensions, self.areas, self.cost, self.changes, self.scale = {}, {}, {}, {}, {}, None
        self.headlines, self.seconds = {}, seconds

    def run(self, name, changes):
        directory = self.directory / "runs" / name.replace(" ", "_").replace("/", "-")
        stamp, key = directory / "digest.json", self.key_of(changes)
        known = json.loads(stamp.read_text()) if stamp.exists() else {}
        if known.get("key") == key:
            changes = known["changes"]
        else:
            changes = self.start(name, changes, directory)
            stamp.write_text(json.dumps({"key": key, "changes": changes}))
        self.changes[name] = changes
        summary = read_summary(directory)
        joints = read_table(directory / "joints.csv")
        self.openings[name] = np.stack([joints[f"opening_{face}"] for face in ("upstream", "downstream")], axis=1).ravel()
        self.tensions[name], self.areas[name] = zone_means(directory)
        self.headlines[name] = headlines(summary, Results(directory).history)
        seconds = summary["seconds"]
        # Processor time, not wall time: what else the machine does should not decide.
        self.cost[name] = seconds["per_second_of_earthquake"] * max(seconds["shaking_cpu"], CLOCK) / seconds["shaking"] / summary["threads"]
        done = len(self.cost)
        left = (time.monotonic() - self.began) / done * max(0, self.n_expected - done)
        opening = f"largest opening {1e3 * self.openings[name].max():7.2f} mm" if self.openings[name].size else "no joints"
        print(f"  {name:24s} {opening}, largest zone mean {1e-6 * self.tensions[name].max():6.3f} MPa, "
              f"{self.cost[name]:7.3f} s per s;  {done}/{self.n_expected}, about {left:.0f} s left", flush=True)

    def start(self, name, changes, directory):
        """Runs the scene with the changes and returns them. Smaller rock elements have a smaller critical time step. Then
        the rock has the number of substeps that the message of the run requires, or else both have smaller steps. An explicit
        step that is above the critical step of smaller elements is replaced by that of the program."""
        shutil.rmtree(directory, ignore_errors=True)
        result = start(self.scene, "--output", directory, "--quiet", *set_options({**self.common, **changes}))
        first, tried = result.stderr, changes
        for entry in (SUBSTEPS, STEPS) if name != FIRST else ():
            if result.returncode == 2 and (needed := re.search(rf'"{entry}" to (\d+)', first)):
                tried = {**changes, entry: int(needed[1])}
                result = start(self.scene, "--output", directory, "--quiet", *set_options({**self.common, **tried}))
        if result.returncode == 2 and name != FIRST and EXPLICIT_STEP in first and "above the critical step" in " ".join(first.split()):
            tried = {**changes, EXPLICIT_STEP: -1}
            result = start(self.scene, "--output", directory, "--quiet", *set_options({**self.common, **tried}))
        if result.returncode != 0:
            error = InputError if result.returncode == 2 else ComputationError
            raise error(f"the run \"{name}\" ({', '.join(f'{k} = {v}' for k, v in tried.items()) or 'the scene as it is'}"
                        f") failed: {message_of(result.stderr, result.returncode)}")
        return tried

    def key_of(self, changes):
        """A digest of the program and of all that a run reads: every entry of the scene, and the contents of its files."""
        entries = entries_of(self.scene, {**self.common, **changes})
        digest = hashlib.sha256(RUNS + program_key().encode() + json.dumps(entries).encode() + self.common["Motion/File"].read_bytes())
        for entry, value in entries.items():
            file = self.scene.parent / value
            digest.update(file.read_bytes() if is_file_entry(entry) and file.is_file() else b"")
        return digest.hexdigest()

    def measures(self, name):
        """Openings and tensions as one vector. Tensions are weighted by the roots of the zones' areas. Each part is relative
        to the largest of the runs of single choices. Openings below 0.01 mm count as 0."""
        share = np.sqrt(self.areas[FIRST] / self.areas[FIRST].sum())
        parts, least = (self.openings, {run: share * means for run, means in self.tensions.items()}), (1e-5, 1.)
        if self.scale is None:  # once: limits are of this scale
            self.scale = [max([smallest, *(np.linalg.norm(v) for v in part.values())]) for part, smallest in zip(parts, least)]
        return np.concatenate([part[name] / s for part, s in zip(parts, self.scale)])

    def norm(self, vector):
        """Relative error of openings and of tensions, and the larger of both."""
        n = len(self.openings[FIRST])
        pair = [float(np.linalg.norm(vector[:n])), float(np.linalg.norm(vector[n:]))]
        return (*pair, max(pair))


def plan(choices, ladder, wish):
    """The cheapest combination of measured and finer levels whose errors, added as vectors, meet the target error."""
    options = []
    for choice in choices:
        cost = [ladder.cost[choice.key(k)] / ladder.cost[FIRST] for k in range(len(choice.levels))]
        options.append([(k, ladder.measures(choice.key(k)) - choice.limit, cost[k]) for k in range(len(choice.levels))])
    best, closest = None, None
    for levels in itertools.product(*options):
        error, cost = combined(ladder, [error for _, error, _ in levels])[2], math.prod(c for _, _, c in levels)
        candidate = (cost, error, [k for k, _, _ in levels])
        if error <= wish and (best is None or cost < best[0]):
            best = candidate
        if closest is None or error < closest[1]:
            closest = candidate
    return best, closest


def combined(ladder, vectors):
    """Estimate of the error of several choices together. They may cancel, but at most down to half of the root sum of squares."""
    norms = [ladder.norm(v) for v in vectors]
    total = ladder.norm(sum(vectors))
    return tuple(max(total[k], 0.5 * math.sqrt(sum(n[k] ** 2 for n in norms))) for k in range(3))


def error_bars(choices, ladder):
    """Error bars of the largest values of the scene over the strongest seconds (see error_bars.bars_of_choices())."""
    return bars_of_choices(ladder.headlines[FIRST], {
        choice.name: ([ladder.headlines[choice.key(k)] for k in range(len(choice.levels))], choice.sizes, choice.cautious) for choice in choices})


def about_bars(bars):
    """Prints the error bars, and the values by combination of the single refinements."""
    print("\nError bars of the largest values over these seconds (in brackets: the signed error of each choice; combined: value plus these errors):")
    for name, found in bars.items():
        scale, unit = UNITS[found["unit"]]
        parts = ", ".join(f"{choice} {signed(scale * error)}" for choice, error in found["parts"].items())
        print(f"  {bar_text(name, found)} ({parts}); combined {scale * found['combined']:.4g} {unit}")


def about_run(scene, directory):
    """Prints the error bars of the run of the scene, if a reader of the run finds this directory: both have the same parent."""
    run = directory.resolve().parent / scene.stem
    if beside(run, scene.stem, "accuracy", "accuracy.json") != directory.resolve() / "accuracy.json":
        return
    try:
        bars = Results(run).error_bars
    except InputError:  # no run, or a run of other entries
        return
    print(f"Run       {run}; with the relative errors of these seconds:")
    for name, found in bars.items():
        print(f"          {bar_text(name, found)}")


def percent(x):
    return f"{100 * x:.2g} %" if x < 0.1 else f"{100 * x:.0f} %"


def draw(choices, ladder, wish, total, proposal, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7.5, 5.2))
    for choice, mark in zip(choices, "osv^D*P"):
        keys = [choice.key(k) for k in range(len(choice.levels))]
        errors = [100 * ladder.norm(ladder.measures(key) - choice.limit)[2] for key in keys]
        axes.plot([ladder.cost[key] for key in keys], errors, mark + "-", label=f"{choice.name} alone, "
                  + (f"order {choice.order:.1f}" if choice.fitted else f"order {choice.order:.0f} assumed"))
    axes.plot(ladder.cost[FIRST], 100 * total[2], "k*", markersize=14, label=f"the input file, {percent(total[2])}")
    if "cost" in proposal:
        axes.plot(proposal["cost"], 100 * proposal["error"], "kD", markersize=9, label=f"proposed, {percent(proposal['error'])}")
    axes.axhline(100 * wish, color="0.5", linewidth=1, linestyle="--", label=f"the target, {percent(wish)}")
    axes.set(xscale="log", yscale="log", xlabel="cost: processor seconds of each thread per second of earthquake",
             ylabel="error of openings or zone tension, the larger [%]")
    axes.grid(True, which="both", linewidth=0.4, color="0.88")
    axes.legend(frameon=False, fontsize=9)
    figure.savefig(file, dpi=160, bbox_inches="tight")


def write_table(choices, ladder, file):
    with open(file, "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(["choice", "setting", "cost", "error_openings", "error_tension", "order", "order_is_fitted"])
        for choice in choices:
            for k, level in enumerate(choice.levels):
                name = choice.key(k)
                errors = ladder.norm(ladder.measures(name) - choice.limit)
                table.writerow([choice.name, "; ".join(f"{e} = {v}" for e, v in level.items()), f"{ladder.cost[name]:.6g}",
                                *(f"{e:.6g}" for e in errors[:2]), f"{choice.order:.3g}", choice.fitted])


def number(text, what, unit=""):
    try:
        value = float(text.removesuffix(unit)) if text.endswith(unit) else math.nan
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{what} must be a positive number{f' with its {unit}, such as 1{unit}' if unit else ''}, not \"{text}\".")
    return value


def expect_no_abutments(scene, entries):
    """Throws InputError for a scene with other motions of the banks, whose strongest part is not cut."""
    if entries["Motion/Abutments"]:
        raise InputError(f"the scene {scene} has Motion/Abutments, but the strongest part of the motion is cut from one record. Use the same motion "
                         "at all base nodes: --set Motion/Abutments=")


def prepare(options, wish):
    """The scene's ladder, with the strongest part of its motion, and what it can refine."""
    seconds = number(options.seconds, "--seconds")
    entries = entries_of(options.scene, options.set)
    if entries["Motion/Source"] == "none":
        raise InputError(f"the scene {options.scene} has no motion (Motion/Source = none): there is no earthquake to chart.")
    expect_no_abutments(options.scene, entries)
    options.set += [f"{entry}={value}" for entry, value in members_of(entries, 1)[0].items()]
    if entries["Output/Envelope interval"] == "0":
        options.set.append("Output/Envelope interval=1")
    directory = Path(options.output or f"output/{Path(options.scene).stem}-accuracy")
    lock = lock_directory(directory, "`voussoir accuracy`")
    call("motion", options.scene, "--output", directory / "whole.csv", *set_options(options.set))
    part, begin = strongest(np.loadtxt(directory / "whole.csv", delimiter=",", skiprows=1), seconds)
    motion = (directory / "motion.csv").resolve()
    np.savetxt(motion, part, delimiter=",", header="t,a_x,a_y,a_z", comments="# ")
    common = dict(entry.split("=", 1) for entry in options.set)
    common.update({**AS_IT_IS, "Motion/File": motion, "Output/Figures": "false", "Output/Solution interval": 0})
    choices = choices_of(entries, Path(options.scene).parent)
    if entries["Dynamics/Scheme"] == "explicit":
        choices[0] = explicit_steps(options.scene, common, entries[EXPLICIT_STEP])
    if entries["Reservoir/Model"] == "acoustic" and (depth := water_depth(options.scene, options.set)) > 0:
        choices += water_choices(entries, depth, lambda size: water_mass_factor(options.scene, {**common, WATER_SIZE: size}))
    n_runs = 2 + sum(len(choice.levels) - 1 for choice in choices)
    print(f"{options.scene}: the strongest {part[-1, 0]:.4g} s, from {begin:.4g} s on; {n_runs} runs; target: {percent(wish)}")
    ladder = Ladder(Path(options.scene).resolve(), common, directory, n_runs, float(part[-1, 0]))
    ladder.lock = lock  # until the command ends
    return choices, ladder, entries


def about_choices(choices, ladder, wish):
    """Prints the error and cost of each level; returns what could be coarser."""
    print("\n  choice       setting                                      s per s   openings   tension   order")
    for choice in choices:
        for k, level in enumerate(choice.levels):
            name = choice.key(k)
            o, t, _ = ladder.norm(ladder.measures(name) - choice.limit)
            words = ", ".join(f"{entry.split('/')[-1]} = {value}" for entry, value in level.items())
            print(f"  {choice.name:12s} {words + (' (now)' if k == choice.current else ''):42s} {ladder.cost[name]:9.3f}   "
                  f"{percent(o):>8s}  {percent(t):>8s}   {choice.order:.1f}{'' if choice.fitted else ' assumed'}")
    small = [c.name for c in choices if ladder.norm(ladder.measures(FIRST) - c.limit)[2] < wish / 10]
    if small:
        print(f"\n  Finer than the target needs: {', '.join(small)} (each less than a tenth of it).")
    return small


def propose(choices, ladder, wish):
    """Runs the cheapest setting that is expected to meet the target error, or else prints the closest one."""
    best, closest = plan(choices, ladder, wish)
    chosen = best or closest
    changes = {}
    for choice, k in zip(choices, chosen[2]):
        if k != choice.current:
            for entry, value in ladder.changes[choice.key(k)].items():  # a shorter explicit step before that of the program (-1) for a finer mesh
                changes[entry] = changes.get(entry, value) if entry == EXPLICIT_STEP else max(value, changes.get(entry, value))
    proposal = {"changes": changes, "predicted": chosen[1], "meets": best is not None}
    if best is None:
        return proposal
    if changes:
        ladder.run(LAST, changes)
        changes = proposal["changes"] = ladder.changes[LAST]
    name = LAST if changes else FIRST
    # Its own measures against the limit of all choices: what the sum of single refinements predicts for size zero.
    limit = ladder.measures(FIRST) + sum(choice.limit - ladder.measures(FIRST) for choice in choices)
    measured = ladder.norm(ladder.measures(name) - limit)
    return {**proposal, "meets": measured[2] <= wish, "openings": measured[0], "tension": measured[1],
            "error": max(measured[2], chosen[1]), "cost": ladder.cost[name]}


def about_proposal(proposal, wish):
    """Prints the setting for the target error, or the closest one."""
    lines = " ".join(f"--set '{entry}={value}'" for entry, value in proposal["changes"].items()) or "(as it is)"
    if "cost" in proposal:
        print(f"{'For' if proposal['meets'] else 'Not quite'} {percent(wish)}: {lines}\n    at {proposal['cost']:.3g} s per "
              f"second of earthquake; error estimated {percent(proposal['predicted'])}, measured against the extrapolated limit "
              f"{percent(max(proposal['openings'], proposal['tension']))}.")
    else:
        print(f"No setting that was tried meets {percent(wish)}. The closest, by estimate {percent(proposal['predicted'])}: "
              f"{lines}\n    Start from it, with `voussoir accuracy` again.")


def main():
    parser = Parser(prog="voussoir accuracy")
    parser.add_argument("--for", dest="wish", default="1%")
    parser.add_argument("--seconds", default="5")
    parser.add_argument("--output")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("scene", nargs="*")
    options = parser.parse_args()
    if len(options.scene) != 1:
        raise InputError("`voussoir accuracy` needs one scene file. `voussoir accuracy --help` shows how.")
    options.scene = options.scene[0]
    wish = number(options.wish, "--for", "%") / 100
    choices, ladder, entries = prepare(options, wish)
    for choice in choices:
        for k, level in enumerate(choice.levels):
            if choice.key(k) not in ladder.cost:
                ladder.run(choice.key(k), {} if k == choice.current else level)
    for choice in choices:
        choice.fit([ladder.measures(choice.key(k)) for k in range(len(choice.levels))])
    total = combined(ladder, [ladder.measures(FIRST) - choice.limit for choice in choices])
    small = about_choices(choices, ladder, wish)
    if all(choice.name.startswith(("time", "water")) for choice in choices):
        print("\n  The mesh cannot be refined from here (degree 2, already subdivided): its error is in none of these numbers.")
    print(f"\nThe input file as it is: error {percent(total[0])} of the openings, {percent(total[1])} of the tensile stress, "
          f"at {ladder.cost[FIRST]:.3g} s of processor time (of each thread) per second of earthquake.")
    bars = error_bars(choices, ladder)
    about_bars(bars)
    if entries["Mesh/Source"] == "file":
        print("  The geometry of the mesh file is taken as given: the bars exclude the distance of its facets from the true faces.")
    proposal = propose(choices, ladder, wish)
    about_proposal(proposal, wish)
    write_table(choices, ladder, ladder.directory / "accuracy.csv")
    draw(choices, ladder, wish, total, proposal, ladder.directory / "accuracy.png")
    (ladder.directory / "accuracy.json").write_text(json.dumps({
        "scene": str(ladder.scene), "wish": wish, "error": {"openings": total[0], "tension": total[1]}, "cost": ladder.cost[FIRST],
        "finer_than_needed": small, "proposal": proposal, "seconds": ladder.seconds, "entries": relevant(entries), "error_bars": bars}, indent=1) + "\n")
    print(f"Chart     {ladder.directory / 'accuracy.png'}\nTable     {ladder.directory / 'accuracy.csv'}")
    about_run(ladder.scene, ladder.directory)
    return 0
