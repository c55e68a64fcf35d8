"""A map of lines: those of all frames of a drive, put in the world by their poses and merged."""

from .mapping import LineMap, line_map

__all__ = ["LineMap", "line_map"]
