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
# The wall of a beam, and its true line, if nothing is known: it counts neither for nor against a segment.
UNKNOWN = -2


def true_lines(scan: Scan, params: Params | None = None, occlusion: float = OCCLUSION) -> NDArray[np.int32]:
    """For each beam its true line, −1 for none or UNKNOWN, for a scan with known walls. Lines are numbered from 0.

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
    return _runs_labelled(scan, params, occlusion, lambda share: (share >= 1.0 - SHORT) & (share < 1.0))


def _runs_labelled(
    scan: Scan,
    params: Params | None,
    occlusion: float,
    wanted: Callable[[NDArray[np.float64]], NDArray[np.bool_]],
) -> NDArray[np.int32]:
    """Numbers the visible runs whose share of P_min and L_min, whichever is smaller, is wanted."""
    need_scan(scan)
    if scan.wall is None:
        raise ValueError("this scan has no true walls; `wall` gives the wall of each beam")
    params = Params() if params is None else params
    need_thresholds(params, Params)
    labels = np.full(len(scan), -1, np.int32)
    beams, run, first, last = _visible_runs(scan, occlusion)
    length = np.hypot(*(scan.xy[last] - scan.xy[first]).T)
    share = np.bincount(run, minlength=len(first)) / params.min_points
    if params.min_length:
        share = np.minimum(share, length / params.min_length)
    kept = wanted(share)
    labels[beams] = np.where(kept, np.cumsum(kept) - 1, -1)[run]
    labels[scan.valid & (scan.wall == UNKNOWN)] = UNKNOWN
    return labels


def demands_of(params: Thresholds) -> Params:
    """P_min and L_min for true lines: those of the method, or the defaults if it has none."""
    asked = {name: value for name, value in params.numbers().items() if name in ("min_points", "min_length")}
    return Params().but(**asked)


def _visible_runs(scan: Scan, occlusion: float) -> tuple[NDArray[np.intp], ...]:
    """Beams that see a wall, wall by wall; the run of each; the first and the last beam of each run."""
    assert scan.wall is not None
    beams = np.flatnonzero(scan.valid & (scan.wall >= 0))
    beams = beams[np.argsort(scan.wall[beams], kind="stable")]
    starts = np.diff(scan.wall[beams], prepend=-1) != 0
    wall_first = np.flatnonzero(starts)
    wall_last = np.append(wall_first[1:], len(beams))[: len(wall_first)] - 1
    following = np.arange(1, len(beams) + 1)
    following[wall_last] = wall_first
    ahead = beams[following]
    steps = (ahead - beams) % (scan.around or len(scan))
    cut = (steps > 1) & (np.hypot(*(scan.xy[ahead] - scan.xy[beams]).T) > occlusion)
    if not scan.full_circle:
        cut[wall_last] = True
    begins = starts.copy()
    begins[following[cut]] = True
    run = np.cumsum(begins) - 1
    first, last = beams[begins], beams[np.roll(begins, -1)]
    # If a wall is not cut between its last beam and its first, its last run goes on as its first.
    head, tail = (run[ends][~cut[wall_last]] for ends in (wall_first, wall_last))
    first[head] = np.where(head == tail, first[head], first[tail])
    whole = np.arange(len(first))
    whole[tail] = head
    kept = whole == np.arange(len(first))
    return beams, (np.cumsum(kept) - 1)[whole[run]], first[kept], last[kept]


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
