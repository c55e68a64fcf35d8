"""Surfaces that lie close in front of each other and face the same way: nobody sees both of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from ..posed.walls import Walls
from .merging import LEAST_PIECE
from .profiles import STRETCH, Profiles

# Two surfaces are the same one seen twice if they are less than this apart [m], with a cosine of the angle above that.
TWICE, ALIKE = 0.25, np.cos(np.radians(8))
# Of two, the one with so many times fewer returns is made of outliers of the other.
FEWER = 4

Floats = NDArray[np.float64]


def without_outdone(pieces: Walls, wall_of: NDArray[np.int64], profiles: Profiles) -> tuple[Walls, NDArray[np.int64]]:
    """The pieces without the stretches that outliers of a stronger surface form, and the wall of each."""
    gone = outdone(profiles, pieces)
    rows, owners = [], []
    for piece, (row, first, stop) in enumerate(zip(pieces.table, profiles.starts, profiles.starts[1:], strict=False)):
        edges = np.flatnonzero(np.diff(np.concatenate(([True], gone[first:stop], [True]))))
        for begin, end in edges.reshape(-1, 2).tolist():
            low, high = row[3] + begin * STRETCH, min(row[3] + end * STRETCH, row[4])
            if high - low >= LEAST_PIECE or end - begin == stop - first:
                rows.append((*row[:3], low, high, row[5]))
                owners.append(wall_of[piece])
    return Walls.of(np.array(rows).reshape(-1, 6)), np.array(owners, np.int64)


def outdone(profiles: Profiles, walls: Walls) -> NDArray[np.bool_]:
    """(s,) whether a stretch has another close in front or behind with FEWER times as many returns."""
    found = np.zeros(len(profiles.at), np.bool_)
    for other, close, at in _beside(profiles, walls, range(len(walls)), 0.0):
        first, last = profiles.starts[other], profiles.starts[other + 1] - 1
        twin = np.clip(first + (at / STRETCH).astype(np.int64), first, last)
        found[close] |= profiles.points[close] * FEWER < profiles.points[twin]
    return found


def doubled(profiles: Profiles, walls: Walls, firm: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(s,) whether the surface of a stretch is there twice: another firm wall that faces the same way lies so close.

    Nobody sees both of two such surfaces, except past an end of the one in front, so poses that were off made two of
    one.
    """
    twice = np.zeros(len(profiles.at), np.bool_)
    for _, close, _ in _beside(profiles, walls, np.flatnonzero(firm).tolist(), STRETCH / 2):
        twice[close] = True
    return twice & firm[profiles.wall]


def _beside(
    profiles: Profiles, walls: Walls, others: Iterable[int], margin: float
) -> Iterator[tuple[int, NDArray[np.intp], Floats]]:
    """Each of the other walls, the stretches close to it and more than a margin [m] from its ends, and how far along it
    they are [m]."""
    wall = profiles.wall
    middle = walls.normal[wall] * walls.offset[wall, None] + walls.along[wall] * profiles.at[:, None]
    for other in others:
        at, across = middle @ walls.along[other], middle @ walls.normal[other] - walls.offset[other]
        inside = (at > walls.low[other] + margin) & (at < walls.high[other] - margin)
        close = np.flatnonzero(inside & (np.abs(across) < TWICE) & (wall != other))
        close = close[walls.normal[wall[close]] @ walls.normal[other] > ALIKE]
        yield other, close, at[close] - walls.low[other]
