"""Recordings from which no truth can be made, and how far a truth can be trusted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..posed.jumps import first_jump
from ..posed.returns import views_of
from ..poses import Poses
from ..scan import Recording
from .refining import MOST_SHIFT, MOST_TURN

# A drive passes through so many views or more.
LEAST_VIEWS = 6
# With less on walls than the first, there is no truth; with less than the second, it is not trusted.
LEAST_EXPLAINED, WELL_EXPLAINED = 0.25, 0.6
THICKEST, MOST_UNKNOWN = 0.05, 0.4
# In simulated drives, the worse of TR and FR of region growing and Split-and-Merge was off by 1 point (median), 4 (9th
# decile) and 16 (most) where walls were thinner [m], less was unknown and poses moved less [m]. Elsewhere, in 82 drives
# with exact poses or poses that were off by 3 cm and 0.5°, it was off by 4, 13 and 22.
THIN, LITTLE_UNKNOWN, SMALL_SHIFT = 0.018, 0.04, 0.020

Floats = NDArray[np.float64]


def check(recording: Recording) -> Poses:
    """The poses, if a truth can be made of them. Raises ValueError that says why not, and what helps."""
    name, poses = recording.name, recording.poses
    if poses is None:
        why = recording.pose_source.missing
        raise ValueError(
            f"{name} has no poses ({why}), so its scans cannot be put together; --poses FILE reads a trajectory."
        )
    known = np.flatnonzero(np.isfinite(poses).all(axis=1))
    places = np.asarray(poses, np.float64)[known]
    views = int(views_of(places).max()) + 1
    if views < LEAST_VIEWS:
        size = np.ptp(places[:, :2], axis=0).max()
        raise ValueError(
            f"{name}: the robot stands still, or nearly: its {len(known)} poses lie within {size:.2f} m. "
            f"What is a wall is seen by looking from {LEAST_VIEWS} or more places; take a recording of a drive."
        )
    jump = first_jump(recording, poses)
    if jump:
        raise ValueError(
            f"{name}: the poses jump: by {jump.length:.2f} m between frames {jump.before} and {jump.after}, where the "
            f"robot usually drives {jump.usual:.2f} m{f' ({jump.times} such jumps)' if jump.times > 1 else ''}. Take "
            "the frames before or after, or poses that were corrected."
        )
    return poses


def trust(
    name: str, thickness: float, explained: float, unknown: float, shift: Floats, turn: Floats
) -> tuple[bool, bool, str]:
    """Whether rates measured with a truth are likely near the exact ones, whether it is usable at all, and why.

    Raises ValueError if there are hardly any walls.
    """
    if explained < LEAST_EXPLAINED:
        raise ValueError(
            f"{name}: only {explained:.0%} of the returns lie on straight walls that several views agree on. "
            "Either there are no walls, or the poses do not fit the scans (of another clock, or another laser)."
        )
    bounded = float(np.mean((shift > 0.98 * MOST_SHIFT) | (turn > 0.98 * MOST_TURN)))
    reasons = []
    if thickness > THICKEST:
        reasons.append(f"walls are {1e3 * thickness:.0f} mm thick, more than {1e3 * THICKEST:.0f} mm")
    if explained < WELL_EXPLAINED:
        reasons.append(f"only {explained:.0%} of the returns lie on walls")
    if unknown > MOST_UNKNOWN:
        reasons.append(f"{unknown:.0%} of the returns are unknown")
    if bounded > 0.05:
        reasons.append(f"{bounded:.0%} of the poses needed the largest correction")
    if reasons:
        return False, False, f"Do not trust this truth: {'; '.join(reasons)}."
    near, reason = _expected(thickness, unknown, float(shift.max()))
    return near, True, reason


def _expected(thickness: float, unknown: float, shift: float) -> tuple[bool, str]:
    """Whether rates measured with such a truth are mostly near the exact ones, and how far off they were."""
    reasons = []
    if thickness >= THIN:
        reasons.append(f"walls are {1e3 * THIN:.0f} mm thick or thicker")
    if unknown >= LITTLE_UNKNOWN:
        reasons.append(f"{LITTLE_UNKNOWN:.0%} or more of the returns are unknown")
    if shift >= SMALL_SHIFT:
        reasons.append(f"a pose was corrected by {1e3 * SMALL_SHIFT:.0f} mm or more")
    measured = "TR and FR measured with such a truth were off by"
    if reasons:
        why = "; ".join(reasons)
        said = f"It is uncertain: {why}. In simulated worlds with this, {measured} 4 points (median)"
        return False, f"{said}, in one of ten by more than 13."
    said = f"The walls hold together. In simulated worlds with such walls, {measured} 1 point (median)"
    return True, f"{said}, in one of ten by more than 4."
