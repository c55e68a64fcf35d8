"""The decisions of one run of region growing, and what they say about a beam."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..params import Params
from ..scan import Scan
from ..segment import Extraction
from ..tracing.decisions import Explanation, Trace
from ..tracing.log import ROW, Row
from ..tracing.vocabulary import Kind, Vocabulary, degrees, metres
from . import Run
from .checks import (
    CHECKS,
    GROWTH_STOPPED,
    LINE_DROPPED,
    LINE_KEPT,
    LINES_MERGED,
    OVERLAP_CUT,
    POINT_ADDED,
    SEED_REJECTED,
)

VOCABULARY = Vocabulary(
    (
        Kind("seed rejected", "seed", "none", "refusal", "seed rejected: {span}; {refusal}"),
        Kind("seed found", "seed", "shown", "seed", "seed found: {span}"),
        Kind(
            "point added", "growth", "shown", "",
            "beam {beam} joins, growing {way}: {value:m} < ε = {limit:m}; now {span}",
        ),
        Kind("growth stopped", "growth", "shown", "refusal", "growth stopped {way}: {refusal}"),
        Kind(
            "line kept", "growth", "stands", "line",
            "line kept: {span}, {points} points, {value:m} ≥ L_min = {limit:m}",
        ),
        Kind("line dropped", "growth", "gone", "drop", "line dropped: {span}; {refusal}"),
        Kind(
            "lines merged", "overlap", "joined", "merge",
            "lines merged: {value:deg} apart, less than {limit:deg}; now {span}",
        ),
        Kind("lines kept apart", "overlap", "none", "", "neighbouring lines not merged: {refusal}"),
        Kind(
            "overlap cut", "overlap", "parted", "cut",
            "overlap cut at beam {beam}, {value:m} from the first line, {limit:m} from the second; "
            "the first line keeps {span}",
            within="overlap cut before beam {beam}: every shared point is nearer to the first line, which keeps {span}",
        ),
        Kind(
            "endpoints", "endpoints", "placed", "",
            "endpoints placed: the outermost points of {span}, projected onto the line, {value:m} apart",
        ),
    ),
    CHECKS,
)  # fmt: skip
PHASES = VOCABULARY.phases


class GrowthTrace(Trace):
    """The trace of region growing; its positions count the valid points."""

    params: Params

    def __init__(self, scan: Scan, params: Params, extraction: Extraction, run: Run) -> None:
        log = run.log if run.log is not None else np.empty(0, ROW)
        super().__init__(scan, params, extraction, VOCABULARY, log, run.beam, run.points)
        self._candidates = run.lines["candidate"]

    @cached_property
    def candidates(self) -> tuple[int, ...]:
        return tuple(self._candidates.tolist())

    @cached_property
    def looked_past(self) -> NDArray[np.bool_]:
        """(n,) which beams end at small objects that lines pass behind, or are lost next to one."""
        n = len(self.scan)
        taken = np.zeros(n, np.bool_)
        taken[self._beams] = True
        if not taken.any():
            return taken
        # Each stretch of beams without a point has the number of the point before it.
        stretch = np.cumsum(taken)
        if self.scan.full_circle:
            stretch %= stretch[-1]
        return ~taken & np.isin(stretch, stretch[self.scan.valid & ~taken])

    @cached_property
    def phases(self) -> NDArray[np.int64]:
        """The index in PHASES of each decision; a line dropped after the last growth counts as overlap."""
        phases = VOCABULARY.phase_of_kind[self.kinds]
        phases[self._growth_ended_at :] = np.maximum(phases[self._growth_ended_at :], PHASES.index("overlap"))
        return phases

    def _stretches(self, level: str) -> tuple[NDArray[np.integer], ...]:
        """A "line" covers the search for the next seed and the growth from it; a growing "phase" covers one line."""
        phases = self.phases
        growing = phases <= 1
        candidates = self.log["candidate"]
        key = phases if level == "phase" else np.where(growing, candidates, -phases)
        return key, candidates * growing

    @cached_property
    def _growth_ended_at(self) -> int:
        """Index of the first decision after the last growth; lines dropped later were dropped for an overlap."""
        growth = np.flatnonzero(self.kinds <= GROWTH_STOPPED)
        if not len(growth):
            return 0
        after = int(growth[-1]) + 1
        return after + int(after < len(self) and self.log["kind"][growth[-1]] == GROWTH_STOPPED)

    def _why_in(self, beam: int, segment: int) -> Explanation:
        line = self.extraction.segments[segment]
        value = float(line.distance(self.scan.xy[beam]))
        limit = float(self.params.epsilon_at(self.scan.ranges[beam]))
        own = self.grown_into(segment)
        rows = self.log[self._decided_on(beam)]
        joined = rows[(rows["kind"] == POINT_ADDED) & np.isin(rows["candidate"], own)]
        if len(joined):
            row = Row(*joined[-1].item())
            value = row.value
            how = f"growth {self.told(row).way} added it, {metres(value)} from the line, ε = {metres(limit)}"
        elif value < limit:
            how = f"it was in the seed, {metres(value)} from the line, ε = {metres(limit)}"
        else:
            how = f"it was in the seed; the line has since moved {metres(value)} away from it, ε = {metres(limit)}"
        margin = limit - value
        text = f"beam {beam} is in segment {segment}: {how} ({_margin(margin)}){self._afterwards(beam, own)}"
        return Explanation(beam, text, segment, "epsilon", value, limit, margin)

    def grown_into(self, segment: int) -> list[int]:
        """The growths whose lines became the segment: its own and those merged into it."""
        ends = self.extraction.segments[segment].first, self.extraction.segments[segment].last
        own = [line.candidate for line in self.lines_at(len(self) - 1) if (line.first, line.last) == ends]
        for row in self.log[self.log["kind"] == LINES_MERGED][::-1]:
            if row["candidate"] in own:
                own.append(int(row["partner"]))
        return own

    def _afterwards(self, beam: int, own: list[int]) -> str:
        """What happened later to the line of the beam: a merge, or a cut from a line that shared the beam."""
        mine = np.isin(self.log["candidate"], own)
        merged = self.log[mine & (self.log["kind"] == LINES_MERGED)]
        shared = self.log[self._decisions_over(beam) & ~mine & (self.log["kind"] == LINE_KEPT)]
        others = shared["candidate"]
        cut = self.log[self.log["kind"] == OVERLAP_CUT]
        cut = cut[np.isin(cut["candidate"], [*own, *others]) & np.isin(cut["partner"], [*own, *others])]
        text = ""
        if len(merged):
            row = Row(*merged[-1].item())
            text += f"; then two lines merged into this one, {degrees(row.value)} apart, less than {degrees(row.limit)}"
        if len(others) and len(cut):
            at = self._beam(Row(*cut[-1].item()).beam)
            text += f"; another line contained it too, and the cut at beam {at} left it to this one"
        return text

    def _why_out(self, beam: int) -> Explanation:
        """The final decision on a beam: its line was dropped or cut, or growth refused it, or no seed contained it."""
        if self.looked_past[beam]:
            widest = self.params.max_occluder
            thing = f"it ends at an object that hides at most W_max = {metres(widest)} of a wall"
            text = f"beam {beam} is in no segment: {thing}, which lines pass behind"
            return Explanation(beam, text, -1, "max_occluder", limit=widest)
        inside = self.log[self._decisions_over(beam)]
        dropped = inside[inside["kind"] == LINE_DROPPED]
        if len(dropped):
            row = longest(dropped)
            told = self.told(row)
            text = f"beam {beam} is in no segment: its line of {told.span} was dropped: {told.refusal}"
            return Explanation(beam, text, -1, told.check.name, row.value, row.limit, row.value - row.limit)
        about = self.log[self._decided_on(beam)]
        refused = about[(about["kind"] == GROWTH_STOPPED)]
        if len(refused):
            return self._refused(beam, nearest(refused), "growth of the nearest line stopped here: ")
        tried = inside[inside["kind"] == SEED_REJECTED]
        if len(tried):
            row = nearest(tried)
            lead = f"no seed was found here; the closest was {self.told(row).span}: "
            return self._refused(beam, row, lead)
        least = max(self.params.min_points, self.params.seed_points)
        text = f"beam {beam} is in no segment: no seed was sought, fewer than {least} points are left from here on"
        name = "min_points" if self.params.min_points >= self.params.seed_points else "seed_points"
        return Explanation(beam, text, -1, name, limit=float(least))

    def _refused(self, beam: int, row: Row, lead: str) -> Explanation:
        told = self.told(row)
        text = f"beam {beam} is in no segment: {lead}{told.refusal}"
        return Explanation(beam, text, -1, told.check.name, row.value, row.limit, row.limit - row.value)


def longest(rows: NDArray[np.void]) -> Row:
    """The row that spans the most points."""
    return Row(*rows[np.argmax(rows["last"] - rows["first"])].item())


def nearest(rows: NDArray[np.void]) -> Row:
    """The row that missed its limit by the smallest factor."""
    with np.errstate(over="ignore"):
        return Row(*rows[np.argmin(rows["value"] / np.maximum(rows["limit"], 1e-12))].item())


def _margin(margin: float) -> str:
    return f"margin {metres(margin)}" if margin >= 0 else f"over by {metres(-margin)}"
