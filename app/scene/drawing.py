"""A step of a replay as marks for `lineseg.figure_svg`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lineseg import Recording
from lineseg.writers.figure import Mark

from ..frame.findings import Findings
from ..view import View
from .flat import look_of, shapes_of
from .picture import Picture, picture

# What a decision is about is drawn from near by.
NEAR = ("window", "candidate", "outermost", "predicted", "growing", "first", "other")
WORDS = {
    "segments": "lines so far",
    "dropped": "dropped",
    "seeds": "seeds",
    "window": "points of the window",
    "candidate": "point under test, P",
    "outermost": "outermost point",
    "predicted": "predicted point P′",
    "growing": "line at this step",
    "first": "first line",
    "other": "second line",
    "bent": "line fitted with P",
    "band": "band of ±ε",
    "ray": "laser beam",
    "perpendicular": "perpendicular to the line",
    "endpoints": "ends of lines",
}


def step_marks(view: View, recording: Recording, found: Findings) -> tuple[list[Mark], NDArray[np.float64]]:
    """The marks of the step in their order, on a light ground, and (n, 2) what is looked at [m]."""
    shown = picture(replace(view, dark=False), recording, found, (0.0, 0.0, 1.0, 1.0))
    looks = ((look_of(name), xy, colours) for name, xy, colours in shapes_of(shown) if name in WORDS)
    marks = [
        Mark(WORDS[look["name"]], look["px"] * (2 if look["kind"] == "points" else 1), xy, colours)
        for look, xy, colours in looks
    ]
    return marks, _near(shown)


def _near(shown: Picture) -> NDArray[np.float64]:
    """The corners of what the decision is about, with room around it; none if it is about the whole."""
    shapes = [
        shape.xyz[..., :2].reshape(-1, 2)
        for name, shape in (*shown.points.items(), *shown.lines.items())
        if name in NEAR
    ]
    near = np.concatenate([*shapes, np.empty((0, 2))]).astype(float)
    if not len(near):
        return near
    low, high = near.min(axis=0), near.max(axis=0)
    room = 0.3 * max(float((high - low).max()), 0.3)
    return np.stack((low - room, high + room))
