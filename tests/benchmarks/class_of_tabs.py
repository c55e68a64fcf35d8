"""A class of tabs that all drag ε, over real sockets: python tests/benchmarks/class_of_tabs.py [TABS] [SECONDS]

Prints the time from a change to the first picture with it or a newer one, the server's processor time for each picture,
and its memory before, with and after the tabs. Nothing renders the scenes, but their bytes are read.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import AsyncIterator
from pathlib import Path

import numpy as np
import viser
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

EVERY = 0.05
# Pages close their sessions; the server gives memory back a few seconds later.
SETTLED = 15.0
REV = re.compile(r'"rev":(\d+)')
# The revisions of all pictures.
PICTURES: list[int] = []


class Server:
    """A server in a process of its own, with these recordings or the samples."""

    def __init__(self, folder: str, *files: str) -> None:
        command = [sys.executable, "-m", "lineseg_app", "view", *files, "--no-browser", "--port", "0"]
        environment = os.environ | {"XDG_DATA_HOME": folder, "TMPDIR": folder}
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
        assert self._process.stdout is not None
        line = next(line for line in self._process.stdout if "http://" in line)
        self.address = re.search(r"http://(\S+:\d+)", line)[1]  # type: ignore[index]
        self.proc = Path(f"/proc/{self._process.pid}")

    @property
    def megabytes(self) -> float:
        return int(re.search(r"VmRSS:\s*(\d+)", (self.proc / "status").read_text())[1]) / 1024  # type: ignore[index]

    @property
    def seconds(self) -> float:
        fields = (self.proc / "stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    @property
    def threads(self) -> int:
        return len(list((self.proc / "task").iterdir()))

    def stop(self) -> None:
        self._process.terminate()
        self._process.wait(30)


async def pupil(address: str, seed: int, seconds: float, together: asyncio.Barrier) -> list[float]:
    """The latencies [ms] of one tab, which drags ε when everybody is there, and leaves when everybody is done."""
    rng = np.random.default_rng(seed)
    sent: dict[int, float] = {}
    times: list[float] = []
    async with connect(f"ws://{address}/api/session", max_size=None, open_timeout=60) as socket:
        await socket.send(json.dumps({"type": "hello", "view": {"recording": "sample:hallway", "frame": seed}}))
        path = json.loads(await socket.recv())["viser"]
        protocol = Subprotocol(f"viser-v{viser.__version__}")
        async with connect(f"ws://{address}{path}", max_size=None, open_timeout=60, subprotocols=[protocol]) as scene:
            drawn = asyncio.Event()
            heard = [asyncio.create_task(_hear(socket, sent, times, drawn)), asyncio.create_task(_watch(scene))]
            await drawn.wait()
            await together.wait()
            begun = time.perf_counter() + EVERY * rng.uniform()
            for rev in range(1, int(seconds / EVERY) + 1):
                await asyncio.sleep(max(0.0, begun + rev * EVERY - time.perf_counter()))
                sent[rev] = time.perf_counter()
                epsilon = round(float(rng.uniform(0.01, 0.1)), 4)
                await socket.send(json.dumps({"type": "view", "rev": rev, "patch": {"params": {"epsilon": epsilon}}}))
            await asyncio.sleep(min(1.0, seconds))
            await together.wait()
            await together.wait()
            await socket.send('{"type": "close"}')
            await asyncio.wait(heard, timeout=10)
    return times


async def _hear(socket: ClientConnection, sent: dict[int, float], times: list[float], drawn: asyncio.Event) -> None:
    """Notes how long each change waited for its picture, or for that of a newer one."""
    async for message in _until_closed(socket):
        if isinstance(message, str) and message.startswith('{"type":"drawn"'):
            drawn.set()
            now, rev = time.perf_counter(), int(REV.search(message)[1])  # type: ignore[index]
            times += [1e3 * (now - sent.pop(each)) for each in list(sent) if each <= rev]
            PICTURES.append(rev)


async def _watch(scene: ClientConnection) -> None:
    async for _ in _until_closed(scene):
        pass


async def _until_closed(socket: ClientConnection) -> AsyncIterator[str | bytes]:
    with contextlib.suppress(ConnectionClosed):
        async for message in socket:
            yield message


async def main(tabs: int, seconds: float) -> None:
    with tempfile.TemporaryDirectory() as folder:
        server = Server(folder)
        try:
            await _run(server, tabs, seconds)
        finally:
            server.stop()


async def _run(server: Server, tabs: int, seconds: float) -> None:
    # The first tab compiles the kernels and loads what all share.
    await asyncio.gather(pupil(server.address, 0, 2.0, asyncio.Barrier(1)))
    await asyncio.sleep(SETTLED)
    before, threads = server.megabytes, server.threads
    together = asyncio.Barrier(tabs + 1)
    pupils = [asyncio.create_task(pupil(server.address, seed, seconds, together)) for seed in range(tabs)]
    await together.wait()
    PICTURES.clear()
    begun, spent, own = time.perf_counter(), server.seconds, time.process_time()
    await together.wait()
    elapsed, spent, during = time.perf_counter() - begun, server.seconds - spent, server.megabytes
    own = time.process_time() - own
    await together.wait()
    times = np.array([each for its in await asyncio.gather(*pupils) for each in its])
    await asyncio.sleep(SETTLED)
    median, most = np.percentile(times, (50, 95))
    pictures = len(PICTURES)
    print(f"{tabs} tabs, {times.size} changes: median {median:.0f} ms, p95 {most:.0f} ms, most {times.max():.0f} ms")
    print(
        f"{pictures / elapsed:.0f} pictures a second, {1e3 * spent / pictures:.1f} ms of processor time each; ", end=""
    )
    print(f"of one core: server {100 * spent / elapsed:.0f} %, these tabs {100 * own / elapsed:.0f} %")
    print(f"memory: {before:.0f} MB before, {during:.0f} with ({(during - before) / tabs:.1f} a tab), ", end="")
    print(f"{server.megabytes:.0f} after; threads: {threads} before, {server.threads} after")


if __name__ == "__main__":
    given = [float(each) for each in sys.argv[1:]]
    asyncio.run(main(int(given[0]) if given else 40, given[1] if len(given) > 1 else 15.0))
