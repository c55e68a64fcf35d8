"""Files dropped on the page, in a temporary folder that is removed with the server."""

from __future__ import annotations

import secrets
import shutil
import threading
import unicodedata
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path

from .scratch import Scratch

LONGEST_NAME = 120
# Files of one lesson.
MOST_TOGETHER = 100


class TooLargeError(ValueError):
    """The upload is too large."""


class TooManyError(ValueError):
    """Too many uploads at once."""


@dataclass(frozen=True)
class Upload:
    id: str
    name: str
    path: Path
    size: int


class Uploads:
    """At most `number` files of `limit` bytes each and `total` bytes together; new files replace the oldest."""

    def __init__(self, limit: int, number: int, total: int, at_once: int = 4) -> None:
        self.limit = limit
        self._number = number
        self._total = max(total, limit)
        self._at_once = at_once
        self._arriving = 0
        self._kept: dict[str, Upload] = {}
        self._scratch = Scratch()
        self._lock = threading.Lock()

    def __getitem__(self, id: str) -> Upload:
        with self._lock:
            return self._kept[id]

    def all(self) -> list[Upload]:
        with self._lock:
            return list(self._kept.values())

    async def receive(
        self, name: str, announced: int | None, chunks: AsyncIterator[bytes], bundle: str = "", into: str = ""
    ) -> Upload:
        """Stream one file to disk; a refused file leaves nothing behind.

        bundle: the name of a folder that it is the first file of; into: the id of a folder that it belongs to.
        Raises ValueError, TooLargeError or TooManyError.
        """
        if announced is not None and announced > self.limit:
            raise TooLargeError(self._too_large(name))
        with self._lock:
            if self._arriving >= self._at_once:
                raise TooManyError(f"{self._arriving} files are being uploaded; wait for one of them to finish")
            self._arriving += 1
        try:
            begun = self._begun(into)
            id = begun.id if begun else secrets.token_urlsafe(9)
            with self._lock:
                home = self._scratch.folder / id
            folder = begun.path if begun else home / safe_name(bundle) if bundle else home
            path = folder / safe_name(name)
            try:
                folder.mkdir(parents=True, exist_ok=begun is not None)
                size = await self._write(path, name, chunks)
            except BaseException:
                self.discard(id)
                shutil.rmtree(home, ignore_errors=True)
                raise
        finally:
            with self._lock:
                self._arriving -= 1
        whole = folder if begun or bundle else path
        upload = Upload(id, whole.name, whole, size + (begun.size if begun else 0))
        self._keep(upload)
        return upload

    def _begun(self, id: str) -> Upload | None:
        """The folder that a file belongs to; None if it is a file of its own."""
        with self._lock:
            upload = self._kept.get(id)
        if id and (upload is None or not upload.path.is_dir()):
            raise ValueError("the files that belong to this one are no longer on the server; drop all of them again")
        if upload is not None and sum(1 for _ in upload.path.iterdir()) >= MOST_TOGETHER:
            raise ValueError(f"at most {MOST_TOGETHER} files belong together")
        return upload

    def discard(self, id: str) -> None:
        with self._lock:
            upload = self._kept.pop(id, None)
        if upload is not None:
            shutil.rmtree(upload.path.parent, ignore_errors=True)

    def close(self) -> None:
        """Remove every upload and the folder."""
        with self._lock:
            self._kept.clear()
            self._scratch.close()

    async def _write(self, path: Path, name: str, chunks: AsyncIterator[bytes]) -> int:
        size = 0
        with path.open("xb") as stream:
            async for chunk in chunks:
                size += len(chunk)
                if size > self.limit:
                    raise TooLargeError(self._too_large(name))
                stream.write(chunk)
        if size == 0:
            raise ValueError(f"{safe_name(name)} is empty")
        return size

    def _keep(self, upload: Upload) -> None:
        with self._lock:
            self._kept[upload.id] = upload
            outdated = []
            while len(self._kept) > self._number or sum(kept.size for kept in self._kept.values()) > self._total:
                outdated.append(self._kept.pop(next(iter(self._kept))))
        for old in outdated:
            shutil.rmtree(old.path.parent, ignore_errors=True)

    def _too_large(self, name: str) -> str:
        return (
            f"{safe_name(name)} is larger than {self.limit / 1e6:g} MB, the limit for uploads; "
            "open it from the command line instead"
        )


def safe_name(name: str) -> str:
    """`name` without folders, control characters and leading dots, short enough for any file system."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1]
    clean = "".join(char for char in last if unicodedata.category(char)[0] != "C" and char not in '<>:"|?*')
    clean = clean.strip().lstrip(".")
    if len(clean.encode()) > LONGEST_NAME:
        suffix = "".join(Path(clean).suffixes[-2:])[-20:]
        clean = clean.encode()[: LONGEST_NAME - len(suffix.encode())].decode(errors="ignore") + suffix
    return clean or "recording"
