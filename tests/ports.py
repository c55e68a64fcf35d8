"""Ports for programs that must be told one before they listen."""

from __future__ import annotations

import contextlib
import socket
from collections.abc import Iterator


@contextlib.contextmanager
def held_port() -> Iterator[int]:
    """A port of the loopback that is nobody else's, and at which nothing listens until a program of the test does.

    It stays bound here. With SO_REUSEADDR, which servers set, another socket may be bound to it too if asked for it by
    number; the system gives it to no one who asks for any.
    """
    with socket.socket() as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(("127.0.0.1", 0))
        yield holder.getsockname()[1]
