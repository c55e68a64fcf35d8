"""A real server in a thread, and a page that talks to it over a real WebSocket."""

from __future__ import annotations

import asyncio
import contextlib
import json
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import httpx
import numpy as np
from lineseg_app.listening import listen, server_of
from lineseg_app.server import Settings, create_app
from waiting import SECONDS
from websockets.sync import client

from lineseg.doubt import SCORES

# However long a handshake or an answer takes.
connect = partial(client.connect, open_timeout=SECONDS, ping_interval=None, max_size=None, proxy=None)


@dataclass(frozen=True)
class Address:
    port: int

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def ws(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    def get(self, path: str, **options: Any) -> httpx.Response:
        return httpx.get(self.http + path, timeout=SECONDS, trust_env=False, **options)

    def post(self, path: str, **options: Any) -> httpx.Response:
        return httpx.post(self.http + path, timeout=SECONDS, trust_env=False, **options)

    def put(self, path: str, **options: Any) -> httpx.Response:
        return httpx.put(self.http + path, timeout=SECONDS, trust_env=False, **options)

    def upload(self, name: str, content: bytes, **options: Any) -> httpx.Response:
        return self.post("/api/upload", params={"name": name}, content=content, **options)


@contextlib.contextmanager
def serving(settings: Settings) -> Iterator[Address]:
    """A server on a free port, stopped at the end."""
    settings = replace(settings, port=0, open_browser=False)
    listening = threading.Event()
    server = server_of(create_app(settings), listening.set)
    with listen("127.0.0.1", 0) as listener:
        # A loop of our own, so that nothing of it outlives the thread.
        thread = threading.Thread(target=lambda: asyncio.run(server.serve([listener])), name="server under test")
        thread.start()
        try:
            assert listening.wait(SECONDS), "the server does not listen"
            yield Address(listener.getsockname()[1])
        finally:
            server.should_exit = True
            thread.join(SECONDS)
    assert not thread.is_alive(), "the server does not end"
    # Compiling a kernel swaps the filters of warnings, which the next test would feel.
    for left in threading.enumerate():
        if left.name == "warm up":
            left.join(SECONDS)


class Page:
    """Does what the page in the browser does on its socket."""

    def __init__(self, socket: client.ClientConnection) -> None:
        self._socket = socket
        self._rev = 0
        self.welcome: dict[str, Any] = {}
        self.last: dict[str, dict[str, Any]] = {}

    def say(self, **message: Any) -> None:
        self._socket.send(json.dumps(message))

    def hear(self, awaited: str = "any message") -> dict[str, Any]:
        """The next message. awaited: for the failure, if none comes."""
        try:
            data = self._socket.recv(timeout=SECONDS)
        except TimeoutError:
            heard = {kind: f"{message!r:.1500}" for kind, message in self.last.items()}
            raise AssertionError(f"waited {SECONDS} s in vain for {awaited}; the last of each kind: {heard}") from None
        message = json.loads(data) if isinstance(data, str) else surveyed(data)
        self.last[message["type"]] = message
        return message

    def hear_a(self, *types: str) -> dict[str, Any]:
        """The next message of one of these types."""
        while (message := self.hear(" or ".join(types)))["type"] not in types:
            pass
        return message

    def heard(self, of: str, until: Callable[[dict[str, Any]], Any]) -> dict[str, Any]:
        """The last message of a type, or the next one, for which `until` holds."""
        message = self.last.get(of)
        while message is None or not until(message):
            message = self.hear_a(of)
        return message

    def hello(self, session: str | None = None, follow: str | None = None, **view: Any) -> dict[str, Any]:
        """Say hello; return the state of the first picture."""
        self.say(type="hello", session=session, view=view, follow=follow)
        self.welcome = self.hear_a("welcome")
        return self.hear_a("drawn")["state"]

    def ask(self, **patch: Any) -> int:
        """Ask for a change without waiting; return its revision."""
        self._rev += 1
        self.say(type="view", rev=self._rev, patch=patch)
        return self._rev

    def drawn(self, rev: int) -> dict[str, Any]:
        """The message of the first picture that contains revision `rev`."""
        while True:
            message = self.hear_a("drawn", "error")
            if message["type"] == "error":
                raise AssertionError(message["message"])
            if message["rev"] >= rev:
                return message

    def drawn_or_told(self, rev: int) -> dict[str, Any]:
        """The state of the first picture that contains revision `rev`, even if an error comes before it."""
        return self.heard("drawn", lambda message: message["rev"] >= rev)["state"]

    def change(self, **patch: Any) -> dict[str, Any]:
        """Change the View; return the state of the picture that shows it."""
        return self.drawn(self.ask(**patch))["state"]

    def until(self, condition: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The last drawn state, or the next one, for which the condition holds."""
        return self.heard("drawn", lambda message: condition(message["state"]))["state"]

    def refused(self, **patch: Any) -> dict[str, Any]:
        """Ask for something impossible; return the error."""
        self.ask(**patch)
        return self.hear_a("error")

    def close(self) -> None:
        self._socket.close()


def surveyed(message: bytes) -> dict[str, Any]:
    """A binary message; its `scores` by name, each of every stride-th frame."""
    start = 4 + int.from_bytes(message[:4], "little")
    head = json.loads(message[4:start])
    names = [*SCORES, "suspicion", "difference"]
    known = -(-head["frames"] // head["stride"])
    values = np.frombuffer(message, "<f4", offset=start).reshape(-1, known)
    rows = [*values, *[np.empty(0, np.float32)] * (len(names) - len(values))]
    return head | {"scores": dict(zip(names, rows, strict=True))}


@contextlib.contextmanager
def page_of(address: Address, **options: Any) -> Iterator[Page]:
    with connect(f"{address.ws}/api/session", **options) as socket:
        yield Page(socket)


def leave(address: Address, page: Page) -> None:
    """Close a page, and wait until the server has noticed: until then its session is given to no other."""
    with page_of(address) as pupil:
        pupil.hello(follow=page.welcome["presenter"])
        page.close()
        pupil.until(lambda state: state["following"] == "away")
