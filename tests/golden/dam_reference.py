#!/usr/bin/python3
"""A second program for small jointed dams on a rigid base, written from the equations with dense matrices, for the golden
numbers of program_golden.py. It shares no line with Voussoir, and never calls it.

    dam_reference.py [SCENE...]         writes reference_SCENE.json beside this script, for the scenes of scenes.py

What it computes, after doc/method.md:
- hexahedra of 8 nodes (plain, or with the modes of Taylor, Beresford and Wilson 1976) or 27 nodes, lumped by row sums;
- hydrostatic pressure, Westergaard's added mass 7/8 rho sqrt(H h) on the normal, by the nodes' area vectors;
- self-weight on free-standing monoliths, or on the whole; Rayleigh damping;
- the trapezoidal rule with the joints' forces as means over the step, Coulomb's law as Alart and Curnier's equations
  (Newton's method on the condensed problem), and Coulomb's law for impulses at the end of the step;
- principal stresses by numpy's eigenvalues, extrapolated from 2 x 2 x 2 Gauss points, averaged within each monolith.
"""

import itertools
import json
import sys
from pathlib import Path

import numpy as np
import scipy.linalg
import scipy.sparse

HERE = Path(__file__).resolve().parent
YOUNG, POISSON, DENSITY, GRAVITY, WATER = 21e9, .17, 2400., 9.81, 1000.
BASE, UPSTREAM, DOWNSTREAM, CREST = 1, 2, 3, 4
# gmsh's corner number at each place of a lattice that runs along xi, then eta, then zeta
LATTICE = [0, 1, 3, 2, 4, 5, 7, 6]


def lagrange(degree, x):
    """Values and slopes of the 1-D polynomials through equal points of [-1, 1]."""
    points = np.linspace(-1, 1, degree + 1)
    value, slope = np.ones(degree + 1), np.zeros(degree + 1)
    for i, p in enumerate(points):
        others = [q for q in points if q != p]
        value[i] = np.prod([(x - q) / (p - q) for q in others])
        slope[i] = sum(np.prod([(x - q) for q in others if q != r]) for r in others) / np.prod([p - q for q in others])
    return value, slope


def shapes(degree, xi):
    """Shape functions of the lattice and their slopes along xi, eta, zeta; or of a face, for two coordinates."""
    one = [lagrange(degree, x) for x in xi]
    n, dim = (degree + 1)**len(xi), len(xi)
    value, slope = np.ones(n), np.ones((n, dim))
    for k, index in enumerate(itertools.product(range(degree + 1), repeat=dim)):
        index = index[::-1]  # xi runs fastest
        for d in range(dim):
            value[k] *= one[d][0][index[d]]
            for e in range(dim):
                slope[k, e] *= one[d][1 if d == e else 0][index[d]]
    return value, slope


def read_mesh(path, turn=lambda x: x):
    """Nodes, hexahedra with their monolith, and the quadrilaterals of the surfaces, of an MSH 2.2 file."""
    lines = iter(Path(path).read_text().splitlines())
    nodes, cells, quads = {}, [], []
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                tag, *x = next(lines).split()
                nodes[int(tag)] = turn(np.array(x, dtype=float))
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                f = [int(w) for w in next(lines).split()]
                corners = [nodes[t] for t in f[3 + f[2]:]]
                if f[1] == 5:
                    cells.append((f[3], np.array(corners)[LATTICE]))
                elif f[1] == 3:
                    quads.append((f[3], np.array(corners)))
    return cells, quads


def key(x):
    return tuple(int(round(1e4 * c)) for c in x)


class Dam:
    """`tied`: the monoliths share their unknowns. Unknowns: 3 to a free node, all nodes are kept for the stresses."""

    def __init__(self, path, degree=1, modes=False, tied=False, turn=lambda x: x, damping=(0., 0.), poisson=POISSON,
                 level=0.):
        self.degree, self.modes, self.poisson, self.level = degree, modes, poisson, level
        cells, quads = read_mesh(path, turn)
        surface_of = {frozenset(key(x) for x in corners): tag for tag, corners in quads if tag < 100}
        number, self.points, self.monolith = {}, [], []
        self.cells, self.geometry = [], []
        self.on = {s: set() for s in (BASE, UPSTREAM, DOWNSTREAM, CREST)}
        self.faces, sides = {s: [] for s in self.on}, {}
        ticks = np.linspace(-1, 1, degree + 1)
        for monolith, corners in cells:
            if np.linalg.det(corners.T @ shapes(1, (0, 0, 0))[1]) < 0:
                corners = corners[[4, 5, 6, 7, 0, 1, 2, 3]]
            local = []
            for z, y, x in itertools.product(ticks, repeat=3):
                p = shapes(1, (x, y, z))[0] @ corners
                if (monolith, key(p)) not in number:
                    number[monolith, key(p)] = len(self.points)
                    self.points.append(p)
                    self.monolith.append(monolith)
                local.append(number[monolith, key(p)])
            self.cells.append(np.array(local))
            self.geometry.append(corners)
            lattice = np.arange(len(local)).reshape(3 * (degree + 1,))  # zeta, eta, xi
            for axis, end in itertools.product(range(3), (0, -1)):
                face = np.array(local)[np.take(lattice, end, axis=axis)]
                inside = np.array(local)[np.take(lattice, -1 - end, axis=axis)]
                corner = face[[0, 0, -1, -1], [0, -1, 0, -1]]
                name = frozenset(key(self.points[i]) for i in corner)
                towards = np.mean([self.points[i] for i in inside.ravel()], axis=0) - np.mean(
                    [self.points[i] for i in face.ravel()], axis=0)
                if name in surface_of:
                    self.faces[surface_of[name]].append((face.ravel(), towards))
                    self.on[surface_of[name]] |= set(face.ravel())
                sides.setdefault(name, []).append((monolith, face.ravel(), towards))
        self.points, self.monolith = np.array(self.points), np.array(self.monolith)
        n = len(self.points)
        master = list(range(n))
        if tied:
            first = {}
            master = [first.setdefault(key(p), i) for i, p in enumerate(self.points)]
        fixed = {master[i] for i in self.on[BASE]}
        self.equation = np.full(n, -1)
        count = 0
        for i in range(n):
            if master[i] not in fixed and master[i] == i:
                self.equation[i] = count
                count += 1
        for i in range(n):
            if master[i] != i and master[i] not in fixed:
                self.equation[i] = self.equation[master[i]]
        self.n = count
        self.assemble()
        self.A0, self.A1 = damping
        self.added = np.zeros((count, 3, 3))
        self.pairs = [] if tied else self.find_pairs(sides)

    def dofs(self, nodes):
        return (3 * self.equation[nodes][:, None] + np.arange(3)).ravel()

    def elasticity(self):
        mu, lam = YOUNG / 2 / (1 + self.poisson), YOUNG * self.poisson / (1 + self.poisson) / (1 - 2 * self.poisson)
        D = np.diag([2 * mu] * 3 + [mu] * 3)
        D[:3, :3] += lam
        return D

    @staticmethod
    def strain(g):
        """Strains xx yy zz xy yz zx of displacements with the gradients g (n,3)."""
        B = np.zeros((6, 3 * len(g)))
        for k, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]):
            B[k, i::3] += g[:, j]
            if i != j:
                B[k, j::3] += g[:, i]
        return B

    def assemble(self):
        """Stiffness, lumped mass, and each node's stress as a matrix on the displacements of all nodes."""
        degree, n_all = self.degree, 3 * len(self.points)
        D, root = self.elasticity(), 1 / np.sqrt(3)
        K, m = np.zeros((3 * self.n, 3 * self.n)), np.zeros(self.n)
        self.stress_of = scipy.sparse.lil_matrix((6 * len(self.points), n_all))
        cells_at = np.zeros(len(self.points))
        gauss = np.polynomial.legendre.leggauss(degree + 1)
        ticks = np.linspace(-1, 1, degree + 1)
        places = [(x, y, z) for z, y, x in itertools.product(ticks, repeat=3)]
        stress_points = [(x, y, z) for z, y, x in itertools.product((-root, root), repeat=3)]
        self.nodal_mass = np.zeros(len(self.points))
        for cell, corners in zip(self.cells, self.geometry):
            middle = corners.T @ shapes(1, (0, 0, 0))[1]

            def operator(xi):
                jacobian = corners.T @ shapes(1, xi)[1]
                g = shapes(degree, xi)[1] @ np.linalg.inv(jacobian)
                if self.modes:
                    scale = np.linalg.det(middle) / np.linalg.det(jacobian)
                    g = np.vstack([g, np.diag([-2 * x for x in xi]) @ np.linalg.inv(middle) * scale])
                return self.strain(g), np.linalg.det(jacobian)

            nodal = 3 * len(cell)
            size = nodal + (9 if self.modes else 0)
            k, mass = np.zeros((size, size)), np.zeros(len(cell))
            for (x, wx), (y, wy), (z, wz) in itertools.product(zip(*gauss), repeat=3):
                B, volume = operator((x, y, z))
                k += wx * wy * wz * volume * B.T @ D @ B
                mass += wx * wy * wz * volume * DENSITY * shapes(degree, (x, y, z))[0]
            inner = -np.linalg.solve(k[nodal:, nodal:], k[nodal:, :nodal])
            full = np.vstack([np.eye(nodal), inner])
            k = full.T @ k @ full
            free = np.repeat(self.equation[cell] >= 0, 3)
            dofs = self.dofs(cell)[free]
            K[np.ix_(dofs, dofs)] += k[np.ix_(free, free)]
            np.add.at(m, self.equation[cell][self.equation[cell] >= 0], mass[self.equation[cell] >= 0])
            self.nodal_mass[cell] += mass
            at = [D @ operator(xi)[0] @ full for xi in stress_points]
            everywhere = (3 * cell[:, None] + np.arange(3)).ravel()
            for i, place in zip(cell, places):
                cells_at[i] += 1
                for weight, s in zip(shapes(1, np.array(place) / root)[0], at):
                    self.stress_of[6 * i:6 * i + 6, everywhere] += weight * s
        self.stress_of = scipy.sparse.diags(1 / np.repeat(cells_at, 6)) @ self.stress_of.tocsr()
        self.K, self.m = K, m

    def area(self, surface, level=None):
        """Area vector of each node, outwards [m^2]; or, with a level, its force under unit weight of water [m^3]."""
        total = np.zeros((len(self.points), 3))
        gauss = np.polynomial.legendre.leggauss(8)
        for face, inwards in self.faces[surface]:
            corner = self.points[face[[0, self.degree, -1 - self.degree, -1]]]
            for (x, wx), (y, wy) in itertools.product(zip(*gauss), repeat=2):
                geometry, slope = shapes(1, (x, y))
                vector = np.cross(corner.T @ slope[:, 0], corner.T @ slope[:, 1])
                vector *= -np.sign(vector @ inwards) * wx * wy
                factor = 1. if level is None else -max(0., level - (geometry @ corner)[2])
                total[face] += factor * np.outer(shapes(self.degree, (x, y))[0], vector)
        return total

    def gather(self, nodal):
        """Sum of the nodes' vectors on the unknowns."""
        load = np.zeros((self.n, 3))
        free = self.equation >= 0
        np.add.at(load, self.equation[free], nodal[free])
        return load.ravel()

    def water(self):
        return self.gather(WATER * GRAVITY * self.area(UPSTREAM, self.level))

    def weight(self):
        return self.gather(-GRAVITY * self.nodal_mass[:, None] * np.array([0, 0, 1.]))

    def add_westergaard(self, depth, factor=1.):
        """Returns the total along x, what rests on the base included [kg]."""
        area = self.area(UPSTREAM)
        foot = {}
        for i in self.on[UPSTREAM] & self.on[BASE]:
            foot[round(self.points[i][1], 6)] = self.points[i][2]
        ys = sorted(foot)
        lowest, total = min(foot.values()), 0.
        shared = {}  # tied nodes add their areas up where they are one unknown: masses of each part
        for i in sorted(self.on[UPSTREAM]):
            y, z = self.points[i][1:]
            below = lowest if depth == "global" else np.interp(y, ys, [foot[q] for q in ys])
            h, size = self.level - z, np.linalg.norm(area[i])
            if h <= 0 or size == 0:
                continue
            H = max(self.level - below, h)
            part = factor * 7 / 8 * WATER * np.sqrt(H * h) / size * np.outer(area[i], area[i])
            total += part[0, 0]
            if self.equation[i] >= 0:
                self.added[self.equation[i]] += part
        return total

    def find_pairs(self, sides):
        pairs, joints = {}, {}
        for name, owners in sides.items():
            if len(owners) == 2 and owners[0][0] != owners[1][0]:
                (low, face, towards), (high, other, _) = sorted(owners, key=lambda o: o[0])
                partner = {key(self.points[i]): i for i in other}
                corner = self.points[face[[0, self.degree, -1 - self.degree, -1]]]
                gauss = np.polynomial.legendre.leggauss(self.degree + 1)
                for (x, wx), (y, wy) in itertools.product(zip(*gauss), repeat=2):
                    slope = shapes(1, (x, y))[1]
                    vector = np.cross(corner.T @ slope[:, 0], corner.T @ slope[:, 1])
                    vector *= -np.sign(vector @ towards) * wx * wy
                    for i, s in zip(face, shapes(self.degree, (x, y))[0]):
                        entry = pairs.setdefault((low, i), [partner[key(self.points[i])], np.zeros(3)])
                        entry[1] += s * vector
        result = []
        for (joint, i), (j, vector) in sorted(pairs.items()):
            if self.equation[i] < 0 and self.equation[j] < 0:
                continue
            n = vector / np.linalg.norm(vector)
            b = np.array([0, 0, 1.]) - n[2] * n
            b /= np.linalg.norm(b)
            result.append((joint, i, j, np.array([n, np.cross(b, n), b])))
        return result

    def jumps(self):
        """The matrix G: jumps (n, a, b) of all pairs of the unknowns."""
        G = np.zeros((3 * len(self.pairs), 3 * self.n))
        for p, (_, i, j, frame) in enumerate(self.pairs):
            for node, sign in ((i, -1), (j, 1)):
                if self.equation[node] >= 0:
                    G[3 * p:3 * p + 3, self.dofs(np.array([node]))] = sign * frame
        return G

    def everywhere(self, u):
        """The displacements of all nodes."""
        x = np.zeros((len(self.points), 3))
        free = self.equation >= 0
        x[free] = u.reshape(-1, 3)[self.equation[free]]
        return x

    def stresses(self, u):
        return (self.stress_of @ self.everywhere(u).ravel()).reshape(-1, 6)

    def crown(self):
        """Of the upstream edge of the crest the node nearest to the middle of its length, and the edge's arc lengths."""
        edge = sorted(self.on[CREST] & self.on[UPSTREAM], key=lambda i: self.points[i][1])
        line = []
        for i in edge:
            if not line or np.linalg.norm(self.points[line[-1]] - self.points[i]) > 1e-6:
                line.append(i)
        steps = np.linalg.norm(np.diff(self.points[line][:, :2], axis=0), axis=1)
        s = np.append(0., np.cumsum(steps)) - .5 * steps.sum()
        return line[int(np.argmin(np.abs(s)))], {key(self.points[i]): x for i, x in zip(line, s)}


def principal(stress):
    """Largest and smallest principal stress of rows xx yy zz xy yz zx."""
    t = np.empty((len(stress), 3, 3))
    for k, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]):
        t[:, i, j] = t[:, j, i] = stress[:, k]
    values = np.linalg.eigvalsh(t)
    return values[:, 2], values[:, 0]


def coulomb(W, b, start, mu, force):
    """Forces f with gap = W f + b: f_n >= 0, gap_n >= 0, one of them zero; |f_t| <= mu f_n, against the slip since
    `start`. mu = None: no slip, open or closed. Newton's method on Alart and Curnier's equations."""
    n = len(b) // 3
    rho = 1. / np.repeat([np.linalg.eigvalsh(W[3 * p:3 * p + 3, 3 * p:3 * p + 3])[-1] for p in range(n)], 3)
    t = np.arange(3 * n).reshape(-1, 3)[:, 1:]

    def residual(f, jacobian=False):
        gap = W @ f + b
        x = f - rho * gap
        r, A, B = f.copy(), np.eye(3 * n), np.zeros((3 * n, 3 * n))  # dr = A df + B dgap
        for p in range(n):
            k, e = 3 * p, t[p]
            closed = x[k] > 0
            if closed:
                r[k] = rho[k] * gap[k]
                A[k, k], B[k, k] = 0., rho[k]
            if mu is None:
                r[e] = rho[e] * gap[e]
                A[e, e], B[e, e] = 0., rho[e]
                continue
            y = f[e] - rho[e] * (gap[e] - start[e])
            radius, size = mu * max(0., x[k]), np.linalg.norm(y)
            if size <= radius:
                r[e] = rho[e] * (gap[e] - start[e])
                A[e, e], B[e, e] = 0., rho[e]
            elif closed:
                d = y / size
                r[e] = f[e] - radius * d
                P = radius / size * (np.eye(2) - np.outer(d, d))
                A[np.ix_(e, e)] -= P
                B[np.ix_(e, e)] += P * rho[e]
                A[e, k] -= mu * d
                B[e, k] += mu * d * rho[k]
        return (r, A + B @ W) if jacobian else r

    def sweep(f):
        """Each pair in turn, by projection."""
        gap = W @ f + b
        for p in range(n):
            k = slice(3 * p, 3 * p + 3)
            for _ in range(20):
                g = gap[k]
                new = f[k] - rho[k] * (g - np.append(0., start[t[p]] if mu is not None else np.zeros(2)))
                new[0] = max(0., f[3 * p] - rho[3 * p] * g[0])
                if mu is not None:
                    size = np.linalg.norm(new[1:])
                    if size > mu * new[0]:
                        new[1:] *= mu * new[0] / size
                change = new - f[k]
                f[k] = new
                gap += W[:, k] @ change
        return f

    scale = max(np.abs(b * rho).max(), np.abs(force).max(), 1e-300)
    f = force.copy()
    for attempt in range(200):
        for _ in range(40):
            r, J = residual(f, True)
            size = np.linalg.norm(r)
            if np.abs(r).max() <= 1e-12 * scale:
                return f
            step = np.linalg.solve(J, -r)
            length = 1.
            while length > 1e-3 and np.linalg.norm(residual(f + length * step)) > (1 - 1e-4 * length) * size:
                length /= 2
            if length <= 1e-3:
                break
            f = f + length * step
        for _ in range(5):
            f = sweep(f)
    raise RuntimeError("the joints do not converge")


def impulse_of_pair(H, v, mu):
    """The impulse that Coulomb's law allows to a touching pair with velocity v without it; None: no slip."""
    if v[0] >= 0 and mu is not None:
        return np.zeros(3)
    if mu is None:
        f = np.linalg.solve(H, -v)
        if f[0] >= 0:
            return f
        return np.append(0., np.linalg.solve(H[1:, 1:], -v[1:]))
    f = np.linalg.solve(H, -v)
    if np.hypot(*f[1:]) <= mu * f[0]:
        return f

    def at(k):  # slip velocity = -k f_t
        f = np.linalg.solve(H + np.diag([0., k, k]), -v)
        return f, np.hypot(*f[1:]) - mu * f[0]

    low, high = 0., np.trace(H)
    while at(high)[1] > 0:
        low, high = high, 4 * high
    for _ in range(200):
        k = (low + high) / 2
        low, high = (k, high) if at(k)[1] > 0 else (low, k)
    return at(high)[0]


class Run:
    """Statics, then shaking. Everything recorded is in self.rows (as Voussoir's tables) and the envelopes."""

    def __init__(self, dam, law, mu=1., free_standing=None):
        """`free_standing`: the dam with its monoliths apart, if each carries its own weight first."""
        self.dam, self.law, self.mu = dam, law, None if law == "FJB" else mu
        self.u = np.zeros(3 * dam.n)
        self.initial = np.zeros((len(dam.points), 6))
        self.load = dam.water()
        if free_standing:
            self.initial = free_standing.stresses(np.linalg.solve(free_standing.K, free_standing.weight()))
        else:
            self.load = self.load + dam.weight()
        self.G = dam.jumps()
        self.force = np.zeros(len(self.G))
        if law == "tied":
            self.u = np.linalg.solve(dam.K, self.load)
        else:
            flexible = np.linalg.solve(dam.K, self.G.T)
            free = np.linalg.solve(dam.K, self.load)
            self.force = coulomb(self.G @ flexible, self.G @ free, np.zeros(len(self.G)), self.mu, self.force)
            self.u = free + flexible @ self.force
        self.strain_0 = .5 * self.u @ dam.K @ self.u
        self.crest, self.arc = dam.crown()
        self.find_crest_pairs()
        n = len(dam.points)
        self.maximum, self.minimum = np.full(n, -np.inf), np.full(n, np.inf)
        self.time_of_maximum, self.time_of_minimum = np.zeros(n), np.zeros(n)
        self.work = dict.fromkeys(("damping", "friction", "impact", "input"), 0.)
        self.history, self.joint_history, self.energy = [], [], []
        self.widest, self.farthest = (0., [0., 0.], None), (0., [0., 0.], None)

    def find_crest_pairs(self):
        d, self.at_crest = self.dam, []
        for joint in sorted({p[0] for p in d.pairs}):
            rows = [k for k, p in enumerate(d.pairs) if p[0] == joint and p[1] in d.on[CREST]]
            self.at_crest.append([next(k for k in rows if d.pairs[k][1] in d.on[s]) for s in (UPSTREAM, DOWNSTREAM)])

    def record(self, t, v, ground):
        d = self.dam
        high, low = principal(d.stresses(self.u) + self.initial)
        for new, best, when, sign in ((high, self.maximum, self.time_of_maximum, 1),
                                      (low, self.minimum, self.time_of_minimum, -1)):
            better = sign * (new - best) > 0
            best[better], when[better] = new[better], t
        self.history.append([t, *d.everywhere(self.u)[self.crest], *ground])
        gaps = (self.G @ self.u).reshape(-1, 3)
        slip = np.hypot(gaps[:, 1], gaps[:, 2])
        for name, values in (("widest", gaps[:, 0]), ("farthest", slip)):
            if len(values) and values.max() > getattr(self, name)[0] * (1 + 1e-9):
                k = int(values.argmax())
                setattr(self, name, (values[k], [t, t], list(d.points[d.pairs[k][1]])))
            elif len(values) and values.max() >= getattr(self, name)[0] * (1 - 1e-9):
                getattr(self, name)[1][1] = t  # a pair that sticks where it has slipped farthest
        self.joint_history.append([t] + [x for up, down in self.at_crest
                                         for x in (gaps[up, 0], gaps[down, 0], slip[up], slip[down])])
        kinetic = .5 * np.sum(np.repeat(d.m, 3) * v * v)
        water = .5 * np.einsum("ia,iab,ib", v.reshape(-1, 3), d.added, v.reshape(-1, 3))
        strain = .5 * self.u @ d.K @ self.u - self.strain_0
        w = self.work
        balance = kinetic + water + strain + w["damping"] + w["friction"] + w["impact"] - w["input"]
        self.energy.append([t, kinetic, strain, water, w["damping"], w["friction"], w["impact"], w["input"], balance])

    def shake(self, motion, dt, n_steps):
        """Base accelerations at the steps, rows x y z."""
        d, G, w = self.dam, self.G, self.work
        blocks = d.m[:, None, None] * np.eye(3) + d.added
        M = scipy.linalg.block_diag(*blocks)
        C = d.A0 * M + d.A1 * d.K
        inverse = np.linalg.inv(blocks)
        inertia = -M @ np.tile(np.eye(3), (d.n, 1))
        factor = scipy.linalg.cho_factor(4 / dt**2 * M + 2 / dt * C + d.K)
        flexible = scipy.linalg.cho_solve(factor, G.T) if len(G) else np.zeros((3 * d.n, 0))
        W = 2. * G @ flexible  # the sum of the forces at both ends is twice their mean
        G_mass = np.linalg.solve(M, G.T) if len(G) else flexible
        v, old_load = np.zeros(3 * d.n), self.load + inertia @ motion[0]
        self.record(0., v, motion[0])
        for step in range(1, n_steps + 1):
            load = self.load + inertia @ motion[step]
            rhs = load + old_load + M @ (4 / dt**2 * self.u + 4 / dt * v) + 2 / dt * C @ self.u - d.K @ self.u
            new = scipy.linalg.cho_solve(factor, rhs)
            if len(G):
                self.force = coulomb(W, G @ new, G @ self.u, self.mu, self.force)
                new = new + 2. * flexible @ self.force
            change = new - self.u
            w["input"] += .5 * (load + old_load) @ change
            w["damping"] += change @ C @ change / dt
            v = 2 / dt * change - v
            self.u, old_load = new, load
            if len(G):
                jump_change = (G @ change).reshape(-1, 3)
                f = self.force.reshape(-1, 3)
                w["friction"] -= np.sum(f[:, 1:] * jump_change[:, 1:])
                w["impact"] -= np.sum(f[:, 0] * jump_change[:, 0])
                before = .5 * v @ M @ v
                v = self.impacts(v, jump_change, dt, inverse, G_mass)
                w["impact"] += before - .5 * v @ M @ v
            self.record(step * dt, v, motion[step])

    def impacts(self, v, jump_change, dt, inverse, G_mass):
        d, kick = self.dam, np.zeros(len(self.G))
        jumps = (self.G @ v).reshape(-1, 3)
        for p, (_, i, j, frame) in enumerate(d.pairs):
            spent = dt * self.force[3 * p:3 * p + 3]
            touching = spent[0] > 0
            if not touching and self.mu is not None:
                continue
            H = sum(frame @ inverse[d.equation[node]] @ frame.T for node in (i, j) if d.equation[node] >= 0)
            jump = jumps[p]
            if not touching:  # no slip, open
                allowed = np.append(0., np.linalg.solve(H[1:, 1:], -(jump - H @ spent)[1:]))
            elif self.slides_on(H, jump, jump_change[p], spent):
                continue
            else:
                allowed = impulse_of_pair(H, jump - H @ spent, self.mu)
            if self.mu is not None:
                more = allowed - spent
                gain = more @ jump + .5 * more @ H @ more
                size = np.abs(more * jump).sum() + np.abs(more * (H @ more)).sum()
                if gain > -spent @ jump_change[p] / dt + 1e-12 * size:
                    allowed = np.append(max(0., spent[0] - jump[0] / H[0, 0]), spent[1:])
            kick[3 * p:3 * p + 3] = allowed - spent
        return v + G_mass @ kick

    second_order = True

    def slides_on(self, H, jump, change, spent):
        """Does the pair slide on with nothing struck? Then the mean force stays, which is of second order."""
        if self.mu is None or not self.second_order or np.hypot(*spent[1:]) < (1 - 1e-9) * self.mu * spent[0]:
            return False
        along = jump @ change >= .5 * np.linalg.norm(jump) * np.linalg.norm(change)
        return along and abs(jump[0]) / H[0, 0] <= 1e-6 * np.linalg.norm(spent)


def damping(ratio, f1, f2):
    """Rayleigh's factors for a damping ratio at two frequencies [Hz]: solves ratio = a0/(2w) + a1 w/2 for both."""
    w = 2 * np.pi * np.array([f1, f2])
    return tuple(np.linalg.solve(np.stack([.5 / w, .5 * w], axis=1), [ratio, ratio]))


def frequencies(dam, count):
    """[Hz]"""
    M = scipy.linalg.block_diag(*(dam.m[:, None, None] * np.eye(3) + dam.added))
    w2 = scipy.linalg.eigh(dam.K, M, eigvals_only=True, subset_by_index=[0, count - 1])
    return np.sqrt(w2) / 2 / np.pi


def rounded(x, digits=7):
    if isinstance(x, dict):
        return {k: rounded(v, digits) for k, v in x.items()}
    if isinstance(x, (list, tuple, np.ndarray)):
        return [rounded(v, digits) for v in x]
    if isinstance(x, (float, np.floating)):
        return float(f"{x:.{digits}g}")
    return int(x) if isinstance(x, np.integer) else x


def results(run, every):
    """What the test compares: rows of the tables, peaks, envelopes on the faces, the last state."""
    d, history, joints = run.dam, np.array(run.history), np.array(run.joint_history)
    out = {"static_crest": run.history[0][1:4], "history": run.history[::every], "energy": run.energy[::every],
           "joint_history": run.joint_history[::every], "joints": []}
    for j in range(len(run.at_crest)):
        mine = joints[:, 1 + 4 * j:5 + 4 * j]
        widest = mine[:, :2].max(axis=1)
        up = d.points[d.pairs[run.at_crest[j][0]][1]]
        out["joints"].append([run.arc[key(up)], *mine.max(axis=0), history[int(widest.argmax()), 0]])
    if d.pairs:
        out["max_opening"], out["max_slip"] = list(run.widest), list(run.farthest)
    for name, surface, values, when, best in (
            ("max_tension_upstream", UPSTREAM, run.maximum, run.time_of_maximum, np.argmax),
            ("max_tension_downstream", DOWNSTREAM, run.maximum, run.time_of_maximum, np.argmax),
            ("max_compression", None, run.minimum, run.time_of_minimum, np.argmin)):
        nodes = sorted(d.on[surface]) if surface else list(range(len(d.points)))
        k = nodes[int(best(values[nodes]))]
        out[name] = [values[k], when[k], list(d.points[k])]
    out["faces"] = {name: [[d.monolith[i], *d.points[i], run.maximum[i], run.minimum[i]] for i in sorted(d.on[s])]
                    for name, s in (("upstream", UPSTREAM), ("downstream", DOWNSTREAM))}
    last = d.stresses(run.u) + run.initial
    out["last"] = [[d.monolith[i], *d.points[i], *d.everywhere(run.u)[i], *last[i]] for i in range(len(d.points))][::3]
    return out


def main():
    import tempfile

    import meshes
    import scenes
    table = {}
    for name, scene in scenes.SCENES.items():
        if len(sys.argv) > 1 and name not in sys.argv[1:]:
            continue
        with tempfile.TemporaryDirectory() as temporary:
            file = scenes.write_mesh(scene, temporary)
            apart, dam = (Dam(file, degree=scene.get("degree", 1), modes=scene.get("modes", False), tied=tied,
                              turn=scenes.turn(scene), damping=damping(*scene["damping"]), level=scene["level"])
                          for tied in (False, scene["law"] == "tied"))
        total = dam.add_westergaard(scene["depth"], scene["factor"]) if "depth" in scene else 0.
        entry = {"added_mass": total, "frequencies": list(frequencies(dam, 4)) if scene["law"] == "tied" else []}
        motion = np.array(scenes.motion(scene))
        run = Run(dam, scene["law"], scene.get("friction"), apart if scene["staged"] else None)
        run.second_order = scene.get("second_order", True)
        run.shake(motion, scene["dt"], len(motion) - 1)
        table[name] = rounded({**entry, **results(run, scene["every"])})
        print(name, "largest opening", table[name].get("max_opening"), "energy", table[name]["energy"][-1], flush=True)
    for name, content in table.items():
        (HERE / f"reference_{name}.json").write_text(json.dumps(content).replace("], [", "],\n["))


if __name__ == "__main__":
    main()
