"""True lines of a scan whose walls are known, and their ends."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_scan, need_thresholds
from ..knobs import Thresholds
from ..params import Params
from ..scan import Scan

OCCLUSION = 0.3
# Share of P_min or L_min by which a wall may miss it and still make a segment on it neutral.
SHORT = 0.3


def true_lines(scan: Scan, params: Params | None = None, occlusion: float = OCCLUSION) -> NDArray[np.int32]:
    """For each beam its true line, or −1, for a scan with known walls. Lines are numbered from 0.

    A true line is a visible run of one wall with at least P_min valid beams and at least L_min between its outermost
    points. A run is cut between two of its beams if other beams, of another wall or without a return, lie between them
    and their points are more than `occlusion` apart [m]; a thinner chair leg or a few lost beams do not cut it.
    On a full circle a run may cross the seam, where beams may be missing. Raises ValueError if the walls are not known.
    """
    return _runs_labelled(scan, params, occlusion, lambda share: share >= 1.0)


def near_lines(scan: Scan, params: Params | None = None, occlusion: float = OCCLUSION) -> NDArray[np.int32]:
    """For each beam its near line, or −1: a visible run that misses P_min or L_min by at most 30 %.

    Such a run is no true line, but whoever finds a segment there is not wrong either. Otherwise as `true_lines`.
    """
    return _runs_labelled(scan, params, occlusion, lambda share: 1.0 - SHORT <= share < 1.0)


def _runs_labelled(
    scan: Scan, params: Params | None, occlusion: float, wanted: Callable[[float], bool]
) -> NDArray[np.int32]:
    """Numbers the visible runs whose share of P_min and L_min, whichever is smaller, is wanted."""
    need_scan(scan)
    if scan.wall is None:
        raise ValueError("this scan has no true walls; `wall` gives the wall of each beam")
    params = Params() if params is None else params
    need_thresholds(params, Params)
    labels = np.full(len(scan), -1, np.int32)
    found = 0
    for wall in np.unique(scan.wall[scan.valid & (scan.wall >= 0)]):
        for run in _visible_runs(scan, np.flatnonzero(scan.valid & (scan.wall == wall)), occlusion):
            length = float(np.hypot(*(scan.xy[run[-1]] - scan.xy[run[0]])))
            share = min(len(run) / params.min_points, length / params.min_length if params.min_length else math.inf)
            if wanted(share):
                labels[run] = found
                found += 1
    return labels


def demands_of(params: Thresholds) -> Params:
    """P_min and L_min for true lines: those of the method, or the defaults if it has none."""
    asked = {name: value for name, value in params.numbers().items() if name in ("min_points", "min_length")}
    return Params().but(**asked)


def _visible_runs(scan: Scan, beams: NDArray[np.intp], occlusion: float) -> list[NDArray[np.intp]]:
    ahead = np.roll(beams, -1)
    steps = (ahead - beams) % (scan.around or len(scan))
    cut = (steps > 1) & (np.hypot(*(scan.xy[ahead] - scan.xy[beams]).T) > occlusion)
    if not scan.full_circle:
        cut[-1] = True
    if not cut.any():
        return [beams]
    first = int(np.flatnonzero(cut)[-1]) + 1
    return np.split(np.roll(beams, -first), np.flatnonzero(np.roll(cut, -first))[:-1] + 1)


def true_ends(scan: Scan, truth: NDArray[np.integer]) -> NDArray[np.float64]:
    """(lines, 2, 2) [m]: for each true line its outermost points, projected on the line fitted to all its points.

    With many beams on a wall this is more accurate than any single measured point. NaN for a line without a return.
    """
    ends = np.full((int(truth.max(initial=-1)) + 1, 2, 2), np.nan)
    for line in range(len(ends)):
        beams = np.flatnonzero((truth == line) & scan.valid)
        if len(beams):
            ends[line] = _projected_ends(scan.xy[_along(scan, beams)])
    return ends


def _along(scan: Scan, beams: NDArray[np.intp]) -> NDArray[np.intp]:
    """The beams of one line in order. On a full circle they may cross the seam: they start after the widest step."""
    if not scan.full_circle:
        return beams
    return np.roll(beams, -int(np.argmax((beams - np.roll(beams, 1)) % scan.around)))


def _projected_ends(xy: NDArray[np.float64]) -> NDArray[np.float64]:
    """Endpoints as in Eqs. 7 and 8."""
    mean = xy.mean(axis=0)
    (xx, cross), (_, yy) = (xy - mean).T @ (xy - mean)
    angle = 0.5 * math.atan2(2 * cross, xx - yy)
    along = np.array((math.cos(angle), math.sin(angle)))
    return mean + ((xy[[0, -1]] - mean) @ along)[:, None] * along
