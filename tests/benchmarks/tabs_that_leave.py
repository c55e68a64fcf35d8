"""Opens and closes many tabs, some at once: python tests/benchmarks/tabs_that_leave.py [TABS]

Prints the server's memory, threads, open files and temporary files as they leave.
"""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path

from class_of_tabs import SETTLED, Server, pupil

AT_ONCE = 10
TOLD_EVERY = 100


async def main(tabs: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        server = Server(folder)
        try:
            await leave(server, 1)
            for done in range(0, tabs + 1, TOLD_EVERY):
                await asyncio.sleep(SETTLED)
                files = len(list((server.proc / "fd").iterdir()))
                left = len([path for path in Path(folder).rglob("*") if path.is_file()])
                print(f"after {done} tabs: {server.megabytes:.0f} MB, {server.threads} threads, ", end="")
                print(f"{files} open files, {left} files on disk", flush=True)
                if done < tabs:
                    await leave(server, TOLD_EVERY)
        finally:
            server.stop()


async def leave(server: Server, tabs: int) -> None:
    """Let this many tabs draw a picture and leave."""
    for seed in range(0, tabs, AT_ONCE):
        several = min(AT_ONCE, tabs - seed)
        together = asyncio.Barrier(several)
        await asyncio.gather(*(pupil(server.address, seed + k, 0.0, together) for k in range(several)))


if __name__ == "__main__":
    asyncio.run(main(int(sys.argv[1]) if len(sys.argv) > 1 else 500))
