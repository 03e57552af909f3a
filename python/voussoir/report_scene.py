# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run analysed, in words for the first page of a report: dam, joints, water, foundation, ground motion; and what its model leaves out.
All texts are plain; the page escapes them."""

import re

import numpy as np

from .report_places import MINUS, places_of
from .runs import Skip
from .units import readable, typeset

LAWS = {"tied": "closed, without opening and slip", "FJA": "they open, and slip with friction", "FJB": "they open, without slip",
        "KSM": "with shear keys, they open, and slip with friction", "cohesive": "bonded until they crack, then they open, and slip with friction"}
WATER = {"none": "static pressure only", "Westergaard": "hydrodynamic added mass by Westergaard", "Westergaard-nodal": "hydrodynamic added mass by Westergaard",
         "added mass table": "hydrodynamic added mass by a table", "incompressible": "incompressible water", "acoustic": "compressible water"}
GROUND = {"rigid": "rigid: the base of the dam has the ground motion", "massless": "elastic rock without mass, the ground motion at its outer boundary",
          "rock": "elastic rock with mass, the earthquake enters from below"}


WAYS = {"x": "along the river", "y": "across", "z": "vertical"}
YOUNG = "Foundation/Young's modulus"


def entry(run, name, default=""):
    return run.entries.get(name, (default, None))[0].strip()


def lengths(run):
    """Height, crest length [m] and volume [m3] of the dam, as far as the run has them."""
    mesh = run.summary.get("mesh", {})
    known = lambda name: mesh[name] if isinstance(mesh.get(name), (int, float)) and mesh[name] > 0. else 0.
    return places_of(run).height, known("crest_length"), known("volume")


def volume_words(volume):
    return f"{volume / 1e6:.3g} million m³" if volume >= 1e6 else f"{1e3 * round(volume / 1e3, 1):,.0f} m³" if volume >= 1e4 else f"{volume:.4g} m³"


def dam(run):
    height, crest, volume = lengths(run)
    mesh = run.summary.get("mesh", {})
    parts = [f"{height:.0f} m high" if height > 0. else "", f"crest {crest:.0f} m long" if crest else "",
             f"{volume_words(volume)} of concrete" if volume else ""]
    concrete = re.sub(r"\s*Poisson.*?,", "", typeset(run.facts.get("Concrete", "").partition(";")[0]))
    elements = f"mesh of {mesh['cells']:,} elements" if isinstance(mesh.get("cells"), int) else ""
    return "; ".join(filter(None, (", ".join(filter(None, parts)), concrete and f"concrete {concrete}", elements)))


def joints(run):
    """Number and law of the joints."""
    mesh = run.summary.get("mesh", {})
    n = mesh.get("joints", 0)
    if isinstance(names := mesh.get("joint_names"), list):
        kinds = {"contraction joint": "joint", "lift joint": "lift", "base joint": "base"}
        numbers = {kind: sum(str(name).startswith(word) for name in names) for kind, word in kinds.items()}
        counts = ", ".join(f"{count} {kind}{'s' if count > 1 else ''}" for kind, count in numbers.items() if count)
    else:
        counts = f"{n} joints"
    if not counts or not n:
        return "none"
    law = next((words for name, words in LAWS.items() if name.lower() == run.law.lower()), "")
    friction = entry(run, "Joints/Friction") if run.law in ("FJA", "KSM", "cohesive") else ""
    others = entry(run, "Joints/Overrides")
    return (f"{counts}, law {run.law}" + (f": {law}" if law else "") + (f" {friction}" if friction else "")
            + (f"; other laws: {others}" if others else ""))


def water(run):
    if "water" not in run.summary.get("loads", {"water": 0}):
        return "none"
    level, top = run.value("Reservoir/Water level"), places_of(run).top
    if "Reservoir/Water level" not in run.entries:
        return typeset(run.facts.get("Water", ""))
    below = f", {top - level:.3g} m below the crest" if top > level else ""
    return f"level {level:g} m{below}; {WATER.get(entry(run, 'Reservoir/Model'), entry(run, 'Reservoir/Model'))}".replace("-", MINUS)


def foundation(run):
    model = str(run.summary.get("foundation", ""))
    text = GROUND.get(model, model)
    if model in ("massless", "rock") and YOUNG in run.entries:
        text += f"; {readable(entry(run, YOUNG), 'Pa')}"
    return text


def source(run):
    """Where the ground motion is from."""
    if run.ensemble:
        names = run.ensemble.found.get("names")
        names = list(dict.fromkeys(map(str, names))) if isinstance(names, list) else []  # each factor repeats them
        seeds = [int(match[1]) for name in names if (match := re.fullmatch(r"seed (\d+)", name))]
        if len(seeds) > 2 and len(seeds) == len(names) and seeds == list(range(seeds[0], seeds[0] + len(seeds))):
            return f"{len(names)} artificial motions of one spectrum ({entry(run, 'Motion/Spectrum') or 'target'}), seeds {seeds[0]} to {seeds[-1]}"
        return f"{run.ensemble.n} motions" + (f": {', '.join(names[:8])}{' …' if len(names) > 8 else ''}" if names else "")
    kind = entry(run, "Motion/Source")
    if kind == "artificial":
        target = entry(run, "Motion/Target spectrum")
        sequence = entry(run, "Motion/Sequence")
        seeds = f"seeds {sequence} one after another" if sequence else f"seed {entry(run, 'Motion/Seed')}"
        return f"artificial, spectrum {target or entry(run, 'Motion/Spectrum')}, {seeds}"
    if kind == "file":
        files = [entry(run, f"Motion/{name}") for name in ("Sequence", "File", "File x", "File y", "File z", "Abutments")]
        change = {"true": ", matched to the spectrum ", "scale": ", scaled to the spectrum "}.get(entry(run, "Motion/Match"))
        matched = change + entry(run, "Motion/Target spectrum") if change else ""
        names = [re.sub(r"[^\s,;:]*/", "", text) for text in files if text]
        return f"recorded: {', '.join(names) or 'no file'}{matched}"
    return kind


def peaks(run):
    """Peak accelerations in g: by the log in all three directions, else by history.csv."""
    match = re.match(r"x, y, z: PGA ([\d.]+) ([\d.]+) ([\d.]+) g", run.facts.get("Motion", ""))
    if match:
        found = dict(zip("xyz", map(float, match.groups())))
    else:
        try:
            found = {d: float(np.abs(column).max()) / 9.80665 for d, column in sorted(run.base_acceleration.items())}
        except Skip:
            return ""
    words = ", ".join(f"{value:.3g} g {WAYS[d]}" for d, value in found.items() if value > 0.)
    return f"peak acceleration {words}" if words else ""


def factor_of_first(run):
    """Factor of the first of many motions, if they have several."""
    return f", factor {run.ensemble.motions['factor'][0]:g}" if run.ensemble and len(run.ensemble.factors) > 1 else ""


def motion(run):
    if not run.moves:
        return "none: the static state alone"
    factor = entry(run, "Motion/Factor", "1")
    ensemble_factors = run.ensemble.factors if run.ensemble else []
    steps, dt = run.summary.get("steps"), run.summary.get("time_step")
    seconds = steps * dt if isinstance(steps, int) and isinstance(dt, (int, float)) else run.value("Motion/Duration")
    length = f"{seconds:.4g} s" if seconds > 0. else ""
    scaled = f"factors {', '.join(f'{x:g}' for x in ensemble_factors)}" if len(ensemble_factors) > 1 else f"factor {factor}" if factor not in ("1", "") else ""
    first = f"the first{factor_of_first(run)}: " if run.ensemble and peaks(run) else ""
    return "; ".join(filter(None, (source(run), first + peaks(run), length, scaled)))


def analysed(run):
    """What was analysed: [(title, text)]."""
    rows = [("Dam", dam(run)), ("Joints", joints(run)), ("Water", water(run)), ("Foundation", foundation(run)), ("Ground motion", motion(run))]
    return [(title, text) for title, text in rows if text]


def left_out(run):
    """What the model leaves out, in one sentence."""
    ground, model = str(run.summary.get("foundation", "")), entry(run, "Reservoir/Model")
    parts = ["cracking of the concrete"]
    if run.tied:
        parts.append("opening of the joints")
    waves = ["radiation of waves into the rock"] if run.moves and ground in ("rigid", "massless") else []
    parts += (["deformation of the rock"] if ground == "rigid" else []) + waves
    if "water" in run.summary.get("loads", {}) and run.moves:
        parts += {"none": ["hydrodynamic pressure"], "acoustic": []}.get(model, ["compressibility of the water"])
    if "temperature" not in run.summary.get("loads", {}):
        parts.append("temperature")
    if run.moves and ground in ("rigid", "massless") and not entry(run, "Motion/Abutments"):
        parts.append("differences of the ground motion along the base")
    return f"The model leaves out {', '.join(parts[:-1])} and {parts[-1]}." if len(parts) > 1 else f"The model leaves out {parts[0]}."
