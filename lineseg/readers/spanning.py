"""Scans that span several lines, each with a few of their ranges, as programs wrap long rows."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..scan import Floats
from .dialect import COMMENTS, Dialect, Row
from .dressing import rows_of
from .scan_columns import alike
from .scan_rows import usual_angles
from .source import Source

# Wider rows are scans; fewer numbers are no scan.
WIDEST, LEAST_BEAMS = 40, 30
LEAST_LINES = 3


def scans_over_lines(
    source: Source, dialect: Dialect, head: list[Row], width: int
) -> tuple[list[int], list[Floats]] | None:
    """(line numbers, ranges) of scans that are parted by blank lines, by lines of words, or by a shorter line; or of
    one scan in all lines. None if the file has one scan, or one beam, a line. width: the most cells of a line."""
    if width == 2 or width > WIDEST or usual_angles(width) is not None:
        return None
    if width > 2:
        whole = [found for row in head if (found := dialect.numbers(row.text)) is not None and len(found) == width]
        if len(whole) < LEAST_LINES or not alike(np.array(whole, np.float64)):
            return None
    lines = list(_lines(source, dialect))
    # A whole file of one column is read as one scan elsewhere.
    parts = (
        _parts(lines, by)
        for by in ((_is_blank, _is_words, _is_short(width), _never) if width > 2 else (_is_blank, _is_words))
    )
    for scans in parts:
        sizes = {sum(map(len, values)) for _, values in scans}
        if len(sizes) != 1 or min(len(values) for _, values in scans) < LEAST_LINES or max(sizes) < LEAST_BEAMS:
            continue
        if len(scans) > 1 or (width > 2 and usual_angles(max(sizes)) is not None):
            source.notes.notice("lines", f"Each scan spans {len(scans[0][1])} lines.")
            return [number for number, _ in scans], [np.concatenate(values) for _, values in scans]
    return None


def _lines(source: Source, dialect: Dialect) -> Iterable[tuple[int, bytes, Floats | None]]:
    """(number, text, numbers) of each line; None for words."""
    for number, line in rows_of(source):
        text = line.strip()
        yield number, text, None if not text or text.startswith(COMMENTS) else dialect.numbers(text)


def _is_blank(line: tuple[int, bytes, Floats | None]) -> bool:
    return not line[1]


def _is_words(line: tuple[int, bytes, Floats | None]) -> bool:
    return bool(line[1]) and line[2] is None


def _is_short(width: int):
    return lambda line: line[2] is not None and len(line[2]) < width


def _never(line: tuple[int, bytes, Floats | None]) -> bool:
    return False


def _parts(lines: list[tuple[int, bytes, Floats | None]], ends) -> list[tuple[int, list[Floats]]]:
    """(line, numbers of its lines) of each run of lines with numbers; a run ends after a line for which `ends`."""
    found: list[tuple[int, list[Floats]]] = []
    fresh = True
    for line in lines:
        if line[2] is not None:
            if fresh:
                found.append((line[0], []))
            found[-1][1].append(line[2])
            fresh = False
        fresh = fresh or ends(line)
    return found
