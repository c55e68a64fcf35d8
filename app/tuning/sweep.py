"""A sweep of one threshold over its range: the beams of each line at each value."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lineseg import EXTRACTORS, Knob, Scan, Thresholds
from lineseg.colours import segment_colours
from lineseg.sweep.axes import spread

from ..told.answers import ThresholdSweep

MOST_VALUES = 96


def values_of(kind: type, knob: Knob, most: int = MOST_VALUES) -> list[float]:
    """Values over the range of the slider, evenly spaced on its scale; whole numbers if required."""
    return [float(value) for value in spread(knob.low, knob.high, most, kind, knob)]


def on_slider(kind: type, knob: Knob, count: int) -> list[float]:
    """At least `count` values over the range of the slider, in its steps; all of them if it has fewer."""
    values, tried = [knob.low], count
    while len(values) < count and tried <= 8 * count:
        steps = dict.fromkeys(round(value / knob.step) for value in spread(knob.low, knob.high, tried, kind, knob))
        stepped = [float(f"{step * knob.step:.6g}") for step in steps]
        values = [value for value in stepped if knob.least <= value <= knob.most]
        tried += count // 3
    return values


def sweep(scan: Scan, method: str, params: Thresholds, name: str) -> ThresholdSweep:
    """values; runs: the stretches of beams [first, last, "#rrggbb"] at each value; lines: number of lines."""
    kind, knob = {field: (kind, knob) for field, kind, knob in params.knobs()}[name]
    values = values_of(kind, knob.reaching(getattr(params, name)))
    extractions = [EXTRACTORS[method].extract(scan, params.but(**{name: kind(value)})) for value in values]
    return {
        "name": name,
        "beams": len(scan),
        "values": values,
        "lines": [len(extraction.segments) for extraction in extractions],
        "runs": [_runs(extraction.labels, segment_colours(extraction.segments)) for extraction in extractions],
    }


def _runs(labels: NDArray[np.int32], colours: NDArray[np.uint8]) -> list[tuple[int, int, str]]:
    """The stretches of beams of each line, with its colour in the scene."""
    if not len(labels):
        return []
    edges = np.flatnonzero(np.diff(labels)) + 1
    firsts, stops = np.concatenate(([0], edges)), np.concatenate((edges, [len(labels)]))
    stretches = ((int(first), int(stop) - 1, int(labels[first])) for first, stop in zip(firsts, stops, strict=True))
    return [(first, last, _hex(colours[label])) for first, last, label in stretches if label >= 0]


def _hex(colour: NDArray[np.uint8]) -> str:
    return "#" + bytes(colour.tolist()).hex()
