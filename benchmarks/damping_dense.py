#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Openings under uniform damping over those under the damping matrix C = 2 z M sqrt(M^-1 K) of each monolith.

    benchmarks/damping_dense.py [--motions 8] [--voussoir PROGRAM]

The dam is prm/coarse.prm with three joints (FJB), few elements and a full reservoir without added mass. Elements, static state,
leapfrog rule, contact and both kinds of damping are computed here. Column `program`: openings of Voussoir with uniform damping
over those of this file, which must be 1. The other columns: openings with uniform damping over those with the matrix and a
modulus multiplied by the number in the heading, because the modulus of uniform damping grows with the frequency."""

import argparse
import math
import sys
import tempfile
from statistics import median

import numpy as np

from program import ROOT, add_program_argument, frequencies, run, simulate

sys.path.insert(0, str(ROOT / "tests" / "golden"))
import meshes  # noqa: E402

YOUNG, POISSON, DENSITY, LEVEL, STEP, SAMPLE, RATIO, BAND = 24e9, .2, 2400., 210., .0005, .01, .05, (.5, 20.)
DAM = {"Mesh/Arch210/Joints": 3, "Mesh/Arch210/Elements along": 8, "Mesh/Arch210/Elements up": 4, "Mesh/Arch210/Elements through": 1,
       "Elements/Incompatible modes": "false", "Joints/Model": "FJB", "Reservoir/Model": "none", "Statics/Self-weight": "none",
       "Concrete/Young's modulus": YOUNG, "Concrete/Poisson's ratio": POISSON, "Concrete/Density": DENSITY, "Reservoir/Water level": LEVEL,
       "Motion/Time step": SAMPLE, "Damping/Ratio": RATIO}
UNIFORM = {"Damping/Model": "uniform", "Dynamics/Scheme": "explicit", "Dynamics/Explicit step": STEP}
MODULI = (.9, .95, 1., 1.05, 1.1)
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
G = 1 / math.sqrt(3)


def element(x):
    """Stiffness matrix and nodal masses of a hexahedron with the corners x."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    D = np.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lame
    K, mass = np.zeros((24, 24)), np.zeros(8)
    for p in G * SIGNS:
        shape = np.prod(1 + SIGNS * p, axis=1) / 8
        local = np.array([SIGNS[:, d] * np.prod(np.delete(1 + SIGNS * p, d, axis=1), axis=1) for d in range(3)]) / 8
        jacobian = local @ x
        grad = np.linalg.solve(jacobian, local)
        B = np.zeros((6, 24))
        for row, (a, b) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))):
            B[row, a::3] += grad[b] if a != b else grad[a]
            if a != b:
                B[row, b::3] += grad[a]
        K += B.T @ D @ B * np.linalg.det(jacobian)
        mass += DENSITY * shape * np.linalg.det(jacobian)
    return K, mass


def over_face(x, value):
    """Integrals of the shape functions times value(place) times the area vector of a quadrilateral with the corners x."""
    signs, result = SIGNS[:4, :2], np.zeros((4, 3))
    for p in G * signs:
        shape = np.prod(1 + signs * p, axis=1) / 4
        a, b = (np.array([signs[:, d] * (1 + signs[:, 1 - d] * p[1 - d]) for d in (0, 1)]) / 4) @ x
        result += np.outer(shape, np.cross(a, b)) * value(shape @ x)
    return result


class Dam:
    """Dense matrices of the monoliths, whose nodes have numbers of their own, and pairs of nodes at the joints."""
    def __init__(self, file):
        nodes, elements, names = meshes.read(file)
        points = np.array([nodes[i + 1] for i in range(len(nodes))])
        hexes = [(m, [i - 1 for i in cell]) for kind, m, cell in elements if kind == 5]
        quads = [(names[2, s], [i - 1 for i in face]) for kind, s, face in elements if kind == 3]
        held = {i for name, face in quads if name == "base" for i in face}
        keys = sorted({(m, i) for m, cell in hexes for i in cell if i not in held})
        self.number = {key: k for k, key in enumerate(keys)}
        n = 3 * len(keys)
        self.K, self.mass, self.load, faces = np.zeros((n, n)), np.zeros(n), np.zeros(n), {}
        for m, cell in hexes:
            K, mass = element(points[cell])
            at = np.array([3 * self.number.get((m, i), -n) + c for i in cell for c in range(3)])
            free = at >= 0
            self.K[np.ix_(at[free], at[free])] += K[np.ix_(free, free)]
            np.add.at(self.mass, at[free], np.repeat(mass, 3)[free])
            middle = points[cell].mean(axis=0)
            for corners in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
                face = [cell[c] for c in corners]
                faces.setdefault(frozenset(face), []).append((m, face, middle))
        wet = {frozenset(face) for name, face in quads if name == "upstream"}
        normals = {}
        for key, sides in faces.items():
            m, face, middle = min(sides, key=lambda side: side[0])
            area = over_face(points[face], lambda x: 1.)
            outward = math.copysign(1., area.sum(axis=0) @ (points[face].mean(axis=0) - middle))
            if key in wet:
                push = over_face(points[face], lambda x: -outward * 9810. * max(0., LEVEL - x[2]))
                for i, f in zip(face, push):
                    if (m, i) in self.number:
                        self.load[3 * self.number[m, i]:][:3] += f
            if len({side[0] for side in sides}) == 2:  # a joint: normals from the lower to the higher monolith
                for i, a in zip(face, outward * area):
                    pair = (min(sides)[0], max(side[0] for side in sides), i)
                    normals[pair] = normals.get(pair, 0.) + a
        pairs = [pair for pair in sorted(normals) if (pair[0], pair[2]) in self.number]
        self.sides = [np.array([3 * self.number[pair[k], pair[2]] + np.arange(3) for pair in pairs]) for k in (0, 1)]
        self.normal = np.array([normals[pair] / np.linalg.norm(normals[pair]) for pair in pairs])

    def gaps(self, u):
        return u[self.sides[1]] - u[self.sides[0]]

    def static(self):
        """Displacement under the load: tied along the joints, and by their normal forces where these press."""
        n, closed = len(self.mass), np.ones(len(self.normal), bool)
        for _ in range(50):
            rows = []
            for p, normal in enumerate(self.normal):
                basis = np.linalg.svd(normal[None])[2]  # the normal, and two tangents
                for axis in basis if closed[p] else basis[1:]:
                    row = np.zeros(n)
                    row[self.sides[1][p]], row[self.sides[0][p]] = axis, -axis
                    rows.append(row)
            B = np.array(rows)
            solution = np.linalg.solve(np.block([[self.K, B.T], [B, np.zeros((len(B), len(B)))]]) / YOUNG, np.append(self.load, np.zeros(len(B))) / YOUNG)
            u, force = solution[:n], np.add.reduce((self.K @ solution[:n] - self.load)[self.sides[1]] * self.normal, axis=1)
            new = np.where(closed, force > -1e-6 * abs(self.load).max(), np.add.reduce(self.gaps(u) * self.normal, axis=1) < 0)
            if (new == closed).all():
                return u
            closed = new
        raise SystemExit("The static state was not found.")

    def root(self):
        """C / (2 z) = M sqrt(M^-1 K)."""
        root = np.sqrt(self.mass)
        values, vectors = np.linalg.eigh(self.K / np.outer(root, root))
        return (vectors * np.sqrt(values.clip(0))) @ vectors.T * np.outer(root, root)

    def largest_opening(self, acceleration, law=None, C=None, modulus=1.):
        """Leapfrog rule from the static state; openings at the samples. law: modulus, c and tau of uniform damping."""
        u_static = u = self.static()
        modulus, c, tau = law or (modulus, np.zeros(1), np.ones(1))
        v, d, kept = np.zeros_like(u), np.zeros((len(c), len(u))), np.exp(-STEP / tau)[:, None]
        added = tau[:, None] * (1 - kept)
        by_force = STEP * (1 / self.mass[self.sides[0][:, :1]] + 1 / self.mass[self.sides[1][:, :1]])
        most, per_sample = 0., round(SAMPLE / STEP)
        for before, after in zip(acceleration, acceleration[1:]):
            for k in range(per_sample):
                force = self.load - self.K @ (u_static + modulus * (u - u_static + c @ d)) - (C @ v if C is not None else 0.)
                v += STEP * (force / self.mass - np.tile(before + (after - before) * k / per_sample, len(u) // 3))
                b = self.gaps(u + STEP * v)
                opened = np.add.reduce(b * self.normal, axis=1).clip(0)[:, None] * self.normal
                f = (opened - b) / (STEP * by_force)
                v[self.sides[1]] += STEP * f / self.mass[self.sides[1]]
                v[self.sides[0]] -= STEP * f / self.mass[self.sides[0]]
                u = u + STEP * v
                d = kept * d + added * v
            most = max(most, np.add.reduce(self.gaps(u) * self.normal, axis=1).max())
        return most


def uniform_law(reference):
    """Static modulus, c and tau of uniform damping, by the fit of source/solid/damping.cc."""
    best = (1e300,)
    for beyond in np.geomspace(.5, 4, 40):
        wanted = RATIO
        for _ in range(4):
            f, w = (2 * math.pi * np.geomspace(a, b, n) for a, b, n in ((BAND[0] / beyond, BAND[1] * beyond, 3), (*BAND, 40)))
            weight = np.linalg.lstsq(f * (.5 / wanted * w[:, None] + f) / (f**2 + w[:, None]**2), np.ones(40), rcond=None)[0]
            if weight.min() <= 0:
                break
            modulus = lambda w: 1 - (weight * f / (f + 1j * np.asarray(w)[..., None])).sum(axis=-1)
            w = 2 * math.pi * np.geomspace(*BAND, 80)
            pole = 1j * w
            for _ in range(60):
                pole = 1j * w * np.sqrt(modulus(-1j * pole))
            error = -pole.real / abs(pole) / RATIO - 1
            if abs(error).max() < best[0]:
                unrelaxed = 1 / modulus(2 * math.pi * reference).real
                static = unrelaxed * (1 - weight.sum())
                best = (abs(error).max(), (static, unrelaxed * weight / static, 1 / f))
            wanted /= 1 + .5 * (error.min() + error.max())
    return best[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motions", type=int, default=8)
    add_program_argument(parser)
    options = parser.parse_args()
    scene, rows = ROOT / "prm" / "coarse.prm", []
    reference = frequencies(options.voussoir, scene, 1, DAM)[0][0]
    with tempfile.TemporaryDirectory() as place:
        run(options.voussoir, "mesh", scene, "--output", f"{place}/dam.msh", "--format", "2.2", settings=DAM)
        dam = Dam(f"{place}/dam.msh")
        print(f"{len(dam.mass)} unknowns, {len(dam.normal)} pairs, reference frequency {reference:.4f} Hz")
        print("| seed | program |", " | ".join(f"{modulus}" for modulus in MODULI), "|\n|---|---|" + "---|" * len(MODULI))
        law, root = uniform_law(reference), dam.root()
        for seed in range(1, options.motions + 1):
            output = f"{place}/{seed}"
            summary = simulate(options.voussoir, scene, {**DAM, **UNIFORM, "Damping/Reference frequency": reference, "Motion/Seed": seed}, output)
            history = np.genfromtxt(f"{output}/history.csv", delimiter=",", names=True)
            acceleration = np.array([history[f"base_acceleration_{c}"] for c in "xyz"]).T
            ours = dam.largest_opening(acceleration, law)
            rows.append([summary["extremes"]["max_opening"]["value"] / ours, *(
                ours / dam.largest_opening(acceleration, C=2 * RATIO * math.sqrt(s) * root, modulus=s) for s in MODULI)])
            print(f"| {seed} |", " | ".join(f"{x:.4f}" for x in rows[-1]), "|", flush=True)
    print("| median |", " | ".join(f"{median(x):.4f}" for x in zip(*rows)), "|")


if __name__ == "__main__":
    main()
