# SPDX-License-Identifier: GPL-3.0-or-later
"""Error bars of the largest values of a run: the rule of `voussoir accuracy`, and what a reader of a run gets.

Each choice of a scene (time step, elements along, up, through, ...) is refined alone. Its signed error of a value is the limit at size zero
minus the value of the scene. With three levels whose differences have one sign and decrease, the order is fitted; elsewhere a cautious
order is taken. The centre of the bar is the value plus the signed errors of all choices (combination). The bar contains the value.

The doubt of a choice is the largest of: the extrapolated part of its signed error (limit minus finest level); without a fit of three levels
the largest difference between them; the median of its relative signed errors of all quantities, since the error of one quantity may be small
by chance. The margin on both sides of the centre is MARGIN times the root of the sum of squares of the doubts.

This bar is the part of mesh and step. An ensemble, whose value is the median over its motions, adds the part of the motion: how well the median is
known. `voussoir needs` of the scene adds the part of the damping ratio: the paired changes by its rows of other ratios.
"""

import json
import math
from pathlib import Path
from statistics import median

from .errors import InputError
from .prm import read_entries

AWAY = "_away_from_base"
HEADLINES = {  # quantity -> title, unit, least value that has a bar
    "max_opening": ("largest opening", "m", 1e-5), "max_slip": ("largest slip", "m", 1e-5),
    f"max_tension_upstream{AWAY}": ("tension upstream", "Pa", 1e3), f"max_tension_downstream{AWAY}": ("tension downstream", "Pa", 1e3),
    "crest_displacement": ("crest displacement", "m", 1e-5)}
UNITS = {"m": (1e3, "mm"), "Pa": (1e-6, "MPa")}  # of printed values
MARGIN = 1.25
UNRELATED = ("Output/", "Contact/Write")  # beginnings of entries that do not change the results

OF_STRESSES = ("Output/Stress recovery", "Output/Envelope interval")
RATIO = "Damping/Ratio"
COLUMNS = {"max_opening": "opening", "max_slip": "slip", f"max_tension_upstream{AWAY}": "tension_upstream",  # of `voussoir needs`
           f"max_tension_downstream{AWAY}": "tension_downstream", "crest_displacement": "crest"}
SMALLEST_SHARE = 0.5  # of a value in the window, relative to that of the run: below, the window does not show this value


def headlines(summary, history):
    """Largest values of a run from summary.json and history.csv (None: of an ensemble, their medians): {quantity: value [m, Pa]}, of those with a bar.

    crest_displacement is the largest |crest_x| over time. Openings, slips and displacements below 0.01 mm are left out."""
    extremes, kind = (summary["ensemble"], "median") if "ensemble" in summary else (summary.get("extremes", {}), "value")
    found = {name: extremes[name][kind] for name in HEADLINES if name in extremes}
    if history and "crest_x" in history:
        found["crest_displacement"] = float(abs(history["crest_x"]).max())
    return {name: float(value) for name, value in found.items() if isinstance(value, (int, float)) and value > HEADLINES[name][2]}


def solve_order(quotient, coarse, fine):
    """p of errors C h^p from the quotient of their differences, h falling by the factors coarse, then fine; 1 to 4."""
    def of(p):
        return fine ** p * (coarse ** p - 1) / (fine ** p - 1)
    low, high = 1.0, 4.0
    if quotient <= of(low) or quotient >= of(high):
        return low if quotient <= of(low) else high
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if of(middle) < quotient else (low, middle)
    return low


def limit_and_doubt(values, sizes, order):
    """Limit at size zero of one value, and the doubt of the limit. values, sizes: from coarse to fine; order: where none can be fitted."""
    values, sizes, scatter = values[-3:], sizes[-3:], 0.
    if len(values) > 2:
        first, last = values[1] - values[0], values[2] - values[1]
        if first * last > 0 and abs(last) < abs(first):
            order = solve_order(first / last, sizes[0] / sizes[1], sizes[1] / sizes[2])
        else:
            scatter = max(values) - min(values)
    extrapolated = (values[-1] - values[0]) / ((sizes[0] / sizes[-1]) ** order - 1)
    return values[-1] + extrapolated, max(abs(extrapolated), scatter)


def bar(value, parts):
    """Error bar of a value. parts: {choice: (limit, doubt)}. Returns value, combined, low, high and the signed error of each choice."""
    errors = {choice: limit - value for choice, (limit, _) in parts.items()}
    combined = value + sum(errors.values())
    margin = MARGIN * math.hypot(*(doubt for _, doubt in parts.values()))
    return {"value": value, "combined": combined, "low": max(0., min(value, combined - margin)), "high": max(value, combined + margin), "parts": errors}


def bars_of_choices(values, choices):
    """Error bars of the values of a scene, {quantity: see bar()}. choices: {name: (values of each level from coarse to fine, sizes, order)}."""
    parts = {name: {} for name in values}
    for choice, (levels, sizes, order) in choices.items():
        found = {name: limit_and_doubt([level.get(name, 0.) for level in levels], sizes, order) for name in values}
        common = median([abs(limit / values[name] - 1.) for name, (limit, _) in found.items()] or [0.])
        for name, (limit, doubt) in found.items():
            parts[name][choice] = limit, max(doubt, common * values[name])
    return {name: {**bar(value, parts[name]), "unit": HEADLINES[name][1]} for name, value in values.items()}


# ---------------------------------------------------------------- the bars of a run

def relevant(entries):
    """The entries of a scene that change its results: {"Section/Entry": value}."""
    return {entry: value for entry, value in entries.items() if not entry.startswith(UNRELATED) or entry in OF_STRESSES}


def beside(directory, scene, command, file):
    """The file of `voussoir COMMAND --output` for the scene of a run: in RUN/COMMAND, or in SCENE-COMMAND beside RUN; else None."""
    directory = Path(directory)
    for place in (directory / command, directory.resolve().parent / f"{scene.replace('/', '-')}-{command}"):
        try:
            if (place / file).is_file():
                return place / file
        except (OSError, ValueError):  # a name that no file can have
            pass
    return None


def scene_name(directory, summary):
    """Name of the scene of a run, without .prm."""
    scene = str(summary.get("scene", Path(directory).name))
    return Path(scene).stem if scene.endswith(".prm") else scene


def accuracy_of_scene(directory, scene, file, read, command="accuracy"):
    """What read() returns of an accuracy.json, or of the file of another command, for the scene of a run in this directory. Throws InputError if the
    file is of another scene, or of another version of the command."""
    again = f"run voussoir {command} {scene}.prm"
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        entries, result = relevant(found["entries"]), read(found)
        mine = relevant({entry: value for entry, (value, _) in read_entries((Path(directory) / "scene.prm").read_text(encoding="utf-8")).items()})
        differs = next((entry for entry in sorted({*entries, *mine}) if entries.get(entry) != mine.get(entry)), None)
    except (ArithmeticError, AttributeError, KeyError, OSError, RecursionError, TypeError, ValueError) as error:
        raise InputError(f"{file} is not of this version of voussoir {command} ({type(error).__name__}): {again}") from error
    if differs:
        raise InputError(f"{file} is of another scene ({differs} = {entries.get(differs)}, here {mine.get(differs)}): {again}")
    return result


def bars_of_run(directory, summary, history):
    """Error bars of the largest values of a run: {quantity: {"value", "combined", "low", "high", "parts", "unit"}} [m, Pa].

    The bars of `voussoir accuracy` are of the strongest seconds; their relative errors apply to the values of the run. A value that is below half
    of the one of the run in these seconds has no bar. Further parts, if they are known: "motion" and "n_motions", half of the interval that contains the
    median over all motions with 68 %; "damping" and "ratios", the smallest and largest change by these damping ratios.
    Throws InputError if there is no accuracy.json of the same scene."""
    def bars_in(found):
        bars = {name: found["error_bars"][name] for name in HEADLINES if name in found["error_bars"]}
        return {name: scaled(bars[name], value) for name, value in headlines(summary, history).items()
                if name in bars and float(bars[name]["value"]) >= SMALLEST_SHARE * value}

    scene = scene_name(directory, summary)
    file = beside(directory, scene, "accuracy", "accuracy.json")
    if file is None:
        raise InputError(f"no error bar: run voussoir accuracy {scene}.prm")
    try:
        bars = accuracy_of_scene(directory, scene, file, bars_in)
    except InputError as error:
        raise InputError(f"no error bar: {error}") from error
    of_motions, (changes, ratios) = summary.get("ensemble", {}), changes_by_damping(directory, scene)
    for name, found in bars.items():
        if isinstance(known := of_motions.get(name, {}).get("known_68"), (int, float)):
            found.update(motion=known * found["value"], n_motions=of_motions["n"])
        if name in changes:
            found.update(damping=[change * found["value"] for change in changes[name]], ratios=ratios)
    return bars


def changes_by_damping(directory, scene):
    """Smallest and largest relative change of each quantity by the damping ratios of `voussoir needs` of the same scene, and these ratios [-]; without
    results of the command {} and []."""
    def read(found):
        rows = [row for row in found["rows"] if list(row["set"]) == [RATIO] and row.get("changes")]
        changes = {name: [float(row["changes"][column]) for row in rows] for name, column in COLUMNS.items()
                   if rows and all(row["changes"][column] is not None for row in rows)}
        return {name: (min(0., *of), max(0., *of)) for name, of in changes.items()}, sorted(float(row["set"][RATIO]) for row in rows)

    file = beside(directory, scene, "needs", "needs.json")
    try:
        return accuracy_of_scene(directory, scene, file, read, "needs") if file else ({}, [])
    except InputError:
        return {}, []


def scaled(bar_of_window, value):
    """The bar with the same relative errors about another value."""
    factor = value / bar_of_window["value"]
    numbers = {key: factor * float(bar_of_window[key]) for key in ("combined", "low", "high")}
    if not all(math.isfinite(x) for x in numbers.values()):
        raise ValueError("a number is not finite")
    return {"value": value, **numbers, "parts": {choice: factor * error for choice, error in bar_of_window["parts"].items()}, "unit": bar_of_window["unit"]}


def bar_text(name, found):
    """Error bar of a quantity, such as "largest opening 57.1 mm, -0.4 to +1.6 mm"; with its other parts, "largest opening 57.1 mm, mesh and step -0.4 to
    +1.6 mm, motion -4.3 to +4.3 mm (68 %, 8 motions), damping ratio 3 to 10 % -22 to +14 mm"."""
    scale, unit = UNITS[found["unit"]]

    def interval(low, high):
        return f"{signed(scale * low)} to {signed(scale * high)} {unit}"

    parts = [interval(*(found[end] - found["value"] for end in ("low", "high")))]
    if "motion" in found:
        parts.append(f"motion {interval(-found['motion'], found['motion'])} (68 %, {found['n_motions']:.0f} motions)")
    if "damping" in found:
        ratios = dict.fromkeys(f"{100 * found['ratios'][k]:g}" for k in (0, -1))
        parts.append(f"damping ratio {' to '.join(ratios)} % {interval(*found['damping'])}")
    return f"{HEADLINES[name][0]} {scale * found['value']:.4g} {unit}, {'mesh and step ' if parts[1:] else ''}{', '.join(parts)}"


def signed(x):
    """A number with its sign and two digits, without an exponent."""
    return f"{x:+.{max(0, min(4, 1 - math.floor(math.log10(abs(x)))))}f}" if abs(x) >= 1e-4 else "0"
