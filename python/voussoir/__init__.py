# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs Voussoir and reads its results: tables as numpy arrays by column, summary as a dictionary, meshes by meshio.

    import voussoir
    run = voussoir.run("prm/quickstart.prm", "output/fjb", {"Joints/Model": "FJB", "Motion/Duration": 5.12})
    run.summary["extremes"]["max_opening"]["value"]      # [m]
    run.history["time"], run.history["crest_x"]          # [s], [m]
    voussoir.load("output/quickstart").joints["opening_upstream"].max()
    voussoir.needs("prm/quickstart.prm", 0.05)           # rows: what the scene needs

Files and columns: doc/output.md; SI units. The modules that are not named here belong to the commands (scripts/).
"""

from typing import Any, Dict, List

from .errors import ComputationError, InputError, VoussoirError
from .program import entries_of as scene
from .program import run
from .results import Results, load
from .tables import PathLike, Table

__all__ = ["ComputationError", "InputError", "Results", "Table", "VoussoirError", "load", "needs", "run", "scene"]


def needs(scene_file: PathLike, target: float = 0.05, seconds: float = 5., jobs: int = 2, **options: Any) -> List[Dict[str, Any]]:
    """Computes effect and cost of each modelling choice of a scene, as `voussoir needs`; returns the rows of the table.

    @param target: largest relative change that does not matter
    @param seconds: duration of the strongest motion [s]
    @param options: only (groups, separated by commas), output (directory), settings ("Section/Entry=value"), mesh (coarse or scene)
    Throws InputError and ComputationError with the message of the program if the scene itself fails."""
    from .needs_command import needs as compute  # takes half a second to load
    return compute(scene_file, target, seconds, jobs, **options)
