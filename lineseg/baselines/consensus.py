"""From a hypothesis to the points that agree with it; used by Hough transform and RANSAC."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .sequence import Line, Positions, Sequence, fit, runs

REFINEMENTS = 2


def consensus(
    points: Sequence, free: NDArray[np.bool_], line: Line, epsilon: float, bridge: int, max_gap: float
) -> Positions:
    """The longest run of `free` points nearer to the line than ε, after refitting the line once to the first such run.

    A hypothesis does not say where along the line the points are. Only the longest run is taken; other runs need
    hypotheses of their own. May be empty.
    """
    run = np.empty(0, np.intp)
    for _ in range(REFINEMENTS):
        members = free & (points.distances(line) < epsilon)
        run = max(runs(points, members, bridge, max_gap), key=len, default=np.empty(0, np.intp))
        if len(run) < 2:
            return run
        line = fit(points, run).line
    return run
