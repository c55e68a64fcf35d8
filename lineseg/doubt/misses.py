"""Probable misses of a frame: lines that only looser thresholds find, and which threshold refused them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_scan, need_thresholds
from ..extractors import trace_growth
from ..kernel import entry_kernel
from ..params import Params
from ..region_growing import Memory, extract_lines
from ..region_growing.checks import GROWTH_STOPPED, LINE_DROPPED, SEED_REJECTED
from ..region_growing.endpoints import place_endpoints
from ..region_growing.limits import limits_of, unpacked
from ..region_growing.lines import DROPPED, LINE, Dropping
from ..region_growing.points import stored_points
from ..region_growing.trace import GrowthTrace, Trace, longest, nearest
from ..scan import Scan
from ..tracing.log import Row
from .scores import probable_misses


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
    memory = Memory(len(scan), scan.full_circle)
    scene = (scan.ranges.astype(np.float64), scan.rays, float(scan.range_min), float(scan.range_max), scan.around)
    count, found = missed_lines(*scene, limits_of(params), *memory.arguments)
    missed = [_miss(traced, memory.numbers[0], row) for row in memory.lines[count : count + found]]
    return tuple(sorted(missed, key=lambda miss: miss.first))


@entry_kernel
def missed_lines(ranges, rays, range_min, range_max, around, limits, xy, numbers, lines, dropped):
    """Write the segments and then the `probable_misses` to `lines`, and return the number of each."""
    count, _, n, returns = extract_lines(
        ranges, rays, range_min, range_max, around, limits, xy, numbers, lines, dropped, None
    )
    rows, drops = lines.view(LINE), Dropping(dropped.view(DROPPED), numbers[3])
    points = stored_points(xy, numbers, n, around, returns)
    found = probable_misses(rows, count, points, unpacked(limits), drops)
    place_endpoints(points, rows[count:], found, None)
    return count, found


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


def _miss(traced: Trace, beam_of: NDArray[np.integer], row: np.void) -> Miss:
    n, around = len(traced.scan), traced.scan.around or len(traced.scan)
    first, last = (int(beam_of[row[end]]) % around for end in ("first", "last"))
    check, beam, value, limit, reason = _reason(traced, (first + np.arange((last - first) % n + 1)) % n)
    points, length = int(row["last"] - row["first"]) + 1, float(row["length"])
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
