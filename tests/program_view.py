#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the pictures: `voussoir view`, `voussoir modes --output`, figures of several runs, and the joints as surfaces.

    program_view.py VOUSSOIR CASE...
"""

import csv
import math
import os
import re
import subprocess
import sys
from pathlib import Path

from program_physics import Solution, close
from run_program import expect, frequencies, refused, run_cases, runs, settings, summary, voussoir, write_scene

SCRIPTS = Path(__file__).resolve().parent.parent / "scripts"
sys.path.insert(0, str(SCRIPTS.parent / "python"))
from voussoir.vtu import read_vtu  # noqa: E402


def table(name):
    with open(name) as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def picture_of(path):
    """Width and height of a PNG that is one."""
    data = Path(path).read_bytes()
    expect(data[:8] == b"\x89PNG\r\n\x1a\n" and len(data) > 5000, f"{path} is no picture")
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


def view():
    """Mesh and groups of a dam alone and with rock; the whole volume and every face are in the files."""
    write_scene()
    text = runs("view", "scene.prm", "--output", "dam")
    expect("upstream 2" in text, text)
    limit = runs("scene.prm", "--validate").split("explicit scheme for the dam ")[1].split()[0]  # [ms]
    expect(f"critical step {limit} ms at (" in text, text)
    small = picture_of("dam/view.png")
    text = runs("view", "scene.prm", "--output", "dam", "--set", "Motion/Source=none")
    expect("no critical step: no motion" in text, text)
    refused(["view", "scene.prm", "--output", "invalid", "--set", "Reservoir/Water level=1000"], "Reservoir/Water level", "1000")
    picture_of("invalid/view.png")
    mesh, surfaces = read_vtu("dam/mesh.vtu"), read_vtu("dam/surfaces.vtu")
    volume = [set() for _ in range(4)]
    for number in mesh["monolith"]:
        volume[int(number)].add(number)
    expect(len(mesh["monolith"]) == len(mesh["connectivity"]) // 8 and sum(map(bool, volume)) == 3, "three monoliths")
    expect(set(surfaces["group"]) == {1., 2., 3., 4.}, f"groups {set(surfaces['group'])}")
    runs("view", "scene.prm", "--output", "rock", "--set", "Mesh/Arch210/Rock/Enabled=true", "--set", "Mesh/Arch210/Rock/Element size=150")
    expect(max(read_vtu("rock/mesh.vtu")["monolith"]) >= 1000, "no rock")
    expect(set(read_vtu("rock/surfaces.vtu")["group"]) >= {2., 3., 4., 5., 6.}, "groups of the rock")
    expect(picture_of("rock/view.png")[1] > small[1], "the rock has no panel of its own")
    refused(["view", "nothing.prm"], "nothing.prm")
    refused(["view"], "voussoir view SCENE.prm")
    refused(["view", "scene.prm", "--set", "Mesh/Nothing=1"], "Nothing")


def water_line():
    """Faces are cut at the level of the water: not wet or dry as a whole."""
    import numpy as np
    from voussoir.picture import below
    face = np.array([[0., 0., 2.], [0., 3., 2.], [0., 3., 6.], [0., 0., 6.]])
    for level, area in ((1., 0.), (2., 0.), (5., 9.), (5.9, 11.7), (6., 12.), (9., 12.)):
        part = below(face, level)
        y, z = part[:, 1:].T if len(part) else (np.zeros(1), np.zeros(1))
        found = .5 * abs(y @ np.roll(z, -1) - z @ np.roll(y, -1))
        expect(abs(found - area) < 1e-12, f"{found} m2 of the face are below {level} m, not {area}")
    wedge = below(np.array([[0., 0., 0.], [0., 4., 0.], [0., 0., 4.]]), 1.)
    expect(len(wedge) == 4 and wedge[:, 2].max() == 1., f"{wedge}")


def damping_of_modes(text, rows):
    """Rayleigh's formula with the default entries (5 % at 1.2 and 6 Hz); the proposal by the shares; warnings."""
    def ratio(f, f1, f2):  # 5 % at f1 and f2
        return 5. * (f1 * f2 / f + f) / (f1 + f2)

    def significant(number):  # modes up to 80 % of the effective mass
        share, found = 0., []
        for row in rows[:number]:
            if share < .8:
                share += sum(row[f"share_{d}"] for d in "xyz") / 3
                found.append(row)
        return found, share >= .8

    for line, row in zip(text.splitlines()[1:41], rows):
        close(float(line.split()[2]), ratio(row["frequency"], 1.2, 6.), 1e-3, f"damping at {row['frequency']} Hz")
    for number in (40, 6):
        found, is_reached = significant(number)
        expect(is_reached == (number == 40) and len(found) <= number, f"{len(found)} significant modes of {number}")
        f1 = rows[0]["frequency"]
        f2 = found[-1]["frequency"] if is_reached else 5. * f1
        dry = ["modes", "scene.prm", "--count", str(number), *settings("Reservoir/Density=0")]
        shown = runs(*dry)
        proposal = re.search(r"Frequency 1 = (\S+), Frequency 2 = (\S+) \((5 times|modes 1 to (\d+)).*; at least (\S+) % in between", shown)
        expect(proposal and proposal[4] == (str(len(found)) if is_reached else None), shown)
        print(f"    between the proposed frequencies: at least {proposal[5]} %")
        for word, exact in ((proposal[1], f1), (proposal[2], f2), (proposal[5], ratio((f1 * f2)**.5, f1, f2))):
            close(float(word), exact, 5e-3, "proposal")
        for pins in ((f1, f2), (1.2, 6.), (.2, 1.), (20., 90.)):
            message = voussoir(*dry, *settings(*(f"Damping/Frequency {k}={pin:.6g}" for k, pin in enumerate(pins, 1)))).stderr
            ratios = [ratio(row["frequency"], *pins) for row in found if max(row[f"share_{d}"] for d in "xyz") >= .01]
            n_off, worst = sum(abs(x / 5. - 1.) > .3 for x in ratios), max(ratios, key=lambda x: abs(x - 5.))
            print(f"    5 % at {pins[0]:.3g} and {pins[1]:.3g} Hz: {n_off} of {len(ratios)} modes, {worst:.2f} %")
            expect(("damping ratio of" in message) == (n_off > 0), f"{pins}, {ratios}: {message}")
            expect(n_off == 0 or ("to the proposal." in message) == (float(proposal[5]) >= 3.5), f"{proposal[5]} %: {message}")
            expect(n_off == 0 or f"of {n_off} mode" in message and f"{worst:.2f} %" in message, f"{n_off}, {worst}: {message}")
    wide = voussoir("modes", str(Path(__file__).resolve().parent.parent / "prm" / "coarse.prm"), "--count", "60")
    found = re.search(r"at least (\S+) % in between", wide.stdout)
    expect(float(found[1]) < 3.5 and '(9 Hz). Set "Damping/Model" to uniform.' in wide.stderr, f"{found}: {wide.stderr}")


def modes():
    """Shapes and effective masses: orthogonal to each other, and in all as much as the mass."""
    write_scene()
    text = runs("modes", "scene.prm", "--count", "40", "--output", "modes", *settings("Reservoir/Density=0"))
    rows = table("modes/modes.csv")
    expect(len(rows) == 40 and "Effective mass" in text, text)
    for row in rows:
        for d in "xyz":
            close(row[f"participation_{d}"] ** 2, row[f"effective_mass_{d}"], 1e-6, "effective mass")
            expect(0. <= row[f"share_{d}"] <= 1., f"share {row}")
    damping_of_modes(text, rows)
    shares = {d: sum(row[f"share_{d}"] for row in rows) for d in "xyz"}
    print("    shares of 40 modes:", {d: round(share, 4) for d, share in shares.items()})
    expect(all(.85 < share < 1. + 1e-9 for share in shares.values()), f"shares of the mass: {shares}")
    whole = rows[0]["effective_mass_x"] / rows[0]["share_x"]
    expect(0. < whole < 2400. * summary_of_volume(), "the free nodes are heavier than the dam")
    # The water moves with the dam most along the river, and shares count by the mass of their own direction.
    runs("modes", "scene.prm", "--count", "2", "--output", "wet")
    wet = {d: table("wet/modes.csv")[0][f"effective_mass_{d}"] / table("wet/modes.csv")[0][f"share_{d}"] for d in "xyz"}
    print(f"    masses with the water {wet}, of the dam {whole:.6g} kg")
    expect(wet["x"] > 1.05 * wet["y"] and wet["y"] > 1.02 * wet["z"] and wet["z"] > whole, f"{wet}, {whole}")
    shape = read_vtu("modes/mode-001.vtu")["displacement"]
    close(max(math.hypot(*shape[i:i + 3]) for i in range(0, len(shape), 3)), 1., 1e-5, "largest displacement of a shape")
    picture_of("modes/modes.png")
    close(frequencies(text)[0], rows[0]["frequency"], 1e-4, "frequency")


def summary_of_volume():
    runs("scene.prm", "--output", "still", "--overwrite", *settings("Motion/Source=none", "Motion/File=", "Motion/Unit=m/s^2"))
    return summary("still")["mesh"]["volume"]


def joint_surfaces():
    """joints-*.vtu beside solution-*.vtu: the same openings, slips and states; the pressure carries what friction needs."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=10", "Joints/Friction=0.3"))
    pvd = Path("run/solution.pvd").read_text()
    expect(pvd.count("solution-") == pvd.count("joints-") == 6 and 'part="1"' in pvd, pvd)
    checked = 0
    for number in (0, 20, 50):
        dam, joints = Solution(f"run/solution-{number:05d}.vtu"), Solution(f"run/joints-{number:05d}.vtu")
        expect(set(joints.data["joint"]) == {1., 2.}, "two joints")
        for i, place in enumerate(joints.points):
            if joints.data["joint_state"][i] < 0:
                expect(joints.data["opening"][i] == 0., "a held foot opens")
                continue
            k = next(k for k in dam.near(place) if dam.data["joint_state"][k] >= 0)
            slip, shear = joints.data["slip"][3 * i:3 * i + 3], joints.data["shear_stress"][3 * i:3 * i + 3]
            expect(abs(joints.data["opening"][i] - dam.data["opening"][k]) < 1e-8, "opening")
            expect(abs(math.hypot(*slip) - dam.data["slip"][k]) < 1e-8, "length of the slip")
            expect(joints.data["joint_state"][i] == dam.data["joint_state"][k], "state")
            expect(math.hypot(*shear) <= .3 * max(joints.data["pressure"][i], 0.) * (1 + 1e-4) + 1e-3, "more shear than friction gives")
            checked += math.hypot(*shear) > 1e3
    expect(checked > 10, "no shear anywhere: this scene tells nothing")
    rows = table("run/joint_points.csv")
    close(sum(row["area"] for row in rows if row["joint"] == 1), area_of(Solution("run/joints-00000.vtu"), 1.), .02, "area of joint 1")


def area_of(surface, joint):
    """Of the quadrilaterals of a joint, by their diagonals, shared out to their corners: what those that are free have."""
    total, nodes = 0., surface.data["connectivity"]
    for i in range(0, len(nodes), 4):
        if surface.data["joint"][nodes[i]] == joint:
            p = [surface.points[n] for n in nodes[i:i + 4]]
            a, b = ([y - x for x, y in zip(p[k], p[k + 2])] for k in (0, 1))
            free = sum(surface.data["joint_state"][n] >= 0 for n in nodes[i:i + 4]) / 4.
            total += free * .5 * math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return total


def film():
    """A GIF of the run, and what is not one."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=10"))
    result = film_of("run", "film.gif", "--width", "320", "--magnify", "50", "--from", "0.1")
    expect(result.returncode == 0 and "5 pictures" in result.stdout, f"{result}")
    expect(Path("film.gif").read_bytes()[:6] == b"GIF89a", "no GIF")
    result = film_of("run", "film.gif", "--from", "3")
    expect(result.returncode == 2 and "too few" in result.stderr, f"{result}")
    expect(film_of("run", "film.mp4").returncode == 2 and film_of("nothing", "film.gif").returncode == 2, "not refused")


def film_of(*arguments):
    return script("film.py", *arguments)


def script(name, *arguments):
    """A script called as the pages call it."""
    return subprocess.run([str(SCRIPTS / name), *arguments], capture_output=True, text=True, check=False)


def damaged():
    """A damaged file of a run, and options that are no numbers: one paragraph that names the file or the option; no traceback."""
    write_scene()
    runs("scene.prm", "--output", "run", *settings("Output/Solution interval=10"))
    path, pvd = Path("run/solution-00020.vtu"), Path("run/solution.pvd")
    sound, times = path.read_bytes(), pvd.read_text()
    middle = sound.index(b">", sound.index(b"displacement")) + 200
    for what, data in (("cut", sound[:len(sound) // 2]), ("empty", b""), ("changed", sound[:middle] + b"AAAAAAAA" + sound[middle + 8:]),
                       ("no text", sound[:middle] + b"\xff\xfe" + sound[middle + 2:]), ("no base64", sound[:middle] + b"A" + sound[middle:]),
                       ("type", sound.replace(b"Float32", b"Float16")), ("no stress", sound.replace(b'"max_principal"', b'"max"')),
                       ("other points", sound.replace(b'Name="connectivity"', b'Name="was"').replace(b'Name="offsets"', b'Name="connectivity"'))):
        path.write_bytes(data)
        for name, arguments in (("film.py", ("run", "film.gif")), ("picture.py", (str(path), "dam.png"))):
            said(script(name, *arguments), "solution-00020.vtu is damaged", "Repeat the run")
    path.write_bytes(sound)
    pvd.write_text(times.replace('timestep="0.2"', 'timestep="soon"'))
    expect("soon" in pvd.read_text(), "the times are written in another way: mend this test")
    said(script("film.py", "run", "film.gif"), "solution.pvd is damaged", "soon")
    pvd.write_text(times)
    said(script("film.py", "run", "film.gif", "--width", "3.5"), "--width must be a whole number, not '3.5'")
    said(script("film.py", "run", "film.gif", "--from", "soon"), "--from must be a number, not 'soon'")
    said(script("film.py", "run"), "film", "--help")
    said(script("picture.py", "nothing.vtu", "dam.png"), "nothing.vtu")
    history = Path("run/joint_history.csv").read_text()
    Path("run/joint_history.csv").write_text(history.replace("\n0.1,", "\nsoon,", 1))
    said(script("picture.py", "run", "dam.png"), "joint_history.csv is damaged", "soon")
    Path("run/joint_history.csv").write_text(history)
    said(script("picture.py", "run", "dam.doc"), "dam.doc")
    expect(script("picture.py", "run", "dam.png").returncode == 0 and picture_of("dam.png")[0] > 500, "no picture of the run")


def said(result, *parts):
    """One paragraph with these parts, and the status of bad input."""
    what = f"status {result.returncode}: {result.stderr[-400:]}"
    expect(result.returncode == 2 and result.stderr.count("\n") == 1 and result.stderr.startswith("voussoir: error: "), what)
    expect(all(part in result.stderr for part in parts), f"{parts} are missing: {what}")


def commands():
    """Scripts that pages and docstrings call by their path can be called so."""
    root = SCRIPTS.parent
    files = [*root.glob("*.md"), *root.glob("doc/**/*.md"), *root.glob("scripts/*.py"), *root.glob("benchmarks/*.py")]
    called = {found for file in files for found in re.findall(r"^ +((?:scripts|benchmarks)/\w+\.(?:py|sh))\b", file.read_text(encoding="utf-8"), re.M)}
    expect(len(called) > 20 and {"scripts/film.py", "scripts/picture.py"} <= called, f"{sorted(called)}")
    for name in sorted(called):
        expect(os.access(root / name, os.X_OK), f"{name} is called by its path, but is not there or not executable")


def figures():
    """Of several runs on the same scales, as PNG and as PDF; a tied run beside one that is not."""
    write_scene()
    for name, model in (("fja", "FJA"), ("tied", "tied")):
        runs("scene.prm", "--output", name, "--set", f"Joints/Model={model}")
    python = "/usr/bin/python3"
    for extra, ending in (([], "png"), (["--format", "pdf"], "pdf")):
        result = subprocess.run([python, str(SCRIPTS / "figures.py"), "fja", "tied", *extra], capture_output=True, text=True, check=False)
        expect(result.returncode == 0 and "error" not in result.stderr, f"{result}")
        for name in ("envelope_upstream", "envelope_downstream_compression", "envelope_arch_upstream", "envelope_cantilever_downstream_compression",
                     "envelope_vertical_upstream", "history", "spectrum", "floor_spectra", "energy"):
            expect(all(Path(run, "figures", f"{name}.{ending}").stat().st_size > 3000 for run in ("fja", "tied")), f"{name}.{ending}")
        expect(Path("fja/figures", f"openings.{ending}").exists() and not Path("tied/figures", f"openings.{ending}").exists(), "openings")
    runs("scene.prm", "--output", "fja", "--overwrite")  # the figures are results, not files of others
    expect(not Path("fja/figures/history.pdf").exists(), "figures of the run before are left")


if __name__ == "__main__":
    run_cases(view, water_line, modes, joint_surfaces, film, damaged, commands, figures)
