"""A grid of settings: the swept thresholds and their values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from ..params import Knob, Params

MOST_SETTINGS = 2_000_000


@dataclass(frozen=True)
class Grid:
    """Every combination of the axes' values, with the other thresholds from `base`; the last axis changes fastest.

    axes: values by name of threshold. Raises ValueError if there are too many settings.
    """

    base: Params
    axes: Mapping[str, tuple[float, ...]]

    def __post_init__(self) -> None:
        # Check each value once, by itself: checking every setting of the grid would take long.
        for name, values in self.axes.items():
            for value in values:
                self.base.but(**{name: value})
        if len(self) > MOST_SETTINGS:
            sizes = " × ".join(str(len(values)) for values in self.axes.values())
            raise ValueError(_too_many(f"{sizes} = {len(self):,}"))

    def __len__(self) -> int:
        return math.prod(len(values) for values in self.axes.values())

    def __iter__(self) -> Iterator[Params]:
        for values in product(*self.axes.values()):
            yield self.base.but(**dict(zip(self.axes, values, strict=True)))

    def __hash__(self) -> int:
        return hash((self.base, tuple(self.axes.items())))


def axis_values(text: str, name: str) -> tuple[float, ...]:
    """Parses the values of a threshold: "0.01:0.1:20" (from, to, count), "0.01,0.02,0.05" or "0.03".

    They are spaced like the threshold's slider, by equal ratios or equal steps; whole numbers if the threshold is one.
    """
    kind, knob = knob_of(name)
    try:
        if ":" not in text:
            return tuple(dict.fromkeys(_exact(float(part), kind) for part in text.split(",")))
        low, high, count = text.split(":")
        ends, number = (float(low), float(high)), int(count)
    except ValueError:
        ends, number = (math.nan, math.nan), 0
    if not all(map(math.isfinite, ends)) or number < 2:
        raise ValueError(
            f"--{name.replace('_', '-')} is {text!r}; give FROM:TO:COUNT, such as {knob.low:g}:{knob.high:g}:20, "
            "or values separated by commas"
        )
    if number > MOST_SETTINGS:
        raise ValueError(_too_many(f"{number:,}"))
    return spread(*ends, number, kind, knob)


def _too_many(sizes: str) -> str:
    return (
        f"a sweep of {sizes} settings exceeds the {MOST_SETTINGS:,} whose sums fit in memory; give fewer values, "
        "or sweep fewer thresholds at once"
    )


def spread(low: float, high: float, count: int, kind: type, knob: Knob) -> tuple[float, ...]:
    """`count` values from low to high; fewer if they are whole numbers."""
    even = np.geomspace if knob.log and min(low, high) > 0 else np.linspace
    return tuple(dict.fromkeys(_exact(value, kind) for value in even(low, high, count).tolist()))


def slider_values(name: str, count: int, present: float | None = None) -> tuple[float, ...]:
    """`count` values over the range of a threshold's slider, which reaches the present value, if any."""
    kind, knob = knob_of(name)
    if present is not None:
        knob = knob.reaching(present)
    return spread(knob.low, knob.high, count, kind, knob)


def knob_of(name: str) -> tuple[type, Knob]:
    """(int or float, Knob) of a threshold. Raises ValueError, listing the known names, for an unknown one."""
    known = {field: (kind, knob) for field, kind, knob in Params.knobs()}
    if name not in known:
        raise ValueError(f"there is no threshold {name[:40]!r}; choose from {', '.join(known)}")
    return known[name]


def _exact(value: float, kind: type) -> float:
    return float(f"{value:.6g}") if kind is float else round(value)
