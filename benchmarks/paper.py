#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the paper's sections 3.1 and 3.2 with several motions each, and what every statement of the paper comes to.

    benchmarks/paper.py run [--output output/paper] [--voussoir PROGRAM] [--motions 7] [--cases 3.2_fja ...] [--rock full]
    benchmarks/paper.py report [--output output/paper] [--figures doc/figures] [--csv doc]

"run" leaves each run in OUTPUT/CASE/seed_N, does not repeat what is done, and goes on from a checkpoint. "report" prints
Markdown tables of all runs that are there, and writes paper_runs.csv, paper_joints.csv and the figures, which are laid
out as the paper's 1 to 10. Section 3.1 has a coarser mesh than prm/paper_3_1_*.prm and ends after the strong part of the
motion, unless --rock full is given: REDUCED, UNTIL.

Upper part of a face: above z = 150 m, within 150 m of the crown. "Mean" tension is that of the envelope at its nodes,
shares are of areas. A: the joint nearest to the right bank.
"""

import argparse
import csv
import json
import sys
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from program import ROOT, add_program_argument, run as program_output
from paper_figures import draw
from paper_run import FACES, Run
from voussoir.tables import read_table
from voussoir.vtu import read_vtu

REDUCED = {"Mesh/Arch210/Elements along": 36, "Mesh/Arch210/Elements up": 14, "Mesh/Arch210/Rock/Element size": 30}
UNTIL = 12.8  # s: the motion decays from 11 s on
RIGID = {"Foundation/Model": "rigid", "Mesh/Arch210/Rock/Enabled": "false", "Dynamics/Steps per sample": 1,
         "Mesh/Arch210/Elements along": 36, "Mesh/Arch210/Elements up": 14}
KEYS = "Joints/Keys/"
CASES = {"3.2_fja": ("paper_3_2_fja", {}), "3.2_fjb": ("paper_3_2_fjb", {}), "3.2_ksm": ("paper_3_2_ksm", {}),
         "rigid17_fja": ("paper_3_1_fja", RIGID), "rigid17_fjb": ("paper_3_1_fjb", RIGID),
         "3.1_fja": ("paper_3_1_fja", REDUCED), "3.1_fjb": ("paper_3_1_fjb", REDUCED),
         "3.1_tied": ("paper_3_1_fja", {**REDUCED, "Joints/Model": "tied"}),
         "3.2_ksm_play": ("paper_3_2_ksm", {KEYS + "Clearance": 0.02}),
         "3.2_ksm_friction": ("paper_3_2_ksm", {KEYS + "Friction": -1}),
         "3.2_ksm_radial": ("paper_3_2_ksm", {KEYS + "Direction": "radial"}),
         "3.2_ksm_vertical": ("paper_3_2_ksm", {KEYS + "Direction": "vertical"})}
NAMES = {"3.2_fja": "FJA", "3.2_fjb": "FJB", "3.2_ksm": "KSM", "3.1_fja": "FJA", "3.1_fjb": "FJB"}
ALONG_Y = ("3.2_fja", "3.2_fjb", "3.2_ksm")  # with the displacements of both sides of the joints


def probes_of_joints(options, case):
    """Output/Probes: a point half a metre to the right and to the left of each joint, at both edges of the crest. The program
    takes the nearest node of the monolith that the point is in: the node on the joint."""
    file = options.output / f"probes_{case}.txt"
    if not file.exists():
        directory = options.output / f"probes_{case}"
        program_output(options.voussoir, ROOT / "prm" / f"{CASES[case][0]}.prm", "--output", directory, "--overwrite",
                       settings={**CASES[case][1], "Motion/Duration": 0.2, "Output/Figures": "false"})
        points = read_table(directory / "joint_points.csv")
        probes = []
        for joint in sorted(set(points["joint"])):
            crest = (points["joint"] == joint) & (points["z"] > points["z"][points["joint"] == joint].max() - 1e-3)
            places = np.stack([points[c][crest] for c in "xyz"], axis=1)[np.argsort(points["depth"][crest])]
            normal = np.array([places[-1, 1] - places[0, 1], places[0, 0] - places[-1, 0], 0.])
            normal *= np.copysign(0.5, normal[1]) / np.linalg.norm(normal)  # to the left bank
            probes += [f"{side}_{face}_{joint:.0f}: " + " ".join(f"{x:.4f}" for x in place + sign * normal)
                       for face, place in zip(FACES, places[[0, -1]]) for side, sign in (("right", -1), ("left", 1))]
        file.write_text("; ".join(probes))
    return file.read_text()


def settings_of(options, case, seed):
    settings = {**CASES[case][1], "Motion/Seed": seed, "Output/Figures": "false"}
    if case in ALONG_Y:
        settings["Output/Probes"] = probes_of_joints(options, case)
    if not case.startswith("3.1"):
        pass
    elif options.rock == "full":
        settings = {key: value for key, value in settings.items() if key not in REDUCED}
    else:
        motion = (options.output / f"motion_{seed}.csv").resolve()
        if not motion.exists():
            options.output.mkdir(parents=True, exist_ok=True)
            program_output(options.voussoir, "motion", ROOT / "prm" / "paper_3_1_fja.prm", "--output", motion,
                           settings={"Motion/Seed": seed})
        settings.update({"Motion/Source": "file", "Motion/File": motion, "Motion/Duration": UNTIL})
    return {key: str(value) for key, value in settings.items()}


def simulate(options, case, seed):
    """Returns whether the run was made; a run that is there with the same settings is left alone."""
    directory = options.output / case / f"seed_{seed}"
    settings, note = settings_of(options, case, seed), directory / "settings.json"
    same = note.exists() and json.loads(note.read_text()) == settings
    if same and (directory / "summary.json").exists():
        return False
    resume = ["--resume"] if same and (directory / "checkpoint.bin").exists() else ["--overwrite"]
    directory.mkdir(parents=True, exist_ok=True)
    note.write_text(json.dumps(settings))
    scene = ROOT / "prm" / f"{CASES[case][0]}.prm"
    interval = 20 if case.startswith("3.1") else 4  # 0.04 s
    wanted = {"Output/Solution interval": interval} if seed == 1 and case in NAMES else {}
    program_output(options.voussoir, scene, "--output", directory, *resume, settings={**settings, **wanted})
    if wanted:
        write_profile(directory)
    return True


def joint_places(directory):
    """joint -> face -> places of the nodes that two neighbouring monoliths have in common, in tenths of millimetres."""
    nodes = read_table(directory / "faces.csv", ["face"])
    monoliths = {}
    for face, monolith, *place in zip(nodes["face"], nodes["monolith"], nodes["x"], nodes["y"], nodes["z"]):
        monoliths.setdefault((face, *np.round(place, 2) + 0.), set()).add(int(monolith))
    result = {}
    for (face, *place), both in monoliths.items():
        if len(both) == 2:
            result.setdefault(min(both), {}).setdefault(face, []).append(tuple(place))
    return result


def write_profile(directory):
    """profile.csv: the largest opening and slip over the stored times, over the height of each joint. Removes the fields."""
    places = [(joint, face, place) for joint, faces in joint_places(directory).items() for face, all_places
              in faces.items() for place in all_places]
    largest, where = np.zeros((len(places), 2)), None
    files = sorted(directory.glob("solution-*.vtu"))
    for file in files:
        fields = read_vtu(file)
        if where is None:
            pairs = np.flatnonzero(np.array(fields["joint_state"]) >= 0)
            tree = cKDTree(np.array(fields["Points"]).reshape(-1, 3)[pairs])
            distance, nearest = tree.query([place for _, _, place in places])
            where = np.where(distance < 0.05, pairs[nearest], -1)  # the feet of the joints are tied
        values = np.column_stack([np.array(fields["opening"]), np.abs(np.array(fields["slip"]))])[where]
        largest = np.maximum(largest, np.where(where[:, None] >= 0, values, 0.))
    with open(directory / "profile.csv", "w") as out:
        out.write("joint,face,z,opening,slip\n")
        for (joint, face, place), (opening, slip) in zip(places, largest):
            out.write(f"{joint},{face},{place[2]:.2f},{opening:.6g},{slip:.6g}\n")
    for file in [*files, directory / "solution.pvd"]:
        file.unlink(missing_ok=True)


def load(output):
    """case -> seed -> Run"""
    runs = {}
    for case in CASES:
        for directory in sorted((output / case).glob("seed_*")):
            if (directory / "summary.json").exists() and (directory / "faces.csv").exists():
                runs.setdefault(case, {})[int(directory.name[5:])] = Run(directory)
    return runs


def scatter(values, digits=1, unit=""):
    """mean +- standard deviation (smallest to largest)"""
    values = np.asarray(values, dtype=float)
    deviation = values.std(ddof=1) if len(values) > 1 else 0.
    return f"{values.mean():.{digits}f}{unit} +- {deviation:.{digits}f} ({values.min():.{digits}f} to {values.max():.{digits}f})"


def both(runs, first, second):
    """Seeds that both cases have."""
    return sorted(set(runs.get(first, {})) & set(runs.get(second, {})))


def rms(a, b, weights=None):
    return np.sqrt(np.average((a - b)**2, weights=weights))


def print_cases(runs):
    print("| case | motions | upper mean u/s [MPa] | d/s | upper area < 1.5 MPa u/s [%] | whole face < 1.5 u/s | d/s | "
          "mean of whole face u/s [MPa] | d/s |\n" + "|---" * 9 + "|")
    for case, by_seed in runs.items():
        m = [run.measures() for run in by_seed.values()]
        columns = [(f"{what}_{face}", 0 if "share" in what else 2) for what, face in (
            ("upper_mean", "upstream"), ("upper_mean", "downstream"), ("upper_share", "upstream"),
            ("whole_share", "upstream"), ("whole_share", "downstream"), ("whole_mean", "upstream"),
            ("whole_mean", "downstream"))]
        print(f"| {case} | {len(m)} | " + " | ".join(scatter([row[c] for row in m], d) for c, d in columns) + " |")
    print("\n| case | mean opening [mm] | largest | first joint | last joint | inner joints | mean slip | largest slip | "
          "Newton mean, max | energy |\n" + "|---" * 10 + "|")
    for case, by_seed in runs.items():
        m = [run.measures() for run in by_seed.values() if not run.tied]
        if m:
            names = ("mean_opening", "largest_opening", "first_opening", "last_opening", "inner_opening", "mean_slip",
                     "largest_slip")
            print(f"| {case} | " + " | ".join(scatter([row[c] for row in m]) for c in names) +
                  f" | {np.mean([row['newton_mean'] for row in m]):.2f}, {max(row['newton_max'] for row in m)} | "
                  f"{max(row['energy_balance'] for row in m):.0e} |")


def print_pairs(runs):
    """Each law less another one, motion by motion: + means that the first is larger."""
    print("\n| pair | motions | mean opening, ratio | smaller in | joints (of all) with smaller opening | first joint, "
          "difference [mm] | last joint | inner joints, mean | upper mean u/s [MPa] | d/s | opening, rms [mm] | "
          "slip, rms [mm] | envelope u/s, rms [MPa] |\n" + "|---" * 13 + "|")
    keys = [case for case in CASES if "ksm" in case]
    for first, second in [("3.2_fjb", "3.2_fja"), *((case, other) for case in keys for other in ("3.2_fja", "3.2_fjb")),
                          ("3.1_fjb", "3.1_fja"), ("rigid17_fjb", "rigid17_fja")]:
        seeds = both(runs, first, second)
        if not seeds:
            continue
        pairs = [(runs[first][seed], runs[second][seed]) for seed in seeds]
        wide = np.array([[run.openings.max(axis=1) for run in pair] for pair in pairs])  # motion, law, joint
        m = [[run.measures() for run in pair] for pair in pairs]
        ratio = wide[:, 0].mean(axis=1) / wide[:, 1].mean(axis=1)
        change = wide[:, 0] - wide[:, 1]
        print(f"| {first} - {second} | {len(seeds)} | {scatter(ratio, 2)} | {(ratio < 1).sum()} of {len(seeds)} | "
              f"{(change < 0).sum()} of {change.size} | {scatter(change[:, 0])} | {scatter(change[:, -1])} | "
              f"{scatter(change[:, 1:-1].mean(axis=1))} | " +
              " | ".join(scatter([a[f"upper_mean_{face}"] - b[f"upper_mean_{face}"] for a, b in m], 2) for face in FACES) +
              f" | {scatter([rms(a.openings, b.openings) for a, b in pairs])} | "
              f"{scatter([rms(a.slips, b.slips) for a, b in pairs])} | " +
              scatter([rms(a.tension, b.tension, a.area * (a.face == "upstream")) for a, b in pairs], 2) + " |")


def print_along_y(runs):
    """Openings of each law over FJA's, motion by motion: normal to the joint, and along the dam's axis y."""
    seeds = sorted(set.intersection(*(set(runs.get(case, {})) for case in ALONG_Y)))
    print("\n| openings over FJA's, mean of the joints | direction | " + " | ".join(f"motion {seed}" for seed in seeds) +
          " | below 1 in |\n" + "|---" * (3 + len(seeds)) + "|")
    for case in ALONG_Y[1:]:
        for name, values in (("normal", lambda run: run.openings), ("along y", lambda run: run.along_y)):
            pairs = [[values(runs[c][seed]) for c in (case, "3.2_fja")] for seed in seeds]
            if pairs and all(value is not None for pair in pairs for value in pair):
                ratio = np.array([a.max(axis=1).mean() / b.max(axis=1).mean() for a, b in pairs])
                print(f"| {NAMES[case]} | {name} | " + " | ".join(f"{r:.2f}" for r in ratio) + f" | {(ratio < 1).sum()} of {len(ratio)} |")


def print_joints(runs):
    """Largest opening (of both faces) of each joint and law, mean and standard deviation over the motions."""
    for section in ("3.1", "rigid17", "3.2"):
        cases = [case for case in runs if case.startswith(section) and not case.endswith("tied")]
        if not cases:
            continue
        n = next(iter(runs[cases[0]].values())).openings.shape[0]
        print(f"\n| {section}: largest opening [mm] | " + " | ".join(joint_names(n)) + " |\n" + "|---" * (n + 1) + "|")
        for case in cases:
            for what in ("openings", "slips"):
                values = np.array([getattr(run, what).max(axis=1) for run in runs[case].values()])
                if what == "openings" or values.max() > 1e-3:
                    deviation = values.std(axis=0, ddof=1) if len(values) > 1 else 0 * values[0]
                    print(f"| {case}, {what} | " +
                          " | ".join(f"{v:.1f} +- {d:.1f}" for v, d in zip(values.mean(axis=0), deviation)) + " |")
        seeds = both(runs, f"{section}_fja", f"{section}_fjb")
        if len(seeds) > 1:
            more = np.array([np.subtract(*(runs[f"{section}_{law}"][seed].openings.max(axis=1) for law in ("fjb", "fja"))) for seed in seeds])
            print("| FJB less FJA, openings | " + " | ".join(
                f"{v:+.1f} +- {d:.1f}" for v, d in zip(more.mean(axis=0), more.std(axis=0, ddof=1))) + " |")


def print_cut(output):
    """What is lost of section 3.2's largest openings without what comes after UNTIL, as in section 3.1."""
    whole, cut = [], []
    for file in sorted(file for law in ("fja", "fjb") for file in output.glob(f"3.2_{law}/seed_*/joint_history.csv")):
        history = read_table(file)
        for j in range(1, 1 + sum(name.startswith("opening_upstream_") for name in history)):
            opening = np.maximum(*(history[f"opening_{face}_{j}"] for face in FACES))
            whole.append(opening.max())
            cut.append(opening[history["time"] <= UNTIL].max())
    if whole:
        whole, cut = np.array(whole), np.array(cut)
        print(f"\n3.2, FJA and FJB: {(cut < whole).sum()} of {len(whole)} largest openings come after {UNTIL} s; without, the mean "
              f"is {100 * (1 - cut.mean() / whole.mean()):.1f} % smaller, one {100 * (1 - cut / whole).max():.0f} %")


def joint_names(n):
    return [chr(ord("A") + j) for j in range(n)] if n > 5 else [str(j + 1) for j in range(n)]


def write_csv(runs, directory):
    with open(directory / "paper_runs.csv", "w", newline="") as out:
        rows = [{"case": case, "seed": seed, **{k: f"{v:.5g}" for k, v in run.measures().items()}}
                for case, by_seed in runs.items() for seed, run in by_seed.items()]
        writer = csv.DictWriter(out, max((list(row) for row in rows), key=len), restval="")
        writer.writeheader()
        writer.writerows(rows)
    with open(directory / "paper_joints.csv", "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["case", "seed", "joint"] + [f"{what}_{face}_mm" for what in ("opening", "slip") for face in FACES])
        for case, by_seed in runs.items():
            for seed, run in by_seed.items():
                if not run.tied:
                    names = joint_names(len(run.openings))
                    writer.writerows([case, seed, name, *np.round(o, 3), *np.round(s, 3)]
                                     for name, o, s in zip(names, run.openings, run.slips))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("run", "report"))
    add_program_argument(parser)
    parser.add_argument("--output", type=Path, default=ROOT / "output" / "paper")
    parser.add_argument("--motions", type=int, default=7)
    parser.add_argument("--first", type=int, default=1, help="seed of the first motion")
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    parser.add_argument("--rock", choices=("reduced", "full"), default="reduced", help="mesh and duration of section 3.1")
    parser.add_argument("--figures", type=Path, default=ROOT / "doc" / "figures")
    parser.add_argument("--csv", type=Path, default=ROOT / "doc")
    options = parser.parse_args()
    status = 0
    if options.what == "run":
        for seed in range(options.first, options.first + options.motions):
            for case in options.cases:
                try:
                    made = simulate(options, case, seed)
                    print(f"{case}, motion {seed}: {'done' if made else 'there'}", flush=True)
                except SystemExit as failure:  # the program's last words
                    print(f"{case}, motion {seed}: {str(failure).strip().splitlines()[-1]}", flush=True)
                    status = 1
        return status
    runs = load(options.output)
    if not runs:
        print(f"paper: error: no finished run in {options.output}; make some with benchmarks/paper.py run", file=sys.stderr)
        return 2
    print_cases(runs)
    print_pairs(runs)
    print_along_y(runs)
    print_joints(runs)
    print_cut(options.output)
    write_csv(runs, options.csv)
    draw(runs, options.output, options.figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
