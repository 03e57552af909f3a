# SPDX-License-Identifier: GPL-3.0-or-later
"""Output of `voussoir needs`: table on the terminal, needs.csv, needs.json, a tornado chart per result, smallest.prm."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from textwrap import wrap
from typing import Any, Dict, List, Mapping, Tuple

from .command import write_whole
from .needs_verdicts import COLUMNS, UNKNOWN
from .palette import COLOURS
from .prm import prm_text, read_entries
from .program import call, set_options
from .study_file import with_paths

SHORT = {"opening": "opening", "slip": "slip", "tension_upstream": "tens. up", "tension_downstream": "tens. dn", "base_shear": "shear",
         "sliding_safety": "safety", "crest": "crest"}


def signed(change: Any, counts: bool = True) -> str:
    """Text of a relative change in percent with sign; in brackets if it is negligible."""
    if change is None:
        return "-"
    size = abs(100 * change)
    if size < 0.005:
        return "0"
    text = f"{100 * change:+.{2 if size < 1 else 1 if size < 10 else 0}f}"
    return text if counts else f"({text})"


def change_text(row: Mapping[str, Any], name: str) -> str:
    """Median change of a row, and half of its range from 16 to 84 % over the motions."""
    text, low, high = signed(row["changes"][name], row["counts"][name]), row["low"][name], row["high"][name]
    return text if low is None or high - low < 1e-4 else f"{text} ±{50 * (high - low):.{1 if high - low < 0.2 else 0}f}"


def motions_text(n: int) -> str:
    return "1 motion" if n == 1 else f"{n} motions"


def value_text(name: str, reference: Mapping[str, Any]) -> str:
    """A value with its unit, and the joint or monolith that has it."""
    column, value, where = COLUMNS[name], reference["values"][name], reference["where"].get(name)
    if value is None:
        return f"{column.title} none"
    place = f" ({'joint' if name in ('opening', 'slip') else 'monolith'} {where})" if where is not None else ""
    return f"{column.title} {column.scale * value:.4g}{' ' + column.unit if column.unit else ''}{place}"


def print_table(rows: List[Dict[str, Any]], target: float, marked: bool, scatter: Mapping[str, Any]) -> None:
    """Prints the table of rows. marked: rows of the scene's own mesh have a star."""
    print(f"\n  {'group':11s}{'row':30s}" + "".join(f"{SHORT[name]:>12s}" for name in COLUMNS) + f"{'motions':>9s}{'cost':>6s}  "
          "verdict; median change over the motions [%] ± half of its range from 16 to 84 %")
    if any(scatter.values()):
        print(f"  {'motion':11s}{'scatter between the motions':30s}"
              + "".join(f"{f'±{100 * size:.0f}' if (size := scatter[name]) is not None else '-':>12s}" for name in COLUMNS))
    group = None
    for row in rows:
        title = row["group"] if row["group"] != group else ""
        group = row["group"]
        if row.get("changes"):
            cells = "".join(f"{change_text(row, name):>12s}" for name in COLUMNS) + f"{row['n']:>9d}{row['cost']:>6.2f}"
        else:
            cells = " " * (12 * len(COLUMNS) + 15)
        reason = f": {row['reason']}" if row["reason"] else ""
        name = row["name"] + (" *" if marked and row["reference"] == "scene" else "")
        print(f"  {title:11s}{name:30s}{cells}  {row['verdict']}{reason}")
    print(f"  In brackets: differences that are negligible, whatever their percentage (doc/needs.md). Target: {100 * target:g} %.")


def write_table(rows: List[Dict[str, Any]], file: Path, scatter: Mapping[str, Any]) -> None:
    """Writes needs.csv: a line per row, changes as shares; scatter_* are the scatter between the motions."""
    with open(file, "w", newline="", encoding="utf-8") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["group", "row", "settings", "simpler", "reference", "motions",
                        *(f"{kind}_{name}" for kind in ("change", "low", "high", "error", "scatter") for name in COLUMNS),
                        "opening_joint", "slip_joint", "shear_monolith", "safety_monolith", "cost", "verdict", "reason"])
        for row in rows:
            def number(value: Any) -> str:
                return "" if value is None else f"{value:.6g}"
            kinds, where = [row.get(key) or {} for key in ("changes", "low", "high", "errors")] + [scatter], row.get("where") or {}
            table.writerow([row["group"], row["name"], "; ".join(f"{entry} = {value}" for entry, value in row["set"].items()), row["simpler"], row["reference"],
                            row.get("n", ""), *(number(kind.get(name)) for kind in kinds for name in COLUMNS),
                            *(where.get(name) or "" for name in ("opening", "slip", "base_shear", "sliding_safety")), number(row.get("cost")), row["verdict"],
                            row["reason"]])


def write_json(result: Mapping[str, Any], file: Path) -> None:
    """Writes needs.json, whole or not at all."""
    write_whole(file, json.dumps(result, indent=1, default=str) + "\n")


def draw(rows: List[Dict[str, Any]], target: float, directory: Path, scatter: Mapping[str, Any]) -> List[Path]:
    """Draws a tornado chart per result: the largest change on top, with its range over the motions, the target as a band, the scatter between the
    motions as lines. Colours: above the target, within it, and grey for rows with the verdict "not known"."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    files = []
    for name, column in COLUMNS.items():
        shown = sorted((row for row in rows if (row.get("changes") or {}).get(name) is not None), key=lambda row: abs(row["changes"][name]))
        if not shown:
            continue
        figure, axes = plt.subplots(figsize=(8, 1.4 + 0.24 * len(shown)))
        axes.axvspan(-100 * target, 100 * target, color="0.9", zorder=0, label=f"target, {100 * target:g} %")
        for sign in (-1, 1) if scatter[name] else ():
            axes.axvline(sign * 100 * scatter[name], color="0.3", linewidth=1, linestyle="--", label="scatter between the motions" if sign == 1 else None)
        for k, row in enumerate(shown):
            change = 100 * row["changes"][name]
            colour = "0.6" if row["verdict"] == UNKNOWN else COLOURS[1 if row["counts"][name] and abs(change) > 100 * target else 2]
            axes.barh(k, change, height=0.6, color=colour, alpha=0.85)
            if row["low"][name] is not None:
                axes.plot((100 * row["low"][name], 100 * row["high"][name]), (k - 0.2, k - 0.2), color="0.2", linewidth=1)
            axes.annotate(f"{signed(row['changes'][name])}", (change, k), xytext=(4 if change >= 0 else -4, 0), textcoords="offset points",
                          ha="left" if change >= 0 else "right", va="center", fontsize=8)
        axes.axvline(0, color="0.2", linewidth=0.8)
        axes.set_yticks(range(len(shown)), [f"{row['group']}: {row['name']}" for row in shown], fontsize=8)
        axes.margins(x=0.12)
        axes.set(xlabel=f"change of the {column.title} [%]", ylim=(-0.6, len(shown) - 0.4))
        axes.legend(loc="lower right", frameon=False, fontsize=8)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        files.append(directory / f"tornado_{name}.png")
        figure.savefig(files[-1], dpi=120, bbox_inches="tight")
        plt.close(figure)
    return files


def remark_of(row: Mapping[str, Any], before: Mapping[str, str], entry: str) -> str:
    """Comment of a changed line of smallest.prm: what, effect, cost."""
    effects = ", ".join(f"{column.title} {change_text(row, name)} %" for name, column in COLUMNS.items()
                        if row["changes"][name] is not None and row["counts"][name])
    return "\n".join(wrap(f"{row['name']}, instead of \"{before[entry]}\": {effects or 'no change that counts'}; cost x {row['cost']:.2f}", 110))


def smallest_text(scene: Path, settings: Any, chosen: List[Dict[str, Any]], target: float, directory: Path) -> Tuple[str, Dict[str, Any]]:
    """Text of smallest.prm with a comment for each changed line, and its changes. Paths of files are relative to @p directory."""
    changes = {entry: value for row in chosen for entry, value in {**row["set"], **row.get("extra", {})}.items()}
    before = {entry: value for entry, (value, _) in read_entries(call("scene", scene, *set_options(settings))).items()}
    entries = read_entries(call("scene", scene, *set_options([*settings, *(f"{entry}={value}" for entry, value in changes.items())])))
    written, remarks = {}, {}
    for entry, (value, default) in entries.items():
        if default is None and entry not in changes:
            continue
        text, files = with_paths(entry, value, scene.parent)
        for file in files:
            text = text.replace(file, os.path.relpath(file, directory))
        written[entry] = text
        if (row := next((row for row in chosen if entry in row["set"]), None)) is not None:
            remarks[entry] = remark_of(row, before, entry)
        elif entry in changes:
            remarks[entry] = f"required by another change, instead of \"{before[entry]}\""
    head = (f"# Smallest scene for a target of {100 * target:g} %, made from {scene.name} by `voussoir needs`.\n"
            "# Entries that are not listed have their defaults.\n")
    return head + prm_text(written, remarks), changes
