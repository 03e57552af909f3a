# SPDX-License-Identifier: GPL-3.0-or-later
"""Rock around a dam of arch_from_table.py, for Foundation/Model = massless: a block of hexahedra that shares the base nodes of the dam.

The grid extends that of the dam: columns to both sides, layers up- and downstream, rows down. The ground is level along the stream. On both
sides of the valley the ground has the level of the base at the dam's ends, whose walls are free.
"""

import numpy as np

SIDE, STREAM, DOWN = 6, 8, 8  # elements beside, up- and downstream of, and below the dam
GROUND, CUT = 5, 6
NAMES = {GROUND: "free surface", CUT: "artificial boundary"}
ROCK = 1000


def graded(first, length, n):
    """n + 1 places from 0 to length; the first step is first, unless equal steps are smaller, the others grow by one ratio."""
    if first * n >= length:
        return np.linspace(0, 1, n + 1) * length
    low, high = 1., 10.
    for _ in range(60):
        ratio = .5 * (low + high)
        low, high = (ratio, high) if first * (ratio**n - 1) < length * (ratio - 1) else (low, ratio)
    steps = first * high**np.arange(n)
    return np.concatenate([[0.], np.cumsum(steps)]) * length / steps.sum()


def ground_of(foot, extent):
    """Points of the ground [column, layer], with the base of the dam."""
    columns, layers = foot.shape[0] + 2 * SIDE, foot.shape[1] + 2 * STREAM
    ground = np.zeros((columns, layers, 3))
    middle = ground[SIDE:-SIDE]
    middle[:, STREAM:-STREAM] = foot
    ends = foot[..., 0].min() - extent, foot[..., 0].max() + extent
    for column, points in zip(middle, foot):
        for edge, inner, face in ((0, 1, ends[0]), (-1, -2, ends[1])):  # lines along the stream
            along = graded(abs(points[edge, 0] - points[inner, 0]), abs(face - points[edge, 0]), STREAM)[1:]
            line = np.repeat(points[edge][None], STREAM, 0)
            line[:, 0] += np.sign(face - points[edge, 0]) * along
            if edge == 0:
                column[:STREAM] = line[::-1]
            else:
                column[-STREAM:] = line
    face = abs(foot[..., 1]).max() + extent
    x_side = np.linspace(*ends, layers)
    for bank in (-1, 1):  # beside the dam the layers spread
        start = middle[0 if bank < 0 else -1]
        inner = middle[1 if bank < 0 else -2]
        for layer in range(layers):
            far = face - abs(start[layer, 1])
            along = graded(abs(start[layer, 1] - inner[layer, 1]), far, SIDE)[1:]
            line = np.repeat(start[layer][None], SIDE, 0)
            line[:, 0] += (along / far)**2 * (x_side[layer] - start[layer, 0])
            line[:, 1] += bank * along
            ground[:SIDE, layer] = line[::-1] if bank < 0 else ground[:SIDE, layer]
            ground[-SIDE:, layer] = line if bank > 0 else ground[-SIDE:, layer]
    return ground


def add_rock(nodes, cells, sides, shape, extent):
    """Nodes, hexahedra and quadrilaterals with rock; shape is that of the dam's nodes (columns, rows, layers), extent the rock's beside
    and below the dam [m]."""
    numbers = np.arange(len(nodes)).reshape(shape)
    columns, _, layers = numbers.shape
    ground = ground_of(nodes[numbers[:, 0, :]], extent)
    bottom = ground.copy()
    bottom[..., 1] = .5 * (bottom[..., 1] + np.linspace(-1, 1, len(ground))[:, None] * abs(ground[[0, -1], :, 1]).max())
    bottom[..., 2] = nodes[:, 2].min() - extent
    share = graded(.4 / DOWN, 1., DOWN)[1:]
    below = ground[None] + share[:, None, None, None] * (bottom - ground)[None]
    number = np.full((DOWN + 1, *ground.shape[:2]), -1)
    foot = np.zeros(ground.shape[:2], bool)
    foot[SIDE:SIDE + columns, STREAM:STREAM + layers] = True
    number[0][foot] = numbers[:, 0, :].ravel()
    number[0][~foot] = len(nodes) + np.arange((~foot).sum())
    new = np.concatenate([ground[~foot], below.reshape(-1, 3)])
    number[1:] = len(nodes) + (~foot).sum() + np.arange(below[..., 0].size).reshape(number[1:].shape)
    last = numbers[0, :, :].ravel(), numbers[-1, :, :].ravel()
    end_walls = [set(part) for part in last]
    sides = [side for side in sides if not (side[0] == 1 and any(set(side[1]) <= wall for wall in end_walls))]
    cells = list(cells)
    for t in range(DOWN):
        for i in range(ground.shape[0] - 1):
            for k in range(ground.shape[1] - 1):
                square = lambda level: [number[level, i, k], number[level, i, k + 1], number[level, i + 1, k + 1], number[level, i + 1, k]]
                low, high = square(t + 1), square(t)
                cells.append((ROCK, low + high))
                on_foot = foot[i, k] and foot[i, k + 1] and foot[i + 1, k + 1] and foot[i + 1, k]
                for outside, group, quad in ((t == 0 and not on_foot, GROUND, high), (t == DOWN - 1, CUT, low),
                                             (i == 0, CUT, [low[0], low[1], high[1], high[0]]),
                                             (i == ground.shape[0] - 2, CUT, [low[3], low[2], high[2], high[3]]),
                                             (k == 0, CUT, [low[0], low[3], high[3], high[0]]),
                                             (k == ground.shape[1] - 2, CUT, [low[1], low[2], high[2], high[1]])):
                    if outside:
                        sides.append((group, quad))
    return np.concatenate([nodes, new]), cells, sides
