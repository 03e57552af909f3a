#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that are not dams: free blocks of .3 m, impact on a wall, lift gaps, forces in time, against closed forms.

    program_bodies.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import sys
from math import asin, atan, cos, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "golden"), str(HERE.parent / "benchmarks")]
import meshes  # noqa: E402
import rebound  # noqa: E402
from compare import DENSITY, E, scene  # noqa: E402
from run_program import expect, refused, run_cases, runs, same_to_the_bit, settings, stopped, summary, table, write  # noqa: E402

SCHEMES = ("trapezoidal", "explicit")
WAVE = sqrt(E / DENSITY)  # [m/s]


def column(name, n, size, surfaces, volumes=None):
    """A cube of n flat cells; with names of two volumes, its halves."""
    place = lambda i, j, k: (size * j, size * i, size * k / n)
    nodes, hexes, quads = meshes.block(place, (1,), 1, n, surfaces)
    if volumes:
        hexes = [(1 if k < n // 2 else 2, corners) for k, (_, corners) in enumerate(hexes)]
    meshes.write(f"{name}.msh", nodes, hexes, quads, volumes=volumes)
    return f"{name}.msh"


def moved(name, mesh, scheme, duration, step, *arguments, **sections):
    """history.csv by column, of a run without earthquake."""
    file = scene(name, mesh, Motion={"Source": "none", "Duration": duration, "Time step": step}, Dynamics={"Scheme": scheme, "Factors": "double"} if
                 scheme == "trapezoidal" else {"Scheme": scheme}, **sections)
    shown = runs(file, "--output", name, *arguments)
    header, rows = table(f"{name}/history.csv")
    balance = summary(name)["energy_balance_error"]
    expect(balance < 1e-9, f"{name}: energy balance {balance}")
    return dict(zip(header, zip(*rows))), shown


def force():
    """A tied column is released from a static pull, and loaded by a force that begins at once: every time step by the modes of its
    lumped chain, with the period error of the scheme; the work of the force; a resumed run."""
    n, length, pull = 8, .4, 2e6
    mesh, dz = column("column", n, length, {"bottom": 1}), length / n
    dt, modes, h = 1e-6, [], .5e-6
    for m in range(1, n + 1):
        q = (2 * m - 1) * pi / (2 * length)
        shape = [sin(q * dz * i) for i in range(1, n + 1)]
        weight = [1.] * (n - 1) + [.5]
        part = sum(w * s * i / n for i, (w, s) in enumerate(zip(weight, shape), 1)) / sum(w * s * s for w, s in zip(weight, shape))
        modes.append((2 * WAVE / dz * sin(q * dz / 2), part * shape[-1]))  # frequency [rad/s]; share of the end's static displacement
    static = pull * length / (E * length**2)

    def swing(scheme, k):
        """Sum of the modes after k time steps, 1 at the start at rest."""
        if scheme == "trapezoidal":
            return sum(a * cos(k * 2 * atan(w * dt / 2)) for w, a in modes)
        return sum(a * cos(round(k * dt / h) * 2 * asin(w * h / 2)) for w, a in modes)

    write("release.txt", f"0 {pull}\n0 0\n")
    write("step.txt", f"time,force\n0,0\n0,{pull}\n")
    for scheme in SCHEMES:
        for kind in ("release", "step"):
            name = f"{kind}_{scheme}"
            chosen = [*settings(f"Loads/Force history=pull: 0.2 0.2 {length}; 0 0 3; {kind}.txt", f"Dynamics/Explicit step={h}",
                                f"Output/Probes=end: 0.2 0.2 {length}", "Output/Checkpoint interval=20", "Output/Progress interval=10")]
            found, shown = moved(name, mesh, scheme, 3e-4, dt, *chosen)
            exact = [static * (swing(scheme, k) if kind == "release" else 1 - swing(scheme, k)) for k in range(301)]
            worst = max(abs(a - b) for a, b in zip(found["end_z"], exact)) / static
            header, rows = table(f"{name}/energy.csv")
            work = [row[header.index("input")] for row in rows]
            off = max(abs(w - (kind == "step") * pull * u) for w, u in zip(work, found["end_z"])) / (pull * static)
            limit = 1e-7 if scheme == "trapezoidal" else .005  # the work of the explicit scheme is that of half a step before
            print(f"    {name}: displacement differs by {worst:.1e} of {1e3 * static:.4f} mm from the modes (limit 1e-7), work by {off:.1e} (limit {limit})")
            expect(worst < 1e-7 and off < limit, f"{name}: {worst}, {off}")
            stopped(15, f"{name}.prm", "killed", *chosen)
            runs(f"{name}.prm", "--output", "killed", *chosen, "--resume")
            same_to_the_bit(name, "killed")
    for text, *parts in (("a: 0 0 0; 0 0 1", "FILE"), ("a: 0.2 0.2 0.4; 0 0 0; step.txt", "direction"),
                         ("a: 0.2 0.2 9; 0 0 1; step.txt", "force \"a\"", "from the dam"),
                         ("a: 0.2 0.2 0.4; 0 0 1; step.txt; b: 0 0 0; 0 0 1; step.txt", 'force "b"', "fixed base"),
                         ("a: 0.2 0.2 0.4; 0 0 1; no.txt", "no.txt")):
        refused(["release_explicit.prm", "--validate", *settings(f"Loads/Force history={text}")], "Force history", *parts)
    write("back.txt", "0 0\n1 0\n0.5 1\n")
    refused(["release_explicit.prm", "--validate", *settings("Loads/Force history=a: 0.2 0.2 0.4; 0 0 1; back.txt")], "back.txt, line 3", "0.5 s")
    for headings, wrong in (("time [s], force [kN]", "force [kN]"), ("t (ms), F (N)", "t (ms)"), ("force [N], time [s]", "time [s]")):
        write("headings.txt", headings + "\n0, 0\n1, 1\n")
        refused(["release_explicit.prm", "--validate", *settings("Loads/Force history=a: 0.2 0.2 0.4; 0 0 1; headings.txt")], "headings.txt", wrong)


def free():
    """Two bricks of 10 cm x 5 cm that nothing holds: one flies through the gap of their lift joint, and both go on with its momentum; a
    force accelerates one. Nothing is required of the mesh."""
    size = .1
    mesh = column("bricks", 2, size, {}, {1: "monolith 1", 2: "monolith 1 lift 2"})
    mass, dt = DENSITY * size**3 / 2, 2e-5
    probes = f"Output/Probes=low: 0.05 0.05 {size / 4}; high: 0.05 0.05 {3 * size / 4}"  # the centres
    joints = {"Model": "FJA", "Friction": .5, "Initial gaps": "lift: 0.1 mm"}
    write("push.txt", "0 0\n0 500\n")
    for scheme in SCHEMES:
        found, shown = moved(f"gap_{scheme}", mesh, scheme, 2e-3, dt, *settings(probes, "Dynamics/Initial velocity=monolith 1: 0 0 0.2"), Joints=joints)
        for part in ("0.1 m high", 'no node on the surface "base"', '"crest" and "upstream" do not meet'):
            expect(part in shown, f"'{part}' is missing: {shown}")
        k = round(4e-4 / dt)  # before the impact, at .5 ms
        expect(abs(found["low_z"][k] - .2 * 4e-4) < 1e-12 and found["low_velocity_z"][k] == .2 and found["high_z"][k] == 0., f"{scheme}: flight")
        header, rows = table(f"gap_{scheme}/energy.csv")
        energy = [row[header.index("kinetic")] for row in rows]
        expect(abs(energy[0] - .5 * mass * .2**2) < 1e-12, f"{scheme}: kinetic energy {energy[0]}")
        off = max(abs(a + b - .2) for a, b in zip(found["low_velocity_z"], found["high_velocity_z"]))
        end = found["high_velocity_z"][-1]
        print(f"    {scheme}: the upper brick goes on with {end:.4f} m/s of .2; momentum differs by {off / .2:.1e} (limit 1e-7)")
        expect(.1 <= end <= .2 and off < 2e-8, f"{scheme}: speed after the impact {end}, momentum {off}")
        found, _ = moved(f"push_{scheme}", mesh, scheme, 6e-4, dt, *settings(probes, "Loads/Force history=push: 0.05 0.05 0; 0 0 1; push.txt"), Joints=joints)
        off = abs(found["low_z"][-1] / (.5 * 500 / mass * 6e-4**2) - 1)
        limit = 1e-7 if scheme == "trapezoidal" else .05  # half an explicit step later
        print(f"    {scheme}: displacement by a force differs by {off:.1e} from F t^2 / 2 m (limit {limit})")
        expect(off < limit and found["high_z"][-1] == 0., f"{scheme}: {off}")
    refused(["push_explicit.prm", "--validate", *settings("Statics/Self-weight=staged")], "monolith 1", "staged", "Self-weight")
    refused(["push_explicit.prm", "--validate", *settings("Joints/Model=tied", "Joints/Initial gaps=")], "monolith 1", "tied joints")
    refused(["push_explicit.prm", "--validate", *settings("Reservoir/Density=1000")], '"upstream"', "Reservoir/Density")
    refused(["push_explicit.prm", "--validate", *settings("Dynamics/Initial velocity=monolith 7: 0 0 1")], "monolith 7")
    refused(["push_explicit.prm", "--validate", *settings("Dynamics/Initial velocity=wall: 0 0 1")], "wall: 0 0 1")


def keys():
    """Two columns of two lifts with keys in all joints: where these meet, the joint is flat, with a warning; the blocks rest and slide alike."""
    place = lambda i, j, k: (j, i, k)
    nodes, hexes, quads = meshes.block(place, (1, 2), 1, 2, meshes.DAM)
    volumes = {1: "monolith 1", 2: "monolith 2", 11: "monolith 1 lift 2", 12: "monolith 2 lift 2"}
    hexes = [(m if min(nodes[c][2] for c in corners) < .5 else m + 10, corners) for m, corners in hexes]
    meshes.write("keys.msh", nodes, hexes, quads, volumes=volumes)
    for scheme in SCHEMES:
        found, shown = moved(f"keys_{scheme}", "keys.msh", scheme, 2e-3, 2e-5, *settings("Dynamics/Initial velocity=monolith 1 lift 2: 0.1 0 0"),
                             Joints={"Model": "KSM", "Friction": .1}, Statics={"Self-weight": "monolithic"})
        expect("Shear keys cannot cross joints: 4 joints" in shown, shown)


def wall():
    """A bar that flies against a wall returns with its speed: benchmarks/rebound.py for both schemes, and the loss with long steps."""
    for scheme in SCHEMES:
        ratio = {}
        for elements, step in ((8, 5e-3 if scheme == "trapezoidal" else 7e-4), (8, 1e-4), (32, 1e-4)):
            ratio[elements, step] = rebound.rebound(runs, scheme, elements, step, Path(f"{scheme}{elements}_{step}"))
        print(f"    {scheme}: speed after over before {ratio}; exact 1")
        long, short, fine = ratio.values()
        expect(long < fine and short < fine and .95 < fine < 1., f"{scheme}: {ratio}")


if __name__ == "__main__":
    run_cases(force, free, keys, wall)
