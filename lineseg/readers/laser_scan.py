"""sensor_msgs/LaserScan as bytes and as JSON. Its layout is fixed, so no message definition is read."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ..scan import Floats, Scan

ROS1_HEADER = struct.Struct("<IIII")
CDR_HEADER, NUMBERS = ({order: struct.Struct(order + form) for order in "<>"} for form in ("iII", "7fI"))
# Plain CDR of either version, whose numbers lie as one after another; the last is how XTypes 1.2 wrote the second.
PLAIN = (0x00, 0x01, 0x06, 0x07, 0x10, 0x11)
FLOATS = {order: np.dtype(f"{order}f4") for order in "<>"}
TYPES = ("sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan")
LONGEST_FRAME_ID = 200


class LaserScan(NamedTuple):
    """seconds, nanoseconds: the stamp, exactly; angles [rad]; ranges (n,) float32 [m].

    time_increment: between two beams [s], 0 if it is not known.
    """

    seconds: int
    nanoseconds: int
    frame_id: str
    angle_min: float
    angle_increment: float
    range_min: float
    range_max: float
    ranges: Floats
    time_increment: float = 0.0

    @property
    def stamp(self) -> float:
        """The stamp [s], to about a microsecond for present-day times."""
        return self.seconds + 1e-9 * self.nanoseconds

    def beams(self) -> Scan:
        """The same as a `Scan`."""
        return Scan.regular(
            self.ranges,
            self.angle_min,
            self.angle_increment,
            range_min=self.range_min,
            range_max=self.range_max,
            stamp=self.stamp,
            frame_id=self.frame_id,
        )


def decode_ros1(data: bytes) -> LaserScan:
    """The serialisation of ROS 1: little-endian, packed."""
    try:
        _, seconds, nanoseconds, length = ROS1_HEADER.unpack_from(data)
        return _decode(data, seconds, nanoseconds, 16, length, 16 + length, "<")
    except struct.error:
        raise ValueError(_too_short(data)) from None


def decode_cdr(data: bytes) -> LaserScan:
    """The serialisation of ROS 2: four bytes that state the byte order, then CDR with aligned numbers."""
    if len(data) > 1 and data[1] not in PLAIN:
        raise ValueError(
            f"its bytes have the encoding 0x{data[1]:04x}, but ROS 2 sends plain CDR; declare its type as final"
        )
    try:
        order = "<" if data[1] & 1 else ">"
        seconds, nanoseconds, length = CDR_HEADER[order].unpack_from(data, 4)
        aligned = 4 + (12 + length + 3) // 4 * 4
        return _decode(data, seconds, nanoseconds, 16, max(length - 1, 0), aligned, order)
    except (struct.error, IndexError):
        raise ValueError(_too_short(data)) from None


def _too_short(data: bytes) -> str:
    return f"its {len(data)} bytes end in the middle of a LaserScan"


def _decode(data: bytes, seconds: int, nanoseconds: int, at: int, length: int, numbers: int, order: str) -> LaserScan:
    angle_min, angle_max, increment, pause, _, range_min, range_max, count = NUMBERS[order].unpack_from(data, numbers)
    if numbers + 32 + 4 * count > len(data):
        raise ValueError(f"a LaserScan announces {count} ranges, but its message has {len(data)} bytes")
    ranges = np.frombuffer(data, FLOATS[order], count, numbers + 32)
    if not ranges.dtype.isnative:
        ranges = ranges.astype(np.float32)
    frame_id = data[at : at + min(length, LONGEST_FRAME_ID)].decode("utf-8", "replace")
    return _checked(
        seconds, nanoseconds, frame_id, angle_min, angle_max, increment, range_min, range_max, ranges, pause
    )


def decode_json(message: Any) -> LaserScan:
    """The message as a JSON object, as rosbridge and Foxglove send it.

    ranges: a list of numbers; null, the JSON form of NaN and inf, means no return. header.stamp: {sec, nanosec} or
    {secs, nsecs}. Optional: the stamp (then 0), range_min, range_max, and angle_increment if angle_max is given.
    """
    if not isinstance(message, Mapping):
        raise ValueError(f"a LaserScan is an object with ranges and angle_min, but this is {_shown(message)}")
    listed = message.get("ranges")
    if not isinstance(listed, list):
        raise ValueError(f"ranges is {_shown(listed)}; give a list of distances [m]")
    try:
        with np.errstate(over="ignore"):
            ranges = np.array(listed, dtype=np.float64).astype(np.float32)
    except (TypeError, ValueError, OverflowError):
        ranges = np.empty((0, 0), np.float32)
    if ranges.ndim != 1:
        raise ValueError("ranges holds something that is neither a number nor null")
    header = message.get("header", {})
    header = header if isinstance(header, Mapping) else {}
    stamp = header.get("stamp", {})
    stamp = stamp if isinstance(stamp, Mapping) else {}
    angles = (_number(message, "angle_min"), _number(message, "angle_max", 0.0))
    if "angle_increment" not in message and "angle_max" not in message:
        raise ValueError("angle_increment [rad] is missing; give it, or angle_max")
    rest = (_number(message, "angle_increment", 0.0), _number(message, "range_min", 0.0))
    return _checked(
        _whole(stamp, "sec", "secs"), _whole(stamp, "nanosec", "nsecs", "nsec"), _text(header.get("frame_id", "")),
        *angles, *rest, _number(message, "range_max", 0.0), ranges, _number(message, "time_increment", 0.0),
    )  # fmt: skip


def _checked(
    seconds: int, nanoseconds: int, frame_id: str, angle_min: float, angle_max: float, increment: float,
    range_min: float, range_max: float, ranges: Floats, pause: float,
) -> LaserScan:  # fmt: skip
    """A limit of 0 means that the device states none; an increment of 0 is computed from angle_max.

    pause: the time between two beams [s].
    """
    if increment == 0 and len(ranges) > 1:
        increment = (angle_max - angle_min) / (len(ranges) - 1)
    if not (math.isfinite(angle_min) and math.isfinite(increment)):
        raise ValueError(f"its angle_min is {angle_min} and its angle_increment {increment}; both must be finite")
    longest = range_max if range_max > 0 else np.inf
    shortest = range_min if range_min > 0 else 0.0
    pause = pause if 0 < pause < math.inf else 0.0
    return LaserScan(seconds, nanoseconds, frame_id, angle_min, increment, shortest, longest, ranges, pause)


def _number(message: Mapping[str, Any], name: str, usual: float | None = None) -> float:
    value = message.get(name, usual)
    if value is None and name in message:  # null: an infinity, which JSON lacks
        return math.nan
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{name} is {_shown(value)}; it must be a number")
    return float(value)


def _text(value: Any) -> str:
    """Without halves of characters, which JSON may hold and no other message can."""
    return str(value)[:LONGEST_FRAME_ID].encode("utf-8", "replace").decode()


def _whole(stamp: Mapping[str, Any], *names: str) -> int:
    value = next((stamp[name] for name in names if name in stamp), 0)
    if isinstance(value, str) and value.isdecimal():  # as protobuf writes long numbers
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 1 << 32:
        raise ValueError(f"the stamp's {names[0]} is {_shown(value)}; it must be a whole number")
    return value


def _shown(value: Any) -> str:
    if value is None:
        return "missing"
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:37]}…"
