#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: nothing that it was given, or has computed, is lost.

    program_safety.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.vtu import read_vtu  # noqa: E402
from program_wedges import write_wedges  # noqa: E402
from run_program import (VOUSSOIR, arch_mesh, expect, refused, run_cases, runs, same, settings, table, voussoir, write,  # noqa: E402
                         write_scene)

LONG = ["--set", "Motion/Duration=3"]


def failed(result, *parts):
    """The run must have ended with status 1 and a message that has all these parts."""
    message = "".join(line + "\n" for line in result.stderr.splitlines() if not line.startswith("voussoir: stopping when"))
    what = f"status {result.returncode}, message: {message.strip()}"
    expect(result.returncode == 1 and message.startswith(("voussoir: failed: ", "voussoir: stopped: ")), what)
    for part in parts:
        expect(part in message, f"'{part}' is missing: {what}")
    print("   ", message.strip())


def stopped_by(number, output, *arguments, after="history.csv", lines=40):
    """Starts a run, and sends the signal when a file of its output has so many lines."""
    for _ in range(30):  # on a busy machine it may end before this process sees the file
        shutil.rmtree(output, ignore_errors=True)
        process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", output, *arguments], text=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        file = Path(output, after)
        while process.poll() is None and not (file.exists() and file.read_bytes().count(b"\n") >= lines):
            time.sleep(.002)
        process.send_signal(number)
        message = process.communicate()[1]
        if process.returncode != 0:
            return subprocess.CompletedProcess([], process.returncode, "", message)
    raise AssertionError("the run always ends before it can be stopped")


def names():
    """Directories and scenes whose names a shell would take apart, or an option parser."""
    write_scene()
    for name in ("-dash o';touch X;'", '"$(touch X)" ümlaut', "a&b|c;d back`touch X`"):
        shutil.copy("scene.prm", f"{name}.prm")
        scene = f"./{name}.prm"
        shown = runs(scene, "--output", name, "--set", "Output/Figures=true", "--set", "Motion/Duration=0.1")
        expect("could not be drawn" not in shown, f"{name}: {shown[-500:]}")
        expect(len(list(Path(name, "figures").glob("*.png"))) > 5 and Path(name, "history.csv").exists(), f"files of {name}")
        expect(not Path("X").exists() and not list(Path().rglob("X")), f"{name}: a shell was let in")
    write("not_python", "#!/bin/sh\nexit 3\n")
    os.chmod("not_python", 0o755)
    shown = runs("scene.prm", "--output", "none", "--set", "Output/Figures=true", "--set", "Motion/Duration=0.1",
                 environment={"VOUSSOIR_PYTHON": str(Path("not_python").resolve())})
    expect("VOUSSOIR_PYTHON" in shown and Path("none/summary.json").exists(), "an interpreter without matplotlib")
    shown = runs("scene.prm", "--output", "none", "--set", "Output/Figures=true", "--set", "Motion/Duration=0.1",
                 environment={"VOUSSOIR_SCRIPTS": "/nowhere"})
    expect("VOUSSOIR_SCRIPTS" in shown, "no script")


def checkpoints():
    """Damage, and input that has changed since, are found and named; the checkpoint before the last serves."""
    write_scene()
    settings = [*LONG, "--set", "Output/Checkpoint interval=40", "--set", "Output/Probes=foot: 0 0 0"]
    runs("scene.prm", "--output", "whole", *settings)
    failed(stopped_by(signal.SIGTERM, "kept", *settings, lines=120), "SIGTERM", "--resume", "kept")
    for name in ("checkpoint.bin", "checkpoint.bin.before"):
        expect(Path("kept", name).exists(), f"{name} is missing")

    resume = ["scene.prm", *settings, "--resume", "--output"]
    refused([*resume, "kept", "--set", "Joints/Friction=0.7"], "Joints/Friction was \"0.6\" and is \"0.7\"", "--resume")
    refused([*resume, "kept", "--set", "Output/Probes=foot: 0 0 1"], "Output/Probes")
    refused([*resume, "kept", "--set", "Motion/Duration=0.3"], "Motion/Duration")
    motion = Path("motion.txt").read_text()
    write("motion.txt", motion.replace("\n", "\n", 1) + "3.01 0 0 0\n")
    refused([*resume, "kept"], "the file of Motion/File (motion.txt) was", "--resume")
    write("motion.txt", motion)
    expect(table("kept/history.csv")[1][0][0] == 0., "a refused run must leave the tables")

    # Any byte of it
    data = Path("kept/checkpoint.bin").read_bytes()
    rng = random.Random(1)
    for _ in range(40):
        shutil.rmtree("other", ignore_errors=True)
        shutil.copytree("kept", "other")
        os.remove("other/checkpoint.bin.before")
        bad = bytearray(data)
        place = rng.choice((rng.randrange(60), rng.randrange(len(data))))
        bad[place] ^= 1 << rng.randrange(8)
        if rng.random() < .2:
            bad = bad[:place]
        Path("other/checkpoint.bin").write_bytes(bad)
        refused([*resume, "other"], "other/checkpoint.bin", "damaged")
    shutil.copy("kept/checkpoint.bin.before", "other/checkpoint.bin.before")
    shown = runs(*resume, "other")
    expect("warning: the checkpoint" in shown and "the previous one" in shown, shown)
    same("other", "whole", 2e-7, ("history", "joint_history", "joints"))

    refused([*resume, "kept", "--overwrite"], "--resume", "--overwrite")
    refused([*resume, "nothing", "--validate"], "nothing/checkpoint.bin")
    refused(["scene.prm", "--validate", "--set", "=3"], "--set '=3'")
    refused(["scene.prm", "--validate", "--set", "Foundation/Stiffness damping=1e300"], "a number from 0 to 1")

    # More of the same record
    runs("scene.prm", "--output", "whole_longer", *settings, "--set", "Motion/Duration=2.5")
    failed(stopped_by(signal.SIGINT, "short", *settings, "--set", "Motion/Duration=2", lines=60), "SIGINT")
    expect("Resumed" in runs(*resume, "short", "--set", "Motion/Duration=2.5"), "a longer motion")
    same("short", "whole_longer", 2e-7, ("history", "joint_history", "joints"))
    runs(*resume, "kept")
    same("kept", "whole", 2e-7, ("history", "joint_history", "joints"))
    expect(not list(Path("kept").glob("checkpoint*")), "a complete run leaves no checkpoint")

    arch_mesh()
    mesh = ["--set", "Mesh/Source=file", "--set", "Mesh/File=arch.msh"]
    failed(stopped_by(signal.SIGTERM, "meshed", *settings, *mesh), "--resume")
    text = Path("arch.msh").read_text()
    write("arch.msh", text.replace("$Nodes", "$Comments\nchanged\n$EndComments\n$Nodes", 1))
    refused([*resume, "meshed", *mesh], "the file of Mesh/File (arch.msh) was")
    write("arch.msh", text)
    os.chdir("meshed")  # the same files by other paths
    expect("Resumed" in runs("../scene.prm", *settings, *mesh, "--resume", "--output", "."), "from another directory")
    os.chdir("..")


def signals():
    write_scene()
    settings = [*LONG, "--set", "Output/Checkpoint interval=0"]
    result = stopped_by(signal.SIGINT, "asked", *settings)
    failed(result, "SIGINT", "after step", "--resume")
    rows = {name: len(table(f"asked/{name}.csv")[1]) for name in ("history", "energy", "joint_history")}
    expect(len(set(rows.values())) == 1 and 39 <= rows["history"] < 301, f"tables so far: {rows}")
    expect(len(table("asked/joints.csv")[1]) == 2, "joints.csv so far")
    expect("Resumed" in runs("scene.prm", "--output", "asked", *settings, "--resume"), "--resume")
    expect(len(table("asked/history.csv")[1]) == 301, "the whole history")
    # A killed run leaves what it had.
    result = stopped_by(signal.SIGKILL, "killed", *settings)
    expect(result.returncode == -signal.SIGKILL, "killed")
    expect(39 <= len(Path("killed/history.csv").read_text().splitlines()) < 302, "the table of a killed run")
    # Two signals while a step is stopped: the second ends it at once.
    process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", "twice", "--set", "Mesh/Arch210/Elements along=90",
                                "--set", "Mesh/Arch210/Elements up=30"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not Path("twice/.voussoir").exists():  # it sets up, for seconds
        time.sleep(.002)
    process.send_signal(signal.SIGTERM)
    expect("second signal" in process.stderr.readline(), "the first signal is answered")
    process.send_signal(signal.SIGINT)
    expect(process.wait(10) == -signal.SIGINT, f"two signals: {process.returncode}")
    # One that was to be ignored stays so, and the mesh's reader does not take it for damage.
    ignored = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", "ignored", *settings], stdout=subprocess.DEVNULL,
                               preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    while not Path("ignored/history.csv").exists():
        time.sleep(.002)
    ignored.send_signal(signal.SIGHUP)
    expect(ignored.wait(60) == 0, "nohup")
    # What is written after a resume is what a straight run writes: the joints' states, too.
    outputs = ["--set", "Output/Solution interval=1", "--set", "Motion/Duration=1.5"]
    runs("scene.prm", "--output", "straight", *outputs)
    result = stopped_by(signal.SIGTERM, "resumed", "--set", "Motion/Duration=1.5")
    runs("scene.prm", "--output", "resumed", *outputs, "--resume")
    first = sorted(Path("resumed").glob("solution-*.vtu"))[0].name
    expect(read_vtu(f"resumed/{first}")["joint_state"] == read_vtu(f"straight/{first}")["joint_state"],
           f"joint_state of {first}")


def directories():
    write_scene()
    quick = ["--set", "Motion/Duration=0.1"]
    runs("scene.prm", "--output", "mine", *quick)
    before = Path("mine/history.csv").read_bytes()
    # Bad input is found before anything is removed, and leaves no new directory.
    refused(["scene.prm", "--output", "mine", "--set", "Motion/File=none.txt"], "none.txt")
    refused(["scene.prm", "--output", "mine", "--set", "Mesh/Source=file", "--set", "Mesh/File=none.msh"], "none.msh")
    expect(Path("mine/history.csv").read_bytes() == before, "old results were removed by a run that did not begin")
    refused(["scene.prm", "--output", "new/deep", "--set", "Motion/File=none.txt"], "none.txt")
    expect(not Path("new").exists(), "a run that did not begin left a directory")
    runs("scene.prm", "--output", "mine", *quick)  # one's own results are replaced

    # Input that is refused late, by the static state, has not removed anything either.
    refused(["scene.prm", "--output", "mine", "--set", "Concrete/Young's modulus=21 MPa"], "Young's modulus")
    expect(Path("mine/history.csv").exists() and Path("mine/summary.json").exists(), "old results were removed")
    write("mine/notes.txt", "mine")
    refused(["scene.prm", "--output", "mine", *quick], "notes.txt", "--overwrite")
    runs("scene.prm", "--output", "mine", *quick, "--overwrite")
    expect(Path("mine/notes.txt").read_text() == "mine", "--overwrite must leave files of others")
    for name in ("theirs/figures", "theirs/contact/shaking", "linked"):
        Path(name).mkdir(parents=True)
    others = ["theirs/figures/mine.png", "theirs/solution-of-my-life.vtu", "theirs/contact/shaking/a.hdf5", "linked/a.png"]
    for name in (*others, "theirs/scene.prm"):
        write(name, "mine")
    os.symlink("../linked", "theirs/figures/linked")
    refused(["scene.prm", "--output", "theirs", *quick], "theirs", "a.hdf5 and 4 more", "--overwrite")
    expect(Path("theirs/scene.prm").read_text() == "mine", "a file of the user was overwritten")
    runs("scene.prm", "--output", "theirs", *quick, "--overwrite")
    expect(all(Path(name).read_text() == "mine" for name in others), "--overwrite removed files of others")
    for command in ("mesh", "motion"):
        refused([command, "scene.prm", "--output", "scene.prm"], "scene.prm", "input")
    refused(["motion", "scene.prm", "--output", "motion.txt"], "motion.txt", "input")
    refused(["scene.prm", "--output", ".", *quick, "--overwrite"], "its own input", "scene.prm")
    expect("Joints" in Path("scene.prm").read_text() and Path("motion.txt").exists(), "input was lost")

    stopped_by(signal.SIGTERM, "held", *LONG)
    checkpoint = Path("held/checkpoint.bin").read_bytes()
    refused(["scene.prm", "--output", "held", *LONG], "held", "checkpoint", "--resume", "--overwrite")
    expect(Path("held/checkpoint.bin").read_bytes() == checkpoint, "the checkpoint was removed")
    runs("scene.prm", "--output", "held", *quick, "--overwrite")

    process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", "locked", *LONG], stdout=subprocess.DEVNULL)
    while not Path("locked/history.csv").exists():
        time.sleep(.002)
    os.kill(process.pid, signal.SIGSTOP)
    refused(["scene.prm", "--output", "locked", *quick], "Another run", "locked", str(process.pid))
    refused(["scene.prm", "--output", "locked", *quick, "--overwrite"], "Another run")
    os.kill(process.pid, signal.SIGCONT)
    expect(process.wait(60) == 0, "the run that had the directory")


def writing():
    """A file that cannot be written: status 1, its name, and the last state is kept."""
    write_scene()
    Path("contact_in_the_way").mkdir()
    write("contact_in_the_way/contact", "")
    failed(voussoir("scene.prm", "--output", "contact_in_the_way", "--overwrite", "--set", "Contact/Write problems=true"),
           "contact_in_the_way/contact")
    for name in ("summary.json", "envelope.vtu", "energy.csv", "joints.csv", "scene.prm", "log.txt"):
        shutil.rmtree("way", ignore_errors=True)
        Path("way", name).mkdir(parents=True)
        result = voussoir("scene.prm", "--output", "way", "--set", "Motion/Duration=0.1")
        failed(result, f"way/{name}")
        if name in ("summary.json", "envelope.vtu", "joints.csv"):
            expect("--resume" in result.stderr, result.stderr)
            Path("way", name).rmdir()
            runs("scene.prm", "--output", "way", "--set", "Motion/Duration=0.1", "--resume")
            expect(len(table("way/history.csv")[1]) == 11 and Path("way/summary.json").is_file(), "the resumed run")
    for name in ("history.csv", "joint_history.csv", "faces.csv", "log.txt", "solution.pvd", "solution-00000.vtu"):
        shutil.rmtree("full", ignore_errors=True)
        Path("full").mkdir()
        os.symlink("/dev/full", f"full/{name}")
        failed(voussoir("scene.prm", "--output", "full", "--set", "Motion/Duration=0.1",
                        "--set", "Output/Solution interval=5"), f"full/{name}")
    # A disk that fills up in the middle of the run
    process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", "fills", *LONG], text=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    while process.poll() is None and not Path("fills/history.csv").exists():
        time.sleep(.002)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (6000, 6000))
    message = process.communicate()[1]
    failed(subprocess.CompletedProcess([], process.returncode, "", message), "fills/", "checkpoint could not be written either")
    with open("/dev/full", "w") as full:
        for arguments in (["parameters"], ["--help"], ["scene.prm", "--validate"]):
            result = subprocess.run([VOUSSOIR, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
            failed(result, "Standard output")
    for command, ending in (("mesh", ".msh"), ("motion", ".csv")):
        Path(f"way{ending}").mkdir()
        failed(voussoir(command, "scene.prm", "--output", f"way{ending}"), f"way{ending}")
        os.symlink("/dev/full", f"full{ending}")
        failed(voussoir(command, "scene.prm", "--output", f"full{ending}"), f"full{ending}")


def lost(output, remove, *parts):
    """The run must fail after remove(), which takes a file or the directory away from it."""
    process = subprocess.Popen([VOUSSOIR, "scene.prm", "--output", output, *LONG], text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    history = Path(output, "history.csv")
    while process.poll() is None and not (history.exists() and history.read_text().count("\n") > 3):  # inside the time loop
        time.sleep(.002)
    process.send_signal(signal.SIGSTOP)
    remove()
    process.send_signal(signal.SIGCONT)
    message = process.communicate()[1]
    failed(subprocess.CompletedProcess([], process.returncode, "", message), *parts)
    expect("disk space" not in message, message)


def losses():
    """A run whose files are removed, or whose directory is renamed, does not end with status 0."""
    write_scene()
    for name in ("history.csv", "log.txt", "spectrum.csv"):
        lost(f"without_{name}", lambda name=name: Path(f"without_{name}", name).unlink(), f"without_{name}/{name} was removed", "--resume")
    runs("scene.prm", "--output", "without_history.csv", *LONG, "--resume")
    expect(len(table("without_history.csv/history.csv")[1]) == 301, "the whole history")
    lost("named", lambda: Path("named").rename("renamed"), "named/", "directory renamed", "no longer exists", "--output")
    lost("gone", lambda: shutil.rmtree("gone"), "gone/", "no longer exists", "start the run again")


def repeated():
    """Every file of a run is known as a result: a finished run is repeated in its directory. Every warning of its log is in the summary and the report."""
    write_scene()
    full = [*write_wedges(), *settings(
        "Motion/Duration=0.1", "Motion/Factor=8", "Reservoir/Model=acoustic", "Reservoir/Element size=25", "Statics/Stages=fill 100, grout 210",
        "Limits/Tensile strength=2 MPa", "Limits/Base friction=1", "Limits/Waterstop depth=1.5", "Output/Figures=true", "Output/Solution interval=5",
        "Output/Checkpoint interval=3", "Output/Frames=5", "Contact/Write problems=true", "Joints/Keys/Height=0.3")]
    shown = runs("scene.prm", "--output", "full", *full)
    written = {str(path.relative_to("full")) for path in Path("full").rglob("*") if path.is_file()}
    for name in ("water_pressure.csv", "stages.csv", "wedges.csv", "frames.bin", "solution.pvd", "figures/envelope_arch_upstream.png", "contact/shaking/problem-000001.txt"):
        expect(name in written, f"{name} is missing: {sorted(written)}")
    for name in ("html", "pdf"):
        write(f"full/report.{name}", "")
    runs("scene.prm", "--output", "full", *full, "--set", "Output/Figures=false")
    expect(not list(Path("full/figures").iterdir()) and not Path("full/report.pdf").exists(), "results of the first run")
    warned = re.findall("^warning: (.*)$", shown, re.M)
    found = json.loads(Path("full/summary.json").read_text())["warnings"]
    expect([w["text"] for w in found] == warned, f"{found}, {warned}")
    cavitation, idle = (next(w for w in found if word in w["text"]) for word in ("cavitate", "Joints/Keys/Height"))
    expect(cavitation["class"] == "physics" and cavitation["place"] in cavitation["text"] and ") m, t = " in cavitation["place"], f"{cavitation}")
    expect(idle["class"] == "input" and idle["place"] == "--set" and "has no effect" in idle["text"], f"{idle}")
    from voussoir.report_answers import items, validity
    from voussoir.runs import Run
    said, harmless = validity(Run("full"), items(Run("full"))), sum(w["class"] == "input" for w in found)
    expect(f"warnings of the program: {len(found) - harmless} (" in said and "absolute pressure of the water" in said and f"remarks on the input file: {harmless}" in said, said)


if __name__ == "__main__":
    run_cases(losses, repeated, names, checkpoints, signals, directories, writing)
