# SPDX-License-Identifier: GPL-3.0-or-later
"""Many motions in a report: the answers of the first page as median and band, the table of the extremes, and that of the motions."""

from html import escape

from .ensembles import is_number, percent
from .report_answers import beginning, failed_checks, strength_of, validity
from .report_tables import AWAY, EXTREMES, exceedances, html_table, items, number, with_unit


def band(found, unit):
    """Median of an extreme, and in brackets 16 to 84 % of the motions."""
    ends = ends_of(found, ("p16", "p84"), unit)
    return f"{number(abs(found['median']), unit)} {unit} " + (f"({' to '.join(ends)})" if len(set(ends)) > 1 else "")


def opening(run):
    """How far the joints open, in the median."""
    found = run.ensemble.extremes
    if "max_opening" not in found or run.tied:
        return "There are no joints that can open."
    one = found["max_opening"]
    text = f"{f'With the factor {run.ensemble.factor:g}, by' if len(run.ensemble.factors) > 1 else 'By'} <b>{number(one['median'], 'mm')} mm</b>"
    if run.ensemble.n > 1:
        text += (f" in the median, {' to '.join(ends_of(one, ('p16', 'p84'), 'mm'))} mm from 16 to 84 % of the motions, "
                 f"{' to '.join(ends_of(one, ('min', 'max'), 'mm'))} mm in all")
    if (joints := run.ensemble.joints) is not None:
        worst = int(joints["opening_median"].argmax())
        text += f"; {escape(run.joint_name(int(joints['joint'][worst])))} opens most"
    text += f". {escape(run.ensemble.known())}"
    return text + (f" Slip: {band(found['max_slip'], 'mm').rstrip()}." if "max_slip" in found else "")


def closing(run):
    """In how many motions all joints close again."""
    kept, found = run.ensemble.values("kept_opening"), run.ensemble.extremes.get("kept_opening")
    if not len(kept) or found is None:
        return "Unknown."
    n_open = sum(value > 0. for value in kept)
    if not n_open:
        return "<b>Yes.</b> At the crest each joint that opens closes again" + (" in all motions." if len(kept) > 1 else ".")
    return (f"<b>Not all.</b> In {n_open} of {len(kept)} motions a joint stays open at the crest from its largest opening to the end of the run, "
            f"at least by {number(max(kept), 'mm')} mm in the worst motion.")


def tensions(run):
    """{face: key of the tension away from the base}."""
    found = run.ensemble.extremes
    return {face: key for face in ("upstream", "downstream") if (key := f"max_tension_{face}_{AWAY}") in found}


def largest_tensions(run):
    """The larger tension of the two faces [Pa], motion by motion."""
    columns = [column for key in tensions(run).values() if len(column := run.ensemble.values(key))]
    if not columns or len({len(column) for column in columns}) > 1:
        return []
    return [max(values) for values in zip(*columns)]


def stresses(run):
    """Tension and compression away from the base, and in how many motions the concrete would crack."""
    faces, found = tensions(run), run.ensemble.extremes
    if not faces:
        return "They were not recorded (Output/Envelope interval)."
    text = ("Tension in the median, and 16 to 84 % of the motions: " if run.ensemble.n > 1 else "Tension at most ") + ", ".join(
        f"<b>{band(found[key], 'MPa').replace(' MPa ', f' MPa</b> {face} ', 1)}".rstrip() for face, key in faces.items())
    if (key := f"max_compression_{AWAY}") in found:
        text += f"; compression {band(found[key], 'MPa').rstrip()}"
    strength, entry = strength_of(run)
    values = largest_tensions(run)
    over = sum(value > strength for value in values)
    source = f"the tensile strength of the scene ({entry})" if entry else "a usual dynamic tensile strength (DL 5073-2000)"
    limit = with_unit(strength, "MPa")
    if values and not over:
        return f"{text}, away from the base. In no motion is the tension above {source}, {limit}."
    return (f'{text}, away from the base. <b class="exceeded">The concrete would crack</b> in {over} of {len(values)} motions: the tension is above '
            f"{source}, {limit}." if over else f"{text}, away from the base.")


def limits(run):
    rows = exceedances(run)
    if not rows:
        return "The scene gives no limits (section Limits) for results of many motions, so nothing is evaluated here."
    named = lambda name, limit: f"{name} ({limit})" if limit else name
    over = [f"{named(name, limit)} in {count} of {n} motions" for name, limit, count, n in rows if count]
    kept = [named(name, limit) for name, limit, count, _ in rows if not count]
    text = f"Exceeded: {'; '.join(over)}." if over else ""
    return escape(" ".join(filter(None, (text, f"Satisfied in all motions: {'; '.join(kept)}." if kept else ""))))


def valid(run):
    """Checks and warnings, and motions without results."""
    failed = run.ensemble.failed
    text = ""
    if failed:
        text = (f'<b class="exceeded">{len(failed)} of {len(run.ensemble.motions["motion"])} analyses have no result:</b> '
                f"{escape('; '.join(f'{name} ({beginning(status)})' for name, status in failed[:8]))}. ")
    return text + validity(run, items(run))


def asked(run):
    """Questions and answers of many motions, as HTML."""
    return [("How far do the joints open?", opening(run)), *([] if run.tied else [("Do they close again?", closing(run))]),
            ("How large are the stresses?", stresses(run)), ("Which limits are exceeded?", limits(run)), ("Are the results valid?", valid(run))]


def state(run):
    """Colour of the answers: exceeded if a limit is exceeded in a motion or a check is not satisfied."""
    rows = exceedances(run)
    return "exceeded" if any(count for *_, count, _ in rows) or run.ensemble.failed or failed_checks(run)[0] else "satisfied" if rows else ""


HEADLINES = ("max_opening", "max_slip", *(f"max_{name}_{AWAY}" for name in ("tension_upstream", "tension_downstream", "compression")))


def shown(run, found):
    """Names of these extremes that a reader looks for first."""
    return [key for key in HEADLINES if key in found and not (run.tied and key in ("max_opening", "max_slip"))]


def ends_of(one, names, unit):
    """Texts of two fractiles without their signs, the smaller one first."""
    values = sorted(abs(one[name]) for name in names if is_number(one.get(name)))
    return [number(value, unit) for value in values] if len(values) == len(names) else ["–"] * len(names)


def extremes(run):
    """Table of the fractiles; of several factors also their headlines side by side."""
    rows = []
    for key, item in items(run).items():
        one = run.ensemble.extremes[key]
        cells = [f'{escape(item.title)} <span class="unit">{f"[{item.unit}]" if item.unit else ""}</span>', number(item.value, item.unit)]
        cells += [number(one[name], item.unit) if is_number(one.get(name)) else "–" for name in ("p16", "p84", "min", "max")]
        cells += [percent(one[name]) if is_number(one.get(name)) else "–" for name in ("known_68", "known_95")]
        cells.append(f"{one['motions_for_10_percent']:.0f}" if is_number(one.get("motions_for_10_percent")) else "–")
        rows.append(("", cells))
    text = html_table([("quantity", ""), ("median", "n"), ("16 %", "n"), ("84 %", "n"), ("least", "n"), ("largest", "n"), ("median known within (68 %)", "n"),
                       ("(95 %)", "n"), ("motions for ±10 %", "n")], rows)
    return text + by_factor(run) if len(run.ensemble.factors) > 1 else text


def by_factor(run):
    """Median and band of the headlines, a row for each factor of the motions."""
    keys = shown(run, run.ensemble.extremes)
    rows = []
    for factor, found in run.ensemble.of_factors():
        cells = [f"{factor:g}", f"{len(run.ensemble.values(keys[0], factor)) if keys else 0} of {run.ensemble.rows(factor).sum()}"]
        for key in keys:
            one = found.get(key, {})
            low, high = ends_of(one, ("p16", "p84"), EXTREMES[key][1])
            median = number(abs(one["median"]), EXTREMES[key][1]) if one else "–"
            cells.append(f'{median} <span class="unit">({low} to {high})</span>')
        rows.append(("", cells))
    heads = [("factor", ""), ("motions", "n"), *(head_of(key) for key in keys)]
    return f"<h3>By the factor of the motions: median (16 to 84 %). The table above has the factor {run.ensemble.factor:g}.</h3>{html_table(heads, rows)}"


def head_of(key):
    title, unit = EXTREMES[key]
    return f"{title.partition(',')[0].lower()} [{unit}]", "n"


def motions(run):
    """A row for each motion; many rows are folded."""
    found = run.ensemble.motions
    keys, several = shown(run, found), len(run.ensemble.factors) > 1
    rows = []
    for k in range(len(found["motion"])):
        status = "" if found["status"][k] == "ok" else escape(beginning(found["status"][k]))
        cells = [escape(found["name"][k]), *([f"{found['factor'][k]:g}"] if several else [])]
        cells += [number(abs(found[key][k]), EXTREMES[key][1]) if found[key][k] == found[key][k] else "–" for key in keys]
        rows.append(("", [*cells, (status, "exceeded" if status else "")]))
    heads = [("motion", ""), *([("factor", "n")] if several else [])]
    text = html_table([*heads, *(head_of(key) for key in keys), ("", "")], rows)
    return f"<details><summary>{len(rows)} motions</summary>{text}</details>" if len(rows) > 20 else text
