# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours and line styles of all figures. Colour-blind readers can tell the colours apart (tests/program_report.py measures it)."""

# Okabe and Ito, Color Universal Design (2002); Wong, Nature Methods 8, 441 (2011). Without yellow, which is too light for lines.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"]
DASHES = ["-", (0, (4, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1))]


def line(number):
    """Style of a line among several, numbered from 0: the colours in turn, then the same colours with other dashes."""
    return {"color": COLOURS[number % len(COLOURS)], "linestyle": DASHES[number // len(COLOURS) % len(DASHES)]}
