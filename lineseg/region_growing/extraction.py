"""Converts the rows written by kernels to segments."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scan import Scan
from ..segment import Dropped, Segment
from .checks import CHECKS


class KernelOutput(NamedTuple):
    """The parts of an `Extraction`, made of arrays of LINE and DROPPED.

    beams: (m,) int maps first and last in them, which are positions, to beams.
    """

    scan: Scan
    lines: NDArray[np.void]
    drops: NDArray[np.void]
    beams: NDArray[np.integer]

    def segments(self) -> tuple[Segment, ...]:
        """In scan order."""
        made = []
        for first, last, _, a, b, c, x1, y1, x2, y2, length, rms in self._in_order().tolist():
            span = int(self.beams[first]), int(self.beams[last])
            made.append(Segment((a, b, c), (x1, y1), (x2, y2), *span, last - first + 1, length, rms))
        return tuple(made)

    def labels(self) -> NDArray[np.int32]:
        """(n,): for each beam the index of its segment, or −1."""
        labels = np.full(len(self.scan), -1, dtype=np.int32)
        lines = self._in_order()
        for label, (first, last) in enumerate(zip(lines["first"].tolist(), lines["last"].tolist(), strict=True)):
            labels[self.beams[first : last + 1]] = label
        return labels

    def dropped(self) -> tuple[Dropped, ...]:
        """The candidates that were not kept."""
        rows, scan = self.drops, self.scan
        first, last = self.beams[rows["first"]], self.beams[rows["last"]]
        # A program that treats dropouts as points may end a line at a dropout.
        with np.errstate(invalid="ignore"):
            dx, dy = scan.ranges[last] * scan.rays[:, last] - scan.ranges[first] * scan.rays[:, first]
            lengths = np.hypot(dx, dy)
        points = rows["last"] - rows["first"] + 1
        checks = (CHECKS[check].name for check in rows["check"].tolist())
        numbers = (column.tolist() for column in (first, last, points, lengths))
        found = zip(*numbers, checks, rows["value"].tolist(), rows["limit"].tolist(), strict=True)
        return tuple(map(Dropped._make, found))

    def _in_order(self) -> NDArray[np.void]:
        return self.lines[np.argsort(self.beams[self.lines["first"]], kind="stable")]
