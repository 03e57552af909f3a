#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program with its ground motion: durations, records, factors, what is refused, what is warned of.

    program_motion.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import math
import os
import random
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from run_program import run_cases, expect, refused, runs, same, summary, table, voussoir, write, write_scene
from voussoir.study_file import with_paths

QUICKSTART = str(Path(__file__).resolve().parent.parent / "prm" / "quickstart.prm")


def artificial():
    """The quick start with another duration, factor and spectrum."""
    motions = {}
    for name, settings in {"one": [], "three": ["Motion/Factor=3"], "short": ["Motion/Duration=5"]}.items():
        arguments = [word for setting in settings for word in ("--set", setting)]
        shown = runs("motion", QUICKSTART, "--output", f"{name}.csv", *arguments)
        expect("warning" not in shown, shown)
        names, motions[name] = table(f"{name}.csv")
        expect(names == ["t", "a_x", "a_y", "a_z"], f"columns of {name}.csv")
        expect(all(math.isfinite(x) for row in motions[name] for x in row), f"{name}.csv is not finite")
        expect("another Motion/Duration is another motion" in shown, shown)
    expect(len(motions["one"]) == 1537 and len(motions["short"]) == 501, "lengths")
    # The envelope of 15 s and more stays as it was.
    expect(abs(max(abs(row[1]) for row in motions["one"]) - 0.5575 * 9.80665) < 1e-9, "peak acceleration")
    expect(all(abs(3 * a - b) < 1e-9 for p, q in zip(motions["one"], motions["three"]) for a, b in zip(p[1:], q[1:])),
           "Motion/Factor of an artificial motion")
    shown = runs(QUICKSTART, "--validate", "--set", "Motion/Duration=5")
    expect("1000 of 0.005 s" in shown, shown)
    Path("none.csv").unlink(missing_ok=True)
    for entry, parts in {"Motion/Peak acceleration=1e308": ("Motion/Peak acceleration", "1e+308"),
                         "Motion/Maximum beta=1e308": ("Motion/Maximum beta",),
                         "Motion/Factor=1e308": ("Motion/Factor",),
                         "Motion/Factor=1e5": ("1000 g", "Factor"),
                         "Motion/Scale y=nan": ("Motion/Scale y", "nan"),
                         "Motion/Seed=-1": ("Motion/Seed", "-1"),
                         "Motion/Matching iterations=-1": ("Motion/Matching iterations", "-1"),
                         "Motion/Decay begin=20": ("Motion/Duration is 15.36", "Decay begin, 20 s"),
                         "Motion/Rise end=16": ("Rise end, 16 s",)}.items():
        refused(["motion", QUICKSTART, "--output", "none.csv", "--set", entry], *parts)
        expect(not Path("none.csv").exists(), f"{entry}: a file was written")


def records():
    """Records of unequal length and step, records that are none, and what they leave at their end."""
    write_scene()
    scene = Path("scene.prm").read_text()
    write("scene.prm", scene.replace("  set Duration = 0.5\n", ""))
    shown = runs("scene.prm", "--validate")
    expect("300 of 0.01 s" in shown and "duration 3 s, that of the record 'motion.txt'" in shown, shown)
    shown = runs("scene.prm", "--validate", "--set", "Motion/Time step=0.02")
    expect("150 of 0.02 s" in shown and "low-pass filtered at 25 Hz" in shown, shown)
    for name, dt, last in (("x", .005, 2.), ("y", .01, 1.5)):
        write(f"{name}.txt", "".join(f"{k * dt:.3f} {math.sin(4 * math.pi * k * dt):.9f}\n"
                                     for k in range(round(last / dt) + 1)))
    components = ["--set", "Motion/File=", "--set", "Motion/File x=x.txt", "--set", "Motion/File y=y.txt"]
    shown = runs("motion", "scene.prm", "--output", "two.csv", *components)
    names, rows = table("two.csv")
    expect(len(rows) == 151 and "the shortest record, 'y.txt'" in shown, shown)
    expect(all(abs(row[1] - row[2]) < 3e-4 * 9.81 and row[3] == 0 for row in rows), "components of unequal step")
    expect("warning: the motion does not end at rest" in shown and "in x displacement" in shown, shown)
    shown = runs("scene.prm", "--validate", *components)
    expect("warning: the motion does not end at rest" in shown, shown)
    refused(["scene.prm", "--validate", "--set", "Motion/Duration=2", *components], "y.txt", "1.5 s", "Motion/Duration")

    os.mkfifo("pipe")
    Path("folder").mkdir()
    write("endless.txt", "1" * 2000000)
    write("decimal.txt", "0,00;0;0;0\n0,01;1;1;1\n")
    for name, parts in {"/dev/zero": ("device",), "pipe": ("pipe",), "folder": ("directory",),
                        "endless.txt": ("million characters",), "decimal.txt": ("line 1", "5 columns")}.items():
        for command in (["scene.prm", "--validate"], ["motion", "scene.prm", "--output", "none.csv"]):
            refused([*command, "--set", f"Motion/File={name}"], name, *parts)
    expect(not Path("none.csv").exists(), "a motion was written")


def units():
    """A unit that is not the file's: what headings say, numbers that are too large, and small ones in a scene that names no unit."""
    write_scene()
    unitless = Path("scene.prm").read_text().replace("  set Unit = g\n", "").replace("motion.txt", "table.csv")
    expect("Unit" not in unitless, unitless)
    write("unitless.prm", unitless)

    def table_of(headings, peak):
        write("table.csv", headings + "".join(f"{.01 * k:.2f},{peak * math.sin(.4 * k):.6f},0,0\n" for k in range(60)))

    def asked(*options):
        return ["motion", "unitless.prm", "--output", "m.csv", *options]

    for headings, unit in (("t,X (g),Y (g),Z (g)\n", "g"), ("# Time [s], acceleration [cm/s2]\n", "cm/s^2"), ("t ax/gal ay/gal az/gal\n", "cm/s^2"),
                           ("Time;AX[m/s/s];AY[m/s/s];AZ[m/s/s]\n", "m/s^2"), ("# record in Gal\nt,x,y,z\n", "cm/s^2"), ("t,a_x,a_y,a_z\n", None),
                           ("# g, cm/s2 and m/s2\n", None)):
        table_of(headings, 2.)
        for given in ("g", "cm/s^2", "m/s^2"):
            options = asked("--set", f"Motion/Unit={given}")
            if unit in (None, given):
                runs(*options)
            else:
                refused(options, "table.csv", f"headings with the unit {unit}, but Motion/Unit is {given}", f"Set Motion/Unit = {unit}")
    table_of("# record in Gal\nt,x,y,z\n", 2.)
    runs(*asked("--set", "Motion/Unit=cm/s^2"))
    expected = Path("m.csv").read_bytes()
    for spelled in ("cm/s2", "gal", "Gal"):
        runs(*asked("--set", f"Motion/Unit={spelled}"))
        expect(Path("m.csv").read_bytes() == expected, f"a record in {spelled}")
    refused(asked("--set", "Motion/Unit=m/s"), "Motion/Unit", "m/s^2, m/s2, cm/s^2, cm/s2, mm/s^2, mm/s2, gal, Gal, g, %g, ft/s^2, ft/s2")
    table_of("# t [s], a [ft/s2]\n", 2.)
    refused(asked("--set", "Motion/Unit=m/s^2"), "headings with the unit ft/s^2", "Set Motion/Unit = ft/s^2")
    table_of("", 380.)  # in cm/s2
    expect("the peak acceleration of the motion is 38.7 g" in runs(*asked()), "a record in cm/s2 that is taken in m/s2")
    expect("the peak" not in runs(*asked("--set", "Motion/Unit=cm/s^2")), "a record in cm/s2")
    table_of("", .45)  # in g
    for command in (asked(), ["unitless.prm", "--validate"]):
        result = voussoir(*command)
        expect(result.returncode == 0 and "the input file has no Motion/Unit" in result.stdout + result.stderr, f"{result}")
    for unit in ("g", "m/s^2"):
        result = voussoir(*asked("--set", f"Motion/Unit={unit}"))
        expect("Motion/Unit" not in result.stdout + result.stderr, f"{unit}: {result}")
    table_of("t,X (m/s2),Y,Z\n", .45)
    expect("no Motion/Unit" not in voussoir(*asked()).stderr, "the headings say the unit")
    write("table.csv", "0,00;0,1;0,2;0,3\n0,01;0,1;0,2;0,3\n")
    refused(asked(), "table.csv', line 1", "Decimals have a point")


G = 9.80665


def noise(seed, n=1201, dt=.01):
    """An accelerogram of a random sequence of pulses [m/s^2], strong from 2 s to 6 s."""
    rng, x, v, a = random.Random(seed), 0., 0., []
    for k in range(n):
        t, w = k * dt, 2 * math.pi * 3.
        v += dt * (-.8 * w * v - w * w * x + rng.gauss(0, 1))
        x += dt * v
        a.append((t / 2.) ** 2 * v if t < 2 else v if t < 6 else v * math.exp(-.6 * (t - 6)))
    largest = max(map(abs, a))
    return [2.1 * value / largest for value in a]


def write_record(name, *components, dt=.01):
    return write(name, "".join(f"{k * dt:.4f}," + ",".join(f"{a:.15g}" for a in row) + "\n" for k, row in enumerate(zip(*components))))


def peak_response(acceleration, dt, period, damping):
    """Pseudo-acceleration by the method of central differences, with at least 100 steps per period."""
    n = max(2, math.ceil(100 * dt / period))
    h, w = dt / n, 2 * math.pi / period
    before, u, largest = 0., 0., 0.
    for a, b in zip(acceleration, acceleration[1:]):
        for i in range(n):
            p = -(a + (b - a) * i / n)
            after = (h * h * (p - w * w * u) + 2 * u - before * (1 - damping * w * h)) / (1 + damping * w * h)
            before, u = u, after
            largest = max(largest, abs(u))
    return w * w * largest


def spectrum_of_code(period):
    """DL 5073-2000 on rock, over the peak acceleration; beyond 3 s a constant displacement."""
    beta = 1 + 15 * period if period < .1 else 2.5 * max(.2, (.2 / max(period, .2)) ** .9)
    return beta * min(1., 3 / max(period, 3.)) ** 2


def corrections():
    """Baseline and matching of records, against a response spectrum of this script."""
    write_scene()
    unitless = Path("scene.prm").read_text().replace("  set Unit = g\n", "").replace("  set Duration = 0.5\n", "")
    write("matched.prm", unitless.replace("motion.txt", "record.csv"))
    x, y = noise(1), noise(2)
    write_record("record.csv", x, y, [0] * len(x))
    write_record("drifting.csv", [a + .05 - .007 * .01 * k for k, a in enumerate(x)], y, [0] * len(x))
    base = ["motion", "matched.prm", "--set", "Motion/Unit=m/s^2"]
    shown = runs(*base, "--output", "linear.csv", "--set", "Motion/Baseline=linear")
    expect(len(re.findall(r"^[xy]: linear baseline .* m/s, now 0; displacement .* m, now 0$", shown, re.M)) == 2 and "not end at rest" not in shown, shown)
    shown = runs(*base, "--output", "drift.csv", "--set", "Motion/Baseline=linear", "--set", "Motion/File=drifting.csv")
    for p, q in zip(table("linear.csv")[1], table("drift.csv")[1]):
        expect(all(abs(a - b) < 1e-11 for a, b in zip(p, q)), f"a straight line remains: {p}, {q}")
    shown = runs(*base, "--output", "drift.csv", "--set", "Motion/File=drifting.csv")
    expect("Correct the baseline (Motion/Baseline)" in shown, shown)

    pga, factor = .4, -1.5
    periods = [0.] + [.01 * 1.02 ** k for k in range(300)]
    write("target.csv", "T,Sa [g]\n" + "".join(f"{t:.12g},{pga * spectrum_of_code(t):.12g}\n" for t in periods))
    record = [*base[:2], "--output", "matched.csv", "--set", "Motion/Target spectrum=target.csv", "--set", "Motion/Unit=g",
              "--set", f"Motion/Factor={factor}"]
    shown = runs(*record)
    expect("spectrum, maximum error" in shown and "the spectrum of x" not in shown, shown)  # compared only
    write("weak.csv", "0 .4\n3 .2\n")
    shown = voussoir("motion", QUICKSTART, "--output", "weak_motion.csv", "--set", "Motion/Duration=1", "--set", f"Motion/Target spectrum={os.path.abspath('weak.csv')}")
    expect("peak acceleration of the target spectrum is 0.4." in shown.stderr, f"{shown}")
    write_record("record.csv", *([a / G for a in component] for component in (x, y, [0] * len(x))))
    shown = runs(*record, "--set", "Motion/Match=true")
    rows = table("matched.csv")[1]
    for d, name, original in ((1, "x", x), (2, "y", y)):
        note = re.search(rf"^{name}: multiplied .* now ([0-9.]+) % \(mean [0-9.]+ %, now ([0-9.]+) %\).* now ([0-9.]+);.*$", shown, re.M)
        largest, mean, peak = map(float, note.groups())
        a = [row[d] / factor for row in rows]
        errors = [peak_response(a, .01, t, .05) / (G * pga * spectrum_of_code(t)) - 1 for t in (.04 * (3 / .04) ** (k / 24.5) for k in range(25))]
        print(f"    {name}: largest error {100 * max(map(abs, errors)):.2f} %, mean {100 * sum(map(abs, errors)) / 25:.2f} %; reported {largest}, {mean}")
        expect(max(map(abs, errors)) < .01 * largest + .01 and largest < 10, f"{name}: errors {errors}, reported {largest} %")
        expect(sum(map(abs, errors)) / 25 < .01 * mean + .01 and mean < 3, f"{name}: errors {errors}, reported mean {mean} %")
        expect(abs(max(map(abs, a)) - pga * G) < 1e-9 and abs(peak - pga * abs(factor)) < 1e-3, f"{name}: peak acceleration")
        mine, its = math.hypot(*original), math.hypot(*a)
        expect(sum(p * q for p, q in zip(original, a)) > .5 * mine * its, f"{name}: another motion")
        first = float(re.search("multiplied by ([0-9.]+)", note[0])[1])
        expect(all(abs(a[k] - first * original[k]) < .01 * abs(a[k]) + 1e-12 for k in (0, -1)), f"{name}: additions at the ends: {a[0]}, {a[-1]}")
        expect(all(abs(a[k] - first * original[k]) < .5 * max(map(abs, a)) for k in range(50)), f"{name}: a blow in the first half second")
        expect("duration D5-95" in note[0] and "peak displacement" in note[0], note[0])
    expect(all(row[3] == 0 for row in rows), "a component without record is matched")
    for entries, parts in {("Match=true", "Target spectrum="): ("Motion/Match", "Motion/Target spectrum"),
                           ("Target spectrum=none.csv",): ("none.csv", "cannot be opened"),
                           ("Target spectrum=record.csv",): ("record.csv", "line 1"),
                           ("Match=true", "Duration=0.5"): ("Motion/Match", "50 steps"),
                           ("Baseline=cubic",): ("Motion/Baseline", "cubic")}.items():
        refused([*record, *(word for entry in entries for word in ("--set", f"Motion/{entry}"))], *parts)


def sequence():
    """Two records with rests, against the same motion from one file, and the first record alone."""
    write_scene()
    a, b = ([[.6 * G * math.sin(w * .01 * k) for k in range(n)] for w in (17, 23, 29)] for n in (31, 26))
    write_record("a.csv", *a)
    for c, component in zip("xyz", b):
        write_record(f"b_{c}.csv", component)
    rest = 20
    write_record("whole.csv", *(p + [0] * (rest - 1) + q + [0] * rest for p, q in zip(a, b)))
    common = [word for entry in ("Motion/File=", "Motion/Unit=m/s^2", "Motion/Duration=-1", "Motion/Rest=0.2", "Output/Block forces=true",
                                 "Limits/Base friction=1", "Statics/Gravity=9.81") for word in ("--set", entry)]
    parts = [*common, "--set", "Motion/Sequence=a.csv; b_x.csv, b_y.csv, b_z.csv"]
    one = [*common, "--set", "Motion/File=whole.csv", "--set", "Motion/Rest=0"]
    shown = runs("motion", "scene.prm", "--output", "parts_motion.csv", *parts)
    runs("motion", "scene.prm", "--output", "one_motion.csv", *one)
    expect("part 2, 'b_x.csv, b_y.csv, b_z.csv': 0.5 s to 0.75 s, rest until 0.95 s" in shown, shown)
    expect(Path("parts_motion.csv").read_bytes() == Path("one_motion.csv").read_bytes(), "the motions differ")

    shown = runs("scene.prm", "--output", "parts", *parts)
    runs("scene.prm", "--output", "one", *one)
    same("parts", "one", 1e-12)
    runs("scene.prm", "--output", "first", *common, "--set", "Motion/File=a.csv")
    found, last, first = summary("parts"), summary("one"), summary("first")
    states = found["motion_parts"]
    expect([(p["begin"], p["end"], p["end_of_rest"], p["time_of_residual"]) for p in states.values()] == [(0, .3, .5, .5), (.5, .75, .95, .95)],
           f"{states}")
    expect("motion_parts" not in last, "one record has no parts")
    for name in ("openings", "slips"):
        for state, of_run in ((states["part 1"], first), (states["part 2"], last)):
            expect(len(state[name]) == 2 and state[name] == of_run["residual"][name], f"{name}: {state}, {of_run['residual']}")
    for name, kind in (("opening", "openings"), ("slip", "slips")):
        with open("parts/joint_points.csv") as file:
            rows = list(csv.DictReader(file))
        for joint, value in enumerate(states["part 2"][kind], 1):
            expect(abs(max(float(row[f"residual_{name}"]) for row in rows if row["joint"] == str(joint)) - value) < 1e-6 * value + 1e-12, f"joint {joint}")
        at, worst = re.findall(rf"Residual .*t = ([0-9.]+) s: .*{name} ([0-9.]+) mm", shown)[-1]
        expect(at == "0.95" and abs(float(worst) - 1e3 * max(states["part 2"][kind])) < .006, shown)
    names, rows = table("parts/blocks.csv")
    safety = [found["blocks"][f"monolith {k}"]["end_sliding_safety"] for k in (1, 2, 3)]
    expect(all(abs(rows[-1][names.index(f"safety_{k}")] - safety[k - 1]) < 1e-6 * safety[k - 1] for k in (1, 2, 3)), f"{safety}")
    expect(f"sliding safety {min(safety):.3g} (monolith {safety.index(min(safety)) + 1})" in shown, shown)
    names, rows = table("parts/energy.csv")
    kinetic, largest = rows[-1][names.index("kinetic")], found["largest_energy"]
    expect(abs(found["end_kinetic_energy"] - kinetic / largest) < 1e-6 * kinetic / largest, "kinetic energy at the end")

    text, files = with_paths("Motion/Sequence", "a.csv; 3; b x.AT2, -, /c.AT2", Path("/d"))  # in a study
    expect(text == "/d/a.csv ; 3 ; /d/b x.AT2 , - , /c.AT2" and files == ["/d/a.csv", "/d/b x.AT2", "/c.AT2"], f"{text}: {files}")

    seeds = ["motion", QUICKSTART, "--set", "Motion/Duration=5", "--output"]
    shown = runs(*seeds, "seeds.csv", "--set", "Motion/Sequence=3; 1", "--set", "Motion/Scale y=0", "--set", "Motion/Scale z=0")
    expect("part 2, seed 1: 15 s to 20 s, rest until 30 s" in shown and "warning" not in shown, shown)
    runs(*seeds, "seed.csv", "--set", "Motion/Seed=1", "--set", "Motion/Scale y=0", "--set", "Motion/Scale z=0")
    both, alone = table("seeds.csv")[1], table("seed.csv")[1]
    expect(len(both) == 6001 or len(both) == 3001, f"{len(both)} samples")
    n = (len(both) - 1) // 30
    expect([row[1] for row in both[15 * n:20 * n + 1]] == [row[1] for row in alone], "the second motion is not that of its seed")
    expect(all(row[1] == 0 for row in both[5 * n + 1:15 * n] + both[20 * n + 1:]), "the rest is no rest")

    for entries, texts in {("Sequence=a.csv; none.csv",): ("none.csv", "cannot be opened"), ("Rest=-3",): ("Motion/Rest", "-3"),
                           ("Rest=0.015",): ("Motion/Rest", "multiple"), ("Rest=0",): ("Motion/Rest", "Time step"),
                           ("Sequence=b_x.csv; a.csv",): ("b_x.csv", "2 columns"), ("File=a.csv",): ("Motion/Sequence", "Motion/File"),
                           ("Source=artificial",): ("Motion/Sequence", "'a.csv' is not a seed")}.items():
        refused(["scene.prm", "--validate", *parts, *(word for entry in entries for word in ("--set", f"Motion/{entry}"))], *texts)


if __name__ == "__main__":
    run_cases(artificial, records, units, corrections, sequence)
