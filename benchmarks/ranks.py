#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One rank, threads, and several ranks, of the same scene: are the results the same bits, and what does each rank do?

Usage: benchmarks/ranks.py [--voussoir build/voussoir] [--ranks 2 4] [--before OTHER/voussoir] [--set ENTRY=VALUE] SCENE.prm ...
Prints a table for benchmarks/README.md. Work is processor time of the shaking without messages, so it can be compared on a
machine that has fewer cores than there are ranks; wall times there mean something for at most as many ranks as cores.
With --before also the wall time of an older program on one rank.
"""
import argparse
import filecmp
import json
import os
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TABLES = ("history.csv", "joint_history.csv", "joints.csv", "energy.csv", "joint_pressures.csv")


def run(program, scene, settings, directory, ranks=1, threads=1):
    command = [program, scene, "--output", directory, "--quiet", "--set", "Output/Figures=false"]
    command += [word for setting in settings for word in ("--set", setting)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command]
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    if os.geteuid() == 0:
        environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    subprocess.run(command, check=True, env=environment)
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def row(name, s, one, same):
    per_rank = s.get("per_rank", {"work_seconds": [0.], "rock_work_seconds": [0.], "messages_per_step": [0.],
                                  "memory_bytes": [s["memory_bytes"]]})
    share = lambda key: max(per_rank[key]) / one["per_rank"][key][0] if one["per_rank"][key][0] > 0 else float("nan")
    return [name, f"{s['seconds']['per_second_of_earthquake']:.2f}", f"{1e3 * s['seconds']['shaking'] / s['steps']:.1f}",
            f"{s['seconds']['setup'] + s['seconds']['static']:.1f}", f"{share('work_seconds'):.2f}", f"{share('rock_work_seconds'):.2f}".replace("nan", ""),
            f"{max(per_rank['messages_per_step']):.0f}", " ".join(f"{m / 2**30:.2f}" for m in per_rank["memory_bytes"]), same]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--voussoir", default=os.path.join(ROOT, "build", "voussoir"))
    parser.add_argument("--before", help="an older program, on one rank")
    parser.add_argument("--ranks", type=int, nargs="+", default=[2, 4])
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE")
    parser.add_argument("scenes", nargs="+")
    arguments = parser.parse_args()
    print("| scene | on | s per s | ms per step | set-up and static [s] | work of the busiest rank, over one rank's | of the rock | "
          "messages per step | memory per rank [GiB] | tables |")
    print("|" + "---|" * 10)
    for scene in arguments.scenes:
        name = os.path.splitext(os.path.basename(scene))[0]
        with tempfile.TemporaryDirectory() as directory:
            one = run(arguments.voussoir, scene, arguments.set, f"{directory}/1")
            rows = [row("1 rank", one, one, "")]
            cases = [("2 threads", 1, 2, arguments.voussoir)]
            cases += [(f"{n} ranks", n, 1, arguments.voussoir) for n in arguments.ranks]
            if arguments.before:
                cases.append(("1 rank, before", 1, 1, arguments.before))
            for label, ranks, threads, program in cases:
                other = f"{directory}/{label.replace(' ', '_')}"
                s = run(program, scene, arguments.set, other, ranks, threads)
                same = all(filecmp.cmp(f"{directory}/1/{t}", f"{other}/{t}", shallow=False) for t in TABLES
                           if os.path.exists(f"{directory}/1/{t}"))
                rows.append(row(label, s, one, "the same bits" if same else "differ"))
            for r in rows:
                print(f"| {name} | " + " | ".join(r) + " |", flush=True)


if __name__ == "__main__":
    main()
