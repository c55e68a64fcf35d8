"""Label files of all recordings: finds, reads and saves them, and notifies listeners of changes."""

from __future__ import annotations

import hashlib
import re
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

from lineseg import FrameLabels, Recording, label_file, read_labels, save_labels
from lineseg.failing import shown
from lineseg.truth.label_file import said_in, users_label_file
from lineseg.truth.labels import Labels, check_labels

from ..live.ring import LiveRecording
from .library import Library

LONGEST_HOW = 60
# Which frames are read does not change a frame, so that its labels stay.
NOT_NAMED = frozenset({"topic", "frames", "seconds", "every_scan"})
PARTIAL = "a file cannot be labelled while it is read; wait until all of it is"
LIVE = "a live recording cannot be labelled, because its frames are replaced; save it as a file first"


@dataclass(frozen=True, eq=False)
class Known:
    """The labels of a recording.

    apart: whether the file is in the user's data folder, not next to the recording. stamp: changes with the file;
    trouble: why the file cannot be read, or "".
    """

    path: Path
    apart: bool
    stamp: str
    labels: Labels
    trouble: str = ""

    def of(self, frame: int) -> FrameLabels:
        return self.labels.get(frame, FrameLabels())

    @property
    def labelled(self) -> list[int]:
        """The frames whose true lines are labelled."""
        return [frame for frame, said in self.labels.items() if said.lines is not None]


class LabelFiles:
    """Safe to use from any thread.

    The labels of a user's file are next to it if that folder is writable. Those of samples, uploads and drawn worlds
    are in the user's data folder, named after the recording; uploads with equal bytes share their labels.
    """

    def __init__(self, library: Library, user_folder: Path) -> None:
        self._library = library
        self._folder = user_folder
        self._known: WeakKeyDictionary[Recording, Known] = WeakKeyDictionary()
        self._lock = threading.Lock()
        self._listeners: list[Callable[[str], None]] = []

    def on_change(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Call `listener` with the id of a recording when its labels are saved; returns a function that ends it."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def place(self, id: str, recording: Recording) -> Path:
        """The path of the labels of a recording. Raises ValueError if it cannot have any."""
        if isinstance(recording, LiveRecording):
            raise ValueError(LIVE)
        if recording.partial:
            raise ValueError(PARTIAL)
        kind, _, name = id.partition(":")
        if kind == "drawn":
            return users_label_file("drawn", name, self._folder)
        path = self._library.path(id)
        stream = _stream(recording)
        if kind in ("file", "recent"):
            return label_file(path.with_name(path.name + stream), self._folder)
        identity = _digest(path) if kind == "upload" else id
        return users_label_file(path.name + stream, identity, self._folder)

    def known(self, id: str, recording: Recording) -> Known | None:
        """The labels of a recording; None if it cannot have any."""
        try:
            path = self.place(id, recording)
        except ValueError:
            return None
        stamp = _stamp(path)
        with self._lock:
            known = self._known.get(recording)
            if known is None or (known.path, known.stamp) != (path, stamp):
                known = self._known[recording] = _read(path, path.is_relative_to(self._folder), stamp, recording)
                if not stamp and recording.pack is not None and recording.pack.labels is not None:
                    known = self._known[recording] = _packed(known, recording, recording.pack.labels)
        return known

    def save(self, id: str, recording: Recording, frame: int, labels: FrameLabels) -> FrameLabels:
        """Same as `lineseg.save_labels`, then notifies the listeners."""
        saved = save_labels(self.place(id, recording), recording, frame, labels)
        for listener in list(self._listeners):
            listener(id)
        return saved


def _read(path: Path, apart: bool, stamp: str, recording: Recording) -> Known:
    try:
        return Known(path, apart, stamp, read_labels(path, recording))
    except ValueError as error:
        return Known(path, apart, stamp, {}, str(error))
    except OSError as error:
        return Known(path, apart, stamp, {}, f"{shown(path.name)} cannot be read: {error.strerror}.")


def _packed(known: Known, recording: Recording, labels: dict[str, Any]) -> Known:
    """The labels that a failure pack brings; they are saved beside it only once somebody changes them."""
    try:
        said = said_in(labels)
        check_labels(said, recording, recording.number(0))
    except (KeyError, TypeError, ValueError) as error:
        return replace(known, trouble=f"{recording.name}: its labels are not valid ({error}).")
    return replace(known, labels={recording.number(0): said})


def _stamp(path: Path) -> str:
    try:
        status = path.stat()
    except OSError:
        return ""
    return f"{status.st_ino}-{status.st_mtime_ns}-{status.st_size}"


def _stream(recording: Recording) -> str:
    """Distinguishes further streams of a file, and other ways to read it, from the first."""
    parts = []
    if recording.topics and recording.topic != recording.topics[0].name:
        parts.append(re.sub(r"\W+", "_", recording.topic).strip("_"))
    given = recording.account.given.given() if recording.account is not None else {}
    how = ",".join(f"{name}={value}" for name, value in given.items() if name not in NOT_NAMED)
    if how:
        clean = re.sub(r"[^\w=,.+-]+", "_", how)
        exact = clean == how and len(how) <= LONGEST_HOW
        parts.append(how if exact else f"{clean[:LONGEST_HOW]}-{hashlib.sha256(how.encode()).hexdigest()[:8]}")
    return "".join(f".{part}" for part in parts)


@lru_cache(maxsize=64)
def _digest(path: Path) -> str:
    if path.is_dir():
        return hashlib.sha256("".join(map(_digest, sorted(path.iterdir()))).encode()).hexdigest()
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
