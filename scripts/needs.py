#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir needs`: effect of each choice of a scene, and its smallest scene (python/voussoir/needs_command.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.needs_command import main

end_with(main)
