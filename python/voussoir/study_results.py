# SPDX-License-Identifier: GPL-3.0-or-later
"""results.csv of a study: a row per scene with its factors and what its run gave (columns: scripts/columns.txt)."""

import csv
from pathlib import Path

import numpy as np

from .results import extremes_of
from .study_scene import summary_of
from .tables import read_table

NUMBERS = ("peak_acceleration", "opening", "slip", "tension", "tension_upstream", "tension_downstream", "compression",
           "damage_area", "damage_share", "crest_upstream", "crest_downstream", "energy_balance_error", "newton_mean", "seconds",
           "cpu_seconds", "memory_bytes", "warnings")


def share_above(values, limit):
    """The share of each triangle where a linear field is above the limit; `values` at its three corners."""
    low, middle, high = np.sort(values, axis=1).T
    with np.errstate(divide="ignore", invalid="ignore"):
        tip = (high - limit) ** 2 / ((high - low) * (high - middle))  # one corner above
        stump = 1. - (limit - low) ** 2 / ((high - low) * (middle - low))  # two corners above
    return np.where(low >= limit, 1., np.where(high <= limit, 0., np.where(middle <= limit, tip, stump)))


def area_above(points, cells, values, limit):
    """Area where the field is above the limit, and the whole area; quadrilaterals as four triangles around their centre."""
    centre, mean = points[cells].mean(axis=1), values[cells].mean(axis=1)
    above = whole = 0.
    for i in range(4):
        a, b = cells[:, i], cells[:, (i + 1) % 4]
        area = .5 * np.linalg.norm(np.cross(points[a] - centre, points[b] - centre), axis=1)
        above += float(area @ share_above(np.stack([values[a], values[b], mean], axis=1), limit))
        whole += float(area.sum())
    return above, whole


def damage(run, strength):
    """Area [m2] and share [-] of the two faces where the largest principal stress of the run exceeds the strength [Pa]."""
    if not (run / "faces.csv").is_file():
        return {}  # without Output/Envelope interval
    nodes, quads = read_table(run / "faces.csv"), read_table(run / "faces_cells.csv")
    points = np.stack([nodes[axis] for axis in "xyz"], axis=1)
    cells = np.stack([quads[f"n{i}"] for i in range(4)], axis=1).astype(int)
    above, whole = area_above(points, cells, nodes["max_principal"], strength) if len(cells) else (0., 0.)
    return {"damage_area": above, "damage_share": above / whole} if whole else {}


def motion_of(run):
    """Largest acceleration of the base in any direction [m/s2], and displacements of the crest from the static state, up- and downstream [m]."""
    columns = read_table(run / "history.csv")
    crest = columns["crest_x"] - columns["crest_x"][0]
    base = [np.abs(column).max() for name, column in columns.items() if name.startswith("base_acceleration_")]
    return {"peak_acceleration": max(base), "crest_upstream": -crest.min(), "crest_downstream": crest.max()}


def row_of(directory, name, strength):
    """All columns of a scene but its factors."""
    run, summary = Path(directory) / "runs" / name, summary_of(directory, name)
    extremes = extremes_of(summary)
    row = {"scene": name, "law": summary["law"], "foundation": summary["foundation"], "revision": summary["revision"],
           "opening": extremes.get("max_opening"), "slip": extremes.get("max_slip"),
           **{name: extremes.get(f"max_{name}_away_from_base") for name in ("tension_upstream", "tension_downstream", "compression")},
           "energy_balance_error": summary.get("energy_balance_error"),
           "newton_mean": summary.get("newton_iterations", {}).get("mean"), "seconds": summary["seconds"]["wall"],
           "cpu_seconds": summary["seconds"]["cpu"], "memory_bytes": summary["memory_bytes"], "warnings": len(summary["warnings"])}
    tensions = [row[column] for column in ("tension_upstream", "tension_downstream") if row[column] is not None]
    row["tension"] = max(tensions) if tensions else None
    return {**row, **({} if "ensemble" in summary else motion_of(run)), **damage(run, strength)}


def write_results(study, directory, scenes):
    """results.csv, written whole; the rows, factors as text and numbers as numbers."""
    rows = []
    for name, scene in scenes.items():
        rows.append({**scene["values"], **row_of(directory, name, study.strength)})
    columns = ["scene", *study.factors, "law", "foundation", *NUMBERS, "revision"]
    new = Path(directory) / "results.csv.new"
    with open(new, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in rows:
            writer.writerow(["" if row.get(column) is None else f"{row[column]:.9g}" if isinstance(row[column], float)
                             else row[column] for column in columns])
    new.replace(Path(directory) / "results.csv")
    return rows
