"""The unit of time stamps that do not say it."""

from __future__ import annotations

import numpy as np

from ..scan import Floats

UNITS = (1.0, 1e-3, 1e-6, 1e-9)
# From 2001 to 2065.
CENTURY = (1e9, 3e9)
USUAL = 0.1  # between scans


def stamp_unit(stamps: Floats) -> float:
    """The unit that puts stamps into this century, or else scans about a tenth of a second apart [s]."""
    middle = float(np.median(np.abs(stamps)))
    for unit in UNITS:
        if CENTURY[0] <= middle * unit <= CENTURY[1]:
            return unit
    steps = np.abs(np.diff(stamps))
    step = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    if not step > 0 or step <= 5:
        return 1.0
    return min(UNITS, key=lambda unit: abs(np.log(step * unit / USUAL)))
