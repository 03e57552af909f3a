# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads Voussoir's files and compares numbers with a limit each; writes simple scenes."""

import base64
import re
import struct
import zlib
from pathlib import Path

from run_program import expect, write

class Worst:
    """The largest difference over its limit, of each thing that was compared."""

    def __init__(self, name):
        self.name, self.worst = name, {}

    def close(self, what, ours, theirs, limit, size=None):
        """|ours - theirs| <= limit size, size: |theirs| if not given."""
        size = abs(theirs) if size is None else size
        error = abs(ours - theirs) / size if size else float(ours != theirs)
        if not error <= self.worst.get(what, (-1.,))[0]:
            self.worst[what] = (error, limit, f"{ours:.9g}", f"{theirs:.9g}")

    def rows(self, what, ours, theirs, limit):
        """Tables, each column over its largest value."""
        expect(len(ours) == len(theirs), f"{self.name}, {what}: {len(ours)} rows instead of {len(theirs)}")
        sizes = [max(map(abs, column)) for column in zip(*theirs)]
        for a, b in zip(ours, theirs):
            expect(len(a) == len(b), f"{self.name}, {what}: {len(a)} columns instead of {len(b)}")
            for x, y, size in zip(a, b, sizes):
                self.close(what, x, y, limit, size or 1.)

    def done(self):
        for what, (error, limit, ours, theirs) in self.worst.items():
            print(f"    {self.name}: {what}: {ours} instead of {theirs}, difference {error:.1e}, limit {limit:.0e}")
        for what, (error, limit, ours, theirs) in self.worst.items():
            expect(error <= limit, f"{self.name}: {what} is {ours} instead of {theirs}: {error:.2e}, limit {limit:.0e}")


def read_vtu(file):
    """The points and the fields at them, of a VTU file as deal.II writes it (zlib in base64)."""
    text = Path(file).read_text(errors="replace")
    kinds = {"Float32": "f", "Int32": "i", "UInt8": "B", "Float64": "d"}

    def values(kind, data):
        data = data.strip()
        head = base64.b64decode(data[:8])
        (blocks,) = struct.unpack("<I", head[:4])
        length = -(-(3 + blocks) * 4 // 3) * 4
        sizes = struct.unpack(f"<{3 + blocks}I", base64.b64decode(data[:length])[:4 * (3 + blocks)])[3:]
        body, out, at = base64.b64decode(data[length:]), b"", 0
        for size in sizes:
            out += zlib.decompress(body[at:at + size])
            at += size
        return struct.unpack(f"<{len(out) // struct.calcsize(kinds[kind])}{kinds[kind]}", out)

    arrays = re.findall(r'<DataArray type="(\w+)"([^>]*)>\s*(.*?)\s*</DataArray>', text, re.S)
    fields = {}
    for kind, attributes, data in arrays:
        name = re.search(r'Name="([^"]*)"', attributes)
        n = int((re.search(r'NumberOfComponents="(\d+)"', attributes) or [0, 1])[1])
        x = values(kind, data)
        fields[name[1] if name else "points"] = [x[i:i + n] for i in range(0, len(x), n)] if n > 1 else list(x)
    return fields


def key(x):
    return tuple(int(round(100 * c)) for c in x)  # 10 mm: places are in single precision


def at_places(fields, names):
    """The different rows of the fields `names` (numbers or vectors) at each place: one for each monolith there."""
    result = {}
    for k, p in enumerate(fields["points"]):
        row = []
        for name in names:
            x = fields[name][k]
            row += list(x) if isinstance(x, tuple) else [x]
        rows = result.setdefault(key(p), [])
        if row not in rows:
            rows.append(row)
    return result


def principal(s):
    """Largest and smallest eigenvalue of the stress xx yy zz xy yz zx: the roots of the characteristic polynomial,
    from their invariants by Newton's method from both ends."""
    i1 = s[0] + s[1] + s[2]
    i2 = s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3]**2 - s[4]**2 - s[5]**2
    i3 = (s[0] * s[1] * s[2] + 2 * s[3] * s[4] * s[5] - s[0] * s[4]**2 - s[1] * s[5]**2 - s[2] * s[3]**2)
    bound = max(abs(s[0]) + abs(s[3]) + abs(s[5]), abs(s[1]) + abs(s[3]) + abs(s[4]), abs(s[2]) + abs(s[4]) + abs(s[5]))
    ends = []
    for x in (bound, -bound):  # Gershgorin: monotone from outside
        for _ in range(200):
            slope = 3 * x * x - 2 * i1 * x + i2
            if slope == 0:
                break
            step = (((x - i1) * x + i2) * x - i3) / slope
            x -= step
            if abs(step) <= 1e-13 * bound:
                break
        ends.append(x)
    return ends


STRESS = [f"stress_{c}" for c in ("xx", "yy", "zz", "xy", "yz", "zx")]


def table_with_names(file):
    rows = [line.split(",") for line in Path(file).read_text().splitlines()]
    return rows[0], rows[1:]


E, DENSITY, GRAVITY = 20e9, 2500., 10.


def scene(name, mesh, **sections):
    """A scene without water, damping, joints and motion, unless `sections` says otherwise (Section={entry: value})."""
    entries = {
        "Mesh": {"Source": "file", "File": mesh},
        "Concrete": {"Young's modulus": E, "Poisson's ratio": 0, "Density": DENSITY},
        "Damping": {"Ratio": 0}, "Joints": {"Model": "tied"}, "Motion": {"Source": "none"},
        "Reservoir": {"Water level": 60, "Density": 0, "Model": "none"},
        "Statics": {"Self-weight": "none", "Gravity": GRAVITY}, "Elements": {}, "Foundation": {}, "Dynamics": {},
        "Output": {"Figures": "false", "Checkpoint interval": 0, "Solution interval": 1000000}}
    for section, values in sections.items():
        entries[section] = {**entries[section], **values}
    return write(f"{name}.prm", "".join(
        f"subsection {section}\n" + "".join(f"  set {k} = {v}\n" for k, v in values.items()) + "end\n"
        for section, values in entries.items()))
