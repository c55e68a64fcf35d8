"""From a guessed line to the points that agree with it: what Hough transform and RANSAC do with their hypotheses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .sequence import Line, Positions, Sequence, fit, runs

REFINEMENTS = 2


def consensus(
    points: Sequence, free: NDArray[np.bool_], line: Line, epsilon: float, bridge: int, max_gap: float
) -> Positions:
    """The longest run of `free` points nearer to the line than ε, the line fitted to it and the run sought once more.

    A guess says nothing about where on its line the points are: of the runs along it one is taken, and the others
    wait until they are guessed themselves. Possibly empty.
    """
    run = np.empty(0, np.intp)
    for _ in range(REFINEMENTS):
        members = free & (points.distances(line) < epsilon)
        run = max(runs(points, members, bridge, max_gap), key=len, default=np.empty(0, np.intp))
        if len(run) < 2:
            return run
        line = fit(points, run).line
    return run
