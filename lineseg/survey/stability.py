"""How much the segments of a recording depend on the exact thresholds: each is varied a little, up and down."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..doubt.scores import CHANGE_OF_THRESHOLD, SCORES
from ..kernel import entry_kernel, kernel
from ..knobs import Thresholds
from ..scan import Recording
from .result import Survey
from .threads import survey


def variations(params: Thresholds) -> Iterator[tuple[str, Thresholds]]:
    """(threshold, varied `params`) for each threshold, up and down by CHANGE_OF_THRESHOLD, whole numbers by 1 or more.

    Values that are not allowed or change nothing are left out.
    """
    for name, kind, knob in params.knobs():
        value = getattr(params, name)
        by = CHANGE_OF_THRESHOLD * value if kind is float else max(1, round(CHANGE_OF_THRESHOLD * value))
        for moved in (value - by, value + by):
            if knob.least <= moved <= knob.most and moved != value:
                yield name, params.but(**{name: moved})


def changes(
    recording: Recording, base: Survey, cancelled: NDArray[np.bool_] | None = None, threads: int | None = None
) -> Iterator[tuple[str, Thresholds, NDArray[np.int32]]]:
    """(threshold, params, (frames,) number of segments that appear or disappear) for each variation of a survey.

    A segment stays if the intersection over union of its beams with some segment of the other survey exceeds one half.
    """
    beams = np.diff(recording.offsets)
    for name, params in variations(base.params):
        moved = survey(recording, params, cancelled, scores=False, threads=threads)
        count = np.zeros(len(base), np.int32)
        count_changes(base.segments, base.offsets, moved.segments, moved.offsets, beams, count)
        yield name, params, count


def with_stability(
    recording: Recording,
    base: Survey,
    cancelled: NDArray[np.bool_] | None = None,
    progress: Callable[[int, int], None] | None = None,
    threads: int | None = None,
) -> Survey:
    """The survey with its last score, "unstable", filled in. Needs a survey for each variation; see `survey`.

    Raises ValueError for a survey without scores, `Cancelled` when stopped.
    """
    scores = base.need_scores().copy()
    total = sum(1 for _ in variations(base.params))
    most = np.zeros(len(base), np.int32)
    for done, (_, _, count) in enumerate(changes(recording, base, cancelled, threads)):
        np.maximum(most, count, out=most)
        if progress is not None:
            progress(done + 1, total)
    scores[:, list(SCORES).index("unstable")] = most
    return replace(base, scores=scores)


@entry_kernel
def count_changes(segments, offsets, others, other_offsets, beams, count):
    """Number of segments without a counterpart, in both surveys, for each frame."""
    for frame in range(len(count)):
        here = segments[offsets[frame] : offsets[frame + 1]]
        there = others[other_offsets[frame] : other_offsets[frame + 1]]
        # No segment has two counterparts.
        count[frame] = len(here) + len(there) - 2 * pairs_in(here, there, beams[frame])


@kernel
def pairs_in(here, there, beams):
    pairs, start = 0, 0
    for i in range(len(here)):
        first, last = here[i].first, here[i].last
        last += beams if last < first else 0
        while start < len(there) and first > there[start].last >= there[start].first:
            start += 1
        j = start
        while j < len(there) and there[j].first <= last:
            pairs += is_same(first, last, there[j], 0, beams)
            j += 1
        if len(there) > 0:
            # A segment across the seam is last, but its counterpart may not be.
            pairs += is_same(first, last, there[0], beams, beams)
            pairs += is_same(first, last, there[len(there) - 1], -beams, beams)
    return pairs


@kernel
def is_same(first, last, other, turn, beams):
    first_2, last_2 = other.first + turn, other.last + turn
    last_2 += beams if other.last < other.first else 0
    shared = min(last, last_2) - max(first, first_2) + 1
    return 2 * shared > max(last, last_2) - min(first, first_2) + 1
