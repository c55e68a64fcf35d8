"""Seed-segment detection (Algorithm 1, Eqs. 3–6)."""

from __future__ import annotations

import math

from ..kernel import inlined_kernel, kernel
from ..total_least_squares import NO_SCATTER, at, halved, line_through, scatter_of_few, signed_distance
from ..tracing.log import note
from .checks import DELTA, EPSILON, NONE, SEED_FOUND, SEED_REJECTED
from .limits import near
from .points import MAX_VOID, are_parted, breach
from .prediction import predicted_distance

NOWHERE = (0.0, 0.0, 0.0)


@inlined_kernel
def find_seed(points, start, stop, limits, candidate, log):
    """First position in start..stop − 1 where a seed begins, or −1; and the scatter of the seed.

    A seed is a window of exactly S_num consecutive points (the listing's j = i + S_num is one too many) in which each
    point passes two checks: the distance to its predicted point P′ is at most δ, and the distance to the line is at
    most ε. `flag` is reset for every window; the printed listing never resets it.
    """
    scatter = NO_SCATTER
    first = start
    while first < stop:
        last = first + limits.seed_points - 1
        scatter = scatter_of_few(points.x, points.y, first, last)
        if is_seed(points, first, last, scatter, limits) and is_whole(points, first, last, limits):
            if log is not None:
                note(log, SEED_FOUND, NONE, candidate, 0, (first, last), -1, line_through(scatter), 0.0, 0.0)
            return first, scatter
        if log is not None:
            note_refusal(points, first, last, scatter, limits, candidate, log)
            first += 1
        else:
            first = next_window(points, first, last, limits)
    return -1, scatter


@inlined_kernel
def next_window(points, first, last, limits):
    """Where to look next after a failed window, skipping windows that cross an edge."""
    for k in range(min(last, len(points.x) - 2), first + 1, -1):
        if is_edge(points, k, limits):
            return k
    return first + 1


@inlined_kernel
def is_edge(points, k, limits):
    """Whether no seed can contain the points A, B, C at positions k − 1, k, k + 1, whatever its line.

    Let r be ρ/ρ′ of a point, so that the line passes through A/r_A, B/r_B and C/r_C; with [PQ] the cross product of two
    points then r_C·[AB] + r_A·[BC] = r_B·[AC]. In a seed each ρ′ is within δ of its ρ, and no r differs from 1 by more
    than δ/(ρ − δ). So |[AB] + [BC] − [AC]|, which is twice the area of ABC, is at most
    δ/(ρ − δ)·(|[AB]| + |[BC]| + |[AC]|), with ρ the least of the three.
    """
    xa, ya = at(points.x, k - 1), at(points.y, k - 1)
    xb, yb = at(points.x, k), at(points.y, k)
    xc, yc = at(points.x, k + 1), at(points.y, k + 1)
    ab, bc, ac = xa * yb - ya * xb, xb * yc - yb * xc, xa * yc - ya * xc
    a, b, c = xa * xa + ya * ya, xb * xb + yb * yb, xc * xc + yc * yc
    # Of points on one beam the products are no more than what rounding leaves.
    twice = abs(ab + bc - ac)
    most, least = limits.delta * (abs(ab) + abs(bc) + abs(ac) + twice), twice - 1e-14 * max(a, b, c)
    # Squared, which spares the root of ρ².
    return least > 0.0 and least * least * min(a, b, c) > most * most


@kernel
def is_whole(points, first, last, limits):
    """Whether a line may cross every step from point `first` to point `last`."""
    whole = True
    for k in range(first + 1, last + 1):
        whole &= not are_parted(points, k, limits)
    return whole


@inlined_kernel
def is_seed(points, first, last, scatter, limits):
    test = test_of(scatter, limits)
    failed = False
    for k in range(first, last + 1):
        too_far, off_line = fails(at(points.x, k), at(points.y, k), test)
        failed |= too_far | off_line
    return not failed


@inlined_kernel
def test_of(scatter, limits):
    """The input of `fails` for a window: u along its line, u × any point of the line, and the limits, squared."""
    ux, uy = halved(scatter.cosine, scatter.sine, scatter.x, scatter.y)
    norm, offset = ux * ux + uy * uy, ux * scatter.y - uy * scatter.x
    return ux, uy, offset, limits.delta**2, limits.epsilon**2 * norm, limits.epsilon_growth**2 * norm


@inlined_kernel
def fails(x, y, test):
    """Whether P = (x, y) lies farther than δ from P′ (Eqs. 4–6), and whether farther than ε from the line (Eq. 3).

    P and P′ lie on one beam, so their distance is |ρ − ρ′| = d / |cos of the angle of incidence|, and that
    cosine is |a·x + b·y| / ρ. Squared and multiplied out, neither check needs a root, a division or the bearing.
    """
    ux, uy, offset, predicted, constant, growing = test
    along = ux * y - uy * x
    d = along - offset
    square, beam = d * d, x * x + y * y
    return square * beam > predicted * along * along, square > constant + growing * beam


@kernel
def note_refusal(points, first, last, scatter, limits, candidate, log):
    """Find the first point of the window that fails, and the check that it fails.

    A void is told only if nothing else is wrong: every jump to another surface is one.
    """
    span = first, last
    void, width = -1, 0.0
    for k in range(first + 1, last + 1):
        check, value, limit = breach(points, k - 1, k, limits)
        if check == MAX_VOID and void < 0:
            void, width = k, value
        elif check != NONE and check != MAX_VOID:
            note(log, SEED_REJECTED, check, candidate, 0, span, k, NOWHERE, value, limit)
            return
    line, test = line_through(scatter), test_of(scatter, limits)
    for k in range(first, last + 1):
        too_far, off_line = fails(points.x[k], points.y[k], test)
        if too_far:
            value = predicted_distance(points.x[k], points.y[k], line)
            note(log, SEED_REJECTED, DELTA, candidate, 0, span, k, line, value, limits.delta)
            return
        if off_line:
            x, y = points.x[k], points.y[k]
            value, limit = abs(signed_distance(line, x, y)), math.sqrt(near(limits, x * x + y * y))
            note(log, SEED_REJECTED, EPSILON, candidate, 0, span, k, line, value, limit)
            return
    note(log, SEED_REJECTED, MAX_VOID, candidate, 0, span, void, line, width, limits.max_void)
