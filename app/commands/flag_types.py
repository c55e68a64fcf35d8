"""Types of flags whose default the help does not print, because its text says what happens without them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, TypeVar

from tyro.conf import arg

T = TypeVar("T")

Unset = Annotated[T | None, arg(help_behavior_hint="")]
Switch = Annotated[bool, arg(help_behavior_hint="")]
Several = Annotated[tuple[T, ...], arg(help_behavior_hint="")]
# Recordings, and one that need not be given.
Files = Annotated[tuple[T, ...], arg(help_behavior_hint="", metavar="FILE ...")]
File = Annotated[T | None, arg(help_behavior_hint="", metavar="[FILE]")]


def lessons_folder(given: Path | None) -> Path | None:
    """The folder of --lessons. Raises NotADirectoryError if it is none."""
    if given is not None and not given.is_dir():
        raise NotADirectoryError(f"--lessons is {given}, which is not a folder; name the folder with the lessons")
    return given and given.resolve()
