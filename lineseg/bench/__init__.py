"""How long extraction takes on this machine: beside the least work that it needs, and beside another program."""

from .timing import bench, table

__all__ = ["bench", "table"]
