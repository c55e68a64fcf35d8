"""All live sources by id."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator, Sequence

from lineseg import Thresholds
from lineseg.readers import Cancelled

from ..bridges.address import Address
from .ring import LiveRecording, Ring
from .robot import Robot
from .source import Source

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
MOST_PUSHED = 16
POLL = 0.2


class TooManySourcesError(ValueError):
    """Scans are pushed under more names than the server accepts."""


class Live:
    """All live sources by id: robots of the command line and pushed sources; each keeps up to `most` scans."""

    def __init__(self, robots: Sequence[Address] = (), most: int = 3000) -> None:
        self._most = most
        self._listeners: list[Callable[[], None]] = []
        self._lock = threading.Lock()
        self._robots = {address.id: Robot(address, Ring(most), self._arrived) for address in robots}
        self._pushed: dict[str, Source] = {}

    def __iter__(self) -> Iterator[Source]:
        return iter([*self._robots.values(), *self._pushed.values()])

    @property
    def robots(self) -> list[str]:
        """The ids of the robots of the command line."""
        return list(self._robots)

    def get(self, id: str) -> Source | None:
        return self._robots.get(id) or self._pushed.get(id)

    def on_scan(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call `listener` in the thread of the source for each new scan. Returns a function that unsubscribes."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def start(self) -> None:
        for robot in self._robots.values():
            robot.start()

    def close(self) -> None:
        for robot in self._robots.values():
            robot.leave()
        for robot in self._robots.values():
            robot.close()

    def pushed(self, name: str) -> Source:
        """The source for a name that a program pushes to; a new name makes a new source."""
        if not NAME.fullmatch(name):
            raise ValueError(f"{name[:80]!r} is not a valid name; use up to 64 letters, digits, _ . and -")
        id = f"live:{name}"
        with self._lock:
            if id not in self._pushed:
                if len(self._pushed) >= MOST_PUSHED:
                    raise TooManySourcesError(f"scans are pushed under {MOST_PUSHED} names already; use one of them")
                self._pushed[id] = Source(id, name, Ring(self._most), self._arrived)
            return self._pushed[id]

    def recording(self, id: str, waiting: Callable[[], None], wanted: Callable[[], bool]) -> LiveRecording:
        """The scans that a source has sent so far. Waits for the first one, calling `waiting` repeatedly."""
        source = self.get(id)
        if source is None:
            raise ValueError(f"there is no live source {id!r}; push a scan under this name first")
        while not source.first_scan.wait(POLL):
            if not wanted():
                raise Cancelled
            waiting()
        return source.ring.snapshot()

    def follow(self, owner: str, id: str, method: str, params: Thresholds) -> None:
        """Note what a tab shows; if the tab publishes its segments, these thresholds apply from now on."""
        source = self.get(id)
        if source is not None:
            source.follow(owner, method, params)

    def leave(self, owner: str) -> None:
        """A tab is gone; stop publishing its segments."""
        for source in self:
            source.publish(owner, None)

    def _arrived(self) -> None:
        for listener in list(self._listeners):
            listener()
