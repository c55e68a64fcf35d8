"""Runs tasks on the threads of this machine or on a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import contextmanager
from itertools import islice
from typing import Any, Protocol, TypeVar

from ..installation import install_command
from ..survey import cores

T = TypeVar("T")
R = TypeVar("R")
# Tasks per worker in its queue; more would only fill memory.
WAITING = 3
CONNECT_SECONDS = 10


class Pool(Protocol):
    def results(self, work: Callable[[T], R], tasks: Iterable[T]) -> Iterator[tuple[int, R]]:
        """(number of the task, its result) in order of completion; takes tasks as needed."""
        ...


@contextmanager
def pool(scheduler: str | None = None) -> Iterator[Pool]:
    """Threads, or the workers of the Dask scheduler at an address such as tcp://host:8786.

    Raises OSError if the scheduler cannot be reached or has no workers.
    """
    if scheduler is None:
        with ThreadPoolExecutor(cores(), thread_name_prefix="sweep") as threads:
            try:
                yield _Threads(threads)
            finally:
                threads.shutdown(cancel_futures=True)
        return
    with _connected(scheduler) as client:
        yield _Cluster(client, scheduler)


class _Threads:
    def __init__(self, threads: ThreadPoolExecutor) -> None:
        self._threads = threads

    def results(self, work: Callable[[T], R], tasks: Iterable[T]) -> Iterator[tuple[int, R]]:
        numbered = iter(enumerate(tasks))
        running: dict[Any, int] = {}
        while True:
            for number, task in islice(numbered, WAITING * cores() - len(running)):
                running[self._threads.submit(work, task)] = number
            if not running:
                return
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(done), done.result()


class _Cluster:
    def __init__(self, client: Any, scheduler: str) -> None:
        self._client, self._scheduler = client, scheduler

    def results(self, work: Callable[[T], R], tasks: Iterable[T]) -> Iterator[tuple[int, R]]:
        from distributed import as_completed
        from distributed.scheduler import KilledWorker

        numbered = iter(enumerate(tasks))
        done: Any = as_completed(loop=self._client.loop)
        numbers: dict[str, int] = {}

        def send() -> None:
            for number, task in islice(numbered, max(1, WAITING * self._threads() - len(numbers))):
                # Not pure: Dask would hash the content of each task, and would never run a repeated sweep.
                future = self._client.submit(work, task, pure=False)
                numbers[future.key] = number
                done.add(future)

        send()
        while numbers:
            future = next(done)
            try:
                result = future.result()
            except KilledWorker as error:
                raise OSError(f"a task crashed every worker of {self._scheduler} that ran it: {error}") from None
            yield numbers.pop(future.key), result
            future.release()
            send()

    def _threads(self) -> int:
        return sum(self._client.nthreads().values())


@contextmanager
def _connected(scheduler: str) -> Iterator[Any]:
    try:
        from distributed import Client
    except ImportError:
        raise ValueError(f"a scheduler needs Dask; `{install_command('cluster')}` installs it") from None
    try:
        client = Client(scheduler, timeout=CONNECT_SECONDS, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        raise OSError(
            f"{scheduler}: no Dask scheduler answers there ({_first_line(error)}); start one with `dask scheduler`, "
            "which prints its address"
        ) from None
    with client:
        if not client.nthreads():
            raise OSError(f"{scheduler}: the scheduler has no workers; start one with `dask worker {scheduler}`")
        yield client


def _first_line(error: BaseException) -> str:
    return next(iter(str(error).splitlines()), "").rstrip(".") or type(error).__name__
