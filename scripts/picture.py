#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Paints the dam with its joints open (python/voussoir/picture.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.picture import main

end_with(main)
