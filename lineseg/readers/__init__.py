"""Reads recordings from files. `open_recording` detects the format by content, then by suffix.

A new format is one small class in one file, and one line in READERS.
"""

from __future__ import annotations

import gzip
import zlib
from pathlib import Path

from ..arguments import need_path
from ..scan import Recording
from .carmen import CarmenLog
from .npz import Npz, save_npz
from .pack import FailurePack
from .ros1 import Ros1Bag
from .ros2 import Mcap, Ros2Bag
from .source import GZIP_MAGIC, Cancelled, Progress, Reader, Source
from .text import Text
from .text_options import TextOptions

__all__ = ["READERS", "Cancelled", "Progress", "TextOptions", "open_recording", "save_npz"]

HEAD_BYTES = 1 << 16


# Readers are asked in this order: a failure pack is a zip like NPZ, and text accepts any lines, so it comes last.
READERS: tuple[type[Reader], ...] = (Ros1Bag, Ros2Bag, Mcap, FailurePack, Npz, CarmenLog, Text)


def open_recording(
    path: str | Path, topic: str | None = None, progress: Progress | None = None, text: TextOptions | None = None
) -> Recording:
    """The scans of a file, or of the folder of a ROS 2 bag.

    topic: the stream of scans to read (default: the first). `Recording.topics` lists all.
    progress: called with (done, total) while reading; may raise `Cancelled`, which is passed on.
    text: the scan geometry that a plain text file does not contain.
    Raises ValueError or OSError, with one sentence, if the file cannot be read.
    """
    need_path(path)
    path = Path(path)
    source = Source(path, topic, progress or (lambda done, total: None), text or TextOptions())
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file or folder.")
    try:
        recording = (_folder_reader(path) if path.is_dir() else _reader(source, _head(path))).read(source)
    except PermissionError:
        raise PermissionError(f"{path}: you have no permission to read it.") from None
    if not recording.ranges.size:
        raise ValueError(f"{source.name} has no scan with a beam; open another file or topic.")
    return recording


def _folder_reader(folder: Path) -> type[Reader]:
    # Any other folder is treated as a ROS 2 bag, whose reader says what is missing.
    return next((reader for reader in READERS if reader.recognises_folder(folder)), Ros2Bag)


def _reader(source: Source, head: bytes) -> type[Reader]:
    suffixes = [suffix.lower() for suffix in source.path.suffixes]
    by_suffix = next((reader for reader in READERS if suffixes and _last(suffixes) in reader.suffixes), None)
    expected = f"; a {by_suffix.format} has {by_suffix.expects}" if by_suffix else ""
    if not head.strip():
        raise ValueError(f"{source.name} is empty{expected}.")
    for reader in READERS:
        if reader.recognises(head):
            if _packed(source.path) and not reader.unpacks:
                raise ValueError(
                    f"{source.name}: a {reader.format} compressed with gzip; unpack it with `gunzip` first."
                )
            return CarmenLog if reader is Text and by_suffix is CarmenLog and not _has_numbers(head) else reader
    formats = ", ".join(reader.format for reader in READERS)
    raise ValueError(
        f"{source.name} begins with {head[:8]!r}, which is not a known format{expected}. Known formats: {formats}."
    )


def _last(suffixes: list[str]) -> str:
    return suffixes[-2] if suffixes[-1] == ".gz" and len(suffixes) > 1 else suffixes[-1]


def _has_numbers(head: bytes) -> bool:
    """Whether a line starts like a number, so that a .log may be a table after all."""
    return any(line.lstrip()[:1] in b"+-.0123456789" for line in head.splitlines() if line.strip())


def _packed(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(2) == GZIP_MAGIC


def _head(path: Path) -> bytes:
    """The first bytes of a file, unpacked if it is gzip; as many as are readable if it is broken."""
    if not _packed(path):
        with path.open("rb") as file:
            return file.read(HEAD_BYTES)
    head = bytearray()
    try:
        with gzip.open(path, "rb") as file:
            while len(head) < HEAD_BYTES and (piece := file.read1(HEAD_BYTES)):
                head += piece
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        if not head:
            raise ValueError(f"{path.name}: damaged gzip data ({error}); fetch the file again.") from None
    return bytes(head)
