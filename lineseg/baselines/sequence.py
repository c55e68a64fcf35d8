"""The points of a scan as a sequence, runs of points in it, and the line through a run."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, summing_kernel
from ..scan import Scan
from ..total_least_squares import line_of, moments_of, project, squared_distance

Line = tuple[float, float, float]
# Positions in a sequence, in order; on a full circle they may continue from the last to the first.
Positions = NDArray[np.intp]


class Sequence(NamedTuple):
    """The valid points in scan order; on a full circle, all the way round from some opening.

    x, y: (n,) [m]; beam: (n,) beam of each point; circle: whether the first point follows the last.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    beam: NDArray[np.intp]
    circle: bool

    def opened(self, place: int) -> Sequence:
        """The same circle, opened before the point at `place`."""
        return Sequence(np.roll(self.x, -place), np.roll(self.y, -place), np.roll(self.beam, -place), self.circle)

    def gaps(self) -> NDArray[np.float64]:
        """(n,) distance from the previous point to each point [m]; infinite for the first point of an open scan."""
        gaps = np.hypot(self.x - np.roll(self.x, 1), self.y - np.roll(self.y, 1))
        if not self.circle:
            gaps[:1] = np.inf
        return gaps

    def distances(self, line: Line) -> NDArray[np.float64]:
        """(n,) distance from each point to a line [m]."""
        a, b, c = line
        return np.abs(a * self.x + b * self.y + c)


class Fit(NamedTuple):
    """A line through points: (a, b, c), the outermost points projected onto it [m], and the rms distance [m]."""

    line: Line
    start: tuple[float, float]
    end: tuple[float, float]
    length: float
    rms: float


def sequence_of(scan: Scan) -> Sequence:
    """The sequence of a scan. A full circle has no first beam, so it is opened at its widest gap."""
    beam = np.flatnonzero(scan.valid)
    x, y = scan.xy[beam].T.copy()
    points = Sequence(x, y, beam, scan.full_circle)
    return points.opened(int(np.argmax(points.gaps()))) if points.circle and len(beam) else points


def opened_between_lines(points: Sequence, spans: Callable[[Sequence], list[tuple[int, int]]]) -> Sequence:
    """A full circle opened where a line begins, so that a point-by-point method cuts no line at the opening.

    spans: first and last position of each line found by the method.
    """
    if not points.circle:
        return points
    found = spans(points)
    return points.opened(found[1][0]) if len(found) > 1 else points


def runs(points: Sequence, members: NDArray[np.bool_], bridge: int, max_gap: float) -> list[Positions]:
    """Runs of members (n,) with at most `bridge` other points and at most `max_gap` [m] between neighbours."""
    place = np.flatnonzero(members)
    if not len(place):
        return []
    before = np.roll(place, 1)
    apart = np.hypot(points.x[place] - points.x[before], points.y[place] - points.y[before])
    cut = ((place - before) % len(points.x) > bridge + 1) | (apart > max_gap)
    if not points.circle:
        cut[0] = True
    starts = np.flatnonzero(cut)
    first = int(starts[0]) if len(starts) else 0
    return np.split(np.roll(place, -first), starts[1:] - first)


def fit(points: Sequence, run: Positions) -> Fit:
    """The line through the points of a run of 2 or more, by total least squares."""
    a, b, c, x1, y1, x2, y2, rms = fit_line(points.x[run], points.y[run])
    return Fit((a, b, c), (x1, y1), (x2, y2), math.hypot(x2 - x1, y2 - y1), rms)


@entry_kernel
def fit_line(x, y):
    """(a, b, c, x1, y1, x2, y2, rms) of the line through the points (n,), and its ends."""
    last = len(x) - 1
    line = line_of(moments_of(x, y, 0, last))
    x1, y1 = project(line, x[0], y[0])
    x2, y2 = project(line, x[last], y[last])
    return line[0], line[1], line[2], x1, y1, x2, y2, math.sqrt(mean_square(x, y, line))


@summing_kernel
def mean_square(x, y, line):
    total = 0.0
    for k in range(len(x)):
        total += squared_distance(line, x[k], y[k])
    return total / len(x)
