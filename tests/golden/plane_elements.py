# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane strain with quadrilaterals of 4 or 9 nodes, in dense matrices: a reference for slices of one element.

Units SI, thickness 1 m. Gauss points: degree + 1 in each direction. Mass: row sums. Geometry: bilinear.
"""

import numpy as np


def lagrange(x, degree):
    """Values and derivatives of the shape functions on the nodes -1, 1 or -1, 0, 1, at x."""
    if degree == 1:
        return np.array([(1 - x) / 2, (1 + x) / 2]), np.array([-.5, .5])
    return np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - .5, -2 * x, x + .5])


def shape(x, y, degree):
    """Values (n) and derivatives (n, 2) of the shape functions, by rows of x."""
    (fx, dx), (fy, dy) = lagrange(x, degree), lagrange(y, degree)
    return np.outer(fy, fx).ravel(), np.stack([np.outer(fy, dx).ravel(), np.outer(dy, fx).ravel()], axis=1)


def all_nodes(corners, cells, degree):
    """Coordinates (n, 2) [m] of the nodes of all cells, and their numbers (cells, (degree + 1)^2)."""
    number, points, table = {}, [], []
    side = np.linspace(-1, 1, degree + 1)
    for cell in cells:
        place = np.array([corners[v] for v in (cell[0], cell[1], cell[3], cell[2])])
        row = []
        for eta in side:
            for xi in side:
                p = shape(xi, eta, 1)[0] @ place
                key = tuple(np.round(p, 6))
                if key not in number:
                    number[key] = len(points)
                    points.append(p)
                row.append(number[key])
        table.append(row)
    return np.array(points), np.array(table)


def assemble(points, table, degree, young, poisson, density):
    """Stiffness (2n, 2n) [N/m] and lumped mass (2n) [kg] of a slice of 1 m."""
    n = len(points)
    stiffness, mass = np.zeros((2 * n, 2 * n)), np.zeros(2 * n)
    elasticity = young / ((1 + poisson) * (1 - 2 * poisson)) * np.array(
        [[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, .5 - poisson]])
    gauss, weights = np.polynomial.legendre.leggauss(degree + 1)
    corner = [0, degree, degree * (degree + 1), degree * (degree + 2)]
    for nodes in table:
        place, of_cell = points[nodes[corner]], np.zeros((2 * len(nodes), 2 * len(nodes)))
        for xi, wx in zip(gauss, weights):
            for eta, wy in zip(gauss, weights):
                jacobian = shape(xi, eta, 1)[1].T @ place
                volume = wx * wy * np.linalg.det(jacobian)
                value, slope = shape(xi, eta, degree)
                slope = slope @ np.linalg.inv(jacobian).T
                strain = np.zeros((3, 2 * len(nodes)))
                strain[0, 0::2] = strain[2, 1::2] = slope[:, 0]
                strain[1, 1::2] = strain[2, 0::2] = slope[:, 1]
                of_cell += volume * strain.T @ elasticity @ strain
                for c in (0, 1):
                    mass[2 * nodes + c] += density * volume * value
        unknowns = np.stack([2 * nodes, 2 * nodes + 1], axis=1).ravel()
        stiffness[np.ix_(unknowns, unknowns)] += of_cell
    return stiffness, mass


def frequencies(corners, cells, degree, young, poisson, density, count):
    """The lowest natural frequencies [Hz] of a section fixed at z = 0."""
    points, table = all_nodes(corners, cells, degree)
    stiffness, mass = assemble(points, table, degree, young, poisson, density)
    free = np.repeat(points[:, 1] > 1e-6, 2)
    root = 1 / np.sqrt(mass[free])
    return np.sqrt(np.linalg.eigvalsh(stiffness[np.ix_(free, free)] * np.outer(root, root))[:count]) / (2 * np.pi)
