# SPDX-License-Identifier: GPL-3.0-or-later
"""Factors and levels of the scenes, from the tables of the program; text of a scene."""

import json
import math
import os
import re
import sys

import run_program

# Choices. {F} in a value is the height of the dam times F above its bottom; GRID is the section of the mesh, Arch210 or Arcs.

BASE = {"Mesh/GRID/Joints": "2", "Mesh/GRID/Elements along": "6", "Mesh/GRID/Elements up": "3", "Mesh/GRID/Elements through": "1",
        "Mesh/GRID/Smallest height": "20", "Reservoir/Water level": "{.7}", "Motion/Duration": "0.1", "Motion/Time step": "0.01", "Joints/Friction": "0.8",
        "Dynamics/Steps per sample": "4", "Output/Figures": "false", "Output/Checkpoint interval": "0"}
DAMS = {"Arch210": (0., 210.), "Arcs": (1000., 120.), "file": (500., 210.)}  # bottom and height [m]
# Entries that a level requires.
NEEDS = {("Motion/Source", "file"): {"Motion/File": "motion.txt", "Motion/Unit": "g"},
         ("Motion/Source", "artificial"): {"Motion/Duration": "0.2"},
         ("Motion/Match", "true"): {"Motion/Target spectrum": "target.txt", "Motion/Duration": "1"},
         ("Motion/Match", "scale"): {"Motion/Target spectrum": "target.txt"},
         ("Reservoir/Model", "acoustic"): {"Reservoir/Element size": "{.15m}", "Output/Pressure depths": "5, 20"},
         ("Reservoir/Model", "incompressible"): {"Reservoir/Element size": "{.15m}"},
         ("Reservoir/Model", "added mass table"): {"Reservoir/Table": "mass.csv"},
         ("Loads/Uplift/Base", "true"): {"Loads/Uplift/Drain efficiency": "0.6", "Loads/Uplift/Drain position": "0.2"},
         ("Foundation/Model", "massless"): {"Mesh/GRID/Rock/Element size": "{.5m}", **{f"Mesh/GRID/Rock/{side}": "{.5m}" for side in (
             "Upstream", "Downstream", "Sides", "Depth")}},
         ("Foundation/Boundary", "mtf4"): {"Mesh/GRID/Rock/Boundary layers": "9"},
         ("Foundation/Model", "rock"): {"Mesh/GRID/Rock/Element size": "{.3m}", "Motion/Duration": "0.35"}}  # waves arrive after 0.25 s; mtf4 drifts later
LAW_NEEDS = {"KSM": {"Joints/Keys/Height": "0.15"}, "cohesive": {"Joints/Strength": "1e6", "Joints/Fracture energy": "200"}}
DEFAULTS = {"Motion/Source": "file"}  # others than those of the program
# Entries that are no factors: the section Mesh has its own factors below; an entry of older versions; figures need matplotlib; a
# reader's view of results that are the same.
EXCLUDED = re.compile(r"Mesh/|Reservoir/Added mass|Output/Figures|Motion/Unit")
TIMES = {("Elements/Degree", "2"): 6, ("Foundation/Model", "massless"): 4, ("Foundation/Model", "rock"): 3, ("Mesh/GRID/Elements through", "2"): 2,
         ("Motion/Match", "true"): 3, ("Reservoir/Model", "acoustic"): 2,
         ("Reservoir/Model", "incompressible"): 2}  # of a run, relative
COMMON = ("Joints/Overrides", "Statics/Stages", "Joints/Initial gaps")  # lists to which several factors contribute
WATERLINE = "Reservoir/Water level"


def scales(laws, loads):
    """Factors with lengths, levels and lists: name, levels with their entries; the first one is the default."""
    def values(entry, *levels):
        return {entry: {level: {entry: level} for level in levels}}

    def lists(entry, levels, **more):
        return {entry: {"none": {}, **{name: {entry: text, **more} for name, text in levels.items()}}}

    def combination(without=None, factor=""):
        return {"Loads/Combination": "net", "Loads/Combinations": "net: " + ", ".join(load + factor for load in (*loads, "earthquake") if load != without)}

    return {
        "mesh": {"arch210": {}, "arcs": {"Mesh/Source": "arcs", "Mesh/Arcs/Table": "arcs.csv"}, "file": {"Mesh/Source": "file", "Mesh/File": "own.msh"}},
        **values("Mesh/GRID/Joints", "2", "0", "3"), **values("Mesh/GRID/Equal rows", "false", "true"),
        **values("Mesh/GRID/Elements through", "1", "2"), **values("Elements/Degree", "1", "2"),
        "base joint": {"none": {}, **{law: {"Joints/Overrides": f"base: {law}", "Mesh/GRID/Base joint": "true"} for law in laws}},
        "lift joints": {"none": {}, **{law: {"Joints/Overrides": f"lift: {law}", "Mesh/GRID/Lift joints": "1"} for law in laws}},
        "joint 1": {"as all": {}, "tied": {"Joints/Overrides": "1: tied"}},
        "Mesh/GRID/Rock/Enabled": {"false": {}, "true": {"Mesh/GRID/Rock/Enabled": "true", "Mesh/GRID/Rock/Element size": "{.3m}"}},
        "joint properties": {"rigid": {}, "elastic": {"Joints/Normal stiffness": "2e10", "Joints/Tangential stiffness": "1e10"},
                             "adhesive": {"Joints/Adhesion": "2e5"}},
        **lists("Joints/Initial gaps", {"contraction": "contraction: 2 mm", "base": "base: 1 mm", "lift": "lift: 1 mm"}),
        "keys": {"tight": {}, "loose": {"Joints/Keys/Clearance": "0.002", "Joints/Keys/Flank angle": "30"}, "rigid": {"Joints/Keys/Seat compliance": "0"}},
        **lists("Statics/Stages", {"fill": "fill {.3}", "grout": "grout {.6}, fill {.3}", "grout with pressure": "grout {1} at 0.2 MPa, fill {.3}",
                                   "cut": "fill {.4}, cut contraction by 1 mm", "day": "fill {.3}, day 30"}),
        **values("Statics/Water increments", "1", "3"),
        "water level": {"high": {}, "half": {WATERLINE: "{.4}"}, "below the dam": {WATERLINE: "{-.1}"}, "none": {"Reservoir/Density": "0"}},
        "temperature": {"none": {}, "faces": {"Loads/Temperature/Upstream face": "6", "Loads/Temperature/Downstream face": "-4"},
                        "table": {"Loads/Temperature/Table": "days.csv", "Loads/Temperature/Day": "60"}},
        "tail water": {"none": {}, "low": {"Loads/Tail water/Level": "{.2}"}},
        "silt": {"none": {}, "Rankine": {"Loads/Silt/Level": "{.3}"}, "coefficient": {"Loads/Silt/Level": "{.3}", "Loads/Silt/Coefficient": "0.5"}},
        **lists("Loads/Concentrated", {"crane": "crane: 0 0 {1} 1e6 3e5 -2e6"}), **lists("Loads/Crest line", {"line": "1e4 2e3 -5e4"}),
        **lists("Loads/Force history", {"shaker": "shaker: 0 0 {1}; 0 0 -1; push.csv"}),
        "combination": {"all": {}, "factors": combination(factor=" 1.1"), **{f"without {load}": combination(load) for load in (*loads, "earthquake")}},
        "sustained moduli": {"none": {}, "concrete": {"Concrete/Sustained modulus": "1.4e10"},
                             "both": {"Concrete/Sustained modulus": "1.4e10", "Foundation/Sustained modulus": "9e9"}},
        "damping of the rock": {"none": {}, "Rayleigh": {"Foundation/Stiffness damping": "2e-4"}, "quality factor": {"Foundation/Quality factor": "30"}},
        **values("Foundation/Incidence", "vertical", "SV 15 90, SH 10 0, P 10 30 0.01"), **values("Foundation/Substeps", "0", "2"),
        **values("Reservoir/Reflection", "1", "0.6"),
        "components": {"all": {}, "x": {"Motion/Scale y": "0", "Motion/Scale z": "0"}, "y": {"Motion/Scale x": "0", "Motion/Scale z": "0"}},
        **lists("Motion/Abutments", {"two": "right {.9}: other.txt; left {.9}: motion.txt"}),
        "sequence": {"none": {}, "two": {"Motion/File": None, "Motion/Sequence": "motion.txt; other.txt", "Motion/Rest": "0.05", "Motion/Duration": "0.05"}},
        **values("Damping/Ratio", "0.05", "0"),
        **lists("Damping/Zones", {"heel": "heel: 0.08"}, **{"Concrete/Zones": "heel: 3e10 0.2 2300"}),  # the own mesh has this zone
        "output": {"tables": {}, "all": {"Output/Solution interval": "10", "Output/Frames": "5", "Output/Probes": "mid: 0 0 {.5}"},
                   "no stresses": {"Output/Envelope interval": "0"}},
        "limits": {"none": {}, "all": {"Limits/Tensile strength": "3e6", "Limits/Opening": "0.01", "Limits/Slip": "0.01", "Limits/Compression": "1e7",
                                       "Limits/Base friction": "0.8", "Limits/Base cohesion": "5e5", "Limits/Sliding safety": "1.2"},
                   "wedges": {"Limits/Wedges": "wedges.csv", "Limits/Wedge safety": "1.1"}}}


def written_files(directory):
    """Files of the scenes: two motions, a target spectrum, tables of added mass, temperature, arcs and wedges."""
    for name, amplitude, shift in (("motion.txt", 4., 0), ("other.txt", 3., 1)):
        lines = []
        for i in range(121):
            t = .01 * i
            xyz = (amplitude / 9.80665 * (1 - math.exp(-15 * t)) * math.sin(w * t + p + shift) for w, p in ((31, 0), (37, 1), (43, 2)))
            lines.append(" ".join(f"{x:.10g}" for x in (t, *xyz)))
        (directory / name).write_text("\n".join(lines) + "\n")
    (directory / "target.txt").write_text("".join(f"{t} {a}\n" for t, a in ((0, .3), (.1, .75), (.2, .75), (1, .2), (3, .07), (4, .05))))
    (directory / "push.csv").write_text("time [s], force [N]\n0, 1e6\n0, 0\n0.1, 2e6\n")
    (directory / "mass.csv").write_text("depth [m], mass [kg/m^2]\n0, 0\n5, 8000\n25, 30000\n60, 60000\n200, 120000\n")
    (directory / "days.csv").write_text("day, upstream, downstream\n0, 6, 8\n30, 4, -2\n90, 10, 14\n")
    (directory / "arcs.csv").write_text("elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"
                                        "1000,-4,72,16,56,30,34\n1060,-8,88,12,76,40,44\n1120,0,100,6,94,46,52\n")
    (directory / "wedges.csv").write_text("wedge, plane, nx, ny, nz, x, y, z, area, friction, cohesion, uplift, volume, density\n"
                                          "left, bottom, 0, -0.4, 0.9, 0, 20, -50, 4500, 0.65, 2e5, 1e5, 1.2e5, 2650\n")


# Scenes

class Choices:
    """Factors with their levels, from the tables of the program."""

    def __init__(self):
        def flat(tree, path=""):
            for name, child in tree.items():
                if "pattern_description" in child:
                    yield path + name, child
                else:
                    yield from flat(child, f"{path}{name}/")

        entries = self.program = dict(flat(json.loads(run_program.runs("parameters", "json"))))
        laws = re.search(r"\[Selection (\S+) *\]", entries["Joints/Overrides"]["pattern_description"])[1].split("|")
        listed = re.search(r"Loads: (.*), earthquake\.", entries["Loads/Combinations"]["documentation"])[1]
        loads = self.loads = re.sub(r" \([^)]*\)", "", listed).split(", ")
        self.factors = scales(laws, loads)
        for entry, row in entries.items():
            kind = re.fullmatch(r"\[(?:(Bool)|Selection (.*?)) *\]", row["pattern_description"])
            if kind and not EXCLUDED.match(entry) and entry not in self.factors:
                levels = ["false", "true"] if kind[1] else kind[2].split("|")
                default = DEFAULTS.get(entry, row["default_value"])
                self.factors[entry] = {level: {entry: level} for level in sorted(levels, key=lambda level: level != default)}
        unknown = {entry for levels in self.factors.values() for level in levels.values() for entry in level} | set(BASE)
        unknown = {e.replace("GRID", "Arch210") for e in unknown} - set(entries)
        if unknown:
            sys.exit(f"combinations: the program has no entries {', '.join(sorted(unknown))}.")
        acting = {"weight": "Statics/Self-weight", "water": "water level", "uplift": "Loads/Uplift/Joints", "concentrated": "Loads/Concentrated",
                  "crest line": "Loads/Crest line", "force history": "Loads/Force history"}
        missing = [load for load in loads if acting.get(load, load) not in self.factors]
        if missing:
            sys.exit(f"combinations: these loads are in no scene: {', '.join(missing)}. Add a factor to scales().")
        self.default = {name: next(iter(levels)) for name, levels in self.factors.items()}

    def entries(self, scene):
        """Entries of a scene; lists to which several factors contribute are joined."""
        result = dict(BASE)
        for name in ("Joints/Model", "base joint", "lift joints"):
            result.update(LAW_NEEDS.get(scene[name], {}))
        for name, level in scene.items():
            needed = NEEDS.get((name, level), {})
            longest = max(needed.get("Motion/Duration", "0"), result["Motion/Duration"], key=float)
            result.update({**needed, "Motion/Duration": longest})
        for name, levels in self.factors.items():
            for entry, value in levels[scene[name]].items():
                if entry in COMMON and entry in result:
                    value = f"{result[entry]}, {value}"
                if entry == "Motion/Duration" and result[entry] != BASE[entry]:  # other choices need longer records
                    value = "0.15" if result[entry] == "0.35" else result[entry]
                if entry in result or value != self.program.get(entry, {}).get("default_value"):
                    result[entry] = value
        grid = "Arcs" if scene["mesh"] == "arcs" else "Arch210"
        bottom, height = DAMS[scene["mesh"] if scene["mesh"] == "file" else grid]

        def number(match):
            return f"{float(match[1]) * height if match[2] else bottom + float(match[1]) * height:.10g}"

        return {entry.replace("GRID", grid): re.sub(r"\{(-?[.\d]+)(m?)\}", number, value) for entry, value in result.items() if value is not None}

    def name(self, scene):
        """Short text: the levels that are not the defaults."""
        return ", ".join(f"{name}={level}" for name, level in scene.items() if level != self.default[name])


def cost(scene):
    """Time of a run, in units of pairs: a scene that covers fewer is preferred if it is faster."""
    return 2 * math.prod(TIMES.get(level, 1) for level in scene.items())


def text_of(entries):
    lines, open_sections = [], []
    for entry, value in sorted(entries.items()):
        *sections, name = entry.split("/")
        common = len(os.path.commonprefix([sections, open_sections]))
        lines += ["end"] * (len(open_sections) - common) + [f"subsection {section}" for section in sections[common:]] + [f"  set {name} = {value}"]
        open_sections = sections
    return "\n".join(lines + ["end"] * len(open_sections)) + "\n"
