"""How straight and how even the walls are: the height of the surface over its line, stretch by stretch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .growing import Walls

# Length of a stretch [m].
STRETCH = 0.20
# A wall whose middle stands out by more than this share of its length, and by more than this [m], is a curve.
CURVED, LEAST_SAGITTA = 0.025, 0.015
# A surface that scatters by so many times what most do, and by more than this [m], is rough: a hedge, books, people.
ROUGH, LEAST_SCATTER = 2.0, 0.025

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Profiles:
    """starts: (w + 1,) the first stretch of each wall; mean, scatter: (s,) height of the points [m], its standard
    deviation, NaN where there are none; points, views: (s,) numbers.
    """

    starts: NDArray[np.int64]
    mean: Floats
    scatter: Floats
    points: NDArray[np.int64]
    views: NDArray[np.int64]

    @property
    def wall(self) -> NDArray[np.int64]:
        """(s,) the wall of each stretch."""
        return np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))


def stretches_of(
    placed: NDArray[np.floating], found: NDArray[np.int32], walls: Walls, starts: NDArray[np.int64]
) -> NDArray[np.int64]:
    """(n,) the stretch of each point that has a wall."""
    along = walls.along[found]
    at = (placed * along).sum(axis=1) - walls.low[found]
    most = np.diff(starts)[found] - 1
    return starts[found] + np.clip(np.floor(at / STRETCH).astype(np.int64), 0, most)


def profiles_of(
    placed: NDArray[np.floating],
    found: NDArray[np.int32],
    height: NDArray[np.floating],
    view: NDArray[np.int64],
    walls: Walls,
) -> Profiles:
    """The profile of each wall from its points (n, 2), their walls, heights [m] and views."""
    starts = np.concatenate(
        ([0], np.cumsum(np.maximum(np.ceil((walls.high - walls.low) / STRETCH), 1).astype(np.int64)))
    )
    stretch, total = stretches_of(placed, found, walls, starts), int(starts[-1])
    points = np.bincount(stretch, minlength=total)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(stretch, height, total) / points
        scatter = np.sqrt(np.maximum(np.bincount(stretch, height.astype(np.float64) ** 2, total) / points - mean**2, 0))
    kinds = int(view.max(initial=0)) + 1
    pairs = np.unique(stretch * kinds + view)
    return Profiles(starts, mean, scatter, points, np.bincount(pairs // kinds, minlength=total))


def is_even(profiles: Profiles) -> NDArray[np.bool_]:
    """(w,) whether the surface of each wall scatters no more than most do."""
    known = profiles.points > 0
    wall, walls = profiles.wall[known], len(profiles.starts) - 1
    points = profiles.points[known]
    scatter = np.bincount(wall, profiles.scatter[known] * points, walls) / np.maximum(
        np.bincount(wall, points, walls), 1
    )
    usual = float(np.median(np.repeat(scatter[wall], points))) if len(wall) else 0.0
    return scatter < max(ROUGH * usual, LEAST_SCATTER)


def is_straight(
    placed: NDArray[np.floating], found: NDArray[np.int32], height: NDArray[np.floating], walls: Walls
) -> NDArray[np.bool_]:
    """(w,) whether each wall is straight: a parabola through its points (n, 2) hardly stands out in its middle."""
    count = len(walls)
    middle, half = (walls.low + walls.high) / 2, (walls.high - walls.low) / 2
    square = (((placed * walls.along[found]).sum(axis=1) - middle[found]) / half[found]) ** 2
    # Near the ends, and far from the line, lie points of other walls.
    inner = (np.abs(height) < np.maximum(2.5 * walls.rms, 0.02)[found]) & (square < 0.8)
    found, height, square = found[inner], height[inner], square[inner]
    points = np.maximum(np.bincount(found, minlength=count), 1)
    square -= (np.bincount(found, square, count) / points)[found]
    sagitta = np.bincount(found, square * height, count) / np.maximum(np.bincount(found, square**2, count), 1e-9)
    return np.abs(sagitta) < np.maximum(CURVED * 2 * half, LEAST_SAGITTA)
