#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Throughput of a study: twelve scenes of prm/coarse.prm with 28 joints, on all cores with one thread each, against the
same scenes started by hand, one process per core. Checks, Snakemake, table and figures are in the study's time.

    benchmarks/study_throughput.py [--voussoir PROGRAM] [--scenes 12] [--duration 10.24] [--set 'Section/Entry=value']...

Some four minutes on two quiet cores, half for either way.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from program import ROOT, add_program_argument

SCENE = ROOT / "prm" / "coarse.prm"
JOINTS = {"Mesh/Arch210/Joints": 28, "Mesh/Arch210/Elements along": 87, "Output/Figures": "false"}


def cpu_seconds():
    """Of all processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(work):
    """Wall and CPU time of a function [s]."""
    begin, cpu = time.monotonic(), cpu_seconds()
    work()
    return time.monotonic() - begin, cpu_seconds() - cpu


def call(*words, **more):
    """Ends the benchmark, with what was said, if the command fails."""
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **more)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))} ended with status {result.returncode}: {result.stderr.strip()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--scenes", type=int, default=12)
    parser.add_argument("--duration", type=float, default=10.24, help="of the shaking [s]")
    parser.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="for another dam than that of 28 joints")
    options = parser.parse_args()
    program, cores = str(Path(options.voussoir).resolve()), len(os.sched_getaffinity(0))
    settings = {**JOINTS, "Motion/Duration": options.duration, **dict(text.split("=", 1) for text in options.set)}
    with tempfile.TemporaryDirectory() as directory:
        def alone(seed):
            words = [word for entry, value in {**settings, "Motion/Seed": seed}.items() for word in ("--set", f"{entry}={value}")]
            call(program, SCENE, "--quiet", "--output", f"{directory}/alone{seed}", *words, env={**os.environ, "OMP_NUM_THREADS": "1"})

        def by_hand():
            with ThreadPoolExecutor(cores) as pool:
                list(pool.map(alone, range(1, options.scenes + 1)))

        study = Path(directory, "study.prm")
        study.write_text(f"set Scene = {SCENE}\nset Threads = 1\n" + "".join(f"set Settings/{e} = {v}\n" for e, v in settings.items())
                         + f"set Factors/Motion/Seed = 1 ... {options.scenes}\n")
        hand, cpu_by_hand = timed(by_hand)
        print(f"{options.scenes} scenes on {cores} cores: by hand {hand:.1f} s", end="", flush=True)
        whole, cpu_whole = timed(lambda: call(program, "study", study, "--jobs", cores, "--output", f"{directory}/study"))
        rows = Path(directory, "study", "results.csv").read_text().splitlines()
    if len(rows) != options.scenes + 1:
        sys.exit(f": the study has {len(rows) - 1} of {options.scenes} results.")
    print(f", as a study {whole:.1f} s: {100 * hand / whole:.0f} % of the throughput; "
          f"CPU time {cpu_by_hand:.1f} and {cpu_whole:.1f} s: {100 * cpu_by_hand / cpu_whole:.0f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
