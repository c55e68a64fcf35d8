"""Line tracking, the incremental method: extend a line point by point until one is too far from it.

Siadat, Kaske, Klausmann, Dufaut, Husson: *An optimized segmentation method for a 2D laser-scanner applied to mobile
robot navigation*, 3rd IFAC Symposium on Intelligent Components and Instruments for Control Applications, 1997;
"Incremental" in Nguyen, Gächter, Martinelli, Tomatis, Siegwart: *A comparison of line extraction algorithms using 2D
range data for indoor mobile robotics*, Autonomous Robots 23, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..kernel import entry_kernel
from ..knobs import Knob, Thresholds
from ..total_least_squares import is_nearer, moments_of, scatter_of, with_point
from ..tracing.vocabulary import Kind
from .found import Found, Method, vocabulary
from .knobs import EPSILON, MAX_GAP, MIN_LENGTH, MIN_POINTS
from .sequence import Sequence, fit, opened_between_lines


@dataclass(frozen=True)
class TrackingParams(Thresholds):
    """Thresholds of line tracking."""

    epsilon: Annotated[float, EPSILON] = 0.04
    start_points: Annotated[
        int,
        Knob(
            "S_num", 2, 20, "", 1, least=2, most=1000,
            label="points at the start",
            why="a line needs at least 2 points",
            help="Points that start a line without a check. Higher gives a more reliable direction but can hide a "
            "corner.",
        ),
    ] = 4  # fmt: skip
    max_gap: Annotated[float, MAX_GAP] = 0.5
    min_points: Annotated[int, MIN_POINTS] = 10
    min_length: Annotated[float, MIN_LENGTH] = 0.6


VOCABULARY = vocabulary(
    "tracking",
    ("epsilon", "max_gap", "end"),
    Kind("line begun", "tracking", "shown", "seed", "line started: through the first points, {span}"),
    Kind(
        "point refused", "tracking", "shown", "refusal",
        "line ended: beam {beam} lies {value:.3f} m from it, ε = {limit:.3f} m; it keeps {span}",
    ),
    Kind(
        "gap", "tracking", "shown", "refusal",
        "line ended: a gap of {value:.3f} m lies before beam {beam}, G_max = {limit:.3f} m; it keeps {span}",
    ),
    Kind("last point", "tracking", "shown", "", "line ended at the last point; it keeps {span}"),
)  # fmt: skip


def find(points: Sequence, params: TrackingParams, found: Found) -> None:
    """Find lines in scan order, each starting at the point that the previous line refused.

    Each point is tested once and never reassigned. A line may therefore keep a corner point that fits the next line
    better, and the result depends on the direction of the scan.
    """
    points = found.points = opened_between_lines(points, lambda circle: _spans(circle, circle.gaps(), params))
    gaps = points.gaps()
    for first, last in _spans(points, gaps, params):
        run = np.arange(first, last + 1)
        if found.traced:
            _note(points, gaps, run, params, found)
        found.keep(run)


def _spans(points: Sequence, gaps: np.ndarray, params: TrackingParams) -> list[tuple[int, int]]:
    spans, first = [], 0
    while first < len(points.x):
        last = track(points.x, points.y, gaps, first, params.start_points, params.epsilon, params.max_gap)
        spans.append((first, last))
        first = last + 1
    return spans


@entry_kernel
def track(x, y, gaps, first, start_points, epsilon, max_gap):
    """The last point of the line that starts at `first`: no gap is wider than max_gap, and each point after the first
    `start_points` lies nearer than ε to the line through the points before it."""
    last, stop = first, len(x)
    while last + 1 < min(first + start_points, stop) and gaps[last + 1] <= max_gap:
        last += 1
    if last + 1 < first + start_points:
        return last
    scatter, near = scatter_of(moments_of(x, y, first, last)), epsilon * epsilon
    while last + 1 < stop and gaps[last + 1] <= max_gap and is_nearer(scatter, x[last + 1], y[last + 1], near):
        last += 1
        scatter = with_point(scatter, x[last], y[last])
    return last


def _note(points: Sequence, gaps: np.ndarray, run: np.ndarray, params: TrackingParams, found: Found) -> None:
    if len(run) < 2:
        return
    start = run[: params.start_points]
    found.note("line begun", start, fit(points, start).line)
    line, after = fit(points, run).line, int(run[-1]) + 1
    if after == len(points.x):
        found.note("last point", run, line, check="end")
    elif gaps[after] > params.max_gap:
        found.note("gap", run, line, check="max_gap", beam=after, value=gaps[after], limit=params.max_gap)
    else:
        value = float(points.distances(line)[after])
        found.note("point refused", run, line, check="epsilon", beam=after, value=value, limit=params.epsilon)


LINE_TRACKING = Method("line-tracking", VOCABULARY, find)
