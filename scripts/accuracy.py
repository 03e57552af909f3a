#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir accuracy`: error against cost of a scene (python/voussoir/accuracy.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.accuracy import main

end_with(main)
