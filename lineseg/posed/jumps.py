"""Where the poses of a recording jump farther than a robot drives."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..poses import Poses
from ..scan import Recording

# Between two scans a robot drives no farther than this [m], or than so many times its usual step.
FARTHEST_STEP, TIMES_USUAL = 1.0, 5.0


class Jump(NamedTuple):
    """The first jump of the poses: how far [m], and between which frames of the file.

    usual: the usual step between two scans [m]; times: how many jumps there are.
    """

    length: float
    before: int
    after: int
    usual: float
    times: int


def first_jump(recording: Recording, poses: Poses) -> Jump | None:
    """Where poses (frames, 3) first jump farther than a robot drives; None if they never do."""
    known = np.flatnonzero(np.isfinite(poses).all(axis=1))
    steps = np.hypot(*np.diff(np.asarray(poses, np.float64)[known, :2], axis=0).T) / np.diff(known)
    usual = float(np.median(steps[steps > 0.01])) if (steps > 0.01).any() else 0.0
    jumps = np.flatnonzero(steps > max(FARTHEST_STEP, TIMES_USUAL * usual))
    if not len(jumps):
        return None
    before, after = (recording.number(int(known[jumps[0] + k])) for k in (0, 1))
    return Jump(float(steps[jumps[0]]), before, after, usual, len(jumps))
