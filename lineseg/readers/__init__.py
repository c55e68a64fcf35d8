"""Reads recordings from files. `open_recording` detects the format by content, then by suffix.

A new format is one small class in one file, and one line in READERS.
"""

from __future__ import annotations

import errno
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..arguments import need_path
from ..failing import named, shown
from ..scan import Recording
from .account import Account, Guess, Notes, Notice, Skipped
from .applying import applied
from .arrays import Npy
from .bags.ros1 import Ros1Bag
from .bags.ros2 import Mcap, Ros2Bag
from .carmen import CarmenLog
from .clouds import PointCloud
from .containers.folder import bag_of_metadata, recording_in
from .containers.wrapping import unwrapped
from .foreign import foreign, unknown
from .mat_file import MatFile
from .matlab import Matlab
from .messages import EchoYaml, JsonMessages
from .npz import Npz, save_npz
from .pack import FailurePack
from .parts import Parts, can_be_shown
from .player import PlayerLog
from .printed import PrintedMessages
from .reading import Reading
from .sick import SickTelegrams
from .source import Cancelled, Progress, Reader, Source
from .tables.dialect import LAST_LIST, LONG_LIST, labels_of
from .tables.labelled import label_in
from .tables.text import Text
from .urgbenri import UrgBenriLog
from .xml_scans import XmlScans
from .yaml_scans import YamlScans

__all__ = [
    "READERS", "Account", "Cancelled", "Guess", "Notice", "Progress", "Reading", "Skipped", "format_of",
    "open_recording", "save_npz",
]  # fmt: skip

HEAD_BYTES = 1 << 16
# The file may be whole, but cannot be had.
LOST = (errno.EIO, errno.ENODEV, errno.ENXIO, errno.ESTALE, errno.ETIMEDOUT)
MOST_LINES = 100


# Readers are asked in this order: a failure pack is a zip like NPZ, and text accepts any lines, so it comes last.
READERS: tuple[type[Reader], ...] = (
    Ros1Bag, Ros2Bag, Mcap, FailurePack, Npz, Npy, PointCloud, CarmenLog, PlayerLog, UrgBenriLog, SickTelegrams,
    JsonMessages, XmlScans, PrintedMessages, MatFile, Matlab, EchoYaml, YamlScans, Text,
)  # fmt: skip


def open_recording(
    path: str | Path,
    reading: Reading | None = None,
    *,
    progress: Progress | None = None,
    so_far: Callable[[Recording], None] | None = None,
    **given: Any,
) -> Recording:
    """The scans of a file, or of the folder of a ROS 2 bag; `Recording.account` says what it was taken for.

    reading: how to read it, where the file does not say it or says it wrongly.
    progress: called with (done, total) while reading; may raise `Cancelled`, which is passed on.
    so_far: called now and then, while a long bag, MCAP file, CARMEN log or file of JSON is read, with a `partial`
    Recording of its first scans.
    given: fields of the Reading, as in open_recording("scan.csv", unit="mm").
    Raises ValueError or OSError, with one sentence, if the file cannot be read.
    """
    need_path(path)
    path = Path(path)
    reading = (reading or Reading()).but(**given)
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file or folder.")
    if not (path.is_file() or path.is_dir()):
        raise ValueError(f"{path} is neither a file nor a folder, such as a pipe or a device; save it as a file first.")
    # Damaged numbers may be anything, and are checked in the end.
    with named(shown(path.name or path), passed=(Cancelled,)), np.errstate(all="ignore"), ExitStack() as stack:
        try:
            source = Source(path, reading, progress or (lambda done, total: None), named=path)
            return _read(replace(source, parts=_parts(source, so_far)), stack)
        except PermissionError:
            raise PermissionError(f"{path}: you have no permission to read it.") from None


def _parts(source: Source, so_far: Callable[[Recording], None] | None) -> Parts | None:
    """Where parts are wanted: shows them as the Reading wants them."""
    if so_far is None or not can_be_shown(source.reading):
        return None

    def show(part: Recording, notes: Notes) -> None:
        shown = applied(part, source.reading, notes, source.named or source.path, source.progress)
        if shown.ranges.size:
            so_far(shown)

    return Parts(show)


def _read(source: Source, stack: ExitStack) -> Recording:
    path = bag_of_metadata(source.path)
    reader = _own_folder(path)
    if path.is_dir() and reader is None:
        path = recording_in(path)
    if reader is None:
        if path.is_file():
            foreign(source.name, _head(path))
        path = unwrapped(path, stack, source.notes, source.progress)
    source = replace(source, path=path)
    reader = reader or (Ros2Bag if path.is_dir() else _reader(source, _head(path)))
    source.reading.check_format(source.name, reader.format)
    recording = _whole(source, reader)
    if not recording.ranges.size:
        raise ValueError(f"{source.name} has no scan with a beam; open another file or topic.")
    return applied(recording, source.reading, source.notes, source.named or source.path, source.progress)


def _whole(source: Source, reader: type[Reader]) -> Recording:
    """What a reader reads; if compressed data broke off, an error says that first."""
    try:
        return reader.read(source)
    except ValueError as error:
        broken = next((notice.text for notice in source.notes.notices if notice.kind == "breaks off"), None)
        if broken is None:
            raise
        raise ValueError(f"{source.name}: {broken[0].lower()}{broken[1:]} {error}") from None
    except (Cancelled, PermissionError, MemoryError):
        raise
    except Exception as error:  # what a library over a damaged file may raise
        if isinstance(error, OSError) and error.errno in LOST:
            raise OSError(
                f"{source.name}: its disk or network failed ({error.strerror}); copy the file first."
            ) from error
        why = " ".join(str(error).split()) or type(error).__name__
        raise ValueError(
            f"{source.name}: a damaged {reader.format} ({why}); a whole one has {reader.expects}."
        ) from error


def _own_folder(path: Path) -> type[Reader] | None:
    return next((reader for reader in READERS if reader.recognises_folder(path)), None) if path.is_dir() else None


def _reader(source: Source, head: bytes) -> type[Reader]:
    suffixes = [suffix.lower() for suffix in source.path.suffixes]
    by_suffix = next((reader for reader in READERS if suffixes and suffixes[-1] in reader.suffixes), None)
    expected = f"; a {by_suffix.format} has {by_suffix.expects}" if by_suffix else ""
    if not head.strip():
        raise ValueError(f"{source.name} is empty{expected}.")
    if (reader := _recognised(head)) is not None:
        # Its sentence says what such a file has.
        told = reader is Text and by_suffix in (CarmenLog, EchoYaml, JsonMessages) and not _has_numbers(head)
        return by_suffix if told and by_suffix is not None else reader
    formats = ", ".join(reader.format for reader in READERS)
    raise unknown(source.name, head, expected, formats)


def format_of(path: Path) -> str:
    """The format of a file by its first bytes, also of one that cannot be read; "" if it is not known."""
    reader = _recognised(_head(path)) if path.is_file() else None
    return "" if reader is None else reader.format


def _recognised(head: bytes) -> type[Reader] | None:
    return next((reader for reader in READERS if reader.recognises(head)), None)


def _has_numbers(head: bytes) -> bool:
    """Whether a line starts like a number, or has numbers with labels, so that a .log may be a table after all."""
    lines = head.splitlines()
    return (
        labels_of(lines[:MOST_LINES]) is not None
        or LONG_LIST.search(head) is not None
        or any(LAST_LIST.search(line) or label_in(line) for line in lines[:MOST_LINES])
        or any(line.lstrip(b" \t[(")[:1] in b"+-.0123456789" for line in lines if line.strip())
    )


def _head(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(HEAD_BYTES)
