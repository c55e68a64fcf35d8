"""Where a wall really ends: beams pass through a doorway or a recess, but not through a wall that furniture hides."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel
from ..posed.walls import Walls

# Of all beams, so many are looked at.
MOST_RAYS = 400_000
# A beam passes through a gap if it ends so far behind it [m], or so many times the rms of the walls, and so far from
# the ends of the gap [m].
BEHIND, THICKNESSES, ASIDE = 0.04, 3.0, 0.04
# So many of these beams make a gap an opening.
LEAST_RAYS = 3

Floats = NDArray[np.float64]


def divided_at_openings(
    pieces: Walls, wall_of: NDArray[np.int64], placed: NDArray[np.float32], scan: NDArray[np.int32], poses: Floats,
    thickness: float,
) -> NDArray[np.int64]:  # fmt: skip
    """The wall of each piece, where pieces with an opening between them are different walls.

    Pieces are in order along their walls. placed: (n, 2) all returns in the world; scan: (n,), poses: (m, 3);
    thickness: rms of the walls [m].
    """
    before = np.flatnonzero(np.diff(wall_of) == 0)
    gaps = np.column_stack(
        (pieces.normal[before], pieces.offset[before], pieces.high[before] + ASIDE, pieces.low[before + 1] - ASIDE)
    )
    every = max(1, len(placed) // MOST_RAYS)
    count = np.zeros(len(gaps), np.int64)
    if len(gaps):
        count_crossings(
            placed[::every],
            np.ascontiguousarray(scan[::every]),
            poses,
            gaps,
            max(BEHIND, THICKNESSES * thickness),
            count,
        )
    divided = np.ones(len(wall_of), np.bool_)
    divided[before + 1] = count >= LEAST_RAYS
    return np.cumsum(divided) - 1


@entry_kernel
def count_crossings(placed, scan, poses, gaps, behind, count):
    """How many beams come from the front of each gap (normal, offset, low, high) and end behind it."""
    for i in range(len(placed)):
        x, y = placed[i, 0], placed[i, 1]
        px, py = poses[scan[i], 0], poses[scan[i], 1]
        for k in range(len(gaps)):
            nx, ny = gaps[k, 0], gaps[k, 1]
            start, end = nx * px + ny * py - gaps[k, 2], nx * x + ny * y - gaps[k, 2]
            if start > 0 and end < -behind:
                share = start / (start - end)
                at = nx * (py + share * (y - py)) - ny * (px + share * (x - px))
                if gaps[k, 3] < at < gaps[k, 4]:
                    count[k] += 1
