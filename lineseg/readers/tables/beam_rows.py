"""Text with one beam per row: angle and distance, or x and y, perhaps with other columns."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scan import Floats, Recording, Topic
from ..account import Notes
from ..guessing import FAR, MOST_DEGREES, angle_unit_of, guess_angle_unit, middle_of, rising, unit_of
from ..reading import METRES, RADIANS, Direction, Reading
from ..source import Source, Sweeps
from ..stamping import in_seconds
from .dialect import LEFT_OUT, Dialect, Row
from .headers import (
    LENGTHS,
    SCANS,
    STAMPS,
    TIMES,
    TURNS,
    Name,
    column_of,
    distance_of,
    is_angle,
)
from .scan_columns import alike, tell_columns, tell_unknown_direction, with_angles
from .scan_rows import scans_of
from .turns import evenness, regularity, turns

# The steps of real angles are about equal; those of other columns are not.
LEAST_REGULAR = 0.5
# Fewer beams show nothing about their columns.
FEW_ROWS = 8
# Of so many rows, most turns have more than FEW_ROWS.
LEAST_ROWS = 30
LONGEST_NAME = 24
# With fewer angles among the rows than this, the column is no angle.
MOST_WITH_ANGLE = 0.9
CLOCKWISE = re.compile(r"(?<!counter_)(?<!anti_)(?:clockwise|(?<![^_])cw(?![^_]))")
# What poses have beside x and y; the first column of the quaternion in TUM's rows.
HEADINGS, QUATERNION = {"heading", "yaw"}, 4
# Headings that differ, and agree with the ways of the moves (`_unity`).
SPREAD_HEADINGS, ONE_WAY, MOST_MOVES = 0.98, 0.95, 2000
# More columns hold more than the time and a path, which may be below 0 in more than a few places.
# Columns that count, such as times and angles, have about equal steps.
MOST_OF_PATH, FEW_BELOW, EVEN = 4, 0.05, 0.01
# Paths begin within so many steps of zero, or have bearings that are less even than this.
NEAR_ZERO, OF_PATH = 2.5, 0.25
# No laser reaches so far [m].
MOST_METRES = 500.0
# Points of one plane differ less in height [m], but for a few.
FLAT = 0.05
# Codes for "no return" are few.
FEW_CODES = 3
# Points around a laser are not all in a spot that is so much smaller than its distance.
FAR_OFF = 0.02
# Points lie on their beams but for rounding [rad].
AGREE = 0.02
# Lower numbers than a laser's quality may be those of scans.
LEAST_QUALITY = 8
# What pandas and numpy print where they leave rows out.
LEFT_OUT_CELLS = {b"..", b"..."}


class Roles(NamedTuple):
    """The columns of a beam; polar: angle and distance instead of x and y; scan, stamp: None without them."""

    polar: bool
    first: int
    second: int
    scan: int | None = None
    stamp: int | None = None


def read_beams(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name] | None,
    guess_direction: bool = True,
) -> Recording:  # fmt: skip
    """The scans of rows that hold a beam each. names: of the columns, None to guess what they hold."""
    roles = None if names is None else _named(names)
    needed = None if roles is None else (roles.first, roles.second)
    return beams_of(source, reading, table_of(source, rows, dialect, names, needed), names, guess_direction)


def beams_of(
    source: Source, reading: Reading, table: NDArray[np.float64], names: list[Name] | None,
    guess_direction: bool = True, format: str = "text",
) -> Recording:  # fmt: skip
    """The scans of a table (beams, columns)."""
    if _are_poses(table, names):
        way = "" if names is not None else " If it has beams after all, say what the columns hold with --columns."
        raise ValueError(
            f"{source.name} has poses, not scans; open the recording of the scans, and name this file there as its "
            f"trajectory.{way}"
        )
    if names is not None or table.shape[1] > 2:
        _check_path(source, table, names)
    if names is not None:
        return with_roles(source, reading, table, names, _varied(source, table, names), guess_direction, format)
    if table.shape[1] > 2 and alike(table):
        return scans_of(source, reading, list(range(1, len(table) + 1)), list(table), 0, None, format)
    roles = _guessed(source, table)
    others = [column for column in range(table.shape[1]) if column != roles.first]
    if roles.polar and len(others) > 1 and alike(table[:, others]):
        return columns_beside(source, reading, table, roles.first, others, format)
    return with_roles(source, reading, table, None, roles, guess_direction, format)


def _are_poses(table: NDArray[np.float64], names: list[Name] | None) -> bool:
    """Whether rows hold a position with a heading or a quaternion, as trajectories do."""
    if names is None:
        norms = np.linalg.norm(table[:, QUATERNION:], axis=1)
        return (table.shape[1] == QUATERNION + 4 and np.allclose(norms, 1, 0, 0.01)) or _moves_ahead(table)
    if _named(names).polar:
        return False
    words = {name.plain.split("_")[-1] for name in names}
    if {"qz", "qw"} <= words or words & HEADINGS or any(name.ends("orientation_w") for name in names):
        return True
    angle, points = column_of(names, is_angle), _points(names)
    if angle is None or points is None:
        return False
    angles = _radians(table[np.isfinite(table[:, angle]), angle])
    return len(angles) < len(table) or _sense_of(table[:, points], angles) is None


def _check_path(source: Source, table: NDArray[np.float64], names: list[Name] | None) -> None:
    """Raises ValueError if x and y are those of a robot that moves, and not of points around a laser."""
    if source.reading.columns is not None or len(table) < LEAST_ROWS:
        return
    if names is not None:
        points = None if _named(names).polar else _points(names)
        found = points if points is not None and _is_path(table[:, points]) else None
    else:
        first = int(table.shape[1] > 2 and bool((np.diff(table[:, 0]) >= 0).all()))
        pairs = [(x, x + 1) for x in range(first, min(2, table.shape[1] - 1))]
        found = next((pair for pair in pairs if table.shape[1] <= MOST_OF_PATH and _goes_about(table[:, pair])), None)
    if found is not None:
        words = ["-"] * table.shape[1]
        words[found[0]], words[found[1]] = "x", "y"
        raise ValueError(
            f"{source.name} has x and y along a path, as a robot drives it, and no scans; open its scans instead. If "
            f"these are points around the laser, say so with --columns={','.join(words)}."
        )


def _goes_about(xy: NDArray[np.float64]) -> bool:
    """Whether two columns without names may be a path: they do not count evenly, and are not all above 0."""
    if not ((xy < 0).mean(axis=0) > FEW_BELOW).any() and not _begins_at_zero(xy):
        return False
    steps = np.abs(np.diff(xy, axis=0))
    usual = np.median(steps, axis=0)
    even = (np.median(np.abs(steps - usual), axis=0) <= EVEN * usual).any()
    return not even and _is_path(xy)


def _begins_at_zero(xy: NDArray[np.float64]) -> bool:
    """Whether points (n, 2) begin nearer to zero than a few of their steps, where no laser sees anything."""
    steps = np.hypot(*np.diff(xy, axis=0).T)
    return bool(np.hypot(*xy[0]) < NEAR_ZERO * middle_of(np.sort(steps)))


def _is_path(xy: NDArray[np.float64]) -> bool:
    """Whether points (n, 2) follow each other smoothly from zero on, or while their bearings do not go on evenly."""
    xy = xy[:MOST_MOVES][xy[:MOST_MOVES].any(axis=1)]
    if len(xy) < LEAST_ROWS or not np.isfinite(xy).all():
        return False
    steps = np.diff(xy, axis=0)
    lengths = np.hypot(*steps.T)
    # Where a robot stands still, noise moves it.
    steps = steps[(lengths > 0) & (lengths >= 0.5 * np.median(lengths))]
    sweeps = regularity(np.arctan2(xy[:, 1], xy[:, 0])) < OF_PATH and not _begins_at_zero(xy)
    return len(steps) >= FEW_ROWS and not sweeps and _unity(np.diff(np.arctan2(steps[:, 1], steps[:, 0]))) > ONE_WAY


def _moves_ahead(table: NDArray[np.float64]) -> bool:
    """Whether columns hold x and y, and a later one the heading in which they move, as odometry has them."""
    table = table[:MOST_MOVES]
    if table.shape[1] < 3 or len(table) < LEAST_ROWS or not np.isfinite(table).all():
        return False
    for x in range(min(2, table.shape[1] - 2)):
        steps = np.diff(table[:, x : x + 2], axis=0)
        lengths = np.hypot(*steps.T)
        # Where a robot stands still, noise moves it.
        moves = (lengths > 0) & (lengths >= np.median(lengths))
        ways = np.arctan2(steps[moves, 1], steps[moves, 0])
        for column in range(x + 2, table.shape[1]):
            headings = _radians(table[:, column])
            if (
                len(ways) >= FEW_ROWS
                and _unity(headings) < SPREAD_HEADINGS
                and _unity(ways - headings[:-1][moves]) > ONE_WAY
                and _sense_of(table[:, x : x + 2], headings) is None
            ):
                return True
    return False


def _unity(angles: Floats) -> float:
    """1 if all angles [rad] are equal, about 0 if they are spread over a turn."""
    return abs(complex(np.mean(np.exp(1j * angles))))


def with_roles(
    source: Source, reading: Reading, table: NDArray[np.float64], names: list[Name] | None, roles: Roles,
    guess_direction: bool, format: str,
) -> Recording:  # fmt: skip
    """The scans of a table (beams, columns) whose columns have these roles. names: of the columns, None without."""
    notes = source.notes
    if not roles.polar:
        # A point at the laser, or nowhere, is a beam without a return; it has no bearing.
        points = table[:, [roles.first, roles.second]]
        table = table[points.any(axis=1) & np.isfinite(points).all(axis=1)]
        if not len(table):
            raise ValueError(f"{source.name} has no point away from the laser; is the file complete?")
        _check_around(source, table[:, [roles.first, roles.second]])
        if names is not None and (z := column_of(names, lambda name: name.plain.split("_")[-1] == "z")) is not None:
            table = _in_plane(source, table, roles, z)
    if names is not None:
        _take_units(source, reading, names, roles)
    if "unit" not in notes.found:
        notes.unstated.add("unit")
    first, second = (_scaled(table, names, column) for column in (roles.first, roles.second))
    if roles.polar and (there := np.isfinite(first)).any() and not there.all() and there.mean() > MOST_WITH_ANGLE:
        for at in np.flatnonzero(~there).tolist():
            notes.skip(f"row {at + 1} of the beams", "it has no angle")
        table, first, second = table[there], first[there], second[there]
    bearings, ranges = _polar(source, reading, first, second) if roles.polar else _from_points(first, second)
    if roles.polar and names is not None and CLOCKWISE.search(names[roles.first].plain):
        notes.found["direction"] = "clockwise"
    elif roles.polar and names is not None and (points := _points(names, table, ranges)) is not None:
        sense = _sense_of(table[:, points], bearings)
        if sense is None:
            # Such as angles from north: what x and y say needs no guess.
            notes.guesses = [guess for guess in notes.guesses if guess.field != "angle_unit"]
            roles = Roles(False, *points, roles.scan, roles.stamp)
            return with_roles(source, reading, table, names, roles, guess_direction, format)
        notes.found["direction"] = sense
    elif roles.polar and (clockwise := notes.clockwise or _why_clockwise(notes)) and reading.direction is None:
        notes.found["direction"] = "clockwise"
        notes.guess("direction", "clockwise", clockwise, direction="counter-clockwise")
    elif roles.polar and guess_direction:
        tell_unknown_direction(notes, reading)
    notes.radians = True
    notes.unstated.add("range_max")
    return replace(_recording(source, table, roles, bearings, ranges, names), format=format)


def _check_around(source: Source, points: NDArray[np.float64]) -> None:
    """Raises ValueError if points (n, 2) all lie far away in one direction, as the places on a map do."""
    if source.reading.columns is not None or len(points) < LEAST_ROWS:
        return
    middle = points.mean(axis=0)
    across = np.quantile(np.hypot(*(points - middle).T), 0.9)
    if across < FAR_OFF * np.hypot(*middle):
        x, y = middle
        raise ValueError(
            f"{source.name} has points near x = {x:.6g}, y = {y:.6g}, far from zero, where a laser would be; they may "
            "be places on a map, or in the world. Save x and y as the laser sees them, from its own place."
        )


def _why_clockwise(notes: Notes) -> str:
    """Why angles count clockwise by their unit alone; "" if nothing says so."""
    of_ticks = notes.found.get("angle_unit") == "1/64deg"
    return "an RPLIDAR counts 64ths of a degree, and clockwise" if of_ticks else ""


def _in_plane(source: Source, table: NDArray[np.float64], roles: Roles, z: int) -> NDArray[np.float64]:
    """The table with x and y in the plane of the scan, which is told if it is not that of x and y.

    In cameras and games, y is up or down, z ahead and x to the right. Raises ValueError for the points of many planes.
    """
    there = np.isfinite(table[:, [roles.first, roles.second, z]]).all(axis=1)
    heights = [np.ptp(_between(table[there, column])) for column in (roles.second, z)]
    usual = np.median(np.hypot(table[there, roles.first], table[there, z])) if there.any() else 0.0
    # Millimetres are told from metres by what they are in the plane.
    flat = FLAT if usual < FAR else 1000 * FLAT
    if heights[1] <= flat:
        return table
    check_flat(source.name, table[there, roles.second if heights[0] <= flat else z], flat)
    source.notes.guess(
        "direction", "The scan has z ahead and x to the right, because all points have about the same y",
        "the file does not say where ahead is", direction="clockwise",
    )  # fmt: skip
    moved = table.copy()
    moved[:, roles.first], moved[:, roles.second] = table[:, z], -table[:, roles.first]
    return moved


def _between(heights: NDArray) -> NDArray[np.float64]:
    """(2,): between which heights most points lie."""
    return np.quantile(heights, (0.05, 0.95)) if len(heights) else np.zeros(2)


def check_flat(file: str, heights: NDArray, flat: float = FLAT, unit: str = "") -> None:
    """Raises ValueError for the points of many planes. unit: of the heights, for the sentence."""
    low, high = _between(heights)
    if high - low > flat:
        raise ValueError(
            f"{file} has points from {low:.3g} to {high:.3g}{unit} in height, but a scan lies in one plane; cut a "
            "slice out of it first, as the node pointcloud_to_laserscan does."
        )


def _sense_of(xy: NDArray[np.float64], bearings: Floats) -> Direction | None:
    """The sense in which bearings [rad] count, if the points (n, 2) beside them agree; None otherwise."""
    there = xy.any(axis=1) & np.isfinite(xy).all(axis=1)
    points = np.arctan2(xy[there, 1], xy[there, 0])
    senses: tuple[tuple[Direction, float], ...] = (("counter-clockwise", 1.0), ("clockwise", -1.0))
    for sense, sign in senses:
        if len(points) and np.median(np.abs(np.angle(np.exp(1j * (points - sign * bearings[there]))))) < AGREE:
            return sense
    return None


def columns_beside(
    source: Source, reading: Reading, table: NDArray[np.float64], angle: int, columns: list[int], format: str = "text"
) -> Recording:
    """The scans of a table whose columns have a scan each, beside one of angles."""
    if len(columns) > 1:
        tell_columns(source.notes, len(columns))
    source.notes.guesses = [guess for guess in source.notes.guesses if guess.field != "columns"]
    source.notes.found.pop("columns", None)
    if "unit" not in source.notes.found:
        source.notes.unstated.add("unit")
    return with_angles(source, table[:, columns].T, table[:, angle], None, format)


def _scaled(table: NDArray[np.float64], names: list[Name] | None, column: int) -> Floats:
    return table[:, column] if names is None else table[:, column] * names[column].scale


def _named(names: list[Name]) -> Roles:
    scan = column_of(names, lambda name: name.plain in SCANS)
    stamp = column_of(names, lambda name: name.plain in STAMPS)
    angle, distance = column_of(names, is_angle), distance_of(names)
    if angle is not None and distance is not None:
        return Roles(True, angle, distance, scan, stamp)
    points = _points(names)
    assert points is not None
    return Roles(False, *points, scan, stamp)


def _varied(source: Source, table: NDArray[np.float64], names: list[Name]) -> Roles:
    """The columns by their names; x and y if the angles are all equal. Raises ValueError if there is no such pair."""
    roles = _named(names)
    if not roles.polar or len(table) < FEW_ROWS or np.nanmax(table[:, roles.first]) > np.nanmin(table[:, roles.first]):
        return roles
    if (points := _points(names)) is not None:
        return Roles(False, *points, roles.scan, roles.stamp)
    check_angles(source, table, roles.first)
    return roles


def check_angles(source: Source, table: NDArray[np.float64], at: int) -> None:
    """Raises ValueError if a column that is called after angles has the same one in all rows."""
    angles = table[:, at]
    if source.reading.columns is None and len(table) >= FEW_ROWS and np.nanmax(angles) == np.nanmin(angles):
        raise ValueError(
            f"{source.name}: column {at + 1}, of angles, has {angles[0]:.6g} in all rows, but each beam of a scan has "
            "its own angle; say what the columns hold with --columns, such as angle,distance."
        )


def _points(
    names: list[Name], table: NDArray[np.float64] | None = None, ranges: Floats | None = None
) -> tuple[int, int] | None:
    """The columns of x and y, if there are both; beside ranges, only if the points are so far away."""
    x, y = (column_of(names, lambda name, axis=axis: name.plain.split("_")[-1] == axis) for axis in "xy")
    if x is None or y is None:
        return None
    if table is not None and ranges is not None:
        there = (ranges > 0) & np.isfinite(table[:, x]) & (table[:, [x, y]] != 0).any(axis=1)
        scales = np.hypot(table[there, x], table[there, y]) / ranges[there]
        if not len(scales) or np.median(np.abs(scales / np.median(scales) - 1)) > AGREE:
            return None
    return x, y


def table_of(
    source: Source, rows: Iterable[Row], dialect: Dialect, names: list[Name] | None, needed: Sequence[int] | None
) -> NDArray[np.float64]:
    """(rows, columns): the numbers of all rows, NaN for other words in columns that are not needed, None for all."""
    width = 0 if names is None else len(names)
    # Spreadsheets end with rows of empty cells.
    rows = [row for row in rows if row.text.strip(b" ,;\t|\r")]
    if (whole := _plain_table(rows, dialect, width)) is not None:
        return whole
    source.notes.skipping = "line"
    table: list[list[float]] = []
    for row in rows:
        cells = dialect.cells(row.text)
        if cells and set(cells) <= LEFT_OUT_CELLS:
            raise ValueError(f"{source.name}:{row.number}: {LEFT_OUT}.")
        if len(cells) == width - 1 and row.text.rstrip(b" \r").endswith(dialect.separator):
            cells.append(b"")
        width = width or len(cells)
        if len(cells) < width:
            shown = ", ".join(name.plain[:LONGEST_NAME] for name in names) if names else "angle, distance"
            source.notes.skip(
                f"{source.name}:{row.number}", f"{len(cells)} of {width} columns ({shown}); is the line complete?"
            )
            continue
        values = [dialect.number(cell) for cell in cells[:width]]
        wrong = next((at for at in (range(min(2, width)) if needed is None else needed) if values[at] is None), None)
        if wrong is not None:
            shown = cells[wrong][:40].decode("utf-8", "replace")
            source.notes.skip(f"{source.name}:{row.number}", f"{shown!r} is not a number")
            continue
        table.append([math.nan if value is None else value for value in values])
    if len(table) <= source.notes.skips:
        source.notes.nothing_left()
        raise ValueError(f"{source.name} has column names, but no line of numbers below them.")
    return np.array(table)


def _plain_table(rows: list[Row], dialect: Dialect, width: int) -> NDArray[np.float64] | None:
    """(rows, columns): the numbers of rows that have nothing else, all at once; None if they have."""
    width = width or (dialect.width(rows[0].text) if rows else 0)
    texts = [row.text for row in rows]
    whole, mark = b"\n".join(texts), dialect.separator
    # A mark too few or at the end of a row is a number too few in the end.
    widths = {len(text.split()) for text in texts} if mark == b" " else {text.count(mark) + 1 for text in texts}
    if widths - {width, width + 1} or len(widths) != 1 or b'"' in whole:
        return None
    values = dialect.numbers(whole)
    if values is None or len(values) != len(rows) * width:
        return None
    return np.asarray(values, np.float64).reshape(len(rows), width)


def _guessed(source: Source, table: NDArray[np.float64]) -> Roles:
    """What columns without names hold: the angle is the one whose steps are about equal; or bearings of x and y are."""
    if table.shape[1] < 2:
        raise ValueError(f"{source.name} has {len(table)} rows of one number; is the file complete?")
    score, roles = columns_of_beam(table)
    if len(table) < FEW_ROWS:
        score, roles = 0.0, Roles(True, 0, 1)
    if table.shape[1] == 2 and not (roles.polar and score <= LEAST_REGULAR):
        _check_path(source, table, None)
    if score > LEAST_REGULAR:
        raise ValueError(
            f"{source.name} has rows of {table.shape[1]} numbers of which none is an angle that rises or falls evenly; "
            "say what the columns hold with --columns, such as angle,distance or x,y."
        )
    words = ["-"] * table.shape[1]
    words[roles.first], words[roles.second] = ("angle", "distance") if roles.polar else ("x", "y")
    named = ",".join(words)
    source.notes.found["columns"] = named
    other = ["-"] * table.shape[1]
    other[roles.first], other[roles.second] = ("x", "y") if roles.polar else ("angle", "distance")
    source.notes.guess("columns", named, "the columns have no names", columns=",".join(other))
    if roles.polar and _are_of_rplidar(table, roles):
        source.notes.clockwise = "a quality, degrees and millimetres are in the order of the package rplidar"
    return roles


def _are_of_rplidar(table: NDArray[np.float64], roles: Roles) -> bool:
    """Whether columns are a quality of 6 bits, an angle in degrees and a distance in millimetres, in this order."""
    if roles.first < 1 or roles.second != roles.first + 1:
        return False
    quality, angles, distances = (table[:, roles.first + at] for at in (-1, 0, 1))
    return bool(
        ((quality >= 0) & (quality < 64) & (quality == np.floor(quality))).all()
        and np.median(quality) >= LEAST_QUALITY
        and not _counts(quality)
        and angle_unit_of(angles) == "deg"
        and unit_of(rising(distances)) == "mm"
    )


def words_of(source: Source, table: NDArray[np.float64]) -> tuple[str, ...]:
    """What columns without names hold, which is told as a guess; the third of points is their height."""
    roles = _guessed(source, table)
    words = ["-"] * table.shape[1]
    words[roles.first], words[roles.second] = ("angle", "distance") if roles.polar else ("x", "y")
    if words[:3] == ["x", "y", "-"]:
        words[2] = "z"
    return tuple(words)


def columns_of_beam(table: NDArray[np.float64]) -> tuple[float, Roles]:
    """The likeliest columns of a beam, and how unequal the steps of their angles are (`regularity`)."""
    columns = np.flatnonzero(np.isfinite(table).mean(axis=0) > 0.5).tolist()
    possible: list[Roles] = []
    for angle in columns:
        if np.nanmax(np.abs(table[:, angle])) <= MOST_DEGREES:
            partner = _distance_beside(table, columns, angle)
            if partner is not None:
                possible.append(Roles(True, angle, partner))
    if len(columns) >= 2:
        possible.append(Roles(False, columns[0], columns[1]))
    if len(columns) >= 3 and _is_number_of_row(table[:, columns[0]]):
        points = Roles(False, columns[1], columns[2])
        score = regularity(bearings_of(table, points))
        if score <= LEAST_REGULAR and not any(_counts(table[:, at]) for at in columns[1:3]):
            return score, points
    found = [(evenness(bearings_of(table, roles)), roles) for roles in possible]
    # The number of a beam counts as evenly as its angle, which is nearer to the distance.
    order = lambda each: (round(each[0], 2), abs(each[1].first - each[1].second))  # noqa: E731
    return min(found, key=order, default=(math.inf, Roles(True, 0, 1)))


def bearings_of(table: NDArray[np.float64], roles: Roles) -> Floats:
    """The bearings [rad] of beams, with the likeliest unit of their angles."""
    first, second = table[:, roles.first], table[:, roles.second]
    return _radians(first) if roles.polar else _from_points(first, second)[0]


def _distance_beside(table: NDArray[np.float64], columns: list[int], angle: int) -> int | None:
    """The column of distances: the first after the angle, or else before it, that varies and is not negative."""
    order = sorted((at for at in columns if at != angle), key=lambda at: (at < angle, abs(at - angle)))
    # A code for "no return" may be negative; distances are not, and those of stamps are out of reach.
    order = [at for at in order if len(np.unique(table[table[:, at] < 0, at])) <= FEW_CODES
             and not np.nanmedian(table[:, at]) * METRES["um"] > MOST_METRES]  # fmt: skip
    if len(order) > 1:
        order = [at for at in order if not _counts(table[:, at])] or order
    if len(order) < 2:
        return order[0] if order else None
    found = (np.unique(table[np.isfinite(table[:, at]), at]) for at in order)
    varied = (at for at, values in zip(order, found, strict=True) if len(values) > min(3, len(table) - 1))
    return next(varied, order[0])


def _counts(column: Floats) -> bool:
    """Whether nearly all steps of a column are equal, as those of numbers and angles are."""
    steps = np.diff(column[np.isfinite(column)])
    usual = middle_of(np.sort(steps))
    return usual != 0 and len(steps) >= FEW_ROWS and bool((np.abs(steps - usual) <= EVEN * abs(usual)).mean() > 0.9)


def _is_number_of_row(column: Floats) -> bool:
    return column[0] in (0, 1) and bool((np.diff(column) == 1).all())


def _radians(angles: Floats) -> Floats:
    return angles * RADIANS[angle_unit_of(angles)]


def _take_units(source: Source, reading: Reading, names: list[Name], roles: Roles) -> None:
    found = source.notes.found
    if reading.unit is None and (unit := LENGTHS.get(names[roles.second].unit)):
        found["unit"] = unit
    if roles.polar and reading.angle_unit is None and (turn := TURNS.get(names[roles.first].unit)):
        found["angle_unit"] = turn


def _polar(source: Source, reading: Reading, angles: Floats, distances: Floats) -> tuple[Floats, Floats]:
    if not np.isfinite(angles).all():
        raise ValueError(f"{source.name}: an angle is not a finite number; each beam needs its own.")
    return angles * RADIANS[guess_angle_unit(angles, reading, source.notes)], distances


def _in_order(source: Source, bearings: Floats) -> NDArray[np.int64]:
    """The order in which shuffled beams rise, which is told. Raises ValueError if they are not those of one scan."""
    order = np.argsort(bearings)
    steps = np.diff(bearings[order])
    if not (steps > 0).all() or regularity(bearings[order]) > LEAST_REGULAR:
        raise ValueError(
            f"{source.name}: the angles of {len(bearings)} rows neither rise nor fall, as those of a scan do."
        )
    source.notes.notice("order", "The rows were in no order, and were sorted by their angles.")
    return order


def _from_points(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    return np.arctan2(y, x), np.hypot(x, y)


def _are_scattered(scans: Floats) -> bool:
    """Whether rows of one scan do not stand together, although scans have many rows."""
    runs = np.count_nonzero(np.diff(scans)) + 1
    return bool(runs * FEW_ROWS > len(scans) > LEAST_ROWS * len(np.unique(scans)))


def _recording(
    source: Source, table: NDArray[np.float64], roles: Roles, bearings: Floats, ranges: Floats,
    names: list[Name] | None,
) -> Recording:  # fmt: skip
    if roles.scan is not None:
        if _are_scattered(table[:, roles.scan]):
            source.notes.notice("order", "The rows were sorted by the number of the scan and by their angles.")
            order = np.lexsort((bearings % (2 * np.pi), table[:, roles.scan]))
            table, bearings, ranges = table[order], bearings[order], ranges[order]
        edges = [0, *(np.flatnonzero(np.diff(table[:, roles.scan]) != 0) + 1).tolist(), len(table)]
    else:
        edges = turns(bearings)
        if len(table) >= LEAST_ROWS and (len(edges) - 1) * FEW_ROWS > len(table):
            order = _in_order(source, bearings)
            table, bearings, ranges = table[order], bearings[order], ranges[order]
            edges = turns(bearings)
    stamps = np.zeros(len(table))
    if roles.stamp is not None and np.isfinite(table[:, roles.stamp]).all():
        unit = TIMES.get(names[roles.stamp].unit) if names else None
        beams = table[:, roles.stamp]
        first = beams[edges[:-1]] if len(edges) > 2 else beams
        stamps = first * unit if unit else in_seconds(first)[0]
        source.notes.stamps = f"column {roles.stamp + 1}"
    sweeps = Sweeps()
    for (start, stop), stamp in zip(pairwise(edges), stamps.tolist(), strict=False):
        angles = np.unwrap(bearings[start:stop])
        if angles.max() > 2 * np.pi + 0.01:
            angles -= 2 * np.pi
        increment = (angles[-1] - angles[0]) / max(len(angles) - 1, 1)
        sweeps.add(ranges[start:stop], angles[0], increment, stamp=stamp, bearings=angles)
    topics = (Topic("scan", len(sweeps)),)
    return sweeps.recording(source, topic=source.choose(list(topics)), topics=topics, format="text")
