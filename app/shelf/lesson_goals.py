"""Which values of a threshold solve the task of a lesson. static/learn/goals.js judges what a person has set."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lineseg import extract
from lineseg.params import Params
from lineseg.scan import Scan
from lineseg.segment import Extraction

from ..tuning.sweep import on_slider

if TYPE_CHECKING:
    from .lesson import Goal

TRIED = 80


def accepted(goal: Goal, scan: Scan, params: Params) -> dict[str, tuple[float, float]]:
    """For each threshold that may be changed, the least and the largest value on its slider that solves the task."""
    ranges = {}
    knobs = {name: (kind, knob) for name, kind, knob in Params.knobs()}
    for name in goal.changed:
        right = [
            value
            for value in on_slider(*knobs[name], TRIED)
            if solves(goal, extract(scan, params.but(**{name: value})))
        ]
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
