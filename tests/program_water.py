#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of compressible water, Reservoir/Model = acoustic.

    program_water.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import math
import re
import sys
from pathlib import Path

import numpy as np

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes as golden  # noqa: E402
from compare import read_vtu, scene  # noqa: E402
from program_blocks import blocks, force  # noqa: E402
from run_program import expect, frequencies, refused, run_cases, runs, same, settings, stop_and_resume, summary, table, write_scene  # noqa: E402

RHO, C, H = 1000., 1440., 60.
# Factors in double precision: tests of round-off
ACOUSTIC, INCOMPRESSIBLE = settings("Reservoir/Model=acoustic", "Dynamics/Factors=double"), settings("Reservoir/Model=incompressible")
FDLV112 = Path(__file__).resolve().parents[2] / "shared" / "reference" / "data" / "water" / "fdlv112_dam_hex.msh"


def bessel(x):
    """J_0 by its integral."""
    angles = (np.arange(400) + .5) * np.pi / 400
    return np.cos(np.outer(x, np.sin(angles))).mean(axis=1)


def wall_force(t, a, parts=8):
    """Force per width on a rigid vertical wall of the depth H, infinite channel, 40 modes: F = 2 rho c/H sum I^2 int a J_0 [N/m]."""
    dt = (t[1] - t[0]) / parts
    fine = np.arange(len(t) * parts) * dt
    a_fine, result = np.interp(fine, t, a, right=0), np.zeros(len(t))
    for n in range(1, 41):
        k = (2 * n - 1) * np.pi / 2 / H
        result += 2 * RHO * C / H / k**2 * np.convolve(a_fine, bessel(C * k * fine))[:len(fine):parts] * dt
    return result


def base_force(directory):
    """Downstream force of the ground on all bases over time [N]."""
    names = {name: base for name, base in summary(directory)["blocks"].items()}
    return np.array([sum(force(of[int(name.split()[1])], base)[0][0] for name, base in names.items()) for _, of in blocks(directory)])


def pulse():
    """A stiff wall under pulses: force of the water against the exact one of an infinite channel. The pulse of 0.4 s is below the first frequency of
    the channel, where only its length counts: 15 depths are almost infinite. That of 0.1 s is above, where the damped layers absorb."""
    dt = .000625
    t = np.arange(0, 1 + dt / 2, dt)
    golden.wall("wall.msh", n_up=24)
    file = scene("stiff", "wall.msh", Concrete={"Young's modulus": 2e17, "Density": 2500}, Damping={"Ratio": 0})
    common = settings("Motion/Source=file", "Motion/File=pulse.txt", "Motion/Unit=m/s^2", f"Motion/Time step={dt}", "Motion/Duration=1",
                      "Reservoir/Water level=60", f"Reservoir/Density={RHO}", f"Reservoir/Sound speed={C}", "Reservoir/Element size=2.5",
                      "Output/Figures=false", "Statics/Self-weight=none", "Joints/Model=tied")
    for length, period, limit in ((0, .4, .02), (900, .4, .005), (0, .1, .07), (900, .1, .01)):
        a = np.where(t < period, np.sin(2 * np.pi * t / period), 0)
        np.savetxt("pulse.txt", np.column_stack([t, a, 0 * t, 0 * t]))
        exact = wall_force(t, a)
        runs(file, "--output", "dry", "--overwrite", *common, *settings("Reservoir/Model=none"))
        text = runs(file, "--output", "wet", "--overwrite", *common, *ACOUSTIC, *settings(f"Reservoir/Length={length}"))
        found = (base_force("wet") - base_force("dry")) / 10
        mean = np.concatenate([[0], .5 * (exact[1:] + exact[:-1])])  # forces are means over the steps
        error = np.abs(found - mean).max() / np.abs(exact).max()
        print(f"    length {length} m, pulse of {period} s: largest error {100 * error:.2f} % of the largest force {exact.max():.4g} N/m")
        expect(error < limit, f"error {error}")
        energies(text, "wet")


def bed_pressure(v, dt, alpha, width):
    """Pressure at the bed of a channel whose bed and banks move vertically with the velocity v at intervals dt [Pa].

    Reflection 1: sum of plane waves between bed and surface. Otherwise differences in z, with the mean over the width: phi'' = c^2 phi_zz -
    2 c^2 q/B phi', phi_z = v + q phi' at the bed."""
    if alpha == 1.:
        p1 = RHO * C * v
        t, trip = np.arange(len(v)) * dt, 2 * H / C
        return p1 + 2 * sum((-1)**k * np.interp(t - k * trip, t, p1, left=0) for k in range(1, int(t[-1] / trip) + 1))
    q, n, parts = (1 - alpha) / (1 + alpha) / C, 240, 8
    dz, step = H / n, dt / parts
    phi, pi, result = np.zeros(n + 1), np.zeros(n + 1), [0.]
    for k in range((len(v) - 1) * parts):
        velocity = np.interp((k + .5) / parts, range(len(v)), v)
        flux = np.concatenate([[0.], np.diff(phi) / dz, [0.]])  # the last node is the surface
        force = C**2 * np.diff(flux) / np.concatenate([[dz / 2], np.full(n - 1, dz), [dz / 2]])
        damping = np.full(n + 1, 2 * C**2 * q / width)
        damping[0] += C**2 * q / (dz / 2)
        force[0] -= C**2 * velocity / (dz / 2)
        pi = (pi * (1 - .5 * step * damping) + step * force) / (1 + .5 * step * damping)
        pi[-1] = 0.
        phi = phi + step * pi
        if k % parts == parts - 1:
            result.append(-RHO * pi[0])
    return np.array(result)


def ground():
    """Bed and banks of a box move, and the wall with them: pressure at its middle and at the bank.

    Vertical motion: the pressure of bed_pressure().
    Slow cross-stream motion a: p = 2 rho a/H sum I_n cos(k_n z) tanh(k_n B/2)/k_n at the bank, k_n = (2n - 1) pi/2H, I_n = (-1)^(n-1)/k_n."""
    dt, width = .000625, 10.
    golden.wall("ground.msh", n_up=24)
    file = scene("ground", "ground.msh", Concrete={"Young's modulus": 2e15, "Density": 2500}, Damping={"Ratio": 0})
    common = [*ACOUSTIC, *settings(
        "Motion/Source=file", "Motion/File=ground.txt", "Motion/Unit=m/s^2", "Reservoir/Water level=60", f"Reservoir/Density={RHO}",
        f"Reservoir/Sound speed={C}", "Reservoir/Element size=2.5", "Output/Figures=false", "Statics/Self-weight=none", "Joints/Model=tied",
        "Output/Pressure depths=60,20")]
    t = np.arange(0, 1 + dt / 2, dt)
    a = np.where(t < .1, np.sin(2 * np.pi * t / .1), 0)
    v = .1 / 2 / np.pi * np.where(t < .1, 1 - np.cos(2 * np.pi * t / .1), 0)
    np.savetxt("ground.txt", np.column_stack([t, 0 * t, 0 * t, a]))
    for alpha in (1., .5):
        text = runs(file, "--output", "vertical", "--overwrite", *common, *settings(
            f"Motion/Time step={dt}", "Motion/Duration=1", f"Reservoir/Reflection={alpha}"))
        names, rows = table("vertical/history.csv")
        found = np.array([row[names.index("pressure_60")] for row in rows])
        exact = bed_pressure(v, dt, alpha, width)[:len(found)]
        error = np.abs(found - exact).max() / np.abs(exact).max()
        print(f"    vertical motion, reflection {alpha}: largest error of the pressure at the bed {100 * error:.2f} % of {np.abs(exact).max():.4g} Pa")
        expect(error < .03, f"{error}")
        energies(text, "vertical")
        expect(max(abs(row[names.index("pressure_20")]) for row in rows) > .1 * np.abs(found).max(), "pressure in the middle")
    dt, period = .005, 2.
    t = np.arange(0, 2 * period + dt / 2, dt)
    a = np.where(t < period, np.sin(2 * np.pi * t / period)**2, 0)
    np.savetxt("ground.txt", np.column_stack([t, 0 * t, a, 0 * t]))
    text = runs(file, "--output", "cross", *common, *settings(f"Motion/Time step={dt}", f"Motion/Duration={period}", "Dynamics/Steps per sample=5"))
    names, rows = table("cross/water_pressure.csv")
    largest, off = 0., 0.
    for row in rows:
        x, y, z, _, high, low = row
        if abs(abs(y) - width / 2) < 1e-6:
            k = (2 * np.arange(1, 400) - 1) * np.pi / 2 / H
            exact = 2 * RHO / H * ((-1.)**np.arange(399) / k * np.cos(k * z) * np.tanh(k * width / 2) / k).sum()
            largest, off = max(largest, exact), max(off, abs((high if y * sum(r[4] * r[1] for r in rows) > 0 else -low) - exact))
    print(f"    cross-stream motion: largest error of the pressure at the bank {100 * off / largest:.2f} % of {largest:.4g} Pa")
    expect(largest > 1e3 and off < .03 * largest, f"{off}, {largest}")


def rock():
    """On rock with mass bed and banks move with the free field: all accounts close, with one and with two rock steps; a killed run goes on
    as if it had not been. Pressures are in the files of ParaView, in the envelope and in the frames."""
    write_scene()
    common = [*ACOUSTIC, *settings("Foundation/Model=rock", "Mesh/Arch210/Rock/Element size=60", "Motion/Duration=0.6", "Reservoir/Element size=25",
                                   "Reservoir/Reflection=0.5", "Dynamics/Steps per sample=4", "Output/Checkpoint interval=40", "Output/Pressure depths=50")]
    text = runs("scene.prm", "--output", "plain", *common, *settings("Output/Solution interval=100", "Foundation/Substeps=1"))
    energies(text, "plain")
    expect("free field of the rock" in text, text)
    for name in ("plain/solution-00100.vtu", "plain/envelope.vtu"):
        fields = read_vtu(name)
        of_water = [field for field in fields if "water_pressure" in field]
        expect(of_water and all(np.abs(fields[field]).max() > 1e4 for field in of_water), f"{name}: {list(fields)}")
    stop_and_resume("plain", [*common, *settings("Foundation/Substeps=1", "Output/Solution interval=0")])
    runs("scene.prm", "--output", "frames", *common, *settings("Foundation/Substeps=1", "Output/Frames=4"))
    head, data = Path("frames/frames.bin").read_bytes().split(b"\n", 1)
    n, quads = (int(re.search(rf'"{word}": (\d+)'.encode(), head)[1]) for word in ("nodes", "quads"))
    expect(b'"pressure": true' in head and (len(data) - 12 * n - 24 * quads) % (8 + 16 + 12 * n) == 0, head)
    energies(runs("scene.prm", "--output", "substeps", *common, *settings("Foundation/Substeps=2", "Dynamics/Steps per sample=2")), "substeps")
    t = np.arange(0, .605, .01)  # 8 Hz, for the interpolation of the valley's velocity in time
    np.savetxt("fast.txt", np.column_stack([t, 0 * t, 0 * t, .2 * np.sin(50 * t) * np.sin(np.pi * t / .6)**2]))
    fast, found = settings("Motion/File=fast.txt", "Joints/Model=tied", "Output/Checkpoint interval=0"), []
    for steps, substeps in ((4, 1), (1, 4)):
        runs("scene.prm", "--output", f"fast_{substeps}", *common, *fast, *settings(f"Foundation/Substeps={substeps}", f"Dynamics/Steps per sample={steps}"))
        names, rows = table(f"fast_{substeps}/history.csv")
        found.append(np.array([[row[0], row[names.index("pressure_50")]] for row in rows]))
    largest = np.abs(found[0][:, 1]).max()
    off = np.abs(np.interp(found[1][:, 0], *found[0].T) - found[1][:, 1]).max() / largest
    print(f"    vertical motion of 8 Hz: pressures with 10 and 2.5 ms differ by {100 * off:.1f} % of the largest, {largest:.4g} Pa")
    expect(off < .1, f"{off}")


def energies(text, directory, limit=1e-11):
    """The accounts of dam and water close. The table has fewer digits than the log."""
    names, rows = table(f"{directory}/energy.csv")
    column = {name: np.array([row[k] for row in rows]) for k, name in enumerate(names)}
    balance = (column["water"] + column["water_radiated"] + column["water_absorbed"] - column["water_from_dam"] - column["water_from_ground"])
    largest = max(np.abs(column[name]).max() for name in names if name.startswith("water"))
    told = float(re.search(r"energy balance of the water (\S+)", text)[1])
    print(f"    the water's account closes to {told:.1e}; of the dam: {summary(directory)['energy_balance_error']:.1e}")
    expect(largest > 0 and told < limit and np.abs(balance).max() < 1e-6 * largest, f"water {told}")
    expect(summary(directory)["energy_balance_error"] < 1e-9, "dam")


def face():
    """The stress normal to the wet face of a stiff wall changes by the dynamic pressure: its smallest value has the largest one of
    water_pressure.csv, at the nearest water node."""
    dt = .005
    t = np.arange(0, .5 + dt / 2, dt)
    np.savetxt("slow.txt", np.column_stack([t, -np.sin(np.pi * t / .5)**2, 0 * t, 0 * t]))
    golden.wall("face.msh", n_up=24)
    file = scene("face", "face.msh", Concrete={"Young's modulus": 2e15, "Density": 2500}, Damping={"Ratio": 0})
    runs(file, "--output", "face", *ACOUSTIC, *settings(
        "Motion/Source=file", "Motion/File=slow.txt", "Motion/Unit=m/s^2", f"Motion/Time step={dt}", "Motion/Duration=0.5",
        "Reservoir/Water level=60", f"Reservoir/Density={RHO}", "Reservoir/Element size=2.5", "Output/Figures=false",
        "Dynamics/Steps per sample=5", "Output/Solution interval=5", "Statics/Self-weight=none", "Joints/Model=tied"))
    names, rows = table("face/water_pressure.csv")
    at = {name: k for k, name in enumerate(names)}
    first, lowest, checked, off = {}, {}, 0, 0.
    for path in sorted(Path("face").glob("**/*.vtu")):
        fields = read_vtu(str(path))
        if "stress_xx" not in fields:
            continue
        for (x, y, z), stress in zip(fields["points"], fields["stress_xx"]):
            if abs(x) < 1e-9 and 10 < z < 50:
                first.setdefault((y, z), stress)  # at rest
                lowest[(y, z)] = min(lowest.get((y, z), 0.), stress - first[(y, z)])
    most = max(row[at["largest_pressure"]] for row in rows)
    for (y, z), stress in lowest.items():
        row = min(rows, key=lambda r: (r[at["y"]] - y)**2 + (r[at["z"]] - z)**2)
        off, checked = max(off, abs(stress + row[at["largest_pressure"]]) / most), checked + 1
    print(f"    {checked} nodes: normal stress and pressure differ by {100 * off:.2f} % of the largest dynamic pressure {most:.4g} Pa")
    expect(checked > 20 and off < .04, f"{checked} nodes, {off}")


def joints():
    """A dam with joints: both accounts close with contact, an absorbing bed and motion in all directions; on massless rock, too. A killed run
    goes on as if it had not been."""
    write_scene()
    common = [*ACOUSTIC, *settings("Motion/Duration=1", "Dynamics/Steps per sample=2", "Reservoir/Reflection=0.5", "Reservoir/Element size=25",
                                   "Output/Checkpoint interval=20")]
    text = runs("scene.prm", "--output", "rigid", *common)
    energies(text, "rigid")
    expect(summary("rigid")["water"]["max_dynamic_pressure"]["value"] > 1e4, "no pressure")
    names, rows = table("rigid/water_pressure.csv")
    largest = max(row[names.index("largest_pressure")] for row in rows)
    expect(abs(largest - summary("rigid")["water"]["max_dynamic_pressure"]["value"]) < 1e-6 * largest, "pressures")
    names, rows = table("rigid/energy.csv")
    expect(rows[-1][names.index("water_absorbed")] > 0 and rows[-1][names.index("water_radiated")] != 0, "nothing is absorbed")
    stop_and_resume("rigid", common)
    runs("scene.prm", "--output", "single", *common, *settings("Dynamics/Factors=single"))
    same("rigid", "single", 1e-4, ("history",))
    motion = np.loadtxt("motion.txt")
    np.savetxt("strong.txt", motion * [1, 2, 2, 2])
    rock = settings("Foundation/Model=massless", "Mesh/Arch210/Rock/Element size=60", "Output/Checkpoint interval=0")
    energies(runs("scene.prm", "--output", "rock", *common, *rock), "rock")
    text = runs("scene.prm", "--output", "banks", *common, *rock, *settings("Motion/Abutments=left 9: strong.txt"))
    energies(text, "banks")
    largest = [summary(name)["water"]["max_dynamic_pressure"]["value"] for name in ("rock", "banks")]
    print(f"    largest pressure {largest[0]:.4g} Pa; with the left bank twice as strong {largest[1]:.4g} Pa")
    expect(largest[1] > 1.1 * largest[0], f"{largest}")


def works():
    """Without static loads and with the ground at rest again, the work of the loads on the dam is that of the water: the opposite of the work of the
    dam on the water, in each step, also with contact."""
    write_scene()
    t = np.arange(0, .5 + .005, .01)
    np.savetxt("kick.txt", np.column_stack([t, *(np.where(t < .2, 2 * np.sin(w * t), 0) for w in (31.4, 62.8, 31.4))]))
    runs("scene.prm", "--output", "works", *ACOUSTIC, *settings(
        "Statics/Gravity=0", "Motion/File=kick.txt", "Motion/Unit=m/s^2", "Dynamics/Steps per sample=2", "Reservoir/Element size=25"))
    names, rows = table("works/energy.csv")
    column = {name: np.array([row[k] for row in rows]) for k, name in enumerate(names)}
    rest = column["time"] > .215
    of_dam, of_water = np.diff(column["input"][rest]), np.diff(column["water_from_dam"][rest])
    largest = np.abs(of_water).max()
    off = np.abs(of_dam + of_water).max() / np.abs(column["input"]).max()
    print(f"    works in a step up to {largest:.4g} J; sum {off:.1e} of the largest work")
    expect(largest > 1e-3 * np.abs(column["input"]).max() and off < 1e-6, f"{off}")
    moved = [abs(x) for name in ("joint_history",) for row in table(f"works/{name}.csv")[1] for x in row[1:]]
    expect(max(moved) > 1e-4, "the joints do not move")


def modes():
    """A cantilever wall in incompressible water: the ratio of the wet and the dry frequency is that of beam theory, 0.37615/0.53212 (H = 100 m,
    thickness 10 m, 26.04 GPa, 2400 kg/m3). Then the arch dam of code_aster's test fdlv112: the frequencies on a conforming water mesh."""
    golden.wall("wall.msh", width=40., height=100., n_up=20)
    file = scene("cantilever", "wall.msh", Concrete={"Young's modulus": 25e9 / .96, "Poisson's ratio": 0, "Density": 2400})
    wet = settings("Reservoir/Water level=100", f"Reservoir/Density={RHO}", "Statics/Self-weight=none")
    dry = frequencies(runs("modes", file, "--count", "2", *wet, *settings("Reservoir/Model=none")))[0]
    ratio = frequencies(runs("modes", file, "--count", "2", *wet, *INCOMPRESSIBLE))[0] / dry
    print(f"    wall: {dry} Hz dry, ratio {ratio:.5f}, beam theory {.37615 / .53212:.5f}")
    expect(abs(dry / .53212 - 1) < .02 and abs(ratio / (.37615 / .53212) - 1) < .01, f"{dry}, {ratio}")
    if not FDLV112.exists():
        print(f"    SKIPPED: {FDLV112} is missing")
        sys.exit(77)
    common = settings("Mesh/Source=file", f"Mesh/File={FDLV112}", "Mesh/Axes=-x -y z", "Concrete/Young's modulus=36e9",
                      "Concrete/Poisson's ratio=0.2", "Concrete/Density=2400", "Reservoir/Water level=0", "Statics/Self-weight=none",
                      "Motion/Source=none")
    Path("aster.prm").write_text("")
    reference = (3.50456, 3.61781, 4.82832, 5.85977)
    compressible = (3.48588, 3.57342, 4.77680, 5.83416)
    for size, limit in ((6, .01), (4.5, .006)):
        for model, exact in ((INCOMPRESSIBLE, reference), ([*ACOUSTIC, *settings("Reservoir/Sound speed=1500")], compressible)):
            text = runs("modes", "aster.prm", "--count", "4", *common, *model, *settings(f"Reservoir/Element size={size}"))
            found = frequencies(text)
            off = [f / g - 1 for f, g in zip(found, exact)]
            print(f"    elements of {size} m, {model[1].split('=')[-1]}: {found} Hz, {', '.join(f'{100 * x:.2f} %' for x in off)}")
            expect(max(map(abs, off)) < limit, f"{off}")
            if model is not INCOMPRESSIBLE:
                radiation = [float(line.split()[3]) for line in text.splitlines() if len(line.split()) == 4 and line.split()[0].isdigit()]
                expect(len(radiation) == 4 and max(radiation) < .1, f"radiation {radiation} %")
    numbers = golden.with_water(FDLV112, "conforming.msh", [6 + 4 * k / 17 for k in range(18)], 0., upstream=1.)
    expect(numbers == (6213, 5292), numbers)
    common[common.index(f"Mesh/File={FDLV112}")] = "Mesh/File=conforming.msh"
    for model, exact in ((INCOMPRESSIBLE, reference), ([*ACOUSTIC, *settings("Reservoir/Sound speed=1500")], compressible)):
        found = frequencies(runs("modes", "aster.prm", "--count", "4", *common, *model))
        off = [f / g - 1 for f, g in zip(found, exact)]
        print(f"    water mesh of the reference, {model[1].split('=')[-1]}: {found} Hz, {', '.join(f'{100 * x:.2f} %' for x in off)}")
        expect(max(map(abs, off)) < .008, f"{off}")
    found = frequencies(runs("modes", "aster.prm", "--count", "4", *common))
    print(f"    Westergaard: {found} Hz, {', '.join(f'{100 * (f / g - 1):.1f} %' for f, g in zip(found, reference))}")


def own():
    """A water mesh of the file: an arch dam with three monoliths and water extruded from its upstream face, up to a damping layer. Crest and pressures are
    those with the channel of the program under motion in three directions; accounts close; a killed run goes on; without acoustic water the
    volumes change nothing, in other axes and units neither."""
    golden.arch("dry.msh", (1,) * 4 + (2,) * 4 + (3,) * 4, n_through=1, n_up=6)
    layers = [6 + 6 * k / 13 for k in range(14)] + [12 * 1.05**k for k in range(1, 18)]
    nodes, cells = golden.with_water("dry.msh", "own.msh", layers, 60.)
    file = scene("scene", "own.msh", Joints={"Model": "FJA"}, Damping={"Ratio": .05}, Statics={"Self-weight": "monolithic"})
    t = np.arange(0, 1.005, .01)
    np.savetxt("motion.txt", np.column_stack([t, *(a * np.sin(w * t) * np.sin(np.pi * t)**2 for a, w in ((2, 20), (1.5, 25), (1, 30)))]))
    common = settings("Motion/Source=file", "Motion/File=motion.txt", "Motion/Unit=m/s^2", "Motion/Time step=0.01", "Motion/Duration=1",
                      "Reservoir/Density=1000", "Reservoir/Reflection=0.8", "Dynamics/Steps per sample=10", "Output/Checkpoint interval=20",
                      "Output/Pressure depths=50", "Output/Solution interval=0")
    text = runs(file, "--output", "own", *common, *ACOUSTIC)
    expect("volumes of the mesh file" in text and f"{nodes} nodes" in text and re.search(rf"water +-> +water +{cells} hexahedra",
           runs(file, "--validate", *common, *ACOUSTIC)), text)
    energies(text, "own")
    energies(runs(file, "--output", "channel", "--overwrite", *common, *ACOUSTIC, *settings("Mesh/File=dry.msh", "Reservoir/Element size=5")), "channel")
    for name in ("crest_x", "crest_z", "pressure_50"):
        one, two = (np.array([row[names.index(name)] for row in rows]) for names, rows in (table(f"{d}/history.csv") for d in ("own", "channel")))
        off = np.abs(one - two).max() / np.ptp(two)
        print(f"    {name}: own mesh and channel differ by {100 * off:.2f} % of the range {np.ptp(two):.4g}")
        expect(off < (.08 if name == "pressure_50" else .03), f"{name}: {off}")
    stop_and_resume("own", [*common, *ACOUSTIC])
    for d, mesh in (("plain", "dry.msh"), ("unused", "own.msh")):
        text = runs(file, "--output", d, *common, *settings(f"Mesh/File={mesh}", "Reservoir/Model=Westergaard"))
    expect('the volumes "water" of the mesh file are not used' in text, text)
    same("plain", "unused", 1e-12)
    golden.arch("finer.msh", (1,) * 17, n_up=8)
    golden.with_water("finer.msh", "other.msh", layers, 60., dam="dry.msh")
    tied = [*common, *INCOMPRESSIBLE, *settings("Joints/Model=tied", "Mesh/File=other.msh")]
    more = settings("Mesh/File=dry.msh", "Reservoir/Element size=5")
    other, channel = (frequencies(runs("modes", file, "--count", "3", *tied, *entries)) for entries in ([], more))
    off = [f / g - 1 for f, g in zip(other, channel)]
    print(f"    water mesh that does not match the dam: {other} Hz, {', '.join(f'{100 * x:.2f} %' for x in off)} against the channel")
    expect(max(map(abs, off)) < .02, f"{off}")
    golden.with_water("dry.msh", "apart.msh", layers, 60., own_nodes=True, end=True)
    text = Path("apart.msh").read_text().split("$")
    at = next(k for k, part in enumerate(text) if part.startswith("Nodes"))
    lines = text[at].splitlines()
    turned = [(i, -float(y) * 1e3, float(x) * 1e3, float(z) * 1e3) for i, x, y, z in map(str.split, lines[2:])]
    text[at] = "\n".join([*lines[:2], *(" ".join(map(str, row)) for row in turned), ""])
    Path("turned.msh").write_text("$".join(text))
    runs(file, "--output", "turned", *common, *ACOUSTIC, *settings("Mesh/File=turned.msh", "Mesh/Axes=y -x z", "Mesh/Length unit=mm"))
    same("own", "turned", 1e-5, ("history",))


def symmetric():
    """A symmetric dam with a joint at the crown under a symmetric motion, coarse water: the joint at the crown does not slip, and the others
    slip by the same amount."""
    write_scene()
    Path("waves.txt").write_text("".join(f"{.01 * k} {12 * math.sin(.4 * k)} 0 {6 * math.sin(.6 * k)}\n" for k in range(41)))
    for size in (24, 30, 36):
        runs("scene.prm", "--output", "symmetric", *settings(
            "Mesh/Arch210/Joints=3", "Mesh/Arch210/Elements along=12", "Mesh/Arch210/Elements up=4", "Mesh/Arch210/Elements through=1", "Joints/Friction=0.8",
            "Reservoir/Model=acoustic", "Reservoir/Water level=195", "Reservoir/Reflection=0.8", f"Reservoir/Element size={size}", "Motion/Source=file",
            "Motion/File=waves.txt", "Motion/Unit=m/s^2", "Motion/Time step=0.01", "Motion/Duration=0.4", "Dynamics/Steps per sample=4"), "--overwrite")
        names, rows = table("symmetric/joint_history.csv")
        slips = [max(row[names.index(f"slip_downstream_{joint}")] for row in rows) for joint in (1, 2, 3)]
        print(f"    water elements of {size} m: slips {slips} m")
        expect(slips[0] > .005 and slips[1] < 1e-7 and abs(slips[0] - slips[2]) < 1e-7, f"slips {slips}")
    runs("scene.prm", "--output", "valley", *settings(  # the bed has a slight bend at y = 0
        "Mesh/Arch210/Equal rows=true", "Mesh/Arch210/Smallest height=20", "Reservoir/Model=acoustic", "Reservoir/Water level=147",
        "Reservoir/Element size=31.5", "Reservoir/Reflection=0.6", "Motion/Duration=0.05"))
    points = [row[:3] for row in table("valley/water_pressure.csv")[1]]
    off = max(min(math.dist((x, -y, z), other) for other in points) for x, y, z in points)
    print(f"    water mesh of a symmetric valley: {len(points)} points at the dam, at most {off:.1e} m from their mirror images")
    expect(len(points) > 50 and off < 1e-6, f"{len(points)} points, {off} m")


def radiation():
    """The first mode of a stiff wall above the first frequency of the channel: complex frequency s with the shape of the mode in air,
    w^2 + s^2 (1 + Ma) = 0, Ma = 2 rho W/H sum (int phi cos k_n z)^2/kappa_n, kappa_n = sqrt(k_n^2 - |s|^2/c^2), for the modal mass 1."""
    width, thick, density = 10., 10., 2400.
    golden.wall("wall.msh", n_up=24)
    file = scene("radiation", "wall.msh", Concrete={"Young's modulus": 3e12, "Poisson's ratio": 0, "Density": density})
    common = settings("Reservoir/Water level=60", f"Reservoir/Density={RHO}", f"Reservoir/Sound speed={C}", "Reservoir/Element size=2.5",
                      "Statics/Self-weight=none")
    dry = frequencies(runs("modes", file, "--count", "2", "--output", "dry", *common, *settings("Reservoir/Model=none")))[0]
    shape = read_vtu("dry/mode-001.vtu")
    heights = {round(z, 6): u[0] for (x, y, z), u in zip(shape["points"], shape["displacement"]) if abs(x) < 1e-9}
    z = np.linspace(0, H, 2001)
    u = np.interp(z, sorted(heights), [heights[height] for height in sorted(heights)])
    mean = lambda f: (f[1:] + f[:-1]).sum() / 2 * (z[1] - z[0])
    phi = u / np.sqrt(density * thick * width * mean(u * u))
    k = (2 * np.arange(1, 60) - 1) * np.pi / 2 / H
    shares = np.array([mean(phi * np.cos(kn * z)) for kn in k])**2
    w, s = 2 * np.pi * dry, 2j * np.pi * dry * .8
    for _ in range(200):
        kappa = np.sqrt(k**2 - abs(s)**2 / C**2 + 0j)  # with i: waves that leave
        s = .5 * (s + 1j * w / np.sqrt(1 + (2 * RHO * width / H * shares / kappa).sum()))
    exact, damping = abs(s) / 2 / np.pi, -100 * s.real / abs(s)
    text = runs("modes", file, "--count", "1", *common, *ACOUSTIC)
    row = next(line.split() for line in text.splitlines() if line.split()[:1] == ["1"])
    print(f"    {dry} Hz dry; {row[1]} Hz and {row[3]} % by the water, series {exact:.4f} Hz and {damping:.2f} %; channel {C / 4 / H:.2f} Hz")
    expect(exact > 1.2 * C / 4 / H and damping > 3, f"{exact}, {damping}")
    expect(abs(float(row[1]) / exact - 1) < .02 and abs(float(row[3]) / damping - 1) < .1, f"{row}")
    as_json = json.loads(runs("modes", file, "--count", "1", "--json", *common, *ACOUSTIC))["modes"][0]
    expect(abs(100 * as_json["radiation_damping"] - float(row[3])) < 1e-2, f"{as_json}")


def messages():
    """Bad input ends with one paragraph."""
    write_scene()
    for entries, parts in ((["Reservoir/Length=50"], ("Reservoir/Length", "depth")),
                           (["Reservoir/Element size=10"], ("critical time step of the water, 0.00", "Steps per sample")),
                           (["Reservoir/Element size=3"], ("critical time step of the water, about 0.00", "nodes", "Steps per sample")),
                           (["Reservoir/Length=1e7"], ("GiB of this computer", "Element size")),
                           (["Reservoir/Element size=190"], ("Element size",)), (["Reservoir/Reflection=2"], ("Reflection",)),
                           (["Output/Pressure depths=20,300", "Reservoir/Element size=25", "Dynamics/Steps per sample=2"],
                            ("Pressure depths", "300 m", "195 m")),
                           (["Reservoir/Model=incompressible"], ("incompressible", "acoustic", "modes")),
                           (["Reservoir/Model=added mass table"], ("Reservoir/Table",)),
                           (["Reservoir/Water level=-5"], ("water level",)), (["Reservoir/Water level=300"], ("Water level", "above"))):
        refused(["scene.prm", "--validate", *ACOUSTIC, *settings(*entries)], *parts)
    runs("scene.prm", "--validate", *ACOUSTIC, *settings("Reservoir/Water level=210.0000001", "Reservoir/Element size=25", "Dynamics/Steps per sample=2"))
    for entries, part in ((["Reservoir/Sound speed=1500"], "Sound speed"), ([*("Reservoir/Model=acoustic", "Reservoir/Factor=0.5")], "Factor")):
        text = runs("scene.prm", "--validate", *settings("Dynamics/Steps per sample=2", "Reservoir/Element size=25", *entries))
        expect(re.search(rf"warning: .*Reservoir/{part}.* no effect", text), f"{part}: {text}")
    for entries, warned in (((), True), (("Reservoir/Length=1170",), False), (("Reservoir/Reflection=0.9",), False)):
        text = runs("scene.prm", "--validate", *ACOUSTIC, *settings("Reservoir/Element size=25", "Dynamics/Steps per sample=2", *entries))
        expect(warned == (" Set Reservoir/Length to 1170 m" in " ".join(text.split())), f"{entries}: {text}")
    refused(["modes", "scene.prm", *ACOUSTIC, "--spectrum", "design"], "Westergaard")
    old = settings("Motion/Source=none", "Reservoir/Added mass=none")
    text = runs("scene.prm", "--validate", *old)
    expect("Replace it by Reservoir/Model = none" in text and "added mass none, 0 kg" in text, text)
    text = runs("scene.prm", "--validate", *settings("Reservoir/Model=none", "Motion/Source=none"))
    expect("added mass none, 0 kg" in text and "older versions" not in text, text)
    Path("mass.csv").write_text("depth,mass\n0,0\n300,3e5\n")
    text = runs("scene.prm", "--validate", *settings("Reservoir/Model=added mass table", "Reservoir/Table=mass.csv"))
    expect(re.search(r"added mass of mass.csv, \S+e\+\d+ kg", text), text)
    golden.arch("dry.msh")
    file = scene("own", "own.msh", Reservoir={"Density": 1000, "Water level": 60})
    layers, moved = [20.] * 6, lambda x: (x[0] - 5, x[1], x[2])
    for water, entries, parts in (({"tetrahedra": True}, (), ("'water'", "Tetrahedron", "extrusion")),
                                  ({}, ("Reservoir/Water level=58",), ("z = 60 m", "Water level is 58 m", "Set the level to 60 m")),
                                  ({"own_nodes": True, "change": moved}, (), ("surface \"upstream\"", "5 m away", "Extrude"))):
        golden.with_water("dry.msh", "own.msh", layers, 60., **water)
        refused([file, "--validate", *ACOUSTIC, *settings(*entries)], *parts)
    golden.with_water("dry.msh", "own.msh", layers, 60., left=True)
    refused([file, "--validate", *ACOUSTIC, *settings("Joints/Model=tied", "Mesh/File=own.msh")], "monolith 1", "no water node")
    golden.arch("one.msh", (1,) * 6)
    golden.with_water("one.msh", "half.msh", layers, 60., left=True)
    refused([file, "--validate", *ACOUSTIC, *settings("Mesh/File=half.msh")], "of the upstream face", "whole wet face")
    golden.with_water("dry.msh", "own.msh", [5.] * 6, 60.)
    refused([file, "--validate", *ACOUSTIC], "30 m upstream", "depth of 60 m")
    golden.with_water("dry.msh", "own.msh", layers, 60.)
    text = runs(file, "--validate", *ACOUSTIC, *settings("Reservoir/Element size=7"))
    expect(re.search(r"warning: .*Reservoir/Element size.* no effect", text), text)
    choices = runs("scene", file, "--choices", *ACOUSTIC)
    expect("water level" not in choices and "reflection 0.75" in choices, choices)
    choices = runs("scene", "scene.prm", "--choices", *ACOUSTIC)
    names = [choice["name"] for choice in json.loads(choices)["choices"] if choice["group"] == "water"]
    expected = ("no added mass", "Westergaard", "half of Westergaard", "compressible, reflection 0.75", "compressible, reflection 0.5")
    expect(all(name in names for name in expected) and "compressible, reflection 1" not in names, names)


if __name__ == "__main__":
    run_cases(pulse, ground, face, joints, rock, works, modes, own, symmetric, radiation, messages)
