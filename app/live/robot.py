"""A robot that is watched; reconnects whenever the connection is lost."""

from __future__ import annotations

import logging
import os
import random
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import AbstractContextManager

from websockets.exceptions import WebSocketException

from lineseg import EXTRACTORS
from lineseg.readers.laser_scan import LaserScan

from ..bridges.address import Address, domain_of
from ..bridges.bridge import Bridge, why_not
from ..bridges.cloud import Cloud
from ..bridges.markers import Markers
from ..bridges.websocket import open_websocket
from ..stopping import abandon
from .ring import Ring
from .source import Published, Publishing, Source, Spent

log = logging.getLogger(__name__)
FIRST_PAUSE, LONGEST_PAUSE = 0.5, 15.0
MOST_SPENT = 10_000
# DDS waits up to two seconds until the last messages are confirmed; Zenoh up to ten, for a router that hangs.
LEAVE_SECONDS = 3.0


class Robot(Source):
    """Receives scans in its own thread."""

    def __init__(self, address: Address, ring: Ring, arrived: Callable[[], None]) -> None:
        self._address = address
        self._place = address.place
        super().__init__(address.id, f"{self._place} {address.topic or ''}".strip(), ring, arrived)
        self.ring.topic = address.topic or ""
        self._bridge: Bridge | None = None
        self._pause = FIRST_PAUSE
        self._unexpected = ""
        # Of the scans that were published, the newest last.
        self.spent: deque[Spent] = deque(maxlen=MOST_SPENT)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"robot {self._place}", daemon=True)
        self.say("connecting", f"connecting to {self._place}")

    def start(self) -> None:
        self._thread.start()

    def leave(self) -> None:
        """Begin to disconnect."""
        self._closing.set()
        bridge = self._bridge
        if bridge is not None:
            bridge.close()

    def close(self) -> None:
        """Disconnect; blocks until the thread has ended, or for a while: a robot may not answer any more."""
        self.leave()
        if self._thread.is_alive():
            self._thread.join(LEAVE_SECONDS)
        if self._thread.is_alive():
            abandon(self._thread)

    @property
    def publishable(self) -> bool:
        return True

    def publish(self, owner: str, publishing: Publishing | None) -> None:
        now = self.publishing
        if now is not None and now.owner != owner:
            if publishing is not None:
                raise ValueError(f"another tab already publishes its segments to {self._place}; stop it there first")
            return
        self.publish_trouble = ""
        self.publishing = publishing

    # --- the thread ---------------------------------------------------------------------------------------------------

    def _run(self) -> None:
        while not self._closing.is_set():
            why = self._converse()
            if self._closing.is_set():
                return
            pause = self._pause * random.uniform(0.8, 1.2)
            self._pause = min(2 * self._pause, LONGEST_PAUSE)
            self.say("lost", f"{why}; trying again in {pause:.1f} s")
            self._closing.wait(pause)

    def _converse(self) -> str:
        """Connect and receive scans until the connection ends; returns the reason."""
        try:
            with self._open() as bridge:
                self._bridge = bridge
                if self._closing.is_set():
                    return ""
                self._announce(bridge)
                self.say("open", f"connected to {self._place} by {bridge.name}; waiting for scans")
                bridge.scans(self._address.topic, self)
        except (OSError, WebSocketException, ValueError) as error:
            return why_not(self._place, error)
        except Exception as error:
            why = f"{self._place} sent a message that cannot be understood ({type(error).__name__}: {error})"
            if why != self._unexpected:
                log.exception("%s", why)
            self._unexpected = why
            return why
        finally:
            self._bridge = None
        return f"{self._place} closed the connection"

    def _open(self) -> AbstractContextManager[Bridge]:
        if self._address.scheme == "ros2":
            from ..bridges.dds import open_dds

            return open_dds(self._address.domain)
        if self._address.scheme == "zenoh":
            from ..bridges.zenoh_bridge import open_zenoh

            return open_zenoh(self._address.router, domain_of(os.environ))
        return open_websocket(self._address.url)

    def topic_is(self, topic: str) -> None:
        self.ring.topic = topic
        self.label = f"{self._place} {topic}"

    def waits(self, why: str) -> None:
        self.say("open", why)

    def misses(self, why: str) -> None:
        self.say("lost", why)

    def loses(self, scans: int) -> None:
        self.lost += scans

    def hand(self, decode: Callable[[], LaserScan], arrived: float, newest: bool = True) -> None:
        """Add one scan. A message that is not a scan is reported, and receiving continues."""
        if self._closing.is_set():
            return
        try:
            scan = decode()
            self.take(scan)
        except Exception as error:
            self.refuse(f"a message of {self.ring.topic} is not a scan: {error}")
            return
        self._pause = FIRST_PAUSE
        if self._message or self._connection != "open":
            self.say("open", "")
        if newest:
            self._publish(scan, arrived)
        elif self.publishing is not None:
            self.left_out += 1

    def _announce(self, bridge: Bridge) -> None:
        to = self.publishing
        if to is not None:
            bridge.announce(to.topic, Markers)
            if to.cloud:
                bridge.announce(to.cloud, Cloud)

    def _publish(self, received: LaserScan, arrived: float) -> None:
        to, bridge = self.publishing, self._bridge
        if to is None or bridge is None:
            return
        scan = received.beams()
        began = time.perf_counter()
        extraction = EXTRACTORS[to.method].extract(scan, to.params)
        elapsed = time.perf_counter() - began
        try:
            bridge.publish(to.topic, Markers(extraction, received))
            if to.cloud:
                bridge.publish(to.cloud, Cloud(extraction, received, scan, to.noise))
        except ValueError as error:
            self.publishing, self.publish_trouble = None, str(error)
            return
        self.published += 1
        self.last_published = Published(scan, extraction, elapsed)
        self.spent.append(Spent(self.delay, time.perf_counter() - arrived))
