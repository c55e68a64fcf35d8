"""The noise of the beams, as flags give it."""

from __future__ import annotations

from lineseg.covariance import Noise


def noise_of(range_noise: float | None, bearing_noise: float | None) -> Noise | None:
    """None if neither is given."""
    if range_noise is None and bearing_noise is None:
        return None
    return Noise(range_noise or 0.0, bearing_noise or 0.0)
