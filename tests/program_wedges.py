#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the sliding safety of rock wedges: wedges.csv, summary.json, log, limits and report.

    program_wedges.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
from pathlib import Path

from program_blocks import blocks, force
from run_program import expect, refused, reports, run_cases, runs, settings, summary, table, write, write_scene

COARSE = Path(__file__).resolve().parent.parent / "prm" / "coarse.prm"
HEAD = "wedge, plane, x [m], y [m], z [m], dip [deg], dip direction [deg], area [m2], friction, cohesion [Pa], uplift [Pa], volume [m3], density [kg/m3]\n"
PLANES = {  # wedge: planes as (name, point, dip, dip direction, area, tan(phi), cohesion, uplift), volume, density
    "whole": ([("under", (0, 0, -50), 0, 0, 3e4, 1., 0., 1e5)], 2e6, 2600),
    "right": ([("middle", (0, 0, 0), 90, -90, 2e3, .5, 0., 0.), ("foot", (0, 0, -30), 35, 20, 5e3, .7, 3e5, 2e5)], 8e5, 2600),
    "left": ([("middle", (0, 0, 0), 90, 90, 2e3, .5, 0., 0.), ("foot", (0, 0, -30), 25, -30, 5e3, .6, 2e5, 2e5),
              ("back", (-80, 0, 0), 80, 0, 1e3, .5, 0., 4e5)], 6e5, 2500),
    "bounded": ([("under", (0, 0, -50), 0, 0, 3e4, 1., 0., 1e5), ("end", (0, 0, 0), 90, 90, 0., 0., 0., 0.)], 2e6, 2600)}
RUNS = {"rigid": [], "tied": ["Joints/Model=tied"],
        "massless": ["Foundation/Model=massless", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60"],
        "rock": ["Foundation/Model=rock", "Mesh/Arch210/Rock/Enabled=true", "Mesh/Arch210/Rock/Element size=60", "Motion/Time step=0.002"]}


def write_wedges(name="wedges.csv", wedges=None):
    lines = [HEAD]
    for wedge, (planes, volume, density) in (wedges or PLANES).items():
        for k, (plane, point, dip, direction, *values) in enumerate(planes):
            rock = [volume, density] if k == 0 else ["", ""]
            lines.append(", ".join(map(str, [wedge, plane, *point, dip, direction, *values, *rock])) + "\n")
    write(name, "".join(lines))
    return settings(f"Limits/Wedges={name}")


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def wedges(name):
    """wedges.csv: of each time the time, and by wedge the force of the dam, the acceleration, the mode and the safety."""
    names, rows = table(f"{name}/wedges.csv")
    of = [dict(zip(names, row)) for row in rows]
    kinds = [name.removeprefix("safety_") for name in names if name.startswith("safety_")]
    expect(len(names) == 1 + 8 * len(kinds), f"{names}")
    return [(row["time"], {w: ([row[f"force_{c}_{w}"] for c in "xyz"], [row[f"acceleration_{c}_{w}"] for c in "xyz"],
                               row[f"mode_{w}"], row[f"safety_{w}"]) for w in kinds}) for row in of]


def normal(dip, direction):
    dip, direction = math.radians(dip), math.radians(direction)
    return math.sin(dip) * math.cos(direction), math.sin(dip) * math.sin(direction), math.cos(dip)


def solved(rows, right):
    """Solution of up to three equations, by Cramer's rule."""
    def det(m):
        return m[0][0] if len(m) == 1 else sum((-1)**j * m[0][j] * det([r[:j] + r[j + 1:] for r in m[1:]]) for j in range(len(m)))
    return [det([row[:j] + [x] + row[j + 1:] for row, x in zip(rows, right)]) / det(rows) for j in range(len(rows))]


def safety(wedge, dam, acceleration, mode, gravity=9.81):
    """Safety in this mode, and the least of its compressions and opening forces, from the numbers of the table."""
    planes, volume, density = [plane for plane in PLANES[wedge][0] if plane[4] > 0.], *PLANES[wedge][1:]
    normals = [normal(*plane[2:4]) for plane in planes]
    mass = volume * density
    total = [f - mass * a for f, a in zip(dam, acceleration)]
    total[2] -= mass * gravity
    for n, plane in zip(normals, planes):
        total = [t + plane[7] * plane[4] * x for t, x in zip(total, n)]
    contact = [int(digit) - 1 for digit in str(int(mode)) if digit != "0"]
    N = solved([[dot(normals[i], normals[j]) for j in contact] for i in contact], [-dot(normals[i], total) for i in contact]) if contact else []
    drive = list(total)
    for i, compression in zip(contact, N):
        drive = [d + compression * x for d, x in zip(drive, normals[i])]
    least = min([*N, *(dot(drive, n) for i, n in enumerate(normals) if i not in contact)])
    if not contact or len(contact) == 3:
        return (math.inf if contact else 0.), least
    return sum(planes[i][5] * x + planes[i][6] * planes[i][4] for i, x in zip(contact, N)) / math.hypot(*drive), least


def check_run(name):
    """The force on the whole base is that of the monoliths; both halves sum to it; modes and safeties by hand."""
    bases, found = summary(name)["blocks"], wedges(name)
    worst = halves = of_safety = 0.
    for (time, of), (at, by_block) in zip(found, blocks(name)):
        expect(time == at, "the same times")
        total = [-sum(force(by_block[int(m.split()[1])], base)[0][c] for m, base in bases.items()) for c in range(3)]
        size = max(map(abs, total + of["left"][0] + of["right"][0]))  # the thrusts of the banks cancel in the total
        worst = max(worst, *(abs(a - b) / size for a, b in zip(of["whole"][0], total)))
        halves = max(halves, *(abs(a + b - c) / size for a, b, c in zip(of["left"][0], of["right"][0], of["whole"][0])))
        expect(of["bounded"][0] == of["left"][0], "a plane with area 0 only bounds the part of the base")
        for wedge, (dam, acceleration, mode, value) in of.items():
            by_hand, least = safety(wedge, dam, acceleration, mode)
            of_safety = max(of_safety, abs(value - by_hand) / by_hand if 0. < by_hand < math.inf else float(value != by_hand))
            expect(least >= -1e-6 * size, f"{wedge} at {time}: mode {mode} is not admissible ({least})")
    print(f"    {name}: whole base {worst:.1e}, halves {halves:.1e}, safety {of_safety:.1e}; modes of left {sorted({of['left'][2] for _, of in found})}")
    expect(max(worst, halves) < 2e-7 and of_safety < 1e-6, "forces and safety")
    for wedge, one in summary(name)["wedges"].items():
        column = [(of[wedge][3], -time) for time, of in found]
        least = min(column)
        expect(abs(one["min_safety"]["value"] / least[0] - 1) < 1e-7 and one["min_safety"]["time"] == -least[1], f"{wedge}: {one} {least}")
        expect(abs(one["static_safety"]["value"] / column[0][0] - 1) < 1e-7, f"{wedge}: static")
    return found


def forces():
    """Each foundation and tied joints. On a rigid base the acceleration of the wedge is that of the ground."""
    write_scene()
    limit = write_wedges()
    for name, entries in RUNS.items():
        shown = runs("scene.prm", "--output", name, *limit, *settings("Motion/Duration=0.3", *entries))
        for words in ("Wedges    whole: 1 plane, 5.2e+09 kg", "left: 3 planes", "left: smallest sliding safety"):
            expect(words in shown, f"'{words}' is not in {shown}")
        found = check_run(name)
        expect(found[0][1]["left"][1] == [0., 0., 0.], "at rest at the start")
        if name in ("rigid", "tied"):
            names, rows = table(f"{name}/history.csv")
            ground = [[row[names.index(f"base_acceleration_{c}")] for c in "xyz"] for row in rows]
            for k in range(1, len(rows)):
                for wedge in PLANES:
                    mean = [(a + b) / 2 for a, b in zip(ground[k - 1], ground[k])]
                    expect(math.dist(found[k][1][wedge][1], mean) < 1e-6, f"acceleration of {wedge}: {found[k][1][wedge][1]}, ground {mean}")
        else:
            size = max(math.hypot(*of["left"][1]) for _, of in found)
            expect(.1 < size < 50., f"acceleration {size} on {name}")


def coarse():
    """The coarse dam of prm/: a wedge around each abutment, and the whole base."""
    write_wedges("coarse.csv")
    path = str(Path("coarse.csv").resolve())
    runs(str(COARSE), "--output", "coarse", *settings(f"Limits/Wedges={path}", "Motion/Duration=0.5", "Output/Figures=false", "Output/Frames=0"))
    check_run("coarse")


def limits():
    """Limit, report, static state alone, and refusals before the run."""
    write_scene()
    limit = write_wedges()
    shown = runs("scene.prm", "--output", "judged", *limit, *settings("Limits/Wedge safety=50", "Motion/Duration=0.2", "Output/Block forces=false"))
    expect("exceeded: wedge safety" in shown and not Path("judged/blocks.csv").exists(), shown)
    found = summary("judged")
    verdict, least = found["limits"]["wedge_safety"], min(one["min_safety"]["value"] for one in found["wedges"].values())
    expect(verdict["is_least"] and not verdict["satisfied"] and verdict["value"] == least, f"{verdict}")
    reports("judged")
    page = Path("judged/report.html").read_text()
    for words in ("Rock wedges", "Least sliding safety of a rock wedge", f"{least:.2f}", "(required 50)",
                  found["wedges"]["left"]["min_safety"]["mode_in_words"]):
        expect(words in page, f"'{words}' is not in the report")
    expect("Not shown" not in page, "all is shown")
    runs("scene.prm", "--output", "static", *limit, *settings("Motion/Source=none"))
    left = summary("static")["wedges"]["left"]
    expect(len(wedges("static")) == 1 and left["min_safety"] == left["static_safety"], "static state")
    write_wedges("stable.csv", {"front": ([(name, [-900 * x for x in normal(60, to)], 60, to, 1, 0, 0, 0) for name, to in
                                           (("a", 0), ("b", 120), ("c", 240))], 1e9, 2600)})
    runs("scene.prm", "--output", "stable", *settings("Limits/Wedges=stable.csv", "Limits/Wedge safety=2", "Motion/Source=none"))
    one = summary("stable")
    expect(one["wedges"]["front"]["min_safety"]["value"] is None and one["limits"]["wedge_safety"]["satisfied"], f"{one['wedges']}")
    expect(wedges("stable")[0][1]["front"][2:] == (123, math.inf), "three planes in contact")
    reports("stable")
    shown = runs("scene.prm", "--output", "none", *settings("Limits/Wedge safety=2", "Motion/Source=none"))
    expect("wedge safety (there is no Limits/Wedges)" in shown and not Path("none/wedges.csv").exists(), shown)
    write("far.csv", HEAD + "far, under, 0, 0, -50, 0, 0, 1, 0.5, 0, 0, 1e5, 2600\nfar, roof, 0, 0, 500, 10, 0, 0, 0, 0, 0, , \n")
    write("weak.csv", HEAD + "weak, under, 0, 0, -50, 0, 0, 0, 0.5, 0, 0, 1e5, 2600\n")
    write("bound.csv", HEAD + "bound, end, 0, 0, 0, 90, 90, 0, 0, 0, 0, 1e5, 2600\n")
    for file, words in (("far.csv", ["no face of the surface \"base\" rests on wedge \"far\"", "other side of: roof"]), ("gone.csv", ["cannot be read"]),
                        ("weak.csv", ["line 2", "area 0", "friction"]), ("bound.csv", ["all planes of wedge \"bound\" have the area 0"])):
        for more in ([], ["--validate"]):
            refused(["scene.prm", "--output", "refused", *settings(f"Limits/Wedges={file}"), *more], "Limits/Wedges", *words)
    expect(not Path("refused/summary.json").exists(), "refused before the run")


if __name__ == "__main__":
    run_cases(forces, coarse, limits)
