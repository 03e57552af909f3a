#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does a time step that damps high frequencies (generalised-alpha) mend the order of the implicit scheme?

    benchmarks/damped_step.py [--motions 3] [--voussoir PROGRAM]

The dam of damping_dense.py with a mass-proportional damping only (5 % in the first mode), so that no damping removes high
frequencies. Generalised-alpha method (Chung and Hulbert 1993) with the spectral radius r at infinite frequency; r = 1 is the
trapezoidal rule. The joint impulse acts in the middle of a step, and a velocity correction stops closed joints, as in
doc/method.md. Each number is the median over the motions of the error of the largest openings of all pairs (2-norm, % of that of
the reference), against the leapfrog rule at 0.0625 ms, for time steps of 10, 5, 2.5, 1.25 and 0.625 ms."""

import argparse
import math
import sys
import tempfile
from statistics import median

import numpy as np

from damping_dense import DAM, SAMPLE, Dam
from program import ROOT, add_program_argument, frequencies, run, simulate

STEPS, RADII, SECONDS = (.01, .005, .0025, .00125, .000625), (1., .9, .7, .5, 0.), 5.12


class Joints:
    """Rows of the jumps of the pairs: first all normals, then two tangents of each."""
    def __init__(self, dam):
        n, self.n_pairs = len(dam.mass), len(dam.normal)
        axes = np.array([np.linalg.svd(normal[None])[2] for normal in dam.normal])
        axes[:, 0] = dam.normal
        self.G = np.zeros((3 * self.n_pairs, n))
        for c in range(3):
            for p in range(self.n_pairs):
                row = self.G[p if c == 0 else self.n_pairs + 2 * p + c - 1]
                row[dam.sides[1][p]], row[dam.sides[0][p]] = axes[p, c], -axes[p, c]
        self.by_impulse = np.einsum("ij,ij->i", self.G, self.G / dam.mass)

    def solve(self, W, gap, closed):
        """Impulses that tie all tangents and keep the normals from closing: gap + W x >= 0. Active sets from the last one."""
        tied = np.ones(2 * self.n_pairs, bool)
        for _ in range(60):
            rows = np.append(closed, tied)
            x = np.zeros(len(gap))
            x[rows] = np.linalg.solve(W[np.ix_(rows, rows)], -gap[rows])
            end = (gap + W @ x)[:self.n_pairs]
            new = np.where(closed, x[:self.n_pairs] > 0, end < 0)
            if (new == closed).all():
                return x, closed
            closed = new
        raise SystemExit("The contact problem was not solved.")


def leapfrog(dam, joints, acceleration, alpha, h):
    """Largest opening of each pair [m]."""
    u, v, most = dam.static(), np.zeros(len(dam.mass)), np.zeros(joints.n_pairs)
    n = round(SAMPLE / h)
    for before, after in zip(acceleration, acceleration[1:]):
        for k in range(n):
            ground = np.tile(before + (after - before) * k / n, len(u) // 3)
            v = ((1 - alpha * h / 2) * v + h * ((dam.load - dam.K @ u) / dam.mass - ground)) / (1 + alpha * h / 2)
            x = -joints.G @ (u / h + v) / joints.by_impulse  # nodes belong to one pair
            x[:joints.n_pairs] = x[:joints.n_pairs].clip(0)
            v += joints.G.T @ x / dam.mass
            u = u + h * v
        most = np.maximum(most, (joints.G[:joints.n_pairs] @ u))
    return most


def generalised_alpha(dam, joints, acceleration, alpha, dt, radius):
    """Largest opening of each pair [m]."""
    am, af = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    beta, gamma, n = (1 - am + af)**2 / 4, .5 - am + af, round(SAMPLE / dt)
    of_mass = (1 - am) / (beta * dt**2) + alpha * (1 - af) * gamma / (beta * dt)
    inverse = np.linalg.inv(np.diag(of_mass * dam.mass) + (1 - af) * dam.K)
    of_impulse = (1 - am) / (2 * beta * dt) + alpha * (1 - af) * (gamma / (2 * beta) - 1)
    response = inverse @ joints.G.T * of_impulse
    W = joints.G @ response
    u, v, most = dam.static(), np.zeros(len(dam.mass)), np.zeros(joints.n_pairs)
    a, closed = np.zeros(len(u)), np.ones(joints.n_pairs, bool)
    a = -np.tile(acceleration[0], len(u) // 3)
    for before, after in zip(acceleration, acceleration[1:]):
        for k in range(n):
            ground = np.tile(before + (after - before) * (k + 1 - af) / n, len(u) // 3)
            ahead, v_ahead = u + dt * v + dt**2 * (.5 - beta) * a, v + dt * (1 - gamma) * a
            force = dam.load - af * (dam.K @ u) + dam.mass * (of_mass * ahead - ground - am * a - alpha * (af * v + (1 - af) * v_ahead))
            free = inverse @ force
            x, closed = joints.solve(W, joints.G @ free, closed)
            u = free + response @ x
            push = joints.G.T @ x / dam.mass
            a = (u - ahead - dt / 2 * push) / (beta * dt**2)
            v = v_ahead + gamma * dt * a + push
            stop = -joints.G @ v / joints.by_impulse
            stop[:joints.n_pairs] = np.where(closed, np.maximum(stop[:joints.n_pairs], -x[:joints.n_pairs]), 0.)
            v += joints.G.T @ stop / dam.mass
        most = np.maximum(most, joints.G[:joints.n_pairs] @ u)
    return most


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motions", type=int, default=3)
    add_program_argument(parser)
    options = parser.parse_args()
    scene, errors = ROOT / "prm" / "coarse.prm", {}
    alpha = 2 * .05 * 2 * math.pi * frequencies(options.voussoir, scene, 1, DAM)[0][0]
    with tempfile.TemporaryDirectory() as place:
        run(options.voussoir, "mesh", scene, "--output", f"{place}/dam.msh", "--format", "2.2", settings=DAM)
        dam = Dam(f"{place}/dam.msh")
        joints = Joints(dam)
        for seed in range(1, options.motions + 1):
            simulate(options.voussoir, scene, {**DAM, "Dynamics/Steps per sample": 1, "Motion/Seed": seed}, f"{place}/{seed}")
            history = np.genfromtxt(f"{place}/{seed}/history.csv", delimiter=",", names=True)
            acceleration = np.array([history[f"base_acceleration_{c}"] for c in "xyz"]).T[:round(SECONDS / SAMPLE)]
            exact = leapfrog(dam, joints, acceleration, alpha, .0000625)
            for radius in RADII:
                for dt in STEPS:
                    found = generalised_alpha(dam, joints, acceleration, alpha, dt, radius)
                    errors.setdefault((radius, dt), []).append(100 * np.linalg.norm(found - exact) / np.linalg.norm(exact))
            print(f"seed {seed}: largest opening {1e3 * exact.max():.2f} mm", file=sys.stderr, flush=True)
    print("| r |", " | ".join(f"{1e3 * dt:g} ms" for dt in STEPS), "|\n|---|" + "---|" * len(STEPS))
    for radius in RADII:
        print(f"| {radius:g} |", " | ".join(f"{median(errors[radius, dt]):.2f}" for dt in STEPS), "|")


if __name__ == "__main__":
    main()
