"""How long methods take for a frame, measured in turns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from time import perf_counter_ns

import numpy as np
from numpy.typing import NDArray

from ..extractors import Extractor
from ..knobs import Thresholds
from ..scan import Recording

ROUNDS = 3

Setting = tuple[Extractor, Thresholds]


def times_of(recording: Recording, frames: Sequence[int], settings: Sequence[Setting]) -> Iterator[NDArray[np.float64]]:
    """(settings,) [µs] of each frame in turn: the least of ROUNDS, since what else the machine does only ever adds.

    A frame is extracted by all methods before the next one is, so that drift of the machine meets all alike, each round
    in another order, so that none always follows one that has filled the caches. Every call gets a scan of its own, of
    which nothing is computed yet.
    """
    order = np.random.default_rng(ROUNDS)
    for method, params in settings:
        # Compiled, and its memory touched, before the clock runs.
        method.extract(recording[frames[0]], params)
    for frame in frames:
        times = np.full(len(settings), np.inf)
        for _ in range(ROUNDS):
            for k in order.permutation(len(settings)).tolist():
                times[k] = min(times[k], _time(recording, frame, *settings[k]))
        yield times


def _time(recording: Recording, frame: int, method: Extractor, params: Thresholds) -> float:
    scan = recording[frame]
    before = perf_counter_ns()
    method.extract(scan, params)
    return (perf_counter_ns() - before) / 1e3
