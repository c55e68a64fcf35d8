"""Splits frames into those for tuning and those for judging a method, and judges it on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from ..extractors import Extractor, extract
from ..knobs import Thresholds
from ..params import Params
from ..scan import Recording, Scan
from ..truth import Agreement, agreement, near_lines, true_ends, true_lines
from ..tuning.judge import judge_of
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


class Lines(NamedTuple):
    """Lines that should be found in a scan, see `match`."""

    labels: NDArray[np.int32]
    ends: NDArray[np.float64] | None = None
    near: NDArray[np.int32] | None = None


class Judge:
    """Scores methods on some scans, each with the lines that should be found, with P_min and L_min of the defaults.

    fitting: thresholds of region growing that fit the noise; None if they were not looked for.
    """

    def __init__(self, scans: Sequence[Scan], expected: Sequence[Lines], fitting: Params | None = None) -> None:
        self._scans, self._expected, self.fitting = scans, expected, fitting

    @classmethod
    def by_truth(cls, recording: Recording, frames: Sequence[int]) -> Self:
        """Compares with the true lines of these frames."""
        scans = [recording[frame] for frame in frames]
        labels = [true_lines(scan) for scan in scans]
        return cls(
            scans,
            [Lines(each, true_ends(scan, each), near_lines(scan)) for scan, each in zip(scans, labels, strict=True)],
        )

    @classmethod
    def blind(cls, recording: Recording, frames: Sequence[int]) -> Self:
        """Compares with the lines of `judge_of`, found from these frames alone. Raises ValueError if nothing fits."""
        part = recording.only(np.array(frames))
        judge, scans = judge_of(part), list(part)
        return cls(scans, [Lines(extract(scan, judge).labels) for scan in scans], judge)

    def agreement(self, method: Extractor, params: Thresholds, ends: bool = True) -> Agreement:
        """The agreement over all scans; ends: whether to compute endpoint errors, which takes time."""
        found = [method.extract(scan, params) for scan in self._scans]
        return Agreement.of_all(
            agreement(each, lines.labels, lines.ends if ends else None, lines.near)
            for each, lines in zip(found, self._expected, strict=True)
        )
