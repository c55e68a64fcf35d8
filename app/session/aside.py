"""What is made of a recording in a thread of its own while the screen shows it, such as the map of its lines."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeVar

from lineseg import Recording, Survey
from lineseg.readers import Cancelled, Progress

from ..newest import Newest
from ..view import View

if TYPE_CHECKING:
    from lineseg.line_map import LineMap

log = logging.getLogger(__name__)
# Shortest time between two pictures that show the progress [s].
TELL_EVERY = 0.3


class Subject(Protocol):
    """Of what something is made."""

    @property
    def recording(self) -> Recording: ...


S = TypeVar("S", bound=Subject)
R = TypeVar("R")


class Aside(Generic[S, R]):
    """What is made of the newest subject.

    make: makes it in the thread, and may raise ValueError or OSError. tell: called in the thread when it is made, when
    it cannot be, and now and then before. failed: what is told of a mistake of ours.
    """

    def __init__(self, name: str, make: Callable[[S, Progress], R], tell: Callable[[], None], failed: str) -> None:
        self._make_of, self._tell, self._failed = make, tell, failed
        self._wanted: S | None = None
        self._made: tuple[S, R | str] | None = None
        self._percent = 0
        self._work = Newest(name, self._make, behind=True)

    def want(self, wanted: S | None) -> None:
        """Make it of this subject, unless it is there; None stops the work."""
        if wanted is self._wanted:
            return
        self._wanted = wanted
        if wanted is not None and (self._made is None or self._made[0] is not wanted):
            self._percent = 0
            self._work.put(wanted)

    def of(self, recording: Recording) -> R | str | None:
        """The last that was made of a recording, which stays while a new one is made, or why there is none.

        None before it. What was made of another recording is forgotten.
        """
        made = self._made
        if made is not None and made[0].recording is not recording:
            made = self._made = None
        return None if made is None else made[1]

    def made_of(self, subject: S) -> R | str | None:
        """What was made of this very subject, or why there is none; None before it."""
        made = self._made
        return made[1] if made is not None and made[0] is subject else None

    @property
    def percent(self) -> int:
        """How much of the present work is done."""
        return self._percent

    def close(self) -> None:
        self._wanted = None
        self._work.close()

    def _make(self, subject: S) -> None:
        told = time.monotonic()

        def progress(done: int, total: int) -> None:
            nonlocal told
            if self._wanted is not subject:
                raise Cancelled
            percent = 100 * done // max(total, 1)
            if percent != self._percent:
                self._percent = percent
                if time.monotonic() > told + TELL_EVERY:
                    told = time.monotonic()
                    self._tell()

        try:
            progress(0, 0)
            self._made = subject, self._make_of(subject, progress)
        except Cancelled:
            return
        except (ValueError, OSError) as error:
            self._made = subject, str(error)
        except Exception:
            log.exception("work on %s failed", subject.recording.name)
            self._made = subject, self._failed
        self._tell()


class FoundLines(NamedTuple):
    """The lines of all frames of a recording."""

    recording: Recording
    lines: Survey


def map_work(name: str, tell: Callable[[], None]) -> Aside[FoundLines, LineMap]:
    """Merges the lines of all frames into a map."""
    return Aside(name, _map_of, tell, "the map could not be made")


def _map_of(subject: FoundLines, progress: Progress) -> LineMap:
    from lineseg.line_map import line_map  # takes a while to import, and few look at a map

    return line_map(subject.recording, found=subject.lines, progress=progress)


def shows_map(view: View) -> bool:
    """Whether the scene shows the line map."""
    return view.space == "world" and view.layers.line_map and view.mode != "learn"
