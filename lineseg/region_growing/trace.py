"""Every decision of one run of region growing, and what they say about a beam."""

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
        Kind("lines kept apart", "overlap", "none", "", "neighbouring lines stay two: {refusal}"),
        Kind(
            "overlap cut", "overlap", "parted", "cut",
            "overlap cut at beam {beam}, {value:m} from the first line, {limit:m} from the second; "
            "the first line keeps {span}",
            within="overlap cut behind beam {last}: every shared point is nearer to the first line; it keeps {span}",
        ),
        Kind(
            "endpoints", "endpoints", "placed", "",
            "endpoints placed: the outermost points of {span}, projected on the line, {value:m} apart",
        ),
    ),
    CHECKS,
)  # fmt: skip
PHASES = VOCABULARY.phases


class GrowthTrace(Trace):
    """The trace of region growing; its positions are those of the valid points."""

    params: Params

    def __init__(self, scan: Scan, params: Params, extraction: Extraction, run: Run) -> None:
        log = run.log if run.log is not None else np.empty(0, ROW)
        super().__init__(scan, params, extraction, VOCABULARY, log, run.beam, run.points)

    @cached_property
    def looked_past(self) -> NDArray[np.bool_]:
        """(n,) which beams end at thin things that lines pass behind, or are lost beside one."""
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
        """Of each decision, which of PHASES it belongs to; a line dropped after the last growth: to the overlap."""
        of_kind = np.array([PHASES.index(kind.phase) for kind in VOCABULARY.kinds])
        phases = of_kind[self.log["kind"]]
        phases[self._growth_ended_at :] = np.maximum(phases[self._growth_ended_at :], PHASES.index("overlap"))
        return phases

    def _stretches(self, level: str) -> NDArray[np.int64]:
        """A line is the search for the next seed with the growth from it; a phase of the growing is of one line."""
        phases = self.phases
        key = phases if level == "phase" else np.where(phases <= 1, self.log["candidate"], -phases)
        return np.column_stack((key, self.log["candidate"] * (phases <= 1)))

    @cached_property
    def _growth_ended_at(self) -> int:
        """Index of the first decision after the last growth; a line dropped later was dropped for an overlap."""
        growth = np.flatnonzero(self.log["kind"] <= GROWTH_STOPPED)
        if not len(growth):
            return 0
        after = int(growth[-1]) + 1
        return after + int(after < len(self) and self.log["kind"][growth[-1]] == GROWTH_STOPPED)

    def _why_in(self, beam: int, segment: int) -> Explanation:
        line = self.extraction.segments[segment]
        value = float(line.distance(self.scan.xy[beam]))
        limit = self.params.epsilon
        own = self._grown_into(segment)
        rows = self.log[self._decided_on(beam)]
        joined = rows[(rows["kind"] == POINT_ADDED) & np.isin(rows["candidate"], own)]
        if len(joined):
            row = Row(*joined[-1].item())
            value = row.value
            how = f"growth {self.told(row).way} took it at {metres(value)} from the line, ε = {metres(limit)}"
        elif value < limit:
            how = f"it was in the seed, and lies {metres(value)} from the line, ε = {metres(limit)}"
        else:
            how = f"it was in the seed; the line has since moved {metres(value)} away from it, ε = {metres(limit)}"
        margin = limit - value
        text = f"beam {beam} is in segment {segment}: {how} ({_margin(margin)}){self._afterwards(beam, own)}"
        return Explanation(beam, text, segment, "epsilon", value, limit, margin)

    def _grown_into(self, segment: int) -> list[int]:
        """The growths whose lines became the segment: its own and those that were merged into it."""
        ends = self.extraction.segments[segment].first, self.extraction.segments[segment].last
        own = [line.candidate for line in self.lines_at(len(self) - 1) if (line.first, line.last) == ends]
        for row in self.log[self.log["kind"] == LINES_MERGED][::-1]:
            if row["candidate"] in own:
                own.append(int(row["partner"]))
        return own

    def _afterwards(self, beam: int, own: list[int]) -> str:
        """What became of the line that took the beam: it was merged, or had to share it and was cut."""
        mine = np.isin(self.log["candidate"], own)
        merged = self.log[mine & (self.log["kind"] == LINES_MERGED)]
        shared = self.log[self._decisions_over(beam) & ~mine & (self.log["kind"] == LINE_KEPT)]
        others = shared["candidate"]
        cut = self.log[self.log["kind"] == OVERLAP_CUT]
        cut = cut[np.isin(cut["candidate"], [*own, *others]) & np.isin(cut["partner"], [*own, *others])]
        text = ""
        if len(merged):
            row = Row(*merged[-1].item())
            text += f"; then two lines became this one, {degrees(row.value)} apart, less than {degrees(row.limit)}"
        if len(others) and len(cut):
            at = self._beam(Row(*cut[-1].item()).beam)
            text += f"; another line took it too, and the cut at beam {at} left it to this one"
        return text

    def _why_out(self, beam: int) -> Explanation:
        """The last word on a beam: its line was dropped or cut; else growth refused it; else no seed held it."""
        if self.looked_past[beam]:
            widest = self.params.max_occluder
            thing = f"it ends at a thing at most W_max = {metres(widest)} wide"
            text = f"beam {beam} is in no segment: {thing}, which lines pass behind"
            return Explanation(beam, text, -1, "max_occluder", limit=widest)
        inside = self.log[self._decisions_over(beam)]
        dropped = inside[inside["kind"] == LINE_DROPPED]
        if len(dropped):
            row = longest(dropped)
            told = self.told(row)
            text = f"beam {beam} is in no segment: its line of {told.span} was dropped, {told.refusal}"
            return Explanation(beam, text, -1, told.check.name, row.value, row.limit, row.value - row.limit)
        about = self.log[self._decided_on(beam)]
        refused = about[(about["kind"] == GROWTH_STOPPED)]
        if len(refused):
            return self._refused(beam, nearest(refused), "no line took it; the nearest stopped there: ")
        tried = inside[inside["kind"] == SEED_REJECTED]
        if len(tried):
            row = nearest(tried)
            lead = f"no seed was found here; nearest to one came {self.told(row).span}: "
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
    """The row that missed its limit by the least factor."""
    with np.errstate(over="ignore"):
        return Row(*rows[np.argmin(rows["value"] / np.maximum(rows["limit"], 1e-12))].item())


def _margin(margin: float) -> str:
    return f"margin {metres(margin)}" if margin >= 0 else f"over by {metres(-margin)}"
