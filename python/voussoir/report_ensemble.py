# SPDX-License-Identifier: GPL-3.0-or-later
"""Many motions in a report: the answers of the first page as median and band, the table of the extremes, and that of the motions."""

from html import escape

from .ensembles import is_number, percent
from .errors import InputError
from .report_answers import closing, failed_checks, strength_of, validity
from .report_tables import AWAY, EXTREMES, html_table, items, number, with_unit
from .runs import Run


def spread(found, unit, bold=True):
    """Median, band and range of an extreme in words."""
    value = lambda name: number(abs(found[name]), unit)
    between = lambda low, high: " to ".join(number(x, unit) for x in sorted((abs(found[low]), abs(found[high]))))
    median = f"{value('median')} {unit}".strip()
    text = f"<b>{median}</b>" if bold else median
    if is_number(found.get("p16")) and is_number(found.get("p84")):
        text += f", 16 to 84 % of the motions {between('p16', 'p84')} {unit}".rstrip()
    if is_number(found.get("min")) and is_number(found.get("max")):
        text += f", all {between('min', 'max')} {unit}".rstrip()
    return text


def opening(run):
    """How far the joints open, in the median."""
    found = run.ensemble.extremes
    if "max_opening" not in found or run.tied:
        return "There are no joints that can open."
    text = f"In the median by at most {spread(found['max_opening'], 'mm')}"
    if (joints := run.ensemble.joints) is not None:
        worst = int(joints["opening_median"].argmax())
        text += f"; {escape(run.joint_name(int(joints['joint'][worst])))} opens most"
    text += f". {escape(run.ensemble.known())}"
    if "max_slip" in found:
        text += f" Slip: {spread(found['max_slip'], 'mm', False)}."
    return text


def closing_of_singles(run):
    """Whether the joints close again: of the motions with full tables."""
    texts = []
    for k, path in run.ensemble.singles():
        try:
            single = Run(path)
            texts.append(f"Motion {k}: {closing(single, items(single))}")
        except InputError:
            continue
    return " ".join(texts) or ("Unknown: openings over time are stored for chosen motions only, by <code>set Ensemble output</code> in subsection Motion, "
                               "such as 3; 7.")


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
    text = "Tension in the median " + "; ".join(f"{face} {spread(found[key], 'MPa')}" for face, key in faces.items())
    if (key := f"max_compression_{AWAY}") in found:
        text += f". Compression {spread(found[key], 'MPa', False)}"
    strength, entry = strength_of(run)
    values = largest_tensions(run)
    over = sum(value > strength for value in values)
    source = f"the tensile strength of the scene ({entry})" if entry else "a usual dynamic tensile strength (DL 5073-2000)"
    limit = with_unit(strength, "MPa")
    if values and not over:
        return f"{text}, away from the base. In no motion is the tension above {source}, {limit}."
    return (f'{text}, away from the base. <b class="exceeded">The concrete would crack</b> in {over} of {len(values)} motions: the tension is above '
            f"{source}, {limit}." if over else f"{text}, away from the base.")


# Entry of section Limits -> the columns that it limits
LIMITED = {"Opening": ("max_opening",), "Slip": ("max_slip",), "Tension": tuple(f"max_tension_{face}_{AWAY}" for face in ("upstream", "downstream")),
           "Compression": (f"max_compression_{AWAY}",), "Demand-capacity ratio": tuple(f"max_tension_{face}_{AWAY}" for face in ("upstream", "downstream"))}


def exceedances(run):
    """Limits of the scene: [(name, limit in words, motions that exceed it, motions)]."""
    rows = []
    for name, columns in LIMITED.items():
        if not (limit := run.limit(name)) > 0.:
            continue
        unit = "" if name.startswith("Demand") else "mm" if name in ("Opening", "Slip") else "MPa"
        static = run.limit("Static tensile strength") or 2. / 3. * run.limit("Tensile strength")
        if not unit and not static > 0.:
            continue
        found = [column for key in columns if len(column := run.ensemble.values(key))]
        if not found or len({len(column) for column in found}) > 1:
            continue
        largest = [max(map(abs, values)) / (1. if unit else static) for values in zip(*found)]
        rows.append((name, with_unit(limit, unit), sum(value > limit for value in largest), len(largest)))
    return rows


def limits(run):
    rows = exceedances(run)
    if not rows:
        return "The scene gives no limits (section Limits) for results of many motions, so nothing is evaluated here."
    over = [f"{name} ({limit}) in {count} of {n} motions" for name, limit, count, n in rows if count]
    kept = [f"{name} ({limit})" for name, limit, count, _ in rows if not count]
    text = f"Exceeded: {'; '.join(over)}." if over else ""
    return escape(" ".join(filter(None, (text, f"Satisfied in all motions: {'; '.join(kept)}." if kept else ""))))


def valid(run):
    """Checks and warnings, and motions without results."""
    failed = run.ensemble.failed
    text = ""
    if failed:
        text = (f'<b class="exceeded">{len(failed)} of {len(run.ensemble.motions["motion"])} motions have no result:</b> '
                f"{escape('; '.join(f'{name} ({status})' for name, status in failed[:8]))}. ")
    return text + validity(run, items(run))


def asked(run):
    """Questions and answers of many motions, as HTML."""
    return [("How far do the joints open?", opening(run)), *([] if run.tied else [("Do they close again?", closing_of_singles(run))]),
            ("How large are the stresses?", stresses(run)), ("Which limits are exceeded?", limits(run)), ("Are the results valid?", valid(run))]


def state(run):
    """Colour of the answers: exceeded if a limit is exceeded in a motion or a check is not satisfied."""
    rows = exceedances(run)
    return "exceeded" if any(count for *_, count, _ in rows) or run.ensemble.failed or failed_checks(run)[0] else "satisfied" if rows else ""


def extremes(run):
    """Tables of the fractiles, one for each factor."""
    parts = []
    factors = run.ensemble.of_factors()
    for factor, found in factors:
        keys = sorted(found, key=lambda key: list(EXTREMES).index(key) if key in EXTREMES else len(EXTREMES))
        rows = []
        for key in keys:
            title, unit = EXTREMES.get(key, (key.removeprefix("max_").replace("_", " ").capitalize(), "MPa" if any(w in key for w in ("stress", "tension")) else ""))
            one = found[key]
            cells = [f'{escape(title)} <span class="unit">{f"[{unit}]" if unit else ""}</span>']
            low_first = [abs(one.get(name, float("nan"))) if is_number(one.get(name)) else float("nan") for name in ("p16", "p84", "min", "max")]
            cells += [number(abs(one["median"]), unit), *(number(x, unit) if x == x else "–" for pair in (low_first[:2], low_first[2:]) for x in sorted(pair))]
            cells += [percent(one[name]) if is_number(one.get(name)) else "–" for name in ("known_68", "known_95")]
            cells.append(f"{one['motions_for_10_percent']:.0f}" if is_number(one.get("motions_for_10_percent")) else "–")
            rows.append(("", cells))
        if len(factors) > 1:
            parts.append(f"<h3>Factor {factor:g}</h3>")
        parts.append(html_table([("quantity", ""), ("median", "n"), ("16 %", "n"), ("84 %", "n"), ("least", "n"), ("largest", "n"), ("median known within (68 %)", "n"),
                                 ("(95 %)", "n"), ("motions for ±10 %", "n")], rows))
    return "".join(parts)


def motions(run):
    """A row for each motion."""
    found = run.ensemble.motions
    keys = [key for key in EXTREMES if key in found and not (run.tied and key in ("max_opening", "max_slip")) and (AWAY in key or key in ("max_opening", "max_slip"))]
    several = len(run.ensemble.factors) > 1
    rows = []
    for k in range(len(found["motion"])):
        ok = found["status"][k] == "ok"
        cells = [escape(found["name"][k]), *([f"{found['factor'][k]:g}"] if several else [])]
        cells += [number(abs(found[key][k]), EXTREMES[key][1]) if found[key][k] == found[key][k] else "–" for key in keys]
        rows.append(("", [*cells, ("" if ok else escape(found["status"][k]), "" if ok else "exceeded")]))
    heads = [("motion", ""), *([("factor", "n")] if several else []), *((f"{EXTREMES[key][0].lower()} [{EXTREMES[key][1]}]", "n") for key in keys), ("", "")]
    return html_table(heads, rows)
