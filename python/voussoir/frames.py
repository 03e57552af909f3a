# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads frames.bin of a run: displacements, stresses, openings and water pressures at the surface of the dam over time.

Format, little-endian: a line of JSON (format, numbers of nodes and quads; stress: false without Output/Envelope interval; pressure:
true with compressible water). Three float32 per node: position [m]. Six int32 per quadrilateral: surface (doc/mesh.md; 100 + K and
200 + K: sides of joint K), monolith, four nodes. Then the frames: float64 time [s]; three float32 units; int16 multiples of them:
displacement relative to the base [m] (three per node), maximum principal stress [Pa], opening [m]; with pressure a float32 unit and
int16 dynamic pressures [Pa]. The largest magnitude of a frame is 32767 times its unit."""

import json
from pathlib import Path

import numpy as np

from .errors import InputError
from .runs import Skip

FORMAT = "voussoir frames 1"
UNITS = ("displacement", "stress", "opening", "pressure")


class Frames:
    """`points` [m]; `surface`, `monolith` and `quads` (four indices into points, counter-clockwise from outside) of each quadrilateral;
    `times` [s]; and numbers of frame k: displacement (n, 3), stress and opening (n), times `units[k]` [m, Pa, m]; with `has_pressure`
    (compressible water) also the dynamic pressure (n) [Pa], 0 at dry nodes. Throws Skip for a run without the file, and InputError for a
    damaged one. An incomplete last frame of an interrupted run is left out."""

    def __init__(self, directory):
        path = Path(directory) / "frames.bin"
        if not path.is_file():
            raise Skip("no frames.bin: Output/Frames is 0")
        data = path.read_bytes()
        try:
            head, begin = json.loads(data[:data.index(b"\n")]), data.index(b"\n") + 1
            if head["format"] != FORMAT:
                raise ValueError(f"its format is {head['format']!r}, not {FORMAT!r}")
            n, m, self.has_stress = int(head["nodes"]), int(head["quads"]), bool(head["stress"])
            self.points = np.frombuffer(data, "<f4", 3 * n, begin).reshape(n, 3)
            cells = np.frombuffer(data, "<i4", 6 * m, begin + 12 * n).reshape(m, 6)
            self.has_pressure = bool(head.get("pressure"))
            kind = np.dtype([("time", "<f8"), ("units", "<f4", 3), ("displacement", "<i2", (n, 3)), ("stress", "<i2", n), ("opening", "<i2", n)]
                            + [("pressure_unit", "<f4"), ("pressure", "<i2", n)] * self.has_pressure)
            begin += 12 * n + 24 * m
            frames = np.frombuffer(data, kind, (len(data) - begin) // kind.itemsize, begin)
            units = frames["units"].astype(float)
            if self.has_pressure:
                units = np.column_stack([units, frames["pressure_unit"].astype(float)])
            self.surface, self.monolith, self.quads = cells[:, 0], cells[:, 1], cells[:, 2:]
            if not (n > 0 and m > 0 and len(frames) and self.quads.min() >= 0 and self.quads.max() < n and np.isfinite(self.points).all()
                    and np.isfinite(units).all() and np.isfinite(frames["time"]).all()):
                raise ValueError("its numbers are not possible")
        except (ValueError, LookupError, TypeError, OverflowError, RecursionError) as error:
            raise InputError(f"{path} is damaged: it cannot be decoded ({error}). Repeat the run.") from error
        self.times, self.units, self.numbers = frames["time"], units, frames

    def values(self, what, chosen):
        """Displacement [m], stress [Pa], opening [m] or pressure [Pa] of these frames: (frame, node, ...)."""
        numbers = self.numbers[what][chosen].astype(np.float32)
        units = self.units[chosen, UNITS.index(what)].astype(np.float32)
        return numbers * units.reshape(-1, *(1,) * (numbers.ndim - 1))

    def strongest(self, count):
        """The `count` consecutive frames that include the largest opening (without joints: displacement from the first frame) and have
        the largest sum of squared displacements from the first frame. The first frame of all is the static state, and no part of them unless it is alone."""
        n = len(self.times)
        if n - 1 <= count:
            return np.arange(min(1, n - 1), n)
        moved = self.values("displacement", np.arange(n))
        square = ((moved - moved[0])**2).sum(axis=(1, 2))
        largest = self.values("opening", np.arange(n)).max(axis=1)
        peak = 1 + int(np.argmax(largest[1:] if largest.any() else square[1:]))
        sums = np.concatenate([[0.], np.cumsum(square)])
        begins = np.arange(max(1, peak - count + 1), min(peak, n - count) + 1)
        begin = begins[np.argmax(sums[begins + count] - sums[begins])]
        return np.arange(begin, begin + count)


def edges_of(frames):
    """Edges between two surfaces, such as joints and the crest: pairs of nodes; and the joint of each (0: none)."""
    found = {}
    for surface, quad in zip(frames.surface.tolist(), frames.quads.tolist()):
        for a, b in zip(quad, quad[1:] + quad[:1]):
            found.setdefault((min(a, b), max(a, b)), []).append(surface)
    outline = [(edge, surfaces) for edge, surfaces in found.items() if len(set(surfaces)) > 1 or len(surfaces) == 1]
    joints = [max((joint_of(surface) for surface in surfaces), default=0) for _, surfaces in outline]
    return np.array([edge for edge, _ in outline]), np.array(joints)


def joint_of(surface):
    """Joint of a surface 10000 + j or 20000 + j (before version 0.6 100 + j or 200 + j); 0 for other surfaces."""
    size = 10000 if surface > 10000 else 100
    return surface % size if size < surface < 3 * size else 0
