"""Seed-segment detection (Algorithm 1, Eqs. 3–6)."""

from __future__ import annotations

import math

from ..kernel import inlined_kernel, kernel
from ..log import note
from ..total_least_squares import add, at, direction_of, empty, line_of, moments_of_few, remove, signed_distance
from .log import DELTA, EPSILON, NONE, SEED_FOUND, SEED_REJECTED
from .points import breach

NOWHERE = (0.0, 0.0, 0.0)
# Moments that slide along with the window are summed anew after so many steps, before rounding adds up.
FRESH = 16


@inlined_kernel
def find_seed(points, start, stop, limits, candidate, log):
    """First position in start..stop − 1 at which a seed begins, or −1; and the moments of the seed.

    A seed is a window of exactly S_num consecutive points (the listing's j = i + S_num would be one more) in which each
    point, in turn, passes two checks: the distance to its predicted point P′ is at most δ, the distance to the line
    at most ε. `flag` of the listing starts anew for every window; printed, it is never set back.
    """
    x, y, breaks = points.x, points.y, points.breaks
    moments = empty(0.0, 0.0)
    for first in range(start, stop):
        last = first + limits.seed_points - 1
        if (first - start) % FRESH == 0:
            moments = moments_of_few(x, y, first, last)
        else:
            moments = add(remove(moments, at(x, first - 1), at(y, first - 1)), at(x, last), at(y, last))
        if at(breaks, first) == at(breaks, last) and is_seed(points, first, last, moments, limits):
            if log is not None:
                note(log, SEED_FOUND, NONE, candidate, 0, (first, last), -1, line_of(moments), 0.0, 0.0)
            return first, moments
        if log is not None:
            note_refusal(points, first, last, moments, limits, candidate, log)
    return -1, moments


@inlined_kernel
def is_seed(points, first, last, moments, limits):
    test = test_of(moments, limits)
    for k in range(first, last + 1):
        too_far, off_line = fails(at(points.x, k), at(points.y, k), test)
        if too_far or off_line:
            return False
    return True


@inlined_kernel
def test_of(m, limits):
    """What `fails` needs of a window: n, n times its direction u and their offset, and the two limits, squared."""
    ux, uy = direction_of(m)
    offset = ux * (m.sy + m.n * m.y0) - uy * (m.sx + m.n * m.x0)
    predicted = (limits.delta * m.n) ** 2
    near = (limits.epsilon * m.n) ** 2 * (ux * ux + uy * uy)
    return m.n, ux, uy, offset, predicted, near


@inlined_kernel
def fails(x, y, test):
    """Whether P = (x, y) lies farther than δ from P′ (Eqs. 4–6), and whether farther than ε from the line (Eq. 3).

    P and P′ lie on one beam, so their distance is |ρ − ρ′| = d / |cos of the angle of incidence|, and that
    cosine is |a·x + b·y| / ρ. Squared and multiplied out, neither check needs a root, a division or the bearing.
    """
    n, ux, uy, offset, predicted, near = test
    along = ux * y - uy * x
    d = n * along - offset
    square = d * d
    return square * (x * x + y * y) > predicted * along * along, square > near


@kernel
def note_refusal(points, first, last, moments, limits, candidate, log):
    """Find the first point of the window that fails, and by which check."""
    span = first, last
    for k in range(first + 1, last + 1):
        check, value, limit = breach(points, k - 1, k, limits)
        if check != NONE:
            note(log, SEED_REJECTED, check, candidate, 0, span, k, NOWHERE, value, limit)
            return
    line, test = line_of(moments), test_of(moments, limits)
    for k in range(first, last + 1):
        too_far, off_line = fails(points.x[k], points.y[k], test)
        if too_far:
            value = predicted_distance(points, k, line)
            note(log, SEED_REJECTED, DELTA, candidate, 0, span, k, line, value, limits.delta)
            return
        if off_line:
            value = abs(signed_distance(line, points.x[k], points.y[k]))
            note(log, SEED_REJECTED, EPSILON, candidate, 0, span, k, line, value, limits.epsilon)
            return


@kernel
def predicted_distance(points, k, line):
    """|ρ − ρ′| of Eqs. 4–6 [m]; infinite where the beam is parallel to the line."""
    a, b, _ = line
    x, y = points.x[k], points.y[k]
    along = abs(a * x + b * y)
    d = abs(signed_distance(line, x, y))
    return d * math.hypot(x, y) / along if along > 0.0 else math.inf
