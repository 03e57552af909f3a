# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a study: measures over the scale (incremental dynamic analysis), fragility over records, tornado of factors."""

import math
from collections import Counter, defaultdict
from dataclasses import replace

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # after the choice of the backend
import numpy as np

from .palette import COLOURS

MEASURES = {"Opening": ("opening", 1e3, "largest opening [mm]", "mm"), "Slip": ("slip", 1e3, "largest slip [mm]", "mm"),
            "Tension": ("tension", 1e-6, "largest tension away from the base [MPa]", "MPa"),
            "Damage": ("damage_share", 100., "faces above {strength:g} MPa [%]", "%")}
ENOUGH = 5  # records for fractiles

plt.rcParams.update({
    "font.size": 10, "axes.titlesize": 11, "legend.fontsize": 9, "legend.frameon": False, "axes.grid": True,
    "grid.linewidth": .4, "grid.color": ".85", "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
    "savefig.dpi": 160, "savefig.bbox": "tight"})


def number(text):
    """The number before a unit."""
    return float(text.split(" ")[0])


def short(entry):
    """An entry's own name."""
    return entry.split("/")[-1]


def measured(rows, name):
    """The measure of the rows that have it, in its unit."""
    column, factor, _, _ = MEASURES[name]
    return [(row, factor * row[column]) for row in rows if row.get(column) is not None]


def label_of(name, study):
    return MEASURES[name][2].format(strength=1e-6 * study.strength)


def grouped(study, rows):
    """Rows by all factors but the scale and the record: {label: rows}."""
    others = [entry for entry in study.factors if entry not in (study.over, study.records)]
    groups = defaultdict(list)
    for row in rows:
        groups[", ".join(f"{short(entry)} {row[entry]}" for entry in others)].append(row)
    return groups


def save(figure, path):
    """PNG and PDF."""
    for suffix in (".png", ".pdf"):
        figure.savefig(path.with_suffix(suffix), metadata={"CreationDate": None} if suffix == ".pdf" else None)
    plt.close(figure)


# ---------------------------------------------------------------- over the scale

def curves(pairs, study):
    """A curve for each record, as {record: {scale: value}}."""
    found = defaultdict(dict)
    for row, value in pairs:
        found[row[study.records] if study.records else ""][number(row[study.over])] = value
    return found


def draw_group(axes, study, pairs, colour, label):
    """Curves of the records; where there are enough, their median and fractiles, too."""
    by_record = curves(pairs, study)
    many = len(by_record) > 1
    for record in by_record.values():
        axes.plot(*zip(*sorted(record.items())), color=colour, marker="o", markersize=2.5 if many else 4.5,
                  linewidth=.6 if many else 1.6, alpha=.45 if many else 1., label=None if many else label)
    if not many:
        return
    scales = sorted({scale for record in by_record.values() for scale in record})
    values = [[record[scale] for record in by_record.values() if scale in record] for scale in scales]
    axes.plot(scales, [np.median(v) for v in values], color=colour, linewidth=2.4, label=label)
    if min(map(len, values)) >= ENOUGH:
        for percent in (16, 84):
            axes.plot(scales, [np.percentile(v, percent) for v in values], color=colour, linewidth=1.4, linestyle="--",
                      label="16 and 84 %" if percent == 16 and label.startswith("median") else None)


def incremental(study, rows, path):
    """Opening, tension and damage over the scale."""
    names = [name for name in ("Opening", "Tension", "Damage") if measured(rows, name)]
    groups = grouped(study, rows)
    figure, panels = plt.subplots(1, len(names), figsize=(4.3 * len(names), 4), squeeze=False, layout="constrained")
    for axes, name in zip(panels[0], names):
        for i, (group, own) in enumerate(groups.items()):
            pairs = measured(own, name)
            n_records = len(curves(pairs, study))
            label = ", ".join(([f"median of {n_records} records"] if n_records > 1 else []) + ([group] if group else []))
            if pairs:
                draw_group(axes, study, pairs, COLOURS[i % len(COLOURS)], label)
        axes.set(xlabel=study.over, ylabel=label_of(name, study))
        axes.set_ylim(bottom=0)
    handles, labels = panels[0][0].get_legend_handles_labels()
    few = len(labels) <= 3
    if few and labels:
        panels[0][0].legend(loc="upper left")
    elif labels:
        figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(.5, 0.), ncol=min(3, len(labels)))
    save(figure, path)


# ---------------------------------------------------------------- fragility

def normal(z):
    """The normal distribution."""
    return .5 * np.array([1. + math.erf(x / math.sqrt(2.)) for x in np.atleast_1d(z)])


def lognormal_fit(scales, above, runs):
    """Median and standard deviation of the logarithm of the scale at which a limit is exceeded. Maximum likelihood of the
    counts `above` of `runs` at each scale (Baker, Earthquake Spectra 31, 2015, equation 11), by Newton's method for
    Phi(a + b ln x). None: the counts do not overlap (then a smaller deviation always fits better), or do not increase."""
    scales, above, runs = (np.asarray(values, dtype=float) for values in (scales, above, runs))
    if not above.any() or (above == runs).all() or scales[above > 0].min() >= scales[above < runs].max():
        return None
    x = np.stack([np.ones_like(scales), np.log(scales)], axis=1)
    beta = np.zeros(2)
    for _ in range(100):
        z = x @ beta
        p = np.clip(normal(z), 1e-12, 1. - 1e-12)
        density = np.exp(-.5 * z * z) / math.sqrt(2. * math.pi)
        weight = runs * density**2 / (p * (1. - p))  # Fisher's information
        step = np.linalg.solve(x.T @ (weight[:, None] * x), x.T @ (density * (above - runs * p) / (p * (1. - p))))
        beta += step * min(1., 2. / np.abs(step).max())
        if np.abs(step).max() < 1e-10:
            break
    return (math.exp(-beta[0] / beta[1]), 1. / beta[1]) if beta[1] > 0 else None


def passings(by_record, limit):
    """Scales at which the records' curves {scale: value} first exceed the limit, by linear interpolation. Three lists: these
    scales; the largest scales of records that never exceed it; the smallest scales of records that always exceed it."""
    known, later, earlier = [], [], []
    for curve in by_record.values():
        scales = sorted(curve)
        values = [curve[scale] for scale in scales]
        first = next((i for i, value in enumerate(values) if value > limit), None)
        if first is None:
            later.append(scales[-1])
        elif first == 0:
            earlier.append(scales[0])
        else:
            part = (limit - values[first - 1]) / (values[first] - values[first - 1])
            known.append(scales[first - 1] + part * (scales[first] - scales[first - 1]))
    return known, later, earlier


def lognormal_of_passings(known, later, earlier):
    """Median and standard deviation of the logarithm of the scales, the others being known to be larger or smaller than
    theirs: maximum likelihood by expectation and maximisation (Dempster, Laird and Rubin, J. R. Stat. Soc. B 39, 1977), the
    deviation with n - 1. None with fewer than three known scales."""
    if len(known) < 3:
        return None
    known, bounds = np.log(known), np.log(np.array([*later, *earlier], dtype=float))
    side = np.array([1.] * len(later) + [-1.] * len(earlier))
    mean, deviation, n = known.mean(), max(known.std(), 1e-9), len(known) + len(bounds)
    for _ in range(2000 if len(bounds) else 1):
        z = (bounds - mean) / deviation
        hazard = np.exp(-.5 * z * z) / math.sqrt(2. * math.pi) / np.maximum(normal(-side * z), 1e-300) if len(bounds) else z
        first = mean + side * deviation * hazard
        second = mean**2 + deviation**2 + side * deviation * hazard * (mean + bounds)
        before = mean, deviation
        mean = (known.sum() + first.sum()) / n
        deviation = math.sqrt(max((known @ known + second.sum()) / n - mean**2, 1e-18))
        if abs(mean - before[0]) + abs(deviation - before[1]) < 1e-12:
            break
    return math.exp(mean), deviation * math.sqrt(n / (n - 1))


def draw_fragility(axes, study, pairs, limit, colour, text):
    """Draws the share of runs above a limit at each scale, with the fitted curve and the number of runs."""
    stripes, by_record = defaultdict(list), curves(pairs, study)
    for row, value in pairs:
        stripes[number(row[study.over])].append(value > limit)
    scales = sorted(stripes)
    above, runs = [sum(stripes[scale]) for scale in scales], [len(stripes[scale]) for scale in scales]
    text += f": {sum(above)} of {sum(runs)} runs"
    fit, reason = None, "a scale is not positive"
    if min(scales) > 0 and min(map(len, by_record.values())) > 1:
        found = passings(by_record, limit)
        fit, reason = lognormal_of_passings(*found), "fewer than three records exceed it between two scales"
        source = f"{len(found[0])} of {len(by_record)} records exceed it between two scales"
    elif min(scales) > 0:
        fit, reason = lognormal_fit(scales, above, runs), "fewer than two scales have both"
        source = f"counts of {len(scales)} scales"
    if fit is not None:
        x = np.linspace(min(scales) / 4, 1.1 * max(scales), 400)
        axes.plot(x, normal((np.log(x) - math.log(fit[0])) / max(fit[1], 1e-6)), color=colour, linewidth=2)
        text += f"\nmedian {fit[0]:.3g}, deviation of ln {fit[1]:.2f}\n{source}"
    else:
        text += f"\nno fit: {reason}"
    axes.plot(scales, np.divide(above, runs), "o", color=colour, clip_on=False, label=text)


def fragility(study, rows, path):
    """Above: the measure of every run over the scale, with its limits; below: the share of runs that pass each."""
    names = [name for name in study.limits if measured(rows, name)]
    groups = grouped(study, rows)
    figure, panels = plt.subplots(2, len(names), figsize=(4.8 * len(names), 7.6), sharex=True, squeeze=False, layout="constrained")
    for (scatter, chance), name in zip(panels.T, names):
        _, factor, _, unit = MEASURES[name]
        i = 0
        for (group, own), marker in zip(groups.items(), "os^Dv<>" * len(groups)):
            pairs = measured(own, name)
            scatter.plot([number(row[study.over]) for row, _ in pairs], [value for _, value in pairs], marker, markersize=4,
                         color=".35", markerfacecolor="none", label=group or None)
            for limit in study.limits[name] if pairs else ():
                text = ", ".join([part for part in (group, f"{name.lower()} > {factor * limit:g} {unit}") if part])
                draw_fragility(chance, study, pairs, factor * limit, COLOURS[i % len(COLOURS)], text)
                scatter.axhline(factor * limit, color=COLOURS[i % len(COLOURS)], linewidth=1.2)
                i += 1
        n_records = len({row[study.records] for row in rows})
        scatter.set(ylabel=label_of(name, study), title=f"{n_records} records, {len(measured(rows, name))} runs")
        scatter.set_ylim(bottom=0)
        chance.set(xlabel=study.over, ylabel="share of runs above the limit", ylim=(-.02, 1.02))
        chance.legend(loc="upper center", bbox_to_anchor=(.5, -.14))
        if len(groups) > 1:
            scatter.legend(loc="upper left")
    save(figure, path)


# ---------------------------------------------------------------- tornado

def effects(study, pairs):
    """Mean measure for each value of each factor: {factor: {value: mean}}, over sets of scenes that differ only in the
    factor. Also the scene that most sets have in common, if there is one."""
    found, taken = {}, Counter()
    for factor in study.factors:
        sets = defaultdict(dict)
        for row, value in pairs:
            sets[tuple(row[entry] for entry in study.factors if entry != factor)][row[factor]] = (row["scene"], value)
        wide = [own for own in sets.values() if len(own) == max(map(len, sets.values()))]
        if len(wide[0]) > 1:
            found[factor] = {key: np.mean([own[key][1] for own in wide if key in own]) for own in wide for key in own}
            taken.update(scene for own in wide for scene, _ in own.values())
    first = taken.most_common(2)
    base = first[0][0] if len(first) == 2 and first[0][1] > first[1][1] else None
    return found, base


def tornado(study, rows, path):
    """Draws the effect of each factor on each measure, the strongest effect on top."""
    names = [name for name in MEASURES if measured(rows, name)]
    heights = max(len(study.factors), 2)
    figure, panels = plt.subplots(2, 2, figsize=(12, 2.4 + 1.1 * heights), squeeze=False, layout="constrained")
    for axes in panels.flat[len(names):]:
        axes.set_visible(False)
    for axes, name in zip(panels.flat, names):
        pairs = measured(rows, name)
        found, base = effects(study, pairs)
        ordered = sorted(found.items(), key=lambda item: max(item[1].values()) - min(item[1].values()))
        for i, (_, means) in enumerate(ordered):
            low, high = (choice(means, key=means.get) for choice in (min, max))
            axes.barh(i, means[high] - means[low], left=means[low], color=COLOURS[0], height=.5, alpha=.8)
            for value, side, shift in ((low, "right", -4), (high, "left", 4)):
                axes.annotate(value, (means[value], i), xytext=(shift, 0), textcoords="offset points", ha=side, va="center", fontsize=8)
        middle = next((value for row, value in pairs if row["scene"] == base), np.mean([value for _, value in pairs]))
        axes.axvline(middle, color=".2", linewidth=1)
        axes.set_title(f"{'base' if base else 'mean of all'} {middle:.3g}", loc="right")
        axes.set_yticks(range(len(ordered)), [short(factor) for factor, _ in ordered])
        ends = [value for means in found.values() for value in means.values()] + [middle]
        room = .2 * (max(ends) - min(ends)) or 1.
        axes.set(xlabel=label_of(name, study), xlim=(min(ends) - room, max(ends) + room))
    save(figure, path)


def independent(factors, rows):
    """The factors without those that follow from another one, as steps follow from a foundation in a table."""
    def follows(entry, other):
        return len({(row[other], row[entry]) for row in rows}) == len({row[other] for row in rows})

    kept = []
    for i, entry in enumerate(factors):
        if not any(follows(entry, other) and (other in kept or not follows(other, entry) or j < i)
                   for j, other in enumerate(factors) if other != entry):
            kept.append(entry)
    return kept


def draw(study, rows, directory):
    """All figures that the study has data for."""
    directory.mkdir(exist_ok=True)
    first = [entry for entry in (study.over, study.records) if entry]
    factors = independent([*first, *(entry for entry in study.factors if entry not in first)], rows)
    study = replace(study, factors=[entry for entry in study.factors if entry in factors or entry in first])
    if study.over and rows:
        incremental(study, rows, directory / "over_scale")
    if study.over and study.records and any(measured(rows, name) for name in study.limits):
        fragility(study, rows, directory / "fragility")
    if len(study.factors) > 1 and len(rows) > 1:
        tornado(study, rows, directory / "tornado")
