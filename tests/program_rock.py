#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program on rock.

    program_rock.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import re
from pathlib import Path

from program_watch import ROCK, settings
from run_program import expect, run_cases, refused, runs, summary, table, write_scene


def sections():
    """Sections beside a boundary that does not absorb end at mtf3: what it needs is asked for before the run."""
    write_scene()
    fixed = [*ROCK, *settings("Foundation/Boundary=fixed")]
    runs("scene.prm", "--validate", *fixed)
    beside = "sections of the free field beside the artificial boundary fixed", "mtf3", "Foundation/Free field"
    for needs, entries in (("Poisson's ratio", ["Foundation/Poisson's ratio=0.4", "Foundation/Stiffness damping=0"]),
                           ("Gauss points", ["Foundation/Nodal quadrature everywhere=false",
                                             "Foundation/Nodal layers=2", "Foundation/Stiffness damping=0"])):
        refused(["scene.prm", "--validate", *fixed, *settings(*entries)], *beside, needs)
        runs("scene.prm", "--validate", *fixed, *settings(*entries, "Foundation/Free field=columns"))


def at_dam():
    """With the dam's elements in all of the rock its static state is that of massless rock, which has them; layers at the dam
    bring it near, layers at the boundary stay nodal."""
    write_scene()
    still = settings("Motion/Source=none", "Joints/Model=FJA")

    def crest(directory, *entries):
        runs("scene.prm", "--output", directory, *ROCK, *still, *settings(*entries))
        names, rows = table(f"{directory}/history.csv")
        return [rows[0][names.index(name)] for name in ("crest_x", "crest_z", "base_x")]

    alike = "Foundation/Boundary=fixed", "Foundation/Free field=columns", "Foundation/Nodal layers=0"
    truth = crest("massless", "Foundation/Model=massless")
    off = {}
    for name, entries in (("nodal", ("Foundation/Layers at the dam=0",)), ("two", ("Foundation/Layers at the dam=2",)), ("all", ("Foundation/Layers at the dam=1000",))):
        found = crest(name, *alike, *entries)
        off[name] = max(abs(a - b) for a, b in zip(found, truth)) / max(map(abs, truth))
    print(f"    crest and base off by {off}")
    expect(off["all"] < 1e-8, "all of the rock has the dam's elements")
    expect(off["two"] < .5 * off["nodal"], "layers at the dam")
    same_as_nodal = crest("none", *alike[:2], "Foundation/Nodal layers=1000", "Foundation/Layers at the dam=1000")
    expect(same_as_nodal == crest("plain", *alike, "Foundation/Layers at the dam=0"), "layers at the boundary stay nodal")
    logs = {name: Path(name, "log.txt").read_text() for name in ("nodal", "two", "all", "none")}
    expect("dam's base are as the dam's" not in logs["nodal"], "no layers")
    expect("elements of rock in" not in logs["two"] + logs["all"], "all of the layers")
    expect(re.search(r"warning: (\d+) of \1 elements of rock in .*too stiff", logs["none"]) is not None, "none of the layers")
    expect(summary("none")["rock"]["elements_at_dam"] == 0 < summary("two")["rock"]["elements_at_dam"], "how many there are")


if __name__ == "__main__":
    run_cases(sections, at_dam)
