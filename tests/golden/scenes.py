# SPDX-License-Identifier: GPL-3.0-or-later
"""The golden scenes that dam_reference.py and Voussoir both compute: their meshes, motions and Voussoir's entries.

s1k.msh is the arch of six monoliths of the comparison with other programs (doc/verification.md), made elsewhere, nodes doubled
at the joints; its x points to the right bank and its y downstream. s1k_motion.txt is the motion used there."""

from math import exp, sin
from pathlib import Path

import meshes

HERE = Path(__file__).resolve().parent
G = 9.80665  # standard gravity, the unit g of motions

SCENES = {
    # Friction and no slip; gravity and water on the finished dam, no added mass: the comparison's own settings.
    "s1k_fja": {"mesh": "s1k", "law": "FJA", "friction": 1., "staged": False, "level": 195.,
                "damping": (.05, 1.49939, 7.49241), "dt": .01, "every": 20, "motion": "s1k"},
    "s1k_fjb": {"mesh": "s1k", "law": "FJB", "staged": False, "level": 195.,
                "damping": (.05, 1.49939, 7.49241), "dt": .01, "every": 20, "motion": "s1k"},
    "tied": {"mesh": "arch", "law": "tied", "staged": True, "level": 55., "depth": "global", "factor": 1.,
             "damping": (.05, 4., 15.), "dt": .005, "every": 10, "motion": "scaled"},
    "modes": {"mesh": "arch", "law": "FJA", "friction": .5, "staged": True, "level": 52., "depth": "local", "factor": .5,
              "modes": True, "damping": (.03, 5., 20.), "dt": .005, "every": 10, "motion": "columns"},
    "degree2": {"mesh": "arch", "law": "FJB", "staged": True, "level": 55., "depth": "local", "factor": 1., "degree": 2,
                "damping": (.05, 4., 15.), "dt": .005, "every": 10, "motion": "plain"},
    "tied_modes": {"mesh": "arch", "law": "tied", "staged": False, "level": 55., "depth": "local", "factor": 1.,
                   "modes": True, "damping": (.05, 4., 15.), "dt": .005, "every": 10, "motion": "plain"},
}
SAMPLE = {"scaled": .01}  # else dt


def write_mesh(scene, directory):
    if scene["mesh"] == "s1k":
        return HERE / "s1k.msh"
    file = Path(directory) / "arch.msh"
    meshes.arch(file)
    return file


def turn(scene):
    """From the file's axes to x downstream, y to the left bank, z up."""
    return (lambda x: x[[1, 0, 2]] * [1, -1, 1]) if scene["mesh"] == "s1k" else (lambda x: x)


def shape(t):
    """Three components, in g."""
    rise = 1 - exp(-20 * t)
    return [.8 * rise * sin(26 * t), .6 * rise * sin(34 * t + 1), .4 * rise * sin(41 * t + 2)]


def duration(scene):
    return 2. if scene["motion"] == "s1k" else .4


def samples(scene):
    """Rows of t and the three components as the file has them."""
    if scene["motion"] == "s1k":
        return [[float(w) for w in line.split()] for line in (HERE / "s1k_motion.txt").read_text().splitlines()[1:]]
    dt = SAMPLE.get(scene["motion"], scene["dt"])
    unit = {"scaled": 1., "columns": 100 * G, "plain": G}[scene["motion"]]
    return [[k * dt] + [float(f"{unit * a:.9g}") for a in shape(k * dt)] for k in range(round(duration(scene) / dt) + 1)]


FACTORS = {"s1k": (1., 1., 1.), "plain": (1., 1., 1.), "columns": (.01, .01, .01),
           "scaled": (.5 * 2. * G, .5 * .7 * G, .5 * -1.5 * G)}  # to m/s^2


def motion(scene):
    """Acceleration of the base at the time steps [m/s^2], linear between samples."""
    rows = [[f * a for f, a in zip(FACTORS[scene["motion"]], row[1:])] for row in samples(scene)]
    n = round(SAMPLE.get(scene["motion"], scene["dt"]) / scene["dt"])
    return [[p + i / n * (q - p) for p, q in zip(a, b)] for a, b in zip(rows, rows[1:]) for i in range(n)] + [rows[-1]]


def write_motion(scene, directory):
    """The files of the motion; entries of section Motion."""
    rows, kind = samples(scene), scene["motion"]
    entries = {"Source": "file", "Duration": duration(scene), "Time step": rows[1][0] - rows[0][0]}
    if kind == "columns":
        for c, name in enumerate("xy", 1):
            (Path(directory) / f"{name}.txt").write_text("".join(f"{row[0]:.9g} {row[c]!r}\n" for row in rows))
            entries[f"File {name}"] = f"{name}.txt"
        values = [f"{row[3] / 100 / G:.15E}" for row in rows]  # AT2 is always in g
        lines = ["PEER NGA", "A test", "ACCELERATION TIME SERIES IN UNITS OF G", f"NPTS= {len(rows)}, DT= {rows[1][0]:.4f} SEC"]
        lines += [" ".join(values[k:k + 5]) for k in range(0, len(values), 5)]
        (Path(directory) / "z.AT2").write_text("\n".join(lines) + "\n")
        return {**entries, "File z": "z.AT2", "Unit": "cm/s^2"}
    (Path(directory) / "motion.txt").write_text("".join(" ".join(f"{x:.9g}" for x in row) + "\n" for row in rows))
    entries.update({"File": "motion.txt", "Unit": "m/s^2"})
    if kind == "scaled":
        entries.update({"Unit": "g", "Factor": .5, "Scale x": 2., "Scale y": .7, "Scale z": -1.5})
    return entries


def prm(scene, directory):
    """Writes the scene's files; the text of the scene."""
    sections = {
        "Mesh": {"Source": "file", "File": write_mesh(scene, directory),
                 "Axes": "y -x z" if scene["mesh"] == "s1k" else "x y z"},
        "Elements": {"Degree": scene.get("degree", 1), "Incompatible modes": str(scene.get("modes", False)).lower()},
        "Concrete": {"Young's modulus": 21e9, "Poisson's ratio": .17, "Density": 2400},
        "Damping": dict(zip(("Ratio", "Frequency 1", "Frequency 2"), scene["damping"])),
        "Reservoir": {"Water level": scene["level"], "Density": 1000, "Model": "Westergaard-nodal", "Depth": scene.get("depth"),
                      "Factor": scene.get("factor")} if "depth" in scene else
                     {"Water level": scene["level"], "Density": 1000, "Model": "none"},
        "Joints": {"Model": scene["law"], **({"Friction": scene["friction"]} if "friction" in scene else {})},
        "Statics": {"Self-weight": "staged" if scene["staged"] else "monolithic", "Gravity": 9.81},
        "Motion": write_motion(scene, directory),
        "Dynamics": {"Steps per sample": round(SAMPLE.get(scene["motion"], scene["dt"]) / scene["dt"])},
        "Output": {"Figures": "false", "Stress recovery": "elements", "Checkpoint interval": 0,
                   "Solution interval": round(duration(scene) / scene["dt"])},
    }
    return "".join(f"subsection {name}\n" + "".join(f"  set {k} = {v}\n" for k, v in entries.items()) + "end\n"
                   for name, entries in sections.items())


# The tied arch that CalculiX computes, too (make_calculix.py)
CALCULIX = {"cells": ((1,) * 3 + (2,) * 3 + (3,) * 3 + (4,) * 3, 2, 6), "level": 50., "ratio": .1, "frequency": 10.,
            "dt": .005, "steps": 60, "every": 5, "every_node": 5}


# An arch of two monoliths for CalculiX's reactions (make_calculix_blocks.py).
BLOCKS = {"cells": ((1,) * 3 + (2,) * 2, 2, 4), "level": 50.}


def calculix_prm(directory, plain):
    c = CALCULIX
    meshes.arch(Path(directory) / "arch.msh", *c["cells"])
    rows = [[k * c["dt"], *(G * a for a in shape(k * c["dt"]))] for k in range(c["steps"] + 1)]
    (Path(directory) / "motion.txt").write_text("".join(" ".join(f"{x:.12g}" for x in row) + "\n" for row in rows))
    return f"""
subsection Mesh
  set Source = file
  set File   = arch.msh
end
subsection Elements
  set Incompatible modes = {"false" if plain else "true"}
end
subsection Concrete
  set Young's modulus = 21e9
  set Poisson's ratio = 0.17
  set Density         = 2400
end
subsection Damping # proportional to stiffness alone
  set Ratio       = {c["ratio"]}
  set Frequency 1 = 1e-6
  set Frequency 2 = {c["frequency"]}
end
subsection Reservoir
  set Water level = {c["level"]}
  set Model       = none
end
subsection Joints
  set Model = tied
end
subsection Statics
  set Self-weight = monolithic
end
subsection Motion
  set Source    = file
  set File      = motion.txt
  set Unit      = m/s^2
  set Duration  = {c["dt"] * c["steps"]:g}
  set Time step = {c["dt"]}
end
subsection Output
  set Figures             = false
  set Stress recovery     = elements
  set Solution interval   = 1000
  set Checkpoint interval = 0
end
"""


# The same arch of three concretes: E, nu, rho without zone, of the heel and of the crown (make_calculix_zones.py)
CONCRETES = ((21e9, .17, 2400.), (32e9, .2, 2550.), (9e9, .12, 2150.))


# Faces upstream and downstream [degC].
TEMPERATURES = {"grouting": 8., "expansion": 9e-6, "uniform": (20., 20.), "linear": (6., -10.)}


def zones_prm(directory, plain):
    text = calculix_prm(directory, plain)
    meshes.zoned_arch(Path(directory) / "zones.msh", *CALCULIX["cells"])
    heel, crown = CONCRETES[1:]
    entry = (f"  set Zones = Heel: {heel[0] / 1e9:g} GPa {heel[1]} {heel[2] / 1e3:g} t/m^3, "
             f"crown: {crown[0]:g} {crown[1]} {crown[2]:g}")
    return text.replace("arch.msh", "zones.msh").replace("subsection Concrete\n", f"subsection Concrete\n{entry}\n")


# A block on a column of rock, shaken from below: P waves alone, since Poisson's ratio is 0 (rock_exact.py). Metres, m/s.
ROCK = {"cell": 5., "columns": 2, "layers": 60, "dam_cells": 6, "E": 10e9, "rho": 2600., "dam_E": 2e9, "dam_rho": 2500.,
        "dt": .001, "steps": 1160, "clean": .52, "every": 20, "ratio": .05, "frequencies": (3., 12.), "mass_damping": (0., 10.)}


def outcrop(t, amplitude=.01, length=.5, frequency=3.):
    """Displacement and acceleration of a wavelet: sin(w s) (1 - s^2)^4, s from -1 to 1 within `length`."""
    half = length / 2
    s = t / half - 1
    if abs(s) >= 1:
        return 0., 0.
    w, q = 2 * 3.141592653589793 * frequency * half, 1 - s * s
    wave, slope, curve = sin(w * s), w * sin(w * s + 3.141592653589793 / 2), -w * w * sin(w * s)
    g, dg, ddg = q**4, -8 * s * q**3, -8 * q**3 + 48 * s * s * q**2
    return amplitude * wave * g, amplitude * (curve * g + 2 * slope * dg + wave * ddg) / half**2
