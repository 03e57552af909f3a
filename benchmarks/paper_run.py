# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of the paper's dam, for paper.py and paper_figures.py."""

import numpy as np

import program  # noqa: F401  for the path of the package
from voussoir.results import read_summary
from voussoir.tables import read_table

LIMIT = 1.5  # MPa, the paper's
FACES = ("upstream", "downstream")


def upper_part(z, s):
    """Returns which places are in the upper part of a face. In the dam of the paper, 210 m high, these are above 150 m and within 150 m
    of the crown; in other dams the shares of the height are the same."""
    height = np.ptp(z)
    return (z >= z.min() + 150. / 210. * height) & (np.abs(s) <= 150. / 210. * height)


def along_y(directory):
    """Returns the largest growth of the distance along y, the axis of the dam, between both sides of each joint (joint, face) [mm],
    or None without probes. At an inclined joint slip has a component along y."""
    history = read_table(directory / "history.csv")
    n = sum(name.startswith("left_upstream_") and name.endswith("_y") for name in history)
    distance = [[history[f"left_{face}_{j}_y"] - history[f"right_{face}_{j}_y"] for face in FACES] for j in range(1, n + 1)]
    return np.array([[1e3 * (d - d[0]).max() for d in faces] for faces in distance]) if n else None


class Run:
    """One run: openings and slips at the crest (joint, face) [mm], envelopes and tensions [MPa]."""

    def __init__(self, directory):
        self.summary = read_summary(directory)
        self.tied = self.summary["law"] == "tied"
        if not self.tied:
            joints = read_table(directory / "joints.csv")
            self.openings, self.slips = (1e3 * np.abs(np.column_stack([joints[f"{what}_{face}"] for face in FACES]))
                                         for what in ("opening", "slip"))
        self.along_y = along_y(directory)
        nodes = read_table(directory / "faces.csv")
        cells = read_table(directory / "faces_cells.csv")
        self.nodes, self.face = nodes, nodes["face"]
        self.tension = nodes["max_principal"] / 1e6
        self.quads = np.stack([cells[f"n{i}"] for i in range(4)], axis=1).astype(int)
        corners = np.stack([nodes[c] for c in "xyz"], axis=1)[self.quads]
        diagonals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        self.area = np.zeros(len(self.face))
        np.add.at(self.area, self.quads.ravel(), np.repeat(np.linalg.norm(diagonals, axis=1) / 8, 4))
        self.upper = upper_part(nodes["z"], nodes["s"])

    def measures(self):
        result = {}
        for face in FACES:
            upper, whole = (self.face == face) & self.upper, self.face == face
            result[f"upper_mean_{face}"] = self.tension[upper].mean()
            for name, part in (("upper", upper), ("whole", whole)):
                below = part & (self.tension < LIMIT)
                result[f"{name}_share_{face}"] = 100 * self.area[below].sum() / self.area[part].sum()
            result[f"whole_mean_{face}"] = np.average(self.tension[whole], weights=self.area[whole])
        extremes = self.summary["extremes"]
        for face in FACES:
            result[f"largest_{face}"] = extremes[f"max_tension_{face}"]["value"] / 1e6
        if not self.tied:
            wide = self.openings.max(axis=1)
            result.update(mean_opening=wide.mean(), largest_opening=wide.max(), first_opening=wide[0],
                          last_opening=wide[-1], inner_opening=wide[1:-1].mean(),
                          mean_slip=self.slips.max(axis=1).mean(), largest_slip=self.slips.max())
        result["newton_mean"], result["newton_max"] = (self.summary["newton_iterations"][k] for k in ("mean", "max"))
        result["energy_balance"] = self.summary["energy_balance_error"]
        return result
