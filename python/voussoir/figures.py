# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes DIR/figures/*.png from the output directory of a run of voussoir, or of several: their scales are then the same. Openings,
slips, spectra, distributions and demands are also made as PDF.

    scripts/figures.py DIR... [--format png|svg|pdf] [--limits]

envelope_{upstream,downstream}[_compression]   principal stress over the run, developed elevation views
envelope_{arch,cantilever,vertical}_{upstream,downstream}[_compression]   stresses in these directions
openings, slips                                maxima at the crest, joint by joint
history, joint_history                         crest and base; the joints that open most
spectrum                                       of the motion, with the design spectrum
floor_spectra                                  of the absolute accelerations of crest and probes, with that of the ground
energy                                         energies and their balance
demand_{upstream,downstream}, overstress       with --limits: demand-capacity ratios, and the durations above them against the allowed one

Of many motions (Motion/Ensemble): envelopes of the median, openings and slips of each motion with median and band, spectrum, and

distribution                                   share of the motions up to a largest opening and a largest tension
ida                                            of several factors: factor over the largest opening and tension (incremental dynamic analysis)

Marked in an envelope is the largest value away from the base. Of the output directory of `voussoir modes`: modes.png. Figures
whose data are missing are skipped with a message.
Exit status: 0 done, 1 some data could not be understood, 2 not an output directory, 3 no numpy or matplotlib.
"""

import argparse
import sys
from io import BytesIO
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from .command import write_whole
from .errors import InputError
from .drawing import (DIRECTIONS, FACES, aspect, common_levels, common_top, demand_bar, draw_base, draw_crest, draw_crest_bars, draw_demand,
                      draw_energy, draw_face, draw_floor_spectra, draw_joint_history, draw_overstress, draw_spectra, energy_parts, imbalance, moving, plt,
                      stress_bar, worst_joints)
from .ensemble_drawing import draw_distribution, draw_dynamic_analysis, draw_joint_band
from .runs import Run, Skip

N_WORST_JOINTS = 4
AS_PDF = ("openings", "slips", "spectrum", "distribution", "ida", "demand", "overstress")  # figures for the reports of others: 0.1 s each


def strength_of(run):
    """Tensile strength [MPa] of the scene's limits, 0 if there is none."""
    return 1e-6 * run.limit("Tensile strength")


# Columns of faces.csv, their titles, and the names of their figures
ENVELOPES = [("max_principal", "maximum principal stress", "envelope_{}"), ("min_principal", "minimum principal stress", "envelope_{}_compression")] + [
    (f"{name}_stress_{end}", f"{end}imum {name} stress", f"envelope_{name}_{{}}{suffix}")
    for name in ("arch", "cantilever", "vertical") for end, suffix in (("max", ""), ("min", "_compression"))]


def median_of(run):
    """Words of a title: the faces of an ensemble are medians."""
    return f", median of {run.ensemble.n} motions" if run.ensemble else ""


def envelopes(runs, save):
    for column, kind, figure_name in ENVELOPES:
        if "_stress_" in column and not all(column in face for run in runs for face in run.faces.values()):
            print(f"figures: skipped {figure_name.format('*')}: faces.csv of an earlier version")
            continue
        levels = common_levels(runs, column)
        for run in runs:
            for name in FACES:
                figure, axes = plt.subplots(figsize=(10, 2.3 + 8.8 * aspect(run)))
                try:
                    contours = draw_face(axes, run, name, column, levels, strength_of(run))
                except Skip as reason:
                    print(f"figures: skipped {figure_name.format(name)}: {reason}")
                    plt.close(figure)
                    continue
                axes.set_title(f"{run.heading}\n{name.capitalize()} face: envelope of {kind}{median_of(run)}", pad=10)
                stress_bar(figure, contours, axes, levels, kind.split()[1], fraction=0.05, pad=0.16, aspect=45)
                save(run, figure, figure_name.format(name))


def demands(runs, save):
    """Demand-capacity ratios on the faces, and the durations above them."""
    for run in runs:
        if not run.static_strength > 0.:
            raise Skip("no static tensile strength is given (Limits/Static tensile strength)")
        for name in FACES:
            figure, axes = plt.subplots(figsize=(10, 2.3 + 8.8 * aspect(run)))
            demand_bar(figure, draw_demand(axes, run, name, run.static_strength), axes, fraction=0.05, pad=0.16, aspect=45)
            axes.set_title(f"{run.heading}\n{name.capitalize()} face: demand-capacity ratio{median_of(run)}, "
                           f"static strength {1e-6 * run.static_strength:.3g} MPa", pad=10)
            save(run, figure, f"demand_{name}")
    for run in runs:
        figure, axes = plt.subplots(figsize=(6, 4))
        draw_overstress(axes, run)
        axes.set_title(f"{run.heading}\nDuration of overstress at a point, away from the base", loc="left")
        save(run, figure, "overstress")


def motions(runs, save):
    """Scatter of the joints over many motions, and incremental dynamic analyses."""
    for run in runs:
        words = f"{run.heading}, {run.ensemble.n} motions"
        for quantity, name in (("opening", "openings"), ("slip", "slips")) if not run.tied else ():
            figure, axes = plt.subplots(figsize=(8, 4))
            draw_joint_band(axes, run, quantity)
            axes.set_title(f"{words}\nLargest joint {quantity} at the crest")
            save(run, figure, name)
        measures = ["tension"] if run.tied else ["max_opening", "tension"]
        for name, draw, title in (("distribution", draw_distribution, "Share of the motions up to a value"),
                                  ("ida", draw_dynamic_analysis, "Incremental dynamic analysis")):
            if run.ensemble.n < 2 or name == "ida" and len(run.ensemble.factors) < 2:
                continue
            figure, row = plt.subplots(1, len(measures), figsize=(5. * len(measures), 4), sharey=True, squeeze=False)
            for axes, measure in zip(row[0], measures):
                draw(axes, run, measure)
            for axes in row[0, 1:]:
                axes.set_ylabel("")
            row[0, 0].set_title(f"{words}\n{title}", loc="left")
            save(run, figure, name)


def crest_maxima(runs, save):
    runs = [run for run in runs if not run.tied]
    for quantity, name in (("opening", "openings"), ("slip", "slips")):
        for run in runs:
            figure, axes = plt.subplots(figsize=(8, 4))
            draw_crest_bars(axes, run, quantity, common_top(runs, quantity), run.limit(quantity.capitalize()))
            axes.set_title(f"{run.heading}\nMaximum joint {quantity} at the crest")
            save(run, figure, name)


def joint_history(runs, save):
    for run in runs:
        if run.tied:
            continue
        worst = worst_joints(run, N_WORST_JOINTS)
        figure, rows = plt.subplots(len(worst), 1, sharex=True, sharey=True, squeeze=False, figsize=(9, 1.2 + 1.5 * len(worst)))
        largest = max(draw_joint_history(axes, run, joint) for axes, joint in zip(rows[:, 0], worst))
        rows[0, 0].set_ylim(-0.04 * largest, 1.3 * largest if largest > 0 else 1)
        rows[0, 0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncol=2)
        rows[0, 0].set_title(f"{run.heading}\nOpenings of the joints that open most", loc="left")
        rows[-1, 0].set_xlabel("time [s]")
        figure.supylabel("opening [mm]", fontsize=11, x=0.06)
        save(run, figure, "joint_history")


def history(runs, save):
    for run in runs:
        base = run.base_acceleration
        figure, rows = plt.subplots(1 + len(base), 1, sharex=True, squeeze=False, figsize=(9, 3.4 + 1.5 * len(base)),
                                    gridspec_kw={"height_ratios": [2] + [1] * len(base)})
        draw_crest(rows[0, 0], [run])
        rows[0, 0].set_ylabel("crest, relative\nto the base [mm]")
        rows[0, 0].set_title(f"{run.heading}\nCrown crest, downstream positive, and base acceleration", loc="left")
        largest = max((np.abs(column).max() for column in base.values()), default=0)
        for axes, direction in zip(rows[1:, 0], sorted(base)):
            draw_base(axes, run, direction, largest)
        rows[-1, 0].set_xlabel("time [s]")
        figure.align_ylabels(rows[:, 0])
        save(run, figure, "history")


def spectrum(runs, save):
    for run in runs:
        table = run.table("spectrum.csv")
        if not (shown := moving(table)):
            continue
        figure, row = plt.subplots(1, len(shown), figsize=(3.6 * len(shown), 3.6), sharey=True, squeeze=False)
        for axes, direction in zip(row[0], shown):
            draw_spectra(axes, table, direction)
        row[0, 0].set_ylabel("pseudo-acceleration [m/s²]")
        row[0, 0].set_title(f"{run.heading}\nResponse spectrum of the motion, damping {100 * table['damping'][0]:g} %", loc="left")
        save(run, figure, "spectrum")


def floor_spectra(runs, save):
    for run in runs:
        table = run.table("floor_spectra.csv")
        figure, row = plt.subplots(1, len(DIRECTIONS), figsize=(3.6 * len(DIRECTIONS), 3.6), sharey=True)
        for axes, direction in zip(row, DIRECTIONS):
            draw_floor_spectra(axes, table, direction)
        row[0].set_ylabel("pseudo-acceleration [m/s²]")
        row[0].legend(loc="lower left", borderaxespad=0.2)
        row[0].set_title(f"{run.heading}\nFloor response spectra, damping {100 * table['damping'][0]:g} %", loc="left")
        save(run, figure, "floor_spectra")


def energy(runs, save):
    for run in runs:
        time, balance = run.energy["time"], imbalance(run)
        figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(9, 6), gridspec_kw={"height_ratios": [3, 1]})
        draw_energy(above, run, energy_parts(run)[1])
        above.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
        above.set_title(f"{run.heading}\nEnergies", loc="left")
        below.plot(time, 100 * balance, color="k", linewidth=1)
        below.text(1.02, 0.95, f"at most\n{100 * np.abs(balance).max():.1e} %", transform=below.transAxes, va="top")
        below.set(xlabel="time [s]", ylabel="balance [% of\nlargest energy]", xlim=(time[0], time[-1]))
        below.ticklabel_format(axis="y", scilimits=(-2, 3), useMathText=True)
        figure.align_ylabels([above, below])
        save(run, figure, "energy")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+", metavar="DIR")
    parser.add_argument("--format", choices=("png", "svg", "pdf"))
    parser.add_argument("--limits", action="store_true")
    options = parser.parse_args()
    modes = Path(options.directories[0])
    if (modes / "modes.csv").exists() and not (modes / "summary.json").exists():
        from .mode_shapes import draw_modes
        draw_modes(modes)
        return 0
    try:
        runs = [Run(directory) for directory in options.directories]
    except InputError as error:
        print(f"figures: error: {error}", file=sys.stderr)
        return 2

    def save(run, figure, name):
        folder = run.directory / "figures"
        if folder.is_symlink():
            raise ValueError(f"{folder} is a link")
        folder.mkdir(exist_ok=True)
        for kind in [options.format] if options.format else ["png", "pdf"] if name.startswith(AS_PDF) else ["png"]:
            data = BytesIO()
            figure.savefig(data, format=kind, metadata={"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind))
            write_whole(folder / f"{name}.{kind}", data.getvalue())
        plt.close(figure)

    single, many = [run for run in runs if not run.ensemble], [run for run in runs if run.ensemble]
    todo = [(envelopes, runs), (spectrum, runs), (history, single), (floor_spectra, single), (energy, single), (motions, many)]
    todo += [(demands, [run for run in single if run.moves])] if options.limits else []
    if all(run.tied for run in single):
        print("figures: tied dam, no figures of joints" if single else "figures: many motions, no figures over time")
    else:
        todo += [(crest_maxima, single), (joint_history, single)]

    def draw(makers):
        status = 0
        for make, shown in makers:
            try:
                make(shown, save)
            except Skip as reason:
                print(f"figures: skipped {make.__name__}: {reason}", flush=True)
            except (KeyError, ValueError, IndexError) as error:
                print(f"figures: error: {make.__name__}: {type(error).__name__}: {error}", file=sys.stderr)
                status = 1
            plt.close("all")
        sys.exit(status)

    # The envelopes take as long as all other figures: two processes.
    workers = [get_context("fork").Process(target=draw, args=(makers,)) for makers in (todo[:1], todo[1:])]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return int(any(worker.exitcode != 0 for worker in workers))
