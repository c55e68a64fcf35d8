"""A class of tabs that step through a lesson, each at its own pace: python tests/benchmarks/class_of_tabs.py [TABS]

Prints the time from a step to the status that shows it, over real sockets; no browser renders the scenes.
"""

from __future__ import annotations

import asyncio
import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from lineseg_app.server import Settings
from websockets.asyncio.client import connect

sys.path.insert(0, str(Path(__file__).parents[1]))
from live import serving

STEPS = 30
PAUSE = 0.5


async def pupil(address: str, seed: int, everybody: asyncio.Barrier) -> list[float]:
    """The latencies [ms] of one tab, from when everybody is there."""
    rng = np.random.default_rng(seed)
    async with connect(f"{address}/api/session", max_size=None) as socket:
        view = {"mode": "learn", "recording": "lesson:1_perfect_corner", "step": 0}
        await socket.send(json.dumps({"type": "hello", "view": view}))
        await drawn(socket, 0)
        await everybody.wait()
        times = []
        for step in range(1, STEPS + 1):
            await asyncio.sleep(PAUSE * rng.uniform(0.5, 1.5))
            begun = time.perf_counter()
            await socket.send(json.dumps({"type": "view", "rev": step, "patch": {"step": step}}))
            await drawn(socket, step)
            times.append(1e3 * (time.perf_counter() - begun))
        return times


async def drawn(socket, rev: int) -> None:
    async for text in socket:
        message = json.loads(text) if isinstance(text, str) else {"type": "survey"}
        if message["type"] == "drawn" and message["rev"] >= rev:
            return


async def main(tabs: int) -> None:
    with tempfile.TemporaryDirectory() as folder, serving(Settings(data_folder=Path(folder))) as server:
        everybody = asyncio.Barrier(tabs)
        times = np.array(await asyncio.gather(*(pupil(server.ws, seed, everybody) for seed in range(tabs))))
    median, most = np.percentile(times, (50, 95))
    print(f"{tabs} tabs, {times.size} steps: median {median:.1f} ms, p95 {most:.1f} ms, most {times.max():.1f} ms")


if __name__ == "__main__":
    asyncio.run(main(int(sys.argv[1]) if len(sys.argv) > 1 else 40))
