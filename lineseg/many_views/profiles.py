"""The height of the surface over the line of its wall, stretch by stretch: how straight and how even the walls are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..posed.walls import Walls

# Length of a stretch [m].
STRETCH = 0.20
# A wall whose middle stands out by more than this share of its length, and by so many times as much as walls of the
# recording bend anyway, is a curve; bounds of that height [m].
CURVED, TIMES_BENT, LEAST_SAGITTA, MOST_SAGITTA = 0.025, 3.0, 0.015, 0.07
# A surface that scatters by so many times what most do, and by more than this [m], is rough: a hedge, books, people.
ROUGH, LEAST_SCATTER = 2.0, 0.025
# Fewer points than this do not tell how the laser scatters at their range.
FEW = 200
# Median absolute deviation of a normal distribution, in standard deviations.
MAD = 0.6745
FINEST = 1_000_000
# Of all points, so many tell how the laser scatters at each range.
MOST_POINTS = 400_000

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Profiles:
    """starts: (w + 1,) the first stretch of each wall; at: (s,) the middle of each stretch along its wall [m];
    height: (s,) median height of its points, NaN without points; scatter: (s,) their robust standard deviation [m];
    points, views: (s,) numbers.
    """

    starts: NDArray[np.int64]
    at: Floats
    height: Floats
    scatter: Floats
    points: NDArray[np.int64]
    views: NDArray[np.int64]

    @property
    def wall(self) -> NDArray[np.int64]:
        """(s,) the wall of each stretch."""
        return np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))

    @property
    def scatter_of_walls(self) -> Floats:
        """(w,) mean standard deviation of the points of each wall [m]."""
        known, walls = self.points > 0, len(self.starts) - 1
        wall, points = self.wall[known], self.points[known]
        return np.bincount(wall, self.scatter[known] * points, walls) / np.maximum(np.bincount(wall, points, walls), 1)


def calmed(values: Floats, profiles: Profiles) -> Floats:
    """(s,) the median of the value of each stretch and those of its two neighbours, or of the three at an end of its
    wall, where returns of other walls lie. Stretches without points have that of the wall; NaN for none at all.
    """
    wall = profiles.wall
    usual = medians(wall[profiles.points > 0], values[profiles.points > 0], len(profiles.starts) - 1)
    filled = np.where(profiles.points > 0, values, usual[wall])
    first, last = profiles.starts[wall], profiles.starts[wall + 1] - 1
    place = np.clip(np.arange(len(values)), np.minimum(first + 1, last), np.maximum(last - 1, first))
    sides = [filled[np.clip(place + step, first, last)] for step in (-1, 0, 1)]
    return np.median(sides, axis=0)


def starts_of(walls: Walls, length: float) -> NDArray[np.int64]:
    """(w + 1,) the first stretch of each wall."""
    count = np.maximum(np.ceil((walls.high - walls.low) / length), 1).astype(np.int64)
    return np.concatenate(([0], np.cumsum(count)))


def stretches_of(
    placed: NDArray[np.floating],
    found: NDArray[np.int32],
    walls: Walls,
    starts: NDArray[np.int64],
    length: float = STRETCH,
) -> NDArray[np.int64]:
    """(n,) the stretch of each point that has a wall."""
    at = (placed * walls.along[found]).sum(axis=1) - walls.low[found]
    most = np.diff(starts)[found] - 1
    return starts[found] + np.clip(np.floor(at / length).astype(np.int64), 0, most)


def profiles_of(
    placed: NDArray[np.floating],
    found: NDArray[np.int32],
    height: NDArray[np.floating],
    view: NDArray[np.int64],
    walls: Walls,
    length: float = STRETCH,
) -> Profiles:
    """The profile of each wall from its points (n, 2), their walls, heights [m] and views."""
    starts = starts_of(walls, length)
    stretch, total = stretches_of(placed, found, walls, starts, length), int(starts[-1])
    wall = np.repeat(np.arange(len(walls)), np.diff(starts))
    at = walls.low[wall] + (np.arange(total) - starts[wall] + 0.5) * length
    middle = medians(stretch, height, total)
    scatter = medians(stretch, np.abs(height - middle[stretch]), total) / MAD
    kinds = int(view.max(initial=0)) + 1
    pairs = np.unique(stretch * kinds + view)
    points, views = np.bincount(stretch, minlength=total), np.bincount(pairs // kinds, minlength=total)
    return Profiles(starts, at, middle, scatter, points, views)


def medians(group: NDArray[np.int64], values: NDArray[np.floating], groups: int) -> Floats:
    """(groups,) the median of the values (n,) of each group, NaN for none; of an even number, the upper one.

    Values are rounded to a millionth of their range, so that one sort of whole numbers does both.
    """
    found = np.full(groups, np.nan)
    if not len(values):
        return found
    least = float(values.min())
    step = max((float(values.max()) - least) / FINEST, 1e-12)
    ordered = np.sort(group * (FINEST + 1) + np.rint((values - least) / step).astype(np.int64))
    counts = np.bincount(group, minlength=groups)
    middle = np.cumsum(counts) - counts + counts // 2
    found[counts > 0] = ordered[middle[counts > 0]] % (FINEST + 1) * step + least
    return found


def scatter_by_range(off: NDArray[np.floating], away: NDArray[np.floating]) -> Floats:
    """(k,) the robust standard deviation of the distances `off` (n,) [m] of points as far `away` (n,) [m], metre by
    metre: of a laser that scatters more on far walls."""
    metre, every = away.astype(np.int64), -(-len(off) // MOST_POINTS)
    return np.nan_to_num(medians(metre[::every], off[::every], int(metre.max(initial=0)) + 1) / MAD)


def is_even(
    stretch: NDArray[np.int64], off: NDArray[np.floating], away: NDArray[np.floating], by_range: Floats,
    profiles: Profiles,
) -> NDArray[np.bool_]:  # fmt: skip
    """(w,) whether the surface of each wall scatters no more than the laser does on others as far away, or farther.

    stretch, off, away: (n,) of each point near a wall its stretch, its distance from the surface and from the laser
    [m]; by_range: see `scatter_by_range`.
    """
    metre = away.astype(np.int64)
    told = np.where(np.bincount(metre, minlength=len(by_range)) >= FEW, by_range, np.inf)
    usual = np.minimum.accumulate(told[::-1])[::-1]
    expected = np.maximum(ROUGH * usual[metre], LEAST_SCATTER)
    walls = len(profiles.starts) - 1
    shares = medians(profiles.wall[stretch], np.minimum(off / expected, 2.0), walls) / MAD
    return ~(shares >= 1.0)


def is_straight(fine: Profiles, walls: Walls, bent: float) -> NDArray[np.bool_]:
    """(w,) whether each wall is straight: a parabola through its profile hardly stands out in its middle.

    bent: how far walls of the recording lie from straight [m], see `evenness`.

    The first and the last stretch are left out, because returns of other walls may lie in them.
    """
    known = fine.points > 0
    wall, height, points = fine.wall[known], fine.height[known], np.minimum(fine.points[known], 20) ** 0.5
    middle, half = (walls.low + walls.high) / 2, (walls.high - walls.low) / 2
    at = (fine.at[known] - middle[wall]) / half[wall]
    sagitta = np.zeros(len(walls))
    for one, (first, last) in enumerate(zip(*_ranges(wall, len(walls)), strict=True)):
        inner = slice(first + 1, last - 1)
        if last - first >= 6:
            sagitta[one] = _bulge(at[inner], height[inner], points[inner])
    most = np.maximum(CURVED * 2 * half, TIMES_BENT * bent)
    return np.abs(sagitta) < np.clip(most, LEAST_SAGITTA, MOST_SAGITTA)


def _bulge(at: Floats, height: Floats, weights: Floats) -> float:
    """The height of a parabola between −1 and 1 over its chord [m]; what lies far from a first one is left out."""
    for _ in range(2):
        off = np.abs(height - np.polyval(np.polyfit(at, height, 2, w=weights), at))
        kept = off <= max(3 * float(np.median(off)) / MAD, 0.005)
        if kept.sum() < 4:
            break
        at, height, weights = at[kept], height[kept], weights[kept]
    return float(np.polyfit(at, height, 2, w=weights)[0])


def _ranges(wall: NDArray[np.int64], walls: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The half-open range of each wall in the rising `wall` (s,)."""
    return np.searchsorted(wall, np.arange(walls)), np.searchsorted(wall, np.arange(walls), side="right")
