"""Surveys with the other methods: frame by frame in Python, scored by the same kernels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..doubt.scores import SCORES, Spans, score_frame, spans_of
from ..extractors import method_of
from ..kernel import entry_kernel, kernel
from ..knobs import Thresholds
from ..params import Params
from ..region_growing.limits import limits_of, unpacked
from ..region_growing.lines import DROPPED, LINE, Dropping
from ..region_growing.points import points_of
from ..scan import Recording, Scan
from ..segment import Extraction
from .stretch import Workspace

# Thresholds that a score takes from the method if it has them. The others keep their defaults, to judge alike.
JUDGED_BY = ("epsilon", "epsilon_growth", "delta", "seed_points", "min_points", "min_length")
COVERAGE = list(SCORES).index("coverage")


def judge_of(params: Thresholds) -> Params:
    """The region-growing thresholds used for scoring the segments of a method."""
    own = {name: value for name, value in params.numbers().items() if name in JUDGED_BY}
    return Params(epsilon_growth=0.0).but(**own)


def survey_stretch(
    recording: Recording,
    start: int,
    stop: int,
    params: Thresholds,
    memory: Workspace,
    cancelled: NDArray[np.bool_],
    counts: NDArray[np.int64],
    scores: NDArray[np.float32] | None,
) -> NDArray[np.void]:
    """The segments of the frames start..stop − 1; writes to `counts` and `scores`, which have all frames."""
    method, limits = method_of(params), limits_of(judge_of(params))
    memory.spans.used[:] = -1
    found = [memory.segments[:0]]
    # The first frame is compared with the previous one, which belongs to another stretch.
    for frame in range(max(start - 1, 0) if scores is not None else start, stop):
        if cancelled[0]:
            break
        scan = recording[frame]
        extraction = method.extract(scan, params)
        rows = segment_rows(extraction, memory.segments.dtype)
        if scores is not None:
            row = scores[frame] if frame >= start else np.empty(len(SCORES), np.float32)
            _score(scan, extraction, rows, limits, frame % 2, memory, row)
        if frame >= start:
            counts[frame] = len(rows)
            found.append(rows)
    return np.concatenate(found)


def segment_rows(extraction: Extraction, kind: np.dtype) -> NDArray[np.void]:
    """Segments as rows of a survey."""
    rows = [
        (*s.line, *s.start, *s.end, s.length, s.rms, s.first, s.last, s.points) for s in extraction.segments
    ]  # fmt: skip
    return np.array(rows, kind)


def _score(
    scan: Scan,
    extraction: Extraction,
    rows: NDArray[np.void],
    limits: NDArray[np.float64],
    turn: int,
    memory: Workspace,
    scores: NDArray[np.float32],
) -> None:
    score_segments(
        scan.ranges.astype(np.float64), scan.rays, np.asarray(scan.bearings, np.float64), float(scan.range_min),
        float(scan.range_max), scan.around, rows, limits, *memory.arguments, *memory.spans, turn, scores,
    )  # fmt: skip
    # The kernel counts all beams from first to last, but some methods leave out beams in between.
    scores[COVERAGE] = extraction.covered / max(int(np.count_nonzero(scan.valid)), 1)


@entry_kernel
def score_segments(
    ranges, rays, bearings, range_min, range_max, around, segments, limits, xy, numbers, lines, dropped, low, high,
    shown, turn, scores,
):  # fmt: skip
    """Score the segments of one frame; turn: alternately 0 and 1, to compare each frame with the previous one."""
    rows, drops = lines.view(LINE), Dropping(dropped.view(DROPPED), numbers[3])
    fields = unpacked(limits)
    points = points_of(ranges, rays, range_min, range_max, around, fields, xy, numbers)
    count = 0
    if points.period > 0:
        for i in range(len(segments)):
            count = put_in_order(points, segments[i], rows, count)
    now = Spans(low[turn], high[turn], shown[turn : turn + 1])
    before = Spans(low[1 - turn], high[1 - turn], shown[1 - turn : 2 - turn])
    spans_of(rows, count, points, bearings, now)
    score_frame(rows, count, points, len(ranges), fields, drops, now, before, scores)


@kernel
def put_in_order(points, segment, lines, count):
    """Number of lines after inserting the segment, ordered by first position."""
    first = position_of(points, segment.first, points.start)
    last = position_of(points, segment.last, first)
    k = count
    while k > 0 and lines[k - 1].first > first:
        lines[k] = lines[k - 1]
        k -= 1
    row = lines[k]
    row.first, row.last, row.candidate = first, last, 0
    row.a, row.b, row.c, row.rms, row.length = segment.a, segment.b, segment.c, segment.rms, segment.length
    row.x1, row.y1, row.x2, row.y2 = segment.x1, segment.y1, segment.x2, segment.y2
    return count + 1


@kernel
def position_of(points, beam, start):
    """The first position from `start` on whose beam is at least `beam`; on a circle beam numbers keep rising."""
    wanted = beam
    while points.around > 0 and wanted < points.beam[start]:
        wanted += points.around
    low, high = start, min(start + points.period, len(points.beam)) - 1
    while low < high:
        middle = (low + high) // 2
        if points.beam[middle] < wanted:
            low = middle + 1
        else:
            high = middle
    return low
