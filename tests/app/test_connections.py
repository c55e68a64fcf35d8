"""Whoever opens connections and says or takes nothing does not keep others out."""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress

import pytest
from lineseg_app import body_limit, connections, socket_limit
from lineseg_app.body_limit import BodyLimit
from lineseg_app.connections import Connection
from lineseg_app.listening import listen, server_of
from lineseg_app.routes import heard
from live import Address, Page, connect
from starlette.exceptions import HTTPException
from starlette.types import Message, Receive, Scope, Send
from uvicorn.server import ServerState
from waiting import SECONDS
from websockets.exceptions import ConnectionClosed, InvalidStatus

HEAD = "{} HTTP/1.1\r\nHost: 127.0.0.1\r\n"


@contextmanager
def open_socket(server: Address, said: str = "") -> Iterator[socket.socket]:
    with socket.create_connection(("127.0.0.1", server.port), SECONDS) as caller:
        caller.sendall(said.encode())
        yield caller


def answer(caller: socket.socket) -> str:
    """All that the server says until it closes the connection."""
    said = b""
    try:
        while data := caller.recv(1 << 16):
            said += data
    except ConnectionResetError:
        pass
    return said.decode()


@contextmanager
def dripping(caller: socket.socket, drop: bytes) -> Iterator[None]:
    over = threading.Event()

    def drip() -> None:
        with suppress(OSError):
            while not over.wait(0.02):
                caller.sendall(drop)

    thread = threading.Thread(target=drip)
    thread.start()
    yield
    over.set()
    thread.join()


@pytest.fixture
def hasty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "REQUEST_SECONDS", 0.2)


@pytest.fixture
def hasty_body(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(body_limit, "SILENT_SECONDS", 0.2)


@pytest.mark.parametrize("said", ["", HEAD.format("GET /api/lessons") + "X-Half: "])
def test_a_connection_without_a_whole_request_is_closed(server: Address, hasty: None, said: str):
    with open_socket(server, said) as caller:
        assert answer(caller) == ""


@pytest.mark.parametrize("first", ["", HEAD.format("GET /nothing") + "\r\n"])
def test_a_head_that_comes_in_drops_is_not_waited_for_also_after_a_request(server: Address, hasty: None, first: str):
    with open_socket(server, first + HEAD.format("GET /api/lessons")) as caller, dripping(caller, b"X-Drip: 1\r\n"):
        assert answer(caller).count("HTTP/1.1") <= bool(first)


@pytest.mark.parametrize("path", ["/api/params", "/api/upload?name=slow.npz", "/api/scans/robot"])
def test_a_body_that_stops_is_refused(server: Address, hasty_body: None, path: str):
    head = HEAD.format(f"POST {path}") + "Content-Type: application/json\r\nContent-Length: 9000\r\n\r\n{"
    with open_socket(server, head) as caller:
        assert "nothing more of this came for 0.2 s" in answer(caller)


def test_a_body_that_comes_too_slowly_is_refused(hasty_body: None):
    async def drops() -> Message:
        return {"type": "http.request", "body": b"", "more_body": True}

    async def read(scope: Scope, receive: Receive, send: Send) -> None:
        while True:
            await receive()

    scope = {"type": "http", "path": "/api/upload", "headers": []}
    with pytest.raises(HTTPException, match="less than 4 kB/s") as error:
        asyncio.run(BodyLimit(read)(scope, drops, lambda message: asyncio.sleep(0)))
    assert error.value.status_code == 408


def test_uploads_that_do_not_proceed_make_room_for_others(
    server: Address, hasty_body: None, monkeypatch: pytest.MonkeyPatch
):
    head = HEAD.format("POST /api/upload?name=slow.npz") + "Content-Length: 4000\r\n\r\n"
    with ExitStack() as stack:
        callers = [stack.enter_context(open_socket(server, head)) for _ in range(4)]
        assert all("408" in answer(caller) for caller in callers)
    # This one may come as slowly as it likes.
    monkeypatch.undo()
    assert server.upload("next.npz", b"x").status_code == 200


def test_beyond_the_most_connections_the_one_that_waits_longest_is_closed(
    server: Address, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(Connection, "most", 3)
    monkeypatch.setattr(connections, "REQUEST_SECONDS", 1e6)
    callers = [socket.create_connection(("127.0.0.1", server.port), SECONDS) for _ in range(12)]
    # What the client of another test keeps open counts, too.
    assert [answer(caller) for caller in callers[:9]] == [""] * 9
    assert server.get("/api/lessons").status_code == 200
    for caller in callers:
        caller.close()


def test_an_answer_that_nobody_takes_ends(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(connections, "STALLED_SECONDS", 0.2)
    left = threading.Event()

    async def film(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return
        await send({"type": "http.response.start", "status": 200, "headers": []})
        await send({"type": "http.response.body", "body": bytes(40_000_000), "more_body": True})
        while (await receive())["type"] != "http.disconnect":
            pass
        left.set()

    listening = threading.Event()
    server = server_of(film, listening.set)
    with listen("127.0.0.1", 0) as listener:
        thread = threading.Thread(target=lambda: asyncio.run(server.serve([listener])))
        thread.start()
        assert listening.wait(SECONDS)
        with open_socket(Address(listener.getsockname()[1]), HEAD.format("GET /film") + "\r\n"):
            assert left.wait(SECONDS)
        server.should_exit = True
        thread.join(SECONDS)


class Outlet(asyncio.Transport):
    """Has so many bytes left to send."""

    left, aborted = 0, False

    def close(self) -> None: ...

    def get_write_buffer_size(self) -> int:
        return self.left

    def abort(self) -> None:
        self.aborted = True


def test_an_answer_that_is_taken_slowly_goes_on():
    async def run() -> None:
        outlet = Outlet()
        connection = Connection(server_of(nothing).config, ServerState(), {})
        connection.connection_made(outlet)
        for left in (100, 60, 20):
            outlet.left = left
            connection.pause_writing() if left == 100 else connection._look()
            assert not outlet.aborted
        connection._look()
        assert outlet.aborted
        connection.connection_lost(None)

    async def nothing(scope: Scope, receive: Receive, send: Send) -> None: ...

    asyncio.run(run())


def test_a_tab_that_says_nothing_is_hung_up_on(server: Address, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(heard, "FIRST_SECONDS", 0.2)
    hung_up = pytest.raises(ConnectionClosed, match="nothing came for")
    with connect(f"{server.ws}/api/session") as silent, hung_up:
        silent.recv(SECONDS)


def test_sockets_of_one_kind_do_not_use_up_those_of_the_others(
    server: Address, page: Page, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(socket_limit, "MOST_SOCKETS", 2)
    url = f"{server.ws}/api/tuning"
    with connect(url) as first:
        first.recv(SECONDS)
        with connect(url) as second, connect(url) as third:
            second.recv(SECONDS)
            with pytest.raises(ConnectionClosed, match="2 connections like this are open"):
                third.recv(SECONDS)
    page.hello()


def test_a_socket_at_no_place_at_all_is_refused(server: Address):
    with pytest.raises(InvalidStatus, match="403"), connect(f"{server.ws}/api"):
        pass


def test_a_message_of_bytes_to_read_as_gets_a_sentence_and_the_next_one_is_answered(server: Address):
    with connect(f"{server.ws}/api/reading") as socket:
        for message in (b"\xff\x00", b"{}"):
            socket.send(message)
            assert '"job": -1' in str(socket.recv(SECONDS))
