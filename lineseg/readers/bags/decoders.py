"""Decodes the messages of a bag: by their type and by the encoding of their channel."""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from ..containers.bounded import unzstd_message
from ..laser_scan import TYPES, LaserScan, decode_cdr, decode_json, decode_ros1

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
MULTI_ECHO = ("sensor_msgs/MultiEchoLaserScan", "sensor_msgs/msg/MultiEchoLaserScan")
FOXGLOVE = ("foxglove.LaserScan", "foxglove_msgs/LaserScan", "foxglove_msgs/msg/LaserScan")
POINT_CLOUDS = ("sensor_msgs/PointCloud2", "sensor_msgs/msg/PointCloud2", "foxglove.PointCloud")
ENCODINGS = ("cdr", "ros1", "json", "protobuf")

Decoder = Callable[[bytes], LaserScan]


def plain_type(type: str) -> str:
    """A type as ROS writes it: sensor_msgs::msg::dds_::LaserScan_ of DDS is sensor_msgs/msg/LaserScan."""
    return type.replace("::dds_::", "::").rstrip("_").replace("::", "/")


def is_laser(type: str, encoding: str = "cdr", schema: bytes = b"") -> bool:
    """Whether messages of a type are scans. JSON and protobuf have no fixed types: a name or a field tells."""
    if encoding in ("json", "protobuf"):
        last = re.split(r"[./:]", type)[-1].lower()
        return last.endswith("scan") or re.search(rb"\branges\b", schema) is not None
    return type in (*TYPES, *MULTI_ECHO, *FOXGLOVE)


def decoder_of(type: str, encoding: str, schema: bytes, echo: int) -> Decoder:
    """The decoder of a channel. Raises ValueError for an encoding that cannot be read.

    echo: which of the echoes of a MultiEchoLaserScan to take. Each call returns another object.
    """
    if encoding == "json":
        return lambda data: decode_foxglove(_object(data))
    if encoding == "protobuf":
        return protobuf_decoder(type, schema)
    if encoding not in ("cdr", "ros1"):
        raise ValueError(f"messages are encoded as {encoding or 'nothing'}; only {', '.join(ENCODINGS)} can be read")
    if type in MULTI_ECHO:
        return partial(decode_multi_echo, encoding=encoding, echo=echo)
    if type in FOXGLOVE:
        return partial(decode_foxglove_binary, encoding=encoding)
    return partial(decode_ros1 if encoding == "ros1" else decode_packed_cdr)


def decode_packed_cdr(data: bytes) -> LaserScan:
    """A message of ROS 2, compressed or not."""
    return decode_cdr(unzstd_message(data) if data[:4] == ZSTD_MAGIC else data)


def unpacked(data: bytes) -> bytes:
    """A message, decompressed if necessary; CDR never begins like zstd."""
    return unzstd_message(data) if data.startswith(ZSTD_MAGIC) else data


def _object(data: bytes) -> Any:
    try:
        return json.loads(data)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"it is not JSON ({error})") from None


def decode_foxglove(message: Any) -> LaserScan:
    """foxglove.LaserScan as an object, or a sensor_msgs/LaserScan, if it has angle_min."""
    if not isinstance(message, Mapping) or "start_angle" not in message:
        return decode_json(message)
    stamp = message.get("timestamp")
    stamp = stamp if isinstance(stamp, Mapping) else {}
    seconds = stamp.get("sec", stamp.get("seconds", 0))
    nanoseconds = stamp.get("nsec", stamp.get("nanos", stamp.get("nanosec", 0)))
    plain = {
        "header": {
            "stamp": {"sec": int(seconds), "nanosec": int(nanoseconds)},
            "frame_id": message.get("frame_id", ""),
        },
        "angle_min": message["start_angle"],
        "angle_max": message.get("end_angle"),
        "ranges": message.get("ranges"),
    }
    return decode_json(plain)


# Protobuf


def protobuf_decoder(type: str, schema: bytes) -> Decoder:
    """Decodes messages by the descriptor that the file brings along. Raises ValueError if it is damaged."""
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

    try:
        files = descriptor_pb2.FileDescriptorSet.FromString(schema)
        pool = descriptor_pool.DescriptorPool()
        waiting = {file.name: file for file in files.file}
        while waiting:
            ready = [file for file in waiting.values() if not any(name in waiting for name in file.dependency)]
            for file in ready:
                pool.Add(waiting.pop(file.name))
            if not ready:
                raise ValueError("its files depend on each other")
        message = message_factory.GetMessageClass(pool.FindMessageTypeByName(type))
    except Exception as error:  # the library has several kinds of errors
        raise ValueError(f"the schema of {type} cannot be used ({error})") from None

    def decode(data: bytes) -> LaserScan:
        try:
            parsed = message.FromString(data)
        except Exception as error:  # DecodeError is no ValueError
            raise ValueError(f"it is no {type} ({error})") from None
        return _from_protobuf(parsed)

    return decode


def _from_protobuf(message: Any) -> LaserScan:
    fields = {field.name: getattr(message, field.name) for field in message.DESCRIPTOR.fields}
    ranges = fields.get("ranges")
    if ranges is None:
        raise ValueError(f"it has no ranges; it has {', '.join(fields)}")
    time = next((fields[name] for name in ("timestamp", "stamp") if name in fields), None)
    header = fields.get("header")
    time = getattr(header, "stamp", None) if time is None else time
    frame_id = fields.get("frame_id", getattr(header, "frame_id", ""))
    low = fields.get("start_angle", fields.get("angle_min", 0.0))
    high = fields.get("end_angle", fields.get("angle_max", 0.0))
    plain = {name: fields[name] for name in ("range_min", "range_max", "angle_increment") if fields.get(name)}
    stamp = {"sec": _whole(time, "seconds", "sec"), "nanosec": _whole(time, "nanos", "nanosec", "nsec")}
    plain |= {"angle_min": low, "angle_max": high, "ranges": list(ranges)}
    return decode_json(plain | {"header": {"stamp": stamp, "frame_id": str(frame_id)}})


def _whole(time: Any, *names: str) -> int:
    return next((int(getattr(time, name)) for name in names if hasattr(time, name)), 0)


# Messages of other layouts


class MessageBytes:
    """Reads a message piece by piece; aligned: whether numbers lie at multiples of their size, as in CDR."""

    def __init__(self, data: bytes, encoding: str) -> None:
        cdr = encoding == "cdr"
        data = unpacked(data) if cdr else data
        self.order = "<" if not cdr or data[1] & 1 else ">"
        self.data, self.at, self.aligned = (data[4:], 0, True) if cdr else (data, 0, False)

    def numbers(self, form: str) -> tuple[Any, ...]:
        """Numbers of one kind, such as "7f"."""
        kind = struct.Struct(self.order + form)
        self._align(struct.calcsize(self.order + form[-1]))
        values = kind.unpack_from(self.data, self.at)
        self.at += kind.size
        return values

    def text(self) -> str:
        (size,) = self.numbers("I")
        value = self.data[self.at : self.at + size]
        self.at += size
        return value.rstrip(b"\0").decode("utf-8", "replace")

    def array(self, kind: str, size: int) -> np.ndarray:
        (count,) = self.numbers("I")
        if count:
            self._align(size)
        if self.at + count * size > len(self.data):
            raise ValueError(f"it announces {count} numbers, but has {len(self.data)} bytes")
        values = np.frombuffer(self.data, f"{self.order}{kind}{size}", count, self.at)
        self.at += count * size
        return values

    def _align(self, size: int) -> None:
        if self.aligned:
            self.at = -(-self.at // size) * size


def decode_multi_echo(data: bytes, encoding: str, echo: int) -> LaserScan:
    """A MultiEchoLaserScan, with one echo of each beam; NaN where a beam has fewer."""
    reader = MessageBytes(data, encoding)
    if encoding == "ros1":
        reader.numbers("I")
    seconds, nanoseconds = (*reader.numbers("i" if encoding == "cdr" else "I"), *reader.numbers("I"))
    frame_id = reader.text()
    low, high, step, _, _, shortest, longest = reader.numbers("7f")
    (beams,) = reader.numbers("I")
    if beams > len(reader.data):
        raise ValueError(f"it announces {beams} beams, but has {len(reader.data)} bytes")
    echoes = [reader.array("f", 4) for _ in range(beams)]
    ranges = [float(each[echo]) if len(each) > echo else None for each in echoes]
    plain = {"angle_min": low, "angle_max": high, "angle_increment": step, "range_min": shortest, "range_max": longest}
    stamp = {"sec": max(seconds, 0), "nanosec": nanoseconds}
    return decode_json(plain | {"ranges": ranges, "header": {"stamp": stamp, "frame_id": frame_id}})


def decode_foxglove_binary(data: bytes, encoding: str) -> LaserScan:
    """foxglove_msgs/LaserScan: time, frame_id, pose (7 numbers), start_angle, end_angle, ranges, intensities."""
    reader = MessageBytes(data, encoding)
    seconds, nanoseconds = (*reader.numbers("I"), *reader.numbers("I"))
    frame_id = reader.text()
    reader.numbers("7d")
    low, high = reader.numbers("2d")
    ranges = reader.array("f", 8).tolist()
    stamp = {"sec": seconds, "nanosec": nanoseconds}
    return decode_json(
        {"angle_min": low, "angle_max": high, "ranges": ranges, "header": {"stamp": stamp, "frame_id": frame_id}}
    )
