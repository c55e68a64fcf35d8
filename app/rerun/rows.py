"""Rows of one entity, many frames of them in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import rerun as rr
from numpy.typing import NDArray

# Stamps later than this are seconds since 1970, by which rerun shows a date; earlier ones are a clock of their own.
A_DATE = 1e8


class Moments(NamedTuple):
    """Where rows stand on each timeline, (rows,) each; None: not on this one."""

    frame: NDArray[np.int64] | None = None
    stamp: NDArray[np.float64] | None = None
    step: NDArray[np.int64] | None = None

    def of_decisions(self, indices: Sequence[NDArray[np.intp]]) -> Moments:
        """Of decisions, where these are of the frames they are in; indices: of each frame, each a step."""
        counts = [len(each) for each in indices]
        begun = {name: np.repeat(values, counts) for name, values in self._asdict().items() if values is not None}
        if self.step is not None:
            begun["step"] += np.concatenate(indices)
        return Moments(**begun)


def send_rows(
    stream: rr.RecordingStream,
    entity: str,
    moments: Moments,
    columns: Callable[..., rr.ComponentColumnList],
    **values: Sequence[NDArray],
) -> None:
    """Send a row for each moment, which holds any number of points or strips.

    values: (rows,) each; those of one row are of the same length.
    """
    counts = list(map(len, next(iter(values.values()))))
    joined = {name: np.concatenate(parts) for name, parts in values.items()}
    stream.send_columns(entity, times(moments), columns(**joined).partition(counts))


def times(moments: Moments) -> list[rr.TimeColumn]:
    """A column for each timeline that the rows stand on."""
    columns = []
    if moments.frame is not None:
        columns.append(rr.TimeColumn("frame", sequence=moments.frame))
    if moments.stamp is not None:
        kind = "timestamp" if moments.stamp[0] > A_DATE else "duration"
        columns.append(rr.TimeColumn("stamp", **{kind: moments.stamp}))
    if moments.step is not None:
        columns.append(rr.TimeColumn("step", sequence=moments.step))
    return columns
