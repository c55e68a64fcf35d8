"""A line through a few points, for what is shown and said of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def fitted(xy: NDArray) -> tuple[float, float, float]:
    """(a, b, c) of the line ax + by + c = 0 through points (n, 2) [m], by total least squares (Eq. 2)."""
    middle = xy.mean(axis=0)
    # The normal is the direction in which the points scatter least.
    a, b = np.linalg.svd(xy - middle)[2][1].tolist()
    return a, b, float(-(a * middle[0] + b * middle[1]))
