"""Region growing (Algorithm 2)."""

from __future__ import annotations

import math

from ..kernel import inlined_kernel, kernel
from ..total_least_squares import at, is_nearer, line_through, signed_distance, with_point
from ..tracing.log import note
from .checks import END, EPSILON, GROWTH_STOPPED, NONE, POINT_ADDED
from .limits import near
from .points import MAX_VOID, are_parted, breach


@inlined_kernel
def grow(points, seed, scatter, limits, candidate, log):
    """The line (first, last, scatter) grown from the seed at position `seed`, forward to its end, then backward.

    A point joins if it is nearer than ε, at its range, to the line fitted without it; then the line is refitted. The
    bounds are tested before the distance (the listing computes the distance first). Backward growth may enter the
    previous line.
    """
    first, last = seed, seed + limits.seed_points - 1
    last, scatter = advance(points, first, last, 1, scatter, limits, candidate, log)
    first, scatter = advance(points, first, last, -1, scatter, limits, candidate, log)
    return first, last, scatter


@inlined_kernel
def advance(points, first, last, direction, scatter, limits, candidate, log):
    """The last position reached in `direction`, and the scatter of the line up to it."""
    here = last if direction > 0 else first
    # The span from the far end of the line to the farthest position it may reach.
    most = points.period - (last - first + 1)
    edge = min(here + most, len(points.x) - 1) if direction > 0 else max(here - most, 0)
    while here != edge:
        there = here + direction
        x, y = at(points.x, there), at(points.y, there)
        if not is_nearer(scatter, x, y, near(limits, x * x + y * y)):
            break
        step = max(here, there)
        if at(points.breaks, step) != 0 and are_parted(points, step, limits):
            break
        if log is not None:
            line = line_through(scatter)
            span = (min(first, there), max(last, there))
            value, limit = abs(signed_distance(line, x, y)), math.sqrt(near(limits, x * x + y * y))
            note(log, POINT_ADDED, EPSILON, candidate, direction, span, there, line, value, limit)
            first, last = span
        scatter = with_point(scatter, x, y)
        here = there
    if log is not None:
        note_stop(points, first, last, here, edge, direction, scatter, limits, candidate, log)
    return here, scatter


@kernel
def note_stop(points, first, last, here, edge, direction, scatter, limits, candidate, log):
    line = line_through(scatter)
    if here == edge:
        note(log, GROWTH_STOPPED, END, candidate, direction, (first, last), -1, line, 0.0, 0.0)
        return
    there = here + direction
    check, value, limit = breach(points, here, there, limits)
    x, y = points.x[there], points.y[there]
    away, epsilon = abs(signed_distance(line, x, y)), math.sqrt(near(limits, x * x + y * y))
    # Every jump to another surface is a void; what keeps its points out is ε.
    if check == NONE or (check == MAX_VOID and away >= epsilon):
        check, value, limit = EPSILON, away, epsilon
    note(log, GROWTH_STOPPED, check, candidate, direction, (first, last), there, line, value, limit)
