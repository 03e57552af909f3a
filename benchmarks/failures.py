#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery of failures (doc/failures.md): what fails, how it looks, and what Voussoir does instead. Numbers: benchmarks/README.md.

    benchmarks/failures.py [NAME]... [--voussoir PROGRAM] [--benchmark PROGRAM] [--figures DIRECTORY]

NAME: newmark, velocity, angle, drift, gauss, interpolation, diagonal, substeps, penalty; all without one. Prints the
tables and draws failure_NAME.png, some seconds each. newmark and angle need the program (scripts/build.sh);
newmark, drift, gauss, interpolation and diagonal benchmark_failures (ninja -C build benchmarks); velocity, substeps and
penalty neither: the program does not have these mistakes, failure_models.py has. Debian: python3-matplotlib.
"""

import argparse
import csv
import io
import json
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image

from failure_models import (CONTACT, FORCE, PHASES, ColumnOnRock, bar_errors, bar_on_wall)
from program import ROOT, add_program_argument, run, simulate

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SCENE = ROOT / "prm" / "coarse.prm"
STRONG = {"Mesh/Arch210/Elements along": 36, "Mesh/Arch210/Elements up": 12, "Motion/Duration": 5.12,
          "Motion/Rise end": 0.5, "Motion/Decay begin": 4.5}  # five seconds of strong shaking, coarse
WORST = 0.9  # the phase in which plain Newmark's energy grows most
BAD, GOOD, EXACT, OTHER = "#c0392b", "#1f5a99", "#222222", "#e0a030"


def table(head, *rows):
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for row in rows:
        print("| " + " | ".join(str(cell).replace("%", " %") for cell in row) + " |")
    print(flush=True)


def figure(panels=2):
    fig, axes = plt.subplots(1, panels, figsize=(4.6 * panels, 3.3), squeeze=False)
    for axis in axes[0]:
        axis.spines[["top", "right"]].set_visible(False)
        axis.grid(True, alpha=0.25)
    return fig, axes[0]


def save(options, fig, name):
    fig.tight_layout()
    options.figures.mkdir(exist_ok=True, parents=True)
    drawn = io.BytesIO()
    fig.savefig(drawn, dpi=100)
    Image.open(drawn).convert("RGB").quantize(128, dither=Image.Dither.NONE).save(
        options.figures / f"failure_{name}.png", optimize=True)  # a third of the size
    plt.close(fig)


def need(program, how):
    if not Path(program).exists():
        raise SystemExit(f"There is no {program}: build it with {how}.")


def benchmark(options, *arguments):
    """The tables that benchmark_failures prints, each a numpy array with named columns."""
    need(options.benchmark, '"ninja -C build benchmarks", or name it with --benchmark')
    text, _ = run(options.benchmark, *arguments)
    return [np.atleast_1d(np.genfromtxt(io.StringIO(part), delimiter=",", names=True)) if part.count("\n") else None
            for part in (block.strip() for block in text.split("\n\n"))]


def bar_of_program(options, rule):
    """Histories of the five phases of a bar on a wall, as bar_on_wall() gives them."""
    rows, = benchmark(options, "bar", rule)
    return {p: [rows[rows["phase"] == p][c] for c in ("time", "force", "gap", "energy")] for p in PHASES}


def mean_and_worst(histories, mean):
    errors = np.array([bar_errors(*histories[p], phase=p, mean=mean) for p in PHASES])
    return errors.mean(0), errors[np.abs(errors[:, 3]).argmax()]


def bar_row(name, histories, mean=False):
    average, worst = mean_and_worst(histories, mean)
    return (name, f"{average[0]:.1%}", f"{average[1]:.2%}", f"{average[2]:.2f}",
            f"{average[3]:+.1%} ({worst[3]:+.1%})")


BAR_HEAD = ("contact", "force, L1 error", "force, rms error while it lasts", "largest force / exact",
            "energy, mean (worst) of five phases")


def draw_bar(axis, bad, bad_name, good, phase):
    axis.plot(*bad[:2], color=BAD, lw=0.8, label=bad_name)
    axis.plot(*good[:2], color=GOOD, lw=1.6, label="mean-force (Voussoir)")
    start = 0.5 + phase * good[0][1]
    axis.plot([0.4, start, start, start + CONTACT, start + CONTACT, 1.3], [0, 0, FORCE, FORCE, 0, 0], color=EXACT,
              lw=0.8, ls="--", label="exact")
    axis.set(xlim=(0.42, 1.3), ylim=(-0.08 * bad[1].max(), 1.65 * bad[1].max()), xlabel="time [s]",
             ylabel="contact force [N]")
    axis.set_title("A bar hits a wall", fontsize=10)
    axis.legend(fontsize=8, loc="upper right")


def energy_of(directory):
    with open(Path(directory) / "energy.csv") as file:
        rows = list(csv.DictReader(file))
    column = {name: np.array([float(row[name]) for row in rows]) for name in ("time", "friction", "impact", "input",
                                                                              "damping")}
    return {**column, "joints": column["friction"] + column["impact"]}


def newmark(options):
    """Plain Newmark: a closed pair rings, and its energy grows."""
    histories = {rule: bar_of_program(options, rule) for rule in ("none", "mean-force")}
    table(BAR_HEAD, bar_row("plain Newmark (`none`)", histories["none"]),
          bar_row("`mean-force`", histories["mean-force"], True))
    fig, axes = figure()
    draw_bar(axes[0], histories["none"][WORST], "plain Newmark", histories["mean-force"][WORST], WORST)
    rows = []
    for rule, color, name in (("none", BAD, "plain Newmark"), ("mean-force", GOOD, "mean-force (Voussoir)")):
        for steps in (1, 4):
            with tempfile.TemporaryDirectory() as directory:
                summary = simulate(options.voussoir, SCENE, {**STRONG, "Dynamics/Impact": rule,
                                                             "Dynamics/Steps per sample": steps}, directory)
                energy = energy_of(directory)
            extremes = {key: value["value"] for key, value in summary["extremes"].items()}
            rows.append((f"`{rule}`", f"{10 / steps:g}", *(f"{1e-9 * energy[key][-1]:.2f}" for key in
                                                           ("input", "joints", "damping")),
                         f"{1e3 * extremes['max_opening']:.1f}", f"{extremes['max_compression'] / 1e6:.1f}"))
            axes[1].plot(energy["time"], 1e-9 * energy["joints"], color=color, ls="-" if steps == 1 else ":",
                         label=f"{name}, {10 / steps:g} ms")
    axes[1].set(xlabel="time [s]", ylabel="energy taken by the joints [GJ]")
    axes[1].set_title(f"An arch dam (the earthquake brings {rows[1][2]} GJ)", fontsize=10)
    axes[1].legend(fontsize=8)
    table(("rule", "step [ms]", "input [GJ]", "taken by joints [GJ]", "taken by damping [GJ]", "largest opening [mm]",
           "compression [MPa]"), *rows)
    save(options, fig, "newmark")


def velocity(options):
    """Only the velocity of a closed pair is corrected: its acceleration rings for ever."""
    rules = {"none": "plain Newmark", "velocity": "velocity corrected alone", "mean-force": "mean-force (Voussoir)"}
    rows, errors, sizes = [], {rule: [] for rule in rules}, (50, 100, 200)
    for rule, name in rules.items():
        for n in sizes:
            errors[rule].append(np.mean([bar_errors(*bar_on_wall(rule, n, phase=p), phase=p, elements=n,
                                                    mean=rule == "mean-force")[0] for p in PHASES]))
        histories = {p: bar_on_wall(rule, phase=p) for p in PHASES}
        rows.append(bar_row(name, histories, rule == "mean-force") +
                    (", ".join(f"{e:.1%}" for e in errors[rule]),))
    table(BAR_HEAD + ("L1 error with 50, 100, 200 elements",), *rows)
    fig, axes = figure()
    draw_bar(axes[0], bar_on_wall("velocity"), "velocity corrected alone", bar_on_wall("mean-force"), 0.5)
    for rule, color in zip(rules, (OTHER, BAD, GOOD)):
        axes[1].loglog(sizes, 100 * np.array(errors[rule]), "o-", color=color, label=rules[rule])
    axes[1].set(xlabel="elements", ylabel="error of the force, L1 [%]", xticks=sizes, ylim=(0.8, 300))
    axes[1].set_xticks([], minor=True)
    axes[1].set_xticklabels(sizes)
    axes[1].set_title("Refinement does not help", fontsize=10)
    axes[1].legend(fontsize=8, loc="center left")
    save(options, fig, "velocity")


def solve_problems(options, files, *arguments):
    """Answers of `voussoir-contact`, beside the program, which are printed for those that fail, too (status 1)."""
    text, _ = run(Path(options.voussoir).with_name("voussoir-contact"), *arguments, *files)
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def angle(options):
    """The slip angle of the force itself, as the paper prints it."""
    rows, answers = [], {}
    with tempfile.TemporaryDirectory() as directory:
        for equations in ("alart-curnier", "paper"):
            output = Path(directory) / equations
            summary = simulate(options.voussoir, SCENE, {
                **STRONG, "Joints/Equations": equations, "Contact/Write problems": str(equations != "paper").lower(),
                "Contact/Write interval": 16}, output)
            rows.append((f"`{equations}`", *(f"{summary['newton_iterations'][k]:.4g}" for k in ("mean", "max")),
                         f"{1e3 * summary['extremes']['max_opening']['value']:.3f}"))
        files = sorted((Path(directory) / "alart-curnier" / "contact" / "shaking").glob("*.txt"))
        times = [0.01 * int(file.stem.split("-")[1]) for file in files]
        for solver in ("newton", "paper"):
            answers[solver] = solve_problems(options, files, "--solver", solver)
    table(("equations, 5 s of shaking", "Newton steps, mean", "most", "largest opening [mm]"), *rows)
    alone = {s: [a["solver"] == s and a["converged"] for a in answers[s]] for s in answers}
    table(("equations", "problems that Newton solves alone", "iterations, median (most)"), *(
        (name, f"{sum(alone[s])} of {len(files)}", f"{np.median([a['iterations'] for a in answers[s]]):g} "
         f"({max(a['iterations'] for a in answers[s])})")
        for s, name in (("newton", "angle of the trial force"), ("paper", "angle of the force (as printed)"))))
    fig, axes = figure()
    draw_angle(axes[0])
    axes[1].semilogy(times, [a["iterations"] for a in answers["newton"]], "o", ms=4, color=GOOD,
                     label="angle of the trial force (Voussoir)")
    for solved, mark, name in ((True, "o", "as printed"), (False, "x", "as printed: Newton fails, rescued")):
        at = [i for i, a in enumerate(alone["paper"]) if a == solved]
        axes[1].semilogy([times[i] for i in at], [answers["paper"][i]["iterations"] for i in at], mark, ms=5,
                         color=BAD, label=name)
    axes[1].set(xlabel="time [s]", ylabel="iterations [-]", ylim=(1, 2000))
    axes[1].set_title("Joint problems of a dam in an earthquake", fontsize=10)
    axes[1].legend(fontsize=8)
    save(options, fig, "angle")


def draw_angle(axis):
    """Residual of an open pair that moved by (0.6, 0.8) mm, about the solution, no tangential force."""
    moved, force = np.array([0.6, 0.8]), np.linspace(-1, 1, 401)  # force in units of rho x 1 mm
    theta = np.arctan2(0 * force, force)
    axis.plot(force, moved[0] * np.sin(theta) - moved[1] * np.cos(theta), color=BAD, label="(4b), angle of the force")
    axis.plot(force, force, color=GOOD, label="angle of the trial force")
    axis.plot([0], [0], "o", color=EXACT, ms=5, label="solution: no force")
    axis.set(xlabel=r"tangential force along a, over $\rho$ [mm]", ylabel="residual [mm]", ylim=(-2.2, 1.2),
             xticks=(-1, -0.5, 0, 0.5, 1))
    axis.set_title("An open pair that moves by (0.6, 0.8) mm", fontsize=10)
    axis.legend(fontsize=8, loc="lower center")


def rock_history(options, shape, boundary, steps):
    history, field, result = benchmark(options, "rock", shape, boundary, steps)
    return history, field, result[0]


def drift(options):
    """No term of geometric spreading in the transmitting formula."""
    fig, axes = figure()
    rows = []
    for boundary, color, name in (("mtf2:gamma=0", BAD, "mtf2, gamma = 0"),
                                  ("mtf2-plain", OTHER, "mtf2-plain (gamma = 0)"),
                                  ("mtf2", "#5a9bd5", "mtf2"), ("mtf3", GOOD, "mtf3 (Voussoir)")):
        history, _, result = rock_history(options, "box", boundary, 8000)
        size = history["largest"] / result["peak"]
        for axis in axes:
            axis.plot(history["step"], size, color=color, label=name)
        rows.append((name, *(f"{size[k - 1]:.3g}" for k in (2000, 4000, 8000))))
    axes[1].set(yscale="log", ylim=(1e-20, 1e2), ylabel="")
    axes[0].set(ylabel="largest displacement / peak [-]")
    for axis, title in zip(axes, ("In proportion to time", "The same, logarithmic")):
        axis.set(xlabel="step")
        axis.set_title(title, fontsize=10)
    axes[0].legend(fontsize=8)
    table(("boundary", "after 2000 steps, over the peak", "4000", "8000"), *rows)
    save(options, fig, "drift")


def draw_explosion(options, name, shape, bad, good):
    """Histories of both, pairs of boundary and name, and what the bad one looks like on its way."""
    fig, axes = figure()
    for (boundary, label), color in ((bad, BAD), (good, GOOD)):
        history, field, _ = rock_history(options, shape, boundary, 2000)
        axes[0].semilogy(history["step"], history["largest"] / history["largest"][:200].max(), color=color, label=label)
        if boundary == bad[0]:
            draw_field(fig, axes[1], field)
    axes[0].set(xlabel="step", ylabel="largest displacement / peak [-]", ylim=(1e-12, 1e8))
    axes[0].set_title("After a push on the ground", fontsize=10)
    axes[0].legend(fontsize=8, loc="lower right")
    save(options, fig, name)


def draw_field(fig, axis, field):
    """The component that is larger, with its sign, in the plane y = 0."""
    x, z = np.unique(field["x"]), np.unique(field["z"])
    component = max("u_x", "u_z", key=lambda c: np.abs(field[c]).max())
    u = np.zeros((len(z), len(x)))
    u[np.searchsorted(z, field["z"]), np.searchsorted(x, field["x"])] = field[component]
    axis.grid(False)
    picture = axis.pcolormesh(x, z, u / np.abs(u).max(), cmap="RdBu_r", vmin=-1, vmax=1, shading="nearest")
    fig.colorbar(picture, ax=axis, label=f"${component}$ / largest", shrink=0.9 * min(1, 1.6 * len(z) / len(x)))
    axis.set(xlabel="x [cells]", ylabel="z [cells]", aspect="equal")
    axis.set_title(f"Step {field['step'][0]:.0f}; boundary right and below", fontsize=10)


MISTAKES = {"gauss": "Gauss points", "diagonal": "diagonal lines", "": "as it is"}


def explosions(options, cases):
    rows = []
    for shape, boundary in cases:
        _, _, result = rock_history(options, shape, boundary, 2000)
        exploded = result["steps"] < 2000
        name, _, mistake = boundary.partition(":")
        rows.append((f"`{name}`, {MISTAKES[mistake]}", shape,
                     f"exceeds 1e6 at step {result['steps']:.0f}" if exploded else
                     f"{result['end'] / result['peak']:.1e} of the peak after 2000 steps"))
    table(("boundary", "rock", "what happens"), *rows)


def gauss(options):
    """Gauss points in the cells at the transmitting formula."""
    explosions(options, [("box", b) for b in ("mtf2:gauss", "mtf3:gauss", "mtf2", "mtf3")])
    draw_explosion(options, "gauss", "box", ("mtf2:gauss", "Gauss points"), ("mtf2", "nodal quadrature (Voussoir)"))


def diagonal(options):
    """Lines of nodes that go inward at 45 degrees from edges and corners."""
    explosions(options, [(s, b) for b in ("mtf3:diagonal", "mtf2:diagonal", "mtf3") for s in ("box", "sheet")])
    draw_explosion(options, "diagonal", "sheet", ("mtf3:diagonal", "diagonal lines"),
                   ("mtf3", "lines normal to one face (Voussoir)"))


def interpolation(options):
    """The point 2 c dt by three nodes about it, instead of two steps of c dt."""
    fig, (axis,) = figure(1)
    rows = []
    for rule, color, name in (("direct", BAD, "direct"), ("linear", OTHER, "composed, linear"),
                              ("quadratic", GOOD, "composed, quadratic (Voussoir)")):
        values, = benchmark(options, "reflection", rule)
        axis.loglog(values["points"], 100 * values["reflected"], "o-", color=color, label=name)
        at = dict(zip(values["points"], values["reflected"]))
        rows.append((name, *(f"{100 * at[k]:.3g}" for k in (10, 20, 40)), f"{np.log2(at[10] / at[20]):.1f}"))
    axis.set(xlabel="nodes per wave length", ylabel="reflected [%]", ylim=(1e-5, 20), xticks=(10, 14, 20, 28, 40))
    axis.set_xticks([], minor=True)
    axis.set_xticklabels((10, 14, 20, 28, 40))
    axis.set_title("S waves in a bar, formula of order 2", fontsize=10)
    axis.legend(fontsize=8, loc="lower left")
    table(("interpolation", "reflected [%] at 10 nodes per wave length", "20", "40", "order, 10 to 20"), *rows)
    save(options, fig, "interpolation")


def substeps(options):
    """Several steps of the rock in one of the dam, the feet no heavier."""
    fig, axes = figure()
    reference, fine = ColumnOnRock(1, False).crest(3.0)
    rows = []
    for m, heavier, color, style, name in ((1, False, EXACT, "--", "one step each (m = 1)"),
                                           (4, False, BAD, "-", "m = 4, feet as they are"),
                                           (4, True, GOOD, "-", "m = 4, heavier feet (Voussoir)")):
        time, top = ColumnOnRock(m, heavier).crest(3.0)
        axes[0].plot(time, 1e3 * top, color=color, ls=style, label=name)
    axes[0].set(xlim=(0, 2.2), ylim=(-20, 80), xlabel="time [s]", ylabel="displacement of the top [mm]")
    axes[0].set_title("A column on rock, pushed at its top", fontsize=10)
    axes[0].legend(fontsize=8)
    numbers = (1, 2, 3, 4, 6)
    growth = {heavier: [ColumnOnRock(m, heavier).largest_eigenvalue() for m in numbers] for heavier in (False, True)}
    for heavier, color, name in ((False, BAD, "feet as they are"), (True, GOOD, "heavier feet (Voussoir)")):
        axes[1].plot(numbers, growth[heavier], "o-", color=color, label=name)
    axes[1].set(xlabel="steps of the rock in one of the dam, m", ylabel="growth in a step of the dam [-]")
    axes[1].set_title("Largest eigenvalue of a step", fontsize=10)
    axes[1].legend(fontsize=8)
    for i, m in enumerate(numbers):
        time, top = ColumnOnRock(m, True).crest(3.0)
        error = np.abs(top - np.interp(time, reference, fine)).max() / np.abs(fine).max()
        rows.append((m, f"{growth[False][i]:.3f}", f"{growth[True][i]:.3f}", f"{error:.1%}"))
    table(("m", "growth in a step of the column", "with the mass k T^2/2 at the foot",
           "its error of the top, against m = 1"), *rows)
    save(options, fig, "substeps")


def penalty(options):
    """A spring instead of a contact condition."""
    stiffness = (0.1, 0.3, 1, 3, 10, 30, 100)
    results = [np.mean([bar_errors(*bar_on_wall("penalty", phase=p, penalty=f), phase=p) for p in PHASES], 0)
               for f in stiffness]
    ours = np.mean([bar_errors(*bar_on_wall("mean-force", phase=p), phase=p, mean=True) for p in PHASES], 0)
    table(("stiffness, of an element's E A/h", "penetration [mm]", "force, rms error while it lasts",
           "largest force / exact", "energy"),
          *((name, f"{1e3 * max(r[4], 0):.3g}", f"{r[1]:.2%}", f"{r[2]:.2f}", f"{r[3]:+.2%}")
            for name, r in zip([f"{f:g}" for f in stiffness] + ["`mean-force`"], results + [ours])))
    fig, axes = figure()
    axes[0].plot(*bar_on_wall("penalty", phase=WORST, penalty=0.1)[:2], color=OTHER, label="penalty, 0.1 E A/h")
    draw_bar(axes[0], bar_on_wall("penalty", phase=WORST, penalty=100), "penalty, 100 E A/h",
             bar_on_wall("mean-force", phase=WORST), WORST)
    axes[1].loglog(stiffness, [1e2 * r[1] for r in results], "o-", color=BAD, label="force: rms error [%]")
    axes[1].loglog(stiffness, [1e2 * r[4] / (FORCE * 10.0 / 900.0) for r in results], "s-", color=OTHER,
                   label="penetration, of the bar's shortening [%]")
    axes[1].axhline(1e2 * ours[1], color=GOOD, label="mean-force: rms error [%] (no penetration)")
    axes[1].set(xlabel="stiffness of the penalty [E A/h]", ylabel="[%]", ylim=(1e-3, 300))
    axes[1].set_title("Soft ones sink in, stiff ones ring", fontsize=10)
    axes[1].legend(fontsize=8, loc="lower left")
    save(options, fig, "penalty")


CASES = {case.__name__: case for case in (newmark, velocity, angle, drift, gauss, interpolation, diagonal, substeps,
                                          penalty)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="of failures: " + ", ".join(CASES))
    add_program_argument(parser)
    parser.add_argument("--benchmark", default=str(ROOT / "build" / "benchmark_failures"), help="ninja benchmarks")
    parser.add_argument("--figures", type=Path, default=ROOT / "doc" / "figures", help="where the pictures go")
    options = parser.parse_args()
    for name in options.names:
        if name not in CASES:
            parser.error(f"there is no failure \"{name}\"; there are {', '.join(CASES)}.")
    for name in options.names or CASES:
        if name in ("newmark", "angle"):
            need(options.voussoir, "scripts/build.sh, or name it with --voussoir")
        if name == "angle":
            need(Path(options.voussoir).with_name("voussoir-contact"), "ninja voussoir-contact")
        print(f"### {name}: {CASES[name].__doc__}\n")
        CASES[name](options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
