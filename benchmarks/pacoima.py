#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequencies and damping ratios of the first two modes of Pacoima Dam (benchmarks/pacoima.prm) beside measured ones.

    pacoima.py [VOUSSOIR] [--figure doc/figures/pacoima.png]

Rigid base and massless rock: `voussoir modes`. Rock with mass has no real modes: two impulses on the crest, at the crown and at a quarter
point, and the free decay afterwards, without damping of the material: what remains is the radiation into the rock. The table of arcs is
symmetric, so the crown has the symmetric modes, and the difference of both quarter points the antisymmetric ones. Their decays are fitted by
sums of damped vibrations (matrix pencil: Hua and Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38, 1990). Runs go to output/pacoima."""

import argparse
import csv
import re
import subprocess
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "benchmarks" / "pacoima.prm"
# Frequency [Hz] and damping ratio [%] of the symmetric and the antisymmetric mode. S. Alves, Nonlinear analysis of Pacoima Dam with spatially
# nonuniform ground motion, EERL 2004-11: sections 4.2.1 (MODE-ID), 7.4.1.
MEASURED = {"measured, earthquake of 13 January 2001": ((4.73, 6.2), (5.06, 6.6)),
            "measured, forced vibration 2002": ((5.40, None), (5.70, None)),
            "another model, calibrated with the latter": ((5.46, None), (5.68, None))}
CASES = {"rigid base": ("Foundation/Model=rigid", "Mesh/Arcs/Rock/Enabled=false"), "massless rock": (),
         "massless rock, half the added mass": ("Reservoir/Factor=0.5",), "massless rock, empty": ("Reservoir/Density=0",)}
FREE = .2, 2.  # [s]: begin and end of the fitted decay


def settings(*entries):
    return [word for entry in entries for word in ("--set", entry)]


def modes(program, entries):
    """The first two frequencies [Hz]."""
    shown = subprocess.run([program, "modes", SCENE, "--count", "2", *settings(*entries)], check=True, capture_output=True, text=True).stdout
    return [(float(frequency), None) for frequency in re.findall(r"^ +[12] +([\d.]+)", shown, re.M)]


def vibrations(x, dt, rank=16):
    """Frequency [Hz], damping ratio [-] and amplitude of the damped vibrations whose sum is x, those of the lowest frequency first."""
    half = len(x) // 2
    rows = np.linalg.svd(np.array([x[i:i + half + 1] for i in range(len(x) - half)]), full_matrices=False)[2][:rank].T
    exponents = np.log(np.linalg.eigvals(np.linalg.pinv(rows[:-1]) @ rows[1:]).astype(complex)) / dt
    shares = np.linalg.lstsq(np.exp(np.outer(dt * np.arange(len(x)), exponents)), x, rcond=None)[0]
    return sorted((abs(s) / (2 * np.pi), -s.real / abs(s), abs(a)) for s, a in zip(exponents, shares) if s.imag > 0)


def on_rock(program, folder):
    """The symmetric and the antisymmetric mode on rock with mass, without damping of the material."""
    pulse = folder / "pulse.csv"
    pulse.write_text("time,force\n0,0\n0.025,1e6\n0.05,1e6\n0.1,-1e6\n0.125,0\n")
    subprocess.run([program, SCENE, "--output", folder / "rock", "--overwrite", "--quiet", *settings(
        "Foundation/Model=rock", "Damping/Ratio=0", "Motion/Duration=3", "Motion/Time step=5 ms", "Output/Figures=false",
        f"Loads/Force history=crown: 0 0 113; 1 0 0; {pulse}; left: 10 40 113; 1 0 0; {pulse}",
        "Output/Probes=left: 10 40 113; right: 10 -40 113")], check=True, capture_output=True)
    with open(folder / "rock" / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    of = {name: np.array([float(row[name]) for row in rows]) for name in ("time", "crest_x", "left_x", "right_x")}
    free, found = (of["time"] > FREE[0]) & (of["time"] < FREE[1]), []
    for x in (of["crest_x"], of["left_x"] - of["right_x"]):
        all_found = vibrations((x - x[-1])[free][::4], 4 * (of["time"][1] - of["time"][0]))
        largest = max(amplitude for *_, amplitude in all_found)
        found.append(next((f, 100 * ratio) for f, ratio, amplitude in all_found if amplitude > .1 * largest and f > 3))
    return found


def draw(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 2.7), layout="constrained")
    for i, (name, values) in enumerate(reversed(rows.items())):
        colour = "#c03030" if name in MEASURED and "measured" in name else "#808080" if name in MEASURED else "#2060a0"
        for (frequency, ratio), marker in zip(values, "os"):
            axes.plot(frequency, i, marker, color=colour, mfc=colour if marker == "o" else "white")
            if ratio:
                side = -1 if marker == "o" else 1
                axes.annotate(f"{ratio:.1f} %", (frequency, i), (7 * side, 0), textcoords="offset points", ha="right" if side < 0 else "left",
                              va="center", fontsize=8)
    axes.set(xlabel="frequency of modes 1 (circle) and 2 [Hz]", xlim=(4, 6), ylim=(-.5, len(rows) - .3))
    axes.set_yticks(range(len(rows)), reversed(rows))
    axes.grid(alpha=.3)
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build" / "voussoir", type=Path)
    parser.add_argument("--figure", type=Path)
    options = parser.parse_args()
    program, folder = options.program.resolve(), Path("output/pacoima").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    rows = dict(MEASURED)
    for name, entries in CASES.items():
        rows["computed, " + name] = modes(program, entries)
    rows["computed, rock with mass, radiation alone"] = on_rock(program, folder)
    print(f"{'':45s} two modes [Hz]   damping ratios [%]")
    for name, values in rows.items():
        print(f"{name:45s} {', '.join(f'{frequency:.2f}' for frequency, _ in values)}       {', '.join(f'{ratio:.1f}' for _, ratio in values if ratio)}")
    if options.figure:
        draw(rows, options.figure)


if __name__ == "__main__":
    main()
