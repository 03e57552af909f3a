#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the response spectrum analysis, `voussoir modes --spectrum`.

    program_spectrum.py VOUSSOIR CASE...     cases: see the functions with that name below
"""

import math
import os
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parent / "golden"
sys.path.insert(0, str(GOLDEN))
import meshes  # noqa: E402
from compare import read_vtu, scene  # noqa: E402
from program_blocks import blocks, force  # noqa: E402
from program_physics import close  # noqa: E402
from run_program import expect, run_cases, runs, settings, summary, table, voussoir, write  # noqa: E402

G = 9.80665
ARTIFICIAL = """
subsection Mesh
  subsection Arch210
    set Joints = 2
    set Elements along = 18
    set Elements up = 6
    set Elements through = 1
  end
end
subsection Motion
  set Source = artificial
  set Spectrum = NB35047-2015
  set Characteristic period = 0.3
  set Peak acceleration = 0.3
end
subsection Output
  set Figures = false
  set Checkpoint interval = 0
end
"""
DRY = settings("Reservoir/Density=0")


def rows_of(file):
    names, rows = table(file)
    return [dict(zip(names, row)) for row in rows]


def printed(text):
    """Rows of the printed table: name, numbers."""
    rows = {}
    for line in text.splitlines():
        words = line.split()
        numbers = []
        while words and words[-1].replace(".", "", 1).isdigit():
            numbers.insert(0, float(words.pop()))
        rows[" ".join(words)] = numbers
    return rows


def code(period):
    """S_a of ARTIFICIAL along x [m/s^2], by NB 35047-2015."""
    beta = 1 + 1.5 * period / .1 if period < .1 else 2.5 if period <= .3 else 2.5 * max((.3 / period)**.6, .2)
    return .3 * G * beta


def cqc(f1, f2, zeta):
    """Wilson, Der Kiureghian and Bayo (1981), equal damping ratios."""
    r = f2 / f1
    return 8 * zeta**2 * (1 + r) * r**1.5 / ((1 - r * r)**2 + 4 * zeta**2 * r * (1 + r)**2)


def rigid_share(f):
    """Gupta's method (US NRC Regulatory Guide 1.92): the plateau of the code ends at .3 s; 99 % of it are reached up to .3/.99^(1/.6) s."""
    f1 = .99**(1 / .6) / .3
    return min(1., max(0., math.log(f / f1) / math.log((f1 + 2 * 33) / 3 / f1)))


def numbers():
    """Spectral accelerations by the code; base forces by the sums over modes and directions, in Python; fields; a file instead of the code."""
    write("scene.prm", ARTIFICIAL)
    count = ["--count", "12", *DRY, *settings("Motion/Scale y=0.8", "Damping/Ratio=0.05")]
    text = runs("modes", "scene.prm", *count, "--spectrum", "design", "--output", "out")
    rows, modes, found = rows_of("out/response_spectrum.csv"), rows_of("out/modes.csv"), printed(text)
    scale = dict(zip("xyz", (1, .8, 2 / 3)))
    expect(len(rows) == 12, text)
    for row, mode in zip(rows, modes):
        expect(row["frequency"] == mode["frequency"] and row["damping"] == .05, f"{row}")
        for d in "xyz":
            close(row[f"spectral_acceleration_{d}"], scale[d] * code(1 / row["frequency"]), 1e-5, f"S_a of mode {row['mode']:.0f}")
            expect(row[f"participation_{d}"] == mode[f"participation_{d}"], f"{row}")
    # Without water the mass of the dam does not couple the directions.
    mass = {d: modes[0][f"effective_mass_{d}"] / modes[0][f"share_{d}"] for d in "xyz"}
    for i, c in enumerate("xyz"):
        square = 0.
        for d in "xyz":
            q = [row[f"participation_{c}"] * row[f"participation_{d}"] for row in rows]
            peak, shares = scale[d] * .3 * G, [rigid_share(row["frequency"]) for row in rows]
            whole = [row[f"spectral_acceleration_{d}"] for row in rows]
            a = [math.sqrt(1 - share**2) * s for share, s in zip(shares, whole)]
            expect(all(abs(row[f"rigid_share_{d}"] - share) < 3e-3 for row, share in zip(rows, shares)), "rigid shares")
            square += sum(cqc(m["frequency"], n["frequency"], .05) * q[j] * q[k] * a[j] * a[k]
                          for j, m in enumerate(rows) for k, n in enumerate(rows))
            square += (peak * ((mass[d] if c == d else 0.) - sum(q)) + sum(x * y * z for x, y, z in zip(shares, whole, q)))**2
        close(found["base force [MN]"][i], 1e-6 * math.sqrt(square), 1e-5, f"base force {c}")
        share = 100 * sum(row[f"share_{c}"] for row in modes)
        close(found["effective mass of the modes [%]"][i], share, 1e-4, f"effective mass {c}")
    warned = voussoir("modes", "scene.prm", *count, "--spectrum", "design").stderr
    low = [d for d in "xyz" if sum(row[f"share_{d}"] for row in modes) < .9]
    expect(low and all(f"% in {d}" in warned for d in low) and "90 %" in warned, warned)
    fields_agree(found)
    periods = [0, .1] + [.3 * 10**(k / 1000) for k in range(1001)]
    write("spectrum.csv", "period,acceleration [g]\n" + "".join(f"{p:.9g},{code(p) / G:.9g}\n" for p in periods))
    other = printed(runs("modes", "scene.prm", *count, "--spectrum", "spectrum.csv"))
    for name in ("displacement of the crown [mm]", "base force [MN]", "arch (horizontal in the face)"):
        for a, b in zip(found[name], other[name]):
            close(b, a, 1e-4, f"{name}, spectrum of the file")


def fields_agree(found):
    """In the vertical plane of symmetry the face is free of stress across it: the arch stress is sigma_yy, the cantilever stress sigma_xx + sigma_zz."""
    fields, checked = read_vtu("out/response_spectrum.vtu"), 0
    crest = max(p[2] for p in fields["points"])
    for i, (x, y, z) in enumerate(fields["points"]):
        if abs(y) < 1e-3 and fields["arch_stress"][i] > 0 and z < .9 * crest:
            size = fields["cantilever_stress"][i]
            expect(abs(fields["arch_stress"][i] - fields["stress_yy"][i]) < 1e-4 * fields["stress_yy"][i], "arch stress")
            expect(abs(size - fields["stress_xx"][i] - fields["stress_zz"][i]) < 1e-4 * size, "cantilever stress")
            checked += 1
    expect(checked >= 4, f"{checked} nodes")
    top = [u for p, u in zip(fields["points"], fields["displacement"]) if p[2] > crest - 1e-3]
    for c, d in enumerate("xyz"):
        close(1e3 * max(u[c] for u in top), found["largest displacement of the crest [mm]"][c], 1e-3, f"crest {d}")


def stiff():
    """A stiff wall follows the ground: force = mass times peak acceleration, stress = weight above times a/g; all modes are rigid."""
    meshes.wall("wall.msh", n_up=12)
    file = scene("stiff", "wall.msh", Concrete={"Young's modulus": 2e15, "Density": 2500}, Damping={"Ratio": .05}, Motion={"Vertical ratio": 1})
    write("spectrum.csv", "0 3\n0.03 3\n0.1 7\n2 1\n")
    text = runs("modes", file, "--count", "4", "--spectrum", "spectrum.csv", "--output", "out", *settings("Motion/Scale x=0", "Motion/Scale y=0.5"))
    expect("combination of 0 modes" in text, text)
    warned = voussoir("modes", file, "--count", "4", "--spectrum", "spectrum.csv", *settings("Motion/Scale y=0.5")).stderr
    expect("Vertical ratio" not in warned and "Damping/Ratio (" not in warned, warned)
    found, mass = printed(text), 2500 * 10 * 10 * (60 - 2.5)  # the lower half of the lowest elements is fixed
    for d, a in enumerate((0, 1.5, 3)):
        expect(abs(found["base force [MN]"][d] - 1e-6 * mass * a) <= 5.1e-4, f"base force {found['base force [MN]']}")
    text = runs("modes", file, "--count", "4", "--spectrum", "spectrum.csv", "--output", "out", *settings("Motion/Scale x=0", "Motion/Scale y=0"))
    fields = read_vtu("out/response_spectrum.vtu")
    worst = max(abs(s - 2500 * 3 * (60 - p[2])) for p, s in zip(fields["points"], fields["stress_zz"]) if p[2] > 7.5)
    across = max(map(abs, fields["arch_stress"]))
    print(f"    largest error of the vertical stress {worst:.3g} Pa of {2500 * 3 * 60} Pa, arch stress {across:.3g} Pa")
    expect(worst < 1e-3 * 2500 * 3 * 60 and across < 1e-3 * 2500 * 3 * 60, "stress of a stiff wall")
    foot = printed(text)["cantilever (across it in the face)"]
    expect(max(abs(s - 1e-6 * 2500 * 3 * 50) for s in foot) < 6e-4, f"cantilever stress away from the base {foot}")
    # Westergaard's pressure 7/8 rho sqrt(H h) a on the upstream face.
    wet = settings("Motion/Scale y=0", "Motion/Scale z=0", "Reservoir/Density=1000", "Reservoir/Model=Westergaard")
    runs("modes", file, "--count", "4", "--spectrum", "spectrum.csv", "--output", "wet", *wet)
    fields = read_vtu("wet/response_spectrum.vtu")
    face = [(p[2], s) for p, s in zip(fields["points"], fields["stress_xx"]) if p[0] == 0 and 10 < p[2] < 50]
    expect(len(face) > 20, "the upstream face")
    for z, pressure in sorted(set(face)):
        close(pressure, 7 / 8 * 1000 * math.sqrt(60 * (60 - z)) * 3, .01, f"hydrodynamic pressure at {z} m")


def history():
    """Mean of the maxima of artificial motions that match the spectrum (SEEDS in the environment, by default 12), tied joints, by
    step-by-step integration.

    The maxima scatter by 13 % (base force x, 12 seeds), so their mean has a standard error of up to 4 %. The base
    force is 0.89 to 1.03 of the mean, the crown 0.94 to 0.98.
    """
    write("scene.prm", ARTIFICIAL)
    runs("modes", "scene.prm", "--count", "30", *DRY, "--output", "modes")
    modes = rows_of("modes/modes.csv")
    f1 = modes[0]["frequency"]
    # Rayleigh's damping ratio is .0485 to .05 between these frequencies, which have the largest part in the response.
    tied = [*DRY, *settings("Joints/Model=tied", f"Damping/Frequency 1={f1}", f"Damping/Frequency 2={1.7 * f1}")]
    text = runs("modes", "scene.prm", "--count", "30", *tied, "--spectrum", "design")
    found = printed(text)
    peaks = []
    seeds = range(1, 1 + int(os.environ.get("SEEDS", "12")))
    for seed in seeds:
        runs("scene.prm", "--output", f"run{seed}", *tied, *settings(f"Motion/Seed={seed}", "Output/Envelope interval=0"))
        peaks.append(maxima(f"run{seed}", modes))
    print("    peaks of the seeds:", peaks)
    for k, (name, part) in enumerate((n, i) for n in ("displacement of the crown [mm]", "base force [MN]") for i in range(3)):
        mean, of_spectrum = sum(p[k] for p in peaks) / len(seeds), found[name][part]
        print(f"    {name} {'xyz'[part]}: spectrum {of_spectrum:.4g}, mean of the histories {mean:.4g}, ratio {of_spectrum / mean:.3f}")
        expect(abs(of_spectrum / mean - 1) < .15, f"{name} {'xyz'[part]}")


def maxima(name, modes):
    """Largest changes of crown displacement [mm] and base force [MN]. The mass of the fixed nodes, which `modes` does not have, is subtracted."""
    rows, motion = rows_of(f"{name}/history.csv"), summary(name)
    held = motion["mesh"]["volume"] * 2400 - modes[0]["effective_mass_x"] / modes[0]["share_x"]
    result = [1e3 * max(abs(row[f"crest_{d}"] - rows[0][f"crest_{d}"]) for row in rows) for d in "xyz"]
    forces = [[sum(force(of[int(m.split()[1])], base)[0][c] for m, base in motion["blocks"].items()) for c in range(3)]
              for _, of in blocks(name)]
    for c, d in enumerate("xyz"):
        mean = [(a[f"base_acceleration_{d}"] + b[f"base_acceleration_{d}"]) / 2 for a, b in zip(rows, rows[1:])]
        result.append(1e-6 * max(abs(f[c] - forces[0][c] - held * a) for f, a in zip(forces[1:], mean)))
    return result


if __name__ == "__main__":
    run_cases(numbers, stiff, history)
