"""Files opened from the command line, remembered in the user's data folder."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path

from ..places import user_folder

MOST = 12


class Recent:
    """The list, newest first. If the folder is not writable, it lasts for this run only."""

    def __init__(self, folder: Path | None = None) -> None:
        self._file = user_folder(folder) / "recent.json"
        self._paths = _read(self._file)

    def paths(self) -> list[Path]:
        return list(self._paths)

    def add(self, path: Path) -> None:
        path = path.absolute()
        others = [known for known in _read(self._file) if known != path]
        self._paths = [path, *others][:MOST]
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            _write(self._file, json.dumps([str(known) for known in self._paths], indent=1))
        except OSError:
            return


def _read(file: Path) -> list[Path]:
    try:
        entries = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return []
    if not isinstance(entries, list):
        return []
    return [Path(entry) for entry in entries if isinstance(entry, str) and entry][:MOST]


def _write(file: Path, text: str) -> None:
    """Replace the file atomically, so that a crash or a second program never leaves half a list."""
    handle, name = tempfile.mkstemp(dir=file.parent, prefix=file.name)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.write(text)
        Path(name).replace(file)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
