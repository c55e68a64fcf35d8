"""Weighted fit of a line in polar form, using the noise of each beam, with its covariance.

Pfister, Roumeliotis, Burdick: *Weighted line fitting algorithms for mobile robot map building and efficient data
representation*, ICRA 2003.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..kernel import kernel

MOST_ITERATIONS = 100


class Polar(NamedTuple):
    """x·cos α + y·sin α = R, and the covariance of (R, α)."""

    radius: float
    angle: float
    rr: float
    ra: float
    aa: float


class Fitting(NamedTuple):
    """Variances of a range [m²] and a bearing [rad²], and the changes of R and α below which the iteration ends."""

    range_variance: float
    bearing_variance: float
    radius_step: float
    angle_step: float


@kernel
def fit_weighted(r, cosines, sines, first, last, line, how):
    """The line through the points first..last that minimises Σ dₖ²/Pₖ, dₖ = rₖ·cos(α − φₖ) − R; starts from `line`.

    Pₖ is the variance of dₖ: σ_r²·cos² + σ_φ²·r²·sin². Each iteration sets R to the weighted mean at α, then moves α
    by a step of Newton's method.
    """
    radius, angle = -line[2], math.atan2(line[1], line[0])
    former_radius = former_angle = 0.0
    for _ in range(MOST_ITERATIONS):
        if abs(radius - former_radius) <= how.radius_step and abs(angle - former_angle) <= how.angle_step:
            break
        former_radius, former_angle = radius, angle
        radius, _ = mean_radius(r, cosines, sines, first, last, angle, how)
        slope, bend, _, _ = derivatives(r, cosines, sines, first, last, radius, angle, how)
        angle -= slope / bend
    _, weight = mean_radius(r, cosines, sines, first, last, angle, how)
    _, bend, lean, spread = derivatives(r, cosines, sines, first, last, radius, angle, how)
    return Polar(radius, angle, 1.0 / weight, lean / (weight * bend), spread / (bend * bend))


@kernel
def mean_radius(r, cosines, sines, first, last, angle, how):
    """(R, Σ 1/Pₖ): the weighted mean of rₖ·cos(α − φₖ)."""
    ca, sa = math.cos(angle), math.sin(angle)
    total = weight = 0.0
    for k in range(first, last + 1):
        along, across = ca * cosines[k] + sa * sines[k], sa * cosines[k] - ca * sines[k]
        w = 1.0 / (how.range_variance * along * along + how.bearing_variance * (r[k] * across) ** 2)
        total += w * r[k] * along
        weight += w
    return total / weight, weight


@kernel
def derivatives(r, cosines, sines, first, last, radius, angle, how):
    """(first, second derivative of Σ dₖ²/Pₖ by α; Σ 2·rₖ·sin/Pₖ; Σ 4·rₖ²·sin²/Pₖ), sin of α − φₖ."""
    ca, sa = math.cos(angle), math.sin(angle)
    slope = bend = lean = spread = 0.0
    for k in range(first, last + 1):
        along, across = ca * cosines[k] + sa * sines[k], sa * cosines[k] - ca * sines[k]
        u, v = r[k] * along, r[k] * across
        d = u - radius
        a, a1, a2 = d * d, -2.0 * d * v, 2.0 * v * v - 2.0 * d * u
        excess = how.bearing_variance * r[k] * r[k] - how.range_variance
        b = how.range_variance * along * along + how.bearing_variance * v * v
        b1, b2 = 2.0 * excess * along * across, 2.0 * excess * (along * along - across * across)
        turn = a1 * b - a * b1
        slope += turn / (b * b)
        bend += ((a2 * b - a * b2) * b - 2.0 * turn * b1) / (b * b * b)
        lean += 2.0 * v / b
        spread += 4.0 * v * v / b
    return slope, bend, lean, spread


@kernel
def chi_squared(one, other):
    """(L₁ − L₂)ᵀ (P₁ + P₂)⁻¹ (L₁ − L₂) of two lines in polar form."""
    dr, da = one.radius - other.radius, one.angle - other.angle
    rr, ra, aa = one.rr + other.rr, one.ra + other.ra, one.aa + other.aa
    return (aa * dr * dr - 2.0 * ra * dr * da + rr * da * da) / (rr * aa - ra * ra)


@kernel
def combined(one, other):
    """The mean of two lines, each weighted by the inverse of its covariance."""
    det, det2 = one.rr * one.aa - one.ra**2, other.rr * other.aa - other.ra**2
    p, q, s = one.aa / det, -one.ra / det, one.rr / det
    p2, q2, s2 = other.aa / det2, -other.ra / det2, other.rr / det2
    u = p * one.radius + q * one.angle + p2 * other.radius + q2 * other.angle
    v = q * one.radius + s * one.angle + q2 * other.radius + s2 * other.angle
    a, b, c = p + p2, q + q2, s + s2
    scale = 1.0 / (a * c - b * b)
    return Polar(scale * (c * u - b * v), scale * (a * v - b * u), c * scale, -b * scale, a * scale)
