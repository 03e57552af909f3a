# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished run for report and figures: tables as arrays, summary, and the entries of the scene."""

import os
import re
from functools import cached_property
from pathlib import Path

import numpy as np

from . import tables
from .ensembles import Ensemble
from .error_bars import bars_of_run, scene_name
from .errors import InputError
from .prm import read_entries
from .results import read_summary
from .units import units_of


class Skip(Exception):
    """A figure or a result whose data are missing."""


class NotComputed(Skip):
    """Content that another command, or another entry of the scene, would add to a report."""


def read_table(path, text_columns=()):
    """Reads the columns of a table of numbers, except for the named columns of text. Throws Skip for a table without rows."""
    if not path.exists():
        raise Skip(f"no {path.name}")
    table = tables.read_table(path, text_columns)
    if not any(len(column) for column in table.values()):
        raise Skip(f"{path.name} is empty")
    return table


def read_history(path):
    """Reads a table over time. Throws Skip for a single time."""
    table = read_table(path)
    if "time" not in table:
        raise InputError(f"{path} is damaged: it has no column time. Repeat the run.")
    if len(table["time"]) < 2:
        raise Skip(f"{path.name} holds a single time")
    return table


def with_new_names(summary):
    """The summary of an earlier version under the names of this one."""
    renamed = {"max_tension_upstream_above_foot": "max_tension_upstream_away_from_base", "kept": "satisfied",
               "max_tension_downstream_above_foot": "max_tension_downstream_away_from_base", "limits_not_judged": "limits_not_evaluated"}
    if not isinstance(summary, dict):
        return summary
    return {renamed.get(name, name): with_new_names(value) for name, value in summary.items() if renamed.get(name) not in summary}


def refuse_links(directory):
    """Throws InputError if a directory, which may be of another person, has a link that leads out of it, or a pipe or a device."""
    root = Path(directory).resolve()
    for folder, folders, files in os.walk(root):
        for path in (Path(folder, name) for name in (*folders, *files)):
            try:
                target = path.resolve() if path.is_symlink() else path
            except (OSError, RuntimeError):  # a circle of links
                target = None
            if target is None or not target.is_relative_to(root) or not (target.is_file() or target.is_dir()):
                raise InputError(f"{Path(directory, path.relative_to(root))} is a link out of the directory, a pipe or a device. Remove it, or replace "
                                 "it by a copy of the file if you trust its source.")


class Run:
    """One finished run. Throws InputError for another directory, and Skip for a missing table."""

    def __init__(self, directory):
        self.directory = Path(directory)
        self.summary = with_new_names(read_summary(directory))
        self.scene = scene_name(directory, self.summary)
        self.law = str(self.summary.get("law", ""))
        self.tied = self.law.lower() == "tied"
        self.heading = f"{self.scene}, {self.law}" if self.law else self.scene
        self.name = self.heading  # among others; see name_apart()

    @cached_property
    def error_bars(self):
        """Error bars of the largest values by `voussoir accuracy` (see error_bars.bars_of_run()), and why there are none."""
        try:
            return (bars_of_run(self.directory, self.summary, None if self.ensemble else self.history), "") if self.moves else ({}, "")
        except (InputError, Skip) as reason:
            return {}, str(reason)

    @property
    def moves(self):
        """True if the run has an earthquake, not only a static state."""
        return self.summary.get("steps", 1) != 0

    @cached_property
    def ensemble(self):
        """Results of many motions in this directory, or None."""
        return Ensemble(self.directory, self.summary["ensemble"]) if self.summary.get("ensemble") else None

    @cached_property
    def warnings(self):
        """Warnings of summary.json, and those that only the log has: [{"class": "input" or "physics", "text", "place"}]. Texts of earlier
        versions count as physics."""
        found = [one if isinstance(one, dict) else {"class": "physics", "text": str(one), "place": ""} for one in self.summary.get("warnings", [])]
        known = {str(one["text"]) for one in found}
        logged = re.findall("^warning: (.+)$", self.log_text, re.M)
        return found + [{"class": "physics", "text": text, "place": ""} for text in dict.fromkeys(logged) if text not in known]

    @cached_property
    def log_text(self):
        file = self.directory / "log.txt"
        return file.read_text(errors="replace") if file.is_file() else ""

    def table(self, name, text_columns=()):
        return read_table(self.directory / name, text_columns)

    @cached_property
    def history(self):
        return read_history(self.directory / "history.csv")

    @cached_property
    def joint_history(self):
        return read_history(self.directory / "joint_history.csv")

    @cached_property
    def joints(self):
        """joints.csv from joint 1 on."""
        table = self.table("joints.csv")
        order = np.argsort(table["joint"])
        return {name: column[order] for name, column in table.items()}

    def joint_name(self, number, short=False):
        """joint 3, lift 2.1, or base 2 for the base joint of monolith 2; short: 3, l2.1 and b2."""
        mesh = self.summary.get("mesh", {})
        names = mesh.get("joint_names")
        name = names[int(number) - 1] if isinstance(names, list) and 0 < number <= len(names) else None
        if isinstance(name, str):
            return name.replace("joint ", "").replace("lift ", "l").replace("base ", "b") if short else name
        k = number - mesh.get("joints", number) - 1
        bases = mesh.get("base_joints", [])
        if not 0 <= k < len(bases):
            return f"{number}" if short else f"joint {number}"
        return f"b{bases[k]:g}" if short else f"base {bases[k]:g}"

    @cached_property
    def energy(self):
        table = read_history(self.directory / "energy.csv")
        if "joint_stored" in table or "joint_fracture" in table:
            table.pop("bond", None)  # their sum, under its name of earlier versions
        return table

    @cached_property
    def blocks(self):
        return read_history(self.directory / "blocks.csv")

    @cached_property
    def wedges(self):
        return read_history(self.directory / "wedges.csv")

    @cached_property
    def faces(self):
        """Both faces: name -> {x, y, z, s, quads, max_principal [Pa], ...}; quads are numbers on this face."""
        nodes, cells = self.table("faces.csv", ["face"]), self.table("faces_cells.csv", ["face"])
        quads = np.stack([cells[f"n{i}"] for i in range(4)], axis=1).astype(int)
        result = {}
        for name in ("upstream", "downstream"):
            mine = nodes["face"] == name
            if not mine.any():
                continue
            number = np.cumsum(mine) - 1  # line in the file -> number on this face
            result[name] = {key: column[mine] for key, column in nodes.items()}
            result[name]["quads"] = number[quads[cells["face"] == name]]
            for key in nodes:
                if ("principal" in key or "stress" in key) and not np.isfinite(result[name][key]).all():
                    raise ValueError(f"faces.csv: column {key} holds values that are not numbers")
        return result

    @cached_property
    def base_acceleration(self):
        """Direction -> acceleration [m/s2], of those that are not zero."""
        found = {}
        for name, column in self.history.items():
            match = re.fullmatch(r"(?:base_a|base_acceleration_|a_)([xyz])", name.lower())
            if match and np.any(column):
                found[match[1]] = column
        return found

    @cached_property
    def scene_text(self):
        file = self.directory / "scene.prm"
        return file.read_text(errors="replace") if file.is_file() else ""

    @cached_property
    def entries(self):
        return read_entries(self.scene_text)

    @cached_property
    def units(self):
        """Units of the entries, "Section/Entry" -> unit."""
        return units_of(self.scene_text)

    def value(self, entry):
        """Number of an entry of the scene in its unit, 0 if there is none."""
        try:
            return float(self.entries[entry][0])
        except (KeyError, ValueError):
            return 0.

    def limit(self, name):
        """Entry "Limits/NAME" of the scene in its unit, 0 if there is none."""
        return self.value(f"Limits/{name}")

    @property
    def static_strength(self):
        """Static tensile strength of the scene [Pa] as the program takes it, 0 if there is none."""
        return self.limit("Static tensile strength") or 2. / 3. * self.limit("Tensile strength")

    @cached_property
    def facts(self):
        """Lines of the log before the first step: {title: text}."""
        facts, title = {}, None
        for line in self.log_text.splitlines():
            if line.startswith(("   time", "Ensemble ", "Limits ", "Joints    largest", "Tension ")):  # results of a static state follow it at once
                break
            if match := re.match(r"([A-Z]\w+) {1,9}(?=\S)(.*)", line):
                title = match[1]
                facts[title] = match[2] if title not in facts else facts[title] + "; " + match[2]
            elif title and line.startswith(" " * 10):
                facts[title] += "; " + line.strip()
        return facts


def name_apart(runs):
    """Gives every run the shortest name that tells it from the others."""
    for names in ([run.law for run in runs], [run.scene for run in runs], [run.heading for run in runs],
                  [run.directory.resolve().name for run in runs], [str(run.directory) for run in runs]):
        if all(names) and len(set(names)) == len(runs):
            for run, name in zip(runs, names):
                run.name = name
            return
    for number, run in enumerate(runs, 1):
        run.name = f"{run.heading} ({number})"
