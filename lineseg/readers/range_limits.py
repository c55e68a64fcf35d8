"""Estimates the limit between returns and codes for "no return", for formats that do not state it reliably."""

from __future__ import annotations

import numpy as np

from ..scan import Floats

# SICK LMS2xx use the top of their number range for "no return"; real measurements end a little below.
# (longest measurement, lowest code, highest code), in metres
SICK_CODES = (
    (8.0, 8.18, 8.192),
    (16.0, 16.37, 16.384),
    (32.0, 32.75, 32.768),
    (50.0, 51.08, 51.2),
    (80.0, 81.8, 81.92),
)
ROUND_MAXIMA = (4.0, 5.6, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 32.0, 40.0, 50.0, 60.0, 80.0, 100.0)
FEW_CODES = 3
AT_ONCE = 1 << 20


def longest_return(ranges: Floats, announced: float | None = None) -> float:
    """A bound below which every range is a return, and no range from it on [m]; inf if the data show none.

    announced: the maximum stated by the file. It is used only if beyond it lie no values, or a few that recur, like
    codes; a robot's "laser max" may be a setting of its driver that real readings exceed.
    """
    greatest = float(ranges.max(initial=0.0))
    # Most files have numbers alone, and are not copied.
    finite = ranges if np.isfinite(greatest) else ranges[np.isfinite(ranges)]
    greatest = float(finite.max(initial=0.0)) if finite is not ranges else greatest
    for longest, lowest_code, highest_code in SICK_CODES:
        if lowest_code <= greatest <= highest_code and _recur(finite, lowest_code):
            return longest
    if announced is not None and announced > 0:
        return announced if len(_beyond(finite, announced)) <= FEW_CODES else np.inf
    if any(abs(greatest - each) <= 1e-6 for each in ROUND_MAXIMA) and _recur(finite, greatest):
        return greatest
    return np.inf


def _recur(ranges: Floats, least: float) -> bool:
    """Whether more than one range is as long as this."""
    return sum(int(np.count_nonzero(block >= least)) for block in _blocks(ranges)) > 1


def _beyond(ranges: Floats, least: float) -> Floats:
    """The different ranges from this on."""
    return np.unique(np.concatenate([np.unique(block[block >= least]) for block in _blocks(ranges)] or [ranges]))


def _blocks(ranges: Floats) -> list[Floats]:
    """Parts of long arrays, so that what is compared with them takes little memory."""
    return [ranges[start : start + AT_ONCE] for start in range(0, len(ranges), AT_ONCE)]
