"""Makes a lesson of what a tab shows: its recording, frame, thresholds, decision and part of the plan."""

from __future__ import annotations

from typing import Any

import numpy as np

from lineseg import Params, Scan, Trace
from lineseg.tracing.decisions import Decision

from ..view import View
from .lesson import USUAL, Find
from .lesson_numbers import METHOD, found

# Scans of which a lesson can only know the name; those of others it contains.
LASTING = ("lesson:", "sample:", "drawn:")
# x₁, y₁, x₂, y₂ [m]
Box = tuple[float, float, float, float]
# How far beams may be from even spacing [rad].
UNEVEN = 1e-5


def drafted(view: View, scan: Scan, trace: Trace, box: Box | None) -> dict[str, Any]:
    """The fields of a lesson of one step, without its texts and its task. box: of the plan on the stage [m].

    Raises ValueError for what a lesson cannot show.
    """
    lesson: dict[str, Any] = {}
    if view.recording.startswith(LASTING) and not view.read_as.given():
        lesson |= {"recording": view.recording, "frame": view.frame}
    else:
        lesson["scan"] = told_scan(scan)
    step: dict[str, Any] = {}
    if view.method != METHOD:
        if view.params != type(view.params)():
            raise ValueError(
                "a lesson shows another method than region growing with its default thresholds; reset them"
            )
        step["method"] = view.method
    elif changed := _changed(view.params):
        lesson["params"] = changed
    if view.step is not None:
        step["find"] = find_of(trace, trace[view.step])
    elif box is not None and (near := near_in(scan, box)):
        step["near"] = near
    if view.selected is not None:
        step["selected"] = view.selected
    return lesson | {"steps": [step]}


def find_of(trace: Trace, decision: Decision) -> dict[str, Any]:
    """What finds this decision again: its kind, what decided, the direction, and which one of these it is."""
    find: dict[str, Any] = {"kind": decision.kind}
    if decision.check:
        find["check"] = decision.check
    if decision.direction:
        find["direction"] = decision.direction
    same = [each.index for each in found(trace, Find(**find))]
    nth = same.index(decision.index)
    return find | ({"nth": nth} if nth else {})


def near_in(scan: Scan, box: Box) -> list[int]:
    """The outermost beams whose points are in a box; none if all of them are."""
    left, low, right, high = box
    x, y = np.nan_to_num(scan.xy, nan=np.inf).T
    inside = np.flatnonzero(scan.valid & (left <= x) & (x <= right) & (low <= y) & (y <= high))
    if not len(inside) or len(inside) == int(scan.valid.sum()):
        return []
    ends = (inside[pick(values[inside])] for values in (x, y) for pick in (np.argmin, np.argmax))
    return sorted({int(beam) for beam in ends})


def told_scan(scan: Scan) -> dict[str, Any]:
    """A scan as in sensor_msgs/LaserScan. Raises ValueError if its beams are not evenly spaced."""
    n = len(scan)
    step = float(scan.bearings[-1] - scan.bearings[0]) / max(n - 1, 1)
    even = float(scan.bearings[0]) + step * np.arange(n)
    if float(np.abs(even - scan.bearings).max(initial=0.0)) > UNEVEN:
        raise ValueError("the beams of this scan are not evenly spaced, so a lesson cannot contain it")
    ranges = [float(value) if valid else None for value, valid in zip(scan.ranges, scan.valid, strict=True)]
    most = (
        scan.range_max if np.isfinite(scan.range_max) else max((r for r in ranges if r is not None), default=0.0) + 1.0
    )
    return {
        "angle_min": float(scan.bearings[0]),
        "angle_increment": step,
        "range_min": float(scan.range_min),
        "range_max": float(most),
        "ranges": ranges,
    }


def _changed(params: Any) -> dict[str, float]:
    """The thresholds that a lesson would otherwise not have."""
    usual = Params().but(**USUAL).numbers()
    return {name: value for name, value in params.numbers().items() if value != usual[name]}
