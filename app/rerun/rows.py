"""Rows of one entity, gathered so that many frames cross into rerun in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import rerun as rr

# Stamps later than this are seconds since 1970, by which rerun shows a date; earlier ones are a clock of their own.
A_DATE = 1e8


class Moment(NamedTuple):
    """Where a row stands on each timeline; None: not on this one."""

    frame: int | None = None
    stamp: float | None = None
    step: int | None = None


class Rows:
    """Rows of `entity`: each holds any number of points, strips or texts, at a moment."""

    def __init__(self, entity: str, columns: Callable[..., Any]) -> None:
        self._entity, self._columns = entity, columns
        self._moments: list[Moment] = []
        self._parts: list[dict[str, Any]] = []

    def add(self, moment: Moment, **values: Any) -> None:
        """values: of one row, all of the same length."""
        self._moments.append(moment)
        self._parts.append(values)

    def send(self, stream: rr.RecordingStream) -> None:
        """Send what was gathered, and gather anew."""
        if self._parts:
            counts = [len(next(iter(part.values()))) for part in self._parts]
            values = {name: np.concatenate([part[name] for part in self._parts]) for name in self._parts[0]}
            stream.send_columns(self._entity, times(self._moments), self._columns(**values).partition(counts))
        self._moments, self._parts = [], []


def times(moments: list[Moment]) -> list[rr.TimeColumn]:
    """A column for each timeline that the first moment, and so every one, stands on."""
    columns = []
    for name, values in zip(Moment._fields, zip(*moments, strict=True), strict=True):
        if values[0] is None:
            continue
        if name != "stamp":
            columns.append(rr.TimeColumn(name, sequence=values))
        elif values[0] > A_DATE:
            columns.append(rr.TimeColumn(name, timestamp=np.array(values)))
        else:
            columns.append(rr.TimeColumn(name, duration=np.array(values)))
    return columns
