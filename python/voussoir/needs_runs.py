# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of `voussoir needs`: each in a directory of its own, known by a digest of all that it reads, with a limit of the work.

Work is counted from mesh, steps and iterations. It is equal on every machine, and about the processor time [s] of one core."""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import resource
import subprocess
import threading
import time
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Set

import numpy as np

from .accuracy import SUBSTEPS, strongest
from .command import write_whole
from .errors import VoussoirError
from .needs_verdicts import Motions, measures_of, measures_of_ensemble
from .program import call, find_program, message_of, program_key, set_options
from .results import read_summary
from .study_file import AS_IT_IS, with_paths

VERSION = b"needs 2"  # of what this module reads of a run: other runs are made again
BATCH, OF_BATCH = 16, 0.75  # motions of a batch, and its work over that of an explicit run
IN_TURN = "one after another, because"  # in the log of an ensemble that cannot run in batches
PATIENCE = 3.  # processor time over work, above which a run is ended
FAILED = 2.  # work of a run that fails at its beginning


def with_numbers(result: Dict[str, Any]) -> Dict[str, Any]:
    """A result from a file, with the numbers of its motions as integers."""
    motions: Motions = {int(number): values for number, values in result.get("motions", {}).items()}
    return {**result, "motions": motions} if motions else result


def slug(name: str) -> str:
    """The name of a directory."""
    return re.sub("[^a-z0-9.]+", "-", name.lower()).strip("-")


def digest_of(scene: Path, entries: Mapping[str, str]) -> str:
    """Returns a digest of the program, of entries and of the files that they name."""
    digest = hashlib.sha256(VERSION + program_key().encode() + json.dumps(dict(entries)).encode())
    for entry, value in entries.items():
        for file in with_paths(entry, value, scene.parent)[1]:
            if Path(file).is_file():
                digest.update(Path(file).read_bytes())
    return digest.hexdigest()


def counted(pattern: str, log: str) -> float:
    """Number in a log, 0 if there is none."""
    found = re.search(pattern, log, re.M)
    return float(found[1]) if found else 0.


def work_of(directory: Path, summary: Mapping[str, Any], scheme: str, iterations: Optional[Mapping[str, Any]] = None) -> tuple[float, float]:
    """Work of the setup, and work per second of earthquake. scheme: for which the work is counted; iterations: "newton_iterations" of a run with this
    scheme, if the run of the directory has another one. The constants are fitted to processor times of nine scenes, which they miss by up to a third."""
    log, mesh, rock = (directory / "log.txt").read_text(encoding="utf-8"), summary["mesh"], summary.get("rock") or {}
    dofs, pairs, joints = mesh["dofs"], mesh["pairs"], max(1, len(mesh["joint_names"]))
    newton = summary.get("newton_iterations") or iterations or {}
    if scheme == "explicit":
        substeps = counted(r"^Explicit +(\d+) steps", log)
        step = dofs * (1e-7 + 1.8e-8 * substeps) + 1.5e-7 * pairs * substeps
    else:
        step = 9.8e-9 * dofs ** 1.3 + 1.6e-6 * pairs * newton.get("mean", 1.)
        step += 1.85e-11 * (3 * pairs / joints) ** 3 * (newton.get("joint_factorisations_mean", joints) if pairs else 0)
    massless = summary["foundation"] == "massless"
    step = step * (2 if massless else 1) + 3e-8 * counted(r"^Water .* (\d+) nodes,", log)
    if rock:
        step += 2.5e-8 * rock["dofs"] * max(1., summary["time_step"] / rock["time_step"])
    return 1.5 + 7e-5 * (dofs + rock.get("dofs", 0)) + (4. if massless else 0.), step / summary["time_step"]


class Limit:
    """Work that is left for the rows. A run reserves the largest work that it may take."""

    def __init__(self) -> None:
        self.condition, self.left, self.largest, self.reserved = threading.Condition(), float("inf"), float("inf"), 0.

    def reserve(self, predicted: float) -> Optional[float]:
        """Reserves the largest work for a run, or what is left if no other run has reserved work. None if this is below the prediction."""
        with self.condition:
            while self.left - self.reserved < self.largest and self.reserved > 0:
                self.condition.wait()
            allowance = min(self.largest, self.left - self.reserved)
            if allowance < predicted:
                return None
            self.reserved += allowance
            return allowance

    def release(self, allowance: float, used: float) -> None:
        """Returns a reservation, less the work that was used."""
        with self.condition:
            self.reserved = max(0., self.reserved - allowance)
            self.left -= used
            self.condition.notify_all()


class Runs:
    """Runs of a scene, by name. Nothing runs twice, also not in a later command."""

    def __init__(self, scene: Path, entries: Mapping[str, str], directory: Path, common: Mapping[str, Any], threads: int,
                 members: list[Dict[str, Any]]) -> None:
        self.scene, self.entries, self.directory, self.common, self.threads = scene, dict(entries), directory, dict(common), threads
        self.members = members  # settings of each motion alone
        self.seconds, self.length = 0., 0.  # of the strongest part, and of the whole motion
        self.iterations: Optional[Dict[str, Any]] = None  # of a run with the scene's own scheme
        self.limit, self.spent, self.stopped = Limit(), 0., False
        self.processes: Set[subprocess.Popen[str]] = set()

    def motion(self, settings: Mapping[str, Any], whole: bool = False) -> Path:
        """Returns the file of a motion with these settings, or of its strongest seconds."""
        entries = {entry: value for entry, value in self.entries_with(settings).items() if entry.startswith("Motion/")}
        digest = digest_of(self.scene, {**entries, "seconds": str(self.seconds)})[:16]
        file = self.directory / "motions" / f"{digest}{'-whole' if whole else ''}.csv"
        if not file.exists():
            new = file.with_suffix(f".{threading.get_ident()}.new")
            call("motion", self.scene, "--output", new, *set_options(settings))
            if not whole:
                part, begin = strongest(np.loadtxt(new, delimiter=",", skiprows=1), self.seconds)
                np.savetxt(new, part, delimiter=",", header=f"t,a_x,a_y,a_z   from {begin:.4g} s on", comments="# ")
            new.replace(file)
        return file

    def entries_with(self, settings: Mapping[str, Any]) -> Dict[str, str]:
        """All entries of the scene with these settings. Whether the values are valid is decided by the run."""
        return {**self.entries, **{entry: str(value) for entry, value in settings.items()}}

    def settings_of(self, changes: Mapping[str, Any], motion: Optional[int], whole: bool) -> Dict[str, Any]:
        """All settings of a run with one motion, or with all (None). Factors of a component apply to the parts of the motions, too."""
        scales = {entry: value for entry, value in changes.items() if entry.startswith("Motion/Scale ")}
        own = {entry: value for entry, value in changes.items() if entry.startswith("Motion/") and entry not in scales}
        given = {entry: value for entry, value in self.common.items() if entry.startswith("Motion/")}
        rest = {entry: value for entry, value in changes.items() if not entry.startswith("Motion/")}
        if whole and motion is not None:
            return {**self.common, **self.members[motion], **changes}
        if motion is not None:
            return {**self.common, **AS_IT_IS, "Motion/File": self.motion({**given, **self.members[motion], **own}), **scales, **rest}
        files = [str(self.motion({**given, **member, **own}, whole)) for member in self.members]
        return {**self.common, **AS_IT_IS, "Motion/File": "", "Motion/Ensemble": "; ".join(files), "Motion/Ensemble output": 1,
                "Dynamics/Scheme": "explicit", **scales, **rest}

    def run(self, name: str, changes: Mapping[str, Any], motion: Optional[int] = 0, predicted: float = 0., whole: bool = False,
            limited: bool = True) -> Dict[str, Any]:
        """Runs the scene with changes and one motion, or in batches with all (None); or reads the run. Returns "motions" (values by number), "where",
        "work", "setup" and "pace" (work per second, with the scheme of the scene) and "changes"; or "failure" and its reason."""
        name = f"{name}, {'all motions' if motion is None else f'motion {motion + 1}'}{', whole' if whole else ''}"
        try:
            settings = self.settings_of(changes, motion, whole)
        except VoussoirError as error:  # of the motion
            return {"failure": str(error), "work": 0.}
        record, key = self.directory / "records" / f"{slug(name)}.json", digest_of(self.scene, self.entries_with(settings))
        known = json.loads(record.read_text()) if record.exists() else {}
        if known.get("key") == key and "result" in known:
            self.limit.release(0., known["result"]["work"])
            self.spent += known["result"]["work"]
            return with_numbers(known["result"])
        allowance = self.limit.reserve(predicted) if limited else float("inf")
        if allowance is None:
            return {"failure": f"not run: cost limit (work of about {predicted:.3g} s expected)", "work": 0.}
        used = 0.
        try:
            if known.get("key") != key:
                write_whole(record, json.dumps({"key": key}))
            result = self.compute(self.directory / "runs" / slug(name), settings, allowance, known.get("key") == key)
            if "failure" not in result:
                result.update(self.measures(self.directory / "runs" / slug(name), changes, motion, whole))
            used = result["work"]
            if not self.stopped:
                write_whole(record, json.dumps({"key": key, "result": result}))
        finally:
            self.limit.release(allowance if limited else 0., used)
            self.spent += used
        return result

    def measures(self, directory: Path, changes: Mapping[str, Any], motion: Optional[int], whole: bool) -> Dict[str, Any]:
        """Values and work of a finished run."""
        summary, seconds = read_summary(directory), self.length if whole else min(self.seconds, self.length)
        scheme = str(changes.get("Dynamics/Scheme", self.entries["Dynamics/Scheme"]))
        setup, pace = work_of(directory, summary, scheme, self.iterations)
        found = {"setup": setup, "pace": pace, "newton": summary.get("newton_iterations")}
        if motion is not None:
            values, where = measures_of(directory)
            return {**found, "motions": {motion: values}, "where": where, "work": setup + pace * seconds}
        motions, where = measures_of_ensemble(directory)
        n_batches = math.ceil(len(self.members) / BATCH)
        return {**found, "motions": motions, "where": where,  # the first motion is run again, for its tables
                "work": 2 * setup + (OF_BATCH * n_batches + 1) * work_of(directory, summary, "explicit")[1] * seconds}

    def compute(self, directory: Path, settings: Dict[str, Any], allowance: float, half_run: bool) -> Dict[str, Any]:
        """Starts the program: from a checkpoint of the same run, and on rock with the number of substeps that the message requires."""
        resume = half_run and (directory / "checkpoint.bin").exists()
        status, text = self.start(directory, settings, allowance, "--resume" if resume else "--overwrite")
        changes: Dict[str, Any] = {}
        if resume and status == 2:
            status, text = self.start(directory, settings, allowance, "--overwrite")
        if status == 2 and (needed := re.search(rf'"{SUBSTEPS}" to (\d+)', text)):
            changes = {SUBSTEPS: needed[1]}
            status, text = self.start(directory, {**settings, **changes}, allowance, "--overwrite")
        if status == 0 or status == 1 and settings.get("Motion/Ensemble") and (directory / "motion-1" / "summary.json").exists():
            return {"changes": changes}
        if status == -24 and not self.stopped:
            return {"failure": f"ended by the cost limit, at about {PATIENCE:g} times the work of {allowance:.3g} s", "work": allowance}
        return {"failure": message_of(text, status), "work": FAILED, "status": status}

    def start(self, directory: Path, settings: Mapping[str, Any], allowance: float, flag: str) -> tuple[int, str]:
        """Status and messages of one start of the program."""
        words = [find_program(), str(self.scene), "--output", str(directory), "--quiet", flag, *set_options(settings)]
        with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              start_new_session=True, env={**os.environ, "OMP_NUM_THREADS": str(self.threads)}) as process:
            self.processes.add(process)
            try:
                if self.stopped:
                    process.terminate()
                elif allowance < float("inf"):
                    most = math.ceil(PATIENCE * allowance) + 1
                    resource.prlimit(process.pid, resource.RLIMIT_CPU, (most, most + 5))  # status -24
                text = self.messages_of(process, directory / "log.txt" if settings.get("Motion/Ensemble") else None)
            except BaseException:  # the user stops the command while it waits for one run
                process.terminate()
                raise
            finally:
                self.processes.discard(process)
        return process.returncode, text

    @staticmethod
    def messages_of(process: "subprocess.Popen[str]", log: Optional[Path]) -> str:
        """Waits for a process and returns its messages. Ends an ensemble that does not run in batches."""
        began = time.time()
        while True:
            try:
                return process.communicate(timeout=0.2 if log else None)[1]
            except subprocess.TimeoutExpired:
                if log and log.is_file() and log.stat().st_mtime >= began - 1 and IN_TURN in log.read_text(encoding="utf-8", errors="replace"):
                    process.kill()

    def stop(self) -> None:
        """Ends all active runs; they write checkpoints."""
        self.stopped = True
        for process in list(self.processes):
            process.terminate()
