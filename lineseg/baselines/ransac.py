"""RANSAC: draw lines through two random points, and take the one that most points agree with.

Fischler, Bolles: *Random sample consensus: a paradigm for model fitting with applications to image analysis and
automated cartography*, Communications of the ACM 24, 1981, DOI 10.1145/358669.358692; for laser scans Nguyen, Gächter,
Martinelli, Tomatis, Siegwart: *A comparison of line extraction algorithms using 2D range data for indoor mobile
robotics*, Autonomous Robots 23, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..kernel import entry_kernel, kernel
from ..knobs import Knob, Thresholds
from ..tracing.vocabulary import Kind
from .consensus import consensus
from .found import Found, Method, vocabulary
from .knobs import BRIDGE, EPSILON, MAX_GAP, MIN_LENGTH, MIN_POINTS, SEED
from .sequence import Line, Sequence

# The search ends after this many failed hypotheses in a row.
FAILURES = 5
GOLDEN = 0x9E3779B97F4A7C15


@dataclass(frozen=True)
class RansacParams(Thresholds):
    """Thresholds of RANSAC."""

    epsilon: Annotated[float, EPSILON] = 0.03
    trials: Annotated[
        int,
        Knob(
            "N_trials", 1, 1000, "", 1, log=True, least=1, most=100_000,
            label="samples for a line",
            why="without a sample there is no hypothesis",
            help="Pairs of points drawn for each line. Higher misses fewer lines and takes longer.",
        ),
    ] = 100  # fmt: skip
    reach: Annotated[
        int,
        Knob(
            "R_max", 1, 2000, "", 1, log=True, least=1, most=1_000_000,
            label="reach of a sample",
            why="a pair is two points",
            help="Largest distance between the points of a pair, counted in points along the scan. Higher finds "
            "longer lines and misses more short ones.",
        ),
    ] = 100  # fmt: skip
    seed: Annotated[int, SEED] = 1
    bridge: Annotated[int, BRIDGE] = 3
    max_gap: Annotated[float, MAX_GAP] = 0.5
    min_points: Annotated[int, MIN_POINTS] = 10
    min_length: Annotated[float, MIN_LENGTH] = 0.6


VOCABULARY = vocabulary(
    "samples",
    (),
    Kind(
        "best sample", "samples", "shown", "seed",
        "best sample: {value:g} points agree with its line, P_min = {limit:g}; the longest run along it is {span}",
    ),
)  # fmt: skip


def find(points: Sequence, params: RansacParams, found: Found) -> None:
    """Find lines one after another, each from the best of `trials` samples of the points that no line has taken.

    Ends when too few points are left, or after FAILURES hypotheses in a row without a run of P_min points.
    """
    free = np.ones(len(points.x), bool)
    state = np.array([((params.seed + 1) * GOLDEN) % 2**64], np.uint64)
    failures, fewest = 0, max(params.min_points, 2)
    while failures < FAILURES and np.count_nonzero(free) >= fewest:
        left = np.flatnonzero(free)
        one, other, votes = best_pair(
            points.x[left], points.y[left], params.trials, min(params.reach, len(left) - 1), params.epsilon, state
        )
        failures += 1
        if votes < fewest:
            continue
        line = _through(points, int(left[one]), int(left[other]))
        run = consensus(points, free, line, params.epsilon, params.bridge, params.max_gap)
        if len(run) < fewest:
            continue
        found.note("best sample", run, line, check="min_points", value=votes, limit=fewest)
        if found.keep(run):
            failures = 0
        free[run] = False


def _through(points: Sequence, one: int, other: int) -> Line:
    a, b = float(points.y[one] - points.y[other]), float(points.x[other] - points.x[one])
    norm = float(np.hypot(a, b))
    c = -(a * float(points.x[one]) + b * float(points.y[one])) / norm
    return (a / norm, b / norm, c) if c <= 0 else (-a / norm, -b / norm, -c)


@entry_kernel
def best_pair(x, y, trials, reach, epsilon, state):
    """The positions of the pair, out of `trials` pairs, whose line has the most points nearer than ε, and their number.

    The second point of a pair is one of the `reach` points after the first; the last point is followed by the first.
    In a tie the pair drawn first wins. The number is −1 if all pairs coincide.
    """
    n = len(x)
    one, other, most = 0, 0, -1
    for _ in range(trials):
        i = below(n, state)
        j = (i + 1 + below(reach, state)) % n
        dx, dy = x[j] - x[i], y[j] - y[i]
        length = (dx * dx + dy * dy) ** 0.5
        if length > 0.0:
            votes = agreeing(x, y, x[i], y[i], dx / length, dy / length, epsilon)
            if votes > most:
                one, other, most = i, j, votes
    return one, other, most


@kernel
def agreeing(x, y, x0, y0, dx, dy, epsilon):
    """Number of points nearer than ε to the line through (x0, y0) in the direction (dx, dy)."""
    votes = 0
    for k in range(len(x)):
        votes += abs(dx * (y[k] - y0) - dy * (x[k] - x0)) < epsilon
    return votes


@kernel
def below(n, state):
    """A random whole number in 0..n − 1 by SplitMix64 (Steele, Lea, Flood 2014), the same on every machine.

    state: (1,) uint64.
    """
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return np.int64((z ^ (z >> np.uint64(31))) >> np.uint64(33)) % n


RANSAC = Method("ransac", VOCABULARY, find)
