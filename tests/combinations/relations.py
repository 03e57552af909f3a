# SPDX-License-Identifier: GPL-3.0-or-later
"""Relations that results must meet without a reference, and the scenes to which they apply."""

import html
import itertools
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import run_program
from choices import DAMS
from run_program import read_mesh, summary, table, write_mesh
from scenes import ROOT, Failed, Omitted, call, warnings_of


def columns(directory):
    """Kind, column: values over time, of displacements and joints, accelerations and pressures; extremes of summary.json. Of long runs, only
    their beginning: each impact multiplies the round-off."""
    result, is_long = {}, False
    for name in ("history", "joint_history"):
        if Path(directory, f"{name}.csv").exists():
            names, rows = table(f"{directory}/{name}.csv")
            is_long = is_long or rows[-1][0] > LONG
            for column, values in zip(names, zip(*(row for row in rows if row[0] <= LONG))):
                kind = "acceleration" if "_acceleration_" in column else "pressure" if column.startswith("pressure") else "displacement"
                if column != "time":
                    result[kind, column] = values
    for name, value in summary(directory).get("extremes", {}).items() if not is_long else ():
        kind = "displacement" if name in ("max_opening", "max_slip") else "stress"
        if isinstance(value, dict) and isinstance(value.get("value"), (int, float)) and ("max_" in name or "min_" in name):
            result[kind, name] = (value["value"],)
    return result


LONG = .36  # duration of motions that are compared as a whole [s]

# Smallest size of a kind in comparisons: below it there is round-off only. Accelerations and stresses are differences, with a larger round-off.
SIZES = {"displacement": 1e-4, "acceleration": 1., "pressure": 1e4, "stress": 1e5}


def compare(a, b, limit, renamed=lambda column: (column, 1)):
    """Throws Failed unless the results differ by at most the limit times the largest value of their kind. renamed: name and sign of a column in the
    second run, or None."""
    one, two, worst = columns(a), columns(b), (0., "")
    for kind in {kind for kind, _ in one}:
        size = max(SIZES[kind], max(abs(x) for key, values in one.items() if key[0] == kind for x in values) * (1 if kind == "displacement" else 10))
        for (_, column), values in (item for item in one.items() if item[0][0] == kind):
            to, sign = renamed(column)
            if to is None:
                continue
            if (kind, to) not in two or len(two[kind, to]) != len(values):
                raise Failed(f"{to} is missing in {b}")
            worst = max(worst, (max(abs(x - sign * y) for x, y in zip(values, two[kind, to])) / size, column))
    if not worst[0] <= limit:
        raise Failed(f"{worst[1]} of {Path(a).name} and {Path(b).name} differ by {worst[0]:.1e}, limit {limit:.0e}")
    return worst[0]


def same_bits(a, b, ignored=()):
    """All tables, fields and numbers that do not depend on the machine."""
    def bits(file):
        return [line for line in Path(file).read_bytes().splitlines() if not line.startswith(b"#")]  # VTK's date

    def strip(value):
        return {key: strip(x) for key, x in value.items() if key not in ignored and not any(word in key for word in (
            "second", "memory", "time_", "directory", "command", "threads", "rank", "cpu", "wall", "date", "scene"))} if isinstance(value, dict) else value

    names = [sorted(path.name for path in Path(x).glob("*.*") if path.suffix in (".bin", ".csv", ".vtu", ".pvd")) for x in (a, b)]
    if names[0] != names[1]:
        raise Failed(f"files of {a} and {b}: {set(names[0]) ^ set(names[1])}")
    for name in names[0]:
        if bits(f"{a}/{name}") != bits(f"{b}/{name}"):
            raise Failed(f"{name} of {Path(a).name} and {Path(b).name} differ, {difference_of(a, b)}")
    x, y = strip(summary(a)), strip(summary(b))
    if x != y:
        raise Failed(f"summary.json of {Path(a).name} and {Path(b).name}: {[(k, x.get(k), y.get(k)) for k in {*x, *y} if x.get(k) != y.get(k)]}"[:400])


def difference_of(a, b):
    try:
        return f"by {compare(a, b, math.inf):.1e}"
    except Failed as error:
        return str(error)


class Case:
    """A scene of the array with its first run."""

    def __init__(self, net, number, scene):
        self.net, self.number, self.scene, self.commands = net, number, scene, []
        self.entries = net.choices.entries(scene)
        self.directory = net.directory / f"{number}"
        shutil.rmtree(self.directory, ignore_errors=True)
        self.file = net.write(f"scene-{number}", self.entries)
        self.grid = "Mesh/Arcs/" if scene["mesh"] == "arcs" else "Mesh/Arch210/"
        self.bottom, self.height = DAMS[scene["mesh"] if scene["mesh"] == "file" else self.grid[5:-1]]
        self.first = None

    def run(self, name, changes=None, *words, file=None, **how):
        """Runs the scene with other entries; its directory."""
        output = self.directory / name
        words = [file or self.file, "--output", str(output), *words, *(w for e, v in (changes or {}).items() for w in ("--set", f"{e}={v}"))]
        call(words, **how)
        return output

    def has(self, *names):
        """True if one of the factors has not its default."""
        return any(self.scene[name] != self.net.choices.default[name] for name in names)

    def is_of_base(self, column):
        """True for a value of a base or lift joint: its place is the first of two on equal heights."""
        match = re.match(r"(?:opening|slip)_\w+_(\d+)$", column)
        return match is not None and int(match[1]) > int(self.scene["Mesh/GRID/Joints"])

    def own_mesh(self, name, change, changes=None):
        """Runs the scene with its own mesh as a file, after a change."""
        file, part = self.net.directory / f"scene-{self.number}-{name}.msh", self.net.directory / f"scene-{self.number}-{name}-part.msh"
        call(["mesh", self.file, "--output", str(part), "--format", "2.2"])
        mesh = read_mesh(part)
        part.unlink()
        mesh["names"] = {(int(d), int(tag)): text for d, tag, text in re.findall(r'^(\d) (\d+) "(.*)"$', "\n".join(mesh["head"]), re.M)}
        changes = {"Mesh/Source": "file", "Mesh/File": file.name, **(changes or {}), **(change(mesh) or {})}
        mesh["head"] = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(mesh["names"])),
                        *(f'{d} {tag} "{text}"' for (d, tag), text in mesh["names"].items()), "$EndPhysicalNames"]
        write_mesh(file, mesh)
        return self.run(name, changes)


NO_MOTION = {"Motion/Source": "none", "Motion/Abutments": "", "Motion/Sequence": ""}


# Relations: functions of a case. Those of ALWAYS need the first run only.

def energy(case):
    error = summary(case.first)["energy_balance_error"]
    if case.scene["Motion/Source"] != "none" and not error <= 1e-6:
        raise Failed(f"energy balance {error:.1e}")


def numbers(case):
    for path in case.first.glob("*.csv"):
        if re.search(r"(?<![a-z_])-?nan(?![a-z_])", path.read_text(), re.I):
            raise Failed(f"{path.name} has NaN")


def facts(case):
    """What --validate prints, and warnings in the log."""
    valid, run = json.loads(call([case.file, "--validate", "--json"])), summary(case.first)
    for key in ("law", "foundation", "mesh", "loads", "steps", "time_step"):
        if key in valid and key in run and valid[key] != run[key]:
            raise Failed(f"--validate has other {key}: {valid[key]} and {run[key]}"[:300])
    log = (case.first / "log.txt").read_text()
    logged = [" ".join(w.split()) for w in re.findall(r"^warning: (.*)", log, re.M | re.I)]
    expected, found = warnings_of(valid), [" ".join(w.split()) for w in warnings_of(run)]
    if [w for w in expected if " ".join(w.split()) not in found] or sorted(logged) != sorted(found):
        raise Failed(f"warnings of --validate {expected}, of the log {logged}, of summary.json {found}")


def report(case):
    """Each warning is in the report."""
    call(["report", str(case.first)])
    page = " ".join(html.unescape(re.sub(r"<[^>]*>", "", (case.first / "report.html").read_text())).split())
    for warning in warnings_of(summary(case.first)):
        if " ".join(warning.split())[:60] not in page:
            raise Failed(f"the report has no warning \"{warning[:80]}\"")


def repeated(case):
    again = case.directory / "repeated"
    shutil.copytree(case.first, again)
    case.run("repeated")
    same_bits(case.first, again)


def threads(case):
    same_bits(case.first, case.run("threads", threads=2))


def ranks(case):
    same_bits(case.first, case.run("ranks", ranks=2))


def resumed(case):
    """A run that is killed after a checkpoint goes on."""
    words = ["--set", "Output/Checkpoint interval=3"]
    output = case.directory / "resumed"
    for _ in range(5):
        shutil.rmtree(output, ignore_errors=True)
        with subprocess.Popen([run_program.VOUSSOIR, case.file, "--output", str(output), *words], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, env={**os.environ, **ROOT}) as process:
            while process.poll() is None and not (output / "checkpoint.txt").exists():
                time.sleep(.0005)
            process.send_signal(signal.SIGKILL)
            process.wait()
        if (output / "checkpoint.bin").exists():
            case.run("resumed", None, "--resume", *words, served=False)  # the same program
            return same_bits(case.first, output)
    raise Omitted("the run ends before it can be killed")


def printed(case):
    """The scene that `voussoir scene` prints."""
    file = case.net.directory / f"scene-{case.number}-printed.prm"
    file.write_text(call(["scene", case.file]))
    same_bits(case.first, case.run("printed", file=str(file)), ("warnings",))  # of entries that are in the scene


def without_effect(case):
    """Entries that are said to have no effect have none."""
    warnings = [w for w in warnings_of(summary(case.first)) if " no effect: " in w]
    idle = [e for e in case.entries if any(re.search(re.escape(e) + r" \(", w.split(" no effect: ")[0]) for w in warnings)]
    if not idle:
        raise Omitted("all entries have an effect")
    file = case.net.write(f"scene-{case.number}-active", {e: v for e, v in case.entries.items() if e not in idle})
    active = case.run("active", file=file)
    if case.scene["Foundation/Model"] == "massless" and case.scene["Motion/Source"] == "none":  # the idle scheme decides on one system or two
        return compare(case.first, active, 1e-9)
    return same_bits(case.first, active, ("warnings",))


def exported(case):
    return compare(case.first, case.own_mesh("exported", lambda mesh: None), 1e-6)


def unless_cracks_depend(case):
    """Large elements on cohesive joints: round-off can change the increments, and with them the cracks, as the program warns."""
    if any("the cracked pairs depend on" in warning for warning in warnings_of(summary(case.first))):
        raise Omitted("elements too large for the fracture energy: the cracks depend on increments and numbers of the joints")


def shuffled(case):
    unless_cracks_depend(case)

    def shuffle(mesh):
        order = list(range(len(mesh["nodes"])))
        random.Random(case.number).shuffle(order)  # place of each node
        nodes = [None] * len(order)
        for old, new in enumerate(order):
            nodes[new] = mesh["nodes"][old]
        mesh["nodes"], mesh["elements"] = nodes, [(kind, tag, [order[n] for n in corners]) for kind, tag, corners in mesh["elements"]]
        random.Random(case.number).shuffle(mesh["elements"])

    return compare(case.first, case.own_mesh("shuffled", shuffle), 1e-6)


def mirrored(case):
    """y -> -y: monoliths are counted from the other bank, loads and motions change their sign along y."""
    unless_cracks_depend(case)
    joints = summary(case.first)["mesh"]["joints"]
    n = summary(case.first)["mesh"]["monoliths"]
    contraction = int(case.entries[case.grid + "Joints"]) if case.scene["mesh"] != "file" else int(case.scene["Mesh/GRID/Joints"])

    def mirror(mesh):
        mesh["nodes"] = [[x, -y, z] for x, y, z in mesh["nodes"]]
        mesh["elements"] = [(kind, tag, c[4:] + c[:4] if kind == 5 else c[::-1]) for kind, tag, c in mesh["elements"]]
        mesh["names"] = {key: re.sub(r"^(monolith|joint) (\d+)", lambda m: f"{m[1]} {contraction + 1 + (m[1] == 'monolith') - int(m[2])}", name)
                         for key, name in mesh["names"].items()}

    changes = {}
    entries = case.entries
    scale = float(entries.get("Motion/Scale y", 1))
    changes["Motion/Scale y"] = f"{-scale:g}"
    if "Loads/Concentrated" in entries:
        changes["Loads/Concentrated"] = re.sub(r"(: \S+ \S+ \S+ \S+) (\S+)", r"\1 -\2", entries["Loads/Concentrated"])
    if "Loads/Crest line" in entries:
        changes["Loads/Crest line"] = re.sub(r"^(\S+) ", r"\1 -", entries["Loads/Crest line"])
    if "Foundation/Incidence" in entries:
        changes["Foundation/Incidence"] = "SV 15 -90, SH 10 0, P 10 -30 0.01"
    if "Motion/Abutments" in entries:
        changes["Motion/Abutments"] = entries["Motion/Abutments"].replace("right", "LEFT").replace("left", "right").replace("LEFT", "left")
    if case.has("joint 1"):
        changes["Joints/Overrides"] = re.sub(r"(^|, )1:", rf"\g<1>{contraction}:", entries["Joints/Overrides"])
    at_joint = "crest_left_x" in table(f"{case.first}/history.csv")[0]

    def renamed(column):
        sign = -1 if re.search(r"(^|_)y$", column) else 1
        if "_acceleration" not in column and re.match(r"(opening|slip)_\w+_\d+$", column):
            number = int(column.rsplit("_", 1)[1])
            return (f"{column.rsplit('_', 1)[0]}_{contraction + 1 - number}", sign) if number <= contraction and joints == contraction else (None, 1)
        if at_joint and column.startswith("mid_"):  # the probe is in the monolith with the smaller number
            return None, 1
        if at_joint and column.startswith("crest_"):
            column = column.replace("crest_left_", "crest_") if column.startswith("crest_left_") else column.replace("crest_", "crest_left_")
        return column, sign

    assert n > contraction
    return compare(case.first, case.own_mesh("mirrored", mirror, changes), 1e-6, renamed)


def rotated(case):
    """30 degrees about z, with the motion: openings, slips and stresses."""
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    scale = [float(case.entries.get(f"Motion/Scale {d}", 1)) for d in "xyz"]
    file = case.net.directory / f"scene-{case.number}-rotated.txt"
    rows = [[float(x) for x in line.split()] for line in (case.net.directory / "motion.txt").read_text().splitlines()]
    file.write_text("".join(" ".join(f"{v:.17g}" for v in (t, c * x - s * y, s * x + c * y, z)) + "\n"
                            for t, x, y, z in ([t, *(a * f for a, f in zip(xyz, scale))] for t, *xyz in rows)))

    def turn(mesh):
        mesh["nodes"] = [[c * x - s * y, s * x + c * y, z] for x, y, z in mesh["nodes"]]

    changes = {"Motion/File": file.name, **{f"Motion/Scale {d}": "1" for d in "xyz"}}
    for entry, count in (("Loads/Concentrated", 3), ("Loads/Crest line", 0)):
        if entry in case.entries:
            head, _, numbers_ = case.entries[entry].rpartition(": ")
            v = [float(x) for x in numbers_.split()]
            v[count:count + 2] = [c * v[count] - s * v[count + 1], s * v[count] + c * v[count + 1]]
            changes[entry] = (head + ": " if head else "") + " ".join(f"{x:.15g}" for x in v)
    return compare(case.first, case.own_mesh("rotated", turn, changes), 1e-6,
                   lambda column: (column if not re.match(r"crest|base|mid|arch|max_arch|cantilever", column) and not case.is_of_base(column) else None, 1))


def renamed_mesh(pattern, to):
    def change(mesh):
        mesh["names"] = {key: re.sub(pattern, to, name) for key, name in mesh["names"].items()}
        first = {}
        for key, name in sorted(mesh["names"].items()):  # one tag for each name
            first.setdefault((key[0], name), key[1])
        tags = {key: first[key[0], name] for key, name in mesh["names"].items()}
        mesh["elements"] = [(kind, tags[3 if kind == 5 else 2, tag], corners) for kind, tag, corners in mesh["elements"]]
        mesh["names"] = {(d, tag): name for (d, name), tag in first.items()}
    return change


def bonded(case):
    """Tied lift and base joints are none."""
    overrides = [part for part in case.entries.get("Joints/Overrides", "").split(", ") if part.startswith("1:")]
    kinds = ["base: tied"] * case.has("base joint") + ["lift: tied"] * case.has("lift joints")
    tied = case.run("tied-base", {"Joints/Overrides": ", ".join(kinds + overrides)})

    def change(mesh):
        renamed_mesh(r" lift \d+|(?<=^base) joint$", "")(mesh)
        return {"Joints/Overrides": ", ".join(overrides)}

    # Stresses are recovered with the known tractions of the base, which a tied joint has not.
    return compare(tied, case.own_mesh("no-base", change), 1e-6, lambda column: (column if re.match(r"(crest|base)_", column) else None, 1))


def one_body(case):
    """Tied joints are none."""
    tied = case.run("tied", {"Joints/Model": "tied", "Joints/Overrides": ""})
    alone = case.own_mesh("one-body", renamed_mesh(r"^monolith \d+", "monolith 1"))

    def renamed(column):
        return (None if re.match(r"(opening|slip)_|max_opening|max_slip|crest_left", column) else column), 1

    return compare(tied, alone, 1e-6, lambda column: renamed(column) if "max_" not in column and "min_" not in column else (None, 1))


def increments(case):
    """Twice the load increments: nearly the same static state."""
    n = int(case.entries.get("Statics/Water increments", 1))
    other = case.run("increments", {"Statics/Water increments": str(2 * n), **NO_MOTION})
    a, b = (summary(x)["static"]["crest_displacement"] for x in (case.first, other))
    change = math.dist(a, b) / max(math.hypot(*a), 1e-5)
    if not change <= .02:
        raise Failed(f"static crest displacement {a} and {b}, difference {change:.1%}")


def at_rest(case):
    names, rows = table(f"{case.run('at-rest', {'Motion/Factor': '0', 'Loads/Force history': ''})}/history.csv")
    places = [k for k, name in enumerate(names) if name.startswith("crest_") and "_acceleration_" not in name]
    size = max([1e-3] + [abs(rows[0][k]) for k in places])
    moved = max(abs(row[k] - rows[0][k]) for row in rows for k in places) / size
    if not moved <= 1e-6:
        raise Failed(f"the crest moves by {moved:.1e} of its displacement without a motion")


def zero_gaps(case):
    kinds = ["contraction"] + [kind for kind in ("base", "lift") if is_open(case.scene, kind)]  # tied lifts with a gap are not merged
    return compare(case.first, case.run("zero-gaps", {"Joints/Initial gaps": ", ".join(f"{kind}: 0" for kind in kinds)}), 1e-6)


def equal_modulus(case):
    changes = {f"{section}/Sustained modulus": case.net.choices.program[f"{section}/Young's modulus"]["default_value"] for section in
               ["Concrete"] + ["Foundation"] * (case.scene["Foundation/Model"] != "rigid")}
    return compare(case.first, case.run("equal-modulus", changes), 1e-9)


def equal_abutments(case):
    level = f"{case.bottom + .9 * case.height:g}"
    return compare(case.first, case.run("abutments", {"Motion/Abutments": f"right {level}: motion.txt; left {level}: motion.txt"}), 1e-9)


def dry_loads(case):
    """Tail water and silt below the base do nothing."""
    level = f"{case.bottom - .3 * case.height:g}"
    changes = {f"Loads/{load}/Level": level for load, name in (("Tail water", "tail water"), ("Silt", "silt")) if not case.has(name)}
    return compare(case.first, case.run("dry-loads", changes), 1e-12)


def needs_rows(case):
    """Rows of `voussoir needs` without a load that does nothing: tail water and silt below the base, uplift of a bonded base."""
    level = f"{case.bottom - .3 * case.height:g}"
    changes = {f"Loads/{load}/Level": level for load, name in (("Tail water", "tail water"), ("Silt", "silt")) if not case.has(name)}
    if not case.has("base joint", "Loads/Uplift/Joints"):
        changes["Loads/Uplift/Base"] = "true"
    words = [w for e, v in changes.items() for w in ("--set", f"{e}={v}")]
    rows = {row["name"]: row["set"] for row in json.loads(call(["scene", case.file, "--choices", *words]))["choices"]}
    idle = [load for load, entry in (("tail water", "Loads/Tail water/Level"), ("silt", "Loads/Silt/Level"), ("uplift", "Loads/Uplift/Base"))
            if entry in changes and f"without {load}" in rows]
    if not idle:
        raise Omitted("no row without effect")
    load = idle[case.number % len(idle)]
    return compare(case.first, case.run("needs-row", {**changes, **rows[f"without {load}"]}), 1e-9)


def base_force(case):
    """The force of the foundation is minus the sum of all loads, with own integrals."""
    static = case.run("base-force", {"Output/Block forces": "true", **NO_MOTION})
    blocks, combination = summary(static)["blocks"], case.entries.get("Loads/Combinations", "")
    names, rows = table(f"{static}/blocks.csv")
    row = dict(zip(names, rows[0]))
    factors = {load: 1. for load in case.net.choices.loads}
    if combination:
        given = dict(re.fullmatch(r"(.*?)( [\d.]+)?", part).groups() for part in combination[5:].split(", "))
        factors = {load: float(given[load] or 1) if load in given else 0. for load in factors}
    total = [0.] * 3
    for monolith, block in blocks.items():
        for component, axis in (("N", "normal"), ("V_stream", "stream"), ("V_arch", "arch")):
            value = row[f"{component}_{monolith.split()[1]}"] * (-1 if component == "N" else 1)
            total = [t + value * a for t, a in zip(total, block[axis])]
    part = case.net.directory / f"scene-{case.number}-base-force.msh"
    call(["mesh", case.file, "--output", str(part), "--format", "2.2"])
    mesh = read_mesh(part)
    part.unlink()
    gravity = 9.81 if "Statics/Gravity" not in case.net.choices.program else float(case.net.choices.program["Statics/Gravity"]["default_value"])
    value = {e: float(case.entries.get(e, row_["default_value"])) for e, row_ in case.net.choices.program.items()
             if re.fullmatch(r"-?[\d.]+(e[-+]?\d+)?", row_["default_value"])}
    coefficient = value["Loads/Silt/Coefficient"]
    if coefficient < 0:
        sine = math.sin(math.radians(value["Loads/Silt/Friction angle"]))
        coefficient = (1 - sine) / (1 + sine)
    loads = [0.] * 3
    for load, surface, level, density in (("water", 2, value["Reservoir/Water level"], value["Reservoir/Density"]),
                                          ("tail water", 3, value["Loads/Tail water/Level"], value["Loads/Tail water/Density"]),
                                          ("silt", 2, value["Loads/Silt/Level"], value["Loads/Silt/Density"])):
        for kind, tag, corners in mesh["elements"]:
            if kind == 3 and tag == surface:
                for area, z in pieces([mesh["nodes"][n] for n in corners]):
                    p = factors[load] * density * gravity * max(0., level - z)
                    if load == "silt":
                        area = [coefficient * area[0], coefficient * area[1], max(0., area[2])]
                    loads = [f - p * a for f, a in zip(loads, area)]
    if "Loads/Concentrated" in case.entries:
        force = case.entries["Loads/Concentrated"].split()[4:]
        loads = [f + factors["concentrated"] * float(x) for f, x in zip(loads, force)]
    if case.scene["Statics/Self-weight"] != "none":
        loads[2] -= factors["weight"] * gravity * sum(zone["volume"] * zone["density"] for zone in summary(static)["zones"]["concrete"].values())
    error = math.dist(loads, [-x for x in total]) / max(math.hypot(*loads), 1e6)
    if not error <= 5e-3:
        raise Failed(f"base force {total} N, loads {loads} N, difference {error:.1e}")


def pieces(corners, n=24):
    """Outward area vector and height of the parts of a quadrilateral."""
    def at(a, b):
        return [(1 - a) * (1 - b) * p + a * (1 - b) * q + a * b * r + (1 - a) * b * s for p, q, r, s in zip(*corners)]
    for i, j in itertools.product(range(n), repeat=2):
        p, q, r, s = (at((i + di) / n, (j + dj) / n) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
        d, e = [x - y for x, y in zip(r, p)], [x - y for x, y in zip(s, q)]
        yield [(d[k - 2] * e[k - 1] - d[k - 1] * e[k - 2]) / 2 for k in range(3)], at((i + .5) / n, (j + .5) / n)[2]


def has_mesh_file(s):  # a mesh with rock is no mesh of a rigid foundation
    return s["Foundation/Model"] != "rigid" or s["Mesh/GRID/Rock/Enabled"] == "false"


def has_joints(s):
    return s["Mesh/GRID/Joints"] != "0" or s["base joint"] != "none" or s["lift joints"] != "none"


def is_numbered(s):  # without contraction joints, joint 1 is a base joint
    return s["joint 1"] == "as all" or s["Mesh/GRID/Joints"] != "0"


def is_unique(s):
    """Forces of rigid flanks, and slips below the limit of friction, are not unique; without an impact rule round-off grows without bound."""
    return (s["keys"] != "rigid" or "KSM" not in (s["Joints/Model"], s["lift joints"])) and s["Dynamics/Impact"] != "none"


def is_open(s, kind):
    return s["base joint" if kind == "base" else "lift joints"] not in ("none", "tied")


def shakes(s):
    return s["Motion/Source"] != "none" and s["combination"] != "without earthquake"


ALWAYS = (energy, numbers, facts)
RARE = (report,)  # some scenes suffice
RELATIONS = {
    report: lambda s: True, repeated: lambda s: True, threads: lambda s: True, ranks: lambda s: s["Dynamics/Scheme"] != "explicit", printed: lambda s: True,
    without_effect: lambda s: True, exported: has_mesh_file, shuffled: lambda s: has_mesh_file(s) and is_unique(s), needs_rows: lambda s: True,
    resumed: shakes, at_rest: lambda s: shakes(s) and is_unique({**s, "Dynamics/Impact": ""}),
    mirrored: lambda s: has_mesh_file(s) and is_numbered(s) and is_unique(s) and s["limits"] != "wedges",
    # These have the directions x and y: the box of rock with mass, channel and local depth of the water, lift keys, wedges, stations.
    rotated: lambda s: has_mesh_file(s) and is_unique(s) and s["lift joints"] != "KSM" and s["Foundation/Model"] != "rock" and s["limits"] != "wedges" and
    s["Reservoir/Depth"] != "local" and s["Reservoir/Model"] not in ("acoustic", "incompressible") and s["Motion/Source"] == "file" and
    s["Motion/Match"] == "false" and s["Motion/Abutments"] == s["sequence"] == "none",
    bonded: lambda s: has_mesh_file(s) and is_numbered(s) and (s["base joint"] != "none" or s["lift joints"] != "none") and s[
        "Joints/Initial gaps"] in ("none", "contraction"),
    one_body: lambda s: has_mesh_file(s) and s["base joint"] == s["lift joints"] == "none" and s["joint 1"] == "as all" and s["Mesh/GRID/Joints"] != "0" and
    s["Joints/Initial gaps"] == "none" and s["Statics/Stages"] in ("none", "fill", "day") and s[
        "Reservoir/Model"] not in ("acoustic", "Westergaard-nodal"),  # their nodes belong to one monolith, with its normal
    zero_gaps: lambda s: has_joints(s) and s["Joints/Initial gaps"] == "none",
    equal_modulus: lambda s: s["sustained moduli"] == "none",
    equal_abutments: lambda s: s["Foundation/Model"] == "massless" and s["Motion/Source"] == "file" and s["Motion/Match"] != "scale" and
    s["Motion/Abutments"] == s["sequence"] == "none",
    dry_loads: lambda s: s["tail water"] == "none" or s["silt"] == "none",
    # The integrals here have no edges and no water in joints.
    base_force: lambda s: s["Loads/Crest line"] == "none" and s["Loads/Uplift/Joints"] == "false" and (
        s["Loads/Uplift/Base"] == "false" or s["base joint"] == "none")}
