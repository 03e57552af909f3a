# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of `voussoir needs`: measures of a run, paired changes, the verdict of a row, and the cheapest set of simplifications."""

from __future__ import annotations

import math
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from .ensembles import Ensemble
from .results import Results

Values = Dict[str, Optional[float]]
Motions = Dict[int, Values]  # values by number of the motion
MATTERS, BELOW, UNIMPORTANT, UNKNOWN = "matters", "matters less than the motion", "does not matter", "not known"
CHEAPER = 0.95  # of the work: a row with a higher ratio is no simplification
FEWEST = 3  # motions of a range
OF_MEDIAN = math.sqrt(math.pi / 2)  # standard error of a median over that of a mean


class Column(NamedTuple):
    """A result: title, unit, its value in SI, the difference that an engineer neglects, in SI, and its name among the extremes of a run."""

    title: str
    unit: str
    scale: float
    negligible: float
    extreme: str = ""


COLUMNS = {"opening": Column("largest opening", "mm", 1e3, 1e-4, "max_opening"),
           "slip": Column("largest slip", "mm", 1e3, 1e-4, "max_slip"),
           "tension_upstream": Column("tension upstream", "MPa", 1e-6, 2e4, "max_tension_upstream_away_from_base"),
           "tension_downstream": Column("tension downstream", "MPa", 1e-6, 2e4, "max_tension_downstream_away_from_base"),
           "base_shear": Column("base shear", "MN", 1e-6, 1e5),
           "sliding_safety": Column("sliding safety", "", 1., 0.05),
           "crest": Column("crest displacement", "mm", 1e3, 1e-4)}


def largest_joint(run: Results, quantity: str) -> Optional[int]:
    """Joint with the largest opening or slip; None for a monolithic dam."""
    points = run.table("joint_points") if (run.directory / "joint_points.csv").is_file() else {}
    return int(points["joint"][np.argmax(points[f"max_{quantity}"])]) if len(points.get("joint", ())) else None


def worst_monolith(summary: Mapping[str, Any], name: str, choose: Any) -> Tuple[Optional[float], Optional[int]]:
    """Value of the worst monolith of summary.json and its number; None and None without a value."""
    found = [(block[name]["value"], int(monolith.split()[-1])) for monolith, block in summary.get("blocks", {}).items()
             if block.get(name, {}).get("value") is not None]
    return choose(found) if found else (None, None)


def values_of(extremes: Mapping[str, float]) -> Values:
    """Values of the columns that are extremes of a run; opening and slip of a monolithic dam are 0."""
    return {name: extremes.get(column.extreme, 0. if name in ("opening", "slip") else None) for name, column in COLUMNS.items() if column.extreme}


def measures_of(directory: Any) -> Tuple[Values, Dict[str, Optional[int]]]:
    """Values of a run by column (SI), and the joint or monolith of some of them."""
    run = Results(directory)
    shear, safety = worst_monolith(run.summary, "max_shear", max), worst_monolith(run.summary, "min_sliding_safety", min)
    crest = [np.sqrt(sum(run.history[f"{point}_{axis}"] ** 2 for axis in "xyz")).max() for point in ("crest", "crest_left")
             if f"{point}_x" in run.history]
    values = values_of({name: extreme["value"] for name, extreme in run.summary["extremes"].items()})
    return ({**values, "base_shear": shear[0], "sliding_safety": safety[0], "crest": float(max(crest))},
            {"opening": largest_joint(run, "opening"), "slip": largest_joint(run, "slip"), "base_shear": shear[1], "sliding_safety": safety[1]})


def measures_of_ensemble(directory: Any) -> Tuple[Motions, Dict[str, Optional[int]]]:
    """Values of the motions of an ensemble that have results, and places as measures_of(). The columns that are no extremes are of the first
    motion, whose tables are in motion-1."""
    table = Ensemble(directory, {}).motions
    motions = {k: values_of({name: float(column[k]) for name, column in table.items() if name.startswith("max_")})
               for k, status in enumerate(table["status"]) if status == "ok"}
    first, where = measures_of(f"{directory}/motion-1")
    if 0 in motions:
        motions[0] = {**first, **motions[0]}
    return motions, where


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


def paired(motions: Motions, references: Motions) -> Dict[str, Any]:
    """Changes of a row, motion by motion: "changes", their medians; "low" and "high", 16 and 84 % from three motions on; "counts", whether at least half
    of the differences are not negligible; "ratios" of each motion; "n", number of motions."""
    both = sorted(set(motions) & set(references))
    found: Dict[str, Any] = {"n": len(both), "changes": {}, "counts": {}, "low": {}, "high": {}, "ratios": {}}
    each = [changes_of(motions[k], references[k]) for k in both]
    for name in COLUMNS:
        values = [changes[name] for changes, _ in each if changes[name] is not None]
        found["ratios"][name] = [1. + value for value in values]
        found["changes"][name] = float(np.median(values)) if values else None
        found["counts"][name] = 2 * sum(counts[name] for _, counts in each) >= max(1, len(values))
        found["low"][name], found["high"][name] = map(float, np.percentile(values, (16, 84))) if len(values) >= FEWEST else (None, None)
    return found


def scatter_of(motions: Motions) -> Values:
    """Half of the range from 16 to 84 % over the motions, relative to the median; None with less than three motions."""
    result: Values = {}
    for name, column in COLUMNS.items():
        values = [value for one in motions.values() if (value := one.get(name)) is not None]
        if len(values) < FEWEST:
            result[name] = None
            continue
        low, middle, high = np.percentile(values, (16, 50, 84))
        result[name] = float((high - low) / 2 / max(abs(middle), column.negligible))
    return result


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


def verdict_of(changes: Values, counts: Mapping[str, bool], errors: Values, target: float, scatter: Values) -> Tuple[str, str]:
    """Verdict of a row that has run, and the columns that decide it. A column without scatter, such as those of the first motion alone, is compared with the
    largest scatter of the others."""
    above, below, unsure = [], [], []
    largest = max((size for size in scatter.values() if size is not None), default=0.)
    for name, column in COLUMNS.items():
        change, error = abs(changes[name] or 0.), errors.get(name) or 0.
        if not counts[name]:
            continue
        if change > max(target, error):
            (above if change > (largest if (size := scatter.get(name)) is None else size) else below).append(column.title)
        elif error > target:
            unsure.append(column.title)
    if above:
        return MATTERS, ", ".join(above)
    if below:
        return BELOW, ", ".join(below)
    if unsure:
        return UNKNOWN, f"the error is larger than the change: {', '.join(unsure)}"
    return UNIMPORTANT, ""


def judge(rows: List[Dict[str, Any]], mesh_error: Values, target: float, scatter: Values) -> None:
    """Adds "errors", "verdict" and "reason" to rows. The error of a change is the larger of its numerical error and the standard error of its median.
    mesh_error: relative error of the coarse reference, {} for rows of the scene's mesh."""
    for row in rows:
        if row.get("failure"):
            row.update(verdict=UNKNOWN, reason=row["failure"], errors={})
            continue
        row["errors"] = errors_of(row["changes"], row["counts"], mesh_error if row["reference"] == "coarse" else {})
        for name, low in row["low"].items():
            if low is not None:  # of a median
                row["errors"][name] = max(row["errors"].get(name) or 0., OF_MEDIAN * (row["high"][name] - low) / 2 / math.sqrt(row["n"]))
        row["verdict"], row["reason"] = verdict_of(row["changes"], row["counts"], row["errors"], target, scatter)
        row["reason"] = "; ".join(filter(None, (row["reason"], row.get("missing"))))


def candidates_of(rows: List[Dict[str, Any]], target: float = 0.) -> List[Dict[str, Any]]:
    """Rows that the smallest scene may adopt, the cheapest first. With a target also rows whose changes less their errors are within it."""
    def may_hold(row: Dict[str, Any]) -> bool:
        return all(abs(row["changes"][name] or 0.) - (row["errors"].get(name) or 0.) <= target for name in COLUMNS if row["counts"][name])

    return sorted((row for row in rows if row["simpler"] and row.get("changes") and row["cost"] < CHEAPER
                   and (row["verdict"] == UNIMPORTANT or target > 0. and may_hold(row))), key=lambda row: row["cost"])


def together(rows: List[Dict[str, Any]], name: str) -> float:
    """Expected change of a column by several rows: the sum with signs, but at least half of the root of the sum of squares."""
    changes = [row["changes"][name] or 0. for row in rows if row["counts"][name]]
    return max(abs(sum(changes)), .5 * math.sqrt(sum(change ** 2 for change in changes)))


def cheapest(candidates: List[Dict[str, Any]], target: float, measured: Optional[Dict[str, Any]] = None) -> List[Dict[str, Any]]:
    """Rows with the smallest product of cost ratios whose changes together are at most the target in each column.

    Two rows that set the same entry exclude each other. @p measured: changes to which those of the rows are added, and entries that are set already."""
    first = [measured] if measured else []
    best: Tuple[float, List[Dict[str, Any]]] = (1., first)
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

    extend(0, first, 1.)
    return best[1][len(first):]


def to_take_back(chosen: List[Dict[str, Any]], changes: Values, counts: Mapping[str, bool]) -> Dict[str, Any]:
    """The adopted row with the largest change per saving in the column that misses the target most. The saving is the logarithm of the cost ratio."""
    column = max(COLUMNS, key=lambda name: abs(changes[name] or 0.) if counts[name] else 0.)
    return max(chosen, key=lambda row: (abs(row["changes"][column] or 0.) / -math.log(row["cost"]), size_of(row["changes"], row["counts"])))
