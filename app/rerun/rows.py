"""Rows of one entity for many frames, sent in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import rerun as rr
from numpy.typing import NDArray

# Later stamps are seconds since 1970, which rerun shows as a date; earlier ones come from some other clock.
A_DATE = 1e8


class Moments(NamedTuple):
    """Positions of rows on each timeline, (rows,) each; None: not on this timeline."""

    frame: NDArray[np.int64] | None = None
    stamp: NDArray[np.float64] | None = None
    step: NDArray[np.int64] | None = None

    def of_decisions(self, indices: Sequence[NDArray[np.intp]]) -> Moments:
        """The moments of decisions, from those of frames; indices: of the decisions of each frame, one step each."""
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
    """Send a row for each moment, with any number of points or strips.

    values: (rows,) each; the values of one row have the same length.
    """
    counts = list(map(len, next(iter(values.values()))))
    joined = {name: np.concatenate(parts) for name, parts in values.items()}
    stream.send_columns(entity, times(moments), columns(**joined).partition(counts))


def times(moments: Moments) -> list[rr.TimeColumn]:
    """A column for each timeline that is used."""
    columns = []
    if moments.frame is not None:
        columns.append(rr.TimeColumn("frame", sequence=moments.frame))
    if moments.stamp is not None:
        kind = "timestamp" if moments.stamp[0] > A_DATE else "duration"
        columns.append(rr.TimeColumn("stamp", **{kind: moments.stamp}))
    if moments.step is not None:
        columns.append(rr.TimeColumn("step", sequence=moments.step))
    return columns
