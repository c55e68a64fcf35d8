"""The input of the procedures: the valid points of a scan, in order, and the breaks that no line may cross."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel
from ..total_least_squares import at
from .checks import NONE, number_of
from .limits import near
from .occluder import look_past, square

MAX_DROPOUT, MAX_GAP, MAX_VOID = number_of("max_dropout"), number_of("max_gap"), number_of("max_void")

# On a wall seen at a grazing angle each gap between its points is at most 3 times as wide as the gap before. A gap
# between neighbouring beams is a void if it is more than this many times as wide as the gaps next to it on its line.
TIMES = 4.0
BREAK, WIDE = 1, 2


class Points(NamedTuple):
    """The valid points in scan order. Kernels count in positions; `beam` maps these to beams.

    A full circle has no first beam. It is opened at its widest gap and stored four times in a row with rising beam
    numbers, so that a line may cross the seam in both directions. Beams missing at the seam are counted.

    x, y: (m,) [m]; beam: (m,) int32, rising; start: the position of the first point; period: number of points.
    breaks: (m,) int32, of the step to each point: BREAK if no seed or line may cross it, WIDE if it may be a void, 0 if
    neither, see `are_parted`. around: see `Scan.around`. returns: number of valid beams, including those on
    ignored objects.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    beam: NDArray[np.int32]
    breaks: NDArray[np.int32]
    start: int
    period: int
    around: int
    returns: int


@kernel
def points_of(ranges, rays, range_min, range_max, around, limits, xy, numbers):
    """Points from ranges (n,) [m] and unit vectors along the beams (2, n); `Scan` defines which are valid.

    Leaves out the points of ignored objects, see `look_past`.
    xy (6, capacity) float64 and numbers (6, capacity) int32 are memory for them, with at least n + 1 places; on a full
    circle with 4·n + 1.
    """
    circle = around > 0
    x, y, rho, beam, breaks = xy[0], xy[1], xy[2], numbers[0], numbers[1]
    if circle:
        x, y, rho, beam = xy[3], xy[4], xy[5], numbers[2]
    if is_complete(ranges, range_min, range_max):
        n = take_all(ranges, rays, x, y, rho, beam)
    else:
        n = take_valid(ranges, rays, range_min, range_max, x, y, rho, beam)
    returns = n
    looking = limits.max_occluder > 0.0 and n > 2
    if looking and circle:
        n = look_past_all_round(x, y, rho, beam, n, around, xy, numbers[0], numbers[4], numbers[5], limits)
    elif looking:
        n = look_past(x, y, rho, beam, breaks, numbers[5], n, limits)
    if circle:
        lay_round(x, y, beam, numbers[4], n, around, xy, numbers[0], breaks, looking, limits)
    else:
        find_breaks(xy[0], xy[1], numbers[0], breaks, n, looking, limits)
    return stored_points(xy, numbers, n, around, returns)


@kernel
def stored_points(xy, numbers, n, around, returns):
    """The n points that `points_of` has stored in this memory."""
    start, m = (n, 4 * n) if around > 0 else (0, n)
    return Points(xy[0, :m], xy[1, :m], numbers[0, :m], numbers[1, :m], start, n, around, returns)


@kernel
def is_valid(r, range_min, range_max):
    """Whether a beam has a return, as defined by `Scan`."""
    return (r > 0.0) & (r >= range_min) & (r < range_max)


@kernel
def is_complete(ranges, range_min, range_max):
    """Whether every beam is valid."""
    invalid = 0
    for k in range(len(ranges)):
        invalid += not is_valid(ranges[k], range_min, range_max)
    return invalid == 0


@kernel
def take_all(ranges, rays, x, y, rho, beam):
    """Compute the points of all beams, several at a time; returns their number."""
    for k in range(len(ranges)):
        r = ranges[k]
        x[k], y[k], rho[k], beam[k] = r * rays[0, k], r * rays[1, k], r, k
    return len(ranges)


@kernel
def take_valid(ranges, rays, range_min, range_max, x, y, rho, beam):
    """Compute the points of the valid beams, one by one; returns their number."""
    n = 0
    for k in range(len(ranges)):
        r = ranges[k]
        # Always written, and kept only if valid: a branch here would be mispredicted at every dropout.
        x[n], y[n], rho[n], beam[n] = r * rays[0, k], r * rays[1, k], r, k
        n += is_valid(r, range_min, range_max)
    return n


@kernel
def look_past_all_round(x, y, rho, beam, n, around, to, to_beam, passed, steps, limits):
    """`look_past` on a full circle, starting at the farthest point, which cannot be on an object."""
    farthest, most = 0, 0.0
    for k in range(n):
        if rho[k] > most:
            farthest, most = k, rho[k]
    for values, target in ((x, to[0]), (y, to[1]), (rho, to[2])):
        turn(values, n, farthest, 0, target)
        target[n] = target[0]
    turn(beam, n, farthest, around, to_beam)
    to_beam[n] = to_beam[0] + around
    left = look_past(to[0], to[1], to[2], to_beam, passed, steps, n + 1, limits) - 1
    passed[0] = passed[left]
    for values, target in ((to[0], x), (to[1], y)):
        shifted(values[:left], 0, target)
    shifted(to_beam[:left], 0, beam)
    return left


@kernel
def lay_round(x, y, beam, passed, n, around, to, to_beam, breaks, looked, limits):
    """Open a full circle of n points at its widest gap, and store it four times."""
    opening, widest = 0, -1.0
    for k in range(1, n):
        gap = square(x, y, k - 1, k)
        if gap > widest:
            opening, widest = k, gap
    if n > 0 and square(x, y, n - 1, 0) > widest:
        opening = 0
    for values, target in ((x, to[0]), (y, to[1])):
        turn(values, n, opening, 0, target)
        repeat(target, n, 0)
    turn(beam, n, opening, around, to_beam)
    # Whatever the rotation so far, the first beam belongs to the first turn.
    past = to_beam[0] // around * around
    for k in range(n):
        to_beam[k] -= past
    repeat(to_beam, n, around)
    turn(passed, n, opening, 0, breaks)
    breaks[n] = breaks[0]
    find_breaks(to[0], to[1], to_beam, breaks, min(n + 1, 4 * n), looked, limits)
    breaks[0] = breaks[n]
    repeat(breaks, n, 0)


@kernel
def turn(values, n, start, shift, to):
    """Store n values of a full circle from `start` on; past the seam they are greater by `shift`."""
    shifted(values[start:n], 0, to[: n - start])
    shifted(values[:start], shift, to[n - start : n])


@kernel
def repeat(values, n, shift):
    """Store n values three more times, each time greater by `shift`."""
    for lap in range(1, 4):
        shifted(values[:n], lap * shift, values[lap * n : (lap + 1) * n])


@kernel
def shifted(values, shift, to):
    """Uses slices, whose indices are known not to count from the end, so the compiler can vectorise the copy."""
    for k in range(len(values)):
        to[k] = values[k] + shift


@kernel
def find_breaks(x, y, beam, breaks, n, looked, limits):
    """Mark the steps with more than max_dropout beams without a return or a gap wider than max_gap, and the wide ones.

    looked: whether `look_past` ran before: at its 1s, the missing beams belong to an object and are neither a dropout
    nor a void.
    """
    widest = limits.max_gap * limits.max_gap
    void = limits.max_void * limits.max_void if limits.max_void > 0.0 else math.inf
    breaks[0] = 0
    for k in range(1, n):
        gap, lost = square(x, y, k - 1, k), at(beam, k) - at(beam, k - 1) - 1
        seen = (breaks[k] == 0) | (not looked)
        breaks[k] = (BREAK * ((seen & (lost > limits.max_dropout)) | (gap > widest))) | (WIDE * (seen & (gap > void)))


@kernel
def are_parted(points, k, limits):
    """Whether no seed or line may cross the step from point k − 1 to point k."""
    return points.breaks[k] != 0 and (points.breaks[k] != WIDE or is_void(points, k, limits))


@kernel
def is_void(points, k, limits):
    """Whether the wide gap before point k is a void: other beams lie between, or no gap next to it continues it.

    A jump to another surface is one, too.
    """
    x, y, beam = points.x, points.y, points.beam
    if at(beam, k) - at(beam, k - 1) > 1:
        return True
    if k > 1 and continues(x, y, k, k - 1, k - 2, limits):
        return False
    return k == len(x) - 1 or not continues(x, y, k - 1, k, k + 1, limits)


@kernel
def continues(x, y, i, j, k, limits):
    """Whether the gap from point j to k continues that from i to j: nearly straight on, and not TIMES narrower."""
    xa, ya, xb, yb = at(x, j) - at(x, i), at(y, j) - at(y, i), at(x, k) - at(x, j), at(y, k) - at(y, j)
    a, b, away = xa * xa + ya * ya, xb * xb + yb * yb, xa * yb - ya * xb
    # If all three are within ε of one line, k lies at most 2·ε·(1 + |jk|/|ij|) from the line ij. To spare the roots,
    # (p + q)² ≤ 2·(p² + q²).
    near_line = 8.0 * near(limits, at(x, j) * at(x, j) + at(y, j) * at(y, j)) * (a + b)
    return TIMES * TIMES * b >= a and away * away <= near_line


@kernel
def breach(points, k, neighbour, limits):
    """(check, value, limit) of the extension that forbids the step from point k to its neighbour, else check NONE."""
    if not are_parted(points, max(k, neighbour), limits):
        return NONE, 0.0, 0.0
    dropout, gap = abs(points.beam[neighbour] - points.beam[k]) - 1, math.sqrt(square(points.x, points.y, k, neighbour))
    # Behind an ignored object, only a gap makes a break.
    if dropout > limits.max_dropout and not (limits.max_occluder > 0.0 and gap > limits.max_gap):
        return MAX_DROPOUT, float(dropout), float(limits.max_dropout)
    if gap > limits.max_gap:
        return MAX_GAP, gap, limits.max_gap
    return MAX_VOID, gap, limits.max_void
