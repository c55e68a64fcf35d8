"""Expectation maximisation: lines and outliers as a mixture, whose shares and places are found in turn.

Nguyen, Gächter, Martinelli, Tomatis, Siegwart: *A comparison of line extraction algorithms using 2D range data for
indoor mobile robotics*, Autonomous Robots 23, 2007; Pfister, Burdick: *Multi-scale point and line range data algorithms
for mapping and localization*, ICRA 2006; Dempster, Laird, Rubin: *Maximum likelihood from incomplete data via the EM
algorithm*, J. Royal Statistical Society B 39, 1977. Nguyen et al. begin with one line drawn at random and look for the
next when it is found; here all begin together, as the lines through pieces of the scan, and those that come to lie on
another one, or keep too few points, are taken out.
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

# What no line explains has this density, beside that of a line at its middle.
OUTLIER = 0.001
# Farther than this from its line, in standard deviations, a point is an outlier.
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
            help="Standard deviation of a point's distance to its line. Points within 3 σ can become its own.",
        ),
    ] = 0.01  # fmt: skip
    piece: Annotated[
        int,
        Knob(
            "N_piece", 3, 200, "", 1, least=3, most=100_000,
            label="points in a first piece",
            why="a line through fewer points lies nowhere in particular",
            help="The scan is cut into pieces of so many points; each begins as a line. Fewer make more lines.",
        ),
    ] = 20  # fmt: skip
    iterations: Annotated[
        int,
        Knob(
            "N_iter", 1, 200, "", 1, least=1, most=10_000,
            label="iterations",
            why="without an iteration nothing is assigned",
            help="Most rounds of assigning points and fitting lines; it ends sooner when no line moves.",
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
        "line taken out: it explains {value:.1f} points, P_min = {limit:g}",
    ),
    Kind("line doubled", "iterations", "gone", "merge", "line taken out: it lies on one that explains more points"),
    Kind("mixture settled", "segments", "gone", "", "mixture settled: the runs of this line are its segments"),
)  # fmt: skip


@dataclass
class Mixture:
    """lines: (k, 3) of (a, b, c); shares: (k,) of all points; names: (k,) which first piece each line was."""

    lines: NDArray[np.float64]
    shares: NDArray[np.float64]
    names: NDArray[np.intp]

    def only(self, chosen: NDArray[np.bool_]) -> Mixture:
        return Mixture(self.lines[chosen], self.shares[chosen], self.names[chosen])


def find(points: Sequence, params: EmParams, found: Found) -> None:
    """Let the mixture settle; each point then belongs to its likeliest line, and a line's runs are its segments."""
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
    """E and M in turn until no line moves and none is taken out, or for so many iterations."""
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
    """A line through each `piece` of neighbouring points with no wide gap between them, all with the same share."""
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
    """Which lines stay: they have P_min points, and the same line has not more in another form."""
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
    """(n, k): how likely each point belongs to each line; what is left to 1 is the outliers'."""
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
    """Each line by total least squares with the weights of the points, and its share of them."""
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
