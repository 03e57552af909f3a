#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what a run says of the forces on the bases of the monoliths, and of their safety against sliding.

    program_blocks.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import math
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes  # noqa: E402
import scenes  # noqa: E402
from compare import GRAVITY, scene  # noqa: E402
from program_physics import close  # noqa: E402
from run_program import expect, reports, run_cases, runs, settings, summary, table, write, write_scene  # noqa: E402

COLUMNS = ("N", "V_stream", "V_arch", "M_stream", "M_arch", "torsion")
H, S, T = 40., .25, .5  # of the wedge: height of its crest above the heel's middle, falls of its base downstream and across


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def blocks(name):
    """blocks.csv: of each time the time, and by monolith the resultants and, if there is one, the safety."""
    names, rows = table(f"{name}/blocks.csv")
    expect(names[0] == "time", f"{names}")
    result = []
    for row in rows:
        of = dict(zip(names, row))
        numbers = sorted({int(n.rsplit("_", 1)[1]) for n in names[1:]})
        result.append((row[0], {m: [of[f"{c}_{m}"] for c in COLUMNS] + [of[name] for name in (f"safety_{m}",) if name in of] for m in numbers}))
    return result


def force(found, base):
    """Force and moment about the origin, of the resultants of one monolith."""
    axes, (n, v1, v2, *m) = [base[a] for a in ("stream", "arch", "normal")], found[:6]
    f = [sum(x * a[c] for x, a in zip((v1, v2, -n), axes)) for c in range(3)]
    return f, [sum(x * a[c] for x, a in zip(m, axes)) + y for c, y in enumerate(cross(base["centroid"], f))]


def wall(name, *arguments, monoliths=(1, 1, 2, 2), **sections):
    """Of monoliths 10 m wide, 10 m thick and 60 m high."""
    meshes.wall("wall.msh", monoliths=monoliths, width=5. * len(monoliths))
    file = scene(name, "wall.msh", Statics={"Self-weight": "staged", "Gravity": GRAVITY}, **sections)
    return runs(file, "--output", name, *arguments)


def hand():
    """Gravity blocks by hand: weight, push of the water, its moment; safety with and without uplift and cohesion."""
    water, tail = 50., 10.
    weight, push = 2500 * GRAVITY * 6000, 1e4 * 10 * (water**2 - tail**2) / 2
    overturning, uplift = 1e4 * 10 * (water**3 - tail**3) / 6, 1e4 * 100 * (water + tail) / 2
    loads = settings("Reservoir/Density=1000", f"Reservoir/Water level={water}", f"Loads/Tail water/Level={tail}")
    for name, more, up, c in (("dry", [], 0, 0), ("wet", ["Loads/Uplift/Base=true"], uplift, 0),
                              ("cohesive", ["Loads/Uplift/Base=true", "Limits/Base cohesion=0.3 MPa"], uplift, 3e5)):
        for joints in ("tied", "FJA"):
            shown = wall(name + joints, *loads, *settings(*more, "Limits/Base friction=0.7", "Limits/Sliding safety=0.9"),
                         Joints={"Model": joints})
            (_, found), = blocks(name + joints)
            safety = (c * 100 + .7 * (weight - up)) / push
            for m in (1, 2):
                n, v1, v2, m1, m2, m3, s = found[m]
                what = f"{name}, {joints}, monolith {m}: "
                close(n, -weight, 1e-7, what + "N")
                close(v1, -push, 1e-7, what + "V_stream")
                close(m2, -overturning, 1e-7, what + "M_arch")
                expect(max(abs(v2), abs(m1) / 10, abs(m3) / 10) < 1e-7 * weight, f"{what}{found[m]}")
                close(s, safety, 1e-7, what + "safety")
                base = summary(name + joints)["blocks"][f"monolith {m}"]
                close(base["area"], 100, 1e-9, "area")
                expect(base["uplift"] == up or abs(base["uplift"] / up - 1) < 1e-9, f"uplift {base['uplift']} of {up}")
                expect(math.dist(base["centroid"], (5, 5 if m == 2 else -5, 0)) < 1e-9, f"{base}")
                close(base["max_shear"]["value"], push, 1e-7, "largest shear")
                close(base["min_sliding_safety"]["value"], safety, 1e-7, "least safety")
            verdict = summary(name + joints)["limits"]["sliding_safety"]
            expect(verdict["satisfied"] == (safety >= .9) and verdict["limit"] == .9, f"{verdict}")
            expect(("sliding safety" in shown) == (safety < .9), shown)
    wedge()


def wedge():
    """One block on a base that falls downstream and across: the same resultant in the axes of that plane."""
    def place(i, j, k):
        x, y = 10. * j / 2, 12. * (i / 2 - .5)
        low = -S * x + T * y
        return x, y, low + (H - low) * k / 5
    meshes.write("wedge.msh", *meshes.block(place, (1, 1), 2, 5, {**meshes.DAM, "right": None, "left": None}))
    file = scene("wedge", "wedge.msh", Statics={"Self-weight": "monolithic", "Gravity": GRAVITY},
                 Reservoir={"Density": 1000, "Water level": H})
    runs(file, "--output", "wedge")
    (_, found), = blocks("wedge")
    base = summary("wedge")["blocks"]["monolith 1"]
    # By integrals over the base x in [0, 10], y in [-6, 6], z = -S x + T y; crest at z = H.
    weight = 2500 * GRAVITY * 120 * (H + S * 5)
    push = .5 * 1e4 * 12 * (H**2 + T**2 * 12)  # of (H - T y)^2 over the width
    length = math.sqrt(1 + S * S + T * T)
    normal = [S / length, -T / length, 1 / length]
    stream = [1 - normal[0]**2, -normal[0] * normal[1], -normal[0] * normal[2]]
    stream = [x / math.sqrt(dot(stream, stream)) for x in stream]
    ground = [-push, 0, weight]
    for name, axis in (("normal", normal), ("stream", stream), ("arch", cross(normal, stream))):
        expect(math.dist(base[name], axis) < 1e-8, f"{name}: {base[name]} instead of {axis}")
    close(base["area"], 120 * length, 1e-8, "area of the plane")
    close(found[1][0], -dot(ground, normal), 1e-7, "N")
    close(found[1][1], dot(ground, stream), 1e-7, "V_stream")
    close(found[1][2], dot(ground, cross(normal, stream)), 1e-7, "V_arch")
    # Moments about the origin: the weight at its centroid, the water by Gauss over the width.
    x, y = 5 + S * 100 / 12 / (H + S * 5), -T * 144 / 12 / (H + S * 5)
    about_y = about_z = 0
    for q, w in ((-math.sqrt(.6), 5 / 9), (0, 8 / 9), (math.sqrt(.6), 5 / 9)):
        depth, part = H - 6 * T * q, 6 * w
        about_y += part * .5e4 * depth**2 * (H - 2 * depth / 3)
        about_z -= part * .5e4 * depth**2 * 6 * q
    loads = [a + b for a, b in zip(cross((x, y, 0), (0, 0, -weight)), (0, about_y, about_z))]
    _, moment = force(found[1], base)
    print(f"    moments {moment}, of the loads {loads}")
    expect(max(abs(a + b) for a, b in zip(moment, loads)) < 1e-7 * max(map(abs, loads)), "moments about the origin")


def shaken():
    """A stiff wall moves with its base: the force is its mass times the mean acceleration of each step, less the static push. A dam of three monoliths carries its weight."""
    steps, dt = 40, .01
    a = [[k * dt] + [s * math.sin(w * k * dt)**2 * (k < 30) for s, w in ((2., 10.), (1., 7.), (-1.5, 5.))] for k in range(steps + 1)]
    write("shake.txt", "".join(" ".join(f"{x:.12g}" for x in row) + "\n" for row in a))
    wall("stiff", monoliths=(1, 1), Concrete={"Young's modulus": 2e19, "Poisson's ratio": 0, "Density": 2500},
         Motion={"Source": "file", "File": "shake.txt", "Unit": "m/s^2", "Duration": steps * dt, "Time step": dt},
         Reservoir={"Density": 1000, "Water level": 50, "Model": "none"})
    found = blocks("stiff")
    expect(len(found) == steps + 1 and found[-1][0] == steps * dt, f"{len(found)} rows")
    mass, push = 2500 * 6000, 1e4 * 10 * 50**2 / 2
    worst = 0.
    for k, (_, of) in enumerate(found):
        mean = [(p + q) / 2 for p, q in zip(a[max(k - 1, 0)][1:], a[k][1:])] if k else [0, 0, 0]
        n, v1, v2, *moments = of[1]
        expected = (-mass * (GRAVITY + mean[2]), mass * mean[0] - push, mass * mean[1])
        worst = max(worst, *(abs(x - y) / mass / GRAVITY for x, y in zip((n, v1, v2), expected)))
        arm = 30 * mass  # of the inertia, acting at half the height
        lever = (-arm * mean[1], arm * mean[0] - 1e4 * 10 * 50**3 / 6, 0)
        worst = max(worst, *(abs(x - y) / arm / GRAVITY for x, y in zip(moments, lever)))
    print(f"    stiff wall: difference {worst:.1e} of the weight")
    expect(worst < 1e-6, f"mass times acceleration: {worst}")
    write_scene()
    runs("scene.prm", "--output", "arch", *settings("Reservoir/Density=0"))
    bases = summary("arch")["blocks"]
    of = blocks("arch")[0][1]
    total = [sum(force(of[int(m.split()[1])], base)[0][c] for m, base in bases.items()) for c in range(3)]
    weight = summary("arch")["mesh"]["volume"] * 2400 * 9.81
    print(f"    {total}, weight {weight}")
    expect(abs(total[2] / weight - 1) < 1e-6 and max(map(abs, total[:2])) < 1e-7 * weight, "the dam's weight")
    expect(bases["monolith 1"]["arch"][1] > 0 and bases["monolith 3"]["normal"][1] < -.1 < .1 < bases["monolith 1"]["normal"][1],
           "the axes look to the left bank, and into the monoliths")


def limits():
    """What is not asked for is not there; what cannot be judged is said; the report has all of it."""
    write_scene()
    shown = runs("scene.prm", "--output", "none", *settings("Output/Block forces=false", "Limits/Sliding safety=1", "Limits/Base friction=1"))
    expect("Limits/Base friction" in shown and "Output/Block forces is false" in shown, shown)
    expect(not Path("none/blocks.csv").exists() and "blocks" not in summary("none"), "no blocks.csv")
    expect("Block forces" in summary("none")["limits_not_evaluated"]["sliding_safety"], "not evaluated")
    shown = runs("scene.prm", "--output", "plain", *settings("Limits/Sliding safety=1"))
    expect("Base friction" in summary("plain")["limits_not_evaluated"]["sliding_safety"], "not evaluated")
    expect("sliding safety (Limits/Base friction and Limits/Base cohesion are 0" in shown, shown)
    expect(len(table("plain/blocks.csv")[0]) == 1 + 3 * 6, "no safety without friction")
    runs("scene.prm", "--output", "judged", *settings("Limits/Sliding safety=40", "Limits/Base friction=1", "Limits/Base cohesion=1 MPa"))
    found, rows = summary("judged"), blocks("judged")
    for m in (1, 2, 3):
        base, most = found["blocks"][f"monolith {m}"], found["blocks"][f"monolith {m}"]["min_sliding_safety"]
        least = min((of[m][6], at) for at, of in rows)
        expect(abs(least[0] / most["value"] - 1) < 1e-7 and least[1] == most["time"], f"{least} {most}")
        for at, of in rows:
            n, v1, v2 = of[m][:3]
            by_hand = (1e6 * base["area"] + max(0., -n)) / math.hypot(v1, v2)
            expect(abs(of[m][6] / by_hand - 1) < 1e-6, f"safety {of[m][6]} instead of {by_hand}")
        shear = max((math.hypot(*of[m][1:3]), at) for at, of in rows)
        expect(abs(shear[0] / base["max_shear"]["value"] - 1) < 1e-7 and shear[1] == base["max_shear"]["time"], f"{shear}")
        pressed = sorted((-of[m][0], at) for at, of in rows)
        for row, name in ((pressed[0], "min_compression"), (pressed[-1], "max_compression")):
            expect(abs(row[0] / base[name]["value"] - 1) < 1e-7 and row[1] == base[name]["time"], f"{name}: {row}")
    verdict = found["limits"]["sliding_safety"]
    least = min(found["blocks"][f"monolith {m}"]["min_sliding_safety"]["value"] for m in (1, 2, 3))
    expect(not verdict["satisfied"] and verdict["is_least"] and verdict["value"] == least, f"{verdict}")
    reports("judged")
    page = Path("judged/report.html").read_text()
    for words in ("Monoliths on their bases", "against sliding", f"{least:.2f}", "(required 40)", "exceeded"):
        expect(words in page, f"'{words}' is not in the report")
    expect("Not shown" not in page, "all is shown")


def calculix():
    """CalculiX's reactions on the same arch of two tied monoliths (golden/make_calculix_blocks.py): plain elements to the seven
    digits that it prints; its elements with modes are others."""
    golden = json.loads((GOLDEN / "calculix_blocks.json").read_text())
    meshes.arch("arch.msh", *scenes.BLOCKS["cells"])
    for element, limit in (("C3D8", 3e-6), ("C3D8I", .02)):
        file = scene(element, "arch.msh", Elements={"Incompatible modes": str(element == "C3D8I").lower()},
                     Concrete={"Young's modulus": 21e9, "Poisson's ratio": .17, "Density": 2400},
                     Statics={"Self-weight": "monolithic", "Gravity": 9.81},
                     Reservoir={"Density": 1000, "Water level": scenes.BLOCKS["level"]})
        runs(file, "--output", element)
        (_, found), = blocks(element)
        for m in (1, 2):
            ours = [x for part in force(found[m], summary(element)["blocks"][f"monolith {m}"]) for x in part]
            theirs = golden[element][str(m)]
            sizes = [math.hypot(*theirs[:3])] * 3 + [math.hypot(*theirs[3:])] * 3
            worst = max(abs(x - y) / size for x, y, size in zip(ours, theirs, sizes))
            print(f"    {element}, monolith {m}: {worst:.1e} of force and moment, limit {limit:.0e}")
            expect(worst < limit, f"{element}, monolith {m}: {ours} instead of {theirs}")


if __name__ == "__main__":
    run_cases(hand, shaken, limits, calculix)
