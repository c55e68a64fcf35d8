"""All live sources by id."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator, Sequence

from lineseg import Thresholds
from lineseg.readers import Cancelled

from .address import Address
from .ring import LiveRecording, Ring
from .robot import Robot
from .source import Source

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
MOST_PUSHED = 16
POLL = 0.2


class TooManySourcesError(ValueError):
    """More names than the server takes scans for."""


class Live:
    """All live sources by id: the robots of the command line, and what is pushed, each kept to `most` scans."""

    def __init__(self, robots: Sequence[Address] = (), most: int = 3000) -> None:
        self._most = most
        self._listeners: list[Callable[[], None]] = []
        self._lock = threading.Lock()
        self._robots = {
            address.id: Robot(address.id, address.url, Ring(most), self._arrived, address.topic) for address in robots
        }
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
        """Call `listener`, in the thread of the source, for each scan that arrives; the result ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def start(self) -> None:
        for robot in self._robots.values():
            robot.start()

    def close(self) -> None:
        for robot in self._robots.values():
            robot.close()

    def pushed(self, name: str) -> Source:
        """The source behind a name that a program pushes to; a new name is a new source."""
        if not NAME.fullmatch(name):
            raise ValueError(f"{name[:80]!r} is no name: letters, digits, _ . and - are allowed, 64 at most")
        id = f"live:{name}"
        with self._lock:
            if id not in self._pushed:
                if len(self._pushed) >= MOST_PUSHED:
                    raise TooManySourcesError(f"scans are pushed under {MOST_PUSHED} names, the most this server takes")
                self._pushed[id] = Source(id, name, Ring(self._most), self._arrived)
            return self._pushed[id]

    def recording(self, id: str, waiting: Callable[[], None], wanted: Callable[[], bool]) -> LiveRecording:
        """What a source has sent so far; before its first scan it waits, calling `waiting` again and again."""
        source = self.get(id)
        if source is None:
            raise ValueError(f"there is no live source {id!r}; nothing was pushed under this name, or it was restarted")
        while not source.first_scan.wait(POLL):
            if not wanted():
                raise Cancelled
            waiting()
        return source.ring.snapshot()

    def follow(self, owner: str, id: str, method: str, params: Thresholds) -> None:
        """A tab shows this; where it publishes its segments, these thresholds hold from now on."""
        source = self.get(id)
        if source is not None:
            source.follow(owner, method, params)

    def leave(self, owner: str) -> None:
        """A tab is gone: what it published is published no more."""
        for source in self:
            source.publish(owner, None)

    def _arrived(self) -> None:
        for listener in list(self._listeners):
            listener()
