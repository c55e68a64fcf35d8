"""Scans that span several lines, each with a few of their ranges, as programs wrap long rows."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...scan import Floats
from ..source import Source
from .dialect import COMMENTS, Dialect, Row
from .dressing import rows_of
from .scan_columns import alike
from .scan_rows import usual_angles

# Wider rows are scans; fewer numbers are no scan.
WIDEST, LEAST_BEAMS = 40, 30
LEAST_LINES = 3


class Line(NamedTuple):
    """numbers: None if it is blank or has words."""

    number: int
    text: bytes
    numbers: Floats | None


def scans_over_lines(
    source: Source, dialect: Dialect, head: list[Row], width: int
) -> tuple[list[int], list[Floats]] | None:
    """(line numbers, ranges) of scans that are parted by blank lines, by lines of words, or by a shorter line; or of
    one scan in all lines. None if the file has one scan, or several numbers of one beam, a line, or lines of other
    words. width: the most cells of a line."""
    if width == 2 or width > WIDEST or usual_angles(width) is not None:
        return None
    if width > 2:
        whole = [found for row in head if (found := dialect.numbers(row.text)) is not None and len(found) == width]
        if len(whole) < LEAST_LINES or not alike(np.array(whole, np.float64)):
            return None
    texts = [(row.number, row.text.strip()) for row in rows_of(source)]
    if width == 1 and (whole := _column(texts, dialect)) is not None:
        return whole
    lines = [Line(number, text, _numbers(text, dialect)) for number, text in texts]
    ends: list[Callable[[Line], bool]] = [_is_blank, _is_words]
    if width > 2:
        ends += [lambda line: line.numbers is not None and len(line.numbers) < width, lambda line: False]
    for scans in (_parts(lines, end) for end in ends):
        sizes = {sum(map(len, values)) for _, values in scans}
        if len(sizes) != 1 or min(len(values) for _, values in scans) < LEAST_LINES or max(sizes) < LEAST_BEAMS:
            continue
        if len(scans) > 1 or (width > 2 and usual_angles(max(sizes)) is not None):
            source.notes.notice("lines", f"Each scan spans {len(scans[0][1])} lines.")
            return [number for number, _ in scans], [np.concatenate(values) for _, values in scans]
    return None


def _column(texts: list[tuple[int, bytes]], dialect: Dialect) -> tuple[list[int], list[Floats]] | None:
    """The scan in a column without a gap, parsed at once; None if there are gaps or words between its numbers."""
    texts = [(number, text) for number, text in texts if not text.startswith(COMMENTS)]
    while texts and not texts[-1][1]:
        texts.pop()
    if not texts or not all(text for _, text in texts):
        return None
    values = dialect.numbers(b"\n".join(text for _, text in texts))
    return None if values is None or len(values) != len(texts) else ([texts[0][0]], [values])


def _numbers(text: bytes, dialect: Dialect) -> Floats | None:
    return None if not text or text.startswith(COMMENTS) else dialect.numbers(text)


def _is_blank(line: Line) -> bool:
    return not line.text


def _is_words(line: Line) -> bool:
    return bool(line.text) and line.numbers is None


def _parts(lines: list[Line], ends: Callable[[Line], bool]) -> list[tuple[int, list[Floats]]]:
    """(line, numbers of its lines) of each run of lines with numbers; a run ends after a line for which `ends`."""
    found: list[tuple[int, list[Floats]]] = []
    fresh = True
    for line in lines:
        if line.numbers is not None:
            if fresh:
                found.append((line.number, []))
            found[-1][1].append(line.numbers)
            fresh = False
        fresh = fresh or ends(line)
    return found
