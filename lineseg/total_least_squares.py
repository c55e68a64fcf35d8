"""Lines by total least squares (Eqs. 1, 2) from running moments; distance and projection of a point (Eqs. 1, 8)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .kernel import fma, inlined_kernel, kernel, summing_kernel


@kernel
def at(values, k):
    """values[k] for k ≥ 0: skips numba's check for negative indices, which is slow in short loops."""
    return values[np.uintp(k)]


class Moments(NamedTuple):
    """Sums over points relative to a nearby origin, so that a fit is as accurate far from the laser as near it."""

    x0: float
    y0: float
    n: float
    sx: float
    sy: float
    sxx: float
    sxy: float
    syy: float


@kernel
def empty(x0, y0):
    """Moments of no points, about (x0, y0)."""
    return Moments(x0, y0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def add(m, x, y):
    """Moments with the point (x, y) added."""
    dx, dy = x - m.x0, y - m.y0
    return Moments(m.x0, m.y0, m.n + 1.0, m.sx + dx, m.sy + dy, m.sxx + dx * dx, m.sxy + dx * dy, m.syy + dy * dy)


@summing_kernel
def moments_of(x, y, first, last):
    """Moments of the points first..last, about the first of them."""
    x0, y0 = x[first], y[first]
    # In a slice no index can be negative, so the compiler can process several points at a time.
    x, y = x[first : last + 1], y[first : last + 1]
    sx = sy = sxx = sxy = syy = 0.0
    for k in range(len(x)):
        # Not with `add`, which is compiled to sum in a fixed order.
        dx, dy = x[k] - x0, y[k] - y0
        sx, sy = sx + dx, sy + dy
        sxx, sxy, syy = sxx + dx * dx, sxy + dx * dy, syy + dy * dy
    return Moments(x0, y0, float(len(x)), sx, sy, sxx, sxy, syy)


@kernel
def halved(cosine, sine, x, y):
    """A vector with half the angle of (cosine, sine), in the one of its two forms that avoids cancellation.

    If all points coincide or scatter equally, both are 0 and any direction fits: then it is the one across the beam to
    (x, y).
    """
    if cosine == 0.0 and sine == 0.0:
        return -y, x
    root = math.sqrt(cosine * cosine + sine * sine)
    if cosine >= 0.0:
        return cosine + root, sine
    return sine, root - cosine


@kernel
def least_squares_of(m):
    """Σ(a·xᵢ + b·yᵢ + c)² of the line that minimises it (Eq. 2): the smaller eigenvalue of the scatter matrix."""
    s = scatter_of(m)
    spread = m.sxx + m.syy - (m.sx * m.sx + m.sy * m.sy) / m.n
    return max(0.5 * (spread - math.sqrt(s.cosine * s.cosine + s.sine * s.sine)), 0.0)


@kernel
def line_of(m):
    """Unit normal (a, b) and offset c ≤ 0 of the line that minimises Σ(a·xᵢ + b·yᵢ + c)² (Eq. 2), from n ≥ 2 points."""
    return line_through(scatter_of(m))


class Scatter(NamedTuple):
    """What a growing line needs to know of its n points: their mean and their scatter about it.

    cosine, sine: Σ(dx² − dy²) and 2·Σdx·dy, with dx and dy the distances of a point from the mean. As a vector they
    have twice the angle of the fitted line.
    """

    x: float
    y: float
    n: int
    cosine: float
    sine: float


NO_SCATTER = Scatter(0.0, 0.0, 0, 0.0, 0.0)


@kernel
def scatter_of(m):
    """The scatter of n ≥ 1 points with known moments."""
    return about_mean(m.x0, m.y0, int(m.n), 1.0 / m.n, m.sx, m.sy, m.sxx - m.syy, m.sxy)


@kernel
def about_mean(x0, y0, n, share, sx, sy, difference, product):
    """The scatter from sums over n points, relative to (x0, y0), of dx, dy, dx² − dy² and dx·dy; share: 1/n."""
    cosine, sine = difference - (sx * sx - sy * sy) * share, 2.0 * (product - sx * sy * share)
    return Scatter(x0 + sx * share, y0 + sy * share, n, cosine, sine)


# Needed for every point added to a line; a division would take longer than everything else.
RECIPROCALS = 1.0 / np.maximum(np.arange(4096), 1)


@kernel
def reciprocal(n):
    """1/n, n ≥ 1."""
    return at(RECIPROCALS, n) if n < len(RECIPROCALS) else 1.0 / n


@inlined_kernel
def scatter_of_few(x, y, first, last):
    """The scatter of the points first..last, for so few points that adding them one by one is fastest."""
    x0, y0 = at(x, first), at(y, first)
    sx = sy = difference = product = 0.0
    for k in range(first + 1, last + 1):
        dx, dy = at(x, k) - x0, at(y, k) - y0
        sx, sy = sx + dx, sy + dy
        difference, product = difference + (dx * dx - dy * dy), product + dx * dy
    n = last - first + 1
    return about_mean(x0, y0, n, reciprocal(n), sx, sy, difference, product)


@kernel
def with_point(s, x, y):
    """The scatter with the point (x, y) added (Welford)."""
    px, py = x - s.x, y - s.y
    share = reciprocal(s.n + 1)
    weight = 1.0 - share
    cosine, sine = fma(weight, px * px - py * py, s.cosine), fma(weight, 2.0 * (px * py), s.sine)
    return Scatter(fma(px, share, s.x), fma(py, share, s.y), s.n + 1, cosine, sine)


@kernel
def line_through(s):
    """`line_of` of the points with this scatter: along the eigenvector of the greater eigenvalue of its 2×2 matrix."""
    ux, uy = halved(s.cosine, s.sine, s.x, s.y)
    norm = math.sqrt(ux * ux + uy * uy)
    a, b = -uy / norm, ux / norm
    c = -(a * s.x + b * s.y)
    if c > 0.0:
        return -a, -b, -c
    return a, b, c


@kernel
def is_nearer(s, x, y, square):
    """Whether the squared distance of (x, y) from the line fitted to n points (Eqs. 2, 3) is less than `square`.

    Needs no division and no root. With p the point relative to the mean and φ the direction of the line, its distance
    d has 2·d² = |p|² − (px² − py²)·cos 2φ − 2·px·py·sin 2φ. Both sides are compared by their squares, with their signs.
    This runs once for every point added to a line.
    """
    px, py = x - s.x, y - s.y
    norm = fma(s.cosine, s.cosine, s.sine * s.sine)
    along = fma(px * px - py * py, s.cosine, 2.0 * (px * py) * s.sine)
    beyond = px * px + py * py - 2.0 * square
    # Coinciding points have no direction; a point close to them joins.
    return along * abs(along) > norm * (beyond * abs(beyond)) or (norm == 0.0 and beyond < 0.0)


@kernel
def signed_distance(line, x, y):
    """Distance of (x, y) to a line with unit normal, positive on the far side of the laser (Eq. 1)."""
    a, b, c = line
    return a * x + b * y + c


@kernel
def squared_distance(line, x, y):
    """The squared distance. Not with `** 2`, which numba compiles only once, with the options of its first caller."""
    d = signed_distance(line, x, y)
    return d * d


@summing_kernel
def squares_of(x, y, first, last, line):
    """Sum of the squared distances of the points first..last to a line with unit normal (Eq. 2)."""
    # In a slice no index can be negative, so the compiler can process several points at a time.
    x, y = x[first : last + 1], y[first : last + 1]
    total = 0.0
    for k in range(len(x)):
        total += squared_distance(line, x[k], y[k])
    return total


@kernel
def project(line, x, y):
    """Foot of the perpendicular from (x, y) to a line with unit normal (Eqs. 7, 8)."""
    a, b, c = line
    d = a * x + b * y + c
    return x - d * a, y - d * b


@kernel
def distance(x1, y1, x2, y2):
    """Distance of two points."""
    return ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5
