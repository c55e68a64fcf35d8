"""Slow work in threads of its own, so that no other request waits for it."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from starlette.exceptions import HTTPException

P = ParamSpec("P")
T = TypeVar("T")


class SlowWork:
    """One kind of slow work. what: its plural, for the sentence; seconds: how long a request waits for it.

    Work counts until it has really ended, also if nobody waits for it any more.
    """

    def __init__(self, what: str, at_once: int, seconds: float) -> None:
        self._what = what
        self._at_once = at_once
        self._seconds = seconds
        self._running = 0

    @property
    def running(self) -> int:
        return self._running

    async def run(self, work: Callable[P, T], *arguments: P.args, **options: P.kwargs) -> T:
        """The result of the work. Answers 429 if too much of it is under way, 504 if it takes too long."""
        done = self.start(work, *arguments, **options)
        await asyncio.wait([done], timeout=self._seconds)
        if not done.done():
            done.add_done_callback(lambda late: late.exception())
            raise HTTPException(504, f"this took longer than {self._seconds:g} s; try again later")
        return done.result()

    def start(self, work: Callable[P, T], *arguments: P.args, **options: P.kwargs) -> asyncio.Future[T]:
        """Start the work. Answers 429 if too much of it is under way."""
        if self._running >= self._at_once:
            raise HTTPException(429, f"{self._at_once} {self._what} are under way; wait for one of them to finish")
        self._running += 1
        loop = asyncio.get_running_loop()
        done: asyncio.Future[T] = loop.create_future()

        def finish(result: T | None, error: BaseException | None) -> None:
            self._running -= 1
            if done.cancelled():
                return
            if error is not None:
                done.set_exception(error)
            else:
                done.set_result(result)  # pyright: ignore[reportArgumentType]

        def run() -> None:
            outcome: tuple[Any, BaseException | None]
            try:
                outcome = work(*arguments, **options), None
            except Exception as error:
                outcome = None, error
            # The server may have stopped.
            with contextlib.suppress(RuntimeError):
                loop.call_soon_threadsafe(finish, *outcome)

        threading.Thread(target=run, name=self._what, daemon=True).start()
        return done
