"""The predicted point P′ of a beam: where it meets the fitted line (Eqs. 4–6). P and P′ lie on one beam."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..kernel import kernel
from ..total_least_squares import signed_distance


@kernel
def predicted_distance(x, y, line):
    """|ρ − ρ′| of P = (x, y) [m]; infinite where the beam is parallel to the line. `fails` asks the same, squared."""
    a, b, _ = line
    along = abs(a * x + b * y)
    d = abs(signed_distance(line, x, y))
    return d * math.hypot(x, y) / along if along > 0.0 else math.inf


def predicted_ranges(line: tuple[ArrayLike, ArrayLike, ArrayLike], rays: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) ρ′ [m] of the beams along rays (2, n); negative if a beam points away from the line, ±inf if parallel.

    line: (a, b, c), one for all beams or (n,) one each.
    """
    a, b, c = map(np.asarray, line)
    with np.errstate(divide="ignore", invalid="ignore"):
        return -c / (a * rays[0] + b * rays[1])
