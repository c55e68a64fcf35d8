"""Endpoints of lines, as most methods place them."""

from __future__ import annotations

import math

from ..kernel import kernel
from ..region_growing.lines import line_at
from ..total_least_squares import project, squares_of
from ..tracing.log import note_ends


@kernel
def place_endpoints(x, y, lines, count, kind, log):
    """Project the outermost points of each line onto it, and compute its length and the rms of the distances."""
    for i in range(count):
        row, line = lines[i], line_at(lines, i)
        row.x1, row.y1 = project(line, x[row.first], y[row.first])
        row.x2, row.y2 = project(line, x[row.last], y[row.last])
        measure(x, y, lines, i, kind, log)


@kernel
def measure(x, y, lines, i, kind, log):
    """Length and rms of a line that has its endpoints."""
    row, line = lines[i], line_at(lines, i)
    row.length = math.hypot(row.x2 - row.x1, row.y2 - row.y1)
    row.rms = math.sqrt(squares_of(x, y, row.first, row.last, line) / (row.last - row.first + 1))
    if log is not None:
        ends, span = (row.x1, row.y1, row.x2, row.y2), (row.first, row.last)
        note_ends(log, kind, row.candidate, span, line, ends, row.length)
