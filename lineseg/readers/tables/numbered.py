"""Long tables: a row for each beam of each scan, with the number of the beam and its range, but no angle."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np

from ...scan import Floats, Recording
from ..reading import Reading
from ..source import Source
from .beam_rows import table_of
from .dialect import Dialect, Row
from .headers import LENGTHS, SCANS, STAMPS, TIMES, Name, column_of, is_beam, is_distance
from .scan_rows import scans_of


def read_numbered(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name]
) -> Recording:
    """The scans of such a table: one ends where the number of the scan or the stamp changes, or beams begin anew."""
    beam, distance = column_of(names, is_beam), column_of(names, is_distance)
    assert beam is not None and distance is not None
    table = table_of(source, rows, dialect, names, (beam, distance))
    scan = column_of(names, lambda name: name.plain in SCANS)
    stamp = column_of(names, lambda name: name.plain in STAMPS)
    begins = np.diff(table[:, beam]) <= 0
    if scan is not None:
        begins |= np.diff(table[:, scan]) != 0
    edges = [0, *(np.flatnonzero(begins) + 1).tolist(), len(table)]
    parts = [table[start:stop] for start, stop in pairwise(edges)]
    first = int(np.nanmin(table[:, beam]))
    most = int(np.nanmax(table[:, beam])) - first + 1
    if most > max(MOST_BEAMS, len(table)):
        raise ValueError(
            f"{source.name}: column {beam + 1} numbers a beam {most + first - 1}; is it the beam's number?"
        )
    ranges: list[Floats] = [np.full(most, np.nan) for _ in parts]
    for row, part in zip(ranges, parts, strict=True):
        # A table may leave out the beams without a return.
        row[part[:, beam].astype(int) - first] = part[:, distance] * names[distance].scale
    if (unit := LENGTHS.get(names[distance].unit)) and reading.unit is None:
        source.notes.found["unit"] = unit
    leading: tuple[str, ...] = ()
    if stamp is not None and all(np.isfinite(part[0, stamp]) for part in parts):
        leading = ("stamp",)
        scale = TIMES.get(names[stamp].unit, 1.0)
        ranges = [np.concatenate(([part[0, stamp] * scale], row)) for row, part in zip(ranges, parts, strict=True)]
    return scans_of(source, reading, edges[:-1], ranges, 0, leading)


MOST_BEAMS = 20_000
