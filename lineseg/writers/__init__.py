"""Writes segments, drawings of frames, and thresholds for ROS, Python and the command line."""

from __future__ import annotations

from .figure import figure_svg, figure_title
from .params_read import read_params
from .params_write import PARAMS_WRITERS, params_text
from .segments import SEGMENT_WRITERS, segment_lines, write_segments

__all__ = [
    "PARAMS_WRITERS",
    "SEGMENT_WRITERS",
    "figure_svg",
    "figure_title",
    "params_text",
    "read_params",
    "segment_lines",
    "write_segments",
]
