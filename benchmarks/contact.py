#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The contact solver against Siconos on friction problems in FCLib files, as Dolan-More performance profiles.

    benchmarks/contact.py [--program build/voussoir-contact] [--samples DIRECTORY] [--problems DIRECTORY] [--output DIRECTORY]

Takes the "fclib_local" problems of the samples (names with dam* apart from the published ones) and of further
directories, such as `voussoir-contact --write-fclib` makes of problems of dams. Voussoir runs as `voussoir-contact`,
Siconos through its Python interface, both from r = 0, with the same cap of CPU seconds per solve and the same tolerances.

The error of every result is computed here, from r alone, by one function: the natural map with rho = 1, relative to
the largest norm of q, r and u, of the problem with W divided by the mean of its diagonal. What a solver says of its
success counts for nothing; r solves the problem if its error is below 1.01 times the tolerance (room for round-off).
If the program has no option --write-solutions, its own residual stands in for the error, and the tables say so.

Siconos gets the scaled problem. It aborts, hangs and leaks now and then: every solve is a process of its own with
limits of time and memory. Every problem is tried as sparse blocks (what Siconos reads FCLib files into), as a
compressed sparse matrix and, to 200 contacts, as a dense one, and the best counts. Where W is singular, as in many
published problems, Siconos' pure Newton solvers are chaotic at tight tolerances: changes of 1e-15 in W decide whether
they converge in 60 iterations or not in 1000. The same holds for their numbers of solved problems.

Seconds are CPU seconds of one thread in the solve alone, the best of three when below 0.2 s. They depend on the
machine; to compare, run all on a quiet one. Results of Siconos are kept in OUTPUT/siconos.json and used again unless
--fresh is given (after changes of its settings here, too).

Writes OUTPUT/{contact.md,contact.csv,contact.png}. Debian: apt install python3-siconos python3-h5py python3-matplotlib.
Exit status: 0 if Voussoir solves at least what the best Siconos solver does and never says "converged" wrongly;
1 if not; 77 if there are no samples or neither program.
"""

import os

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")  # before numpy and Siconos

import argparse  # noqa: E402
import csv  # noqa: E402
import hashlib  # noqa: E402
import json  # noqa: E402
import math  # noqa: E402
import pickle  # noqa: E402
import resource  # noqa: E402
import select  # noqa: E402
import signal  # noqa: E402
import statistics  # noqa: E402
import subprocess  # noqa: E402
import sys  # noqa: E402
import tempfile  # noqa: E402
import time  # noqa: E402
import warnings  # noqa: E402
from pathlib import Path  # noqa: E402

import h5py  # noqa: E402
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
OURS = "Voussoir"
TOLERANCES = [1e-4, 1e-8, 1e-12]
ROUND_OFF = 1.01
MEMORY = 4 << 30  # bytes of address space for one Siconos process
SETS = {"dam": "dam-type", "published": "published"}
UNLIMITED = 10**9
# Siconos' name, iterations, and what differs from its defaults.
SOLVERS = {
    "NSGS": ("NSGS", UNLIMITED, {}),
    "NSN_AC": ("NSN_AC", 1000, {}),
    "NSN_AC_HYBRID": ("NSN_AC", 1000, {"NSN_HYBRID_STRATEGY": "NSN_HYBRID_STRATEGY_VI_EG_NSN"}),
    "NSN_FB": ("NSN_FB", 1000, {}),
    "PROX": ("PROX", 1000, {}),
    "ADMM": ("ADMM", UNLIMITED, {"ADMM_IPARAM_RHO_STRATEGY": "ADMM_RHO_STRATEGY_RESIDUAL_BALANCING",
                                 "ADMM_IPARAM_INITIAL_RHO": "ADMM_INITIAL_RHO_NORM_INF",
                                 "IPARAM_RESCALING": "RESCALING_SCALAR"})}


class Problem:
    """u = W r + q with 3 components (normal first) and one friction coefficient per contact."""

    def __init__(self, path):
        self.path, self.name = path, path.stem
        with h5py.File(path, "r") as file:
            local = file["fclib_local"]
            if int(local["spacedim"][0]) != 3 or "V" in local or "R" in local:
                raise ValueError("not a problem of contacts in space alone")
            matrix = local["W"]
            self.size, self.W = int(matrix["m"][0]), np.array(matrix["x"], dtype=float)
            kind, p, i = int(matrix["nz"][0]), np.array(matrix["p"]), np.array(matrix["i"])
            self.q = np.array(local["vectors/q"], dtype=float)
            self.friction = np.array(local["vectors/mu"], dtype=float)
        if kind >= 0:  # triplets; p holds columns and i rows, as in CSparse and unlike what fclib.h says
            self.rows, self.columns, self.W = i[:kind], p[:kind], self.W[:kind]
        else:
            outer = np.repeat(np.arange(self.size), np.diff(p))
            i, self.W = i[:len(outer)], self.W[:len(outer)]
            self.rows, self.columns = (outer, i) if kind == -2 else (i, outer)
        if self.size != len(self.q) or self.size != 3 * len(self.friction):
            raise ValueError("sizes of W, q and mu differ")
        self.contacts = len(self.friction)
        self.omega = self.W[self.rows == self.columns].sum() / self.size
        self.W = self.W / self.omega  # now in units of forces: r * omega solves it
        digest = hashlib.sha1()
        for array in (self.rows, self.columns, self.W, self.q, self.friction):
            digest.update(np.ascontiguousarray(array, dtype=float).tobytes())
        self.key = f"{self.name} {digest.hexdigest()[:12]}"
        self.set = "dam" if self.name.startswith("dam") else "published"

    def error(self, r):
        """Of r (times omega): |r - P(r - u - mu |u_t| n)| / max(|q|, |r|, |u|), P the projection onto the cones."""
        if r.shape != self.q.shape or not np.isfinite(r).all():
            return math.inf
        u = np.bincount(self.rows, self.W * r[self.columns], self.size) + self.q
        mu, velocity, force = self.friction, u.reshape(-1, 3), r.reshape(-1, 3)
        n = force[:, 0] - velocity[:, 0] - mu * np.hypot(velocity[:, 1], velocity[:, 2])
        tangential = force[:, 1:] - velocity[:, 1:]
        t = np.hypot(tangential[:, 0], tangential[:, 1])
        inside, outside = t <= mu * n, mu * t <= -n
        normal = np.where(inside, n, np.where(outside, 0, (n + mu * t) / (1 + mu**2)))
        factor = np.where(inside, 1, np.where(outside, 0, mu * normal / np.where(t > 0, t, 1)))
        distance = np.linalg.norm(force - np.column_stack([normal, factor[:, None] * tangential]))
        scale = max(map(np.linalg.norm, (self.q, r, u)))
        return float(distance / scale if scale > np.finfo(float).eps else distance)


class Result:
    """Of one solver on one problem at one tolerance."""

    def __init__(self, error=math.inf, seconds=math.inf, iterations=None, status="", **others):
        self.error, self.seconds, self.iterations, self.status = error, seconds, iterations, status
        self.storage, self.converged = others.get("storage", ""), others.get("converged")
        self.tolerance, self.r = others.get("tolerance"), others.get("r")

    @property
    def solved(self):
        return self.error <= ROUND_OFF * self.tolerance

    @property
    def cost(self):
        return self.seconds if self.solved else math.inf


# Siconos -------------------------------------------------------------------------------------------------------------

def load_siconos():
    try:
        warnings.simplefilter("ignore")  # of conversions
        import siconos.numerics
        import scipy.sparse
        return siconos.numerics, scipy.sparse
    except ImportError as error:
        print(f"NO SICONOS ({error}): apt install python3-siconos", file=sys.stderr)
        return None


def siconos_problem(siconos, problem, storage):
    numerics, sparse = siconos
    matrix = sparse.coo_matrix((problem.W, (problem.rows, problem.columns)), shape=(problem.size, problem.size))
    if storage == "dense":
        matrix = np.asfortranarray(matrix.toarray())
    elif storage == "sparse":
        matrix = matrix.tocsc()
    else:
        matrix = numerics.SBM_from_csparse(3, matrix)[1]
    q, mu = problem.q.copy(), problem.friction.copy()
    friction = numerics.FrictionContactProblem(3, problem.contacts, matrix, q, mu)
    friction.keep = matrix, q, mu  # Siconos only points to them
    return friction


def siconos_options(numerics, solver, tolerance):
    name, iterations, settings = SOLVERS[solver]

    def constant(word):
        return getattr(numerics, "SICONOS_FRICTION_3D_" + word)

    options = numerics.SolverOptions(constant(name))
    options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = iterations
    for entry, value in settings.items():
        options.iparam[constant(entry)] = constant(value)
    return options


def siconos_child(siconos, problem, solver, storage, tolerance, cap, pipe):
    """Solves up to three times and sends (seconds, status, iterations, r) of each run."""
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGPROF, signal.SIG_DFL)  # ends the process, wherever it is
    with os.fdopen(pipe, "wb") as stream:
        for _ in range(3):
            friction = siconos_problem(siconos, problem, storage)
            options = siconos_options(siconos[0], solver, tolerance)
            r, u = np.zeros(problem.size), np.zeros(problem.size)
            signal.setitimer(signal.ITIMER_PROF, cap)
            # The process' clock runs in ticks of milliseconds while the timer is set; this one does not.
            start = time.thread_time()
            status = siconos[0].fc3d_driver(friction, r, u, options)
            seconds = time.thread_time() - start
            signal.setitimer(signal.ITIMER_PROF, 0)
            iterations = int(options.iparam[siconos[0].SICONOS_IPARAM_ITER_DONE])
            pickle.dump((seconds, int(status), iterations, r), stream)
            stream.flush()
            if seconds >= 0.2:
                break


def siconos_run(siconos, problem, solver, storage, tolerance, cap):
    """The best of the runs of one child process that came to an end."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reading)
            siconos_child(siconos, problem, solver, storage, tolerance, cap, writing)
        except BaseException:  # the parent must not go on twice
            os._exit(1)
        os._exit(0)
    os.close(writing)
    data, end, ending = b"", time.monotonic() + 8 * cap + 30, None
    while True:
        if select.select([reading], [], [], max(0, end - time.monotonic()))[0]:
            chunk = os.read(reading, 1 << 20)
            if not chunk:
                break
            data += chunk
        else:
            os.kill(child, signal.SIGKILL)
            ending = "hang"
            break
    os.close(reading)
    status = os.waitpid(child, 0)[1]
    if ending is None and os.WIFSIGNALED(status):
        ending = {signal.SIGPROF: "time"}.get(os.WTERMSIG(status), signal.Signals(os.WTERMSIG(status)).name)
    elif ending is None and status:
        ending = "error"

    results = []
    while data:
        try:
            seconds, info, iterations, r = pickle.loads(data)
        except (EOFError, pickle.UnpicklingError):
            break
        data = data[len(pickle.dumps((seconds, info, iterations, r))):]
        results.append(Result(problem.error(r), seconds, iterations, ending or f"info {info}", storage=storage,
                              converged=info == 0, tolerance=tolerance))
    if not results:
        return Result(status=ending or "error", storage=storage, tolerance=tolerance)
    return min(results, key=lambda result: (result.cost, result.error))


def siconos_solve(siconos, problem, solver, cap, kept):
    """Results per tolerance; `kept` holds the known ones and is added to."""
    results, hopeless = {}, set()
    for tolerance in TOLERANCES:
        key = f"{problem.key} {solver} {tolerance:g} {cap:g}"
        if key not in kept:
            if siconos is None:
                continue
            runs = []
            for storage in ["blocks", "sparse"] + (["dense"] if problem.contacts <= 200 else []):
                if storage in hopeless:  # ran out of time at a larger tolerance
                    runs.append(Result(status="time", storage=storage, tolerance=tolerance))
                    continue
                runs.append(siconos_run(siconos, problem, solver, storage, tolerance, cap))
                if runs[-1].status in ("time", "hang"):
                    hopeless.add(storage)
            best = min(runs, key=lambda run: (run.cost, run.error))
            kept[key] = {"error": best.error, "seconds": best.seconds, "iterations": best.iterations,
                         "status": best.status, "storage": best.storage, "converged": best.converged}
        results[tolerance] = Result(**kept[key], tolerance=tolerance)
    return results


# Voussoir ------------------------------------------------------------------------------------------------------------

class Voussoir:
    def __init__(self, program, cap):
        self.program, self.cap, self.writes = program, cap, True

    def run(self, problem, tolerance, files, directory):
        command = [str(self.program), *map(str, files), "--tolerance", f"{tolerance:g}",
                   "--max-seconds", f"{self.cap:g}"]
        if self.writes:
            command += ["--write-solutions", directory]
        try:
            result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    timeout=30 + 4 * self.cap * len(files))
        except subprocess.TimeoutExpired:
            return []
        if result.returncode == 2 and self.writes and "write-solutions" in result.stderr:
            self.writes = False
            return self.run(problem, tolerance, files, directory)
        if result.returncode == 2:
            raise SystemExit(f"{' '.join(command)}:\n{result.stderr}")
        return [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]

    def solve(self, problem, tolerance):
        with tempfile.TemporaryDirectory() as directory:
            lines = self.run(problem, tolerance, [problem.path], directory)
            if lines and lines[0]["seconds"] < 0.2:
                lines += self.run(problem, tolerance, [problem.path] * 2, directory)
            if not lines:
                return Result(status="crash or hang", tolerance=tolerance)
            best, error, r = min(lines, key=lambda line: line["seconds"]), None, None
            if self.writes:
                path, error = Path(directory) / f"{problem.name}.txt", math.inf
                if path.exists():
                    r = problem.omega * np.array(path.read_text().split(), dtype=float)
                    error = problem.error(r)
            else:
                error = best["residual"]
        if best["seconds"] > self.cap:
            error = math.inf
        return Result(math.inf if error is None else error, best["seconds"], best["iterations"], best["solver"],
                      converged=bool(best["converged"]), tolerance=tolerance, r=r)


def voussoir_usable(program):
    try:
        text = subprocess.run([str(program), "--help"], text=True, stdout=subprocess.PIPE, timeout=60).stdout
    except (OSError, subprocess.TimeoutExpired):
        text = ""
    if "voussoir-contact" not in text:
        print(f"NO VOUSSOIR: {program} is missing (ninja voussoir-contact)", file=sys.stderr)
        return False
    return True


# Tables --------------------------------------------------------------------------------------------------------------

def ratio(results, name, problem, names):
    """Cost over that of the fastest of `names`; infinite if not solved."""
    cost = results[problem][name].cost
    return cost / min(results[problem][other].cost for other in names) if cost < math.inf else math.inf


def profile(results, name, names, tau):
    return sum(ratio(results, name, problem, names) <= tau for problem in results) / max(1, len(results))


def total(results, names, cap):
    """CPU seconds of the best of `names` on all problems, a failure taken as the cap; how many it solves."""
    costs = [min(results[problem][name].cost for name in names) for problem in results]
    return sum(min(cost, cap) for cost in costs), sum(cost < math.inf for cost in costs)


def seconds_text(results, names, cap):
    value, solved = total(results, names, cap)
    return ("" if solved == len(results) else "≥ ") + (f"{value:.1f}" if value >= 1 else f"{value:.2g}")


def solver_table(title, results, names, cap):
    """`results` by tolerance, problem and solver."""
    tight = results[TOLERANCES[-1]]
    lines = [f"**{title}** ({len(tight)} problems)", "",
             "| solver | " + " | ".join(f"{tolerance:g}" for tolerance in TOLERANCES)
             + f" | CPU s at {TOLERANCES[0]:g} / {TOLERANCES[1]:g} / {TOLERANCES[2]:g} | ρ(1.5) | ρ(3) | ρ(10) "
             "| median iterations |", "|---" * (6 + len(TOLERANCES)) + "|"]
    siconos = [name for name in names if name != OURS]
    for name in names + (["Siconos' virtual best"] if siconos else []):
        group = [name] if name in names else siconos
        counts = [f"{total(results[t], group, cap)[1]}/{len(tight)}" for t in TOLERANCES]
        times = " / ".join(seconds_text(results[t], group, cap) for t in TOLERANCES)
        if name in names:
            shares = [f"{profile(tight, name, names, tau):.2f}" for tau in (1.5, 3, 10)]
            iterations = [tight[p][name].iterations for p in tight if tight[p][name].solved]
            shares.append(f"{statistics.median(iterations):g}" if iterations else "")
        else:
            costs = {p: (min(tight[p][n].cost for n in siconos), min(tight[p][n].cost for n in names)) for p in tight}
            shares = [f"{sum(a < math.inf and a <= tau * b for a, b in costs.values()) / len(tight):.2f}"
                      for tau in (1.5, 3, 10)] + [""]
        lines.append(f"| {name} | " + " | ".join([*counts, times, *shares]) + " |")
    return lines + [""]


def goal_table(problems, results, raw, names, cap, reported):
    """The goals of the contact solver, on the problems at hand."""
    by_name, siconos = {p.name: p for p in problems}, [name for name in names if name != OURS]
    tight, middle = results[TOLERANCES[-1]], results[TOLERANCES[1]]

    def pick(table, condition):
        return {name: table[name] for name in table if condition(by_name[name])}

    def best(table):  # Siconos' best single solver: most solved, then fastest
        return max(siconos, key=lambda name: (total(table, [name], cap)[1], -total(table, [name], cap)[0]))

    def compared(table):
        single = best(table)
        return (f"{single} {seconds_text(table, [single], cap)} s ({total(table, [single], cap)[1]}/{len(table)}), "
                f"virtual best {seconds_text(table, siconos, cap)} s ({total(table, siconos, cap)[1]}/{len(table)})")

    dam, published = pick(tight, lambda p: p.set == "dam"), pick(tight, lambda p: p.set == "published")
    large = {name: runs for name, runs in pick(published, lambda p: p.contacts >= 40).items()
             if not siconos or min(runs[solver].cost for solver in siconos) < math.inf}
    lines = ["| goal | Voussoir | Siconos |", "|---|---|---|"]
    ours, theirs = OURS in names, bool(siconos)

    def row(goal, mine, anchor):
        lines.append(f"| {goal} | {mine() if ours else 'not run'} | {anchor() if theirs else 'not run'} |")

    def iterations(table):
        return [table[name][OURS].iterations for name in table if table[name][OURS].solved]

    if dam:
        row("G1 dam-type at 1e-12: solved; largest number of iterations (20)",
            lambda: f"{total(dam, [OURS], cap)[1]}/{len(dam)}; {max(iterations(dam), default='-')}", lambda: "; ".join(
                f"{name} {total(dam, [name], cap)[1]}/{len(dam)} ({max(runs)} it.)" for name in siconos
                if (runs := [dam[p][name].iterations for p in dam if dam[p][name].solved])))
        row("G2 dam-type at 1e-12: total CPU", lambda: f"{seconds_text(dam, [OURS], cap)} s", lambda: compared(dam))
    if published:
        loose = pick(middle, lambda p: p.set == "published")
        row("G3 published at 1e-12: solved", lambda: f"{total(published, [OURS], cap)[1]}/{len(published)}",
            lambda: compared(published))
        row("G3 published at 1e-8: solved", lambda: f"{total(loose, [OURS], cap)[1]}/{len(loose)}",
            lambda: compared(loose))
    if large:
        row(f"G4 published with 40 contacts or more that Siconos solves ({len(large)}), 1e-12: total CPU",
            lambda: f"{seconds_text(large, [OURS], cap)} s ({total(large, [OURS], cap)[1]}/{len(large)})",
            lambda: compared(large))
    for title, low, high in [("below 100", 0, 100), ("100 to 300", 100, 300), ("300 or more", 300, UNLIMITED)]:
        part = pick(dam, lambda p: low <= p.contacts < high)
        if not part:
            continue

        def share(names_, tau):
            return sum(min(part[p][n].cost for n in names_) <= tau * min(part[p][n].cost for n in siconos)
                       and min(part[p][n].cost for n in names_) < math.inf for p in part) / len(part)

        row(f"G5 dam-type, {title} contacts ({len(part)}): fraction within 1.5 and 3 times the virtual best, solved",
            lambda: (f"{share([OURS], 1.5):.2f}, {share([OURS], 3):.2f}, " if theirs else "")
            + f"{total(part, [OURS], cap)[1] / len(part):.2f}",
            lambda: ", ".join(f"{name} {share([name], 1.5):.2f}" for name in siconos))
    for name, result in raw.items():
        twin = tight.get(name, {}).get(OURS)
        if twin is None:
            continue
        difference = ""
        if twin.r is not None and result.r is not None:
            one, other = (run.r / np.linalg.norm(run.r) for run in (twin, result))  # gaps have other units, too
            difference = f"; r differs by {np.linalg.norm(one - other):.1e}"
        row(f"G6 {name} in N and m against scaled units: iterations",
            lambda: f"{result.iterations} and {twin.iterations}{difference}", lambda: "gets the scaled problem only")
    if ours:
        runs = [results[t][p][OURS] for t in results for p in results[t]]
        wrong = sum(bool(run.converged) and not run.solved for run in runs)
        silent = sum(run.solved and not run.converged for run in runs)
    row("G7 \"converged\" above the tolerance, all tolerances" + (" (REPORTED errors)" if reported else ""),
        lambda: f"{wrong} of {len(runs)} (solved, but not called converged: {silent})",
        lambda: ", ".join(f"{name} {bad}" for name in siconos if (bad := sum(
            bool(results[t][p][name].converged) and not results[t][p][name].solved
            for t in results for p in results[t]))) or "0")
    return lines + ["", "G8 (time histories) and G9 (mixed against condensed) are tests of the program.", ""]


def draw(groups, names, cap, path):
    tolerance = TOLERANCES[-1]
    figure, axes = plt.subplots(1, len(groups), figsize=(5.5 * len(groups), 4), sharey=True, squeeze=False)
    taus = np.logspace(0, 3, 601)
    for axis, (title, results) in zip(axes[0], groups.items()):
        results = results[tolerance]
        for name in names:
            ratios = np.array([ratio(results, name, problem, names) for problem in results])
            axis.step(taus, [(ratios <= tau).mean() for tau in taus], where="post", label=name,
                      **({"color": "black", "linewidth": 2.5} if name == OURS else {"linewidth": 1.3}))
        axis.set(xscale="log", xlim=(1, 1e3), ylim=(0, 1.02), xlabel="τ: CPU time over that of the fastest",
                 title=f"{title}: {len(results)} problems, error {tolerance:g}, cap {cap:g} s")
        axis.grid(alpha=0.3)
    axes[0, 0].set_ylabel("fraction of problems solved")
    axes[0, -1].legend(loc="lower right", fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    plt.close(figure)


# ---------------------------------------------------------------------------------------------------------------------

def read_problems(directories):
    problems = {}
    for directory in directories:
        files = sorted([*directory.glob("*.hdf5"), *directory.glob("*.h5")])
        if not files:
            print(f"NO PROBLEMS in {directory} (options --samples, --problems)", file=sys.stderr)
        for path in files:
            try:
                problem = Problem(path)
                if directory != directories[0] and not problem.name.startswith("dam"):
                    problem.set = "dam"  # Voussoir's own
                if problem.name in problems:
                    raise ValueError("a problem of this name is there already")
                problems[problem.name] = problem
            except (KeyError, OSError, ValueError) as error:
                print(f"LEFT OUT {path}: {error}", file=sys.stderr)
    return list(problems.values())


def processor():
    try:
        return next(line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    except (OSError, StopIteration):
        return "unknown"


def run_siconos(problems, options):
    path = options.output / "siconos.json"
    kept = {} if options.fresh or not path.exists() else json.loads(path.read_text())
    if kept and kept.get("processor") != processor():
        print(f"SICONOS' TIMES ARE OF ANOTHER MACHINE ({kept.get('processor')}): --fresh repeats them", file=sys.stderr)
    kept.setdefault("processor", processor())
    results = kept.setdefault("results", {})
    siconos, all_results = load_siconos(), {}
    for count, problem in enumerate(problems):
        for solver in options.solvers:
            known = len(results)
            runs = siconos_solve(siconos, problem, solver, options.cap, results)
            if len(results) > known:
                path.write_text(json.dumps(kept, indent=0))
                print(f"{count + 1}/{len(problems)} {problem.name} {solver}: " + ", ".join(
                    f"{r.seconds:.4f} s" if r.solved else f"{r.status} {r.error:.0e}" for r in runs.values()),
                    file=sys.stderr, flush=True)
            all_results[problem.name, solver] = runs
    return all_results


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "voussoir-contact", help="Voussoir")
    collection = ROOT / "../shared/reference/data/fclib"  # all of them; tests/fclib, with RockPile, is a choice
    parser.add_argument("--samples", type=Path, default=collection if collection.exists() else ROOT / "tests" / "fclib", help="FCLib files")
    parser.add_argument("--problems", type=Path, action="append", default=[], help="further dam-type problems")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "benchmarks" / "contact")
    parser.add_argument("--cap", type=float, default=10, help="CPU seconds per solve")
    parser.add_argument("--solvers", nargs="*", choices=SOLVERS, default=list(SOLVERS), help="of Siconos")
    parser.add_argument("--fresh", action="store_true", help="run Siconos again")
    options = parser.parse_args()

    problems = read_problems([options.samples.resolve(), *(d.resolve() for d in options.problems)])
    if not problems:
        print("SKIPPED: no problems")
        return 77
    options.output.mkdir(parents=True, exist_ok=True)
    # The same problem in other units would count twice.
    raw = [problem for problem in problems if problem.name.endswith("-rawSI")]
    problems = [problem for problem in problems if problem not in raw]

    runs = run_siconos(problems, options)
    names = [solver for solver in options.solvers
             if all(len(runs[problem.name, solver]) == len(TOLERANCES) for problem in problems)]
    reported, raw_results = False, {}
    if voussoir_usable(options.program):
        voussoir = Voussoir(options.program, options.cap)
        names.insert(0, OURS)
        for problem in problems:
            runs[problem.name, OURS] = {t: voussoir.solve(problem, t) for t in TOLERANCES}
        raw_results = {p.name.removesuffix("-rawSI"): voussoir.solve(p, TOLERANCES[-1]) for p in raw}
        reported = not voussoir.writes
    if not names:
        print("SKIPPED: neither Voussoir nor Siconos")
        return 77

    results = {t: {p.name: {name: runs[p.name, name][t] for name in names} for p in problems} for t in TOLERANCES}
    groups = {title: {t: {p.name: results[t][p.name] for p in problems if p.set == key} for t in TOLERANCES}
              for key, title in SETS.items()}
    groups = {title: group for title, group in groups.items() if group[TOLERANCES[0]]}

    text = [f"{processor()}; cap {options.cap:g} CPU s per solve, a failure counts as the cap in totals (≥); "
            f"ρ and iterations at {TOLERANCES[-1]:g} (those of PROX are its outer ones, of NSGS sweeps).", ""]
    if reported:
        text += ["**The program has no --write-solutions: the errors of Voussoir are those it REPORTS itself.**", ""]
    for title, group in groups.items():
        text += solver_table(title, group, names, options.cap)
    text += goal_table(problems, results, raw_results, names, options.cap, reported)
    (options.output / "contact.md").write_text("\n".join(text))
    print("\n".join(text))

    with open(options.output / "contact.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow("problem set contacts tolerance solver solved error seconds iterations storage status".split())
        for problem in problems:
            for tolerance in TOLERANCES:
                for name in names:
                    r = results[tolerance][problem.name][name]
                    writer.writerow([problem.name, problem.set, problem.contacts, f"{tolerance:g}", name, int(r.solved),
                                     f"{r.error:.3e}", f"{r.seconds:.3e}", r.iterations, r.storage, r.status])
    draw(groups, names, options.cap, options.output / "contact.png")

    if OURS not in names:
        return 0
    good = all(total(group[t], [OURS], options.cap)[1] >= max(
        total(group[t], [name], options.cap)[1] for name in names) for group in groups.values() for t in TOLERANCES)
    return 0 if good and not any(run.converged and not run.solved for t in results
                                 for run in (results[t][p][OURS] for p in results[t])) else 1


if __name__ == "__main__":
    sys.exit(main())
