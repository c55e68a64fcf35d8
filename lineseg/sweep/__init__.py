"""Many recordings under many settings, on one machine or many: grid → tasks → sums → measures (README.md)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..readers import Reading
from .axes import MOST_SETTINGS, Grid, axis_values, slider_values
from .chunks import BLOCK_SETTINGS, Source, Task, describe, measure_task
from .journal import Journal
from .measure import Batch
from .totals import COLUMNS, MEASURES, Totals
from .workers import Pool, pool

__all__ = [
    "MEASURES", "Batch", "Grid", "Journal", "Sweep", "Totals", "axis_values", "pool", "slider_values", "sweep",
]  # fmt: skip


@dataclass(frozen=True, eq=False)
class Sweep:
    """The totals of every setting of a grid for every file; totals: (files, settings), see `Totals`."""

    grid: Grid
    sources: tuple[Source, ...]
    totals: Totals

    @property
    def all_files(self) -> Totals:
        """(settings,) totals over the frames of all files."""
        return Totals(self.totals.sums.sum(axis=0))


def sweep(
    files: Sequence[Path],
    grid: Grid,
    workers: Pool,
    reading: Reading | None = None,
    journal: Journal | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Sweep:
    """Measure every setting on every frame of every file.

    Workers open the files, so a cluster must find them at the same paths. Sums are added in the order of the frames,
    so the result does not depend on the workers.
    journal: finished work that is not computed again. progress: called with (frames × settings done, total).
    """
    places = [(str(Path(file).absolute()), reading or Reading()) for file in files]
    if len(grid) * len(places) > MOST_SETTINGS:
        raise ValueError(
            f"{len(grid):,} settings for {len(places)} files exceed the {MOST_SETTINGS:,} sums that fit in memory; "
            "give fewer values or fewer files"
        )
    sources = tuple(source for _, source in sorted(workers.results(describe, places), key=lambda found: found[0]))
    for source in sources:
        if not source.frames:
            raise ValueError(f"{source.file} has no scans; leave it out")
    totals = np.zeros((len(sources), len(grid), len(COLUMNS)))
    work = sum(source.frames for source in sources) * len(grid)
    done = 0
    adding = _InOrder(totals)
    for place, task, sums in _done_tasks(_tasks(sources, grid), workers, journal):
        adding.add(place, sums)
        done += (task.chunk.stop - task.chunk.start) * len(task.settings)
        progress(done, work)
    return Sweep(grid, sources, Totals(totals))


@dataclass(frozen=True)
class _Place:
    """Where the sums of a task belong: the file, the settings, and the number of the chunk."""

    file: int
    start: int
    chunk: int


def _tasks(sources: Sequence[Source], grid: Grid) -> Iterator[tuple[_Place, Task]]:
    for file, source in enumerate(sources):
        for number, chunk in enumerate(source.chunks()):
            settings = iter(grid)
            start = 0
            while block := tuple(islice(settings, BLOCK_SETTINGS)):
                yield _Place(file, start, number), Task(chunk, block, scored=True)
                start += len(block)


def _done_tasks(
    tasks: Iterator[tuple[_Place, Task]], workers: Pool, journal: Journal | None
) -> Iterator[tuple[_Place, Task, NDArray[np.float64]]]:
    """Each task with its sums, from the journal or from the workers."""
    sent: list[tuple[_Place, Task, Task, dict] | None] = []
    known_already: list[tuple[_Place, Task, NDArray[np.float64]]] = []

    def missing() -> Iterator[Task]:
        for place, task in tasks:
            known = journal.known(task) if journal else {}
            rest = Task(task.chunk, tuple(params for params in task.settings if params not in known), task.scored)
            if rest.settings:
                sent.append((place, task, rest, known))
                yield rest
            else:
                known_already.append((place, task, np.array([known[params] for params in task.settings])))

    for number, sums in workers.results(measure_task, missing()):
        entry = sent[number]
        assert entry is not None
        place, task, rest, known = entry
        sent[number] = None
        if journal:
            journal.add(rest, sums)
        known = known | dict(zip(rest.settings, sums, strict=True))
        yield place, task, np.array([known[params] for params in task.settings])
        yield from known_already
        known_already.clear()
    yield from known_already


class _InOrder:
    """Adds the sums of each file and block of settings in chunk order, because floating-point sums depend on order."""

    def __init__(self, totals: NDArray[np.float64]) -> None:
        self._totals = totals
        self._next: dict[tuple[int, int], int] = {}
        self._early: dict[_Place, NDArray[np.float64]] = {}

    def add(self, place: _Place, sums: NDArray[np.float64]) -> None:
        self._early[place] = sums
        block = place.file, place.start
        while (early := self._early.pop(_Place(*block, self._next.get(block, 0)), None)) is not None:
            self._totals[place.file, place.start : place.start + len(early)] += early
            self._next[block] = self._next.get(block, 0) + 1
