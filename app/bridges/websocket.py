"""Connects to a robot's WebSocket. The robot decides the protocol: a Foxglove server accepts its subprotocol."""

from __future__ import annotations

import socket
import struct
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from .bridge import CLOSE_SECONDS, LARGEST_MESSAGE, OPEN_SECONDS, Bridge
from .foxglove import SUBPROTOCOLS, Foxglove
from .rosbridge import RosBridge

# A robot that takes nothing for so long is given up; until then, nothing else can be said to it, not even goodbye.
TAKE_SECONDS = 2


@contextmanager
def open_websocket(url: str) -> Iterator[Bridge]:
    """Raises OSError or WebSocketException if the robot cannot be reached, or no longer."""
    with connected(url, SUBPROTOCOLS) as connection:
        named = (connection.subprotocol or "").startswith("foxglove.")
        yield Foxglove(connection) if named else RosBridge(connection)


def connected(url: str, subprotocols: Sequence[Subprotocol] | None = None) -> ClientConnection:
    """A connection with limits for everything that the other side does."""
    connection = connect(
        url,
        subprotocols=subprotocols,
        open_timeout=OPEN_SECONDS,
        close_timeout=CLOSE_SECONDS,
        max_size=LARGEST_MESSAGE,
        proxy=None,
    )
    milliseconds = sys.platform == "win32"
    limit = struct.pack("L", 1000 * TAKE_SECONDS) if milliseconds else struct.pack("ll", TAKE_SECONDS, 0)
    connection.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, limit)
    return connection
