"""The interface of every way to a robot, and words for failed connections."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from websockets import CloseCode
from websockets.exceptions import ConnectionClosed, InvalidHandshake

from lineseg.readers.laser_scan import LaserScan

from .outgoing import Message

OPEN_SECONDS, CLOSE_SECONDS = 5.0, 1.0
# JSON takes several times as many bytes as the numbers themselves.
LARGEST_MESSAGE, LARGEST_SAMPLE = 4 * 1024 * 1024, 1024 * 1024


class Told(Protocol):
    """The receiver of a bridge's messages."""

    def topic_is(self, topic: str) -> None: ...
    def waits(self, why: str) -> None: ...
    def misses(self, why: str) -> None:
        """The connection holds, but scans no longer come."""

    def loses(self, scans: int) -> None:
        """So many were sent and never arrived."""

    def hand(self, decode: Callable[[], LaserScan], arrived: float, newest: bool = True) -> None:
        """arrived: when (`time.perf_counter`); newest: whether no later scan has arrived already."""


class Bridge(Protocol):
    """An open connection. `scans` runs in one thread; `close`, from any other, ends it."""

    @property
    def name(self) -> str:
        """What it speaks."""
        ...

    def scans(self, topic: str | None, told: Told) -> None:
        """Hand over each scan of the topic until the connection ends. Raises ValueError if the topic has no scans."""
        ...

    def announce(self, topic: str, message: type[Message]) -> None:
        """Say that such messages will be published, so that the first one already has its receivers."""
        ...

    def publish(self, topic: str, message: Message) -> None:
        """Raises ValueError if the robot does not accept it."""
        ...

    def close(self) -> None: ...


def hand_all(told: Told, waiting: Sequence[Callable[[], LaserScan]], arrived: float) -> None:
    """Hand over scans that wait together, the oldest first."""
    for index, decode in enumerate(waiting, 1):
        told.hand(decode, arrived, newest=index == len(waiting))


def why_not(place: str, error: Exception) -> str:
    """Why a connection failed or ended, with the address."""
    if isinstance(error, TimeoutError):
        return f"{place} does not answer"
    if isinstance(error, ConnectionRefusedError):
        return f"nothing listens at {place}"
    if isinstance(error, BlockingIOError) or isinstance(error.__cause__, BlockingIOError):
        return f"{place} takes no messages any more"
    if isinstance(error, ConnectionClosed):
        if error.sent is not None and error.sent.code == CloseCode.MESSAGE_TOO_BIG:
            return f"{place} sent a message of more than {LARGEST_MESSAGE >> 20} MB"
        if error.sent is not None and error.sent.code in (CloseCode.INVALID_DATA, CloseCode.PROTOCOL_ERROR):
            return f"{place} sent a message that is not one of WebSocket ({error.sent.reason or error.sent.code})"
        return f"{place} closed the connection"
    if isinstance(error, InvalidHandshake):
        return f"{place} does not offer a usable WebSocket ({error})"
    if isinstance(error, OSError):
        return f"{place} cannot be reached ({error.strerror or error})"
    return str(error)
