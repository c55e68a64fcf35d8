"""Files opened from the command line, remembered in the user's data folder with how each was read."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lineseg.readers import Reading
from lineseg.unfinished import write_whole

from ..places import user_folder

MOST = 12


class Recent:
    """The list, newest first. If the folder is not writable, it lasts for this run only."""

    def __init__(self, folder: Path | None = None) -> None:
        self._file = user_folder(folder) / "recent.json"
        self._readings = _read(self._file)

    def paths(self) -> list[Path]:
        return list(self._readings)

    def reading(self, path: Path) -> Reading:
        """How a file was last read."""
        return self._readings.get(path.absolute(), Reading())

    def add(self, path: Path) -> None:
        """Put a file first."""
        path = path.absolute()
        others = _read(self._file)
        former = others.pop(path, self.reading(path))
        self._keep({path: former} | others)

    def remember(self, path: Path, reading: Reading) -> None:
        """Note how a listed file is read."""
        known = _read(self._file)
        self._keep(known | {path.absolute(): reading})

    def _keep(self, readings: Mapping[Path, Reading]) -> None:
        self._readings = dict(list(readings.items())[:MOST])
        entries = [
            {"path": str(path), "reading": reading.given()} if reading.given() else str(path)
            for path, reading in self._readings.items()
        ]
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self._file, json.dumps(entries, indent=1))
        except OSError:
            return


def _read(file: Path) -> dict[Path, Reading]:
    try:
        entries = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    found = map(_entry, entries if isinstance(entries, list) else [])
    return dict([entry for entry in found if entry is not None][:MOST])


def _entry(said: Any) -> tuple[Path, Reading] | None:
    """A path, or a path with a Reading."""
    path, how = (said.get("path"), said.get("reading")) if isinstance(said, dict) else (said, None)
    if not isinstance(path, str) or not path or "\0" in path:
        return None
    try:
        os.fsencode(path)
    except UnicodeEncodeError:
        return None
    try:
        return Path(path), Reading(**(how or {}))
    except (TypeError, ValueError):
        # Of another version.
        return Path(path), Reading()
