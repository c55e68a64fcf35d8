"""`Params` in the form that the kernels take."""

from __future__ import annotations

from collections import namedtuple
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..kernel import kernel
from ..params import Params

# Each threshold of Params, under the same name.
Limits = namedtuple("Limits", Params.names())


def limits_of(params: Params) -> NDArray[np.float64]:
    """(len(Limits._fields),): the input of `unpacked`; numba takes an array faster than a tuple."""
    return np.array([getattr(params, name) for name in Limits._fields], dtype=np.float64)


def _from(kinds: tuple[type, ...], k: int = 0) -> Any:
    """A kernel that returns the tuple of values[k], values[k + 1], … as numbers of these kinds."""
    if not kinds:
        return kernel(lambda values: ())
    kind, others = kinds[0], _from(kinds[1:], k + 1)
    return kernel(lambda values: (kind(values[k]), *others(values)))


_numbers = _from(tuple(kind for _, kind, _ in Params.knobs()))


@kernel
def unpacked(limits):
    """`Limits` from an array of its fields."""
    return Limits(*_numbers(limits))


def _times(follows: tuple[bool, ...], k: int = 0) -> Any:
    """A kernel that returns limits[k], limits[k + 1], …, of which those that follow are multiplied by a factor."""
    if not follows:
        return kernel(lambda limits, times: ())
    others = _times(follows[1:], k + 1)
    if follows[0]:
        return kernel(lambda limits, times: (times * limits[k], *others(limits, times)))
    return kernel(lambda limits, times: (limits[k], *others(limits, times)))


_follow_the_noise = _times(tuple(knob.scatter > 0 or knob.growth > 0 for _, _, knob in Params.knobs()))


@kernel
def loosened(limits, times):
    """The limits with the thresholds that follow the noise (ε, at every range, and δ) multiplied by a factor."""
    return Limits(*_follow_the_noise(limits, times))


@kernel
def near(limits, square):
    """ε² at a point whose range has this square: constant noise plus noise in proportion to the range."""
    return limits.epsilon * limits.epsilon + limits.epsilon_growth * limits.epsilon_growth * square
