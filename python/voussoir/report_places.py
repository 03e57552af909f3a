# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of results in words: joint or monolith, height and face, instead of coordinates."""

import re
from functools import lru_cache

import numpy as np

from .errors import InputError
from .runs import Skip

NEAR = .02  # of the height of the dam: a node that far from a place is the place
CREST = .01  # of the height below the highest point: the crest
MINUS = "\N{MINUS SIGN}"


def coordinates(place):
    """The place as (x, y, z), without negative zeros."""
    return f"({', '.join(f'{x + 0.:.0f}'.replace('-0', '0').replace('-', MINUS) for x in place)}) m"


class Places:
    """Nodes of joints and faces of a run, for its places in words."""

    def __init__(self, run):
        self.run, self.joints, self.faces = run, None, {}
        try:
            self.faces = run.faces
        except (Skip, InputError, KeyError, ValueError):
            pass
        try:
            table = run.table("joint_points.csv")
            self.joints = {name: table[name] for name in ("joint", "x", "y", "z", "depth")}
        except (Skip, InputError, KeyError):
            pass
        heights = [face["z"] for face in self.faces.values()] or ([] if self.joints is None else [self.joints["z"]])
        self.top, self.bottom = (max(map(np.max, heights)), min(map(np.min, heights))) if heights else (0., 0.)

    @property
    def height(self):
        """Height of the dam [m], 0 if unknown."""
        return float(self.top - self.bottom)

    def level(self, z):
        if z > self.top - CREST * self.height:
            return "crest"
        return "lowest point" if z < self.bottom + CREST * self.height else f"elevation {z + 0.:.0f} m".replace("-", MINUS)

    def on_joint(self, place):
        """As joint 5, crest, upstream; nothing if no node of a joint is near."""
        if self.joints is None:
            return ""
        nodes = np.stack([self.joints[c] for c in "xyz"], axis=1)
        distance = np.linalg.norm(nodes - place, axis=1)
        k = int(distance.argmin())
        if not distance[k] <= NEAR * self.height:
            return ""
        side = self.side(nodes[k]) or ("upstream" if self.joints["depth"][k] < 1e-6 else "")
        return ", ".join(filter(None, (self.run.joint_name(int(self.joints["joint"][k])), self.level(place[2]), side)))

    def side(self, node):
        """Face on which a node of the mesh lies, or nothing."""
        for name, face in self.faces.items():
            if np.abs(np.stack([face[c] for c in "xyz"], axis=1) - node).max(axis=1).min() < 1e-4 * self.height:
                return name
        return ""

    def in_dam(self, place, column="", value=0.):
        """As monolith 4, elevation 137 m, downstream. Of the nodes at the place that with the nearest value of the column decides."""
        found = []
        for name, face in self.faces.items():
            distance = np.linalg.norm(np.stack([face[c] for c in "xyz"], axis=1) - place, axis=1)
            for k in np.flatnonzero(distance <= min(NEAR * self.height, distance.min() + 1e-4 * self.height)):
                apart = abs(float(face[column][k]) - value) if column in face else 0.
                found.append((round(float(distance[k]), 3), apart, name, int(face["monolith"][k])))
        if not found:
            return ""
        _, _, name, monolith = min(found)
        several = len({int(m) for face in self.faces.values() for m in face["monolith"]}) > 1
        return ", ".join(filter(None, (f"monolith {monolith}" if several else "", self.level(place[2]), name)))

    def words(self, key, place, value):
        """Words for the place of an extreme of summary.json, or its coordinates."""
        if not place:
            return ""
        try:
            at = np.array([float(x) for x in place])
            if len(at) == 3 and np.isfinite(at).all():
                if any(word in key for word in ("opening", "slip")):
                    found = self.on_joint(at)
                else:
                    directed = re.match("(arch|cantilever|vertical)_stress_(max|min)", key)
                    found = self.in_dam(at, directed[0] if directed else "min_principal" if "compression" in key else "max_principal", value)
                if found:
                    return found
        except (KeyError, OverflowError, TypeError, ValueError):
            pass
        return f"at {coordinates(place)}"


@lru_cache(maxsize=16)
def places_of(run):
    return Places(run)
