# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one scene of a study; a job of the Snakefile that `voussoir study` writes.

    study_scene.py STUDY_DIRECTORY SCENE THREADS

What is recorded as done is not run again, a checkpoint is resumed, and what another process is running is waited for.
"""

import ctypes
import fcntl
import json
import os
import signal
import subprocess
import time
from pathlib import Path

from .command import write_whole
from .errors import InputError
from .program import message_of
from .results import extremes_of, read_summary


def end_with_parent(number=signal.SIGTERM):
    """This process gets the signal when its parent ends (Linux: PR_SET_PDEATHSIG is 1)."""
    try:
        ctypes.CDLL(None).prctl(1, int(number))
    except (OSError, AttributeError):
        pass  # elsewhere the next study waits for what still runs


def record_of(directory, name):
    """Record of a scene's last run: key, status, message, seconds."""
    try:
        return json.loads((Path(directory) / "records" / f"{name}.json").read_text())
    except (OSError, ValueError):
        return {}


def summary_of(directory, name):
    """Returns summary.json of a scene, {} if there is none."""
    try:
        return read_summary(Path(directory) / "runs" / name)
    except InputError:
        return {}


def revision_of(directory, name):
    """Revision of the program that ran the scene."""
    return summary_of(directory, name).get("revision", "")


def row_in_words(directory, name):
    """Results of a scene, for the screen."""
    summary = summary_of(directory, name)
    extremes = extremes_of(summary)
    words = [f"opening {1e3 * extremes['max_opening']:.1f} mm"] if "max_opening" in extremes else []
    tensions = [value for key, value in extremes.items() if key.startswith("max_tension") and key.endswith("_away_from_base")]
    words += [f"tension {1e-6 * max(tensions):.1f} MPa"] if tensions else []
    return ", ".join([*words, f"{summary['seconds']['wall']:.0f} s"])


def run(program, directory, name, threads, extra):
    """Status and log of one start of the program; -1 if this process received a signal to stop."""
    stopped = []

    def stop(*_):
        """Passes the signal to the program only once, since a second signal would prevent its checkpoint."""
        if not stopped:
            stopped.append(True)
            job.terminate()

    log = directory / "logs" / f"{name}.log"
    with open(log, "w", encoding="utf-8") as file:
        job = subprocess.Popen([program, f"scenes/{name}.prm", "--output", f"runs/{name}", *extra], cwd=directory,
                               stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                               env={**os.environ, "OMP_NUM_THREADS": threads}, start_new_session=True, preexec_fn=end_with_parent)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, stop)
        status = job.wait()
    return -1 if stopped and status else status, log


def main(directory, name, threads):
    """Status 0 when the scene is done."""
    end_with_parent()
    directory = Path(directory).resolve()
    scene = json.loads((directory / "scenes.json").read_text())["scenes"][name]
    with open(directory / "records" / f"{name}.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        record = record_of(directory, name)
        if record.get("key") != scene["key"] or record.get("status") != 0:
            program = json.loads((directory / "scenes.json").read_text())["program"]
            begin = time.time()
            half_run = (directory / "runs" / name / "checkpoint.bin").exists()
            status, log = run(program, directory, name, threads, ["--resume"] if half_run else ["--overwrite"])
            if half_run and status == 2:  # of another scene or program
                half_run = False
                status, log = run(program, directory, name, threads, ["--overwrite"])
            if status == -1:
                return 1
            record = {"key": scene["key"], "status": status, "resumed": half_run, "seconds": round(time.time() - begin, 3),
                      "message": "" if status == 0 else message_of(log.read_text(errors="replace"), status)}
            write_whole(directory / "records" / f"{name}.json", json.dumps(record))
    if record["status"] == 0:
        (directory / "done" / name).touch()
    return 1 if record["status"] else 0
