"""`lineseg view`: serve the page."""

from __future__ import annotations

import contextlib
from pathlib import Path

from tyro.conf import Positional

MOST_KEPT = 20_000


def view(
    file: Positional[str | None] = None,
    *,
    topic: str | None = None,
    keep: int = 3000,
    host: str = "127.0.0.1",
    port: int = 8765,
    token: str | None = None,
    no_browser: bool = False,
    rerun: bool = False,
) -> None:
    """Show the page in the browser.

    Args:
        file: recording to open: CARMEN log, ROS 1 or ROS 2 bag, MCAP, NPZ or text; without it, a sample.
            Or a robot, whose scans are shown as they come: ws://robot:9090 (rosbridge), ws://robot:8765 (Foxglove).
        topic: laser topic to take; the first without.
        keep: of a robot's scans the newest so many are kept.
        host: address to listen on; any but the loopback asks for a token.
        port: TCP port; 0 takes a free one.
        token: word that a browser must bring along.
        no_browser: only serve, open no browser.
        rerun: stream what is looked at into rerun's viewer as well, on its port 9876; it is started if there is none.
    """
    from ..live.address import Address, is_address
    from ..server import Settings, serve

    files, robots = (), ()
    if file is not None and is_address(file):
        robots = (Address(file, topic),)
    elif file is not None:
        path = Path(file)
        if not path.exists():
            raise FileNotFoundError(f"{path}: there is no such file or folder.")
        files = (path.resolve(),)
    if not 1 <= keep <= MOST_KEPT:
        raise ValueError(f"--keep is {keep}; allowed are 1 to {MOST_KEPT} scans")
    with contextlib.ExitStack() as stack:
        watch = None
        if rerun:
            from ..rerun.live import live_rerun

            watch = stack.enter_context(live_rerun()).show
        settings = Settings(
            files=files,
            topic=None if robots else topic,
            robots=robots,
            keep=keep,
            host=host,
            port=port,
            token=token,
            open_browser=not no_browser,
            watch=watch,
        )
        serve(settings, lambda address: print(f"lineseg is at {address} (Ctrl-C stops it)", flush=True))
