"""LaserScan messages as text: JSON, JSON lines, a rosbridge log, and what `ros2 topic echo` prints."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import chain
from typing import Any, TypeGuard

import numpy as np

from ..scan import Floats, Recording, Topic
from .json_scans import BEHIND, as_list, is_even, json_values, number_in, parsed, scan_of
from .laser_scan import LaserScan, decode_json
from .lasers import MOST_LASERS, laser_of, rows_of_one_laser
from .source import Reader, Source, Sweeps
from .stamping import in_seconds
from .tables.beam_rows import beams_of, read_beams
from .tables.dialect import LEFT_OUT, Dialect, Row
from .tables.headers import (
    LASERS,
    NAMES,
    SCANS,
    STAMPS,
    array_columns,
    field_of,
    geometry_in,
    is_angle,
    is_distance,
    name_of,
)
from .tables.numbers import all_numbers, is_number
from .tables.scan_rows import scans_of

MOST_DEPTH = 6
# A shorter list of numbers is no scan; what lists of ranges are called where they have no usual name, and others.
LONG_LIST = 30
OF_SCANS = re.compile(
    r"scan|laser|lidar|rang|dist|depth|reading|measure|value|data|frame|sweep|turn|front|rear|back|^\d*$"
)
OF_OTHERS = re.compile(r"intens|qualit|remission|reflect|rssi|signal|time|stamp|angle|bearing|theta|azimuth")
LIST_KEYS = ("ranges", "distances", "range", "distance")
LEAST_BEAMS = 8
# A part is shown after as many scans.
PART = 64
STAMP_NAMES = NAMES["stamp"]
# Texts that may look like numbers.
TEXTS = {*LASERS, *NAMES["frame_id"], "child_frame_id"}
ECHO_LINES = (
    re.compile(rb"^[ \t]*angle_(?:min|increment|step)[ \t]*[:=][ \t]*[-+.\d]", re.MULTILINE),
    re.compile(rb"^[ \t]*ranges[ \t]*[:=][ \t]*(?:[-+.\d\[]|inf|nan|'?<|$)", re.MULTILINE),
)

Table = list[list[float]]


class JsonMessages(Reader):
    """Objects with `ranges`, alone, in a list, one a line, or inside of others; or lists of beams or points."""

    format = "JSON"
    suffixes = (".json", ".jsonl", ".ndjson")
    expects = "objects with ranges and angles"

    @staticmethod
    def recognises(head: bytes) -> bool:
        start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
        return bool(re.match(rb"(?:\[\s*)?\{\s*[\"}]", start)) or _is_behind(start)

    @staticmethod
    def read(source: Source) -> Recording:
        source.notes.kind = "JSON"
        recording = recording_of_values(source, json_values(source), JsonMessages.format)
        return recording_of(source, {}, JsonMessages.format) if recording is None else recording


def _is_behind(head: bytes) -> bool:
    """Whether the first line ends with an object, or is longer than what is known of it."""
    line, ended, _ = head.partition(b"\n")
    found = BEHIND.match(line)
    return found is not None and (not ended or parsed(line[found.start(2) :]) is not None)


class EchoYaml(Reader):
    """Messages as indented text, divided by lines of three dashes, or those of Gazebo; one scan as YAML or TOML."""

    format = "echo"
    suffixes = (".yaml", ".yml")
    expects = "messages as `ros2 topic echo` prints them"

    @staticmethod
    def recognises(head: bytes) -> bool:
        if b"angle_" not in head and b"ranges" not in head:
            return False
        found = [line.search(head) is not None for line in ECHO_LINES]
        return all(found) or (any(found) and re.search(rb"^header:\s*$", head, re.MULTILINE) is not None)

    @staticmethod
    def read(source: Source) -> Recording:
        source.notes.kind = "topic echo"
        scans: list[LaserScan] = []
        for number, message in _documents(source):
            try:
                scans.append(decode_json(message))
            except ValueError as error:
                source.notes.skip(f"{source.name}:{number}", str(error))
        return recording_of(source, {"scan": scans} if scans else {}, EchoYaml.format)


def recording_of(source: Source, found: dict[str, list[LaserScan]], format: str) -> Recording:
    """The scans of the chosen topic. Raises ValueError if there are none."""
    if not found:
        source.notes.nothing_left()
        raise ValueError(f"{source.name} has no object with ranges; a scan has a list of ranges, and its angles.")
    topics = tuple(Topic(name, len(scans)) for name, scans in found.items())
    topic = source.choose(list(topics))
    if "stamps" in source.notes.unstated:
        times, _ = in_seconds(np.array([scan.stamp for scan in found[topic]]))
        found[topic] = [
            scan._replace(seconds=0, nanoseconds=time * 1e9) for scan, time in zip(found[topic], times, strict=True)
        ]
    sweeps = Sweeps()
    sweeps.extend(found[topic])
    source.notes.stamps = "the messages"
    return sweeps.recording(source, topic=topic, topics=topics, format=format)


# JSON


def recording_of_values(source: Source, values: Iterable[tuple[str, Any]], format: str) -> Recording | None:
    """The scans in (place, value), wherever they lie inside of the values; None if there are none.

    Raises ValueError if none of them can be read.
    """
    found: dict[str, list[LaserScan]] = {}
    beams: list[Mapping[str, Any]] = []
    tables: list[Table] = []
    rows: list[tuple[str, Floats]] = []
    shared: dict[str, Any] = {}
    for place, value in values:
        messages = list(_messages(value, "scan"))
        rows += [] if messages or found else _long_lists(value)
        if isinstance(value, Mapping) and not messages:
            shared |= _shared_geometry(value)
        for topic, message in messages:
            if isinstance(message, list):
                tables.append(message)
            elif _ranges_key(message) is None:
                beams.append(message)
            else:
                try:
                    scan = scan_of(source, message)
                except ValueError as error:
                    source.notes.skip(place, str(error))
                else:
                    scans = found.setdefault(topic, [])
                    scans.append(scan)
                    if len(scans) % PART == 0:
                        source.offer(len(scans), partial(_part, found, format))
    if not found and len(beams) >= LEAST_BEAMS:
        return replace(_beams(source, beams), format=format)
    if not found and not tables and rows:
        said = geometry_in(shared.items(), max(len(ranges) for _, ranges in rows))
        said = {name: angle for name, angle in said.items() if getattr(source.reading, name) is None}
        return _of_lists(replace(source, reading=source.reading.but(**said)), rows, format)
    if not found and tables:
        table = np.array([row for each in tables for row in each], dtype=np.float64)
        return beams_of(source, source.reading, table, None, format=format)
    if not found:
        source.notes.nothing_left()
    return recording_of(source, found, format) if found else None


def _of_lists(source: Source, lists: list[tuple[str, Floats]], format: str) -> Recording:
    """The scans of (name, ranges); of one laser, if the names recur and differ."""
    counts, laser = Counter(name for name, _ in lists), ""
    if 1 < len(counts) < len(lists):
        laser = laser_of(source, source.reading, counts, "scans")
    rows = [ranges for name, ranges in lists if laser in ("", name)]
    recording = scans_of(source, source.reading, list(range(1, len(rows) + 1)), rows, 0, None, format)
    return replace(recording, frame_ids=(laser,) * len(recording)) if laser else recording


def _part(found: dict[str, list[LaserScan]], format: str, source: Source) -> Recording:
    """The scans so far."""
    copied = {topic: list(scans) for topic, scans in found.items()}
    return replace(recording_of(source, copied, format), partial=True)


def _long_lists(value: Any, name: str = "", depth: int = 0) -> Iterator[tuple[str, Floats]]:
    """(name without its number, numbers) of lists that are called like scans, or have no name, wherever they lie."""
    if depth > MOST_DEPTH:
        return
    if isinstance(value, Mapping):
        for key, held in value.items():
            plain = name_of(str(key)).plain
            if isinstance(held, Mapping) or (OF_SCANS.search(plain) and not OF_OTHERS.search(plain)):
                yield from _long_lists(held, re.sub(r"_?\d+", "", plain), depth + 1)
    elif isinstance(value, list) and len(value) >= LONG_LIST and all(_is_number_or_none(held) for held in value):
        yield name, np.array(value, dtype=np.float64)
    elif isinstance(value, list):
        for inner in value:
            yield from _long_lists(inner, name, depth + 1)


def _is_number_or_none(value: Any) -> bool:
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool))


def _messages(value: Any, topic: str, depth: int = 0) -> Iterator[tuple[str, Mapping[str, Any] | Table]]:
    """(topic, object with ranges, or with one beam, or list of beams), wherever it lies inside of other objects."""
    if depth > MOST_DEPTH:
        return
    if isinstance(value, str) and value[:1] in ("{", "["):
        value = parsed(value)
    if isinstance(value, Mapping):
        value = {key: held if key in TEXTS else number_in(as_list(held)) for key, held in value.items()}
        if (records := _records(value)) is not None:
            value = records
        elif (joined := _joined(value)) is not None:
            value = joined
    if isinstance(value, Mapping):
        if (beams := _parallel(value)) is not None:
            for beam in beams:
                yield topic, beam
        elif _ranges_key(value) is not None or _is_beam(value):
            yield topic, value
        elif (point := _geo_point(value)) is not None:
            yield topic, point
        elif (table := _keyed(value)) is not None:
            yield topic, table
        else:
            named = value.get("topic")
            stamp = {key: held for key, held in value.items() if key in STAMP_NAMES and not isinstance(held, Mapping)}
            shared = _shared_geometry(value)
            lasers = _laser_keys(value)
            of_all = {key: held for key, held in value.items() if name_of(key).plain in LASERS and key != "topic"
                      and isinstance(held, str | int)}  # fmt: skip
            for key, inner in value.items():
                laser = {"laser": key} if key in lasers else of_all
                for name, message in _messages(inner, named if isinstance(named, str) and named else topic, depth + 1):
                    if shared and isinstance(message, Mapping) and not _has_angles(message):
                        message = {**message, **shared}
                    if laser and isinstance(message, Mapping) and not _has_laser(message):
                        message = {**message, **laser}
                    lacks = stamp and isinstance(message, Mapping) and not {*STAMP_NAMES, "header"} & message.keys()
                    yield name, {**message, **stamp} if lacks and isinstance(message, Mapping) else message
    elif isinstance(value, list) and _is_table(value := as_list(value)):
        yield topic, value
    elif isinstance(value, list):
        for inner in value:
            yield from _messages(inner, topic, depth + 1)


def _shared_geometry(value: Mapping[str, Any]) -> dict[str, Any]:
    """The angles that stand once beside scans, also in an object such as "meta"; {} if they do not say all."""
    inner = [held for held in value.values() if isinstance(held, Mapping) and _ranges_key(held) is None]
    for each in (value, *inner):
        found = {key: held for key, held in each.items()
                 if _is_number_or_none(held) and (field_of(name_of(str(key))) or "").startswith("angle_")}  # fmt: skip
        if len(found) > 1:
            return found
    return {}


def _laser_keys(value: Mapping[str, Any]) -> list[str]:
    """The keys under which the scans of several lasers stand, such as front and rear; [] if they number scans."""
    keys = [key for key, held in value.items() if isinstance(held, Mapping) and _ranges_key(held) is not None]
    plain = {re.sub(r"\d+", "", key) for key in keys}
    return keys if 1 < len(keys) == len(plain) <= MOST_LASERS else []


def _has_laser(message: Mapping[str, Any]) -> bool:
    header = message.get("header")
    names = {name_of(key).plain for key in message}
    return bool(names & {*LASERS, "frame_id"}) or (isinstance(header, Mapping) and bool(header.get("frame_id")))


def _has_angles(message: Mapping[str, Any]) -> bool:
    return any((field_of(name_of(str(key))) or "").startswith("angle") for key in message)


def _records(value: Mapping[str, Any]) -> list[dict[str, Any]] | None:
    """The rows of a table of pandas whose names stand beside them, with their names; None if it is none."""
    names, rows = value.get("columns"), value.get("data")
    if not isinstance(names, list) or not isinstance(rows, list) or not all(isinstance(name, str) for name in names):
        return None
    if not rows or not all(isinstance(row, list) and len(row) == len(names) for row in rows):
        return None
    return [dict(zip(names, row, strict=True)) for row in rows]


def _joined(value: Mapping[str, Any]) -> dict[str, Any] | None:
    """An object with a list of ranges instead of a key for each, as a row of a table has them; None for others."""
    if len(value) < LONG_LIST:
        return None
    keys = list(value)
    names = [name_of(str(key)) for key in keys]
    columns = array_columns(names)
    if len(columns) < LONG_LIST or not all(_is_number_or_none(value[keys[at]]) for at in columns):
        return None
    others = {key: value[key] for key, name in zip(keys, names, strict=True) if name.element < 0}
    unit = f"_{names[columns[0]].unit}" if names[columns[0]].unit else ""
    return {**others, f"ranges{unit}": [value[keys[at]] for at in columns]}


def _parallel(value: Mapping[str, Any]) -> list[dict[str, Any]] | None:
    """The rows of an object with a list for each column; None if a row is no beam, or all are one scan of even angles.

    A row may also have a whole scan.
    """
    lists = {key: held for key, held in value.items() if isinstance(held, list)}
    ranges = next((key for key in lists if is_distance(name_of(key))), None)
    if ranges is None or not lists[ranges]:
        return None
    columns = {key: held for key, held in lists.items() if len(held) == len(lists[ranges])}
    names = {key: name_of(key) for key in columns}
    angles = next((key for key, name in names.items() if is_angle(name)), None)
    if len(columns) < 2:
        return None
    if not (isinstance(columns[ranges][0], list) and len(columns) == len(value)):
        numbered = any(name.plain in SCANS for name in names.values())
        if angles is None or len(columns[angles]) < LEAST_BEAMS or (is_even(columns[angles]) and not numbered):
            return None
    alone = {key: held for key, held in value.items() if name_of(key).plain in STAMPS and key not in columns}
    return [{**alone, **dict(zip(columns, row, strict=True))} for row in zip(*columns.values(), strict=True)]


def _ranges_key(value: Mapping[str, Any]) -> str | None:
    flat = [key for key, held in value.items() if isinstance(held, list) and not isinstance(next(iter(held), 0), list)]
    named = [key for key in flat if name_of(key).plain.split("_")[-1] in LIST_KEYS and not is_angle(name_of(key))]
    # Elsewhere dist_m or depths; beside them stands another list, or an angle.
    other = [key for key in flat if is_distance(name_of(key)) and len(value[key]) >= LEAST_BEAMS]
    return next(iter(named or other), None)


def _is_beam(value: Mapping[str, Any]) -> bool:
    names = [name_of(key) for key, held in value.items() if isinstance(held, int | float)]
    plain = {name.plain for name in names}
    return (any(map(is_angle, names)) and any(map(is_distance, names))) or {"x", "y"} <= plain


def _geo_point(value: Mapping[str, Any]) -> dict[str, Any] | None:
    """x and y of a point of GeoJSON; None for others."""
    held = value.get("coordinates")
    if value.get("type") != "Point" or not isinstance(held, list) or len(held) < 2:
        return None
    return {"x": held[0], "y": held[1]}


def _is_table(value: Any) -> TypeGuard[Table]:
    """Whether it is a list of beams or points: lists of a few numbers."""
    rows = value if isinstance(value, list) and len(value) >= LEAST_BEAMS else []
    width = len(rows[0]) if rows and isinstance(rows[0], list) else 0
    return 2 <= width <= 4 and all(
        isinstance(row, list)
        and len(row) == width
        and all(each is None or isinstance(each, int | float) for each in row)
        for row in rows
    )


def _keyed(value: Mapping[str, Any]) -> Table | None:
    """The beams of an object whose keys are angles; None if they are not."""
    if len(value) < LEAST_BEAMS:
        return None
    columns = list(value.values())
    scans = len(columns[0]) if isinstance(columns[0], list) else 0
    # A longer list is a scan under its number, or its time.
    if scans and 0 < scans < LONG_LIST <= len(value) and all(_is_list_of(held, scans) for held in columns):
        rows = list(zip(*columns, strict=True))
    elif all(map(_is_number_or_none, columns)):
        rows = [tuple(columns)]
    else:
        return None
    try:
        angles = [float(key) for key in value]
    except ValueError:
        return None
    return [[angle, np.nan if held is None else float(held)] for row in rows
            for angle, held in zip(angles, row, strict=True)]  # fmt: skip


def _is_list_of(value: Any, count: int) -> bool:
    return isinstance(value, list) and len(value) == count and all(map(_is_number_or_none, value))


def _beams(source: Source, beams: list[Mapping[str, Any]]) -> Recording:
    """Objects with an angle and a distance each, or with x and y."""
    keys = list(beams[0])
    rows = (Row(at, b"\t".join(str(beam.get(key)).encode() for key in keys)) for at, beam in enumerate(beams, 1))
    names, dialect = [name_of(key) for key in keys], Dialect(b"\t")
    rows, frame_id = rows_of_one_laser(source, source.reading, rows, dialect, names)
    recording = read_beams(source, source.reading, rows, dialect, names)
    return replace(recording, frame_ids=(frame_id,) * len(recording))


# YAML


def _documents(source: Source) -> Iterator[tuple[int, dict[str, Any]]]:
    """(line, message): the fields that a scan needs, of each document. A full YAML parser would take minutes.

    Raises ValueError for arrays that `ros2 topic echo` has shortened.
    """
    message: dict[str, Any] = {}
    header: dict[str, Any] = {}
    began, key, flow = 1, "", list[str]()
    for number, line in chain(source.lines(), [(0, b"---")]):
        text = line.decode("utf-8", "replace").strip()
        # An entry of a list of messages.
        entry = ENTRY.match(text) is not None
        text = text[1:].lstrip() if entry else text
        ends = text.startswith("---") or ("ranges" in message and (BLOCK.match(line) or SECTION.fullmatch(text)))
        again = re.split("[:=]", text, maxsplit=1)[0].rstrip() in message.keys() - {"ranges"}
        if ends or ("ranges" in message and (entry or again)):
            if "ranges" in message and not (number == 0 and _is_cut(message)):
                stamp = {name: header[name] for name in STAMP_KEYS if name in header}
                yield began, message | {"header": {"stamp": stamp, "frame_id": header.get("frame_id", "")}}
            elif "ranges" in message:
                source.notes.skip(f"{source.name}:{began}", f"it breaks off after {len(message['ranges'])} ranges")
            message, header, began, key, flow = {}, {}, number + 1, "", []
            if ends:
                continue
        if flow:
            flow.append(text)
        elif text.startswith("- ") and key == "ranges":
            message["ranges"].append(_scalar(text[2:], source, number))
            continue
        elif match := re.match(r"([A-Za-z_]\w*)\s*[:=]\s*(.*?);?$", text):
            key, value = SAME_FIELDS.get(match[1], match[1]), match[2]
            if key == "ranges" and NO_ARRAY.match(value):
                raise ValueError(f"{source.name}:{number}: {NOT_PRINTED}.")
            if key == "ranges" and (many := all_numbers(value.encode())) is not None and len(many) > 1:
                message["ranges"] = many.tolist()
                continue
            if key == "ranges" and value and not value.startswith("["):
                message.setdefault("ranges", []).append(_scalar(value, source, number))
                continue
            if key == "ranges":
                message["ranges"] = []
            if value.startswith("["):
                flow = [value]
            elif value and key in STAMP_KEYS:
                header[key] = int(value) if re.fullmatch(r"-?\d+", value) else 0
            elif key in ("stamp", "timestamp") and is_number(value.encode()):
                header["sec"], header["nanosec"] = int(float(value)), round(float(value) % 1 * 1e9)
            elif value and key == "frame_id":
                header[key] = value.strip("'\"")
            elif value and key.startswith(("angle_", "range_")):
                message[key] = _scalar(value, source, number)
        elif text.startswith("...") and key == "ranges":
            _scalar("...", source, number)
        if flow and flow[-1].rstrip().endswith("]"):
            if key == "ranges":
                words = re.split(r"[\s,]+", " ".join(flow).strip("[] ,"))
                message["ranges"] = [_scalar(word, source, number) for word in words]
            flow = []


def _is_cut(message: Mapping[str, Any]) -> bool:
    """Whether the last message has fewer ranges than its angles announce."""
    low, high, step = (message.get(name) for name in ("angle_min", "angle_max", "angle_increment"))
    if low is None or high is None or not step:
        return not message["ranges"]
    return len(message["ranges"]) < round((high - low) / step)


STAMP_KEYS = ("sec", "nanosec", "secs", "nsecs", "nsec")
# What echo prints instead of an array if told to, and what stands there then.
NO_ARRAY = re.compile(r"'?<(?:array|sequence) type")
NOT_PRINTED = "the ranges were not printed; save them with `ros2 topic echo --full-length`, without --no-arr"
# A message of Gazebo begins with a block that is not indented.
BLOCK = re.compile(rb"\w+ \{\s*$")
# A section of an INI file, and the first field of an entry of a list.
SECTION, ENTRY = re.compile(r"\[{1,2}[A-Za-z_][\w.]*\]{1,2}"), re.compile(r"-\s+[A-Za-z_]\w*\s*:")
# Gazebo's names.
SAME_FIELDS = {"angle_step": "angle_increment", "frame": "frame_id"}


def _scalar(word: str, source: Source, number: int) -> float | None:
    word = word.strip().strip("'\"")
    if word == "...":
        raise ValueError(f"{source.name}:{number}: {LEFT_OUT}.")
    try:
        return float(word.lstrip("+-.") if word.lower().lstrip("+-.") in ("inf", "nan") else word)
    except ValueError:
        return None
