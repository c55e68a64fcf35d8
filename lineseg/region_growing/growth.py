"""Region growing (Algorithm 2)."""

from __future__ import annotations

from ..kernel import inlined_kernel, kernel
from ..log import note
from ..total_least_squares import add, is_nearer, line_of, project, signed_distance
from .log import END, EPSILON, GROWTH_STOPPED, NONE, POINT_ADDED
from .points import breach


@inlined_kernel
def grow(points, seed, moments, limits, candidate, log):
    """The line (first, last, moments) that grows from the seed at position `seed`: forward to its end, then backward.

    A point is compared with the line fitted without it and joins if it is nearer than ε; then the line is fitted anew.
    The bounds are tested before the point is looked at (the listing looks first). Backward growth may enter the line
    before it.
    """
    first, last = seed, seed + limits.seed_points - 1
    last, moments = advance(points, first, last, 1, moments, limits, candidate, log)
    first, moments = advance(points, first, last, -1, moments, limits, candidate, log)
    return first, last, moments


@inlined_kernel
def advance(points, first, last, direction, moments, limits, candidate, log):
    """The last position reached in `direction`, and the moments of the line up to there."""
    here = last if direction > 0 else first
    # The span from the far end of the line to the farthest position that it may reach.
    most = points.period - (last - first + 1)
    edge = min(here + most, len(points.x) - 1) if direction > 0 else max(here - most, 0)
    while here != edge:
        there = here + direction
        if points.breaks[there] != points.breaks[here]:
            break
        x, y = points.x[there], points.y[there]
        if not is_nearer(moments, x, y, limits.epsilon):
            break
        if log is not None:
            line = line_of(moments)
            span = (min(first, there), max(last, there))
            value = abs(signed_distance(line, x, y))
            note(log, POINT_ADDED, EPSILON, candidate, direction, span, there, line, value, limits.epsilon)
            first, last = span
        moments = add(moments, x, y)
        here = there
    if log is not None:
        note_stop(points, first, last, here, edge, direction, moments, limits, candidate, log)
    return here, moments


@kernel
def note_stop(points, first, last, here, edge, direction, moments, limits, candidate, log):
    line = line_of(moments)
    if here == edge:
        note(log, GROWTH_STOPPED, END, candidate, direction, (first, last), -1, line, 0.0, 0.0)
        return
    there = here + direction
    check, value, limit = breach(points, here, there, limits)
    if check == NONE:
        check, limit = EPSILON, limits.epsilon
        value = abs(signed_distance(line, points.x[there], points.y[there]))
    note(log, GROWTH_STOPPED, check, candidate, direction, (first, last), there, line, value, limit)


@kernel
def length_of(points, first, last, line):
    """L_l: the distance between the two endpoints, projected on the line [m]."""
    x1, y1 = project(line, points.x[first], points.y[first])
    x2, y2 = project(line, points.x[last], points.y[last])
    return ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5
