#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: uniform damping, the entries of section Damping, and the explicit scheme, which needs it.

    program_damping.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import math
import re
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
import meshes  # noqa: E402
from compare import scene  # noqa: E402
from run_program import expect, refused, run_cases, runs, same, same_to_the_bit, settings, summary, table, voussoir, write, write_scene  # noqa: E402

OFF = {"FJA": 2e-3, "FJB": 2e-3, "KSM": 2e-3, "cohesive": 2e-3, "mass": 2e-3, "lifts": 1e-2, "bonds": 1e-2, "massless": 2e-3, "rock": 2e-3,
       "water": 2e-3, "water_massless": 2e-3, "water_rock": 2e-3}
WATER = ("Reservoir/Model=acoustic", "Reservoir/Reflection=0.5", "Reservoir/Element size=25")
UNIFORM = settings("Damping/Model=uniform", "Motion/Duration=0.5", "Output/Figures=false", "Dynamics/Factors=double")
ROCK = ("Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60")


def foundations():
    """The energy balance closes on each foundation, with open and with tied joints."""
    write_scene()
    for model in ("rigid", "massless", "rock"):
        for law in ("FJA", "KSM", "tied"):
            directory = f"{model}_{law}"
            more = (*ROCK, "Dynamics/Steps per sample=4") if model != "rigid" else ()
            runs("scene.prm", "--output", directory, *UNIFORM, *settings(f"Foundation/Model={model}", f"Joints/Model={law}", *more))
            error = summary(directory)["energy_balance_error"]
            print(f"    {model}, {law}: error of the energy balance {error:.1e}")
            expect(error < 1e-10, f"energy balance on {model}, {law}: {error}")


def entries():
    """No ratio is no damping. Coefficients are those of the ratio. Entries without effect."""
    write_scene()
    short = settings("Motion/Duration=0.2", "Output/Figures=false")
    for directory, model in (("none", "Rayleigh"), ("uniform", "uniform")):
        runs("scene.prm", "--output", directory, *short, *settings("Damping/Ratio=0", f"Damping/Model={model}"))
    same_to_the_bit("none", "uniform")
    runs("scene.prm", "--output", "ratio", *short)
    damping = json.loads(voussoir("scene.prm", "--validate", "--json").stdout)["damping"]
    given = settings(*(f"Damping/{name} coefficient={damping[key]!r}" for name, key in (("Mass", "mass_factor"), ("Stiffness", "stiffness_factor"))))
    runs("scene.prm", "--output", "coefficients", *short, *given)
    same("ratio", "coefficients", 1e-8, ("history",))
    warned = voussoir("scene.prm", "--validate", *settings("Damping/Model=uniform", "Damping/Frequency 1=2")).stdout
    expect("Damping/Frequency 1" in warned and "no effect: The damping is uniform" in warned, warned)
    warned = voussoir("scene.prm", "--validate", *settings("Damping/Model=uniform", "Damping/Terms=1")).stdout
    expect('Increase "Damping/Terms"' in warned, warned)


def modes():
    """Ratios of the tied dam and of the highest monolith between open joints."""
    write_scene()
    for model, tied, free in (("uniform", (.048, .052), (.048, .052)), ("Rayleigh", (.03, .05), (.05, .2))):
        found = json.loads(runs("modes", "scene.prm", "--count", "3", "--json", *settings(f"Damping/Model={model}")))
        monolith = found["free_monolith"]
        print(f"    {model}: {[mode['damping'] for mode in found['modes']]}, {monolith}")
        expect(all(tied[0] < mode["damping"] < tied[1] for mode in found["modes"]), f"{model}: ratios of the tied dam")
        expect(free[0] < monolith["damping"][0] < free[1], f"{model}: ratio of the free monolith")
        expect(monolith["frequencies"][0] < .8 * found["modes"][0]["frequency"], "a free monolith is softer than the arch")
    text = voussoir("modes", "scene.prm", "--count", "2", *settings("Damping/Frequency 1=4"))
    expect(re.search("between open joints has a damping ratio of", text.stderr), text.stderr)
    tied = runs("modes", "scene.prm", *settings("Joints/Model=tied"))
    expect("between open joints" not in tied, "a tied dam has no free monolith")


def explicit():
    """The explicit scheme has the openings of the implicit one with steps of 0.3 ms; its energy balance closes."""
    write_scene()
    common = settings("Damping/Model=uniform", "Damping/Reference frequency=2", "Motion/Duration=1", "Output/Figures=false")
    for name, *entries in (("FJA",), ("FJB",), ("KSM",), ("cohesive", "Joints/Strength=1e6"), ("lifts", "Mesh/Arch210/Lift joints=1",
                           "Mesh/Arch210/Base joint=true"),
                           ("bonds", "Mesh/Arch210/Lift joints=1", "Mesh/Arch210/Base joint=true", "Joints/Strength=1e6"),
                           ("massless", *ROCK, "Foundation/Model=massless"), ("rock", *ROCK, "Foundation/Model=rock"),
                           ("water", *WATER), ("water_massless", *WATER, *ROCK, "Foundation/Model=massless"), ("water_rock", *WATER, *ROCK, "Foundation/Model=rock"),
                           ("mass", "Damping/Model=Rayleigh", "Damping/Mass coefficient=0.6", "Damping/Stiffness coefficient=0")):
        law = "cohesive" if name == "bonds" else name if name in ("FJB", "KSM", "cohesive") else "FJA"
        more = [*common, *settings(f"Joints/Model={law}", *entries)]
        text = runs("scene.prm", "--output", f"explicit_{name}", *more, *settings("Dynamics/Scheme=explicit", "Dynamics/Explicit step=0.0005", "Dynamics/Steps per sample=16"))
        runs("scene.prm", "--output", f"implicit_{name}", *more, *settings("Dynamics/Steps per sample=32", "Dynamics/Factors=double"))
        if name == "FJA":  # steps of 0.95 of the critical one, recorded once per sample: peaks between are missed
            runs("scene.prm", "--output", "explicit_default", *more, *settings("Dynamics/Scheme=explicit"))
            default, fine_step = (summary(d)["extremes"]["max_opening"]["value"] for d in ("explicit_default", "implicit_FJA"))
            expect(abs(default / fine_step - 1.) < 2e-2, f"largest opening {default}, with small steps {fine_step}")
        a, b = (table(f"{scheme}_{name}/joints.csv") for scheme in ("explicit", "implicit"))
        column = [k for k, title in enumerate(a[0]) if title.startswith("opening_")]
        x, y = ([row[k] for row in rows[1] for k in column] for rows in (a, b))
        off = math.dist(x, y) / math.hypot(*y)
        error = summary(f"explicit_{name}")["energy_balance_error"]
        if name == "rock":
            (titles, rows), total = table("explicit_rock/energy.csv"), summary("explicit_rock")["rock"]["energy_balance_error"]
            feet, interface = (abs(rows[-1][titles.index(c)]) for c in ("rock_feet", "interface"))
            expect(total < 1e-10 and interface < 1e-10 * feet, f"rock: balance {total}, dam and rock {interface} of {feet}")
        if name.startswith("water"):
            of_water = float(re.search(r"energy balance of the water (\S+)", text)[1])
            forces = [list(zip(*table(f"{scheme}_{name}/blocks.csv")[1])) for scheme in ("explicit", "implicit")]
            worst = max(abs(max(map(abs, x)) / max(map(abs, y)) - 1) for x, y in zip(*forces))
            print(f"    {name}: largest base forces and moments off by {worst:.1e}, balance of the water {of_water:.1e}")
            expect(of_water < 1e-10 and worst < 2e-3, f"{name}: balance of the water {of_water}, base forces {worst}")
        print(f"    {name}: openings up to {max(y):.4f} m, off by {off:.1e}; energy balance {error:.1e}")
        expect(off < OFF[name] and error < 1e-10, f"{name}: openings off by {off}, energy balance {error}")


def rest():
    """Without a motion the explicit scheme keeps the static state, also where pairs at the base have another law, without history variables."""
    write_scene()
    write("rest.txt", "".join(f"{.01 * k:g} 0 0 0\n" for k in range(6)))
    still = settings("Motion/Source=file", "Motion/File=rest.txt", "Motion/Unit=g", "Motion/Duration=-1", "Dynamics/Scheme=explicit", "Dynamics/Steps per sample=16",
                     "Damping/Model=uniform", "Damping/Reference frequency=2", "Output/Figures=false")
    for model in ("massless", "rock"):
        for law, *entries in (("FJA", "Joints/Normal stiffness=2e10", "Joints/Tangential stiffness=1e10"), ("cohesive", "Joints/Strength=1e6"), ("KSM",)):
            runs("scene.prm", "--output", f"{model}_{law}", *still, *settings(*ROCK, f"Foundation/Model={model}", f"Joints/Model={law}", *entries))
            titles, rows = table(f"{model}_{law}/energy.csv")
            kinetic = max(row[titles.index("kinetic")] for row in rows)
            print(f"    {model}, {law}: kinetic energy up to {kinetic:.1e} J")
            expect(kinetic < 1e-3, f"{model}, {law}: the dam at rest gets the kinetic energy {kinetic} J")


def thrown():
    """The energy balance of the explicit scheme closes with an initial velocity and static loads."""
    write_scene()
    runs("scene.prm", "--output", "thrown", *settings("Motion/Source=none", "Motion/Duration=0.1", "Dynamics/Scheme=explicit", "Damping/Reference frequency=2",
                                                      "Output/Figures=false", "Dynamics/Initial velocity=all: 0.05 0 -0.05"))
    error = summary("thrown")["energy_balance_error"]
    expect(error < 1e-10, f"energy balance {error}")


def scaling():
    """Mass scaling makes the step of an own mesh with slivers longer by half, says so in a warning, and changes the openings little; it is for own meshes only."""
    write_scene()
    runs("mesh", "scene.prm", "--output", "own.msh", *settings("Mesh/Arch210/Equal rows=true", "Mesh/Arch210/Elements along=18", "Mesh/Arch210/Elements up=12"))
    common = ["scene.prm", *settings("Dynamics/Scheme=explicit", "Motion/Duration=0.5", "Output/Figures=false", "Damping/Reference frequency=2")]
    own = settings("Mesh/Source=file", "Mesh/File=own.msh")

    def critical(output, *entries):
        text = runs(*common, "--output", output, *own, *settings(*entries))
        return 1e-3 * float(re.search(r"explicit scheme for the dam (\S+) ms", text)[1]), text

    before, _ = critical("plain")
    after, text = critical("scaled", f"Dynamics/Mass scaling={1.5 * before:.6g}")
    added = float(re.search(r"Mass scaling\" adds (\S+) % to the mass", text)[1])
    openings = [summary(d)["extremes"]["max_opening"]["value"] for d in ("plain", "scaled")]
    print(f"    critical step {1e3 * before:.3f} and {1e3 * after:.3f} ms, {added} % of mass, openings {openings}")
    expect(1.5 * before / .95 <= after < 1.05 * 1.5 * before / .95 and 0. < added < 5., f"critical steps {before} and {after}, {added} % of mass")
    expect(abs(openings[1] / openings[0] - 1.) < .05 and summary("scaled")["energy_balance_error"] < 1e-10, f"openings {openings}")
    expect("Mass scaling" not in critical("idle", f"Dynamics/Mass scaling={.5 * before:.6g}")[1].replace("Dynamics/Mass scaling=", ""), "no mass is needed")
    refused([*common, "--validate", *settings("Dynamics/Mass scaling=0.001")], "Mass scaling", "meshes from files")


def pulse():
    """After a pulse the explicit dam on rock comes to rest, with a step of 0.99 of the critical one; a step of 1.01 is refused."""
    write_scene()
    write("pulse.csv", "t,x,y,z\n" + "".join(f"{.01 * k:.2f},{3. * math.sin(math.pi * k / 20) if k < 40 else 0:.6f},0,0\n" for k in range(2101)))
    common = ["scene.prm", *settings("Damping/Model=automatic", "Dynamics/Scheme=explicit", "Foundation/Model=rock", *ROCK, "Motion/Source=file",
                                     "Motion/File=pulse.csv", "Motion/Unit=m/s2", "Motion/Baseline=none", "Output/Figures=false")]
    setup = runs(*common, "--validate")
    of_dam, of_rock = (factor * float(re.search(text + r" (\S+) m?s", setup)[1]) for factor, text in (
        (.001, "step of an explicit scheme for the dam"), (1., "critical time step of the rock is")))
    critical = min(of_dam, of_rock)
    refused([*common, "--validate", *settings(f"Dynamics/Explicit step={1.01 * critical:.8g}")], "above the critical step", "of the rock" if of_rock < of_dam else "elements at")
    sample = round(3 * .99 * critical, 9)
    runs(*common, "--output", "rest", *settings(f"Motion/Duration={math.ceil(20 / sample) * sample:.12g}", f"Motion/Time step={sample:.12g}", f"Dynamics/Explicit step={.9901 * critical:.12g}"))
    expect(f"3 steps of {1e3 * .99 * critical:.4g} ms" in Path("rest/log.txt").read_text(), "a step of 0.99 of the critical one")
    titles, rows = table("rest/energy.csv")
    kinetic = [row[titles.index("kinetic")] for row in rows]
    quarter = len(kinetic) // 4
    early, late = max(kinetic[quarter:2 * quarter]), max(kinetic[-quarter:])
    print(f"    kinetic energy up to {max(kinetic):.1e} J, in the second quarter {early:.1e} J, in the last one {late:.1e} J")
    expect(late < 1e-2 * early < 1e-3 * max(kinetic) and summary("rest")["energy_balance_error"] < 1e-9, "the dam does not come to rest")


def decay(q):
    """Damping ratio from the differences of successive extremes, in which a slow offset cancels."""
    peaks = [b - ((c - a) / 4)**2 / ((a - 2 * b + c) / 2) for a, b, c in zip(q, q[1:], q[2:]) if (b - a) * (c - b) < 0]
    decrement = math.log(abs(peaks[5] - peaks[4]) / abs(peaks[13] - peaks[12])) / 8
    return decrement / math.hypot(math.pi, decrement)


def zones():
    """A bar with a foot of 8 % and a rest of 3 % decays as printed, and as the complex mode of two bodies with exactly these ratios. Zones
    with equal ratios are uniform damping to the bit. A dam of zones with a joint: both schemes agree."""
    n, n_foot, c, ratios, w = 8, 3, 160., (.08, .03), 4 * math.pi
    nodes, hexes, quads = meshes.block(lambda i, j, k: (4. * j, 4. * i, 2.5 * k), (1,), 1, n, {**meshes.DAM, "right": None, "left": None})
    meshes.write("bar.msh", nodes, [(101 if k < n_foot else 1, cell) for k, (_, cell) in enumerate(hexes)], quads, volumes={101: "monolith 1 foot", 1: "monolith 1"})
    write("pulse.txt", "".join(f"{.0025 * k:.4f} 0 0 {math.sin(math.pi * k / 100) if k < 200 else 0:.9f}\n" for k in range(1601)))
    damping = {"Model": "uniform", "Reference frequency": 2, "Ratio": ratios[1], "Zones": f"foot: {ratios[0]}"}
    bar = scene("bar", "bar.msh", Concrete={"Young's modulus": 2500 * c**2}, Damping=damping, Motion={
        "Source": "file", "File": "pulse.txt", "Unit": "m/s^2", "Duration": 4, "Time step": .0025, "Baseline": "none"})
    parts = [numpy.zeros((n + 1, n + 1)) for _ in ratios]
    for k in range(n):
        parts[k >= n_foot][k:k + 2, k:k + 2] += (c / 2.5)**2 * numpy.array([[1, -1], [-1, 1]])
    mass = numpy.diag([1.] * (n - 1) + [.5])
    pole = 1j * w
    for _ in range(30):  # lambda^2 M + sum K_z (lambda/w)^(2 g)/cos(pi g), where g = d/(pi/2 + d) gives free oscillations the ratio sin d
        powers = [math.asin(z) / (math.pi / 2 + math.asin(z)) for z in ratios]
        K = sum(K[1:, 1:] * (pole / w)**(2 * g) / math.cos(math.pi * g) for K, g in zip(parts, powers))
        pole = 1j * numpy.sqrt(min(numpy.linalg.eigvals(numpy.linalg.solve(mass, K)), key=abs))
    found = json.loads(runs("modes", bar, "--count", "6", "--json"))["modes"]
    axial = min(found, key=lambda mode: abs(mode["frequency"] - 2.))
    exact = -pole.real / abs(pole)
    expect(abs(axial["damping"] / exact - 1.) < .03, f"ratio {axial} of the complex mode {exact}")
    for name, more in (("trapezoidal", "Dynamics/Factors=double"), ("single", "Dynamics/Factors=single"), ("explicit", "Dynamics/Scheme=explicit")):
        runs(bar, "--output", name, *settings(more))
        titles, rows = table(f"{name}/history.csv")
        ratio, error = decay([row[titles.index("crest_z")] for row in rows if row[0] > .6]), summary(name)["energy_balance_error"]
        print(f"    {name}: ratio {ratio:.5f}, printed {axial['damping']:.5f}, exact {exact:.5f}, energy balance {error:.1e}")
        expect(abs(ratio / axial["damping"] - 1.) < .02 and error < (1e-10 if name != "single" else 1e-6), f"{name}: ratio {ratio}, energy balance {error}")
        for directory, entry in (("equal", "foot: 0.03"), ("none", "")):
            runs(bar, "--output", directory, *settings(more, f"Damping/Zones={entry}"))
        same_to_the_bit("equal", "none")
    meshes.zoned_arch("dry.msh", (1, 1, 2, 2), 1, 3)
    meshes.with_water("dry.msh", "wet.msh", [30.] * 3, 60.)
    write_scene()
    for name, reservoir in (("dry", {}), ("wet", {"Model": "acoustic", "Density": 1000})):
        arch = scene(name, f"{name}.msh", Concrete={"Young's modulus": 2e9}, Damping={**damping, "Zones": "heel: 0.08, crown: 0.02"}, Joints={"Model": "FJA"},
                     Reservoir=reservoir, Motion={"Source": "file", "File": "motion.txt", "Unit": "m/s^2", "Duration": 1, "Time step": .01})
        runs(arch, "--output", "fine", *settings("Dynamics/Steps per sample=32", "Dynamics/Factors=double"))
        runs(arch, "--output", "explicit_arch", *settings("Dynamics/Scheme=explicit", "Dynamics/Explicit step=0.0002", "Dynamics/Steps per sample=16"))
        a, b = (summary(d)["extremes"]["max_opening"]["value"] for d in ("fine", "explicit_arch"))
        errors = [summary(d)["energy_balance_error"] for d in ("fine", "explicit_arch")]
        print(f"    {name} arch: openings {a:.6f} and {b:.6f} m, energy balance {errors}")
        expect(b > 1e-3 and abs(a / b - 1.) < 5e-3 and max(errors) < 1e-10, f"{name} arch of zones: {a}, {b}, {errors}")


if __name__ == "__main__":
    run_cases(foundations, entries, modes, explicit, rest, thrown, scaling, pulse, zones)
