"""Why a map should not be trusted."""

from __future__ import annotations

import numpy as np

from ..posed.jumps import first_jump
from ..poses import Poses
from ..scan import Recording

# Of a building, map lines hold more of the returns.
LEAST_COVERED = 0.3
# A drive is longer [m].
SHORTEST_DRIVE = 0.5


def doubt(recording: Recording, poses: Poses, coverage: float) -> str:
    """Sentences about what is wrong with the poses or the surroundings; "" if nothing is."""
    told = []
    jump = first_jump(recording, poses)
    if jump:
        more = f", and {jump.times - 1} more times" if jump.times > 1 else ""
        told.append(
            f"The poses jump by {jump.length:.2f} m between frames {jump.before} and {jump.after}{more}: lines of "
            "before and after may lie beside each other."
        )
    if np.ptp(poses[np.isfinite(poses).all(axis=1), :2], axis=0).max() < SHORTEST_DRIVE:
        told.append("The robot stands still, so the map shows one view, and says nothing of how well poses fit.")
    if not coverage >= LEAST_COVERED:
        told.append(
            f"Only {coverage:.0%} of the returns lie on lines: either there are few straight walls, or the thresholds "
            "or the poses do not fit the scans (poses of another clock, or of another laser)."
        )
    return " ".join(told)
