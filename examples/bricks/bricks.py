#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Array of 81 keyed graphite bricks on a shaking table (1985): mesh and motion of scene.prm, and the comparison with the measurement.

    bricks.py                writes bricks.msh and motion.csv into this directory
    bricks.py RESULTS        compares the velocities in RESULTS/history.csv with measured.csv; writes figure.png"""

import csv
import sys
from math import cos, log, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).resolve().parent
FUEL, SMALL, DEPTH = .214, .11025, .907  # [m]: half distances of opposite faces, thickness
HALF, CORNER, HOLE = .0619, .028, .1316  # [m]: half widths of the faces between the bricks, and between fuel bricks; radius of the hole
PITCH = FUEL + SMALL  # [m]: distance of the centres without the gaps of 2.2 mm, which scene.prm has
DWELL, RATE, FIRST, DURATION, SAMPLE = 2., .1, 3., 42., .002  # constant frequency [s], sweep [Hz/s], [Hz], [s], [s]
# Place in the grid of 11 x 11 bricks, whose outer ones are the frame; the first number is along the motion.
BRICKS = {"FB2(2)(2)": (5, 5), "IB2(3)(2)": (6, 5), "FB2(2)(3)": (5, 7), "FB2(1)(2)": (3, 5), "FB1(3)(4)": (6, 8), "IB2(1)(0)": (2, 1)}


def quarters(*cells):
    """Cells in the plane (x, z), each turned by 0, 90, 180 and 270 degrees."""
    turn = lambda p, q: p if q == 0 else turn((-p[1], p[0]), q - 1)
    return [[turn(p, q) for p in cell] for q in range(4) for cell in cells]


def write_mesh(file):
    """A fuel brick is a ring of twelve cells with faces to four interstitial bricks and four fuel bricks, an interstitial brick an octagon of four cells."""
    numbers, cells, faces, names, count = {}, [], [], {}, {1: 0, 2: 0}
    inner, outer = (HOLE * cos(pi / 8), HOLE * sin(pi / 8)), (PITCH / 2 + CORNER, PITCH / 2 - CORNER)
    swap = lambda p: (p[1], p[0])
    parts = {1: quarters(((inner[0], -inner[1]), (FUEL, -HALF), (FUEL, HALF), inner), (inner, (FUEL, HALF), outer, swap(inner)),
                         (swap(inner), outer, swap(outer), (HALF, FUEL))),
             2: quarters(((0, 0), (SMALL, -HALF), (SMALL, HALF), (HALF, SMALL)))}

    def node(x, y, z):
        return numbers.setdefault((round(x, 6), y, round(z, 6)), len(numbers) + 1)

    on_edge = lambda q: not {0, 10} & set(q)
    for i, j in sorted(((i, j) for i in range(11) for j in range(11)), key=on_edge):  # frame first
        kind, half = (1, FUEL) if (i + j) % 2 == 0 else (2, SMALL)
        count[kind] += 1
        volume = 1000 * kind + count[kind]
        names[volume] = f"monolith {kind} lift {count[kind]} " + ("fuel" if kind == 1 else "interstitial")
        for part in parts[kind]:
            sides = [[node(i * PITCH + x, y, j * PITCH + z) for x, z in part] for y in (0, DEPTH)]
            cells.append((volume, sides[1] + sides[0]))
            for k in range(4):
                a, b = part[k], part[(k + 1) % 4]
                if any(place in (0, 10) and a[d] == b[d] == (half if place else -half) for d, place in ((0, i), (1, j))):
                    faces.append([sides[s][(k + m) % 4] for s, m in ((0, 0), (0, 1), (1, 1), (1, 0))])
    with open(file, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", 1 + len(names), '2 1 "base"', sep="\n", file=out)
        print(*(f'3 {v} "{name}"' for v, name in names.items()), "$EndPhysicalNames\n$Nodes", len(numbers), sep="\n", file=out)
        print(*(f"{n} {x:.6f} {y} {z:.6f}" for (x, y, z), n in numbers.items()), "$EndNodes\n$Elements", len(faces) + len(cells), sep="\n", file=out)
        for n, (element, group, c) in enumerate([(3, 1, f) for f in faces] + [(5, v, c) for v, c in cells], 1):
            print(n, element, 2, group, group, *c, file=out)
        print("$EndElements", file=out)


def write_motion(file):
    """.3 g at 3 Hz for 2 s, then rising by .1 Hz/s."""
    with open(file, "w") as out:
        print("t [s],a_x [g],a_y [g],a_z [g]", file=out)
        for k in range(round(DURATION / SAMPLE) + 1):
            t = k * SAMPLE
            phase = 2 * pi * (FIRST * t + .5 * RATE * max(0, t - DWELL)**2)
            print(f"{t:.3f},{.3 * cos(phase):.8f},0,0", file=out)


def velocity_ratios(history):
    """Of each brick: frequency of the table [Hz], largest velocity over that of the table, in windows of 1 s."""
    with open(history) as file:
        rows = list(csv.reader(file))
    column = {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])
              if name == "time" or name.endswith(("_velocity_x", "base_acceleration_x"))}
    time, acceleration, table = column["time"], column["base_acceleration_x"], [0.]
    for k in range(1, len(time)):
        table.append(table[-1] + .5 * (acceleration[k - 1] + acceleration[k]) * (time[k] - time[k - 1]))
    found = {brick: [] for brick in BRICKS}
    per_window = round(1 / (time[1] - time[0]))
    for begin in range(round(DWELL) * per_window, len(time) - per_window, per_window):
        window = range(begin, begin + per_window)
        largest = max(abs(table[k]) for k in window)
        for brick, (i, j) in BRICKS.items():
            probes = [column[name] for name in column if name.startswith(f"b{i}_{j}")]  # a fuel brick has two, on both sides of its centre
            own = max(abs(sum(probe[k] for probe in probes) / len(probes) + table[k]) for k in window)
            found[brick].append((FIRST + RATE * (time[begin] + .5 - DWELL), own / largest))
    return found


def measured_ratios():
    found = {brick: [] for brick in BRICKS}
    with open(HERE / "measured.csv") as file:
        for row in csv.DictReader(file):
            found[row["brick"]].append((float(row["frequency"]), float(row["ratio"])))
    return found


def interpolated(curve, x):
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= x <= x1 and x0 < x1:
            return y0 + (x - x0) / (x1 - x0) * (y1 - y0)
    return None


def compare(results):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    computed, measured = velocity_ratios(Path(results, "history.csv")), measured_ratios()
    bands = ((3, 3.5), (3.5, 4), (4, 4.5), (4.5, 5), (5, 5.3), (5.3, 6), (6, 7), (3, 5.3))
    print("| brick | " + " | ".join(f"{a:g} to {b:g} Hz" for a, b in bands) + " | rms of ln, 3 to 4.8 Hz | to 5.3 Hz |")
    print("|---|" + "---|" * (len(bands) + 2))
    figure, axes = plt.subplots(2, 3, figsize=(10, 5.5), sharex=True, sharey=True, layout="constrained")
    for panel, brick in zip(axes.flat, BRICKS):
        ratio = [(f, c / m) for f, c in computed[brick] for m in [interpolated(measured[brick], f)] if m]
        within = lambda a, b: [r for f, r in ratio if a <= f <= b]
        means = [sum(within(*band)) / max(1, len(within(*band))) for band in bands]
        rms = [sqrt(sum(log(r)**2 for r in within(3, end)) / max(1, len(within(3, end)))) for end in (4.8, 5.3)]
        print(f"| {brick} | " + " | ".join(f"{m:.2f}" if m else "" for m in means) + f" | {rms[0]:.2f} | {rms[1]:.2f} |")
        panel.plot(*zip(*measured[brick]), "k-", lw=1.5, label="measured")
        panel.plot(*zip(*computed[brick]), "C0.-", lw=1, ms=4, label="Voussoir")
        panel.set(title=brick, xlim=(3, 7), ylim=(0, 4))
        panel.grid(alpha=.3)
    axes[0, 0].legend()
    figure.supxlabel("frequency of the table [Hz]")
    figure.supylabel("largest velocity over that of the table")
    figure.savefig(HERE / "figure.png", dpi=110)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        compare(sys.argv[1])
    else:
        write_mesh(HERE / "bricks.msh")
        write_motion(HERE / "motion.csv")
