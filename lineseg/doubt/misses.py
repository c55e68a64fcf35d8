"""Probable misses of a frame: lines that only looser thresholds find, and which threshold refused them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_scan, need_thresholds
from ..extractors import extract, trace_growth
from ..params import Params
from ..region_growing.checks import GROWTH_STOPPED, LINE_DROPPED, SEED_REJECTED
from ..region_growing.trace import GrowthTrace, Trace, longest, nearest
from ..scan import Scan
from ..tracing.log import Row
from . import LOOSER


@dataclass(frozen=True)
class Miss:
    """A run of beams in no segment that forms a line when ε and δ are LOOSER times as large.

    first, last: beams; points: number of valid beams among them; length [m]. check: the threshold that refused it, ""
    if no seed was sought; beam: where it was refused, −1 for a line that grew and was dropped; value, limit: the
    numbers compared.
    """

    first: int
    last: int
    points: int
    length: float
    check: str
    beam: int
    value: float
    limit: float
    text: str


def misses(scan: Scan, params: Params | None = None) -> tuple[Miss, ...]:
    """The probable misses of a scan, in scan order; their number is the score "misses"."""
    need_scan(scan)
    params = Params() if params is None else params
    need_thresholds(params, Params)
    traced = trace_growth(scan, params)
    looser = params.but(
        epsilon=min(LOOSER * params.epsilon, 100.0), delta=min(LOOSER * params.delta, 1000.0), max_occluder=0.0
    )
    found: list[Miss] = []
    for run in _runs(scan, traced):
        # Objects that lines pass behind have already been removed.
        beams = run[~traced.looked_past[run]]
        part = Scan(scan.ranges[beams], np.unwrap(scan.bearings[beams]), scan.range_min, scan.range_max)
        lines = extract(part.opened(), looser).segments
        found += [_miss(traced, beams[line.first : line.last + 1], line.points, line.length) for line in lines]
    return tuple(found)


def why_none(traced: Trace, beams: NDArray[np.intp]) -> str:
    """Why a run of beams is not a line, in words; "" if the method does not say."""
    valid, labels = traced.scan.valid[beams], traced.extraction.labels[beams]
    if 2 * np.count_nonzero(valid) < len(beams):
        return "most of its beams have no return"
    taken = np.bincount(labels[labels >= 0]) if (labels >= 0).any() else np.zeros(1, int)
    if 2 * taken.max() > np.count_nonzero(valid):
        return f"its beams belong to segment {np.argmax(taken)}"
    return _reason(traced, _widened(traced.scan, beams))[-1] if isinstance(traced, GrowthTrace) else ""


def _widened(scan: Scan, beams: NDArray[np.intp]) -> NDArray[np.intp]:
    """The beams and a quarter more on either side: a tried line need not have started where another ended."""
    more = max(len(beams) // 4, 3)
    wide = np.arange(beams[0] - more, beams[0] + len(beams) + more)
    return wide % len(scan) if scan.full_circle else wide[(wide >= 0) & (wide < len(scan))]


def _runs(scan: Scan, traced: Trace) -> Iterator[NDArray[np.intp]]:
    """The beams before the first segment, between neighbours, and after the last."""
    n, segments = len(scan), traced.extraction.segments
    ends = [(segment.first, segment.last) for segment in segments]
    if not scan.full_circle:
        starts, stops = [0, *(last + 1 for _, last in ends)], [*(first for first, _ in ends), n]
        yield from (np.arange(start, stop) for start, stop in zip(starts, stops, strict=True))
    elif not ends:
        yield (_opening(scan) + np.arange(n)) % n
    else:
        for (_, last), (first, _) in zip(ends, [*ends[1:], ends[0]], strict=True):
            yield (last + 1 + np.arange((first - last - 1) % n)) % n


def _opening(scan: Scan) -> int:
    """The beam after the widest gap of a full circle."""
    beams = np.flatnonzero(scan.valid)
    if not len(beams):
        return 0
    gaps = np.hypot(*(scan.xy[np.roll(beams, -1)] - scan.xy[beams]).T)
    return int(np.roll(beams, -1)[np.argmax(gaps)])


def _miss(traced: Trace, beams: NDArray[np.intp], points: int, length: float) -> Miss:
    check, beam, value, limit, reason = _reason(traced, beams)
    first, last = int(beams[0]), int(beams[-1])
    text = f"a line was probably missed: beams {first}–{last}, {points} points, {length:.1f} m – {reason}"
    return Miss(first, last, points, length, check, beam, value, limit, text)


def _reason(traced: Trace, beams: NDArray[np.intp]) -> tuple[str, int, float, float, str]:
    """(check, beam, value, limit, words) of the longest line dropped here, else of the window nearest to a seed."""
    inside = np.zeros(len(traced.scan), np.bool_)
    inside[beams] = True
    log = traced.log
    rows = log[inside[traced.as_beams(log["first"])] & inside[traced.as_beams(log["last"])]] if len(log) else log
    dropped = rows[rows["kind"] == LINE_DROPPED]
    if len(dropped):
        row = longest(dropped)
        told = traced.told(row)
        words = f"its line of {told.span} was dropped: {told.refusal}{_stop(traced, row)}"
        return told.check.name, -1, row.value, row.limit, words
    rejected = rows[rows["kind"] == SEED_REJECTED]
    if not len(rejected):
        return "", -1, np.nan, np.nan, "no search for a seed started here"
    row = nearest(rejected)
    told = traced.told(row)
    symbol = next(knob.symbol for name, _, knob in traced.params.knobs() if name == told.check.name)
    words = f"seed refused by {symbol}: {told.refusal}"
    return told.check.name, told.beam, row.value, row.limit, words


def _stop(traced: Trace, dropped: Row) -> str:
    """Why a dropped line stopped growing, by the threshold that it missed by least."""
    log = traced.log
    stops = log[(log["kind"] == GROWTH_STOPPED) & (log["candidate"] == dropped.candidate) & (log["beam"] >= 0)]
    if not len(stops):
        return ""
    return f"; it stopped growing where {traced.told(nearest(stops)).refusal}"
