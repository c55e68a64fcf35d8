"""Text with one scan per row, perhaps after leading columns, and perhaps below a row of angles or of settings."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import compress, pairwise

import numpy as np

from ...scan import Floats, Recording, Topic
from ..account import Notes
from ..guessing import angle_unit_of
from ..lasers import laser_of
from ..plausible import unwrapped, wrap_of
from ..reading import RADIANS, Reading
from ..source import Source, Sweeps
from ..stamping import in_seconds
from .dialect import Dialect, Row, text_of
from .scan_columns import alike, tell_columns, tell_unknown_direction

# angle_min and angle_increment, in degrees, of common lasers by number of beams.
LASERS = {
    180: (-90.0, 1.0),
    181: (-90.0, 1.0),
    360: (-180.0, 1.0),
    361: (-90.0, 0.5),
    541: (-135.0, 0.5),
    682: (-120.0, 240.0 / 681),
    721: (-90.0, 0.25),
    726: (-135.0, 360.0 / 1024),
    769: (-135.0, 360.0 / 1024),
    1081: (-135.0, 0.25),
}
# Fields of view and steps [deg] of lasers that are not in the table.
VIEWS, STEPS = (180.0, 190.0, 200.0, 240.0, 270.0, 275.0), (1.0, 0.5, 1 / 3, 0.25, 0.2, 1 / 6, 0.125, 0.1)
MOST_LEADING = 8
# Before the ranges of a known laser may also stand what a robot knows.
MOST_SETTINGS = 32
# More columns than a turn has degrees are no angles.
MOST_DEGREES = 361
MOST_LASERS = 4
# So many rows of each length are not two that broke off.
LEAST_ALTERNATE = 3
# Rows may vary by this share; those that differ more are broken.
VARIES = 0.1
LEAST_BEAMS, MANY_BEAMS = 10, 30
# So many times farther are ranges from the quantities between them than from the next range.
LEAST_PAIRS, FAR_APART = 30, 8.0
# So many rows of real ranges have more different numbers than these.
MANY_ROWS, FEW_LEVELS = 30, 8
# Scans in which the seam shows whether beams go all around, and the leap there as a share of the ranges.
FEW_SCANS, MANY_SCANS, SEAM_SHARE, NEARLY_ALL = 4, 1000, 0.15, 0.9
# Rows of two lasers differ so many times as much as those of one.
UNLIKE = 2.0


@dataclass(frozen=True)
class Geometry:
    """angle_min and increment [rad] of `beams` beams; bearings: (beams,) [rad] if they are not evenly spaced."""

    angle_min: float
    increment: float
    beams: int
    bearings: Floats | None = None


def read_scans(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, leading: tuple[str, ...] | None,
    trailing: tuple[str, ...] = (),
) -> Recording:  # fmt: skip
    """The scans of rows of numbers. leading: what the columns before the ranges hold, None to find out; trailing: what
    those after them hold."""
    return scans_of(source, reading, *parsed(source, rows, dialect), leading, trailing=trailing)


def scans_of(
    source: Source, reading: Reading, numbers: list[int], values: list[Floats], double: int,
    leading: tuple[str, ...] | None, format: str = "text", trailing: tuple[str, ...] = (),
) -> Recording:  # fmt: skip
    """The scans of rows; numbers: of their lines. double: the numbers before a double space, 0 without one.

    leading, trailing: what the columns before and after the ranges hold; None to find out.
    """
    if trailing and leading is not None:
        cut = len(trailing)
        values, leading = [np.concatenate((row[-cut:], row[:-cut])) for row in values], trailing + leading
    if len(values) > 1 and all(len(row) == 1 for row in values):
        numbers, values = numbers[:1], [np.concatenate(values)]
    if leading is None and (columns := _in_columns(reading, values)) is not None:
        tell_columns(source.notes, len(columns))
        numbers, values, double = numbers[:1] * len(columns), list(columns), 0
    if leading is None and reading.skip_columns is None and (pairs := _pairs(values)):
        source.notes.notice("pairs", f"Of each row, every second number was left out, as {pairs} intensities would be.")
        values = [row[::2] for row in values]
    elif leading is None and reading.skip_columns is None and (beams := _halves(values)):
        source.notes.notice("halves", f"The second half of each row was left out, as {beams} intensities would be.")
        values = [row[:beams] for row in values]
    if leading is None:
        _check_rows(source, values)
    geometry = None
    if len(values) > 1:
        numbered = _numbers_columns(values)
        angles = None if numbered > MOST_DEGREES else _angle_row(source, reading, values)
        geometry = angles or _settings_row(values)
        if numbered and angles is not None:
            _tell_counted(source.notes, reading, angles)
        if geometry is not None or numbered:
            # The row may be there again before each scan.
            others = [at for at, row in enumerate(values) if not np.array_equal(row, values[0], equal_nan=True)]
            numbers, values = [numbers[at] for at in others], [values[at] for at in others]
    numbers, values, laser = _of_one_length(source, numbers, values)
    numbers, values = _whole(source, numbers, values, geometry is not None and geometry.bearings is not None)
    skip = _skipped(source, reading, values, leading, geometry, double)
    if leading is None and geometry is None and reading.angle_increment is None:
        values = _without_trailing(source, values, skip)
    if min(map(len, values)) <= skip:
        raise ValueError(f"{source.name}:{numbers[0]}: no ranges are left after {skip} leading columns; skip fewer.")
    beams = Counter(len(row) - skip for row in values).most_common(1)[0][0]
    angle_min, increment = _angles(source, reading, [row[skip:] for row in values], beams, geometry)
    stamps = _stamps(source, values, skip, leading, len(trailing))
    lasers = _lasers(values, skip) if leading is None and not laser else [laser] * len(values)
    sweeps = Sweeps()
    bearings = None if geometry is None else geometry.bearings
    for row, stamp, laser in zip(values, stamps.tolist(), lasers, strict=True):
        sweeps.add(row[skip:], angle_min, increment, stamp=stamp, frame_id=laser, bearings=bearings)
    lengths = [len(row) - skip for row in values]
    if min(lengths) != max(lengths):
        source.notes.notice(
            "rows vary", f"Rows have {min(lengths)} to {max(lengths)} ranges, all from the same angle on."
        )
    source.notes.unstated |= {"unit", "range_max"} - source.notes.found.keys()
    topics = (Topic("scan", len(sweeps)),)
    return sweeps.recording(source, topic=source.choose(list(topics)), topics=topics, format=format)


def _in_columns(reading: Reading, values: list[Floats]) -> Floats | None:
    """(scans, beams) of rows that have a beam each: as many as a laser has, while a row has fewer than any laser."""
    rows, width = len(values), len(values[0])
    if reading.angle_increment is not None or reading.skip_columns is not None or not 2 <= width < rows:
        return None
    if usual_angles(rows) is None or any(usual_angles(width - lead) for lead in range(min(MOST_LEADING, width))):
        return None
    if any(len(row) != width for row in values):
        return None
    table = np.array(values, np.float64)
    return table.T if alike(table) else None


def _check_rows(source: Source, values: list[Floats]) -> None:
    """Raises ValueError if rows are those of poses, or have only a few different numbers, as maps of cells do."""
    if _are_transforms(values):
        raise ValueError(
            f"{source.name} has poses, a matrix in each row as in those of KITTI, and no scans; open its scans instead."
        )
    if len(values) < MANY_ROWS or source.reading.given():
        return
    levels = np.unique(np.concatenate(values[:: max(len(values) // MANY_ROWS, 1)]))
    levels = levels[np.isfinite(levels)]
    if 1 < len(levels) <= FEW_LEVELS:
        shown = ", ".join(f"{level:g}" for level in levels)
        raise ValueError(
            f"{source.name} has only the numbers {shown}, as a map of cells has, and no ranges; open the scans that it "
            "was made of. If these are ranges after all, say so with --columns ranges."
        )


def _are_transforms(values: list[Floats]) -> bool:
    """Whether each row is a rotation and a position: a matrix (3, 4), or (4, 4)."""
    if len(values) < 2 or {len(row) for row in values} not in ({12}, {16}):
        return False
    turns = np.array([row[:12] for row in values], np.float64).reshape(-1, 3, 4)[:, :, :3]
    return bool(np.allclose(turns @ turns.swapaxes(1, 2), np.eye(3), rtol=0, atol=0.01))


def _pairs(values: list[Floats]) -> int:
    """The number of ranges in a row if each is followed by another quantity, such as its intensity; 0 if none is."""
    row, beams = values[0], len(values[0]) // 2
    if len(row) % 2 or beams < LEAST_PAIRS or any(len(each) != len(row) for each in values):
        return 0
    ranges, others = row[::2], row[1::2]
    apart = float(np.nanmedian(np.abs(ranges - others)))
    steps = [float(np.nanmedian(np.abs(np.diff(each)))) for each in (ranges, others)]
    return beams if apart > FAR_APART * max(*steps, 1e-9) else 0


def _halves(values: list[Floats]) -> int:
    """The number of ranges in a row if as many of another quantity follow, such as intensities; 0 if none do."""
    size = len(values[0])
    if size % 2 or any(len(row) != size for row in values) or usual_angles(size) or not usual_angles(size // 2):
        return 0
    half = size // 2
    # The leap is in the middle of every row.
    return half if all(_leaps_at(row, half) for row in values) else 0


def _leaps_at(row: Floats, half: int) -> bool:
    first, second = row[:half], row[half:]
    usual = float(np.nanmedian(first))
    apart = abs(usual - float(np.nanmedian(second)))
    steps = [float(np.nanmedian(np.abs(np.diff(each)))) for each in (first, second)]
    ends = abs(float(np.nanmedian(first[-3:])) - float(np.nanmedian(second[:3])))
    return apart > max(FAR_APART * max(*steps, 1e-9), usual) and ends > apart / 2


def parsed(source: Source, rows: Iterable[Row], dialect: Dialect) -> tuple[list[int], list[Floats], int]:
    """(line numbers, numbers of each row, numbers before the only double space of the first row or 0)."""
    numbers: list[int] = []
    values: list[Floats] = []
    double = None
    words: dict[str, None] = {}
    for number, text in rows:
        if double is None:
            double = _before_double_space(text)
        found = dialect.numbers(text)
        if found is None:
            found, wrong = _with_a_word(dialect, text)
            shown = text_of(wrong[:40])
            if found is None:
                source.notes.skip(f"{source.name}:{number}", f"{shown!r} is not a number; {FORMS}")
            else:
                words.setdefault(shown)
        if found is None:
            continue
        if len(found):
            numbers.append(number)
            values.append(found)
    for word in words:
        source.notes.notice("word", f"{word!r} among the ranges was read as no return.")
    if len(values) <= source.notes.skips:
        source.notes.nothing_left()
        raise ValueError(f"{source.name} has no line of numbers; {FORMS}")
    return numbers, values, double or 0


FORMS = "use one scan per row, or columns of angle and distance, or a table with a column named ranges"


def _with_a_word(dialect: Dialect, text: bytes) -> tuple[Floats | None, bytes]:
    """The numbers of a line, NaN for the one word that recurs among them, if it does; also returns the first word."""
    cells = dialect.cells(text)
    found = [dialect.number(cell) for cell in cells]
    words = [cell for cell, number in zip(cells, found, strict=True) if number is None]
    if len(words) < 2 or len(set(words)) > 1 or 2 * len(words) > len(cells):
        return None, words[0]
    return np.array([math.nan if number is None else number for number in found]), words[0]


def _before_double_space(text: bytes) -> int:
    """Number of values before a double space, if the line has exactly one."""
    parts = re.split(rb" {2,}", text.strip())
    before, after = (len(part.split()) for part in parts) if len(parts) == 2 else (0, 0)
    return before if after > before else 0


def _angle_row(source: Source, reading: Reading, values: list[Floats]) -> Geometry | None:
    """The angles in the first row, if it has numbers that only rise, or only fall, for each of those in the other rows,
    which do not."""
    first, second = values[0], values[1]
    for lead in range(min(4, len(first))):
        angles, others = first[lead:], second[lead:]
        if len(first) not in (len(second), len(second) - lead) or len(angles) < LEAST_BEAMS:
            continue
        alike = (_even, _goes_one_way) if len(angles) >= MANY_BEAMS else (_even,)
        if not np.isfinite(angles).all() or not any(is_one(angles) and not is_one(others) for is_one in alike):
            continue
        unit = reading.angle_unit or angle_unit_of(angles)
        turn = RADIANS[unit]
        if abs(angles[-1] - angles[0]) * turn > 2 * math.pi + 0.1:
            continue
        source.notes.found["angle_unit"] = unit
        source.notes.radians = True
        step = float(angles[-1] - angles[0]) / (len(angles) - 1)
        return Geometry(float(angles[0]) * turn, step * turn, len(angles), None if _even(angles) else angles * turn)
    return None


def _numbers_columns(values: list[Floats]) -> int:
    """How many columns the first row numbers from 0 or 1, as spreadsheets and pandas do; 0 if it does not."""
    for lead in range(min(4, len(values[0]))):
        first, second = values[0][lead:], values[1][lead:]
        if len(first) >= LEAST_BEAMS and first[0] in (0, 1) and (np.diff(first) == 1).all():
            return 0 if len(second) == len(first) and _even(second) else len(first)
    return 0


def _tell_counted(notes: Notes, reading: Reading, angles: Geometry) -> None:
    """Tells that a row that counts was taken for angles in degrees."""
    if reading.angle_min is None and reading.angle_increment is None:
        first, step = usual_angles(angles.beams) or (-angles.beams / 2, 1.0)
        why = "the first row counts, as degrees do, or the numbers of columns"
        last = math.degrees(angles.angle_min) + angles.beams - 1
        change = {"angle_min": round(math.radians(first), 8), "angle_increment": round(math.radians(step), 8)}
        notes.guess("angle_min", f"{math.degrees(angles.angle_min):.0f}…{last:.0f}°", why, **change)


def _even(numbers: Floats) -> bool:
    steps = np.diff(numbers)
    middle = float(np.median(steps))
    return middle != 0 and bool(np.abs(steps - middle).max() <= 0.3 * abs(middle))


def _goes_one_way(numbers: Floats) -> bool:
    """Whether numbers rise, or fall, at every step, as no ranges do from beam to beam."""
    steps = np.diff(numbers)
    return bool((steps > 0).all() or (steps < 0).all())


def _settings_row(values: list[Floats]) -> Geometry | None:
    """The geometry in a short first row that names the number of beams, and a step or the first and the last angle."""
    first, usual = values[0], len(values[1])
    if len(first) >= 0.5 * usual or len(first) < 3 or usual < LEAST_BEAMS:
        return None
    beams = next((int(n) for n in first if n == int(n) and usual - MOST_LEADING <= n <= usual and n > 1), None)
    if beams is None:
        return None
    for low in first:
        for high in first:
            for step in first:
                in_degrees = abs(high) > 2 * math.pi + 0.2 or abs(low) > 2 * math.pi + 0.2
                turn = math.radians(1) if in_degrees else 1.0
                if 0 < step * turn < 0.2 and abs(low + step * (beams - 1) - high) < 2 * step:
                    return Geometry(float(low) * turn, float(step) * turn, beams)
    return None


def _of_one_length(
    source: Source, numbers: list[int], values: list[Floats]
) -> tuple[list[int], list[Floats], str]:  # fmt: skip
    """The rows of one laser, and what it is called, if those of two alternate, which differ in length; or all rows."""
    sizes = Counter(map(len, values))
    changes = sum(len(one) != len(other) for one, other in pairwise(values))
    small, large = min(sizes), max(sizes)
    if len(sizes) != 2 or min(sizes.values()) < LEAST_ALTERNATE or 2 * changes < len(values) or large < 1.2 * small:
        return numbers, values, ""
    counts = {f"{size} numbers": count for size, count in sizes.items()}
    taken = laser_of(source, source.reading, counts, "rows")
    these = [f"{len(row)} numbers" == taken for row in values]
    return list(compress(numbers, these)), list(compress(values, these)), taken


def _whole(
    source: Source, numbers: list[int], values: list[Floats], exact: bool
) -> tuple[list[int], list[Floats]]:  # fmt: skip
    """The rows whose length is about the usual one, or is exactly so long; others are skipped."""
    usual = Counter(map(len, values)).most_common(1)[0][0]
    near = [abs(len(row) - usual) <= (0 if exact else VARIES * usual) for row in values]
    for number, row, good in zip(numbers, values, near, strict=True):
        if not good:
            why = f"{len(row)} ranges, but other scans have {usual}; is the line complete?"
            source.notes.skip(f"{source.name}:{number}", why)
    if sum(near) <= len(near) / 2:
        source.notes.nothing_left()
    return (
        [number for number, good in zip(numbers, near, strict=True) if good],
        [row for row, good in zip(values, near, strict=True) if good],
    )


# Leading columns


def _skipped(
    source: Source, reading: Reading, values: list[Floats], leading: tuple[str, ...] | None,
    geometry: Geometry | None, double: int,
) -> int:  # fmt: skip
    """The number of columns before the ranges."""
    if leading is not None:
        return len(leading)
    if reading.skip_columns is not None:
        return reading.skip_columns
    usual = Counter(map(len, values)).most_common(1)[0][0]
    if geometry is not None and 0 <= usual - geometry.beams <= MOST_LEADING:
        return usual - geometry.beams
    skip = double or _unlike(values)
    if reading.angle_increment is None and usual_angles(usual - skip) is None:
        leads = range(skip + 1, MOST_SETTINGS)
        skip = next((lead for lead in leads if usual - lead in LASERS and _leaps(values, lead)), skip)
    if skip:
        why = "they differ from the numbers after them"
        source.notes.guess("skip_columns", f"{skip} leading column{'' if skip == 1 else 's'}", why, skip_columns=0)
    source.notes.found["skip_columns"] = skip
    return skip


def _without_trailing(source: Source, values: list[Floats], skip: int) -> list[Floats]:
    """The rows without what follows the ranges of a known laser, such as a pose."""
    sizes = {len(row) for row in values}
    (size,) = sizes if len(sizes) == 1 else (0,)
    if not size or usual_angles(size - skip) is not None:
        return values
    backwards = [row[::-1] for row in values]
    found = (more for more in range(1, MOST_SETTINGS) if size - skip - more in LASERS and _leaps(backwards, more))
    if not (more := next(found, 0)):
        return values
    words = ",".join([*["-"] * skip, "ranges", *["-"] * more])
    what = "column" if more == 1 else f"{more} columns"
    source.notes.notice(
        "trailing",
        f"The last {what} of each row {'was' if more == 1 else 'were'} left out, because {size - skip - more} ranges "
        f"before make a usual laser. The flag --columns names them, as --columns={words} does.",
    )
    return [row[:-more] for row in values]


def _unlike(values: list[Floats]) -> int:
    """The number of leading columns that are no ranges: stamps, which rise from row to row, or are far too large."""
    width = min(map(len, values))
    table = np.array([row[: min(width, MOST_LEADING + 3)] for row in values])
    tops = np.array(
        [np.nanmax(np.abs(np.where(np.isfinite(row), row, np.nan))[len(row) // 4 :], initial=0) for row in values]
    )
    skip = 0
    for lead in range(min(MOST_LEADING, table.shape[1] - 3)):
        column = table[:, lead]
        rises = len(column) >= 3 and _rises(column)
        huge = bool((np.abs(column) > 50 * np.maximum(tops, 1e-9)).mean() > 0.5)
        if huge or (rises and _leaps(values, lead + 1)):
            skip = lead + 1
    return skip


def _rises(column: Floats) -> bool:
    """Whether numbers rise from row to row, as a counter does, perhaps but for where it wraps at 2³²."""
    steps = np.diff(column)
    falls = steps[~(steps > 0)].tolist()
    return len(falls) <= max(1, len(steps) // 10) and all(map(wrap_of, falls))


def _leaps(values: list[Floats], lead: int) -> bool:
    """Whether the last of `lead` columns differs from the first ranges much more than neighbouring ranges do.

    Some of these may stand for no return, so the nearest of several counts.
    """
    gaps = np.array([np.nanmin(np.abs(row[lead - 1] - row[lead : lead + 5]), initial=np.inf) for row in values])
    usual = np.concatenate([np.abs(np.diff(row[lead:])) for row in values])
    gaps, usual = gaps[np.isfinite(gaps)], usual[~np.isnan(usual)]
    return bool(gaps.size and usual.size and np.median(gaps) > 8 * max(float(np.median(usual)), 1e-9))


def _stamps(
    source: Source, values: list[Floats], skip: int, leading: tuple[str, ...] | None, moved: int
) -> Floats:  # fmt: skip
    """(rows,) [s]: the leading column of stamps, or one that rises from row to row; 0 without one.

    moved: how many of the leading columns are the last ones in the file.
    """
    if leading is not None:
        at = leading.index("stamp") if "stamp" in leading else None
    else:
        columns = [np.array([row[lead] for row in values]) for lead in range(min(skip, MOST_LEADING))]
        rising = [lead for lead, column in enumerate(columns) if len(column) > 1 and _rises(column)]
        # A column that counts the rows is a time only if there is no other.
        timed = [lead for lead in rising if not (np.diff(columns[lead]) == 1).all()]
        at = next(iter(timed or rising), None)
    if at is None:
        return np.zeros(len(values))
    raw = np.array([row[at] for row in values])
    column = unwrapped(raw)
    if (column != raw).any():
        source.notes.notice("wraps", "The stamps wrap at 2³², and were counted on.")
    times, words = in_seconds(column)
    source.notes.stamps = f"column {(at - moved) % len(values[0]) + 1}"
    if leading is None:
        source.notes.guess("stamps", f"column {at + 1} as {words}", "it rises from row to row", stamps="none")
    return times


def _lasers(values: list[Floats], skip: int) -> list[str]:
    """(rows,) the number of each row's laser, if a leading column has a few whole numbers in turn, and rows of one
    number are alike while those of two are not; otherwise ""."""
    for lead in range(min(skip, MOST_LEADING)):
        column = np.array([row[lead] for row in values])
        count = len(np.unique(column))
        repeats = column[count:] == column[:-count]
        if 2 <= count <= MOST_LASERS and len(repeats) >= count and repeats.all() and (column == np.floor(column)).all():
            near, far = (_differ([row[skip:] for row in values], after) for after in (1, count))
            return [f"{laser:.0f}" for laser in column.tolist()] if near > UNLIKE * far else [""] * len(values)
    return [""] * len(values)


def _differ(rows: list[Floats], after: int) -> float:
    """How much rows differ from those so many rows later; inf if their lengths do."""
    pairs = list(zip(rows, rows[after:], strict=False))
    if any(len(one) != len(other) for one, other in pairs):
        return math.inf
    both = (np.isfinite(one) & np.isfinite(other) for one, other in pairs)
    gaps = [np.median(np.abs(one - other)[seen]) for (one, other), seen in zip(pairs, both, strict=True) if seen.any()]
    return float(np.median(gaps)) if gaps else math.inf


# Angles


def _angles(
    source: Source, reading: Reading, rows: list[Floats], beams: int, geometry: Geometry | None
) -> tuple[float, float]:
    """angle_min and angle_increment [rad]: as given, as the file says, or of the common laser with so many beams.

    rows: the ranges of the scans.
    """
    usual = usual_angles(beams)
    if usual is not None and abs(usual[1] * beams - 360) < usual[1] / 2 and _leap_at_seam(rows, beams):
        # No full circle: half of one, at half the steps.
        usual = (usual[0] / 2, usual[1] / 2)
    low, step = (math.nan, math.nan) if usual is None else map(math.radians, usual)
    if geometry is not None:
        low, step = geometry.angle_min, geometry.increment
    stated = reading.angle_min is not None and reading.angle_increment is not None
    step = step if reading.angle_increment is None else reading.angle_increment
    low = low if reading.angle_min is None else reading.angle_min
    if geometry is None and usual is None and not math.isnan(step) and math.isnan(low):
        low = -step * (beams - 1) / 2
    if math.isnan(step) or math.isnan(low):
        raise ValueError(
            f"{source.name}: rows of {beams} numbers without angles; give angle_increment, and angle_min unless 0° "
            "is in the middle. If not all numbers are ranges, give skip_columns, or columns such as -,ranges,-,-."
        )
    if geometry is None and not stated:
        tell_usual_angles(source.notes, reading, "the rows have", beams, low, step)
    else:
        tell_unknown_direction(source.notes, reading)
    return low, step


def _leap_at_seam(rows: list[Floats], beams: int) -> bool:
    """Whether in nearly all scans of so many beams the last range is far from the first, where neighbours in a circle
    would be near.

    False if neighbours elsewhere are as far apart in nearly all of them, as they may be while a laser stands still.
    """
    ranges = np.array([row for row in rows[:: max(len(rows) // MANY_SCANS, 1)] if len(row) == beams])
    ranges = np.where(np.isfinite(ranges) & (ranges > 0), ranges, np.nan)
    ranges = ranges[np.isfinite(ranges[:, [0, -1]]).all(axis=1)]
    if len(ranges) < FEW_SCANS:
        return False
    steps = np.abs(np.diff(ranges, axis=1, append=ranges[:, :1]))
    far = (steps > FAR_APART * np.nanmedian(steps, axis=1, keepdims=True)) & (
        steps > SEAM_SHARE * np.nanmedian(ranges, axis=1, keepdims=True)
    )
    *inside, seam = far.mean(axis=0) > NEARLY_ALL
    return bool(seam and not any(inside))


def tell_usual_angles(notes: Notes, reading: Reading, where: str, beams: int, low: float, step: float) -> None:
    """Tells, once, that angles [rad] are those of a common laser. where: begins the reason, such as "the rows have"."""
    if any(guess.field == "angle_min" for guess in notes.guesses):
        return
    first, last = math.degrees(low), math.degrees(low + step * (beams - 1))
    why = f"{where} {beams} ranges and no angles"
    # Beams might be counted from 0° instead, or from −180° if they are already.
    other = {"angle_min": 0.0 if low else -3.141593, "angle_increment": round(step, 8)}
    notes.guess("angle_min", f"{first:.4g}…{last:.4g}°".replace("-", "−"), why, **other)
    if reading.direction is None:
        notes.guess("direction", "counter-clockwise", why, direction="clockwise")


def usual_angles(beams: int) -> tuple[float, float] | None:
    """angle_min and angle_increment [deg] of a laser with so many beams: from the table, or even steps of a view."""
    if beams in LASERS:
        return LASERS[beams]
    for step in STEPS:
        for view in VIEWS:
            if abs((beams - 1) * step - view) < 1e-6:
                return -view / 2, step
    whole = next((step for step in (0.5, 0.25, 0.2, 0.1) if beams * step == 360), None)
    return None if whole is None else (-180.0, whole)
