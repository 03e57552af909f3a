# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect and cost of each modelling choice of a scene, and the smallest scene that stays within a target (doc/needs.md).

    voussoir needs SCENE.prm [--for 5%] [--seconds 5] [--jobs 2] [--only water,rock,joints] [--mesh coarse|scene] [--output DIR]
                   [--set 'Section/Entry=value']...

The program declares the rows of a scene (`voussoir scene SCENE.prm --choices`). A row is run with the strongest seconds of several motions, and
compared with the scene motion by motion: in batches where the explicit scheme applies, elsewhere with one motion, and with others as far as the limit
of the work allows. Rows of the mesh and of cheaper numerics are relative to the mesh of the scene, other rows to a coarse mesh. The smallest scene is
run over the whole motions. Existing runs of this version are not repeated.
"""

from __future__ import annotations

import json
import math
import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any, Dict, Iterable, List, Mapping, Optional

import numpy as np

from .accuracy import ROCK_SHARE, expect_no_abutments, height_of, n_monoliths, number
from .command import Parser, lock_directory
from .ensembles import members_of
from .errors import ComputationError, InputError
from .needs_output import change_text, draw, motions_text, print_table, signed, smallest_text, value_text, write_json, write_table
from .needs_runs import Runs
from .needs_verdicts import CHEAPER, COLUMNS, Motions, candidates_of, cheapest, judge, paired, scatter_of, size_of, to_take_back
from .program import call, entries_of, set_options

GROUPS = ("water", "foundation", "joints", "loads", "motion", "material", "numerics")
ALIASES = {"rock": "foundation"}
MOTIONS = 8  # artificial motions of a scene with one
MOST, LEAST = 10., 300.  # limit of the command: work in runs of the scene, but at least this work
RESERVE = 0.3  # of it, for the comparison of the smallest scenes
ATTEMPTS = 5  # proposals that are run
OPTIMISM = 1.5  # rows are added up to this part of the target: the effects are those of the strongest seconds, and the run decides


def coarse_mesh(entries: Mapping[str, str], directory: Path) -> Dict[str, str]:
    """Changes to a mesh with about half of the elements in each direction, at least two along a monolith, four up, two through; {} for a
    mesh from a file. With one element through, changes of rows differ from those of a fine mesh by 4 % of the reference (median), at most 58 %."""
    section = {"arch210": "Mesh/Arch210/", "arcs": "Mesh/Arcs/"}.get(entries["Mesh/Source"])
    if section is None:
        return {}
    monoliths = n_monoliths(entries, section)
    along, up, through = (int(entries[f"{section}Elements {name}"]) for name in ("along", "up", "through"))
    wanted = {f"{section}Elements along": monoliths * max(2, round(along / monoliths / 2)), f"{section}Elements up": max(4, round(up / 2)),
              f"{section}Elements through": max(2, round(through / 2))}
    if entries.get(section + "Rows"):
        del wanted[f"{section}Elements up"]  # the rows are the user's
    result = {entry: str(value) for entry, value in wanted.items() if value < int(entries[entry])}
    if result and entries["Foundation/Model"] != "rigid":
        size = float(entries[section + "Rock/Element size"]) or ROCK_SHARE * height_of(directory / entries["Mesh/Arcs/Table"])
        result[section + "Rock/Element size"] = f"{1.4 * size:.4g}"
    return result


def groups_of(text: Optional[str]) -> tuple[str, ...]:
    """Groups of --only."""
    if not text:
        return GROUPS
    names = [ALIASES.get(name.strip(), name.strip()) for name in text.split(",")]
    for name in names:
        if name not in GROUPS:
            raise InputError(f'--only: "{name}" is no group. The groups are {", ".join(GROUPS)} (rock means foundation).')
    return tuple(names)


class Needs:
    """One command: its scene, its runs and its rows."""

    def __init__(self, scene: Any, target: float, seconds: float, jobs: int, options: Mapping[str, Any]) -> None:
        self.scene, self.target, self.seconds, self.jobs = Path(scene), target, seconds, jobs
        self.settings: List[str] = list(options.get("settings") or ())
        self.groups, self.mesh = groups_of(options.get("only")), options.get("mesh") or "coarse"
        entries = entries_of(scene, self.settings)
        if entries["Motion/Source"] == "none":
            raise InputError(f"the scene {scene} has no motion (Motion/Source = none), so its choices have no effect on an earthquake. "
                             "Set Motion/Source to artificial or file.")
        expect_no_abutments(scene, entries)
        self.rows = [row for row in self.declared() if row["group"] in self.groups and "Motion/Seed" not in row["set"]]
        if not self.rows:
            raise InputError(f"the scene {scene} has no choice in the groups {', '.join(self.groups)}. Give other groups with --only.")
        self.directory = Path(options.get("output") or f"output/{self.scene.stem}-needs").resolve()
        given = os.environ.get("OMP_NUM_THREADS", "")
        threads = int(given) if given.isdecimal() and int(given) > 0 else max(1, len(os.sched_getaffinity(0)) // jobs)
        self.runs = Runs(self.scene.resolve(), entries, self.directory, self.output_settings(entries), threads, members_of(entries, MOTIONS))
        self.runs.seconds, self.numbers = seconds, range(len(self.runs.members))
        self.found: Dict[Any, Dict[str, Any]] = {}  # runs of the scene
        self.lock = threading.Lock()
        self.entries, self.began, self.done, self.expected = entries, time.monotonic(), 0, 0
        self.coarse = coarse_mesh(entries, self.scene.resolve().parent) if self.mesh == "coarse" else {}

    def declared(self) -> List[Dict[str, Any]]:
        """Rows that the program declares for this scene."""
        rows: List[Dict[str, Any]] = json.loads(call("scene", self.scene, "--choices", *set_options(self.settings)))["choices"]
        return rows

    def output_settings(self, entries: Mapping[str, str]) -> Dict[str, Any]:
        """Settings of all runs. The change of the sliding safety does not depend on the friction if there is no cohesion."""
        common: Dict[str, Any] = dict(text.split("=", 1) for text in self.settings)
        common.update({"Output/Figures": "false", "Output/Frames": 0, "Output/Solution interval": 0, "Output/Block forces": "true"})
        if entries["Output/Envelope interval"] == "0":
            common["Output/Envelope interval"] = 1
        if float(entries["Limits/Base friction"]) == 0 and float(entries["Limits/Base cohesion"]) == 0:
            common["Limits/Base friction"] = 1
        return common

    def progress(self, name: str, run: Mapping[str, Any]) -> None:
        """Prints a line for a run that has ended."""
        self.done += 1
        left = (time.monotonic() - self.began) / self.done * max(0, self.expected - self.done)
        what = run.get("failure") or f"work of {run['work']:.3g} s"
        print(f"  {self.done:3d}/{max(self.done, self.expected)} {name}: {what}; about {left:.0f} s left", flush=True)

    def reference(self, mesh: str, motion: Optional[int], whole: bool = False) -> Dict[str, Any]:
        """A run of the scene with its own or with the coarse mesh, which is made once."""
        with self.lock:
            key = (mesh, motion, whole)
            if key not in self.found:
                name, changes = ("the scene, coarse mesh", self.coarse) if mesh == "coarse" else ("the scene", {})
                self.found[key] = self.runs.run(name, changes, motion, whole=whole, limited=False)
            return self.found[key]

    def references(self) -> None:
        """Runs the scene with one motion, decides on the coarse mesh, and sets the limit of the work. Throws InputError or ComputationError with the
        message of the program."""
        self.expected = 1 + len(self.rows)
        given = {entry: value for entry, value in self.runs.common.items() if entry.startswith("Motion/")}
        whole = self.runs.motion({**given, **self.runs.members[0]}, True)
        self.runs.length = float(np.loadtxt(whole, delimiter=",", skiprows=1, usecols=0)[-1])
        base = self.reference("scene", 0)
        if "failure" in base:
            raise (InputError if base.get("status") == 2 else ComputationError)(
                f"the scene {self.scene} failed, so there is no reference for its choices: {base['failure']}")
        self.progress("the scene, strongest seconds", base)
        self.runs.iterations = base["newton"]
        self.predicted = base["setup"] + base["pace"] * self.runs.length
        self.total, limit = max(MOST * self.predicted, LEAST), self.runs.limit
        batch = self.reference("scene", None) if self.fits_batch({}) else base
        expected = len(self.rows) * max(batch["work"], base["work"])
        limit.left, limit.largest = (1 - RESERVE) * self.total - self.runs.spent, max(self.predicted, 1.5 * base["work"], LEAST / 10)
        if self.coarse and (expected < limit.left or "failure" in (run := self.reference("coarse", 0)) or run["pace"] > 0.8 * base["pace"]):
            self.coarse = {}
        for row in self.rows:
            on_scene = not self.coarse or row["group"] == "numerics" or set(row["set"]) & set(self.coarse)
            row.update(reference="scene" if on_scene else "coarse", motions={}, mode="single")

    def fits_batch(self, changes: Mapping[str, Any]) -> bool:
        """False if the program cannot run these changes in batches, or if they act in another scheme. The program decides in the other cases."""
        entries = self.runs.entries_with(changes)
        return (len(self.numbers) > 1 and entries["Foundation/Model"] == "rigid" and entries["Reservoir/Model"] not in ("acoustic", "incompressible")
                and not any(entry.startswith(("Contact/", "Dynamics/")) for entry in changes))

    def run_row(self, row: Dict[str, Any], motion: int) -> Dict[str, Any]:
        """Runs a row with all motions in batches, or else with one motion; adds the values of the motions, or the reason of the failure."""
        changes = {**(self.coarse if row["reference"] == "coarse" else {}), **row["set"]}
        name = f"{row['group']} {row['name']}"
        if motion == 0 and self.fits_batch(changes) and "failure" not in (reference := self.reference(row["reference"], None)):
            run = self.runs.run(name, changes, None, predicted=reference["work"])
            if "failure" not in run:
                return self.adopt(row, run, reference, "batch")
        reference = self.reference(row["reference"], motion)
        run = {**reference} if "failure" in reference else self.runs.run(name, changes, motion, predicted=reference["work"])
        if "failure" not in run:
            return self.adopt(row, run, reference, "single")
        row["failure" if motion == 0 else "missing"] = run["failure"] if motion == 0 else f"from motion {motion + 1} on: {run['failure']}"
        return run

    @staticmethod
    def adopt(row: Dict[str, Any], run: Dict[str, Any], reference: Mapping[str, Any], mode: str) -> Dict[str, Any]:
        """Adds a run to its row."""
        row["motions"].update(run["motions"])
        if lost := sorted(set(reference["motions"]) - set(run["motions"])):
            row["missing"] = f"the batch has no results of {'motion' if len(lost) == 1 else 'motions'} {', '.join(str(k + 1) for k in lost)}"
        if len(row["motions"]) == len(run["motions"]):  # the first
            row.update(mode=mode, where=run["where"], values=run["motions"].get(0, {}), cost=run["pace"] / reference["pace"], extra=run["changes"])
        return run

    def run_round(self, pool: ThreadPoolExecutor, rows: List[Dict[str, Any]], motion: int) -> None:
        """Runs rows with a motion, some at a time; with the first one also in batches."""
        self.expected = self.done + len(rows)
        futures = {pool.submit(self.run_row, row, motion): row for row in rows}
        for future in as_completed(futures):
            row, run = futures[future], future.result()
            if motion == 0 or "failure" not in run:
                self.progress(f"{row['group']}: {row['name']}{f', motion {motion + 1}' if motion else ''}", run)

    def run_all(self) -> None:
        """Runs all rows; then those that do not run in batches with the other motions, first the rows that the smallest scene may adopt."""
        pool = ThreadPoolExecutor(self.jobs)
        try:
            # What the smallest scene may adopt first, and of this the cheapest: the cost limit ends the others.
            rows = sorted(self.rows, key=lambda row: (not row["simpler"], row["reference"] == "scene"))
            self.run_round(pool, rows, 0)
            for adoptable in (True, False):
                group = [row for row in rows if row["mode"] == "single" and row["motions"] and (row["simpler"] and row["cost"] < CHEAPER) == adoptable]
                for motion in self.numbers[1:]:
                    self.run_round(pool, [row for row in group if len(row["motions"]) == motion], motion)
        except BaseException:
            self.runs.stop()
            pool.shutdown(cancel_futures=True)
            raise
        pool.shutdown()

    def motions_of(self, mesh: str, mode: str, whole: bool = False) -> Motions:
        """Values of the scene by motion, from the runs so far."""
        runs = [run for (of, motion, length), run in self.found.items()
                if (of, motion is None, length) == (mesh, mode == "batch", whole) and "failure" not in run]
        return {number: values for run in runs for number, values in run["motions"].items()}

    def smallest(self) -> Dict[str, Any]:
        """Writes, runs and compares the smallest scene; takes changes back until the promise holds. Then adds rows that the measured changes may allow;
        what holds at the lowest cost is kept."""
        candidates, attempts, kept = candidates_of(self.rows), [], None  # kept: text, attempt, rows
        chosen, others = cheapest(candidates, self.target), candidates_of(self.rows, self.target)
        n_run = sum("failure" not in row for row in self.rows)
        for k in range(ATTEMPTS):
            text, changes = smallest_text(self.scene.resolve(), self.settings, chosen, self.target, self.directory)
            names = [f"{row['group']}: {row['name']}" for row in chosen]
            if not chosen:
                attempts.append({"rows": [], "holds": True, "cost": 1., "within": len(COLUMNS), "of": len(COLUMNS)})
                print(f"\nSmallest scene: the scene as it is. No combination of the {n_run} rows that were run (of {len(self.rows)}) is cheaper and stays "
                      "within the target.")
                break
            print(f"\nSmallest scene, attempt {k + 1}: {'; '.join(names)}")
            attempt = {"rows": names, "settings": changes, **self.compare(f"smallest {k + 1}", chosen, changes)}
            attempts.append(attempt)
            if attempt["holds"] and attempt["cost"] < (kept[1]["cost"] if kept else 1.):
                kept = text, attempt, chosen
            elif attempt["holds"] is None or k + 1 == ATTEMPTS:
                break
            else:
                new = [row for row in chosen if not kept or row not in kept[2]]
                missed = attempt.get("own_scheme", attempt)
                back = (to_take_back(new, missed["changes"], missed["counts"]) if "changes" in missed
                        else max(new, key=lambda row: size_of(row["changes"], row["counts"])))
                print(f"    {'No gain' if attempt['holds'] else 'The promise does not hold'}; taken back: {back['group']}: {back['name']}")
                chosen, candidates, others = ([row for row in rows if row is not back] for rows in (chosen, candidates, others))
                chosen = chosen or cheapest(candidates, self.target)
            if kept:
                more = cheapest([row for row in others if row not in kept[2]], OPTIMISM * self.target, {**kept[1], "set": kept[1]["settings"]})
                chosen = [*kept[2], *more]
                if not more:
                    break
        text, attempt = kept[:2] if kept else (text, attempts[-1])
        file = self.directory / "smallest.prm"
        file.write_text(text.replace("\n# Entries", f"\n# {self.promise(attempt)}\n# Entries", 1), encoding="utf-8")
        return {**attempt, "file": str(file), "attempts": attempts}

    def promise(self, attempt: Mapping[str, Any]) -> str:
        """A sentence: whether the smallest scene was found to be within the target, and its cost."""
        state = {True: "holds", False: "does not hold", None: "is not tested"}[attempt["holds"]]
        cost = f" at {attempt['cost']:.2f} of the cost" if "cost" in attempt else ""
        reason = f" ({' '.join(attempt['failure'].split())})" if "failure" in attempt else ""
        return f"The promise of {100 * self.target:g} % {state}{cost}{reason}"

    def compare(self, name: str, chosen: List[Dict[str, Any]], changes: Mapping[str, Any]) -> Dict[str, Any]:
        """Changes of a smallest scene against the scene, in batches if possible; then also with one motion and the scheme of the smallest scene."""
        mode = "batch" if all(row["mode"] == "batch" for row in chosen) else "single"
        attempt = self.compare_by(mode, name, chosen, changes, [None] if mode == "batch" else list(self.numbers))
        if mode == "batch" and attempt["holds"] and changes.get("Dynamics/Scheme", self.entries["Dynamics/Scheme"]) != "explicit":
            print("    with the scheme of the scene:")
            own = self.compare_by("single", name, chosen, changes, [0])
            attempt.update({key: own[key] for key in ("holds", "failure", "cost", "within") if key in own}, own_scheme=own)
        return attempt

    def compare_by(self, mode: str, name: str, chosen: List[Dict[str, Any]], changes: Mapping[str, Any],
                   numbers: List[Optional[int]]) -> Dict[str, Any]:
        """Changes of a smallest scene against the scene, motion by motion over the whole motions."""
        cost, half, motions, first = math.prod(row["cost"] for row in chosen), (self.runs.spent + self.total) / 2, {}, None
        for motion in numbers:  # while half of the work is left for other attempts
            expected = self.predicted * (cost + (("scene", motion, True) not in self.found))
            if self.runs.spent + expected > (half if first else self.total):
                break
            reference, run = self.reference("scene", motion, True), self.runs.run(name, changes, motion, whole=True, limited=False)
            for one in (reference, run):
                if "failure" in one and first is None:
                    print(f"    failed: {one['failure']}")
                    return {"failure": one["failure"], "holds": False if one is run else None}
            motions.update(run.get("motions", {}))
            first = first or (reference, run)
        if first is None:
            print("    not run: cost limit")
            return {"failure": "not run: cost limit", "holds": None}
        found, (reference, run) = paired(motions, self.motions_of("scene", mode, True)), first
        within = [column for column in COLUMNS if not found["counts"][column] or abs(found["changes"][column] or 0.) <= self.target]
        work = [one["setup"] + one["pace"] * self.runs.length for one in (run, reference)]
        shown = [f"{COLUMNS[column].title} {change_text(found, column)} %" for column in COLUMNS if found["changes"][column] is not None]
        print(f"    against the scene, {motions_text(found['n'])}, whole: {', '.join(shown)}")
        print(f"    cost {work[0] / work[1]:.2f} of the scene; {len(within)} of {len(COLUMNS)} results within {100 * self.target:g} %")
        return {**found, "values": motions.get(0, {}), "where": run["where"], "cost": work[0] / work[1], "cost_shaking": run["pace"] / reference["pace"],
                "holds": len(within) == len(COLUMNS), "within": len(within), "of": len(COLUMNS)}

    def compute(self) -> Dict[str, Any]:
        """As compute_alone(), with the lock of the directory."""
        with lock_directory(self.directory, "`voussoir needs`", ("runs", "records", "motions")):
            return self.compute_alone()

    def compute_alone(self) -> Dict[str, Any]:
        """All runs; prints and writes the results, and returns what needs.json has."""
        print(f"{self.scene}: {len(self.rows)} rows, {self.jobs} runs at a time; target {100 * self.target:g} %")
        if len(self.numbers) == 1:
            print("  One motion: the effects of the choices are those of this motion. Give others with Motion/Ensemble.")
        self.references()
        mesh = "coarse" if self.coarse else "scene"
        self.run_all()
        best = {where: max((self.motions_of(where, mode) for mode in ("batch", "single")), key=len) for where in {mesh, "scene"}}
        mesh_error = paired(best["coarse"], best["scene"])["changes"] if self.coarse else {}
        batch, single = (self.motions_of(mesh, mode) for mode in ("batch", "single"))
        scatter = scatter_of({k: {**single.get(k, {}), **batch.get(k, {})} for k in {*batch, *single}})
        for row in self.rows:
            if "failure" not in row:
                row.update(paired(row["motions"], self.motions_of(row["reference"], row["mode"])))
        judge(self.rows, mesh_error, self.target, scatter)
        base = self.found[("coarse" if self.coarse else "scene", 0, False)]
        reference = {"values": base["motions"][0], "where": base["where"], "n": len(best[mesh]), "seconds": min(self.seconds, self.runs.length)}
        print(f"\nReference over {reference['seconds']:g} s, first motion: " + ", ".join(value_text(name, reference) for name in COLUMNS))
        if self.coarse:
            print("  on a coarse mesh; rows with * are relative to the scene's own mesh. Change by the coarse mesh: "
                  + ", ".join(f"{COLUMNS[name].title} {signed(mesh_error[name])} %" for name in COLUMNS if mesh_error[name] is not None))
        print_table(self.rows, self.target, bool(self.coarse), scatter)
        smallest = self.smallest()
        total = self.runs.spent / self.predicted
        result = {"scene": self.scene.stem, "target": self.target, "seconds": self.seconds, "mesh": mesh, "n_motions": len(self.numbers),
                  "reference": reference, "mesh_error": mesh_error, "scatter": scatter, "rows": self.rows, "smallest": smallest, "total_cost": total,
                  "entries": self.entries}
        write_table(self.rows, self.directory / "needs.csv", scatter)
        charts = draw(self.rows, self.target, self.directory, scatter)
        write_json(result, self.directory / "needs.json")
        self.conclude(smallest, total, charts)
        return result

    def conclude(self, smallest: Mapping[str, Any], total: float, charts: List[Path]) -> None:
        """Prints the last lines."""
        if smallest.get("rows"):
            print(f"\n{self.promise(smallest)}: {smallest['file']}")
        print(f"Total     work of {total:.1f} times one run of the scene (limit {self.total / self.predicted:.0f})")
        print(f"Table     {self.directory / 'needs.csv'}, needs.json")
        print(f"Charts    {', '.join(file.name for file in charts)}\nScene     {smallest['file']}")


def needs(scene: Any, target: float = 0.05, seconds: float = 5., jobs: int = 2, **options: Any) -> List[Dict[str, Any]]:
    """Rows of the table; parameters: voussoir.needs()."""
    rows: List[Dict[str, Any]] = Needs(scene, target, seconds, jobs, options).compute()["rows"]
    return rows


def main(words: Optional[Iterable[str]] = None) -> int:
    """The command."""
    parser = Parser(prog="voussoir needs", description=__doc__)
    parser.add_argument("--for", dest="target", default="5%")
    parser.add_argument("--seconds", default="5")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--mesh", choices=("coarse", "scene"), default="coarse")
    parser.add_argument("--only")
    parser.add_argument("--output")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("scene", nargs="*")
    options = parser.parse_args(words)
    if len(options.scene) != 1:
        raise InputError("`voussoir needs` needs one scene file. `voussoir needs --help` shows how.")
    if not 0 < options.jobs <= 10000:
        raise InputError(f"--jobs must be a positive number, not {options.jobs}.")
    for stop in (signal.SIGINT, signal.SIGTERM):
        signal.signal(stop, signal.default_int_handler)
    target = number(options.target, "--for", "%") / 100
    try:
        needs(options.scene[0], target, number(options.seconds, "--seconds"), options.jobs, only=options.only, output=options.output,
              settings=options.set, mesh=options.mesh)
    except KeyboardInterrupt:
        raise ComputationError("stopped; the same command goes on from the runs so far.") from None
    return 0
