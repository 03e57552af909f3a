#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of runs; exit status 3 without numpy or matplotlib (python/voussoir/figures.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
try:
    from voussoir.figures import main
except ImportError as error:
    print(f"{sys.executable}: {error}")
    sys.exit(3)
sys.exit(main())
