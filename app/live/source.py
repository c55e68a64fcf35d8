"""Where live scans come from, and how that goes."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lineseg import Thresholds
from lineseg.readers.laser_scan import LaserScan

from ..told.messages import Connection, LiveStatus
from .ring import Ring

WINDOW = 3.0
SILENT = 2.0
# Beyond this the two clocks have nothing to do with each other (a simulation, a replayed bag).
FOREIGN_CLOCK = 3600.0


@dataclass(frozen=True)
class Publishing:
    """Segments go back to the robot: whose thresholds, and under which topic."""

    owner: str
    topic: str
    method: str
    params: Thresholds


class Source:
    """A ring, and how it is filled. `arrived` is called for each scan, in the thread that brought it."""

    def __init__(self, id: str, label: str, ring: Ring, arrived: Callable[[], None]) -> None:
        self.id, self.label, self.ring = id, label, ring
        self.first_scan = threading.Event()
        self.publishing: Publishing | None = None
        self.published = 0
        self.publish_trouble = ""
        self._arrived = arrived
        self._times: deque[float] = deque(maxlen=512)
        self._delay: float | None = None
        self._refused = 0
        self._connection: Connection = "open"
        self._message = ""

    def take(self, scan: LaserScan) -> None:
        """A scan has arrived; one that cannot be kept is a ValueError."""
        if not len(scan.ranges):
            raise ValueError("a scan without ranges")
        self.ring.add(scan)
        self._times.append(time.monotonic())
        delay = time.time() - scan.stamp
        self._delay = delay if abs(delay) < FOREIGN_CLOCK else None
        self.first_scan.set()
        self._arrived()

    def refuse(self, why: str) -> None:
        """A message that is no scan: it is counted, and the last reason is shown."""
        self._refused += 1
        self._message = why

    def say(self, connection: Connection, message: str) -> None:
        self._connection, self._message = connection, message

    def publish(self, owner: str, publishing: Publishing | None) -> None:
        """Publish segments for a tab, or no longer; only who publishes can end it."""
        if publishing is not None:
            raise ValueError(f"{self.label} takes no messages: its scans are pushed to this server")

    def follow(self, owner: str, method: str, params: Thresholds) -> None:
        """The tab that publishes has other thresholds now."""
        now = self.publishing
        if now is not None and now.owner == owner and (now.method, now.params) != (method, params):
            self.publishing = Publishing(owner, now.topic, method, params)

    @property
    def note(self) -> str:
        """Why there is no scan yet."""
        return self._message or f"{self.label}: waiting for the first scan"

    def rate(self) -> float:
        """Scans a second of late; 0 where none came lately."""
        now = time.monotonic()
        late = [moment for moment in list(self._times) if now - moment < WINDOW]
        if len(late) < 2 or now - late[-1] > SILENT:
            return 0.0
        return (len(late) - 1) / max(late[-1] - late[0], 1e-6)

    def status(self, session: str) -> LiveStatus:
        """How it fares, for one tab: the ids of other tabs are not told."""
        publishing = self.publishing
        return LiveStatus(
            recording=self.id,
            connection=self._connection,
            message=self._message,
            rate=float(np.round(self.rate(), 1)),
            delay=None if self._delay is None else round(self._delay, 3),
            total=self.ring.total,
            dropped=self.ring.dropped,
            refused=self._refused,
            most=self.ring.most,
            publishable=self.publishable,
            publisher="" if publishing is None else "this" if publishing.owner == session else "another",
            publishTopic="" if publishing is None else publishing.topic,
            published=self.published,
            publishTrouble=self.publish_trouble,
        )

    @property
    def publishable(self) -> bool:
        return False
