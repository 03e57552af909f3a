# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of many motions in one output directory (Motion/Ensemble): a row per motion, and the fractiles over the motions."""

import math
from functools import cached_property
from pathlib import Path

import numpy as np

from .errors import InputError
from .tables import read_table

NAMES = ("name", "status")  # columns of text
ENDS = ("median", "p16", "p84")
# How much the largest values of motions that match one spectrum differ [%], from 16 to 84 % about the median: of up to 64 artificial motions, for
# dams with 5 and with 28 joints.
SCATTER = {"openings": 25, "tensions": 10}


def numbers(column):
    """Numbers of a column; nan for an empty cell. Throws ValueError for a text."""
    return np.array([float(text) if str(text).strip() else np.nan for text in column])


def members_of(entries, n):
    """Settings that reduce a scene to one motion, for each motion of its ensemble (with several factors those with the factor nearest to 1), or for
    n artificial motions with the seeds from its own on; one motion if the scene has another source."""
    text, single = entries["Motion/Ensemble"], {f"Motion/Ensemble{name}": "" for name in ("", " factors", " output")}
    if entries["Motion/Source"] == "artificial" and not text and not entries["Motion/Sequence"]:
        seed = int(entries["Motion/Seed"])
        return [{"Motion/Seed": seed + k} for k in range(n)]
    if not text:
        return [{}]
    if factors := [float(word) for word in entries["Motion/Ensemble factors"].split(",") if word.strip()]:
        single["Motion/Factor"] = float(entries["Motion/Factor"]) * min(factors, key=lambda factor: abs(math.log(factor)))
    members = []
    for element in text.split(";"):
        files = [word.strip() for word in element.split(",")]
        if entries["Motion/Source"] == "artificial":
            first, _, last = element.partition("-")
            members += [{**single, "Motion/Seed": seed} for seed in range(int(first), int(last or first) + 1)]
        elif len(files) == 1:
            members.append({**single, "Motion/File": files[0]})
        else:
            members.append({**single, **{f"Motion/File {axis}": "" if file == "-" else file for axis, file in zip("xyz", files)}})
    return members


class Ensemble:
    """Motions and fractiles of a run. @p found: "ensemble" of summary.json. Throws InputError for damaged tables."""

    def __init__(self, directory, found):
        self.directory, self.found = Path(directory), found if isinstance(found, dict) else {}

    def damaged(self, file, error):
        return InputError(f"{self.directory / file} is damaged ({error}). Repeat the run.")

    @cached_property
    def motions(self):
        """ensemble.csv: name -> column; nan where a motion has no result."""
        table = read_table(self.directory / "ensemble.csv")
        try:
            if not {"motion", "factor", *NAMES} <= set(table) or not len(table["motion"]):
                raise ValueError("it has no motions, or not the columns motion, name, factor and status")
            return {name: column.astype(str) if name in NAMES else numbers(column) for name, column in table.items()}
        except ValueError as error:
            raise self.damaged("ensemble.csv", error) from error

    @cached_property
    def joints(self):
        """ensemble_joints.csv, sorted by joint; None for a dam without joints."""
        if not (self.directory / "ensemble_joints.csv").exists():
            return None
        table = read_table(self.directory / "ensemble_joints.csv")
        columns = ["joint", "s", *(f"{quantity}_{end}" for quantity in ("opening", "slip") for end in ENDS)]
        try:
            if missing := [name for name in columns if name not in table]:
                raise ValueError(f"there is no column {missing[0]}")
            table = {name: numbers(table[name]) for name in columns}
        except ValueError as error:
            raise self.damaged("ensemble_joints.csv", error) from error
        order = np.argsort(table["joint"])
        return {name: column[order] for name, column in table.items()} if len(order) else None

    @property
    def factor(self):
        """Factor of the motions to which the fractiles of summary.json belong."""
        return float(self.found.get("factor", 1.))

    @cached_property
    def factors(self):
        """All factors, ascending."""
        return [float(x) for x in np.unique(self.motions["factor"])]

    def rows(self, factor=None):
        """Which rows of ensemble.csv have this factor, by default that of the fractiles."""
        return np.isclose(self.motions["factor"], self.factor if factor is None else factor)

    def values(self, name, factor=None):
        """A column of the motions with this factor that were computed to the end."""
        column = self.motions.get(name)
        return np.zeros(0) if column is None else column[self.rows(factor) & np.isfinite(column)]

    @property
    def n(self):
        """Number of motions with results."""
        return int(self.found.get("n", self.rows().sum()))

    @cached_property
    def failed(self):
        """(name, status) of the motions without results."""
        factors = [f", factor {x:g}" if len(self.factors) > 1 else "" for x in self.motions["factor"]]
        return [(name + factor, status) for name, factor, status in zip(self.motions["name"], factors, self.motions["status"]) if status != "ok"]

    @cached_property
    def extremes(self):
        """Fractiles of the extremes: {name: {"median", "p16", ...}}."""
        return {name: found for name, found in self.found.items() if isinstance(found, dict) and is_number(found.get("median"))}

    def of_factors(self):
        """Fractiles of the extremes for each factor, ascending: [(factor, {name: ...})]."""
        listed = self.found.get("factors")
        listed = listed if isinstance(listed, list) and listed else [self.found]
        extremes = lambda one: {name: found for name, found in one.items() if isinstance(found, dict) and is_number(found.get("median"))}
        return sorted(((float(one.get("factor", 1.)), extremes(one)) for one in listed if isinstance(one, dict)), key=lambda pair: pair[0])

    def curves(self, quantity):
        """Largest openings or slips [m] of the joints, a row for each motion with results."""
        names = [f"{quantity}_{joint:.0f}" for joint in (self.joints or {"joint": []})["joint"]]
        if not names or any(name not in self.motions for name in names):
            return np.zeros((0, len(names)))
        columns = np.stack([self.motions[name] for name in names], axis=1)[self.rows()]
        return columns[np.isfinite(columns).all(axis=1)]

    def known(self):
        """Sentence on how well the median of the largest opening (or of the first extreme) is known."""
        name = "max_opening" if "max_opening" in self.extremes else next(iter(self.extremes), None)
        found = self.extremes.get(name, {})
        if self.n < 2:
            return "One motion: the scatter is unknown."
        if not is_number(found.get("known_68")):
            return f"{self.n} motions."
        text = f"{self.n} motions: the median is known within {percent(found['known_68'])} (68 %)"
        if is_number(found.get("known_95")):
            text += f", {percent(found['known_95'])} (95 %)"
        return text + "."


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def percent(share):
    return f"{100. * share:.2g} %"
