#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scaling on paper: how fast four sizes of dam and rock would run on 1 to 1,000 nodes, from costs measured on this machine.

Usage: benchmarks/scaling.py --measure [--voussoir build/voussoir] [--messages build/benchmark_messages]
       benchmarks/scaling.py [--output doc/figures/scaling.png]
The first writes doc/scaling.json: the stages of rigid28 and rock28 on one rank and one thread, messages and their cost on two ranks.
The second prints tables from it, which doc/performance.md quotes, with one and with 48 threads per rank, and draws the figure.
The network, the larger sizes and the memory are not measured.
"""
import argparse
import json
import math
import os
import re
import subprocess
import tempfile

from ranks import ROOT, run

COSTS = os.path.join(ROOT, "doc", "scaling.json")
CORES = 48                              # of a node
# Between nodes: InfiniBand HDR, 200 Gbit/s per node shared by its processes; latency of 1 byte as published for Azure HBv3
# (Microsoft, "HBv3-series performance") [s, bytes/s]
LATENCY, BANDWIDTH = 1.2e-6, 25e9
MONOLITHS = 29
# Name, unknowns of the dam and of the rock, step of the dam [s], steps of the rock in one of the dam.
SIZES = (("rock28", 16443., 338520., .005, 3), ("1.1 M, 30 M", 1.1e6, 30e6, .002, 4),
         ("1.1 M, 90 M", 1.1e6, 90e6, .001, 4), ("5 M, 300 M", 5e6, 300e6, .001, 4))


def measure(arguments):
    costs = {}
    with tempfile.TemporaryDirectory() as directory:
        for name in ("rigid28", "rock28"):
            scene = os.path.join(ROOT, "prm", f"{name}.prm")
            one = run(arguments.voussoir, scene, ["Motion/Duration=4"], f"{directory}/{name}")
            two = run(arguments.voussoir, scene, ["Motion/Duration=4"], f"{directory}/{name}_2", ranks=2)
            costs[name] = {"dam": one["mesh"]["dofs"], "rock_dofs": one.get("rock", {}).get("dofs", 0),
                           "messages": max(two["per_rank"]["messages_per_step"]),
                           "rock_steps": round(one["time_step"] / one["rock"]["time_step"]) if "rock" in one else 0,
                           "krylov": one["newton_iterations"]["linear_iterations_mean"], "pairs": one["mesh"]["pairs"],
                           **{stage if stage != "rock" else "rock_seconds": one["seconds"][stage] / one["steps"]
                              for stage in ("substitutions", "joints", "stepping", "rock", "stresses", "output")}}
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    text = subprocess.run(["mpirun", "-np", "2", arguments.messages], check=True, capture_output=True, text=True,
                          env=environment).stdout
    rows = [[float(x) for x in row] for row in re.findall(r"\| (\d+) \| ([\d.]+) \| ([\d.]+) \|", text)]
    costs["latency"] = 1e-6 * rows[0][1]
    costs["bandwidth"] = 8e6 * rows[-1][0] / rows[-1][1]
    with open(COSTS, "w", encoding="utf-8") as file:
        json.dump(costs, file, indent=1)
        file.write("\n")
    print(f"{COSTS} written")


def seconds_per_second(costs, size, cores, threads=1):
    """Returns the wall times per second of earthquake: dam, rock, work that every rank repeats (by one of its threads), messages. All cores are
    assumed to be equally efficient, whether they run ranks or threads."""
    ranks = math.ceil(cores / threads)
    _, dam, rock, step, substeps = size
    rock_costs = costs["rock28"]
    dam_costs = costs["rigid28"] if dam > 2. * rock_costs["dam"] else rock_costs
    ratio = dam / dam_costs["dam"]
    # The time of the joints and of the substitutions grows with N^1.31 as measured to 135 thousand unknowns.
    growth = ratio**1.31 if dam < 135e3 else (135e3 / dam_costs["dam"])**1.31 * (dam / 135e3)**1.55
    shared = (dam_costs["substitutions"] + dam_costs["joints"]) * growth + dam_costs["stresses"] * ratio
    on_dam = min(cores, MONOLITHS)
    alike = (dam_costs["stepping"] + dam_costs["output"]) * ratio
    of_rock = rock_costs["rock_seconds"] * rock / rock_costs["rock_dofs"] * substeps / rock_costs["rock_steps"] / cores
    nodes = max(1, math.ceil(cores / CORES))
    latency, bandwidth = (costs["latency"], costs["bandwidth"]) if nodes == 1 else (max(LATENCY, costs["latency"]), BANDWIDTH)
    hops = math.log2(ranks) if ranks > 1 else 0.
    pairs = dam_costs["pairs"] * ratio**(2 / 3)
    gathered = 16. * dam + 3 * pairs * (8. * 8. + 2 * 4. * 8.)  # u and K u; forces, and the vectors of GMRES
    surface = 2 * 24. * (rock / 3 / ranks)**(2 / 3) * substeps if ranks > 1 else 0.
    sharing = 1 if nodes == 1 else CORES / threads  # processes with the connection of a node
    messages = rock_costs["messages"] * latency * hops + ((gathered if ranks > 1 else 0.) + surface) * sharing / bandwidth
    return [x / step for x in (shared / on_dam, of_rock, alike, messages)]


def memory_per_rank(size, ranks):
    """Returns the memory of the first rank and of another rank, peak [GiB]. Rock: see memory_need.cc. Dam: fits the table of doc/performance.md to 8 %."""
    _, dam, rock, _, _ = size
    matrix = 19 * 76.                           # of a rock node: blocks with column numbers [bytes]
    kept = min(1., 1. / ranks + .13)
    coarse = 900.                               # of the static state, on the first rank [bytes per rock node]
    of_node = 2100. - (1. - kept) * matrix + (.15 + .4 / ranks) * matrix + ranks / 8.  # RockSplit has a bit per rank and node
    first = .17 + .2 * (dam / 54180)**1.3 / min(ranks, MONOLITHS) + (5500. * dam + (of_node + coarse) * rock) / 3 / 2**30
    return first, first - (coarse + (.05 + .4 / ranks) * matrix) * rock / 3 / 2**30


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--measure", action="store_true")
    parser.add_argument("--voussoir", default=os.path.join(ROOT, "build", "voussoir"))
    parser.add_argument("--messages", default=os.path.join(ROOT, "build", "benchmark_messages"))
    parser.add_argument("--output", default=os.path.join(ROOT, "doc", "figures", "scaling.png"))
    arguments = parser.parse_args()
    if arguments.measure:
        return measure(arguments)
    with open(COSTS, encoding="utf-8") as file:
        costs = json.load(file)
    ranks = sorted([1, 2, 4, 8, 16, 32, 64, 256, 1024] + [CORES * n for n in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)])
    print("| size | cores | threads per rank | nodes | s per s | dam | rock | all alike | messages | memory of the first rank, of its node [GiB] |\n|"
          + "---|" * 10)
    curves = {}
    for size in SIZES:
        for n, threads in [(n, 1) for n in ranks] + [(n, CORES) for n in ranks if n % CORES == 0]:
            parts = seconds_per_second(costs, size, n, threads)
            curves.setdefault((size[0], threads), []).append((n, sum(parts)))
            if n in (1, 4, 32, CORES, 64, 240, 256, 960, 1024, 10 * CORES, 100 * CORES, 1000 * CORES):
                first, other = memory_per_rank(size, math.ceil(n / threads))
                computer = first + other * (math.ceil(min(n, CORES) / threads) - 1)
                print(f"| {size[0]} | {n} | {threads} | {max(1, math.ceil(n / CORES))} | {sum(parts):.3g} | "
                      + " | ".join(f"{x:.2g}" for x in parts) + f" | {first:.3g}, {computer:.3g} |")
    print("\nWeak scaling: rock of 10 thousand unknowns per rank, the dam of rock28, s per s:",
          ", ".join(f"{n} ranks {sum(seconds_per_second(costs, ('', 16443., 1e4 * n, .005, 3), n)):.2g}" for n in (1, 48, 480, 4800)))
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for size, colour in zip(SIZES, ("#1b6ca8", "#c8553d", "#8b5fa8", "#3a7d44")):
        first = curves[size[0], 1][0][1]
        axes.loglog(*zip(*curves[size[0], 1]), "o-", color=colour, markersize=3.5, label=size[0])
        axes.loglog(*zip(*curves[size[0], CORES]), "--", color=colour, linewidth=1.2)
        axes.loglog([1, 48000], [first, first / 48000], ":", color=colour, linewidth=.8)
    axes.axvline(MONOLITHS, color="grey", linewidth=.8)
    axes.text(MONOLITHS * 1.15, .97, "one monolith\nper core", fontsize=8, color="grey", va="top", transform=axes.get_xaxis_transform())
    axes.set(xlabel="cores (48 to a node)", ylabel="wall time per second of earthquake [s]",
             ylim=(1e-3, None), title="Calculated; dashed: one rank per node; dotted: ideal")
    axes.legend(title="dam, rock: unknowns", frameon=False, loc="lower left", ncol=2, fontsize=9)
    figure.savefig(arguments.output, dpi=150)


if __name__ == "__main__":
    main()
