"""What fits the laser of the recording on the screen: its noise, and thresholds that follow from it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording, Thresholds
from lineseg.noise import RangeNoise
from lineseg.tuning.proposal import Proposal, propose

from ..told.answers import Fitted, Noise


def fit(recording: Recording, params: Thresholds, method: str, stop: NDArray[np.bool_]) -> Iterator[Fitted]:
    """Yield one answer. stop: (1,) bool, set it to end the work with `Cancelled`."""
    found = propose(recording, params, method, lambda: not stop[0])
    yield {
        "method": method,
        "fits": _changes(params, found),
        "better": found.changed,
        "text": found.text,
        "scatter": _number(found.scatter),
        "noise": _noise(found.noise),
    }


def _changes(params: Thresholds, found: Proposal) -> dict[str, int | float]:
    """The values that fit, of the thresholds that depend on the noise, and others that differ."""
    if found.fitting is None:
        return {}
    values = found.fitting.numbers()
    present = params.numbers()
    follows = (name for name, _, knob in params.knobs() if present[name] and knob.scatter)
    return {name: values[name] for name in dict.fromkeys([*follows, *(n for n in values if values[n] != present[n])])}


def _noise(noise: RangeNoise) -> Noise | None:
    if not noise.known:
        return None
    return {
        "edges": [round(edge, 3) for edge in noise.edges.tolist()],
        "sigma": [_number(sigma) for sigma in noise.sigma.tolist()],
        "base": float(f"{noise.base:.4g}"),
        "growth": float(f"{noise.growth:.4g}"),
        "rough": float(f"{noise.roughness:.4g}"),
        "roughOver": float(noise.lengths[np.nanargmax(noise.rough)]) if noise.roughness else 0.0,
    }


def _number(value: float) -> float | None:
    """JSON has no NaN."""
    return float(f"{value:.4g}") if math.isfinite(value) else None
