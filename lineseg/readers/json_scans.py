"""Scans as JSON: the values of a file, also one that breaks off, and a scan under other names than those of ROS."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .guessing import guess_angle_unit
from .laser_scan import LaserScan, decode_json
from .source import Source
from .tables.dialect import Dialect, seconds_of
from .tables.headers import LASERS, LENGTHS, TIMES, TURNS, Name, field_of, is_angle, is_distance, name_of
from .tables.numbers import all_numbers, is_number
from .tables.scan_columns import tell_unknown_direction
from .tables.scan_rows import tell_usual_angles, usual_angles

# A text of fewer numbers is none of ranges.
LEAST_NUMBERS = 8
# What stands before an object in its line, such as the topic that mosquitto_sub -v prints, or the time of a log.
BEHIND = re.compile(rb"([^\n\r{}\"']{0,119}?[\w\])>/])[\s:=|,;]*(\{\s*\"[^\"\n]{1,60}\"\s*:)")
NO_DIALECT = Dialect(b";")
# So much of a step may angles be off their places [1], because they are rounded.
UNEVEN = 0.1


def parsed(text: bytes | str) -> Any:
    """The value, None if the text is not JSON."""
    try:
        return json.loads(text.strip().rstrip(b"," if isinstance(text, bytes) else ","))  # type: ignore[arg-type]
    except (ValueError, RecursionError):
        return None


def as_list(value: Any) -> Any:
    """The values of an object whose keys count from 0, as JavaScript and pandas write arrays; the numbers of a text, or
    of a list of lists of one; all else unchanged."""
    if isinstance(value, list) and is_text(value):
        return _numbers_of(value)
    if isinstance(value, list) and value and all(isinstance(each, list) and is_text(each) for each in value):
        return [_numbers_of(each) for each in value]
    if isinstance(value, str) and value.count(",") + value.count(" ") >= LEAST_NUMBERS:
        numbers = all_numbers(value.strip("[]() ").encode())
        return value if numbers is None else numbers.tolist()
    if isinstance(value, list) and len(value) >= LEAST_NUMBERS and isinstance(value[0], list):
        alone = all(isinstance(each, list) and len(each) == 1 for each in value)
        return [each[0] for each in value] if alone else value
    if not isinstance(value, Mapping) or "0" not in value or str(len(value) - 1) not in value:
        return value
    return list(value.values()) if all(key == str(at) for at, key in enumerate(value)) else value


def is_text(values: list[Any]) -> bool:
    return bool(values) and all(isinstance(each, str) for each in values)


def _numbers_of(words: list[str]) -> list[Any]:
    """The numbers that words are, None for empty ones; the words if one of them is no number."""
    numbers = [NO_DIALECT.number(word.strip().encode()) for word in words]
    if None in numbers:
        return words
    return [None if number is None or math.isnan(number) else number for number in numbers]


def number_in(value: Any) -> Any:
    """The number that a text is; all else unchanged."""
    return float(value) if isinstance(value, str) and is_number(value.encode()) else value


def json_values(source: Source) -> Iterator[tuple[str, Any]]:
    """(place, value): the whole file as one value, or one a line, or one after the other up to where it breaks off."""
    first = next((line for _, line in source.lines() if line.strip()), b"").removeprefix(b"\xef\xbb\xbf")
    behind = BEHIND.match(first) is not None
    if not behind and parsed(first) is None:
        text = source.path.read_bytes().removeprefix(b"\xef\xbb\xbf").decode("utf-8", "replace")
        whole = parsed(text)
        if whole is not None:
            yield source.name, whole
            return
        read = 0
        for end, place, value in _one_by_one(text):
            read = end
            yield f"{source.name}:{place}", value
        if read and text[read:].strip(" \r\n\t,]"):
            source.notes.notice("breaks off", f"The JSON breaks off after {read} characters; it was read up to there.")
        if read:
            return
    for number, line in source.lines():
        if not line.strip():
            continue
        value = _behind(line) if behind else parsed(line.removeprefix(b"\xef\xbb\xbf") if number == 1 else line)
        if value is None:
            source.notes.skip(f"{source.name}:{number}", "the line is not JSON; is it complete?")
        else:
            yield f"{source.name}:{number}", value


def _behind(line: bytes) -> Any:
    """The object at the end of a line, under the topic before it if there is one; None if it has none."""
    found = BEHIND.match(line)
    value = parsed(line[found.start(2) :]) if found else parsed(line)
    if found is None or value is None:
        return value
    topic = next((word for word in found[1].split() if b"/" in word), b"").decode("utf-8", "replace")
    return {"topic": topic, "msg": value} if topic else value


def _one_by_one(text: str) -> Iterator[tuple[int, int, Any]]:
    """(end, line, value) of the objects of a text, or of the list that it begins."""
    decoder, gap = json.JSONDecoder(), re.compile(r"[\s,]*")
    at = text.index("[") + 1 if text.lstrip().startswith("[") else 0
    line, seen = 1, 0
    while True:
        match = gap.match(text, at)
        at = match.end() if match else at
        try:
            value, end = decoder.raw_decode(text, at)
        except (ValueError, RecursionError):
            return
        line, seen = line + text.count("\n", seen, at), at
        yield end, line, value
        at = end


def is_even(angles: list[Any]) -> bool:
    """Whether angles rise or fall evenly, so that the first and the step say all."""
    try:
        values = np.asarray(angles, dtype=np.float64)
    except (TypeError, ValueError):
        return True
    if values.ndim != 1 or len(values) < 2 or not np.isfinite(values).all():
        return True
    line = np.linspace(values[0], values[-1], len(values))
    return bool(np.abs(values - line).max() <= UNEVEN * abs(line[1] - line[0]))


def scan_of(source: Source, message: Mapping[str, Any]) -> LaserScan:
    """A scan under any of the usual names of its fields. Raises ValueError if it is none.

    What its names do not say is noted: the unit, angles of a common laser, a stamp of unknown unit.
    """
    if "ranges" in message and "angle_min" in message and not isinstance(message.get("header", {}), Mapping):
        message = {name: value for name, value in message.items() if name != "header"}
    found: dict[str, tuple[Name, Any]] = {}
    for key, value in message.items():
        name = name_of(key)
        field = field_of(name) or _listed(name, value)
        if field is not None and value is not None:
            found.setdefault(field, (name, value))
    plain = {field: value for field, (_, value) in found.items() if field not in ("angles", "stamp", "frame_id")}
    header = message.get("header")
    header = dict(header) if isinstance(header, Mapping) else {}
    if (laser := found["frame_id"][1] if "frame_id" in found else _laser(message)) is not None:
        header.setdefault("frame_id", laser)
    _take_units(source, found)
    beams = len(found["ranges"][1]) if isinstance(found.get("ranges", ("", 0))[1], list) else 0
    plain |= _angles(source, found, beams)
    name, stamp = found.get("stamp", (Name(""), None))
    stamp = header.pop("stamp", stamp)
    if isinstance(stamp, Mapping):
        return decode_json(plain | {"header": header | {"stamp": stamp}})
    scan = decode_json(plain | {"header": header})
    return scan if stamp is None else _with_time(source, scan, stamp, name)


def _laser(message: Mapping[str, Any]) -> str | None:
    """What a message calls its laser, such as "sensor": "front"; None if it does not."""
    held = (value for key, value in message.items() if name_of(key).plain in LASERS)
    return next((str(value) for value in held if isinstance(value, str | int)), None)


def _listed(name: Name, value: Any) -> str | None:
    """The field that a list of numbers is by its name, such as dist_mm or azimuths; None if it is none."""
    if not isinstance(value, list):
        return None
    return "ranges" if is_distance(name) else "angles" if is_angle(name) else None


def _with_time(source: Source, scan: LaserScan, stamp: Any, name: Name) -> LaserScan:
    """The scan with a stamp that is one number, or text."""
    number = seconds_of(stamp.encode()) if isinstance(stamp, str) else stamp
    if isinstance(number, bool) or not isinstance(number, int | float) or not math.isfinite(number):
        raise ValueError(f"the stamp is {stamp!r:.40}; it must be a number or a time such as 2023-11-14T22:13:20Z")
    if (unit := TIMES.get(name.unit)) is not None:
        number *= unit
    elif not isinstance(stamp, str):
        source.notes.unstated.add("stamps")
    whole = math.floor(number)
    return scan._replace(seconds=whole, nanoseconds=round((number - whole) * 1e9))


def _take_units(source: Source, found: Mapping[str, tuple[Name, Any]]) -> None:
    notes = source.notes
    if "ranges" in found:
        unit = LENGTHS.get(found["ranges"][0].unit)
        if unit is not None:
            notes.found["unit"] = unit
        elif found["ranges"][0].plain != "ranges" or "angle_min" not in found or found["angle_min"][0].unit == "deg":
            notes.unstated.add("unit")
    turns = [TURNS.get(name.unit) for field, (name, _) in found.items() if field.startswith("angle")]
    if turn := next((turn for turn in turns if turn not in (None, "rad")), None):
        notes.found["angle_unit"] = turn


def _angles(source: Source, found: Mapping[str, tuple[Name, Any]], beams: int) -> dict[str, float]:
    """angle_min and angle_increment where the message has them in another form, or not at all."""
    reading, notes = source.reading, source.notes
    listed = found["angles"][1] if "angles" in found else None
    if isinstance(listed, list) and len(listed) == beams > 1:
        angles = np.asarray(listed, dtype=np.float64)
        guess_angle_unit(angles, reading, notes)
        return {"angle_min": float(angles[0]), "angle_increment": float(angles[-1] - angles[0]) / (beams - 1)}
    if "angle_min" in found or beams < 2:
        return {}
    step, low = reading.angle_increment, reading.angle_min
    usual = usual_angles(beams)
    if step is None and usual is not None:
        usual_low, step = (math.radians(each) for each in usual)
        low = usual_low if low is None else low
        tell_usual_angles(notes, reading, "the scan has", beams, low, step)
    elif step is not None:
        tell_unknown_direction(notes, reading)
    if step is None:
        raise ValueError(f"it has {beams} ranges without angles; give angle_min and angle_increment")
    return {"angle_min": -step * (beams - 1) / 2 if low is None else low, "angle_increment": step}
