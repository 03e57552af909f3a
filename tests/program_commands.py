#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the command line as an interface: spelling of options, completion in bash, JSON objects, questions of `voussoir new`.

    program_commands.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

from run_program import VOUSSOIR, arch_mesh, expect, frequencies, refused, run_cases, runs, settings, voussoir, write, write_scene


def spelling():
    """--option=value and -o mean --option value, for commands of the program and of Python; wrong ones are refused."""
    write_scene()
    for name, words in (("a", ["--output", "a.msh", "--format", "2.2"]), ("b", ["--format=2.2", "--output=b.msh"]),
                        ("c", ["-o", "c.msh", "--format=2.2"]), ("d", ["-o=d.msh", "--format", "2.2"])):
        runs("mesh", *words, "scene.prm", "--set=Mesh/Arch210/Joints=1")
        expect(Path(f"{name}.msh").read_bytes() == Path("a.msh").read_bytes(), f"{words}: another mesh")
    expect(len(frequencies(runs("modes", "scene.prm", "--count=1"))) == 1, "--count=1")
    expect("friction 0.25" in runs("scene.prm", "--validate", "--set=Joints/Friction=0.25"), "--set=ENTRY=VALUE")
    write("arcs.csv", "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n"
                      "0,-4,60,14,42,25,27\n30,-8,75,12,58,38,41\n60,-7,90,9,76,47,49\n90,0,100,4,96,53,55\n")
    runs("arcs", "arcs.csv", "--output", "e.prm", "--kind", "circular")
    runs("arcs", "--kind=circular", "-o", "f.prm", "arcs.csv")
    expect(Path("e.prm").read_bytes() == Path("f.prm").read_bytes(), "arcs: another scene")
    for arguments, parts in ((["scene.prm", "--quiet=1"], ("--quiet", "has no value", '"=1"')),
                             (["scene.prm", "--output="], ("--output", "needs a value", "DIR")),
                             (["scene.prm", "-o"], ("--output", "needs a value")),
                             (["scene.prm", "--set", "--output=a"], ("--set", "needs a value")),
                             (["scene.prm", "-o", "a", "--output=b"], ("--output", "twice")),
                             (["scene.prm", "--outptu=a"], ("no option --outptu", "Did you mean --output?")),
                             (["scene", "scene.prm", "-o", "a"], ("`voussoir scene` has no option --output", "`voussoir mesh`")),
                             (["scene.prm", "--json"], ("--json requires --validate",)),
                             (["completion", "zsh"], ("bash",))):
        refused(arguments, *parts)
    expect(not Path("output").exists(), "a refused run wrote")


def completion():
    """The script of bash offers what help and `voussoir parameters` list, and files of the right kind."""
    if shutil.which("bash") is None:
        print("not installed: bash")
        sys.exit(77)
    write("completion.bash", runs("completion", "bash"))
    for name in ("scene.prm", "other.txt", "a.msh", "arcs.csv"):
        write(name, "")
    Path("out").mkdir()

    def offers(*words):
        result = subprocess.run(["bash", "--norc", "-c", 'source completion.bash; COMP_WORDS=(voussoir "$@"); COMP_CWORD=$#\n'
                                 '_voussoir voussoir; printf "%s\\n" "${COMPREPLY[@]}"', "bash", *words], capture_output=True, text=True)
        expect(result.returncode == 0 and result.stderr == "", f"{words}: {result.stderr}")
        return sorted(filter(None, result.stdout.splitlines()))

    commands = set(re.findall(r"^voussoir ([a-z]+)\b", runs("--help"), re.M))
    expect(len(commands) > 12 and set(offers("")) == commands | {"out", "scene.prm"}, f"first word: {offers('')}, {commands}")
    for command in ["", *commands]:
        words, text = [command] if command else ["scene.prm"], runs(*([command] if command else ["scene.prm"]), "--help")
        options = set(re.findall(r"^  (--[a-z-]+)", text, re.M))
        found = set(offers(*words, "-")) - {"--help", "--version"}
        expect(found == options, f"options of {words}: {found}, help: {options}")
    for words, expected in ((["mod"], ["modes"]), (["scene.prm", "--re"], ["--resume"]), (["scene.prm", "--output", ""], ["out"]),
                            (["scene.prm", "--output", "=", "o"], ["out"]), (["scene.prm", "--output", "="], ["out"]),
                            (["scene.prm", "-o", ""], ["out"]), (["mesh", "scene.prm", "-o", ""], ["a.msh", "out"]),
                            (["mesh", "scene.prm", "--format", ""], ["2.2", "4.1"]), (["modes", "scene.prm", "--count", ""], []),
                            (["mesh", ""], ["out", "scene.prm"]), (["arcs", ""], ["arcs.csv", "out"]),
                            (["report", ""], ["out"]), (["parameters", ""], ["json", "markdown", "prm"]), (["new", "s"], ["scene.prm"]),
                            (["scene.prm", "--set", "Joints/Fri"], ["Joints/Friction="]), (["--set", "=", "Joints/Fri"], ["Joints/Friction="]),
                            (["scene.prm", "--set", "'Concrete/Y"], ["Concrete/Young's modulus="]),
                            (["scene.prm", "--set", r"Concrete/Young\'s\ m"], ["Concrete/Young's modulus="]),
                            (["scene.prm", "--set", "Joints/Friction", "=", "0"], []), (["study", "scene.prm", "--set", "J"], [])):
        expect(offers(*words) == expected, f"{words}: {offers(*words)} instead of {expected}")

    def all_entries(start):
        found = []
        for offer in offers("scene.prm", "--set", start):
            found += all_entries(offer) if offer.endswith("/") else [offer[:-1]]
        return found

    entries = re.findall(r"^\| `(.*?)` \|", runs("parameters", "markdown"), re.M)
    found = all_entries("")
    expect(len(entries) > 100 and sorted(found) == sorted(entries), f"entries: {set(found) ^ set(entries)}")


def objects():
    """--validate --json and modes --json have the numbers of the text, and the formulas of the damping."""
    def numbers(pattern, text):
        match = re.search(pattern, text, re.M)
        expect(match, f"no '{pattern}' in {text}")
        return [float(x) for x in match.groups()]

    def close(x, y, digits, what):
        expect(math.isclose(x, y, rel_tol=.5001 * 10 ** (1 - digits), abs_tol=0), f"{what}: {x}, {y}")

    def both(*arguments):
        text, result = voussoir("scene.prm", "--validate", *arguments).stdout, voussoir("scene.prm", "--validate", "--json", *arguments)
        expect(result.returncode == 0, result.stderr)
        return text, json.loads(result.stdout), result.stderr

    write_scene()
    text, model, messages = both(*settings("Concrete/Density=2.4", "Motion/Scale y=0.5", "Motion/Scale z=0.2", "Damping/Ratio=0.04"))
    mesh = model["mesh"]
    expect(numbers(r": (\d+) cells, degree (\d+), (\d+) dofs, (\d+) monoliths", text) ==
           [mesh[key] for key in ("cells", "degree", "dofs", "monoliths")], f"{mesh}")
    close(numbers(r"volume (\S+) m3", text)[0], mesh["volume"], 4, "volume")
    expect(numbers(r"Joints +(\d+) joints, (\d+) pairs, law FJA \(friction (\S+)\)", text) ==
           [mesh["joints"], mesh["pairs"], model["joints"]["friction"]], f"{mesh}")
    expect((model["law"], model["foundation"], model["scene"]) == ("FJA", "rigid", "scene"), f"{model}")
    unknowns = model["unknowns"]
    expect(numbers(r"Unknowns +(\d+) of the monoliths, (\d+) of the joints", text) == [unknowns["monoliths"], unknowns["joints"]] ==
           [mesh["dofs"], 3 * mesh["pairs"]], f"{unknowns}")
    damping, (w1, w2) = model["damping"], (2 * math.pi * f for f in (1.2, 6))
    close(damping["mass_factor"], .08 * w1 * w2 / (w1 + w2), 9, "a")
    close(damping["stiffness_factor"], .08 / (w1 + w2), 9, "b")
    expect([damping["ratio"], damping["frequency_1"], damping["frequency_2"]] == [.04, 1.2, 6], f"{damping}")
    water = model["water"]
    expect(water["level"] == 195 and water["added_mass"] == "Westergaard" and water["factor"] == 1 and water["reaches_dam"], f"{water}")
    close(numbers(r"x 1, (\S+) kg along x", text)[0], water["added_mass_x"], 4, "added mass")
    for name, key, unit in (("PGA", "acceleration", 9.80665), ("PGV", "velocity", 1), ("PGD", "displacement", 1)):
        shown = numbers(rf"{name} (\S+) (\S+) (\S+)", text)
        expect(len(set(shown)) == 3 and all(abs(a - b / unit) <= .50001e-3 for a, b in zip(shown, model["motion"]["peak_" + key])), f"{name}")
    expect(numbers(r"Steps +(\d+) of (\S+) s", text) == [model["steps"], model["time_step"]] == [50, .01], "steps")
    expect(model["motion"]["duration"] == .5 and "rock" not in model, f"{model}")
    memory = model["memory_bytes"]
    for shown, key in zip(numbers(r"Memory +about (\S+) GiB, and (\S+) GiB more", text), ("run", "halved_step")):
        expect(abs(shown - memory[key] / 2 ** 30) <= .00501, f"{key}: {memory}")
    groups = [re.sub("^Groups ", "", line).strip() for line in re.search(r"^Groups(.*\n)+(?=Unknowns)", text, re.M)[0].splitlines()]
    expect([row.strip() for row in model["groups"]] == groups and len(groups) == 5, f"{model['groups']}, {groups}")
    warned = re.findall("^warning: (.*)$", text, re.M)
    expect(len(warned) == 2 and [w["text"] for w in model["warnings"]] == warned and messages == "".join(f"voussoir: warning: {w}\n" for w in warned), messages)
    for law in ("FJB", "tied"):
        expect(both(*settings(f"Joints/Model={law}"))[1]["law"] == law, law)
    expect(both(*settings("Joints/Overrides=2: FJB"))[1]["joints"]["overrides"] == {"2": "FJB"}, "overrides")
    still = both(*settings("Motion/Source=none", "Reservoir/Density=0"))[1]
    expect(still["steps"] == 0 and "motion" not in still and not still["water"]["reaches_dam"], f"{still}")
    text, model, _ = both(*settings("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60",
                                    "Dynamics/Steps per sample=4"))
    close(numbers(r"critical time step of the rock (\S+) s", text)[0], model["rock"]["critical_time_step"], 4, "critical time step")
    expect(model["rock"]["time_step"] == model["time_step"] == .0025, f"{model['rock']}")
    result = voussoir("scene.prm", "--validate", "--json", *settings("Joints/Model=FJC"))
    expect(result.returncode == 2 and result.stdout == "" and "FJC" in result.stderr, f"{result}")

    text = runs("modes", "scene.prm", "--count", "4", "--output", "modes")
    found = json.loads(runs("modes", "scene.prm", "--count", "4", "--json"))
    expect([f"{mode['frequency']:.5f}" for mode in found["modes"]] == re.findall(r"^ +\d+ +(\d+\.\d{5}) ", text, re.M), f"{found}")
    header, *rows = [line.split(",") for line in Path("modes/modes.csv").read_text().splitlines()]
    for row, mode in zip(rows, found["modes"], strict=True):
        expect(list(mode) == [*header, "damping"], f"{list(mode)}")
        for key, value in zip(header, row):
            close(float(value), mode[key], 6, key)
        for d, mass in zip("xyz", found["free_mass"]):
            close(mode[f"participation_{d}"] ** 2 / mass, mode[f"share_{d}"], 6, f"share {d}")
    result = voussoir("modes", "scene.prm", "--count", "1", "--json", *settings("Concrete/Density=2.4"))
    warned = json.loads(result.stdout)["warnings"]
    expect(len(warned) == 1 and result.stderr == f"voussoir: warning: {warned[0]['text']}\n", result.stderr)
    expect(warned[0]["class"] == "physics" and warned[0]["place"] == "--set", f"{warned}")


def answered(answers, *arguments):
    return subprocess.run([VOUSSOIR, "new", *arguments], input=answers, capture_output=True, text=True, timeout=120)


def answered_file(name, *answers):
    result = answered("\n".join(answers), name)
    expect(result.returncode == 0, f"{result}")
    return name


def accepted(file, lines, allowed="at rest"):
    """The scene is short and valid without other warnings than the @p allowed ones, and each entry has a comment; its model as JSON, its entries."""
    text = Path(file).read_text()
    expect(text.count("\n") <= lines, f"{file} is long: {text}")
    for before, line in zip(text.splitlines(), text.splitlines()[1:]):
        expect(not line.strip().startswith("set ") or re.match(r" *# \w", before), f"no comment: {line}")
    result = voussoir(file, "--validate", "--json")
    expect(result.returncode == 0, f"{file}: {result.stderr}\n{text}")
    model = json.loads(result.stdout)
    expect([w for w in model["warnings"] if not re.search(allowed, w["text"])] == [], f"{model['warnings']}")
    return model, dict(re.findall(r"^ *set (.*?) = (.*)$", text, re.M))


def questions():
    """`voussoir new`: defaults, checked answers, and files that --validate accepts."""
    # All defaults: the scene of an empty file
    result = answered("")
    expect(result.returncode == 0 and "Enter takes the value in brackets. The end of the input" in result.stdout, f"{result}")
    write("empty.prm", "")
    expect(runs("scene", "dam.prm") == runs("scene", "empty.prm"), "the defaults of the questions are not those of the program")
    _, entries = accepted("dam.prm", 70)
    expect({"Young's modulus", "Water level", "Friction", "Peak acceleration", "Ratio"} <= set(entries), f"{entries}")
    # Nothing is replaced
    before = Path("dam.prm").read_bytes()
    refused(["new"], "dam.prm exists", "Name another file")
    expect(Path("dam.prm").read_bytes() == before, "dam.prm was replaced")
    refused(["new", "a.prm", "b.prm"], "b.prm")

    # Wrong answers are asked again: missing files, implausible or unknown values, rock that is not there
    arch_mesh()
    Path("sub").mkdir()
    result = answered("\n".join(["fiel", "file", "", "missing.msh", "../arch.msh", "", "", "195 kg", "211", "190.5 m", "FJX", "KSM", "rock",
                                 "rigid", "file", "none.txt", "../motion.txt", "cm/s^2", "../motion.txt", "m/s^2"]), "sub/own.prm")
    expect(result.returncode == 0, f"{result}")
    for part in ('"fiel"', "Name a file", "missing.msh does not exist", '"kg"', "z = 0 to 210 m", '"FJX"', "no volumes of rock",
                 "none.txt does not exist", "peak acceleration of the motion is 0.0006"):
        expect(part in result.stdout, f"'{part}' is missing: {result.stdout}")
    model, entries = accepted("sub/own.prm", 90)
    expect((model["law"], model["foundation"], model["water"]["level"]) == ("KSM", "rigid", 190.5), f"{model}")
    expect(model["mesh"]["monoliths"] == 3 and entries["Source"] == "file" and entries["Unit"] == "m/s^2", f"{entries}")

    # The input ends before a file is named; files of components
    result = answered("file\n", "b.prm")
    expect(result.returncode == 2 and "Name a file" in result.stderr and not Path("b.prm").exists(), f"{result}")
    write("x.txt", "".join(f"{.01 * i:.2f} {math.sin(.3 * i):.6f}\n" for i in range(101)))
    file = answered_file("c.prm", "", "", "cohesive", "2 MPa", "", "", "file", "", "x.txt", "", "", "")
    model, entries = accepted(file, 100, "at rest|cohesive joints are up to")
    expect("# Length of the ground motion and of the run, or of each part of Sequence [s]. -1: length of the shortest record, or 20.48 s" in Path(file).read_text(), "-1")
    expect(model["law"] == "cohesive" and entries["Strength"] == "2 MPa" and entries["File x"] == "x.txt" and "File y" not in entries, f"{entries}")
    expect(model["motion"]["peak_acceleration"][1:] == [0, 0], f"{model['motion']}")
    result = answered("\n".join(["", "180", "tied", "massless", "artificial", "20", "0.2"]), "d.prm")
    expect("Motion/Peak acceleration is 20 g" in result.stdout, result.stdout)
    model, entries = accepted("d.prm", 80)
    expect((model["law"], model["foundation"], entries["Enabled"]) == ("tied", "massless", "true"), f"{entries}")
    expect(abs(model["motion"]["peak_acceleration"][0] / (.2 * 9.80665) - 1) < .05, f"{model['motion']}")

    # Rock with mass: the time step of the dam is stable, a larger one is refused
    runs("mesh", "scene.prm", "--output", "rock.msh", *settings("Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60"))
    walls = "at rest|in no physical surface"  # the ends of the built-in dam
    model, entries = accepted(answered_file("e.prm", "file", "rock.msh", "", "", "", "", "rock"), 90, walls)
    _, still = accepted(answered_file("f.prm", "file", "rock.msh", "", "", "", "", "rock", "none"), 80, walls)
    expect("Steps per sample" not in still, f"{still}")
    steps = int(entries.get("Steps per sample", 1))
    larger = {2: 1, 5: 2, 10: 5, 20: 10}[steps]
    print("    rock:", steps, "steps per sample;", model["rock"])
    expect(.01 / steps <= model["rock"]["critical_time_step"] < .01 / larger, f"{model['rock']}")
    refused(["e.prm", "--validate", *settings(f"Dynamics/Steps per sample={larger}", "Foundation/Substeps=1")], "Steps per sample")


if __name__ == "__main__":
    run_cases(spelling, completion, objects, questions)
