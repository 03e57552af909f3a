# SPDX-License-Identifier: GPL-3.0-or-later
"""Study files: which scenes, with which values of which entries. `voussoir study` runs them; doc/studies.md explains them."""

import csv
import itertools
import re
from dataclasses import dataclass, field, replace
from pathlib import Path

from .errors import InputError
from .program import declarations

UNITS = {"m": {"": 1., "m": 1., "cm": 1e-2, "mm": 1e-3}, "Pa": {"": 1., "Pa": 1., "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
         "-": {"": 1., "%": 1e-2}}
LIMITS = {"Opening": "m", "Slip": "m", "Tension": "Pa", "Damage": "-"}
ENTRIES = {"Scene", "Table", "Combine", "Threads", "Figures/Over", "Figures/Records", "Limits/Strength",
           *(f"Limits/{name}" for name in LIMITS)}
MOST_SCENES = 10000


@dataclass
class Value:
    """An entry of a scene in a study, and where it is written."""
    entry: str
    text: str
    place: str


@dataclass
class Study:
    """Content of a study file. A scene is a base scene and a tuple of Values."""
    file: Path
    scenes: list = field(default_factory=list)  # (base scene, settings, factors)
    factors: list = field(default_factory=list)  # entries that vary, in the file's order; "Scene" if there are several
    over: str = ""
    records: str = ""
    threads: int = 0
    limits: dict = field(default_factory=dict)  # name -> list of numbers [m, Pa, -]
    strength: float = 3e6  # [Pa]


def edit_distance(a, b):
    """Levenshtein distance of two words."""
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        before, row[0] = row[0], i
        for j, y in enumerate(b, 1):
            before, row[j] = row[j], min(row[j] + 1, row[j - 1] + 1, before + (x != y))
    return row[-1]


def nearest(name, names):
    """The name that is meant, perhaps: the same entry of another section counts as near."""
    name = name.lower()
    return min(sorted(names), key=lambda other: min(edit_distance(name, other.lower()),
                                                    edit_distance(name.split("/")[-1], other.lower().split("/")[-1]) + 2))


def read_prm(path):
    """(entry, value, place) for each line "set" of a .prm file; subsections are joined by slashes."""
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"The study {path} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}.") from None
    sections, entries, number = [], [], 0
    while number < len(lines):
        place, line = f"{path}, line {number + 1}", lines[number].strip()
        number += 1
        while line.endswith("\\") and number < len(lines):
            line, number = line[:-1] + lines[number].strip(), number + 1
        line = line.split("#", 1)[0].strip()
        word, _, rest = line.partition(" ")
        if word == "subsection" and rest.strip():
            sections.append(rest.strip())
        elif line == "end":
            if not sections:
                raise InputError(f'{place}: "end" without a "subsection" before it. Remove it.')
            sections.pop()
        elif word == "set" and "=" in rest:
            name, value = (part.strip() for part in rest.split("=", 1))
            entries.append(("/".join([*sections, name]), value, place))
        elif line:
            raise InputError(f'{place}: "{line}" is none of: subsection NAME, end, set ENTRY = VALUE, # comment.')
    if sections:
        raise InputError(f'{path}: subsection "{sections[-1]}" is not closed. Add an "end".')
    return entries


def check_entry(entry, place, known):
    """Throws InputError, with the nearest entry, if scenes have none of this name."""
    if entry not in known:
        raise InputError(f'{place}: scenes have no entry "{entry}". Did you mean "{nearest(entry, known)}"? '
                         "`voussoir parameters` prints all entries.")


def value_in(entry, text):
    """Meaning of a text: 0.5 and 0.50 are the same value, files 1 and 01 are different."""
    first, *rest = text.split() or [""]
    try:
        return text if is_file_entry(entry) or entry == "Scene" else (float(first), *rest)
    except ValueError:
        return text


def values_of(text, place, entry=""):
    """The list "a | b | c", or the whole numbers "a ... b", of an entry."""
    low, dots, high = (part.strip() for part in text.partition("..."))
    if dots and "|" not in text:
        try:
            low, high = int(low), int(high)
        except ValueError:
            raise InputError(f'{place}: "{text}" is no range of whole numbers such as 1 ... 10.') from None
        if not 0 <= high - low < MOST_SCENES:
            raise InputError(f'{place}: "{text}" has {max(0, high - low + 1)} values. Give 1 to {MOST_SCENES}.')
        return [str(number) for number in range(low, high + 1)]
    values = [value.strip() for value in text.split("|")]
    for i, value in enumerate(values):
        if value == "" and len(values) > 1:
            raise InputError(f'{place}: a value is missing in "{text}". Values stand between bars: a | b | c.')
        same = [other for other in values[:i] if value_in(entry, other) == value_in(entry, value)]
        if same:
            how = "" if same[0] == value else f' (as "{same[0]}")'
            raise InputError(f'{place}: the value "{value}" is there twice{how}. Leave one.')
    return values


def number_with_unit(text, unit, place):
    """Value of a text [m], [Pa] or as a share."""
    digits = text.rstrip("%abcdfghijklmnopqrstuvwxyzGMP ").strip()
    factor = UNITS[unit].get(text[len(digits):].strip())
    try:
        number = float(digits)
    except ValueError:
        factor = None
    if factor is None or not 0 < number * factor < 1e300:
        allowed = ", ".join(name for name in UNITS[unit] if name)
        raise InputError(f'{place}: "{text}" must be a positive number, with or without a unit ({allowed}).')
    return number * factor


def read_table(path, place, known):
    """The rows of a CSV file as tuples of Values: the first line names the entries, "Scene" among them perhaps."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [(number, [cell.strip() for cell in row]) for number, row in enumerate(csv.reader(file), 1)
                     if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{place}: the table {path} cannot be read ({getattr(error, 'strerror', None) or error}). "
                         "Paths are relative to the study.") from None
    if len(lines) < 2:
        raise InputError(f"{path} has no rows. Its first line names entries, each other line is a scene.")
    number, names = lines[0]
    for name in names:
        if name != "Scene":
            check_entry(name, f"{path}, line {number}", known)
        if names.count(name) > 1:
            raise InputError(f'{path}, line {number}: the column "{name}" is there twice. Leave one.')
    for number, cells in lines[1:]:
        if len(cells) != len(names):
            raise InputError(f"{path}, line {number}: {len(cells)} values for {len(names)} columns.")
    return [tuple(Value(name, cell, f"{path}, line {number}") for name, cell in zip(names, cells))
            for number, cells in lines[1:]]


def combined(axes, how):
    """Choices of one value from each axis: all combinations, or the first of each and then one by one the others."""
    if how == "all":
        return list(itertools.product(*axes))
    first = [axis[0] for axis in axes]
    return [tuple(first)] + [tuple(first[:i] + [value] + first[i + 1:])
                             for i, axis in enumerate(axes) for value in axis[1:]]


def study_of_itself(study, entries):
    """Reads what is not about scenes; the rest stays."""
    rest, own = [], {}
    for entry, text, place in entries:
        if entry.split("/")[0] in ("Factors", "Settings") and "/" in entry:
            rest.append((entry, text, place))
        elif entry not in ENTRIES:
            raise InputError(f'{place}: studies have no entry "{entry}". Did you mean "'
                             f'{nearest(entry, [*ENTRIES, "Factors/...", "Settings/..."])}"? '
                             "Entries of scenes stand in subsection Factors or Settings.")
        elif entry in own:
            raise InputError(f'{place}: the entry "{entry}" is there twice. Leave one.')
        else:
            own[entry] = (text, place)
    for name, unit in LIMITS.items():
        if f"Limits/{name}" in own:
            text, place = own[f"Limits/{name}"]
            study.limits[name] = [number_with_unit(value, unit, place) for value in values_of(text, place)]
    if "Limits/Strength" in own:
        study.strength = number_with_unit(own["Limits/Strength"][0], "Pa", own["Limits/Strength"][1])
    text, place = own.get("Threads", ("0", ""))
    if not text.isdecimal() or int(text) > 1024:
        raise InputError(f'{place}: "Threads" must be a whole number from 0 to 1024, not "{text}".')
    study.threads = int(text)
    if own.get("Combine", ("all", ""))[0] not in ("all", "one by one"):
        raise InputError(f'{own["Combine"][1]}: "Combine" must be "all" or "one by one", not "{own["Combine"][0]}".')
    return own, rest


def base_scenes(study, own):
    """The values of "Scene" as an axis: paths relative to the study; or None."""
    text, place = own.get("Scene", ("", ""))
    return [(Value("Scene", value, place),) for value in values_of(text, place, "Scene")] if text else None


def path_of(value, study):
    """The file that an entry of the study names, relative to it."""
    path = (study.file.parent / value.text).resolve()
    if not path.is_file():
        raise InputError(f'{value.place}: the file {value.text} of "{value.entry}" is not there. Paths are relative to the study.')
    return path


# Settings of a motion in a file with unit, scale and corrections of a scene.
AS_IT_IS = {"Motion/Source": "file", "Motion/File x": "", "Motion/File y": "", "Motion/File z": "", "Motion/File step": 0, "Motion/Azimuths": "",
            "Motion/Unit": "m/s^2", "Motion/Duration": -1, "Motion/Factor": 1, "Motion/Scale x": 1, "Motion/Scale y": 1, "Motion/Scale z": 1,
            "Motion/Sequence": "", "Motion/Ensemble": "", "Motion/Ensemble factors": "", "Motion/Ensemble output": "",
            "Motion/Rest": 0, "Motion/Target spectrum": "", "Motion/Baseline": "none", "Motion/Match": "false",
            "Motion/Match band": ""}


def is_file_entry(entry):
    """Mesh/File, Motion/File, Motion/File x..., the target spectrum, the tables of arcs, temperatures and added masses, and the rock wedges."""
    return entry.split("/")[-1] in ("File", "File x", "File y", "File z") or entry in (
        "Mesh/Arcs/Table", "Motion/Target spectrum", "Loads/Temperature/Table", "Reservoir/Table", "Limits/Wedges")


def with_paths(entry, text, directory):
    """The value of an entry with absolute paths of its files, and these paths. In Motion/Sequence and
    Ensemble, numbers and ranges are seeds; in Motion/Abutments, a bank and a height precede the files; in Loads/Force history each third part is a file."""
    if is_file_entry(entry) and text:
        file, colon, choice = text.rpartition(":") if entry == "Motion/Target spectrum" and not (directory / text).exists() else ("", "", "")
        path = str((directory / (file or text)).resolve())
        return path + colon + choice, [path]
    if entry == "Loads/Force history":
        parts = [part.strip() for part in text.split(";")]
        parts[2::3] = [str((directory / part).resolve()) for part in parts[2::3]]
        return "; ".join(parts), parts[2::3]
    if entry not in ("Motion/Sequence", "Motion/Ensemble", "Motion/Abutments"):
        return text, []
    words = [word.strip() for word in re.split("([;,]|(?:right|left) [^:;]*:)" if entry == "Motion/Abutments" else "([;,])", text)]
    seed = re.compile(r"\d+(\s*-\s*\d+)?")
    paths = {word: str((directory / word).resolve()) for word in words
             if word not in ("", ";", ",", "-") and not seed.fullmatch(word) and word[-1] != ":"}
    return " ".join(paths.get(word, word) for word in words), list(paths.values())


def read_study(path, overrides=()):
    """The study in a file, every scene of it spelled out. `overrides`: "Section/Entry=value" of the command line."""
    study, known = Study(Path(path).resolve()), set(declarations())
    entries = read_prm(path)
    for text in overrides:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals:
            raise InputError(f'--set "{text}": give an entry of the study and its value, such as \'Factors/Motion/Seed=1 | 2\'.')
        entries = [entry for entry in entries if entry[0] != name] + [(name, value, "--set")]
    own, rest = study_of_itself(study, entries)
    settings, axes, names = {}, [], []
    scenes = base_scenes(study, own)
    if scenes:
        axes, names = [scenes], ["Scene"]
    if "Table" in own:
        rows = read_table(study.file.parent / own["Table"][0], own["Table"][1], known)
        axes, names = axes + [rows], names + [value.entry for value in rows[0]]
    for entry, text, place in rest:
        kind, name = entry.split("/", 1)
        check_entry(name, place, known)
        if name in settings or name in names:
            raise InputError(f'{place}: the entry "{name}" has values at two places of the study. Leave one.')
        if kind == "Settings":
            settings[name] = Value(name, text, place)
        else:
            axes.append([(Value(name, value, place),) for value in values_of(text, place, name)])
            names.append(name)
    if "Scene" not in names:
        raise InputError(f'{path}: which scene? Add "set Scene = FILE.prm", relative to the study.')
    if names.count("Scene") > 1:
        raise InputError(f'{path}: "Scene" has values in the file and in its table. Leave one.')
    count = 1
    for axis in axes:
        count *= len(axis)
    how = own.get("Combine", ("all", ""))[0]
    if how == "all" and count > MOST_SCENES:
        raise InputError(f"{path}: these are {count} scenes, more than {MOST_SCENES}. Give fewer values, or \"set Combine = one by one\".")
    spell_out(study, combined(axes, how), settings)
    choose_axes(study, own)
    return study


def spell_out(study, choices, settings):
    """The scenes of the study, and which entries vary."""
    for choice in choices:
        values = {value.entry: value for part in choice for value in part}
        base = path_of(values["Scene"], study)
        for value in [*settings.values(), *values.values()]:
            for file in with_paths(value.entry, value.text, study.file.parent)[1]:
                path_of(replace(value, text=file), study)
        study.scenes.append((base, settings, values))
    study.factors = [entry for entry in study.scenes[0][2]
                     if len({values[entry].text for _, _, values in study.scenes}) > 1]


def choose_axes(study, own):
    """Abscissa of the figures, and entries that identify a record: from the file, or from the names of the axes."""
    for name, attribute, usual in (("Over", "over", ("Motion/Factor", "Motion/Peak acceleration")),
                                   ("Records", "records", ("Motion/Seed", "Motion/File", "Motion/File x"))):
        text, place = own.get(f"Figures/{name}", ("", ""))
        if text and text not in study.factors:
            one_of = ", ".join(study.factors) or "none does"
            raise InputError(f'{place}: "Figures/{name}" must be an entry that varies in this study ({one_of}), not "{text}".')
        setattr(study, attribute, text or next((entry for entry in usual if entry in study.factors), ""))
    for _, _, values in study.scenes if study.over else ():
        try:
            float(values[study.over].text.split(" ")[0])
        except ValueError:
            raise InputError(f'{values[study.over].place}: "{study.over}" has to be a number to draw figures over it, '
                             f'not "{values[study.over].text}".') from None
