"""Messages of a WebSocket in the order of their arrival, those together that wait together."""

from __future__ import annotations

import time
from collections.abc import Iterator

from websockets.exceptions import ConnectionClosed, ConnectionClosedOK
from websockets.sync.connection import Connection

from .bridge import LARGEST_MESSAGE

MOST_WAITING = 64


def arrivals(socket: Connection) -> Iterator[tuple[float, list[str | bytes]]]:
    """The messages that wait, the oldest first, with the moment at which they were taken (`time.perf_counter`).

    Ends when the other side closes the connection. Raises ConnectionClosed if it is lost.
    """
    while True:
        try:
            waiting: list[str | bytes] = [socket.recv()]
        except ConnectionClosedOK:
            return
        arrived = time.perf_counter()
        try:
            # All of these are decoded before the first is handed over.
            while len(waiting) < MOST_WAITING and sum(map(len, waiting)) < LARGEST_MESSAGE:
                waiting.append(socket.recv(timeout=0))
        except (TimeoutError, ConnectionClosed):
            pass  # the next `recv` raises again
        yield arrived, waiting
