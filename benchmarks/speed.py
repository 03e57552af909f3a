#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds of wall time per second of earthquake of the benchmark dam, jointed and tied, in one run.

Usage: benchmarks/speed.py [--voussoir build/voussoir] [SCENE.prm ...]     (default: rigid28 with FJA, FJB, tied)
Prints a table for doc/performance.md. Take a quiet machine: stages are wall times.
"""
import argparse
import json
import os
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def run(voussoir, scene, settings):
    with tempfile.TemporaryDirectory() as directory:
        subprocess.run([voussoir, scene, "--output", directory, "--quiet", "--set", "Output/Figures=false"]
                       + [word for setting in settings for word in ("--set", setting)], check=True)
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
            return json.load(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--voussoir", default=os.path.join(ROOT, "build", "voussoir"))
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args()
    cases = [(scene, []) for scene in arguments.scenes]
    if not cases:
        dam = os.path.join(ROOT, "prm", "rigid28.prm")
        cases = [(dam, ["Joints/Model=" + law]) for law in ("FJA", "FJB", "tied")]
    print("| scene | law | unknowns | pairs | s per s | ms per step: sweeps | joints | stepping | stresses | output "
          "| Newton mean (max) | GMRES per step | memory [GiB] |")
    print("|" + "---|" * 13)
    for scene, settings in cases:
        s = run(arguments.voussoir, scene, settings)
        seconds, newton = s["seconds"], s["newton_iterations"]
        step = [f"{1e3 * seconds[stage] / s['steps']:.1f}"
                for stage in ("sweeps", "joints", "stepping", "stresses", "output")]
        print("|", " | ".join(
            [s["scene"], s["law"], str(s["mesh"]["dofs"]), str(s["mesh"]["pairs"]),
             f"{seconds['per_second_of_earthquake']:.2f}", *step, f"{newton['mean']:.2f} ({newton['max']:.0f})",
             f"{newton['linear_iterations_mean']:.1f}", f"{s['memory_bytes'] / 2**30:.2f}"]), "|", flush=True)


if __name__ == "__main__":
    main()
