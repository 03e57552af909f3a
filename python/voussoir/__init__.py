# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs Voussoir and reads its results: tables as numpy arrays by column, summary as a dictionary, meshes by meshio.

    import voussoir
    run = voussoir.run("prm/quickstart.prm", "output/fjb", {"Joints/Model": "FJB", "Motion/Duration": 5.12})
    run.summary["extremes"]["max_opening"]["value"]      # [m]
    run.history["time"], run.history["crest_x"]          # [s], [m]
    voussoir.load("output/quickstart").joints["opening_upstream"].max()

Files and columns: doc/output.md; SI units. The modules that are not named here belong to the commands (scripts/).
"""

from .errors import ComputationError, InputError, VoussoirError
from .program import entries_of as scene
from .program import run
from .results import Results, load
from .tables import Table

__all__ = ["ComputationError", "InputError", "Results", "Table", "VoussoirError", "load", "run", "scene"]
