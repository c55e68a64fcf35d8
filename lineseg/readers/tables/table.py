"""Tables with the ranges of each scan in a row, its geometry and stamp beside them, as exporters of ROS write them."""

from __future__ import annotations

import math
import re
from collections import deque
from collections.abc import Iterable
from itertools import chain
from typing import NamedTuple

import numpy as np

from ...scan import Floats, Recording, Topic
from ..guessing import guess_angle_unit
from ..reading import RADIANS, AngleUnit, Reading
from ..source import Source, Sweeps
from ..stamping import in_seconds
from .dialect import LEFT_OUT, Dialect, Row
from .headers import LENGTHS, STAMPS, TIMES, TURNS, Name, array_columns, column_of, field_of, is_angle
from .numbers import all_numbers
from .scan_columns import tell_unknown_direction
from .scan_rows import tell_usual_angles, usual_angles

# What precedes the ranges in `ros2 topic echo --csv`.
BEFORE_RANGES = (
    "header_stamp_sec", "header_stamp_nanosec", "header_frame_id", "angle_min", "angle_max", "angle_increment",
    "time_increment", "scan_time", "range_min", "range_max",
)  # fmt: skip
FIELDS = ("angle_min", "angle_max", "angle_increment", "range_min", "range_max")
SECONDS = ("stamp_sec", "stamp_secs", "secs", "sec")
# So many numbers in a cell are a list of beams.
MANY_BEAMS = 30
NANOSECONDS = ("stamp_nanosec", "stamp_nsecs", "stamp_nsec", "stamp_nanosecs", "nsecs", "nsec", "nanosec", "nanosecs")


class Layout(NamedTuple):
    """Where a row has what: a list of ranges, or a column for each; a field's column, None without it.

    angles: of lists of angles.
    """

    listed: int | None
    angles: int | None
    beams: list[int]
    at: dict[str, int]
    frame_id: int | None
    header: int | None
    seconds: int | None
    nanoseconds: int | None
    stamp: int | None
    names: list[Name]

    @property
    def ranges(self) -> Name:
        """The name of the ranges, with their unit."""
        return self.names[self.beams[0] if self.listed is None else self.listed]

    @property
    def is_of_ros(self) -> bool:
        """Whether the fields are called as in sensor_msgs/LaserScan, which has metres and radians."""
        at = self.at.get("angle_min")
        return at is not None and self.names[at].ends("angle_min") and self.turn in (None, "rad")

    @property
    def turn(self) -> AngleUnit | None:
        """The unit that the names of the angles give, None if they give none."""
        columns = [*(at for field, at in self.at.items() if field.startswith("angle")), self.angles]
        return next(
            (TURNS[self.names[at].unit] for at in columns if at is not None and self.names[at].unit in TURNS), None
        )


def echo_columns(dialect: Dialect, head: list[Row]) -> list[Name]:
    """The columns of `ros2 topic echo --csv`, which has no header; [] if these rows are something else."""
    cells = dialect.cells(head[0].text)
    at = len(BEFORE_RANGES)
    numbers = [dialect.number(cell) for cell in cells]
    if len(cells) <= at or (numbers[2] is not None and cells[2]):
        return []
    before = numbers[:2] + numbers[3:at]
    if any(number is None or not math.isfinite(number) for number in before):
        return []
    low, high, step = (numbers[place] or 0.0 for place in (3, 4, 5))
    if step == 0:
        return []
    announced, there = round((high - low) / step) + 1, len(cells) - at
    likely = (announced, announced - 1, announced + 1, there)
    beams = next((count for count in likely if there in (count, 2 * count)), 0)
    names = [*map(Name, BEFORE_RANGES), *(Name("ranges", "", beam) for beam in range(beams))]
    return [*names, *(Name("intensities", "", beam) for beam in range(there - beams))]


def read_table(source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name]) -> Recording:
    """The scans of a table, whose columns have these names."""
    first = next(rows := iter(rows), None)
    layout = _layout(names, dialect.cells(first.text) if first else [])
    rows = chain([first] if first else [], rows)
    notes = source.notes
    if layout.turn is not None:
        notes.radians = True
        notes.found.setdefault("angle_unit", layout.turn)
    sweeps = Sweeps()
    stamps: list[float] = []
    latest: deque[Row] = deque(maxlen=3)
    for row in rows:
        latest.append(row)
        try:
            stamps.append(_add(source, reading, sweeps, row, dialect, layout))
        except ValueError as error:
            notes.skip(f"{source.name}:{row.number}", str(error))
    if not sweeps:
        notes.nothing_left()
        raise ValueError(f"{source.name} has column names, but no scans below them.")
    _tell_cut(source, dialect, len(names), list(latest))
    times = np.array(stamps)
    if layout.stamp is not None and layout.seconds is None and layout.header is None:
        # ROS 1 exports header.stamp as whole nanoseconds, other tools as seconds.
        whole = names[layout.stamp].ends("header_stamp") and bool((times == np.floor(times)).all())
        unit = TIMES.get(names[layout.stamp].unit) or (1e-9 if whole else None)
        times = times * unit if unit else in_seconds(times)[0]
    if times.any():
        at = next(place for place in (layout.seconds, layout.header, layout.stamp) if place is not None)
        notes.stamps = f"column {at + 1}"
    if unit := LENGTHS.get(layout.ranges.unit):
        notes.found.setdefault("unit", unit)
    elif not layout.is_of_ros and "unit" not in notes.found:
        notes.unstated.add("unit")
    if "range_max" not in layout.at and "range_max" not in notes.found:
        notes.unstated.add("range_max")
    topics = (Topic("scan", len(sweeps)),)
    topic = source.choose(list(topics))
    return sweeps.recording(source, topic=topic, topics=topics, format="text", stamps=times)


def _tell_cut(source: Source, dialect: Dialect, width: int, latest: list[Row]) -> None:
    """Tells that the last row breaks off, if it is shorter than the two before, which are whole."""
    *before, last = (dialect.width(row.text) for row in latest)
    # A comma at the end of a row may stand before an empty cell.
    if len(before) > 1 and {*before} == {width} and last < width - 1:
        source.notes.notice(
            "breaks off",
            f"The last row has {last} of {width} columns; it was read up to there, and its last number may be cut.",
        )


def _layout(names: list[Name], first: list[bytes]) -> Layout:
    """first: the cells of the first row."""

    def column(*known: str) -> int | None:
        return column_of(names, lambda name: name.element < 0 and name.ends(*known))

    fields = [field_of(name) if name.element < 0 else None for name in names]
    at = {name: fields.index(name) for name in FIELDS if name in fields}
    listed = column("ranges")
    stamp = column("header_stamp", "stamp")
    angles = None
    if listed is not None:
        angles = next(
            (at for at, name in enumerate(names) if is_angle(name) and is_long_list(first[at : at + 1])), None
        )
    return Layout(
        listed,
        angles,
        array_columns(names) if listed is None else [],
        at,
        column("frame_id"),
        column_of(names, lambda name: name.plain.split("_")[-1] == "header"),
        column(*SECONDS),
        column(*NANOSECONDS),
        _time(names) if stamp is None else stamp,
        names,
    )


def _time(names: list[Name]) -> int | None:
    """The column of times: one that is named so, or else one that is named so in short."""
    long = column_of(names, lambda name: name.element < 0 and name.ends("timestamp", "time"))
    return column_of(names, lambda name: name.element < 0 and name.plain in STAMPS) if long is None else long


def _add(source: Source, reading: Reading, sweeps: Sweeps, row: Row, dialect: Dialect, layout: Layout) -> float:
    """Add the scan of a row; returns its stamp. Raises ValueError if the row is not whole."""
    cells = dialect.cells(row.text)
    names = layout.names
    # Scans of some exporters vary in length, and the last cells may be missing, with their separators.
    needed: int = max([*layout.at.values(), *([] if layout.listed is None else [layout.listed]), *layout.beams[:1]])
    if len(cells) <= needed or (layout.listed is not None and len(cells) not in (len(names), len(names) - 1)):
        raise ValueError(f"{len(cells)} of {len(names)} columns; is the line complete?")
    ranges = _ranges(dialect, cells, layout) * layout.ranges.scale
    field = {name: _number(dialect, cells[at], name) for name, at in layout.at.items()}
    if layout.turn is not None:
        turn = RADIANS[reading.angle_unit or layout.turn]
        field = {name: value * turn * names[layout.at[name]].scale if value and name.startswith("angle") else value
                 for name, value in field.items()}  # fmt: skip
    bearings = None
    if layout.angles is not None:
        bearings = _listed_bearings(source, reading, dialect, cells[layout.angles], names[layout.angles], len(ranges))
        low, step = bearings[0], (bearings[-1] - bearings[0]) / max(len(bearings) - 1, 1)
    else:
        low, step = _angles(source, reading, field, len(ranges))
    frame_id = _frame_id(cells, layout)
    limits = field.get("range_min") or 0.0, field.get("range_max") or math.inf
    sweeps.add(ranges, low, step, *limits, 0.0, frame_id, bearings)
    return _stamp(dialect, cells, layout)


def is_long_list(cells: list[bytes]) -> bool:
    """Whether each of some cells holds a list of many numbers."""
    return bool(cells) and all(len(cell) >= 2 * MANY_BEAMS and _is_list(cell) for cell in cells)


def _is_list(cell: bytes) -> bool:
    numbers = all_numbers(cell.strip(b" []()'\""))
    return numbers is not None and len(numbers) > MANY_BEAMS


def _listed_bearings(
    source: Source, reading: Reading, dialect: Dialect, cell: bytes, name: Name, beams: int
) -> Floats:  # fmt: skip
    """The bearings [rad] of a list of angles, one for each beam."""
    angles = _list(dialect, cell, "angles") * name.scale
    if len(angles) != beams:
        raise ValueError(f"{len(angles)} angles, but {beams} ranges; each beam needs its own")
    if not np.isfinite(angles).all():
        raise ValueError("an angle is not a finite number; each beam needs its own")
    turn = RADIANS[guess_angle_unit(angles, reading, source.notes)]
    source.notes.radians = True
    tell_unknown_direction(source.notes, reading)
    return np.unwrap(angles * turn)


def _list(dialect: Dialect, cell: bytes, what: str) -> Floats:
    """The numbers of a list in a cell. what: they are, for errors."""
    if b"..." in cell:
        raise ValueError(LEFT_OUT)
    # array('f', [1.5, …]) and the like
    text = (cell[cell.index(b"[") :] if b"[" in cell else cell).strip(b" []()'\"")
    values = all_numbers(text)
    if values is None:
        text = re.sub(rb"[\[\](){}'\"]|array|[dD]type=\w+", b" ", text)
        values = all_numbers(text.replace(b"None", b"nan").replace(b"null", b"nan"))
    if values is None:
        wrong = next((word for word in re.split(rb"[\s,;]+", text.strip()) if dialect.number(word) is None), b"?")
        raise ValueError(f"{wrong[:40].decode('utf-8', 'replace')!r} among the {what} is not a number")
    return values


def _ranges(dialect: Dialect, cells: list[bytes], layout: Layout) -> Floats:
    if layout.listed is not None:
        return _list(dialect, cells[layout.listed], "ranges")
    found = [dialect.number(cells[at]) if at < len(cells) else math.nan for at in layout.beams]
    if None in found:
        wrong = cells[layout.beams[found.index(None)]][:40].decode("utf-8", "replace")
        if "..." in wrong:
            raise ValueError(LEFT_OUT)
        raise ValueError(f"{wrong!r} among the ranges is not a number")
    return np.array(found, dtype=np.float64)


def _number(dialect: Dialect, cell: bytes, name: str) -> float | None:
    number = dialect.number(cell)
    if number is None:
        raise ValueError(f"{cell[:40].decode('utf-8', 'replace')!r} is not a number; {name} must be one")
    return None if math.isnan(number) else number


def _angles(source: Source, reading: Reading, field: dict[str, float | None], beams: int) -> tuple[float, float]:
    """angle_min and increment of a row: as given, from its columns, or of a common laser with so many beams."""
    low = field.get("angle_min") if reading.angle_min is None else reading.angle_min
    step = field.get("angle_increment") if reading.angle_increment is None else reading.angle_increment
    high = field.get("angle_max")
    if not step and low is not None and high is not None and beams > 1:
        step = (high - low) / (beams - 1)
    usual = usual_angles(beams)
    if (low is None or not step) and usual is not None and "angle_min" not in field:
        guessed_low, guessed_step = map(math.radians, usual)
        low, step = guessed_low if low is None else low, step or guessed_step
        tell_usual_angles(source.notes, reading, "the table has", beams, low, step)
    if low is None:
        raise ValueError("angle_min is missing; give it in a column or an option")
    if not step and beams > 1:
        raise ValueError("angle_increment is missing; give it in a column or an option")
    return low, step or 0.0


def _stamp(dialect: Dialect, cells: list[bytes], layout: Layout) -> float:
    """The stamp of a message, in any of the exporters' forms; 0 if there is none."""

    def number(at: int | None) -> float:
        return (dialect.number(cells[at]) or 0.0) if at is not None else 0.0

    if layout.seconds is not None:
        return number(layout.seconds) + 1e-9 * number(layout.nanoseconds)
    header = cells[layout.header].decode("utf-8", "replace") if layout.header is not None else ""
    seconds = re.search(r"\bsecs?'?\s*[:=]\s*(-?\d+)", header)
    nanoseconds = re.search(r"\bn(?:ano)?secs?'?\s*[:=]\s*(\d+)", header)
    if seconds:
        return int(seconds[1]) + 1e-9 * int(nanoseconds[1] if nanoseconds else 0)
    found = number(layout.stamp)
    return found if math.isfinite(found) else 0.0


def _frame_id(cells: list[bytes], layout: Layout) -> str:
    if layout.frame_id is not None:
        return cells[layout.frame_id].decode("utf-8", "replace").strip("\"' ")
    header = cells[layout.header].decode("utf-8", "replace") if layout.header is not None else ""
    found = re.search(r"'?frame_id'?\s*[:=]\s*['\"]?([^'\",})]*)", header)
    return found[1] if found else ""
