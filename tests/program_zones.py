#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Zones through the whole program: names in meshes, entries, and waves in layers of rock.

    program_zones.py VOUSSOIR CASE...     cases: see the functions with that name below

Against CalculiX: program_golden.py, case zones."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "golden"))
import meshes  # noqa: E402
from compare import scene  # noqa: E402
from run_program import expect, refused, run_cases, runs, summary, table, write  # noqa: E402

CELLS = ((1, 1, 2, 2), 2, 6)


def names():
    """--validate shows the zones; a mesh that is written and read has the same, and gives the same results."""
    meshes.zoned_arch("names.msh", *CELLS, zones=("Heel_1", "weak crown"))
    zones = {"Zones": "heel 1: 30 GPa 0.2 2500 kg/m^3, Weak-Crown: 12e9 0.1 2200"}
    statics = {"Self-weight": "monolithic"}
    file = scene("names", "names.msh", Concrete=zones, Statics=statics)
    shown = runs(file, "--validate")
    groups = {" ".join(line.split()) for line in shown.replace("Groups", "").splitlines()}
    for name, role, n in (("{}", "", 24), ("{} heel 1", ", zone heel 1", 8), ("{} weak crown", ", zone weak crown", 16)):
        line = f"{name.format('monolith 1')} ... {name.format('monolith 2')} -> monolith 1 to monolith 2{role} {n} hexahedra"
        expect(line in groups, f"no '{line}' in {groups}")
    expect("zone heel 1: 30 GPa, Poisson's ratio 0.2, 2500 kg/m3; " in shown, shown)
    expect("2 monoliths" in shown and "1 joint," in shown, shown)
    for version in ("4.1", "2.2"):
        runs("mesh", file, "--output", f"again{version}.msh", "--format", version)
        again = scene(f"again{version}", f"again{version}.msh", Concrete=zones, Statics=statics)
        expect(runs(again, "--validate").split("Groups")[1].split("Unknowns")[0].lower().replace("_", " ").split()
               == shown.split("Groups")[1].split("Unknowns")[0].lower().replace("_", " ").split(), shown)
    runs(file, "--output", "names")
    runs("again4.1.prm", "--output", "again")
    first, again = summary("names"), summary("again")
    expect(first["zones"].keys() == again["zones"].keys(), f"{first} {again}")
    for a, b in zip(first["static"]["crest_displacement"], again["static"]["crest_displacement"]):  # files have 16 digits
        expect(abs(a - b) < 1e-10 * math.hypot(*first["static"]["crest_displacement"]), f"{first} {again}")
    # Without entry: the section's material, and the log says so.
    shown = runs(scene("plain", "names.msh", Statics=statics), "--output", "plain")
    expect("zone weak crown: not in Concrete/Zones, so as the section" in shown, shown)
    meshes.arch("arch.msh", *CELLS)
    runs(scene("arch", "arch.msh", Statics=statics), "--output", "arch")
    expect(summary("plain")["static"]["crest_displacement"] == summary("arch")["static"]["crest_displacement"], "no zones")
    expect(summary("names")["static"]["crest_displacement"] != summary("arch")["static"]["crest_displacement"], "zones")
    text = Path("names.msh").read_text()
    write("twice.msh", text.replace('"monolith 2 Heel_1"', '"monolith 1 Heel_1"'))
    refused([scene("twice", "twice.msh")], "two physical groups have the name 'monolith 1 Heel_1'")
    write("number.msh", text.replace('"monolith 2 Heel_1"', '"monolith 2 5"'))
    refused([scene("number", "number.msh")], "'monolith 2 5'", "unknown name", "zone")


def layer():
    """A layer of speed 1 and density 1 on rock of 2 and 1.1 moves 2.2 times as far at c/4H as the rock's outcrop would,
    4.4 times as far as the wave that comes in."""
    cell, n_layer, c, rho, dt = 5., 20, 1000., 2000., .0016
    meshes.on_rock("layer.msh", cell, 2, (0, 2), n_layer + 10, 1, None,
                   lambda i, j, k: "weak layer" if k >= -n_layer else "")
    period, size, n = 4 * n_layer * cell / c, .01, 2500
    rise = lambda t: max(0., 1 - max(0., 1 - t / 3 / period)**4) if t > 0 else 0.
    u = [size * rise(k * dt)**4 * math.sin(2 * math.pi * k * dt / period) for k in range(-1, n + 2)]
    write("layer.txt", "".join(f"{k * dt:.7f} 0 0 {(u[k] - 2 * u[k + 1] + u[k + 2]) / dt**2:.12g}\n" for k in range(n + 1)))
    runs(scene("layer", "layer.msh", Concrete={"Young's modulus": 1e9, "Density": 1},
               Motion={"Source": "file", "File": "layer.txt", "Unit": "m/s^2", "Duration": n * dt, "Time step": dt},
               Foundation={"Model": "rock", "Young's modulus": 1.1 * rho * (2 * c)**2, "Poisson's ratio": 0, "Density": 1.1 * rho,
                           "Zones": f"weak layer: {rho * c * c:g} 0 {rho:g}", "Free field": "columns", "Stiffness damping": 0,
                           "Boundary": "viscous"},  # exact for waves along its normal
               Output={"Envelope interval": 0}), "--output", "layer")
    largest = max(abs(r[9]) for r in table("layer/history.csv")[1] if r[0] > n * dt - 2 * period)
    print(f"    base / outcrop {largest / size:.4f}, exact 2.2")
    expect(abs(largest / size / 2.2 - 1) < .005, f"amplification {largest / size}")


def rocks():
    """Three rocks: a weak layer and a fault zone, which crosses the boundary, explicit and massless."""
    fault = lambda i, j, k: "Fault_zone" if 8 <= j < 10 else "weak layer" if k in (-2, -3) else ""
    meshes.on_rock("rocks.msh", 10., 18, (7, 11), 12, 3, 6, fault)
    sine = [math.sin(12 * k * .002) * math.sin(4 * k * .002) for k in range(201)]
    write("rocks.txt", "".join(f"{k * .002:.6f} {a:.9g} {.5 * a:.9g} {.3 * a:.9g}\n" for k, a in enumerate(sine)))
    zones = "fault zone: 2 GPa 0.3 2.2 t/m^3, Weak layer: 4e9 0.28 2400"
    ground = {"Model": "rock", "Young's modulus": 10e9, "Poisson's ratio": .25, "Density": 2600, "Zones": zones}
    parts = {"Motion": {"Source": "file", "File": "rocks.txt", "Unit": "m/s^2", "Duration": .4, "Time step": .002},
             "Concrete": {"Young's modulus": 2e10, "Density": 2400}, "Output": {"Envelope interval": 0}}
    crest = {}
    for name, change in (("sections", {}), ("columns", {"Free field": "columns"}), ("viscous", {"Boundary": "viscous-spring"}),
                         ("unlisted", {"Zones": ""}), ("massless", {"Model": "massless"})):
        shown = runs(scene(name, "rocks.msh", Foundation={**ground, **change}, **parts), "--output", name)
        rock, result = summary(name)["zones"]["rock"], summary(name)
        expect(abs(sum(zone["volume"] for zone in rock.values()) - 180 * 180 * 120) < 1, f"volumes {rock}")
        expect(abs(rock["weak layer"]["volume"] - 160 * 180 * 20) < 1, f"volumes {rock}")
        if name != "unlisted":
            expect("zone fault zone: 2 GPa, Poisson's ratio 0.3, 2200 kg/m3" in shown, shown)
            expect(rock["weak layer"]["young"] == 4e9 and rock["(no zone)"]["young"] == 10e9, f"{rock}")
        else:
            expect("zone weak layer: not in Foundation/Zones" in shown, shown)
        if name != "massless":
            expect(result["rock"]["energy_balance_error"] < 1e-6, f"balance {result['rock']}")
        crest[name] = [r[1] for r in table(f"{name}/history.csv")[1]]
    size = max(map(abs, crest["sections"]))
    for name in ("viscous", "unlisted"):
        distance = max(abs(a - b) for a, b in zip(crest[name], crest["sections"])) / size
        print(f"    crest, {name} against sections: {distance:.2g} of its peak")
        expect((distance > .1) == (name == "unlisted"), f"{name}: {distance}")
    # Massless rock: the softer, the more the dam leans under water.
    lean = {}
    for name, change in (("soft", {}), ("hard", {"Zones": ""})):
        runs(scene(name, "rocks.msh", Foundation={**ground, **change, "Model": "massless"}, Concrete=parts["Concrete"],
                   Reservoir={"Water level": 30, "Density": 1000}), "--output", name)
        lean[name] = summary(name)["static"]["crest_displacement"][0]
    expect(lean["soft"] > 1.3 * lean["hard"] > 0, f"{lean}")
    # A layer among those that the boundary needs alike; a high Poisson's ratio; a zone that is not there.
    meshes.on_rock("low.msh", 10., 18, (7, 11), 12, 3, 6, lambda i, j, k: "weak layer" if k == -9 else "")
    low = {**ground, "Zones": "weak layer: 4e9 0.28 2400"}
    refused([scene("low", "low.msh", Foundation=low, **parts)], "the material changes from 'rock' to 'rock weak layer'", "layer 4")
    runs(scene("alike", "low.msh", Foundation={**ground, "Zones": ""}, **parts), "--validate")
    # Undamped rock of a high Poisson's ratio is stable with 0.6, and grows with 0.96 of the critical time step.
    undamped = {**ground, "Stiffness damping": 0, "Zones": "weak layer: 4e9 0.45 2400"}
    runs(scene("far", "rocks.msh", Foundation=undamped, **parts), "--validate")
    longer = {**parts, "Motion": {**parts["Motion"], "Time step": .0032, "Duration": .32}}
    refused([scene("poisson", "rocks.msh", Foundation=undamped, **longer)],
            "Poisson's ratio is 0.45", "Foundation/Zones", "grows by 1.1", "at least 6.4e-05 s")
    runs(scene("damped", "rocks.msh", Foundation={**undamped, "Stiffness damping": 6.4e-5}, **longer), "--validate")
    refused([scene("too_high", "rocks.msh", Foundation={**ground, "Zones": "weak layer: 4e9 0.46 2400"}, **parts)],
            "Foundation/Zones", "Poisson's ratio", "from 0 to 0.45")
    refused([scene("missing", "rocks.msh", Foundation={**ground, "Zones": "weak leyer: 4e9 0.3 2400"}, **parts)],
            "Foundation/Zones", "Did you mean \"weak layer\"?")


if __name__ == "__main__":
    run_cases(names, layer, rocks)
