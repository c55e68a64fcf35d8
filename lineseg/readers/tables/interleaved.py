"""Rows with a scan each, of which every beam has several numbers: its angle and its distance, or x and y."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scan import Floats, Recording
from ..reading import Reading
from ..source import Source
from .beam_rows import Roles, bearings_of, columns_of_beam, with_roles

LEAST_BEAMS, MOST_NUMBERS = 20, 4
# Neighbours in a row of ranges differ less than this share of them; an angle and a distance differ more.
APART = 0.1
# The steps of the angles are as equal as this.
REGULAR = 0.3
# Points within less than this [rad] are ranges beside another quantity.
NARROW = 0.35
# So many steps may go back, because angles jitter.
FEW_BACK = 0.05
# Distances are more than these.
FEW_VALUES = 3


class Beams(NamedTuple):
    """How many numbers a beam has, and which of them are its angle and distance, or its x and y."""

    numbers: int
    roles: Roles


def interleaved(values: list[Floats], reading: Reading) -> Beams | None:
    """What the beams of the rows have; None if a row has one number a beam."""
    row = values[0]
    given = (reading.columns, reading.skip_columns, reading.angle_increment)
    if len(row) < 2 * LEAST_BEAMS or any(each is not None for each in given):
        return None
    if not np.nanmedian(np.abs(np.diff(row))) > APART * np.nanmedian(np.abs(row)):
        return None
    for numbers in range(2, MOST_NUMBERS + 1):
        if any(len(each) % numbers for each in values) or len(row) < LEAST_BEAMS * numbers:
            continue
        table = row.astype(np.float64).reshape(-1, numbers)
        score, roles = columns_of_beam(table)
        if score < REGULAR and _sweeps(table, roles):
            return Beams(numbers, roles)
    return None


def angles_between(values: list[Floats], reading: Reading) -> bool:
    """Whether every other row has the angles of the row after it, and these differ from scan to scan."""
    angles, ranges = values[::2], values[1::2]
    given = (reading.columns, reading.skip_columns, reading.angle_increment)
    if len(values) < 4 or len(values) % 2 or any(each is not None for each in given):
        return False
    if any(len(one) != len(other) or len(one) < LEAST_BEAMS for one, other in zip(angles, ranges, strict=True)):
        return False
    if all(np.array_equal(each, angles[0]) for each in angles[1:]):
        return False
    return all(map(_goes_around, angles)) and not any(map(_goes_around, ranges))


def _goes_around(numbers: Floats) -> bool:
    """Whether numbers rise, or fall, at every step but one, where a turn ends."""
    rises = np.diff(numbers) > 0
    return bool(min(rises.sum(), (~rises).sum()) <= 1 and np.isfinite(numbers).all())


def read_angles_between(source: Source, reading: Reading, values: list[Floats]) -> Recording:
    """The scans of such rows."""
    scans = np.repeat(np.arange(len(values) // 2, dtype=np.float64), list(map(len, values[::2])))
    table = np.column_stack((scans, np.concatenate(values[::2]), np.concatenate(values[1::2]))).astype(np.float64)
    source.notes.notice("beams", "Every other row was read as the angles of the ranges below it.")
    return with_roles(source, reading, table, None, Roles(True, 1, 2, 0), True, "text")


def _sweeps(table: NDArray[np.float64], roles: Roles) -> bool:
    """Whether the bearings of the beams go on in one sense over a field of view, and their distances vary."""
    if len(np.unique(table[:, roles.second])) <= FEW_VALUES:
        return False
    bearings = bearings_of(table, roles)
    steps = (np.diff(bearings[np.isfinite(bearings)]) + np.pi) % (2 * np.pi) - np.pi
    back = np.minimum((steps > 0).mean(), (steps < 0).mean())
    return bool(back < FEW_BACK and np.median(np.abs(steps)) * len(table) > NARROW)


def read_interleaved(source: Source, reading: Reading, values: list[Floats], beams: Beams) -> Recording:
    """The scans of such rows."""
    tables = [row.reshape(-1, beams.numbers) for row in values]
    scans = np.repeat(np.arange(len(values), dtype=np.float64), [len(table) for table in tables])
    table = np.column_stack((np.concatenate(tables), scans)).astype(np.float64)
    what = "angle and distance" if beams.roles.polar else "x and y"
    source.notes.notice("beams", f"Each row was read as a scan with {what} of one beam after the other.")
    return with_roles(source, reading, table, None, beams.roles._replace(scan=beams.numbers), True, "text")
