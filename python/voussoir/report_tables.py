# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of a report, as HTML: numbers in engineering units, next to their limits."""

import re
from html import escape

from .report_places import MINUS, places_of
from .runs import Skip
from .units import decimal, readable, superscript, typeset

AWAY, WITH_BASE = "away_from_base", "with the base"
# Key of summary.json's extremes -> title, unit
EXTREMES = {
    "max_opening": ("Opening of a joint", "mm"),
    "max_slip": ("Slip of a joint", "mm"),
    "kept_opening": ("Opening that a joint keeps to the end", "mm"),
    "max_tension_upstream_away_from_base": ("Tension upstream, away from the base", "MPa"),
    "max_tension_downstream_away_from_base": ("Tension downstream, away from the base", "MPa"),
    "max_compression_away_from_base": ("Compression, away from the base", "MPa"),
    "max_tension_upstream": ("Tension upstream, with the base", "MPa"),
    "max_tension_downstream": ("Tension downstream, with the base", "MPa"),
    "max_compression": ("Compression, with the base", "MPa"),
    **{f"{name}_stress_{end}_{face}_{AWAY}": (f"{name.capitalize()} stress {face}, {word}, away from the base", "MPa")
       for name in ("arch", "cantilever", "vertical") for end, word in (("max", "largest"), ("min", "smallest")) for face in ("upstream", "downstream")},
    "overstress_seconds": ("Duration of overstress at a point, away from the base", "s")}
SCALES = {"mm": 1e3, "MPa": 1e-6, "%": 100., "s": 1., "": 1., "MN": 1e-6, "kN": 1e-3}


def number(value, unit, digits=3):
    """The value, given in SI, in this unit."""
    value *= SCALES[unit]
    if value != value:
        return "none"
    if value == 0. or abs(value) < 1e-4 and unit in ("mm", "MPa", "s", "%"):  # round-off, to an engineer
        return "0"
    if abs(value) < 1e-3 or abs(value) >= 1e6:
        mantissa, exponent = f"{value:.1e}".split("e")
        return f"{mantissa.replace('-', MINUS)} × 10{superscript(int(exponent))}"
    decimals = max(0, min(3, digits - len(str(int(abs(value))).lstrip("0"))))
    return f"{value:.{decimals}f}".replace("-", MINUS)


def with_unit(value, unit):
    """Text of a limit as in the scene, without zeros at the end."""
    return decimal(float(f"{value * SCALES[unit]:.4g}")) + (f" {unit}" if unit else "")


WORDS = {"demand_capacity": "demand-capacity ratio", "overstressed_share": "share of a face above the static tensile strength",
         "overstress_duration": "duration of overstress", "sliding_safety": "least safety against sliding on the base",
         "key_shear_stress": "shear stress of the keys", "wedge_safety": "least sliding safety of a rock wedge"}


def state_of(limit, bar=None):
    """satisfied or exceeded if this is so for the whole error bar (least, largest value); otherwise undecided. Without a bar, by the value."""
    if bar is None:
        return "satisfied" if limit["satisfied"] else "exceeded"
    satisfied = [end >= limit["limit"] if limit.get("is_least") else end <= limit["limit"] for end in bar]
    return "satisfied" if all(satisfied) else "undecided" if any(satisfied) else "exceeded"


def bars_of_limits(run):
    """Error bars of the values that limits are compared with: {name of the limit: (least, largest value)}."""
    bars, limits, found = run.error_bars[0], limits_of(run), {}
    for key, bar in bars.items():
        name = key.removeprefix("max_").removesuffix(f"_{AWAY}")
        if not key.endswith(AWAY) or "value_with_base" in limits.get(name, {}):  # earlier versions compare the whole face
            found[name] = bar["low"], bar["high"]
    faces = [bars[key] for key in (f"max_tension_{face}_{AWAY}" for face in ("upstream", "downstream")) if key in bars]
    overstress = run.summary.get("overstress") or {}
    strength = overstress.get("static_tensile_strength", overstress.get("tensile_strength"))  # the latter: earlier versions
    if len(faces) == 2 and strength and "value_with_base" in limits.get("demand_capacity", {}):
        found["demand_capacity"] = tuple(max(bar[end] for bar in faces) / strength for end in ("low", "high"))
    return found


def add_bars(run, found):
    """Gives the items of a run their error bars. That of the crest belongs to the farther of its two displacements."""
    bars = {key: (bar["low"], bar["high"]) for key, bar in run.error_bars[0].items()}
    if crest := [key for key in ("crest_downstream", "crest_upstream") if key in found and "crest_displacement" in bars]:
        bars[max(crest, key=lambda key: found[key].magnitude)] = bars.pop("crest_displacement")
    if "demand_capacity" in (of_limits := bars_of_limits(run)):
        bars["demand_capacity"] = of_limits["demand_capacity"]
    for key, (low, high) in bars.items():
        if key in found:
            found[key].bar = (low, high) if found[key].value >= 0. else (-high, -low)


def bar_words(item):
    """Error bar of an item relative to its value, such as "-0.4 to +1.6", in its unit."""
    return " to ".join(("+" if end > item.value else "") + number(end - item.value, item.unit, 2) for end in item.bar)


class Item:
    """A line of the table of results: a value in SI, perhaps with a place, a time and a limit."""

    def __init__(self, title, unit, found, limit=None):
        self.title, self.unit, self.limit = title, unit, limit
        self.bar = None  # least and largest value by `voussoir accuracy`
        self.band = None  # 16 and 84 % of many motions; the value is then their median
        found = found if isinstance(found, dict) else {"value": found}
        self.value, self.place, self.time = found["value"], found.get("place"), found.get("time")
        self.words = found.get("words", "")  # of the place

    @property
    def magnitude(self):
        return abs(self.value)

    @property
    def state(self):
        return "" if self.limit is None else state_of(self.limit, self.bar)

    def where(self):
        """Place and time in words, as HTML."""
        return escape(self.words), f"{self.time:.2f}" if self.time is not None else ""


def html_table(heads, rows):
    """A table of cells that are HTML. heads: (escaped title, class of its cells); rows: (class of the row, cells), a cell is HTML or (HTML, class).
    On a telephone each row is a card: first cell, then the others behind their titles."""
    def cell(content, head, first):
        text, kind = content if isinstance(content, tuple) else (content, "")
        kinds = " ".join(filter(None, (head[1], kind, "" if text else "empty")))
        return "<td" + (f' class="{kinds}"' if kinds else "") + ("" if first else f' data-label="{head[0]}"') + f">{text}</td>"

    titles = "".join(f'<th{f" class={kind}" if kind else ""}>{title}</th>' for title, kind in heads)
    body = "".join(f'<tr{f" class={kind}" if kind else ""}>' + "".join(cell(content, head, k == 0) for k, (content, head) in enumerate(zip(cells, heads))) +
                   "</tr>" for kind, cells in rows)
    return f'<div class="table"><table><thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table></div>'


def limits_of(run):
    return run.summary.get("limits", {})


def unit_of(name):
    """Unit of an extreme that is not listed by name."""
    if any(word in name for word in ("opening", "slip", "displacement", "gap")):
        return "mm"
    return "MPa" if any(word in name for word in ("tension", "compression", "stress", "pressure")) else ""


def items(run):
    """Results of a run in sequence: {key: Item}."""
    if run.ensemble:
        return items_of_ensemble(run)
    limits, found = limits_of(run), {}
    extremes_of_run = run.summary.get("extremes", {})
    for key in sorted(extremes_of_run, key=lambda key: list(EXTREMES).index(key) if key in EXTREMES else len(EXTREMES)):
        value = extremes_of_run[key]
        if not isinstance(value, dict) or not isinstance(value.get("value"), (int, float)) or (run.tied and key in ("max_opening", "max_slip")):
            continue
        title, unit = EXTREMES.get(key, (key.removeprefix("max_").replace("_", " ").capitalize(), unit_of(key)))
        name = key.removeprefix("max_").removesuffix(f"_{AWAY}")
        limit = limits.get(name)
        if limit and f"max_{name}_{AWAY}" in extremes_of_run and key.endswith(AWAY) != ("value_with_base" in limit):
            limit = None  # it is compared with the other one; in earlier versions with that of the whole face
        found[key] = Item(title, unit, value, limit)
    for key, of in (("waterstop", "at the waterstop"), ("residual", "that remains")):
        for name in ("opening", "slip"):
            if f"max_{name}" in run.summary.get(key, {}):
                found[f"{key}_{name}"] = Item(f"{name.capitalize()} {of}", "mm", run.summary[key][f"max_{name}"],
                                              limits.get(f"{key}_{name}"))
    found.update(demands(run, limits))
    if safeties := [block["min_sliding_safety"] | {"place": block["centroid"], "words": name} for name, block in blocks_of(run).items()
                    if is_number(block.get("min_sliding_safety", {}).get("value"))]:
        found["sliding_safety"] = Item("Least safety of a monolith against sliding on its base", "",
                                       min(safeties, key=lambda safety: safety["value"]), limits.get("sliding_safety"))
    if safeties := [wedge["min_safety"] | {"place": wedge["base_centroid"], "words": name} for name, wedge in wedges_of(run).items()
                    if is_number(wedge["min_safety"]["value"])]:
        found["wedge_safety"] = Item("Least sliding safety of a rock wedge", "", min(safeties, key=lambda one: one["value"]), limits.get("wedge_safety"))
    if "max_shear_stress" in (keys := run.summary.get("keys", {})):
        found["keys"] = Item(f"Shear stress of the keys, joint {keys['max_shear_stress']['joint']:.0f}, over its area", "MPa",
                             keys["max_shear_stress"], limits.get("key_shear_stress"))
    try:
        crest, time = run.history["crest_x"], run.history["time"]
        for name, k in (("downstream", crest.argmax()), ("upstream", crest.argmin())):
            found[f"crest_{name}"] = Item(f"Crest, farthest {name}", "mm", {"value": float(crest[k]), "time": float(time[k])})
    except (Skip, KeyError):
        pass
    add_bars(run, found)
    places = places_of(run)
    for key, item in found.items():
        item.words = item.words or places.words(key, item.place, item.value)
    return found


def items_of_ensemble(run):
    """Medians of the extremes over the motions, each with its band."""
    found, extremes_of_run = {}, run.ensemble.extremes
    for key in sorted(extremes_of_run, key=lambda key: list(EXTREMES).index(key) if key in EXTREMES else len(EXTREMES)):
        if run.tied and key in ("max_opening", "max_slip"):
            continue
        title, unit = EXTREMES.get(key, (key.removeprefix("max_").replace("_", " ").capitalize(), unit_of(key)))
        found[key] = Item(title, unit, extremes_of_run[key]["median"])
        if is_number(extremes_of_run[key].get("p16")) and is_number(extremes_of_run[key].get("p84")):
            found[key].band = extremes_of_run[key]["p16"], extremes_of_run[key]["p84"]
    return found


def is_number(value):
    return isinstance(value, (int, float))


def blocks_of(run):
    return run.summary.get("blocks", {})


def blocks(run):
    """The extremes of the forces on the bases, monolith by monolith."""
    found = blocks_of(run)
    columns = [("max_compression", "compression at most"), ("min_compression", "compression at least"), ("max_shear", "shear at most")]
    forces = [block[key]["value"] for block in found.values() for key, _ in columns if is_number(block[key]["value"])]
    unit = "MN" if max(map(abs, forces), default=0.) >= 1e6 else "kN"
    safe = any("min_sliding_safety" in block for block in found.values())
    heads = [("", ""), ("area [m²]", "n"), (f"uplift [{unit}]", "n"), *((f"{title} [{unit}]", "n") for _, title in columns)]
    heads += [("sliding safety at least", "n")] if safe else []
    rows = []
    for name, block in found.items():
        cells = [escape(name), number(block["area"], ""), number(block["uplift"], unit)]
        for key, of in [(key, unit) for key, _ in columns] + ([("min_sliding_safety", "")] if safe else []):
            value, time = block[key]["value"], block[key]["time"]
            cells.append(f"{number(value, of)} ({time:.2f} s)" if is_number(value) else "–")  # of no shear at all
        rows.append(("", cells))
    return html_table(heads, rows)


def wedges_of(run):
    return run.summary.get("wedges", {})


def wedges(run):
    """Sliding safety of the rock wedges, with the mode and the force of the dam at its time."""
    heads = [("", ""), ("mass [t]", "n"), ("base on it [m²]", "n"), ("static safety", "n"), ("smallest safety", "n"), ("mode", ""),
             *((f"force {axis} [MN]", "n") for axis in "xyz")]
    rows = []
    for name, wedge in wedges_of(run).items():
        least, static = wedge["min_safety"], wedge["static_safety"]["value"]
        rows.append(("", [escape(name), number(wedge["mass"] / 1000., ""), number(wedge["base_area"], ""), number(static, "") if is_number(static) else "–",
                          f"{number(least['value'], '')} ({least['time']:.2f} s)" if is_number(least["value"]) else "–",
                          escape(least["mode_in_words"]), *(number(round(force), "MN") for force in least["force"])]))
    return html_table(heads, rows)


def demands(run, limits):
    """Items about the tensile strength."""
    overstress, found = run.summary.get("overstress"), {}
    faces = [overstress[name] for name in ("upstream", "downstream") if name in (overstress or {})]
    if not faces:
        return found
    away = f"_{AWAY}" if f"share_{AWAY}" in faces[0] else ""  # earlier versions have the whole face only
    words = ", away from the base" if away else ""
    found["demand_capacity"] = Item(f"Demand-capacity ratio{words}", "", max(face[f"demand_capacity{away}"] for face in faces), limits.get("demand_capacity"))
    if away:
        found["demand_capacity_with_base"] = Item(f"Demand-capacity ratio, {WITH_BASE}", "", max(face["demand_capacity"] for face in faces))
    if not run.moves:  # the stresses are of one time
        overstress_of_faces(run, found, overstress, limits, away)
        return found
    title, longest, limit = f"Duration of overstress at a point{words}", max(face[f"duration{away}"][0] for face in faces), limits.get("overstress_duration")
    if limit:  # of the level that decides: what is allowed there falls to none at twice the strength
        longest = limit["value"]
        title += f", above {level_of(run, limit, 'Overstress duration'):.2g} times the strength"
    found["overstress_duration"] = Item(title, "s", longest, limit)
    if away:
        longest = limit["value_with_base"] if limit else max(face["duration"][0] for face in faces)
        found["overstress_duration_with_base"] = Item(title.replace(words, f", {WITH_BASE}"), "s", longest)
    overstress_of_faces(run, found, overstress, limits, away)
    return found


def level_of(run, limit, entry):
    """Level, in multiples of the strength, that decides on a limit which falls to zero at twice the strength."""
    return 2. - limit["limit"] / run.limit(entry) if run.limit(entry) > 0. else 1.


def overstress_of_faces(run, found, overstress, limits, away):
    """Adds the share of either face, at the level that decides on the limit."""
    limit = limits.get("overstressed_share")  # that of the worse face
    level = level_of(run, limit, "Overstressed share") if limit else 1.
    number = min(range(len(overstress["levels"])), key=lambda k: abs(overstress["levels"][k] - level))
    for name in ("upstream", "downstream"):
        if name in overstress:
            share = overstress[name][f"share{away}"][number]
            title = f"Share of the {name} face above {f'{level:.2g} times ' if number else ''}the static tensile strength"
            found[f"share_{name}"] = Item(title + (", away from the base" if away else ""), "%", share,
                                          limit and {**limit, "value": share, "satisfied": share <= limit["limit"]})
            if away:
                found[f"share_{name}_with_base"] = Item(f"{title}, {WITH_BASE}", "%", overstress[name]["share"][number])


def verdict(run):
    """satisfied, exceeded, undecided or nothing; and a sentence."""
    limits, unjudged = limits_of(run), run.summary.get("limits_not_evaluated", {})
    rest = " Not evaluated: " + "; ".join(f"{WORDS.get(name, name.replace('_', ' '))} ({why})" for name, why in unjudged.items()) + "." if unjudged else ""
    if not limits:
        return "", rest.strip() or "The scene gives no limits (section Limits), so nothing is evaluated here."
    texts, bars = {"exceeded": [], "undecided": []}, bars_of_limits(run)
    for name, limit in limits.items():
        if (state := state_of(limit, bars.get(name))) != "satisfied":
            unit = {"Pa": "MPa", "m": "mm"}.get(limit.get("unit", ""), limit.get("unit", "")) or ("%" if "share" in name else "")
            value = f"{number(limit['value'], unit)}{' ' + unit if unit else ''}"
            bound = "required" if limit.get("is_least") else "limit"  # as in the log
            texts[state].append(f"{WORDS.get(name, name.replace('_', ' '))} {value} ({bound} {with_unit(limit['limit'], unit)})")
    if not any(texts.values()):
        return ("", f"{len(limits)} of {len(limits) + len(unjudged)} limits are satisfied.{rest}") if unjudged else (
            "satisfied", "All limits of the scene are satisfied.")
    words = {"exceeded": "exceeded", "undecided": "undecided, as the limit lies within the error bar"}
    sentences = [f"{len(found)} of {len(limits)} limits {'is' if len(found) == 1 else 'are'} {words[state]}: {'; '.join(found)}."
                 for state, found in texts.items() if found]
    return "exceeded" if texts["exceeded"] else "undecided", " ".join(sentences) + rest


# Entry of section Limits -> the columns that it limits
LIMITED = {"Opening": ("max_opening",), "Slip": ("max_slip",), "Tension": tuple(f"max_tension_{face}_{AWAY}" for face in ("upstream", "downstream")),
           "Compression": (f"max_compression_{AWAY}",), "Demand-capacity ratio": tuple(f"max_tension_{face}_{AWAY}" for face in ("upstream", "downstream"))}


def exceedances(run):
    """Limits of the scene of many motions: [(name, limit in words, motions that exceed it, motions)]."""
    counted = run.ensemble.found.get("motions_above_limit")
    if isinstance(counted, dict) and counted:  # by the program, also of limits that ensemble.csv does not show
        entries = {"opening": "Opening", "slip": "Slip", "tension_upstream": "Tension", "tension_downstream": "Tension", "compression": "Compression",
                   "demand_capacity": "Demand-capacity ratio"}
        bound = lambda name: with_unit(run.limit(entries[name]), unit_of(name)) if name in entries else ""
        return [(WORDS.get(name, name.replace("_", " ")), bound(name), int(count), run.ensemble.n) for name, count in counted.items()]
    rows = []
    for name, columns in LIMITED.items():
        if not (limit := run.limit(name)) > 0.:
            continue
        unit = "" if name.startswith("Demand") else "mm" if name in ("Opening", "Slip") else "MPa"
        static = run.static_strength
        if not unit and not static > 0.:
            continue
        found = [column for key in columns if len(column := run.ensemble.values(key))]
        if not found or len({len(column) for column in found}) > 1:
            continue
        largest = [max(map(abs, values)) / (1. if unit else static) for values in zip(*found)]
        rows.append((name, with_unit(limit, unit), sum(value > limit for value in largest), len(largest)))
    return rows


def extremes(runs):
    """All results; of a single run with places and times, of several side by side."""
    found = [items(run) for run in runs]
    keys = list(dict.fromkeys(key for of_run in found for key in of_run))
    limited, single, rows = any(item.limit for of_run in found for item in of_run.values()), len(runs) == 1, []
    for key in keys:
        item = next(of_run[key] for of_run in found if key in of_run)
        titles = {of_run[key].title for of_run in found if key in of_run}
        title = item.title if len(titles) == 1 else f"{item.title.partition(',')[0]}, where each run has its worst"
        cells = [f'{escape(title)} <span class="unit">{"[" + item.unit + "]" if item.unit else ""}</span>']
        for of_run in found:
            one = of_run.get(key)
            if one and (one.bar or one.band):
                spread = bar_words(one) if one.bar else f"({' to '.join(number(end, one.unit) for end in one.band)})"
                cells.append((f'{number(one.value, one.unit)} <span class="unit">{spread}</span>', one.state))
                continue
            cells.append((number(one.value, one.unit), one.state) if one else "–")
        if limited:
            given = dict.fromkeys(with_unit(of_run[key].limit["limit"], item.unit).removesuffix(item.unit).strip()
                                  for of_run in found if key in of_run and of_run[key].limit)  # runs may have their own
            cells.append(", ".join(given))
        if single:
            if limited:
                cells.append(("not reached" if item.state == "exceeded" and item.limit.get("is_least") else item.state, item.state))
            cells += item.where()
        rows.append(("", cells))
    heads = [("quantity", ""), *((escape(name), "n") for name in (["largest"] if single else [run.name for run in runs]))]
    heads += ([("limit", "n")] if limited else []) + ([("", "")] if limited and single else [])
    return html_table(heads + ([("place", ""), ("time [s]", "n")] if single else []), rows)


def table(head, rows):
    """Rows of texts; a row may be marked as one in which runs differ."""
    return html_table([(escape(title), "") for title in head], [("differs" if differs else "", [escape(cell) for cell in cells]) for cells, differs in rows])


def facts(runs):
    """Table of the lines of the log about each scene."""
    titles = list(dict.fromkeys(title for run in runs for title in run.facts if title not in ("Shaking", "Figures", "Results", "Speed", "Energy")))
    rows = []
    for title in titles:
        texts = [run.facts.get(title, "–") for run in runs]
        if len(runs) > 1:  # runs of one dam have the same mesh and static state, whatever they are called and however long they took
            texts = [re.sub(r" \([\d.]+ s\)$", "", text.removeprefix(f"{run.scene}: ")) for run, text in zip(runs, texts)]
        texts = [typeset(text) for text in texts]
        rows.append(((title, *(texts if len(set(texts)) > 1 else texts[:1] + [""] * (len(runs) - 1))), len(set(texts)) > 1))
    if len(runs) == 1:
        return table(["", "as the program understood it"], rows)
    same = [((cells[0], cells[1]), False) for cells, differs in rows if not differs]
    apart = [(cells, False) for cells, differs in rows if differs]
    return (table(["in all runs", ""], same) if same else "") + (table(["", *(run.name for run in runs)], apart) if apart else "")


def differences(runs):
    """Entries whose values are not the defaults in some run; those in which runs differ are marked."""
    changed = {name for run in runs for name, (_, default) in run.entries.items() if default is not None}
    names = [name for name in dict.fromkeys(name for run in runs for name in run.entries) if name in changed]
    if not names:
        return "<p>Nothing: every entry has its default.</p>"
    rows = []
    for name in names:
        values = [readable(run.entries[name][0], run.units.get(name)) if name in run.entries else "–" for run in runs]
        default = next(readable(run.entries[name][1], run.units.get(name)) for run in runs if run.entries.get(name, ("", None))[1] is not None)
        rows.append(((name, *(value or "(empty)" for value in values), default or "(empty)"), len(set(values)) > 1))
    marked = '<p class="sub">Shaded: the runs differ.</p>' if any(differs for _, differs in rows) and len(runs) > 1 else ""
    return table(["entry", *([run.name for run in runs] if len(runs) > 1 else ["value"]), "default"], rows) + marked
