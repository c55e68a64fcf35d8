"""The result of a baseline: runs of points that become segments or are dropped, and its decisions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..region_growing.checks import CHECKS, MIN_LENGTH, MIN_POINTS
from ..scan import Scan
from ..segment import Dropped, Extraction, Segment
from ..tracing.decisions import Trace
from ..tracing.log import NO_ENDS, ROW, Row
from ..tracing.vocabulary import Check, Kind, Vocabulary
from .sequence import Line, Positions, Sequence, fit, sequence_of

NOWHERE: Line = (0.0, 0.0, 0.0)
KEPT, DROPPED = "line kept", "line dropped"


def vocabulary(phase: str, checks: tuple[str, ...], *kinds: Kind) -> Vocabulary:
    """The kinds of a baseline plus the common ones: line kept, and line dropped for its points or its length.

    phase: the phase that keeps or drops a line.
    """
    kept = Kind(
        KEPT, phase, "stands", "line", "line kept: {span}, {points} points, {value:.3f} m ≥ L_min = {limit:.3f} m"
    )
    dropped = Kind(DROPPED, phase, "gone", "drop", "line dropped: {span}; {refusal}")
    own = (Check(""), *map(Check, checks), CHECKS[MIN_POINTS], CHECKS[MIN_LENGTH])
    return Vocabulary((*kinds, kept, dropped), own)


class Method(NamedTuple):
    """find: looks for lines in a `Sequence` of 2 points or more and adds each to `Found`."""

    name: str
    vocabulary: Vocabulary
    find: Callable[[Sequence, Any, Found], None]

    def extract(self, scan: Scan, params: Any) -> Extraction:
        """The segments of one scan."""
        return self._run(scan, params, traced=False).extraction(self.name, len(scan))

    def trace(self, scan: Scan, params: Any) -> Trace:
        """The same run with its decisions."""
        found = self._run(scan, params, traced=True)
        # On a full circle a line may continue from the last point to the first.
        positions = np.concatenate((found.points.beam, found.points.beam))
        extraction = found.extraction(self.name, len(scan))
        return Trace(scan, params, extraction, self.vocabulary, np.array(found.rows, ROW), positions)

    def _run(self, scan: Scan, params: Any, traced: bool) -> Found:
        found = Found(sequence_of(scan), params, self.vocabulary, traced)
        if len(found.points.x) >= 2:
            self.find(found.points, params, found)
        return found


class Found:
    """The lines of one run of a method; params has min_points and min_length.

    rows: of the log; traced: whether to write them; candidates: number of lines noted so far.
    """

    def __init__(self, points: Sequence, params: Any, vocabulary: Vocabulary, traced: bool) -> None:
        self.points = points
        self.params = params
        self.traced = traced
        self.rows: list[Row] = []
        self._vocabulary = vocabulary
        self._segments: list[tuple[Segment, NDArray[np.intp]]] = []
        self._dropped: list[Dropped] = []
        self.candidates = 0

    def keep(self, run: Positions, candidate: int | None = None) -> bool:
        """Whether the run has P_min points and a length of L_min, and becomes a segment.

        candidate: its number in the log; the next free one if None.
        """
        beams, count = self.points.beam[run], len(run)
        first, last = int(beams[0]), int(beams[-1])
        line, start, end, length, rms = fit(self.points, run) if count > 1 else (NOWHERE, (0, 0), (0, 0), 0.0, 0.0)
        check, value, limit = self._shortfall(count, length)
        self.note(DROPPED if check else KEPT, run, line, candidate=candidate, check=check, value=value, limit=limit)
        self.candidates += 1
        if check:
            self._dropped.append(Dropped(first, last, count, length, check, value, limit))
        else:
            self._segments.append((Segment(line, start, end, first, last, count, length, rms), beams))
        return not check

    def note(
        self,
        kind: str,
        run: Positions,
        line: Line = NOWHERE,
        *,
        candidate: int | None = None,
        partner: int = -1,
        other: Line = NOWHERE,
        beam: int = -1,
        check: str = "",
        value: float = 0.0,
        limit: float = 0.0,
    ) -> None:
        """Write down a decision about the next candidate, or the one named; `run` and `beam` are positions."""
        if not self.traced:
            return
        number, why = self._vocabulary.names.index(kind), self._vocabulary.check_names.index(check)
        candidate = self.candidates if candidate is None else candidate
        first, last = int(run[0]), int(run[-1])
        last += len(self.points.x) if last < first else 0
        row = Row(number, why, 0, candidate, partner, first, last, beam, line, other, NO_ENDS, value, limit)
        self.rows.append(row)

    def extraction(self, method: str, beams: int) -> Extraction:
        """Segments in the order of their first beam."""
        self._segments.sort(key=lambda pair: pair[0].first)
        labels = np.full(beams, -1, np.int32)
        for label, (_, own) in enumerate(self._segments):
            labels[own] = label
        segments = tuple(segment for segment, _ in self._segments)
        return Extraction(method, self.params, segments, labels, tuple(self._dropped))

    def _shortfall(self, count: int, length: float) -> tuple[str, float, float]:
        """(check, value, limit) of the requirement that a line fails, P_min first; check "" if it meets both."""
        if count < max(self.params.min_points, 2):
            return "min_points", float(count), float(self.params.min_points)
        # Not `<`: the length is NaN for points too close together to have a direction.
        return "" if length >= self.params.min_length else "min_length", length, self.params.min_length
