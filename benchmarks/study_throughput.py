#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Throughput of a study: twelve scenes of prm/coarse.prm with 28 joints, on all cores with one thread each, against the
same scenes started by hand, one process per core. Checks, Snakemake, table and figures are in the study's time.

    benchmarks/study_throughput.py [--voussoir PROGRAM] [--scenes 12] [--duration 20.48]
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

JOINTS = {"Mesh/Arch210/Joints": 28, "Mesh/Arch210/Elements along": 87, "Output/Figures": "false"}


def cpu_seconds():
    """Of all processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--scenes", type=int, default=12)
    parser.add_argument("--duration", type=float, default=20.48, help="of the shaking [s]")
    options = parser.parse_args()
    program, cores = str(Path(options.voussoir).resolve()), len(os.sched_getaffinity(0))
    settings = {**JOINTS, "Motion/Duration": options.duration}
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as directory:
        def alone(seed):
            words = [word for entry, value in {**settings, "Motion/Seed": seed}.items() for word in ("--set", f"{entry}={value}")]
            subprocess.run([program, ROOT / "prm" / "coarse.prm", "--quiet", "--output", f"{directory}/alone{seed}", *words],
                           env=environment, check=True, stdout=subprocess.DEVNULL)

        begin, cpu = time.time(), cpu_seconds()
        with ThreadPoolExecutor(cores) as pool:
            list(pool.map(alone, range(1, options.scenes + 1)))
        by_hand, cpu_by_hand = time.time() - begin, cpu_seconds() - cpu
        study = Path(directory, "study.prm")
        study.write_text(f"set Scene = {ROOT / 'prm' / 'coarse.prm'}\n" + "".join(f"set Settings/{e} = {v}\n" for e, v in settings.items())
                         + f"set Factors/Motion/Seed = 1 ... {options.scenes}\n")
        begin, cpu = time.time(), cpu_seconds()
        subprocess.run([program, "study", str(study), "--jobs", str(cores), "--output", f"{directory}/study"], check=True, stdout=subprocess.DEVNULL)
        whole, cpu_whole = time.time() - begin, cpu_seconds() - cpu
    print(f"{options.scenes} scenes on {cores} cores: by hand {by_hand:.1f} s, as a study {whole:.1f} s; {100 * by_hand / whole:.0f} % of the throughput; "
          f"CPU time {cpu_by_hand:.1f} and {cpu_whole:.1f} s, {100 * cpu_by_hand / cpu_whole:.0f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
