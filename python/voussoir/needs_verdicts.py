# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of `voussoir needs`: measures of a run, their changes, the verdict of a row, and the cheapest set of simplifications."""

from __future__ import annotations

import math
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from .results import Results
from .zone_tension import zone_means

Values = Dict[str, Optional[float]]
MATTERS, UNIMPORTANT, UNKNOWN = "matters", "does not matter", "not known"
CHEAPER = 0.8  # of the cost: a row with a higher ratio is no simplification, since the processor times of equal runs scatter by up to 20 %
CLOCK = 0.05  # shortest processor time [s] that is distinguished from a shorter one


class Column(NamedTuple):
    """A result: title, unit, its value in SI, and the difference that an engineer neglects, in SI."""

    title: str
    unit: str
    scale: float
    negligible: float


COLUMNS = {"opening": Column("largest opening", "mm", 1e3, 1e-4),
           "slip": Column("largest slip", "mm", 1e3, 1e-4),
           "tension_upstream": Column("tension upstream", "MPa", 1e-6, 2e4),
           "tension_downstream": Column("tension downstream", "MPa", 1e-6, 2e4),
           "base_shear": Column("base shear", "MN", 1e-6, 1e5),
           "sliding_safety": Column("sliding safety", "", 1., 0.05),
           "crest": Column("crest displacement", "mm", 1e3, 1e-4)}


def largest_at_joints(run: Results, quantity: str) -> Tuple[float, Optional[int]]:
    """Largest opening or slip [m] of all pairs and its joint; 0 and None for a monolithic dam."""
    if not (run.directory / "joint_points.csv").is_file():
        return 0., None
    points = run.table("joint_points")
    if len(points.get("joint", ())) == 0:
        return 0., None
    first = int(np.argmax(points[f"max_{quantity}"]))
    return float(points[f"max_{quantity}"][first]), int(points["joint"][first])


def worst_monolith(summary: Mapping[str, Any], name: str, choose: Any) -> Tuple[Optional[float], Optional[int]]:
    """Value of the worst monolith of summary.json and its number; None and None without a value."""
    found = [(block[name]["value"], int(monolith.split()[-1])) for monolith, block in summary.get("blocks", {}).items()
             if block.get(name, {}).get("value") is not None]
    return choose(found) if found else (None, None)


def measures_of(directory: Any) -> Dict[str, Any]:
    """Measures a run: "values" by column (SI), "where" (joint or monolith), "cost" [CPU s per s of earthquake], "cpu" [s],
    "setup" [s] and "seconds" of the earthquake."""
    run = Results(directory)
    summary, seconds = run.summary, run.summary["seconds"]
    opening, slip = (largest_at_joints(run, quantity) for quantity in ("opening", "slip"))
    shear, safety = worst_monolith(summary, "max_shear", max), worst_monolith(summary, "min_sliding_safety", min)
    zones = zone_means(directory)[0]
    half = len(zones) // 2
    crest = [np.sqrt(sum(run.history[f"{point}_{axis}"] ** 2 for axis in "xyz")).max() for point in ("crest", "crest_left")
             if f"{point}_x" in run.history]
    length = summary["steps"] * summary["time_step"]
    return {"values": {"opening": opening[0], "slip": slip[0], "tension_upstream": float(zones[:half].max()),
                       "tension_downstream": float(zones[half:].max()), "base_shear": shear[0], "sliding_safety": safety[0],
                       "crest": float(max(crest))},
            "where": {"opening": opening[1], "slip": slip[1], "base_shear": shear[1], "sliding_safety": safety[1]},
            "cost": max(seconds["shaking_cpu"], CLOCK) / length, "cpu": seconds["cpu"], "setup": seconds["cpu"] - seconds["shaking_cpu"], "seconds": length}


def changes_of(values: Values, reference: Values) -> Tuple[Values, Dict[str, bool]]:
    """Relative change of each column with sign, and whether it counts: its difference is not negligible.

    A reference below the negligible difference is replaced by this difference. A column that only one run has counts as -1 or 1."""
    changes: Values = {}
    counts: Dict[str, bool] = {}
    for name, column in COLUMNS.items():
        value, before = values.get(name), reference.get(name)
        if value is None or before is None:
            changes[name], counts[name] = (None, False) if value is before else (1. if before is None else -1., True)
        else:
            changes[name] = (value - before) / max(abs(before), column.negligible)
            counts[name] = abs(value - before) > column.negligible
    return changes, counts


def size_of(changes: Values, counts: Mapping[str, bool], columns: Iterable[str] = COLUMNS) -> float:
    """Largest change that counts, as a magnitude."""
    return max((abs(changes[name] or 0.) for name in columns if counts[name]), default=0.)


def errors_of(changes: Values, counts: Mapping[str, bool], mesh_error: Values) -> Values:
    """Numerical error of each change of a row on the coarse mesh: max(e, E) min(1, 2 sqrt(S)).

    e: error of the reference in this column by its mesh; E: root mean square of e over the columns, without the sliding safety; S: size of the row.
    A peak that the mesh does not hit in one column can be missed in another one, hence E. {} for rows without such an error."""
    if not mesh_error:
        return {}
    share = min(1., 2 * math.sqrt(size_of(changes, counts)))
    known = [mesh_error[name] or 0. for name in COLUMNS if name != "sliding_safety" and mesh_error.get(name) is not None]
    typical = math.sqrt(sum(error ** 2 for error in known) / max(1, len(known)))
    return {name: max(abs(mesh_error.get(name) or 0.), typical) * share for name in COLUMNS}


def verdict_of(changes: Values, counts: Mapping[str, bool], errors: Values, target: float) -> Tuple[str, str]:
    """Verdict of a row that has run, and the columns that decide it."""
    above, unsure = [], []
    for name, column in COLUMNS.items():
        change, error = abs(changes[name] or 0.), errors.get(name) or 0.
        if not counts[name]:
            continue
        if change > max(target, error):
            above.append(column.title)
        elif error > target:
            unsure.append(column.title)
    if above:
        return MATTERS, ", ".join(above)
    if unsure:
        return UNKNOWN, f"the numerical error is larger than the change: {', '.join(unsure)}"
    return UNIMPORTANT, ""


def merge_scatter(rows: List[Dict[str, Any]]) -> List[Dict[str, Any]]:
    """Joins the rows "scatter ..." of a group to one row with the largest change of each column; at the place of the first."""
    parts = [row for row in rows if row["name"].startswith("scatter")]
    good = [row for row in parts if row.get("changes")]
    if not parts:
        return rows
    joined = {**parts[0], "name": "scatter of the motion", "simpler": False, "set": {"runs": [row["set"] for row in parts]}}
    if good:
        pick = {name: max(good, key=lambda row: abs(row["changes"][name] or 0.)) for name in COLUMNS}
        joined.update({"cost": sum(row["cost"] for row in good) / len(good), "failure": None})
        for key in ("changes", "counts", "values", "where"):
            joined[key] = {name: pick[name][key].get(name) for name in COLUMNS}
    return [joined if row is parts[0] else row for row in rows if row is parts[0] or row not in parts]


def judge(rows: List[Dict[str, Any]], mesh_error: Values, target: float) -> None:
    """Adds "errors", "verdict" and "reason" to rows. mesh_error: relative error of the coarse reference, {} for rows of the scene's mesh."""
    for row in rows:
        if row.get("failure"):
            row.update(verdict=UNKNOWN, reason=row["failure"], errors={})
            continue
        row["errors"] = errors_of(row["changes"], row["counts"], mesh_error if row["reference"] == "coarse" else {})
        row["verdict"], row["reason"] = verdict_of(row["changes"], row["counts"], row["errors"], target)


def candidates_of(rows: List[Dict[str, Any]]) -> List[Dict[str, Any]]:
    """Rows that the smallest scene may adopt, the cheapest first."""
    return sorted((row for row in rows if row["simpler"] and row["verdict"] == UNIMPORTANT and row["cost"] < CHEAPER), key=lambda row: row["cost"])


def together(rows: List[Dict[str, Any]], name: str) -> float:
    """Expected change of a column by several rows: the sum with signs, but at least half of the root of the sum of squares."""
    changes = [row["changes"][name] or 0. for row in rows if row["counts"][name]]
    return max(abs(sum(changes)), .5 * math.sqrt(sum(change ** 2 for change in changes)))


def cheapest(candidates: List[Dict[str, Any]], target: float) -> List[Dict[str, Any]]:
    """Rows with the smallest product of cost ratios whose changes together are at most the target in each column.

    Two rows that set the same entry exclude each other."""
    best: Tuple[float, List[Dict[str, Any]]] = (1., [])
    remaining = [math.prod(row["cost"] for row in candidates[k:]) for k in range(len(candidates) + 1)]

    def extend(k: int, chosen: List[Dict[str, Any]], cost: float) -> None:
        nonlocal best
        if cost < best[0] and all(together(chosen, name) <= target for name in COLUMNS):
            best = (cost, chosen)
        for j in range(k, len(candidates)):
            row = candidates[j]
            if cost * remaining[j] >= best[0]:
                return
            if not any(set(row["set"]) & set(other["set"]) for other in chosen):
                extend(j + 1, [*chosen, row], cost * row["cost"])

    extend(0, [], 1.)
    return best[1]


def to_take_back(chosen: List[Dict[str, Any]], changes: Values, counts: Mapping[str, bool]) -> Dict[str, Any]:
    """The adopted row with the largest change in the column that misses the target most."""
    column = max(COLUMNS, key=lambda name: abs(changes[name] or 0.) if counts[name] else 0.)
    return max(chosen, key=lambda row: (abs(row["changes"][column] or 0.), size_of(row["changes"], row["counts"])))
