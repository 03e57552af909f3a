#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program on several ranks: the same bits for any number of them, checkpoints, errors.

    program_ranks.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import run_program
from run_program import contact_program, expect, run_cases, runs, settings, succeeds, write, write_scene

os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1")
SHORT = settings("Motion/Duration=0.3", "Output/Solution interval=10")
ROCK = settings("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                "Dynamics/Steps per sample=5", "Motion/Duration=0.3", "Output/Envelope interval=0")
WATER = settings("Reservoir/Model=acoustic", "Reservoir/Element size=25", "Reservoir/Reflection=0.5", "Dynamics/Steps per sample=4")
OWN = settings("Foundation/Substeps=4", "Dynamics/Steps per sample=2")


def launcher(n):
    mpirun = shutil.which("mpirun")
    if mpirun is None:
        print("SKIPPED: there is no mpirun")
        sys.exit(77)
    return [mpirun, "--oversubscribe", "-np", str(n), run_program.VOUSSOIR]


def on_ranks(n, *arguments):
    """Status, standard output, standard error."""
    result = subprocess.run([*launcher(n), *arguments], capture_output=True, text=True, timeout=240)
    return result.returncode, result.stdout, result.stderr


def numbers(directory):
    """summary.json without what depends on the machine."""
    def strip(value):
        if not isinstance(value, dict):
            return value
        return {key: strip(x) for key, x in value.items()
                if not any(word in key for word in ("second", "memory", "gib", "time_", "directory", "command", "threads",
                                                    "rank", "cpu", "wall", "date"))}
    return strip(json.loads(Path(directory, "summary.json").read_text()))


def same_bits(a, b):
    def bits(file):
        return [line for line in Path(file).read_bytes().splitlines() if not line.startswith(b"#")]  # VTK's date

    names = sorted(path.name for path in Path(a).glob("*.*") if path.suffix in (".bin", ".csv", ".vtu", ".pvd"))
    expect("history.csv" in names and "energy.csv" in names, f"files of {a}: {names}")
    expect(names == sorted(path.name for path in Path(b).glob("*.*") if path.suffix in (".bin", ".csv", ".vtu", ".pvd")),
           f"files of {a} and {b}")
    for name in names:
        expect(bits(f"{a}/{name}") == bits(f"{b}/{name}"), f"{name} of {a} and {b} differ")
    x, y = numbers(a), numbers(b)
    expect(x == y, f"summary.json of {a} and {b}: {[(k, x[k], y.get(k)) for k in x if x[k] != y.get(k)]}")


def any_number(name, ranks, *arguments):
    """The scene on one rank and on several."""
    runs("scene.prm", "--output", f"{name}.1", *arguments)
    for n in ranks:
        status, out, error = on_ranks(n, "scene.prm", "--output", f"{name}.{n}", *arguments)
        expect(status == 0, f"{name} on {n} ranks: status {status}: {out[-1000:]}{error[-2000:]}")
        expect(out.count("Energy    error") == 1, f"one rank speaks: {out}")
        same_bits(f"{name}.1", f"{name}.{n}")
        print(f"    {name}: {n} ranks, the same bits")


def rigid():
    """Every law, static and shaken; more ranks than bodies; one body that has it all."""
    write_scene()
    five = settings("Mesh/Arch210/Joints=5", "Mesh/Arch210/Elements along=12")
    any_number("FJA", (2, 4), *SHORT, *five)
    any_number("KSM", (2,), *SHORT, *five, *settings("Joints/Model=KSM"))
    any_number("cohesive", (2,), *SHORT, *five, *settings("Joints/Model=cohesive", "Joints/Strength=0.5 MPa"))
    any_number("few", (5,), *SHORT, *settings("Joints/Model=FJB"))
    any_number("tied", (2,), *SHORT, *settings("Joints/Model=tied"))
    any_number("double", (2,), *SHORT, *five, *settings("Dynamics/Factors=double"))
    any_number("water", (2,), *SHORT, *WATER)
    any_number("massless", (2,), *SHORT, *settings("Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true",
                                                   "Mesh/Arch210/Rock/Element size=60", "Concrete/Sustained modulus=14e9",
                                                   "Foundation/Sustained modulus=9e9"))


def crossings():
    """Contraction, lift and base joints that cross, with the preconditioner of their clusters."""
    write_scene()
    arguments = [*SHORT, *settings("Mesh/Arch210/Joints=5", "Mesh/Arch210/Elements along=12", "Mesh/Arch210/Lift joints=1")]
    any_number("lift", (2,), *arguments)
    arguments += settings("Mesh/Arch210/Base joint=true")
    any_number("base", (2, 4), *arguments)
    any_number("massless", (4,), *arguments, *settings("Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true",
                                                       "Mesh/Arch210/Rock/Element size=60"))


def problems():
    """The joints' problems are written whole, as by one rank."""
    write_scene()
    arguments = [*SHORT, *settings("Mesh/Arch210/Joints=5", "Mesh/Arch210/Elements along=12", "Contact/Write problems=true",
                                   "Contact/Write interval=9")]
    any_number("problems", (3,), *arguments)
    files = sorted(path.relative_to("problems.1") for path in Path("problems.1").rglob("problem-*.txt"))
    expect(len(files) > 3, f"problems: {len(files)}")
    expect(files == sorted(path.relative_to("problems.3") for path in Path("problems.3").rglob("problem-*.txt")), "their names")
    solved = []
    for n in (1, 3):
        out = succeeds(contact_program(*(Path(f"problems.{n}", file) for file in files[:4])))
        solved.append([{k: x for k, x in json.loads(line).items() if k not in ("file", "problem") and "second" not in k}
                       for line in out.splitlines()])
    expect(len(solved[0]) == 4 and solved[0] == solved[1], f"their solutions: {solved}")


def rock():
    """Every boundary, both free fields, matrix and kernel, steps of its own."""
    write_scene()
    for boundary in ("mtf3", "mtf2-plain", "viscous-spring", "fixed"):
        any_number(boundary, (2,), *ROCK, *settings(f"Foundation/Boundary={boundary}"))
    any_number("double", (2,), *ROCK, *settings("Dynamics/Factors=double"))
    any_number("sections", (3,), *ROCK, *settings("Foundation/Free field=sections"))
    any_number("water", (3,), *ROCK, *WATER, *settings("Foundation/Free field=sections"))
    any_number("water_columns", (2,), *ROCK, *WATER, *settings("Foundation/Free field=columns"))
    any_number("gauss", (2,), *ROCK, *settings("Foundation/Nodal quadrature everywhere=false",
                                               "Foundation/Stiffness damping=6e-4"))
    any_number("wide", (3,), *ROCK, *settings("Foundation/Layers at the dam=4", "Foundation/Nodal layers=3", "Foundation/Boundary=viscous-spring"))
    any_number("own", (2, 4), *ROCK, *OWN, *settings("Mesh/Arch210/Joints=5", "Mesh/Arch210/Elements along=12"))


def killed(n, directory, *arguments):
    """A run on n ranks that is killed once it has a checkpoint."""
    process = subprocess.Popen([*launcher(n), "scene.prm", "--output", directory, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not Path(directory, "checkpoint.txt").exists():
        time.sleep(.002)
    children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()
    expect(len(children) == n, f"{len(children)} processes of {n}")
    os.kill(int(children[-1]), signal.SIGKILL)
    error = process.communicate(timeout=60)[1]
    expect(process.returncode != 0 and error.strip() != "", f"killed: status {process.returncode}, {error}")
    expect(Path(directory, "checkpoint.bin").exists(), "the run ended before it could be killed")


def killed_and_continued(*arguments):
    """A rank of two is killed; three ranks continue the run, with the bits of a whole run."""
    killed(2, "killed", *arguments)
    status, _, error = on_ranks(3, "scene.prm", "--output", "killed", "--resume", *arguments)
    expect(status == 0, error)
    runs("scene.prm", "--output", "whole", *arguments)
    same_bits("killed", "whole")


def checkpoint():
    """A rank is killed: the others end; the run goes on on another number of ranks, with the same bits."""
    write_scene()
    for name, arguments in (("dam", settings("Output/Checkpoint interval=40", "Motion/Duration=3")),
                            ("rock", [*ROCK, *settings("Output/Checkpoint interval=40", "Motion/Duration=2")]),
                            ("own", [*ROCK, *OWN, *settings("Output/Checkpoint interval=20", "Motion/Duration=2")])):
        killed(3, name, *arguments)
        shutil.copytree(name, f"{name}_1")
        runs("scene.prm", "--output", f"{name}_1", "--resume", *arguments)
        status, _, error = on_ranks(2, "scene.prm", "--output", name, "--resume", *arguments)
        expect(status == 0, error)
        same_bits(name, f"{name}_1")
        runs("scene.prm", "--output", f"{name}_whole", *arguments)
        same_bits(name, f"{name}_whole")


def oblique():
    """Waves across, along and at an angle to the valley: several ranks give the same bits, also after a rank is killed."""
    write_scene()
    arguments = [*ROCK, *settings("Foundation/Incidence=SV 15 90, SH 20 0, P 10 30 0.01")]
    any_number("oblique", (2, 3), *arguments)
    any_number("columns", (3,), *arguments, *settings("Foundation/Free field=columns"))
    any_number("oblique_water", (2,), *arguments, *WATER)
    arguments += settings("Output/Checkpoint interval=40", "Motion/Duration=2")
    killed_and_continued(*arguments)


def quality():
    """Rock with a quality factor, with a time step of its own and with that of the dam: the same bits on several ranks, also after a
    rank is killed."""
    write_scene()
    arguments = [*ROCK, *settings("Foundation/Quality factor=20")]
    any_number("columns", (2,), *arguments, *settings("Foundation/Free field=columns"))
    arguments += OWN
    any_number("sections", (3,), *arguments)
    arguments += settings("Output/Checkpoint interval=20", "Motion/Duration=2")
    killed_and_continued(*arguments)


def last_write():
    """The last files cannot be written: the state that is kept is that of all ranks, also of the rock, and all there is to
    tell of it."""
    write_scene()
    for n in (1, 2):
        directory = f"end_{n}"
        Path(directory, "summary.json").mkdir(parents=True)
        status, _, error = on_ranks(n, "scene.prm", "--output", directory, "--overwrite", *ROCK)
        expect(status == 1 and "summary.json" in error and "is kept" in error, f"status {status}: {error}")
        Path(directory, "summary.json").rmdir()
        runs("scene.prm", "--output", directory, "--resume", *ROCK)
    runs("scene.prm", "--output", "whole", *ROCK)
    same_bits("end_1", "whole")
    same_bits("end_2", "whole")


def stopped():
    """A signal to one of the ranks: all keep the state and stop."""
    write_scene()
    arguments = settings("Motion/Duration=3", "Output/Checkpoint interval=1000")
    process = subprocess.Popen([*launcher(2), "scene.prm", "--output", "out", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and (not Path("out/history.csv").exists() or
                                      len(Path("out/history.csv").read_text().splitlines()) < 10):
        time.sleep(.002)
    children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()
    os.kill(int(children[1]), signal.SIGTERM)
    error = process.communicate(timeout=60)[1]
    expect(process.returncode == 1 and error.count("voussoir: stopped: ") == 1 and "--resume" in error, error)
    status, _, error = on_ranks(2, "scene.prm", "--output", "out", *arguments, "--resume")
    expect(status == 0, error)


def errors():
    """Each reaches the user once, with its status; nobody waits for ever."""
    write_scene()
    good = Path("scene.prm").read_text()
    write("unknown.prm", good + "subsection Joints\n set Frictoin = 1\nend\n")
    write("no_file.prm", good.replace("motion.txt", "nothing.txt"))
    Path("there").write_text("a file\n")
    Path("full").mkdir()
    Path("full/history.csv").mkdir()
    for arguments, status, part in ((["unknown.prm"], 2, "Frictoin"), (["no_file.prm"], 2, "nothing.txt"),
                                    (["missing.prm"], 2, "missing.prm"), (["scene.prm", "--frob"], 2, "--frob"),
                                    (["scene.prm", "--set", "Motion/Factor=nan"], 2, "Motion/Factor"),
                                    (["scene.prm", "--output", "there"], None, "there"),
                                    (["scene.prm", "--output", "full", "--overwrite"], 1, "history.csv")):
        began = time.time()
        got, _, error = on_ranks(2, *arguments)
        expect(error.count("voussoir: ") - error.count("voussoir: warning") == 1 and part in error, f"{arguments}: {error}")
        expect(got == status or status is None and got in (1, 2), f"{arguments}: status {got}: {error}")
        expect(time.time() - began < 60, f"{arguments} took {time.time() - began} s")
    # Ranks with different scenes are none of one run; an error of one rank alone ends the others, who wait for it.
    def apart(first, second):
        return subprocess.run([*launcher(1), *first, ":", "-np", "1", run_program.VOUSSOIR, *second], capture_output=True, text=True,
                              timeout=120)

    scene = ["scene.prm", "--output", "mixed"]
    result = apart(scene, [*scene, *settings("Motion/Factor=2")])
    expect(result.returncode == 2 and "different scenes" in result.stderr, f"{result.returncode}: {result.stderr}")
    result = apart(scene, ["missing.prm", *scene[1:]])
    expect(result.returncode == 2 and result.stderr.count("missing.prm") == 1 and "(rank 1)" in result.stderr,
           f"{result.returncode}: {result.stderr}")
    # What is not a run is done by the first rank.
    status, out, error = on_ranks(2, "--version")
    expect(status == 0 and out.count("Voussoir") == 1, out + error)
    status, out, error = on_ranks(2, "mesh", "scene.prm", "--output", "mesh.msh")
    expect(status == 0 and out.count("dam : z from") == 1 and Path("mesh.msh").exists(), out + error)
    status, out, error = on_ranks(2, "modes", "scene.prm", "--count", "2", "--output", "modes")
    expect(status == 0 and out.count("mode  frequency") == 1 and Path("modes/modes.csv").exists(), out + error)
    status, out, error = on_ranks(2, "scene.prm", "--validate")
    expect(status == 0 and out.count("Memory") == 1, out + error)


if __name__ == "__main__":
    run_cases(rigid, crossings, rock, problems, checkpoint, oblique, quality, last_write, stopped, errors)
