#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of `voussoir study`: what it refuses, what it repeats, what it says of scenes that fail, its table and its fits.

    program_study.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from run_program import VOUSSOIR, expect, refused, run_cases, runs, summary, write, write_scene

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
STUDY = """
set Scene = scene.prm
subsection Factors
  subsection Motion
    set Factor = 0.5 | 1
  end
  subsection Joints
    set Friction = 0.4 | 0.8
  end
end
"""
NAMES = [f"factor-{factor}_friction-{friction}" for factor in ("0.5", "1") for friction in ("0.4", "0.8")]


def study(*arguments, status=0):
    """A study's standard output and error."""
    result = subprocess.run([VOUSSOIR, "study", *arguments], capture_output=True, text=True, timeout=280)
    expect(result.returncode == status, f"status {result.returncode} of study {arguments}: {result.stdout}{result.stderr}")
    return result.stdout, result.stderr


def needs_snakemake():
    if shutil.which("snakemake") is None:
        print("Snakemake is not installed")
        sys.exit(77)


def rows_of(directory):
    with open(Path(directory) / "results.csv", newline="") as file:
        return {row["scene"]: row for row in csv.DictReader(file)}


def times_of(directory):
    """When each scene's summary was written [ns]."""
    return {path.parent.name: path.stat().st_mtime_ns for path in Path(directory, "runs").glob("*/summary.json")}


def not_read(text, *parts):
    """The study is refused with a message that has these parts."""
    from voussoir.errors import InputError
    from voussoir.study_file import read_study
    try:
        read_study(write("bad.prm", text))
    except InputError as error:
        print("   ", error)
        expect(all(part in str(error) for part in parts), f"{parts} is missing: {error}")
    else:
        raise AssertionError(f"{text} was read")


def refusals():
    """Everything is refused before a scene is run, with file, line and the nearest entry."""
    needs_snakemake()
    write_scene()
    for text, parts in ((STUDY.replace("set Factor", "set Facter"), ("bad.prm, line 5", '"Motion/Facter"', '"Motion/Factor"')),
                        (STUDY.replace("set Scene", "set Sceen"), ("bad.prm, line 2", '"Sceen"', '"Scene"')),
                        (STUDY.replace("set Scene = scene.prm", ""), ("which scene",)),
                        (STUDY.replace("= scene.prm", "= nowhere.prm"), ("line 2", "nowhere.prm", "not there")),
                        (STUDY.replace("0.4 | 0.8", "0.4 | 0.4"), ("line 8", '"0.4"', "twice")),
                        (STUDY.replace("0.4 | 0.8", "0.4 | | 0.8"), ("line 8", "missing")),
                        (STUDY.replace("0.4 | 0.8", "0.4 | 0.40"), ("line 8", '"0.40"', 'as "0.4"', "twice")),
                        (STUDY.replace("= scene.prm", "="), ("which scene",)),
                        (STUDY.replace("0.5 | 1", "1 ... " + "9" * 30), ("line 5", "9" * 30 + " values", "1 to 10000")),
                        (STUDY.replace("0.5 | 1", "5 ... 1"), ("line 5", "0 values")),
                        (STUDY.replace("0.4 | 0.8", "1 ... x"), ("line 8", "1 ... 10")),
                        (STUDY.replace("0.5 | 1", "1 ... 5001"), ("10002 scenes", "Combine")),
                        (STUDY + "set Combine = some\n", ("line 11", "one by one", '"some"')),
                        (STUDY + "set Threads = -1\n", ("line 11", "Threads")),
                        (STUDY + "subsection Limits\nset Opening = 3 kg\nend\n", ("line 12", "3 kg", "mm")),
                        (STUDY + "subsection Figures\nset Over = Motion/Seed\nend\n", ("line 12", "varies", "Motion/Factor")),
                        (STUDY + "subsection Settings\nset Joints/Friction = 1\nend\n", ("line 12", "two places")),
                        (STUDY + "end\n", ("line 11", "subsection")), (STUDY + "subsection A\n", ('"A"', "not closed")),
                        (STUDY + "set Table = table.csv\n", ("line 11", "table.csv", "cannot be read"))):
        not_read(text, *parts)
    for rows, parts in (("Motion/Seed,Joints/Modal\n1,FJA\n", ("table.csv, line 1", '"Joints/Model"')),
                        ("Motion/Seed\n", ("no rows",)), ("Motion/Seed,Joints/Model\n1\n", ("table.csv, line 2", "1 values for 2")),
                        ("Motion/Seed,Motion/Seed\n1,2\n", ("twice",))):
        write("table.csv", rows)
        not_read("set Scene = scene.prm\nset Table = table.csv\n", *parts)
    write("table.csv", "Motion/Seed\n1\n1\n")
    write("bad.prm", "set Scene = scene.prm\nset Table = table.csv\n")
    refused(["study", "bad.prm"], "table.csv, line 3", "twice")
    write("table.csv", "Motion/Factor\n1\n1.0\n")
    refused(["study", "bad.prm"], "table.csv, line 3", "twice")
    refused(["study", "nowhere.prm"], "nowhere.prm", "cannot be read")
    for profile in ("/nowhere/profile", "no_such_profile", "."):
        refused(["study", "bad.prm", "--profile", profile], "--profile", profile, "config.yaml")
    write("bad.prm", STUDY.replace("0.4 | 0.8", "0.4 | much"))
    refused(["study", "bad.prm"], "bad.prm, line 8", '"Joints/Friction"', '"much"', "a number")
    # Not valid as a scene: a duration that the records do not have
    write("bad.prm", STUDY.replace("set Factor = 0.5 | 1", "set Duration = 0.5 | 99"))
    refused(["study", "bad.prm"], "bad.prm, Motion/Duration = 99, Joints/Friction = 0.4", "1 more of the 4 scenes", "Duration")
    expect(not list(Path("output/bad/runs").iterdir()), "something was run")
    write("good.prm", STUDY)
    refused(["study", "good.prm", "--set", "Factors/Motion/Factr=1"], "--set", '"Motion/Factor"')
    Path("full").mkdir()
    write("full/mine.txt", "mine")
    refused(["study", "good.prm", "--output", "full"], "no study wrote")
    Path("bin").mkdir()
    Path("bin/python3").symlink_to("/usr/bin/python3")
    result = subprocess.run([VOUSSOIR, "study", "good.prm"], capture_output=True, text=True, env={**os.environ, "PATH": os.path.abspath("bin")})
    expect(result.returncode == 2 and "apt-get install snakemake" in result.stderr, f"without Snakemake: {result.stderr}")


def table():
    """2 x 2 scenes: what is in results.csv, and that nothing is done twice."""
    needs_snakemake()
    write_scene()
    write("four.prm", STUDY + "subsection Limits\nset Opening = 0.1 mm\nend\n")
    text, _ = study("four.prm", "--dry-run")
    expect(text.count("to do     factor-") == 4 and not times_of("output/four"), text)
    study("four.prm", "--jobs", "2")
    rows, first = rows_of("output/four"), times_of("output/four")
    expect(list(rows) == NAMES and list(first.keys() ^ rows.keys()) == [], f"{list(rows)}")
    for name, row in rows.items():
        run = summary(f"output/four/runs/{name}")
        expect(name == f"factor-{row['Motion/Factor']}_friction-{row['Joints/Friction']}", name)
        expect(float(row["opening"]) == float(f"{run['extremes']['max_opening']['value']:.9g}"), f"{name}: opening {row['opening']}")
        expect(abs(float(row["tension"]) - max(run["extremes"][f"max_tension_{face}stream_away_from_base"]["value"] for face in ("up", "down"))) < 1,
               f"{name}: tension {row['tension']}")
        expect(0 <= float(row["damage_share"]) <= 1 and float(row["seconds"]) > 0, f"{row}")
    one, two = (float(rows[name]["peak_acceleration"]) for name in (NAMES[0], NAMES[2]))
    expect(abs(two / one - 2) < 1e-6, f"peak accelerations {one}, {two}")
    for name in ("over_scale", "tornado"):
        expect(Path(f"output/four/figures/{name}.png").stat().st_size > 10000, f"{name}.png")
    # The same alone
    runs("scene.prm", "--set", "Motion/Factor=1", "--set", "Joints/Friction=0.8", "--output", "alone")
    expect(Path("alone/history.csv").read_bytes() == Path(f"output/four/runs/{NAMES[3]}/history.csv").read_bytes(), "another history")
    # Again: nothing; with one more value: one; with another factor instead of one that no longer varies: two new, two take their new name
    text, _ = study("four.prm")
    expect("4 before, 0 to do" in text and times_of("output/four") == first, text)
    write("four.prm", STUDY.replace("0.5 | 1", "1 | 1.2").replace("0.4 | 0.8", "0.8"))
    text, _ = study("four.prm")
    expect("1 before, 1 to do" in text and set(first.values()) <= set(times_of("output/four").values()), text)
    write("four.prm", STUDY.replace("0.5 | 1", "0.5").replace("set Friction", "set Model = FJA | FJB\n set Friction"))
    text, _ = study("four.prm")
    expect("2 before, 2 to do" in text and len(rows_of("output/four")) == 4, text)
    expect(set(first.values()) <= set(times_of("output/four").values()), "runs were repeated for their names")
    # A file that scenes read has changed: all again
    with open("motion.txt", "a") as file:
        print("# another file", file=file)
    text, _ = study("four.prm", "--dry-run")
    expect("0 before, 4 to do" in text, text)


def killed():
    """Killed with -9 in the middle and started again."""
    interrupted(signal.SIGKILL)


def stopped():
    """Stopped by SIGTERM in the middle and started again."""
    interrupted(signal.SIGTERM)


def interrupted(number):
    """What was done is not repeated, the rest is as if nothing had been."""
    needs_snakemake()
    write_scene(extra="subsection Output\nset Checkpoint interval = 20\nend\n")
    write("three.prm", STUDY.replace("0.5 | 1", "0.5 | 1 | 1.2").replace("0.4 | 0.8", "0.4"))
    words = ["three.prm", "--jobs", "1", "--set", "Settings/Motion/Duration=1", "--set", "Settings/Dynamics/Steps per sample=10"]
    process = subprocess.Popen([VOUSSOIR, "study", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    end = time.time() + 200
    second = []  # the scene that runs when one is done; Snakemake chooses the order
    while time.time() < end and not second:
        expect(process.poll() is None, "the study ended before it could be killed")
        time.sleep(.005)
        done = times_of("output/three")
        if len(done) == 1:
            second = [p.parent.name for p in Path("output/three/runs").glob("*/checkpoint.bin") if p.parent.name not in done]
    process.send_signal(number)
    _, error = process.communicate()
    expect(number == signal.SIGKILL or process.returncode == 1 and "goes on" in error, f"status {process.returncode}: {error}")
    first = times_of("output/three")
    expect(len(first) == 1, f"{len(first)} scenes were done when the study was killed")
    text, _ = study(*words)
    expect("1 before, 2 to do" in text, text)
    expect(first.items() <= times_of("output/three").items() and len(times_of("output/three")) == 3, "a scene was repeated")
    expect('"resumed": true' in Path(f"output/three/records/{second[0]}.json").read_text(), "the second scene did not go on from its checkpoint")
    for name in times_of("output/three"):
        runs(f"output/three/scenes/{name}.prm", "--output", f"whole/{name}")
        for file in ("history.csv", "joints.csv", "faces.csv"):
            expect(Path(f"whole/{name}/{file}").read_bytes() == Path(f"output/three/runs/{name}/{file}").read_bytes(),
                   f"{file} of {name} is another after the kill")


def failing():
    """A scene that fails is named with its message; --keep-going runs the others; mended, only it is run."""
    needs_snakemake()
    write_scene()
    text = STUDY.replace("subsection Joints\n    set Friction = 0.4 | 0.8", "subsection Concrete\n    set Young's modulus = 10 MPa | 21 GPa")
    write("soft.prm", text)
    _, error = study("soft.prm", "--jobs", "1", status=1)
    expect("_young-s-modulus-10-mpa: The static state of the dam is impossible" in error and "not run" in error, error)
    _, error = study("soft.prm", "--keep-going", status=1)
    expect(error.count("voussoir: failed: ") == 2 and "not run" not in error, error)
    good = times_of("output/soft")
    expect(len(good) == 2 and len(rows_of("output/soft")) == 2, f"{list(good)}")
    write("soft.prm", text.replace("10 MPa", "20 GPa"))
    out, _ = study("soft.prm")
    expect("2 before, 2 to do" in out and good.items() <= times_of("output/soft").items(), out)


def quantile(distribution, share):
    """By bisection."""
    low, high = -9., 9.
    for _ in range(60):
        middle = .5 * (low + high)
        low, high = (middle, high) if distribution(middle)[0] < share else (low, middle)
    return low


def fits():
    """Damaged area, fragility and tornado against what they must be."""
    import numpy as np
    from voussoir.study_figures import effects, independent, lognormal_fit, lognormal_of_passings, normal, passings
    from voussoir.study_file import Study
    from voussoir.study_results import area_above
    # A linear field on a unit square: the strip above the limit, for any direction
    points, cells = np.array([[0., 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2, 3]])
    for limit, share in ((-.1, 1), (0, 1), (.25, .75), (.5, .5), (.9, .1), (1, 0), (1.1, 0)):
        above, whole = area_above(points, cells, points[:, 0], limit)
        expect(abs(above - share) < 1e-14 and abs(whole - 1) < 1e-14, f"share above {limit}: {above}")
    above, _ = area_above(points, cells, points[:, 0] + points[:, 1], 1.5)
    expect(abs(above - .125) < 1e-14, f"corner: {above}")
    # Counts that are a lognormal distribution give it back
    scales = np.array([.2, .4, .6, .8, 1., 1.5])
    exact = normal((np.log(scales) - math.log(.7)) / .35)
    median, deviation = lognormal_fit(scales, 1e3 * exact, np.full(6, 1e3))
    expect(abs(median - .7) < 1e-9 and abs(deviation - .35) < 1e-9, f"{median}, {deviation}")
    for above in ([0] * 6, [10] * 6, [0, 0, 0, 10, 10, 10], [0, 0, 3, 10, 10, 10], [9, 8, 6, 4, 2, 1]):
        expect(lognormal_fit(scales, above, [10] * 6) is None, f"a fit for {above}")
    # Where curves pass a limit, and the distribution of that
    curves = {"1": {1.: 0., 2.: 4., 3.: 2.}, "2": {1.: 5., 2.: 6.}, "3": {1.: 0., 2.: 1.}, "4": {1.: 1., 3.: 3.}}
    expect(passings(curves, 2.) == ([1.5, 2.], [2.], [1.]), f"{passings(curves, 2.)}")
    median, deviation = lognormal_of_passings([math.exp(x) for x in (-1, 0, 1)], [], [])
    expect(abs(median - 1) < 1e-12 and abs(deviation - 1) < 1e-12, f"{median}, {deviation}")
    z = np.array([quantile(normal, (i + .5) / 2000) for i in range(2000)])
    known = np.exp(math.log(.7) + .35 * z)
    cut, low = float(np.exp(math.log(.7) + .35 * .5)), float(np.exp(math.log(.7) - .35))
    for parts in ((known[known < cut], [cut] * int((known >= cut).sum()), []),
                  (known[(known < cut) & (known > low)], [cut] * int((known >= cut).sum()), [low] * int((known <= low).sum()))):
        median, deviation = lognormal_of_passings(*parts)
        expect(abs(median - .7) < 1e-3 and abs(deviation - .35) < 1e-3, f"censored: {median}, {deviation}")
    expect(lognormal_of_passings([1., 2.], [3.], []) is None, "a fit to two")
    # What follows from another factor is none
    rows = [{"joints": j, "along": {"5": "60", "17": "54"}[j], "model": m, "steps": {"a": "1", "b": "1", "c": "5"}[m], "twin": m + m}
            for j in ("5", "17") for m in "abc"]
    expect(independent(["joints", "along", "model", "steps", "twin"], rows) == ["joints", "model"], "independent")
    # Tornado of a + 10 b, all combinations, and one by one
    rows = [({"a": str(a), "b": str(b), "scene": f"{a}{b}"}, a + 10. * b) for a in (1, 2, 3) for b in (0, 4)]
    found, base = effects(Study(Path("x"), factors=["a", "b"]), rows)
    expect(found["a"] == {"1": 21, "2": 22, "3": 23} and found["b"] == {"0": 2, "4": 42} and base is None, f"{found}, {base}")
    found, base = effects(Study(Path("x"), factors=["a", "b"]), [row for row in rows if row[0]["scene"] in ("10", "20", "30", "14")])
    expect(found["a"] == {"1": 1, "2": 2, "3": 3} and found["b"] == {"0": 1, "4": 41} and base == "10", f"{found}, {base}")


def examples():
    """The studies of the tree: what they would run; the small one is run."""
    needs_snakemake()
    studies = ROOT / "studies"
    from voussoir.study_file import read_study
    for name, scenes in (("ida/ida", 50), ("ida/small", 4), ("joints/joints", 15), ("joints/small", 9)):
        found = read_study(studies / f"{name}.prm")
        expect(len(found.scenes) == scenes, f"{name}: {len(found.scenes)} scenes")
    study(str(studies / "ida/small.prm"), "--set", "Settings/Motion/Duration=0.64", "--output", "small")
    expect(len(rows_of("small")) == 4, "rows")
    for figure in ("over_scale", "fragility", "tornado"):
        expect(Path(f"small/figures/{figure}.png").exists() and Path(f"small/figures/{figure}.pdf").exists(), figure)
    profile = Path("profile")
    profile.mkdir()
    write("profile/config.yaml", "cores: 2\n")
    text, _ = study(str(studies / "ida/small.prm"), "--set", "Settings/Motion/Duration=0.32", "--output", "other", "--profile", "profile")
    expect(len(rows_of("other")) == 4, text)


def joints():
    """The small study of joints and foundations: every foundation, tied and not, and the figure over the number of joints."""
    needs_snakemake()
    study(str(ROOT / "studies/joints/small.prm"), "--output", "joints", "--set", "Settings/Motion/Duration=0.32",
          "--set", "Settings/Motion/Rise end=0.05", "--set", "Settings/Motion/Decay begin=0.2")
    rows = rows_of("joints")
    expect(len(rows) == 9 and {row["foundation"] for row in rows.values()} == {"rigid", "massless", "rock"}, f"{list(rows)}")
    for name, row in rows.items():
        expect((row["Joints/Model"] == "tied") == (row["opening"] == "" or float(row["opening"]) == 0), f"{name}: opening {row['opening']}")
    expect(Path("joints/figures/over_scale.png").exists(), "the figure over the number of joints")


if __name__ == "__main__":
    os.environ["VOUSSOIR_PROGRAM"] = VOUSSOIR
    run_cases(refusals, table, killed, stopped, failing, fits, examples, joints)
