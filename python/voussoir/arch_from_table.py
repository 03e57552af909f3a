# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes an arch dam of circular arcs from a table: 8-node hexahedra, monoliths that share their nodes, gmsh MSH 2.2.

    voussoir arcs TABLE.csv --output DAM.msh [--joints 10] [--along 40] [--up 10] [--through 2] [--end-height 5] [--rock 150]

Columns of the table [m, degrees]; one arc per line, in any order; lines that begin with # are comments:

    elevation
    upstream_x                crown of the upstream face, x downstream
    upstream_radius           of the upstream face at this elevation
    thickness                 at the crown
    downstream_radius         of the downstream face; upstream_radius - thickness is a concentric arc
    right_angle, left_angle   of the abutments at the upstream arc's centre, from the crown: both positive, growing upwards

Between the arcs all columns are monotone cubic functions of the elevation (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980;
the weighted harmonic mean of Fritsch and Butland). Joints divide the crest into equal parts. On the upstream face all joints and
columns of elements lie in vertical planes normal to the crest, so that free-standing monoliths do not lean. Through the dam they
are radial at every elevation. Each end of the crest has a fixed end wall of height --end-height. With --rock the end walls are
free, and a block of rock supports the base, for Foundation/Model = massless.
"""

import csv
from pathlib import Path

import numpy as np

from .arch_rock import NAMES as ROCK_NAMES, ROCK, add_rock
from .command import Parser
from .errors import InputError

COLUMNS = ("elevation", "upstream_x", "upstream_radius", "thickness", "downstream_radius", "right_angle", "left_angle")
LARGEST = 1e5  # of a table's numbers [m, degrees]
SMALLEST_ANGLE = 2.  # of the crest: 1.4 radians is 80 degrees
MOST_ELEMENTS = 10000, 5000000  # each way, in all
FACES = {1: "base", 2: "upstream", 3: "downstream", 4: "crest"}


def monotone(x, y):
    """The monotone cubic through the points, as a function."""
    step, slope = np.diff(x), np.diff(y) / np.diff(x)
    tangent = np.zeros(len(x))
    for i in range(1, len(x) - 1):
        if slope[i - 1] * slope[i] > 0:
            a, b = 2 * step[i] + step[i - 1], step[i] + 2 * step[i - 1]
            tangent[i] = (a + b) / (a / slope[i - 1] + b / slope[i])
    for end, (i, j) in ((0, (0, 1)), (-1, (-1, -2))):  # three points, without a change of sign
        t = slope[i] if len(x) == 2 else ((2 * step[i] + step[j]) * slope[i] - step[i] * slope[j]) / (step[i] + step[j])
        tangent[end] = 0. if t * slope[i] <= 0 else np.sign(t) * min(abs(t), 3 * abs(slope[i]))

    def value(at):
        i = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
        t = (at - x[i]) / step[i]
        return (y[i] * (1 + 2 * t) * (1 - t)**2 + y[i + 1] * t**2 * (3 - 2 * t)
                + step[i] * (tangent[i] * t * (1 - t)**2 - tangent[i + 1] * t**2 * (1 - t)))

    return value


def read_table(path):
    """{column: values over the elevation, which rises}."""
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
        rows = [(number, [cell.strip() for cell in next(csv.reader([line]))]) for number, line in enumerate(lines, 1)
                if line.strip() and not line.startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"The table {path} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}.") from None
    names = rows[0][1] if len(rows) > 1 else []
    for name in COLUMNS:
        if names.count(name) != 1:
            raise InputError(f"{path}: the column {name} is {'there twice' if name in names else 'missing, or the table is empty'}. "
                             f"The first line must name {', '.join(COLUMNS)}, separated by commas; decimals have a point.")
    for number, row in rows[1:]:
        if len(row) != len(names):
            raise InputError(f"{path}, line {number}: {len(row)} values for {len(names)} columns. Each column needs one.")
    table = {name: np.array([number_of(row[names.index(name)], f"{path}, line {number}, {name}") for number, row in rows[1:]])
             for name in COLUMNS}
    order = np.argsort(table["elevation"])
    table = {name: values[order] for name, values in table.items()}
    check(table, path)
    return table


def number_of(text, place):
    """Throws InputError for what is no number of a dam."""
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not abs(value) <= LARGEST:
        raise InputError(f'{place}: "{text}" must be a number between -{LARGEST:g} and {LARGEST:g}, in metres or degrees.')
    return value


def check(table, path):
    """Throws InputError for arcs that are no dam."""
    if len(table["elevation"]) < 2 or np.diff(table["elevation"]).min() <= 0:
        raise InputError(f"{path}: at least two arcs, of different elevations, are needed.")
    for name in ("upstream_radius", "thickness", "downstream_radius", "right_angle", "left_angle"):
        if table[name].min() <= 0:
            raise InputError(f"{path}: the column {name} must be positive.")
        if "angle" in name and table[name].max() < SMALLEST_ANGLE:
            raise InputError(f"{path}: the column {name} has no angle above {table[name].max():g} degrees, which is no arch. Are they in "
                             "radians? Give degrees.")
    if (table["thickness"] >= table["upstream_radius"]).any():
        raise InputError(f"{path}: an arc is thicker than its upstream radius.")
    centre = table["upstream_x"] + table["upstream_radius"]
    for name in ("right_angle", "left_angle"):
        if table[name].max() >= 85:
            raise InputError(f"{path}: the column {name} must not reach 85 degrees.")
        angle = np.radians(table[name])  # the abutments as seen from the centre of the crest
        seen = np.arctan2(table["upstream_radius"] * np.sin(angle), centre[-1] - centre + table["upstream_radius"] * np.cos(angle))
        if (narrower := np.diff(seen) < -1e-9).any():
            raise InputError(f"{path}: by the column {name} the valley is wider at elevation {table['elevation'][narrower.argmax()]:g} m than at "
                             f"{table['elevation'][narrower.argmax() + 1]:g} m; it must open upwards. Check the angles and the radii there.")


class Dam:
    """Faces of the dam from the table."""

    def __init__(self, table):
        self.low, self.top = table["elevation"][0], table["elevation"][-1]
        self.at = {name: monotone(table["elevation"], table[name]) for name in COLUMNS[1:]}
        self.ends = -np.radians(table["right_angle"][-1]), np.radians(table["left_angle"][-1])

    def on_arc(self, angle, z):
        """The angle at the arc's own centre [rad] of the column that has this angle at the crest: where the vertical plane through the
        crest's centre meets the upstream face; infinite where it does not."""
        radius = self.at["upstream_radius"](z)
        apart = self.centre(self.top) - self.centre(z)
        sine = apart * np.sin(angle) / radius
        return np.where(abs(sine) < 1., angle + np.arcsin(np.clip(sine, -1., 1.)), np.copysign(np.inf, angle))

    def centre(self, z):
        """Place x of the centre of the upstream arc [m]."""
        return self.at["upstream_x"](z) + self.at["upstream_radius"](z)

    def place(self, angle, z, w):
        """The point of the column with this angle at the crest [rad], at an elevation and w from 0 upstream to 1 downstream, along
        the upstream arc's radius."""
        x, radius, thickness, other = (float(self.at[name](z)) for name in
                                       ("upstream_x", "upstream_radius", "thickness", "downstream_radius"))
        angle = float(self.on_arc(angle, z))
        up = np.array([x + radius * (1 - np.cos(angle)), radius * np.sin(angle)])
        inward = np.array([np.cos(angle), -np.sin(angle)])
        to_centre = np.array([x + thickness + other, 0.]) - up
        along = to_centre @ inward
        root = other**2 - (to_centre @ to_centre - along**2)
        length = along - np.sqrt(root) if root > 0 else -1.
        if length <= 0:
            raise InputError(f"The arcs of elevation {z:.1f} m meet before {np.degrees(angle):.1f} degrees. Check its radii and angles.")
        return (*(up + w * length * inward), z)

    def foot(self, angle, end_height):
        """Elevation of the abutment under this angle of the crest."""
        bound = self.at["left_angle" if angle > 0 else "right_angle"]

        def in_rock(z):
            return abs(self.on_arc(angle, z)) > np.radians(bound(z)) + 1e-9

        levels = np.linspace(self.top - end_height, self.low, 1001)
        inside = in_rock(levels)
        if not inside.any():
            return self.low
        first = inside.argmax()
        low, high = levels[first], levels[max(first - 1, 0)]
        for _ in range(60):
            middle = .5 * (low + high)
            low, high = (middle, high) if in_rock(middle) else (low, middle)
        return high


def crest_angles(dam, n):
    """Angles that divide the crest's upstream edge into n equal parts."""
    return np.linspace(*dam.ends, n + 1)


def n_columns(joints, along):
    """Elements along the crest: as many in each monolith."""
    return -(-along // (joints + 1)) * (joints + 1)


def build(dam, joints, along, up, through, end_height):
    """Nodes [m], hexahedra with their monolith, quadrilaterals with their group."""
    columns = n_columns(joints, along)
    per_monolith = columns // (joints + 1)
    number = lambda i, j, k: (i * (up + 1) + j) * (through + 1) + k
    nodes, cells, sides = [], [], []
    for angle in crest_angles(dam, columns):
        foot = dam.foot(angle, end_height)
        for z in np.linspace(foot, dam.top, up + 1):
            nodes += [dam.place(angle, z, k / through) for k in range(through + 1)]
    for i in range(columns):
        for j in range(up):
            for k in range(through):
                # x from k, y from i, z from j
                square = lambda z: [number(i, z, k), number(i, z, k + 1), number(i + 1, z, k + 1), number(i + 1, z, k)]
                low, high = square(j), square(j + 1)
                cells.append((1 + i // per_monolith, low + high))
                for inside, group, quad in ((j > 0, 1, low), (j < up - 1, 4, high),
                                            (i > 0, 1, [low[0], low[1], high[1], high[0]]),
                                            (i < columns - 1, 1, [low[3], low[2], high[2], high[3]]),
                                            (k > 0, 2, [low[0], low[3], high[3], high[0]]),
                                            (k < through - 1, 3, [low[1], low[2], high[2], high[1]])):
                    if not inside:
                        sides.append((group, quad))
    return np.array(nodes), cells, sides


def smallest_jacobian(nodes, cells):
    """Smallest Jacobian of the corners over the product of the edges there; negative if a cell is folded."""
    x = nodes[[cell for _, cell in cells]]
    worst = 1.
    for corner, (a, b, c) in enumerate(((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))):
        edges = [x[:, other] - x[:, corner] for other in (a, b, c)]
        volume = np.einsum("ij,ij->i", np.cross(edges[0], edges[1]), edges[2])
        worst = min(worst, (volume / np.prod([np.linalg.norm(edge, axis=1) for edge in edges], axis=0)).min())
    return worst


def volume_of(nodes, cells):
    """Volume of hexahedra, by six tetrahedra each [m3]."""
    x, total = nodes[[cell for _, cell in cells]], 0.
    for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)):
        total += np.einsum("ij,ij->i", np.cross(x[:, a] - x[:, 0], x[:, b] - x[:, 0]), x[:, 6] - x[:, 0]).sum() / 6
    return total


def write(path, nodes, cells, sides):
    """MSH 2.2; groups by name."""
    volumes = sorted({volume for volume, _ in cells})
    groups = {group for group, _ in sides}
    number = {v: v if v == ROCK else 10 + v for v in volumes}
    names = [f'2 {group} "{name}"' for group, name in {**FACES, **ROCK_NAMES}.items() if group in groups]
    names += [f'3 {number[v]} "{"rock" if v == ROCK else f"monolith {v}"}"' for v in volumes]
    elements = [f"3 2 {group} {group} " + " ".join(str(n + 1) for n in quad) for group, quad in sides]
    elements += [f"5 2 {number[v]} {number[v]} " + " ".join(str(n + 1) for n in cell) for v, cell in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{i} {x:.12g} {y:.12g} {z:.12g}" for i, (x, y, z) in enumerate(nodes, 1)] + ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i} {element}" for i, element in enumerate(elements, 1)] + ["$EndElements", ""]
    try:
        Path(path).write_text("\n".join(lines), encoding="ascii")
    except OSError as error:
        raise InputError(f"The file {path} cannot be written: {error.strerror}.") from None


def main():
    parser = Parser(prog="voussoir arcs", description=__doc__)
    parser.add_argument("table", help="CSV; columns: " + ", ".join(COLUMNS))
    parser.add_argument("--output", required=True, help="the mesh, MSH 2.2")
    parser.add_argument("--joints", type=int, default=10)
    parser.add_argument("--along", type=int, default=40, help="elements along the crest, rounded up to a multiple of the monoliths")
    parser.add_argument("--up", type=int, default=10, help="elements from the base to the crest")
    parser.add_argument("--through", type=int, default=2, help="elements through the thickness")
    parser.add_argument("--end-height", type=float, default=5., help="height of the dam's two ends [m]")
    parser.add_argument("--rock", type=float, default=0., metavar="EXTENT", help="massless rock beside, up- and downstream of and below the dam [m]")
    options = parser.parse_args()
    counts, (each, in_all) = (options.along, options.up, options.through), MOST_ELEMENTS
    if not (0 <= options.joints < 999 and min(counts) > 0 and max(counts) <= each):
        raise InputError(f"--joints must be 0 to 998, --along, --up and --through 1 to {each}.")
    if max(options.along, options.joints + 1) * options.up * options.through > in_all:
        raise InputError(f"--along, --up and --through make more than {in_all} elements. Take fewer.")
    dam = Dam(read_table(options.table))
    if not 0 < options.end_height < dam.top - dam.low:
        raise InputError(f"--end-height must lie between 0 and the height of the dam, {dam.top - dam.low:g} m.")
    if not 0 <= options.rock <= LARGEST or 0 < options.rock < .5 * (dam.top - dam.low):
        raise InputError(f"--rock must be 0 or at least half of the dam's height, {.5 * (dam.top - dam.low):g} m.")
    nodes, cells, sides = build(dam, options.joints, options.along, options.up, options.through, options.end_height)
    n_dam, volume = len(cells), volume_of(nodes, cells)
    if options.rock > 0:
        nodes, cells, sides = add_rock(nodes, cells, sides, (-1, options.up + 1, options.through + 1), options.rock)
    worst = smallest_jacobian(nodes, cells)
    if not worst > 0:  # or not a number
        raise InputError("Elements are folded: the arcs of neighbouring elevations cross, or the end height is too small"
                         + (", or the rock needs another extent." if options.rock else "."))
    write(options.output, nodes, cells, sides)
    edges = np.array([[dam.place(angle, dam.top, side) for angle in crest_angles(dam, n_columns(options.joints, options.along))] for side in (0., 1.)])
    print(f"{options.output}: {len(nodes)} nodes, {n_dam} hexahedra{f' and {len(cells) - n_dam} of rock' if options.rock else ''}, "
          f"{options.joints} joints; height {dam.top - dam.low:g} m, crest "
          f"{np.linalg.norm(np.diff(edges, axis=1), axis=2).sum() / 2:.1f} m, volume {volume:.0f} m3, smallest scaled Jacobian {worst:.2f}")
    return 0
