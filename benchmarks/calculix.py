#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Voussoir against CalculiX on the same mesh: the tied (linear, monolithic) dam on a rigid base.

    benchmarks/calculix.py SCENE.prm [--set 'Section/Entry=value']... [options]
    benchmarks/calculix.py --only-calculix --mesh FILE.msh [--motion FILE] [options]

Compared: natural frequencies, the crown crest under static load, and its linear history
under base acceleration.  Both programs get the same nodes, the same consistent nodal forces of the
water (no added mass), the same mass, Rayleigh damping and trapezoidal Newmark.  The first form takes the mesh
from `voussoir mesh`, the motion from `voussoir motion`, and material, water, damping and time step from the scene.
The scene must say: tied joints, rigid base, no added mass, and the static load named by --static.

Voussoir's mass is lumped.  CalculiX's is consistent: --mass lumped gives it a weightless solid with a point mass
at each node instead.  Its point masses have no mass-proportional damping, so that the histories agree only if
the scene has (nearly) none.

Exit status: 0 agreement, 1 disagreement or a failed run, 2 bad input, 77 skipped (no CalculiX).
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import program  # noqa: F401  for the path of the package
from voussoir.prm import read_entries
from voussoir.program import set_options

SURFACES = {"base": 1, "upstream": 2, "downstream": 3, "crest": 4}
HEXAHEDRON, QUADRILATERAL = 5, 3  # gmsh element types
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TOLERANCE = {"frequency": 0.01, "static": 0.01, "history": 0.03}


@dataclass
class Mesh:
    """Nodes (n,3), hexahedra (m,8) and the quadrilaterals of each surface, by zero-based node."""

    nodes: np.ndarray
    hexahedra: np.ndarray
    surfaces: dict

    def surface_nodes(self, name):
        return np.unique(self.surfaces[name])


def read_sections(path):
    sections, lines = {}, []
    for line in path.read_text().splitlines():
        if line.startswith("$"):
            lines = sections.setdefault(line[1:].strip(), [])
        elif line.strip():
            lines.append(line)
    return sections


def read_nodes_and_elements_2(sections):
    nodes = {int(f[0]): f[1:4] for f in (line.split() for line in sections["Nodes"][1:])}
    elements = [[int(word) for word in line.split()] for line in sections["Elements"][1:]]
    return nodes, [(f[1], f[3], f[3 + f[2]:]) for f in elements]  # type, physical id, node tags


def read_nodes_and_elements_4(sections):
    lines = iter(sections["Entities"])
    physical = {}  # (dimension, entity) -> physical id
    for dimension, count in enumerate(next(lines).split()):
        for _ in range(int(count)):
            f = next(lines).split()
            first = 4 if dimension == 0 else 7
            if int(f[first]) > 0:
                physical[dimension, int(f[0])] = int(f[first + 1])
    nodes = {}
    lines = iter(sections["Nodes"])
    for _ in range(int(next(lines).split()[0])):
        tags = [int(next(lines)) for _ in range(int(next(lines).split()[3]))]
        nodes.update((tag, next(lines).split()[:3]) for tag in tags)
    elements = []
    lines = iter(sections["Elements"])
    for _ in range(int(next(lines).split()[0])):
        dimension, entity, kind, count = (int(word) for word in next(lines).split())
        elements += [(kind, physical.get((dimension, entity), 0), [int(word) for word in next(lines).split()[1:]])
                     for _ in range(count)]
    return nodes, elements


def read_mesh(path):
    """A conforming mesh of 8-node hexahedra, gmsh MSH 2.2 or 4.1, ASCII."""
    sections = read_sections(path)
    version, binary = (sections.get("MeshFormat") or ["? 0"])[0].split()[:2]
    readers = {"2.2": read_nodes_and_elements_2, "4.1": read_nodes_and_elements_4}
    if version not in readers or binary != "0":
        raise ValueError(f"{path} is not an ASCII gmsh file of version 2.2 or 4.1")
    raw_nodes, elements = readers[version](sections)

    ids = dict(SURFACES)
    for line in sections.get("PhysicalNames", ["0"])[1:]:
        dimension, number, name = line.split(maxsplit=2)
        if dimension == "2" and name.strip('"') in ids:
            ids[name.strip('"')] = int(number)

    hexahedra = [tags for kind, physical, tags in elements if kind == HEXAHEDRON and physical < 1000]
    used = sorted(set(tag for tags in hexahedra for tag in tags))
    if not used:
        raise ValueError(f"{path} holds no 8-node hexahedra")
    index = {tag: i for i, tag in enumerate(used)}
    nodes = np.array([raw_nodes[tag] for tag in used], dtype=float)
    if len(np.unique(nodes.round(6), axis=0)) < len(nodes):
        raise ValueError(f"{path} has coincident nodes; this comparison needs the conforming mesh")
    surfaces = {}
    for name, number in ids.items():
        quads = [[index[tag] for tag in tags] for kind, physical, tags in elements
                 if kind == QUADRILATERAL and physical == number]
        if not quads:
            raise ValueError(f"{path} has no quadrilaterals on surface '{name}' (id {number})")
        surfaces[name] = np.array(quads)
    hexahedra = np.array([[index[tag] for tag in tags] for tags in hexahedra])
    corner = nodes[hexahedra]
    volume = np.einsum("ij,ij->i", np.cross(corner[:, 1] - corner[:, 0], corner[:, 3] - corner[:, 0]),
                       corner[:, 4] - corner[:, 0])
    hexahedra[volume < 0] = hexahedra[volume < 0][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    return Mesh(nodes, hexahedra, surfaces)


def add_midside_nodes(mesh):
    """Straight 20-node hexahedra and 8-node faces on the same corners."""
    nodes, middle = list(mesh.nodes), {}

    def midside(*ends):
        if frozenset(ends) not in middle:
            middle[frozenset(ends)] = len(nodes)
            nodes.append(mesh.nodes[list(ends)].mean(axis=0))
        return middle[frozenset(ends)]

    hexahedra = [list(cell) + [midside(cell[a], cell[b]) for a, b in HEX_EDGES] for cell in mesh.hexahedra]
    surfaces = {name: np.array([list(q) + [midside(q[i], q[(i + 1) % 4]) for i in range(4)] for q in quads])
                for name, quads in mesh.surfaces.items()}
    return Mesh(np.array(nodes), np.array(hexahedra), surfaces)


def crown_crest(mesh, face, downstream):
    """Of the crest's nodes on a face the one that lies farthest upstream."""
    edge = np.intersect1d(mesh.surface_nodes("crest"), mesh.surface_nodes(face))
    return edge[np.argmin(mesh.nodes[edge, downstream])]


def face_shapes(xi, eta, quadratic):
    """Shape functions of a 4- or 8-node quadrilateral."""
    a, b = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    if not quadratic:
        return (1 + a * xi) * (1 + b * eta) / 4
    corners = (1 + a * xi) * (1 + b * eta) * (a * xi + b * eta - 1) / 4
    return np.append(corners, [(1 - xi**2) * (1 - eta) / 2, (1 + xi) * (1 - eta**2) / 2,
                               (1 - xi**2) * (1 + eta) / 2, (1 - xi) * (1 - eta**2) / 2])


def water_forces(mesh, level, density, gravity, n_points):
    """Consistent nodal forces (n,3) of the hydrostatic pressure on the upstream face, by n x n Gauss points
    (quadratic faces: at least 3 x 3).  On partly wet faces the number of points matters."""
    quadratic = mesh.hexahedra.shape[1] == 20
    points, weights = np.polynomial.legendre.leggauss(max(n_points, 3) if quadratic else n_points)
    owner = {tuple(sorted(cell[list(face)])): mesh.nodes[cell[:8]].mean(axis=0) for cell in mesh.hexahedra
             for face in [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
    forces = np.zeros_like(mesh.nodes)
    for quad in mesh.surfaces["upstream"]:
        p = mesh.nodes[quad[:4]]  # straight edges: the geometry is bilinear in any case
        inwards = owner[tuple(sorted(quad[:4]))] - p.mean(axis=0)
        for xi, weight_xi in zip(points, weights):
            for eta, weight_eta in zip(points, weights):
                along_xi = ((1 - eta) * (p[1] - p[0]) + (1 + eta) * (p[2] - p[3])) / 4
                along_eta = ((1 - xi) * (p[3] - p[0]) + (1 + xi) * (p[2] - p[1])) / 4
                area = np.cross(along_xi, along_eta) * weight_xi * weight_eta
                area *= np.sign(area @ inwards)
                depth = max(0., level - face_shapes(xi, eta, False) @ p[:, 2])
                forces[quad] += np.outer(face_shapes(xi, eta, quadratic), density * gravity * depth * area)
    return forces


def lumped_masses(mesh, density):
    """Row sums of the consistent mass of 8-node hexahedra, by 2 x 2 x 2 Gauss points."""
    signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                      (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], dtype=float)
    masses = np.zeros(len(mesh.nodes))
    for point in signs / np.sqrt(3):
        factors = 1 + signs * point
        shape = factors.prod(axis=1) / 8
        slope = np.stack([signs[:, k] * np.delete(factors, k, axis=1).prod(axis=1) / 8 for k in range(3)], axis=1)
        jacobian = mesh.nodes[mesh.hexahedra].transpose(0, 2, 1) @ slope
        np.add.at(masses, mesh.hexahedra, density * np.abs(np.linalg.det(jacobian))[:, None] * shape)
    return masses


def read_motion(path):
    """Columns t, a_x, a_y, a_z (s, m/s^2), separated by commas or blanks, in the mesh's axes."""
    lines = [line.replace(",", " ").split() for line in path.read_text().splitlines() if line.strip()]
    motion = np.array([words[:4] for words in lines if words[0][0] in "+-.0123456789"], dtype=float)
    if motion.ndim != 2 or motion.shape[0] < 2 or motion.shape[1] != 4:
        raise ValueError(f"{path} does not hold the four columns t, a_x, a_y, a_z")
    return motion


@dataclass
class CalculiX:
    """Writes the input, runs ccx, reads the .dat file; one job per analysis."""

    mesh: Mesh
    probe: int
    options: argparse.Namespace
    directory: Path

    def model(self):
        o, lines = self.options, ["*NODE, NSET=ALL"]
        lines += [f"{i + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for i, (x, y, z) in enumerate(self.mesh.nodes)]
        lines += [f"*ELEMENT, TYPE={o.element}, ELSET=DAM"]
        for i, cell in enumerate(self.mesh.hexahedra):
            words = [str(i + 1)] + [str(node + 1) for node in cell]
            lines += [", ".join(words[:11]) + ","] + ([", ".join(words[11:])] if words[11:] else [])
        # One set per direction of shaking: CalculiX takes one GRAV load per set.
        for axis in "XYZ":
            lines += [f"*ELSET, ELSET=DAM{axis}", "DAM"]
        lines += ["*NSET, NSET=BASE"] + [str(node + 1) for node in self.mesh.surface_nodes("base")]
        lines += ["*NSET, NSET=CREST", str(self.probe + 1), "*BOUNDARY", "BASE, 1, 3"]
        density = o.density * (1e-9 if o.mass == "lumped" else 1)
        lines += ["*MATERIAL, NAME=CONCRETE", "*ELASTIC", f"{o.young:.12g}, {o.poisson:.12g}"]
        lines += ["*DENSITY", f"{density:.12g}"]
        lines += [f"*DAMPING, ALPHA={o.damping[0]:.12g}, BETA={o.damping[1]:.12g}"] if any(o.damping) else []
        lines += ["*SOLID SECTION, ELSET=DAM, MATERIAL=CONCRETE"]
        if o.mass == "lumped":
            first = len(self.mesh.hexahedra) + 1
            for i, mass in enumerate(lumped_masses(self.mesh, o.density)):
                lines += [f"*ELEMENT, TYPE=MASS, ELSET=MASS{i + 1}", f"{first + i}, {i + 1}",
                          f"*MASS, ELSET=MASS{i + 1}", f"{mass:.12g}"]
        return lines

    def run(self, job, steps):
        """The .dat file of one job, as lines."""
        base = self.directory / job
        base.with_suffix(".inp").write_text("\n".join(self.model() + steps) + "\n")
        base.with_suffix(".dat").unlink(missing_ok=True)
        start = time.time()
        result = subprocess.run([self.options.ccx, job], cwd=self.directory, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        base.with_suffix(".log").write_text(result.stdout)
        if result.returncode or "*ERROR" in result.stdout or not base.with_suffix(".dat").exists():
            raise RuntimeError(f"CalculiX failed on {base}.inp; the end of its output:\n{result.stdout[-1500:]}")
        print(f"CalculiX  {job}: {time.time() - start:.1f} s", flush=True)
        return base.with_suffix(".dat").read_text().splitlines()

    def displacements(self, dat):
        """Rows of time, u_x, u_y, u_z of the probe."""
        rows = []
        for i, line in enumerate(dat):
            if line.strip().startswith("displacements"):
                rows.append([float(line.split()[-1])] + [float(word) for word in dat[i + 2].split()[1:4]])
        return np.array(rows)

    def static(self):
        """Crown crest displacement (m) under water alone and under gravity alone."""
        o = self.options
        forces = water_forces(self.mesh, o.water_level, o.water_density, o.gravity, o.water_points)
        loads = [f"{i + 1}, {k + 1}, {forces[i, k]:.12g}" for i, k in zip(*np.nonzero(forces))]
        output = ["*NODE PRINT, NSET=CREST", "U", "*END STEP"]
        steps = ["*STEP", "*STATIC", "*CLOAD"] + loads + output
        if o.mass == "lumped":
            masses = lumped_masses(self.mesh, o.density)
            weight = [f"{i + 1}, 3, {-o.gravity * mass:.12g}" for i, mass in enumerate(masses)]
            steps += ["*STEP", "*STATIC", "*CLOAD, OP=NEW"] + weight + output
        else:
            steps += ["*STEP", "*STATIC", "*CLOAD, OP=NEW", "*DLOAD", f"DAM, GRAV, {o.gravity:.12g}, 0, 0, -1"] + output
        rows = self.displacements(self.run("static", steps))
        print(f"          water resultant {forces.sum(axis=0) / 1e6} MN")
        return {"water": rows[0, 1:], "gravity": rows[1, 1:]}

    def frequencies(self):
        """Natural frequencies (Hz), damping ignored."""
        dat = self.run("modes", ["*STEP", "*FREQUENCY", str(self.options.modes), "*END STEP"])
        start = next(i for i, line in enumerate(dat) if "E I G E N V A L U E   O U T P U T" in line)
        table = [line.split() for line in dat[start + 1:] if len(line.split()) == 5]
        return [float(words[3]) for words in table if words[0].isdigit()][:self.options.modes]

    def history(self, motion):
        """Rows of time, u_x, u_y, u_z of the crown crest relative to the base, from rest, without static loads."""
        o, steps = self.options, []
        masses = lumped_masses(self.mesh, o.density) if o.mass == "lumped" else []
        for k, axis in enumerate("XYZ"):
            steps += [f"*AMPLITUDE, NAME=BASE{axis}"]
            steps += [f"{t:.9g}, {a:.12g}" for t, a in zip(motion[:, 0], motion[:, k + 1])]
        steps += [f"*STEP, INC={o.steps + 10}", "*DYNAMIC, DIRECT, ALPHA=0", f"{o.dt:.9g}, {o.steps * o.dt:.9g}"]
        for k, axis in enumerate("XYZ"):
            direction = ", ".join("-1." if i == k else "0." for i in range(3))
            if o.mass == "lumped":
                steps += [f"*CLOAD, AMPLITUDE=BASE{axis}"]
                steps += [f"{i + 1}, {k + 1}, {-mass:.12g}" for i, mass in enumerate(masses)]
            else:
                steps += [f"*DLOAD, AMPLITUDE=BASE{axis}", f"DAM{axis}, GRAV, 1., {direction}"]
        steps += ["*NODE PRINT, NSET=CREST, FREQUENCY=1", "U", "*END STEP"]
        return self.displacements(self.run("history", steps))


def voussoir(options, *arguments):
    command = [options.voussoir, *arguments, *set_options(options.set)]
    print("Voussoir  " + " ".join(command[1:]), flush=True)
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if result.returncode:
        raise RuntimeError(f"{' '.join(command)} failed ({result.returncode}):\n{result.stdout[-1500:]}{result.stderr}")
    return result.stdout


def take_from_scene(options, path):
    scene = {entry: value for entry, (value, _) in read_entries(path.read_text()).items()}
    for name, entry in [("young", "Concrete/Young's modulus"), ("poisson", "Concrete/Poisson's ratio"),
                        ("density", "Concrete/Density"), ("water_level", "Reservoir/Water level"),
                        ("water_density", "Reservoir/Density"), ("gravity", "Statics/Gravity"),
                        ("dt", "Motion/Time step")]:
        setattr(options, name, float(scene[entry]))
    ratio, f1, f2 = (float(scene["Damping/" + name]) for name in ("Ratio", "Frequency 1", "Frequency 2"))
    options.damping = [4 * np.pi * ratio * f1 * f2 / (f1 + f2), ratio / (np.pi * (f1 + f2))]
    if scene["Motion/Source"] != "none" and float(scene["Motion/Duration"]) < 0:
        sys.exit(f"{path}: set Motion/Duration, which is automatic")
    options.steps = round(float(scene["Motion/Duration"]) / options.dt) if scene["Motion/Source"] != "none" else 0


def run_voussoir(options, directory):
    """Mesh, motion, frequencies, static crest displacement, and the history relative to it."""
    scene, output = options.scene, directory / "voussoir"
    voussoir(options, "mesh", scene, "--output", str(directory / "dam.msh"))
    table = [line.split() for line in voussoir(options, "modes", scene, "--count", str(options.modes)).splitlines()]
    frequencies = [float(row[1]) for row in table if len(row) >= 2 and row[0].isdigit()]
    start = time.time()
    voussoir(options, scene, "--output", str(output))
    print(f"          static state and history: {time.time() - start:.1f} s")
    take_from_scene(options, output / "scene.prm")
    if options.steps > 0:
        voussoir(options, "motion", scene, "--output", str(directory / "motion.csv"))
    summary = json.loads((output / "summary.json").read_text())
    static = np.array(summary["static"]["crest_displacement"])
    table = np.atleast_1d(np.genfromtxt(output / "history.csv", delimiter=",", names=True))
    history = np.stack([table[name] for name in ("time", "crest_x", "crest_y", "crest_z")], axis=1)
    history[:, 1:] -= static
    return {"frequencies": frequencies, "static": static, "history": history if options.steps > 0 else None,
            "crest_point": summary["static"].get("crest_point")}


def compare(name, ours, theirs, difference, limit):
    """One line of the table; true where the programs agree."""
    verdict = "ok" if difference <= limit else "DIFFERS"
    print(f"{name:<30}{ours:>14.6g}{theirs:>14.6g}{difference:>12.3%}   {verdict}")
    return bool(difference <= limit)


def compare_all(ours, theirs):
    print(f"\n{'':<30}{'Voussoir':>14}{'CalculiX':>14}{'difference':>12}")
    agree = []
    for k, f in enumerate(theirs["frequencies"]):
        mine = ours["frequencies"][k] if k < len(ours["frequencies"]) else np.inf
        agree.append(compare(f"frequency {k + 1} [Hz]", mine, f, abs(mine / f - 1), TOLERANCE["frequency"]))
    for mine, reference, axis in zip(ours["static"], theirs["static"], "xyz"):
        difference = abs(mine - reference) / np.linalg.norm(theirs["static"])
        agree.append(compare(f"static crest {axis} [m]", mine, reference, difference, TOLERANCE["static"]))
    if ours["history"] is None:
        return all(agree)
    times, reference = theirs["history"][:, 0], theirs["history"][:, 1:]
    for k, axis in enumerate("xyz"):
        mine = np.interp(times, ours["history"][:, 0], ours["history"][:, k + 1], right=np.inf)  # too short: differs
        difference = np.linalg.norm(mine - reference[:, k]) / np.linalg.norm(reference)
        agree.append(compare(f"history crest {axis}, peak [m] *", np.abs(mine).max(), np.abs(reference[:, k]).max(),
                             difference, TOLERANCE["history"]))
    print("* the difference is the L2 norm over the whole history")
    return all(agree)


def parse_arguments():
    root = Path(__file__).resolve().parent.parent
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0],
                                formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    p.add_argument("scene", nargs="?", help="scene of the tied dam")
    p.add_argument("--set", action="append", default=[], metavar="ENTRY=VALUE", help="passed on to voussoir")
    p.add_argument("--voussoir", default=str(root / "build" / "voussoir"), help="the program")
    p.add_argument("--ccx", default="ccx", help="the CalculiX program")
    p.add_argument("--only-calculix", action="store_true", help="run CalculiX alone and print its results")
    p.add_argument("--mesh", type=Path, help="its conforming gmsh mesh")
    p.add_argument("--motion", type=Path, help="its base acceleration: t, a_x, a_y, a_z (no history without)")
    p.add_argument("--element", default="C3D8I", choices=["C3D8", "C3D8I", "C3D20R"])
    p.add_argument("--mass", default="consistent", choices=["consistent", "lumped"], help="mass in CalculiX")
    p.add_argument("--damping", type=float, nargs=2, default=[0.785, 0.00177], help="Rayleigh a0 [1/s], a1 [s]")
    for name, default, meaning in [
            ("young", 21e9, "Pa"), ("poisson", 0.17, "Poisson's ratio"), ("density", 2400., "kg/m3"),
            ("water-level", 195., "z, m"), ("water-density", 1000., "kg/m3"), ("gravity", 9.81, "m/s2"),
            ("water-points", 8, "Gauss points per direction of a face"), ("modes", 6, "number of frequencies"),
            ("dt", 0.01, "time step, s"), ("steps", 200, "number of time steps")]:
        p.add_argument("--" + name, type=type(default), default=default, help=meaning)
    p.add_argument("--static", default="water", choices=["water", "gravity", "both"], help="static load of the scene")
    p.add_argument("--downstream", default="x", choices=["x", "y"], help="downstream axis of the mesh")
    p.add_argument("--crest", default="upstream", choices=["upstream", "downstream"], help="face of the crown node")
    p.add_argument("--directory", type=Path, help="where to keep all files (else a temporary one)")
    return p.parse_args()


def main():
    o = parse_arguments()
    if shutil.which(o.ccx) is None:
        print(f"SKIPPED: {o.ccx} not found (Debian package calculix-ccx)")
        return 77
    if o.only_calculix and o.mesh is None:
        raise ValueError("--only-calculix needs --mesh FILE.msh")
    if not o.only_calculix and (o.scene is None or not shutil.which(o.voussoir)):
        raise ValueError(f"needs a scene and the program {o.voussoir}; or use --only-calculix --mesh FILE.msh")
    with tempfile.TemporaryDirectory() as temporary:
        directory = o.directory or Path(temporary)
        directory.mkdir(parents=True, exist_ok=True)
        return run(o, directory.resolve())


def run(o, directory):
    ours = {"crest_point": None}
    if not o.only_calculix:
        ours = run_voussoir(o, directory)
        o.mesh = directory / "dam.msh"
        o.motion = directory / "motion.csv" if o.steps > 0 else None
    mesh = read_mesh(o.mesh)
    probe = crown_crest(mesh, o.crest, "xy".index(o.downstream))
    if ours["crest_point"] is not None:
        probe = np.argmin(np.linalg.norm(mesh.nodes - ours["crest_point"], axis=1))
    if o.element == "C3D20R" and o.mass == "lumped":
        raise ValueError("--mass lumped needs 8-node elements")
    if o.element == "C3D20R":
        mesh = add_midside_nodes(mesh)
    print(f"{o.mesh}: {len(mesh.hexahedra)} {o.element}, {len(mesh.nodes)} nodes, crown crest at {mesh.nodes[probe]}")

    calculix = CalculiX(mesh, probe, o, directory)
    static = calculix.static()
    static["both"] = static["water"] + static["gravity"]
    theirs = {"static": static[o.static], "frequencies": calculix.frequencies(), "history": None}
    if o.motion:
        theirs["history"] = calculix.history(read_motion(o.motion))
        np.savetxt(directory / "calculix_history.csv", theirs["history"], delimiter=",",
                   header="time,crest_x,crest_y,crest_z", comments="")

    if o.only_calculix:
        peaks = np.abs(theirs["history"][:, 1:]).max(axis=0) if o.motion else []
        for name, values in [("frequencies [Hz]", theirs["frequencies"]), ("crest, water [m]", static["water"]),
                             ("crest, gravity [m]", static["gravity"]), ("crest, history peaks [m]", peaks)]:
            print(f"{name:<26}" + "".join(f"{value:>12.6f}" for value in values))
        return 0
    return 0 if compare_all(ours, theirs) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (ValueError, OSError, KeyError, RuntimeError) as error:
        missing = "not in the file or table: " if isinstance(error, KeyError) else ""
        print(f"calculix.py: error: {missing}{error}", file=sys.stderr)
        sys.exit(2 if isinstance(error, (ValueError, OSError)) else 1)
