# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs Voussoir and reads its results: tables as numpy arrays by column, summary as a dictionary, meshes by meshio.

    import voussoir
    run = voussoir.run("prm/quickstart.prm", "output/fjb", {"Joints/Model": "FJB", "Motion/Duration": 5.12})
    run.summary["extremes"]["max_opening"]["value"]      # [m]
    run.history["time"], run.history["crest_x"]          # [s], [m]
    voussoir.load("output/quickstart").joints["opening_upstream"].max()

Files and columns: doc/output.md; SI units.
"""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
from functools import cached_property
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Sequence, Union

import numpy as np

__all__ = ["ComputationError", "InputError", "Results", "Table", "VoussoirError", "load", "run", "scene"]

Table = Dict[str, np.ndarray]
PathLike = Union[str, "os.PathLike[str]"]


class VoussoirError(Exception):
    """What the program said when it ended with another status than 0."""


class InputError(VoussoirError):
    """Bad input (status 2), or a directory that is no run's."""


class ComputationError(VoussoirError):
    """A computation that failed (status 1)."""


class Results:
    """The directory of a run. Tables are read when they are asked for."""

    def __init__(self, directory: PathLike) -> None:
        self.directory = Path(directory)
        if not (self.directory / "log.txt").is_file():
            raise InputError(f"{self.directory} is not the directory of a run: it has no log.txt.")

    def __repr__(self) -> str:
        return f"Results({str(self.directory)!r})"

    def table(self, name: str) -> Table:
        """The columns of NAME.csv by name: numbers, where all are, or text."""
        path = self.directory / f"{name}.csv"
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = [row for row in csv.reader(file) if row]
        except OSError as error:
            raise InputError(f"{path} cannot be read: {error.strerror}.") from None
        except (UnicodeDecodeError, csv.Error) as error:
            raise InputError(f"{path} cannot be read: it is no table ({getattr(error, 'reason', error)}).") from None
        if len(rows) > 1 and len(rows[-1]) < len(rows[0]):
            rows.pop()  # half a line of a run that was killed
        for number, row in enumerate(rows, 1):
            if len(row) != len(rows[0]):
                raise InputError(f"{path}, line {number}: {len(row)} values for {len(rows[0])} columns. The file is damaged.")
        return {column: _array([row[i] for row in rows[1:]]) for i, column in enumerate(rows[0] if rows else [])}

    @cached_property
    def summary(self) -> Dict[str, Any]:
        """summary.json; a run that has not ended has none."""
        try:
            found = json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))
        except OSError:
            raise InputError(f"{self.directory} has no summary.json: its run has not come to its end.") from None
        except ValueError:
            found = None
        if not isinstance(found, dict):
            raise InputError(f"{self.directory / 'summary.json'} is not whole: run the scene again.")
        return found

    @cached_property
    def history(self) -> Table:
        """Crest, base and probes over time [s, m, m/s2]."""
        return self.table("history")

    @cached_property
    def joints(self) -> Table:
        """Largest opening and slip of each joint at the crest [m]."""
        return self.table("joints")

    @cached_property
    def joint_history(self) -> Table:
        """Opening and slip of each joint at the crest over time [s, m]."""
        return self.table("joint_history")

    @cached_property
    def blocks(self) -> Table:
        """Forces on the bases of the monoliths over time [s, N, N m]."""
        return self.table("blocks")

    @cached_property
    def energy(self) -> Table:
        """Energies over time [s, J]."""
        return self.table("energy")

    @cached_property
    def faces(self) -> Table:
        """Envelope of the principal stresses on the faces [m, Pa]."""
        return self.table("faces")

    def mesh(self, name: str = "envelope.vtu") -> Any:
        """A .vtu file as a meshio.Mesh."""
        try:
            import meshio
        except ImportError:
            raise InputError("Meshes need meshio (on Debian: apt-get install python3-meshio).") from None
        path = self.directory / name
        if not path.is_file():
            raise InputError(f"{path} is not there.")
        try:
            return meshio.read(path)
        except (Exception, SystemExit) as error:  # meshio ends the program for some files  # pylint: disable=broad-exception-caught
            why = "meshio does not know it" if isinstance(error, SystemExit) else str(error) or type(error).__name__
            raise InputError(f"{path} cannot be read as a mesh: {why}.") from None


def _array(texts: Sequence[str]) -> np.ndarray:
    """Of numbers, or else of text."""
    try:
        return np.array(texts, dtype=float)
    except ValueError:
        return np.array(texts)


def _program(program: Optional[PathLike]) -> str:
    """The one that is given, or of the environment (VOUSSOIR_PROGRAM), the PATH, or the build beside these sources."""
    beside = Path(__file__).resolve().parent.parent.parent / "build" / "voussoir"
    found = program or os.environ.get("VOUSSOIR_PROGRAM") or shutil.which("voussoir") or (beside if beside.is_file() else None)
    if found is None:
        raise InputError("The program voussoir was not found. Name it in the environment variable VOUSSOIR_PROGRAM.")
    return os.fspath(found)


def _call(words: Sequence[str], program: Optional[PathLike], threads: Optional[int]) -> str:
    """What the program prints; VoussoirError for its errors."""
    environment = dict(os.environ)
    if threads is not None:
        environment["OMP_NUM_THREADS"] = str(threads)
    try:
        result = subprocess.run([_program(program), *words], capture_output=True, text=True, env=environment, check=False)
    except OSError as error:
        raise InputError(f"{_program(program)} cannot be started: {error.strerror}.") from None
    if result.returncode != 0:
        lines = [line for line in result.stderr.splitlines() if line.startswith("voussoir: ") and not line.startswith("voussoir: warning")]
        message = lines[-1].split(": ", 2)[-1] if lines else f"voussoir ended with status {result.returncode}."
        raise (InputError if result.returncode == 2 else ComputationError)(message)
    return result.stdout


def _settings(settings: Optional[Mapping[str, Any]]) -> list[str]:
    """The words --set; True and False as the program writes them."""
    def text(value: Any) -> str:
        return str(value).lower() if isinstance(value, bool) else str(value)
    return [word for entry, value in (settings or {}).items() for word in ("--set", f"{entry}={text(value)}")]


def run(scene: PathLike, output: PathLike, settings: Optional[Mapping[str, Any]] = None, *, resume: bool = False, overwrite: bool = False,
        threads: Optional[int] = None, program: Optional[PathLike] = None) -> Results:
    """Runs a scene ("Section/Entry" -> value in `settings`) and returns its results; its screen is in log.txt.

    InputError and ComputationError carry the program's message; after a failed computation load() reads what there is."""
    flags = [flag for flag, given in (("--resume", resume), ("--overwrite", overwrite)) if given]
    _call([os.fspath(scene), "--output", os.fspath(output), *flags, *_settings(settings)], program, threads)
    return Results(output)


def load(directory: PathLike) -> Results:
    """The results of an earlier run."""
    return Results(directory)


def scene(file: PathLike, settings: Optional[Mapping[str, Any]] = None, *, program: Optional[PathLike] = None) -> Dict[str, str]:
    """Every entry of a scene with its value as text, defaults included: "Section/Entry" -> value."""
    entries: Dict[str, str] = {}
    path: list[str] = []
    for line in _call(["scene", os.fspath(file), *_settings(settings)], program, None).splitlines():
        words = line.split("#", 1)[0].strip()
        if words.startswith("subsection "):
            path.append(words.split(" ", 1)[1].strip())
        elif words == "end":
            path.pop()
        elif words.startswith("set "):
            name, value = words[4:].split("=", 1)
            entries["/".join([*path, name.strip()])] = value.strip()
    return entries
