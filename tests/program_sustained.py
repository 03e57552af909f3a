#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sustained moduli in the static state, Young's moduli in the earthquake: bars with exact solutions, and the foundations.

    program_sustained.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

from math import atan, cos, pi, sin, sqrt

from run_program import FACES, expect, run_cases, runs, settings, summary, table, voussoir, write, write_mesh, write_scene

YOUNG, SUSTAINED, DENSITY = 20e9, 12e9, 2500.
BAR = settings("Mesh/Source=file", f"Concrete/Young's modulus={YOUNG}", "Concrete/Poisson's ratio=0", f"Concrete/Density={DENSITY}",
               "Reservoir/Density=0", "Motion/Unit=m/s^2", "Output/Stress recovery=elements", "Output/Block forces=true")
TWO = settings(f"Concrete/Sustained modulus={SUSTAINED}")


def bar(name, axis, length, n, joint=None, side=1.):
    """A bar of a square section along an axis in n elements, fixed at its start, and at its end if it has a joint: the monolith
    of the element i is 2 from i = joint on."""
    def place(i, a, b):
        x = [a, b]
        x.insert(axis, length * i / n)
        return x
    corners = [(0, 0), (side, 0), (side, side), (0, side)]
    nodes = [place(i, *c) for i in range(n + 1) for c in corners]
    hexes = [list(range(4 * i, 4 * i + 8)) for i in range(n)]
    if axis == 1:  # (x, z) with y is left-handed
        hexes = [h[4:] + h[:4] for h in hexes]
    elements = [(5, 2 if joint and i >= joint else 1, h) for i, h in enumerate(hexes)]
    for h in hexes:
        for face in FACES:
            quad = [h[k] for k in face]
            c = [sum(nodes[k][d] for k in quad) / 4 for d in range(3)]
            ends = {0.: 1, length: 1 if joint else 4}
            if c[axis] in ends:
                elements.append((3, ends[c[axis]], quad))
            elif c[0] in (0, side):
                elements.append((3, 2 + int(c[0] > 0), quad))
            elif axis == 1 and c[2] == side:
                elements.append((3, 4, quad))
    write_mesh(name, {"head": ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"], "nodes": nodes, "elements": elements})


def motion(name, of_time, n, dt):
    write(name, "".join(f"{i * dt:.6f} {' '.join(str(x) for x in of_time(i * dt))}\n" for i in range(n + 1)))


def column(directory, name, of="history"):
    header, rows = table(f"{directory}/{of}.csv")
    return [row[header.index(name)] for row in rows]


def agree(a, b, name, limit, without="nothing"):
    """Two tables, relative to their largest value: some columns have only round-off. without: part of the names of columns left out."""
    (header, x), (other, y) = (table(f"{directory}/{name}.csv") for directory in (a, b))
    x, y = ([[value for title, value in zip(header, row) if without not in title] for row in rows] for rows in (x, y))
    expect(header == other and len(x) == len(y), f"{name} of {a} and {b}")
    size = max(abs(value) for row in x for value in row[1:])
    off = max(abs(p - q) for r, s in zip(x, y) for p, q in zip(r, s)) / size
    print(f"    {name}.csv of {a} and {b}: difference {off:.1e}, limit {limit:.0e}")
    expect(off < limit, f"{name}.csv of {a} and {b}")


def chain(n, length, step, n_steps, dt):
    """Displacements of a bar of n elements, fixed at its start, under a suddenly applied acceleration of its base: the modes
    of the chain of lumped masses, in time by the trapezoidal rule, whose frequency w' has tan(w' dt/2) = w dt/2."""
    h = length / n
    result = [[0.] * (n + 1) for _ in range(n_steps + 1)]
    for k in range(1, n + 1):
        shape = [sin((2 * k - 1) * pi * j / (2 * n)) for j in range(n + 1)]
        w = 2 * sqrt(YOUNG / DENSITY) / h * sin((2 * k - 1) * pi / (4 * n))
        part = (sum(shape[1:-1]) + shape[n] / 2) / (n / 2)
        seen = 2 / dt * atan(w * dt / 2)
        for i in range(n_steps + 1):
            q = -step * part / w**2 * (1 - cos(i * dt * seen))
            result[i] = [u + q * s for u, s in zip(result[i], shape)]
    return result


def dead_load():
    """A bar under its weight, then shaken: u = rho g z (L - z/2)/E_s, then the motion with E on top. Stresses, forces and
    energies are those of a bar with one modulus, because the bar is statically determinate."""
    length, n, a, dt, n_steps, g = 20., 10, -15., .002, 100, 9.81
    bar("bar.msh", 2, length, n)
    motion("step.txt", lambda t: (0, 0, a), n_steps, dt)
    write_scene()
    chosen = [*BAR, *settings("Mesh/File=bar.msh", "Statics/Self-weight=monolithic", "Motion/File=step.txt", f"Motion/Time step={dt}",
                              f"Motion/Duration={n_steps * dt}", "Damping/Ratio=0")]
    for name, more in (("one", []), ("two", TWO)):
        for kind in ("double", "single"):
            runs("scene.prm", "--output", name if kind == "double" else f"{name}_single", *chosen, *more, *settings(f"Dynamics/Factors={kind}"))
    balance = {name: summary(name)["energy_balance_error"] for name in ("one", "two", "one_single", "two_single")}
    print(f"    errors of the energy balance: {balance}")
    expect(max(balance["one"], balance["two"]) < 1e-12, "energy in double precision")
    expect(abs(balance["two_single"] / balance["one_single"] - 1) < .01, "energy in single precision")
    exact, h = chain(n, length, a, n_steps, dt), length / n
    size = max(abs(u[n]) for u in exact)
    for name, young in (("one", YOUNG), ("two", SUSTAINED)):
        static = -DENSITY * g * length**2 / (2 * young)
        off = max(abs(x - static - u[n]) for x, u in zip(column(name, "crest_z"), exact)) / size
        stresses = [YOUNG * u[1] / h - DENSITY * g * (length - h / 2) for u in exact]  # of the lowest element
        print(f"    {name}: static {static:.6g} m, motion {size:.3g} m, error {off:.1e}; stress {min(stresses):.6g} to {max(stresses):.6g} Pa")
        expect(off < 1e-7, f"displacement of {name}")  # tables have eight digits
        for key, value in (("max_compression", min(stresses)), ("max_tension_upstream", max(stresses))):
            found = summary(name)["extremes"][key]["value"]
            expect(abs(found - value) < 1e-5 * abs(value), f"{key} of {name}: {found}, exact {value}")
    for name in ("energy", "blocks"):
        agree("one", "two", name, 1e-7)
    # In single precision the velocity has round-off, which the acceleration divides by the time step.
    agree("two", "two_single", "history", 1e-10, without="crest_acceleration")
    agree("two", "two_single", "energy", 1e-6)
    expect("static state: 0.6 of Young's modulus" in runs("scene.prm", "--validate", *chosen, *TWO), "log")
    shown = voussoir("scene.prm", "--validate", *chosen, *settings("Concrete/Sustained modulus=30 GPa")).stdout
    expect("Concrete/Sustained modulus is 1.5 times Concrete/Young's modulus" in shown, shown)


def joint():
    """A warm bar of two monoliths between fixed ends has the pressure E_s alpha dT. An acceleration that grows slowly to
    -A pulls the joint at L/4 with rho A L/4: the joint opens when this is the pressure."""
    length, n, rate, dt, alpha, warm = 240., 24, 2., .02, 1e-5, 6.
    bar("joint.msh", 1, length, n, n // 4, 6.)
    motion("ramp.txt", lambda t: (0, -rate * t, 0), 250, dt)
    write_scene()
    for name, young, more in (("stiff", YOUNG, []), ("soft", YOUNG / 2, settings(f"Concrete/Sustained modulus={YOUNG / 2}"))):
        runs("scene.prm", "--output", name, *BAR, *settings(
            "Mesh/File=joint.msh", "Statics/Self-weight=none", f"Loads/Temperature/Upstream face={warm}", f"Loads/Temperature/Downstream face={warm}",
            f"Loads/Temperature/Expansion={alpha}", "Motion/File=ramp.txt", f"Motion/Time step={dt}", "Motion/Duration=5"), *more)
        pressure, opens = young * alpha * warm, 4 * young * alpha * warm / (DENSITY * length * rate)
        first = column(name, "max_pressure", "joint_pressures")[0]
        time = next(t for t, x in zip(column(name, "time"), column(name, "opening_upstream_1", "joint_history")) if x > 1e-8)
        print(f"    {name}: pressure {first:.6g}, exact {pressure:.6g} Pa; opens at {time:.4g} s, exact {opens:.4g} s")
        expect(abs(first - pressure) < 1e-3 * pressure, "pressure in the joint")
        expect(abs(time - opens) < 2 * dt, "time of opening")
        expect(summary(name)["energy_balance_error"] < 1e-8, f"energy of {name}")


def foundations():
    """The static state with sustained moduli is that of a dam and a rock with these Young's moduli, and it stays in
    equilibrium when the earthquake begins."""
    write_scene()
    soft = settings("Concrete/Young's modulus=14e9", "Foundation/Young's modulus=9e9")
    two = settings("Concrete/Young's modulus=21e9", "Foundation/Young's modulus=15e9", "Concrete/Sustained modulus=14e9",
                   "Foundation/Sustained modulus=9e9")
    rock = settings("Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60")
    for name, model in (("rigid", []), ("massless", [*rock, *settings("Foundation/Model=massless")]),
                        ("tied", [*rock, *settings("Foundation/Model=massless", "Joints/Model=tied")]),
                        ("rock", [*rock, *settings("Foundation/Model=rock", "Dynamics/Steps per sample=5")])):
        chosen = [*model, *settings("Loads/Temperature/Upstream face=-6", "Loads/Temperature/Downstream face=4",
                                    "Contact/Tolerance=1e-12", "Motion/Factor=1e-12", "Motion/Duration=0.1")]
        both = [f"{name}_{which}" for which in ("soft", "two")]
        runs("scene.prm", "--output", both[0], *chosen, *soft, *settings("Motion/Source=none", "Motion/File="))
        runs("scene.prm", "--output", both[1], *chosen, *two)
        a, b = (summary(directory) for directory in both)
        u, v = (s["static"]["crest_displacement"] for s in (a, b))
        size = max(map(abs, u))
        off = max(abs(x - y) for x, y in zip(u, v)) / size
        moved = max(abs(x - y) for c, y in zip("xyz", v) for x in column(both[1], f"crest_{c}")) / size
        print(f"    {name}: crest {u}, difference {off:.1e}, moves by {moved:.1e} of that")
        expect(off < 1e-8, f"static crest of {name}")
        expect(moved < 1e-7, f"the crest of {name} moves by {moved}")
        for key in ("max_tension_upstream", "max_compression"):
            x, y = (s["extremes"][key]["value"] for s in (a, b))
            expect(abs(x - y) < 1e-5 * abs(a["extremes"]["max_compression"]["value"]), f"{key} of {name}: {x}, {y}")
    shown = voussoir("scene.prm", "--validate", *settings("Foundation/Sustained modulus=9e9")).stdout
    expect("has no effect: Foundation/Model is rigid" in shown, shown)


if __name__ == "__main__":
    run_cases(dead_load, joint, foundations)
