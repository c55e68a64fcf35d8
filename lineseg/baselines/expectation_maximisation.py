"""Expectation maximisation: a mixture of lines and outliers, whose weights and lines are estimated in turn.

Nguyen, Gächter, Martinelli, Tomatis, Siegwart: *A comparison of line extraction algorithms using 2D range data for
indoor mobile robotics*, Autonomous Robots 23, 2007; Pfister, Burdick: *Multi-scale point and line range data algorithms
for mapping and localization*, ICRA 2006; Dempster, Laird, Rubin: *Maximum likelihood from incomplete data via the EM
algorithm*, J. Royal Statistical Society B 39, 1977. Nguyen et al. start with one random line and look for the next
once it is found. Here all lines start together, one through each piece of the scan, and a line is removed if it
coincides with another or keeps too few points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel
from ..knobs import Knob, Thresholds
from ..total_least_squares import Moments, line_of
from ..tracing.vocabulary import Kind
from .found import Found, Method, vocabulary
from .knobs import BRIDGE, MAX_GAP, MIN_LENGTH, MIN_POINTS
from .sequence import Sequence, fit, runs

# Density of the outliers, relative to the peak density of a line.
OUTLIER = 0.001
# A point farther than this from its line, in standard deviations, is an outlier.
REACH = 3.0
SAME_ANGLE = 0.05
STILL = 1e-4


@dataclass(frozen=True)
class EmParams(Thresholds):
    """Thresholds of expectation maximisation."""

    sigma: Annotated[
        float,
        Knob(
            "σ", 0.002, 0.1, "m", 0.001, log=True, least=1e-5, most=10.0, scatter=0.33,
            label="noise of a point",
            why="without noise no point would belong to a line that moves",
            help="Standard deviation of a point's distance to its line. Higher lets lines take points from farther "
            "away, up to 3 σ.",
        ),
    ] = 0.01  # fmt: skip
    piece: Annotated[
        int,
        Knob(
            "N_piece", 3, 200, "", 1, least=3, most=100_000,
            label="points in a first piece",
            why="a line through fewer points has no reliable direction",
            help="Points in each piece of the scan that starts as a line. Higher starts with fewer lines.",
        ),
    ] = 20  # fmt: skip
    iterations: Annotated[
        int,
        Knob(
            "N_iter", 1, 200, "", 1, least=1, most=10_000,
            label="iterations",
            why="without an iteration nothing is assigned",
            help="Largest number of rounds of assigning points and fitting lines. Stops earlier when no line moves.",
        ),
    ] = 40  # fmt: skip
    bridge: Annotated[int, BRIDGE] = 3
    max_gap: Annotated[float, MAX_GAP] = 0.5
    min_points: Annotated[int, MIN_POINTS] = 10
    min_length: Annotated[float, MIN_LENGTH] = 0.6


VOCABULARY = vocabulary(
    "segments",
    (),
    Kind("piece fitted", "pieces", "stands", "seed", "piece fitted: a line through {span}"),
    Kind(
        "line moved", "iterations", "stands", "",
        "line moved: it explains {value:.1f} points, most of them {span}",
    ),
    Kind(
        "line emptied", "iterations", "gone", "drop",
        "line removed: it explains {value:.1f} points, P_min = {limit:g}",
    ),
    Kind("line doubled", "iterations", "gone", "merge", "line removed: it coincides with one that explains more "
    "points"),
    Kind("mixture settled", "segments", "gone", "", "mixture converged: the runs of this line become segments"),
)  # fmt: skip


@dataclass
class Mixture:
    """lines: (k, 3) of (a, b, c); shares: (k,) of all points; names: (k,) the initial piece of each line."""

    lines: NDArray[np.float64]
    shares: NDArray[np.float64]
    names: NDArray[np.intp]

    def only(self, chosen: NDArray[np.bool_]) -> Mixture:
        return Mixture(self.lines[chosen], self.shares[chosen], self.names[chosen])


def find(points: Sequence, params: EmParams, found: Found) -> None:
    """Iterate until the mixture converges, assign each point to its likeliest line, and make segments of the runs."""
    mixture = settled(points, params, found)
    if not len(mixture.lines):
        return
    owner = np.argmax(expectation(points, mixture, params.sigma), axis=1)
    found.candidates = int(mixture.names[-1]) + 1
    for k, line in enumerate(mixture.lines.tolist()):
        near = points.distances(line) < REACH * params.sigma
        own = runs(points, (owner == k) & near, params.bridge, params.max_gap)
        found.note("mixture settled", max(own, key=len, default=np.zeros(1, np.intp)), candidate=int(mixture.names[k]))
        for run in own:
            found.keep(run)


def settled(points: Sequence, params: EmParams, found: Found) -> Mixture:
    """Alternate E and M steps until no line moves or is removed, or until the iterations are used up."""
    mixture = first_pieces(points, params, found)
    for _ in range(params.iterations):
        weights = expectation(points, mixture, params.sigma)
        before = mixture.lines.copy()
        maximise(points.x, points.y, weights, mixture.lines, mixture.shares)
        moved = float(np.abs(mixture.lines - before).max(initial=0.0))
        stays = standing(points, mixture, weights, params)
        _note(points, mixture, weights, stays, params, found)
        mixture = mixture.only(stays)
        if moved < STILL and stays.all():
            break
    return mixture


def first_pieces(points: Sequence, params: EmParams, found: Found) -> Mixture:
    """A line through each `piece` of neighbouring points without a wide gap, all with the same share."""
    breaks = np.flatnonzero(points.gaps()[1:] > params.max_gap) + 1
    whole = np.split(np.arange(len(points.x)), breaks)
    pieces = [piece for each in whole for piece in np.array_split(each, math.ceil(len(each) / params.piece))]
    pieces = [piece for piece in pieces if len(piece) >= max(2, params.piece // 2)]
    lines = [fit(points, piece).line for piece in pieces]
    for name, (piece, line) in enumerate(zip(pieces, lines, strict=True)):
        found.note("piece fitted", piece, line, candidate=name)
    count = len(lines)
    return Mixture(np.array(lines).reshape(-1, 3), np.full(count, 1.0 / max(count, 1)), np.arange(count))


def standing(points: Sequence, mixture: Mixture, weights: NDArray[np.float64], params: EmParams) -> NDArray[np.bool_]:
    """Which lines stay: those with P_min points that do not coincide with a line that has more."""
    sizes = weights.sum(axis=0)
    stays = sizes >= max(params.min_points, 2)
    middles = np.column_stack((weights.T @ points.x, weights.T @ points.y)) / np.maximum(sizes, 1e-9)[:, None]
    lines = mixture.lines
    apart = np.abs(lines[:, :2] @ middles.T + lines[:, 2:])
    cross = np.abs(np.outer(lines[:, 0], lines[:, 1]) - np.outer(lines[:, 1], lines[:, 0]))
    same = (np.maximum(apart, apart.T) < 2 * params.sigma) & (cross < SAME_ANGLE)
    for k in np.argsort(-sizes, kind="stable"):
        if stays[k]:
            stays[same[k] & (np.arange(len(stays)) != k)] = False
    return stays


def expectation(points: Sequence, mixture: Mixture, sigma: float) -> NDArray[np.float64]:
    """(n, k): probability that each point belongs to each line; the remainder to 1 belongs to the outliers."""
    weights = np.empty((len(points.x), len(mixture.lines)))
    expect(points.x, points.y, mixture.lines, mixture.shares, sigma, OUTLIER, weights)
    return weights


@entry_kernel
def expect(x, y, lines, shares, sigma, outlier, weights):
    """wᵢⱼ = πⱼ·exp(−dᵢⱼ²/2σ²) / (outlier + Σₗ πₗ·exp(−dᵢₗ²/2σ²)), dᵢⱼ the distance of point i to line j."""
    n, count = weights.shape
    for i in range(n):
        total = outlier
        for j in range(count):
            d = (lines[j, 0] * x[i] + lines[j, 1] * y[i] + lines[j, 2]) / sigma
            weights[i, j] = shares[j] * math.exp(-0.5 * d * d)
            total += weights[i, j]
        for j in range(count):
            weights[i, j] /= total


@entry_kernel
def maximise(x, y, weights, lines, shares):
    """Each line fitted by weighted total least squares, and its share of the points."""
    n, count = weights.shape
    for j in range(count):
        w = sx = sy = sxx = sxy = syy = 0.0
        for i in range(n):
            p, dx, dy = weights[i, j], x[i] - x[0], y[i] - y[0]
            w, sx, sy = w + p, sx + p * dx, sy + p * dy
            sxx, sxy, syy = sxx + p * dx * dx, sxy + p * dx * dy, syy + p * dy * dy
        shares[j] = w / n
        if w > 1e-9:
            lines[j, 0], lines[j, 1], lines[j, 2] = line_of(Moments(x[0], y[0], w, sx, sy, sxx, sxy, syy))


def _note(
    points: Sequence,
    mixture: Mixture,
    weights: NDArray[np.float64],
    stays: NDArray[np.bool_],
    params: EmParams,
    found: Found,
) -> None:
    if not found.traced:
        return
    sizes, fewest = weights.sum(axis=0).tolist(), max(params.min_points, 2)
    for k, name in enumerate(mixture.names.tolist()):
        own = runs(points, weights[:, k] > 0.5, params.bridge, params.max_gap)
        run = max(own, key=len, default=np.zeros(1, np.intp))
        a, b, c = mixture.lines[k].tolist()
        gone = "line emptied" if sizes[k] < fewest else "line doubled"
        kind = "line moved" if stays[k] else gone
        found.note(kind, run, (a, b, c), candidate=name, check="min_points", value=sizes[k], limit=fewest)


EXPECTATION_MAXIMISATION = Method("expectation-maximisation", VOCABULARY, find)
