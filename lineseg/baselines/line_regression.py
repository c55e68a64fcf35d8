"""Line regression: fit a line to each sliding window, and cluster the lines that agree.

Arras, Siegwart: *Feature extraction and scene interpretation for map-based navigation and map building*, Proc. SPIE
3210, 1997; "Line regression" in Nguyen, Gächter, Martinelli, Tomatis, Siegwart: *A comparison of line extraction
algorithms using 2D range data for indoor mobile robotics*, Autonomous Robots 23, 2007.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from ..covariance import covariance_of
from ..kernel import entry_kernel, kernel
from ..knobs import Knob, Thresholds
from ..total_least_squares import line_of, moments_of
from ..tracing.vocabulary import Kind
from .found import NOWHERE, Found, Method, vocabulary
from .knobs import MAX_GAP, MIN_LENGTH, MIN_POINTS
from .sequence import Sequence, fit, opened_between_lines

Span = tuple[int, int]


@dataclass(frozen=True)
class RegressionParams(Thresholds):
    """Thresholds of line regression."""

    sigma: Annotated[
        float,
        Knob(
            "σ_r", 0.002, 0.1, "m", 0.001, log=True, least=1e-5, most=10.0, scatter=0.5,
            label="noise of a range",
            why="without noise no two lines agree",
            help="Standard deviation of a range. Higher lets the lines of neighbouring windows differ more.",
        ),
    ] = 0.015  # fmt: skip
    window: Annotated[
        int,
        Knob(
            "N_f", 3, 51, "", 1, least=3, most=1000,
            label="points in a window",
            why="a window needs 3 or more points, because any 2 points fit a line exactly",
            help="Consecutive points in each fit. Higher makes lines more accurate and corners rounder.",
        ),
    ] = 11  # fmt: skip
    max_spread: Annotated[
        float,
        Knob(
            "D_max", 0.1, 50.0, "", 0.1, log=True, least=1e-3, most=1e6,
            label="spread of three windows",
            why="with 0 no lines would ever agree",
            help="Largest sum of squared Mahalanobis distances from three neighbouring lines to their mean. Higher "
            "makes longer clusters.",
        ),
    ] = 3.0  # fmt: skip
    max_merge: Annotated[
        float,
        Knob(
            "M_max", 0.1, 100.0, "", 0.1, log=True, least=1e-3, most=1e6,
            label="distance of a merge",
            why="with 0 no lines would ever be merged",
            help="Largest squared Mahalanobis distance between neighbouring clusters that are merged. Higher merges "
            "more.",
        ),
    ] = 40.0  # fmt: skip
    max_gap: Annotated[float, MAX_GAP] = 0.5
    min_points: Annotated[int, MIN_POINTS] = 10
    min_length: Annotated[float, MIN_LENGTH] = 0.6


VOCABULARY = vocabulary(
    "segments",
    ("max_spread", "max_merge"),
    Kind(
        "cluster found", "windows", "stands", "seed",
        "cluster found: neighbouring windows spread at most {value:.2f} < D_max = {limit:g}, {span}",
    ),
    Kind(
        "clusters merged", "clusters", "joined", "merge",
        "clusters merged: Mahalanobis distance² {value:.2f} < M_max = {limit:g}; now {span}",
    ),
    Kind(
        "overlap cut", "clusters", "parted", "cut",
        "overlap cut at beam {beam}, the first one nearer to the next line; this line keeps {span}",
    ),
)  # fmt: skip


def find(points: Sequence, params: RegressionParams, found: Found) -> None:
    """Cluster windows that agree with their neighbours, then merge the nearest clusters while they agree."""
    points = found.points = opened_between_lines(
        points, lambda circle: _clustered(Clusters(circle, params, None)).spans
    )
    clusters = _clustered(Clusters(points, params, found))
    for (first, last), name in zip(clusters.spans, clusters.names, strict=True):
        found.keep(np.arange(first, last + 1), name)


def _clustered(clusters: Clusters) -> Clusters:
    clusters.find()
    clusters.merge()
    clusters.part()
    return clusters


class Clusters:
    """Clusters of windows, in scan order.

    spans: (first, last) positions of each; names: their numbers in the log.
    """

    def __init__(self, points: Sequence, params: RegressionParams, found: Found | None) -> None:
        self.points, self.params = points, params
        self.found = found if found is not None and found.traced else None
        self.spans: list[Span] = []
        self.names: list[int] = []
        self._noise = np.full(len(points.x), params.sigma), np.zeros(len(points.x))
        self._breaks = np.concatenate(([0], np.cumsum(points.gaps()[1:] > params.max_gap)))

    def find(self) -> None:
        """The runs of windows whose line and both neighbouring lines spread less than D_max about their mean."""
        window, count = self.params.window, len(self.points.x) - self.params.window + 1
        if count < 3:
            return
        spreads, models = np.full(count, np.inf), np.empty((count, 5))
        spread_of_windows(self.points.x, self.points.y, *self._noise, window, models, spreads)
        # Three windows span from the first point of the first window to the last point of the third.
        spreads[1:-1][self._breaks[window + 1 :] != self._breaks[: count - 2]] = np.inf
        edges = np.flatnonzero(
            np.diff(np.concatenate(([False], spreads < self.params.max_spread, [False])).astype(int))
        )
        for start, stop in edges.reshape(-1, 2).tolist():
            self.spans.append((start - 1, stop + window - 1))
            self.names.append(len(self.names))
            worst, limit = float(spreads[start:stop].max()), self.params.max_spread
            self._note("cluster found", len(self.spans) - 1, check="max_spread", value=worst, limit=limit)

    def merge(self) -> None:
        """Merge the two nearest neighbours until none are near enough (agglomerative, hierarchical)."""
        distances = [self._distance(k) for k in range(len(self.spans) - 1)]
        while distances:
            k = int(np.argmin(distances))
            value, limit = distances[k], self.params.max_merge
            if not value < limit:
                return
            self.spans[k : k + 2] = [(self.spans[k][0], self.spans[k + 1][1])]
            self._note("clusters merged", k, partner=self.names[k + 1], check="max_merge", value=value, limit=limit)
            del distances[k], self.names[k + 1]
            for changed in range(max(k - 1, 0), min(k + 1, len(distances))):
                distances[changed] = self._distance(changed)

    def _distance(self, k: int) -> float:
        """The squared Mahalanobis distance of clusters k and k + 1; infinite across a gap."""
        one, other = self.spans[k], self.spans[k + 1]
        if self._breaks[one[1]] != self._breaks[other[0]]:
            return math.inf
        return distance_of(self.points.x, self.points.y, *self._noise, *one, *other)

    def part(self) -> None:
        """Cut neighbours that share points at the first one that is not nearer to the earlier line."""
        for k in range(len(self.spans) - 1):
            (first, last), (first_2, last_2) = self.spans[k : k + 2]
            if first_2 > last:
                continue
            line, other = (fit(self.points, np.arange(a, b + 1)).line for a, b in self.spans[k : k + 2])
            shared = np.arange(first_2, min(last, last_2) + 1)
            farther = self.points.distances(line)[shared] >= self.points.distances(other)[shared]
            cut = int(shared[np.argmax(farther)]) if farther.any() else int(shared[-1]) + 1
            # Each keeps at least one point.
            cut = min(max(cut, first + 1), last_2)
            self.spans[k : k + 2] = [(first, cut - 1), (cut, last_2)]
            self._note("overlap cut", k, partner=self.names[k + 1], beam=cut, other=other)

    def _note(self, kind: str, k: int, **numbers: Any) -> None:
        if self.found is not None:
            run = np.arange(self.spans[k][0], self.spans[k][1] + 1)
            line = fit(self.points, run).line if len(run) > 1 else NOWHERE
            self.found.note(kind, run, line, candidate=self.names[k], **numbers)


@entry_kernel
def spread_of_windows(x, y, sigma, exact, window, models, spreads):
    """Fit every window, and find the spread of each three neighbouring lines about their weighted mean.

    With xⱼ = (ρ, θ) and Cⱼ of the three windows, Σ (xⱼ − x̄)ᵀ Cⱼ⁻¹ (xⱼ − x̄), x̄ = (Σ Cⱼ⁻¹)⁻¹ Σ Cⱼ⁻¹ xⱼ.
    models: (windows, 5) and spreads: (windows,) are memory.
    """
    for i in range(len(models)):
        model = model_of(x, y, sigma, exact, i, i + window - 1)
        models[i, 0], models[i, 1], models[i, 2], models[i, 3], models[i, 4] = model
    for i in range(1, len(models) - 1):
        spreads[i] = spread(models, i)


@kernel
def spread(models, i):
    a = b = d = u = v = total = 0.0
    for j in range(i - 1, i + 2):
        rho, theta = difference(models[i, 0], models[i, 1], models[j, 0], models[j, 1])
        var_rho, cov, var_theta = models[j, 2], models[j, 3], models[j, 4]
        determinant = var_rho * var_theta - cov * cov
        p, q, r = var_theta / determinant, -cov / determinant, var_rho / determinant
        a, b, d = a + p, b + q, d + r
        u, v = u + p * rho + q * theta, v + q * rho + r * theta
        total += p * rho * rho + 2.0 * q * rho * theta + r * theta * theta
    return total - (d * u * u - 2.0 * b * u * v + a * v * v) / (a * d - b * b)


@kernel
def model_of(x, y, sigma, exact, first, last):
    """(ρ, θ, var ρ, cov, var θ) of the line through the points first..last."""
    line = line_of(moments_of(x, y, first, last))
    var_rho, cov, var_theta = covariance_of(x, y, sigma, exact, first, last, line)
    return -line[2], math.atan2(line[1], line[0]), var_rho, cov, var_theta


@kernel
def difference(rho, theta, rho_2, theta_2):
    """(ρ₂ − ρ, θ₂ − θ), with the second line in whichever of its two forms is nearer to the first."""
    turn = theta_2 - theta
    turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)
    if abs(turn) > 0.5 * math.pi:
        return -rho_2 - rho, turn - math.copysign(math.pi, turn)
    return rho_2 - rho, turn


@entry_kernel
def distance_of(x, y, sigma, exact, first, last, first_2, last_2):
    """(x₁ − x₂)ᵀ (C₁ + C₂)⁻¹ (x₁ − x₂) of the lines through the points first..last and first_2..last_2."""
    rho, theta, var_rho, cov, var_theta = model_of(x, y, sigma, exact, first, last)
    rho_2, theta_2, var_rho_2, cov_2, var_theta_2 = model_of(x, y, sigma, exact, first_2, last_2)
    d_rho, d_theta = difference(rho, theta, rho_2, theta_2)
    a, b, d = var_rho + var_rho_2, cov + cov_2, var_theta + var_theta_2
    return (d * d_rho * d_rho - 2.0 * b * d_rho * d_theta + a * d_theta * d_theta) / (a * d - b * b)


LINE_REGRESSION = Method("line-regression", VOCABULARY, find)
