"""The line through the first and last point of a stretch, and the points farthest from it."""

from __future__ import annotations

import math

from ..kernel import kernel
from ..total_least_squares import signed_distance


@kernel
def chord(x, y, first, last):
    """The line (a, b, c), c ≤ 0, through the points first and last; perpendicular to the beam if they coincide."""
    ux, uy = x[last] - x[first], y[last] - y[first]
    norm = math.hypot(ux, uy)
    if norm == 0.0:
        ux, uy = -y[first], x[first]
        norm = math.hypot(ux, uy)
    a, b = -uy / norm, ux / norm
    c = -(a * x[first] + b * y[first])
    return (-a, -b, -c) if c > 0.0 else (a, b, c)


@kernel
def farthest(x, y, first, last, line):
    """(the point between first and last farthest from the line, its distance); (first, 0) if all lie on the line."""
    place, most = first, 0.0
    for k in range(first + 1, last):
        away = abs(signed_distance(line, x[k], y[k]))
        if away > most:
            place, most = k, away
    return place, most


@kernel
def step_to(x, y, k):
    """Distance from point k to point k − 1."""
    return math.hypot(x[k] - x[k - 1], y[k] - y[k - 1])


@kernel
def widest_step(x, y, first, last):
    """(the point after the widest gap between first and last, its width); (first, 0) for a single point."""
    place, widest = first, 0.0
    for k in range(first + 1, last + 1):
        gap = step_to(x, y, k)
        if gap > widest:
            place, widest = k, gap
    return place, widest
