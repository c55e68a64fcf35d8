"""Why two beams are in one line or in two, and which threshold would change it, found by running the method."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arguments import need_scan, need_thresholds
from .extractors import EXTRACTORS
from .knobs import Thresholds
from .region_growing.checks import GROWTH_STOPPED, LINE_DROPPED, LINES_KEPT_APART, LINES_MERGED, OVERLAP_CUT
from .region_growing.trace import GrowthTrace, longest
from .scan import Scan
from .segment import Extraction
from .survey.difference import SPLIT, difference
from .tracing.decisions import Trace
from .tracing.log import Row
from .tracing.vocabulary import degrees, metres
from .what_if import nearest

# So many thresholds together are tried, if none alone joins two lines.
MOST_TOGETHER = 4
# It refuses seeds only, which parts no line.
OF_SEEDS = "delta"


@dataclass(frozen=True)
class Change:
    """Values of thresholds with which it would be otherwise.

    first, last: the beams of the line that both would be in, or −1.
    """

    values: dict[str, int | float]
    first: int
    last: int
    text: str


@dataclass(frozen=True)
class Relation:
    """Whether two beams are in one line, and why. one, other: their segments, or −1; changes: what would change it."""

    together: bool
    one: int
    other: int
    text: str
    changes: tuple[Change, ...]


def why_apart(
    scan: Scan, beam: int, other: int, params: Thresholds | None = None, method: str = "region-growing"
) -> Relation:
    """Why two beams are in one line, or what parted their lines, in one sentence; and what would change that.

    changes: for each threshold, changed alone, the nearest value at which both lines are one (for beams of one line: at
    which it is two or more); two lines are one if more than half of the beams of each are in it. If no threshold alone
    joins them, those that refused something on the way, together. Every change was tried by running the method.
    Only region growing says in full what parted two lines. Raises ValueError for a beam outside the scan.
    """
    need_scan(scan)
    for each in (beam, other):
        if not 0 <= each < len(scan):
            raise ValueError(f"beam {each}: the scan has the beams 0 to {len(scan) - 1}")
    extractor = EXTRACTORS[method]
    params = extractor.params_type() if params is None else params
    need_thresholds(params, extractor.params_type)
    pair = _Pair(scan, beam, other, params, method)
    one, two = pair.segments
    together = one == two >= 0
    if together:
        return Relation(True, one, two, _why_one(pair, one), tuple(_alone(pair, pair.is_split, pair.told_split)))
    changes = tuple(_alone(pair, pair.is_joined, pair.told_joined)) or tuple(_several(pair))
    return Relation(False, one, two, _why_two(pair), changes)


class _Pair:
    """Two beams of a scan, and the lines in which they are."""

    def __init__(self, scan: Scan, beam: int, other: int, params: Any, method: str) -> None:
        self.scan, self.beams, self.params = scan, (beam, other), params
        self._extractor = EXTRACTORS[method]
        self.trace: Trace = self._extractor.trace(scan, params)
        self.now: Extraction = self.trace.extraction

    @cached_property
    def segments(self) -> tuple[int, int]:
        """Of both beams, or −1."""
        one, other = (int(self.now.labels[beam]) for beam in self.beams)
        return one, other

    @cached_property
    def members(self) -> tuple[NDArray[np.intp], ...]:
        """The beams that belong together with each: those of its segment, or it alone."""
        return tuple(
            np.flatnonzero(self.now.labels == segment) if segment >= 0 else np.array([beam])
            for beam, segment in zip(self.beams, self.segments, strict=True)
        )

    def run(self, params: Any) -> Extraction:
        return self._extractor.extract(self.scan, params)

    def common(self, found: Extraction) -> int:
        """The segment that has more than half of the members of each, or −1."""
        homes = [_home(found.labels[members]) for members in self.members]
        return homes[0] if homes[0] == homes[1] else -1

    def is_joined(self, found: Extraction) -> bool:
        return self.common(found) >= 0

    def is_split(self, found: Extraction) -> bool:
        return bool(difference(self.now, found).fates_a[self.segments[0]] == SPLIT)

    def told_joined(self, found: Extraction) -> tuple[str, int, int]:
        line = found.segments[self.common(found)]
        return f"they are one line of beams {line.first}–{line.last}", line.first, line.last

    def told_split(self, found: Extraction) -> tuple[str, int, int]:
        lines = [found.segments[k] for k in np.unique(found.labels[self.members[0]]) if k >= 0]
        spans = " and ".join(f"beams {line.first}–{line.last}" for line in lines)
        return f"it is {len(lines)} lines, {spans}", -1, -1


def _home(labels: NDArray[np.integer]) -> int:
    """The segment of more than half of some beams, or −1."""
    counts = np.bincount(labels[labels >= 0], minlength=1)
    most = int(np.argmax(counts))
    return most if 2 * counts[most] > len(labels) else -1


Told = Callable[[Extraction], tuple[str, int, int]]


def _alone(pair: _Pair, otherwise: Callable[[Extraction], bool], told: Told) -> Iterator[Change]:
    """For each threshold that can change it alone, the nearest value that does."""
    for name, kind, knob in pair.params.knobs():

        def run(value: int | float, name: str = name) -> Extraction:
            return pair.run(pair.params.but(**{name: value}))

        value = nearest(getattr(pair.params, name), kind, knob, lambda value, run=run: otherwise(run(value)))
        if value is not None:
            yield _change(pair, {name: value}, told(run(value)))


def _several(pair: _Pair) -> Iterator[Change]:
    """The thresholds that refuse one after the other, each set to what it would have to allow, if that joins them."""
    values: dict[str, int | float] = {}
    for _ in range(MOST_TOGETHER):
        tried = _Pair(pair.scan, *pair.beams, pair.params.but(**values), pair.now.method)
        row = next((row for row in _refusals(tried) if _parts(tried, row)), None)
        if row is None:
            return
        name = tried.trace.told(row).check.name
        needed = _needed(tried.params, name, row)
        if needed is None or needed <= values.get(name, -math.inf):
            return
        values[name] = needed
        found = pair.run(pair.params.but(**values))
        if pair.is_joined(found):
            yield _change(pair, values, pair.told_joined(found))
            return


def _parts(pair: _Pair, row: Row) -> bool:
    """Whether a threshold parted a line there, by refusing something above it."""
    name = pair.trace.told(row).check.name
    knobs = {each: knob for each, _, knob in pair.params.knobs()}
    return name in knobs and bool(knobs[name].refuses) and not knobs[name].floor and name != OF_SEEDS


def _needed(params: Any, name: str, row: Row) -> int | float | None:
    """A value that would have allowed what a threshold refused; None if its slider does not reach it."""
    kind, knob = next((kind, knob) for each, kind, knob in params.knobs() if each == name)
    # The limit is the threshold, or that times something else, such as an rms.
    wanted = getattr(params, name) * row.value / row.limit if row.limit > 0.0 else row.value
    steps = math.floor(wanted / knob.step + 1e-6) + (0 if kind is int else 1)
    value = kind(round(steps * knob.step, 9))
    return value if value <= knob.high else None


def _change(pair: _Pair, values: dict[str, int | float], told: tuple[str, int, int]) -> Change:
    knobs = {name: knob for name, _, knob in pair.params.knobs()}
    settings = " and ".join(knobs[name].told(value) for name, value in values.items())
    text, first, last = told
    return Change(dict(values), first, last, f"with {settings} {text}")


def _why_two(pair: _Pair) -> str:
    one, other = pair.segments
    if one < 0 or other < 0:
        return _why_not_in(pair)
    lead = f"segments {one} and {other} are two lines"
    reasons = list(_reasons(pair)) if isinstance(pair.trace, GrowthTrace) else list(_between(pair))
    return f"{lead}: {'; '.join([*reasons, _position(pair)])}"


def _why_not_in(pair: _Pair) -> str:
    """Of two beams at least one is in no segment."""
    outside = next(beam for beam, segment in zip(pair.beams, pair.segments, strict=True) if segment < 0)
    text = pair.trace.explain(outside).text
    inside = max(pair.segments)
    if inside < 0 or not pair.scan.valid[outside]:
        return text
    away = float(pair.now.segments[inside].distance(pair.scan.xy[outside]))
    return f"{text}; it lies {metres(away)} from the line of segment {inside}"


def _reasons(pair: _Pair) -> Iterator[str]:
    """What parted the lines, as the trace says."""
    trace = pair.trace
    for row in _refusals(pair):
        told = trace.told(row)
        if row.kind == LINES_KEPT_APART:
            yield f"they were not merged, {told.refusal}"
        elif told.check.name == "end":
            continue
        else:
            yield f"growth {told.way} stopped, {told.refusal}"
    cut = _last(_rows_of_both(pair, OVERLAP_CUT))
    if cut is not None:
        yield f"where they overlapped, they were cut at beam {trace.told(cut).beam}"
    yield from _pieces(pair)


def _pieces(pair: _Pair) -> Iterator[str]:
    """The longest piece between the lines that was grown and dropped."""
    trace = pair.trace
    rows = trace.log[trace.log["kind"] == LINE_DROPPED]
    spans = trace.as_beams(np.array([rows["first"], rows["last"]]))
    between = set(_beams_between(pair).tolist())
    inside = [k for k in range(len(rows)) if {int(spans[0, k]), int(spans[1, k])} <= between]
    if inside:
        told = trace.told(longest(rows[inside]))
        yield f"the piece of {told.span} between them was dropped, {told.refusal}"


def _refusals(pair: _Pair) -> Iterator[Row]:
    """What was refused between the lines: a merge, growth of the first forward, growth of the second backward."""
    if not isinstance(pair.trace, GrowthTrace) or min(pair.segments) < 0:
        return
    apart = _last(_rows_of_both(pair, LINES_KEPT_APART))
    if apart is not None:
        yield apart
    log = pair.trace.log
    for segment, direction in zip(_in_order(pair), (1, -1), strict=True):
        mine = np.isin(log["candidate"], pair.trace.grown_into(segment)) & (log["direction"] == direction)
        stopped = log[mine & (log["kind"] == GROWTH_STOPPED)]
        if len(stopped):
            yield Row(*stopped[np.argmax(direction * stopped["last" if direction > 0 else "first"])].item())


def _rows_of_both(pair: _Pair, kind: int) -> NDArray[np.void]:
    log, trace = pair.trace.log, pair.trace
    assert isinstance(trace, GrowthTrace)
    own = [trace.grown_into(segment) for segment in pair.segments]
    rows = log[log["kind"] == kind]
    of = [(np.isin(rows["candidate"], a) & np.isin(rows["partner"], b)) for a, b in (own, own[::-1])]
    return rows[of[0] | of[1]]


def _last(rows: NDArray[np.void]) -> Row | None:
    return Row(*rows[-1].item()) if len(rows) else None


def _in_order(pair: _Pair) -> tuple[int, int]:
    """Both segments, so that the way over the beams from the first to the second is the shorter one."""
    number, second = pair.segments
    one, other = pair.now.segments[number], pair.now.segments[second]
    n = len(pair.scan)
    if pair.scan.full_circle:
        ahead = (other.first - one.last) % n <= (one.first - other.last) % n
    else:
        ahead = one.first <= other.first
    return (number, second) if ahead else (second, number)


def _beams_between(pair: _Pair) -> NDArray[np.intp]:
    """From the end of the first segment to the start of the second."""
    first, second = (pair.now.segments[segment] for segment in _in_order(pair))
    n = len(pair.scan)
    return (first.last + 1 + np.arange((second.first - first.last - 1) % n)) % n


def _between(pair: _Pair) -> Iterator[str]:
    """What lies between two lines of a method that does not say what parted them."""
    between = _beams_between(pair)
    lost = int(np.count_nonzero(~pair.scan.valid[between]))
    if len(between):
        span = f"beams {between[0]}–{between[-1]}" if len(between) > 1 else f"beam {between[0]}"
        yield f"{span} lie between them, {lost} of them without a return" if lost else f"{span} lie between them"


def _position(pair: _Pair) -> str:
    """How the lines lie to each other."""
    one, other = (pair.now.segments[segment] for segment in pair.segments)
    (a, b, _), (c, d, _) = one.line, other.line
    angle = math.asin(min(1.0, abs(a * d - b * c)))
    away = float(one.distance(np.add(other.start, other.end) / 2))
    number, second = pair.segments
    beside = f"segment {second} lies {metres(away)} off the line of segment {number}"
    return f"the lines are {degrees(angle)} apart, and {beside}"


def _why_one(pair: _Pair, number: int) -> str:
    segment = pair.now.segments[number]
    grown = f"segment {number} is one line of beams {segment.first}–{segment.last}"
    return "; ".join([f"{grown}: {_how_grown(pair, number)}", *_weakest(pair, number)])


def _how_grown(pair: _Pair, number: int) -> str:
    trace = pair.trace
    if not isinstance(trace, GrowthTrace):
        return f"its points lie {metres(pair.now.segments[number].rms)} (rms) from it"
    own = trace.grown_into(number)
    merges = trace.log[(trace.log["kind"] == LINES_MERGED) & np.isin(trace.log["candidate"], own)]
    if not len(merges):
        return "it grew from one seed"
    told = trace.told(Row(*merges[np.argmax(merges["value"])].item()))
    each = "two lines that overlapped" if len(merges) == 1 else f"{len(merges) + 1} lines that overlapped"
    return f"{each} were merged, {degrees(told.value)} apart, less than {degrees(told.limit)}"


def _weakest(pair: _Pair, number: int) -> Iterator[str]:
    """Where it would part first: the point farthest from it, and its widest gap."""
    segment, xy = pair.now.segments[number], pair.scan.xy
    beams = pair.members[0]
    beams = np.roll(beams, -int(np.searchsorted(beams, segment.first)))
    away = segment.distance(xy[beams])
    far = int(np.argmax(away))
    yield f"beam {beams[far]} is farthest from it, {metres(float(away[far]))}"
    if len(beams) > 1:
        gaps = np.hypot(*np.diff(xy[beams], axis=0).T)
        wide = int(np.argmax(gaps))
        yield f"its widest gap is {metres(float(gaps[wide]))}, between beams {beams[wide]} and {beams[wide + 1]}"
