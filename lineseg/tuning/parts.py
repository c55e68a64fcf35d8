"""The split of frames into those for tuning and those held back for judging, and the lines they are compared with."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Literal, Protocol

import numpy as np

from ..params import Params
from ..readers import Reading
from ..scan import Recording
from ..sweep.chunks import Chunk, Source, Task, describe, measure_task, opened
from ..sweep.measure import Batch
from ..sweep.totals import Totals
from ..sweep.workers import Pool
from .judge import judge_of

# Blocks per recording; every other one is held back. A block is a stretch of time, since neighbouring frames are alike.
BLOCKS = 20
Split = Literal["frames", "files"]


class Blocks(Protocol):
    """Stretches of frames that can be measured with a setting.

    truth: whether they are compared with true lines; otherwise they are with those of `judge_of`.
    """

    @property
    def train(self) -> Sequence[int]: ...
    @property
    def held_back(self) -> Sequence[int]: ...
    @property
    def frames(self) -> Sequence[int]: ...
    @property
    def truth(self) -> bool: ...
    @property
    def name(self) -> str: ...

    def totals(self, params: Params, which: Sequence[int]) -> list[Totals]:
        """The totals of each of these blocks."""
        ...


def stretches(frames: int, blocks: int, most: int | None) -> list[tuple[int, int]]:
    """(start, stop) of blocks spread over a recording, with `most` frames in total (default: all)."""
    blocks = max(1, min(blocks, frames // 2))
    ends = np.linspace(0, frames, blocks + 1).round().astype(int)
    share = -(-frames // blocks) if most is None else max(2, most // blocks)
    return [(start, min(start + share, stop)) for start, stop in pairwise(ends.tolist())]


class RecordingBlocks:
    """Blocks of a recording in memory.

    blind: compare with the lines of the judge, even if the truth is known; base: thresholds with their P_min and L_min.
    """

    def __init__(
        self, recording: Recording, workers: Pool, blind: bool, most: int | None = None, base: Params | None = None
    ) -> None:
        spans = stretches(len(recording), BLOCKS, most)
        if len(spans) < 2:
            raise ValueError("auto-tuning needs 4 or more frames: some to learn from, some to judge it by")
        self.train, self.held_back = range(0, len(spans), 2), range(1, len(spans), 2)
        self.frames = [stop - start for start, stop in spans]
        self.truth = not blind and recording.wall is not None
        self.name = recording.name
        self._workers = workers
        judge = judge_of(recording, base) if blind else None
        self._batches = [
            Batch(recording.only(np.arange(start, stop)), scored=False, judge=judge) for start, stop in spans
        ]

    def totals(self, params: Params, which: Sequence[int]) -> list[Totals]:
        tasks = [(self._batches[block], params) for block in which]
        return [Totals(sums) for _, sums in sorted(self._workers.results(_measure, tasks), key=lambda row: row[0])]


def _measure(task: tuple[Batch, Params]) -> np.ndarray:
    batch, params = task
    return batch.measure([params]).sums[0]


class FileBlocks:
    """Blocks of files, opened by the workers; split: whether every other block or every other file is held back.

    blind: compare with the lines of a judge for each file, even if the truth is known; None: only if a file has
    no truth, not even by many views. base: thresholds with their P_min and L_min. sources: the files as they are read.
    """

    def __init__(
        self,
        files: Sequence[Path],
        workers: Pool,
        blind: bool | None,
        split: Split = "frames",
        reading: Reading | None = None,
        most: int | None = None,
        base: Params | None = None,
    ) -> None:
        if split == "files" and len(files) < 2:
            raise ValueError("splitting by files needs two or more files; split by frames instead")
        reading = reading or Reading()
        if blind and reading.walls is None:
            reading = reading.but(walls="none")
        places = [(str(Path(file).absolute()), reading) for file in files]
        self.sources = sources = [
            source for _, source in sorted(workers.results(describe, places), key=lambda row: row[0])
        ]
        self._chunks: list[Chunk] = []
        owner: list[int] = []
        for number, source in enumerate(sources):
            share = None if most is None else most // len(sources)
            spans = stretches(source.frames, BLOCKS, share) if source.frames else []
            self._chunks += [Chunk(source, start, stop) for start, stop in spans]
            owner += [number] * len(spans)
        side = [number % 2 if split == "files" else k % 2 for k, number in enumerate(owner)]
        self.train = [k for k, half in enumerate(side) if half == 0]
        self.held_back = [k for k, half in enumerate(side) if half == 1]
        if not self.train or not self.held_back:
            raise ValueError("auto-tuning needs 4 or more frames: some to learn from, some to judge it by")
        self.frames = [chunk.stop - chunk.start for chunk in self._chunks]
        known = all(source.truth for source in sources)
        self.name = ", ".join(Path(source.file).name for source in sources)
        blind = not known if blind is None else blind
        self.truth = known and not blind
        tasks = [(source, base) for source in sources] if blind else []
        judges = dict(workers.results(_judge, tasks))
        self._workers, self._judges = workers, [judges.get(number) for number in owner]

    def totals(self, params: Params, which: Sequence[int]) -> list[Totals]:
        tasks = [Task(self._chunks[block], (params,), False, self._judges[block]) for block in which]
        found = sorted(self._workers.results(measure_task, tasks), key=lambda row: row[0])
        return [Totals(sums[0]) for _, sums in found]


def _judge(task: tuple[Source, Params | None]) -> Params | None:
    source, base = task
    return judge_of(opened(source), base) if source.frames else None
