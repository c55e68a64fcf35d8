"""Removes small objects in front of a wall, such as chair legs, so that a line passes behind them (an extension)."""

from __future__ import annotations

import numpy as np

from ..kernel import kernel
from ..total_least_squares import at
from .limits import near

# Points that are asked together whether a step is among them.
AT_ONCE = 32


@kernel
def look_past(x, y, rho, beam, passed, steps, n, limits):
    """Remove the points of small objects in front of a wall, in place; returns the number of points left.

    An object is a run of points that all lie more than δ, and more than 2 ε at their range, in front of where their
    beams meet the chord between the two points next to the run (as in Eqs. 4–6). These two points must be at most
    `max_occluder` apart, and the run too small for a line, see `is_large`; it may be the legs of several chairs, one
    behind the other.
    x, y, rho, beam: (n,) of the points in scan order; rho is not changed. passed: (n,) int32, set to 1 if an object
    was removed before the point, else to 0; steps: (n,) int32, memory.
    """
    passed[:n] = 0
    # A δ below the noise must not turn noise into objects.
    ahead = max(limits.delta, 2.0 * limits.epsilon)
    steps = steps[: find_steps(rho[:n], steps, ahead)]
    left = behind = rise = 0
    for fall in range(len(steps)):
        k = steps[fall] - 1
        if k < behind or rho[k + 1] > rho[k]:
            continue
        # On a wall seen at a grazing angle many falls in a row wait for the same rise.
        while rise < len(steps) and (rise <= fall or rho[steps[rise]] < rho[steps[rise] - 1]):
            rise += 1
        j = behind_thing(x, y, rho, steps[rise:], k, limits)
        if j > k:
            left = close_up(x, y, beam, behind, k + 1, left)
            passed[left], behind = 1, j
    return close_up(x, y, beam, behind, n, left)


@kernel
def find_steps(rho, steps, ahead):
    """Store the points that lie more than `ahead` nearer or farther than the previous one; returns their number."""
    count = np.uintp(0)
    for first in range(0, len(rho) - 1, AT_ONCE):
        last = min(first + AT_ONCE, len(rho) - 1)
        before, here = rho[first:last], rho[first + 1 : last + 1]
        # Most runs have no step, and several points at a time can be asked.
        some = 0
        for k in range(len(here)):
            some += is_step(before[k], here[k], ahead)
        if some == 0:
            continue
        for k in range(len(here)):
            # Always written, and kept only if it is a step: a branch would be mispredicted at most steps.
            steps[count] = first + k + 1
            count += np.uintp(is_step(before[k], here[k], ahead))
    return count


@kernel
def is_step(before, here, ahead):
    return (here < before - ahead) | (here > before + ahead)


@kernel
def close_up(x, y, beam, start, stop, to):
    """Move the points start..stop − 1 to `to`; returns the position after them."""
    if to < start:
        source, target = np.uintp(start), np.uintp(to)
        for k in range(np.uintp(stop - start)):
            x[target + k], y[target + k] = x[source + k], y[source + k]
            beam[target + k] = beam[source + k]
    return to + stop - start


@kernel
def behind_thing(x, y, rho, steps, k, limits):
    """The last point that may be the first after an object, which begins with point k + 1; −1 if none is one.

    Of several, all but the last are mixed pixels at the edge of the object. steps: from the first rise after k on.
    """
    widest, behind = limits.max_occluder, -1
    for j in steps:
        if rho[j] > rho[j - 1]:
            # From here on every beam passes point k at more than `max_occluder`.
            if at(x, k) * at(y, j) - at(y, k) * at(x, j) > widest * at(rho, j):
                break
            if square(x, y, k, j) <= widest * widest and is_thing(x, y, rho, k, j, limits):
                behind = j
    return behind


@kernel
def is_large(x, y, k, j, i, limits):
    """Whether the run between points k and j is large enough for a line, as seen from its beginning to point i.

    It has at least P_min points then, and is wider than `max_occluder` and L_min, without mixed pixels at its edges.
    """
    widest = max(limits.max_occluder, limits.min_length)
    return j - k > limits.min_points and k + 2 < i < j - 1 and square(x, y, k + 2, i) > widest * widest


@kernel
def square(x, y, i, j):
    """Squared distance between two points, i, j ≥ 0."""
    return (at(x, j) - at(x, i)) ** 2 + (at(y, j) - at(y, i)) ** 2


@kernel
def is_thing(x, y, rho, k, j, limits):
    """Whether every point between k and j lies far in front of the chord from k to j, along its beam.

    Together they must also be too small for a line.
    """
    dx, dy = x[j] - x[k], y[j] - y[k]
    offset = dx * y[k] - dy * x[k]
    for i in range(k + 1, j):
        along = dx * y[i] - dy * x[i]
        # ρ′ = ρ · offset / along
        ahead = rho[i] * (offset / along - 1.0)
        if not (ahead > limits.delta and ahead * ahead > 4.0 * near(limits, rho[i] * rho[i])):
            return False
        if is_large(x, y, k, j, i, limits):
            return False
    return True
