#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two staggerings of explicit water beside an implicit wall: the critical time step of each, with prototypes of both.

    water_staggering.py [--steps 20000]

Model: a closed box of water, 40 m long, 60 m deep and 10 m wide, in cubes of 5 m (8 nodes, 2 x 2 x 2 points, lumped mass), without damping.
At one end is an elastic wall (25 GPa, 0.2, 2400 kg/m3, 8 nodes, lumped mass, trapezoidal rule), fixed at its base. All other sides are rigid, and
the potential is 0 at the surface. At the start the wall has a random velocity (all modes).

"pressure at whole steps" is the scheme of doc/water.md: the wall's matrix has rho^2 a a^T/M, and the critical step is that of the water alone.
"pressure at half steps": the velocity of the wall at whole steps drives the water, and the pressure at half steps acts on the wall. Its bound is
dt^2/4 < 1/largest eigenvalue of M^-1 (K + rho^2 a^T M_wall^-1 a).
"""

import argparse
import sys

import numpy as np

RHO, SPEED, SIZE = 1000., 1500., 5.  # water: density [kg/m3], speed of sound [m/s], cells [m]
LONG, WIDE, DEEP = 8, 2, 12  # cells
MODULUS, POISSON, CONCRETE = 25e9, 0.2, 2400.
WALLS = ((20., 4), (4., 4), (1., 2), (0.1, 2))  # thickness [m], cells
UNSTABLE = 1e6  # a kinetic energy of the wall of so many times the first one

CORNERS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
POINTS = [0.5 + 0.5 / 3**0.5 * (2 * corner - 1) for corner in CORNERS]


def gradients(point, size):
    """Gradients of the eight shape functions at a point of the unit cell, for a cell with these sides [1/m]."""
    factors = np.where(CORNERS == 1, point, 1 - point)
    signs = 2. * CORNERS - 1
    return np.stack([signs[:, d] * np.delete(factors, d, axis=1).prod(axis=1) / size[d] for d in range(3)], axis=1)


def grid(counts):
    """Numbers of the nodes of each cell of a box, and the index of each node."""
    index = np.array(list(np.ndindex(*(n + 1 for n in counts))))
    number = np.arange(len(index)).reshape([n + 1 for n in counts])
    cells = np.array([[number[tuple(np.add(cell, corner))] for corner in CORNERS] for cell in np.ndindex(*counts)])
    return cells, index


def assemble(cells, n, element):
    """Adds an element matrix for each cell; n unknowns."""
    matrix = np.zeros((n, n))
    for cell in cells:
        matrix[np.ix_(cell, cell)] += element
    return matrix


def lumped(cells, n, mass):
    """Distributes the mass of each cell to its nodes."""
    return np.bincount(cells.ravel(), minlength=n) * mass / 8


class Box:
    """Matrices of water and wall, without the nodes at the surface and at the base of the wall."""

    def __init__(self, thickness, layers):
        volume = SIZE**3
        cells, self.water = grid((LONG, WIDE, DEEP))
        free = self.water[:, 2] < DEEP
        element = RHO * volume / 8 * sum(g @ g.T for g in (gradients(p, [SIZE] * 3) for p in POINTS))
        self.K = assemble(cells, len(free), element)[np.ix_(free, free)]
        self.M = lumped(cells, len(free), RHO / SPEED**2 * volume)[free]
        self.water = self.water[free]
        self.add_wall([thickness / layers, SIZE, SIZE], layers)
        self.add_areas()

    def add_wall(self, size, layers):
        """Stiffness and mass of the wall, and its nodes: the first layer of nodes is wet."""
        cells, self.wall = grid((layers, WIDE, DEEP))
        n, volume = len(self.wall), np.prod(size)
        shear = MODULUS / 2 / (1 + POISSON)
        law = np.diag([2 * shear] * 3 + [shear] * 3)
        law[:3, :3] += MODULUS * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
        element = np.zeros((24, 24))
        for point in POINTS:
            strain = np.zeros((6, 24))
            for k, (x, y, z) in enumerate(gradients(point, size)):
                strain[:, 3 * k:3 * k + 3] = [(x, 0, 0), (0, y, 0), (0, 0, z), (y, x, 0), (0, z, y), (z, 0, x)]
            element += volume / 8 * strain.T @ law @ strain
        unknowns = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 24)
        free = np.repeat(self.wall[:, 2] > 0, 3)
        self.K_wall = assemble(unknowns, 3 * n, element)[np.ix_(free, free)]
        self.M_wall = np.repeat(lumped(cells, n, CONCRETE * volume), 3)[free]
        self.wall = self.wall[self.wall[:, 2] > 0]

    def add_areas(self):
        """Areas of the wet nodes: a.v is the flow of the wall out of the water [m3/s], one row for each node of the water."""
        self.a = np.zeros((len(self.M), len(self.M_wall)))
        number = {tuple(node[1:]): k for k, node in enumerate(self.wall) if node[0] == 0}
        for k, (x, y, z) in enumerate(self.water):
            if x == LONG and (y, z) in number:
                edge = (0.5 if y in (0, WIDE) else 1.) * (0.5 if z == 0 else 1.)
                self.a[k, 3 * number[y, z]] = edge * SIZE**2

    def critical_step(self, with_wall):
        """2/omega of the water alone, or with the term of the wall that bounds the other staggering [s]."""
        K = self.K + (RHO**2 * (self.a / self.M_wall) @ self.a.T if with_wall else 0)
        root = np.sqrt(self.M)
        return 2 / np.linalg.eigvalsh(K / np.outer(root, root))[-1]**0.5

    def run(self, half, dt, n_steps):
        """Number of steps until the kinetic energy of the wall is UNSTABLE times its first value (0: never), and the largest error of the energy
        balance relative to the first energy.

        half: the pressure is at half steps and the potential at whole steps. Else the pressure is at whole steps, the potential at half steps."""
        M, K, a = self.M, self.K, RHO * self.a
        at = np.flatnonzero(a.any(axis=1))  # wet nodes
        a, M_at = a[at], M[at]
        S = np.diag(2 / dt**2 * self.M_wall) + self.K_wall / 2 + (0 if half else (a.T / (2 * M_at)) @ a)
        inverse = np.linalg.inv(S)
        u, v = np.zeros(len(S)), np.random.default_rng(1).standard_normal(len(S))
        pressure, phi = np.zeros(len(M)), np.zeros(len(M))
        first, error, phi_before, K_phi = None, 0., phi, K @ phi
        for step in range(n_steps + 1):
            K_u = self.K_wall @ u
            energy = (v @ (self.M_wall * v) + u @ K_u + pressure @ (M * pressure) + phi_before @ K_phi) / 2
            if half:
                energy += dt / 2 * pressure[at] @ (a @ v)
            size = energy if first is None else v @ (self.M_wall * v) / 2
            first = energy if first is None else first
            error = max(error, abs(energy - first) / first)
            if not size < UNSTABLE * first:
                return step, error
            right, new = 2 / dt * self.M_wall * v - K_u, pressure - dt * K_phi / M
            if half:
                new[at] += dt * (a @ v) / M_at
                du = inverse @ (right - new[at] @ a)
            else:
                du = inverse @ (right - (pressure[at] + new[at]) @ a / 2)
                new[at] += (a @ du) / M_at
            u, v, pressure = u + du, 2 / dt * du - v, new
            phi_before, phi = phi, phi + dt * pressure
            K_phi = K @ phi
        return 0, error


def text(result, n_steps):
    return f"unstable after {result[0]} steps" if result[0] else f"stable, {n_steps} steps, balance {result[1]:.0e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=20000)
    n_steps = parser.parse_args().steps
    print("| wall | critical step [ms] | pressure at whole steps (Voussoir): 0.99 | 1.01 of the critical step "
          "| pressure at half steps: bound [ms] | 0.99 | 1.02 of the bound |\n|" + "---|" * 7)
    as_expected = True
    for thickness, layers in WALLS:
        box = Box(thickness, layers)
        critical, bound = box.critical_step(False), box.critical_step(True)
        cases = (False, 0.99 * critical), (False, 1.01 * critical), (True, 0.99 * bound), (True, 1.02 * bound)
        runs = [box.run(half, dt, n_steps) for half, dt in cases]
        as_expected = as_expected and [run[0] > 0 for run in runs] == [False, True, False, True]
        words = [text(run, n_steps) for run in runs]
        print(f"| {thickness:g} m in {layers} cells | {1e3 * critical:.3f} | {words[0]} | {words[1]} | {1e3 * bound:.3f} | {words[2]} | {words[3]} |",
              flush=True)
    return 0 if as_expected else 1


if __name__ == "__main__":
    sys.exit(main())
