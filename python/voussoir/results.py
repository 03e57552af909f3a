# SPDX-License-Identifier: GPL-3.0-or-later
"""The output directory of a run: summary, tables and meshes."""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import Any, Dict

from .error_bars import bars_of_run
from .errors import InputError
from .tables import PathLike, Table, read_table


def read_summary(directory: PathLike) -> Dict[str, Any]:
    """Reads summary.json of a finished run; throws InputError if the file is missing or damaged."""
    file = Path(directory) / "summary.json"
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except OSError:
        raise InputError(f"{directory} holds no summary.json, so it is not the output directory of a finished run. Give the "
                         "directory that voussoir was told to write to with --output.") from None
    except (RecursionError, ValueError) as error:
        raise InputError(f"{file} is not valid JSON: {error}. Repeat the run.") from error
    if not isinstance(found, dict):
        raise InputError(f"{file} does not hold an object. Repeat the run.")
    return found


def extremes_of(summary: Dict[str, Any]) -> Dict[str, float]:
    """Extremes of a run by name; of an ensemble, their medians."""
    if "ensemble" in summary:
        return {key: value["median"] for key, value in summary["ensemble"].items() if isinstance(value, dict) and "median" in value}
    return {key: value["value"] for key, value in summary["extremes"].items()}


def _table_property(name: str, contents: str) -> cached_property[Table]:
    """Returns a property of Results that reads NAME.csv at its first use."""
    table = cached_property(lambda results: results.table(name))
    table.__doc__ = contents
    return table


class Results:
    """The directory of a run. A table is read at its first use."""

    def __init__(self, directory: PathLike) -> None:
        self.directory = Path(directory)
        if not (self.directory / "log.txt").is_file():
            raise InputError(f"{self.directory} is not the directory of a run: it has no log.txt.")

    def __repr__(self) -> str:
        return f"Results({str(self.directory)!r})"

    def table(self, name: str) -> Table:
        """Reads the columns of NAME.csv by name: numbers, or text."""
        return read_table(self.directory / f"{name}.csv")

    @cached_property
    def summary(self) -> Dict[str, Any]:
        """summary.json, which a finished run has."""
        return read_summary(self.directory)

    @cached_property
    def error_bars(self) -> Dict[str, Any]:
        """Error bars of the largest values, from `voussoir accuracy` of the same scene in DIR/accuracy or SCENE-accuracy beside DIR.

        {quantity: {"value", "low", "high", "combined", "parts", "unit"}} [m, Pa], see error_bars.bars_of_run(); throws InputError if there are none."""
        return bars_of_run(self.directory, self.summary, None if "ensemble" in self.summary else self.history)

    history = _table_property("history", "Crest, base and probes over time [s, m, m/s2].")
    joints = _table_property("joints", "Largest opening and slip of each joint at the crest [m].")
    joint_history = _table_property("joint_history", "Opening and slip of each joint at the crest over time [s, m].")
    blocks = _table_property("blocks", "Forces on the bases of the monoliths over time [s, N, N m].")
    wedges = _table_property("wedges", "Force of the dam on the rock wedges and their sliding safety over time [s, N, m/s2].")
    energy = _table_property("energy", "Energies over time [s, J].")
    faces = _table_property("faces", "Envelope of the principal stresses on the faces [m, Pa].")

    def mesh(self, name: str = "envelope.vtu") -> Any:
        """Reads a .vtu file as a meshio.Mesh."""
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


def load(directory: PathLike) -> Results:
    """Returns the results of an earlier run."""
    return Results(directory)
