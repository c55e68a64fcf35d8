"""Converts the rows written by kernels to segments."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..knobs import Thresholds
from ..scan import Scan
from ..segment import Dropped, Extraction, Segment
from .checks import CHECKS


def extraction_of(
    method: str,
    scan: Scan,
    params: Thresholds,
    lines: NDArray[np.void],
    dropped: NDArray[np.void],
    beams: NDArray[np.integer],
) -> Extraction:
    """The output of the kernels as segments in scan order.

    lines, dropped: arrays of LINE and DROPPED, with first and last as positions; beams: (m,) int maps these to beams.
    """
    labels = np.full(len(scan), -1, dtype=np.int32)
    segments = []
    lines = lines[np.argsort(beams[lines["first"]], kind="stable")] if len(lines) else lines
    for label, (first, last, _, a, b, c, x1, y1, x2, y2, length, rms) in enumerate(lines.tolist()):
        labels[beams[first : last + 1]] = label
        span = int(beams[first]), int(beams[last])
        segments.append(Segment((a, b, c), (x1, y1), (x2, y2), *span, last - first + 1, length, rms))
    return Extraction(method, params, tuple(segments), labels, _dropped(scan, dropped, beams))


def _dropped(scan: Scan, rows: NDArray[np.void], beams: NDArray[np.integer]) -> tuple[Dropped, ...]:
    first, last = beams[rows["first"]], beams[rows["last"]]
    # A program that treats dropouts as points may end a line at a dropout.
    with np.errstate(invalid="ignore"):
        dx, dy = scan.ranges[last] * scan.rays[:, last] - scan.ranges[first] * scan.rays[:, first]
        lengths = np.hypot(dx, dy)
    points = rows["last"] - rows["first"] + 1
    checks = (CHECKS[check].name for check in rows["check"].tolist())
    numbers = (column.tolist() for column in (first, last, points, lengths))
    found = zip(*numbers, checks, rows["value"].tolist(), rows["limit"].tolist(), strict=True)
    return tuple(map(Dropped._make, found))
