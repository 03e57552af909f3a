# SPDX-License-Identifier: GPL-3.0-or-later
"""The output directory of many motions (Motion/Ensemble), made from that of one run: for tests of the report and the figures."""

import csv
import json
import math
import random
import shutil
from pathlib import Path

from voussoir.ensembles import Ensemble

GONE = ("history.csv", "joints.csv", "joint_history.csv", "energy.csv", "blocks.csv", "joint_points.csv", "joint_cells.csv", "joint_pressures.csv",
        "floor_spectra.csv", "frames.bin")


def fractile(values, share):
    """Linear between the sorted values."""
    values, at = sorted(values), share * (len(values) - 1)
    if len(values) == 1:
        return values[0]
    k = min(int(at), len(values) - 2)
    return values[k] + (at - k) * (values[k + 1] - values[k])


def fractiles(values):
    half = .3 / math.sqrt(len(values))
    return {"median": fractile(values, .5), "p16": fractile(values, .16), "p84": fractile(values, .84), "min": min(values), "max": max(values),
            "known_68": half, "known_95": 2. * half, "motions_for_10_percent": 9}


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_rows(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def many_motions(run, target, n=16, factors=(1.,), failed=(), seed=1):
    """Writes the directory @p target; motions @p failed have no result at the largest factor. The first motion is that of the run."""
    run, target, chance = Path(run), Path(target), random.Random(seed)
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(run, target, ignore=lambda _, names: [name for name in names if name in (*GONE, "figures") or name.startswith(("report", "solution"))])
    found = json.loads((run / "summary.json").read_text())
    joints = rows_of(run / "joints.csv") if (run / "joints.csv").exists() else []
    extremes = {name: one["value"] for name, one in found.pop("extremes").items()} | ({"kept_opening": 1e-3} if joints else {})
    spread = [(1., 1.)] + [(chance.lognormvariate(0., .25), chance.lognormvariate(0., .1)) for _ in range(n - 1)]
    rows = []
    for factor in factors:
        for k, (opening, tension) in enumerate(spread, 1):
            row = {"motion": len(rows) + 1, "name": f"seed {k}", "factor": factor, "status": "ok"}
            row |= {name: value * factor * (opening if "opening" in name or "slip" in name else tension) for name, value in extremes.items()}
            if joints and k % 2:
                row["kept_opening"] = 0.
            for quantity in ("opening", "slip"):
                row |= {f"{quantity}_{joint['joint']}": max(float(joint[f"{quantity}_{face}"]) for face in ("upstream", "downstream")) * factor * opening *
                        (chance.uniform(.9, 1.1) if k > 1 else 1.) for joint in joints}
            if k in failed and factor == max(factors):
                row = {name: value if name in ("motion", "name", "factor") else "" for name, value in row.items()} | {"status": "unstable at 3.2 s"}
            rows.append(row)
    write_rows(target / "ensemble.csv", rows)
    of = lambda factor: [row for row in rows if row["factor"] == factor and row["status"] == "ok"]
    statistics = {factor: {"factor": factor, "n": len(of(factor))} | {name: fractiles([row[name] for row in of(factor)]) for name in extremes} for factor in factors}
    main = 1. if 1. in factors else factors[0]
    found["ensemble"] = statistics[main] | {"names": [row["name"] for row in rows], "lanes": 16}
    if len(factors) > 1:
        found["ensemble"]["factors"] = list(statistics.values())
    for name in ("limits", "limits_not_evaluated", "limits_not_judged", "overstress", "waterstop", "residual", "blocks", "accelerations", "energy_balance_error",
                 "contact_residual", "newton_iterations"):
        found.pop(name, None)
    (target / "summary.json").write_text(json.dumps(found))
    if joints:
        columns = {joint["joint"]: {f"{quantity}_{end}": fractile([row[f"{quantity}_{joint['joint']}"] for row in of(main)], share)
                                    for quantity in ("opening", "slip") for end, share in (("p16", .16), ("median", .5), ("p84", .84))} for joint in joints}
        write_rows(target / "ensemble_joints.csv", [{"joint": joint["joint"], "s": joint["s"], **columns[joint["joint"]]} for joint in joints])
    faces = rows_of(run / "faces.csv")
    write_rows(target / "faces.csv", [row | {"max_principal_p16": .9 * float(row["max_principal"]), "max_principal_p84": 1.1 * float(row["max_principal"])}
                                      for row in faces])
    return Ensemble(target, found["ensemble"])
