#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program's results against each other and against closed forms, on a small dam.

    program_physics.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from run_program import expect, frequencies, run_cases, runs, settings, summary, table, write_scene  # noqa: E402
from voussoir.vtu import read_vtu  # noqa: E402

TIED = ["--set", "Joints/Model=tied"]
STILL = ["--set", "Motion/Source=none", "--set", "Motion/File="]
ROCK = ["--set", "Mesh/Arch210/Rock/Enabled=true", "--set", "Mesh/Arch210/Rock/Element size=60"]


def close(value, expected, relative, what):
    print(f"    {what}: {value:.8g}, expected {expected:.8g}")
    expect(abs(value - expected) <= relative * abs(expected), f"{what} is {value}, not {expected}")


class Solution:
    """A solution-*.vtu; places and values by point."""

    def __init__(self, path):
        self.data = read_vtu(path)
        x = self.data["Points"]
        self.points = [tuple(x[3 * i:3 * i + 3]) for i in range(len(x) // 3)]

    def near(self, place, tolerance=1e-3):
        found = [i for i, p in enumerate(self.points) if math.dist(p, place) < tolerance]
        expect(found, f"no point at {place}")
        return found

    def displacement(self, i):
        return self.data["displacement"][3 * i:3 * i + 3]


def rows_by_name(name):
    names, rows = table(name)
    return [dict(zip(names, row)) for row in rows]


def steps_per_sample():
    """Two steps per sample are the motion with samples half-way: it is linear between them."""
    write_scene()
    lines = [[float(x) for x in line.split()] for line in Path("motion.txt").read_text().splitlines()]
    with open("finer.txt", "w") as file:
        for a, b in zip(lines, lines[1:]):
            print(*(f"{x:.12g}" for x in a), file=file)
            print(*(f"{(x + y) / 2:.12g}" for x, y in zip(a, b)), file=file)
    runs("scene.prm", "--output", "two", *TIED, *settings("Dynamics/Steps per sample=2"))
    runs("scene.prm", "--output", "finer", *TIED, *settings("Motion/File=finer.txt", "Motion/Time step=0.005"))
    two, finer = table("two/history.csv")[1], table("finer/history.csv")[1]
    expect(len(two) == len(finer) == 101, "number of steps")
    size = max(abs(row[1]) for row in finer)
    worst = max(abs(x - y) for a, b in zip(two, finer) for x, y in zip(a[1:4], b[1:4]))
    print(f"    difference {worst:.1e} m of {size:.3g} m")
    expect(worst < 1e-6 * size, "two steps per sample are not the finer motion")


def damping():
    """The logarithmic decrement of the first mode after the shaking: by Rayleigh's formula with the entries."""
    write_scene()
    with open("pulse.txt", "w") as file:
        for i in range(601):
            t = .01 * i
            print(t, f"{.2 * math.sin(2 * math.pi * t / .4)**2 if t < .2 else 0.:.10g}", 0, 0, file=file)
    pulse = settings("Motion/File=pulse.txt", "Motion/Duration=6", "Output/Envelope interval=0", "Damping/Ratio=0.1",
                     "Reservoir/Density=0")
    frequency = frequencies(runs("modes", "scene.prm", "--count", "1", *pulse))[0]
    omega = 2 * math.pi * frequency
    # The ratio holds at two frequencies; far from the other one it falls or rises with the frequency.
    for name, f1, f2, zeta in (("stiffness", 1e-4, 6., .1 * frequency / 6.), ("mass", .5, 1e5, .1 * .5 / frequency)):
        change = settings(f"Damping/Frequency 1={f1}", f"Damping/Frequency 2={f2}")
        runs("scene.prm", "--output", name, *TIED, *pulse, *change)
        rows = rows_by_name(f"{name}/history.csv")
        # The mode's part of the crest: the projection on a damped wave over whole periods, early and late.
        damped = omega * math.sqrt(1 - zeta**2)
        period = 2 * math.pi / damped
        mean = rows[0]["crest_x"]

        def amplitude(begin, periods=3):
            part = [r for r in rows if begin <= r["time"] < begin + periods * period]
            c = sum(math.exp(zeta * omega * (r["time"] - begin)) * (r["crest_x"] - mean) * math.cos(damped * r["time"])
                    for r in part) / len(part)
            s = sum(math.exp(zeta * omega * (r["time"] - begin)) * (r["crest_x"] - mean) * math.sin(damped * r["time"])
                    for r in part) / len(part)
            return math.hypot(c, s)
        early, late = 2.0, 2.0 + 4 * period
        measured = math.log(amplitude(early) / amplitude(late)) / (omega * (late - early))
        close(measured, zeta, .04, f"damping of the first mode, {frequency:.3f} Hz, {name}")


def static_state():
    """Weights, envelopes and fields of the static state."""
    write_scene()
    whole = settings("Mesh/Arch210/Joints=0", "Reservoir/Density=0", "Output/Solution interval=1") + STILL
    runs("scene.prm", "--output", "staged", *whole)
    runs("scene.prm", "--output", "monolithic", *whole, *settings("Statics/Self-weight=monolithic"))
    staged, monolithic = summary("staged")["static"], summary("monolithic")["static"]
    for a, b in zip(staged["self_weight_crest_displacement"], monolithic["crest_displacement"]):
        expect(abs(a - b) < 1e-9 * abs(monolithic["crest_displacement"][2]), f"crest under self-weight: {a}, {b}")
    expect(monolithic["crest_displacement"][2] < -1e-3, "self-weight lowers the crest")
    # The stress under self-weight is the same, whether the program adds it or finds it.
    fields = {name: Solution(f"{name}/solution-00000.vtu") for name in ("staged", "monolithic")}
    for name in ("stress_zz", "max_principal", "min_principal"):
        a, b = (fields[d].data[name] for d in ("staged", "monolithic"))
        size = max(map(abs, a))
        expect(max(abs(x - y) for x, y in zip(a, b)) < 1e-4 * size, f"{name} of staged and monolithic self-weight")
    expect(min(fields["staged"].data["stress_zz"]) < -1e6, "self-weight presses")
    # The envelope of a static state is that state.
    for directory in ("staged", "monolithic"):
        envelope, solution = Solution(f"{directory}/envelope.vtu"), fields[directory]
        for name in ("max_principal", "min_principal"):
            a, b = envelope.data[name], solution.data[name]
            expect(max(abs(x - y) for x, y in zip(a, b)) < 1e-4 * max(map(abs, b)), f"{directory}: {name} at time 0")
    # Joints: friction knows the slip of each increment, so that a pair may stick where it slipped before.
    jointed = settings("Statics/Water increments=8", "Statics/Self-weight=monolithic", "Output/Solution interval=1") + STILL
    runs("scene.prm", "--output", "jointed", *jointed)
    data = Solution("jointed/solution-00000.vtu").data
    kept = [s for s, state in zip(data["slip"], data["joint_state"]) if state == 1 and s > 1e-6]
    print(f"    {len(kept)} points stick after they have slipped, by up to {1e3 * max(kept, default=0):.3g} mm")
    expect(kept, "no pair sticks where it slipped in an increment before")


def recorders():
    """Tables, figures' data and summary against the fields of every step."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=1", "Output/Probes=foot: 0 0 0", "Joints/Friction=0.3"))
    n = len(table("run/history.csv")[1])
    solutions = [Solution(f"run/solution-{k:05d}.vtu") for k in range(n)]
    history, joints = rows_by_name("run/history.csv"), rows_by_name("run/joints.csv")
    joint_history, result = rows_by_name("run/joint_history.csv"), summary("run")
    crown = solutions[0].near(result["static"]["crest_point"])[0]
    for row, solution in zip(history, solutions):
        for c, value in zip("xyz", solution.displacement(crown)):
            expect(abs(row[f"crest_{c}"] - value) < 1e-6, f"crest_{c} at {row['time']} s: {row[f'crest_{c}']}, {value}")

    # Probes on both sides of a joint are of two monoliths: what is between them is the opening.
    runs("scene.prm", "--output", "sides", *settings("Mesh/Arch210/Joints=1", "Output/Probes=left: 0 2e-6 210; right: 0 -2e-6 210; joint: 0 0 210"))
    sides = rows_by_name("sides/history.csv")
    apart = [row["left_y"] - row["right_y"] for row in sides]
    for c in "xyz":  # the crest is the side to the right bank; the other side has columns of its own
        expect(all(abs(row[f"crest_{c}"] - row[f"right_{c}"]) + abs(row[f"crest_left_{c}"] - row[f"left_{c}"]) < 1e-7 for row in sides),
               f"crest_{c} of both sides")
        expect(all(row[f"crest_{c}"] == row[f"joint_{c}"] for row in sides), f"crest_{c}: a probe at a node has its values to the bit")
    opening = [row["opening_upstream_1"] for row in rows_by_name("sides/joint_history.csv")]
    expect(len(apart) == len(opening) and max(opening) > 1e-4, f"the joint at the crown opens by {max(opening)} m")
    expect(max(abs(a - b) for a, b in zip(apart, opening)) < 1e-6 * max(opening), "the probes' distance is not the opening")

    # The joints' crest: of the places with an opening, the uppermost ones, upstream the one with the smallest x.
    sides = {}
    for i, (p, state) in enumerate(zip(solutions[0].points, solutions[0].data["joint_state"])):
        if state >= 0 and p[2] > 210 - 1e-2:
            sides.setdefault(-1 if p[1] < 0 else 1, []).append(i)
    expect(len(sides) == 2, "two joints, one on each side of the valley")
    worst = {}
    for j, side in enumerate((-1, 1), 1):
        places = sorted(sides[side], key=lambda i: solutions[0].points[i][0])
        for face, i in (("upstream", places[0]), ("downstream", places[-1])):
            for row, solution in zip(joint_history, solutions):
                for quantity in ("opening", "slip"):
                    key = f"{quantity}_{face}_{j}"
                    worst[key] = max(worst.get(key, 0.), abs(row[key] - solution.data[quantity][i]))
        expect(joints[j - 1]["s"] * side > 0, "joint 1 is at the right bank")
        widest = max(joint_history, key=lambda r: max(r[f"opening_upstream_{j}"], r[f"opening_downstream_{j}"]))
        expect(abs(joints[j - 1]["time_of_max_opening"] - widest["time"]) < 1e-9,
               f"joint {j}: time of the largest opening {joints[j - 1]['time_of_max_opening']}, {widest['time']}")
        expect(0 < widest["time"] < history[-1]["time"], "the largest opening is not at an end")
    print("    joint_history.csv against the fields [m]:", {k: f"{v:.1e}" for k, v in worst.items()})
    expect(max(worst.values()) < 1e-8, f"joint_history.csv: {worst}")
    differ = max(abs(r["opening_upstream_1"] - r["opening_downstream_1"]) for r in joint_history)
    expect(differ > 1e-5, "both faces open alike: this scene cannot tell them apart")

    # Envelopes and their extremes
    for key, name, choose, face in (("max_tension_upstream", "max_principal", max, "upstream"),
                                    ("max_tension_downstream", "max_principal", max, "downstream"),
                                    ("max_compression", "min_principal", min, None)):
        extreme = result["extremes"][key]
        at = [solution.near(extreme["place"]) for solution in solutions[:1]][0]
        values = [choose(solution.data[name][i] for i in at) for solution in solutions]
        best = choose(values)
        close(extreme["value"], best, 1e-5, key)
        expect(abs(extreme["time"] - history[values.index(best)]["time"]) < 1e-6, f"{key}: time {extreme['time']}")
        if face is None:
            close(extreme["value"], min(min(s.data[name]) for s in solutions), 1e-5, "largest compression of all")
            continue
        with open("run/faces.csv") as file:
            names = file.readline().strip().split(",")
            rows = [dict(zip(names, line.strip().split(","))) for line in file]
        expect(all(float(r["max_principal"]) > float(r["min_principal"]) for r in rows), "faces.csv")
        close(extreme["value"], max(float(r["max_principal"]) for r in rows if r["face"] == face), 1e-5, f"{key}, faces.csv")


def on_rock():
    """What the tables say of a dam on rock, and entries that reach the joints."""
    write_scene()
    runs("scene.prm", "--output", "rock", *ROCK, *settings("Foundation/Model=rock", "Motion/Duration=0.1",
         "Dynamics/Steps per sample=5", "Output/Solution interval=50", "Output/Envelope interval=0"))
    runs("scene.prm", "--output", "rigid", *STILL)
    for key in ("volume", "crest_length", "cells"):
        close(summary("rock")["mesh"][key], summary("rigid")["mesh"][key], 1e-9, f"{key} of the dam on rock")
    solution, row = Solution("rock/solution-00050.vtu"), rows_by_name("rock/history.csv")[50]
    crown = solution.near(summary("rock")["static"]["crest_point"])[0]
    lowest = min(p[2] for p in solution.points)
    feet = {}
    for i, p in enumerate(solution.points):
        if p[2] < lowest + 1e-3:
            feet[tuple(round(x, 3) for x in p)] = solution.displacement(i)
    for k, c in enumerate("xyz"):
        base = row[f"base_{c}"]
        expect(min(u[k] for u in feet.values()) - 1e-7 <= base <= max(u[k] for u in feet.values()) + 1e-7,
               f"base_{c} {base} is not between those of the feet")
        expect(abs(row[f"crest_{c}"] + base - solution.displacement(crown)[k]) < 1e-6, f"crest_{c} against base_{c}")
    expect(abs(row["base_x"]) > 1e-6, "the base moves")


def accelerations():
    """Absolute accelerations: against displacements on each foundation, of a rigid dam, and their spectra."""
    write_scene()
    probe = settings("Output/Probes=foot: 0 0 0", "Output/Envelope interval=0")
    massless = [*ROCK, *settings("Foundation/Model=massless")]
    explicit = [*ROCK, *settings("Foundation/Model=rock", "Dynamics/Steps per sample=5", "Motion/Duration=0.9")]
    for name, foundation in (("rigid", []), ("massless", massless), ("rock", explicit)):
        runs("scene.prm", "--output", name, *TIED, *probe, *settings("Reservoir/Density=0"), *foundation)
        against_displacements(name)
    runs("scene.prm", "--output", "stiff", *TIED, *probe, *settings("Concrete/Young's modulus=1e18"))
    rows, found = rows_by_name("stiff/history.csv"), summary("stiff")["accelerations"]
    for c in "xyz":
        ground = ground_means(rows, c)
        for point, limit in (("crest", 1e-5), ("foot", 1e-7)):
            worst = max(abs(row[f"{point}_acceleration_{c}"] - a) for row, a in zip(rows, ground)) / max(map(abs, ground))
            expect(worst < limit, f"acceleration of the {point} of a rigid dam along {c}: {worst:.1e}")
            close(found[point][c]["amplification"], 1., limit, f"amplification at the {point} of a rigid dam, {c}")
            for row in rows_by_name("stiff/floor_spectra.csv"):
                expect(abs(row[f"{point}_{c}"] / row[f"ground_{c}"] - 1.) < 1e-5, f"floor spectrum of a rigid dam: {row}")
    runs("scene.prm", "--output", "jointed", *probe, *settings("Motion/Damping=0.03", "Motion/Scale y=0"))
    rows, found = rows_by_name("jointed/history.csv"), summary("jointed")["accelerations"]
    for c in "xyz":
        ground = [abs(a) for a in ground_means(rows, c)]
        close(found["ground"][c]["value"], max(ground), 1e-7, f"largest acceleration of the ground, {c}")
        for point in ("crest", "foot"):
            peak = max(rows, key=lambda row: abs(row[f"{point}_acceleration_{c}"]))
            largest = abs(peak[f"{point}_acceleration_{c}"])
            close(found[point][c]["value"], largest, 1e-7, f"largest acceleration of the {point}, {c}")
            expect(largest == 0. or abs(found[point][c]["time"] - peak["time"]) < 1e-6, "time of the largest acceleration")
            ratio = found[point][c]["amplification"]
            expect(ratio is None if c == "y" else abs(ratio - largest / max(ground)) < 1e-6 * ratio, f"amplification {ratio}")
        duhamel(rows, c)
    runs("scene.prm", "--output", "still", *STILL)
    expect(not Path("still/floor_spectra.csv").exists() and "accelerations" not in summary("still"), "a static state")


def ground_means(rows, c):
    """Mean acceleration of the ground in the step that ends with a row, as for the other points zero in the first row."""
    a = [row[f"base_acceleration_{c}"] for row in rows]
    return [0.] + [(p + q) / 2 for p, q in zip(a, a[1:])]


def against_displacements(name):
    """The trapezoidal rule: without impacts the second difference of displacements is the mean of two accelerations."""
    rows = rows_by_name(f"{name}/history.csv")
    dt = summary(name)["time_step"]
    for c in "xyz":
        u = [row[f"crest_{c}"] + row.get(f"base_{c}", 0.) for row in rows]
        a = [row[f"crest_acceleration_{c}"] for row in rows]
        ground = ground_means(rows, c) if name != "rock" else [0.] * len(rows)  # on rock displacements are absolute
        largest, digits = max(map(abs, a)), 4 * 5e-8 * max(map(abs, u)) / dt**2  # displacements have eight digits
        worst = max(abs((u[k + 1] - 2 * u[k] + u[k - 1]) / dt**2 + (ground[k] + ground[k + 1] - a[k] - a[k + 1]) / 2)
                    for k in range(1, len(rows) - 1))
        print(f"    {name}, {c}: acceleration up to {largest:.3g} m/s2, against the displacements {worst:.1e} m/s2")
        expect(largest > .1 and worst < 1e-6 * largest + digits, f"absolute acceleration on {name}, {c}: {worst} of {largest}")


def duhamel(rows, c, parts=40):
    """floor_spectra.csv by Duhamel's integral over the accelerations, linear between their times. Peaks are those at the
    times of the table, of short periods at 20 times per period or more."""
    dt = rows[1]["time"] - rows[0]["time"]
    h = dt / parts
    time = h * np.arange(parts * (len(rows) - 1) + 1)
    points = {point: [row[f"{point}_acceleration_{c}"] for row in rows] for point in ("crest", "foot")}
    points["ground"] = ground_means(rows, c)
    for row in rows_by_name("jointed/floor_spectra.csv")[21:90:8]:
        period, xi = row["period"], row["damping"]
        expect(xi == .03, "damping of the floor spectra")
        w = 2 * math.pi / period
        wd = w * math.sqrt(1 - xi**2)
        impulse = np.exp(-xi * w * time) * np.sin(wd * time) / wd
        every = parts // max(1, math.ceil(20. * dt / period))
        for point, values in points.items():
            a = np.interp(time, dt * np.arange(len(rows)), values)
            exact = w**2 * h * np.abs(np.convolve(a, impulse)[:len(time):every]).max()
            expect(abs(row[f"{point}_{c}"] - exact) <= 1e-4 * exact + 1e-9,
                   f"floor spectrum of {point}, {c}, {period:.3g} s: {row[f'{point}_{c}']}, exact {exact}")


if __name__ == "__main__":
    run_cases(steps_per_sample, damping, static_state, recorders, on_rock, accelerations)
