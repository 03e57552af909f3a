# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of `voussoir needs`: each in a directory of its own, known by a digest of all that it reads, with a limit of the processor time."""

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
from .needs_verdicts import measures_of
from .program import call, find_program, message_of, program_key, set_options
from .study_file import AS_IT_IS, with_paths

VERSION = b"needs 1"  # of what this module reads of a run: other runs are made again


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


class Limit:
    """Processor time [s] that is left for the rows. A run reserves the largest time that it may take."""

    def __init__(self) -> None:
        self.condition, self.left, self.largest, self.reserved = threading.Condition(), float("inf"), float("inf"), 0.

    def reserve(self, predicted: float) -> Optional[float]:
        """Reserves the largest time for a run, or what is left if no other run has reserved time. None if this is below the prediction."""
        with self.condition:
            while self.left - self.reserved < self.largest and self.reserved > 0:
                self.condition.wait()
            allowance = min(self.largest, self.left - self.reserved)
            if allowance < predicted:
                return None
            self.reserved += allowance
            return allowance

    def release(self, allowance: float, used: float) -> None:
        """Returns a reservation, less the time that was used."""
        with self.condition:
            self.reserved = max(0., self.reserved - allowance)
            self.left -= used
            self.condition.notify_all()


class Runs:
    """Runs of a scene, by name. Nothing runs twice, also not in a later command."""

    def __init__(self, scene: Path, entries: Mapping[str, str], directory: Path, common: Mapping[str, Any], threads: int) -> None:
        self.scene, self.entries, self.directory, self.common, self.threads = scene, dict(entries), directory, dict(common), threads
        self.seconds = 0.  # of the strongest part
        self.limit, self.spent, self.stopped = Limit(), 0., False
        self.processes: Set[subprocess.Popen[str]] = set()

    def motion(self, settings: Mapping[str, Any]) -> Path:
        """Returns the file of the strongest seconds of the scene's motion with these settings."""
        entries = {entry: value for entry, value in self.entries_with(settings).items() if entry.startswith("Motion/")}
        file = self.directory / "motions" / f"{digest_of(self.scene, {**entries, 'seconds': str(self.seconds)})[:16]}.csv"
        if not file.exists():
            whole = file.with_suffix(".whole")
            call("motion", self.scene, "--output", whole, *set_options(settings))
            part, begin = strongest(np.loadtxt(whole, delimiter=",", skiprows=1), self.seconds)
            np.savetxt(file.with_suffix(".new"), part, delimiter=",", header=f"t,a_x,a_y,a_z   from {begin:.4g} s on", comments="# ")
            file.with_suffix(".new").replace(file)
        return file

    def entries_with(self, settings: Mapping[str, Any]) -> Dict[str, str]:
        """All entries of the scene with these settings. Whether the values are valid is decided by the run."""
        return {**self.entries, **{entry: str(value) for entry, value in settings.items()}}

    def settings_of(self, changes: Mapping[str, Any], whole: bool) -> Dict[str, Any]:
        """All settings of a run over the strongest seconds, or over the whole motion. Factors of a component apply to the part."""
        if whole:
            return {**self.common, **changes}
        scales = {entry: value for entry, value in changes.items() if entry.startswith("Motion/Scale ")}
        own = {entry: value for entry, value in changes.items() if entry.startswith("Motion/") and entry not in scales}
        given = {entry: value for entry, value in self.common.items() if entry.startswith("Motion/")}
        rest = {entry: value for entry, value in changes.items() if not entry.startswith("Motion/")}
        return {**self.common, **AS_IT_IS, "Motion/File": self.motion({**given, **own}), **scales, **rest}

    def run(self, name: str, changes: Mapping[str, Any], predicted: float = 0., whole: bool = False, limited: bool = True) -> Dict[str, Any]:
        """Runs the scene with changes, or reads the run. Returns measures_of() with "changes", or "failure" and its reason."""
        try:
            settings = self.settings_of(changes, whole)
        except VoussoirError as error:  # of the motion
            return {"failure": str(error), "cpu": 0.}
        record, key = self.directory / "records" / f"{slug(name)}.json", digest_of(self.scene, self.entries_with(settings))
        known = json.loads(record.read_text()) if record.exists() else {}
        if known.get("key") == key and "result" in known:
            self.limit.release(0., known["result"]["cpu"] if limited else 0.)
            self.spent += known["result"]["cpu"]
            return known["result"]
        allowance = self.limit.reserve(predicted) if limited else float("inf")
        if allowance is None:
            return {"failure": f"not run: cost limit (about {predicted:.3g} s of processor time expected)", "cpu": 0.}
        used = 0.
        try:
            if known.get("key") != key:
                write_whole(record, json.dumps({"key": key}))
            result = self.compute(self.directory / "runs" / slug(name), settings, allowance, known.get("key") == key)
            used = result["cpu"]
            if not self.stopped:
                write_whole(record, json.dumps({"key": key, "result": result}))
        finally:
            if limited:
                self.limit.release(allowance, used)
            self.spent += used
        return result

    def compute(self, directory: Path, settings: Dict[str, Any], allowance: float, half_run: bool) -> Dict[str, Any]:
        """Starts the program: from a checkpoint of the same run, and on rock with the number of substeps that the message requires."""
        resume = half_run and (directory / "checkpoint.bin").exists()
        status, text, cpu = self.start(directory, settings, allowance, "--resume" if resume else "--overwrite")
        changes: Dict[str, Any] = {}
        if resume and status == 2:
            status, text, cpu = self.start(directory, settings, allowance, "--overwrite")
        if status == 2 and (needed := re.search(rf'"{SUBSTEPS}" to (\d+)', text)):
            changes = {SUBSTEPS: needed[1]}
            status, text, cpu = self.start(directory, {**settings, **changes}, allowance, "--overwrite")
        if status == 0:
            return {**measures_of(directory), "changes": changes}
        if status in (-24, -9) and not self.stopped:
            return {"failure": f"ended by the cost limit, after {cpu:.3g} s of processor time", "cpu": cpu}
        return {"failure": message_of(text, status), "cpu": cpu, "status": status}

    def start(self, directory: Path, settings: Mapping[str, Any], allowance: float, flag: str) -> tuple[int, str, float]:
        """Status, messages and an upper bound of the processor time of one start of the program."""
        words = [find_program(), str(self.scene), "--output", str(directory), "--quiet", flag, *set_options(settings)]
        began = time.monotonic()
        with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              start_new_session=True, env={**os.environ, "OMP_NUM_THREADS": str(self.threads)}) as process:
            self.processes.add(process)
            try:
                if self.stopped:
                    process.terminate()
                elif allowance < float("inf"):
                    most = math.ceil(allowance) + 1
                    resource.prlimit(process.pid, resource.RLIMIT_CPU, (most, most + 5))
                text = process.communicate()[1]
            except BaseException:  # the user stops the command while it waits for one run
                process.terminate()
                raise
            finally:
                self.processes.discard(process)
        return process.returncode, text, min((time.monotonic() - began) * self.threads, allowance)

    def stop(self) -> None:
        """Ends all active runs; they write checkpoints."""
        self.stopped = True
        for process in list(self.processes):
            process.terminate()
