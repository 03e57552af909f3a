#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory a run needs: what --validate says, what it takes, and what is said when there is not so much.

    program_memory.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import json
import re
import resource
import subprocess
import sys
from pathlib import Path

import run_program
from run_program import expect, run_cases, runs, summary, write

run_program.Server.library = ""  # a whole process is measured
GIB = 2**30
SCENE = """
subsection Mesh
  subsection Arch210
    set Joints = {joints}
    set Elements along = {along}
    set Elements up = {up}
    set Elements through = {through}
    {rock}
  end
end
subsection Motion
  set Duration = 0.2
  set Time step = 0.01
end
subsection Output
  set Figures = false
end
{more}
"""
ROCK = "subsection Rock\n set Enabled = true\n set Element size = 30\n end"
MASSLESS = "subsection Foundation\n set Model = massless\n end\n subsection Elements\n set Degree = 2\n end"
ON_ROCK = "subsection Foundation\n set Model = rock\n end\n subsection Dynamics\n set Steps per sample = 5\n end"


def scene(name, joints, along, up, through, rock="", more=""):
    return write(f"{name}.prm", SCENE.format(joints=joints, along=along, up=up, through=through, rock=rock, more=more))


def estimate(text):
    """Of a run, and more for each halving [bytes]."""
    found = re.search(r"about ([\d.]+) GiB, and ([\d.]+) GiB more for each divided time step", text)
    expect(found, f"no estimate in {text}")
    return [float(x) * GIB for x in found.groups()]


def estimates():
    """To a fifth: joints, tied, with factors in double precision, elements of degree 2, on rock, on
    massless rock of degree 2."""
    for name, file in (("joints", scene("joints", 5, 60, 16, 2)), ("tied", scene("tied", 0, 60, 16, 3)),
                       ("double", scene("double", 0, 90, 32, 5, more="subsection Dynamics\n set Factors = double\n end")),
                       ("quadratic", scene("quadratic", 5, 30, 8, 1, more="subsection Elements\n set Degree = 2\n end")),
                       ("water", scene("water", 5, 60, 16, 2, more="subsection Reservoir\n set Model = acoustic\n set Element size = 16\n end")),
                       ("rock", scene("rock", 5, 30, 10, 1, ROCK, ON_ROCK)),
                       ("massless", scene("massless", 5, 20, 6, 1, ROCK.replace("30", "100"), MASSLESS))):
        run, halved = estimate(runs(file, "--validate"))
        runs(file, "--output", name)
        taken = summary(name)["memory_bytes"]
        print(f"    {name}: estimate {run / GIB:.2f} GiB, taken {taken / GIB:.2f} GiB, ratio {run / taken:.2f}; halved {halved / GIB:.2f}")
        expect(.8 < run / taken < 1.2, f"{name}: estimate {run}, taken {taken}")


def water():
    """The part of compressible water in the estimate is between half and twice the part that it takes."""
    sizes = []
    for model in ("Westergaard", "acoustic"):
        file = scene(model, 5, 60, 16, 2, more=f"subsection Reservoir\n set Model = {model}\n set Element size = 7\n end\n"
                                               "subsection Dynamics\n set Steps per sample = 5\n end")
        sizes.append((json.loads(runs(file, "--validate", "--json"))["memory_bytes"]["run"], (runs(file, "--output", model), summary(model)["memory_bytes"])[1]))
    (run, taken), (wet_run, wet_taken) = sizes
    print(f"    compressible water: estimate {(wet_run - run) / 2**20:.0f} MiB, taken {(wet_taken - taken) / 2**20:.0f} MiB")
    expect(wet_taken - taken > 2e7 and .5 < (wet_run - run) / (wet_taken - taken) < 2, f"{sizes}")


def shortage():
    """Too little memory ends the run with status 1 and the estimate."""
    file = scene("large", 5, 120, 80, 4)
    run, _ = estimate(runs(file, "--validate"))
    limit = int(.8 * GIB)
    result = subprocess.run([run_program.VOUSSOIR, file, "--output", "large"], capture_output=True, text=True, timeout=120,
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
    expect(run > limit, f"the scene is too small: {run}")
    expect(result.returncode == 1 and result.stderr.startswith("voussoir: failed: There is not enough memory: this scene needs"),
           f"status {result.returncode}: {result.stderr}")
    expect(estimate(result.stderr)[0] == run, f"{result.stderr}")
    expect(not Path("large", "summary.json").exists(), "it has results")


if __name__ == "__main__":
    run_cases(estimates, water, shortage)
