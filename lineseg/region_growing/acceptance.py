"""The test for keeping a line: at least P_min points and a length of at least L_min."""

from __future__ import annotations

from ..kernel import inlined_kernel, kernel
from ..total_least_squares import distance, project
from .checks import MIN_LENGTH, MIN_POINTS, NONE


@inlined_kernel
def shortfall(points, first, last, line, limits):
    """(check, value, limit) of the requirement that a line fails, P_min first; check NONE if it meets both."""
    n = last - first + 1
    if n < limits.min_points or n < 2:
        return MIN_POINTS, float(n), float(limits.min_points)
    length = length_of(points.x, points.y, first, last, line)
    # Not `<`: the length is NaN for points too close together to have a direction.
    if not length >= limits.min_length:
        return MIN_LENGTH, length, limits.min_length
    return NONE, length, limits.min_length


@kernel
def length_of(x, y, first, last, line):
    """L_l: the distance between the two endpoints, projected onto the line [m]."""
    x1, y1 = project(line, x[first], y[first])
    x2, y2 = project(line, x[last], y[last])
    return distance(x1, y1, x2, y2)
