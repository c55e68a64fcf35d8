"""Thresholds shared by several baselines."""

from __future__ import annotations

from dataclasses import replace

from ..knobs import Knob
from ..params import Params

_OF_GROWING = {name: replace(knob, ros="", extension=False) for name, _, knob in Params.knobs()}

EPSILON = replace(
    _OF_GROWING["epsilon"], help="Largest distance of a point from its line. Higher accepts noisier points."
)
MIN_POINTS = _OF_GROWING["min_points"]
MIN_LENGTH = _OF_GROWING["min_length"]
MAX_GAP = replace(
    _OF_GROWING["max_gap"], help="Widest gap between neighbouring points of a line. Higher bridges wider openings."
)
BRIDGE = Knob(
    "B_max", 0, 50, "", 1, least=0, most=100_000,
    label="points bridged",
    why="a number of points is never negative",
    help="Largest number of points off the line between two neighbours on it. Higher bridges larger obstacles.",
)  # fmt: skip
SEED = Knob(
    "seed", 0, 100, "", 1, least=0, most=2**31 - 1,
    label="random seed",
    why="a random seed is 0 or more",
    help="Start of the random numbers. The same seed draws the same samples.",
)  # fmt: skip
