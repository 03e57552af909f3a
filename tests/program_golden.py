#!/usr/bin/env python3
"""The whole program against numbers from outside: closed forms, CalculiX, and a second program (golden/).

    program_golden.py VOUSSOIR CASE...     cases: see the functions with that name below

Each number's source is named where it stands; doc/verification.md has the table of what is compared and how closely."""

import base64
import json
import math
import os
import re
import shutil
import struct
import sys
import zlib
from pathlib import Path

from run_program import expect, runs, summary, table, write

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes  # noqa: E402
import scenes  # noqa: E402


# Reading and comparing

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


# The second program (golden/dam_reference.py)

def same_as_reference(name, limit=2e-6, stress=5e-5):
    """All files of a scene against reference_NAME.json. Tables have eight digits, the reference seven; stresses are in
    single precision."""
    scene, reference = scenes.SCENES[name], json.loads((GOLDEN / f"reference_{name}.json").read_text())
    write(f"{name}.prm", scenes.prm(scene, "."))
    shown, every, check = runs(f"{name}.prm", "--output", name), scene["every"], Worst(name)
    result = summary(name)
    match = re.search(r"added mass \w+ x \S+, (\S+) kg along x", shown)
    check.close("added mass", float(match[1]), reference["added_mass"], 1e-3)  # four digits
    if reference["frequencies"]:
        lines = [line.split() for line in runs("modes", f"{name}.prm", "--count", "4").splitlines()]
        ours = [float(line[1]) for line in lines if len(line) == 2 and line[0].isdigit()]
        check.rows("frequencies", [ours], [reference["frequencies"]], 1e-5)
    for a, b in zip(result["static"]["crest_displacement"], reference["static_crest"]):
        check.close("static crest", a, b, limit, math.hypot(*reference["static_crest"]))
    columns, rows = table(f"{name}/history.csv")
    expect(columns == ["time", "crest_x", "crest_y", "crest_z", "base_acceleration_x", "base_acceleration_y",
                       "base_acceleration_z"], f"columns {columns}")
    check.rows("history", rows[::every], reference["history"], limit)
    for number, row in enumerate(scenes.motion(scene)):
        for c in range(3):
            check.close("base acceleration", rows[number][4 + c], row[c], 1e-7, 1.)
    columns, rows = table(f"{name}/energy.csv")
    expect(columns == ["time", "kinetic", "strain", "added_mass", "damping", "friction", "impact", "input", "balance"],
           f"columns {columns}")
    largest = max(row[7] for row in reference["energy"])
    for a, b in zip(rows[::every], reference["energy"]):
        for c, column in enumerate(columns[:8]):
            check.close(f"energy, {column}", a[c], b[c], limit, largest if c else 1.)
        check.close("energy, balance", a[8], 0., 1e-7, largest)
    columns, rows = table(f"{name}/joint_history.csv")
    n_joints = max((len(row) - 1 for row in rows)) // 4
    expect(columns == ["time"] + [f"{q}_{j}" for j in range(1, n_joints + 1) for q in (
        "opening_upstream", "opening_downstream", "slip_upstream", "slip_downstream")], f"columns {columns}")
    if scene["law"] != "tied":
        joint_limits(check, name, reference, rows[::every], result)
    envelopes(check, name, reference, result, stress)
    check.done()


def joint_limits(check, name, reference, rows, result):
    """Openings and slips within 0.01 mm, peaks over all steps included."""
    for a, b in zip(rows, reference["joint_history"]):
        for x, y in zip(a, b):
            check.close("joint history [m]", x, y, 1e-5, 1.)
    columns, rows = table(f"{name}/joints.csv")
    expect(columns == ["joint", "s", "opening_upstream", "opening_downstream", "slip_upstream", "slip_downstream",
                       "time_of_max_opening"], f"columns {columns}")
    expect(len(rows) == len(reference["joints"]), f"{len(rows)} joints")
    for j, (a, b) in enumerate(zip(rows, reference["joints"]), 1):
        expect(a[0] == j, f"joint {a[0]} in line {j}")
        check.close("arc length", a[1], b[0], 1e-6, 100.)
        for x, y in zip(a[2:6], b[1:5]):
            check.close("peaks of the joints [m]", x, y, 1e-5, 1.)
        check.close("time of the peak [s]", a[6], b[5], 1e-6, 1.)
    for what in ("max_opening", "max_slip"):
        (value, (first, last), place), ours = reference[what], result["extremes"][what]
        if value < 1e-9:  # no slip
            check.close(f"{what} [m]", ours["value"], 0., 1e-9, 1.)
            continue
        check.close(f"{what} [m]", ours["value"], value, 1e-5, 1.)
        check.close(f"time of {what} [s]", ours["time"], min(max(first, ours["time"]), last), 1e-6, 1.)
        check.rows(f"place of {what}", [ours["place"]], [place], 1e-4)


def envelopes(check, name, reference, result, limit):
    """faces.csv, envelope.vtu, the last solution and the extremes, self-weight included."""
    columns, rows = table_with_names(f"{name}/faces.csv")
    expect(columns == ["face", "monolith", "x", "y", "z", "s", "max_principal", "min_principal"], f"columns {columns}")
    faces = {(row[0], int(row[1]), key(map(float, row[2:5]))): [float(x) for x in row[6:8]] for row in rows}
    size = max(abs(x) for face in reference["faces"].values() for row in face for x in row[4:6])
    everywhere = at_places(read_vtu(f"{name}/envelope.vtu"), ["max_principal", "min_principal"])
    count = 0
    for face, nodes in reference["faces"].items():
        for monolith, *place, high, low in nodes:
            ours = faces[face, monolith, key(place)]
            check.close("largest principal stress", ours[0], high, limit, size)
            check.close("smallest principal stress", ours[1], low, limit, size)
            nearest = min(everywhere[key(place)], key=lambda row: abs(row[0] - high) + abs(row[1] - low))
            check.close("envelope.vtu", nearest[0], high, limit, size)
            check.close("envelope.vtu", nearest[1], low, limit, size)
            count += 1
    expect(count == len(faces), f"{len(faces)} nodes of the faces instead of {count}")
    for what in ("max_tension_upstream", "max_tension_downstream", "max_compression"):
        (value, time, place), ours = reference[what], result["extremes"][what]
        check.close(what, ours["value"], value, limit, size)
        check.close(f"time of {what} [s]", ours["time"], time, 1e-6, 1.)
        check.rows(f"place of {what}", [ours["place"]], [place], 1e-4)
    last = sorted(Path(name).glob("solution-*.vtu"))[-1]
    fields = at_places(read_vtu(last), ["displacement", *STRESS, "max_principal", "min_principal"])
    move = max(abs(x) for row in reference["last"] for x in row[4:7])
    size = max(abs(x) for row in reference["last"] for x in row[7:])
    for monolith, *row in reference["last"]:
        nearest = min(fields[key(row[:3])], key=lambda r: max(abs(a - b) for a, b in zip(r[3:], row[6:])))
        for a, b in zip(nearest[:3], row[3:6]):
            check.close("last displacement", a, b, 1e-5, move)
        for a, b in zip(nearest[3:9], row[6:]):
            check.close("last stress", a, b, limit, size)
        for a, b in zip(nearest[9:], principal(row[6:])):
            check.close("last principal stress", a, b, limit, size)


def table_with_names(file):
    rows = [line.split(",") for line in Path(file).read_text().splitlines()]
    return rows[0], rows[1:]


def peaks():
    """The jointed arch of six monoliths: openings and slips of all joints to 0.01 mm."""
    same_as_reference("s1k_fja")
    same_as_reference("s1k_fjb")


def reference():
    """Added mass by global and local depth, staged weight, elements with modes and of degree 2, formats of the motion."""
    for name in ("tied", "modes", "degree2", "tied_modes"):
        same_as_reference(name)


def calculix():
    """CalculiX on the same mesh (golden/make_calculix.py): plain elements as closely as it prints, C3D8I as closely as the
    two kinds of modes agree. Limits: displacements, stresses, frequencies, history."""
    golden = json.loads((GOLDEN / "calculix.json").read_text())
    for element, limits in (("C3D8", (5e-6, 1e-4, 2e-6, 2e-6)), ("C3D8I", (.01, .06, .01, .03))):
        check, theirs = Worst(element), golden[element]
        write(f"{element}.prm", scenes.calculix_prm(".", element == "C3D8"))
        runs(f"{element}.prm", "--output", element)
        fields = at_places(read_vtu(f"{element}/solution-00000.vtu"), ["displacement", *STRESS])
        sizes = [max(math.hypot(*row[3:6]) for row in theirs["nodes"]), max(abs(x) for row in theirs["nodes"] for x in row[6:])]
        for row in theirs["nodes"]:
            (ours,) = fields[key(row[:3])] if len(fields[key(row[:3])]) == 1 else [None]
            if ours is None:  # on a joint each monolith has its own stress
                continue
            for c, (a, b) in enumerate(zip(ours, row[3:])):
                check.close(["static displacement", "static stress"][c >= 3], a, b, limits[c >= 3], sizes[c >= 3])
        lines = [line.split() for line in runs("modes", f"{element}.prm", "--count", "6").splitlines()]
        for row in lines[-6:]:
            check.close("frequency", float(row[1]), theirs["frequencies"][int(row[0]) - 1], limits[2])
        result, (_, rows) = summary(element), table(f"{element}/history.csv")
        check.rows("crest", [result["static"]["crest_point"]], [theirs["crest"]], 1e-6)
        every, n = scenes.CALCULIX["every"], len(theirs["history"])
        ours = [[row[0]] + [x - y for x, y in zip(row[1:4], rows[0][1:4])] for row in rows[1::every]]
        check.rows("history", ours[:n], theirs["history"], limits[3])
        check.done()


# Closed forms

E, DENSITY, GRAVITY = 20e9, 2500., 10.


def scene(name, mesh, **sections):
    """A scene without water, damping, joints and motion, unless `sections` says otherwise (Section={entry: value})."""
    entries = {
        "Mesh": {"Source": "file", "File": mesh},
        "Concrete": {"Young's modulus": E, "Poisson's ratio": 0, "Density": DENSITY},
        "Damping": {"Ratio": 0}, "Joints": {"Model": "tied"}, "Motion": {"Source": "none"},
        "Reservoir": {"Water level": 60, "Density": 0, "Added mass": "none"},
        "Statics": {"Self-weight": "none", "Gravity": GRAVITY}, "Elements": {}, "Foundation": {}, "Dynamics": {},
        "Output": {"Figures": "false", "Checkpoint interval": 0, "Solution interval": 1000000}}
    for section, values in sections.items():
        entries[section] = {**entries[section], **values}
    return write(f"{name}.prm", "".join(
        f"subsection {section}\n" + "".join(f"  set {k} = {v}\n" for k, v in values.items()) + "end\n"
        for section, values in entries.items()))


def face_rows(directory):
    """Rows of face, x, y, z, s, largest and smallest principal stress."""
    return [[row[0], *map(float, row[2:])] for row in table_with_names(f"{directory}/faces.csv")[1]]


def weight():
    """A column of height H = 60 m and n = 12 rows, Poisson's ratio 0: stress -rho g (H - z) between rows, the mean of a row at
    its ends, top settles rho g H^2/(2 E): exact for linear elements. The same in feet (0.3048 m)."""
    check, H, n = Worst("weight"), 60., 12
    meshes.wall("wall.msh")
    nodes, hexes, quads = meshes.block(lambda i, j, k: (5 * j, 10 * (i - .5), 5 * k), (1,), 2, n, meshes.DAM | {
        "right": None, "left": None})
    meshes.write("feet.msh", nodes, hexes, quads, 1 / .3048)
    for how in ("staged", "monolithic"):
        for unit, mesh in (("m", "wall.msh"), ("ft", "feet.msh")):
            name = f"weight_{how}_{unit}"
            runs(scene(name, mesh, Mesh={"Length unit": unit}, Statics={"Self-weight": how}), "--output", name)
            result = summary(name)
            check.close("volume [m3]", result["mesh"]["volume"], 6000., 1e-9)
            check.close("crest length [m]", result["mesh"]["crest_length"], 10., 1e-9)
            settled = -DENSITY * GRAVITY * H**2 / 2 / E
            u = [result["static"][f"{k}crest_displacement"][2] for k in ("self_weight_", "")]
            check.close(f"settlement of the top, {how}", u[how == "monolithic"], settled, 1e-9)
            check.close(f"and the other way, {how}", u[how == "staged"], 0., 1e-12, -settled)
            for face, x, y, z, s, high, low in face_rows(name):
                depth = H - z if 0 < z < H else H / n / 2 if z else H - H / n / 2
                check.close(f"stress, {how}", low, -DENSITY * GRAVITY * depth, 2e-6, DENSITY * GRAVITY * H)
                check.close(f"largest stress, {how}", high, 0., 2e-6, DENSITY * GRAVITY * H)
            least = result["extremes"]["max_compression"]
            check.close("extreme", least["value"], -DENSITY * GRAVITY * (H - H / n / 2), 2e-6)
            check.close("its height", least["place"][2], 0., 1e-9, 1.)
            zz = [(p[2], row[2], row[:2] + row[3:]) for p, row in zip(*stress_at_places(name))]
            for z, vertical, others in zz:
                depth = H - z if 0 < z < H else H / n / 2 if z else H - H / n / 2
                check.close("stress_zz", vertical, -DENSITY * GRAVITY * depth, 2e-6, DENSITY * GRAVITY * H)
                check.close("the other components", max(map(abs, others)), 0., 2e-6, DENSITY * GRAVITY * H)
    check.done()


def stress_at_places(directory):
    fields = read_vtu(f"{directory}/solution-00000.vtu")
    return fields["points"], list(zip(*(fields[c] for c in STRESS)))


def water():
    """Hydrostatic pressure: Lame's stresses of a closed tower, a cantilever wall by beam theory with shear, an arch ring by the
    elastic centre."""
    check, unit = Worst("water"), 1000. * GRAVITY
    # Lame: p(z) = g rho (H - z) outside; a thick tube whose pressure is linear along its axis has his stresses at each z.
    # A thin tube, so that what its foot does has died out there: sqrt(r t) = 11 m.
    a, b, H, level = 26., 30., 120., 75.
    for degree, around in ((1, 48), (2, 32)):
        name = f"ring_{degree}"
        meshes.ring(f"{name}.msh", around, 2, 8, a, b, H)
        runs(scene(name, f"{name}.msh", Reservoir={"Water level": H, "Density": 1000}, Elements={"Degree": degree}), "--output", name)
        n = 0
        for face, x, y, z, s, high, low in face_rows(name):
            if abs(z - level) > 1e-6:
                continue
            p, n = unit * (H - z), n + 1
            hoop = -2 * p * b**2 / (b**2 - a**2) if face == "downstream" else -p * (b**2 + a**2) / (b**2 - a**2)
            check.close(f"Lame's hoop stress, {face}, degree {degree}", low, hoop, .02 if degree == 1 else .01)
            check.close(f"largest stress, {face}, degree {degree}", high, 0., .03, -hoop)
        expect(n == degree * 2 * around, f"{n} nodes at {level} m")
    # Cantilever: load q = rho g b (H - z): q0 H^4/(30 E I) + q0 H^2/(6 k G A), k = 5/6; G = E/2.
    meshes.wall("wall.msh", n_through=4, n_up=24)
    runs(scene("wall", "wall.msh", Reservoir={"Density": 1000}), "--output", "wall")
    H = 60.
    q0, I, A = unit * 10. * H, 10. * 10.**3 / 12, 100.
    tip = q0 * H**4 / 30 / E / I + q0 * H**2 / 6 / (5 / 6 * E / 2 * A)
    check.close("cantilever's tip", summary("wall")["static"]["crest_displacement"][0], tip, .01)
    # Bending stress M/W = (q0 (H - z)^3/(6 H))/W: tension upstream, compression downstream
    for face, x, y, z, s, high, low in face_rows("wall"):
        if abs(z - 15) < 1e-6:
            bending = q0 * (H - z)**3 / 6 / H / (10. * 10.**2 / 6)
            check.close(f"bending stress, {face}", high if face == "upstream" else low,
                        bending if face == "upstream" else -bending, .02)
    # The ring, held at its ends, under the mean pressure over its height (Poisson's ratio 0: the mean over the height is plane).
    r, t, height, half = 50., 5., 10., math.radians(60.)
    meshes.slab("slab.msh")
    middle = r - r * math.cos(0.)
    runs(scene("slab", "slab.msh", Reservoir={"Water level": height, "Density": 1000}), "--output", "slab")
    fields = at_places(read_vtu("slab/solution-00000.vtu"), ["displacement"])
    crown = [rows[0][0] for p, rows in fields.items() if p[0] == round(100 * middle) and p[1] == 0]
    expect(len(crown) == 3, f"{len(crown)} nodes on the crown's axis")
    mean = (crown[0] + 2 * crown[1] + crown[2]) / 4
    check.close("arch ring's crown", mean, arch_crown(unit * height / 2, r, t, half), .01)
    check.done()


def arch_crown(pressure, r, t, half, n=2000):
    """Displacement of the crown of a fixed arch ring under uniform pressure on its extrados: Castigliano with bending, thrust
    and shear of the curved beam (unit width)."""
    p = pressure * (r + t / 2) / r
    I, A, K = t**3 / 12, t, 5 / 6 * t / 2  # of E
    angles = [half * (i + .5) / n for i in range(n)]
    ds = r * half / n

    def forces(moment, thrust, load, push):
        """Bending, thrust, shear from moment and thrust at the crown, pressure, and a downstream force at the crown."""
        for f in angles:
            yield (moment - thrust * r * (1 - math.cos(f)) + load * r * r * (1 - math.cos(f)) + push / 2 * r * math.sin(f),
                   thrust * math.cos(f) + load * r * (1 - math.cos(f)) + push / 2 * math.sin(f),
                   -thrust * math.sin(f) + load * r * math.sin(f) + push / 2 * math.cos(f))

    def work(one, two):
        return sum((a[0] * b[0] / I + a[1] * b[1] / A + a[2] * b[2] / K) for a, b in zip(one, two)) * ds / E

    unit_m, unit_n, loaded, push = (list(forces(*x)) for x in ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, p, 0), (0, 0, 0, 1)))
    a, b, c = work(unit_m, unit_m), work(unit_m, unit_n), work(unit_n, unit_n)
    d, e = -work(unit_m, loaded), -work(unit_n, loaded)
    moment, thrust = (d * c - b * e) / (a * c - b * b), (a * e - b * d) / (a * c - b * b)
    whole = list(forces(moment, thrust, p, 0.))
    return 2 * work(whole, push)


def added_mass():
    """Westergaard: 7/8 rho sqrt(H h) integrated over a face normal to x is 7/12 rho b H^2 where the depth H is the same
    everywhere; over a valley with the local depth H(y) it is the integral of 7/12 rho H(y)^2, with the greatest H0 everywhere
    that of 7/12 rho sqrt(H0) H(y)^1.5. By the nodes' areas (trapezoids in sqrt(h)) a little less."""
    check = Worst("added mass")
    westergaard = {"Density": 1000, "Added mass": "Westergaard"}

    def total(name, mesh, **entries):
        shown = runs(scene(name, mesh, Reservoir={**westergaard, **entries}), "--validate")
        return float(re.search(r"(\S+) kg along x", shown)[1])

    meshes.wall("wall.msh", n_through=1, n_up=60)
    n, H, b = 60, 60., 10.
    nodal = 7 / 8 * 1000 * b * H / n * (H / 2 + sum(math.sqrt(H * (H - H * k / n)) for k in range(1, n)))
    for depth in ("global", "local"):
        check.close("wall, by its nodes", total("wall", "wall.msh", Depth=depth), nodal, 5e-4)
        check.close("wall", total("wall", "wall.msh", Depth=depth), 7 / 12 * 1000 * b * H**2, 2e-3)
    check.close("wall, factor 0.5", total("wall", "wall.msh", Factor=.5), 7 / 24 * 1000 * b * H**2, 2e-3)
    check.close("wall, 30 m of water", total("wall", "wall.msh", **{"Water level": 30}), 7 / 12 * 1000 * b * 30.**2, 6e-3)
    # H from 20 to 60 m over 40 m on both sides
    meshes.valley("valley.msh")
    local = 2 * 40 / 40 * 7 / 12 * 1000 * (60**3 - 20**3) / 3
    world = 2 * 40 / 40 * 7 / 12 * 1000 * math.sqrt(60) * (60**2.5 - 20**2.5) / 2.5
    check.close("valley, local depth", total("valley", "valley.msh", Depth="local"), local, 6e-3)
    check.close("valley, global depth", total("valley", "valley.msh", Depth="global"), world, 6e-3)
    check.done()


def oscillator():
    """One element, Poisson's ratio 0, shaken vertically: a damped oscillator of w = sqrt(2 E/rho)/H, exactly (half the mass is
    on the base). At resonance with a sine of amplitude a from rest: u = a/(2 xi w^2) ((cos w t) - exp(-xi w t)(cos w' t + ...)),
    both Rayleigh frequencies with the damping ratio given; then its energies."""
    check, H, xi = Worst("oscillator"), 60., .05
    meshes.wall("one.msh", n_through=1, n_up=1)
    w = math.sqrt(2 * E / DENSITY) / H
    f, n, steps, a0 = w / 2 / math.pi, 200, 2000, 2.
    dt = round(2 * math.pi / w / n, 7)
    write("motion.txt", "".join(f"{k * dt:.9f} 0 0 {a0 * math.sin(w * k * dt):.12g}\n" for k in range(steps + 1)))
    entries = {"Source": "file", "File": "motion.txt", "Unit": "m/s^2", "Duration": f"{steps * dt:.9f}", "Time step": dt}
    wd, mass, stiffness = w * math.sqrt(1 - xi**2), DENSITY * 100 * H / 2, E * 100 / H

    def exact(t):
        """u and v of u'' + 2 xi w u' + w^2 u = -a0 sin(w t)."""
        A = a0 / (2 * xi * w * w)
        decay = math.exp(-xi * w * t)
        u = A * (math.cos(w * t) - decay * (math.cos(wd * t) + xi * w / wd * math.sin(wd * t)))
        v = A * (-w * math.sin(w * t) + decay * (wd + xi**2 * w**2 / wd) * math.sin(wd * t))
        return u, v

    size = exact(2 * math.pi / w * 1000)[0]
    for name, f1, f2 in (("at the first frequency", f, 5 * f), ("at the second frequency", f / 5, f), ("at both", f, f * 1.0001)):
        directory = name.replace(" ", "_")
        shown = runs(scene(directory, "one.msh", Damping={"Ratio": xi, "Frequency 1": f"{f1:.12g}", "Frequency 2": f"{f2:.12g}"},
                           Motion=entries), "--output", directory)
        _, rows = table(f"{directory}/history.csv")
        _, energy = table(f"{directory}/energy.csv")
        lost = work = 0.
        for k, row in enumerate(rows):
            u, v = exact(k * dt)
            check.close(f"displacement {name}", row[3], u, 2e-3, size)
            if k:
                before = exact((k - 1) * dt)
                lost += dt * 2 * xi * w * mass * (v**2 + before[1]**2) / 2
                work -= dt * mass * (a0 * math.sin(w * k * dt) * v + a0 * math.sin(w * (k - 1) * dt) * before[1]) / 2
            for column, value in ((1, .5 * mass * v * v), (2, .5 * stiffness * u * u), (4, lost), (7, work)):
                check.close(f"energy, column {column}, {name}", energy[k][column], value, 5e-3, abs(work) + .5 * stiffness * size**2)
        a, b = (float(x) for x in re.search(r"C = (\S+) 1/s M \+ (\S+) s K", shown).groups())
        check.close(f"printed factors {name}", a / 2 / w + b * w / 2, xi, 1e-3)
        lines = runs("modes", f"{directory}.prm", "--count", "5").split()
        check.close("frequency", min((float(x) for x in lines[4::2]), key=lambda x: abs(x - f)), f, 1e-6)
    # Between its samples the motion is linear: Steps per sample = 10 of every tenth sample of a polygon is the polygon.
    coarse = [(a0 * math.sin(1.7 * k), 10 * k * dt) for k in range(41)]
    polygon = [p + i / 10 * (q - p) for (p, _), (q, _) in zip(coarse, coarse[1:]) for i in range(10)] + [coarse[-1][0]]
    write("coarse.txt", "".join(f"{t:.9f} 0 0 {x:.15g}\n" for x, t in coarse))
    write("polygon.txt", "".join(f"{k * dt:.9f} 0 0 {x:.15g}\n" for k, x in enumerate(polygon)))
    for name, parts in (("coarse", 10), ("polygon", 1)):
        runs(scene(name, "one.msh", Motion={**entries, "File": f"{name}.txt", "Duration": f"{400 * dt:.9f}",
                                            "Time step": f"{10 * dt / (10 // parts):.9f}"},
                   Dynamics={"Steps per sample": parts}), "--output", name)
    (_, one), (_, two) = table("coarse/history.csv"), table("polygon/history.csv")
    check.rows("steps between samples", [row[::3] for row in one], [row[::3] for row in two], 1e-7)
    for k, row in enumerate(one):
        check.close("its acceleration", row[6], polygon[k], 1e-7, a0)
    check.done()


def rock():
    """A block on a column of rock under P waves from below (golden/rock_exact.py), the rock without and with damping of its
    mass; then waves through flat ground under next to no dam."""
    check, r, golden = Worst("rock"), scenes.ROCK, json.loads((GOLDEN / "rock.json").read_text())
    meshes.on_rock("column.msh", r["cell"], r["columns"], (0, r["columns"]), r["layers"], r["dam_cells"], None)
    wave = [scenes.outcrop(k * r["dt"])[1] for k in range(r["steps"] + 1)]
    write("p.txt", "".join(f"{k * r['dt']:.6f} 0 0 {a:.12g}\n" for k, a in enumerate(wave)))
    motion = {"Source": "file", "File": "p.txt", "Unit": "m/s^2", "Duration": r["dt"] * r["steps"], "Time step": r["dt"]}
    ground = {"Model": "rock", "Young's modulus": r["E"], "Poisson's ratio": 0, "Density": r["rho"], "Free field": "columns",
              "Stiffness damping": 0, "Boundary": "viscous"}  # exact for waves along its normal
    concrete = {"Young's modulus": r["dam_E"], "Density": r["dam_rho"]}
    for alpha, exact in golden.items():
        name = f"alpha_{alpha}"
        damping = dict(zip(("Ratio", "Frequency 1", "Frequency 2"), (r["ratio"], *r["frequencies"])))
        runs(scene(name, "column.msh", Concrete=concrete, Damping=damping, Motion=motion,
                   Foundation={**ground, "Mass damping": alpha}), "--output", name)
        columns, rows = table(f"{name}/history.csv")
        expect(columns[3] == "crest_z" and columns[9] == "base_z", f"columns {columns}")
        _, energy = table(f"{name}/energy.csv")
        sizes = [max(abs(row[c]) for row in exact) for c in range(7)]
        for ours, e, theirs in zip(rows[::r["every"]], energy[::r["every"]], exact):
            check.close(f"time, {alpha}", ours[0], theirs[0], 1e-9, 1.)
            check.close(f"base, {alpha}", ours[9], theirs[1], .015, sizes[1])
            check.close(f"crest against base, {alpha}", ours[3], theirs[2], .015, sizes[2])
            for c, column, value in ((2, "strain", theirs[4]), (4, "damping", theirs[5]), (12, "rock_feet", -theirs[6])):
                check.close(f"energy, {column}, {alpha}", e[c], value, .01, sizes[6])
        if alpha == "0.0":  # all that rose has left again but for the block's share
            check.close("transmitted energy", energy[-1][13], -exact[-1][6], .01)
            check.close("transmitted energy, summary", summary(name)["rock"]["transmitted_energy"], energy[-1][13], 1e-6)
    flat_ground(check)
    check.done()


def flat_ground(check):
    """Under next to no dam the ground moves as the outcrop does, when the waves have come up: S in x and y, P in z."""
    E_rock, nu, rho, cell, layers, dt = 10e9, .25, 2600., 10., 12, .0015
    meshes.on_rock("flat.msh", cell, 18, (8, 10), layers, 1, 6)
    speed = [math.sqrt(E_rock / 2 / (1 + nu) / rho)] * 2
    speed.append(math.sqrt(E_rock * (1 - nu) / (1 + nu) / (1 - 2 * nu) / rho))
    factor = (1., -.6, .4)
    wave = [[f * scenes.outcrop(k * dt)[1] for f in factor] for k in range(501)]
    write("flat.txt", "".join(f"{k * dt:.6f} {a[0]:.12g} {a[1]:.12g} {a[2]:.12g}\n" for k, a in enumerate(wave)))
    for field in ("columns", "sections"):
        runs(scene(field, "flat.msh", Concrete={"Young's modulus": 1e9, "Density": 1},
                   Motion={"Source": "file", "File": "flat.txt", "Unit": "m/s^2", "Duration": 500 * dt, "Time step": dt},
                   Foundation={"Model": "rock", "Young's modulus": E_rock, "Poisson's ratio": nu, "Density": rho,
                               "Stiffness damping": 0, "Free field": field},
                   Output={"Envelope interval": 0}), "--output", field)
        for row in table(f"{field}/history.csv")[1]:
            for c in range(3):
                delay = (layers + 1) * cell / speed[c]
                check.close(f"flat ground, {'xyz'[c]}, {field}", row[7 + c], factor[c] * scenes.outcrop(row[0] - delay)[0],
                            .02, abs(factor[c]) * .01)


def main():
    cases = {c.__name__: c for c in (peaks, reference, calculix, weight, water, added_mass, oscillator, rock)}
    if len(sys.argv) < 3 or any(name not in cases for name in sys.argv[2:]):
        sys.exit(f"{__doc__}\nCases: {' '.join(cases)}")
    start = Path.cwd()
    for name in sys.argv[2:]:
        directory = start / "golden" / name
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir(parents=True)
        os.chdir(directory)
        print(name)
        cases[name]()
        print(f"{name}: OK")


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"FAILED: {error}")
