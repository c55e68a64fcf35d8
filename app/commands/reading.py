"""Flags for how files are read, made from the declaration of the Reading, and the files that a command names."""

from __future__ import annotations

import glob
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, make_dataclass
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import arg

from lineseg.readers import Reading


def _flag(name: str) -> Any:
    entry = Reading.declared()[name]
    text = f"{entry.help}{f' [{entry.unit}]' if entry.unit else ''}."
    kind = Reading.type_of(name)
    shown = entry.metavar or "|".join(Reading.choices(name)) or {str: "TEXT", int: "INT", float: "FLOAT"}[kind]
    return Annotated[kind | None, arg(help=text, metavar=shown, help_behavior_hint="")]


ReadingFlags: type = make_dataclass(
    "ReadingFlags", [(name, _flag(name), None) for name in Reading.declared()], frozen=True
)


def reading_of(flags: Any) -> Reading:
    """The Reading that flags ask for."""
    return Reading(**asdict(flags))


def files_of(names: Sequence[str | Path]) -> list[Path]:
    """The files that are named, each once; a name with * or ? stands for all that match, for shells that leave it.

    Raises FileNotFoundError for a name that matches nothing, ValueError if none is given.
    """
    if not names:
        raise ValueError("name one or more files.")
    found: dict[Path, None] = {}
    for name in names:
        matches = [name] if Path(name).exists() else sorted(glob.glob(str(name), recursive=True))  # noqa: PTH207 - absolute patterns too
        if not matches:
            what = "no file matches" if set("*?[") & set(str(name)) else "there is no such file or folder"
            raise FileNotFoundError(f"{name}: {what}.")
        found |= dict.fromkeys(map(Path, matches))
    return list(found)


def each_file(names: Sequence[str | Path], work: Callable[[Path], None]) -> None:
    """Do `work` for every file. One that cannot be read does not stop the others: it is told, and raised at the end."""
    files = files_of(names)
    failed = 0
    for file in files:
        try:
            work(file)
        except (ValueError, OSError) as error:
            if len(files) == 1:
                raise
            failed += 1
            print(f"lineseg: {' '.join(str(error).split())}", file=sys.stderr)
    if failed:
        raise ValueError(f"{failed} of {len(files)} files failed; see above.")
