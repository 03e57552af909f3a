#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes rock.json: a block on a column of rock, exactly. Voussoir has no part in it.

Vertical motion of a prism of Poisson's ratio 0 is one-dimensional. With rho (u'' + a u') = E u_zz the rock gives its top the
force i k E A (2 U - u), k = w/c sqrt(1 - i a/w), U = u_outcrop/2 exp(-i k D) the rising wave there: for a = 0 the classical
rho c A (v_outcrop - v). Of the rock's mass the half cell at the foot counts as the block's (doc/method.md): its damping is
relative to the foot, that is nothing, and is taken off. With damping the times end before what the boundary throws back arrives. The block is the chain of its cells, masses lumped, with Rayleigh damping relative to its foot
(mass; the frame that moves with the foot carries it, not the rock) and of its strains (stiffness). Solved by Fourier transform; energies are integrals over time."""

import json
from pathlib import Path

import numpy as np

import scenes

HERE = Path(__file__).resolve().parent


def solve(alpha):
    r, n = scenes.ROCK, 1 << 14
    dt, A, h = r["dt"], (r["cell"] * r["columns"])**2, r["cell"]
    t = dt * np.arange(n)
    w = 2 * np.pi * np.fft.rfftfreq(n, dt)
    w[0] = 1e-9
    out = np.fft.rfft([scenes.outcrop(x)[0] for x in t])
    c = np.sqrt(r["E"] / r["rho"])
    depth = (r["layers"] + 1) * h  # the wave enters a cell below the rock's foot
    wait = depth * (np.sqrt(2) - 1) / c  # until S waves, of speed c/sqrt(2), can be at the foot together with it
    k = w / c * np.sqrt(1 - 1j * alpha / w)
    U = out / 2 * np.exp(-1j * (k * depth + w * wait))
    f1, f2 = 2 * np.pi * np.array(r["frequencies"])
    a0, a1 = np.linalg.solve([[.5 / f1, .5 * f1], [.5 / f2, .5 * f2]], 2 * [r["ratio"]])
    N = r["dam_cells"]
    K = np.zeros((N + 1, N + 1))
    for i in range(N):
        K[i:i + 2, i:i + 2] += r["dam_E"] * A / h * np.array([[1, -1], [-1, 1]])
    m = np.full(N + 1, r["dam_rho"] * A * h)
    m[[0, -1]] /= 2
    C = a1 * K + a0 * (np.diag(m) - np.outer(m, np.eye(N + 1)[0]))  # relative to the foot
    u = np.zeros((N + 1, len(w)), complex)
    for i, x in enumerate(w):
        D = K + 1j * x * C - x * x * np.diag(m)
        force = np.zeros(N + 1, complex)
        D[0, 0] += 1j * k[i] * r["E"] * A - 1j * x * alpha * r["rho"] * A * h / 2
        force[0] = 2j * k[i] * r["E"] * A * U[i]
        u[:, i] = np.linalg.solve(D, force)
    half_cell = r["rho"] * A * h / 2 * (1j * w * alpha - w * w)  # it is the block's: what the elements give is more
    force = np.fft.irfft(1j * k * r["E"] * A * (2 * U - u[0]) + half_cell * u[0], n)
    velocity = np.fft.irfft(1j * w * u, n)
    u = np.fft.irfft(u, n)
    relative = velocity - velocity[0]
    lost = a0 * m @ relative**2 + a1 * np.einsum("it,ij,jt->t", velocity, K, velocity)
    work = force * velocity[0]  # of the rock on the foot
    damping, work = (np.concatenate([[0.], np.cumsum(x[1:] + x[:-1]) * dt / 2]) for x in (lost, work))
    work[1:] = (work[1:] + work[:-1]) / 2  # the rock's account is half a step earlier
    kinetic = .5 * m @ velocity**2
    strain = .5 * np.einsum("it,ij,jt->t", u, K, u)
    rows = np.stack([t, u[0], u[-1] - u[0], kinetic, strain, damping, work], axis=1)[:r["steps"] + 1:r["every"]]
    return [row for row in rows.tolist() if alpha == 0 or row[0] < r["clean"]]


def main():
    table = {str(alpha): solve(alpha) for alpha in scenes.ROCK["mass_damping"]}
    text = json.dumps({k: [[float(f"{x:.6g}") for x in row] for row in rows] for k, rows in table.items()})
    (HERE / "rock.json").write_text(text.replace("], [", "],\n["))


if __name__ == "__main__":
    main()
