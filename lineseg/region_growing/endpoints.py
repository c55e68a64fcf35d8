"""Endpoint generation (Eqs. 7, 8)."""

from __future__ import annotations

import math

from ..kernel import kernel
from ..total_least_squares import distance, project, squares_of
from ..tracing.log import note_ends
from .checks import ENDPOINTS
from .lines import line_at


@kernel
def place_endpoints(points, lines, count, log):
    """Project the outermost points of each line onto it, and compute its length and the rms of the distances."""
    for i in range(count):
        row = lines[i]
        first, last, line = row.first, row.last, line_at(lines, i)
        row.x1, row.y1 = project(line, points.x[first], points.y[first])
        row.x2, row.y2 = project(line, points.x[last], points.y[last])
        row.length = distance(row.x1, row.y1, row.x2, row.y2)
        row.rms = math.sqrt(squares_of(points.x, points.y, first, last, line) / (last - first + 1))
        if log is not None:
            ends = row.x1, row.y1, row.x2, row.y2
            note_ends(log, ENDPOINTS, row.candidate, (first, last), line, ends, row.length)
