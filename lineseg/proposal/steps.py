"""Cuts lines where they step aside, as a line does that takes in a door set back a little.

A wall that bends leaves its line little by little. At a door, the points beside the jamb lie on one side of the line
before it and on the other after it. So a step is where the mean distance from the line of a few points differs from
that of as many points before them much more than it usually does at such ranges.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ..params import Params
from ..scan import Floats, Scan
from ..segment import Extraction

# Numbers of points on either side that are compared.
SIDES = (3, 5, 8)
# A difference this many times the usual one is a step.
TIMES = 4.0
# Differences are usual among those of a quarter of the points, by range, if there are so many of them.
PARTS, LEAST = 4, 30
# Of the steps this many points apart, or less, the highest counts.
APART = 4


@dataclass(frozen=True, eq=False)
class _Points:
    """The points of all lines, line by line in scan order.

    along, off: (m,) position along the line and signed distance from it [m]; ranges: (m,) [m]; line, scan, beam: (m,).
    """

    along: Floats
    off: Floats
    ranges: Floats
    line: NDArray[np.intp]
    scan: NDArray[np.intp]
    beam: NDArray[np.intp]


def cut_at_steps(
    scans: Sequence[Scan], found: Sequence[Extraction], demands: Params
) -> tuple[list[NDArray[np.int64]], float]:
    """For each scan the piece of a line that each beam belongs to (n,), or −1; and the share of lines that step.

    Pieces with fewer than P_min points or shorter than L_min are left out.
    """
    points = _points(scans, found)
    steps = _steps(points)
    share = len(np.unique(points.line[steps])) / max(sum(len(one.segments) for one in found), 1)
    begins = np.diff(points.line, prepend=-1) != 0
    begins[steps] = True
    piece, first = np.cumsum(begins) - 1, np.flatnonzero(begins)
    last = np.append(first[1:], len(begins))[: len(first)] - 1
    enough = last - first + 1 >= demands.min_points
    enough &= np.abs(points.along[last] - points.along[first]) >= demands.min_length
    labels = []
    for number, scan in enumerate(scans):
        here = points.scan == number
        here[here] = enough[piece[here]]
        labels.append(np.full(len(scan), -1))
        labels[-1][points.beam[here]] = np.unique(piece[here], return_inverse=True)[1]
    return labels, share


def _points(scans: Sequence[Scan], found: Sequence[Extraction]) -> _Points:
    parts: list[tuple[NDArray, ...]] = []
    for number, (scan, one) in enumerate(zip(scans, found, strict=True)):
        for label, segment in enumerate(one.segments):
            beams = np.flatnonzero(one.labels == label)
            # On a full circle, a line may begin before the seam and end after it.
            beams = np.roll(beams, -int(np.searchsorted(beams, segment.first)))
            a, b, c = segment.line
            ranges = scan.ranges[beams].astype(np.float64)
            x, y = ranges * scan.rays[:, beams]
            same = (np.full(len(beams), each) for each in (len(parts), number))
            parts.append((a * y - b * x, a * x + b * y + c, ranges, *same, beams))
    none = (np.empty(0), np.empty(0), np.empty(0), *(np.empty(0, np.intp) for _ in range(3)))
    return _Points(*map(np.concatenate, zip(none, *parts, strict=True)))


def _steps(points: _Points) -> NDArray[np.intp]:
    """The points before which a line steps aside."""
    n = len(points.off)
    high = np.zeros(n)
    part = np.searchsorted(np.quantile(points.ranges, np.arange(1, PARTS) / PARTS), points.ranges) if n else high
    sums = np.concatenate(([0.0], np.cumsum(points.off)))
    for side in SIDES:
        here = np.arange(side, n - side + 1)
        here = here[points.line[here - side] == points.line[here + side - 1]]
        differ = np.abs(sums[here + side] - 2 * sums[here] + sums[here - side]) / side
        for each in range(PARTS):
            some = part[here] == each
            # The median of normal values is 0.6745 standard deviations.
            usual = np.median(differ[some]) / 0.6745 if np.count_nonzero(some) >= LEAST else 0.0
            if usual > 0.0:
                high[here[some]] = np.maximum(high[here[some]], differ[some] / usual)
    around = sliding_window_view(np.pad(high, APART), 2 * APART + 1).max(axis=1) if n else high
    return np.flatnonzero((high > TIMES) & (high == around))
