#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear keys (KSM) at their limits: does every setting run to its end, in how many Newton steps, at which cost?

    benchmarks/key_limits.py [--voussoir PROGRAM] [--mesh 24x8x1] [--duration 2.56] [--only TEXT] [--set ENTRY=VALUE]...

prm/coarse.prm with keys of all flank angles 0, 20, 45, 60 degrees, clearances 0, 1, 5 mm, directions both, radial,
vertical, and flank friction 0.8 and 0: 72 settings, and FJA beside them. Prints a Markdown table: per setting the
largest and mean number of Newton steps, steps solved by fall-backs or halved, and the time in the joints over FJA's.

Exit status: 0 if all run to the end without a halved step.
"""

import argparse
import itertools
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from program import ROOT, add_program_argument


def simulate(program, scene, settings, directory):
    """summary.json, or the last line of the message."""
    command = [program, str(scene), "--output", directory, "--overwrite", "--set", "Output/Figures=false"]
    for entry, value in settings.items():
        command += ["--set", f"{entry}={value}"]
    result = subprocess.run(command, text=True, capture_output=True,
                            env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    if result.returncode:
        return " ".join(result.stderr.split())[-160:]
    return json.loads((Path(directory) / "summary.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_program_argument(parser)
    parser.add_argument("--scene", default=str(ROOT / "prm" / "coarse.prm"))
    parser.add_argument("--mesh", default="24x8x1", help="elements along x up x through")
    parser.add_argument("--duration", type=float, default=2.56, help="of the motion [s]")
    parser.add_argument("--only", default="", help="settings whose name contains this")
    parser.add_argument("--set", action="append", default=[], help="further entries of the scene")
    arguments = parser.parse_args()
    along, up, through = arguments.mesh.split("x")
    common = {"Mesh/Arch210/Elements along": along, "Mesh/Arch210/Elements up": up,
              "Mesh/Arch210/Elements through": through, "Motion/Duration": arguments.duration,
              **dict(entry.split("=", 1) for entry in arguments.set)}
    bad = 0
    print("| keys | Newton steps: max | mean | static | sweeps, proximal, halved | joints / FJA |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as directory:
        plain = simulate(arguments.voussoir, arguments.scene, {**common, "Joints/Model": "FJA"}, directory)
        if isinstance(plain, str):
            raise SystemExit(plain)

        def row(name, result):
            path, newton = result["contact_path"], result["newton_iterations"]
            print(f"| {name} | {newton['max']} | {newton['mean']:.2f} | {result['static']['newton_iterations']} | "
                  f"{path['sweeps']}, {path['proximal']}, {path['smaller_step']} | "
                  f"{result['seconds']['joints'] / plain['seconds']['joints']:.2f} |", flush=True)
            return path["smaller_step"] == 0

        row("FJA", plain)
        for angle, clearance, direction, friction in itertools.product(
                (0, 20, 45, 60), (0, .001, .005), ("both", "radial", "vertical"), (.8, 0)):
            name = f"{angle} deg, {1e3 * clearance:g} mm, {direction}, {friction}"
            if arguments.only not in name:
                continue
            result = simulate(arguments.voussoir, arguments.scene,
                              {**common, "Joints/Model": "KSM", "Joints/Keys/Flank angle": angle,
                               "Joints/Keys/Clearance": clearance, "Joints/Keys/Direction": direction,
                               "Joints/Keys/Friction": friction}, directory)
            if isinstance(result, str):
                print(f"| {name} | **fails**: {result} |", flush=True)
                bad += 1
            else:
                bad += not row(name, result)
    print(f"\n{bad} settings fail or have halved steps")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
