"""What texts of lessons let one try (the field `show`): times, noise, other methods, frames to label."""

from __future__ import annotations

import math
import os
import platform
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from lineseg import EXTRACTORS, Params, Recording, Scan, Thresholds, extract
from lineseg.compare.timing import times_of
from lineseg.truth import agreement, true_lines

from ..told.answers import FrameToLabel, LineToLabel, MethodTimes, TimesHere
from ..told.drawn import TraceColumns
from .findings import findings_in
from .stepping import columns_of

# Those of the paper's Fig. 9 and Table 3.
TIMED = ("region-growing", "split-and-merge")
TIMED_FRAMES = 100
# Those of the paper's Figs. 1 and 2.
BESIDE = ("iterative-end-point-fit", "split-and-merge")
LABELLED = 10
MILLIMETRES = 3


def times_here(recording: Recording) -> TimesHere:
    """How long methods take for a frame, on this machine and now [µs]."""
    frames = _spread(recording, TIMED_FRAMES)
    methods = [EXTRACTORS[name] for name in TIMED]
    taken = np.stack(list(times_of(recording, frames, [(each, each.params_type()) for each in methods])))
    told: list[MethodTimes] = [
        {
            "method": each.label,
            "frames": frames,
            "us": [round(us, 1) for us in of_method.tolist()],
            "mean": float(of_method.mean()),
            "std": float(of_method.std()),
            "least": float(of_method.min()),
            "most": float(of_method.max()),
        }
        for each, of_method in zip(methods, taken.T, strict=True)
    ]
    return {"machine": _machine(), "methods": told}


def _machine() -> str:
    """ "Linux x86_64 with 8 processors, 27 November 2026" """
    processors, today = os.cpu_count() or 1, datetime.now(UTC)
    counted = f"{processors} {'processor' if processors == 1 else 'processors'}"
    return f"{platform.system()} {platform.machine()} with {counted}, {today.day} {today:%B %Y}"


def decisions_of(scan: Scan, method: str) -> TraceColumns:
    """The decisions of a method with its default thresholds."""
    return columns_of(findings_in(scan, method, EXTRACTORS[method].params_type()))


def frames_to_label(recording: Recording, params: Thresholds) -> list[FrameToLabel]:
    """LABELLED frames with what region growing finds in them, to be judged by a person."""
    assert isinstance(params, Params)
    return [_to_label(recording, position, params) for position in _spread(recording, LABELLED)]


def _to_label(recording: Recording, position: int, params: Params) -> FrameToLabel:
    scan = recording[position]
    found = extract(scan, params)
    true = agreement(found, true_lines(scan, params)) if scan.wall is not None else None
    lines: list[LineToLabel] = [
        {"first": each.first, "last": each.last, "start": each.start, "end": each.end} for each in found.segments
    ]
    return {
        "frame": recording.number(position),
        "x": _mm(np.where(scan.valid, scan.xy[:, 0], np.nan)),
        "y": _mm(np.where(scan.valid, scan.xy[:, 1], np.nan)),
        "lines": lines,
        "known": None if true is None else {"true": true.true_lines, "found": true.segments, "matched": true.matches},
    }


def _mm(values: NDArray[np.float64]) -> list[float | None]:
    """To a millimetre; None for NaN."""
    return [round(value, MILLIMETRES) if math.isfinite(value) else None for value in values.tolist()]


def _spread(recording: Recording, most: int) -> list[int]:
    """Positions of at most so many frames, from the first to the last."""
    return np.unique(np.linspace(0, len(recording) - 1, most, dtype=int)).tolist()
