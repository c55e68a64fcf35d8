"""Sums over frames, and the measures computed from them: sums of chunks can be added, measures cannot."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..doubt import SCORES

# Scores whose mean over frames is kept; the other scores are in COUNTS.
MEANS = ("rms", "splits", "gap", "misses", "change")
COUNTS = ("frames", "valid", "covered", "segments", "true_lines", "matches", "shared")
COLUMNS = COUNTS + MEANS
MEAN_COLUMNS = [list(SCORES).index(name) for name in MEANS]


@dataclass(frozen=True)
class Measure:
    """The name and meaning of a measure; truth: whether it needs true lines."""

    name: str
    label: str
    unit: str
    better: Literal["higher", "lower", "neither"]
    truth: bool
    help: str


MEASURES = {
    measure.name: measure
    for measure in [
        Measure("coverage", "coverage", "", "higher", False, "Share of the valid beams that belong to a segment."),
        Measure("segments", "segments", "", "neither", False, "Number of segments per frame."),
        Measure("true_rate", "TR", "", "higher", True, "True rate: matches / true lines (Eq. 9)."),
        Measure("false_rate", "FR", "", "lower", True, "False rate: segments without a match / segments (Eq. 10)."),
        Measure("completeness", "completeness", "", "higher", True, "Mean intersection over union of the matches."),
        Measure(
            "f_score", "F × completeness", "", "higher", True,
            "Harmonic mean of TR and 1 − FR, times completeness.",
        ),
        *(
            Measure(name, score.label, score.unit, "lower", False, f"Mean over the frames. {score.help}")
            for name, score in SCORES.items()
            if name in MEANS
        ),
    ]
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Totals:
    """Sums over frames: (…, len(COLUMNS)) float64; the measures have the leading shape, NaN if undefined.

    `+` combines the frames of both.
    """

    sums: NDArray[np.float64]

    def __add__(self, other: Totals) -> Totals:
        return Totals(self.sums + other.sums)

    def column(self, name: str) -> NDArray[np.float64]:
        return self.sums[..., COLUMNS.index(name)]

    @cached_property
    def has_truth(self) -> bool:
        return bool((self.column("true_lines") > 0).any())

    def measure(self, name: str) -> NDArray[np.float64]:
        """One of MEASURES."""
        matches, lines, segments = (self.column(part) for part in ("matches", "true_lines", "segments"))
        frames = self.column("frames")
        match name:
            case "coverage":
                return _ratio(self.column("covered"), self.column("valid"))
            case "segments":
                return _ratio(segments, frames)
            case "true_rate":
                return _ratio(matches, lines)
            case "false_rate":
                # Without truth, nothing counts as false.
                return np.where(lines > 0, _ratio(segments - matches, segments), np.nan)
            case "completeness":
                return _ratio(self.column("shared"), matches)
            case "f_score":
                # 2·TR·(1 − FR) / (TR + 1 − FR) = 2·matches / (lines + segments); times shared / matches.
                return np.where(lines > 0, _ratio(2.0 * self.column("shared"), lines + segments), np.nan)
        return _ratio(self.column(name), frames)


def _ratio(above: NDArray[np.float64], below: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.divide(above, below, out=np.full(np.shape(above), np.nan), where=below > 0)
