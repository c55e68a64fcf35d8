"""What a tab asks for, what was drawn of it, and what is on its screen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from lineseg import Recording

from ..frame.findings import Findings
from ..live.ring import LiveRecording
from ..scene.picture import Picture
from ..told.drawn import Timings
from ..view import View
from .composing import Content

Origin = Literal["page", "scene"]
Watch = Callable[[View, Recording, str, Findings], None]


@dataclass(frozen=True)
class Request:
    """A View to draw; `number` counts the requests of a session."""

    number: int
    view: View
    rev: int
    origin: Origin


@dataclass(frozen=True, eq=False)
class Painted:
    """A request with its picture, which viser has."""

    request: Request
    recording: Recording
    content: Content
    timings: Timings


@dataclass(frozen=True, eq=False)
class Shown:
    """What is on the screen."""

    view: View
    recording: Recording
    found: Findings
    picture: Picture

    @property
    def position(self) -> int:
        """Of the frame in the recording, from which some frames of the file may be left out."""
        return self.recording.position(self.view.frame)

    def paused(self, view: View) -> bool:
        """Whether it shows a live recording that `view` does not follow."""
        return isinstance(self.recording, LiveRecording) and self.view.recording == view.recording and not view.live
