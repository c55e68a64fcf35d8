"""The labels of every recording on offer: where they are kept, what they say, and who is told when they change."""

from __future__ import annotations

import hashlib
import re
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from weakref import WeakKeyDictionary

from lineseg import FrameLabels, Recording, label_file, read_labels, save_labels
from lineseg.truth.label_file import users_label_file
from lineseg.truth.labels import Labels

from ..live.ring import LiveRecording
from .library import Library

LIVE = "the frames of a live recording come and go; save it as a file to label it"


@dataclass(frozen=True, eq=False)
class Known:
    """What is said of a recording.

    apart: whether it is in the user's data folder, not beside the recording. stamp: another one whenever the file is;
    trouble: why it cannot be read, or "".
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
        """The frames of which somebody has said which lines are true."""
        return [frame for frame, said in self.labels.items() if said.lines is not None]


class LabelFiles:
    """May be used by any thread.

    A file of the user has its labels beside it, where that can be written. Those of samples, uploads and drawn worlds
    are in the user's data folder, under what the recording is; an upload is the same whenever its bytes are.
    """

    def __init__(self, library: Library, user_folder: Path) -> None:
        self._library = library
        self._folder = user_folder
        self._known: WeakKeyDictionary[Recording, Known] = WeakKeyDictionary()
        self._lock = threading.Lock()
        self._listeners: list[Callable[[str], None]] = []

    def on_change(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Call `listener` with the id of a recording whose labels were saved; the result ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def place(self, id: str, recording: Recording) -> Path:
        """Where the labels of a recording are; a ValueError if it can have none."""
        if isinstance(recording, LiveRecording):
            raise ValueError(LIVE)
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
        """What is said of a recording; None if nothing can be."""
        try:
            path = self.place(id, recording)
        except ValueError:
            return None
        stamp = _stamp(path)
        with self._lock:
            known = self._known.get(recording)
            if known is None or (known.path, known.stamp) != (path, stamp):
                known = self._known[recording] = _read(path, path.is_relative_to(self._folder), stamp, recording)
        return known

    def save(self, id: str, recording: Recording, frame: int, labels: FrameLabels) -> FrameLabels:
        """As `lineseg.save_labels`, and tell those who listen."""
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
        return Known(path, apart, stamp, {}, f"{path.name} cannot be read: {error.strerror}.")


def _stamp(path: Path) -> str:
    try:
        status = path.stat()
    except OSError:
        return ""
    return f"{status.st_ino}-{status.st_mtime_ns}-{status.st_size}"


def _stream(recording: Recording) -> str:
    """What tells the second and further streams of a file from its first."""
    if not recording.topics or recording.topic == recording.topics[0].name:
        return ""
    return "." + re.sub(r"\W+", "_", recording.topic).strip("_")


@lru_cache(maxsize=64)
def _digest(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
