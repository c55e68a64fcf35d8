"""Every way into the process but the guarded one is closed."""

from __future__ import annotations

import contextlib
import logging
from pathlib import Path

import httpx
import pytest
from lineseg_app.server import Settings
from live import Address, connect, page_of, serving
from waiting import SECONDS
from websockets.exceptions import InvalidHandshake, InvalidStatus

LISTENING = "0A"


def listening() -> set[int]:
    """The ports on which this process listens, as Linux lists them."""
    held = set()
    for descriptor in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(OSError):
            held.add(str(descriptor.readlink()))
    ports = set()
    # Without IPv6 there is no second table.
    for table in filter(Path.exists, map(Path, ("/proc/self/net/tcp", "/proc/self/net/tcp6"))):
        for line in table.read_text().splitlines()[1:]:
            fields = line.split()
            if fields[3] == LISTENING and f"socket:[{fields[9]}]" in held:
                ports.add(int(fields[1].rsplit(":", 1)[1], 16))
    return ports


@pytest.mark.skipif(not Path("/proc/self/net/tcp").exists(), reason="only Linux lists the ports of a process")
def test_no_port_of_the_process_answers_without_the_token_or_to_another_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    before, said = listening(), []
    monkeypatch.setattr(logging.getLogger("uvicorn.error"), "callHandlers", said.append)
    with serving(Settings(token="sesame", data_folder=tmp_path)) as server:
        key = {"Authorization": "Bearer sesame"}
        with page_of(server, additional_headers=key) as page:
            page.hello()
            scene = page.welcome["viser"].rstrip("/")
            options = {"subprotocols": ["viser-v1.1.1"]}
            with connect(server.ws + scene, additional_headers=key, **options) as socket:  # pyright: ignore
                assert socket.recv(timeout=SECONDS)
                opened = listening() - before
                assert server.port in opened
                for port in opened:
                    there = Address(port)
                    foreign = {"Origin": "http://127.0.0.1:1"}
                    for headers in ({}, foreign, foreign | key):
                        with contextlib.suppress(httpx.RemoteProtocolError):
                            assert there.get("/", headers=headers).status_code == 403, (port, headers)
                        with pytest.raises((InvalidStatus, InvalidHandshake, EOFError)):
                            connect(there.ws + scene, additional_headers=headers, **options).close()  # pyright: ignore
    # What is refused fills no log.
    assert said == []


def test_the_viewer_of_rerun_is_read_from_the_installed_program_without_running_it(tmp_path, monkeypatch):
    viewer = pytest.importorskip("lineseg_app.rerun.viewer")
    monkeypatch.setenv("PATH", "")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("socket.socket.connect", lambda *_: pytest.fail("a port was asked"))
        patched.setattr("subprocess.Popen.__init__", lambda *_, **__: pytest.fail("a program was run"))
        viewer.unpack(tmp_path)
    script, module = ((tmp_path / name).read_bytes() for name in viewer.FILES)
    assert script.startswith(b"let wasm_bindgen")
    assert script.decode().rstrip().endswith("})({ __proto__: null });")
    assert module.startswith(b"\0asm")
    assert 1e7 < len(module) < 1e8
