"""Files that appear when they are complete, and temporary folders. What a killed process left, the next one removes."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import IO

FOLDERS = "lineseg-kept-"
LOCK = ".in-use"
FILES = ".lineseg-*.part"
# So that nothing is removed between being made and being locked.
YOUNG_SECONDS = 60.0


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A file to write in the same folder, which becomes `path` at the end; after an error nothing has changed.

    A link stays a link: its target is replaced. A pipe or device is written itself. Raises OSError, which names `path`,
    if the folder or the disk says no.
    """
    if path.exists() and not path.is_file():
        yield path
        return
    target = path.resolve()
    remove_left(target.parent, FILES)
    part = target.with_name(FILES.replace("*", secrets.token_hex(8)))
    try:
        with _created(part, target) as held:
            locked(held)
            yield part
        part.replace(target)
    except OSError as error:
        with contextlib.suppress(OSError):  # a file system that is read-only
            part.unlink(missing_ok=True)
        if error.errno is None or error.filename not in (None, str(part)):
            raise
        raise type(error)(error.errno, error.strerror, str(path)) from None
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def write_whole(path: Path, text: str) -> None:
    """Write a text as a file that appears when it is complete. Raises OSError, which names `path`."""
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def _created(part: Path, path: Path) -> IO[bytes]:
    with contextlib.suppress(FileNotFoundError):
        # Others may read the file if they could read the one that it replaces.
        mode = path.stat().st_mode & 0o777
        return open(os.open(part, os.O_CREAT | os.O_EXCL | os.O_RDWR, mode), "r+b")  # noqa: PTH123
    return part.open("xb")


@contextlib.contextmanager
def temporary_folder() -> Iterator[Path]:
    """A temporary folder that is removed at the end."""
    folder, lock = held_folder()
    try:
        yield folder
    finally:
        lock.close()
        shutil.rmtree(folder, ignore_errors=True)


def held_folder() -> tuple[Path, IO[bytes]]:
    """A temporary folder, and the lock that keeps others from removing it, for as long as it is open."""
    remove_left(Path(tempfile.gettempdir()), f"{FOLDERS}*")
    folder = Path(tempfile.mkdtemp(prefix=FOLDERS))
    lock = (folder / LOCK).open("wb")
    locked(lock)
    return folder, lock


def remove_left(folder: Path, pattern: str) -> None:
    """Remove the files and temporary folders of killed processes of this user from a folder."""
    with contextlib.suppress(OSError):
        for left in folder.glob(pattern):
            if is_old(left) and _is_free(left):
                if left.is_dir():
                    shutil.rmtree(left, ignore_errors=True)
                else:
                    left.unlink(missing_ok=True)


def is_old(path: Path) -> bool:
    """Whether it is this user's, and not of the last minute."""
    try:
        status = path.lstat()
    except OSError:
        return False
    ours = not hasattr(os, "getuid") or status.st_uid == os.getuid()
    return ours and time.time() - status.st_mtime > YOUNG_SECONDS


def _is_free(path: Path) -> bool:
    """Whether no process holds it. Where files cannot be locked, nothing is free."""
    try:
        with (path / LOCK if path.is_dir() else path).open("rb") as lock:
            return locked(lock)
    except FileNotFoundError:
        # A killed process had no time to lock it, or to remove all of it.
        return True
    except OSError:
        return False


def locked(file: IO[bytes]) -> bool:
    """Lock a file for as long as it is open; False if another process has, or if files cannot be locked here."""
    try:
        import fcntl
    except ImportError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
