"""The part of the plan that shows a decision.

Its points fill the stage, and distances across its line are exaggerated where they would be too small to be seen.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lineseg import Decision, Params, Trace

from .findings import Findings
from .geometry import Bounds
from .names import Measure, Name, feet, names_of, pair_of, point_of, shared_with

Line = tuple[float, float, float]

# The longer side of a small stage [px].
STAGE = 560.0
# What a limit and an outermost point's distance should look like [px].
LIMIT, OFFSET = 90.0, 30.0
LEAST_OFFSET = 0.0005
# The largest part of the longer side that exaggerated distances may fill.
MOST_ACROSS = 0.45
FACTORS = (100, 50, 20, 10, 5, 2)
# Longer growths are shown in blocks of points around the one under test.
LONGEST, BLOCK, AROUND = 48, 16, 12
# Points shown beyond the first and the last one.
BEYOND = 2
AROUND_CUT = 1
GROWING = ("point added", "growth stopped")


@dataclass(frozen=True)
class Framing:
    """box: of what is shown, as drawn [m]. factor: distances along the unit vector `normal` are drawn so many times as
    long, about the point `at`."""

    box: Bounds
    factor: int
    normal: tuple[float, float]
    at: tuple[float, float]
    names: tuple[Name, ...]
    measures: tuple[Measure, ...]


def framing_of(found: Findings, step: int) -> Framing | None:
    """The framing of a decision; None if it has no points."""
    trace, scan = found.trace, found.scan
    decision = trace[step]
    shown, beyond = _points_of(found, step, decision)
    xy, outside = scan.xy[shown[scan.valid[shown]]], scan.xy[beyond[scan.valid[beyond]]]
    if not len(xy):
        return None
    names, measures = names_of(found, decision)
    shared = shared_with(found, decision)
    if shared is not None and shared[1] in shown:
        names += (shared[0],)
    about = np.array([end for each in measures for end in (each.start, each.end)]).reshape(-1, 2)
    about = about[np.hypot(*(about - xy.mean(axis=0)).T) < 3 * max(float(np.ptp(xy, axis=0).max()), 0.1)]
    if decision.kind in GROWING:
        # The view stands still while a line grows, whatever its distance from the next point.
        about = about[:0]
    line = _line_of(trace, step, decision)
    return _around(np.concatenate((xy, about)), outside, line, _wanted(found, decision), names, measures)


def framing_near(found: Findings, beams: Sequence[int], named: Mapping[str, int]) -> Framing | None:
    """The framing of a whole result: of these beams, or all, with names for some.

    The line across which distances are exaggerated is that of the first of the beams, if it has one.
    """
    scan = found.scan
    names = tuple(Name(words, point_of(scan.xy[beam])) for words, beam in named.items() if scan.valid[beam])
    shown = np.array(beams, int) if len(beams) else np.flatnonzero(scan.valid)
    xy = scan.xy[shown[scan.valid[shown]]]
    if not len(xy):
        return None
    segment = int(found.extraction.labels[shown[0]]) if len(beams) else -1
    line = found.extraction.segments[segment].line if segment >= 0 else None
    return _around(xy, xy[:0], line, (LIMIT, tolerance(found)), names, ())


def _around(
    xy: NDArray,
    beyond: NDArray,
    line: Line | None,
    wanted: tuple[float, float],
    names: tuple[Name, ...],
    measures: tuple[Measure, ...],
) -> Framing:
    """xy: (n, 2) is shown, and the line beside the points beyond. wanted: what should be seen, see `_wanted`."""
    if line is None:
        return Framing(_box(xy), 1, (0.0, 1.0), (0.0, 0.0), names, measures)
    normal = np.array(line[:2])
    at = feet((beyond if len(beyond) else xy).mean(axis=0), line)
    along = np.concatenate((xy, beyond)) @ (-normal[1], normal[0])
    aside = (xy - at) @ normal
    factor = _factor(max(float(np.ptp(along)), 1e-3), float(np.abs(aside).max()), *wanted)
    drawn = xy + (factor - 1) * aside[:, None] * normal
    beside = beyond - ((beyond - at) @ normal)[:, None] * normal
    return Framing(
        _box(np.concatenate((drawn, beside))), factor, tuple(normal.tolist()), tuple(at.tolist()), names, measures
    )


def _factor(length: float, aside: float, pixels: float, distance: float) -> int:
    """The largest of FACTORS that neither draws `distance` longer than wanted nor fills too much of the stage."""
    wish = pixels * length / (STAGE * max(distance, 1e-6))
    most = min(wish, MOST_ACROSS * length / (2 * max(aside, 1e-6)))
    return next((factor for factor in FACTORS if factor <= most), 1)


def _wanted(found: Findings, decision: Decision) -> tuple[float, float]:
    """What should be seen at a decision: how large [px] a distance [m] should be."""
    if decision.ends is not None:
        outermost = found.scan.xy[[decision.first, decision.last]]
        return OFFSET, max(float(np.abs(outermost @ decision.line[:2] + decision.line[2]).min()), LEAST_OFFSET)
    return LIMIT, tolerance(found)


def tolerance(found: Findings) -> float:
    """The distance to a line that the method allows [m]."""
    params = found.trace.params
    return float(params.epsilon) if isinstance(params, Params) else float(getattr(params, "epsilon", 0.03))


def _points_of(found: Findings, step: int, decision: Decision) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The beams that a decision is about, and others up to where its line is shown.

    These are a window, what a line will have grown to, both lines, or an overlap.
    """
    trace, row = found.trace, found.trace.log[step]
    first, last, tested = int(row["first"]), int(row["last"]), [int(row["beam"])] if row["beam"] >= 0 else []
    if decision.phase == "seed":
        return _at(trace, first, last, tested), _at(trace, first - 1, last + 1)
    if decision.kind in GROWING:
        low, high = _growth(trace, row)
        return _at(trace, low, high, tested), _at(trace, low - BEYOND, high + BEYOND)
    pair, none = pair_of(found, decision), np.arange(0)
    if pair is None:
        return _at(trace, first, last, tested), none
    one, two = pair
    shared = _widened(trace, two.first, one.last)
    if decision.kind == "overlap cut" and len(shared):
        return shared, none
    return np.concatenate((_at(trace, first, last, tested), trace.beams(two.first, two.last))), none


def _growth(trace: Trace, row: np.void) -> tuple[int, int]:
    """The positions of all points that the line of this growth will have; of many, those around the one under test."""
    own = trace.log[_of_growth(trace, row)]
    low, high = int(own["first"].min()), int(own["last"].max())
    if high - low >= LONGEST:
        front = int(row["beam"] if row["beam"] >= 0 else row["last"] if row["direction"] > 0 else row["first"])
        middle = front // BLOCK * BLOCK
        low, high = max(low, middle - AROUND), min(high, middle + BLOCK + AROUND)
    return low, high


def _of_growth(trace: Trace, row: np.void) -> NDArray[np.intp]:
    """Indices of the decisions of one growth."""
    kinds = [number for number, name in enumerate(trace.vocabulary.names) if name in GROWING]
    return np.flatnonzero((trace.log["candidate"] == row["candidate"]) & np.isin(trace.log["kind"], kinds))


def _widened(trace: Trace, first: int, last: int) -> NDArray[np.intp]:
    """The beams of an overlap and some on both sides; none if there is no overlap."""
    n = len(trace.scan)
    if trace.scan.full_circle:
        return trace.beams((first - AROUND_CUT) % n, (last + AROUND_CUT) % n)
    return trace.beams(max(first - AROUND_CUT, 0), min(last + AROUND_CUT, n - 1)) if first <= last else np.arange(0)


def _at(trace: Trace, first: int, last: int, more: Sequence[int] = ()) -> NDArray[np.int64]:
    """The beams at the positions from first to last, as far as there are any, and at some more."""
    return np.unique(trace.as_beams(np.array([*range(max(first, 0), last + 1), *more], int)))


def _line_of(trace: Trace, step: int, decision: Decision) -> Line | None:
    """The line across which distances are exaggerated.

    While a line grows, it is the line that it becomes, so that the points stand still.
    """
    line = decision.line
    if decision.kind in GROWING:
        line = trace.log["line"][_of_growth(trace, trace.log[step])[-1]].item()
    return line if math.isfinite(sum(line)) and math.hypot(line[0], line[1]) > 0.5 else None


def _box(xy: NDArray) -> Bounds:
    (x1, y1), (x2, y2) = xy.min(axis=0), xy.max(axis=0)
    return float(x1), float(y1), float(x2), float(y2)
