"""Robots in processes of their own that obey, and nodes in threads, for tests of live sources."""

from __future__ import annotations

import json
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from lineseg_app.bridges.address import Address
from lineseg_app.live.source import Publishing
from lineseg_app.node.node import OWNER, Node
from lineseg_app.node.running import Running
from waiting import SECONDS, eventually

from lineseg import Params


class Obedient:
    """A program that obeys one JSON command a line, and answers each with one line."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def ask(self, do: str, **arguments: Any) -> Any:
        assert self._process.stdin and self._process.stdout
        self._process.stdin.write(json.dumps({"do": do, **arguments}) + "\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline()
        assert answer, f"the program ended with {self._process.wait(SECONDS)} when it was asked to {do}"
        return json.loads(answer)

    def until(self, do: str, **arguments: Any) -> Any:
        """The first answer that is not empty."""
        return eventually(lambda: self.ask(do, **arguments), f"an answer to {do} {arguments}")

    def close(self) -> None:
        self._process.kill()
        self._process.communicate()


@contextmanager
def running(address: Address, topic: str, present: Running | None = None, **fields: Any) -> Iterator[list[str]]:
    """A node, in a thread, that publishes below the topic; yields what it tells. present: what it runs."""
    told: list[str] = []
    present = present or Running("region-growing", Params())
    publishing = Publishing(OWNER, f"{topic}/markers", *present.now, f"{topic}/cloud", **fields)
    node = Node(address, publishing, present, told.append)
    thread = threading.Thread(target=node.run)
    thread.start()
    try:
        yield told
    finally:
        node.stop()
        thread.join(SECONDS)
    assert not thread.is_alive(), f"the node does not end; it told {told}"


def said(told: list[str], words: str) -> None:
    eventually(lambda: any(words in line for line in told), words, lambda: told)
