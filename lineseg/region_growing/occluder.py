"""Thin things in front of a wall, such as the leg of a chair, that a line passes behind (an extension)."""

from __future__ import annotations

from ..kernel import kernel


@kernel
def look_past(x, y, ranges, beam, passed, n, limits):
    """Take away the points of thin things in front of a wall, in place: the number of points that are left.

    A thing is a run of points that all lie more than δ, and 2 ε, in front of where their beams meet the chord between
    the points beside the run (as in Eqs. 4–6), if these are at most `max_occluder` apart, and so are the outermost
    points of the run; mixed pixels at its edges do not count for the latter.
    x, y, beam: (n,) of the points in scan order; ranges: of all beams. passed: (n,) int32, set to 1 where a thing stood
    before a point, else to 0.
    """
    passed[:n] = 0
    left = k = 0
    # A δ below the noise must not make things of it.
    ahead = max(limits.delta, 2.0 * limits.epsilon)
    while k < n:
        if left != k:
            x[left], y[left], beam[left] = x[k], y[k], beam[k]
        left += 1
        k += 1
        if k + 1 < n and range_at(ranges, beam, k) < range_at(ranges, beam, k - 1) - ahead:
            beyond = behind_thing(x, y, ranges, beam, k - 1, n, ahead, limits.max_occluder)
            if beyond != k:
                passed[left], k = 1, beyond
    return left


@kernel
def range_at(ranges, beam, k):
    """ρ of point k; on a full circle beams may go on counting past the seam."""
    # Not by a remainder: it would take longer than all else that is asked of most points.
    return ranges[beam[k] if beam[k] < len(ranges) else beam[k] - len(ranges)]


@kernel
def behind_thing(x, y, ranges, beam, k, n, ahead, widest):
    """The first point behind a thing that begins with point k + 1, or k + 1 where none does."""
    for j in range(k + 2, n):
        if j - 2 > k + 2 and square(x, y, k + 2, j - 2) > widest * widest:
            return k + 1
        stands_out = range_at(ranges, beam, j) > range_at(ranges, beam, j - 1) + ahead
        if stands_out and square(x, y, k, j) <= widest * widest and in_front(x, y, ranges, beam, k, j, ahead):
            return j
    return k + 1


@kernel
def square(x, y, i, j):
    """Squared distance of two points."""
    return (x[j] - x[i]) ** 2 + (y[j] - y[i]) ** 2


@kernel
def in_front(x, y, ranges, beam, k, j, ahead):
    """Whether every point between k and j lies more than `ahead` before the chord between these two, along its beam."""
    dx, dy = x[j] - x[k], y[j] - y[k]
    offset = dx * y[k] - dy * x[k]
    for i in range(k + 1, j):
        along = dx * y[i] - dy * x[i]
        # ρ′ = ρ · offset / along
        if not range_at(ranges, beam, i) * (offset / along - 1.0) > ahead:
            return False
    return True
