# SPDX-License-Identifier: GPL-3.0-or-later
"""The smallest models of failures that the program itself does not have: an elastic bar on a wall with other contact
rules, and a column on rock whose feet are coupled in other ways. For benchmarks/failures.py."""

import numpy as np

LENGTH, SPEED, APPROACH, FORCE = 10.0, 30.0, 10.0, 300.0  # m, m/s, m/s; exact contact force, rho c A v [N]
CONTACT = 2 * LENGTH / SPEED  # how long the bar stays at the wall [s]
PHASES = (0.1, 0.3, 0.5, 0.7, 0.9)  # of the step, at which the bar strikes


def bar_matrices(elements):
    """Lumped masses [kg] and stiffness [N/m] of a bar with E A = 900 N and rho A = 1 kg/m."""
    h = LENGTH / elements
    mass = np.full(elements + 1, h)
    mass[[0, -1]] /= 2
    k = 900.0 / h
    stiffness = np.diag(np.r_[k, np.full(elements - 1, 2 * k), k]) - k * (np.eye(elements + 1, k=1) +
                                                                          np.eye(elements + 1, k=-1))
    return mass, stiffness


def bar_on_wall(rule, elements=100, courant=1.5, phase=0.5, penalty=None):
    """Trapezoidal Newmark; returns time, contact force, gap, energy over its first value. `rule`:

    none          the gap is closed at the end of the step, nothing else
    velocity      then the velocity of a closed node is set to zero, its acceleration is not
    mean-force    force is the mean over the step, velocities are corrected by an impulse (the program's default)
    penalty       force = stiffness x penetration, stiffness = `penalty` times that of an element, E A/h
    """
    mass, stiffness = bar_matrices(elements)
    dt = courant * LENGTH / elements / SPEED
    inverse = np.linalg.inv(np.diag(4 / dt**2 * mass) + stiffness)
    push, share = inverse[:, 0], 2.0 if rule == "mean-force" else 1.0  # of a force at the foot
    per_force = share * push[0]
    height = 5.0 + phase * APPROACH * dt
    u, v, a = np.zeros(elements + 1), np.full(elements + 1, -APPROACH), np.zeros(elements + 1)
    rows = [(0.0, 0.0, height, 1.0)]
    for step in range(1, round((1 + CONTACT) / dt) + 1):
        load = mass * (4 / dt**2 * u + 4 / dt * v)
        load = load - stiffness @ u if rule == "mean-force" else load + mass * a
        free = inverse @ load
        gap = free[0] + height
        if rule == "penalty":
            k = penalty * 900.0 / (LENGTH / elements)
            force = max(0.0, -k * gap / (1 + k * per_force))
        else:
            force = max(0.0, -gap / per_force)
        new = free + share * push * force
        a = 4 / dt**2 * (new - u) - 4 / dt * v - a
        v = 2 / dt * (new - u) - v
        u = new
        if force > 0 and rule == "velocity":
            v[0] = 0.0
        if force > 0 and rule == "mean-force":
            without = v[0] - dt * force / mass[0]
            v[0] = max(without, 0.0)
        energy = 0.5 * mass @ v**2 + 0.5 * u @ stiffness @ u
        if rule == "penalty":
            energy += 0.5 * k * min(0.0, u[0] + height) ** 2
        rows.append((step * dt, force, u[0] + height, energy / (0.5 * LENGTH * APPROACH**2)))
    return np.array(rows).T


def bar_errors(time, force, gap, energy, phase, elements=100, courant=1.5, mean=False):
    """L1 error of the force, its rms error in the middle of the contact, largest force (all over the exact ones),
    change of energy, deepest penetration [m]. `mean`: forces are means over the step."""
    dt = courant * LENGTH / elements / SPEED
    since = time - (5.0 + phase * APPROACH * dt) / APPROACH
    if mean:
        exact = np.clip(np.minimum(since, CONTACT) - np.maximum(since - dt, 0), 0, None) / dt
    else:
        exact = ((since > 0) & (since < CONTACT)).astype(float)
    middle = (since > 0.1 * CONTACT) & (since < 0.9 * CONTACT)
    error = force / FORCE - exact
    return np.array([np.abs(error).sum() / exact.sum(), np.sqrt(np.mean(error[middle] ** 2)), force.max() / FORCE,
                     energy[-1] - 1, -gap.min()])


class ColumnOnRock:
    """A column of 20 elements of 10 m on 80 cells of rock of 10 m before a dashpot: a chain of springs, per area.

    The column is implicit with the step T = m h, the rock explicit with h, as the program does it (doc/rock.md, element
    partition): the foot goes evenly from one predicted place to the next, and the column feels the rock's force at the
    end. `heavier`: the foot carries the mass k T^2/2. No damping but the dashpot. `step`: h over cell/speed."""

    def __init__(self, m, heavier, step=0.9, n_column=20, n_rock=80, cell=10.0):
        density, speed_column, speed_rock = 2400.0, 2960.0, 2580.0
        h = step * cell / speed_rock
        self.m, self.h, self.T = m, h, m * h
        self.k = density * speed_rock**2 / cell  # per area
        self.mass = np.full(n_column + 1, density * cell)  # foot first
        self.mass[-1] /= 2  # at the foot: half a column's element, half a rock's
        if heavier and m > 1:
            self.mass[0] += self.k * self.T**2 / 2
        k = density * speed_column**2 / cell
        K = 2 * k * np.eye(n_column + 1) - k * np.eye(n_column + 1, k=1) - k * np.eye(n_column + 1, k=-1)
        K[0, 0] = K[-1, -1] = k
        self.K = K
        self.inverse = np.linalg.inv(np.diag(4 / self.T**2 * self.mass) + K)
        self.rock_mass = np.full(n_rock, density * cell)
        self.rock_mass[-1] /= 2
        self.decay = np.zeros((n_rock, 1))  # of the dashpot in half a sub-step
        self.decay[-1] = density * speed_rock * h / 2 / self.rock_mass[-1]
        self.sizes = [n_column + 1] * 3 + [1] + [n_rock] * 2

    def step(self, state, load=0.0):
        """One step of the column, `load` at its top; of many states side by side, one a column."""
        u, v, a, before, x, w = np.split(state, np.cumsum(self.sizes)[:-1])
        T, h, k = self.T, self.h, self.k
        predicted = u[:1] + T * v[:1] + T**2 / 4 * a[:1]
        for j in range(1, self.m + 1):
            foot = before + (j - 1) / self.m * (predicted - before)  # with x at the beginning of the sub-step
            all_x = np.vstack([foot, x])
            force = -k * np.diff(all_x, axis=0)
            force[:-1] += k * np.diff(all_x, axis=0)[1:]
            w = (w * (1 - self.decay) + h * force / self.rock_mass[:, None]) / (1 + self.decay)
            x = x + h * w
        forces = np.zeros_like(u)
        forces[-1] = load
        forces[:1] += k * (x[:1] - predicted)
        new = self.inverse @ (forces + self.mass[:, None] * (4 / T**2 * u + 4 / T * v + a))
        a = 4 / T**2 * (new - u) - 4 / T * v - a
        v = 2 / T * (new - u) - v
        return np.vstack([new, v, a, predicted, x, w])

    def largest_eigenvalue(self):
        """Of the matrix of one step: above 1 a run grows by this factor in every step."""
        return np.abs(np.linalg.eigvals(self.step(np.eye(sum(self.sizes))))).max()

    def crest(self, duration, pulse=0.4):
        """Time, displacement of the top under a smooth pulse of 1 MPa there."""
        state = np.zeros((sum(self.sizes), 1))
        top = self.sizes[0] - 1
        rows = [(0.0, 0.0)]
        for i in range(1, int(duration / self.T) + 1):
            t = i * self.T
            state = self.step(state, 1e6 * np.sin(np.pi * t / pulse) ** 2 if t < pulse else 0.0)
            rows.append((t, state[top, 0]))
            if abs(state[top, 0]) > 1e3:
                break
        return np.array(rows).T
