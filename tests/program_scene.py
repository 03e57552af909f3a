#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what the program makes of the command line, of scenes and of meshes: options, units, warnings, groups, axes.

    program_scene.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import os
import re
from pathlib import Path

from run_program import (run_cases, arch_mesh, expect, frequencies, from_file, refused, runs, split_tetrahedra, voussoir, write, write_mesh,
                         write_scene)

SOURCE = Path(__file__).resolve().parent.parent


def warnings(*arguments):
    """The warnings of a run that succeeds, from screen and standard error; but for that of the tests' short motion."""
    result = voussoir(*arguments)
    expect(result.returncode == 0, f"status {result.returncode} of {arguments}: {result.stderr}")
    lines = (result.stdout + result.stderr).splitlines()
    found = [re.sub("^voussoir: ", "", line) for line in lines if re.match("(voussoir: )?warning: ", line) and "does not end at rest" not in line]
    for line in found:
        print("   ", line)
    return found


def warned(arguments, *parts):
    """One warning, with all these parts."""
    found = warnings(*arguments)
    expect(len(found) == 1, f"{arguments}: {len(found)} warnings: {found}")
    for part in parts:
        expect(part in found[0], f"'{part}' is missing: {found[0]}")


def options():
    """Each command has its own options and its own help."""
    write_scene()
    commands = {"mesh": "--format", "modes": "--count", "motion": "--output",
                "parameters": "SECTION"}
    for command, option in commands.items():
        for arguments in ([command, "--help"], ["help", command], [command, "-h"]):
            text = runs(*arguments)
            expect(option in text and f"voussoir {command}" in text and "Exit status" in text, f"{arguments}: {text}")
            for other in commands:
                expect(other == command or f"voussoir {other}" not in text, f"{arguments} speaks of {other}")
        expect(f"voussoir {command} " in runs("--help"), f"--help without {command}")
    text = runs("scene.prm", "--help")
    for option in ("--output", "--set", "--resume", "--overwrite", "--validate", "--quiet"):
        expect(option in text, f"the help about a run lacks {option}")
    expect("--count" not in text, text)
    out = ["--output", "a"]
    for arguments, parts in ((["motion", "scene.prm", *out, "--resume"], ("`voussoir motion` has no option --resume",
                                                                         "`voussoir SCENE.prm`")),
                             (["scene.prm", "--count", "3"], ("no option --count", "`voussoir modes`")),
                             (["modes", "scene.prm", "--format", "2.2"], ("`voussoir modes` has no option --format",)),
                             (["mesh", "scene.prm", *out, "--validate"], ("no option --validate",)),
                             (["parameters", "--quiet"], ("`voussoir parameters` has no option --quiet",)),
                             (["scene.prm", "--validat"], ("no option --validat", "Did you mean --validate?")),
                             (["scene.prm", "--quiet", *out, *out], ("--output", "twice")),
                             (["scene.prm", "--output", "--quiet"], ("--output", "needs a value", "DIR")),
                             (["mehs", "scene.prm"], ('no command "mehs"', "`voussoir mesh`")),
                             (["mehs"], ('no command "mehs"', "`voussoir mesh`")),
                             (["motion"], ("needs one scene file", "`voussoir motion --help`")),
                             (["modes", "scene.prm", "--count", "3x"], ("--count", "3x")),
                             (["parameters", "Joint"], ('"Joint"', 'Did you mean "Joints"', "markdown")),
                             (["parameters", "prm", "Joints/Key"], ('"Joints/Keys"',)),
                             (["parameters", "json", "Joints", "Mesh"], ("Mesh", "Remove the argument"))):
        refused(arguments, *parts)
    expect("2 joints" in runs("--validate", "--overwrite", "--", "scene.prm"), "-- before the scene")
    # One section
    keys = json.loads(runs("parameters", "json", "Joints/Keys"))
    expect(list(keys) == ["Joints"] and list(keys["Joints"]) == ["Keys"] and "Height" in keys["Joints"]["Keys"], f"{keys}")
    for arguments in (["parameters", "Joints/Keys"], ["parameters", "prm", "Joints/Keys"]):
        text = runs(*arguments)
        expect("set Height" in text and "subsection Keys" in text and "set Overrides" not in text, text)
        expect(re.search(r"# .*Height of the shear keys \[m\]", text), text)
    rows = runs("parameters", "markdown", "Joints/Keys").splitlines()
    expect(len(rows) == 9 and all("Joints/Keys/" in row for row in rows[2:]), f"{rows}")
    expect(len(runs("parameters", "markdown", "Joints/Friction").splitlines()) == 3, "a single entry")
    for entry in runs("parameters", "markdown").splitlines()[2:]:
        expect(len(re.findall(r"(?<!\\)\|", entry)) == 4, f"columns of {entry}")


def values():
    """Units, patterns in words, implausible values, entries without effect."""
    write_scene()

    def check(*settings):
        return ["scene.prm", "--validate", *(x for s in settings for x in ("--set", s))]

    shown = runs(*check("Reservoir/Water level=19500 cm", "Damping/Frequency 1=0.0012 kHz", "Statics/Gravity=1 g",
                        "Concrete/Young's modulus=25 GPa", "Concrete/Density=2.45 t/m3"))
    expect("level 195 m" in shown and "at 1.2 and" in shown and not re.search("warning: (?!the motion does not end)", shown), shown)
    write("scene2.prm", "include scene.prm\nsubsection Output\n  set Figures = false\nend\n"
                        "subsection Reservoir\n  set Water level = 15 MPa\nend\n")
    refused(["scene2.prm", "--validate"], "scene2.prm, line 6", "Reservoir/Water level", "is in m", "pressure")
    for setting, parts in {"Joints/Friction=2 mm": ("Joints/Friction", "no unit"),
                           "Elements/Degree=1 m": ("Elements/Degree", "no unit"),
                           "Motion/Duration=5 kg": ("Motion/Duration", "is in s", '"kg"', "ms"),
                           "Joints/Friction=-1": ("a number from 0 to 10000",),
                           "Joints/Friction=0,8": ("a number from 0 to 10000",),
                           "Concrete/Poisson's ratio=0.6": ("a number from -0.99 to 0.499",),
                           "Mesh/Arch210/Joints=2.5": ("an integer from 0 to 60",),
                           "Joints/Model=FJC": ("one of: tied, FJA, FJB, KSM, cohesive",),
                           "Output/Figures=maybe": ("true or false",),
                           "Joints/Overrides=a: FJA": ('the joint "a"', "contraction"),
                           "Joints/Overrides=1: FJA, 1: FJB": ('"1" twice',),
                           "Output/Probes=foot: 0 0 0; foot: 1 0 0": ('"foot" twice',),
                           "Output/Probes=foot: 0 0 0; far: 0 900 100": ('"far"', "(0, 900, 100) m", "more than an element"),
                           "Output/Probes=crest: 0 0 0": ('"crest"', "column of history.csv"),
                           "Output/Probes=top_acceleration: 0 0 0": ('"top_acceleration"', "column of history.csv"),
                           "Output/Probes=ground: 0 0 0": ('"ground"', "floor_spectra.csv")}.items():
        refused(check(setting), *parts)
        message = voussoir(*check(setting)).stderr
        expect(not re.search(r"\[(Double|Integer|Bool|Selection|Map)|MAX_DOUBLE|inclusive|\|", message), message)
    expect(warnings(*check()) == [], "warnings without reason")
    for setting, parts in {"Concrete/Young's modulus=21": ("21 Pa", "5e+09 to 6e+10 Pa"),
                           "Concrete/Density=2.4": ("Concrete/Density (--set)", "2.4 kg/m^3"),
                           "Motion/Unit=cm/s^2": ("peak acceleration of the motion", "0.0006"),
                           "Motion/Scale x=60": ("peak acceleration of the motion", "g"),
                           "Reservoir/Water level=-20": ("does not reach the dam", "-20 m"),
                           "Mesh/Arch210/Rock/Enabled=true": ("rock", "Foundation/Model is rigid"),
                           "Joints/Model=FJB": ("Joints/Friction (scene.prm, line 12)", "FJB"),
                           "Joints/Keys/Height=0.3": ("Joints/Keys/Height", "KSM"),
                           "Mesh/File=a.msh": ("Mesh/File", "Mesh/Source is not file"),
                           "Motion/Seed=7": ("Motion/Seed", "Motion/Source is file"),
                           "Limits/Tensile strength=2.5": ("Limits/Tensile strength", "2.5 Pa", "21 GPa"),
                           "Limits/Waterstop opening=15": ("Limits/Waterstop opening", "15 m", "20 cm"),
                           "Limits/Waterstop depth=500": ("Limits/Waterstop depth", "500 m"),
                           "Foundation/Density=2500": ("Foundation/Density", "rigid")}.items():
        if parts:
            warned(check(setting), *parts)
        else:
            expect(warnings(*check(setting)) == [], setting)
    # Quiet or not, --validate shows the warnings.
    for settings, n in ((["Concrete/Density=2.4", "Reservoir/Water level=-20"], 2), ([], 0)):
        loud, quiet = (warnings(*check(*settings), *more) for more in ([], ["--quiet"]))
        expect(loud == quiet and len(loud) == n, f"{loud}, quiet: {quiet}")
    expect(voussoir("scene.prm", "--validate", "--quiet").stdout == "", "--quiet prints more than warnings")
    # Friction belongs to the laws that have it.
    for settings, law in ((["Joints/Model=FJB"], "FJB"), (["Joints/Model=FJA"], "FJA (friction 0.6)"),
                          (["Joints/Model=FJB", "Joints/Overrides=2: FJA"], "FJB, joint 2: FJA (friction 0.6)")):
        expect(f", law {law}\n" in runs(*check(*settings)), f"law {law}")
    # The other commands warn on standard error, and a run in its log.
    for command in (["modes", "scene.prm", "--count", "1"], ["motion", "scene.prm", "--output", "a.csv"],
                    ["mesh", "scene.prm", "--output", "a.msh"]):
        result = voussoir(*command, "--set", "Concrete/Density=2.4")
        expect(result.returncode == 0 and result.stderr.startswith("voussoir: warning: Concrete/Density"), result.stderr)
    shown = runs("scene.prm", "--output", "run", "--set", "Joints/Model=FJB", "--set", "Motion/Duration=0.05")
    expect(len(re.findall("^warning: Joints/Friction", Path("run/log.txt").read_text(), re.M)) == 1, shown)
    expect(re.search(r"^Motion +x, y, z: PGA 0\.\d+ .* g, PGV .* m/s, PGD .* m$", shown, re.M), shown)
    table = runs("motion", "scene.prm", "--output", "a.csv")
    peaks = re.search("peak acceleration +g +(.*)", table)[1].split()
    expect("PGA " + " ".join(peaks) + " g" in runs(*check()), f"PGA: {peaks}")
    # Components of unequal size: each peak in the log is that of its own row and column in the table.
    unequal = [x for scale in ("y=0.5", "z=0.2") for x in ("--set", f"Motion/Scale {scale}")]
    table, shown = runs("motion", "scene.prm", "--output", "a.csv", *unequal), runs(*check(), *unequal)
    for name, row, unit in (("PGA", "peak acceleration +g", "g"), ("PGV", "peak velocity +m/s", "m/s"), ("PGD", "peak displacement +m", "m")):
        peaks = re.search(row + " +(.*)", table)[1].split()
        expect(len(set(peaks)) == 3 and f"{name} " + " ".join(peaks) + f" {unit}" in shown, f"{name}: {peaks}: {shown}")


def groups():
    """Groups of a mesh by name; their table."""
    arch_mesh()
    text = Path("arch.msh").read_text()
    shown = runs("scene.prm", "--validate", *from_file("arch.msh"))
    expect("no Reservoir/Water level: it is 195 m, the default for the dam arch210" in shown, f"the built-in dam's level for another: {shown}")
    given = runs("scene.prm", "--validate", *from_file("arch.msh"), "--set", "Reservoir/Water level=195")
    expect("the default for the dam" not in given, given)
    for row in (r"Groups +monolith 1 \.\.\. monolith 3 +-> +monolith 1 to monolith 3 +\d+ hexahedra", r"base +-> +base +\d+ faces",
                r"upstream +-> +upstream +\d+ faces", r"crest +-> +crest +6 faces"):
        expect(re.search(row, shown), f"'{row}' is missing: {shown}")
    built_in = runs("scene.prm", "--validate")
    expect(re.search(r"Groups.*(\n +.*){4}", built_in)[0] == re.search(r"Groups.*(\n +.*){4}", shown)[0], built_in)
    for old, new, parts in (('"base"', '"gallery wall"', ("'gallery wall'", "(id 1)", "unknown name", "'base'")),
                            ('"monolith 3"', '"foundation"', ("'foundation'", "(id 3)", "unknown name", "'monolith 1'")),
                            ('"downstream"', '"donwstream"', ("'donwstream'", "Did you mean 'downstream'?"))):
        write("named.msh", text.replace(old, new))
        refused(["scene.prm", "--validate", *from_file("named.msh")], "named.msh", *parts)
    write("unnamed.msh", re.sub(r"\$PhysicalNames.*\$EndPhysicalNames\n", "", text, flags=re.S))
    shown = runs("scene.prm", "--validate", *from_file("unnamed.msh"))
    expect(re.search(r"surface 1 \(no name\) +-> +base +\d+ faces", shown), shown)


def axes():
    """A dam in another unit, turned, or with exchanged faces is refused with the entry that mends it."""
    mesh = arch_mesh()

    def variant(name, place, elements=None):
        write_mesh(name, {**mesh, "nodes": [place(*x) for x in mesh["nodes"]], "elements": elements or mesh["elements"]})
        return ["scene.prm", "--validate", *from_file(name)]

    plain = runs("scene.prm", "--validate", *from_file("arch.msh"))

    def mended(arguments, *entries):
        shown = runs(*arguments, *(x for e in entries for x in ("--set", e)))
        expect(re.sub("(?m)^Memory.*", "", shown) == re.sub("(?m)^Memory.*", "", plain), f"{entries}: {shown}")

    large = variant("mm.msh", lambda x, y, z: [1e3 * x, 1e3 * y, 1e3 * z])
    refused(large, "mm.msh", "210000 m high", '"Mesh/Length unit"', "mm (then it is 210 m high)")
    mended(large, "Mesh/Length unit=mm")
    refused(["mesh", "scene.prm", "--output", "a.msh", *from_file("mm.msh")], "210000 m high")
    refused(["modes", "scene.prm", *from_file("mm.msh")], "210000 m high")
    small = variant("km.msh", lambda x, y, z: [1e-3 * x, 1e-3 * y, 1e-3 * z])
    shown = runs(*small, "--set", "Reservoir/Density=0")
    expect("warning: mesh km.msh: the dam is 0.21 m high" in shown and "km (then it is 210 m high)" in shown, shown)
    for name, place, values in (("across.msh", lambda x, y, z: [-y, x, z], "y -x z"),
                                ("y_up.msh", lambda x, y, z: [x, z, -y], "x -z y"),
                                ("x_up.msh", lambda x, y, z: [z, y, -x], "-z y x"),
                                ("half_turn.msh", lambda x, y, z: [-x, -y, z], "-x -y z")):
        arguments = variant(name, place)
        refused(arguments, name, f'"Mesh/Axes" = {values}')
        mended(arguments, f"Mesh/Axes={values}")
    exchanged = [(kind, {2: 3, 3: 2}.get(tag, tag) if kind == 3 else tag, nodes) for kind, tag, nodes in mesh["elements"]]
    refused(variant("exchanged.msh", lambda x, y, z: [x, y, z], exchanged), "'downstream' faces upstream",
            "Exchange the names", "the names are wrong")


def files():
    """A pipe is no scene, nor is it waited for; what is in an included file that is no scene is not shown."""
    write_scene()
    os.mkfifo("pipe")
    refused(["pipe", "--validate"], "The scene file pipe cannot be read")
    write("with_pipe.prm", "include pipe\n")
    refused(["with_pipe.prm", "--validate"], "with_pipe.prm, line 1", "pipe cannot be read")
    write("private.txt", "\n# comment\nhunter2:x:0\n")
    write("wrong.prm", "include scene.prm\ninclude private.txt\n")
    refused(["wrong.prm", "--validate"], "private.txt, line 3", "an included file", "set ENTRY = VALUE")
    expect("hunter2" not in voussoir("wrong.prm", "--validate").stderr, "the line of an included file is shown")
    refused(["private.txt", "--validate"], 'private.txt, line 3: "hunter2:x:0"')


def tetrahedra():
    """Tetrahedra that were split into hexahedra: with degree 1 much too stiff, which is told."""
    write_mesh("split.msh", split_tetrahedra(arch_mesh()))
    scene = [write("split.prm", "subsection Mesh\n set Source = file\n set File = split.msh\nend\nsubsection Reservoir\n set Water level = 195\nend\n"
                                "subsection Motion\n set Source = none\nend\n")]
    degree = ["--set", "Elements/Degree=2"]
    warned([*scene, "--validate"], "split tetrahedra", "Jacobian", "0.074", "frequencies", "Set Elements/Degree = 2")
    expect(warnings(*scene, *degree, "--validate") == [], "degree 2")
    frequency = {}
    for name, arguments, n_warnings in (("hexahedra", ["scene.prm", *degree], 0), ("split, degree 1", scene, 1), ("split, degree 2", [*scene, *degree], 0)):
        result = voussoir("modes", *arguments, "--count", "1")
        expect(result.returncode == 0 and result.stderr.count("split tetrahedra") == n_warnings, f"{name}: {result.stderr}")
        frequency[name] = frequencies(result.stdout)[0]
    print("   ", frequency)
    expect(1.05 < frequency["split, degree 1"] / frequency["split, degree 2"] < 1.15, "the error that the warning states")
    expect(abs(frequency["split, degree 2"] / frequency["hexahedra"] - 1) < .01, "the remedy that it proposes")


def scenes():
    """The scenes that come with the program are not warned of."""
    for scene in sorted([*(SOURCE / "prm").glob("*.prm"), *(SOURCE / "benchmarks").glob("*.prm")]):
        text = scene.read_text()
        if "Source = file" in text:
            continue  # has a mesh of its own
        entries = ["Elements along=18", "Elements up=4", "Elements through=1"] + ["Joints=2"] * ("Joints = 0" not in text)
        section = "Arcs" if "Source = arcs" in text else "Arch210"
        settings = [f"Mesh/{section}/{entry}" for entry in entries]
        if "Motion" not in text:
            settings += ["Motion/Duration=12", "Dynamics/Steps per sample=20"]
        settings = [x for setting in settings for x in ("--set", setting)]
        result = warnings(str(scene), "--validate", *settings)
        print("   ", scene.name)
        expect(result == [], f"{scene}: {result}")


if __name__ == "__main__":
    run_cases(options, values, groups, axes, files, tetrahedra, scenes)
