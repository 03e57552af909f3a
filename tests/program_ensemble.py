#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ensembles of motions: batches against single runs, any lane and thread, resumed runs, statistics, refusals.

    program_ensemble.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import csv
import os
import shutil
import signal
import subprocess
import time
from math import sin
from pathlib import Path
from statistics import median

from program_bodies import column
from program_bodies import scene as body_scene
from run_program import MESH, VOUSSOIR, expect, refused, run_cases, runs, settings, summary, voussoir, write

ARTIFICIAL = MESH + """
subsection Joints
  set Friction = 0.6
end
subsection Motion
  set Duration = 1.5
end
subsection Output
  set Figures = false
end
"""
EXPLICIT = settings("Dynamics/Scheme=explicit")
LIMIT = 1e-4  # difference of single precision, relative to the largest opening or slip, and to the largest stress
LIMIT_WITHOUT_WATER = 2e-4  # of stresses, which impacts of monoliths without added mass change by 1.2e-4


def ensemble(directory, motions, *arguments, environment=None, scene="scene.prm"):
    """Rows of ensemble.csv by name of the motion."""
    write("scene.prm", ARTIFICIAL)
    print(runs(scene, "--output", directory, "--overwrite", *settings(f"Motion/Ensemble={motions}"), *arguments, environment=environment)[-700:])
    return rows_of(directory)


def rows_of(directory):
    with open(f"{directory}/ensemble.csv") as file:
        return {(row["name"], row["factor"]): row for row in csv.DictReader(file)}


def numbers(row):
    return {name: float(value) for name, value in row.items() if name not in ("motion", "name", "status", "overstress_seconds") and value}


def largest_difference(row, other, limits=(1., 1.)):
    """Of all extremes and joints, relative to the largest number of the same unit, and to the limits of lengths and stresses."""
    row, other = numbers(row), numbers(other)
    expect(row.keys() == other.keys() and len(row) > 20, "the rows have the same columns")
    kinds = {name: "length" if "opening" in name or "slip" in name else "stress" for name in row}
    size = {kind: max(abs(row[name]) for name in row if kinds[name] == kind) for kind in kinds.values()}
    limit = dict(zip(("length", "stress"), limits))
    return max(abs(row[name] - other[name]) / size[kinds[name]] / limit[kinds[name]] for name in row)


def single(directory):
    """The results of a run in the columns of ensemble.csv."""
    row = {"factor": "1", **{name: str(extreme["value"]) for name, extreme in summary(directory)["extremes"].items() if "above_foot" not in name}}
    kept = [0.]
    with open(f"{directory}/joint_history.csv") as file:
        history = list(csv.DictReader(file))
    of_contraction = [str(k) for k, name in enumerate(summary(directory)["mesh"]["joint_names"], 1) if name.split()[0] not in ("base", "lift")]
    for name in (name for name in history[0] if name.startswith("opening_") and name.split("_")[-1] in of_contraction):
        ends = [float(line[name]) for line in history]
        least = min(ends[ends.index(max(ends)):])
        kept.append(least if max(ends) > 1e-4 and least > .01 * max(ends) else 0.)
    row["kept_opening"] = str(max(kept))
    faces = summary(directory).get("overstress", {})
    row["overstress_seconds"] = str(max(faces[face]["duration_away_from_base"][0] for face in ("upstream", "downstream"))) if faces else ""
    with open(f"{directory}/joints.csv") as file:
        joints = [{name: float(value) for name, value in joint.items()} for joint in csv.DictReader(file)]
    for quantity in ("opening", "slip"):
        for k, joint in enumerate(joints, 1):
            row[f"{quantity}_{k}"] = str(max(joint[f"{quantity}_upstream"], joint[f"{quantity}_downstream"]))
    return row


def agrees(directory, number, name, limit, of_stress=None):
    row, alone = rows_of(directory)[name, "1"], single(f"{directory}/motion-{number}")
    difference = limit * largest_difference(row, alone, (limit, of_stress or limit))
    expect(row["overstress_seconds"] == alone["overstress_seconds"] == "" or abs(float(row["overstress_seconds"]) - float(alone["overstress_seconds"])) < 1e-6,
           f"{name}: {row['overstress_seconds']} s above the strength in a batch, {alone['overstress_seconds']} s alone")
    print(f"    {directory}: {name[:40]} in a batch and alone: difference {difference:.1e}, limit {limit:.0e}")
    expect(difference <= limit, f"{name} differs by {difference:.1e} from its own run")


def lanes():
    """A batch agrees with single runs; its results do not depend on lanes, threads and other motions; sizes of lanes agree."""
    both = ensemble("both", "1-3", *EXPLICIT, *settings("Motion/Ensemble output=1, 3"))
    expect(summary("both")["ensemble"]["lanes"] in (4, 8, 16), "the motions run in a batch")
    for number in (1, 3):
        agrees("both", number, f"seed {number}", LIMIT)
    seventeen = ensemble("seventeen", "3; 21-35; 1", *EXPLICIT, environment={"OMP_NUM_THREADS": "2"})
    for seed in (1, 3):
        name = (f"seed {seed}", "1")
        expect(numbers(both[name]) == numbers(seventeen[name]), "a result depends on its lane, on threads or on the other motions")
    one = ensemble("one", "3", *EXPLICIT)
    expect(numbers(one["seed 3", "1"]) == numbers(both["seed 3", "1"]), "one motion alone in a batch")
    expect(summary("one")["ensemble"]["max_opening"]["known_68"] is None, "one motion says nothing of the scatter")
    for n in (4, 8):
        narrow = ensemble(f"narrow{n}", "1-3", *EXPLICIT, environment={"VOUSSOIR_LANES": str(n)})
        expect(summary(f"narrow{n}")["ensemble"]["lanes"] <= n, "VOUSSOIR_LANES limits the lanes")
        for name in both:
            expect(largest_difference(both[name], narrow[name]) < LIMIT, f"{n} lanes agree with the others")


def laws():
    """All laws with a batch, also mixed, with and without added mass and damping, against single runs; other scenes run one by one."""
    for name, *more in (("fjb", "Joints/Model=FJB"), ("mixed", "Joints/Overrides=1: FJB, 2: tied"), ("smooth", "Joints/Friction=0"),
                        ("dry", "Reservoir/Density=0", "Damping/Terms=1"), ("four", "Damping/Terms=4"),
                        ("undamped", "Damping/Mass coefficient=0", "Damping/Stiffness coefficient=0", "Damping/Model=Rayleigh")):
        ensemble(name, "4; 5", *EXPLICIT, *settings("Motion/Ensemble output=1, 2", *more))
        expect(summary(name)["ensemble"]["lanes"] > 1, f"{name} runs in a batch")
        for number, seed in ((1, 4), (2, 5)):
            agrees(name, number, f"seed {seed}", LIMIT, LIMIT_WITHOUT_WATER if name == "dry" else LIMIT)
    for name, more, reason in (("keys", ("Joints/Model=KSM",), "law"), ("lift", ("Mesh/Arch210/Lift joints=1",), "joints cross"),
                               ("implicit", ("Dynamics/Scheme=trapezoidal",), "not explicit")):
        ensemble(name, "5", *EXPLICIT, *settings("Motion/Ensemble output=1", "Motion/Duration=0.3", *more))
        expect(reason in Path(name, "log.txt").read_text(), f"{name}: the log gives the reason '{reason}'")
        agrees(name, 1, "seed 5", 1e-7)  # of the digits in the tables


def sequential():
    """Statistics of an ensemble with factors, from its table; medians of the fields lie between the single ones."""
    rows = ensemble("factors", "1-5", *settings("Motion/Ensemble factors=0.5, 1", "Motion/Duration=0.5", "Limits/Opening=0.001",
                                                "Limits/Static tensile strength=1e6", "Motion/Ensemble output=10"))
    expect(len(rows) == 10, "five motions for each factor")
    of_all = summary("factors")["ensemble"]
    expect(of_all["n"] == 5 and of_all["factor"] == 1 and [f["factor"] for f in of_all["factors"]] == [.5, 1], "factors in summary.json")
    for factor in of_all["factors"]:
        openings = sorted(float(row["max_opening"]) for row in rows.values() if float(row["factor"]) == factor["factor"])
        found = factor["max_opening"]
        expect(abs(found["median"] - median(openings)) < 1e-9 and [found["min"], found["max"]] == [openings[0], openings[-1]], "median and range")
        expect(abs(found["p16"] - (openings[0] + .64 * (openings[1] - openings[0]))) < 1e-9, "percentile by linear interpolation")
        expect(0 < found["known_68"] < found["known_95"] and found["motions_for_10_percent"] >= 1, "how well the median is known")
        expect(factor["motions_above_limit"]["opening"] == sum(x > .001 for x in openings), "motions above the limit")
        expect(factor["overstress_seconds"]["max"] > 0, "duration above the strength")
    expect(Path("factors/motion-10/history.csv").exists() and not Path("factors/motion-1").exists(), "tables on request")
    with open("factors/faces.csv") as file:
        faces = list(csv.DictReader(file))
    expect(all(float(f["max_principal_p16"]) <= float(f["max_principal"]) <= float(f["max_principal_p84"]) for f in faces), "median fields")
    half = rows["seed 5", "0.5"]
    runs("scene.prm", "--output", "alone", *settings("Motion/Seed=5", "Motion/Factor=0.5", "Motion/Duration=0.5", "Limits/Static tensile strength=1e6"))
    difference = largest_difference({**half, "factor": "1", "overstress_seconds": ""}, single("alone"))
    expect(difference < 1e-7, f"a factor is that of the motion: difference {difference}")


def resumed():
    """An ensemble that is stopped goes on bitwise identically, in batches and one by one."""
    for scheme, motions, more in (("explicit", "1-12", ("Motion/Duration=2",)), ("trapezoidal", "1-5", ("Motion/Duration=1",))):
        chosen = settings(f"Dynamics/Scheme={scheme}", *more)
        environment = {"VOUSSOIR_LANES": "4", "OMP_NUM_THREADS": "1"}
        ensemble(f"{scheme}_whole", motions, *chosen, environment=environment)
        stop(f"{scheme}_cut", motions, chosen, environment)
        again = runs("scene.prm", "--output", f"{scheme}_cut", "--resume", *settings(f"Motion/Ensemble={motions}"), *chosen, environment=environment)
        expect("motions are complete" in again, again)
        expect(Path(f"{scheme}_whole/ensemble.csv").read_bytes() == Path(f"{scheme}_cut/ensemble.csv").read_bytes(), "a resumed ensemble")
        expect(not Path(f"{scheme}_cut/checkpoint.bin").exists(), "a complete ensemble has no checkpoint")
    refused(["scene.prm", "--output", "explicit_cut", "--resume", *settings("Motion/Ensemble=1-12")], "no checkpoint")


def stop(directory, motions, chosen, environment):
    """Stops an ensemble after its first results."""
    for _ in range(10):
        shutil.rmtree(directory, ignore_errors=True)
        process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", directory, "--overwrite", *settings(f"Motion/Ensemble={motions}"), *chosen],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, **environment})
        while not Path(directory, "checkpoint.bin").exists() and process.poll() is None:
            time.sleep(.001)
        process.send_signal(signal.SIGTERM)
        message = process.communicate()[1]
        if process.returncode == 1 and "motions were complete" in message and "--resume" in message:
            return
    raise AssertionError("the ensemble always ends before it can be stopped: " + message)


def unstable():
    """A motion that fails is named; the others have the results that they have without it."""
    for scheme in ("explicit", "trapezoidal"):
        chosen = settings(f"Dynamics/Scheme={scheme}", "Motion/Duration=0.6")
        alone = ensemble(f"{scheme}_alone", "1-2", *chosen)
        result = voussoir("scene.prm", "--output", scheme, *settings("Motion/Ensemble=1-2", "Motion/Ensemble factors=1, 500", *()), *chosen)
        print("   ", result.stderr.strip())
        expect(result.returncode == 1 and "2 of 4 motions have no results: seed 1 times 500" in result.stderr, f"status {result.returncode}")
        rows = rows_of(scheme)
        for name, row in alone.items():
            expect(numbers(rows[name]) == numbers(row) and rows[name[0], "500"]["status"] != "ok", f"{name} beside an unstable motion")
        expect(len(summary(scheme)["ensemble"]["failures"]) == 2, "failures in summary.json")


def records():
    """Records of different lengths and intervals, also of zeros, in one batch: each one as alone."""
    for name, n, dt, size in (("short", 60, .01, 1.), ("long", 500, .002, 2.), ("zero", 80, .01, 0.)):
        write(f"{name}.txt", "".join(f"{k * dt} {size * sin(40 * k * dt)} {size * sin(31 * k * dt)} 0\n" for k in range(n + 1)))
    files = "short.txt; long.txt; zero.txt"
    strength = settings("Limits/Static tensile strength=3e5", "Output/Envelope interval=20 ms")
    rows = ensemble("records", files, *EXPLICIT, *strength, *settings("Motion/Source=file", "Motion/Duration=-1", "Motion/Ensemble output=1, 2, 3"))
    lasting = [float(row["overstress_seconds"]) for row in rows.values()]
    expect(min(lasting[:2]) > .1 and lasting[0] < lasting[1], f"durations above the strength: {lasting}")
    for number, name in enumerate(("'short.txt'", "'long.txt'", "'zero.txt'"), 1):
        agrees("records", number, name, LIMIT)
    expect(summary("records/motion-1")["steps"] < summary("records/motion-2")["steps"], "the records have different lengths")
    for axis, rate in (("x", 40), ("z", 31)):
        write(f"{axis}.txt", "".join(f"{k * .01} {sin(rate * k * .01)}\n" for k in range(61)))
    ensemble("three", "x.txt,-,z.txt; long.txt", *EXPLICIT, *settings("Motion/Source=file", "Motion/Duration=-1", "Motion/Ensemble output=2"))
    agrees("three", 2, "'long.txt'", LIMIT)


def kept():
    """Files of others, write errors, limits on base forces, warnings of later motions, statistics of zeros, very short steps."""
    Path("others/motion-1").mkdir(parents=True)
    write("others/motion-1/notes.txt", "precious")
    ensemble("others", "1-2", *settings("Motion/Duration=0.2"))
    expect(Path("others/motion-1/notes.txt").exists() and not Path("others/motion-1/summary.json").exists(), "a file of others")
    Path("full").mkdir()
    Path("full/checkpoint.bin.new").mkdir()
    result = voussoir("scene.prm", "--output", "full", "--overwrite", *settings("Motion/Ensemble=1-2", "Motion/Duration=0.2"), *EXPLICIT)
    expect(result.returncode == 1 and "cannot be written" in result.stderr, f"status {result.returncode}: {result.stderr}")
    ensemble("sliding", "1-2", *EXPLICIT, *settings("Motion/Duration=0.3", "Limits/Sliding safety=3", "Limits/Base friction=0.8"))
    expect(summary("sliding")["ensemble"]["motions_above_limit"] == {"sliding_safety": 2}, "limits of base forces")
    ensemble("zeros", "1-8", *EXPLICIT, *settings("Motion/Duration=0.5", "Limits/Static tensile strength=4e6", "Joints/Model=FJB"))
    found = summary("zeros")["ensemble"]
    expect(found["overstress_seconds"]["min"] == 0 and found["overstress_seconds"]["motions_for_10_percent"] is None, "zeros have no logarithm")
    expect(found["max_slip"]["known_68"] is None, "slips of joints without slip are noise")
    for name, size in (("weak", 1.), ("big", 30.)):
        write(f"{name}.txt", "".join(f"{k * .01} {size * sin(.3 * k)} 0 0\n" for k in range(21)))
    shown = runs("scene.prm", "--validate", *settings("Motion/Ensemble=weak.txt; big.txt", "Motion/Source=file", "Motion/Duration=-1"))
    expect("'big.txt': " in shown and "peak acceleration" in shown, "warnings of all motions")
    mesh = column("column", 4, .4, {"bottom": 1})  # without faces of a dam: stresses away from the base are not defined
    body = ["--output", "body", "--overwrite", *settings("Motion/Ensemble=1-3", "Motion/Duration=0.2")]
    runs(body_scene("body", mesh, Motion={"Source": "artificial"}), *body)
    found = summary("body")["ensemble"]
    expect(found["max_tension_upstream_away_from_base"]["median"] is None and found["max_compression"]["median"] < 0, f"{found}")
    shown = runs("scene.prm", "--validate", *settings("Motion/Ensemble=1-2", "Motion/Seed=5"))
    expect("Motion/Seed has no effect" in shown or "Motion/Seed" in shown and "no effect" in shown, "an idle seed")
    ensemble("short", "1", *EXPLICIT, *settings("Motion/Duration=0.2", "Dynamics/Explicit step=0.0001"))
    expect("single precision" in Path("short/log.txt").read_text(), "very short steps run one by one")


def kept_base():
    """Base joints that stay open keep no opening at the crest. A base that slides by 0.4 m exceeds LIMIT."""
    arch = ("Source=arch210", "Arch210/Joints=3", "Arch210/Elements along=16", "Arch210/Elements up=6", "Arch210/Elements through=2", "Arch210/Base joint=true")
    base = [*EXPLICIT, *settings(*(f"Mesh/{entry}" for entry in arch), "Motion/Ensemble output=1", "Joints/Overrides=contraction: tied",
                                 "Reservoir/Water level=150")]
    ensemble("strong", "1", *base, *settings("Motion/Scale x=2"))
    agrees("strong", 1, "seed 1", 4 * LIMIT)
    ensemble("base", "1", *base)
    agrees("base", 1, "seed 1", LIMIT)
    with open("base/motion-1/joint_history.csv") as file:
        last = list(csv.DictReader(file))[-1]
    expect(rows_of("base")["seed 1", "1"]["kept_opening"] == "0" and float(last["opening_upstream_7"]) > .001, f"{last}")


def entries():
    """What an ensemble refuses, before any work."""
    write("scene.prm", ARTIFICIAL)
    write("a.txt", "0 0 0 0\n0.01 0 0 0\n")
    scene = lambda *chosen: ["scene.prm", "--output", "none", *settings(*chosen)]
    refused(scene("Motion/Ensemble=1-16", "Motion/Sequence=1; 2"), "Ensemble", "Sequence")
    refused(scene("Motion/Ensemble=16-1"), "range", "16-1")
    refused(scene("Motion/Ensemble=1-x"), "not a seed")
    refused(scene("Motion/Ensemble=1; 2; 1-3"), "seed 1", "twice")
    refused(scene("Motion/Ensemble=1-200000"), "range")
    refused(scene("Motion/Ensemble=1-6000", "Motion/Ensemble factors=1, 2"), "12000 motions")
    refused(scene("Motion/Ensemble=1-4", "Motion/Ensemble factors=1, 0"), "factors", "'0'")
    refused(scene("Motion/Ensemble=1-4", "Motion/Ensemble factors=1, 1"), "twice")
    refused(scene("Motion/Ensemble=1-4", "Motion/Ensemble output=5"), "Ensemble output", "from 1 to 4")
    refused(scene("Motion/Ensemble factors=1, 2"), "require Motion/Ensemble")
    refused(scene("Motion/Ensemble=1-4", "Motion/Source=none"), "Source")
    refused(scene("Motion/Ensemble=a.txt; b.txt", "Motion/Source=file", "Motion/File=a.txt"), "both given")
    refused(scene("Motion/Ensemble=a.txt; b.txt", "Motion/Source=file", "Motion/Duration=-1"), "b.txt")
    shown = runs("motion", "scene.prm", "--output", "m.csv", *settings("Motion/Ensemble=3; 1-2", "Motion/Ensemble factors=2, 1"))
    runs("motion", "scene.prm", "--output", "n.csv", *settings("Motion/Seed=3", "Motion/Factor=2"))
    expect("the first one, seed 3" in shown and Path("m.csv").read_bytes() == Path("n.csv").read_bytes(), "the motion of an ensemble is the first")
    refused(scene("Motion/Ensemble=1-4", "Motion/Ensemble output=1.5"), "no whole number")
    shown = runs("scene.prm", "--validate", *settings("Motion/Ensemble=4294967294-4294967295"))
    expect("2 motions" in shown, "the last seeds")
    runs("scene.prm", "--validate", *settings("Motion/Ensemble=1-4"))
    expect(not Path("output").exists(), "--validate writes nothing")


if __name__ == "__main__":
    run_cases(lanes, laws, sequential, resumed, unstable, records, kept, kept_base, entries)
