#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Frequency and damping ratio of the free vibration after a snap-back: prints them and draws figure.png.

    decay.py RESULTS [RESULTS_2]      RESULTS_2: a second curve of the figure"""

import csv
import sys
from math import hypot, log, pi
from pathlib import Path

AVERAGE = .12  # [s]: period of the second mode, which the mean over this time removes
LAST = 1.5     # [s]: the last swings begin


def history(results):
    """Times [s] and displacements of the crest downstream [m]."""
    with open(Path(results) / "history.csv", encoding="utf-8") as file:
        rows = [(float(row["time"]), float(row["crest_x"])) for row in csv.DictReader(file)]
    return [time for time, _ in rows], [x for _, x in rows]


def swings(times, x):
    """Begin [s], frequency [Hz] and damping ratio [-] of each full swing, from three zeros and four extremes of the smoothed displacement
    relative to its mean in the last second."""
    dt = times[1] - times[0]
    half, last = round(AVERAGE / dt / 2), round(1 / dt)
    rest = sum(x[-last:]) / last
    smooth = [sum(x[i - half:i + half + 1]) / (2 * half + 1) - rest for i in range(half, len(x) - half)]
    at = [i for i in range(1, len(smooth)) if smooth[i - 1] * smooth[i] < 0]
    zeros = [times[half + i] - dt * smooth[i] / (smooth[i] - smooth[i - 1]) for i in at]
    tops = [max(map(abs, smooth[i:j])) for i, j in zip(at, at[1:])]
    for k in range(0, len(tops) - 3, 2):
        decrement = log((tops[k] + tops[k + 1]) / (tops[k + 2] + tops[k + 3]))
        yield zeros[k], 1 / (zeros[k + 2] - zeros[k]), decrement / hypot(2 * pi, decrement)


def decay(results):
    """Frequency [Hz] and damping ratio [-] of the first swing, and means of the last ones."""
    every = list(swings(*history(results)))
    last = [swing for swing in every if LAST < swing[0] < 2 * LAST]
    return {"first": dict(zip(("frequency", "ratio"), every[0][1:])),
            "last": {name: sum(swing[i] for swing in last) / len(last) for i, name in ((1, "frequency"), (2, "ratio"))}}


def draw(all_results, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(7, 2.8), layout="constrained")
    for results, (label, style) in zip(all_results, (("lift joint", {"color": "#c03030"}), ("tied", {"color": "#808080", "lw": .9}))):
        times, x = history(results)
        axes.plot(times, [1e3 * value for value in x], label=label, **style)
    axes.set(xlabel="time after the release [s]", ylabel="crest downstream [mm]", xlim=(0, 3))
    axes.grid(alpha=.3)
    if len(all_results) > 1:
        axes.legend()
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    for name, values in decay(sys.argv[1]).items():
        print(f"{name}: {values['frequency']:.3f} Hz, damping ratio {100 * values['ratio']:.2f} %")
    draw(sys.argv[1:], Path(sys.argv[1]) / "decay.png")
