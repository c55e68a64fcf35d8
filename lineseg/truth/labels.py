"""Labels of the frames of a recording: true lines, tags, notes. label_file.py reads and writes them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..region_growing import thin_things
from ..scan import Recording, Scan
from ..segment import Extraction
from . import true_ends

Point = tuple[float, float]


@dataclass(frozen=True)
class TrueLine:
    """A true line: its beams first..last, inclusive (last < first across the seam of a full circle), and its
    endpoints [m]."""

    first: int
    last: int
    start: Point
    end: Point

    @classmethod
    def over(cls, scan: Scan, first: int, last: int) -> TrueLine:
        """The line of these beams; its endpoints are the outermost points projected on the fitted line, or NaN.

        Points of thin objects in front of the line are left out. `check_labels` checks the beam numbers.
        """
        truth = np.full(len(scan), -1)
        if first < len(scan) and last < len(scan):
            truth[beams_between(first, last, len(scan))] = 0
            truth[thin_things(scan)] = -1
        ends = true_ends(scan, truth) if (truth >= 0).any() else np.full((1, 2, 2), math.nan)
        (x1, y1), (x2, y2) = ends[0].tolist()
        return cls(first, last, (x1, y1), (x2, y2))


@dataclass(frozen=True)
class FrameLabels:
    """The labels of one frame. lines: None if its true lines are not labelled, () if it has none.

    revision: how often this frame was saved; 0 for never.
    """

    lines: tuple[TrueLine, ...] | None = None
    tags: tuple[str, ...] = ()
    note: str = ""
    revision: int = 0

    @classmethod
    def of(cls, extraction: Extraction) -> FrameLabels:
        """The segments as true lines, as a first draft."""
        return cls(tuple(TrueLine(each.first, each.last, each.start, each.end) for each in extraction.segments))

    @property
    def ends(self) -> NDArray[np.float64]:
        """(lines, 2, 2) [m] the endpoints."""
        return np.array([(line.start, line.end) for line in self.lines or ()], np.float64).reshape(-1, 2, 2)

    def truth(self, scan: Scan) -> NDArray[np.int32] | None:
        """(n,) for each beam its true line or −1, as `true_lines` gives it; None if not labelled.

        Thin objects in front of a line, such as a chair leg, do not belong to it.
        """
        if self.lines is None:
            return None
        labels = np.full(len(scan), -1, np.int32)
        for label, line in enumerate(self.lines):
            beams = beams_between(line.first, line.last, len(scan))
            labels[beams[scan.valid[beams]]] = label
        labels[thin_things(scan)] = -1
        return labels


Labels = dict[int, FrameLabels]


def beams_between(first: int, last: int, beams: int) -> NDArray[np.intp]:
    """first..last, both inclusive; the first beam follows the last."""
    return (first + np.arange((last - first) % beams + 1)) % beams


def check_labels(labels: FrameLabels, recording: Recording, frame: int) -> None:
    """Raises ValueError if the labels do not fit this frame, for a missing beam or one on two lines."""
    if not recording.has(frame):
        frames = recording.whole or len(recording)
        left_out = ", and not all of them were read" if recording.whole else ""
        raise ValueError(f"frame {frame}: {recording.name} has the frames 0 to {frames - 1}{left_out}")
    scan = recording[recording.position(frame)]
    taken = np.full(len(scan), -1)
    for number, line in enumerate(labels.lines or ()):
        where = f"frame {frame}, true line {number}: beams {line.first} to {line.last}"
        if not (0 <= line.first < len(scan) and 0 <= line.last < len(scan)):
            raise ValueError(f"{where}; the scan has the beams 0 to {len(scan) - 1}")
        if line.last < line.first and not scan.full_circle:
            raise ValueError(f"{where}; only a line on a full circle may continue past the last beam")
        if not np.isfinite((line.start, line.end)).all():
            raise ValueError(f"{where}: its endpoints {line.start} and {line.end} are not finite")
        beams = beams_between(line.first, line.last, len(scan))
        if (taken[beams] >= 0).any():
            beam = int(beams[taken[beams] >= 0][0])
            raise ValueError(f"{where}; beam {beam} already belongs to line {taken[beam]}")
        taken[beams] = number
