"""Types of ROS 2 messages for Cyclone DDS. Their samples stay bytes: Python decodes field by field too slowly."""

from __future__ import annotations

from functools import cache
from typing import Any

from cyclonedds.idl import make_idl_struct, types

from .outgoing import dds_type, typestore

BASE: dict[str, Any] = {"bool": bool, "string": str, "octet": types.byte} | {
    name: getattr(types, name)
    for name in ("int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", "float32", "float64")
}


class Serialised:
    """A message as CDR, which begins with four bytes for the byte order."""

    def __init__(self, data: bytes) -> None:
        self.data = data

    def serialize(self, **_: Any) -> bytes:
        return self.data

    @classmethod
    def deserialize(cls, data: bytes, **_: Any) -> Any:
        return cls(data)


@cache
def serialised_type(name: str) -> Any:
    """The type of sensor_msgs/msg/LaserScan, for example. Its samples are made of bytes and have them as `data`."""
    kind = _struct(name)
    # A base class would become part of the type that others see.
    for method in ("__init__", "serialize", "deserialize"):
        setattr(kind, method, Serialised.__dict__[method])
    kind.deserialize_key = kind.deserialize
    return kind


@cache
def _struct(name: str) -> Any:
    fields = {field: _kind(kind) for field, kind in typestore("ROS2_HUMBLE").fielddefs[name][1]}
    return make_idl_struct(name.rpartition("/")[2], dds_type(name), fields, dataclassify=False)


def _kind(kind: tuple[Any, Any]) -> Any:
    """A kind of rosbags: base types have (name, size), named types their name, and sequences (element, most)."""
    from rosbags.interfaces import Nodetype

    node, detail = kind
    if node is Nodetype.BASE:
        return BASE[detail[0]]
    if node is Nodetype.NAME:
        return _struct(detail)
    inner, count = detail
    return types.array[_kind(inner), count] if node is Nodetype.ARRAY else types.sequence[_kind(inner)]
