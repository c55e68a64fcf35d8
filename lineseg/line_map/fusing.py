"""The map line of several lines of frames: least squares weighted by their covariances, and where it is seen."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .posed import Floats, PosedLines

# Step in which it is counted how many scans see a part of a line [m].
STEP = 0.02
# A map line reaches across parts that too few scans saw, if these are not longer [m].
BRIDGED = 0.30
# Shorter pieces of map lines are left out [m].
SHORTEST = 0.25


class Fused(NamedTuple):
    """Map lines (m,) over their reference lines.

    origin, normal: (m, 2) of the reference line; line: (m, 2) height and slope over it; covariance: (m, 2, 2) of these.
    spread: (m,) how many times as far as expected the lines of frames lie from it (rms).
    """

    origin: Floats
    normal: Floats
    line: Floats
    covariance: Floats
    spread: Floats


class Over(NamedTuple):
    """Lines (n,) over the reference line of their map line: along it, height at their middle, slope."""

    along: Floats
    height: Floats
    slope: Floats


def over(lines: PosedLines, owner: NDArray[np.int64], origin: Floats, normal: Floats) -> Over:
    away, n = lines.middle - origin[owner], normal[owner]
    along = n[:, 0] * away[:, 1] - n[:, 1] * away[:, 0]
    sin = n[:, 1] * lines.normal[:, 0] - n[:, 0] * lines.normal[:, 1]
    return Over(along, (n * away).sum(axis=1), sin / (n * lines.normal).sum(axis=1))


def fused(lines: PosedLines, owner: NDArray[np.int64], covariance: Floats) -> Fused:
    """One map line for each owner; scans from the same place count as one.

    If the lines of frames lie farther from it than their covariances say, its covariance is as much larger (Birge:
    *The calculation of errors by the method of least squares*, Phys. Rev. 40, 1932).
    """
    count = int(owner.max(initial=-1)) + 1
    longest = np.full(count, -1)
    order = np.argsort(lines.half, kind="stable")
    longest[owner[order]] = order
    origin, normal = lines.middle[longest], lines.normal[longest]
    along, height, slope = over(lines, owner, origin, normal)
    design = design_at(along)
    information = np.linalg.inv(covariance) * lines.weight[:, None, None]
    part = design.transpose(0, 2, 1) @ information
    measured = np.stack((height, slope), axis=1)[:, :, None]
    total = summed(owner, part @ design, count)
    line = np.linalg.solve(total, summed(owner, part @ measured, count))
    apart = measured - design @ line[owner]
    squares = summed(owner, apart.transpose(0, 2, 1) @ information @ apart, count)[:, 0, 0]
    spread = np.sqrt(squares / (2 * np.bincount(owner, lines.weight, count)))
    found = np.linalg.inv(total) * np.maximum(spread, 1.0)[:, None, None] ** 2
    return Fused(origin, normal, line[:, :, 0], found, spread)


def design_at(along: Floats) -> Floats:
    """(n, 2, 2) matrices from height and slope over a reference line to those of the same line at `along` (n,) [m]."""
    design = np.zeros((len(along), 2, 2))
    design[:, 0, 0] = design[:, 1, 1] = 1.0
    design[:, 0, 1] = along
    return design


def summed(owner: NDArray[np.int64], values: Floats, count: int) -> Floats:
    """The sums of `values` (n, …) by owner."""
    flat = values.reshape(len(values), math.prod(values.shape[1:]))
    sums = [np.bincount(owner, column, count) for column in flat.T]
    return np.stack(sums, axis=1).astype(np.float64).reshape(count, *values.shape[1:])


class Pieces(NamedTuple):
    """The parts of map lines that enough scans saw.

    line: (k,) the map line of each; low, high: along its reference line [m]; seen: how many lines of frames lie on it.
    """

    line: NDArray[np.int64]
    low: Floats
    high: Floats
    seen: NDArray[np.int64]


def pieces_of(lines: PosedLines, owner: NDArray[np.int64], made: Fused, least: int) -> Pieces:
    """The parts that `least` or more scans saw."""
    along = over(lines, owner, made.origin, made.normal).along
    count = len(made.origin)
    low, high = along - lines.half, along + lines.half
    lowest = np.full(count, np.inf)
    np.minimum.at(lowest, owner, low)
    first, stop = (np.round((each - lowest[owner]) / STEP).astype(np.int64) for each in (low, high))
    bins = np.zeros(count, np.int64)
    np.maximum.at(bins, owner, stop + 1)
    starts = np.cumsum(bins) - bins
    change = np.zeros(int(bins.sum()) + 1, np.int64)
    np.add.at(change, starts[owner] + first, 1)
    np.add.at(change, starts[owner] + stop, -1)
    # The last bin of each line is empty, so that no run crosses from one line to the next.
    enough = np.cumsum(change)[:-1] >= least
    begins, ends = runs_of(enough, np.repeat(np.arange(count), bins))
    line = np.searchsorted(starts, begins, side="right") - 1
    low, high = (lowest[line] + (bound - starts[line]) * STEP for bound in (begins, ends))
    middle = starts[owner] + (first + stop) // 2
    piece = np.searchsorted(begins, middle, side="right") - 1
    inside = (piece >= 0) & (middle < np.append(ends, 0)[piece])
    seen = np.bincount(piece[inside], minlength=len(begins))
    long = high - low >= SHORTEST
    return Pieces(line[long], low[long], high[long], seen[long])


def runs_of(enough: NDArray[np.bool_], line: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Where runs of bins begin and end (exclusive); short gaps of one line are bridged."""
    steps = np.diff(enough.astype(np.int8), prepend=0, append=0)
    begins, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    if not len(begins):
        return begins, ends
    apart = (begins[1:] - ends[:-1] > round(BRIDGED / STEP)) | (line[begins[1:]] != line[begins[:-1]])
    return begins[np.append(True, apart)], ends[np.append(apart, True)]
