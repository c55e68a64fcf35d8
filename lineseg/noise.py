"""Estimates the noise of a laser from its scans: how much ranges scatter about walls.

Along a straight line 1/ρ = a·cos φ + b·sin φ, which is linear in the ray u of the beam. So for three beams with the
rays u₁, u₂, u₃ on one wall, at whatever angle they meet it,

    e = [u₂u₃]/ρ₁ − [u₁u₃]/ρ₂ + [u₁u₂]/ρ₃ = 0,

with [uv] the cross product. If ranges have the standard deviation σ, e has the variance σ²·Σ (wᵢ/ρᵢ²)², where w are the
three cross products; so e divided by the root of that sum has the standard deviation σ. This is the white part of the
noise, because a wall bends little within three neighbouring beams. Its line tells how much it bends (`propose`).

A mixture model separates walls from edges, corners and clutter: measurements on walls have a known distribution with
one unknown scale, and everything else lies above it (Dempster, Laird, Rubin: *Maximum likelihood from incomplete
data via the EM algorithm*, J. Royal Statistical Society B 39(1), 1977).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .kernel import entry_kernel, kernel
from .region_growing.points import is_valid
from .scan import Floats, Recording

# Successive triples to average. Fewer separate walls from clutter less well; more do not fit on short walls.
WINDOW = 8
BINS = 8
# Second differences of white noise have the correlations 1, −2/3 and 1/6. Their mean square varies as one of fewer
# independent values would (Welch, Satterthwaite): these are its degrees of freedom.
WINDOW_DOF = WINDOW**2 / (WINDOW + 2 * (WINDOW - 1) * 4 / 9 + 2 * (WINDOW - 2) / 36)
# Windows in a bin: with fewer, the scale is uncertain by more than 10 %.
LEAST = 40
# Share of a bin that must lie on walls for its scale to be believed.
TRUSTED = 0.2
# No laser scatters by more [m]; a bin above this holds no walls.
MOST = 0.3
# The number of scans that are looked at.
FRAMES = 300
# Quantiles of the values at which the search for their scale starts.
STARTS = (0.2, 0.5, 0.8)
# Width of the cells in which values are counted: a twentieth of the scale.
GRAIN = 0.05


@dataclass(frozen=True, eq=False)
class RangeNoise:
    """How the points of a recording scatter.

    edges: (bins + 1,) of the ranges [m]; sigma: (bins,) standard deviation of a range in each bin [m], NaN if unknown;
    walls: (bins,) share of what was measured there that lies on walls; windows: (bins,) number of measurements.
    base [m], growth: σ² = base² + (growth·ρ)² through these.
    """

    edges: Floats
    sigma: Floats
    walls: Floats
    windows: NDArray[np.int64]
    base: float
    growth: float

    def at(self, ranges: Floats | float) -> Floats:
        """σ at these ranges [m]; NaN if the recording does not show its noise."""
        return np.hypot(self.base, self.growth * np.asarray(ranges))

    @property
    def known(self) -> bool:
        """Whether the scans show their noise at all."""
        return math.isfinite(self.base)


def noise(recording: Recording) -> RangeNoise:
    """The noise of a recording, from up to 300 of its scans, evenly spread.

    Unknown (NaN) if there is too little data: a scan of ten beams, no return, no straight wall.
    """
    ranges, departures = _neighbouring(recording)
    edges, middles, sigma, walls, windows = _by_range(ranges, departures)
    base, growth = _law(middles, sigma, windows)
    return RangeNoise(edges, sigma, walls, windows, base, growth)


def _spread(recording: Recording, most: int) -> list[int]:
    return sorted(set(np.linspace(0, len(recording) - 1, min(len(recording), most)).round().astype(int).tolist()))


def _neighbouring(recording: Recording) -> tuple[Floats, Floats]:
    """Ranges and scatter of windows of neighbouring beams."""
    found = []
    for frame in _spread(recording, FRAMES):
        scan = recording[frame]
        out = np.empty((2, len(scan) // WINDOW + 1))
        used = windows_of(scan.ranges.astype(np.float64), scan.rays, scan.range_min, scan.range_max, out)
        found.append(out[:, :used])
    ranges, squares = np.hstack(found) if found else np.empty((2, 0))
    # Exactly equal ranges, as from a simulator, give nothing to measure.
    some = squares > 0.0
    return ranges[some], np.sqrt(squares[some])


@entry_kernel
def windows_of(ranges, rays, range_min, range_max, out):
    """The mean range and the mean square of e of each run of WINDOW triples of neighbouring beams: their number."""
    used = count = 0
    square = distance = 0.0
    for k in range(1, len(ranges) - 1):
        one, two, three = ranges[k - 1], ranges[k], ranges[k + 1]
        if not (
            is_valid(one, range_min, range_max)
            & is_valid(two, range_min, range_max)
            & is_valid(three, range_min, range_max)
        ):
            count, square, distance = 0, 0.0, 0.0
            continue
        square += departure(ranges, rays, k - 1, k, k + 1) ** 2
        distance += two
        count += 1
        if count == WINDOW:
            out[0, used], out[1, used] = distance / WINDOW, square / WINDOW
            used, count, square, distance = used + 1, 0, 0.0, 0.0
    return used


@kernel
def departure(ranges, rays, i, j, k):
    """e of three beams, over the root of the sum: as large as σ, if they lie on one straight wall [m]."""
    one = (rays[0, j] * rays[1, k] - rays[1, j] * rays[0, k]) / ranges[i]
    two = (rays[0, i] * rays[1, k] - rays[1, i] * rays[0, k]) / ranges[j]
    three = (rays[0, i] * rays[1, j] - rays[1, i] * rays[0, j]) / ranges[k]
    size = (one / ranges[i]) ** 2 + (two / ranges[j]) ** 2 + (three / ranges[k]) ** 2
    return (one - two + three) / math.sqrt(size) if size > 0.0 else 0.0


def _by_range(ranges: Floats, departures: Floats) -> tuple[Floats, Floats, Floats, Floats, NDArray[np.int64]]:
    """edges, median ranges, sigma, walls, windows of bins with equally many windows each."""
    bins = min(BINS, len(ranges) // LEAST)
    if not bins:
        return np.empty(0), np.empty(0), np.empty(0), np.empty(0), np.empty(0, np.int64)
    order = np.argsort(ranges)
    parts = np.array_split(order, bins)
    edges = np.append([ranges[part[0]] for part in parts], ranges[order[-1]])
    middles = np.array([np.median(ranges[part]) for part in parts])
    fits = [_scale(departures[part], WINDOW_DOF) for part in parts]
    walls = np.array([share for _, share in fits])
    scales = np.array([scale for scale, _ in fits])
    sigma = np.where((walls >= TRUSTED) & (scales <= MOST), scales, np.nan)
    return edges, middles, sigma, walls, np.array([len(part) for part in parts])


def _scale(values: Floats, dof: float) -> tuple[float, float]:
    """The scale of those values (n,) > 0 that lie on walls, and their share.

    A value on a wall is scale·√(χ²/dof) with `dof` degrees of freedom; another may have any size above the scale, each
    order of magnitude as likely as the next. The likelihood has several maxima; the highest of those found counts.
    """
    logs = np.log(values)
    places = np.linspace(float(logs.min()), top := float(logs.max()), max(math.ceil(np.ptp(logs) / GRAIN), 1) + 1)
    counts, _ = np.histogram(logs, places)
    cells = (places[:-1] + places[1:]) / 2
    _, log_scale, share = max(_mixture(cells, counts, dof, top, start) for start in np.quantile(logs, STARTS).tolist())
    return math.exp(log_scale), share


def _mixture(
    logs: Floats, counts: NDArray[np.int64], dof: float, top: float, log_scale: float
) -> tuple[float, float, float]:
    """(log-likelihood, log of the scale, share on walls) of counted logarithms, from one start of the search."""
    share, half, likelihood = 0.5, dof / 2, -math.inf
    constant = math.log(2) + half * math.log(half) - math.lgamma(half)
    for _ in range(100):
        x = logs - log_scale
        on_wall = share * np.exp(constant + 2 * half * x - half * np.exp(2 * x))
        elsewhere = (1 - share) * np.where(x > 0, 1 / max(top - log_scale, 1.0), 1e-9)
        likelihood = float(counts @ np.log(on_wall + elsewhere))
        weight = counts * on_wall / (on_wall + elsewhere)
        share = float(weight.sum() / counts.sum())
        mean = float(weight @ np.exp(2 * logs)) / float(weight.sum())
        before, log_scale = log_scale, 0.5 * math.log(mean)
        if abs(log_scale - before) < 1e-4:
            break
    return likelihood, log_scale, share


def _law(middles: Floats, sigma: Floats, windows: NDArray[np.int64]) -> tuple[float, float]:
    """base and growth: least squares of the relative error of σ² as a line over ρ², neither of them negative."""
    told = np.isfinite(sigma)
    if not told.any() or not sigma[told].any():
        return math.nan, math.nan
    squares, distances = sigma[told] ** 2, middles[told] ** 2
    rows = np.column_stack((np.ones(len(squares)), distances)) / squares[:, None] * np.sqrt(windows[told])[:, None]
    goal = np.sqrt(windows[told])
    constant, slope = np.linalg.lstsq(rows, goal, rcond=None)[0] if told.sum() > 1 else (squares[0], 0.0)
    if slope < 0 or constant < 0:
        only = 0 if slope < 0 else 1
        value = float(rows[:, only] @ goal / (rows[:, only] @ rows[:, only]))
        constant, slope = (value, 0.0) if only == 0 else (0.0, value)
    return math.sqrt(constant), math.sqrt(slope)
