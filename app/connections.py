"""Connections that bring no request or take no answer are closed, so that strangers cannot hold all of them."""

from __future__ import annotations

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

REQUEST_SECONDS = 10.0
STALLED_SECONDS = 60.0
MOST_FILES = 4096


def most_connections() -> int:
    """Half of the files that this process may open; the limit is raised as far as the system allows."""
    try:
        import resource
    except ImportError:
        return MOST_FILES // 2
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    # -1: as many as there are.
    allowed, wanted = (MOST_FILES if limit < 0 else min(limit, MOST_FILES) for limit in (soft, hard))
    if allowed < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
    return wanted // 2


class Connection(H11Protocol):
    """A connection of uvicorn. It ends if the head of a request does not come in time, or if nothing of an answer is
    taken for a while.

    most: of all connections; beyond, each new one ends the one that has waited longest for a request.
    """

    most = MOST_FILES

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._look_again: asyncio.TimerHandle | None = None
        self._watch()
        if len(self.connections) > self.most:
            waiting = [each for each in self.connections if isinstance(each, Connection) and not each.answers]
            longest = min(waiting, key=lambda each: each.watched_since)
            # It ends a moment later, when others have come.
            self.connections.discard(longest)
            longest.transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        self._unwatch()
        super().connection_lost(exc)

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        self._unwatch()
        super().handle_websocket_upgrade(event)

    def handle_events(self) -> None:
        super().handle_events()
        if self.answers and not self.flow.write_paused:
            self._unwatch()

    def on_response_complete(self) -> None:
        self._watch()
        super().on_response_complete()

    def pause_writing(self) -> None:
        super().pause_writing()
        self._watch()

    def resume_writing(self) -> None:
        super().resume_writing()
        if self.answers:
            self._unwatch()

    @property
    def answers(self) -> bool:
        """Whether a request is being answered."""
        return self.cycle is not None and not self.cycle.response_complete

    def _watch(self) -> None:
        self._unwatch()
        self.watched_since = self.loop.time()
        self._unsent = self.transport.get_write_buffer_size()
        self._look_again = self.loop.call_later(STALLED_SECONDS if self._unsent else REQUEST_SECONDS, self._look)

    def _look(self) -> None:
        if 0 < self.transport.get_write_buffer_size() < self._unsent:
            self._watch()
        else:
            self.transport.abort()

    def _unwatch(self) -> None:
        if self._look_again is not None:
            self._look_again.cancel()
