"""Every decision of one run of region growing, and what they say about a beam."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..params import Params
from ..scan import Scan
from ..segment import Extraction
from ..tracing.decisions import Explanation, Kind, Trace, Vocabulary, lack, metres
from ..tracing.log import ROW, Row
from . import Run
from .checks import (
    CHECKS,
    DELTA,
    END,
    GROWTH_STOPPED,
    LINE_DROPPED,
    LINE_KEPT,
    LINES_KEPT_APART,
    LINES_MERGED,
    MAX_DROPOUT,
    MERGE_RMS,
    OVERLAP_CUT,
    POINT_ADDED,
    SEED_FOUND,
    SEED_REJECTED,
)

VOCABULARY = Vocabulary(
    (
        Kind("seed rejected", "seed", "none", "refusal"),
        Kind("seed found", "seed", "shown", "seed"),
        Kind("point added", "growth", "shown"),
        Kind("growth stopped", "growth", "shown", "refusal"),
        Kind("line kept", "growth", "stands", "line"),
        Kind("line dropped", "growth", "gone", "drop"),
        Kind("lines merged", "overlap", "joined", "merge"),
        Kind("lines kept apart", "overlap"),
        Kind("overlap cut", "overlap", "parted", "cut"),
        Kind("endpoints", "endpoints", "placed"),
    ),
    CHECKS,
)
PHASES = VOCABULARY.phases
_SYMBOLS = {name: knob.symbol for name, _, knob in Params.knobs()}


class GrowthTrace(Trace):
    """The trace of region growing; its positions are those of the valid points."""

    params: Params

    def __init__(self, scan: Scan, params: Params, extraction: Extraction, run: Run) -> None:
        log = run.log if run.log is not None else np.empty(0, ROW)
        super().__init__(scan, params, extraction, VOCABULARY, log, run.beam)
        self._points = run.points

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

    def _sentence(self, row: Row, first: int, last: int, beam: int) -> str:
        kind, check, value, limit = row.kind, row.check, row.value, row.limit
        span = f"beams {first}–{last}"
        way = _way(row)
        if kind == SEED_REJECTED:
            return f"seed rejected: {span}; {refusal(beam, check, value, limit)}"
        if kind == SEED_FOUND:
            return f"seed found: {span}"
        if kind == POINT_ADDED:
            return f"beam {beam} joins, growing {way}: {metres(value)} < ε = {metres(limit)}; now {span}"
        if kind == GROWTH_STOPPED:
            reason = f"{self._end_of_growth(row)}, {span}" if check == END else refusal(beam, check, value, limit)
            return f"growth stopped {way}: {reason}"
        if kind == LINE_KEPT:
            return f"line kept: {span}, {row.points} points, {metres(value)} ≥ L_min = {metres(limit)}"
        if kind == LINE_DROPPED:
            return f"line dropped: {span}; {lack(CHECKS[check], value, limit)}"
        if kind == LINES_MERGED:
            return f"lines merged: {_degrees(value)} apart, less than {_degrees(limit)}; now {span}"
        if kind == LINES_KEPT_APART and check == MERGE_RMS:
            return f"neighbouring lines stay two: as one they have an rms of {metres(value)}, more than {metres(limit)}"
        if kind == LINES_KEPT_APART:
            return f"neighbouring lines stay two: {_degrees(value)} apart, not less than {_degrees(limit)}"
        if kind == OVERLAP_CUT and value < limit:
            return f"overlap cut behind beam {last}: every shared point is nearer to the first line; it keeps {span}"
        if kind == OVERLAP_CUT:
            distances = f"{metres(value)} from the first line, {metres(limit)} from the second"
            return f"overlap cut at beam {beam}, {distances}; the first line keeps {span}"
        return f"endpoints placed: the outermost points of {span}, projected on the line, {metres(limit)} apart"

    def _end_of_growth(self, row: Row) -> str:
        if row.points >= self._points:
            return "every point belongs to the line"
        return "the last valid beam is reached" if row.direction > 0 else "the first valid beam is reached"

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
            how = f"growth {_way(row)} took it at {metres(value)} from the line, ε = {metres(limit)}"
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
            text += f"; then two lines became this one, {_degrees(row.value)} apart, less than {_degrees(row.limit)}"
        if len(others) and len(cut):
            at = self._beam(Row(*cut[-1].item()).beam)
            text += f"; another line took it too, and the cut at beam {at} left it to this one"
        return text

    def _why_out(self, beam: int) -> Explanation:
        """The last word on a beam: its line was dropped or cut; else growth refused it; else no seed held it."""
        if self.looked_past[beam]:
            widest = self.params.max_occluder
            thing = f"it ends at a thing at most {_SYMBOLS['max_occluder']} = {metres(widest)} wide"
            text = f"beam {beam} is in no segment: {thing}, which lines pass behind"
            return Explanation(beam, text, -1, "max_occluder", limit=widest)
        inside = self.log[self._decisions_over(beam)]
        dropped = inside[inside["kind"] == LINE_DROPPED]
        if len(dropped):
            row = longest(dropped)
            check, value, limit = CHECKS[row.check], row.value, row.limit
            span = self._span(row)
            text = f"beam {beam} is in no segment: its line of {span} was dropped, {lack(check, value, limit)}"
            return Explanation(beam, text, -1, check, value, limit, value - limit)
        about = self.log[self._decided_on(beam)]
        refused = about[(about["kind"] == GROWTH_STOPPED)]
        if len(refused):
            return self._refused(beam, nearest(refused), "no line took it; the nearest stopped there: ")
        tried = inside[inside["kind"] == SEED_REJECTED]
        if len(tried):
            row = nearest(tried)
            lead = f"no seed was found here; nearest to one came {self._span(row)}: "
            return self._refused(beam, row, lead)
        least = max(self.params.min_points, self.params.seed_points)
        text = f"beam {beam} is in no segment: no seed was sought, fewer than {least} points are left from here on"
        name = "min_points" if self.params.min_points >= self.params.seed_points else "seed_points"
        return Explanation(beam, text, -1, name, limit=float(least))

    def _refused(self, beam: int, row: Row, lead: str) -> Explanation:
        check, value, limit = row.check, row.value, row.limit
        text = f"beam {beam} is in no segment: {lead}{refusal(self._beam(row.beam), check, value, limit)}"
        return Explanation(beam, text, -1, CHECKS[check], value, limit, limit - value)

    def _span(self, row: Row) -> str:
        return f"beams {self._beam(row.first)}–{self._beam(row.last)}"


def longest(rows: NDArray[np.void]) -> Row:
    """The row that spans the most points."""
    return Row(*rows[np.argmax(rows["last"] - rows["first"])].item())


def nearest(rows: NDArray[np.void]) -> Row:
    """The row that missed its limit by the least factor."""
    with np.errstate(over="ignore"):
        return Row(*rows[np.argmin(rows["value"] / np.maximum(rows["limit"], 1e-12))].item())


def refusal(beam: int, check: int, value: float, limit: float) -> str:
    """What kept a point out of a seed or a line, with the value, the limit and by how much it was missed."""
    if check == MAX_DROPOUT:
        return f"{value:g} beams without a return lie before beam {beam}, D_max = {limit:g} (over by {value - limit:g})"
    symbol, over = _SYMBOLS[CHECKS[check]], f"(over by {metres(value - limit)})"
    if check == DELTA:
        return f"beam {beam} lies {metres(value)} from its predicted point, {symbol} = {metres(limit)} {over}"
    if CHECKS[check] == "max_gap":
        return f"a gap of {metres(value)} lies before beam {beam}, {symbol} = {metres(limit)} {over}"
    return f"beam {beam} lies {metres(value)} from the line, {symbol} = {metres(limit)} {over}"


def _way(row: Row) -> str:
    return "forward" if row.direction > 0 else "backward"


def _margin(margin: float) -> str:
    return f"margin {metres(margin)}" if margin >= 0 else f"over by {metres(-margin)}"


def _degrees(radians: float) -> str:
    return f"{math.degrees(radians):.1f}°"
