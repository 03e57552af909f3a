#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a gmsh mesh (MSH 2.2, ASCII) of a mesh of Abaqus or CalculiX (.inp) or of Salome (.med).

    mesh_to_msh.py FILE OUTPUT.msh      needs meshio (Debian package python3-meshio); Voussoir runs it by itself

Groups become physical groups when their names are Voussoir's: "monolith 3", "MONOLITH_3_HEEL", "rock", "water", "upstream", ... (case,
blanks, '_' and '-' do not count); others are left out. In .inp they are ELSETs of volumes or of shells, *SURFACEs, and NSETs:
all outer faces whose corners are in the set, for "base" also the faces between dam and rock. In .med they are groups of
volumes, of faces and of nodes alike.

Exit status: 0 done, 2 the mesh cannot be used (the last line says why), 3 meshio is missing.
"""

import re
import sys
from pathlib import Path

try:
    import meshio
    import numpy  # noqa: F401 (of meshio)
except ImportError:
    sys.exit(3)

VOLUME = re.compile(r"(monolith[ _-]*\d+|rock|water$)")
SURFACE = re.compile(r"(base|upstream|downstream|crest|free[ _-]*surface|artificial([ _-]*boundary)?|water[ _-]*end|joint[ _-]*\d+.*)$")
# meshio's types: dimension, gmsh's number, corners of the faces (of Abaqus' labels S1, S2, ...)
HEXAHEDRON = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
WEDGE = ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0))
TYPES = {"hexahedron": (3, 5, 8, HEXAHEDRON), "hexahedron20": (3, 5, 8, HEXAHEDRON), "hexahedron27": (3, 5, 8, HEXAHEDRON),
         "wedge": (3, 6, 6, WEDGE), "wedge15": (3, 6, 6, WEDGE), "wedge18": (3, 6, 6, WEDGE),
         "tetra": (3, 4, 4, ()), "tetra10": (3, 4, 4, ()), "pyramid": (3, 7, 5, ()), "pyramid13": (3, 7, 5, ()),
         "quad": (2, 3, 4, ()), "quad8": (2, 3, 4, ()), "quad9": (2, 3, 4, ()),
         "triangle": (2, 2, 3, ()), "triangle6": (2, 2, 3, ())}


def refuse(text):
    print(text)
    sys.exit(2)


def known(name, pattern):
    return pattern.match(name.strip().lower()) is not None


def lines_of_inp(file):
    """Keywords of an .inp file in capitals, with their parameters and lines of data."""
    blocks = []
    for line in Path(file).read_text(errors="replace").splitlines():
        if line.startswith("*") and not line.startswith("**"):
            words = [word.strip() for word in line[1:].split(",")]
            pairs = (word.partition("=") for word in words[1:])
            blocks.append((words[0].upper(), {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}, []))
        elif blocks and line.strip() and not line.startswith("**"):
            blocks[-1][2].append([word.strip() for word in line.split(",") if word.strip()])
    return blocks


def elements_of_inp(blocks):
    """Numbers of the elements in the order of the file, and sets of elements by name in capitals. meshio loses the numbers, and
    reads only one block of nodes. It confuses sets if a block of elements has no set or the same set as another block."""
    if sum(keyword == "NODE" for keyword, _, _ in blocks) > 1 or any(
            keyword == "INCLUDE" or keyword == "INSTANCE" and data for keyword, _, data in blocks):
        refuse("it has several *NODE blocks, an *INCLUDE or a moved *INSTANCE, which meshio does not put together. Write a flat "
               "file, with all nodes in one block.")
    ids, sets = [], {}
    for keyword, parameters, data in blocks:
        name = parameters.get("ELSET", "").upper()
        if keyword == "ELEMENT":
            kind = meshio.abaqus._abaqus.abaqus_to_meshio_type.get(parameters.get("TYPE", "").upper())
            words = [word for line in data for word in line]
            here = [int(word) for word in words[::meshio._mesh.num_nodes_per_cell[kind] + 1]] if kind else []
            ids += here
            if name:
                sets.setdefault(name, []).extend(here)
        elif keyword == "ELSET":
            members = sets.setdefault(name, [])
            for line in data:
                if "GENERATE" in parameters:
                    first, last, step = (int(word) for word in (line + ["1"])[:3])
                    members += range(first, last + 1, step)
                else:
                    for word in line:
                        members += [int(word)] if word.isdigit() else sets.get(word.upper(), [])
    return ids, sets


def surfaces_of_inp(blocks):
    """*SURFACE, TYPE=ELEMENT: name -> (set or element, label)."""
    surfaces = {}
    for keyword, parameters, data in blocks:
        if keyword == "SURFACE":
            surfaces.setdefault(parameters.get("NAME", ""), []).extend((line + [""])[:2] for line in data)
    return surfaces


class Converter:
    def __init__(self, file):
        self.file, self.inp = file, Path(file).suffix.lower() == ".inp"
        self.blocks_of_inp = lines_of_inp(file) if self.inp else []
        self.ids, self.sets_of_inp = elements_of_inp(self.blocks_of_inp)
        self.mesh = (meshio.abaqus if self.inp else meshio.med).read(file)  # meshio.read() ends the program where these say why
        self.cells, start, self.blocks = [], 0, []  # [type, corners, group]; first number of each block
        for block in self.mesh.cells:
            self.blocks.append(start)
            if block.type not in TYPES and block.type not in ("line", "line3", "vertex"):
                refuse(f"it has elements of type '{block.type}', and the program needs hexahedra. Mesh the dam with them.")
            for nodes in block.data:
                self.cells.append([block.type, nodes[:TYPES[block.type][2]] if block.type in TYPES else (), None])
            start += len(block.data)
        self.faces = []  # of groups that are not elements: corners and group

    def dimension(self, k):
        return TYPES.get(self.cells[k][0], (0,))[0]

    def sets(self):
        """Element sets by name: numbers of cells."""
        if self.inp:
            number = {i: k for k, i in enumerate(self.ids)}
            return {name: [number[i] for i in dict.fromkeys(members) if i in number] for name, members in self.sets_of_inp.items()}
        sets = {name: [first + int(i) for first, part in zip(self.blocks, parts) if part is not None for i in part]
                for name, parts in self.mesh.cell_sets.items()}
        for tags, first in zip(self.mesh.cell_data.get("cell_tags", []), self.blocks):  # of .med
            for i, tag in enumerate(tags):
                for name in getattr(self.mesh, "cell_tags", {}).get(int(tag), []):
                    sets.setdefault(name, []).append(first + i)
        return sets

    def put(self, name, numbers):
        for k in numbers:
            group, pattern = self.cells[k][2], {3: VOLUME, 2: SURFACE}.get(self.dimension(k))
            if pattern is None or not known(name, pattern):
                continue
            if group is not None and group != name:
                refuse(f"an element is in two groups, '{group}' and '{name}'. Leave it in one.")
            self.cells[k][2] = name

    def cell_faces(self):
        """Faces of volumes by their corners: the cells that have them."""
        owners = {}
        for k, (kind, nodes, _) in enumerate(self.cells):
            for face in TYPES.get(kind, (0, 0, 0, ()))[3]:
                corners = tuple(nodes[list(face)])
                owners.setdefault(frozenset(corners), []).append((k, corners))
        return owners

    def is_in(self, k, group):
        return (self.cells[k][2] or "").strip().lower().startswith(group)

    def take_nodes(self, name, nodes, owners):
        """The faces whose corners are all in the set."""
        nodes = set(int(n) for n in nodes)
        for corners, cells in owners.items():
            cells = [cell for cell in cells if not self.is_in(cell[0], "water")] or cells  # the water is beside the body
            outer = len(cells) == 1 or name.lower().startswith("base") and self.is_in(cells[0][0], "rock") != self.is_in(cells[1][0], "rock")
            if outer and corners <= nodes:
                self.faces.append((cells[0][1], name))

    def point_sets(self):
        sets = dict(self.mesh.point_sets)
        for n, tag in enumerate(self.mesh.point_data.get("point_tags", [])):  # of .med
            for name in getattr(self.mesh, "point_tags", {}).get(int(tag), []):
                sets.setdefault(name, []).append(n)
        return sets

    def take_surfaces(self, sets):
        number = {i: k for k, i in enumerate(self.ids)}
        for name, parts in surfaces_of_inp(self.blocks_of_inp).items():
            if not known(name, SURFACE):
                continue
            for of, label in parts:
                cells = [number[int(of)]] if of.isdigit() and int(of) in number else sets.get(of.upper())
                if cells is None or not re.fullmatch(r"S[1-6]", label.upper()):
                    refuse(f"the surface '{name}' has the line '{of}, {label}', which is no face of a known element or set.")
                for k in cells:
                    kind, nodes, _ = self.cells[k]
                    if self.dimension(k) == 3:
                        self.faces.append((tuple(nodes[list(TYPES[kind][3][int(label[1]) - 1])]), name))

    def convert(self):
        sets = self.sets()
        for name, numbers in sets.items():
            self.put(name, numbers)
        if not any(group and self.dimension(k) == 3 for k, (_, _, group) in enumerate(self.cells)):
            refuse("no volumes are in a group 'monolith 1', 'monolith 2', ... (ELSET or group of volumes); its groups are: "
                   + (", ".join(f"'{name}'" for name in sets) or "none") + ".")
        if self.inp:
            self.take_surfaces(sets)
        there = {name.lower() for _, name in self.faces} | {group.lower() for _, _, group in self.cells if group}
        owners = None
        for name, nodes in self.point_sets().items():
            if known(name, SURFACE) and name.lower() not in there:
                owners = owners or self.cell_faces()
                self.take_nodes(name, nodes, owners)

    def write(self, file):
        elements = [(TYPES[kind][1], nodes, TYPES[kind][0], group) for kind, nodes, group in self.cells
                    if kind in TYPES and (group or TYPES[kind][0] == 3)]
        elements += [(3 if len(nodes) == 4 else 2, nodes, 2, name) for nodes, name in self.faces]
        tags = {}
        for _, _, dimension, group in elements:
            if group and (dimension, group) not in tags:
                tags[dimension, group] = len(tags) + 1
        with open(file, "w") as out:
            print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(tags), sep="\n", file=out)
            for (dimension, group), tag in tags.items():
                print(dimension, tag, f'"{group}"', file=out)
            print("$EndPhysicalNames\n$Nodes", len(self.mesh.points), sep="\n", file=out)
            for i, x in enumerate(self.mesh.points):
                print(i + 1, *(f"{c:.17g}" for c in x), file=out)
            print("$EndNodes\n$Elements", len(elements), sep="\n", file=out)
            for i, (kind, nodes, dimension, group) in enumerate(elements):
                tag = tags.get((dimension, group), 0)
                print(i + 1, kind, 2, tag, tag or 10000, *(n + 1 for n in nodes), file=out)
            print("$EndElements", file=out)


def main():
    try:
        converter = Converter(sys.argv[1])
        converter.convert()
    except (meshio.ReadError, KeyError, ValueError, IndexError, AssertionError, OSError, UnicodeDecodeError) as error:
        refuse(f"meshio cannot read it: {type(error).__name__} {error}. Write it again, or as a gmsh mesh.".replace("\n", " "))
    converter.write(sys.argv[2])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
