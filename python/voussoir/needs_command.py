# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect and cost of each modelling choice of a scene, and the smallest scene that stays within a target (doc/needs.md).

    voussoir needs SCENE.prm [--for 5%] [--seconds 5] [--jobs 2] [--only water,rock,joints] [--mesh coarse|scene] [--output DIR]
                   [--set 'Section/Entry=value']...

The program declares the rows of a scene (`voussoir scene SCENE.prm --choices`). Each row is run over the strongest seconds of the motion.
Rows of the mesh and of cheaper numerics are relative to the mesh of the scene, other rows to a coarse mesh. The smallest scene is run over the
whole motion. The command takes at most ten times the processor time of the scene. Existing runs of this version are not
repeated.
"""

from __future__ import annotations

import json
import math
import os
import signal
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any, Dict, Iterable, List, Mapping, Optional

import numpy as np

from .accuracy import ROCK_SHARE, expect_one_record, height_of, n_monoliths, number
from .command import Parser, lock_directory
from .errors import ComputationError, InputError
from .needs_output import draw, print_table, signed, smallest_text, value_text, write_json, write_table
from .needs_runs import Runs
from .needs_verdicts import COLUMNS, candidates_of, changes_of, cheapest, judge, merge_scatter, size_of, to_take_back
from .program import call, entries_of, set_options

GROUPS = ("water", "foundation", "joints", "loads", "motion", "material", "numerics")
ALIASES = {"rock": "foundation"}
MOST = 10.  # cost of the command, in runs of the scene
RESERVE = 2.  # of it, for the scene and the smallest scenes over the whole motion
ATTEMPTS = 5  # one proposal, and four with changes taken back


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
        expect_one_record(scene, entries)
        self.rows = [row for row in self.declared() if row["group"] in self.groups]
        if not self.rows:
            raise InputError(f"the scene {scene} has no choice in the groups {', '.join(self.groups)}. Give other groups with --only.")
        self.directory = Path(options.get("output") or f"output/{self.scene.stem}-needs").resolve()
        given = os.environ.get("OMP_NUM_THREADS", "")
        threads = int(given) if given.isdecimal() and int(given) > 0 else max(1, len(os.sched_getaffinity(0)) // jobs)
        self.runs = Runs(self.scene.resolve(), entries, self.directory, self.output_settings(entries), threads)
        self.runs.seconds = seconds
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
        what = run.get("failure") or f"{run['cost']:.3g} s of processor time per second of earthquake"
        print(f"  {self.done:3d}/{self.expected} {name}: {what}; about {left:.0f} s left", flush=True)

    def must_run(self, name: str, changes: Mapping[str, Any], whole: bool = False) -> Dict[str, Any]:
        """A run without which there is no table. Throws InputError or ComputationError with the message of the program."""
        run = self.runs.run(name, changes, whole=whole, limited=False)
        if "failure" in run:
            raise (InputError if run.get("status") == 2 else ComputationError)(
                f"the scene {self.scene}{' over its whole motion' if whole else ''} failed, so there is no reference for its choices: {run['failure']}")
        self.progress(name, run)
        return run

    def references(self) -> Dict[str, Dict[str, Any]]:
        """Runs of the scene over the strongest seconds, with its own and with the coarse mesh; sets the limit of the cost."""
        self.expected = 3 + len(self.rows)
        found = {"scene": self.must_run("the scene, strongest seconds", {})}
        if self.coarse:
            run = self.runs.run("the scene, coarse mesh", self.coarse, limited=False)
            if "failure" not in run and run["cost"] < 0.8 * found["scene"]["cost"]:
                self.expected += 1
                self.progress("the scene, coarse mesh", run)
                found["coarse"] = run
        if "coarse" not in found:
            self.coarse = {}
        self.length = float(np.loadtxt(self.whole_motion(), delimiter=",", skiprows=1, usecols=0)[-1])
        base = found["scene"]
        self.predicted = base["setup"] + base["cost"] * self.length
        limit = self.runs.limit
        limit.left, limit.largest = (MOST - RESERVE) * self.predicted - self.runs.spent, max(self.predicted, 1.5 * base["cpu"])
        return found

    def whole_motion(self) -> Path:
        """The file of the scene's whole motion."""
        file = self.directory / "motions" / "whole.csv"
        call("motion", self.scene, "--output", file, *set_options(self.settings))
        return file

    def run_row(self, row: Dict[str, Any], references: Mapping[str, Dict[str, Any]]) -> None:
        """Runs a row against the reference with the same mesh; adds changes, values and cost, or the reason of its failure."""
        reference = references[row["reference"]]
        changes = {**(self.coarse if row["reference"] == "coarse" else {}), **row["set"]}
        run = self.runs.run(f"{row['group']} {row['name']}", changes, predicted=reference["cpu"])
        row["run"] = run
        if "failure" in run:
            row["failure"] = run["failure"]
            return
        row["changes"], row["counts"] = changes_of(run["values"], reference["values"])
        row.update(values=run["values"], where=run["where"], cost=run["cost"] / reference["cost"], extra=run["changes"])

    def run_all(self, references: Mapping[str, Dict[str, Any]]) -> Dict[str, Any]:
        """Runs the scene over the whole motion and all rows, some at a time. Returns the run over the whole motion."""
        full: Dict[str, Any] = {}
        pool = ThreadPoolExecutor(self.jobs)
        try:
            futures = {pool.submit(self.runs.run, "the scene, whole motion", {}, whole=True, limited=False): None}
            for row in self.rows:
                on_scene = not self.coarse or row["group"] == "numerics" and row["simpler"] or set(row["set"]) & set(self.coarse)
                row["reference"] = "scene" if on_scene else "coarse"
            # What the smallest scene may adopt first, and of this the cheapest: the cost limit ends the others.
            order = sorted(self.rows, key=lambda row: (not row["simpler"], row["reference"] == "scene"))
            futures.update({pool.submit(self.run_row, row, references): row for row in order})
            for future in as_completed(futures):
                row = futures[future]
                if row is None:
                    full = future.result()
                    if "failure" in full:
                        raise ComputationError(f"the scene {self.scene} over its whole motion failed: {full['failure']}")
                    self.progress("the scene, whole motion", full)
                else:
                    future.result()
                    self.progress(f"{row['group']}: {row['name']}", row.pop("run"))
        except BaseException:
            self.runs.stop()
            pool.shutdown(cancel_futures=True)
            raise
        pool.shutdown()
        return full

    def smallest(self, full: Dict[str, Any]) -> Dict[str, Any]:
        """Writes, runs and compares the smallest scene; takes changes back until the promise holds."""
        chosen, attempts = cheapest(candidates_of(self.rows), self.target), []
        file = self.directory / "smallest.prm"
        for k in range(ATTEMPTS):
            text, changes = smallest_text(self.scene.resolve(), self.settings, chosen, self.target, self.directory)
            file.write_text(text, encoding="utf-8")
            names = [f"{row['group']}: {row['name']}" for row in chosen]
            if not chosen:
                attempts.append({"rows": [], "holds": True, "cost": 1., "within": len(COLUMNS), "of": len(COLUMNS)})
                print("\nSmallest scene: the scene as it is. No combination of cheaper rows stays within the target.")
                break
            expected = full["cpu"] * math.prod(row["cost"] for row in chosen)
            print(f"\nSmallest scene, attempt {k + 1}: {'; '.join(names)}")
            if self.runs.spent + expected > MOST * full["cpu"]:
                print("    not run: cost limit")
                attempts.append({"rows": names, "failure": "not run: cost limit", "holds": None})
                break
            run = self.runs.run(f"smallest {k + 1}", changes, whole=True, limited=False)
            attempt, missed = self.compare(run, full)
            attempts.append({"rows": names, "settings": changes, **attempt})
            if attempt["holds"] or k + 1 == ATTEMPTS:
                break
            back = to_take_back(chosen, *missed) if missed else max(chosen, key=lambda row: size_of(row["changes"], row["counts"]))
            print(f"    The promise does not hold; taken back: {back['group']}: {back['name']}")
            chosen = [row for row in chosen if row is not back]
        return {**attempts[-1], "file": str(file), "attempts": attempts}

    def compare(self, run: Mapping[str, Any], full: Mapping[str, Any]) -> tuple[Dict[str, Any], Any]:
        """Changes of a smallest scene against the scene, both over the whole motion; and the changes as they count."""
        if "failure" in run:
            print(f"    failed: {run['failure']}")
            return {"failure": run["failure"], "holds": False}, None
        changes, counts = changes_of(run["values"], full["values"])
        within = [name for name in COLUMNS if not counts[name] or abs(changes[name] or 0.) <= self.target]
        cost = run["cpu"] / full["cpu"]
        shown = [f"{COLUMNS[name].title} {signed(changes[name], counts[name])} %" for name in COLUMNS if changes[name] is not None]
        print(f"    against the scene, whole motion: {', '.join(shown)}")
        print(f"    cost {cost:.2f} of the scene; {len(within)} of {len(COLUMNS)} results within {100 * self.target:g} %")
        return {"changes": changes, "counts": counts, "values": run["values"], "where": run["where"], "cost": cost, "cost_shaking": run["cost"] / full["cost"],
                "holds": len(within) == len(COLUMNS), "within": len(within), "of": len(COLUMNS)}, (changes, counts)

    def compute(self) -> Dict[str, Any]:
        """As compute_alone(), with the lock of the directory."""
        with lock_directory(self.directory, "`voussoir needs`", ("runs", "records", "motions")):
            return self.compute_alone()

    def compute_alone(self) -> Dict[str, Any]:
        """All runs; prints and writes the results, and returns what needs.json has."""
        print(f"{self.scene}: {len(self.rows)} rows, {self.jobs} runs at a time; target {100 * self.target:g} %")
        references = self.references()
        reference = references.get("coarse", references["scene"])
        full = self.run_all(references)
        mesh_error = changes_of(references["scene"]["values"], reference["values"])[0] if "coarse" in references else {}
        for row in self.rows:
            row.pop("run", None)
        self.rows = merge_scatter(self.rows)
        judge(self.rows, mesh_error, self.target)
        print(f"\nReference over {reference['seconds']:g} s: " + ", ".join(value_text(name, reference) for name in COLUMNS))
        if "coarse" in references:
            print("  on a coarse mesh; rows with * are relative to the scene's own mesh. Change by the coarse mesh: "
                  + ", ".join(f"{COLUMNS[name].title} {signed(mesh_error[name])} %" for name in COLUMNS if mesh_error[name] is not None))
        print_table(self.rows, self.target, "coarse" in references)
        smallest = self.smallest(full)
        total = self.runs.spent / full["cpu"]
        result = {"scene": self.scene.stem, "target": self.target, "seconds": self.seconds, "mesh": "coarse" if "coarse" in references else "scene",
                  "reference": reference, "mesh_error": mesh_error, "full": full, "rows": self.rows, "smallest": smallest, "total_cost": total,
                  "entries": self.entries}
        write_table(self.rows, self.directory / "needs.csv")
        charts = draw(self.rows, self.target, self.directory)
        write_json(result, self.directory / "needs.json")
        self.conclude(smallest, total, charts)
        return result

    def conclude(self, smallest: Mapping[str, Any], total: float, charts: List[Path]) -> None:
        """Prints the last lines."""
        if smallest.get("rows"):
            state = {True: "holds", False: "does not hold", None: "is not tested"}[smallest["holds"]]
            cost = f" at {smallest['cost']:.2f} of the cost" if "cost" in smallest else ""
            print(f"\nThe promise of {100 * self.target:g} % {state}{cost}: {smallest['file']}")
        print(f"Total     {total:.1f} times one run of the scene (limit {MOST:g})\nTable     {self.directory / 'needs.csv'}, needs.json")
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
