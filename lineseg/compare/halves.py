"""Splits frames into those for tuning and those for judging a method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..extractors import Extractor
from ..knobs import Thresholds
from ..scan import Recording
from ..truth import Agreement, agreement, true_ends, true_lines
from ..tuning.parts import BLOCKS, stretches


class Halves(NamedTuple):
    """Numbers of frames; no frame is in both."""

    training: list[int]
    judged: list[int]


def halves(frames: int, most: int | None = None) -> Halves:
    """Alternating stretches out of BLOCKS, since neighbouring frames are alike, with at most `most` frames in total.

    Raises ValueError for fewer than four frames.
    """
    if most is not None and most < 4:
        raise ValueError(f"{most} frames are too few for a comparison; take 4 or more, for tuning and for judging")
    if frames < 4:
        raise ValueError(f"has {frames} frames; a comparison needs 4 or more, for tuning and for judging")
    spans = stretches(frames, BLOCKS if most is None else min(BLOCKS, most // 2), None)
    share = max(most // len(spans), 1) if most is not None else frames
    parts = [_spread(start, stop, share) for start, stop in spans]
    return Halves([f for part in parts[::2] for f in part], [f for part in parts[1::2] for f in part])


def _spread(start: int, stop: int, most: int) -> list[int]:
    """At most `count` of start..stop − 1, spread evenly."""
    count = min(most, stop - start)
    return np.unique((start + (np.arange(count) + 0.5) * (stop - start) / count).astype(int)).tolist()


class Judge:
    """True lines of some frames, found once, with the default P_min and L_min for every method."""

    def __init__(self, recording: Recording, frames: Sequence[int]) -> None:
        self._scans = [recording[frame] for frame in frames]
        self._truths = [true_lines(scan) for scan in self._scans]
        self._ends = [true_ends(scan, truth) for scan, truth in zip(self._scans, self._truths, strict=True)]

    def agreement(self, method: Extractor, params: Thresholds, ends: bool = True) -> Agreement:
        """The agreement over all frames; ends: whether to compute endpoint errors, which takes time."""
        each = zip(self._scans, self._truths, self._ends, strict=True)
        return Agreement.of_all(
            agreement(method.extract(scan, params), truth, true if ends else None) for scan, truth, true in each
        )
