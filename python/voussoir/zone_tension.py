# SPDX-License-Identifier: GPL-3.0-or-later
"""Means of a run's largest tension over zones of the dam's faces: what `voussoir accuracy` measures stresses by."""

import re

import numpy as np

from .tables import read_table

ZONES = 3  # of either face, along and up
FOOT = 0.1  # of the height: nearer to the base is no zone


def is_slice(directory):
    """True if the run is a slice in plane strain, whose sides are free."""
    scene = directory / "scene.prm"
    return scene.exists() and re.search(r"^\s*set Plane strain\s*=\s*true", scene.read_text(encoding="utf-8"), re.M) is not None


def outline(x, corners, free_sides):
    """Positions of the nodes at the edges of the faces, except the crest and free sides at both ends of y: nodes on the base."""
    places = np.round(x[:, :3], 2)
    number = np.unique(places, axis=0, return_inverse=True)[1].ravel()[corners]  # joints have two nodes at each place
    edges = np.sort(np.stack([number, np.roll(number, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    _, first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)[first[count == 1]]
    if free_sides:
        ends = ends[~(np.isin(x[ends, 1], (x[:, 1].min(), x[:, 1].max())).all(axis=1) & (np.ptp(x[ends, 1], axis=1) == 0))]
    below = x[ends, 2].min(axis=1) < x[:, 2].max() - 0.1
    return places[np.unique(ends[below])]


def zone_means(directory):
    """Means of the largest tension [Pa] over the zones of both faces, by the area of their quadrilaterals' parts; and the
    zones' areas [m2]."""
    nodes, quads = read_table(directory / "faces.csv"), read_table(directory / "faces_cells.csv")
    x = np.stack([nodes[k] for k in ("x", "y", "z", "s", "max_principal")], axis=1)
    corners = np.stack([quads[f"n{i}"] for i in range(4)], axis=1).astype(int)
    face = quads["face"]
    parts = 8
    at = (np.arange(parts) + 0.5) / parts
    weights = np.array([[(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b] for a in at for b in at])
    inside = np.einsum("pk,qkc->qpc", weights, x[corners])  # quad, part, column
    diagonals = x[corners[:, 2], :3] - x[corners[:, 0], :3], x[corners[:, 3], :3] - x[corners[:, 1], :3]
    area = np.repeat(np.linalg.norm(np.cross(*diagonals), axis=1) / (2 * parts**2), parts * parts).reshape(len(corners), -1)
    base = outline(x, corners, is_slice(directory))
    foot = FOOT * (x[:, 2].max() - x[:, 2].min())
    means, areas = [], []
    for name in ("upstream", "downstream"):
        s, z, tension, weight = (values[face == name].ravel() for values in (inside[:, :, 3], inside[:, :, 2], inside[:, :, 4], area))
        places = inside[face == name][:, :, :3].reshape(-1, 3)
        far = np.concatenate([np.linalg.norm(part[:, None] - base, axis=2).min(axis=1) > foot
                              for part in np.array_split(places, 1 + len(places) // 2000)])
        for value in (s, z):
            value -= value.min()
            value /= value.max() / ZONES
        zone = np.minimum(s.astype(int), ZONES - 1) * ZONES + np.minimum(z.astype(int), ZONES - 1)
        area_of, sum_of = (np.bincount(zone[far], w[far], ZONES ** 2) for w in (weight, weight * tension))
        means.extend(sum_of / np.maximum(area_of, 1e-300))
        areas.extend(area_of)
    return np.array(means), np.array(areas)
