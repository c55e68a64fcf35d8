"""How long Auto takes over the page's socket: python tests/benchmarks/auto_in_page.py [RECORDING] [TRIALS]

Prints the time from the request to the first trial, to the last one and to the final verdict, and the processor time
of all; without truth, in a server in this process, which has drawn the recording before.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from pathlib import Path

from lineseg_app.server import Settings
from websockets.sync.client import connect
from websockets.sync.connection import Connection

sys.path.insert(0, str(Path(__file__).parents[1]))
from live import SECONDS, page_of, serving

THRESHOLDS = ["epsilon", "delta", "seed_points"]


def main(recording: str, trials: int) -> None:
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Settings(data_folder=Path(folder))) as address,
        page_of(address) as page,
    ):
        page.hello(recording=recording)
        place = f"{address.ws}/api/tuning?session={page.welcome['session']}"
        with connect(place, max_size=None, proxy=None) as socket:
            socket.recv(timeout=SECONDS)
            for run in ("first run", "again"):
                begun, spent = time.perf_counter(), time.process_time()
                times = _searched(socket, trials)
                print(
                    f"{recording}, {len(times) - 1} trials, {run}: first after {times[0] - begun:.2f} s, last after "
                    f"{times[-2] - begun:.2f} s, verdict after {times[-1] - begun:.2f} s; "
                    f"{time.process_time() - spent:.2f} s of processor time"
                )


def _searched(socket: Connection, trials: int) -> list[float]:
    """When each trial came, and at last the end."""
    wish = {"objective": "label-free", "thresholds": THRESHOLDS, "trials": trials, "anew": True}
    socket.send(json.dumps({"type": "auto", "job": 1, "params": {}} | wish))
    times, answer = [], {"done": False}
    while not answer.get("done"):
        answer = json.loads(socket.recv(timeout=SECONDS))
        times += [time.perf_counter()] * len(answer.get("trials", []))
    return [*times, time.perf_counter()]


if __name__ == "__main__":
    given = sys.argv[1:]
    main(given[0] if given else "sample:hallway", int(given[1]) if len(given) > 1 else 100)
