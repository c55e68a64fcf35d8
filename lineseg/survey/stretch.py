"""Region growing over consecutive frames: one kernel call for thousands of frames."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..doubt.scores import SCORES, Spans, score_frame, spans_of
from ..kernel import entry_kernel, kernel
from ..params import Params
from ..region_growing import Memory, extract_lines
from ..region_growing.limits import limits_of, unpacked
from ..region_growing.lines import DROPPED, LINE, Dropping
from ..region_growing.points import stored_points
from ..scan import Recording
from .geometry import geometry_of
from .result import SEGMENT, joined


class Flat(NamedTuple):
    """A recording in arrays of fixed types; other types would compile the kernel again."""

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

    compared: whether to include the previous frame, for comparing the first one with it.
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
        """The segments of these frames, in a new array; writes to `counts` and `scores`, which have all frames."""
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
    """The memory that one thread writes to."""

    def __init__(self, beams: int) -> None:
        super().__init__(beams, circle=True)
        # Alternately of this frame and of the previous one.
        self.spans = Spans(np.empty((2, beams + 1)), np.empty((2, beams + 1)), np.zeros(2, np.int64))
        self.segments = np.empty(max(4096, beams), SEGMENT)

    def grow(self) -> None:
        self.segments = joined([self.segments, np.empty_like(self.segments)])


class Scans(NamedTuple):
    """A recording as the kernel takes it; place and around start with the frame `lead`."""

    ranges: NDArray[np.floating]
    offsets: NDArray[np.int64]
    range_min: NDArray[np.float64]
    range_max: NDArray[np.float64]
    lead: int
    bearings: NDArray[np.float64]
    rays: NDArray[np.float64]
    place: NDArray[np.int64]
    around: NDArray[np.int64]


@entry_kernel
def survey_frames(
    scans, frame, start, stop, limits, xy, numbers, lines, dropped, low, high, shown, cancelled, segments, used, counts,
    scores,
):  # fmt: skip
    """Extract and score the frames frame..stop − 1: (first frame not done, number of segments written).

    A frame before `start` is only used for comparison. Ends early when `cancelled` is set or `segments` is full.
    """
    rows, drops = lines.view(LINE), Dropping(dropped.view(DROPPED), numbers[3])
    fields = unpacked(limits)
    while frame < stop and not cancelled[0]:
        first, beams = scans.offsets[frame], scans.offsets[frame + 1] - scans.offsets[frame]
        place, around = scans.place[frame - scans.lead], scans.around[frame - scans.lead]
        rays = scans.rays[2 * place : 2 * (place + beams)].reshape((2, beams))
        count, _, n, returns = extract_lines(
            scans.ranges[first : first + beams], rays, scans.range_min[frame], scans.range_max[frame], around,
            limits, xy, numbers, lines, dropped, None,
        )  # fmt: skip
        if used + count > len(segments):
            return frame, used
        points = stored_points(xy, numbers, n, around, returns)
        if frame >= start:
            counts[frame] = count
            write_segments(rows, count, points, max(around, beams), segments, used)
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
def write_segments(lines, count, points, around, segments, used):
    """Write lines as segments, ordered by first beam: those that start past the seam of a full circle come first."""
    past = 0
    while past < count and points.beam[lines[past].first] // around == points.beam[lines[0].first] // around:
        past += 1
    for i in range(count):
        line = lines[(past + i) % count]
        row = segments[used + i]
        row.a, row.b, row.c, row.rms = line.a, line.b, line.c, line.rms
        row.x1, row.y1, row.x2, row.y2, row.length = line.x1, line.y1, line.x2, line.y2, line.length
        row.first, row.last = points.beam[line.first] % around, points.beam[line.last] % around
        row.points = line.last - line.first + 1
