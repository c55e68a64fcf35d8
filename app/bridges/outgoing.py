"""Messages to a robot, in every encoding that a bridge may ask for."""

from __future__ import annotations

import base64
import json
from functools import cache
from typing import Any, ClassVar, Protocol

import numpy as np

from lineseg.readers.laser_scan import LaserScan

from .cdr import CdrWriter


class Message(Protocol):
    """type: as both versions of ROS accept it; encodings: those to send it in, the best first."""

    type: ClassVar[str]
    encodings: ClassVar[tuple[str, ...]]

    def fields(self, ros1: bool = False) -> dict[str, Any]:
        """The fields; those left out are empty."""
        ...

    def cdr(self) -> bytes: ...


def encoded(message: Message, encoding: str) -> bytes:
    """The message as "json", "cdr" or "ros1"."""
    if encoding == "cdr":
        return message.cdr()
    if encoding == "json":
        return as_json(message.fields()).encode()
    store = typestore("ROS1_NOETIC")
    type = full_type(message.type)
    return bytes(store.serialize_ros1(_message(store, message.fields(), type), type))


def as_json(fields: Any) -> str:
    """JSON as rosbridge writes it: bytes in base64."""
    return json.dumps(fields, default=lambda data: base64.b64encode(data).decode())


def full_type(type: str) -> str:
    """sensor_msgs/LaserScan as ROS 2 names it, sensor_msgs/msg/LaserScan."""
    package, _, name = type.partition("/")
    return f"{package}/msg/{name.removeprefix('msg/')}"


def dds_type(name: str) -> str:
    """The name of a type in DDS: sensor_msgs/msg/LaserScan is sensor_msgs::msg::dds_::LaserScan_."""
    package, _, short = name.split("/")
    return f"{package}::msg::dds_::{short}_"


def header_fields(scan: LaserScan, ros1: bool) -> dict[str, Any]:
    """The stamp and the frame of a scan; in ROS 1 the parts of a stamp have other names."""
    names = ("secs", "nsecs") if ros1 else ("sec", "nanosec")
    stamp = dict(zip(names, (scan.seconds, scan.nanoseconds), strict=True))
    return {"stamp": stamp, "frame_id": scan.frame_id}


def write_header(cdr: CdrWriter, scan: LaserScan) -> None:
    cdr.numbers("2I", scan.seconds & 0xFFFFFFFF, scan.nanoseconds)
    cdr.text(scan.frame_id)


@cache
def typestore(name: str) -> Any:
    """Definitions of the messages of a version of ROS."""
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores[name])


def _message(store: Any, values: dict[str, Any], type: str) -> Any:
    """A message of `type` with these values; missing fields are empty."""
    fields = {name: _field(store, kind, values.get(name)) for name, kind in store.fielddefs[type][1]}
    return store.types[type](**fields)


def _field(store: Any, kind: tuple[Any, Any], value: Any) -> Any:
    """One field: base types have (name, size), named types their name, and sequences (element, most)."""
    from rosbags.interfaces import Nodetype

    node, detail = kind
    if node is Nodetype.NAME:
        return _message(store, value or {}, detail)
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        (inner, of), items = detail[0], value or []
        if inner is Nodetype.NAME:
            return [_message(store, item, of) for item in items]
        return np.frombuffer(items, np.uint8) if isinstance(items, bytes) else np.array(items, dtype=np.dtype(of[0]))
    base = detail[0]
    return value if value is not None else "" if base == "string" else False if base == "bool" else 0
