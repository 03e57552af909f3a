#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Response of the tied dam on rock to waves from below, by frequency, against the box of rock.

    benchmarks/box_response.py [--depths 210 420 630] [--all-sides] [--component x] [--set ENTRY=VALUE]... [--voussoir PROGRAM]

A pulse of one component under prm/rock_fja.prm with 30 x 10 x 1 elements, tied, without water and weight: so all is linear.
The response H is acceleration over that of the outcrop, at the middle of the base, and of the crest against the base, at the
complex frequencies 2 pi f - 0.6i /s (a decay that forgets what comes after the run). The factor exp(s T), with the arrival T of
S at the foot and s = 0.6 + 2 pi i f, belongs to H, because the waves arrive later in deeper boxes. Prints |H| in the last of the
boxes and, of the others, in per cent, the change |H / H_last - 1| and that of the amplitude, |H| / |H_last| - 1. The rock is
elastic, so nothing should change. The rms is that over the frequencies. --all-sides: the rock is as long on all sides as it is deep.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

from choices import box
from program import ROOT, add_program_argument, simulate

STEP, SECONDS, PEAK, DECAY = 0.01, 5.0, 3.0, 0.6  # [s], [s], [Hz], [1/s]
FREQUENCIES = np.array([0.25, 0.5, 0.75, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8])
LAYERS = 8
SCENE = {"Mesh/Arch210/Elements along": 30, "Mesh/Arch210/Elements up": 10, "Mesh/Arch210/Elements through": 1,
         "Mesh/Arch210/Rock/Boundary layers": LAYERS, "Dynamics/Steps per sample": 6, "Joints/Model": "tied",
         "Statics/Self-weight": "none", "Reservoir/Density": 0, "Motion/Source": "file", "Motion/Duration": -1,
         "Output/Checkpoint interval": 0}


def pulse(component, file):
    """Ricker's wavelet: neither velocity nor displacement is left."""
    t = STEP * np.arange(round(SECONDS / STEP) + 1)
    s = np.pi * PEAK * (t - 0.5)
    motion = np.zeros((len(t), 4))
    motion[:, 0], motion[:, 1 + component] = t, (1 - 2 * s**2) * np.exp(-s**2)
    np.savetxt(file, motion, delimiter=",")


def responses(options, depth, directory):
    """H of base and crest, with the arrival taken off."""
    c = options.component
    file = Path(directory) / "pulse.csv"
    pulse("xyz".index(c), file)
    entries = {**SCENE, **(box(depth) if options.all_sides else {}), **dict(entry.split("=", 1) for entry in options.set),
               "Motion/File": file, "Mesh/Arch210/Rock/Depth": depth}
    summary = simulate(options.voussoir, ROOT / "prm" / "rock_fja.prm", entries, Path(directory) / str(depth))
    rows = np.genfromtxt(Path(directory) / str(depth) / "history.csv", delimiter=",", names=True)
    s = DECAY + 2j * np.pi * FREQUENCIES
    kernel = np.exp(-np.outer(s, rows["time"]))
    outcrop = kernel @ rows["base_acceleration_" + c]
    shift = np.exp(s * summary["rock"]["arrival"])
    return [(kernel @ (rows[key + c] - rows[key + c][0])) * s**2 / outcrop * shift for key in ("base_", "crest_")], summary["rock"]["nodes"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--depths", type=float, nargs="+", default=[210, 420, 630])
    parser.add_argument("--all-sides", action="store_true")
    parser.add_argument("--component", choices="xyz", default="x")
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        found = {depth: responses(options, depth, directory) for depth in options.depths}
    last = options.depths[-1]
    print(f"| {options.component} | nodes | " + " | ".join(f"{f:g} Hz" for f in FREQUENCIES) + " | rms |\n|" + "---|" * (len(FREQUENCIES) + 3))
    for k, place in enumerate(("base", "crest")):
        reference = found[last][0][k]
        print(f"| {place}, abs(H), {last:g} m | {found[last][1]} | " + " | ".join(f"{abs(h):.3f}" for h in reference) + " | |")
        for depth in options.depths[:-1]:
            ratio = found[depth][0][k] / reference
            for what, change in (("change", np.abs(ratio - 1)), ("amplitude", np.abs(ratio) - 1)):
                print(f"| {place}, {depth:g} m: {what} [%] | {found[depth][1]} | " + " | ".join(f"{100 * x:.1f}" for x in change)
                      + f" | {100 * np.sqrt((change**2).mean()):.1f} |")


if __name__ == "__main__":
    main()
