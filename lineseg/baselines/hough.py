"""Hough transform: every point votes for the lines through it, and the line with the most votes is taken.

Duda, Hart: *Use of the Hough transformation to detect lines and curves in pictures*, Communications of the ACM 15,
1972; for laser scans Pfister, Roumeliotis, Burdick: *Weighted line fitting algorithms for mobile robot map building and
efficient data representation*, ICRA 2003, as the first guess of a line, and Nguyen, Gächter, Martinelli, Tomatis,
Siegwart: *A comparison of line extraction algorithms using 2D range data for indoor mobile robotics*, Autonomous Robots
23, 2007.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..kernel import entry_kernel
from ..knobs import Knob, Thresholds
from ..tracing.vocabulary import Kind
from .consensus import consensus
from .found import Found, Method, vocabulary
from .knobs import BRIDGE, EPSILON, MAX_GAP, MIN_LENGTH, MIN_POINTS
from .sequence import Positions, Sequence

# Largest number of cells. Lasers with a very long range get coarser cells in ρ.
MOST_CELLS = 8_000_000
SPENT = np.iinfo(np.int32).min // 2


@dataclass(frozen=True)
class HoughParams(Thresholds):
    """Thresholds of the Hough transform."""

    epsilon: Annotated[float, EPSILON] = 0.03
    theta_step_deg: Annotated[
        float,
        Knob(
            "Δθ", 0.25, 10.0, "°", 0.25, log=True, least=0.05, most=45.0,
            label="step of the directions",
            why="a grid of finer steps would not fit into memory",
            help="Width of a cell in θ. Higher collects the votes of noisier lines, but finds shorter ones.",
        ),
    ] = 1.0  # fmt: skip
    rho_step: Annotated[
        float,
        Knob(
            "Δρ", 0.01, 0.5, "m", 0.01, log=True, least=0.001, most=10.0, scatter=1.5,
            label="step of the distances",
            why="a grid of finer steps would not fit into memory",
            help="Width of a cell in ρ. Higher collects the votes of noisier lines. Set it to a few times the range "
            "noise.",
        ),
    ] = 0.05  # fmt: skip
    min_votes: Annotated[
        int,
        Knob(
            "V_min", 3, 200, "", 1, least=2, most=100_000,
            label="votes of a line",
            why="a line needs at least 2 points",
            help="Fewest votes for a cell to become a line. Higher finds fewer lines.",
        ),
    ] = 10  # fmt: skip
    bridge: Annotated[int, BRIDGE] = 3
    max_gap: Annotated[float, MAX_GAP] = 0.5
    min_points: Annotated[int, MIN_POINTS] = 10
    min_length: Annotated[float, MIN_LENGTH] = 0.6


VOCABULARY = vocabulary(
    "peaks",
    ("min_votes",),
    Kind(
        "peak found", "peaks", "shown", "seed",
        "peak found: {value:g} points vote for this line, V_min = {limit:g}; the longest run along it is {span}",
    ),
)  # fmt: skip


class Grid:
    """votes: (angles, cells) int32 of the lines x·cos θ + y·sin θ = ρ, 0 ≤ θ < π, |ρ| as far as the points reach."""

    def __init__(self, points: Sequence, params: HoughParams) -> None:
        angles = np.arange(0.0, 180.0 - 1e-9, params.theta_step_deg)
        farthest = float(np.hypot(points.x, points.y).max())
        self.step = max(params.rho_step, 2 * farthest * len(angles) / MOST_CELLS)
        self.middle = math.ceil(farthest / self.step) + 1
        self.cosines, self.sines = np.cos(np.radians(angles)), np.sin(np.radians(angles))
        self.votes = np.zeros((len(angles), 2 * self.middle + 1), np.int32)

    def count(self, points: Sequence, run: Positions, weight: int) -> None:
        """Add or remove the votes of some points."""
        x, y = points.x[run], points.y[run]
        vote(x, y, self.cosines, self.sines, self.middle, self.step, self.votes, weight)

    def peak(self) -> tuple[int, int]:
        """The cell with the most votes; the first one in a tie."""
        angle, cell = divmod(int(np.argmax(self.votes)), self.votes.shape[1])
        return angle, cell


def find(points: Sequence, params: HoughParams, found: Found) -> None:
    """For each peak, remove the longest run of points along it and their votes, whether or not it makes a segment."""
    free = np.ones(len(points.x), bool)
    grid = Grid(points, params)
    grid.count(points, np.arange(len(points.x)), 1)
    while True:
        angle, cell = grid.peak()
        votes = int(grid.votes[angle, cell])
        if votes < params.min_votes:
            return
        line = grid.cosines[angle], grid.sines[angle], -(cell - grid.middle) * grid.step
        run = consensus(points, free, line, params.epsilon, params.bridge, params.max_gap)
        if len(run) < 2:
            # The voters are too far apart to make a run, but may still belong to other lines.
            grid.votes[angle, cell] = SPENT
            continue
        found.note("peak found", run, line, check="min_votes", value=votes, limit=params.min_votes)
        found.keep(run)
        free[run] = False
        grid.count(points, run, -1)


@entry_kernel
def vote(x, y, cosines, sines, middle, step, votes, weight):
    """Add `weight` to the cells of all lines through each point; `middle` is the cell of ρ = 0."""
    for i in range(len(cosines)):
        for k in range(len(x)):
            votes[i, math.floor((x[k] * cosines[i] + y[k] * sines[i]) / step + 0.5) + middle] += weight


HOUGH = Method("hough", VOCABULARY, find)
