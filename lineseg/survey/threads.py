"""The survey of a recording, distributed over all cores."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording, need_thresholds
from ..doubt import SCORES
from ..doubt.neighbours import VOTES, compare_frames, views_of
from ..knobs import Thresholds
from ..params import Params
from ..readers.source import Cancelled
from ..scan import Recording
from .frame_by_frame import survey_stretch
from .result import Survey, joined
from .stretch import Stretch, Workspace, flattened

# Scores that need the next frame.
BESIDE = ("brief", "gone", "jump", "jolt", "turn")
# A chunk takes a few milliseconds: long enough to hide the cost of Python, short enough to balance the threads.
CHUNK_BEAMS = 200_000
# Smaller recordings are not worth another thread.
LEAST_BEAMS = 20_000


def survey(
    recording: Recording,
    params: Thresholds | None = None,
    cancelled: NDArray[np.bool_] | None = None,
    scores: bool = True,
    progress: Callable[[int, int], None] | None = None,
    threads: int | None = None,
) -> Survey:
    """The result of `extract` for every frame, and its scores. The type of the thresholds selects the method.

    cancelled: (1,) bool; set it in another thread to stop after the current frame with `Cancelled`.
    progress: called in the calling thread with (frames done, frames); its exceptions are passed on.
    threads: number of threads; default: one per core.
    Raises TypeError for arguments of the wrong type.
    """
    need_recording(recording)
    params = Params() if params is None else params
    need_thresholds(params)
    flag = np.zeros(1, np.bool_) if cancelled is None else cancelled
    job = _Job(recording, params, flag, scores)
    helpers = [
        threading.Thread(target=job.help, daemon=True) for _ in range(min(threads or cores(), len(job.waiting)) - 1)
    ]
    for helper in helpers:
        helper.start()
    told = 0
    try:
        told = job.work(progress or (lambda done, total: None))
    finally:
        # If the calling thread was stopped, the others can stop too.
        job.waiting.clear()
        for helper in helpers:
            helper.join()
    if job.error is not None:
        raise job.error
    if progress is not None and told < len(recording) and not flag[0]:
        # The others have done the rest, or all of it.
        progress(len(recording), len(recording))
    result = None if flag[0] else job.result(len(helpers) + 1)
    if result is None or flag[0]:
        raise Cancelled(f"the survey of {recording.name or 'a recording'} was stopped")
    return result


def cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Job:
    """The queue of chunks of frames, and their results."""

    def __init__(self, recording: Recording, params: Thresholds, cancelled: NDArray[np.bool_], scored: bool) -> None:
        self.recording, self.params, self.cancelled = recording, params, cancelled
        self.flat = flattened(recording)
        frames = len(recording)
        self.counts = np.zeros(frames, np.int64)
        self.scores = np.full((frames, len(SCORES)), np.nan, np.float32) if scored else None
        self.waiting = deque(_chunks(self.flat.offsets))
        self.segments: dict[int, NDArray[np.void]] = {}
        self.done, self.lock = 0, threading.Lock()
        self.error: BaseException | None = None

    def help(self) -> None:
        try:
            self.work(lambda done, total: None)
        except BaseException as error:
            self.error = error
            self.waiting.clear()

    def work(self, progress: Callable[[int, int], None]) -> int:
        """Work on chunks until the queue is empty; return the number of frames that progress was last told of."""
        memory, told = Workspace(self.recording.beams[1]), 0
        while not self.cancelled[0]:
            try:
                start, stop = self.waiting.popleft()
            except IndexError:
                break
            where = memory, self.cancelled, self.counts, self.scores
            if isinstance(self.params, Params):
                stretch = Stretch(self.recording, self.flat, start, stop, compared=self.scores is not None)
                self.segments[start] = stretch.run(self.params, *where)
            else:
                self.segments[start] = survey_stretch(self.recording, start, stop, self.params, *where)
            with self.lock:
                self.done += stop - start
                told = self.done
            progress(told, len(self.counts))
        return told

    def result(self, threads: int) -> Survey:
        parts = [self.segments[start] for start in sorted(self.segments)]
        segments = joined(parts)
        offsets = np.concatenate(([0], np.cumsum(self.counts)))
        if self.scores is not None:
            self._compare(segments, offsets, self.scores, threads)
        return Survey(self.params, segments, offsets, self.scores)

    def _compare(
        self, segments: NDArray[np.void], offsets: NDArray[np.int64], scores: NDArray[np.float32], threads: int
    ) -> None:
        """Compute the scores that need the previous and the next frame."""
        columns = [scores[:, list(SCORES).index(name)] for name in BESIDE]
        for column in columns:
            column[:] = 0

        views = views_of(self.recording)

        def compare(start: int, stop: int) -> None:
            compare_frames(segments, offsets, views, start, stop, np.empty(VOTES), *columns, self.cancelled)

        if threads == 1:
            compare(0, len(self.counts))
            return
        ends = np.linspace(0, len(self.counts), threads + 1).astype(int).tolist()
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(compare, ends[:-1], ends[1:]))


def _chunks(offsets: NDArray[np.int64]) -> list[tuple[int, int]]:
    """(start, stop) frames of each chunk; at least one chunk per core if there are enough frames."""
    frames, beams = len(offsets) - 1, int(offsets[-1])
    if frames < 1:
        return []
    count = max(-(-beams // CHUNK_BEAMS), min(4 * cores(), -(-beams // LEAST_BEAMS)), 1)
    ends = np.searchsorted(offsets, np.linspace(0, beams, count + 1)[1:-1], side="right") - 1
    ends = np.unique(np.concatenate(([0], ends, [frames])))
    return list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))
