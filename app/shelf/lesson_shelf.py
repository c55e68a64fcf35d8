"""The lessons that pages can open: those of the program, of a folder, and those that were dropped on a page."""

from __future__ import annotations

import logging
import threading
from collections.abc import AsyncIterator
from functools import partial
from pathlib import Path

from lineseg.scan import Recording
from lineseg.tracing.glossary import TERMS

from ..told.answers import ExplainedTerm
from .lesson import Lessons, Looked, NamedLesson
from .lesson_markup import picture_file
from .lessons import Home, lesson_files, read_lesson, recording_of
from .scratch import Scratch
from .uploads import Uploads

# For what is dropped on all pages together [bytes].
LARGEST_DROPPED, MOST_DROPPED, ALL_DROPPED = 50_000_000, 40, 400_000_000
# No dropped file has this name.
INSIDE = ".scans"
Stamp = tuple[tuple[int, int], ...]

log = logging.getLogger(__name__)


class LessonShelf:
    """Safe to use from any thread. folder: of one's own lessons, read again when a file in it has changed.

    What is wrong with one of its files is logged where the server was started, once: whoever opens the page need not
    know. What is wrong with a dropped file is told to whoever dropped it.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._scratch = Scratch()
        self._paths: dict[str, Path] = {}
        self._dropped = Uploads(LARGEST_DROPPED, MOST_DROPPED, ALL_DROPPED)
        self._homes: dict[str, Home] = {}
        self._known: dict[Path, tuple[Stamp, NamedLesson | None]] = {}
        self._lock = threading.RLock()

    def told(self) -> Lessons:
        """The lessons of the program and of the folder."""
        files = [*lesson_files(), *sorted(self._folder.glob("*.json") if self._folder else ())]
        lessons = [lesson for file in files if (lesson := self._lesson(file)) is not None]
        return Lessons(lessons=lessons, terms=[ExplainedTerm(**term._asdict()) for term in TERMS])

    def find(self, id: str) -> NamedLesson | None:
        """A lesson, also one that was dropped."""
        # Looked up, not made from the id, which comes from a link.
        file = next((file for file in self._files(id) if self._id_of(file) == id), None)
        return self._lesson(file) if file is not None else None

    def looked_at(self, id: str, page: int) -> tuple[str, Looked] | None:
        """The recording of a lesson, and what one of its pages looks at; the task comes after the steps."""
        lesson = self.find(id)
        if lesson is None:
            return None
        return lesson.recording, lesson.steps[page] if page < len(lesson.steps) else lesson.task

    def recording(self, id: str) -> Path:
        """The file of a recording that only lessons have. Raises KeyError if there is none."""
        return self._paths[id]

    def title_of(self, recording: str) -> str:
        """The title of a lesson with this recording; "" if there is none."""
        with self._lock:
            every = [lesson for _, lesson in self._known.values() if lesson is not None]
        return next((lesson.title for lesson in every if lesson.recording == recording), "")

    def scans_of(self, lesson: NamedLesson) -> Recording:
        """The recording of a lesson. Raises ValueError or OSError if it is gone."""
        return recording_of(lesson, Home(paths=self._paths).place_of(lesson)[1])

    def picture(self, id: str, name: str) -> Path:
        """A picture beside a lesson. Raises ValueError if there is none."""
        if self.find(id) is None:
            raise ValueError(f"there is no lesson {id[:60]!r}")
        kind, _, _ = id.partition("/")
        return picture_file(self._homes[kind].folder if kind in self._homes else self._folder, name)

    async def receive(self, name: str, size: int | None, chunks: AsyncIterator[bytes], into: str) -> str:
        """Keep a dropped file, and return the id of its folder. into: the id of the folder that it belongs to."""
        return (await self._dropped.receive(name, size, chunks, "" if into else "lessons", into)).id

    def open_dropped(self, id: str) -> list[NamedLesson]:
        """The lessons in a folder of dropped files. Raises ValueError if there is none, or if one has a mistake."""
        try:
            folder = self._dropped[id].path
        except KeyError:
            raise ValueError("these files are no longer on the server; drop them again") from None
        home = self._home(folder, f"{id}/")
        try:
            lessons = [read_lesson(file, home) for file in sorted(folder.glob("*.json"))]
            if not lessons:
                raise ValueError("there is no lesson among these files; its name ends with .json")
        except ValueError:
            self._dropped.discard(id)
            raise
        with self._lock:
            kept = {known: each for known, each in self._homes.items() if each.folder and each.folder.is_dir()}
            self._homes = {**kept, id: home}
            self._forget_removed()
        return lessons

    def close(self) -> None:
        self._dropped.close()
        self._scratch.close()

    def _forget_removed(self) -> None:
        """Forget lessons and recordings of dropped files that newer ones have replaced."""
        self._known = {file: known for file, known in self._known.items() if file.is_file()}
        for id in [id for id, path in self._paths.items() if not path.is_file()]:
            del self._paths[id]

    def _files(self, id: str) -> list[Path]:
        """The files among which the lesson with this id is."""
        kind, inside, _ = id.partition("/")
        if inside:
            home = self._homes.get(kind)
            return sorted(home.folder.glob("*.json")) if home and home.folder else []
        return [*lesson_files(), *(self._folder.glob("*.json") if self._folder else ())]

    def _id_of(self, file: Path) -> str:
        return f"{self._home_of(file).prefix}{file.stem}"

    def _home_of(self, file: Path) -> Home:
        if self._folder and file.parent == self._folder:
            return self._home(self._folder)
        return next((home for home in self._homes.values() if home.folder == file.parent), Home())

    def _home(self, folder: Path, prefix: str = "") -> Home:
        return Home(folder, prefix, partial(self._scans_of, folder), self._paths)

    def _scans_of(self, folder: Path) -> Path:
        """Where scans of lessons in a folder are kept: inside of it if it was dropped, so that they go with it."""
        if folder == self._folder:
            return self._scratch.folder
        inside = folder / INSIDE
        inside.mkdir(exist_ok=True)
        return inside

    def _lesson(self, file: Path) -> NamedLesson | None:
        """The lesson in a file, read again if the file or its recording has changed; None if it has a mistake."""
        with self._lock:
            stamp, lesson = self._known.get(file, ((), None))
            if stamp and stamp == self._stamp(file, lesson):
                return lesson
            try:
                lesson = self._read(file)
            except ValueError as error:
                log.warning("%s", error)
                lesson = None
            self._known[file] = self._stamp(file, lesson), lesson
            return lesson

    def _read(self, file: Path) -> NamedLesson:
        if file.parent == self._folder and any(file.stem == other.stem for other in lesson_files()):
            raise ValueError(f"{file.name}: a lesson of the program has this name; rename the file")
        return read_lesson(file, self._home_of(file))

    def _stamp(self, file: Path, lesson: NamedLesson | None) -> Stamp:
        """Changes with the file and its recording; with any file beside it, if it has a mistake."""
        beside = [file]
        if lesson is None:
            beside += sorted(file.parent.iterdir()) if file.parent.is_dir() else []
        elif lesson.recording in self._paths:
            beside.append(self._paths[lesson.recording])
        return tuple(_stamp(path) for path in beside)


def _stamp(path: Path) -> tuple[int, int]:
    try:
        status = path.stat()
    except OSError:
        return 0, 0
    return status.st_mtime_ns, status.st_size
