"""Scenes share the event loop of the server."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator

import pytest
from lineseg_app.scene.portless import Arrival, PortlessServer
from waiting import SECONDS


@pytest.fixture
def loop() -> Iterator[asyncio.AbstractEventLoop]:
    """A loop that runs in a thread of its own."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    yield loop
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()


def test_scenes_are_served_in_one_loop_that_outlives_them(loop: asyncio.AbstractEventLoop):
    servers = [PortlessServer(loop) for _ in range(3)]
    assert {server.door.loop for server in servers} == {loop}
    for server in servers:
        server.stop()
        assert server._websock_server._server_thread is not None
        assert not server._websock_server._server_thread.is_alive()
    assert loop.is_running()


def test_an_event_of_a_scene_is_touched_in_its_loop_only(loop: asyncio.AbstractEventLoop):
    """viser sets its events in the threads of those who draw; asyncio's break off there when the loop is waiting."""

    async def waiting() -> bool:
        event = Arrival(loop)
        waiter = asyncio.create_task(event.wait())
        await asyncio.sleep(0)
        other = threading.Thread(target=event.set)
        other.start()
        other.join()
        untouched = not event.is_set() and not waiter.done()
        event.set()
        return await waiter and untouched

    assert asyncio.run_coroutine_threadsafe(waiting(), loop).result(SECONDS)
