"""Which values of a threshold solve the task of a lesson. static/learn/goals.js judges what a person has set."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lineseg import extract
from lineseg.params import Params
from lineseg.scan import Scan
from lineseg.segment import Extraction

if TYPE_CHECKING:
    from .lesson import Goal

TRIED = 80


def accepted(goal: Goal, scan: Scan, params: Params) -> dict[str, tuple[float, float]]:
    """For each threshold that may be changed, the least and the largest value on its slider that solves the task."""
    ranges = {}
    for name in goal.changed:
        right = [value for value in _on_slider(name) if solves(goal, extract(scan, params.but(**{name: value})))]
        if right:
            ranges[name] = (right[0], right[-1])
    return ranges


def solves(goal: Goal, extraction: Extraction) -> bool:
    """Whether the lines are those that the task asks for."""
    line = extraction.labels
    one = [line[first] >= 0 and line[first] == line[other] for first, other in (*goal.together, *goal.either)]
    return (
        (goal.lines is None or goal.lines[0] <= len(extraction.segments) <= goal.lines[1])
        and all(one[: len(goal.together)])
        and (not goal.either or any(one[len(goal.together) :]))
        and all(line[first] >= 0 and line[other] >= 0 and line[first] != line[other] for first, other in goal.apart)
        and all(line[beam] >= 0 for beam in goal.inside)
        and all(line[beam] < 0 for beam in goal.outside)
    )


def _on_slider(name: str) -> list[float]:
    """Values over the range of the slider, in its steps."""
    _, kind, knob = next(each for each in Params.knobs() if each[0] == name)
    spread = np.geomspace if knob.log and knob.low > 0 else np.linspace
    steps = np.unique(np.round(spread(knob.low, knob.high, TRIED) / knob.step))
    values = [float(f"{step * knob.step:.6g}") for step in steps]
    return [value for value in values if knob.least <= value <= knob.most and (kind is float or value.is_integer())]
