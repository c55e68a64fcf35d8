"""Lines by total least squares (Eqs. 1, 2) from running moments; distance and projection of a point (Eqs. 1, 8)."""

from __future__ import annotations

import math
from typing import NamedTuple

from .kernel import inlined_kernel, kernel, summing_kernel


class Moments(NamedTuple):
    """Sums over points relative to a point of their own: far from the laser a line is fitted as well as near it."""

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


@kernel
def remove(m, x, y):
    """Moments with the point (x, y) taken out."""
    dx, dy = x - m.x0, y - m.y0
    return Moments(m.x0, m.y0, m.n - 1.0, m.sx - dx, m.sy - dy, m.sxx - dx * dx, m.sxy - dx * dy, m.syy - dy * dy)


@summing_kernel
def moments_of(x, y, first, last):
    """Moments of the points first..last, about the first of them."""
    x0, y0 = x[first], y[first]
    # Of a slice it is known that no index counts from its end: several points are then taken at a time.
    x, y = x[first : last + 1], y[first : last + 1]
    sx = sy = sxx = sxy = syy = 0.0
    for k in range(len(x)):
        # Not by `add`, which is compiled to sum in its order.
        dx, dy = x[k] - x0, y[k] - y0
        sx, sy = sx + dx, sy + dy
        sxx, sxy, syy = sxx + dx * dx, sxy + dx * dy, syy + dy * dy
    return Moments(x0, y0, float(len(x)), sx, sy, sxx, sxy, syy)


@inlined_kernel
def moments_of_few(x, y, first, last):
    """The same for so few points that adding them one by one is the fastest."""
    m = empty(x[first], y[first])
    for k in range(first, last + 1):
        m = add(m, x[k], y[k])
    return m


@kernel
def direction_of(m):
    """A vector, not of unit length, along the line that minimises Σ(a·xᵢ + b·yᵢ + c)² (Eq. 2).

    It is the eigenvector of the greater eigenvalue of the 2×2 scatter matrix, here n² times too large, in closed form.
    Of its two forms the one without cancellation is taken. Where all points coincide or scatter equally any direction
    fits, and the one across the beam is taken.
    """
    xx, xy, yy = m.n * m.sxx - m.sx * m.sx, m.n * m.sxy - m.sx * m.sy, m.n * m.syy - m.sy * m.sy
    half = 0.5 * (xx - yy)
    root = math.sqrt(half * half + xy * xy)
    if root == 0.0:
        return -(m.n * m.y0 + m.sy), m.n * m.x0 + m.sx
    if half >= 0.0:
        return half + root, xy
    return xy, root - half


@kernel
def line_of(m):
    """Unit normal (a, b) and offset c ≤ 0 of the line that minimises Σ(a·xᵢ + b·yᵢ + c)² (Eq. 2), from n ≥ 2 points."""
    ux, uy = direction_of(m)
    x, y = m.x0 + m.sx / m.n, m.y0 + m.sy / m.n
    norm = math.sqrt(ux * ux + uy * uy)
    a, b = -uy / norm, ux / norm
    c = -(a * x + b * y)
    if c > 0.0:
        return -a, -b, -c
    return a, b, c


@kernel
def is_nearer(m, x, y, limit):
    """Whether (x, y) lies nearer than `limit` to the line fitted to m (Eqs. 2, 3), without a division or a root.

    With p the point relative to the mean and φ the direction of the line, its distance d has
    2·d² = |p|² − (px² − py²)·cos 2φ − 2·px·py·sin 2φ, and (cos 2φ, sin 2φ) has the direction of (xx − yy, 2·xy) of the
    scatter matrix. Both sides are compared by their squares, with their signs. This is asked once for every point that
    a line takes.
    """
    px, py = m.n * (x - m.x0) - m.sx, m.n * (y - m.y0) - m.sy
    cosine = m.n * (m.sxx - m.syy) - (m.sx * m.sx - m.sy * m.sy)
    sine = 2.0 * (m.n * m.sxy - m.sx * m.sy)
    norm = cosine * cosine + sine * sine
    along = (px * px - py * py) * cosine + 2.0 * px * py * sine
    reach = limit * m.n
    beyond = px * px + py * py - 2.0 * reach * reach
    # Points that all coincide have no direction; what lies next to them joins.
    return along * abs(along) > norm * (beyond * abs(beyond)) or (norm == 0.0 and beyond < 0.0)


@kernel
def signed_distance(line, x, y):
    """Distance of (x, y) to a line with unit normal, positive on the far side of the laser (Eq. 1)."""
    a, b, c = line
    return a * x + b * y + c


@summing_kernel
def squares_of(x, y, first, last, line):
    """Sum of the squared distances of the points first..last to a line with unit normal (Eq. 2)."""
    # Of a slice it is known that no index counts from its end: several points are then taken at a time.
    x, y = x[first : last + 1], y[first : last + 1]
    total = 0.0
    for k in range(len(x)):
        total += signed_distance(line, x[k], y[k]) ** 2
    return total


@kernel
def project(line, x, y):
    """Foot of the perpendicular from (x, y) to a line with unit normal (Eqs. 7, 8)."""
    a, b, c = line
    d = a * x + b * y + c
    return x - d * a, y - d * b
