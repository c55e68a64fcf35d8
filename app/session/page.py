"""The page of a tab, and what it knows already."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from pydantic import BaseModel

from lineseg import Recording

from ..frame.findings import Findings
from ..frame.stepping import columns_of
from ..live.ring import LiveRecording
from ..told.drawn import DrawnState
from ..told.messages import Drawn, Traced
from .following import Presence
from .shown import Painted


@dataclass(frozen=True)
class Page:
    """What a session needs of its page.

    send: for its threads; returns when the page has taken the message, so a slow page slows its own session only.
    tell: the same for the event loop. hang_up: called when the session ends.
    """

    send: Callable[[BaseModel], None]
    tell: Callable[[BaseModel], Awaitable[None]]
    hang_up: Callable[[], None]


async def _unheard(message: BaseModel) -> None:
    """No page is there."""


NOBODY = Page(lambda message: None, _unheard, lambda: None)


class Told:
    """What a page knows already: times, trace and marks are long, and are sent only when they are others."""

    def __init__(self) -> None:
        self._marks: Findings | None = None
        self._trace: Findings | None = None
        self._times: Recording | None = None

    def forget(self) -> None:
        """Another page is to be told everything."""
        self._marks = self._trace = self._times = None

    def news(self, painted: Painted, following: Presence | None) -> list[BaseModel]:
        """What the page does not know yet, the picture last."""
        request, content, recording = painted.request, painted.content, painted.recording
        found = content.found
        messages: list[BaseModel] = []
        # The times of a recording that grows are sent once it is paused, or read to its end.
        growing = recording.partial or (isinstance(recording, LiveRecording) and request.view.live)
        if self._times is not recording and not growing:
            self._times = recording
            messages.append(content.times())
        if content.view.mode == "learn" and self._trace is not found:
            self._trace = found
            messages.append(Traced(trace=columns_of(found)))
        state: DrawnState = {**content.state, **painted.timings, "following": following}
        if self._marks is not found:
            self._marks = found
            state["marks"] = found.marks
        return [*messages, Drawn(rev=request.rev, origin=request.origin, state=state)]
