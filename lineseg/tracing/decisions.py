"""All decisions of one run of a method, in order, as the page replays them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scan import Scan
from ..segment import Extraction
from .log import Ends, Line, Row
from .vocabulary import Effect, Sentence, Vocabulary, metres

# Decisions made together when a trace is gone through.
AT_ONCE = 1000


@dataclass(frozen=True)
class Decision:
    """One decision, with the line, the measured value and the limit at that moment.

    kind, phase: from the method's vocabulary. candidate: number of the line from 0 (in region growing, of the growth);
    partner: the other line of a merge or cut, else −1. direction: +1 forward, −1 backward, 0 neither. first, last:
    beams of the tested window, or of the line after the decision; beam: the tested beam, or −1. line: (a, b, c), the
    line it was compared with; other: the partner's line, for merges and cuts.
    check: the threshold; "" if nothing was compared, "end" at the end of the scan. value, limit: the compared numbers;
    both are the length when endpoints are placed.
    ends: both endpoints (x1, y1, x2, y2), only when they are placed.
    """

    index: int
    kind: str
    phase: str
    candidate: int
    partner: int
    direction: int
    first: int
    last: int
    beam: int
    points: int
    line: Line
    other: Line | None
    check: str
    value: float
    limit: float
    ends: Ends | None
    text: str


@dataclass(frozen=True)
class TracedLine:
    """A line after some decision; `growing` until it is accepted."""

    candidate: int
    first: int
    last: int
    line: Line
    growing: bool


@dataclass(frozen=True)
class Explanation:
    """Why a beam belongs to its segment, or to none; margin: how far it is inside the limit (negative: outside)."""

    beam: int
    text: str
    segment: int
    check: str = ""
    value: float = np.nan
    limit: float = np.nan
    margin: float = np.nan


class Trace:
    """The decisions of one run; a sequence of `Decision`.

    log: (decisions,) structured array, one row each (see log.py), with first, last and beam as positions. positions:
    (m,) int maps these to beams. total: number of points (default: number of positions).
    """

    def __init__(
        self,
        scan: Scan,
        params: Any,
        extraction: Extraction,
        vocabulary: Vocabulary,
        log: NDArray[np.void],
        positions: NDArray[np.integer],
        total: int | None = None,
    ) -> None:
        self.scan = scan
        self.params = params
        self.extraction = extraction
        self.vocabulary = vocabulary
        self.log = log
        self.total = len(positions) if total is None else total
        self._beams = positions

    def __len__(self) -> int:
        return len(self.log)

    def __iter__(self) -> Iterator[Decision]:
        for start in range(0, len(self), AT_ONCE):
            yield from self.at(np.arange(start, min(start + AT_ONCE, len(self))))

    def __getitem__(self, index: int) -> Decision:
        if not -len(self) <= index < len(self):
            raise IndexError(f"decision {index}: the trace has the decisions 0 to {len(self) - 1}")
        return self.at(np.array([index % len(self)]))[0]

    def at(self, indices: NDArray[np.integer]) -> list[Decision]:
        """The decisions with these indices, from 0; faster than one by one."""
        rows = self.log[indices]
        firsts, lasts = self.as_beams(np.maximum([rows["first"], rows["last"]], 0)).tolist()
        numbers = indices.tolist(), self.phases[indices].tolist(), map(Row._make, rows.tolist())
        beams = firsts, lasts, self.as_beams(rows["beam"]).tolist()
        return [self._decision(*decision) for decision in zip(*numbers, *beams, strict=True)]

    def _decision(self, index: int, phase: int, row: Row, first: int, last: int, beam: int) -> Decision:
        told = self._sentence(row, first, last, beam)
        return Decision(
            index=index,
            kind=told.kind.name,
            phase=self.vocabulary.phases[phase],
            candidate=row.candidate,
            partner=row.partner,
            direction=row.direction,
            first=first,
            last=last,
            beam=beam,
            points=row.points,
            line=row.line,
            other=row.other if row.partner >= 0 else None,
            check=told.check.name,
            value=row.value,
            limit=row.limit,
            ends=row.ends if told.kind.effect == "placed" else None,
            text=str(told),
        )

    def texts(self, indices: NDArray[np.integer]) -> list[str]:
        """The sentences of some decisions, much faster than the whole decisions."""
        rows = self.log[indices]
        beams = self.as_beams(np.array([rows["first"], rows["last"], rows["beam"]])).T.tolist()
        return [str(self._sentence(Row(*row), *where)) for row, where in zip(rows.tolist(), beams, strict=True)]

    def beams(self, first: int, last: int) -> NDArray[np.intp]:
        """The valid beams from beam `first` to beam `last`, both inclusive, across the seam where last < first."""
        n = len(self.scan)
        span = (last - first) % n + 1 if self.scan.full_circle else last - first + 1
        beams = (first + np.arange(max(0, span))) % max(n, 1)
        return beams[self.scan.valid[beams]]

    def beams_of(
        self, firsts: NDArray[np.integer], lasts: NDArray[np.integer]
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The valid beams of many spans, as of `beams`, one span after the other; and the span that each is from."""
        n = max(len(self.scan), 1)
        counts = (lasts - firsts) % n + 1 if self.scan.full_circle else np.maximum(lasts - firsts + 1, 0)
        spans = np.repeat(np.arange(len(firsts)), counts)
        beams = (np.arange(len(spans)) + np.repeat(firsts - (np.cumsum(counts) - counts), counts)) % n
        valid = self.scan.valid[beams]
        return beams[valid], spans[valid]

    def as_beams(self, positions: NDArray[np.integer]) -> NDArray[np.int64]:
        """Beams at the positions of `log`; negative positions become −1, for none."""
        if not len(self._beams):
            return np.full(positions.shape, -1, dtype=np.int64)
        return np.where(positions < 0, -1, self._beams.take(positions, mode="clip"))

    @cached_property
    def kinds(self) -> NDArray[np.int8]:
        """The number of each decision's kind in the vocabulary; side by side, and so faster than the log's column."""
        return np.ascontiguousarray(self.log["kind"])

    @cached_property
    def phases(self) -> NDArray[np.int64]:
        """The index of each decision's phase in the vocabulary."""
        return self.vocabulary.phase_of_kind[self.kinds]

    def indices(self, kind: str) -> NDArray[np.intp]:
        """Indices of the decisions of a kind."""
        names = self.vocabulary.names
        if kind not in names:
            raise ValueError(f"there is no decision {kind!r}; choose from {', '.join(names)}")
        return (self.kinds == names.index(kind)).nonzero()[0]

    def jump(self, name: str) -> NDArray[np.intp]:
        """Indices of the decisions that a jump leads to, see `Kind`; none if the method has no such decisions."""
        wanted = self.vocabulary.leads_to.get(name)
        return np.empty(0, np.intp) if wanted is None else wanted[self.kinds].nonzero()[0]

    def starts(self, level: str) -> NDArray[np.intp]:
        """Indices where a "decision", a "phase" or a "line" (decisions about one candidate) starts."""
        if level not in ("decision", "phase", "line"):
            raise ValueError(f"there is no level {level!r}; choose from decision, phase, line")
        if level == "decision" or not len(self):
            return np.arange(len(self))
        begins = np.zeros(len(self), np.bool_)
        begins[0] = True
        for key in self._stretches(level):
            begins[1:] |= key[1:] != key[:-1]
        return begins.nonzero()[0]

    def _stretches(self, level: str) -> tuple[NDArray[np.integer], ...]:
        """Columns that are all equal for neighbouring decisions of one stretch."""
        return (self.phases, self.log["candidate"]) if level == "line" else (self.phases,)

    def lines_at(self, step: int) -> tuple[TracedLine, ...]:
        """The lines after decision `step`; none for −1, before the first decision."""
        rows = self.log[: step + 1]
        lines: dict[int, TracedLine] = {}
        lasting = np.flatnonzero(self._lasting[: step + 1])
        kinds, candidates = rows["kind"][lasting].tolist(), rows["candidate"][lasting].tolist()
        for index, kind, candidate in zip(lasting.tolist(), kinds, candidates, strict=True):
            # Most lines that are dropped were never one of `lines`.
            if candidate in lines or self.vocabulary.kinds[kind].effect != "gone":
                self._apply(Row._make(rows[index].item()), lines)
        if len(rows) and self._effect(now := Row(*rows[-1].item())) == "shown":
            lines[now.candidate] = self._traced(now, growing=True)
        return tuple(lines.values())

    @cached_property
    def candidates(self) -> tuple[int, ...]:
        """The candidate of each line after the last decision."""
        return tuple(line.candidate for line in self.lines_at(len(self) - 1))

    @cached_property
    def _lasting(self) -> NDArray[np.bool_]:
        lasting = [kind.effect not in ("none", "shown") for kind in self.vocabulary.kinds]
        return np.array(lasting)[self.kinds]

    def _effect(self, row: Row) -> Effect:
        return self.vocabulary.kinds[row.kind].effect

    def _apply(self, row: Row, lines: dict[int, TracedLine]) -> None:
        candidate, partner, effect = row.candidate, row.partner, self._effect(row)
        if effect == "gone":
            lines.pop(candidate, None)
            return
        was = lines.get(partner, lines.get(candidate))
        lines[candidate] = self._traced(row)
        if effect == "joined":
            lines.pop(partner, None)
        elif effect == "parted" and was is not None:
            lines[partner] = TracedLine(partner, self._beam(row.beam), was.last, row.other, False)

    def _traced(self, row: Row, growing: bool = False) -> TracedLine:
        return TracedLine(row.candidate, self._beam(row.first), self._beam(row.last), row.line, growing)

    def _beam(self, position: int) -> int:
        return int(self._beams[min(max(position, 0), len(self._beams) - 1)])

    def _sentence(self, row: Row, first: int, last: int, beam: int) -> Sentence:
        """first, last, beam: the beams at the row's positions; beam −1 for none."""
        kind, check = self.vocabulary.kinds[row.kind], self.vocabulary.checks[row.check]
        return Sentence(row, kind, check, first, last, beam, self.total)

    def told(self, row: Row) -> Sentence:
        """The fields for the sentence of a row's decision."""
        beam = self._beam(row.beam) if row.beam >= 0 else -1
        return self._sentence(row, self._beam(row.first), self._beam(row.last), beam)

    def explain(self, beam: int) -> Explanation:
        """Why beam `beam` belongs to its segment, or to none: one sentence with threshold, value and margin."""
        if not 0 <= beam < len(self.scan):
            raise ValueError(f"beam {beam}: the scan has the beams 0 to {len(self.scan) - 1}")
        segment = int(self.extraction.labels[beam])
        if not self.scan.valid[beam]:
            return Explanation(beam, f"beam {beam} has no return: {self._why_invalid(beam)}", segment)
        if segment >= 0:
            return self._why_in(beam, segment)
        return self._why_out(beam)

    def _why_invalid(self, beam: int) -> str:
        measured, scan = float(self.scan.ranges[beam]), self.scan
        if not np.isfinite(measured) or measured <= 0:
            return f"its range is {measured:g}"
        if measured < scan.range_min:
            return f"its range of {measured:.3f} m is below the laser's minimum of {scan.range_min:g} m"
        return f"its range of {measured:.2f} m is not below the laser's maximum of {scan.range_max:g} m"

    def _why_in(self, beam: int, segment: int) -> Explanation:
        line = self.extraction.segments[segment]
        value = float(line.distance(self.scan.xy[beam]))
        text = f"beam {beam} is in segment {segment} of beams {line.first}–{line.last}, {metres(value)} from its line"
        return Explanation(beam, text, segment, value=value)

    def _why_out(self, beam: int) -> Explanation:
        """The final decision on a beam: the last one about it, or about the last line that contained it."""
        about = np.flatnonzero(self._decided_on(beam) | self._decisions_over(beam))
        if not len(about):
            return Explanation(beam, f"beam {beam} is in no segment: no line ever contained it", -1)
        decision = self[int(about[-1])]
        text = f"beam {beam} is in no segment: {decision.text}"
        margin = decision.value - decision.limit if decision.kind == "line dropped" else np.nan
        return Explanation(beam, text, -1, decision.check, decision.value, decision.limit, margin)

    def _decided_on(self, beam: int) -> NDArray[np.bool_]:
        """(decisions,) whether a decision is about the beam itself."""
        return self.as_beams(self.log["beam"]) == beam

    def _decisions_over(self, beam: int) -> NDArray[np.bool_]:
        """(decisions,) whether the window or line of a decision contains the beam."""
        within = np.zeros(len(self.log), dtype=bool)
        for position in np.flatnonzero(self._beams == beam):
            within |= (self.log["first"] <= position) & (position <= self.log["last"])
        return within
