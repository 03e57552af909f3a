# SPDX-License-Identifier: GPL-3.0-or-later
"""`voussoir study`: many scenes and one table of their results (python/voussoir/study.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.command import end_with
from voussoir.study import main

end_with(lambda: main(Path(__file__).resolve().with_name("study_scene.py")))
