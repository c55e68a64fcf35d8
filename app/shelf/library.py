"""The recordings that can be opened, by id, and the open ones, shared by all tabs."""

from __future__ import annotations

import hashlib
import os
import threading
from collections import OrderedDict
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from lineseg import Recording
from lineseg.failing import shown
from lineseg.readers import Cancelled, Reading, open_recording
from lineseg.simulate.drawing import Drawing

from ..live.hub import Live
from ..places import data_folder
from ..told.messages import RecordingEntry
from .lesson_shelf import LessonShelf
from .recent import Recent
from .uploads import Uploads

MOST_OPEN = 12
MOST_BYTES = 2_000_000_000
POLL = 0.05

# The id of a drawn world contains the world itself, so a link is enough to open it.
DRAWN = "drawn:"
FIRST_DRAWING = "w-2,2,3,2;w3,2,3,-1.5;w3,-1.5,0.5,-1.5;c1.2,0.8,0.25;l0,0,0;b-135,135,0.5,30,0.01;s0"
# The recording of a lesson that is not one of the program's.
OWN = "own"
OWN_LABEL = "Scans of the lesson"
DRAWN_LABEL = "Your own world"

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class _Key:
    """A file at one moment, and how it is read; a changed file is another recording."""

    path: Path
    reading: Reading
    changed: int
    size: int


class _Load:
    """A file being read; cancelled when no tab waits for it."""

    def __init__(self, key: _Key) -> None:
        self.done = threading.Event()
        self.progress = (0, 0)
        self.part: Recording | None = None
        self.waiting = 0
        self.recording: Recording | None = None
        self.error: BaseException | None = None
        self._key = key
        self._given_up = False

    def start(self, finish: Callable[[_Load], None]) -> None:
        def work() -> None:
            try:
                path, reading = self._key.path, self._key.reading
                self.recording = open_recording(path, reading, progress=self._report, so_far=self._show)
            except BaseException as error:
                self.error = error
            finish(self)
            self.done.set()

        threading.Thread(target=work, name=f"load {self._key.path.name}", daemon=True).start()

    def _show(self, part: Recording) -> None:
        self.part = part

    def give_up(self) -> None:
        self._given_up = True

    def _report(self, done: int, total: int) -> None:
        if self._given_up:
            raise Cancelled
        self.progress = (done, total)


class Library:
    """Only listed recordings can be opened: samples, lessons, files of the command line, recent files and uploads.

    reading: how the files of the command line are read (default: each as the last time).
    """

    def __init__(
        self,
        files: Sequence[Path],
        recent: Recent,
        uploads: Uploads,
        live: Live | None = None,
        reading: Reading | None = None,
        lessons: LessonShelf | None = None,
    ) -> None:
        self.uploads = uploads
        self.lessons = lessons or LessonShelf()
        self.live = live or Live()
        self._samples = _samples()
        self._files = {f"file:{_digest(path)}": path for path in map(_absolute, files)}
        self._recents = recent
        self._recent = {f"recent:{_digest(path)}": path for path in recent.paths()}
        self._readings = {id: recent.reading(path) for id, path in {**self._recent, **self._files}.items()}
        if reading is not None and reading.given():
            self._readings |= dict.fromkeys(self._files, reading)
        # Uploads that could not be read; they are kept, so that they may be read in another way.
        self._unread: set[str] = set()
        for path in reversed(self._files.values()):
            recent.add(path)
        self._open: OrderedDict[_Key, Recording] = OrderedDict()
        self._loads: dict[_Key, _Load] = {}
        self._lock = threading.Lock()
        self._listeners: list[Callable[[], None]] = []

    def on_change(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call `listener`, from any thread, when the list changes. Returns a function that unsubscribes."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def changed(self) -> None:
        for listener in list(self._listeners):
            listener()

    def entries(self) -> list[RecordingEntry]:
        """All recordings, in the order of the menu."""
        lessons = [id for id in self._samples if id.startswith("lesson:")]
        samples = [id for id in self._samples if id.startswith("sample:")]
        opened = set(self._files.values())
        rows = [RecordingEntry(id=source.id, label=source.label, group="Live") for source in self.live]
        rows += [RecordingEntry(id=id, label=self.label(id), group="Command line") for id in self._files]
        rows += [
            RecordingEntry(id=id, label=up.name, group="Uploads")
            for up in reversed(self.uploads.all())
            if (id := f"upload:{up.id}") not in self._unread
        ]
        rows += [RecordingEntry(id=id, label=_title(self._samples[id]), group="Samples") for id in samples]
        rows += [RecordingEntry(id=id, label=_title(self._samples[id]), group="Lessons") for id in lessons]
        rows += [
            RecordingEntry(id=id, label=self.label(id), group="Recent", missing=not os.path.exists(path))  # noqa: PTH110 - this one raises nothing
            for id, path in self._recent.items()
            if path not in opened
        ]
        rows.append(RecordingEntry(id=f"{DRAWN}{FIRST_DRAWING}", label=DRAWN_LABEL, group="Drawn"))
        for row in rows:
            row.reading = self.reading(row.id).given()
        return rows

    def reading(self, id: str) -> Reading:
        """How a recording was last read."""
        return self._readings.get(id, Reading())

    def remember(self, id: str, reading: Reading) -> None:
        """Note how a recording is read, for the next time; that of a file lasts. A truth from poses is not kept."""
        reading = reading.but(walls=None)
        if self.reading(id) == reading or id.startswith(("live:", DRAWN)):
            return
        self._readings[id] = reading
        path = {**self._recent, **self._files}.get(id)
        if path is not None:
            self._recents.remember(path, reading)
        self.changed()

    def first(self) -> str:
        """The recording of a new tab: a robot or the first file of the command line, else the first sample."""
        return next(iter([*self.live.robots, *self._files, *self._samples]), "")

    def instead_of(self, broken: Collection[str]) -> str:
        """The recording to show if these ids cannot be shown; "" if none is left."""
        return next((id for id in [*self._files, *self._samples] if id not in broken), "")

    def label(self, id: str) -> str:
        if id.startswith(DRAWN):
            return DRAWN_LABEL
        if (source := self.live.get(id)) is not None:
            return source.label
        if id in self._samples:
            return _title(self._samples[id])
        path = self._files.get(id) or self._recent.get(id)
        if path is not None:
            return shown(path.name)
        if id.startswith(f"{OWN}:"):
            title = self.lessons.title_of(id)
            return f"{OWN_LABEL} “{title}”" if title else OWN_LABEL
        return next((upload.name for upload in self.uploads.all() if id == f"upload:{upload.id}"), id)

    def path(self, id: str) -> Path:
        """The file with an id. Raises ValueError for an unknown id."""
        kind, _, name = id.partition(":")
        try:
            if kind == "upload":
                return self.uploads[name].path
            if kind == OWN:
                return self.lessons.recording(id)
            return {**self._samples, **self._files, **self._recent}[id]
        except KeyError:
            if kind == "upload":
                raise ValueError("this upload is no longer on the server; drop the file on the page again") from None
            if kind == OWN:
                raise ValueError("this server no longer has the lesson of this link; drop its file again") from None
            if kind in ("file", "recent"):
                raise ValueError(
                    "this server does not know the file of this link; open it from the command line"
                ) from None
            raise ValueError(f"there is no recording {id[:60]!r}; choose one from the menu") from None

    def recording(
        self,
        id: str,
        reading: Reading | None = None,
        progress: Progress | None = None,
        wanted: Callable[[], bool] = lambda: True,
        so_far: Callable[[Recording], None] | None = None,
    ) -> Recording:
        """The recording with an id, read from its file if not open yet. Raises Cancelled once it is not `wanted`.

        For a live source: the scans so far. so_far: called now and then with the first scans of a long file being read.
        Raises ValueError for a Reading of what is not a file.
        """
        reading = reading or Reading()
        if id.startswith(("live:", DRAWN)) and reading.but(topic=None).given():
            raise ValueError(f"{self.label(id)} is not read from a file, so {', '.join(reading.given())} cannot be set")
        if id.startswith("live:"):
            return self.live.recording(id, lambda: progress and progress(0, 0), wanted)
        if id.startswith(DRAWN):
            return _drawn(id.removeprefix(DRAWN))
        key = self._key(id, reading)
        with self._lock:
            if key in self._open:
                self._open.move_to_end(key)
                return self._open[key]
            load = self._loads.get(key)
            if load is None:
                load = self._loads[key] = _Load(key)
                load.start(lambda load: self._finish(key, load))
            load.waiting += 1
        try:
            recording = _wait(load, progress, wanted, so_far)
        except (ValueError, OSError):
            if id.startswith("upload:") and not reading.given():
                self._unread.add(id)
                self.changed()
            raise
        else:
            if id in self._unread:
                self._unread.discard(id)
                self.changed()
            return recording
        finally:
            with self._lock:
                load.waiting -= 1
                if load.waiting == 0 and not load.done.is_set():
                    load.give_up()
                    if self._loads.get(key) is load:
                        del self._loads[key]

    def open_already(self, id: str, reading: Reading) -> Recording | None:
        """The recording of a file, if it is open and the file is as it was when it was read."""
        if id.startswith(("live:", DRAWN)):
            return None
        try:
            key = self._key(id, reading)
        except (ValueError, OSError):
            return None
        with self._lock:
            return self._open.get(key)

    def _key(self, id: str, reading: Reading) -> _Key:
        """Of the file as it is now; of what was read of it last, if it is gone."""
        path = self.path(id)
        try:
            status = path.stat()
        except FileNotFoundError:
            with self._lock:
                known = [key for key in self._open if (key.path, key.reading) == (path, reading)]
            if known:
                return known[-1]
            raise ValueError(f"{shown(path.name)} is no longer in {shown(path.parent)}") from None
        except OSError as error:
            raise ValueError(f"{shown(path.name)} cannot be read: {error.strerror}") from None
        return _Key(path, reading, status.st_mtime_ns, status.st_size)

    def _finish(self, key: _Key, load: _Load) -> None:
        with self._lock:
            if self._loads.get(key) is load:
                del self._loads[key]
            if load.recording is None:
                return
            self._open[key] = load.recording
            while len(self._open) > 1 and (len(self._open) > MOST_OPEN or self._bytes() > MOST_BYTES):
                self._open.popitem(last=False)

    def _bytes(self) -> int:
        arrays = ((open.ranges, open.bearings, open.wall) for open in self._open.values())
        return sum(array.nbytes for group in arrays for array in group if array is not None)


@lru_cache(maxsize=16)
def _drawn(text: str) -> Recording:
    return Drawing.parse(text).recording()


def _wait(
    load: _Load, progress: Progress | None, wanted: Callable[[], bool], so_far: Callable[[Recording], None] | None
) -> Recording:
    told = shown = None
    while not load.done.wait(POLL):
        if not wanted():
            raise Cancelled
        if so_far is not None and load.part is not shown and load.part is not None:
            shown = load.part
            so_far(shown)
        if progress is not None and load.progress != told:
            told = load.progress
            progress(*told)
    if load.error is not None:
        raise load.error
    assert load.recording is not None
    return load.recording


def _samples() -> dict[str, Path]:
    """Ids of the samples and lessons: hallway and laboratory first, then the same worlds in other formats."""
    try:
        folder = data_folder("sample_scans")
    except FileNotFoundError:
        return {}
    samples = sorted(
        (path for path in folder.iterdir() if path.is_file() and path.suffix not in (".py", ".md", ".json")),
        key=lambda path: (path.suffix != ".npz", path.name),
    )
    lessons = sorted((folder / "lessons").glob("*.npz"))
    plain = [path for path in samples if path.suffix == ".npz"]
    ids = {f"sample:{path.stem if path in plain else path.name}": path for path in samples}
    return ids | {f"lesson:{path.stem}": path for path in lessons}


def _title(path: Path) -> str:
    """hallway.npz → Hallway (simulated), hallway.log → Hallway (log), 4_lost_end.npz → 4 lost end."""
    number, _, rest = path.stem.partition("_")
    if number.isdigit():
        return f"{number} {rest.replace('_', ' ')}"
    kind = "simulated" if path.suffix == ".npz" else path.suffix.lstrip(".")
    return f"{_sentence_case(path.stem)} ({kind})"


def _sentence_case(name: str) -> str:
    words = name.replace("_", " ").replace("-", " ")
    return words[:1].upper() + words[1:]


def _absolute(path: Path) -> Path:
    return Path(path).expanduser().absolute()


def _digest(path: Path) -> str:
    """An id that hides the user's folders and survives a restart, so that links keep working."""
    return hashlib.sha256(os.fsencode(path)).hexdigest()[:12]
