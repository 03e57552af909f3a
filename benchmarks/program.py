# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program for the other scripts of this directory, on one thread, and measures its CPU time.

The import of this module puts the package voussoir of these sources on the path."""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))
from voussoir.program import set_options
from voussoir.results import read_summary


def add_program_argument(parser):
    parser.add_argument("--voussoir", default=str(ROOT / "build" / "voussoir"), help="the program")


def run(program, *arguments, settings=None):
    """What the program printed, and its CPU seconds. `settings` are entries of the scene and their values."""
    command = [str(word) for word in (program, *arguments, *set_options(settings))]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode:
        raise SystemExit(f"{' '.join(command)} failed ({result.returncode}):\n{result.stdout[-1500:]}{result.stderr}")
    return result.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def simulate(program, scene, settings=None, output=None):
    """Runs a scene; returns its summary.json and its directory (temporary, if not given)."""
    with tempfile.TemporaryDirectory() as temporary:
        directory = Path(output or temporary)
        _, seconds = run(program, scene, "--output", directory,
                         settings={"Output/Figures": "false", **(settings or {})})
        summary = read_summary(directory)
    summary["seconds"]["cpu"] = seconds
    return summary


def frequencies(program, scene, count, settings=None):
    """Natural frequencies [Hz] of the tied dam, and CPU seconds."""
    text, seconds = run(program, "modes", scene, "--count", count, settings=settings)
    rows = [line.split() for line in text.splitlines()]
    return [float(row[1]) for row in rows if len(row) == 3 and row[0].isdigit()], seconds
