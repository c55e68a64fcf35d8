"""Temporary folders that end with the process, also if it was killed: the next start removes what it left."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import tempfile
import time
from pathlib import Path
from typing import IO

PREFIX = "lineseg-kept-"
LOCK = ".in-use"
# So that a folder is not removed between being made and being locked.
YOUNG_SECONDS = 60.0
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
            self._folder = Path(tempfile.mkdtemp(prefix=PREFIX))
            self._lock = (self._folder / LOCK).open("wb")
            _locked(self._lock)
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
    """Remove what killed processes of this user left: temporary folders, and pages that open the browser."""
    with contextlib.suppress(OSError):
        for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
            if _is_old(folder) and _is_left(folder):
                shutil.rmtree(folder, ignore_errors=True)
    with contextlib.suppress(OSError):
        for page in user_folder.iterdir():
            if OPENERS.fullmatch(page.name) and _is_old(page):
                page.unlink(missing_ok=True)


def _is_old(path: Path) -> bool:
    try:
        status = path.lstat()
    except OSError:
        return False
    ours = not hasattr(os, "getuid") or status.st_uid == os.getuid()
    return ours and time.time() - status.st_mtime > YOUNG_SECONDS


def _is_left(folder: Path) -> bool:
    """Whether no process holds the folder. Where files cannot be locked, nothing is removed."""
    try:
        with (folder / LOCK).open("rb") as lock:
            return _locked(lock)
    except OSError:
        return False


def _locked(file: IO[bytes]) -> bool:
    try:
        import fcntl
    except ImportError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
