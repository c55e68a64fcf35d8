"""Times methods on the same frames, in alternation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from time import perf_counter_ns

import numpy as np
from numpy.typing import NDArray

from ..extractors import Extractor
from ..knobs import Thresholds
from ..scan import Recording

ROUNDS = 3

Timed = tuple[Extractor, Thresholds]


def times_of(recording: Recording, frames: Sequence[int], settings: Sequence[Timed]) -> Iterator[NDArray[np.float64]]:
    """(settings,) [µs] for each frame in turn: the minimum over ROUNDS, since other work of the machine only adds time.

    All methods run on a frame before the next frame, so drift of the machine affects all equally. The order changes
    each round, so no method always follows one that has filled the caches. Every call gets a fresh scan without cached
    values.
    """
    order = np.random.default_rng(ROUNDS)
    for method, params in settings:
        # Compile and touch the memory before timing.
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
