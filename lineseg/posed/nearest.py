"""The wall nearest to each return."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from .walls import Walls

# Side of a square of the table in which the walls near a point are looked up [m].
SQUARE = 0.25
# A wall is looked for at most so far from a point [m], and reaches so far past its ends.
REACH, PAST = 0.25, 0.03
# Where a long wall and a short one compete for a point, the long one may be farther away by this [m].
PREFERRED = 0.04
Floats = NDArray[np.float64]


class Table(NamedTuple):
    """The walls near each square: `walls[starts[k]:starts[k + 1]]` for the square `keys[k]`; origin: (2,) [m]."""

    keys: NDArray[np.int64]
    starts: NDArray[np.int64]
    walls: NDArray[np.int64]
    origin: Floats


def table_of(walls: Walls) -> Table:
    """The squares that a point within REACH of a wall can lie in."""
    along, steps = walls.along, np.ceil((walls.high - walls.low + 2 * REACH) / (SQUARE / 2)).astype(np.int64) + 1
    wall = np.repeat(np.arange(len(walls)), steps)
    number = np.arange(len(wall)) - np.repeat(np.cumsum(steps) - steps, steps)
    at = walls.low[wall] - REACH + number * (SQUARE / 2)
    middle = walls.normal[wall] * walls.offset[wall, None] + along[wall] * at[:, None]
    spots = [middle + walls.normal[wall] * height for height in np.linspace(-REACH, REACH, 5)]
    spots = np.concatenate(spots)
    origin = spots.min(axis=0) - SQUARE
    key = np.floor((spots - origin) / SQUARE).astype(np.int64) @ np.array([1 << 32, 1])
    pairs = np.unique(np.column_stack((key, np.tile(wall, 5))), axis=0)
    keys, starts = np.unique(pairs[:, 0], return_index=True)
    return Table(keys, np.append(starts, len(pairs)), np.ascontiguousarray(pairs[:, 1]), origin)


def nearest_walls(
    placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats, walls: Walls, reach: float
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """(n,) the nearest wall within `reach` that faces the laser, or −1; and the height of each point over it [m]."""
    found, height = np.full(len(placed), -1, np.int32), np.full(len(placed), np.nan, np.float32)
    if len(walls):
        find_nearest(placed, scan, poses, rows_of(walls), *table_of(walls), reach, found, height)
    return found, height


def rows_of(walls: Walls) -> Floats:
    """(w, 5) normal, offset, low, high."""
    return np.column_stack((walls.normal, walls.offset, walls.low, walls.high))


@entry_kernel
def find_nearest(placed, scan, poses, rows, keys, starts, walls, origin, reach, found, height):
    """See `nearest_walls`."""
    for i in range(len(placed)):
        pose = poses[scan[i]]
        wall, across = nearest(placed[i, 0], placed[i, 1], pose[0], pose[1], rows, keys, starts, walls, origin, reach)
        if wall >= 0:
            found[i], height[i] = wall, across


@kernel
def nearest(x, y, px, py, rows, keys, starts, walls, origin, reach):
    """The nearest wall to (x, y) that faces the laser at (px, py), or −1, and how far the point lies in front of it."""
    k = square_of(x, y, keys, origin)
    best, wall, height = np.inf, -1, 0.0
    if k >= 0:
        for j in range(starts[k], starts[k + 1]):
            row = rows[walls[j]]
            across = row[0] * x + row[1] * y - row[2]
            at = -row[1] * x + row[0] * y
            inside = row[3] - PAST <= at <= row[4] + PAST
            distance = abs(across) - PREFERRED * min(row[4] - row[3], 1.0)
            if inside and abs(across) < reach and distance < best and row[0] * px + row[1] * py > row[2]:
                best, wall, height = distance, walls[j], across
    return wall, height


@kernel
def square_of(x, y, keys, origin):
    """The position of the square around a point, or −1."""
    key = int(np.floor((x - origin[0]) / SQUARE)) * (1 << 32) + int(np.floor((y - origin[1]) / SQUARE))
    k = first_from(keys, key)
    return k if k < len(keys) and keys[k] == key else -1


@kernel
def first_from(keys, wanted):
    """The first position whose key is at least `wanted`."""
    low, high = 0, len(keys)
    while low < high:
        middle = (low + high) // 2
        if keys[middle] < wanted:
            low = middle + 1
        else:
            high = middle
    return low
