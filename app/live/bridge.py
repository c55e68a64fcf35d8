"""What every protocol of a robot's bridge offers and tells, and why a connection to one fails."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from websockets.exceptions import ConnectionClosed, InvalidHandshake

from lineseg.readers.laser_scan import LaserScan
from lineseg.segment import Extraction

OPEN_SECONDS = 5.0
LARGEST_MESSAGE = 4 * 1024 * 1024


class Told(Protocol):
    """Who hears of a bridge's messages."""

    def topic_is(self, topic: str) -> None: ...
    def waits(self, why: str) -> None: ...
    def hand(self, decode: Callable[[], LaserScan]) -> None: ...


class Bridge(Protocol):
    """What a protocol does on an open connection."""

    name: str

    def scans(self, topic: str | None, told: Told) -> None:
        """Hand over each scan of the topic until the connection ends; ValueError where there can be none."""
        ...

    def publish(self, topic: str, extraction: Extraction, scan: LaserScan) -> None:
        """Send segments as a MarkerArray; ValueError where the robot takes none."""
        ...


def why_not(place: str, error: Exception) -> str:
    """Why a connection failed or ended, in words that name the place."""
    if isinstance(error, TimeoutError):
        return f"{place} does not answer"
    if isinstance(error, ConnectionRefusedError):
        return f"nothing listens at {place}"
    if isinstance(error, ConnectionClosed):
        return f"{place} hung up"
    if isinstance(error, InvalidHandshake):
        return f"{place} speaks no WebSocket that can be used ({error})"
    if isinstance(error, OSError):
        return f"{place} cannot be reached ({error.strerror or error})"
    return str(error)
