# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of the report about `voussoir needs`: verdicts of the modelling choices, and the smallest scene."""

import json
from html import escape
from pathlib import Path

from .error_bars import relevant
from .needs_verdicts import COLUMNS
from .report_answers import beside
from .report_tables import MINUS, html_table
from .runs import Skip
from .study_file import is_file_entry


def differs(run, entries):
    """First entry with another value in the run than in needs.json, None if there is none. Of files only the names count."""
    def value_of(entry, value):
        return Path(value).name if is_file_entry(entry) or entry in ("Motion/Sequence", "Motion/Ensemble", "Motion/Abutments") else value

    for entry, value in relevant({name: text for name, (text, _) in run.entries.items()}).items():
        if entry in entries and value_of(entry, value) != value_of(entry, entries[entry]):
            return entry
    return None


def needs_of(run):
    """Text, table (both HTML) and length of the motion [s] of needs.json of the run's scene. Throws Skip."""
    file = beside(run, "needs", "needs.json")
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        shown = smallest_sentence(found), needs_table(found), float(found["seconds"])
        entry = differs(run, found["entries"])
    except (ArithmeticError, AttributeError, LookupError, OSError, RecursionError, TypeError, ValueError) as error:
        raise Skip(f"{file} is not of voussoir needs ({type(error).__name__})") from error
    if entry is not None:
        raise Skip(f"{file} is of another version of the scene: {entry} differs")
    return shown


def percent(row, name):
    """Text of a relative change, in brackets if it is negligible, and half of its range from 16 to 84 % over the motions."""
    change, (low, high) = row["changes"][name], (row.get(end, {}).get(name) for end in ("low", "high"))
    if change is None:
        return ""
    text = f"{100 * change:+.{1 if abs(change) < 0.1 else 0}f}".replace("-", MINUS)
    return (text if row["counts"][name] else f"({text})") + ("" if low is None else f" ±{50 * (high - low):.1f}")


def needs_table(found):
    """Rows of the table as HTML."""
    heads = [("group", ""), ("choice", ""), *((f"{column.title} [%]", "n") for column in COLUMNS.values()), ("cost", "n"), ("verdict", "")]
    body, scatter = [], found.get("scatter") or {}
    if any(scatter.values()):
        body.append(("", ["motion", "scatter between the motions", *(f"±{100 * scatter[name]:.0f}" if scatter[name] else "" for name in COLUMNS), "", ""]))
    for row in found["rows"]:
        changes = row.get("changes")
        cells = [percent(row, name) for name in COLUMNS] if changes else [""] * len(COLUMNS)
        reason = f": {escape(str(row['reason']))}" if row["verdict"] == "not known" and row["reason"] else ""
        body.append(("", [escape(str(row["group"])), escape(str(row["name"])), *cells, f"{row['cost']:.2f}" if changes else "",
                          escape(str(row["verdict"])) + reason]))
    return html_table(heads, body)


def smallest_sentence(found):
    """What the smallest scene is, and whether its promise holds, as HTML."""
    smallest, target = found["smallest"], f"{100 * float(found['target']):g} %"
    text = f"<code>voussoir needs</code> changed one choice at a time, with a target of {target}. "
    if not smallest["rows"]:
        return text + "No cheaper combination of choices stays within the target."
    text += f"The smallest scene differs by: {escape('; '.join(map(str, smallest['rows'])))}. "
    if smallest["holds"] is None or "cost" not in smallest:
        return text + f"It was not compared with the scene ({escape(str(smallest['failure']))})."
    state = "stays within the target" if smallest["holds"] else '<b class="exceeded">does not stay within the target</b>'
    return text + (f"Over the whole motion it {state} in {int(smallest['within'])} of {int(smallest['of'])} results, for {float(smallest['cost']):.2f} of the "
                   "work.")
