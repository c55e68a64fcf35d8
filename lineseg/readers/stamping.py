"""The unit of time stamps that do not say it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..scan import Floats

UNITS = {1.0: "seconds", 1e-3: "milliseconds", 1e-6: "microseconds", 1e-9: "nanoseconds"}
# From 2001 to 2065.
CENTURY = (1e9, 3e9)
USUAL = 0.1  # between scans
MINUTE, HOUR, DAY = 60.0, 3600.0, 86_400.0


class Calendar(NamedTuple):
    """Stamps that count from another day than 1970-01-01, which is `epoch` in their unit [s]."""

    words: str
    unit: float
    epoch: float
    low: float
    high: float


CALENDARS = (
    Calendar("days since 1900", DAY, 25_569.0, 36_500.0, 60_000.0),  # Excel
    Calendar("0.1 µs since 1601", 1e-7, 1.16444736e17, 1.2e17, 1.5e17),  # Windows
    Calendar("0.1 µs since the year 1", 1e-7, 6.21355968e17, 6.2e17, 6.6e17),  # .NET
)


def stamp_unit(stamps: Floats) -> float:
    """The unit that puts stamps into this century, or else scans about a tenth of a second apart [s]."""
    middle, step = float(np.median(np.abs(stamps))), _step(stamps)
    for unit in UNITS:
        if CENTURY[0] <= middle * unit <= CENTURY[1] and step * unit < HOUR:
            return unit
    if not step > 0 or step <= 5:
        return 1.0
    return min(UNITS, key=lambda unit: abs(np.log(step * unit / USUAL)))


def in_seconds(stamps: Floats) -> tuple[Floats, str]:
    """Stamps whose unit is not said in seconds, and the words for what they were taken for.

    Times of day go on after midnight.
    """
    middle, step = float(np.median(stamps)) if len(stamps) else 0.0, _step(stamps)
    for each in CALENDARS:
        if each.low <= middle <= each.high and 0 < step * each.unit < MINUTE:
            return (stamps - each.epoch) * each.unit, each.words
    unit = stamp_unit(stamps)
    times = stamps * unit
    falls = np.diff(times) < -DAY / 2
    if falls.any() and (times >= 0).all() and (times < DAY).all() and (np.diff(times)[~falls] >= 0).all():
        times = times + DAY * np.concatenate(([0], np.cumsum(falls)))
    return times, UNITS[unit]


def _step(stamps: Floats) -> float:
    """The usual step between stamps, 0 if there is none."""
    steps = np.abs(np.diff(stamps))
    return float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
