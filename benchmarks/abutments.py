#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What different motions of the banks do to the dam Pacoima (benchmarks/pacoima.prm, with joints): Motion/Abutments.

    abutments.py [VOUSSOIR] [--seconds 8]

The records of 13 January 2001 are not free to be copied, so the motions here are artificial. The motion of the base has 0.2 g. At 80 % of
the height, where the stations of that event are, the motion of both banks is the motion of the base, times a factor above 1 Hz and later by a
delay. (Canyons amplify short waves, and a factor of the slow displacements would strain the dam by decimetres.)
For each case the script prints the largest opening, the largest tension of the zone means of both faces, and the largest acceleration
of the crest downstream. Runs are written to output/abutments; existing ones are not repeated.
"""

import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from voussoir.results import read_summary  # noqa: E402
from voussoir.zone_tension import zone_means  # noqa: E402

STATION = 0.8 * 113  # height [m]
CASES = {"uniform": None, "banks x 2": (2, 0), "banks x 2, 0.05 s later": (2, .05), "banks 0.05 s later": (1, .05), "uniform x 2": "factor"}


def settings(*entries):
    return [word for entry in entries for word in ("--set", entry)]


def above(frequency, a, dt):
    """The part of accelerations above a frequency [Hz]: factor (f/f_0)^4 / (1 + (f/f_0)^4) of the Fourier spectrum."""
    ratio = (np.fft.rfftfreq(2 * len(a), dt) / frequency)**4
    return np.fft.irfft(np.fft.rfft(a, 2 * len(a), axis=0) * (ratio / (1 + ratio))[:, None], axis=0)[:len(a)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=ROOT / "build" / "voussoir")
    parser.add_argument("--seconds", type=float, default=8)
    options = parser.parse_args()
    folder = Path("output/abutments").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    scene = [ROOT / "benchmarks" / "pacoima.prm", *settings("Statics/Self-weight=staged", "Joints/Model=FJA", "Joints/Friction=0.8",
                                                            "Mesh/Arcs/Elements along=22", "Mesh/Arcs/Elements up=10", "Output/Figures=false",
                                                            "Damping/Frequency 1=4.5", "Damping/Frequency 2=20")]
    base = folder / "base.csv"
    subprocess.run([options.program, "motion", *scene, "--output", base, *settings(
        "Motion/Source=artificial", "Motion/Peak acceleration=0.2", f"Motion/Duration={options.seconds}")], check=True, capture_output=True)
    motion = np.loadtxt(base, delimiter=",", skiprows=1)
    print(f"{'case':26s} opening [mm]   tension, zone means [MPa]   crest [m/s2]")
    for name, change in CASES.items():
        banks = []
        if isinstance(change, tuple):
            factor, delay = change
            n = round(delay / motion[1, 0])
            shifted = np.vstack([np.zeros((n, 4)), motion[:len(motion) - n]])
            shifted[:, 0] = motion[:, 0]
            shifted[:, 1:] += (factor - 1) * above(1., shifted[:, 1:], motion[1, 0])
            file = folder / f"banks_{factor}_{n}.csv"
            np.savetxt(file, shifted, delimiter=",", header="t,a_x,a_y,a_z", comments="")
            banks = settings(f"Motion/Abutments=right {STATION}: {file}; left {STATION}: {file}")
        directory = folder / name.replace(" ", "_")
        if not (directory / "summary.json").exists():
            factor = ["Motion/Factor=2"] if change == "factor" else []
            subprocess.run([options.program, *scene, "--output", directory, "--overwrite", "--quiet", *settings(
                "Motion/Source=file", f"Motion/File={base}", "Motion/Unit=m/s^2", "Motion/Duration=-1", "Dynamics/Steps per sample=2", *factor),
                *banks], check=True)
        summary = read_summary(directory)
        means, _ = zone_means(directory)
        print(f"{name:26s} {1e3 * summary['extremes']['max_opening']['value']:8.2f}       {1e-6 * means.max():8.2f}                "
              f"{summary['accelerations']['crest']['x']['value']:14.2f}")


if __name__ == "__main__":
    main()
