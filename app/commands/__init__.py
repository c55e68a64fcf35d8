"""The commands of the command line, one file each. To add one, write a file and add a line to COMMANDS."""

from __future__ import annotations

from collections.abc import Callable

from .bench import bench
from .compare import compare
from .explain import explain
from .extract import extract
from .info import info
from .lessons import lessons
from .line_map import line_map
from .node import node
from .params import params
from .record import record
from .score import score
from .sweep import sweep
from .truth import truth
from .tune import tune
from .view import view

COMMANDS: dict[str, Callable[..., None]] = {
    "view": view,
    "lessons": lessons,
    "node": node,
    "extract": extract,
    "explain": explain,
    "info": info,
    "params": params,
    "record": record,
    "score": score,
    "sweep": sweep,
    "truth": truth,
    "map": line_map,
    "tune": tune,
    "compare": compare,
    "bench": bench,
}
