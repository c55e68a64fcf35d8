"""Compares two results for the same scans: which lines are kept, lost, gained, split and merged."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernel import entry_kernel, kernel
from ..scan import Recording
from ..segment import Extraction
from .result import Survey

KEPT, LOST, GAINED, SPLIT, MERGED = range(5)
FATES = ("kept", "lost", "gained", "split", "merged")


class Difference(NamedTuple):
    """What happened to the lines of A in B.

    fates_a (lines of A,), fates_b (lines of B,): indices into FATES, decided by the beams from first to last of each
    line. "split": a line of A that contains more than half of the beams of two or more lines of B, and these lines of
    B. "merged": a line of B that contains more than half of the beams of two or more lines of A, and these lines of A.
    "kept": of the rest, a pair whose intersection over union is more than one half. All others are lost (in A) or
    gained (in B).
    """

    fates_a: NDArray[np.int8]
    fates_b: NDArray[np.int8]

    @property
    def counts(self) -> dict[str, int]:
        """Numbers of lines of A kept, lost and split, and of lines of B gained and merged."""
        of_a, of_b = np.bincount(self.fates_a, minlength=5), np.bincount(self.fates_b, minlength=5)
        return {name: int((of_b if fate in (GAINED, MERGED) else of_a)[fate]) for fate, name in enumerate(FATES)}


def difference(a: Extraction, b: Extraction) -> Difference:
    """What happened in B to the lines of A, where A and B are two extractions from the same scan."""
    spans = [np.array([(s.first, s.last) for s in each.segments], np.int32).reshape(-1, 2) for each in (a, b)]
    found = Difference(np.empty(len(spans[0]), np.int8), np.empty(len(spans[1]), np.int8))
    _compare(*spans, len(a.labels), *found)
    return found


def differences(a: Survey, b: Survey, recording: Recording) -> NDArray[np.int32]:
    """(frames, 5) `counts` of every frame of a recording, in the order of FATES.

    Raises ValueError if the number of frames differs between the surveys and the recording.
    """
    if not len(a) == len(b) == len(recording):
        raise ValueError(
            f"the surveys have {len(a)} and {len(b)} frames, the recording {len(recording)}; use surveys of it"
        )
    counts = np.zeros((len(a), len(FATES)), np.int32)
    spans = [np.column_stack((each.segments["first"], each.segments["last"])) for each in (a, b)]
    most = [int(np.diff(each.offsets).max(initial=0)) for each in (a, b)]
    _count(*spans, a.offsets, b.offsets, np.diff(recording.offsets), np.empty((2, max(most)), np.int8), counts)
    return counts


@entry_kernel
def _count(a, b, offsets_a, offsets_b, beams, fates, counts):
    for frame in range(len(beams)):
        in_a, in_b = a[offsets_a[frame] : offsets_a[frame + 1]], b[offsets_b[frame] : offsets_b[frame + 1]]
        fates_a, fates_b = fates[0, : len(in_a)], fates[1, : len(in_b)]
        fates_of(in_a, in_b, beams[frame], fates_a, fates_b)
        for i in range(len(in_a)):
            counts[frame, fates_a[i]] += fates_a[i] != MERGED
        for j in range(len(in_b)):
            counts[frame, fates_b[j]] += (fates_b[j] == GAINED) | (fates_b[j] == MERGED)


@entry_kernel
def _compare(a, b, beams, fates_a, fates_b):
    fates_of(a, b, beams, fates_a, fates_b)


@kernel
def fates_of(a, b, beams, fates_a, fates_b):
    """Write the fates of lines; a (m, 2) and b (n, 2) are their first and last beams."""
    fates_a[:] = LOST
    fates_b[:] = GAINED
    for i in range(len(a)):
        for j in range(len(b)):
            common = shared_beams(a[i], b[j], beams)
            if 2 * common > length_of(a[i], beams) + length_of(b[j], beams) - common:
                fates_a[i] = fates_b[j] = KEPT
    for i in range(len(a)):
        mark(a[i], b, beams, fates_a[i : i + 1], fates_b, SPLIT)
    for j in range(len(b)):
        mark(b[j], a, beams, fates_b[j : j + 1], fates_a, MERGED)


@kernel
def mark(whole, parts, beams, fate, fates, name):
    """Set the fate of a line and of its parts, if it contains more than half of the beams of two or more lines."""
    inside = 0
    for k in range(len(parts)):
        inside += 2 * shared_beams(whole, parts[k], beams) > length_of(parts[k], beams)
    if inside < 2:
        return
    fate[0] = name
    for k in range(len(parts)):
        if 2 * shared_beams(whole, parts[k], beams) > length_of(parts[k], beams):
            fates[k] = name


@kernel
def length_of(line, beams):
    """Number of beams from the first to the last of a line, which may cross the seam."""
    return (line[1] - line[0]) % beams + 1


@kernel
def shared_beams(line, other, beams):
    """Number of beams that both lines share, on a circle of `beams`."""
    length, length_2 = length_of(line, beams), length_of(other, beams)
    ahead = (other[0] - line[0]) % beams
    return max(0, min(length, ahead + length_2) - ahead) + max(0, min(length, ahead + length_2 - beams))
