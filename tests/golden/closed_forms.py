# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of program_golden.py: closed forms of statics, added mass and the damped oscillator."""

import math
import re

import meshes
from compare import DENSITY, E, GRAVITY, STRESS, Worst, at_places, read_vtu, scene, table_with_names
from run_program import expect, runs, summary, table, write


def face_rows(directory):
    """Rows of face, x, y, z, s, largest and smallest principal stress."""
    return [[row[0], *map(float, row[2:8])] for row in table_with_names(f"{directory}/faces.csv")[1]]


def weight():
    """A column of height H = 60 m and n = 12 rows, Poisson's ratio 0: stress -rho g (H - z), on
    the base, too; the top settles rho g H^2/(2 E): exact for linear elements. The same in feet (0.3048 m)."""
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
                check.close(f"stress, {how}", low, -DENSITY * GRAVITY * (H - z), 2e-6, DENSITY * GRAVITY * H)
                check.close(f"largest stress, {how}", high, 0., 2e-6, DENSITY * GRAVITY * H)
            least = result["extremes"]["max_compression"]
            check.close("extreme", least["value"], -DENSITY * GRAVITY * H, 2e-6)
            check.close("its height", least["place"][2], 0., 1e-9, 1.)
            zz = [(p[2], row[2], row[:2] + row[3:]) for p, row in zip(*stress_at_places(name))]
            for z, vertical, others in zz:
                check.close("stress_zz", vertical, -DENSITY * GRAVITY * (H - z), 2e-6, DENSITY * GRAVITY * H)
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
    that of 7/12 rho sqrt(H0) H(y)^1.5; both kinds. By the nodes' areas (trapezoids in sqrt(h)) a little less."""
    check = Worst("added mass")
    westergaard = {"Density": 1000, "Model": "Westergaard"}

    def total(name, mesh, **entries):
        shown = runs(scene(name, mesh, Reservoir={**westergaard, **entries}), "--validate")
        return float(re.search(r"(\S+) kg along x", shown)[1])

    meshes.wall("wall.msh", n_through=1, n_up=60)
    n, H, b = 60, 60., 10.
    nodal = 7 / 8 * 1000 * b * H / n * (H / 2 + sum(math.sqrt(H * (H - H * k / n)) for k in range(1, n)))
    for depth in ("global", "local"):
        check.close("wall, by its nodes", total("wall", "wall.msh", Depth=depth, **{"Model": "Westergaard-nodal"}),
                    nodal, 5e-4)
        check.close("wall", total("wall", "wall.msh", Depth=depth), 7 / 12 * 1000 * b * H**2, 5e-4)
    check.close("wall, factor 0.5", total("wall", "wall.msh", Factor=.5), 7 / 24 * 1000 * b * H**2, 5e-4)
    for level in (30, 30.3):
        check.close(f"wall, {level} m of water", total("wall", "wall.msh", **{"Water level": level}),
                    7 / 12 * 1000 * b * level**2, 5e-4)
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
                mean = (v - before[1]) / dt + a0 * (math.sin(w * k * dt) + math.sin(w * (k - 1) * dt)) / 2
                check.close(f"absolute acceleration {name}", row[9], mean, 2e-3, w * w * size)
                lost += dt * 2 * xi * w * mass * (v**2 + before[1]**2) / 2
                work -= dt * mass * (a0 * math.sin(w * k * dt) * v + a0 * math.sin(w * (k - 1) * dt) * before[1]) / 2
            for column, value in ((1, .5 * mass * v * v), (2, .5 * stiffness * u * u), (4, lost), (7, work)):
                check.close(f"energy, column {column}, {name}", energy[k][column], value, 5e-3, abs(work) + .5 * stiffness * size**2)
        a, b = (float(x) for x in re.search(r"a = (\S+) 1/s, b = (\S+) s ", shown).groups())
        check.close(f"printed factors {name}", a / 2 / w + b * w / 2, xi, 1e-3)
        modes = [line.split() for line in runs("modes", f"{directory}.prm", "--count", "5").splitlines()[1:6]]
        _, frequency, percent = min(modes, key=lambda row: abs(float(row[1]) - f))
        check.close("frequency", float(frequency), f, 1e-6)
        check.close(f"damping of the mode {name}", float(percent), 100 * xi, 1e-4)
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
