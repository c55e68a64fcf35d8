"""The page in Firefox, driven over WebDriver BiDi."""

from __future__ import annotations

import itertools
import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from live import Address
from waiting import SECONDS
from websockets.sync.client import connect
from websockets.sync.connection import Connection

FIREFOX = shutil.which("firefox") or shutil.which("firefox-esr")


class Firefox:
    """One tab, and what its console complained of."""

    def __init__(self, socket: Connection) -> None:
        self._socket = socket
        self._numbers = itertools.count(1)
        self.complaints: list[str] = []
        self.ask("session.new", capabilities={})
        self.ask("session.subscribe", events=["log.entryAdded"])
        self._context = self.ask("browsingContext.getTree")["contexts"][0]["context"]

    def ask(self, method: str, **params: Any) -> dict[str, Any]:
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            message = json.loads(self._socket.recv(SECONDS))
            if message.get("method") == "log.entryAdded" and message["params"]["level"] == "error":
                self.complaints.append(message["params"]["text"])
            if message.get("id") == number:
                assert message["type"] == "success", message
                return message["result"]

    def open(self, url: str) -> None:
        self.ask("browsingContext.navigate", context=self._context, url=url, wait="complete")

    def until(self, condition: str) -> None:
        """Waits until JavaScript holds."""
        script = f"""new Promise((done, failed) => {{
            const late = Date.now() + {1000 * SECONDS};
            const look = () => {{
                const s = window.lineseg?.state;
                if (s && window.lineseg.settled && ({condition})) done(true);
                else if (Date.now() > late) failed(new Error("waited in vain"));
                else setTimeout(look, 20);
            }};
            look();
        }})"""
        answer = self.ask("script.evaluate", expression=script, target={"context": self._context}, awaitPromise=True)
        assert answer["type"] == "success", f"{condition}: {answer}"


@pytest.fixture
def firefox(tmp_path: Path) -> Iterator[Firefox]:
    if FIREFOX is None:
        pytest.skip("apt-get install firefox-esr")
    command = [FIREFOX, "--headless", "--remote-debugging-port", "0", "--profile", str(tmp_path)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    try:
        assert process.stderr is not None
        found = (re.search(r"WebDriver BiDi listening on (\S+)", line) for line in process.stderr)
        listening = next(filter(None, found))
        with connect(f"{listening[1]}/session", max_size=None) as socket:
            yield Firefox(socket)
    finally:
        process.kill()
        process.wait()
        if process.stderr is not None:
            process.stderr.close()


def test_firefox_shows_a_recording_and_answers_a_threshold_and_a_question(firefox: Firefox, address: Address):
    firefox.open(f"{address.http}/#recording=sample:hallway")
    firefox.until("s.segments.length > 3 && lineseg.project(0, 0)")
    firefox.until("document.querySelector('.scene.ready')")
    firefox.open(f"{address.http}/#recording=sample:hallway&epsilon=0.2&beam=273")
    firefox.until("s.params.epsilon === 0.2 && document.querySelector('.explanation').checkVisibility()")
    assert firefox.complaints == []
