#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The trial of a consistent mass inside the monoliths and a lumped one at the joints' nodes: frequencies, and error of openings
and tension on three meshes, against the lumped mass.

    git apply benchmarks/mass_trial.patch     (fits the sources of version 0.3.0 only), build, then
    benchmarks/mass_trial.py [--seconds 3] [--voussoir PROGRAM]

The patched program takes from the environment which share of the consistent mass it adds and of the lumped one it leaves out:
TRIAL_MASS of the concrete, TRIAL_WATER of the added mass. Degree 1 and rigid base only. References: 120 x 32 x 6 elements at
2.5 ms with either mass; for the frequencies of the tied dam 90 x 24 x 4 elements with the mean of both. Prints Markdown tables."""

import argparse
import os
import sys
import tempfile

import numpy as np

from choices import RIGID, STEPS, Runs, error, mesh, name
from program import add_program_argument, frequencies

MASSES = {"lumped": {}, "consistent, water lumped": {"TRIAL_MASS": "1"}, "consistent": {"TRIAL_MASS": "1", "TRIAL_WATER": "1"},
          "mean of both": {"TRIAL_MASS": ".5", "TRIAL_WATER": ".5"}}
MESHES = [(30, 8, 1), (60, 16, 2), (60, 20, 3)]
MEAN = "mean of both"


def choose(mass):
    for variable in ("TRIAL_MASS", "TRIAL_WATER"):
        os.environ.pop(variable, None)
    os.environ.update(MASSES[mass])


def modes(options):
    choose(MEAN)
    best = np.array(frequencies(options.voussoir, RIGID, 6, mesh(90, 24, 4))[0])
    print("| elements | mass | error of six frequencies |\n|---|---|---|")
    for sizes in MESHES[:2]:
        for mass in MASSES:
            choose(mass)
            values = np.array(frequencies(options.voussoir, RIGID, 6, mesh(*sizes))[0])
            print(f"| {name(sizes)} | {mass} | " + " ".join(f"{x:+.2f}" for x in 100 * (values / best - 1)) + " % |", flush=True)


def shaking(options):
    with tempfile.TemporaryDirectory() as directory:
        runs, references = Runs(options, RIGID, {}, directory), []
        for mass in ("lumped", MEAN):
            choose(mass)
            references.append(runs.measure({**mesh(120, 32, 6), STEPS: 4}))
        print("\n| elements, step | mass | openings | tension | against the mean mass | | energy account |\n" + "|---" * 7 + "|")
        for sizes in MESHES:
            for n in (2, 4):
                for mass in MASSES:
                    choose(mass)
                    *measures, summary = runs.measure({**mesh(*sizes), STEPS: n})
                    errors = [error(measures[k], r[k]) for r in references for k in (0, 1)]
                    print(f"| {name(sizes)}, {10 / n:g} ms | {mass} | " + " | ".join(f"{100 * e:.2g} %" for e in errors)
                          + f" | {summary['energy_balance_error']:.0e} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_program_argument(parser)
    parser.add_argument("--seconds", type=float, default=3)
    options = parser.parse_args()
    modes(options)
    shaking(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
