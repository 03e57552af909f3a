# SPDX-License-Identifier: GPL-3.0-or-later
"""The linear part of dam_reference.py: elements, masses, loads, stresses and pairs of a small dam, with dense matrices."""

import itertools
from pathlib import Path

import numpy as np
import scipy.sparse

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
