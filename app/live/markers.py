"""Segments as visualization_msgs/MarkerArray, with the stamp and the frame of their scan."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from lineseg.colours import segment_colours
from lineseg.readers.laser_scan import LaserScan
from lineseg.segment import Extraction

# Both versions of ROS accept the short type name.
MARKER_ARRAY = "visualization_msgs/MarkerArray"
LINE_LIST, ADD, DELETE = 5, 0, 2
WIDTH = 0.04


def marker_array(extraction: Extraction, scan: LaserScan, ros1: bool = False) -> dict[str, Any]:
    """One LINE_LIST of all segments as a JSON object; without segments, deletes the previous one.

    ros1: rosbridge of ROS 1 has other names for the parts of a stamp.
    """
    names = ("secs", "nsecs") if ros1 else ("sec", "nanosec")
    stamp = dict(zip(names, (scan.seconds, scan.nanoseconds), strict=True))
    ends = [end for segment in extraction.segments for end in (segment.start, segment.end)]
    colours = np.repeat(segment_colours(extraction.segments), 2, axis=0) / 255
    return {
        "markers": [
            {
                "header": {"stamp": stamp, "frame_id": scan.frame_id},
                "ns": "lineseg",
                "id": 0,
                "type": LINE_LIST,
                "action": ADD if ends else DELETE,
                "pose": {"position": _xyz(), "orientation": _xyz() | {"w": 1.0}},
                "scale": _xyz(x=WIDTH),
                "color": {"r": 1.0, "g": 1.0, "b": 1.0, "a": 1.0},
                "points": [_xyz(x=float(x), y=float(y)) for x, y in ends],
                "colors": [dict(zip("rgba", (*map(float, rgb), 1.0), strict=True)) for rgb in colours.tolist()],
            }
        ]
    }


def _xyz(x: float = 0.0, y: float = 0.0) -> dict[str, float]:
    return {"x": x, "y": y, "z": 0.0}


def _as_json(extraction: Extraction, scan: LaserScan) -> bytes:
    return json.dumps(marker_array(extraction, scan)).encode()


def _as_cdr(extraction: Extraction, scan: LaserScan) -> bytes:
    store = _store("ROS2_HUMBLE")
    return bytes(store.serialize_cdr(_message(store, marker_array(extraction, scan)), _TYPE))


def _as_ros1(extraction: Extraction, scan: LaserScan) -> bytes:
    store = _store("ROS1_NOETIC")
    return bytes(store.serialize_ros1(_message(store, marker_array(extraction, scan)), _TYPE))


# Encoding → bytes; JSON first, because it does not depend on the version of the message.
MARKER_ENCODERS: dict[str, Callable[[Extraction, LaserScan], bytes]] = {
    "json": _as_json,
    "cdr": _as_cdr,
    "ros1": _as_ros1,
}
_TYPE = "visualization_msgs/msg/MarkerArray"


@cache
def _store(name: str) -> Any:
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores[name])


def _message(store: Any, values: dict[str, Any], type: str = _TYPE) -> Any:
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
        return np.array(items, dtype=np.dtype(of[0]))
    base = detail[0]
    return value if value is not None else "" if base == "string" else False if base == "bool" else 0
