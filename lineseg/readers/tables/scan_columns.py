"""Tables with a scan in each column, perhaps beside a column of angles or of the numbers of the beams."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...scan import Floats, Recording, Topic
from ..account import Notes
from ..guessing import guess_angle_unit
from ..reading import RADIANS, Reading
from ..source import Source, Sweeps
from ..stamping import in_seconds
from .headers import Name, column_of, is_angle, is_beam

# Scans of one place differ by less than this share of their ranges; other quantities beside them differ by more.
ALIKE = 0.15
EVEN = 1e-5
# Fewer beams may be farther by chance.
FEW = 20


def alike(columns: NDArray[np.float64]) -> bool:
    """Whether columns hold about the same, as scans of one place do, and not angles beside distances."""
    first, *others = columns.T
    usual = np.nanmedian(np.abs(first)) if np.isfinite(first).any() else 0.0
    gaps = [np.nanmedian(np.abs(first - other)) if np.isfinite(other).any() else np.inf for other in others]
    return usual > 0 and bool(max(gaps, default=np.inf) < ALIKE * usual) and bool((columns >= 0).mean() > 0.7)


def named_columns(names: list[Name]) -> tuple[int, list[int]] | None:
    """The column of angles, or of the beams' numbers, and those that have a scan each; None if the names say else."""
    beam = column_of(names, is_angle)
    beam = column_of(names, is_beam) if beam is None else beam
    stems: dict[str, list[int]] = {}
    for at, name in enumerate(names):
        if name.element >= 0 and "intensit" not in name.plain:
            stems.setdefault(name.plain, []).append(at)
    columns = max(stems.values(), key=len, default=[])
    return (beam, columns) if beam is not None and len(columns) > 1 else None


def first_echoes(
    source: Source, table: NDArray[np.float64], names: list[Name], beam: int, columns: list[int]
) -> list[int]:
    """The columns, or the first alone, which is told, if they are echoes of one scan: each farther than the last."""
    words = set(names[columns[0]].plain.split("_"))
    if not words & {"echo", "return", "pulse"} and not all(
        _is_farther(table[:, one], table[:, other]) for one, other in pairwise(columns)
    ):
        return columns
    others = ["angle" if at == beam else "distance" if at == columns[1] else "-" for at in range(len(names))]
    source.notes.notice(
        "echoes", f"Each row has {len(columns)} echoes of a beam; the first was read. Use the second?",
        columns=",".join(others),
    )  # fmt: skip
    return columns[:1]


def _is_farther(first: Floats, second: Floats) -> bool:
    """Whether the second echo, where a beam has one, is always farther than the first."""
    both = (first > 0) & (second > 0)
    return bool((second[both] > first[both]).all() and not ((second > 0) & ~(first > 0)).any() and len(first) > FEW)


def tell_columns(notes: Notes, scans: int) -> None:
    notes.notice("columns", f"Each of {scans} columns was read as a scan; a row has the ranges of one beam.")


def with_angles(
    source: Source, ranges: NDArray[np.float64], angles: Floats, stamps: NDArray | None, format: str
) -> Recording:
    """The scans of rows of ranges that share the bearings of their beams."""
    reading, notes = source.reading, source.notes
    if not np.isfinite(angles).all():
        raise ValueError(f"{source.name}: an angle is not a finite number; each beam needs its own.")
    bearings = angles * RADIANS[guess_angle_unit(angles, reading, notes)]
    notes.radians = True
    tell_unknown_direction(notes, reading)
    notes.unstated.add("range_max")
    step = (bearings[-1] - bearings[0]) / max(len(bearings) - 1, 1)
    even = np.allclose(np.diff(bearings), step, rtol=0, atol=EVEN)
    times = np.zeros(len(ranges))
    if stamps is not None and len(stamps) == len(ranges):
        times, notes.stamps = in_seconds(stamps.astype(np.float64))[0], "their array"
    sweeps = Sweeps()
    for row, time in zip(ranges, times.tolist(), strict=True):
        sweeps.add(row, bearings[0], step, stamp=time, bearings=None if even else bearings)
    topics = (Topic("ranges", len(sweeps)),)
    return sweeps.recording(source, topic=source.choose(list(topics), "array"), topics=topics, format=format)


def tell_unknown_direction(notes: Notes, reading: Reading) -> None:
    """Tells, once, that nothing says in which sense the angles count."""
    if reading.direction is None and not any(guess.field == "direction" for guess in notes.guesses):
        why = "the file does not say in which sense its angles count"
        notes.guess("direction", "counter-clockwise", why, direction="clockwise")
