"""Segments as visualization_msgs/MarkerArray, with the stamp and the frame of their scan."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

import numpy as np

from lineseg.colours import segment_colours
from lineseg.readers.laser_scan import LaserScan
from lineseg.segment import Extraction

from .cdr import CdrWriter
from .outgoing import header_fields, write_header

LINE_LIST, ADD, DELETE = 5, 0, 2
WIDTH = 0.04
NAMESPACE = "lineseg"


@dataclass(frozen=True)
class Markers:
    """One LINE_LIST of all segments; without segments, deletes the previous one."""

    extraction: Extraction
    scan: LaserScan
    type: ClassVar[str] = "visualization_msgs/MarkerArray"
    # JSON first, because it does not depend on the version of the message.
    encodings: ClassVar[tuple[str, ...]] = ("json", "cdr", "ros1")

    def fields(self, ros1: bool = False) -> dict[str, Any]:
        ends, colours = self._lines()
        return {
            "markers": [
                {
                    "header": header_fields(self.scan, ros1),
                    "ns": NAMESPACE,
                    "id": 0,
                    "type": LINE_LIST,
                    "action": ADD if len(ends) else DELETE,
                    "pose": {"position": _xyz(), "orientation": _xyz() | {"w": 1.0}},
                    "scale": _xyz(WIDTH),
                    "color": {"r": 1.0, "g": 1.0, "b": 1.0, "a": 1.0},
                    "points": [_xyz(*end) for end in ends.tolist()],
                    "colors": [dict(zip("rgba", rgba, strict=True)) for rgba in colours.tolist()],
                }
            ]
        }

    def cdr(self) -> bytes:
        """As visualization_msgs defines it since ROS 2 Humble."""
        ends, colours = self._lines()
        cdr = CdrWriter()
        cdr.numbers("I", 1)
        write_header(cdr, self.scan)
        cdr.text(NAMESPACE)
        cdr.numbers("3i", 0, LINE_LIST, ADD if len(ends) else DELETE)
        cdr.numbers("7d", *[0.0] * 6, 1.0)
        cdr.numbers("3d", WIDTH, 0.0, 0.0)
        cdr.numbers("4f", 1.0, 1.0, 1.0, 1.0)
        cdr.numbers("2i", 0, 0)  # lifetime: forever
        cdr.numbers("?", False)  # frame_locked
        cdr.sequence(ends)
        cdr.sequence(colours.astype(np.float32))
        cdr.same(_no_texture_and_no_mesh())
        return cdr.bytes()

    def _lines(self) -> tuple[np.ndarray, np.ndarray]:
        """Both ends of each segment (2n, 3) [m], and their colours (2n, 4)."""
        segments = self.extraction.segments
        ends = np.zeros((2 * len(segments), 3))
        ends[:, :2] = np.array([(segment.start, segment.end) for segment in segments]).reshape(-1, 2)
        colours = np.ones((2 * len(segments), 4))
        colours[:, :3] = np.repeat(segment_colours(segments), 2, axis=0) / 255
        return ends, colours


def _xyz(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


@cache
def _no_texture_and_no_mesh() -> bytes:
    """texture_resource, texture, uv_coordinates, text, mesh_resource, mesh_file, mesh_use_embedded_materials."""
    cdr = CdrWriter()
    cdr.text("")
    cdr.numbers("2I", 0, 0)
    cdr.text("")
    cdr.text("")
    cdr.numbers("2I", 0, 0)
    cdr.text("")
    cdr.text("")
    cdr.text("")
    cdr.numbers("I", 0)
    cdr.numbers("?", False)
    return cdr.body()
