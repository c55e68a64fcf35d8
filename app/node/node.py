"""Extracts segments from the scans of a robot and publishes them, without a page."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable

import numpy as np

from lineseg import EXTRACTORS, Thresholds
from lineseg.covariance import Noise
from lineseg.readers.laser_scan import LaserScan

from ..bridges.address import Address
from ..bridges.cloud import Cloud
from ..bridges.markers import Markers
from ..live.ring import Ring
from ..live.robot import MOST_SPENT, Robot
from ..live.source import SILENT, Published, Publishing, Spent
from .latency import latency
from .running import Running

OWNER = "node"
LOOK_SECONDS = 0.05
REPORT_SECONDS = 1.0
# A single publication waits so long for those who want it.
ANNOUNCED_SECONDS = 0.5


class Node:
    """running: says method and thresholds before each scan; tell: is called with lines for the user.

    once: publish one scan only.
    """

    def __init__(
        self,
        address: Address,
        publishing: Publishing,
        running: Running,
        tell: Callable[[str], None],
        once: bool = False,
    ) -> None:
        self._publishing, self._running, self._tell, self._once = publishing, running, tell, once
        self._robot = Robot(address, Ring(1), self._before_each_scan)
        self._robot.publish(OWNER, publishing)
        self._stop = threading.Event()
        self._began = 0.0
        self._reported = self._refusal_told = 0.0
        self._said, self._silent, self._refused = "", False, 0
        self._spent: deque[Spent] = deque(maxlen=MOST_SPENT)

    def stop(self) -> None:
        self._stop.set()

    def run(self) -> Published | None:
        """Publish until `stop`, or once. Returns what was published last; None if nothing was.

        Raises ValueError if the robot does not accept the segments.
        """
        self._began = self._reported = time.monotonic()
        self._robot.start()
        try:
            while not self._stop.wait(LOOK_SECONDS):
                self._say_new()
                self._say_silence()
                self._report()
                if self._robot.publish_trouble:
                    raise ValueError(self._robot.publish_trouble)
                if self._once and self._robot.last_published:
                    break
        finally:
            self._robot.close()
            self._sum_up()
        return self._robot.last_published

    def _before_each_scan(self) -> None:
        """In the thread of the robot."""
        if self._once:
            early = time.monotonic() - self._began < ANNOUNCED_SECONDS
            self._robot.publish(OWNER, None if early or self._robot.published else self._publishing)
        self._robot.follow(OWNER, *self._running.newest())

    def _say_new(self) -> None:
        """Tell what the connection says, if it is new; at most once a second what is wrong with a scan."""
        words, refused, now = self._robot.message, self._robot.refused, time.monotonic()
        if refused > self._refused and now - self._refusal_told > REPORT_SECONDS:
            self._refused, self._refusal_told = refused, now
            self._tell(self._robot.refusal)
        if words and words == self._robot.refusal:
            return
        if words != self._said:
            self._said = words
            if words:
                self._tell(words)

    def _say_silence(self) -> None:
        """Tell it once. The connection may need much longer to find out: DDS waits for a lease of 10 s by default."""
        silent = self._robot.silence > SILENT
        if silent and not self._silent and not self._robot.message:
            self._tell(f"no scan for {SILENT:g} s; is its publisher still running?")
        self._silent = silent

    def _report(self) -> None:
        """A line a second while scans are published."""
        now, last = time.monotonic(), self._robot.last_published
        if self._once or last is None or now - self._reported < REPORT_SECONDS:
            return
        self._reported = now
        rate, spent = self._robot.rate(), self._newly_spent()
        if rate and spent:
            self._tell(
                f"{rate:.1f} Hz, {latency(spent)}, {len(last.extraction.segments)} segments in "
                f"{1e6 * last.elapsed:.0f} µs, {self._counts()}"
            )

    def _sum_up(self) -> None:
        self._newly_spent()
        if self._spent and not self._once:
            self._tell(f"ended after {self._counts()}; {latency(self._spent)}")

    def _newly_spent(self) -> list[Spent]:
        arrived = [self._robot.spent.popleft() for _ in range(len(self._robot.spent))]
        self._spent.extend(arrived)
        return arrived

    def _counts(self) -> str:
        counted = {"left out": self._robot.left_out, "lost": self._robot.lost, "refused": self._robot.refused}
        published = self._robot.published
        return f"{published} scan{'s' * (published != 1)}" + "".join(
            f", {n} {words}" for words, n in counted.items() if n
        )


def warm_up(method: str, params: Thresholds, noise: Noise | None) -> None:
    """Load or compile what the first scan needs, which takes from a second to a minute."""
    bearings = np.linspace(-0.5, 0.5, 60)
    received = LaserScan(0, 0, "", -0.5, 1 / 59, 0.0, 30.0, (2 / np.cos(bearings)).astype(np.float32))
    scan = received.beams()
    extraction = EXTRACTORS[method].extract(scan, params)
    Markers(extraction, received).cdr()
    Cloud(extraction, received, scan, noise).cdr()
