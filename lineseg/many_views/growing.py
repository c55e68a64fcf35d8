"""Straight walls in the squares of the world: each grows from a flat place along its surface."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..posed.nearest import first_from
from ..posed.walls import Walls
from .cells import MOST_VIEWS, QUARTERS, ROW, SIDE, Cells, across_and_along

# Length of the stretches into which a wall is divided [m].
BIN = 0.05
# A wall ends where nothing lies for this long [m].
GAP = 0.30
# A surface may bend this far from the straight line [m]; from one stretch to the next it steps by less than the band.
BEND = 0.08

# Squares whose own normal is turned by more than this belong to another surface [cosine].
TURNED = 0.80
LEAST_LENGTH = 0.30
LONGEST = 60.0


def grown_walls(cells: Cells, band: float) -> tuple[Walls, NDArray[np.int32]]:
    """The walls, and the wall of each square or −1.

    band: how far the points of one surface scatter [m]. The flattest and most seen places grow first.
    """
    weights = np.minimum(cells.views, MOST_VIEWS)
    flat = cells.flat / np.maximum(cells.spread, 1e-9)
    seeds = np.flatnonzero((cells.spread > 2 * SIDE) & (flat < 0.45))
    seeds = seeds[np.argsort((flat / np.sqrt(weights))[seeds], kind="stable")]
    owner = np.full(len(weights), -1, np.int32)
    memory = Memory(
        np.empty((len(weights), 3)),
        np.empty((len(weights), 3), np.int64),
        np.full(int(2 * LONGEST / BIN) + 1, -1, np.int64),
    )
    rows = np.zeros((len(seeds) + 1, 6))
    count = grow_all(
        cells.xy, cells.toward, cells.normal, weights, cells.key, cells.origin, seeds, owner, *memory, band, rows
    )
    return Walls.of(rows[:count]), owner


class Memory(NamedTuple):
    """Room for the squares around a wall. local: along, across, whether accepted; links: square, next one in the same
    stretch; heads: first one in each stretch."""

    local: NDArray[np.float64]
    links: NDArray[np.int64]
    heads: NDArray[np.int64]


@entry_kernel
def grow_all(xy, toward, normal, weights, keys, origin, seeds, owner, local, links, heads, band, rows):
    """The number of walls that were found; writes them to `rows`, and to `owner` the wall of each square."""
    count = 0
    for k in range(len(seeds)):
        seed = seeds[k]
        if owner[seed] >= 0:
            continue
        row = rows[count]
        row[0], row[1] = normal[seed, 0], normal[seed, 1]
        row[2] = row[0] * xy[seed, 0] + row[1] * xy[seed, 1]
        at = -row[1] * xy[seed, 0] + row[0] * xy[seed, 1]
        row[3], row[4] = at - 0.2, at + 0.2
        used = 0
        for turn in range(14):
            low, high = row[3], row[4]
            used = gathered(xy, toward, normal, keys, origin, owner, local, links, row)
            tracked(local, links, heads, weights, used, xy, seed, band, row)
            if not refitted(xy, weights, local, links, used, row):
                used = 0
                break
            if turn > 2 and abs(row[3] - low) < BIN and abs(row[4] - high) < BIN:
                break
        if used == 0 or row[4] - row[3] < LEAST_LENGTH:
            continue
        for i in range(used):
            if local[i, 2] > 0:
                owner[links[i, 0]] = count
        count += 1
    return count


@kernel
def gathered(xy, toward, normal, keys, origin, owner, local, links, row):
    """The number of free squares near the wall and beyond its ends that face alike; writes them down."""
    nx, ny, offset = row[0], row[1], row[2]
    reach = min(max(1.0, (row[4] - row[3]) / 2), LONGEST / 4)
    low, high = row[3] - reach, row[4] + reach
    x1, y1 = nx * offset - ny * low, ny * offset + nx * low
    x2, y2 = nx * offset - ny * high, ny * offset + nx * high
    if x2 < x1:
        x1, y1, x2, y2 = x2, y2, x1, y1
    wide = 2 * BEND
    used = 0
    first, last = int((x1 - wide - origin[0]) / SIDE), int((x2 + wide - origin[0]) / SIDE)
    for column in range(max(first, 0), last + 1):
        # Of the line, the part above this column, and a little more on both sides.
        left, right = origin[0] + column * SIDE - wide, origin[0] + (column + 1) * SIDE + wide
        slope = (y2 - y1) / (x2 - x1) if x2 > x1 else 0.0
        if abs(slope) < 1e6 and x2 - x1 > 1e-9:
            a, b = y1 + slope * (max(left, x1) - x1), y1 + slope * (min(right, x2) - x1)
        else:
            a, b = y1, y2
        bottom, top = min(a, b) - wide, max(a, b) + wide
        start = (column * ROW + max(int((bottom - origin[1]) / SIDE), 0)) * QUARTERS
        stop = (column * ROW + max(int((top - origin[1]) / SIDE) + 1, 0)) * QUARTERS
        j = first_from(keys, start)
        while j < len(keys) and keys[j] < stop:
            across = nx * xy[j, 0] + ny * xy[j, 1] - offset
            at = -ny * xy[j, 0] + nx * xy[j, 1]
            alike = nx * normal[j, 0] + ny * normal[j, 1] > TURNED and nx * toward[j, 0] + ny * toward[j, 1] > 0
            if owner[j] < 0 and alike and abs(across) < wide and low <= at <= high:
                local[used, 0], local[used, 1], local[used, 2] = at, across, 0.0
                links[used, 0] = j
                used += 1
            j += 1
    return used


@kernel
def tracked(local, links, heads, weights, used, xy, seed, band, row):
    """Accept the squares that follow the surface from the seed on, both ways, until it ends, steps or bends away."""
    nx, ny = row[0], row[1]
    at = -ny * xy[seed, 0] + nx * xy[seed, 1]
    middle = len(heads) // 2
    least, most = len(heads), -1
    for i in range(used):
        place = min(max(int(np.floor((local[i, 0] - at) / BIN)) + middle, 0), len(heads) - 1)
        links[i, 1], heads[place] = heads[place], i
        least, most = min(least, place), max(most, place)
    begin = nx * xy[seed, 0] + ny * xy[seed, 1] - row[2]
    for step in (1, -1):
        height, gap = begin, 0.0
        place = middle if step > 0 else middle - 1
        while least <= place <= most and gap < GAP:
            total, moment = 0.0, 0.0
            i = heads[place]
            while i >= 0:
                if abs(local[i, 1] - height) < band and abs(local[i, 1]) < BEND + band:
                    local[i, 2] = 1.0
                    total += weights[links[i, 0]]
                    moment += weights[links[i, 0]] * local[i, 1]
                i = links[i, 1]
            if total > 0:
                height += 0.5 * (moment / total - height)
                gap = 0.0
            else:
                gap += BIN
            if abs(height) > BEND:
                break
            place += step
    for place in range(least, most + 1):
        heads[place] = -1


@kernel
def refitted(xy, weights, local, links, used, row):
    """Fit the line to the accepted squares by total least squares; whether there are enough of them."""
    n = sx = sy = sxx = sxy = syy = 0.0
    x0 = y0 = 0.0
    count = 0
    for i in range(used):
        if local[i, 2] > 0:
            j = links[i, 0]
            if count == 0:
                x0, y0 = xy[j, 0], xy[j, 1]
            count += 1
            w, x, y = weights[j], xy[j, 0] - x0, xy[j, 1] - y0
            n += w
            sx += w * x
            sy += w * y
            sxx += w * x * x
            sxy += w * x * y
            syy += w * y * y
    if count < 4:
        return False
    mx, my = sx / n, sy / n
    a, b, c = sxx / n - mx * mx, sxy / n - mx * my, syy / n - my * my
    nx, ny, row[5], _ = across_and_along(a, b, c, row[0], row[1])
    row[0], row[1] = nx, ny
    row[2] = nx * (mx + x0) + ny * (my + y0)
    row[3], row[4] = np.inf, -np.inf
    for i in range(used):
        if local[i, 2] > 0:
            j = links[i, 0]
            at = -ny * xy[j, 0] + nx * xy[j, 1]
            row[3], row[4] = min(row[3], at), max(row[4], at)
    return True
