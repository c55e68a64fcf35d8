"""The lines of a text file without what programs put around their numbers: the time it was received, a label, quotes,
dashes, LaTeX, or a remark."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import chain, islice
from typing import NamedTuple

from ..source import Source
from .dialect import COMMENTS, Row
from .headers import LENGTHS, TURNS
from .labelled import without_labels

# How most rows begin; nothing is to be done to them.
PLAIN = frozenset(b"%c" % each for each in b"+-.0123456789")
SEPARATOR = re.compile(rb"sep=.", re.IGNORECASE)  # the first line of Excel's tables
# A remark after a semicolon, and one behind the numbers of a line.
REMARK, INLINE = re.compile(rb";+\s*[A-Za-z][^;]*"), re.compile(rb"\s+(?:#|//)\s.*$")
# The time at which a terminal received a line, such as `12:00:00.120 -> ` of Arduino's.
RECEIVED = re.compile(
    rb"\s*(\[)?((?:\d{4}-\d\d-\d\d[ T])?\d\d:\d\d:\d\d(?:[.,]\d+)?(?:Z|[-+]\d\d:?\d\d)?)(?(1)\]\s+|\s*->\s*)(?=\S)"
)
QUOTES = re.compile(rb'\s*"([^"]*[,;\t][^"]*)"\s*[,;]?\s*')
DASH = re.compile(rb"\s*-\s+(?=[-+]?\.?(?:\d|nan|inf)\S*\s*$)", re.IGNORECASE)
ROW_END = re.compile(rb"\\\\(?:\[[^\]]*\])?\s*(?:\\\w+\s*)*$|\\(?:tabularnewline|cr)\b.*$")
DEGREES = re.compile(rb"\^\{?\\circ\}?|\\textdegree|\\degree")
MARKS = re.compile(rb"\$|\\(?:,|\w+\{|)|[{}]")
# A table in a box, as MySQL, polars and Markdown draw it.
UPRIGHT = re.compile("\\||│|┃|║|┆|┊|¦".encode())
BOXED = re.compile("\\s*(?:\\||│|┃|║)[^\n]*(?:\\||│|┃|║)\\s*".encode())
RULE = re.compile(rb"[-:= ]*")
# What colours the text of a terminal.
COLOUR = re.compile(rb"\x1b\[[\d;]*[A-Za-z]")
# The unit of a number.
WITH_UNIT = re.compile(rb"(?<=\d)\s?(mm|cm|m|deg|rad|\xc2\xb0)(?=[\s,;|\"\])]|$)", re.IGNORECASE)
MANY, ENOUGH, SAMPLE = 10, 16, 40
MOST_SPANNED = 2000


class Dress(NamedTuple):
    """fits: whether a line wears it; off: the line without it, empty if it has no numbers."""

    fits: Callable[[bytes], object]
    off: Callable[[bytes], bytes]


def _without_time(line: bytes) -> bytes:
    """The line; the time stays in front of a whole scan, as its stamp."""
    found = RECEIVED.match(line)
    if found is None:
        return line
    rest = line[found.end() :]
    mark = next((mark for mark in (b";", b"\t", b",") if mark in rest), b" ")
    return found[2].replace(b" ", b"T") + mark + rest if rest.count(mark) >= MANY else rest


def _of_latex(line: bytes) -> bytes:
    """The cells of a row, parted by tabs; nothing for other lines."""
    if b"&" not in line:
        return b""
    return MARKS.sub(b"", DEGREES.sub("°".encode(), ROW_END.sub(b"", line.strip()))).replace(b"&", b"\t")


def _of_box(line: bytes) -> bytes:
    """The cells of a row, parted by tabs; nothing for lines that are drawn."""
    cells = [cell.strip() for cell in UPRIGHT.split(line.strip())]
    if len(cells) < 3 or all(RULE.fullmatch(cell) for cell in cells):
        return b""
    return b"\t".join(cells[1:-1])


def _unit_free(source: Source, lines: list[bytes]) -> Callable[[bytes], bytes] | None:
    """What takes the units off numbers such as 1.25m or -90.0°, which are noted; None if most lines have none, or if
    numbers have several units of one kind."""
    found = [set(WITH_UNIT.findall(line)) for line in lines]
    units = {unit.decode().lower() for each in found for unit in each}
    lengths, turns = ({known[unit] for unit in units if unit in known} for known in (LENGTHS, TURNS))
    if 2 * sum(map(bool, found)) <= len(lines) or len(lengths) > 1 or len(turns) > 1:
        return None
    stated = (("unit", lengths, source.reading.unit), ("angle_unit", turns, source.reading.angle_unit))
    source.notes.found |= {name: next(iter(each)) for name, each, given in stated if each and given is None}
    return lambda line: WITH_UNIT.sub(b"", line)


DRESSES = (
    Dress(BOXED.fullmatch, _of_box),
    Dress(RECEIVED.match, _without_time),
    Dress(lambda line: b"&" in line and ROW_END.search(line.strip()), _of_latex),
    Dress(QUOTES.fullmatch, lambda line: QUOTES.sub(rb"\1", line)),
    Dress(DASH.match, lambda line: DASH.sub(b"", line)),
)


def rows_of(source: Source) -> Iterator[Row]:
    """The lines of a file without what a program put around their numbers; blank lines have no text."""
    rows = _lines(source)
    head = list(islice(rows, SAMPLE))
    lines = [row.text for row in head if row.text]
    off = _undressing(source, lines)
    if (plain := _unit_free(source, [off(line) for line in lines] if off else lines)) is not None:
        dress, off = off, (lambda line: plain(dress(line) if dress else line))
    if off is None:
        yield from head
        yield from rows
        return
    for row in chain(head, rows):
        if (text := off(row.text)) or not row.text:
            yield Row(row.number, text)


def _whole_lines(source: Source) -> Iterator[tuple[int, bytes]]:
    """(number, line), where a cell in quotes that spans lines, as pandas writes arrays, is in one line."""
    held: list[tuple[int, bytes]] = []
    for number, line in source.lines():
        if not held and (b'"' not in line or line.count(b'"') % 2 == 0):
            yield number, line
            continue
        held.append((number, line))
        if len(held) > 1 and line.count(b'"') % 2:
            yield held[0][0], b" ".join(text for _, text in held)
            held = []
        elif len(held) > MOST_SPANNED:
            # A quote that nothing closes is a mark of inches, or a slip.
            yield from held
            held = []
    yield from held


def _lines(source: Source) -> Iterator[Row]:
    for number, line in _whole_lines(source):
        if line[:1] in PLAIN and b"#" not in line and b"//" not in line:
            yield Row(number, line)
            continue
        text = line.removeprefix(b"\xef\xbb\xbf") if number == 1 else line
        text = COLOUR.sub(b"", text) if b"\x1b" in text else text
        stripped = text.strip()
        if number == 1 and SEPARATOR.fullmatch(stripped):
            continue
        if stripped.startswith(b";") and REMARK.fullmatch(stripped):
            stripped = b"#" + stripped
        elif b"#" in stripped or b"//" in stripped:
            text = INLINE.sub(b"", text)
        yield Row(number, stripped if not stripped or stripped.startswith(COMMENTS) else text)


def _undressing(source: Source, lines: list[bytes]) -> Callable[[bytes], bytes] | None:
    """What takes off the dress that most of the lines wear; None if they wear none."""
    # Titles may stand above.
    lines = lines[-ENOUGH:]
    worn = (dress for dress in DRESSES if 2 * sum(map(bool, map(dress.fits, lines))) > len(lines))
    dress = next(worn, None)
    return without_labels(source, lines) if dress is None else dress.off
