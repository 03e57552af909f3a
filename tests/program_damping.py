#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: uniform damping, and the entries of section Damping.

    program_damping.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import re

from program_ranks import on_ranks
from program_watch import settings
from run_program import expect, interrupted, refused, run_cases, runs, same, same_to_the_bit, summary, voussoir, write_scene

UNIFORM = settings("Damping/Model=uniform", "Motion/Duration=0.5", "Output/Figures=false", "Dynamics/Factors=double")
ROCK = ("Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60")


def foundations():
    """The energy balance closes on each foundation, with open and with tied joints."""
    write_scene()
    for model in ("rigid", "massless", "rock"):
        for law in ("FJA", "KSM", "tied"):
            directory = f"{model}_{law}"
            more = (*ROCK, "Dynamics/Steps per sample=4") if model != "rigid" else ()
            runs("scene.prm", "--output", directory, *UNIFORM, *settings(f"Foundation/Model={model}", f"Joints/Model={law}", *more))
            error = summary(directory)["energy_balance_error"]
            print(f"    {model}, {law}: error of the energy balance {error:.1e}")
            expect(error < 1e-10, f"energy balance on {model}, {law}: {error}")


def same_bits():
    """A resumed run, and a run on two processes: the same bits."""
    write_scene()
    runs("scene.prm", "--output", "whole", *UNIFORM)
    more = settings("Motion/Duration=3", "Output/Checkpoint interval=40", "Dynamics/Factors=single")
    runs("scene.prm", "--output", "long", *UNIFORM, *more)
    interrupted("scene.prm", "stopped", *UNIFORM, *more)
    expect("Resumed" in runs("scene.prm", "--output", "stopped", *UNIFORM, *more, "--resume"), "--resume")
    same_to_the_bit("long", "stopped")
    status, _, message = on_ranks(2, "scene.prm", "--output", "ranks", *UNIFORM)
    expect(status == 0, message)
    same_to_the_bit("whole", "ranks")


def entries():
    """No ratio is no damping. Coefficients are those of the ratio. Entries without effect, and invalid ones."""
    write_scene()
    short = settings("Motion/Duration=0.2", "Output/Figures=false")
    for directory, model in (("none", "Rayleigh"), ("uniform", "uniform")):
        runs("scene.prm", "--output", directory, *short, *settings("Damping/Ratio=0", f"Damping/Model={model}"))
    same_to_the_bit("none", "uniform")
    runs("scene.prm", "--output", "ratio", *short)
    damping = json.loads(voussoir("scene.prm", "--validate", "--json").stdout)["damping"]
    given = settings(*(f"Damping/{name} coefficient={damping[key]!r}" for name, key in (("Mass", "mass_factor"), ("Stiffness", "stiffness_factor"))))
    runs("scene.prm", "--output", "coefficients", *short, *given)
    same("ratio", "coefficients", 1e-8, ("history",))
    warned = voussoir("scene.prm", "--validate", *settings("Damping/Model=uniform", "Damping/Frequency 1=2")).stdout
    expect("Damping/Frequency 1" in warned and "no effect: Damping/Model is uniform" in warned, warned)
    warned = voussoir("scene.prm", "--validate", *settings("Damping/Model=uniform", "Damping/Terms=1")).stdout
    expect('Increase "Damping/Terms"' in warned, warned)
    for words, *parts in ((["Damping/Mass coefficient=1"], "together"),
                          (["Damping/Model=uniform", "Damping/Band end=0.4"], "Band begin", "0.4"),
                          (["Damping/Model=uniform", "Damping/Ratio=0.5"], "Damping/Ratio", "0.25"),
                          (["Damping/Model=uniform", "Damping/Reference frequency=-2"], "Reference frequency"),
                          (["Damping/Model=uniform", "Foundation/Model=massless", "Dynamics/Impact=paper", *ROCK], "mean-force")):
        refused(["scene.prm", "--validate", *settings(*words)], *parts)


def modes():
    """Ratios of the tied dam and of the highest monolith between open joints."""
    write_scene()
    for model, tied, free in (("uniform", (.048, .052), (.048, .052)), ("Rayleigh", (.03, .05), (.05, .2))):
        found = json.loads(runs("modes", "scene.prm", "--count", "3", "--json", *settings(f"Damping/Model={model}")))
        monolith = found["free_monolith"]
        print(f"    {model}: {[mode['damping'] for mode in found['modes']]}, {monolith}")
        expect(all(tied[0] < mode["damping"] < tied[1] for mode in found["modes"]), f"{model}: ratios of the tied dam")
        expect(free[0] < monolith["damping"][0] < free[1], f"{model}: ratio of the free monolith")
        expect(monolith["frequencies"][0] < .8 * found["modes"][0]["frequency"], "a free monolith is softer than the arch")
    text = voussoir("modes", "scene.prm", "--count", "2", *settings("Damping/Frequency 1=4"))
    expect(re.search("between open joints has a damping ratio of", text.stderr), text.stderr)
    tied = runs("modes", "scene.prm", *settings("Joints/Model=tied"))
    expect("between open joints" not in tied, "a tied dam has no free monolith")


if __name__ == "__main__":
    run_cases(foundations, same_bits, entries, modes)
