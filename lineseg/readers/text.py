"""Plain text: one scan per row, columns of angle and distance, or a table with a column `ranges`."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..scan import Floats, Recording, Topic
from .numbers import all_numbers, is_number, split
from .reading import Reading
from .source import Reader, Source, Sweeps

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
COMMENTS = (b"#", b"%", b"//")
ECHO = b"%time,field."  # the first line of `rostopic echo -p`
SETTING = re.compile(rb"(\w+)\s*[=:]\s*([^\s,;]+)")
ANGLES = ("angle", "angles", "bearing", "theta", "angle_rad", "angle_deg", "azimuth")
DISTANCES = ("distance", "distances", "range", "dist", "rho", "distance_m", "distance_mm", "range_m", "range_mm")


class Row(NamedTuple):
    number: int
    text: bytes


class Text(Reader):
    """The last reader to try: any file with lines of numbers."""

    format = "text"
    suffixes = (".csv", ".txt", ".dat", ".tsv", ".asc", ".xy")
    expects = "lines of numbers"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return bool(head.strip()) and b"\0" not in head

    @staticmethod
    def read(source: Source) -> Recording:
        rows = _rows(source)
        said: dict[str, str] = {}
        first = next(rows, None)
        while first is not None and first.text.startswith(COMMENTS) and not first.text.startswith(ECHO):
            said.update((key.decode(), value.decode()) for key, value in SETTING.findall(first.text))
            first = next(rows, None)
        if first is None:
            raise ValueError(f"{source.name} has no line of numbers; {TEXT_FORMS}")
        options = _with_comments(source, said)
        names = _names(first.text)
        if names and ("ranges" in names or "ranges0" in names):
            return _read_table(source, names, rows, options)
        if names:
            return _read_columns(source, rows, options, names)
        rows = _chain(first, rows)
        if len(split(first.text)) == 2 and not options.skip_columns:
            return _read_columns(source, rows, options, ["angle", "distance"])
        return _read_scans(source, rows, options)


TEXT_FORMS = "use one scan per row, or columns of angle and distance, or a table with a column named ranges."


def _rows(source: Source) -> Iterator[Row]:
    for number, line in source.lines():
        text = line.removeprefix(b"\xef\xbb\xbf") if number == 1 else line
        if stripped := text.strip():
            yield Row(number, stripped if stripped.startswith(COMMENTS) else text)


def _chain(first: Row, rest: Iterator[Row]) -> Iterator[Row]:
    yield first
    yield from (row for row in rest if not row.text.startswith(COMMENTS))


def _names(text: bytes) -> list[str] | None:
    """The column names in a line, None if it begins with a number."""
    words = split(text)
    if is_number(words[0]):
        return None
    return [word.decode("utf-8", "replace").strip("\"'%").removeprefix("field.").lower() for word in words]


def _numbers(source: Source, row: Row, text: bytes) -> Floats:
    values = all_numbers(text)
    if values is None:
        wrong = next(word for word in split(text) if not is_number(word))
        shown = wrong[:40].decode("utf-8", "replace")
        raise ValueError(f"{source.name}:{row.number}: {shown!r} is not a number; {TEXT_FORMS}")
    return values


def _with_comments(source: Source, said: dict[str, str]) -> Reading:
    """The given options, completed from the comment lines of the file."""
    found: dict[str, str | float | int] = {}
    for name in said.keys() & Reading.declared().keys():
        if getattr(source.reading, name) is None:
            try:
                kind, value = Reading.type_of(name), said[name]
                found[name] = kind(value) if kind in (int, float) else value
            except ValueError:
                raise ValueError(
                    f"{source.name}: its comments say {name} = {said[name]!r}; it must be a number."
                ) from None
    try:
        options = source.reading.but(**found)
    except ValueError as error:
        raise ValueError(f"{source.name}: {error}") from None
    source.notes.found |= found
    return options


# One scan a row


def _read_scans(source: Source, rows: Iterator[Row], options: Reading) -> Recording:
    scans: list[Floats] = []
    numbers: list[int] = []
    skip = options.skip_columns
    for row in rows:
        if skip is None:
            skip = _leading_columns(row.text)
        values = _numbers(source, row, row.text)[skip:]
        if scans and len(values) != len(scans[0]):
            raise ValueError(
                f"{source.name}:{row.number}: {len(values)} ranges, but earlier scans have {len(scans[0])}; "
                "is the line complete?"
            )
        scans.append(values)
        numbers.append(row.number)
    if len(scans) > 1 and len(scans[0]) == 1:
        scans = [np.concatenate(scans)]
    if len(scans[0]) == 0:
        raise ValueError(f"{source.name}:{numbers[0]}: no ranges are left after {skip} leading columns; skip fewer.")
    angle_min, increment = _angles(source, len(scans[0]), options)
    sweeps = Sweeps()
    for scan in scans:
        sweeps.add(scan, angle_min, increment)
    return _finish(source, sweeps)


def _leading_columns(text: bytes) -> int:
    """Number of values before the ranges: those before a double space, if the line has exactly one."""
    parts = re.split(rb" {2,}", text.strip())
    return len(split(parts[0])) if len(parts) == 2 and len(split(parts[1])) > len(split(parts[0])) else 0


def _angles(source: Source, beams: int, options: Reading) -> tuple[float, float]:
    """angle_min and angle_increment [rad]: as given, or of the common laser with this number of beams."""
    low, step = (math.radians(angle) for angle in LASERS.get(beams, (math.nan, math.nan)))
    step = step if options.angle_increment is None else options.angle_increment
    low = low if options.angle_min is None else options.angle_min
    if math.isnan(low) and not math.isnan(step):
        low = -step * (beams - 1) / 2
    if math.isnan(step):
        raise ValueError(
            f"{source.name}: rows of {beams} numbers without angles; give angle_increment, and angle_min unless 0° "
            "is in the middle, and skip_columns if not all numbers are ranges."
        )
    return low, step


# Columns of angle and distance


def _read_columns(source: Source, rows: Iterator[Row], options: Reading, names: list[str]) -> Recording:
    angle_at = _column(source, names, ANGLES)
    distance_at = _column(source, names, DISTANCES)
    table: list[Floats] = []
    for row in rows:
        if row.text.startswith(COMMENTS):
            continue
        words = split(row.text)
        if len(words) < len(names):
            raise ValueError(
                f"{source.name}:{row.number}: {len(words)} of {len(names)} columns ({', '.join(names)}); "
                "is the line complete?"
            )
        table.append(_numbers(source, row, words[angle_at] + b" " + words[distance_at]))
    if not table:
        raise ValueError(f"{source.name} has column names, but no line of numbers; {TEXT_FORMS}")
    angles, distances = np.array(table).T
    if not np.isfinite(angles).all():
        raise ValueError(f"{source.name}: an angle is not a finite number; each beam needs its own.")
    if names[distance_at].endswith("_mm"):
        source.notes.found["unit"] = "mm"
    if _in_degrees(angles, names[angle_at], options):
        angles = np.deg2rad(angles)
    source.notes.radians = True
    sweeps = Sweeps()
    for start, stop in _revolutions(angles):
        bearings, ranges = angles[start:stop], distances[start:stop]
        increment = (bearings[-1] - bearings[0]) / max(len(bearings) - 1, 1)
        sweeps.add(ranges, bearings[0], increment, bearings=bearings)
    return _finish(source, sweeps)


def _column(source: Source, names: list[str], known: tuple[str, ...]) -> int:
    for name in known:
        if name in names:
            return names.index(name)
    raise ValueError(
        f"{source.name} begins with {' '.join(names)[:60]!r}, which names no column {known[0]}; {TEXT_FORMS}"
    )


def _in_degrees(angles: Floats, name: str, options: Reading) -> bool:
    """The unit of angles: as given, from the column's name, or degrees if angles are too large for radians."""
    if options.angle_unit:
        return options.angle_unit == "deg"
    if name.endswith(("_deg", "_rad")):
        return name.endswith("_deg")
    return bool(np.abs(angles).max() > 2 * np.pi + 0.2)


def _revolutions(angles: Floats) -> Iterator[tuple[int, int]]:
    """Half-open spans of the scans in a column of angles: a new scan starts where the angle jumps back."""
    leaps = np.flatnonzero(np.abs(np.diff(angles)) > np.pi) + 1
    edges = [0, *leaps.tolist(), len(angles)]
    yield from pairwise(edges)


# A table with a column of lists, as written by `rostopic echo -p` and exporters


def _read_table(source: Source, names: list[str], rows: Iterator[Row], options: Reading) -> Recording:
    csv.field_size_limit(1 << 24)
    sweeps = Sweeps()
    for row in rows:
        cells = next(csv.reader([row.text.decode("utf-8", "replace")]))
        if len(cells) != len(names):
            raise ValueError(f"{source.name}:{row.number}: {len(cells)} of {len(names)} columns; is the line complete?")
        cell = dict(zip(names, cells, strict=True))
        listed = cell.get("ranges") or " ".join(cell[name] for name in names if re.fullmatch(r"ranges\d+", name))
        ranges = _numbers(source, row, listed.strip(" []()").encode())
        angle_min = _value(source, row, cell, "angle_min", options.angle_min)
        increment = _value(source, row, cell, "angle_increment", options.angle_increment)
        range_min = _value(source, row, cell, "range_min", 0.0)
        range_max = _value(source, row, cell, "range_max", math.inf) or math.inf
        stamp, frame_id = _stamp(cell), _frame_id(cell)
        sweeps.add(ranges, angle_min, increment, range_min, range_max, stamp, frame_id)
    if not sweeps:
        raise ValueError(f"{source.name} has column names, but no scans below them.")
    return _finish(source, sweeps, limits=True)


def _value(source: Source, row: Row, cell: dict[str, str], name: str, default: float | None) -> float:
    """The number in the column `name`; `default` if the column is missing or the cell is empty."""
    if cell.get(name, "").strip():
        return float(_numbers(source, row, cell[name].encode())[0])
    if default is None:
        raise ValueError(f"{source.name}:{row.number}: {name} is missing; give it in a column or an option.")
    return default


def _stamp(cell: dict[str, str]) -> float:
    """The stamp of a message in seconds, in any of the exporters' forms; 0 if there is none."""
    header = cell.get("header", "")
    seconds = re.search(r"\bsecs?'?\s*:\s*(-?\d+)", header)
    nanoseconds = re.search(r"\bn(?:ano)?secs?'?\s*:\s*(\d+)", header)
    if seconds:
        return int(seconds[1]) + 1e-9 * int(nanoseconds[1] if nanoseconds else 0)
    for name, unit in (("header.stamp", 1e-9), ("stamp", 1.0), ("timestamp", 1.0), ("time", 1.0)):
        if is_number(cell.get(name, "").strip().encode()):
            return float(cell[name]) * unit
    return 0.0


def _frame_id(cell: dict[str, str]) -> str:
    found = re.search(r"'?frame_id'?\s*:\s*['\"]?([^'\",}]*)", cell.get("header", ""))
    return found[1] if found else cell.get("header.frame_id", cell.get("frame_id", ""))


def _finish(source: Source, sweeps: Sweeps, limits: bool = False) -> Recording:
    topics = (Topic("scan", len(sweeps)),)
    if not limits:
        source.notes.unstated |= {"unit", "range_max"} - source.notes.found.keys()
    return sweeps.recording(source, topic=source.choose(list(topics)), topics=topics, format=Text.format)
