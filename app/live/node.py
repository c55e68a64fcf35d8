"""Extracts segments from the scans of a robot and publishes them, without a page."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

import numpy as np

from lineseg import EXTRACTORS, Thresholds
from lineseg.covariance import Noise
from lineseg.readers.laser_scan import LaserScan

from .address import Address
from .cloud import Cloud
from .markers import Markers
from .ring import Ring
from .robot import Robot
from .running import Running
from .source import Published, Publishing

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
        self._reported = 0.0

    def stop(self) -> None:
        self._stop.set()

    def run(self) -> Published | None:
        """Publish until `stop`, or once. Returns what was published last; None if nothing was.

        Raises ValueError if the robot does not accept the segments.
        """
        warm_up(*self._running.now, self._publishing.noise)
        self._began = self._reported = time.monotonic()
        self._robot.start()
        said = ""
        try:
            while not self._stop.wait(LOOK_SECONDS):
                said = self._say_new(said)
                self._report()
                if self._robot.publish_trouble:
                    raise ValueError(self._robot.publish_trouble)
                if self._once and self._robot.last_published:
                    break
        finally:
            self._robot.close()
        return self._robot.last_published

    def _before_each_scan(self) -> None:
        """In the thread of the robot."""
        if self._once:
            early = time.monotonic() - self._began < ANNOUNCED_SECONDS
            self._robot.publish(OWNER, None if early or self._robot.published else self._publishing)
        self._robot.follow(OWNER, *self._running.newest())

    def _say_new(self, said: str) -> str:
        """Tell what the connection says, if it is new."""
        words = self._robot.message
        if words and words != said:
            self._tell(words)
        return words

    def _report(self) -> None:
        """A line a second while scans are published."""
        now, last = time.monotonic(), self._robot.last_published
        if self._once or last is None or now - self._reported < REPORT_SECONDS:
            return
        self._reported = now
        rate = self._robot.rate()
        if rate:
            delay, left_out = self._robot.delay, self._robot.left_out
            self._tell(
                f"{rate:.1f} Hz, {'' if delay is None else f'delay {1e3 * delay:.0f} ms, '}"
                f"{len(last.extraction.segments)} segments in {1e6 * last.elapsed:.0f} µs, "
                f"{self._robot.published} scans{f', {left_out} left out' if left_out else ''}"
            )


def warm_up(method: str, params: Thresholds, noise: Noise | None) -> None:
    """Load or compile what the first scan needs, which takes from a second to a minute."""
    bearings = np.linspace(-0.5, 0.5, 60)
    received = LaserScan(0, 0, "", -0.5, 1 / 59, 0.0, 30.0, (2 / np.cos(bearings)).astype(np.float32))
    scan = received.beams()
    extraction = EXTRACTORS[method].extract(scan, params)
    Markers(extraction, received).cdr()
    Cloud(extraction, received, scan, noise).cdr()
