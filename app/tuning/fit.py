"""What fits the laser of the recording on the screen: its noise, and thresholds that follow from it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording, Thresholds
from lineseg.noise import RangeNoise, noise
from lineseg.proposal import Proposal, propose

from ..told.answers import Fitted, Noise
from .kept import Kept

# Every change of a threshold asks again.
_kept_noise = Kept[RangeNoise](most=1)


def fit(recording: Recording, params: Thresholds, method: str, stop: NDArray[np.bool_]) -> Iterator[Fitted]:
    """Yield one answer. stop: (1,) bool, set it to end the work with `Cancelled`."""
    known = _kept_noise.get(recording, None, lambda: noise(recording))
    found = propose(recording, params, method, lambda: not stop[0], known)
    yield {
        "method": method,
        "fits": _changes(params, found),
        "better": found.changed,
        "text": found.text,
        "scatter": _number(found.scatter),
        "noise": _told(known, found.bend),
    }


def _changes(params: Thresholds, found: Proposal) -> dict[str, int | float]:
    """The values that fit, of the thresholds that depend on the noise, and others that differ."""
    if found.fitting is None:
        return {}
    values = found.fitting.numbers()
    present = params.numbers()
    follows = (name for name, _, knob in params.knobs() if present[name] and knob.scatter)
    return {name: values[name] for name in dict.fromkeys([*follows, *(n for n in values if values[n] != present[n])])}


def _told(found: RangeNoise, bend: float) -> Noise | None:
    if not found.known:
        return None
    return {
        "edges": [round(edge, 3) for edge in found.edges.tolist()],
        "sigma": [_number(sigma) for sigma in found.sigma.tolist()],
        "base": float(f"{found.base:.4g}"),
        "growth": float(f"{found.growth:.4g}"),
        "bend": _number(bend),
    }


def _number(value: float) -> float | None:
    """JSON has no NaN."""
    return float(f"{value:.4g}") if math.isfinite(value) else None
