"""The covariance of a line's (ρ, θ), from the noise of the beams that it was fitted to.

Total least squares gives the line x·cos θ + y·sin θ = ρ through the points pᵢ = rᵢ·uᵢ, uᵢ the unit vector of bearing
φᵢ. With its normal n = (cos θ, sin θ) and its direction t = (−sin θ, cos θ), let

    sᵢ = t·(pᵢ − p̄),  dᵢ = n·(pᵢ − p̄),  m = t·p̄,  S = Σ(sᵢ² − dᵢ²).

The fit is where ρ = n·p̄ and Σ sᵢ·dᵢ = 0. As ∂dᵢ/∂θ = sᵢ and ∂sᵢ/∂θ = −dᵢ, the second condition, differentiated, says
how θ follows the points, and the first how ρ follows them and θ (N points):

    δθ = −Σ (sᵢ·n + dᵢ·t)·δpᵢ / S,   δρ = Σ n·δpᵢ / N + m·δθ.

A beam moves its point by δpᵢ = uᵢ·δrᵢ + rᵢ·vᵢ·δφᵢ, vᵢ at a right angle to uᵢ, and with ψᵢ = φᵢ − θ

    ∂θ/∂rᵢ = −(sᵢ·cos ψᵢ + dᵢ·sin ψᵢ) / S,        ∂ρ/∂rᵢ = cos ψᵢ / N + m·∂θ/∂rᵢ,
    ∂θ/∂φᵢ = rᵢ·(sᵢ·sin ψᵢ − dᵢ·cos ψᵢ) / S,      ∂ρ/∂φᵢ = −rᵢ·sin ψᵢ / N + m·∂θ/∂φᵢ.

With independent beams the covariance is C = Σᵢ (σ_r² gᵣ·gᵣᵀ + σ_φ² g_φ·g_φᵀ), gᵣ = (∂ρ/∂rᵢ, ∂θ/∂rᵢ) and so on.

Deriche, Vaillant, Faugeras: *From noisy edge points to 3D reconstruction of a scene*, 1992, from the scatter. Arras,
Siegwart: *Feature extraction and scene interpretation for map-based navigation and map building*, SPIE 3210, 1997, from
ranges. Pfister, Roumeliotis, Burdick: *Weighted line fitting algorithms for mobile robot map building and efficient
data representation*, ICRA 2003, from both. Diosi, Kleeman: *Uncertainty of line segments extracted from static SICK PLS
laser scans*, ACRA 2003, also from systematic errors, which are not independent and are left out here.

This is a first-order result. At grazing incidence, noise also moves the points along the wall, which turns the
line by √N·σ_r·sin ψ / (rms of sᵢ) standard deviations: little, as long as the noise is small beside the wall's length.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .kernel import entry_kernel, kernel, summing_kernel
from .scan import Floats, Scan
from .segment import Extraction, Segment


@dataclass(frozen=True)
class Noise:
    """Standard deviations of a beam: `range` [m] and `bearing` [rad], of all beams or (n,) one each."""

    range: float | Floats
    bearing: float | Floats = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("range", "m"), ("bearing", "rad")):
            sigma = np.asarray(getattr(self, name), dtype=np.float64)
            wrong = sigma[~((sigma >= 0) & np.isfinite(sigma))]
            if wrong.size:
                raise ValueError(
                    f"the noise of a {name} is {wrong.flat[0]:g}; a standard deviation is 0 {unit} or more, and finite"
                )


def covariance(scan: Scan, segment: Segment, noise: Noise) -> NDArray[np.float64]:
    """Covariance (2, 2) of (ρ, θ) [m, rad] of a segment that was fitted to every valid beam from `first` to `last`.

    ρ is counted along the normal at θ. The line with −ρ and θ + π is the same one: through ρ = 0 nothing is singular
    and the covariance stays true, but `Segment.rho` is never negative, so that within a few σ_ρ of the laser θ may come
    out turned by half a circle. To compare two such lines, use the closer of the two forms.
    NaN if the points have no direction: they coincide, or scatter equally in all directions.
    """
    n = len(scan)
    span = np.arange(segment.first, segment.last + 1 + (n if segment.last < segment.first else 0)) % n
    beams = span[scan.valid[span]]
    return _covariances(scan, beams, np.array([0, len(beams)]), (segment,), noise)[0]


def covariances(scan: Scan, extraction: Extraction, noise: Noise) -> NDArray[np.float64]:
    """Covariances (segments, 2, 2) of (ρ, θ) of all segments, each from the beams that carry its label; see above."""
    labels = np.where(scan.valid, extraction.labels, -1)
    beams = np.argsort(labels, kind="stable")
    bounds = np.searchsorted(labels[beams], np.arange(len(extraction.segments) + 1))
    return _covariances(scan, beams, bounds, extraction.segments, noise)


def _covariances(
    scan: Scan, beams: NDArray[np.integer], bounds: NDArray[np.integer], segments: Sequence[Segment], noise: Noise
) -> NDArray[np.float64]:
    """The beams of segment k are `beams[bounds[k] : bounds[k + 1]]`."""
    range_sigma, bearing_sigma = (
        np.broadcast_to(np.asarray(sigma, np.float64), len(scan))[beams] for sigma in (noise.range, noise.bearing)
    )
    x, y = scan.xy[beams].T.copy()
    lines = np.array([segment.line for segment in segments]).reshape(-1, 3)
    found = np.empty((len(segments), 2, 2))
    covariances_of_points(x, y, range_sigma, bearing_sigma, bounds.astype(np.int64), lines, found)
    return found


@entry_kernel
def covariances_of_points(x, y, range_sigma, bearing_sigma, bounds, lines, found):
    """Write the covariance of each line (a, b, c) to `found` (lines, 2, 2).

    bounds: the points of line k are those from bounds[k] to bounds[k + 1] − 1. range_sigma, bearing_sigma: (points,)
    standard deviations of their beams.
    """
    for k in range(len(lines)):
        line = (lines[k, 0], lines[k, 1], lines[k, 2])
        var_rho, cov, var_theta = covariance_of(x, y, range_sigma, bearing_sigma, bounds[k], bounds[k + 1] - 1, line)
        found[k, 0, 0], found[k, 0, 1] = var_rho, cov
        found[k, 1, 0], found[k, 1, 1] = cov, var_theta


@kernel
def covariance_of(x, y, range_sigma, bearing_sigma, first, last, line):
    """The same of the points first..last."""
    a, b, c = line
    n = last - first + 1.0
    middle, spread = scatter_along(x, y, first, last, line)
    var_rho = cov = var_theta = 0.0
    for k in range(first, last + 1):
        r = math.hypot(x[k], y[k])
        across, along = a * x[k] + b * y[k], a * y[k] - b * x[k]
        s, d = along - middle, across + c
        theta_r, theta_phi = -(s * across + d * along) / (r * spread), (s * along - d * across) / spread
        rho_r, rho_phi = across / (r * n) + middle * theta_r, -along / n + middle * theta_phi
        of_range, of_bearing = range_sigma[k] ** 2, bearing_sigma[k] ** 2
        var_rho += of_range * rho_r**2 + of_bearing * rho_phi**2
        cov += of_range * rho_r * theta_r + of_bearing * rho_phi * theta_phi
        var_theta += of_range * theta_r**2 + of_bearing * theta_phi**2
    return var_rho, cov, var_theta


@summing_kernel
def scatter_along(x, y, first, last, line):
    """m and S; S is NaN if only rounding errors are left of it."""
    a, b, c = line
    middle = spread = size = 0.0
    for k in range(first, last + 1):
        middle += (a * y[k] - b * x[k]) / (last - first + 1)
    for k in range(first, last + 1):
        s, d = a * y[k] - b * x[k] - middle, a * x[k] + b * y[k] + c
        spread += s * s - d * d
        size += x[k] * x[k] + y[k] * y[k]
    return middle, (spread if spread > 1e-12 * size else math.nan)
