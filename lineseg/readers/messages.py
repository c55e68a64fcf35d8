"""LaserScan messages as text: JSON, JSON lines, a rosbridge log, and what `ros2 topic echo` prints."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from itertools import chain
from typing import Any

import numpy as np

from ..scan import Recording, Topic
from .dialect import Dialect, Row
from .headers import is_angle, is_distance, name_of
from .laser_scan import LaserScan, decode_json
from .source import Reader, Source, Sweeps

MOST_DEPTH = 6
LIST_KEYS = ("ranges", "distances", "range", "distance")


class JsonMessages(Reader):
    """Objects with `ranges`, alone, in a list, one a line, or inside of others; or lists of angle and distance."""

    format = "JSON"
    suffixes = (".json", ".jsonl", ".ndjson")
    expects = "objects with ranges, angle_min and angle_increment"

    @staticmethod
    def recognises(head: bytes) -> bool:
        start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
        return start.startswith(b"{") or bool(re.match(rb"\[\s*\{", start))

    @staticmethod
    def read(source: Source) -> Recording:
        source.notes.kind = "JSON"
        found: dict[str, list[LaserScan]] = {}
        beams: list[Mapping[str, Any]] = []
        for place, value in _values(source):
            for topic, message in _messages(value, "scan"):
                if not any(key in message for key in LIST_KEYS):
                    beams.append(message)
                    continue
                try:
                    found.setdefault(topic, []).append(_decoded(source, message))
                except ValueError as error:
                    source.notes.skip(place, str(error))
        if not found and beams:
            return _beams(source, beams)
        return recording_of(source, found, "JSON")


class EchoYaml(Reader):
    """Messages as indented text, divided by lines of three dashes."""

    format = "echo"
    suffixes = (".yaml", ".yml")
    expects = "messages as `ros2 topic echo` prints them"

    @staticmethod
    def recognises(head: bytes) -> bool:
        lines = [line.strip() for line in head.splitlines()]
        return any(line.startswith((b"angle_min:", b"ranges:")) for line in lines) and b"header:" in lines

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
        raise ValueError(f"{source.name} has no object with ranges; a scan has ranges, angle_min and angle_increment.")
    topics = tuple(Topic(name, len(scans)) for name, scans in found.items())
    topic = source.choose(list(topics))
    sweeps = Sweeps()
    for scan in found[topic]:
        sweeps.add(
            scan.ranges, scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.stamp, scan.frame_id
        )  # fmt: skip
    source.notes.stamps = "the messages"
    return sweeps.recording(source, topic=topic, topics=topics, format=format)


# JSON


def _values(source: Source) -> Iterator[tuple[str, Any]]:
    """(place, value): the whole file as one value if it is one, else each line. Lines that are no JSON are skipped."""
    first = next((line for _, line in source.lines() if line.strip()), b"")
    if _parsed(first) is None:
        whole = _parsed(source.path.read_bytes())
        if whole is not None:
            yield source.name, whole
            return
    for number, line in source.lines():
        if not line.strip():
            continue
        value = _parsed(line)
        if value is None:
            source.notes.skip(f"{source.name}:{number}", "the line is not JSON; is it complete?")
        else:
            yield f"{source.name}:{number}", value


def _parsed(text: bytes) -> Any:
    """The value, None if the text is not JSON."""
    try:
        return json.loads(text.removeprefix(b"\xef\xbb\xbf").strip().rstrip(b","))
    except (ValueError, RecursionError):
        return None


def _messages(value: Any, topic: str, depth: int = 0) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """(topic, object with ranges, or with one angle and one distance), wherever it lies inside of other objects."""
    if depth > MOST_DEPTH:
        return
    if isinstance(value, Mapping):
        if any(isinstance(value.get(key), list) for key in LIST_KEYS) or _is_beam(value):
            yield topic, value
            return
        named = value.get("topic")
        for inner in value.values():
            if isinstance(inner, Mapping | list):
                yield from _messages(inner, named if isinstance(named, str) and named else topic, depth + 1)
    elif isinstance(value, list):
        for inner in value:
            yield from _messages(inner, topic, depth + 1)


def _is_beam(value: Mapping[str, Any]) -> bool:
    numbers = [name_of(key) for key, held in value.items() if isinstance(held, int | float)]
    return any(map(is_angle, numbers)) and any(map(is_distance, numbers))


def _decoded(source: Source, message: Mapping[str, Any]) -> LaserScan:
    """A LaserScan; also with other names for ranges, and with the bearing of each beam if they are even."""
    key = next(key for key in LIST_KEYS if isinstance(message.get(key), list))
    angles = next((message[name] for name in ("angles", "bearings") if isinstance(message.get(name), list)), None)
    plain = dict(message) | {"ranges": message[key]}
    if angles is not None and len(angles) == len(message[key]) > 1:
        even = np.asarray(angles, dtype=np.float64)
        plain |= {"angle_min": float(even[0]), "angle_increment": float(even[-1] - even[0]) / (len(even) - 1)}
        if float(np.abs(even).max()) > 2 * np.pi + 0.2:
            source.notes.found.setdefault("angle_unit", "deg")
    if key != "ranges" or angles is not None:
        source.notes.unstated.add("unit")
    return decode_json(plain)


def _beams(source: Source, beams: list[Mapping[str, Any]]) -> Recording:
    """Objects with an angle and a distance each."""
    from .beam_rows import read_beams

    keys = list(beams[0])
    rows = (Row(at, b"\t".join(str(beam.get(key)).encode() for key in keys)) for at, beam in enumerate(beams, 1))
    return read_beams(source, source.reading, rows, Dialect(b"\t"), [name_of(key) for key in keys])


# YAML


def _documents(source: Source) -> Iterator[tuple[int, dict[str, Any]]]:
    """(line, message): the fields that a scan needs, of each document. A full YAML parser would take minutes.

    Raises ValueError for arrays that `ros2 topic echo` has shortened.
    """
    message: dict[str, Any] = {}
    header: dict[str, Any] = {}
    began, key, flow = 1, "", ""
    for number, line in chain(source.lines(), [(0, b"---")]):
        text = line.decode("utf-8", "replace").strip()
        if text.startswith("---"):
            if "ranges" in message:
                stamp = {name: header[name] for name in STAMP_KEYS if name in header}
                yield began, message | {"header": {"stamp": stamp, "frame_id": header.get("frame_id", "")}}
            message, header, began, key, flow = {}, {}, number + 1, "", ""
            continue
        if flow:
            flow += " " + text
        elif text.startswith("- ") and key == "ranges":
            message["ranges"].append(_scalar(text[2:], source, number))
            continue
        elif match := re.match(r"([A-Za-z_]\w*):\s*(.*)$", text):
            key, value = match[1], match[2]
            if key == "ranges":
                message["ranges"] = []
            if value.startswith("["):
                flow = value
            elif value and key in STAMP_KEYS:
                header[key] = int(value) if re.fullmatch(r"-?\d+", value) else 0
            elif value and key == "frame_id":
                header[key] = value.strip("'\"")
            elif value and key.startswith(("angle_", "range_")):
                message[key] = _scalar(value, source, number)
        elif text.startswith("...") and key == "ranges":
            _scalar("...", source, number)
        if flow.rstrip().endswith("]"):
            if key == "ranges":
                message["ranges"] = [_scalar(word, source, number) for word in re.split(r"[\s,]+", flow.strip("[] ,"))]
            flow = ""


STAMP_KEYS = ("sec", "nanosec", "secs", "nsecs")


def _scalar(word: str, source: Source, number: int) -> float | None:
    word = word.strip().strip("'\"")
    if word == "...":
        raise ValueError(
            f"{source.name}:{number}: `ros2 topic echo` has left out ranges here ('...'); "
            "save them again with its flag --full-length."
        )
    try:
        return float(word.lstrip("+-.") if word.lower().lstrip("+-.") in ("inf", "nan") else word)
    except ValueError:
        return None
