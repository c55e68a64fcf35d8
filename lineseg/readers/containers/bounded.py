"""Limits on what compressed data may become: bytes are counted after expansion. Every reader expands with this."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import IO, cast

from ...failing import reason

PIECE = 1 << 20
# Scans compress to a tenth, rarely to a hundredth; what grows more was made to do harm.
LARGEST_RATIO = 200
SMALL, MOST = 1 << 28, 8 << 30
MOST_MESSAGE = 1 << 26
# In bytes; file systems allow 255.
LONGEST_NAME = 200


class TooLargeError(ValueError):
    """Data would become larger than allowed."""


class Budget:
    """What a file of `size` bytes may become in memory, spent before it is made."""

    def __init__(self, name: str, size: int) -> None:
        self._name, self._limit = name, limit_of(size)
        self.left = self._limit

    def spend(self, size: int) -> None:
        """Raises TooLargeError if there is not so much left."""
        if size > self.left:
            raise TooLargeError(too_large(self._name, self._limit))
        self.left -= size


def limit_of(packed: int) -> int:
    """The most bytes that `packed` bytes may become."""
    return min(max(SMALL, LARGEST_RATIO * packed), MOST)


def expand(
    packed: IO[bytes], target: Path, name: str, limit: int, tell: Callable[[int], None] = lambda done: None
) -> str:
    """Write all of an opened compressed file to `target`; returns why it broke off, "" if it is whole.

    tell: called with the bytes written so far. Raises TooLargeError beyond the limit.
    """
    done, read = 0, getattr(packed, "read1", packed.read)
    with target.open("wb") as out:
        while True:
            try:
                piece = read(PIECE)
            except Exception as error:  # each library has errors of its own
                return reason(error) or type(error).__name__
            if not piece:
                return ""
            done += len(piece)
            if done > limit:
                raise TooLargeError(too_large(name, limit))
            out.write(piece)
            tell(done)


def file_name(entry: str) -> str:
    """A name for a file from an archive: the last part of its path, and never one that leads out of the folder."""
    last = entry.replace("\\", "/").rpartition("/")[2].replace("\0", "")
    end = last.encode("utf-8", "replace")[-LONGEST_NAME:].decode(errors="ignore")
    return end if end.strip(".") else "unpacked"


def zstd_file(raw: IO[bytes]) -> IO[bytes]:
    """A file opened in binary mode, unpacked from zstd while it is read."""
    from rosbags.rosbag2.reader import zstd

    return cast(IO[bytes], zstd.open(raw, "rb"))


def unzstd(data: bytes, most: int) -> bytes:
    """The first `most` bytes of data packed with zstd; fewer if they break off."""
    from rosbags.rosbag2.reader import zstd

    return zstd.ZstdDecompressor().decompress(data, max_length=most)


def unzstd_message(data: bytes, most: int = MOST_MESSAGE) -> bytes:
    """A message expanded from zstd. Raises TooLargeError if it would have more than `most` bytes."""
    unpacked = unzstd(data, most + 1)
    if len(unpacked) > most:
        raise TooLargeError(too_large("a message", most))
    return unpacked


def too_large(name: str, limit: int) -> str:
    size = f"{limit / 2**30:.3g} GB" if limit >= 1 << 30 else f"{limit >> 20} MB"
    return f"{name} would have more than {size} unpacked, which is not allowed; unpack it yourself, or split it."
