"""Pieces of one wall become one: with a door or a cupboard between them, or where the walls of a drive lie over each
other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..posed.walls import Walls
from .cells import MOST_VIEWS, Cells
from .growing import BEND

# Pieces turned by more than this against each other are different walls [cosine].
ALIKE = 0.97
# The gap between two pieces is at most so long [m], or half as long as both together.
LONGEST_GAP = 1.5
# A merge may raise the rms by this factor; below the floor [m] it always may.
RISE, FLOOR = 1.25, 0.012
# The heights of two pieces are compared over so much of each [m].
COMPARED = 0.4
STRETCH = 0.10
# A wall is interrupted where nothing lies for this long [m]; shorter pieces are left out.
BREAK, LEAST_PIECE = 0.20, 0.25

# A weaker surface so near in front of or behind a stronger one [m] is made of its outliers, if most of it lies there.
# Farther away, it has to be far weaker.
SHADOW, MOSTLY = 0.12, 0.6
FAR_SHADOW, FAR_WEAKER = 0.25, 0.20

Floats = NDArray[np.float64]


def without_shadows(cells: Cells, walls: Walls, owner: NDArray[np.int32]) -> tuple[Walls, NDArray[np.int32]]:
    """The walls without those that outliers of a stronger wall form next to it."""
    parts = parts_of(walls, owner)
    table = walls.table
    strength = [np.bincount(*_bins(cells, part, wall)) for part, wall in zip(parts, table, strict=True)]
    alive = np.ones(len(parts), np.bool_)
    for strong in np.argsort([-each.sum() for each in strength]).tolist():
        if not alive[strong]:
            continue
        for weak in candidates(table, alive, strong):
            if _is_shadow(cells, parts[weak], table[strong], strength[strong]):
                alive[weak] = False
    numbers = np.where(alive, np.cumsum(alive) - 1, -1).astype(np.int32)
    return walls.only(alive), np.where(owner >= 0, numbers[owner], -1)


def parts_of(walls: Walls, owner: NDArray[np.int32]) -> list[NDArray[np.intp]]:
    """The squares of each wall."""
    order = np.argsort(owner, kind="stable")
    return np.split(order, np.searchsorted(owner[order], np.arange(len(walls))))[1:]


def _bins(cells: Cells, part: NDArray, wall: Floats) -> tuple[NDArray[np.int64], Floats]:
    """The stretch of the wall that each square belongs to, and its strength."""
    at = cells.xy[part] @ np.array((-wall[1], wall[0])) - wall[3]
    return np.maximum(np.floor(at / STRETCH), 0).astype(np.int64), cells.strength[part]


def _is_shadow(cells: Cells, part: NDArray, wall: Floats, strength: Floats) -> bool:
    at = np.floor((cells.xy[part] @ np.array((-wall[1], wall[0])) - wall[3]) / STRETCH).astype(np.int64)
    height = np.abs(cells.xy[part] @ wall[:2] - wall[2])
    near = (height < FAR_SHADOW) & (at >= 0) & (at < len(strength))
    if near.sum() < MOSTLY * len(part):
        return False
    own = np.bincount(at[near], cells.strength[part][near], minlength=len(strength))
    weaker = own[at[near]] < np.where(height[near] < SHADOW, 1.0, FAR_WEAKER) * strength[at[near]]
    return bool(weaker.sum() >= MOSTLY * len(part))


def merged_walls(cells: Cells, walls: Walls, owner: NDArray[np.int32], band: float) -> tuple[Walls, NDArray[np.int32]]:
    """The walls after all merges, longest first, and the wall of each square or −1."""
    weights = np.minimum(cells.views, MOST_VIEWS)
    parts = parts_of(walls, owner)
    fits = [fitted(cells.xy[part], weights[part], normal) for part, normal in zip(parts, walls.normal, strict=True)]
    waiting = sorted(range(len(parts)), key=lambda k: fits[k][3] - fits[k][4])
    alive = np.ones(len(parts), np.bool_)
    table = np.array([fit[:6] for fit in fits]).reshape(-1, 6)
    while waiting:
        one = waiting.pop(0)
        while alive[one]:
            for other in candidates(table, alive, one):
                joint = np.concatenate((parts[one], parts[other]))
                fit = fitted(cells.xy[joint], weights[joint], table[one, :2])
                if belongs(cells.xy, weights, parts[one], parts[other], table[one], table[other], fit, band):
                    parts[one], table[one], alive[other] = joint, fit, False
                    break
            else:
                break
    kept = np.flatnonzero(alive)
    kept = kept[np.argsort(table[kept, 3] - table[kept, 4], kind="stable")]
    owner = np.full(len(weights), -1, np.int32)
    for number, k in enumerate(kept.tolist()):
        owner[parts[k]] = number
    return Walls.of(table[kept]), owner


def pieces_of(cells: Cells, walls: Walls, owner: NDArray[np.int32]) -> tuple[Walls, NDArray[np.int64]]:
    """The parts of the walls that something was seen on without a break, and the wall of each.

    A piece lies on the line of its wall; rms is its own.
    """
    wall = np.flatnonzero(owner >= 0)
    of = owner[wall]
    at = (cells.xy[wall] * walls.along[of]).sum(axis=1)
    order = np.lexsort((at, of))
    wall, of, at = wall[order], of[order], at[order]
    begins = (np.diff(of, prepend=-1) != 0) | (np.diff(at, prepend=-np.inf) > BREAK)
    first = np.flatnonzero(begins)
    last = np.append(first[1:], len(of)) - 1 if len(first) else first
    number = np.cumsum(begins) - 1
    across = (cells.xy[wall] * walls.normal[of]).sum(axis=1) - walls.offset[of]
    rms = np.sqrt(np.bincount(number, across**2, len(first)) / np.maximum(last - first + 1, 1))
    owners = of[first]
    pieces = Walls(walls.normal[owners], walls.offset[owners], at[first], at[last], rms)
    long = pieces.high - pieces.low >= LEAST_PIECE
    return pieces.only(long), owners[long].astype(np.int64)


def fitted(xy: Floats, weights: Floats, normal: Floats) -> Floats:
    """(6,) normal, offset, low, high, rms of the line of least squares; its normal points as the given one does."""
    total = weights.sum()
    mean = weights @ xy / total
    (a, b), (_, c) = (xy - mean).T @ ((xy - mean) * weights[:, None]) / total
    angle = 0.5 * np.arctan2(2 * b, a - c)
    found = np.array((-np.sin(angle), np.cos(angle)))
    found *= 1 if found @ normal >= 0 else -1
    at = xy @ np.array((-found[1], found[0]))
    across = (xy - mean) @ found
    return np.array((*found, found @ mean, at.min(), at.max(), np.sqrt(weights @ across**2 / total)))


def candidates(table: Floats, alive: NDArray[np.bool_], one: int) -> list[int]:
    """Walls that could be pieces of wall `one`, the nearest first."""
    nx, ny, offset, low, high, _ = table[one]
    foot = table[:, :2] * table[:, 2:3]
    along = np.column_stack((-table[:, 1], table[:, 0]))
    ends = [foot + along * table[:, k : k + 1] for k in (3, 4)]
    heights = np.abs([end @ np.array((nx, ny)) - offset for end in ends])
    at = np.array([end @ np.array((-ny, nx)) for end in ends])
    gap = np.maximum(at.min(axis=0) - high, low - at.max(axis=0))
    length = table[:, 4] - table[:, 3]
    possible = alive & (table[:, :2] @ np.array((nx, ny)) > ALIKE)
    possible &= (heights.min(axis=0) < FAR_SHADOW) & (gap < np.maximum(LONGEST_GAP, 0.5 * (length + high - low)))
    possible[one] = False
    found = np.flatnonzero(possible)
    return found[np.argsort(np.maximum(gap[found], 0), kind="stable")].tolist()


def belongs(
    xy: Floats, weights: Floats, one: NDArray, other: NDArray, line: Floats, second: Floats, joint: Floats, band: float
) -> bool:
    """Whether two pieces are one wall: their common line fits as well as their own ones, and no step is between."""
    if joint[5] > max(RISE * max(line[5], second[5]), FLOOR):
        return False
    normal, along = joint[:2], np.array((-joint[1], joint[0]))
    at, at_other = xy[one] @ along, xy[other] @ along
    low, high = max(at.min(), at_other.min()), min(at.max(), at_other.max())
    low, high = min(low, high) - COMPARED, max(low, high) + COMPARED
    heights = []
    for part, places in ((one, at), (other, at_other)):
        near = (places >= low) & (places <= high)
        if not near.any():
            return False
        across = xy[part][near] @ normal - joint[2]
        heights.append(np.average(across, weights=weights[part][near]))
        if np.abs(heights[-1]) > BEND:
            return False
    return abs(heights[0] - heights[1]) < band
