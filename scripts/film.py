#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a film of the opening dam (python/voussoir/film.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.film import main

end_with(main)
