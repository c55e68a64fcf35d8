"""What is made aside of the recording of a tab, for its scene: the line map, and the scans of the other lasers."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from lineseg import Recording, Survey
from lineseg.knobs import Thresholds

from ..scene.beside import OtherLaser
from ..shelf.library import Library
from ..view import View
from .aside import FoundLines, map_work, shows_map
from .composing import Around
from .other_lasers import Robot, lasers_work, others_in, shows_lasers
from .shown import Shown

if TYPE_CHECKING:
    from lineseg.line_map import LineMap


class Surroundings:
    """name: for the threads. more: called in one of them when there is more to draw."""

    def __init__(self, name: str, library: Library, more: Callable[[], None]) -> None:
        self._library = library
        # The lines of all frames, as far as they were found last.
        self._lines: FoundLines | None = None
        self._map = map_work(f"map {name}", more)
        # The recording on the screen, where its other lasers are asked for.
        self._robot: Robot | None = None
        self._lasers = lasers_work(f"lasers {name}", more)

    def surveyed(self, recording: Recording, survey: Survey) -> None:
        """Note the lines of all frames."""
        self._lines = FoundLines(recording, survey)

    def want(self, view: View, shown: Shown) -> None:
        """Have made of the recording on the screen what the View shows; stop other work."""
        lines, recording = self._lines, shown.recording
        self._map.want(lines if lines is not None and lines.recording is recording and shows_map(view) else None)
        if not shows_lasers(view, recording):
            self._robot = None
        elif self._robot is None or self._robot.recording is not recording:
            self._robot = Robot(recording, partial(self._library.path, shown.view.recording), shown.view.reading)
        self._lasers.want(self._robot)

    def around(self, view: View, recording: Recording) -> Around:
        """What there is to draw of a View."""
        known, mapped, lasers = self._lines, self._map.of(recording), self._lasers.of(recording)
        lines = known.lines if known is not None and known.recording is recording else None
        if not shows_map(view):
            mapped = None
        if not shows_lasers(view, recording):
            lasers = ()
        elif not isinstance(lasers, tuple):
            lasers = tuple(OtherLaser(topic, why=lasers) for topic in others_in(recording))
        return Around(lines, mapped, self._map.percent, lasers)

    def line_map(self, recording: Recording) -> LineMap | None:
        """The map that was made last of a recording."""
        found = self._map.of(recording)
        return None if isinstance(found, str) else found

    def known(self, recording: Recording, params: Thresholds) -> tuple[Survey | None, LineMap | None]:
        """The lines of all frames with these thresholds, and their map, where they are there already."""
        lines = self._lines
        if lines is None or lines.recording is not recording or lines.lines.params != params:
            return None, None
        found = self._map.made_of(lines)
        return lines.lines, None if isinstance(found, str) else found

    def close(self) -> None:
        self._map.close()
        self._lasers.close()
