"""The totals of some frames for many settings: prepared once, extracted for each setting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..doubt import SCORES
from ..extractors import extract
from ..kernel import entry_kernel
from ..params import Params
from ..readers.source import Cancelled
from ..scan import Recording, are_valid
from ..survey.stretch import Stretch, Workspace, flattened
from ..truth import UNKNOWN, true_lines
from .totals import COLUMNS, COUNTS, MEAN_COLUMNS, Totals

SEGMENTS = COUNTS.index("segments")
LINES = slice(COUNTS.index("true_lines"), COUNTS.index("shared") + 1)


@dataclass(frozen=True, eq=False)
class Truth:
    """The true lines of some frames.

    labels: (total,) int32 line of each beam, −1 for none or UNKNOWN, numbered from 0 in each frame; sizes: number of
    beams of each line, frame after frame; offsets: (frames + 1,) where the lines of each frame start in `sizes`.
    """

    labels: NDArray[np.int32]
    sizes: NDArray[np.int64]
    offsets: NDArray[np.int64]

    @classmethod
    def of(cls, recording: Recording) -> Truth | None:
        """The `true_lines` for the paper's P_min and L_min, whatever is being tried; None if the truth is unknown.

        With the tried thresholds, a larger L_min would remove the difficult true lines and be rewarded for it.
        """
        if recording.wall is None:
            return None
        return cls._of_lines([true_lines(scan, Params()) for scan in recording])

    @classmethod
    def found_by(cls, judge: Params, recording: Recording) -> Truth:
        """The lines that region growing finds with this setting."""
        return cls._of_lines([extract(scan, judge).labels for scan in recording])

    @classmethod
    def _of_lines(cls, labels: Sequence[NDArray[np.integer]]) -> Truth:
        """labels: for each frame and beam its line, or −1."""
        sizes = [np.bincount(frame[frame >= 0]) for frame in labels]
        counts = np.array([len(frame) for frame in sizes], dtype=np.int64)
        return cls(
            np.concatenate(labels).astype(np.int32) if labels else np.empty(0, np.int32),
            np.concatenate(sizes).astype(np.int64) if labels else np.empty(0, np.int64),
            np.concatenate(([0], np.cumsum(counts))),
        )


class Batch:
    """Frames of one recording, prepared for measuring many settings; may be used by several threads at once.

    scored: whether to compute the label-free scores that cost more than the extraction (totals.MEANS).
    lead: whether the first frame is only used for comparison and not counted.
    judge: a setting whose lines stand in for the truth.
    """

    def __init__(self, recording: Recording, scored: bool, lead: bool = False, judge: Params | None = None) -> None:
        self._first = int(lead)
        self._frames, self._beams = len(recording), recording.beams[1]
        self._scored = scored
        self._flat = flattened(recording)
        self._truth = Truth.of(recording) if judge is None else Truth.found_by(judge, recording)
        self._stretch = Stretch(recording, self._flat, self._first, self._frames, compared=scored)
        counted = slice(self._flat.offsets[self._first], self._flat.offsets[-1])
        near, far = (
            np.repeat(limit[self._first :], np.diff(self._flat.offsets)[self._first :])
            for limit in (self._flat.range_min, self._flat.range_max)
        )
        self._valid = int(np.count_nonzero(are_valid(self._flat.ranges[counted], near, far)))

    def measure(self, settings: Sequence[Params], cancelled: NDArray[np.bool_] | None = None) -> Totals:
        """The totals of each setting; cancelled: (1,) bool, set it in another thread to stop with `Cancelled`."""
        flag = np.zeros(1, np.bool_) if cancelled is None else cancelled
        memory, tally = Workspace(self._beams), np.zeros(self._beams + 1, np.int64)
        counts = np.zeros(self._frames, np.int64)
        scores = np.zeros((self._frames, len(SCORES)), np.float32) if self._scored else None
        sums = np.zeros((len(settings), len(COLUMNS)))
        for row, params in zip(sums, settings, strict=True):
            segments = self._stretch.run(params, memory, flag, counts, scores)
            if flag[0]:
                raise Cancelled("the sweep was stopped")
            row[: len(COUNTS)] = (
                self._frames - self._first,
                self._valid,
                segments["points"].sum(),
                len(segments),
                0,
                0,
                0,
            )
            if scores is not None:
                row[len(COUNTS) :] = scores[self._first :, MEAN_COLUMNS].sum(axis=0, dtype=np.float64)
            else:
                row[len(COUNTS) :] = np.nan
            if self._truth is not None:
                *lines, known = self._agreement(self._truth, segments, counts, tally)
                row[LINES], row[SEGMENTS] = lines, known
        return Totals(sums)

    def _agreement(
        self, truth: Truth, segments: NDArray[np.void], counts: NDArray[np.int64], tally: NDArray[np.int64]
    ) -> tuple[float, float, float, float]:
        """(true lines, matches, Σ of their intersections over union, segments whose truth is known)."""
        lines = truth.labels, truth.sizes, truth.offsets
        found = count_matches(segments, counts, self._first, self._flat.offsets, *lines, tally)
        return float(truth.offsets[-1] - truth.offsets[self._first]), *found


@entry_kernel
def count_matches(segments, counts, first, offsets, labels, sizes, places, tally):
    """(matches, Σ of their intersections over union, known segments) of the frames from `first`, see `truth.match`.

    tally: (beams,) zeros, and zeros again afterwards.
    """
    matches, shared, used, known = 0, 0.0, 0, 0
    for frame in range(first, len(counts)):
        start, beams = offsets[frame], offsets[frame + 1] - offsets[frame]
        for i in range(used, used + counts[frame]):
            length = (segments[i].last - segments[i].first) % beams + 1
            most = line = -1
            unknown = 0
            for k in range(length):
                label = labels[start + (segments[i].first + k) % beams]
                if label >= 0:
                    tally[label] += 1
                    if tally[label] > most:
                        most, line = tally[label], label
                elif label == UNKNOWN:
                    unknown += 1
            for k in range(length):
                label = labels[start + (segments[i].first + k) % beams]
                if label >= 0:
                    tally[label] = 0
            points = segments[i].points - unknown
            known += 2 * points >= segments[i].points
            if line >= 0:
                union = points + sizes[places[frame] + line] - most
                if 2 * most > union:
                    matches += 1
                    shared += most / union
        used += counts[frame]
    return matches, shared, known
