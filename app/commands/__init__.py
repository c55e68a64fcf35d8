"""The commands of the command line, one file each. To add one, write a file and add a line to COMMANDS."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

# Each command's function, which its file is named after.
COMMANDS = {
    "view": "view",
    "lessons": "lessons",
    "node": "node",
    "extract": "extract",
    "explain": "explain",
    "info": "info",
    "params": "params",
    "record": "record",
    "score": "score",
    "sweep": "sweep",
    "truth": "truth",
    "map": "line_map",
    "tune": "tune",
    "compare": "compare",
    "bench": "bench",
}


def command(name: str) -> Callable[..., None]:
    """The function of a command. Its file is imported only then, because all of them together take a second."""
    function = COMMANDS[name]
    return getattr(import_module(f".{function}", __package__), function)
