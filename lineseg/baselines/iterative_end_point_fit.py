"""Iterative end-point fit: stretches split at the farthest point from the line through their ends, and nothing else.

Duda, Hart: *Pattern Classification and Scene Analysis*, 1973 (also Ramer 1972, Douglas and Peucker 1973).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..kernel import entry_kernel
from ..knobs import Thresholds
from ..params import MinLength, MinPoints
from ..region_growing.checks import NONE
from ..region_growing.lines import DROPPED, LINE, Dropping, line_at
from ..scan import Scan
from ..tracing.log import ROW, note, written
from ..tracing.vocabulary import Kind, Vocabulary
from .endpoints import measure
from .logged import LoggedMethod, Run
from .splitting import KINDS, SPLIT_CHECKS, LineGap, SplitDistance, Splitting, loop_of, select, split


@dataclass(frozen=True)
class EndPointFitParams(Thresholds):
    """Thresholds of the iterative end-point fit."""

    split_distance: SplitDistance = 0.04
    max_gap: LineGap = 0.5
    min_points: MinPoints = 10
    min_length: MinLength = 0.60


LINE_KEPT, ENDPOINTS = range(len(KINDS), len(KINDS) + 2)
VOCABULARY = Vocabulary(
    (
        *KINDS,
        Kind("line kept", "select", "stands", "line", "line kept: {span}, {points} points"),
        Kind("endpoints", "endpoints", "placed", "", "the line runs through its ends: {span}, {limit:.3f} m apart"),
    ),
    SPLIT_CHECKS,
)


def run(scan: Scan, params: EndPointFitParams, logged: bool) -> Run:
    """The remaining stretches, each with the line through its ends."""
    beam, xy = loop_of(scan)
    n = len(beam)
    rules = Splitting(params.split_distance, params.max_gap, params.min_points, params.min_length)
    lines, dropped, used = np.empty(n + 1, LINE), np.empty(2 * n + 1, DROPPED), np.zeros(1, np.int32)
    call = partial(extract_lines, xy, rules, np.empty((n + 2, 3), np.int64), lines, dropped, used)
    count, rows = written(call, 4 * n + 64) if logged else (call(None), np.empty(0, ROW))
    return Run(lines[:count], dropped[: used[0]], beam, rows)


ITERATIVE_END_POINT_FIT = LoggedMethod("iterative-end-point-fit", VOCABULARY, run)


@entry_kernel
def extract_lines(xy, rules, stack, lines, dropped, used, log):
    """Number of lines through the points xy (2, n); see `split` for the stack."""
    x, y = xy[0], xy[1]
    used[0] = 0
    if len(x) < 2:
        return 0
    count = split(x, y, len(x) - 1, rules, stack, lines, log)
    count = select(x, y, rules, lines, count, Dropping(dropped, used), log)
    for i in range(count):
        row = lines[i]
        row.x1, row.y1, row.x2, row.y2 = x[row.first], y[row.first], x[row.last], y[row.last]
        if log is not None:
            note(log, LINE_KEPT, NONE, row.candidate, 0, (row.first, row.last), -1, line_at(lines, i), 0.0, 0.0)
        measure(x, y, lines, i, ENDPOINTS, log)
    return count
