#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program on rock.

    program_rock.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

from program_watch import ROCK, settings
from run_program import run_cases, refused, runs, write_scene


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


if __name__ == "__main__":
    run_cases(sections)
