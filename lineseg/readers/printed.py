"""LaserScan messages as Python prints them, also inside the lines of a log."""

from __future__ import annotations

import re
from typing import Any

from ..scan import Recording
from .laser_scan import LaserScan, decode_json
from .messages import recording_of
from .source import Reader, Source
from .tables.dialect import LEFT_OUT
from .tables.numbers import all_numbers

BEGINS = re.compile(rb"\bLaserScan\(\s*header=")
NUMBER = re.compile(rb"\b(angle_min|angle_max|angle_increment|range_min|range_max)=([-+.\w]+)")
RANGES = re.compile(rb"\branges=(?:\w+\((?:'\w',\s*)?)?\[([^\]]*)(\]?)")
STAMP = re.compile(rb"\bsec=(-?\d+),\s*nanosec=(\d+)")
FRAME_ID = re.compile(rb"\bframe_id=['\"]([^'\"]*)")


class PrintedMessages(Reader):
    """`print(message)` in Python, with ROS 2."""

    format = "printed messages"
    suffixes = ()
    expects = "messages such as sensor_msgs.msg.LaserScan(header=…, ranges=[…])"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return b"LaserScan(" in head and BEGINS.search(head) is not None and b"\0" not in head

    @staticmethod
    def read(source: Source) -> Recording:
        text = source.path.read_bytes()
        starts = [found.start() for found in BEGINS.finditer(text)]
        scans: list[LaserScan] = []
        line, seen = 1, 0
        for start, stop in zip(starts, [*starts[1:], len(text)], strict=True):
            line, seen = line + text.count(b"\n", seen, start), start
            try:
                scans.append(decode_json(_fields(text[start:stop])))
            except ValueError as error:
                source.notes.skip(f"{source.name}:{line}", str(error))
        source.notes.kind = "printed messages"
        return recording_of(source, {"scan": scans} if scans else {}, PrintedMessages.format)


def _fields(message: bytes) -> dict[str, Any]:
    ranges = RANGES.search(message)
    if ranges is None or not ranges[2]:
        raise ValueError("the message breaks off before its ranges end")
    if b"..." in ranges[1]:
        raise ValueError(LEFT_OUT)
    values = all_numbers(ranges[1])
    if values is None:
        raise ValueError("some of its ranges are not numbers")
    fields: dict[str, Any] = {name.decode(): float(number) for name, number in NUMBER.findall(message)}
    header: dict[str, Any] = {}
    if stamp := STAMP.search(message):
        header["stamp"] = {"sec": int(stamp[1]), "nanosec": int(stamp[2])}
    if frame_id := FRAME_ID.search(message):
        header["frame_id"] = frame_id[1].decode("utf-8", "replace")
    return fields | {"ranges": values.tolist(), "header": header}
