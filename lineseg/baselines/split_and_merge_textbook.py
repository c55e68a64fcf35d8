"""Textbook Split-and-Merge: split by the distance to a fitted line, then merge neighbours that fit one line.

Pavlidis, Horowitz: *Segmentation of plane curves*, IEEE Transactions on Computers C-23, 1974. Nguyen, Gächter,
Martinelli, Tomatis, Siegwart: *A comparison of line extraction algorithms using 2D range data for indoor mobile
robotics*, Autonomous Robots 23, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..kernel import entry_kernel, kernel
from ..knobs import Thresholds
from ..params import MinLength, MinPoints
from ..region_growing.checks import NONE
from ..region_growing.lines import DROPPED, LINE, Dropping, line_at, remove
from ..scan import Scan
from ..tracing.log import ROW, note, note_pair, written
from ..tracing.vocabulary import Kind, Vocabulary
from .chord import farthest, step_to
from .endpoints import place_endpoints
from .logged import LoggedMethod, Run
from .splitting import (
    KINDS,
    LINE_GAP,
    SPLIT_CHECKS,
    SPLIT_DISTANCE,
    LineGap,
    SplitDistance,
    Splitting,
    fitted,
    loop_of,
    select,
    split,
)


@dataclass(frozen=True)
class TextbookParams(Thresholds):
    """Thresholds of the textbook's Split-and-Merge."""

    split_distance: SplitDistance = 0.04
    max_gap: LineGap = 0.5
    min_points: MinPoints = 10
    min_length: MinLength = 0.60


LINES_MERGED, LINES_KEPT_APART, LINE_KEPT, ENDPOINTS = range(len(KINDS), len(KINDS) + 4)
VOCABULARY = Vocabulary(
    (
        *KINDS,
        Kind("lines merged", "merge", "joined", "merge", "lines merged: {span}, all within {value:.3f} m"),
        Kind("lines kept apart", "merge", "none", "", "lines not merged: {value:.3f} ≥ {limit:.3f} m"),
        Kind("line kept", "select", "stands", "line", "line kept: {span}, {points} points"),
        Kind("endpoints", "endpoints", "placed", "", "endpoints placed: {span}, {limit:.3f} m apart"),
    ),
    SPLIT_CHECKS,
)  # fmt: skip


def run(scan: Scan, params: TextbookParams, logged: bool) -> Run:
    """The lines left after splitting and merging; on a full circle also across the opening."""
    beam, xy = loop_of(scan)
    n = len(beam)
    rules = Splitting(params.split_distance, params.max_gap, params.min_points, params.min_length, by_fit=True)
    lines, dropped, used = np.empty(n + 1, LINE), np.empty(2 * n + 1, DROPPED), np.zeros(1, np.int32)
    twice = np.concatenate((xy, xy), axis=1)
    call = partial(extract_lines, twice, scan.full_circle, rules, np.empty((n + 2, 3), np.int64), lines, dropped, used)
    count, rows = written(call, 4 * n + 64) if logged else (call(None), np.empty(0, ROW))
    return Run(lines[:count], dropped[: used[0]], np.concatenate((beam, beam)), rows)


SPLIT_AND_MERGE_TEXTBOOK = LoggedMethod("split-and-merge-textbook", VOCABULARY, run)


@entry_kernel
def extract_lines(xy, circle, rules, stack, lines, dropped, used, log):
    """Number of lines through the points xy (2, 2·n), each point twice; see `split` for the stack."""
    x, y, n = xy[0], xy[1], len(xy[0]) // 2
    used[0] = 0
    if n < 2:
        return 0
    count = split(x, y, n - 1, rules, stack, lines, log)
    count = merge(x, y, n, circle, rules, lines, count, log)
    count = select(x, y, rules, lines, count, Dropping(dropped, used), log)
    if log is not None:
        for i in range(count):
            span = lines[i].first, lines[i].last
            note(log, LINE_KEPT, NONE, lines[i].candidate, 0, span, -1, line_at(lines, i), 0.0, 0.0)
    place_endpoints(x, y, lines, count, ENDPOINTS, log)
    return count


@kernel
def merge(x, y, n, circle, rules, lines, count, log):
    """Merge neighbours if no point lies too far from their common line; on a circle also the last and the first."""
    i = 0
    while i + 1 < count:
        if merged(x, y, lines, i, i + 1, 0, rules, log):
            count = remove(lines, count, i + 1)
        else:
            i += 1
    if circle and count > 1 and merged(x, y, lines, count - 1, 0, n, rules, log):
        count = remove(lines, count, 0)
    return count


@kernel
def merged(x, y, lines, i, j, turn, rules, log):
    """Whether line j, `turn` points further on, was merged into line i."""
    first, last = lines[i].first, lines[j].last + turn
    line = fitted(x, y, first, last)
    check, value, limit = LINE_GAP, step_to(x, y, lines[j].first + turn), rules.max_gap
    if value < limit:
        _, value = farthest(x, y, first - 1, last + 1, line)
        check, limit = SPLIT_DISTANCE, rules.split_distance
    one = value < limit
    pair = lines[i].candidate, lines[j].candidate
    if log is not None:
        kind, span = (LINES_MERGED, (first, last)) if one else (LINES_KEPT_APART, (first, lines[i].last))
        note_pair(log, kind, check, pair, span, -1, line, line_at(lines, j), value, limit)
    if one:
        lines[i].last = last
        lines[i].a, lines[i].b, lines[i].c = line
    return one
