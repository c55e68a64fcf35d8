"""The work of one worker: open a recording, take some of its frames, and sum them up for some settings."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..params import Params
from ..readers import Reading, open_recording
from ..readers.walling import with_walls_if_any
from ..scan import Recording
from .measure import Batch

# About a second of work per task: long enough to hide the cost of sending it, short enough to lose.
CHUNK_BEAMS = 1_000_000
BLOCK_SETTINGS = 64
# Auto-tuning reads every chunk again in every trial.
BATCHES_KEPT = 64

_reading = threading.Lock()


@dataclass(frozen=True)
class Source:
    """A file as it is read, at one moment; beams, frames: its size.

    truth: whether it has one, if need be by many views; by_views: what is said of that one, or why there is none, ""
    where nothing is.
    """

    file: str
    reading: Reading
    changed: int
    size: int
    frames: int
    beams: int
    truth: bool
    by_views: str = ""

    def chunks(self) -> list[Chunk]:
        """All frames, in chunks of about CHUNK_BEAMS beams."""
        count = min(max(1, round(self.beams / CHUNK_BEAMS)), max(self.frames, 1))
        ends = np.linspace(0, self.frames, count + 1).round().astype(int).tolist()
        return [Chunk(self, start, stop) for start, stop in pairwise(ends) if stop > start]


@dataclass(frozen=True)
class Chunk:
    """The frames start..stop − 1 of a source."""

    source: Source
    start: int
    stop: int


@dataclass(frozen=True)
class Task:
    """A chunk and some settings; scored, judge: see `Batch`."""

    chunk: Chunk
    settings: tuple[Params, ...]
    scored: bool
    judge: Params | None = None


def describe(place: tuple[str, Reading]) -> Source:
    """The description of a file, read on this machine."""
    file, reading = place
    status = Path(file).stat()
    recording, by_views = _opened(file, reading, status.st_mtime_ns, status.st_size)
    size = len(recording), int(recording.offsets[-1])
    truth = recording.wall is not None, by_views
    return Source(file, reading, status.st_mtime_ns, status.st_size, *size, *truth)


def measure_task(task: Task) -> NDArray[np.float64]:
    """The sums of a task, (settings, len(COLUMNS)). Raises ValueError if the file has changed."""
    source = task.chunk.source
    status = Path(source.file).stat()
    if (status.st_mtime_ns, status.st_size) != (source.changed, source.size):
        raise ValueError(f"{source.file} has changed since the sweep began, or differs on this machine; start again")
    with _reading:
        batch = _batch(task.chunk, task.scored, task.judge)
    return batch.measure(task.settings).sums


@lru_cache(maxsize=BATCHES_KEPT)
def _batch(chunk: Chunk, scored: bool, judge: Params | None) -> Batch:
    source = chunk.source
    lead = scored and chunk.start > 0
    return Batch(opened(source).only(np.arange(chunk.start - lead, chunk.stop)), scored, lead, judge)


def opened(source: Source) -> Recording:
    """The recording of a source."""
    return _opened(source.file, source.reading, source.changed, source.size)[0]


@lru_cache(maxsize=2)
def _opened(file: str, reading: Reading, changed: int, size: int) -> tuple[Recording, str]:
    return with_walls_if_any(open_recording(Path(file), reading))
