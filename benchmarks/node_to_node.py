#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A second, independent program for the jointed arch of peers.py, with joints that slide (FJA) or do not (FJB).

    benchmarks/node_to_node.py [--data DIRECTORY] [--law fja|fjb] [--dt 0.01] [--mass consistent|lumped]
                               [--impact none|mean-force]

Dense matrices on a few pages: plain trilinear elements, trapezoidal Newmark, an active set (FJB) or Newton's method on
Alart and Curnier's equations (FJA, friction 1). "none" takes the joints' forces at the end of each step; "mean-force"
as means over it, and then the velocities that the law of impulses leaves. It shows what the reference of peers.py owes
to its consistent mass and to its impact rule.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import scipy.linalg
import scipy.optimize

import calculix
from program import ROOT

YOUNG, POISSON, DENSITY, A0, A1 = 21e9, 0.17, 2400., 0.785, 0.00177
FRICTION = 1.
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                  (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], dtype=float)


def element(corners):
    """Stiffness (24,24) and consistent mass (8,8) of a trilinear hexahedron."""
    mu, lam = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
    D = np.diag([2 * mu] * 3 + [mu] * 3)
    D[:3, :3] += lam
    K, M = np.zeros((24, 24)), np.zeros((8, 8))
    for point in SIGNS / np.sqrt(3):
        factors = 1 + SIGNS * point
        shape = factors.prod(axis=1) / 8
        slope = np.stack([SIGNS[:, k] * np.delete(factors, k, axis=1).prod(axis=1) / 8 for k in range(3)], axis=1)
        jacobian = corners.T @ slope
        volume = np.linalg.det(jacobian)
        g = slope @ np.linalg.inv(jacobian)
        B = np.zeros((6, 24))
        for k, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]):
            B[k, i::3] += g[:, j]
            if i != j:
                B[k, j::3] += g[:, i]
        K += volume * B.T @ D @ B
        M += volume * DENSITY * np.outer(shape, shape)
    return K, M


def read_doubled(path):
    """The mesh, and pairs of coincident nodes with the joint's normal: (joint, node 1, node 2, normal)."""
    raw, elements = calculix.read_nodes_and_elements_2(calculix.read_sections(path))
    index = {tag: i for i, tag in enumerate(raw)}
    nodes = np.array(list(raw.values()), dtype=float)
    quads = {}
    for kind, physical, tags in elements:
        if kind == calculix.QUADRILATERAL:
            quads.setdefault(physical, []).append([index[tag] for tag in tags])
    hexahedra = np.array([[index[t] for t in tags] for kind, _, tags in elements if kind == calculix.HEXAHEDRON])
    p = nodes[hexahedra]
    volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 3] - p[:, 0]), p[:, 4] - p[:, 0])
    hexahedra[volume < 0] = hexahedra[volume < 0][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    mesh = calculix.Mesh(nodes, hexahedra, {name: np.array(quads[n]) for name, n in calculix.SURFACES.items()})
    pairs = []
    for joint in range(1, 100):
        if 100 + joint not in quads:
            break
        side_1, side_2 = (np.unique(quads[base + joint]) for base in (100, 200))
        normal = {i: np.zeros(3) for i in side_1}
        for quad in quads[100 + joint]:
            x = nodes[quad]
            for i in quad:
                normal[i] += np.cross(x[2] - x[0], x[3] - x[1])
        beyond = hexahedra[np.isin(hexahedra, side_2).any(axis=1)]
        towards = nodes[beyond].mean(axis=(0, 1)) - nodes[side_1].mean(axis=0)
        for i in side_1:
            n = normal[i] / np.linalg.norm(normal[i])
            pairs.append((joint, i, side_2[np.argmin(np.linalg.norm(nodes[side_2] - nodes[i], axis=1))],
                          n * np.sign(n @ towards)))
    return mesh, pairs


def no_slip(W, gap, force):
    """Forces f with gap + W f = 0 tangentially; normally (every third row) gap >= 0, f >= 0, and one of them zero."""
    tied = np.arange(len(gap)) % 3 != 0
    active = tied | (force > 0)
    scale = 1 / np.diag(W)
    for _ in range(100):
        force = np.zeros(len(gap))
        force[active] = np.linalg.solve(W[np.ix_(active, active)], -gap[active])
        previous, active = active, tied | (force - scale * (gap + W @ force) > 0)
        if (active == previous).all():
            return force
    raise RuntimeError("the active set does not settle")


def project(x):
    """The point with the normal force max(0, x_n) and the friction nearest to x_t, and its derivative, (pair, 3[, 3])."""
    closed, size = x[:, 0] > 0, np.hypot(x[:, 1], x[:, 2])
    radius = FRICTION * np.maximum(0, x[:, 0])
    slides = closed & (size > radius)
    shrink = np.where(slides, radius / np.maximum(size, 1e-300), closed)
    along = x[:, 1:] / np.maximum(size, 1e-300)[:, None] * slides[:, None]
    point = np.column_stack([np.maximum(0, x[:, 0]), shrink[:, None] * x[:, 1:]])
    slope = np.zeros((len(x), 3, 3))
    slope[:, 0, 0] = closed
    slope[:, 1:, 0] = FRICTION * along
    slope[:, 1:, 1:] = shrink[:, None, None] * (np.eye(2) - along[:, :, None] * along[:, None, :])
    return point, slope


def coulomb(W, gap, force):
    """Forces f with gap + W f: normally f >= 0, gap >= 0, and one of them zero; friction at most FRICTION f_n, against
    the tangential gap (the slip of the step). Damped Newton, with Gauss-Seidel sweeps where it stalls."""
    n, identity = len(gap) // 3, np.eye(3)
    diagonal = W.reshape(n, 3, n, 3)[np.arange(n), :, np.arange(n)]
    rho = 1 / np.linalg.eigvalsh(diagonal)[:, -1]

    def residual(f):
        point, slope = project((f - np.repeat(rho, 3) * (gap + W @ f)).reshape(-1, 3))
        return f - point.ravel(), slope

    f, scale = force.copy(), max(np.abs(gap * np.repeat(rho, 3)).max(), np.abs(force).max())
    for _ in range(200):
        for _ in range(40):
            r, slope = residual(f)
            if np.abs(r).max() <= 1e-12 * scale:
                return f
            J = np.einsum("pij,pjk->pik", rho[:, None, None] * slope, W.reshape(n, 3, 3 * n)).reshape(3 * n, 3 * n)
            J.reshape(n, 3, n, 3)[np.arange(n), :, np.arange(n)] += identity - slope
            step, length = np.linalg.solve(J, -r), 1.
            while length > 1e-3 and (np.linalg.norm(residual(f + length * step)[0])
                                     > (1 - 1e-4 * length) * np.linalg.norm(r)):
                length /= 2
            if length <= 1e-3:
                break
            f = f + length * step
        for pair in np.tile(np.arange(n), 5):
            k = slice(3 * pair, 3 * pair + 3)
            for _ in range(20):
                f[k] = project((f[k] - rho[pair] * (gap[k] + W[k] @ f))[None])[0][0]
    raise RuntimeError("the joints do not converge")


def allowed_impulse(H, v):
    """The impulse that Coulomb's law allows to a closed pair that has the velocity v without it. H: 3x3."""
    if v[0] >= 0:
        return np.zeros(3)

    def at(k):  # the velocity of slip is -k times the tangential impulse
        f = np.linalg.solve(H + np.diag([0, k, k]), -v)
        return f, np.hypot(*f[1:]) - FRICTION * f[0]

    if at(0.)[1] <= 0:
        return at(0.)[0]
    high = np.trace(H)
    while at(high)[1] > 0:
        high *= 4
    return at(scipy.optimize.brentq(lambda k: at(k)[1], 0., high, xtol=1e-300, rtol=1e-15))[0]


def impulses(H, spent, jump, change, dt):
    """What has to be added to the impulse `spent` of each pair, by the rule of doc/method.md. Rows of pairs: the
    velocity `jump` at the end of the step and the displacement `change` in it."""
    more = np.zeros_like(spent)
    for p in np.flatnonzero(spent[:, 0] > 0):
        slides = np.hypot(*spent[p, 1:]) >= (1 - 1e-9) * FRICTION * spent[p, 0]
        struck = abs(jump[p, 0]) / H[p, 0, 0] > 1e-6 * np.linalg.norm(spent[p])
        if slides and not struck and jump[p] @ change[p] >= .5 * np.linalg.norm(jump[p]) * np.linalg.norm(change[p]):
            continue  # slides on: the mean friction of the step stays
        more[p] = allowed_impulse(H[p], jump[p] - H[p] @ spent[p]) - spent[p]
        gain = more[p] @ jump[p] + .5 * more[p] @ H[p] @ more[p]
        if gain > -spent[p] @ change[p] / dt + 1e-12 * np.abs(more[p]) @ (np.abs(jump[p]) + np.abs(H[p] @ more[p])):
            more[p] = [max(-spent[p, 0], -jump[p, 0] / H[p, 0, 0]), 0, 0]
    return more


def simulate(data, law, dt, mass, impact):
    """Static displacement of the crown's crest, downstream and up, and the largest openings and slips of the joints at
    the crest, upstream and downstream, all in mm."""
    mesh, pairs = read_doubled(data / "s1k.v22.msh")
    n = len(mesh.nodes)
    K, m = np.zeros((3 * n, 3 * n)), np.zeros((n, n))
    for cell in mesh.hexahedra:
        dofs = (3 * cell[:, None] + np.arange(3)).ravel()
        k_cell, m_cell = element(mesh.nodes[cell])
        K[np.ix_(dofs, dofs)] += k_cell
        m[np.ix_(cell, cell)] += m_cell
    if mass == "lumped":
        m = np.diag(m.sum(axis=1))
    M = np.kron(m, np.eye(3))
    free = np.setdiff1d(np.arange(n), mesh.surface_nodes("base"))
    fixed = np.isin(np.arange(n), mesh.surface_nodes("base"))
    pairs = [p for p in pairs if not fixed[p[1]]]
    keep = (3 * free[:, None] + np.arange(3)).ravel()
    B = np.zeros((3 * len(pairs), 3 * n))
    for row, (_, i, j, normal) in enumerate(pairs):
        axes = np.linalg.svd(normal[None])[2]
        axes[0] = normal
        B[3 * row:3 * row + 3, 3 * i:3 * i + 3] = -axes
        B[3 * row:3 * row + 3, 3 * j:3 * j + 3] = axes
    B = B[:, keep]
    load = calculix.water_forces(mesh, 195., 1000., 9.81, 8).ravel() - 9.81 * M @ np.tile([0, 0, 1.], n)
    influence = (M @ np.tile(np.eye(3), (n, 1)))[keep]
    load, K, M = load[keep], K[np.ix_(keep, keep)], M[np.ix_(keep, keep)]
    C = A0 * M + A1 * K
    crest_pairs = [[r for r, p in enumerate(pairs) if p[0] == j and p[1] in mesh.surface_nodes("crest")]
                   for j in range(1, 6)]
    top = np.array([end(rows, key=lambda r: mesh.nodes[pairs[r][1], 1])  # y is downstream
                    for end in (min, max) for rows in crest_pairs])

    def flexibility(A):
        factor = scipy.linalg.cho_factor(A)
        G = scipy.linalg.cho_solve(factor, B.T)
        return factor, G, B @ G

    static, G, W = flexibility(K)
    u = scipy.linalg.cho_solve(static, load)
    contact = coulomb if law == "fja" else no_slip
    force = contact(W, B @ u, np.zeros(len(B)))
    u += G @ force
    probe = np.flatnonzero(keep == 3 * calculix.crown_crest(mesh, "upstream", 1))[0]
    crest = 1e3 * u[probe + 1:probe + 3]

    factor, G, W = flexibility(4 / dt**2 * M + 2 / dt * C + K)
    inverse_mass = scipy.linalg.cho_factor(M)
    G_mass = scipy.linalg.cho_solve(inverse_mass, B.T)
    motion = np.loadtxt(data / "motion.txt")
    times = np.arange(1, round(2 / dt) + 1) * dt
    v, a = np.zeros_like(u), np.zeros_like(u)
    widest, farthest, f_old = np.zeros(len(top)), np.zeros(len(top)), load
    n_pairs, at = len(pairs), np.arange(len(pairs))
    H = (B @ G_mass).reshape(n_pairs, 3, n_pairs, 3)[at, :, at]  # of each pair alone: for lumped masses
    normal = np.arange(len(B)) % 3 == 0
    for t in times:
        ground = np.array([np.interp(t, motion[:, 0], motion[:, k]) for k in (1, 2, 3)])
        f_new = load - influence @ ground
        if impact == "none":
            rhs = f_new + M @ (4 / dt**2 * u + 4 / dt * v + a) + C @ (2 / dt * u + v)
        else:  # trapezoidal rule in momentum; the joints' force is constant over the step
            rhs = (f_old + f_new) + M @ (4 / dt**2 * u + 4 / dt * v) + C @ (2 / dt * u) - K @ u
        predicted = scipy.linalg.cho_solve(factor, rhs)
        before = np.zeros(len(B)) if law == "fjb" else np.where(normal, 0, B @ u)  # slip is that of the step
        force = contact(W, B @ predicted - before, force)
        new = predicted + G @ force
        if impact == "none":
            a_new = 4 / dt**2 * (new - u) - 4 / dt * v - a
            u, v, a = new, v + dt / 2 * (a + a_new), a_new
        elif law == "fja":
            change, u, v = B @ (new - u), new, 2 / dt * (new - u) - v
            spent, jump = dt / 2 * force.reshape(-1, 3), (B @ v).reshape(-1, 3)
            v += G_mass @ impulses(H, spent, jump, change.reshape(-1, 3), dt).ravel()
        else:
            u, v = new, 2 / dt * (new - u) - v
            jump, closed = B @ v, force != 0
            # Newton's impact law of a closed pair: no relative velocity, whatever the mean force left of it.
            v += G_mass[:, closed] @ np.linalg.solve((B @ G_mass)[np.ix_(closed, closed)], -jump[closed])
        f_old = f_new
        gaps = (B @ u).reshape(-1, 3)[top]
        widest, farthest = np.maximum(widest, gaps[:, 0]), np.maximum(farthest, np.hypot(gaps[:, 1], gaps[:, 2]))
    return crest, 1e3 * widest.reshape(2, 5), 1e3 * farthest.reshape(2, 5)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/reference/data/peers", help="reference data")
    parser.add_argument("--law", default="fjb", choices=["fja", "fjb"])
    parser.add_argument("--dt", type=float, default=0.01)
    parser.add_argument("--mass", default="consistent", choices=["consistent", "lumped"])
    parser.add_argument("--impact", default="none", choices=["none", "mean-force"])
    o = parser.parse_args()
    if not (o.data / "motion.txt").exists():
        print(f"SKIPPED: no reference data in {o.data} (option --data)")
        return 77
    if o.law == "fja" and (o.mass, o.impact) == ("consistent", "mean-force"):
        parser.error("the law of impulses is pair by pair here, which needs --mass lumped")
    crest, openings, slips = simulate(o.data, o.law, o.dt, o.mass, o.impact)
    print(f"static crest {crest[0]:.2f} mm downstream, {crest[1]:.2f} mm up")
    print(f"{o.law}, {o.mass} mass, impact {o.impact}, dt {1e3 * o.dt:g} ms: largest openings, slips [mm]")
    for face, values in zip(("upstream", "downstream"), np.hstack([openings, slips])):
        print(f"  {face:<12}" + " ".join(f"{x:6.2f}" for x in values))
    return 0


if __name__ == "__main__":
    sys.exit(main())
