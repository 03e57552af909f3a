#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane strain (Mesh/Plane strain): own plane elements, CalculiX, closed forms, joints, water, refusals.

    program_plane_strain.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import sys
from math import sqrt
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "golden"), str(HERE.parent / "meshes"), str(HERE.parent / "python")]
import koyna  # noqa: E402
import meshes  # noqa: E402
import plane_elements  # noqa: E402
import scenes  # noqa: E402
from compare import STRESS, read_vtu, scene  # noqa: E402
from program_sustained import agree  # noqa: E402
from program_water import ACOUSTIC, RHO, C, H, base_force, bed_pressure  # noqa: E402
from run_program import expect, run_cases, runs, same, settings, table, voussoir, write_scene  # noqa: E402
from voussoir.zone_tension import zone_means  # noqa: E402

KOYNA = 31.027e9, .2, 2643.  # Young's modulus, Poisson's ratio, density
CPE8 = (3.072911, 8.110253, 11.07714, 15.93205)  # [Hz], CalculiX on 32 x 80 cells: benchmarks/plane_strain.py
PLANE = settings("Mesh/Source=file", "Mesh/Plane strain=true", "Reservoir/Density=0", f"Concrete/Young's modulus={KOYNA[0]}",
                 f"Concrete/Poisson's ratio={KOYNA[1]}", f"Concrete/Density={KOYNA[2]}")


def modes():
    """The section of Koyna Dam: the frequencies of own plane elements and of CalculiX, for each thickness and number of elements
    along y; nothing along y."""
    cells, count = (8, 20), 20
    write_scene()
    koyna.write("one.msh", *cells)
    koyna.write("three.msh", *cells, along=3, thickness=2.)
    for degree, limit in ((1, .02), (2, .005)):
        exact = plane_elements.frequencies(*koyna.section(*cells), degree, *KOYNA, count)
        for mesh in ("one", "three"):
            runs("modes", "scene.prm", "--count", str(count), "--output", f"{mesh}{degree}", *PLANE, *settings(
                f"Mesh/File={mesh}.msh", f"Elements/Degree={degree}", "Elements/Incompatible modes=false", "Output/Figures=false"))
            header, rows = table(f"{mesh}{degree}/modes.csv")
            found = [row[header.index("frequency")] for row in rows]
            off, reference = (max(abs(a / b - 1) for a, b in zip(found, values)) for values in (exact, CPE8))
            print(f"    {mesh}, degree {degree}: {found[:4]} Hz; difference {off:.1e} (limit 1e-6) of {count} frequencies from the "
                  f"plane elements, {reference:.2e} (limit {limit}) of 4 from CalculiX")
            expect(off < 1e-6 and reference < limit, f"{mesh}, degree {degree}: {found}, plane elements {exact}")
            expect(all(row[header.index(f"{name}_y")] == 0 for row in rows for name in ("participation", "share")), "along y")


def column():
    """A column far above its base: s_zz = -rho g (H - z), s_yy = nu s_zz under weight, s_yy = -E alpha dT under a temperature."""
    height, young, poisson, density, gravity = 60., 20e9, .2, 2500., 10.
    meshes.wall("wall.msh", monoliths=(1, 1), width=3., height=height, thickness=4.)
    for weight, change in (("monolithic", 0), ("staged", 0), ("none", 10)):
        file = scene("wall", "wall.msh", Mesh={"Plane strain": "true"}, Elements={"Degree": 2},
                     Statics={"Self-weight": weight, "Gravity": gravity},
                     Concrete={"Young's modulus": young, "Poisson's ratio": poisson, "Density": density})
        runs(file, "--output", weight, *settings("Loads/Temperature/Expansion=1e-5", f"Loads/Temperature/Upstream face={change}",
                                                 f"Loads/Temperature/Downstream face={change}"))
        fields, worst, moved = read_vtu(f"{weight}/solution-00000.vtu"), 0., 0.
        for k, (_, _, z) in enumerate(fields["points"]):
            moved = max(moved, abs(fields["displacement"][k][1]))
            if z < 36:
                continue
            s_zz = -density * gravity * (height - z) * (change == 0)
            exact = [0., poisson * s_zz - young * 1e-5 * change, s_zz, 0., 0., 0.]
            worst = max(worst, *(abs(fields[name][k] - s) for name, s in zip(STRESS, exact)))
        size = density * gravity * height if change == 0 else young * 1e-5 * change
        print(f"    weight {weight}, temperature {change}: stresses off by {worst / size:.1e} of {size:.3g} Pa (limit 3e-5), u_y {moved}")
        expect(worst < 3e-5 * size and moved == 0, f"column, weight {weight}")


def joint():
    """Two blocks with a joint that opens and slides: three elements along y give the same as one, and nothing moves along y,
    also under a motion along y."""
    write_scene()
    shaken = [*PLANE, *settings("Reservoir/Density=1000", "Reservoir/Water level=95", "Joints/Friction=0.3", "Contact/Tolerance=1e-12", "Dynamics/Factors=double",
                                "Output/Block forces=true")]
    for name, along in (("one", 1), ("three", 3)):
        koyna.write(f"{name}.msh", 6, 10, along=along, thickness=6., monolith=lambda i, k: 1 if i < 3 else 2)
        shown = runs("scene.prm", "--output", name, *shaken, *settings(f"Mesh/File={name}.msh"))
        expect("plane strain: no displacements along y; forces and masses are those of a slice of 6 m" in shown, shown)
    same("one", "three", 1e-9)
    for name in ("energy", "blocks"):
        agree("one", "three", name, 1e-9)
    header, rows = table("three/joint_history.csv")
    largest = {name: max(abs(row[k]) for row in rows) for k, name in enumerate(header)}
    print("   ", largest)
    expect(largest["opening_upstream_1"] > .001 and largest["slip_upstream_1"] > .001, "the joint opens and slides")
    area = zone_means(Path("one"))[1].sum()  # of both faces, farther than a tenth of the height from the base
    expect(abs(area / (6 * (92.7 + 36.8 + 73.5)) - 1) < .01, f"zones of {area} m2")
    runs("scene.prm", "--output", "still", *shaken, *settings("Mesh/File=three.msh", "Motion/Scale y=0"))
    same("three", "still", 1e-9, ("joint_history",))
    for directory in ("one", "three"):
        header, rows = table(f"{directory}/history.csv")
        expect(all(row[header.index("crest_y")] == 0 for row in rows), f"{directory}: the crest moves along y")


ROCK = {"Young's modulus": 20e9, "Poisson's ratio": .25, "Density": 2700.}
CELLS, BOX, WIDE = (4, 10), (8, 8), (16, 16)  # of the section; of the rock beside and below it, and under waves


def parts_with_rock(beside, below, degree):
    """Nodes [m], and stiffness [N/m] and mass [kg] of dam and rock: own plane elements."""
    nodes, ground = koyna.rock_below(koyna.section(*CELLS)[0], CELLS[0], beside, below)
    dam = koyna.section(*CELLS)[1]
    points, elements = plane_elements.all_nodes(nodes, dam + [cell for cell, _ in ground], degree)
    of_dam, of_rock = elements[:len(dam)], elements[len(dam):]
    return points, plane_elements.assemble(points, of_dam, degree, *KOYNA), plane_elements.assemble(points, of_rock, degree, *ROCK.values())


def on_rock(name, thickness, box=BOX, **sections):
    koyna.write(f"{name}.msh", *CELLS, thickness=thickness, rock=box)
    concrete = dict(zip(("Young's modulus", "Poisson's ratio", "Density"), KOYNA))
    return scene(name, f"{name}.msh", **{"Mesh": {"Plane strain": "true"}, "Concrete": concrete, **sections})


def massless():
    """The section on massless rock: the frequencies of own plane elements. Two thicknesses give the same history."""
    count = 6
    for degree in (1, 2):
        points, (stiffness, mass), (rock, _) = parts_with_rock(*BOX, degree)
        side = points[:, 0].max() - 1e-6, points[:, 0].min() + 1e-6, points[:, 1].min() + 1e-6
        free = np.repeat((points[:, 0] < side[0]) & (points[:, 0] > side[1]) & (points[:, 1] > side[2]), 2)
        K, m = (stiffness + rock)[np.ix_(free, free)], mass[free]
        moving = m > 0
        S = K[np.ix_(moving, moving)] - K[np.ix_(moving, ~moving)] @ np.linalg.solve(K[np.ix_(~moving, ~moving)], K[np.ix_(~moving, moving)])
        root = 1 / np.sqrt(m[moving])
        exact = np.sqrt(np.linalg.eigvalsh(S * np.outer(root, root))[:count]) / (2 * np.pi)
        file = on_rock("two", 2., Elements={"Degree": degree, "Incompatible modes": "false"}, Foundation={"Model": "massless", **ROCK})
        runs("modes", file, "--count", str(count), "--output", f"modes{degree}")
        header, rows = table(f"modes{degree}/modes.csv")
        off = max(abs(row[header.index("frequency")] / x - 1) for row, x in zip(rows, exact))
        print(f"    degree {degree}: {exact} Hz; difference {off:.1e} (limit 1e-6)")
        expect(len(rows) == count and off < 1e-6, f"{rows}, plane elements {exact}")
    wet = {"Model": "acoustic", "Density": RHO, "Water level": 90, "Element size": 6}
    for steps, water in ((1, {}), (4, {"Reservoir": wet})):
        for thickness in (1, 3):
            runs(on_rock(f"of_{thickness}", thickness, Foundation={"Model": "massless", **ROCK}, Statics={"Self-weight": "staged"},
                         Motion={"Source": "artificial", "Duration": 1, "Scale y": 0}, Dynamics={"Factors": "double", "Steps per sample": steps}, **water),
                 "--output", f"of_{thickness}", "--overwrite")
        same("of_1", "of_3", 1e-9, ("history",))


def sliding():
    """The section with friction on its base, on massless rock softer than the dam. A pull downstream just below the sliding limit mu W + c A
    has an equilibrium, whose sliding safety is the limit over the pull; one just above it has none. Without cohesion the limit is mu W."""
    mu, gravity, width = .7, 9.81, koyna.FACE[0][1]
    weight = gravity * KOYNA[2] * sum((a[1] + b[1]) / 2 * (b[0] - a[0]) for a, b in zip(koyna.FACE, koyna.FACE[1:]))
    for cohesion in (0, 1e6):
        file = on_rock("loose", 1., Foundation={"Model": "massless", **ROCK}, Joints={"Model": "FJA", "Friction": mu, "Adhesion": cohesion},
                       Statics={"Self-weight": "monolithic", "Gravity": gravity})
        mesh = Path("loose.msh")
        mesh.write_text(mesh.read_text().replace('"base"', '"base joint"'))
        limit, pull = mu * weight + cohesion * width, "Loads/Concentrated=pull: 0 0.5 15 {} 0 0"
        runs(file, "--output", f"below{cohesion:g}", *settings(pull.format(.995 * limit), f"Limits/Base friction={mu}", f"Limits/Base cohesion={cohesion}"))
        header, rows = table(f"below{cohesion:g}/blocks.csv")
        safety = rows[0][header.index("safety_1")]
        header, rows = table(f"below{cohesion:g}/joint_points.csv")
        slip = max(row[header.index("max_slip")] for row in rows)
        print(f"    cohesion {cohesion:g} Pa: limit {limit:.4e} N, at .995 of it the sliding safety {safety:.5f}, exact {1 / .995:.5f}, and the "
              f"largest slip {slip / (limit / KOYNA[0]):.2f} of F/E (limit 3)")
        expect(abs(.995 * safety - 1) < 1e-3, f"sliding safety {safety}")  # the footing weighs something
        expect(slip < 3 * limit / KOYNA[0], f"slip of {slip} m: more than the bodies can stretch")  # nodes of the footing that shear alternately
        stopped = voussoir(file, "--output", "above", *settings(pull.format(1.005 * limit)))
        expect(stopped.returncode == 1 and "no equilibrium: monolith 1" in stopped.stderr, f"above the limit: {stopped.stderr}")


class Channel:
    """Water upstream of the section, without bed waves: bilinear elements of the velocity potential, so long that no wave returns. Leapfrog rule."""

    def __init__(self, face, level, dt, n=30, length=700.):
        """face: heights of the nodes of the upstream face, level: of the water [m]."""
        self.dt, h = dt, level / n
        slopes = [np.diag([1.] + [2.] * (k - 1) + [1.]) - np.eye(k + 1, k=1) - np.eye(k + 1, k=-1) for k in (round(length / h), n)]
        means = [(3 * np.diag(np.diag(A)) - A) / 6 for A in slopes]
        self.terms = (slopes[0], means[1]), (means[0], slopes[1])
        ends = [np.diag(A) * h / 2 for A in slopes]
        self.mass = np.outer(*ends) / C**2
        self.area = np.array([np.interp(h * np.arange(n + 1), face, node) for node in np.eye(len(face))]) * ends[1]
        self.phi, self.rate = np.zeros(self.mass.shape), np.zeros(self.mass.shape)

    def advance(self, velocity):
        """Forces x on the nodes of the face [N/m] at the end of a step with these mean velocities x."""
        flux = -sum(A @ self.phi @ B for A, B in self.terms)
        flux[0] += velocity @ self.area
        self.rate += self.dt * flux / self.mass
        self.rate[:, -1] = 0.
        self.phi += self.dt * self.rate
        return -RHO * self.area @ self.rate[0]


def wide_reference(beside, below, wave, early, dt, steps, level=None):
    """Displacements x of the upstream crest and of the base [m] at intervals dt, explicit, in a box so wide that no reflection returns. A plane S wave rises, which
    comes to the ground after `early` [s], with half of the displacement wave(t) of an outcrop. level: of the water, which acts on the dam only."""
    nodes, ground = koyna.rock_below(koyna.section(*CELLS)[0], CELLS[0], beside, below)
    points, dam = np.array(nodes), koyna.section(*CELLS)[1]
    order = (0, 1, 3, 2)
    cells = np.array([[cell[k] for k in order] for cell in dam + [cell for cell, _ in ground]])
    matrices = [plane_elements.assemble(points[cell], np.arange(4)[None], 1, *KOYNA) for cell in cells[:len(dam)]]
    matrices += [plane_elements.assemble(points[cells[-1]], np.arange(4)[None], 1, *ROCK.values())] * len(ground)
    stiffness, mass = np.array([K for K, _ in matrices]), np.array([m for _, m in matrices])
    unknowns = np.stack([2 * cells, 2 * cells + 1], axis=2).reshape(len(cells), 8)
    mass = np.bincount(unknowns.ravel(), mass.ravel())
    speed = sqrt(ROCK["Young's modulus"] / 2 / (1 + ROCK["Poisson's ratio"]) / ROCK["Density"])
    held = np.repeat(points[:, 1] < points[:, 1].min() + 1e-6, 2)
    held[1::2] |= abs(points[:, 0] - points[:, 0].mean()) > .999 * np.ptp(points[:, 0]) / 2  # the wave has no z there
    rising = lambda t: np.stack([[.5 * wave(t - early - z / speed) for z in points[:, 1]], 0 * points[:, 1]], axis=1).ravel()
    before, u, result = rising(-dt), rising(0.), []
    crest, base = np.argmin(np.hypot(points[:, 0], points[:, 1] - 103.)), np.arange(CELLS[0] + 1)
    face = np.arange(0, len(dam) + CELLS[1] + 1, CELLS[0] + 1)
    water = Channel(points[face, 1], level, dt) if level else None
    for _ in range(steps):
        result.append((u[2 * crest], u[2 * base].mean()))
        force = np.bincount(unknowns.ravel(), np.einsum("eij,ej->ei", stiffness, u[unknowns]).ravel())
        if water:
            force[2 * face] -= water.advance((u - before)[2 * face] / dt)
        before, u = u, 2 * u - before - dt**2 * force / mass
        u[held] = 0.
    return np.array(result).T


def waves():
    """The section on rock with mass, under a rising S wave: crest and base of a wide box of own elements. Two thicknesses give the same histories."""
    wave = lambda t: scenes.outcrop(t, .01, .35, 4.)
    speed = sqrt(ROCK["Young's modulus"] / 2 / (1 + ROCK["Poisson's ratio"]) / ROCK["Density"])
    size, dt, steps, early = koyna.FACE[0][1] / CELLS[0], .0015, 600, .04
    delay = (WIDE[1] + 1) * size / speed
    shaken = {"Source": "file", "File": "wave.txt", "Unit": "m/s^2", "Duration": dt * steps, "Time step": dt}
    np.savetxt("wave.txt", [[k * dt, wave(k * dt)[1], 0., 0.] for k in range(steps + 1)])
    rock = {"Model": "rock", **ROCK, "Stiffness damping": 0}
    wet = [*ACOUSTIC, *settings(f"Reservoir/Density={RHO}", "Reservoir/Water level=90", f"Reservoir/Sound speed={C}", "Reservoir/Length=900", "Reservoir/Element size=3")]
    for level, case, limit in ((0, (), 2e-8), (90, wet, 2e-6)):
        for thickness in (1, 3 if level else 20):
            runs(on_rock(f"of_{thickness}", thickness, WIDE, Elements={"Incompatible modes": "false"}, Foundation=rock, Motion=shaken,
                         Dynamics={"Factors": "double"}), "--output", f"of_{thickness}", "--overwrite", *case)
        same("of_1", f"of_{thickness}", limit, ("history",))  # eight digits; of the settlement by the water 1e-6
        header, rows = table("of_1/history.csv")
        t, x, base = np.array([(row[0], row[header.index("crest_x")], row[header.index("base_x")]) for row in rows]).T  # crest_x: relative to the base
        fine, n = .001, 680
        for name, values, exact in zip(("crest", "base"), (x + base, base), wide_reference(52, 76, lambda t: wave(t)[0], early, fine, n, level)):
            off = np.abs(np.interp(np.arange(n) * fine + delay - early, t, values - values[0]) - exact).max() / np.abs(exact).max()
            print(f"    level {level} m, {name}: largest difference {100 * off:.2f} % of {1e3 * np.abs(exact).max():.2f} mm (limit 2 %)")
            expect(off < .02, f"{name}: {off}")


def wet_force(t, a, alpha, n=24, shift=8.):
    """Downstream force per width [N/m] on a rigid vertical wall of the depth H under the acceleration a, infinite channel, absorbing bed: modes of linear
    elements over the depth for each frequency (Fenves and Chopra 1984), on the line Re s = shift / length of the record."""
    dz, dt, steps = H / n, t[1] - t[0], 2 * len(t)
    q = (1 - alpha) / (1 + alpha) / C
    K, M = (np.diag([d] + [2 * d] * (n - 1)) + np.diag([e] * (n - 1), 1) + np.diag([e] * (n - 1), -1) for d, e in ((1 / dz, -1 / dz), (dz / 3, dz / 6)))
    load, inverse = M @ np.ones(n) + np.eye(n)[-1] * dz / 6, np.linalg.inv(M)
    damping = shift / (steps * dt)
    spectrum = np.fft.rfft(np.exp(-damping * t) * a, steps)
    result = np.zeros(len(spectrum), complex)
    for k, omega in enumerate(2 * np.pi * np.fft.rfftfreq(steps, dt)):
        s = damping + 1j * omega
        if omega > 2 * np.pi * 100:
            break
        A = K.astype(complex)
        A[0, 0] += s * q
        squares, modes = np.linalg.eig(inverse @ A)
        modes = modes / np.sqrt(np.einsum("ij,ik,kj->j", modes, M, modes))
        result[k] = RHO * np.sum((load @ modes)**2 / np.sqrt(squares + s * s / C**2)) * spectrum[k]
    return np.fft.irfft(result, steps)[:len(t)] * np.exp(damping * t)


def water():
    """A stiff wall 1 m wide, and a stiff section on stiff massless rock: force of the water by pulses along x, exact modes with an absorbing bed, and
    pressure at the bed by a pulse along z. The sides of the slice neither absorb nor move the water. Two thicknesses give the same."""
    dt = .001
    t = np.arange(0, 1 + dt / 2, dt)
    common = settings("Motion/Source=file", "Motion/File=pulse.txt", "Motion/Unit=m/s^2", f"Motion/Time step={dt}", "Motion/Duration=1", "Reservoir/Water level=60",
                      f"Reservoir/Density={RHO}", f"Reservoir/Sound speed={C}", "Reservoir/Element size=2.5", "Reservoir/Length=900",
                      "Output/Pressure depths=60", "Output/Block forces=true", "Dynamics/Factors=double")
    pulse = lambda period: np.where(t < period, np.sin(2 * np.pi * t / period), 0)
    for width in (1., 5.):
        meshes.wall(f"wall{width:g}.msh", width=width, n_up=24)
    koyna.write("rock1.msh", *CELLS, rock=(4, 4))
    stiff = {"Young's modulus": 2e17, "Density": 2500}
    for mesh, width, period, alpha, limit in (("rock", 1., .1, .5, .01), ("wall", 1., .4, 1., .01), ("wall", 1., .4, .5, .01),
                                              ("wall", 1., .1, .5, .01), ("wall", 5., .1, .5, .01)):
        file = scene("stiff", f"{mesh}{width:g}.msh", Mesh={"Plane strain": "true"}, Concrete=stiff,
                     Foundation={"Model": "massless", **stiff} if mesh == "rock" else {})
        a, name = pulse(period), f"of{width:g}"
        np.savetxt("pulse.txt", np.column_stack([t, a, 0 * t, 0 * t]))
        runs(file, "--output", "dry", "--overwrite", *common, *settings("Reservoir/Model=none"))
        runs(file, "--output", name, "--overwrite", *common, *ACOUSTIC, *settings(f"Reservoir/Reflection={alpha}"))
        found, exact = (base_force(name) - base_force("dry")) / width, wet_force(t, a, alpha)
        error = np.abs(found[1:] - .5 * (exact[1:] + exact[:-1])).max() / np.abs(exact).max()
        print(f"    {mesh}, width {width} m, pulse of {period} s, reflection {alpha}: largest error {100 * error:.2f} % (limit {100 * limit} %)")
        expect(error < limit, f"error {error}")
    v = .1 / 2 / np.pi * np.where(t < .1, 1 - np.cos(2 * np.pi * t / .1), 0)
    np.savetxt("pulse.txt", np.column_stack([t, 0 * t, 0 * t, pulse(.1)]))
    runs(file, "--output", "rising", *common, *ACOUSTIC, *settings("Reservoir/Reflection=0.5"))
    header, rows = table("rising/history.csv")
    found, exact = [row[header.index("pressure_60")] for row in rows], bed_pressure(v, dt, .5, 1e30)
    error = np.abs(found - exact).max() / np.abs(exact).max()
    print(f"    bed: {100 * error:.2f} % (limit 2 %)")
    expect(error < .02, f"bed: {error}")


if __name__ == "__main__":
    run_cases(modes, column, joint, massless, sliding, waves, water)
