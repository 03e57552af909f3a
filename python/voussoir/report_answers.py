# SPDX-License-Identifier: GPL-3.0-or-later
"""The first page of a report in words: how far the joints open, whether they close again, stresses, limits, validity, of one run or of
several in one table. And what other commands computed for the same scene: natural modes and the error of mesh and time step."""

import re
from html import escape

import numpy as np

from . import error_bars, tables
from .ensembles import SCATTER
from .errors import InputError
from .picture import read_solution
from .report_scene import entry, left_out
from .report_tables import MINUS, bar_words, exceedances, html_table, items, limits_of, number, verdict, with_unit
from .runs import NotComputed, Skip, refuse_links

# Dynamic tensile strength of dam concrete if the scene gives none [Pa]: a tenth of the dynamic compressive strength (DL 5073-2000), which
# is 1.3 times the static one; 23 MPa give 3 MPa.
USUAL_STRENGTH = 3e6
CLOSED = 0.01  # of its largest opening: a joint below is closed


def strength_of(run):
    """Dynamic tensile strength [Pa], and where it is from."""
    for name in ("Output/Tensile strength", "Limits/Tensile strength"):
        if (value := run.value(name)) > 0.:
            return value, name
    return USUAL_STRENGTH, ""


def place_and_time(item):
    """Text of the place and the time of an extreme, or nothing."""
    place, time = item.where()
    words = [place, f"at {time} s" if time and item.time > 0. else ""]
    return f" ({', '.join(filter(None, words))})" if any(words) else ""


def value_of(item):
    return f"{number(item.magnitude, item.unit)} {item.unit}"


def opening(found):
    if "max_opening" not in found:
        return "There are no joints that can open."
    item = found["max_opening"]
    error = f", error bar {bar_words(item)} {item.unit}" if item.bar else ""
    text = f"By at most <b>{value_of(item)}</b>{place_and_time(item)}{error}."
    if "max_slip" in found:
        text += f" Their faces slip by at most {value_of(found['max_slip'])}{place_and_time(found['max_slip'])}."
    return text


def least_afterwards(run):
    """Joint that opens by more than 0.1 mm at the crest -> least opening after the largest one [m], of both faces the wider; 0 if closed."""
    table, found = run.joint_history, {}
    for name, column in table.items():
        if (match := re.fullmatch(r"opening_(?:upstream|downstream)_(\d+)", name)) and column.max() > 1e-4:
            least = float(column[column.argmax():].min())
            joint = int(match[1])
            if run.joint_name(joint).startswith("lift"):
                continue  # a lift joint has no crest
            found[joint] = max(found.get(joint, 0.), least if least > CLOSED * column.max() else 0.)
    return found


def closing(run, found):
    """Whether the joints close again after their largest opening."""
    if not run.moves:
        return "The run is of the static state alone."
    try:
        opened, end = least_afterwards(run), run.joint_history["time"][-1]
    except Skip as reason:
        return f"Unknown: {escape(str(reason))}."
    open_ = {joint: least for joint, least in opened.items() if least > 0.}
    if not opened:
        text = "No joint opens by more than 0.1 mm at the crest."
    elif not open_:
        which = f"each of the {len(opened)} joints that open" if len(opened) > 1 else "the joint that opens"
        text = f"<b>Yes.</b> At the crest {which} closes again."
    else:
        listed = ", ".join(f"{escape(run.joint_name(joint))} ({number(open_[joint], 'mm')} mm)" for joint in sorted(open_, key=lambda joint: -open_[joint])[:6])
        one = len(open_) == 1
        text = (f"<b>Not all.</b> Of {len(opened)} joints that open at the crest, {len(open_)} {'stays' if one else 'stay'} open from "
                f"{'its' if one else 'their'} largest opening to the end of the run at {end:.2f} s, at least by: {listed}.")
    if "residual_opening" in found:
        text += f" At the end of the run, when the dam may still move, the largest opening is {value_of(found['residual_opening'])}."
    return text


def tensions(found):
    """The largest tension of each face away from the base, or with the base in runs of earlier versions: {face: Item}."""
    keys = {face: [key for key in (f"max_tension_{face}_away_from_base", f"max_tension_{face}") if key in found][:1] for face in ("upstream", "downstream")}
    return {face: found[names[0]] for face, names in keys.items() if names and found[names[0]].value == found[names[0]].value}


def stresses(run, found):
    largest = tensions(found)
    if not largest:
        return "They were not recorded (Output/Envelope interval)."
    away = any(key.endswith("_away_from_base") for key in found)
    text = "Tension at most " + ", ".join(f"<b>{value_of(item)}</b> {face}{place_and_time(item).replace(f', {face}', '')}" for face, item in largest.items())
    for key in ("max_compression_away_from_base", "max_compression"):
        if key in found:
            text += f"; compression at most {value_of(found[key])}"
            break
    text += ", away from the base. " if away else ". "
    strength, entry = strength_of(run)
    worst = max(item.value for item in largest.values())
    source = f"the tensile strength of the scene ({entry})" if entry else "a usual dynamic tensile strength"
    if worst <= strength:
        return text + f"The tension is below {source}, {with_unit(strength, 'MPa')}."
    return text + (f'<b class="exceeded">The concrete would crack:</b> the tension is {worst / strength:.2g} times {source}, {with_unit(strength, "MPa")}'
                   f"{'' if entry else ' (DL 5073-2000)'}.")


def cracks(run, found):
    """True if the tension exceeds the strength."""
    return max((item.value for item in tensions(found).values()), default=0.) > strength_of(run)[0]


def beginning(text, most=100):
    """First sentence of a warning; of a long one the part before its colon, or the first words."""
    first = text.partition(". ")[0].rstrip(".")
    if len(first) <= most:
        return first
    head = first[:most]
    return head[:colon] if (colon := head.rfind(": ")) > 20 else head.rpartition(" ")[0] + " …"


def failed_checks(run):
    """Numerical checks and warnings about the physics: those that are not satisfied, and those that are."""
    bad, good, summary = [], [], run.summary
    for key, limit, name in (("energy_balance_error", 1e-4, "energy balance"),
                             ("contact_residual", max(1e-10, run.value("Contact/Tolerance")), "contact residual")):
        if isinstance(value := summary.get(key), (int, float)):
            if value <= limit:
                good.append(name)
            else:
                bad.append(f"{name} {number(value, '')} (limit {number(limit, '')})")
    warnings = [escape(beginning(str(warning["text"]))) for warning in run.warnings if warning["class"] != "input"]
    if warnings:
        bad.append(f"warnings of the program: {len(warnings)} ({'; '.join(warnings)})")
    return bad, good


def validity(run, found):
    """Which numerical checks are satisfied, and whether the concrete stays elastic."""
    bad, good = failed_checks(run)
    others = sum(warning["class"] == "input" for warning in run.warnings)
    remarks = f"; remarks on the input file: {others}" if others else ""
    text = (f'<b class="exceeded">Not all checks are satisfied:</b> {"; ".join(bad)}{remarks}. ' if bad else
            f"The computation passes its checks{' (' + ', '.join(good) + ')' if good else ''}{remarks}. ")
    try:
        text += accuracy_sentence(run)
    except NotComputed:
        text += "The error of mesh and time step is not estimated (<code>voussoir accuracy</code>). "
    except Skip as reason:
        text += f"The error of mesh and time step is unknown: {escape(str(reason))}. "
    if cracks(run, found):
        text += ('<b class="exceeded">The linear monoliths are beyond their validity</b> where the tension exceeds the strength: the model does not '
                 "redistribute stresses after cracking, so openings, slips and stresses after the first crack are indications only.")
    else:
        text += "The monoliths are linear elastic, and the tension stays below the strength."
    return text


def scatter(run):
    """How much motions of one spectrum differ, and how to run sixteen: of a run with one motion."""
    if not run.moves or run.ensemble:
        return ""
    how = ("<code class=entry>set Ensemble = 1-16</code> in subsection Motion runs sixteen" if entry(run, "Motion/Source") == "artificial" else
           "<code class=entry>set Ensemble</code> in subsection Motion runs several records")
    openings = "" if run.tied else f"openings by about ±{SCATTER['openings']} %, "
    return (f"This is the answer for one motion; motions of one spectrum differ ({openings}tensions by about ±{SCATTER['tensions']} %): {how}.")


def asked(run, found):
    """Questions and answers, as HTML."""
    return [("How far do the joints open?", " ".join(filter(None, (opening(found), "max_opening" in found and scatter(run))))),
            *([("Do they close again?", closing(run, found))] if "max_opening" in found else []),
            ("How large are the stresses?", " ".join(filter(None, (stresses(run, found), "max_opening" not in found and scatter(run))))),
            ("Which limits are exceeded?", escape(verdict(run)[1])),
            ("Are the results valid?", validity(run, found))]


def answers(run, questions=None):
    """A list of questions and answers, as HTML."""
    questions = [*(questions or asked(run, items(run))), ("What is left out?", escape(left_out(run)))]
    return '<dl class="answers">' + "".join(f"<dt>{question}</dt><dd>{text}</dd>" for question, text in questions) + "</dl>"


# ---------------------------------------------------------------- several runs

def with_spread(item):
    """Value of an item, with its band over motions or its error bar."""
    text = number(item.magnitude, item.unit)
    if item.band:
        return f'{text} <span class="unit band">({" to ".join(number(end, item.unit) for end in sorted(map(abs, item.band)))})</span>'
    return f'{text} <span class="unit band">{bar_words(item)}</span>' if item.bar else text


def closing_words(run, found):
    """Whether the joints close again, in a word."""
    if run.ensemble or "max_opening" not in found or not run.moves:
        return ""
    try:
        opened = least_afterwards(run)
    except Skip:
        return ""
    stay = sum(least > 0. for least in opened.values())
    return (f"{stay} of {len(opened)} stay open", "undecided") if stay else "yes" if opened else "none opens"


def limit_words(run):
    """How many limits are exceeded or undecided, and the state."""
    if run.ensemble and (rows := exceedances(run)):
        worst = max(rows, key=lambda row: row[2])
        return (f"exceeded in {worst[2]} of {worst[3]} motions", "exceeded") if worst[2] else ("satisfied", "satisfied")
    state, _ = verdict(run)
    if not limits_of(run):
        return "none given"
    return (state, state) if state else "not all evaluated"


def compared(runs):
    """One table over several runs: a row for each, a column for each answer."""
    heads = [("run", ""), ("opening [mm]", "n"), ("slip [mm]", "n"), ("joints close again?", ""), ("tension upstream [MPa]", "n"),
             ("tension downstream [MPa]", "n"), ("over the strength", "n"), ("limits", ""), ("checks", "")]
    rows = []
    for run in runs:
        found = items(run)
        cells = [escape(run.name)]
        cells += [(with_spread(found[key]), found[key].state) if key in found else "–" for key in ("max_opening", "max_slip")]
        cells.append(closing_words(run, found) or "–")
        faces = tensions(found)
        cells += [(with_spread(faces[face]), faces[face].state) if face in faces else "–" for face in ("upstream", "downstream")]
        ratio = max((item.value for item in faces.values()), default=0.) / strength_of(run)[0]
        cells.append((f"{ratio:.2g} ×", "exceeded" if ratio > 1. else "") if faces else "–")
        bad, _ = failed_checks(run)
        inputs = sum(warning["class"] == "input" for warning in run.warnings)
        cells += [limit_words(run), ("see the warnings", "exceeded") if bad else f"{inputs} remark{'s' if inputs > 1 else ''}" if inputs else "satisfied"]
        rows.append(("", cells))
    return html_table(heads, rows)


def notes(runs):
    """What the table over several runs cannot hold: strength, limits, validity, scatter, and what is left out, as HTML paragraphs."""
    sentences = []
    strengths = dict.fromkeys((with_unit(strength_of(run)[0], "MPa"), strength_of(run)[1]) for run in runs)
    which = "; ".join(f"{value} ({name or 'a usual dynamic tensile strength, DL 5073-2000'})" for value, name in strengths)
    cracking = [escape(run.name) for run in runs if cracks(run, items(run))]
    text = f"Tensions are away from the base; the strength is {escape(which)}."
    if cracking:
        all_of = "all runs" if len(cracking) == len(runs) else ", ".join(cracking)
        text += (f' <b class="exceeded">The concrete would crack</b> in {all_of}: the linear monoliths are beyond their validity there, so results after the '
                 "first crack are indications only.")
    sentences.append(text)
    sentences += [f"<b>{escape(run.name)}.</b> {escape(verdict(run)[1])}" for run in runs if limits_of(run) and verdict(run)[0] != "satisfied"]
    if any(item.band for run in runs for item in items(run).values()):
        sentences.append("Of many motions the table has the median, and in brackets 16 to 84 %.")
    else:
        sentences += [text.replace("This is the answer for one motion; motions", "Motions") for text in map(scatter, runs) if text][:1]
    of_runs = {}
    for run in runs:
        of_runs.setdefault(left_out(run), []).append(run.name)
    sentences += [(f"<b>{escape(', '.join(names))}.</b> " if len(of_runs) > 1 else "") + escape(text) for text, names in of_runs.items()]
    return "".join(f"<p>{text}</p>" for text in sentences)


# ---------------------------------------------------------------- other commands

def beside(run, command, file):
    """The file of `voussoir COMMAND --output` for the same scene: in RUN/COMMAND, or in SCENE-COMMAND beside RUN. Throws NotComputed."""
    if (found := error_bars.beside(run.directory, run.scene, command, file)) is not None:
        try:
            refuse_links(found.parent)
        except InputError as error:
            raise Skip(error) from error
        return found
    raise NotComputed(f"voussoir {command} {run.scene}.prm --output {run.directory.name}/{command}")


def accuracy_of(run):
    """accuracy.json of the run's scene: errors of openings and tension [-], and the target. Throws Skip."""
    file = beside(run, "accuracy", "accuracy.json")
    try:
        return error_bars.accuracy_of_scene(run.directory, run.scene, file, lambda found: (
            float(found["error"]["openings"]), float(found["error"]["tension"]), float(found["wish"])))
    except InputError as error:
        raise Skip(error) from error


def accuracy_sentence(run):
    openings, tension, target = accuracy_of(run)
    state = "within" if max(openings, tension) <= target else "above"
    return (f"<code>voussoir accuracy</code> of the scene estimates an error of mesh and time step of {number(openings, '%', 2)} % for the openings and "
            f"{number(tension, '%', 2)} % for the tensile stress, {state} its target of {number(target, '%', 2)} %. ")


def modes_of(run):
    """modes.csv, and its directory. Throws Skip."""
    file = beside(run, "modes", "modes.csv")
    try:
        table = tables.read_table(file)
        if not len(table["mode"]) or not all(np.isfinite(table[name]).all() for name in ("mode", "frequency", "share_x", "share_y", "share_z")):
            raise ValueError("a value is not finite")
    except (InputError, KeyError, TypeError, ValueError) as error:
        raise Skip(f"{file} is not of voussoir modes ({error})") from error
    return table, file.parent


def modes(run):
    """Table of frequencies and effective masses."""
    table, _ = modes_of(run)
    rows = [("", [f"mode {table['mode'][k]:.0f}", f"{table['frequency'][k]:.3g}", *(f"{100. * table[f'share_{d}'][k]:.0f}" for d in "xyz")])
            for k in range(len(table["mode"]))]
    return html_table([("", ""), ("frequency [Hz]", "n"), *((f"effective mass {way} [%]", "n") for way in ("downstream", "across", "vertical"))], rows)


def mesh_quality(run):
    """Rows about the elements: numbers, edges [m], smallest scaled Jacobian (1: right angles, 0: flat), as `voussoir mesh` computes them."""
    mesh, file = run.summary.get("mesh", {}), run.directory / "envelope.vtu"
    if not file.exists():
        raise Skip("no envelope.vtu: Output/Envelope interval is 0")
    try:
        data = read_solution(file)
    except InputError as error:
        raise Skip(error) from error
    if len(data["connectivity"]) != mesh.get("cells"):
        raise Skip("envelope.vtu has other cells than the mesh (Elements/Degree = 2)")
    shortest, longest, jacobian = quality(data["Points"].astype(float)[data["connectivity"]])
    return [("elements of the dam; nodes; monoliths", f"{mesh['cells']}; {mesh['nodes']}; {mesh['monoliths']}"),
            ("edges, shortest and longest", f"{shortest:.3g} m, {longest:.3g} m"),
            ("smallest scaled Jacobian (1: right angles, 0: flat element)", f"{jacobian:.3f}".replace("-", MINUS))]


def quality(corners):
    """Shortest and longest edge [m] and smallest scaled Jacobian [-] of hexahedra of VTK, (cell, 8, 3)."""
    neighbours = np.array([[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]])
    edges = corners[:, neighbours] - corners[:, :, None]  # cell, corner, edge, coordinate
    lengths = np.linalg.norm(edges, axis=3)
    volumes = np.einsum("kvi,kvi->kv", np.cross(edges[:, :, 0], edges[:, :, 1]), edges[:, :, 2])
    return lengths.min(), lengths.max(), (volumes / lengths.prod(axis=2)).min()
