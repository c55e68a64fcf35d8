"""Segments against true lines: matches of beam sets, TR and FR (Eqs. 9, 10), splits, merges, endpoint errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Self

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording, need_thresholds
from ..extractors import EXTRACTORS
from ..knobs import Thresholds
from ..scan import Recording
from ..segment import Extraction
from .lines import UNKNOWN, demands_of, near_lines, true_ends, true_lines


@dataclass(frozen=True)
class Agreement:
    """How well segments agree with true lines, in one frame, or in many by `+` or `of_all`.

    true_lines, segments, matches, splits, merges: counts; shared: sum of the intersections over union of the
    matches. endpoint_errors: two for each match [m]. neutral: number of segments on near lines, see `near_lines`.
    """

    true_lines: int = 0
    segments: int = 0
    matches: int = 0
    shared: float = 0.0
    splits: int = 0
    merges: int = 0
    endpoint_errors: tuple[float, ...] = ()
    neutral: int = 0

    def __add__(self, other: Self) -> Agreement:
        return Agreement.of_all((self, other))

    @classmethod
    def of_all(cls, parts: Iterable[Agreement]) -> Agreement:
        """The sum of all."""
        parts = list(parts)
        numbers = ("true_lines", "segments", "matches", "shared", "splits", "merges", "neutral")
        errors = tuple(chain.from_iterable(part.endpoint_errors for part in parts))
        return cls(**{name: sum(getattr(part, name) for part in parts) for name in numbers}, endpoint_errors=errors)

    @property
    def true_rate(self) -> float:
        """TR = matches / true lines (Eq. 9); NaN if there is no true line."""
        return self.matches / self.true_lines if self.true_lines else math.nan

    @property
    def false_rate(self) -> float:
        """FR = (segments − matches) / segments (Eq. 10); NaN if there is no segment."""
        return (self.segments - self.matches) / self.segments if self.segments else math.nan

    @property
    def neutral_false_rate(self) -> float:
        """FR without the neutral segments, which are neither right nor false; NaN if there is no other."""
        counted = self.segments - self.neutral
        return (counted - self.matches) / counted if counted else math.nan

    @property
    def completeness(self) -> float:
        """Mean intersection over union of the matches; NaN if there is none."""
        return self.shared / self.matches if self.matches else math.nan

    def endpoint_error(self, percent: float = 50.0) -> float:
        """This quantile of the endpoint errors of the matches [m]; NaN if there is no match."""
        return float(np.percentile(self.endpoint_errors, percent)) if self.endpoint_errors else math.nan


@dataclass(frozen=True, eq=False)
class Matching:
    """Matches the segments of a frame with its true lines.

    shared: (lines, segments) number of beams in common; line_beams, segment_beams: number of beams of each.
    endpoint_errors: (lines, 2) [m] from the ends of a true line to those of its match; NaN without a match.
    neutral: (segments,) whether a segment is neither right nor false, because it matches a near line or is `unknown`.
    unknown: (segments,) whether the truth is unknown for more than half of its beams; then it is not counted at all.
    """

    shared: NDArray[np.int64]
    line_beams: NDArray[np.int64]
    segment_beams: NDArray[np.int64]
    endpoint_errors: NDArray[np.float64]
    neutral: NDArray[np.bool_]
    unknown: NDArray[np.bool_]

    @cached_property
    def overlap(self) -> NDArray[np.float64]:
        """(lines, segments) intersection over union of their beams."""
        return _overlap(self.shared, self.line_beams, self.segment_beams)

    @cached_property
    def segment_of(self) -> NDArray[np.intp]:
        """(lines,) the segment that matches each true line, −1 for a missed one."""
        return _index_where(self.overlap > 0.5, axis=1)

    @cached_property
    def line_of(self) -> NDArray[np.intp]:
        """(segments,) the true line that each segment matches, −1 for a false one."""
        return _index_where(self.overlap > 0.5, axis=0)

    @cached_property
    def split(self) -> NDArray[np.bool_]:
        """(lines,) whether two or more segments have more than half of their beams on this line."""
        return (2 * self.shared > self.segment_beams).sum(axis=1) > 1

    @cached_property
    def merged(self) -> NDArray[np.bool_]:
        """(segments,) whether this segment holds more than half of the beams of two or more lines."""
        return (2 * self.shared > self.line_beams[:, None]).sum(axis=0) > 1

    @cached_property
    def agreement(self) -> Agreement:
        matched = self.overlap > 0.5
        errors = self.endpoint_errors[np.isfinite(self.endpoint_errors)]
        return Agreement(
            len(self.line_beams),
            int((~self.unknown).sum()),
            matches=int(matched.sum()),
            shared=float(self.overlap[matched].sum()),
            splits=int(self.split.sum()),
            merges=int(self.merged.sum()),
            endpoint_errors=tuple(errors.tolist()),
            neutral=int((self.neutral & ~self.unknown).sum()),
        )


def match(
    extraction: Extraction,
    truth: NDArray[np.integer],
    ends: NDArray[np.float64] | None = None,
    near: NDArray[np.integer] | None = None,
) -> Matching:
    """Segments and true lines (n,), as `true_lines` gives them, matched one to one.

    A segment matches a true line if the intersection over union of their beams is more than one half. Two segments
    share no beam, nor do two true lines, so no other can match either of them.
    ends: (lines, 2, 2) [m] the endpoints of the true lines, see `true_ends`; None: no endpoint errors.
    near: (n,) the lines that make a segment neutral instead of false, see `near_lines`; None: no segment is neutral.
    Beams whose truth is UNKNOWN are left out of all sets.
    """
    counts = _shared_beams(extraction, truth)
    known = counts[2]
    unknown = 2 * known < np.bincount(extraction.labels[extraction.labels >= 0], minlength=len(known))
    neutral = unknown.copy()
    if near is not None:
        neutral |= (_overlap(*_shared_beams(extraction, near)) > 0.5).any(axis=0)
    matching = Matching(*counts, np.full((len(counts[0]), 2), np.nan), neutral, unknown)
    if ends is not None:
        for line in np.flatnonzero(matching.segment_of >= 0):
            segment = extraction.segments[matching.segment_of[line]]
            matching.endpoint_errors[line] = _end_errors(np.array((segment.start, segment.end)), ends[line])
    return matching


def _shared_beams(
    extraction: Extraction, truth: NDArray[np.integer]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """(lines, segments) number of beams in common, and the number of beams of each line and of each segment.

    Unknown beams belong to no segment.
    """
    lines, segments = int(truth.max(initial=-1)) + 1, len(extraction.segments)
    both = (truth >= 0) & (extraction.labels >= 0)
    pairs = truth[both].astype(np.int64) * segments + extraction.labels[both]
    shared = np.bincount(pairs, minlength=lines * segments).reshape(lines, segments)
    line_beams = np.bincount(truth[truth >= 0], minlength=lines)
    known = (extraction.labels >= 0) & (truth != UNKNOWN)
    segment_beams = np.bincount(extraction.labels[known], minlength=segments)
    return shared, line_beams, segment_beams


def _overlap(
    shared: NDArray[np.int64], line_beams: NDArray[np.int64], segment_beams: NDArray[np.int64]
) -> NDArray[np.float64]:
    return shared / np.maximum(line_beams[:, None] + segment_beams - shared, 1)


def agreement(
    extraction: Extraction,
    truth: NDArray[np.integer],
    ends: NDArray[np.float64] | None = None,
    near: NDArray[np.integer] | None = None,
) -> Agreement:
    """How well the segments of one scan agree with its true lines. See `match` for which segment matches which.

    truth: (n,) int, the true line of each beam, −1 or UNKNOWN; ends: (lines, 2, 2) [m], see `true_ends`; near:
    (n,) int, see `near_lines`.
    """
    return match(extraction, truth, ends, near).agreement


def agreements(
    recording: Recording,
    params: Thresholds | None = None,
    method: str = "region-growing",
    truth: Callable[[int], NDArray[np.integer] | None] | None = None,
    ends: Callable[[int], NDArray[np.float64]] | None = None,
) -> Iterator[Agreement | None]:
    """How well a method agrees with the truth, frame by frame.

    truth: the true line of each beam of a frame, or None for a frame without labels; then no segment is neutral.
    Default: `true_lines` and `near_lines` with the method's P_min and L_min. ends: the endpoints of a frame's true
    lines; default: `true_ends`.
    """
    extractor = EXTRACTORS[method]
    need_recording(recording)
    params = extractor.params_type() if params is None else params
    need_thresholds(params, extractor.params_type)
    known = truth or (lambda frame: true_lines(recording[frame], demands_of(params)))
    for frame, scan in enumerate(recording):
        lines = known(frame)
        if lines is None:
            yield None
        else:
            known_ends = true_ends(scan, lines) if ends is None else ends(frame)
            near = near_lines(scan, demands_of(params)) if truth is None else None
            yield agreement(extractor.extract(scan, params), lines, known_ends, near)


def _index_where(table: NDArray[np.bool_], axis: int) -> NDArray[np.intp]:
    return np.where(table.any(axis), table.argmax(axis) if table.shape[axis] else 0, -1)


def _end_errors(found: NDArray[np.float64], true: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2,) distances of the two ends in the better pairing, because labels may be drawn from either end."""
    pairings = [np.hypot(*(ends - true).T) for ends in (found, found[::-1])]
    return min(pairings, key=np.sum)


def quality(found: float, false: float, completeness: float, recall: float = 1.0, power: float = 1.0) -> float:
    """One number in [0, 1] from TR, FR and completeness, higher is better; NaN if undefined.

    The mean F_β of TR and 1 − FR, where β is `recall`, times completeness to this power.
    """
    right = 1.0 - false
    if not np.isfinite(right):
        # Without segments nothing is found and nothing is false.
        return 0.0 if np.isfinite(found) else np.nan
    if found == 0.0 or right == 0.0:
        return 0.0
    beta = recall**2
    harmonic = (1 + beta) * found * right / (beta * right + found)
    return harmonic * completeness**power
