#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program: a run that is stopped after its first checkpoint and resumed has the tables of an uninterrupted run, to the bit.

    program_resume.py VOUSSOIR CASE...     cases: the names in CASES
"""

import signal
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
import meshes
import program_base
import program_gaps
import program_wedges
from program_cohesive import SHORT, cohesive
from program_lift import LIFTS
from program_massless import MASSLESS, SUSTAINED
from program_subcycling import OWN
from program_ranks import launcher, on_ranks
from run_program import expect, refused, run_cases, runs, same_to_the_bit, settings, stopped, summary, write_scene

KILLED, ASKED = signal.SIGKILL, signal.SIGTERM  # with the checkpoint of the interval, or with one of the last step
EXPLICIT = settings("Dynamics/Scheme=explicit", "Damping/Model=uniform")
ROCK = settings("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60", "Motion/Time step=0.002")


def every(interval, *entries):
    return settings(f"Output/Checkpoint interval={interval}", *entries)


def asked(interval, *entries):
    """A run that is asked to stop looks for it whenever it reports."""
    return every(interval, "Output/Progress interval=10", *entries)


def plain(law, factors):
    return every(40, "Motion/Duration=3", "Output/Solution interval=100", f"Joints/Model={law}", f"Dynamics/Factors={factors}")


def files_and_changes(_, whole, killed, chosen):
    """Refusals, other files than the tables, and entries of the output, which may change."""
    refused(["scene.prm", "--output", "nothing", *chosen, "--resume"], "nothing/checkpoint.bin", "--resume")
    scene = Path(killed, "scene.prm").read_bytes()
    refused(["scene.prm", "--output", killed, *chosen, "--resume", "--set", "Joints/Friction=0.7"], "checkpoint", "another scene")
    expect(Path(killed, "scene.prm").read_bytes() == scene, "a refused run must not overwrite scene.prm")
    expect("Resumed" in runs("scene.prm", "--output", killed, *chosen, "--resume", "--set", "Output/Progress interval=10"), "--resume")
    for name in ("solution.pvd", "frames.bin"):
        expect(Path(killed, name).read_bytes() == Path(whole, name).read_bytes(), name)
    found = summary(killed)
    expect(found["steps"] == summary(whole)["steps"] == 300, "steps of the resumed run")
    limit = 1e-9 if "Dynamics/Factors=double" in chosen else 3e-8
    expect(found["energy_balance_error"] < limit, "energy balance of the resumed run")


def elastic_base(shown, whole, *_):
    expect("4 base joints" in shown, shown[:800])
    expect(summary(whole)["energy_balance_error"] < 1e-9, f"energy balance of {whole}")


def two_threads(_, whole, killed, chosen):
    runs("scene.prm", "--output", f"{whole}_threads", *chosen, environment={"OMP_NUM_THREADS": "2"})
    same_to_the_bit(whole, f"{whole}_threads")


def two_ranks(_, whole, killed, chosen):
    launcher(2)
    status, _, message = on_ranks(2, "scene.prm", "--output", f"{whole}_two", *chosen)
    expect(status == 0, message)
    same_to_the_bit(f"{whole}_two", whole)


def wedges(which):
    return [*program_wedges.write_wedges(), *every(20, "Motion/Duration=0.4", *program_wedges.RUNS[which])]


def zoned(*entries):
    meshes.zoned_arch("zoned.msh", (1, 1, 2, 2), 1, 3)
    return asked(20, "Mesh/Source=file", "Mesh/File=zoned.msh", "Reservoir/Water level=50", "Damping/Model=uniform", "Damping/Zones=heel: 0.08, crown: 0.02", "Motion/Duration=1", *entries)


BASE, GAPS = [*program_base.ARCH, *program_base.BASE], program_gaps.ARCH
# case -> rows (settings or a function that returns them; signal; further check before --resume, or None)
CASES = {
    "plain": [(plain("KSM", "double"), KILLED, files_and_changes), (plain("FJA", "double"), KILLED, files_and_changes),
              (plain("FJA", "single"), KILLED, files_and_changes)],
    "subcycling": [([*OWN, *every(20, f"Joints/Model={law}")], KILLED, None) for law in ("tied", "FJA")],
    "massless": [([*MASSLESS, *every(20, "Joints/Model=FJA", *SUSTAINED)], KILLED, None)],
    "cohesive": [([*SHORT, *cohesive("1 MPa", "300"), *asked(20)], KILLED, None)],
    "base": [([*BASE, *asked(20, "Joints/Normal stiffness=1e11", "Joints/Adhesion=1 MPa", "Motion/Duration=1.5")], ASKED, elastic_base),
             ([*BASE, *asked(20, "Foundation/Model=massless", "Mesh/Arch210/Lift joints=1", "Motion/Duration=1.5")], ASKED, elastic_base)],
    "lift": [([*program_base.ARCH, *LIFTS, *asked(20, "Motion/Duration=0.6")], ASKED, two_threads)],
    "gaps": [([*GAPS, *asked(10, "Mesh/Arch210/Elements through=2")], ASKED, None)],
    "blocks": [(every(20, "Motion/Duration=0.4", "Limits/Base friction=1"), KILLED, None),
               ([*every(20, "Motion/Duration=0.4", "Limits/Base friction=1"), *ROCK], KILLED, None)],
    "damping": [(every(20, "Damping/Model=uniform", f"Joints/Model={law}", "Motion/Duration=1"), KILLED, two_ranks) for law in ("FJA", "KSM")]
    + [(lambda: zoned("Dynamics/Factors=single"), KILLED, two_ranks), (lambda: zoned("Dynamics/Scheme=explicit"), ASKED, two_threads)],
    "explicit": [([*EXPLICIT, *asked(20, f"Joints/Model={law}", "Motion/Duration=1.5")], ASKED, two_threads) for law in ("FJA", "KSM", "cohesive")]
    + [([*EXPLICIT, *program_base.ARCH, *LIFTS, *asked(20, "Motion/Duration=0.6")], ASKED, two_threads)]
    + [([*EXPLICIT, *ROCK, *asked(20, f"Foundation/Model={model}", "Motion/Duration=0.5")], ASKED, two_threads) for model in ("massless", "rock")]
    + [([*EXPLICIT, *asked(20, "Motion/Duration=0.5", "Reservoir/Model=acoustic", *more)], ASKED, two_threads)
       for more in ((), ("Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60"))],
    "wedges": [(lambda: wedges("rigid"), KILLED, two_ranks), (lambda: wedges("rock"), KILLED, two_ranks)],
}


def case_of(name):
    def case():
        write_scene()
        for i, (chosen, sent, check) in enumerate(CASES[name]):
            chosen, whole, killed = chosen() if callable(chosen) else chosen, f"whole_{i}", f"killed_{i}"
            shown = runs("scene.prm", "--output", whole, *chosen)
            stopped(sent, "scene.prm", killed, *chosen)
            if check:
                check(shown, whole, killed, chosen)
            if check != files_and_changes:
                runs("scene.prm", "--output", killed, *chosen, "--resume")
            same_to_the_bit(whole, killed)
            for key in ("extremes", "blocks", "wedges"):
                expect(summary(killed).get(key) == summary(whole).get(key), f"{key} of the resumed run")
    case.__name__ = name
    return case


if __name__ == "__main__":
    run_cases(*map(case_of, CASES))
