#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
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

import json
import sys
from pathlib import Path

import numpy as np
import scipy.linalg

from dam_elements import CREST, DOWNSTREAM, UPSTREAM, Dam, key

HERE = Path(__file__).resolve().parent


def principal(stress):
    """Largest and smallest principal stress of rows xx yy zz xy yz zx."""
    t = np.empty((len(stress), 3, 3))
    for k, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]):
        t[:, i, j] = t[:, j, i] = stress[:, k]
    values = np.linalg.eigvalsh(t)
    return values[:, 2], values[:, 0]


def gauss_seidel(W, b, start, mu, rho, f):
    """Each pair in turn, by projection."""
    gap = W @ f + b
    for p in range(len(b) // 3):
        k = slice(3 * p, 3 * p + 3)
        for _ in range(20):
            g = gap[k]
            new = f[k] - rho[k] * (g - np.append(0., start[3 * p + 1:3 * p + 3] if mu is not None else np.zeros(2)))
            new[0] = max(0., f[3 * p] - rho[3 * p] * g[0])
            if mu is not None:
                size = np.linalg.norm(new[1:])
                if size > mu * new[0]:
                    new[1:] *= mu * new[0] / size
            change = new - f[k]
            f[k] = new
            gap += W[:, k] @ change
    return f


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
            f = gauss_seidel(W, b, start, mu, rho, f)
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
