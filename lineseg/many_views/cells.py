"""Small squares of the world: what was measured in each, from how many views, and which way the surface faces there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..posed.nearest import first_from

# Side of a square [m], and how far around it points tell the direction of the surface [squares].
SIDE = 0.04
AROUND = 6
# More views than this do not add to the weight of a square.
MOST_VIEWS = 8
MOST_POINTS = 20
# Squares are numbered row by row, at most so many in a row; those seen from other quarters of the sky are others.
ROW = 1 << 24
QUARTERS = 4

Floats = NDArray[np.float64]


class Cells(NamedTuple):
    """xy: (c, 2) mean of the points [m]; toward: (c, 2) mean direction to the laser; views: (c,) number of views;
    strength: (c,) number of points, of each view at most MOST_POINTS;
    normal: (c, 2) of the surface, towards the laser; flat: (c,) rms of the points around the local line [m];
    spread: (c,) their rms along it [m]; key: (c,) rising; origin: (2,) the corner of the first square [m].
    """

    xy: Floats
    toward: Floats
    views: Floats
    strength: Floats
    normal: Floats
    flat: Floats
    spread: Floats
    key: NDArray[np.int64]
    origin: Floats


def cells_of(placed: NDArray[np.floating], scan: NDArray[np.integer], poses: Floats, views: NDArray[np.int64]) -> Cells:
    """The squares that something is seen in.

    placed: (n, 2) points in the world; scan: (n,) scan of each; poses: (m, 3), views: (m,) of each scan.
    Within a square each view counts alike, however many points it has there.
    """
    origin = placed.min(axis=0).astype(np.float64)
    toward = poses[scan, :2] - placed
    toward /= np.maximum(np.hypot(*toward.T), 1e-6)[:, None]
    quarter = np.floor(np.arctan2(toward[:, 1], toward[:, 0]) * (QUARTERS / (2 * np.pi))).astype(np.int64) % QUARTERS
    column, row = np.floor((placed - origin) / SIDE).astype(np.int64).T
    key = (column * ROW + row) * QUARTERS + quarter
    order = np.argsort(key * (int(views.max()) + 1) + views[scan])
    key, view = key[order], views[scan[order]]
    starts = np.flatnonzero((np.diff(key, prepend=-1) != 0) | (np.diff(view, prepend=-1) != 0))
    sizes = np.diff(starts, append=len(key))
    strength = np.minimum(sizes, MOST_POINTS).astype(np.float64)
    values = np.column_stack((placed[order], toward[order])).astype(np.float64)
    of_views = np.add.reduceat(values, starts) / sizes[:, None]
    key = key[starts]
    starts = np.flatnonzero(np.diff(key, prepend=-1) != 0)
    counts = np.diff(starts, append=len(key))
    means = np.add.reduceat(of_views, starts) / counts[:, None]
    strength = np.add.reduceat(strength, starts)
    key, counts = key[starts], counts.astype(np.float64)
    surface = np.zeros((len(key), 4))
    xy, looking = np.ascontiguousarray(means[:, :2]), np.ascontiguousarray(means[:, 2:])
    surfaces(key, xy, looking, np.minimum(counts, MOST_VIEWS), ROW, QUARTERS, AROUND, surface)
    return Cells(
        xy,
        looking,
        counts,
        strength,
        np.ascontiguousarray(surface[:, :2]),
        surface[:, 2].copy(),
        surface[:, 3].copy(),
        key,
        origin,
    )


@entry_kernel
def surfaces(keys, xy, toward, weights, row, quarters, around, surface):
    """Normal, rms across and rms along of the points around each square, by the eigenvectors of their scatter.

    Only squares seen from the same half of the sky count: the two faces of a board are two surfaces.
    """
    for i in range(len(keys)):
        place = keys[i] // quarters
        n = sx = sy = sxx = sxy = syy = 0.0
        for column in range(-around, around + 1):
            start = (place + column * row - around) * quarters
            j = first_from(keys, start)
            while j < len(keys) and keys[j] < start + (2 * around + 1) * quarters:
                if toward[i, 0] * toward[j, 0] + toward[i, 1] * toward[j, 1] > 0:
                    w = weights[j]
                    x, y = xy[j, 0] - xy[i, 0], xy[j, 1] - xy[i, 1]
                    n += w
                    sx += w * x
                    sy += w * y
                    sxx += w * x * x
                    sxy += w * x * y
                    syy += w * y * y
                j += 1
        a, b, c = sxx / n - sx * sx / n / n, sxy / n - sx * sy / n / n, syy / n - sy * sy / n / n
        surface[i, 0], surface[i, 1], surface[i, 2], surface[i, 3] = across_and_along(
            a, b, c, toward[i, 0], toward[i, 1]
        )


@kernel
def across_and_along(a, b, c, x, y):
    """Normal (two numbers, towards (x, y)), rms across and rms along of points with the scatter ((a, b), (b, c))."""
    angle = 0.5 * np.arctan2(2 * b, a - c)
    half = np.sqrt((a - c) * (a - c) / 4 + b * b)
    nx, ny = -np.sin(angle), np.cos(angle)
    if nx * x + ny * y < 0:
        nx, ny = -nx, -ny
    return nx, ny, np.sqrt(max((a + c) / 2 - half, 0.0)), np.sqrt((a + c) / 2 + half)
