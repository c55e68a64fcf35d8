"""Why a map should not be trusted."""

from __future__ import annotations

import numpy as np

from ..many_views.checks import FARTHEST_STEP, TIMES_USUAL
from ..poses import Poses
from ..scan import Recording

# Of a building, map lines hold more of the returns.
LEAST_COVERED = 0.3
# A drive is longer [m].
SHORTEST_DRIVE = 0.5


def doubt(recording: Recording, poses: Poses, coverage: float) -> str:
    """Sentences about what is wrong with the poses or the surroundings; "" if nothing is."""
    known = np.flatnonzero(np.isfinite(poses).all(axis=1))
    places = np.asarray(poses, np.float64)[known, :2]
    told = []
    steps = np.hypot(*np.diff(places, axis=0).T) / np.diff(known)
    usual = float(np.median(steps[steps > 0.01])) if (steps > 0.01).any() else 0.0
    jumps = np.flatnonzero(steps > max(FARTHEST_STEP, TIMES_USUAL * usual))
    if len(jumps):
        first, last = (recording.number(int(known[jumps[0] + k])) for k in (0, 1))
        more = f", and {len(jumps) - 1} more times" if len(jumps) > 1 else ""
        told.append(
            f"The poses jump by {steps[jumps[0]]:.2f} m between frames {first} and {last}{more}: lines of before and "
            "after may lie beside each other."
        )
    if np.ptp(places, axis=0).max() < SHORTEST_DRIVE:
        told.append("The robot stands still, so the map shows one view, and says nothing of how well poses fit.")
    if not coverage >= LEAST_COVERED:
        told.append(
            f"Only {coverage:.0%} of the returns lie on lines: either there are few straight walls, or the thresholds "
            "or the poses do not fit the scans (poses of another clock, or of another laser)."
        )
    return " ".join(told)
