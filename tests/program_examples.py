#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each directory of examples/ but bricks (12 minutes): its command runs without a warning, and its page states the numbers of the run.

    program_examples.py VOUSSOIR CASE...     cases: the names of the directories
"""

import re
import shlex
import sys
from pathlib import Path

from run_program import expect, run_cases, runs, succeeds, summary, voussoir

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "examples" / "snap_back"))
import decay  # noqa: E402
NUMBER = r"(?<![\w.])\d+(?:\.\d+)?(?!\w)"
# Rows of the tables: path in summary.json and factor
TENSION = {f"tensile stress {face}": f"max_tension_{face}_away_from_base" for face in ("upstream", "downstream")}
ROWS = {**{f"{label} [MPa]": (f"extremes/{name}/value", 1e-6) for label, name in TENSION.items()},
        "largest opening [mm]": ("extremes/max_opening/value", 1e3), "largest slip [mm]": ("extremes/max_slip/value", 1e3),
        "opening at the end [mm]": ("residual/max_opening/value", 1e3), "slip at the end [mm]": ("residual/max_slip/value", 1e3),
        "crest at rest, downstream [mm]": ("static/crest_displacement/0", 1e3),
        "crest at rest, downstream of the base [mm]": ("static/crest_displacement/0", 1e3),
        "largest crest acceleration, downstream [g]": ("accelerations/crest/x/value", 1 / 9.80665),
        "compression at the joint, which would crush concrete [MPa]": ("extremes/max_compression/value", -1e-6),
        "largest dynamic water pressure [MPa]": ("water/max_dynamic_pressure/value", 1e-6)}
ENSEMBLE = {"opening [mm]": ("max_opening", 1e3), "slip [mm]": ("max_slip", 1e3), **{f"{label} [MPa]": (name, 1e-6) for label, name in TENSION.items()}}


def value(found, path):
    for name in path.split("/"):
        found = found[int(name) if isinstance(found, list) else name]
    return found


def computed(found, label):
    """The values of a row of a table."""
    if "ensemble" in found:
        name, factor = ENSEMBLE[label]
        return [factor * found["ensemble"][name][end] for end in ("median", "p16", "p84", "min", "max")]
    path, factor = ROWS[label]
    return [factor * value(found, path)]


def swings(name, in_percent):
    """Frequency [Hz] or damping ratio [%] of the first swing and of the last ones, and of the first mode of the tied dam."""
    part, factor = (("frequency", 1), ("ratio", 100))[in_percent]
    mode = re.search(r"^ +1 +([\d.]+) +([\d.]+)$", runs("modes", f"examples/{name}/scene.prm", "--count", "1"), re.M)
    found = [factor * values[part] for values in decay.decay(f"output/{name}").values()] + [float(mode[1 + in_percent])]
    expect(abs(found[1] / found[2] - 1) < .005, f"the last swings and the first mode: {found}")
    return found


def example(name):
    page = (ROOT / "examples" / name / "README.md").read_text()
    expect(len(page.split()) <= 120, f"{len(page.split())} words")
    expect((ROOT / "examples" / name / "figure.png").stat().st_size <= 120e3 and "](figure.png)" in page, "figure")
    Path("examples").symlink_to(ROOT / "examples")
    command, = re.findall(rf"^    voussoir (examples/{name}/scene\.prm --output output/{name})$", page, re.M)
    result = voussoir(*shlex.split(command), "--set", "Output/Figures=false")
    succeeds(result)
    found = summary(f"output/{name}")
    expect(found["warnings"] == [] and "warning" not in result.stdout + result.stderr, f"{found['warnings']}, {result.stderr}")
    rows = re.findall(r"^\| (.*?\[.*?\]) \| (.*) \|$", page, re.M)
    expect(len(rows) > 2, f"rows: {rows}")
    for label, cells in rows:
        stated = re.findall(NUMBER, cells)
        values = swings(name, "[%]" in label) if "swing" in label else computed(found, label)
        print(f"    {label}: {' '.join(stated)}, computed {[float(f'{x:.5g}') for x in values]}")
        expect(len(stated) == len(values), f"{label}: {stated}")
        for digits, x in zip(stated, values):
            half_digit = .501 * 10. ** -len(digits.partition(".")[2])
            expect(abs(float(digits) - x) <= max(half_digit, .01 * abs(x)), f"{label}: {digits} is not {x}")
    # Other numbers of the page are entries of the scene, or years.
    prose = re.sub(r"^(\||    ).*|\]\(.*?\)|\[.*?\]|`.*?`", "", page, flags=re.M)
    entries = re.findall(NUMBER, Path(f"output/{name}/scene.prm").read_text())
    known = {float(x) for x in entries}
    expect(all(float(x) in known or 1900 < float(x) < 2100 for x in re.findall(NUMBER, prose)), f"{re.findall(NUMBER, prose)}")


def case(name):
    def run():
        example(name)
    run.__name__ = name
    return run


if __name__ == "__main__":
    run_cases(*(case(path.parent.name) for path in sorted((ROOT / "examples").glob("*/scene.prm")) if path.parent.name != "bricks"))
