"""A robot on a WebSocket; reconnects whenever the connection is lost."""

from __future__ import annotations

import logging
import random
import threading
from collections.abc import Callable
from urllib.parse import urlsplit

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from lineseg import EXTRACTORS, Scan
from lineseg.readers.laser_scan import LaserScan

from .bridge import LARGEST_MESSAGE, OPEN_SECONDS, Bridge, why_not
from .foxglove import SUBPROTOCOLS, Foxglove
from .ring import Ring
from .rosbridge import RosBridge
from .source import Publishing, Source

log = logging.getLogger(__name__)
FIRST_PAUSE, LONGEST_PAUSE = 0.5, 15.0


class Robot(Source):
    """Receives scans in its own thread. The robot decides the protocol: a Foxglove server accepts its subprotocol."""

    def __init__(self, id: str, url: str, ring: Ring, arrived: Callable[[], None], topic: str | None = None) -> None:
        self._url, self._topic = url, topic
        self._place = urlsplit(url).netloc
        super().__init__(id, f"{self._place} {topic or ''}".strip(), ring, arrived)
        self.ring.topic = topic or ""
        self._bridge: Bridge | None = None
        self._socket: Connection | None = None
        self._pause = FIRST_PAUSE
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"robot {self._place}", daemon=True)
        self.say("connecting", f"connecting to {self._place}")

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        """Disconnect; blocks until the thread has ended."""
        self._closing.set()
        socket = self._socket
        if socket is not None:
            socket.close()
        if self._thread.is_alive():
            self._thread.join(timeout=OPEN_SECONDS + 1)

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
            with connect(
                self._url,
                subprotocols=SUBPROTOCOLS,
                open_timeout=OPEN_SECONDS,
                max_size=LARGEST_MESSAGE,
                proxy=None,
            ) as socket:
                self._socket = socket
                named = (socket.subprotocol or "").startswith("foxglove.")
                self._bridge = Foxglove(socket) if named else RosBridge(socket)
                self.say("open", f"connected to {self._place} by {self._bridge.name}; waiting for scans")
                self._bridge.scans(self._topic, self)
        except (OSError, WebSocketException, ValueError) as error:
            return why_not(self._place, error)
        except Exception as error:
            log.exception("%s sent a message that cannot be understood", self._place)
            return f"{self._place} sent a message that cannot be understood ({type(error).__name__}: {error})"
        finally:
            self._socket = self._bridge = None
        return f"{self._place} closed the connection"

    def topic_is(self, topic: str) -> None:
        self.ring.topic = topic
        self.label = f"{self._place} {topic}"

    def waits(self, why: str) -> None:
        self.say("open", why)

    def hand(self, decode: Callable[[], LaserScan]) -> None:
        """Add one scan. A message that is not a scan is reported, and receiving continues."""
        try:
            scan = decode()
            self.take(scan)
        except Exception as error:
            self.refuse(f"a message of {self.ring.topic} is not a scan: {error}")
            return
        self._pause = FIRST_PAUSE
        if self._message or self._connection != "open":
            self.say("open", "")
        self._publish(scan)

    def _publish(self, received: LaserScan) -> None:
        to, bridge = self.publishing, self._bridge
        if to is None or bridge is None:
            return
        scan = Scan.regular(
            received.ranges,
            received.angle_min,
            received.angle_increment,
            range_min=received.range_min,
            range_max=received.range_max,
        )
        try:
            bridge.publish(to.topic, EXTRACTORS[to.method].extract(scan, to.params), received)
            self.published += 1
        except ValueError as error:
            self.publishing, self.publish_trouble = None, str(error)
