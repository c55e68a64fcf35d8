"""Merges the lines of all frames into a map in its own thread, while the layer of the map is shown."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import NamedTuple

from lineseg import Recording, Survey
from lineseg.line_map import LineMap, line_map
from lineseg.readers import Cancelled

from ..newest import Newest
from ..view import View

log = logging.getLogger(__name__)


class Surveyed(NamedTuple):
    """The lines of all frames of a recording."""

    recording: Recording
    lines: Survey


class MapWork:
    """The map of the newest survey. tell: called in its thread when a map is made, or cannot be."""

    def __init__(self, name: str, tell: Callable[[], None]) -> None:
        self._tell = tell
        self._wanted: Surveyed | None = None
        self._made: tuple[Surveyed, LineMap | str] | None = None
        self._work = Newest(name, self._make, behind=True)

    def want(self, wanted: Surveyed | None) -> None:
        """Make the map of this survey, unless there is one; None stops the work."""
        if wanted is self._wanted:
            return
        self._wanted = wanted
        if wanted is not None and (self._made is None or self._made[0] is not wanted):
            self._work.put(wanted)

    def of(self, recording: Recording) -> LineMap | str | None:
        """The last map of a recording, which stays while a new one is made, or why there is none; None before it."""
        made = self._made
        return made[1] if made is not None and made[0].recording is recording else None

    def close(self) -> None:
        self._wanted = None
        self._work.close()

    def _make(self, subject: Surveyed) -> None:
        def wanted(done: int, total: int) -> None:
            if self._wanted is not subject:
                raise Cancelled

        try:
            wanted(0, 0)
            self._made = subject, line_map(subject.recording, found=subject.lines, progress=wanted)
        except Cancelled:
            return
        except ValueError as error:
            self._made = subject, str(error)
        except Exception:
            log.exception("mapping %s failed", subject.recording.name)
            self._made = subject, "the map could not be made"
        self._tell()


def shows_map(view: View) -> bool:
    """Whether the scene shows the line map."""
    return view.space == "world" and view.layers.line_map and view.mode != "learn"
