#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir arcs`: a mesh from a table of arcs (python/voussoir/arch_from_table.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.arch_from_table import main

end_with(main)
