"""Guesses what a file does not state: the unit of ranges and of angles, and codes for "no return"."""

from __future__ import annotations

import re
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..scan import Floats, Recording
from .account import Notes
from .range_limits import longest_return
from .reading import METRES, AngleUnit, Reading, Unit

UNIT_NAMES = {
    "m": "metres", "cm": "centimetres", "mm": "millimetres", "0.1mm": "tenths of a millimetre",
    "1/4mm": "quarters of a millimetre", "um": "micrometres", "in": "inches", "ft": "feet",
}  # fmt: skip
ANGLE_UNIT_NAMES = {
    "rad": "radians", "deg": "degrees", "gon": "gon", "mrad": "milliradians", "0.01deg": "hundredths of a degree",
    "1/64deg": "64ths of a degree",
}  # fmt: skip
# Rooms and yards: a laser's median range is hardly ever outside of these [m].
NEAR, FAR = 0.35, 60.0
# What drivers write for "no return": the greatest numbers of 16, 15, 14, 13 and 12 bits in millimetres or centimetres.
CODES = (655.35, 655.34, 655.33, 65.535, 65.534, 65.533, 32.767, 16.383, 8.191, 4.095)
OFTEN, FEW = 0.002, 3
# Two turns, and a little; a turn, and a little.
MOST_DEGREES, MOST_RADIANS = 725.0, 2 * np.pi + 0.2
# What people write where there was no return, such as 9999 or 99.99.
NINES = re.compile(r"999|9{4,}|(?=.{5})9{1,4}\.9{1,5}")
# A greatest value so many times as large as the next is no reading.
ALONE, ENOUGH = 3.0, 100
MOST_SAMPLED = 2_000
SPREAD = np.arange(MOST_SAMPLED) * 0.6180339887498949 % 1.0  # by the golden ratio


@lru_cache(maxsize=4)
def sampled_at(count: int) -> NDArray[np.int64]:
    """The indices of `count` values, or of MOST_SAMPLED of them: evenly spread, but not at even steps.

    Even steps might meet the same beam of every scan.
    """
    if count <= MOST_SAMPLED:
        return np.arange(count)
    return (SPREAD * count).astype(np.int64)


def sampled(values: Floats) -> Floats:
    """The values, or MOST_SAMPLED of them, evenly spread."""
    return values if len(values) <= MOST_SAMPLED else values[sampled_at(len(values))]


def rising(ranges: Floats) -> Floats:
    """A sample of the ranges that are finite and above 0, sorted."""
    found = sampled(ranges)
    return np.sort(found[(found > 0) & (found < np.inf)])


def middle_of(rising: Floats) -> float:
    """The median of sorted values, 0 if there are none."""
    count = len(rising)
    return float(rising[(count - 1) // 2] + rising[count // 2]) / 2 if count else 0.0


def unit_of(rising: Floats) -> Unit:
    """The unit of sorted ranges above 0: metres, unless most ranges are too large for them.

    Then millimetres, or centimetres if these would be too small.
    """
    if not rising.size:
        return "m"
    middle, high = middle_of(rising), float(rising[9 * (len(rising) - 1) // 10])
    if middle <= FAR and not (high > 100 and (rising == np.floor(rising)).all()):
        return "m"
    whole_cm = middle < 1e3 * NEAR and NEAR <= 0.01 * middle <= FAR and float(rising[-1]) < 6000
    return "cm" if whole_cm else "mm"


def guess_unit(recording: Recording, reading: Reading, notes: Notes) -> Unit:
    """The unit of the ranges: as wanted, as the file says, or guessed."""
    if reading.unit or "unit" not in notes.unstated:
        return reading.unit or notes.found.get("unit", "m")
    ranges = rising(recording.ranges)
    if notes.found.get("angle_unit") == "1/64deg" and unit_of(ranges) == "mm":
        why = "no unit is stated, and lasers that count 64ths of a degree count so"
        notes.guess("unit", UNIT_NAMES["1/4mm"], why, unit="mm")
        return "1/4mm"
    unit = unit_of(ranges)
    other = next(each for each in ("mm", "m", "cm") if each != unit)
    why = f"no unit is stated, and the median of the ranges is {middle_of(ranges):.4g}"
    notes.guess("unit", UNIT_NAMES[unit], why, unit=other)
    return unit


def angle_unit_of(angles: Floats) -> AngleUnit:
    """Degrees if angles are too large for radians, and what drivers count in if they are too large for degrees."""
    greatest = float(np.nanmax(np.abs(angles), initial=0.0)) if angles.size else 0.0
    if greatest <= MOST_RADIANS:
        return "rad"
    if greatest <= MOST_DEGREES:
        return "gon" if abs(_turn(angles) - 400.0) < 0.5 else "deg"
    # A turn of these units, or else hundredths.
    turn = {"mrad": 2000 * np.pi, "1/64deg": 360 * 64}
    return next((unit for unit, most in turn.items() if 0.98 * most < greatest <= most), "0.01deg")  # type: ignore[return-value]


def _turn(angles: Floats) -> float:
    """The span of angles with the step after the last of them, which is a turn if they go all around."""
    return float(np.nanmax(angles) - np.nanmin(angles)) + middle_of(np.sort(np.abs(np.diff(angles))))


def guess_angle_unit(angles: Floats, reading: Reading, notes: Notes) -> AngleUnit:
    """The unit of the angles: as wanted, as the file says, or guessed."""
    unit = reading.angle_unit or notes.found.get("angle_unit")
    if unit is None:
        unit = notes.found["angle_unit"] = angle_unit_of(angles)
        why = f"no unit is stated, and the angles go from {np.nanmin(angles):.4g} to {np.nanmax(angles):.4g}"
        other = {"deg": "rad", "gon": "deg", "0.01deg": "1/64deg", "1/64deg": "0.01deg"}.get(unit, "deg")
        notes.guess("angle_unit", ANGLE_UNIT_NAMES[unit], why, angle_unit=other)
    return unit


def no_return_codes(recording: Recording, reading: Reading, notes: Notes) -> tuple[float, ...]:
    """Codes for "no return" that recur as the greatest value of all beams [m]."""
    if reading.no_return is not None or reading.range_max is not None:
        return ()
    ranges = sampled(recording.ranges)
    finite = ranges[np.isfinite(ranges)]
    limit = float(np.max(recording.range_max, initial=0.0))
    greatest = float(finite.max(initial=0.0))
    code = next((each for each in CODES if abs(greatest - each) < 5e-4), None)
    if code is None and NINES.fullmatch(f"{greatest / METRES[reading.unit or 'm']:.6g}"):
        code = greatest
    if code is None and "range_max" in notes.unstated and len(finite) >= ENOUGH:
        others = float(finite[finite < greatest].max(initial=0.0))
        code = greatest if greatest > ALONE * others > 0 else None
    if code is None or code >= limit or np.count_nonzero(np.abs(finite - code) < 5e-4) < max(FEW, OFTEN * len(ranges)):
        return ()
    why = "it is the greatest number that fits, and recurs" if code in CODES else "it recurs, beyond all others"
    notes.guess("no_return", f"{code:g} m means no return", why, no_return="none")
    return (code,)


def guess_limit(recording: Recording, reading: Reading, notes: Notes) -> float:
    """The range from which on there are no returns [m]; inf if the data show none."""
    limit = longest_return(recording.ranges)
    if np.isfinite(limit) and reading.range_max is None and reading.no_return is None:
        why = "readings at and above it recur like codes"
        notes.guess("range_max", f"no return from {limit:g} m on", why, range_max=round(2 * limit, 3))
    return limit
