# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one scene of a study (python/voussoir/study_scene.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.study_scene import main

sys.exit(main(*sys.argv[1:]))
