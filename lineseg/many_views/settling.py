"""Where walls lie over each other or cross at a small angle, the stronger one takes what lies on its line."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..posed.walls import Walls
from .cells import MOST_VIEWS, Cells
from .merging import LEAST_PIECE, LONGEST_GAP, candidates, fitted, parts_of

# Length of the stretches that walls compete for [m], and how far from the line of the stronger one they are looked at.
STRETCH, REACH = 0.20, 0.12
# A surface lies on a line if the median of its squares is at most so far from it [m].
ON_LINE = 0.02
# A wall has so many squares or more.
LEAST_SQUARES = 4

Floats = NDArray[np.float64]


def settled(cells: Cells, walls: Walls, owner: NDArray[np.int32]) -> tuple[Walls, NDArray[np.int32]]:
    """The walls after the strongest took from the others what lies on its line, then the next, and so on; and the wall
    of each square or −1.

    The noise of a laser makes walls grow twice, or aslant from a wall into a recess beside it. Of a stretch that two
    walls claim, the median over the squares of both tells whether the surface lies on the line of the stronger one.
    """
    parts, owner = parts_of(walls, owner), owner.copy()
    table = walls.table
    weights = np.minimum(cells.views, MOST_VIEWS)
    alive, waiting = np.ones(len(parts), np.bool_), np.ones(len(parts), np.bool_)
    for one in np.argsort([-cells.strength[part].sum() for part in parts], kind="stable").tolist():
        waiting[one] = False
        others = candidates(table, alive & waiting, one) if alive[one] else []
        if not others:
            continue
        taken = _taken(cells, parts[one], np.concatenate([parts[other] for other in others]), table[one])
        losers = np.unique(owner[taken]).tolist()
        owner[taken] = one
        parts[one] = np.concatenate((parts[one], taken))
        for changed in [one, *losers] if losers else []:
            part = parts[changed] = parts[changed][owner[parts[changed]] == changed]
            if len(part) >= LEAST_SQUARES:
                table[changed] = fitted(cells.xy[part], weights[part], table[changed, :2])
            alive[changed] = len(part) >= LEAST_SQUARES and table[changed, 4] - table[changed, 3] >= LEAST_PIECE
    numbers = np.where(alive, np.cumsum(alive) - 1, -1).astype(np.int32)
    return Walls.of(table[alive]), np.where(owner >= 0, numbers[owner], -1).astype(np.int32)


def _taken(cells: Cells, own: NDArray[np.intp], others: NDArray[np.intp], line: Floats) -> NDArray[np.intp]:
    """Those of the squares of other walls that belong to a wall with the squares `own` on this line (6,)."""
    near = np.concatenate((own, others))
    height = cells.xy[near] @ line[:2] - line[2]
    inside = np.abs(height) < REACH
    near, height, is_own = near[inside], height[inside], (np.arange(len(near)) < len(own))[inside]
    if not is_own.any():
        return near[:0]
    stretch = np.floor((cells.xy[near] @ np.array((-line[1], line[0])) - line[3]) / STRETCH).astype(np.int64)
    stretch -= stretch.min()
    total = int(stretch.max()) + 1
    on_line = np.abs(weighted_medians(stretch, height, cells.strength[near], total)) <= ON_LINE
    return near[~is_own & _reached(on_line, np.bincount(stretch[is_own], minlength=total) > 0)[stretch]]


def _reached(on_line: NDArray[np.bool_], own: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(s,) the stretches on its line that a wall reaches from its own ones, with gaps of at most LONGEST_GAP."""
    known = np.flatnonzero(on_line | own)
    run = np.cumsum(np.diff(known, prepend=known[0]) > LONGEST_GAP / STRETCH)
    of_own = run[own[known]]
    reached = np.zeros(len(own), np.bool_)
    reached[known[(run >= of_own[0]) & (run <= of_own[-1])]] = True
    return reached & on_line


def weighted_medians(group: NDArray[np.int64], values: Floats, weights: Floats, groups: int) -> Floats:
    """(groups,) the weighted median of the values (n,) of each group, NaN for none."""
    order = np.lexsort((values, group))
    total = np.bincount(group, weights, groups)
    middle = np.cumsum(total) - total / 2
    at = np.searchsorted(np.cumsum(weights[order]), middle)
    found = values[order][np.minimum(at, len(order) - 1)]
    return np.where(total > 0, found, np.nan)
