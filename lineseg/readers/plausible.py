"""Notices what cannot be in a recording, each with the change of the Reading that would mend it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from ..scan import Floats, Recording, are_valid
from .account import Notice
from .guessing import UNIT_NAMES, middle_of, rising, sampled_at, unit_of
from .reading import Reading

MOST_RANGE, LEAST_MEDIAN = 500.0, 0.05
MANY_BELOW = 10
RECURS = 0.1
# A laser has no such narrow view of so many beams.
MANY_BEAMS, NARROW = 30, 12.0
CODES_BELOW = 0.02
YEAR = 365.25 * 86400
WRAP = "stamps wrap"
WRAPS = tuple(2.0**32 * scale for scale in (1.0, 1e-3, 1e-6, 1e-9))


def noticed(recording: Recording, reading: Reading, recorded: bool, odd: Oddness | None) -> Iterator[Notice]:
    """All notices of a recording in metres and radians; recorded: whether its recorder's times are known.

    odd: what is wrong with its stamps.
    """
    yield from _about_angles(recording, reading)
    ranges, inside = _sample(recording)
    yield from _below_zero(ranges)
    size = list(_about_size(rising(ranges), reading))
    yield from size
    if not any("unit" in notice.change for notice in size):
        yield from _about_limits(recording, reading, ranges, inside)
        yield from _about_codes(recording, reading)
    yield from _about_recurring(recording, ranges[inside])
    yield from _about_stamps(odd, recorded and reading.stamps != "recorded")


def _sample(recording: Recording) -> tuple[Floats, Any]:
    """Some of the ranges, and which of them are within the limits."""
    beams = sampled_at(len(recording.ranges))
    ranges = recording.ranges[beams]
    low, high = recording.range_min, recording.range_max
    if (low == low[0]).all() and (high == high[0]).all():
        low, high = low[0], high[0]
    else:
        frame = np.searchsorted(recording.offsets, beams, side="right") - 1
        low, high = low[frame], high[frame]
    return ranges, are_valid(ranges, low, high)


def _about_angles(recording: Recording, reading: Reading) -> Iterator[Notice]:
    lengths = np.diff(recording.offsets)
    steps = np.abs(recording.angle_increment)
    views = np.rad2deg(steps * np.maximum(lengths - 1, 0))
    if recording.bearings is not None:
        inner = [abs(scan.bearings[-1] - scan.bearings[0]) for scan in recording if len(scan)]
        views = np.rad2deg(np.array(inner or [0.0]))
    view = middle_of(np.sort(views))
    if view > 360.0 + 1.5 * float(np.rad2deg(middle_of(np.sort(steps)))) + 0.5:
        change = _in_degrees(recording, reading, float(np.deg2rad(view)))
        question = "Are the angles in degrees?" if change else "Check angle_increment."
        if "angle_increment" in change:
            question = "Is only angle_increment in degrees?"
        yield Notice("field of view", f"A field of view of {view:.0f}° is more than a turn. {question}", change)

    beams = middle_of(np.sort(lengths))
    if beams >= MANY_BEAMS and view < NARROW:
        text = f"{beams:.0f} beams within {view:.2g}° are more than a laser has. Are these an angle and a distance?"
        yield Notice("narrow", text)


def _in_degrees(recording: Recording, reading: Reading, view: float) -> dict[str, Any]:
    """The change for angles in degrees, which would give this field of view [°]: of all, or of the step alone."""
    if reading.angle_unit == "deg" or view > 361:
        return {}
    first, step = float(np.median(recording.angle_min)), float(np.median(recording.angle_increment))
    # In radians −2.36 is the first angle of a laser that sees 270°; in degrees it would look ahead.
    half = np.deg2rad(view) / 2
    if recording.bearings is None and first and abs(abs(first) - half) < 0.1 * half:
        return {"angle_increment": round(float(np.deg2rad(step)), 8)}
    return {"angle_unit": "deg"}


def _below_zero(ranges: Floats) -> Iterator[Notice]:
    """Distances are never below 0; codes for "no return" that are have few values."""
    below = ranges[(ranges < 0) & (ranges > -np.inf)]
    if len(below) > RECURS * len(ranges) and len(np.unique(below)) > MANY_BELOW:
        share = f"{len(below) / len(ranges):.0%}"
        yield Notice("below zero", f"{share} of all ranges are below 0, as no distance is. Are these coordinates?")


def _about_size(ranges: Floats, reading: Reading) -> Iterator[Notice]:
    """ranges: above 0, sorted."""
    if not ranges.size:
        yield Notice("no ranges", "No beam has a range above 0.")
        return
    middle = middle_of(ranges)
    far = 1 - float(np.searchsorted(ranges, MOST_RANGE, "right")) / len(ranges)
    likely = unit_of(ranges) if reading.unit == "m" else "m"
    if far > RECURS or likely != "m":
        question = f"Are they in {UNIT_NAMES[likely]}?" if likely != "m" else "Check the unit, or what means no return."
        share = f"{far:.0%} of all ranges are above {MOST_RANGE:g} m (the median is {middle:.4g} m)"
        text = share if far > RECURS else f"The median of the ranges is {middle:.4g} m"
        yield Notice("far", f"{text}. {question}", {"unit": likely} if likely != "m" else {})
    elif middle < LEAST_MEDIAN:
        unit = {"mm": "m", "cm": "m"}.get(reading.unit or "m")
        question = f" Are they in {'metres' if unit else 'another unit'}?"
        yield Notice(
            "near", f"The median of the ranges is {100 * middle:.2g} cm.{question}", {"unit": unit} if unit else {}
        )


def _about_limits(recording: Recording, reading: Reading, ranges: Floats, inside: Any) -> Iterator[Notice]:
    """More than half of the beams outside the limits; codes at the top do not count, because they are no readings."""
    lowest, highest = float(recording.range_min[0]), float(recording.range_max[0])
    if lowest > highest:
        text = f"range_min = {lowest:g} m is above range_max = {highest:g} m. Are they swapped?"
        yield Notice("limits", text, {"range_min": round(highest, 4), "range_max": round(lowest, 4)})
        return
    there = np.isfinite(ranges) & (ranges > 0)
    count = max(len(ranges), 1)
    low, high = (middle_of(np.sort(limits)) for limits in (recording.range_min, recording.range_max))
    below = np.count_nonzero(there & (ranges < low)) / count
    beyond = ranges[there & (ranges >= high)]
    above = len(beyond) / count if len(np.unique(np.round(beyond[:5000], 3))) > 20 else 0.0
    if below + above <= 0.5:
        return
    limit = f"nearer than range_min = {low:g} m" if below >= above else f"not nearer than range_max = {high:g} m"
    change = {"range_min": 0.0} if below >= above else {"range_max": float(np.ceil(beyond.max() + 1))}
    name, value = next(iter(change.items()))
    yield Notice(
        "limits",
        f"{max(below, above):.0%} of all beams are {limit} and count as no return. Use {name} = {value:g} m instead?",
        change,
    )


def _about_codes(recording: Recording, reading: Reading) -> Iterator[Notice]:
    """Whole millimetres nearer than any laser of a robot measures, as Hokuyo's codes of errors are."""
    if reading.range_min is not None or recording.range_min.any():
        return
    near = recording.ranges[(recording.ranges > 0) & (recording.ranges < 2 * CODES_BELOW)]
    codes = np.unique(np.round(1000.0 * near, 3))
    if 0 < len(codes) < 1000 * CODES_BELOW and codes[-1] < 1000 * CODES_BELOW and (codes == np.floor(codes)).all():
        read = f"{codes[0]:g} mm" if len(codes) == 1 else f"{codes[0]:g} to {codes[-1]:g} mm"
        beams = f"{len(near)} beam{' reads' if len(near) == 1 else 's read'}"
        yield Notice("codes", f"{beams} {read}, as codes of errors do. Use range_min = {CODES_BELOW:g} m?",
                     {"range_min": CODES_BELOW})  # fmt: skip


def _about_recurring(recording: Recording, valid: Floats) -> Iterator[Notice]:
    """One value, or a narrow ring below the greatest, that recurs in more than a tenth of all beams."""
    if len(valid) < 100:
        return
    rounded = np.sort(np.round(valid.astype(np.float64), 3))
    starts = np.concatenate(([0], np.flatnonzero(rounded[1:] != rounded[:-1]) + 1))
    values, counts = rounded[starts], np.diff(starts, append=len(rounded))
    most = int(np.argmax(counts))
    share = counts[most] / len(valid)
    if share > RECURS and len(values) > 1:
        value = float(values[most])
        yield Notice(
            "recurs",
            f"{share:.0%} of all beams read exactly {value:g} m. Does this value mean no return?",
            {"no_return": f"{value:g}"},
        )
        return
    top = float(values[-1])
    ring = valid > 0.99 * top
    limit = middle_of(np.sort(recording.range_max))
    lonely = np.count_nonzero((valid <= 0.99 * top) & (valid > 0.95 * top)) < 0.05 * np.count_nonzero(ring)
    if ring.mean() > RECURS and lonely and (not np.isfinite(limit) or top > 0.95 * limit):
        low = float(np.floor(1000 * valid[ring].min()) / 1000)
        yield Notice(
            "recurs",
            f"{ring.mean():.0%} of all beams read between {low:g} and {top:g} m. Do these values mean no return?",
            {"no_return": f"{low:g}:{top:g}"},
        )


def trouble_of(stamps: Floats) -> str:
    """Why stamps cannot be times, in a few words; "" if they rise, and neither jump by years nor wrap."""
    return trouble_in(stamps, oddness(stamps))


def trouble_in(stamps: Floats, odd: Oddness | None) -> str:
    """The same for stamps whose oddness is known."""
    if not stamps.any():
        return "no stamps"
    return "" if odd is None else odd.words


def _about_stamps(odd: Oddness | None, recorded: bool) -> Iterator[Notice]:
    if odd is not None:
        way, stamps = "Read the file without stamps?", "none"
        if odd.words == WRAP:
            way, stamps = "Count on from there?", "unwrapped"
        elif recorded:
            way, stamps = "Use the times of the recorder?", "recorded"
        yield Notice("stamps", f"{odd.sentence} {way}", {"stamps": stamps})


def wrap_of(step: float) -> float:
    """How far a counter fell at this step [s], if it wrapped at 2³²; 0 if it did not."""
    return next((wrap for wrap in WRAPS if abs(-step - wrap) < 0.01 * wrap), 0.0)


def unwrapped(stamps: Floats) -> Floats:
    """Stamps that count on where their counter wraps."""
    falls = np.array([wrap_of(step) for step in np.diff(stamps).tolist()])
    return stamps + np.concatenate(([0.0], np.cumsum(falls)))


class Oddness(NamedTuple):
    """Why stamps cannot be times."""

    words: str
    sentence: str


def oddness(stamps: Floats) -> Oddness | None:
    """What is wrong with stamps; None if they rise, and neither jump by years nor wrap."""
    if len(stamps) < 2 or not stamps.any():
        return None
    if not np.isfinite(stamps).all():
        return Oddness("stamps are not numbers", "Some stamps are not numbers.")
    steps = np.diff(stamps)
    if not steps.any():
        return Oddness("stamps are equal", f"All stamps are equal ({stamps[0]:g}).")
    at, leap = int(np.argmin(steps)), int(np.argmax(np.abs(steps)))
    if wrap_of(steps[at]):
        return Oddness(WRAP, f"The stamps wrap at 2³² before frame {at + 1}.")
    if abs(steps[leap]) > YEAR:
        years = abs(steps[leap]) / YEAR
        return Oddness("stamps jump by years", f"The stamps jump by {years:.0f} years before frame {leap + 1}.")
    if steps[at] < 0:
        backwards = np.count_nonzero(steps < 0)
        times = "once" if backwards == 1 else f"{backwards} times"
        return Oddness(
            "stamps run backwards",
            f"The stamps run backwards {times}, by {-steps[at]:.3g} s before frame {at + 1}.",
        )
    return None
