"""Sources of live scans and their status."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from lineseg import Extraction, Scan, Thresholds
from lineseg.covariance import Noise
from lineseg.readers.laser_scan import LaserScan

from ..told.messages import Connection, LiveStatus
from .ring import Ring

WINDOW = 3.0
SILENT = 2.0
# Beyond this delay the two clocks are unrelated (a simulation, a replayed bag).
FOREIGN_CLOCK = 3600.0


@dataclass(frozen=True)
class Publishing:
    """Publishing of segments to the robot: with which thresholds, and to which topic.

    cloud: topic of the segments as a PointCloud2, "" for none; noise: of the laser, for their covariance.
    """

    owner: str
    topic: str
    method: str
    params: Thresholds
    cloud: str = ""
    noise: Noise | None = None


@dataclass(frozen=True)
class Published:
    """What was published last; elapsed: time that the extraction took [s]."""

    scan: Scan
    extraction: Extraction
    elapsed: float


class Spent(NamedTuple):
    """Times of one scan [s]. delay: from its stamp to its arrival, None if the clocks are unrelated; publishing: from
    its arrival to the end of publishing its segments.
    """

    delay: float | None
    publishing: float


class Source:
    """A ring of scans and its status. `arrived` is called for each scan, in the thread that received it."""

    def __init__(self, id: str, label: str, ring: Ring, arrived: Callable[[], None]) -> None:
        self.id, self.label, self.ring = id, label, ring
        self.first_scan = threading.Event()
        self.publishing: Publishing | None = None
        self.published = 0
        self.last_published: Published | None = None
        self.left_out = self.lost = 0
        self.publish_trouble = ""
        self._arrived = arrived
        self._times: deque[float] = deque(maxlen=512)
        self._delay: float | None = None
        self._refused = 0
        self.refusal = ""
        self._connection: Connection = "open"
        self._message = ""

    def take(self, scan: LaserScan) -> None:
        """Add a scan. Raises ValueError if it cannot be kept."""
        if not len(scan.ranges):
            raise ValueError("the scan has no ranges")
        self.ring.add(scan)
        self._times.append(time.monotonic())
        delay = time.time() - scan.stamp
        self._delay = delay if abs(delay) < FOREIGN_CLOCK else None
        self.first_scan.set()
        self._arrived()

    def refuse(self, why: str) -> None:
        """Count a message that is not a scan, and show the last reason."""
        self._refused += 1
        self.refusal = self._message = why

    def say(self, connection: Connection, message: str) -> None:
        self._connection, self._message = connection, message

    def publish(self, owner: str, publishing: Publishing | None) -> None:
        """Start or stop publishing segments for a tab; only the publishing tab can stop it."""
        if publishing is not None:
            raise ValueError(
                f"{self.label} accepts no messages, because its scans are pushed; publish to a robot instead"
            )

    def follow(self, owner: str, method: str, params: Thresholds) -> None:
        """Update the thresholds of the publishing tab."""
        now = self.publishing
        if now is not None and now.owner == owner and (now.method, now.params) != (method, params):
            self.publishing = replace(now, method=method, params=params)

    @property
    def message(self) -> str:
        """What is to be said of the connection; "" if nothing."""
        return self._message

    @property
    def refused(self) -> int:
        """Messages that were no scans."""
        return self._refused

    @property
    def delay(self) -> float | None:
        """From the stamp of the last scan to its arrival [s]; None if the clocks are unrelated."""
        return self._delay

    @property
    def note(self) -> str:
        """Why there is no scan yet."""
        return self._message or f"{self.label}: waiting for the first scan"

    @property
    def silence(self) -> float:
        """Time since the last scan [s]; 0 if there was none yet."""
        return time.monotonic() - self._times[-1] if self._times else 0.0

    def rate(self) -> float:
        """Recent scans per second; 0 if none came recently."""
        now = time.monotonic()
        late = [moment for moment in list(self._times) if now - moment < WINDOW]
        if len(late) < 2 or now - late[-1] > SILENT:
            return 0.0
        return (len(late) - 1) / max(late[-1] - late[0], 1e-6)

    def status(self, session: str, not_drawn: int) -> LiveStatus:
        """The status for one tab, without the ids of other tabs."""
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
            notDrawn=not_drawn,
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
