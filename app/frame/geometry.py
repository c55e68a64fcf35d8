"""Bounding boxes of scans and recordings [m], and the beam nearest to a point."""

from __future__ import annotations

import math
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording, Scan
from lineseg.region_growing.points import TIMES

# x₁, y₁, x₂, y₂
Bounds = tuple[float, float, float, float]
FRAMES_FOR_BOUNDS = 60
# How many points of a frame may lie outside of each side of the bounds, and how many frames should lie inside [%].
STRAY, MOST_FRAMES = 1.0, 75.0
# Narrower voids are not shown [m].
LEAST_VOID = 0.1


def bounds_of(recording: Recording) -> Bounds:
    """A box around the laser and what it sees in most frames; ignores stray far points.

    Each side is as far out as nearly all points of a frame, in most of the frames.
    """
    frames = np.unique(np.linspace(0, len(recording) - 1, FRAMES_FOR_BOUNDS).astype(int)) if len(recording) else []
    each = [scan.xy[scan.valid] for scan in (recording[int(frame)] for frame in frames)]
    boxes = np.array([np.percentile(xy, [STRAY, 100 - STRAY], axis=0) for xy in each if len(xy)])
    if not len(boxes):
        return -5.0, -5.0, 5.0, 5.0
    low = np.minimum(np.percentile(boxes[:, 0], 100 - MOST_FRAMES, axis=0), 0.0)
    high = np.maximum(np.percentile(boxes[:, 1], MOST_FRAMES, axis=0), 0.0)
    margin = 0.02 * max(float((high - low).max()), 1.0)
    low, high = low - margin, high + margin
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def extent_of(scan: Scan, bounds: Bounds) -> Bounds:
    """The box around the points of one scan; the box of the recording if it has none."""
    if scan not in _EXTENTS:
        _EXTENTS[scan] = _extent_of(scan)
    return _EXTENTS[scan] or bounds


# While a slider moves, the scan stays the same.
_EXTENTS: WeakKeyDictionary[Scan, Bounds | None] = WeakKeyDictionary()


def _extent_of(scan: Scan) -> Bounds | None:
    xy = scan.xy[scan.valid]
    if not len(xy):
        return None
    (x1, y1), (x2, y2) = xy.min(axis=0), xy.max(axis=0)
    return float(x1), float(y1), float(x2), float(y2)


def united(one: Bounds, other: Bounds) -> Bounds:
    """The smallest box around both."""
    return min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), max(one[3], other[3])


def voids(scan: Scan, labels: NDArray[np.integer]) -> tuple[NDArray[np.intp], NDArray[np.integer]]:
    """(voids, 2) the beams on both sides of each void in a line, and (voids,) its line; labels: (n,) the line of each
    beam, or −1.

    A void is a gap of more than LEAST_VOID in which other beams ended, or one more than TIMES as wide as the gaps next
    to it.
    """
    beams, line = _along_lines(scan, labels)
    within = line[1:] == line[:-1]
    steps = (beams[1:] - beams[:-1]) % max(scan.around, len(scan))
    x, y = scan.xy[beams].T
    gaps = np.hypot(x[1:] - x[:-1], y[1:] - y[:-1])
    each = np.zeros(len(gaps) + 2)
    np.divide(gaps, np.maximum(steps, 1), out=each[1:-1], where=within)
    wide = within & (gaps > LEAST_VOID) & ((steps > 1) | (gaps > TIMES * np.maximum(each[:-2], each[2:])))
    return np.stack((beams[:-1][wide], beams[1:][wide]), axis=1), line[:-1][wide]


def _along_lines(scan: Scan, labels: NDArray[np.integer]) -> tuple[NDArray[np.intp], NDArray[np.integer]]:
    """The valid beams, line after line, and their lines; a line across the seam begins after its widest gap."""
    beams = np.flatnonzero((labels >= 0) & scan.valid)
    beams = beams[np.argsort(labels[beams], kind="stable")]
    line = labels[beams]
    if not scan.full_circle or not len(beams):
        return beams, line
    first = np.flatnonzero(np.diff(line, prepend=-1))
    counts = np.diff(first, append=len(beams))
    before = np.arange(len(beams)) - 1
    before[first] += counts
    gaps = (beams - beams[before]) % scan.around
    own = np.repeat(np.arange(len(first)), counts)
    widest = np.flatnonzero(gaps == np.maximum.reduceat(gaps, first)[own])
    begin = widest[np.unique(own[widest], return_index=True)[1]]
    return beams[first[own] + (np.arange(len(beams)) - 2 * first[own] + begin[own]) % counts[own]], line


def beam_near(scan: Scan, point: tuple[float, float], radius: float) -> int | None:
    """The beam whose point is nearest to `point`; None if no point lies within `radius`."""
    if not scan.valid.any():
        return None
    distances = np.hypot(*(scan.xy - point).T)
    nearest = int(np.nanargmin(distances))
    return nearest if distances[nearest] <= radius else None


def square_of(bounds: Bounds) -> float:
    """Side of the grid's squares [m]: 1, 2 or 5 × 10ⁿ m, such that 6 to 12 cover the longer side of a recording."""
    rough = max(bounds[2] - bounds[0], bounds[3] - bounds[1], 1e-3) / 12
    power = 10.0 ** math.floor(math.log10(rough))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= rough)
