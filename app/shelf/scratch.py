"""Temporary folders that end with the process, also if it was killed: the next start removes what it left."""

from __future__ import annotations

import contextlib
import re
import shutil
import tempfile
from pathlib import Path
from typing import IO

from lineseg.truth.label_file import LABELS
from lineseg.unfinished import FILES, FOLDERS, held_folder, is_old, remove_left

OPENERS = re.compile(r"open-\w+\.html")


class Scratch:
    """A folder that is made when it is first asked for, and anew if something has removed it."""

    def __init__(self) -> None:
        self._folder: Path | None = None
        self._lock: IO[bytes] | None = None

    @property
    def folder(self) -> Path:
        if self._folder is None or not self._folder.is_dir():
            self.close()
            self._folder, self._lock = held_folder()
        return self._folder

    def close(self) -> None:
        """Remove the folder."""
        folder, lock = self._folder, self._lock
        self._folder = self._lock = None
        if lock is not None:
            lock.close()
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)


def remove_leftovers(user_folder: Path) -> None:
    """Remove what killed processes of this user left: temporary folders, parts of files, pages to open the browser."""
    remove_left(Path(tempfile.gettempdir()), f"{FOLDERS}*")
    for folder in (user_folder, user_folder / LABELS):
        remove_left(folder, FILES)
    with contextlib.suppress(OSError):
        for page in user_folder.iterdir():
            if OPENERS.fullmatch(page.name) and is_old(page):
                page.unlink(missing_ok=True)
