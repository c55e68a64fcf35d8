"""Region growing (Algorithm 2)."""

from __future__ import annotations

from ..kernel import inlined_kernel, kernel
from ..total_least_squares import at, is_nearer, line_through, signed_distance, with_point
from ..tracing.log import note
from .checks import END, EPSILON, GROWTH_STOPPED, NONE, POINT_ADDED
from .points import MAX_VOID, breach


@inlined_kernel
def grow(points, seed, scatter, limits, candidate, log):
    """The line (first, last, scatter) grown from the seed at position `seed`, forward to its end, then backward.

    A point joins if it is nearer than ε to the line fitted without it; then the line is refitted. The bounds are
    tested before the distance (the listing computes the distance first). Backward growth may enter the previous line.
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
    free = at(points.breaks, here)
    while here != edge:
        there = here + direction
        if at(points.breaks, there) != free:
            break
        x, y = at(points.x, there), at(points.y, there)
        if not is_nearer(scatter, x, y, limits.epsilon):
            break
        if log is not None:
            line = line_through(scatter)
            span = (min(first, there), max(last, there))
            value = abs(signed_distance(line, x, y))
            note(log, POINT_ADDED, EPSILON, candidate, direction, span, there, line, value, limits.epsilon)
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
    away = abs(signed_distance(line, points.x[there], points.y[there]))
    # Every jump to another surface is a void; what keeps its points out is ε.
    if check == NONE or (check == MAX_VOID and away >= limits.epsilon):
        check, value, limit = EPSILON, away, limits.epsilon
    note(log, GROWTH_STOPPED, check, candidate, direction, (first, last), there, line, value, limit)
