# SPDX-License-Identifier: GPL-3.0-or-later
"""Structured meshes for the golden scenes, written as gmsh MSH 2.2 with physical names. Metres; x downstream, y to the
left bank, z up."""

from math import cos, pi, radians, sin

NAMES = {1: "base", 2: "upstream", 3: "downstream", 4: "crest", 5: "free surface", 6: "artificial boundary", 7: "base joint"}


def write(file, nodes, hexes, quads, scale=1., volumes=None):
    """hexes, quads: (physical id, corners counted from 0). volumes: names by id, where they are not the usual ones."""
    usual = lambda i: f"monolith {i}" if i < 1000 else "rock"
    ids = [(3, i, (volumes or {}).get(i, usual(i))) for i in sorted({tag for tag, _ in hexes})]
    ids += [(2, i, NAMES[i]) for i in sorted({tag for tag, _ in quads})]
    with open(file, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(ids), sep="\n", file=out)
        for dimension, tag, name in ids:
            print(dimension, tag, f'"{name}"', file=out)
        print("$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=out)
        for i, x in enumerate(nodes):
            print(i + 1, *(f"{scale * c:.17g}" for c in x), file=out)
        print("$EndNodes\n$Elements", len(hexes) + len(quads), sep="\n", file=out)
        for i, (kind, tag, corners) in enumerate([(3, *q) for q in quads] + [(5, *h) for h in hexes]):
            print(i + 1, kind, 2, tag, tag, *(n + 1 for n in corners), file=out)
        print("$EndElements", file=out)


def block(place, monoliths, n_through, n_up, surfaces):
    """A block of cells: monoliths[i] is the volume of column i (across the valley), place(i, j, k) the point of a node
    (i across the valley, j downstream, k up). surfaces: the physical ids of its sides, by right, left, upstream,
    downstream, bottom, top; None for sides that are in no group."""
    n = (len(monoliths), n_through, n_up)
    number = lambda i, j, k: (i * (n[1] + 1) + j) * (n[2] + 1) + k
    nodes = [place(i, j, k) for i in range(n[0] + 1) for j in range(n[1] + 1) for k in range(n[2] + 1)]
    hexes, quads = [], []
    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                ring = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
                corners = [number(a, b, k + c) for c in (0, 1) for a, b in ring]
                hexes.append((monoliths[i], corners))
    sides = {"right": (0, 0), "left": (0, n[0]), "upstream": (1, 0), "downstream": (1, n[1]), "bottom": (2, 0),
             "top": (2, n[2])}
    for side, (axis, end) in sides.items():
        if surfaces.get(side) is None:
            continue
        one, two = [d for d in range(3) if d != axis]
        for a in range(n[one]):
            for b in range(n[two]):
                corners = []
                for da, db in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    at = [end] * 3
                    at[one], at[two] = a + da, b + db
                    corners.append(number(*at))
                quads.append((surfaces[side], corners))
    return nodes, hexes, quads


DAM = {"right": 1, "left": 1, "upstream": 2, "downstream": 3, "bottom": 1, "top": 4}


def arch(file, monoliths=(1, 1, 2, 2, 3, 3), n_through=1, n_up=3, scale=1.):
    """An arch dam, 60 m high, radius 100 m, 90 degrees, 6 to 18 m thick, in a valley with end walls of 24 m."""
    write(file, *arch_block(monoliths, n_through, n_up), scale=scale)


def arch_block(monoliths, n_through, n_up):
    n = len(monoliths)

    def place(i, j, k):
        angle = radians(-45 + 90 * i / n)
        low = 36 * (angle / (pi / 4))**2
        z = low + (60 - low) * k / n_up
        outer = 100 + .08 * (60 - z)
        r = outer - (6 + .2 * (60 - z)) * j / n_through
        return (100 - r * cos(angle), r * sin(angle), z)

    return block(place, monoliths, n_through, n_up, DAM)


def zoned_arch(file, monoliths, n_through, n_up, zones=("heel", "crown")):
    """The arch of three concretes: the lower third of the upstream cells is the heel, the upper third of all the crown,
    the rest has no zone. The number of each hexahedron's zone."""
    nodes, hexes, quads = arch_block(monoliths, n_through, n_up)
    zone = [2 if 3 * k >= 2 * n_up else 1 if 3 * k < n_up and j == 0 else 0
            for i in range(len(monoliths)) for j in range(n_through) for k in range(n_up)]
    volumes = {100 * z + m: f"monolith {m} {zones[z - 1]}" for z in (1, 2) for m in monoliths}
    write(file, nodes, [(100 * z + m, corners) for z, (m, corners) in zip(zone, hexes)], quads, volumes=volumes)
    return zone


def wall(file, monoliths=(1,), width=10., height=60., thickness=10., n_through=2, n_up=12, sides=None, toe=0.):
    """A straight wall with vertical upstream face, fixed at its foot; `sides`: 1 to hold the ends, too. `toe`: how far
    the downstream face's foot stands out."""
    def place(i, j, k):
        z = height * k / n_up
        return ((thickness + toe * (1 - z / height)) * j / n_through, width * (i / len(monoliths) - .5), z)

    write(file, *block(place, monoliths, n_through, n_up, {**DAM, "right": sides, "left": sides}))


def ring(file, n, n_through, n_up, inner, outer, height):
    """A closed tower, its outer face upstream, its foot fixed: not a dam, but Lame's pressurised cylinder."""
    number = lambda i, j, k: ((i % n) * (n_through + 1) + j) * (n_up + 1) + k

    def place(i, j, k):
        r, angle = outer + (inner - outer) * j / n_through, pi + 2 * pi * i / n
        return (r * cos(angle), -r * sin(angle), height * k / n_up)

    nodes = [place(i, j, k) for i in range(n) for j in range(n_through + 1) for k in range(n_up + 1)]
    hexes, quads = [], []
    for i in range(n):
        for j in range(n_through):
            for k in range(n_up):
                plan = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
                hexes.append((1, [number(a, b, k + c) for c in (0, 1) for a, b in plan]))
        for k in range(n_up):
            for j, surface in ((0, 2), (n_through, 3)):
                quads.append((surface, [number(i, j, k), number(i + 1, j, k), number(i + 1, j, k + 1), number(i, j, k + 1)]))
        for j in range(n_through):
            for k, surface in ((0, 1), (n_up, 4)):
                quads.append((surface, [number(i, j, k), number(i, j + 1, k), number(i + 1, j + 1, k), number(i + 1, j, k)]))
    write(file, nodes, hexes, quads)


def slab(file, n=24, n_through=2, n_up=2, radius=50., thickness=5., half_angle=60., height=10.):
    """An arch ring of constant thickness, held at its two ends only."""
    def place(i, j, k):
        angle = radians(half_angle * (2 * i / n - 1))
        r = radius + thickness * (.5 - j / n_through)
        return (radius - r * cos(angle), r * sin(angle), height * k / n_up)

    write(file, *block(place, (1,) * n, n_through, n_up, {**DAM, "bottom": None}))


def valley(file, n=40, n_up=24, half_width=40., low=0., high=40., top=60., thickness=10.):
    """A straight wall whose foot rises from `low` in the middle to `high` at both ends, which are held, too."""
    def place(i, j, k):
        y = half_width * (2 * i / n - 1)
        foot = low + (high - low) * abs(y) / half_width
        return (thickness * j, y, foot + (top - foot) * k / n_up)

    write(file, *block(place, (1,) * n, 1, n_up, DAM))


def on_rock(file, cell, n, dam, layers, dam_cells, sides, zone=None):
    """Writes on_rock_parts()."""
    nodes, hexes, quads, volumes = on_rock_parts(cell, n, dam, layers, dam_cells, sides, zone)
    write(file, nodes, hexes, quads, volumes=volumes)


def on_rock_parts(cell, n, dam, layers, dam_cells, sides, zone=None):
    """zone(i, j, k): the zone of a cell of the rock, "" for none; k = -1 is the uppermost layer. A box of rock of n x n columns, `layers` deep, its top at z = 0, all cells cubes of edge `cell`; on the columns
    dam[0] <= i, j < dam[1] a block of concrete, `dam_cells` high. sides: the surface of the box's four sides."""
    number, nodes, hexes, quads, zones = {}, [], [], [], [""]

    def volume(*cell):
        name = zone(*cell) if zone else ""
        if name not in zones:
            zones.append(name)
        return 1000 + zones.index(name)

    def node(i, j, k):
        if (i, j, k) not in number:
            number[i, j, k] = len(nodes)
            nodes.append((cell * (i - n / 2), cell * (j - n / 2), cell * k))
        return number[i, j, k]

    def has(i, j, k):
        return -layers <= k < 0 and 0 <= i < n and 0 <= j < n or (
            0 <= k < dam_cells and all(dam[0] <= c < dam[1] for c in (i, j)))

    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    for k in range(-layers, dam_cells):
        for i in range(n):
            for j in range(n):
                if not has(i, j, k):
                    continue
                rock = k < 0
                hexes.append((volume(i, j, k) if rock else 1, [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ring]))
                for axis in range(3):
                    for step in (0, 1):
                        to = [i, j, k]
                        to[axis] += 2 * step - 1
                        if rock and has(*to) or not rock and has(*to) and to[2] >= 0:
                            if not (rock and to[2] == 0 and axis == 2):
                                continue
                        if not rock and axis == 2 and step == 0 and k == 0:
                            continue  # the base: once, from the rock
                        if rock:
                            surface = (1 if has(*to) else 5) if axis == 2 and step else 6 if axis == 2 else sides
                        else:
                            surface = 4 if axis == 2 else {(0, 0): 2, (0, 1): 3}.get((axis, step))
                        if surface is None:
                            continue
                        one, two = [d for d in range(3) if d != axis]
                        corners = []
                        for a, b in ring:
                            at = [i, j, k]
                            at[axis] += step
                            at[one], at[two] = at[one] + a, at[two] + b
                            corners.append(node(*at))
                        quads.append((surface, corners))
    return nodes, hexes, quads, {1000 + i: f"rock {name}" for i, name in enumerate(zones) if name}


def read(file):
    """Nodes by number, elements [kind, physical id, corners] and names {(dimension, id): name} of a file in MSH 2.2."""
    parts = [part.splitlines() for part in open(file).read().split("$")]
    sections = {part[0]: part[2:] for part in parts if part and not part[0].startswith("End")}
    names = {(int(a), int(b)): name.strip('"') for a, b, name in (line.split(None, 2) for line in sections["PhysicalNames"])}
    nodes = {int(i): tuple(map(float, x)) for i, *x in (line.split() for line in sections["Nodes"])}
    words = [list(map(int, line.split())) for line in sections["Elements"]]
    return nodes, [[w[1], w[3], w[3 + w[2]:]] for w in words], names


def with_water(file, output, layers, level, upstream=-1., own_nodes=False, change=None, end=False, tetrahedra=False, left=False, dam=None):
    """Adds the volume 'water': layers of the given lengths on the faces of `upstream` below the level, up to a flat end. The lengths are those at the
    most upstream node. upstream: direction of the file's x. own_nodes: the water shares no nodes with the dam. change(x): moves the water's
    nodes. end: marks the end as 'water end'. left: only on faces with y > 0 of the file. dam: file with another
    mesh of the same dam, which receives this water. Numbers of nodes and elements of the water."""
    nodes, elements, names = read(file)
    surface = next(tag for (dimension, tag), name in names.items() if (dimension, name) == (2, "upstream"))
    wet = [c for kind, tag, c in elements if (kind, tag) == (3, surface) and all(nodes[n][2] < level + 1e-6 for n in c)
           and (not left or min(nodes[n][1] for n in c) > -1e-6)]
    at, count = sorted({n for c in wet for n in c}), max(nodes)
    far, number = max(upstream * nodes[n][0] for n in at) + sum(layers), {}
    for k in range(len(layers) + 1):
        t = sum(layers[:k]) / sum(layers)
        for n in at:
            x, y, z = nodes[n]
            number[n, k] = n
            if k > 0 or own_nodes:
                count += 1
                number[n, k] = count
                x += t * (upstream * far - x)
                nodes[count] = change((x, y, z)) if change else (x, y, z)
    rings = []
    for c in wet:
        (_, y, z), (_, y1, z1), (_, y3, z3) = (nodes[c[i]] for i in (0, 1, 3))
        rings.append(c if upstream * ((y1 - y) * (z3 - z) - (z1 - z) * (y3 - y)) > 0 else c[::-1])
    names[3, 2000] = "water"
    for k in range(len(layers)):
        for c in rings:
            corners = [number[n, a] for a in (k, k + 1) for n in c]
            elements.append([4, 2000, [corners[i] for i in (0, 1, 3, 4)]] if tetrahedra else [5, 2000, corners])
    if end:
        names[2, 7] = "water end"
        elements += [[3, 7, [number[n, len(layers)] for n in c]] for c in rings]
    if dam:
        of_water, (of_dam, cells, names) = nodes, read(dam)
        first = max(of_dam)
        nodes = {**of_dam, **{first + n: x for n, x in of_water.items()}}
        elements = cells + [[kind, tag, [first + n for n in c]] for kind, tag, c in elements if tag == 2000]
        names[3, 2000] = "water"
    with open(output, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), sep="\n", file=out)
        print(*(f'{a} {b} "{name}"' for (a, b), name in names.items()), "$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=out)
        print(*(f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in nodes.items()), "$EndNodes\n$Elements", len(elements), sep="\n", file=out)
        for i, (kind, tag, corners) in enumerate(elements):
            print(i + 1, kind, 2, tag, tag, *corners, file=out)
        print("$EndElements", file=out)
    return len(number), len(layers) * len(rings)
