#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Elastic bar that flies against a rigid wall: the exact solution returns with its speed. Table of mesh and step for both schemes.

    benchmarks/rebound.py [--voussoir PROGRAM]

Bar of 20 m (24 GPa, Poisson's ratio 0, 2400 kg/m3), 1 m/s, 1 mm from the wall, a base joint FJA without friction; plane wave of 3162 m/s. Prints a Markdown
table: the mean velocity of the bar after the impact over that before. Exit status 1 if the finest rows lose more than 3 %."""

import argparse
import sys
import tempfile
from functools import partial
from math import sqrt
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "golden"))
import meshes  # noqa: E402
from program import add_program_argument, run  # noqa: E402

LENGTH, GAP, SPEED, YOUNG, DENSITY = 20., 1e-3, 1., 24e9, 2400.
WAVE = sqrt(YOUNG / DENSITY)  # [m/s]
SCENE = """
subsection Mesh
  set Source = file
  set File = bar.msh
end
subsection Concrete
  set Young's modulus = {young}
  set Poisson's ratio = 0
  set Density = {density}
end
subsection Damping
  set Ratio = 0
end
subsection Reservoir
  set Density = 0
end
subsection Statics
  set Self-weight = none
end
subsection Joints
  set Friction = 0
  set Initial gaps = base: {gap}
end
subsection Motion
  set Source = none
  set Duration = {duration}
  set Time step = {step}
end
subsection Dynamics
  set Scheme = {scheme}
  set Explicit step = {explicit}
  set Initial velocity = all: 0 0 -{speed}
end
subsection Output
  set Probes = {probes}
  set Figures = false
  set Envelope interval = 0
  set Frames = 0
  set Checkpoint interval = 0
end
"""


def rebound(simulate, scheme, elements, step, directory):
    """Mean velocity after over before. scheme: trapezoidal with time steps, or explicit with steps, of `step` [s]."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    width = LENGTH / elements
    place = lambda i, j, k: (width * j, width * i, width * k)
    meshes.write(directory / "bar.msh", *meshes.block(place, (1,), 1, elements, {"bottom": 7}))
    time_step = step if scheme == "trapezoidal" else 1e-3
    n = round((GAP / SPEED + 6 * LENGTH / WAVE) / time_step)  # an impact lasts 2 LENGTH / WAVE, with long steps longer
    probes = "; ".join(f"z{k}: 0 0 {width * k}" for k in range(elements + 1))
    scene = directory / "bar.prm"
    scene.write_text(SCENE.format(young=YOUNG, density=DENSITY, gap=GAP, speed=SPEED, scheme=scheme, probes=probes, step=time_step,
                                  duration=max(n, 8) * time_step, explicit=step if scheme == "explicit" else -1))
    simulate(str(scene), "--output", str(directory / "run"), "--overwrite")
    header, *_, last = (line.split(",") for line in (directory / "run" / "history.csv").read_text().splitlines())
    velocity = [float(last[header.index(f"z{k}_velocity_z")]) for k in range(elements + 1)]
    return (sum(velocity) - .5 * (velocity[0] + velocity[-1])) / elements / SPEED


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_program_argument(parser)
    simulate = partial(run, parser.parse_args().voussoir)
    meshes_of_table, found = (4, 16, 64), {}
    print("| scheme | step | " + " | ".join(f"{n} elements" for n in meshes_of_table) + " |\n|---|---|" + "---|" * len(meshes_of_table))
    with tempfile.TemporaryDirectory() as directory:
        for scheme, steps in (("trapezoidal", (10e-3, 5e-3, 2.5e-3, 1.25e-3, .5e-3, .1e-3)), ("explicit", (.95, .5, .25))):
            for step in steps:
                row = []
                for n in meshes_of_table:
                    row.append(rebound(simulate, scheme, n, step if scheme == "trapezoidal" else step * LENGTH / n / WAVE, directory))
                name = f"{1e3 * step:g} ms" if scheme == "trapezoidal" else f"{step:g} h/c"
                print(f"| {scheme} | {name} | " + " | ".join(f"{x:.3f}" for x in row) + " |", flush=True)
                found[scheme] = row[-1]
    return int(min(found.values()) < .97)


if __name__ == "__main__":
    sys.exit(main())
