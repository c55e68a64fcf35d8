"""Connects to a robot's WebSocket. The robot decides the protocol: a Foxglove server accepts its subprotocol."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from websockets.sync.client import connect

from .bridge import CLOSE_SECONDS, LARGEST_MESSAGE, OPEN_SECONDS, Bridge
from .foxglove import SUBPROTOCOLS, Foxglove
from .rosbridge import RosBridge


@contextmanager
def open_websocket(url: str) -> Iterator[Bridge]:
    with connect(
        url,
        subprotocols=SUBPROTOCOLS,
        open_timeout=OPEN_SECONDS,
        close_timeout=CLOSE_SECONDS,
        max_size=LARGEST_MESSAGE,
        proxy=None,
    ) as socket:
        named = (socket.subprotocol or "").startswith("foxglove.")
        yield Foxglove(socket) if named else RosBridge(socket)
