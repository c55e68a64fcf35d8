"""A whole recording at once: every frame, over all cores, in compact arrays."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arguments import need_recording, need_thresholds
from ..doubt import SCORES, Spans, score_frame, spans_of
from ..doubt.neighbours import VOTES, compare_frames, views_of
from ..kernel import entry_kernel, kernel
from ..knobs import Thresholds
from ..params import Params
from ..readers.source import Cancelled
from ..region_growing import Memory, extract_lines, limits_of
from ..region_growing.lines import DROPPED, LINE, Dropping
from ..region_growing.points import Points, unpacked
from ..scan import Recording
from .frame_by_frame import survey_stretch
from .geometry import geometry_of

# The fields are those of `Segment`; a frame's rows stand in the order of its `Extraction`.
SEGMENT = np.dtype(
    [
        *((name, np.float64) for name in ("a", "b", "c", "x1", "y1", "x2", "y2", "length")),
        ("rms", np.float32),
        *((name, np.int32) for name in ("first", "last", "points")),
    ]
)
# Scores for which the frame behind must be known.
BESIDE = ("brief", "gone", "jump", "jolt")
# A chunk is some milliseconds of work: long enough that Python costs nothing, short enough to share out evenly.
CHUNK_BEAMS = 200_000
# Less is not worth a thread.
LEAST_BEAMS = 20_000


@dataclass(frozen=True, eq=False)
class Survey:
    """What a method finds in every frame of a recording.

    segments: of SEGMENT, frame after frame; offsets: (frames + 1,) where the segments of each frame begin.
    scores: (frames, len(SCORES)) float32, a column for each of SCORES; None where they were not asked for. What takes
    many surveys is NaN, see `stability`.
    """

    params: Thresholds
    segments: NDArray[np.void]
    offsets: NDArray[np.int64]
    scores: NDArray[np.float32] | None

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, frame: int) -> NDArray[np.void]:
        """The segments of one frame."""
        if not -len(self) <= frame < len(self):
            raise IndexError(f"frame {frame} of a survey of {len(self)} frames")
        frame %= len(self)
        return self.segments[self.offsets[frame] : self.offsets[frame + 1]]

    def score(self, name: str) -> NDArray[np.float32]:
        """(frames,) one score of every frame; the names are those of SCORES."""
        if name not in SCORES:
            raise ValueError(f"there is no score {name!r}; there are {', '.join(SCORES)}")
        if self.scores is None:
            raise ValueError("this survey was made without scores")
        return self.scores[:, list(SCORES).index(name)]


def survey(
    recording: Recording,
    params: Thresholds | None = None,
    cancelled: NDArray[np.bool_] | None = None,
    scores: bool = True,
    progress: Callable[[int, int], None] | None = None,
    threads: int | None = None,
) -> Survey:
    """What `extract` finds in every frame by the method whose thresholds these are, and the scores of every frame.

    cancelled: (1,) bool; set it in another thread and the survey stops after the frame at hand, raising `Cancelled`.
    progress: called in the calling thread with (frames done, frames); what it raises comes through.
    threads: as many as there are cores without.
    Raises TypeError, which says what to pass, for anything but a Recording and thresholds.
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
    try:
        job.work(progress or (lambda done, total: None))
    finally:
        # Where the calling thread was stopped, there is nothing left to do for the others.
        job.waiting.clear()
        for helper in helpers:
            helper.join()
    if job.error is not None:
        raise job.error
    result = None if flag[0] else job.result(len(helpers) + 1)
    if result is None or flag[0]:
        raise Cancelled(f"the survey of {recording.name or 'a recording'} was stopped")
    return result


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Job:
    """Chunks of frames that wait for a thread, and what has come of them."""

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

    def work(self, progress: Callable[[int, int], None]) -> None:
        """Take chunk after chunk until none waits."""
        memory = Workspace(self.recording.beams[1])
        while not self.cancelled[0]:
            try:
                start, stop = self.waiting.popleft()
            except IndexError:
                return
            where = memory, self.cancelled, self.counts, self.scores
            if isinstance(self.params, Params):
                stretch = Stretch(self.recording, self.flat, start, stop, compared=self.scores is not None)
                self.segments[start] = stretch.run(self.params, *where)
            else:
                self.segments[start] = survey_stretch(self.recording, start, stop, self.params, *where)
            with self.lock:
                self.done += stop - start
            progress(self.done, len(self.counts))

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
        """The scores for which the frames on both sides must be known."""
        columns = [scores[:, list(SCORES).index(name)] for name in BESIDE]
        for column in columns:
            column[:] = 0

        views = views_of(self.recording)

        def compare(start: int, stop: int) -> None:
            compare_frames(segments, offsets, views, start, stop, np.empty(VOTES), *columns, self.cancelled)

        ends = np.linspace(0, len(self.counts), threads + 1).astype(int).tolist()
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(compare, ends[:-1], ends[1:]))


class Flat(NamedTuple):
    """A recording in arrays of one kind each: for every other kind a kernel would be compiled anew."""

    ranges: NDArray[np.floating]
    offsets: NDArray[np.int64]
    range_min: NDArray[np.float64]
    range_max: NDArray[np.float64]


def flattened(recording: Recording) -> Flat:
    return Flat(
        np.ascontiguousarray(recording.ranges),
        np.ascontiguousarray(recording.offsets, dtype=np.int64),
        np.array(recording.range_min, dtype=np.float64),
        np.array(recording.range_max, dtype=np.float64),
    )


class Stretch:
    """The frames start..stop − 1 of a recording, ready to be surveyed again and again.

    compared: whether the frame before comes along, with which the first is compared by its score.
    """

    def __init__(self, recording: Recording, flat: Flat, start: int, stop: int, compared: bool) -> None:
        lead = max(start - 1, 0) if compared else start
        self._scans = Scans(*flat, lead, *geometry_of(recording, lead, stop))
        self._start, self._stop = start, stop

    def run(
        self,
        params: Params,
        memory: Workspace,
        cancelled: NDArray[np.bool_],
        counts: NDArray[np.int64],
        scores: NDArray[np.float32] | None,
    ) -> NDArray[np.void]:
        """The segments of these frames, in an array of their own; counts and scores: of all frames, written to."""
        memory.spans.used[:] = -1
        scored = np.empty((0, len(SCORES)), np.float32) if scores is None else scores
        frame, used = self._scans.lead, 0
        while True:
            frame, used = survey_frames(
                self._scans, frame, self._start, self._stop, limits_of(params), *memory.arguments, *memory.spans,
                cancelled, memory.segments, used, counts, scored,
            )  # fmt: skip
            if frame == self._stop or cancelled[0]:
                return joined([memory.segments[:used]])
            memory.grow()


class Workspace(Memory):
    """What one thread writes to."""

    def __init__(self, beams: int) -> None:
        super().__init__(beams, circle=True)
        # Of the frame at hand and of the one before, in turns.
        self.spans = Spans(np.empty((2, beams + 1)), np.empty((2, beams + 1)), np.zeros(2, np.int64))
        self.segments = np.empty(max(4096, beams), SEGMENT)

    def grow(self) -> None:
        self.segments = joined([self.segments, np.empty_like(self.segments)])


def joined(parts: list[NDArray[np.void]]) -> NDArray[np.void]:
    """A new array of the same segments; copied field by field it would take ten times as long."""
    return np.concatenate([np.empty(0, np.uint8), *(part.view(np.uint8) for part in parts)]).view(SEGMENT)


def _chunks(offsets: NDArray[np.int64]) -> list[tuple[int, int]]:
    """(start, stop) of the frames of each chunk; there are enough for all cores, if there are enough frames."""
    frames, beams = len(offsets) - 1, int(offsets[-1])
    if frames < 1:
        return []
    count = max(-(-beams // CHUNK_BEAMS), min(4 * cores(), -(-beams // LEAST_BEAMS)), 1)
    ends = np.searchsorted(offsets, np.linspace(0, beams, count + 1)[1:-1], side="right") - 1
    ends = np.unique(np.concatenate(([0], ends, [frames])))
    return list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))


class Scans(NamedTuple):
    """A recording as the kernel takes it; place and circle begin with the frame `lead`."""

    ranges: NDArray[np.floating]
    offsets: NDArray[np.int64]
    range_min: NDArray[np.float64]
    range_max: NDArray[np.float64]
    lead: int
    bearings: NDArray[np.float64]
    rays: NDArray[np.float64]
    place: NDArray[np.int64]
    circle: NDArray[np.bool_]


@entry_kernel
def survey_frames(
    scans, frame, start, stop, limits, xy, numbers, lines, dropped, low, high, shown, cancelled, segments, used, counts,
    scores,
):  # fmt: skip
    """Extract and score the frames frame..stop − 1: (the first that is not done, number of segments written).

    A frame before `start` is only there to be compared with. It ends early when `cancelled` or `segments` is full.
    """
    rows, drops = lines.view(LINE), Dropping(dropped.view(DROPPED), numbers[3])
    fields = unpacked(limits)
    while frame < stop and not cancelled[0]:
        first, beams = scans.offsets[frame], scans.offsets[frame + 1] - scans.offsets[frame]
        place, circle = scans.place[frame - scans.lead], scans.circle[frame - scans.lead]
        rays = scans.rays[2 * place : 2 * (place + beams)].reshape((2, beams))
        count, _, n, returns = extract_lines(
            scans.ranges[first : first + beams], rays, scans.range_min[frame], scans.range_max[frame], circle,
            limits, xy, numbers, lines, dropped, None,
        )  # fmt: skip
        if used + count > len(segments):
            return frame, used
        m = 4 * n if circle else n
        points = Points(xy[0, :m], xy[1, :m], numbers[0, :m], numbers[1, :m], n if circle else 0, n, circle, returns)
        if frame >= start:
            counts[frame] = count
            write_segments(rows, count, points, beams, segments, used)
            used += count
        if len(scores) > 0:
            this, other = frame % 2, 1 - frame % 2
            now = Spans(low[this], high[this], shown[this : this + 1])
            before = Spans(low[other], high[other], shown[other : other + 1])
            spans_of(rows, count, points, scans.bearings[place : place + beams], now)
            if frame >= start:
                score_frame(rows, count, points, beams, fields, drops, now, before, scores[frame])
        frame += 1
    return frame, used


@kernel
def write_segments(lines, count, points, beams, segments, used):
    """Put lines down as segments, by their first beam: those that begin past the seam of a full circle come first."""
    past = 0
    while past < count and points.beam[lines[past].first] // beams == points.beam[lines[0].first] // beams:
        past += 1
    for i in range(count):
        line = lines[(past + i) % count]
        row = segments[used + i]
        row.a, row.b, row.c, row.rms = line.a, line.b, line.c, line.rms
        row.x1, row.y1, row.x2, row.y2, row.length = line.x1, line.y1, line.x2, line.y2, line.length
        row.first, row.last = points.beam[line.first] % beams, points.beam[line.last] % beams
        row.points = line.last - line.first + 1
