"""How a text file writes numbers: its separator, its decimal sign, brackets, labels and comments."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import zip_longest
from typing import NamedTuple

import numpy as np

from ...scan import Floats
from .numbers import all_numbers, is_number, number_of

COMMENTS = (b"#", b"%", b"//")
DECIMAL_COMMA = re.compile(rb"[-+]?\d+,\d+(?:[eEdD][-+]?\d+)?")
EITHER = re.compile(rb"[-+]?\d+(?:,\d+(?:[eEdD][-+]?\d+)?)?")
PAIR = re.compile(
    rb"([A-Za-z_][\w ]{0,40}?(?:\((?:mm|cm|m|deg|rad)\))?)\s{0,9}[:=]\s*"
    rb"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(mm|cm|m|deg|rad)?(?![\w:])"
)
QUOTED = re.compile(rb'(?:^|(?<=[,;|]))\s*"([^"]*)"\s*(?=[,;|]|$)')
BRACKET = re.compile(rb"([\[\](){}])")
LIST = re.compile(
    rb"[\w\s.:=,+<>-]*(?:\('\w',\s*)?[\[({][\[({\s]*(?:[-+]?\.?(?:\d|nan|inf|None|True|False|float)[^:\"]*)?",
    re.IGNORECASE,
)
# An index, or a unit with its factor, in brackets behind the name of a column.
IN_NAME = re.compile(
    "[^\\[({]*[\\[({](?:\\d+[\\])}]\\s*(?:[,;\t]|$)|\\s*[\\d./]+\\s?(?!nan|inf)(?:[a-zµ]{1,12}|°)\\s*[\\])}])".encode(),
    re.IGNORECASE,
)
# What stands before the size or an index of an array, as in ranges[541].
INDEXED = re.compile(rb"\w$")
# A number can be read in one way only, so that a long line that fits nothing takes no time.
NUMBER = rb"(?>[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|[-+.]?inf|\.?nan|null|none)"
# Two numbers or more in brackets at the end of a line.
LAST_LIST = re.compile(rb"[\[({]\s*+(%s(?>(?:\s*+,\s*+|\s++)%s)+)\s*+[\])}]\W*$" % (NUMBER, NUMBER), re.IGNORECASE)
OPENING = re.compile(rb"\[")
# A list of ten numbers or more.
LONG_LIST = re.compile(rb"(?:\[|\{\w+ )((?>(?:\s*+%s\s*+,){9}[^\[\]{}]*))[\]}]" % NUMBER, re.IGNORECASE)
WORDS = {
    rb"float\(['\"]([-+\w]+)['\"]\)": rb"\1",
    rb"\b(?:np|numpy|math)\.": b"",
    rb"\bTrue\b": b"1",
    rb"\bFalse\b": b"0",
    rb"(?<=[\d.])[fF]\b": b"",  # of C
}
MISSING = (
    b"", b"-", b"--", b"null", b"none", b"na", b"n/a", b"#n/a", b"#value!", b"#num!", b"#div/0!", b"#ref!", b".nan",
    b".inf", b"-.inf", b"undefined", b"nil", b"missing", b"invalid", b"out of range", b"no return", b"no echo",
)  # fmt: skip
# What C programs print on Windows.
OF_WINDOWS = re.compile(rb"[-+]?(?:1\.#(?:inf|ind|qnan|snan)\d*|nan\(\w*\))", re.IGNORECASE)
TIME = re.compile(
    rb"(?:(\d{4})[-/.](\d\d?)[-/.](\d\d?)[T /_-])?(\d\d?):(\d\d):(\d\d(?:[.,]\d+)?)\s*"
    rb"(?:([AP])\.?M\.?)?\s*(?:Z|UTC|([-+]\d\d):?(\d\d))?",
    re.IGNORECASE,
)
# A date that begins with the day, as in German, and one of which nobody knows whether it begins with the day.
DAY_FIRST, EITHER_FIRST = re.compile(rb"(\d\d?)\.(\d\d?)\.(\d{4})\b,?"), re.compile(rb"\d\d?[-/]\d\d?[-/]\d{4}\b,?\s*")
# A time with its unit, as MATLAB writes durations.
DURATION = re.compile(rb"([-+]?(?:\d+\.?\d*|\.\d+)) ?(s|secs?|seconds?|ms|msec|us|ns)", re.IGNORECASE)
DURATIONS = {b"s": 1.0, b"m": 1e-3, b"u": 1e-6, b"n": 1e-9}
# Marks between thousands: of English, of German, and of Swiss or French numbers.
ENGLISH = re.compile(rb"[-+]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?")
GERMAN = re.compile(rb"[-+]?[1-9]\d{0,2}(?:\.\d{3})+(?:,\d*)?")
SPACED = re.compile("[-+]?[1-9]\\d{0,2}(?:(?:'|’|\u00a0|\u202f| )\\d{3})+(?:[.,]\\d*)?".encode())
HUNDREDS = re.compile(rb"[-+]?[1-9]\d\d")
MANY_CELLS = 10
EASTERN = re.compile("角度|方位|距離|距离")
FIRST_WORD = re.compile(rb'["\s]*([^\s,;|"]*)')
THOUSANDS = re.compile(rb"[^\d.,+-]+")
LONGEST_ROW = 1 << 24
FREE_NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
LEFT_OUT = (
    "'...' stands where numbers were left out; save all of them, with `ros2 topic echo --full-length`, or after "
    "numpy.set_printoptions(threshold=sys.maxsize)"
)


class Row(NamedTuple):
    """A line with data, and its number from 1."""

    number: int
    text: bytes


@dataclass(frozen=True)
class Dialect:
    """separator: of the cells, b" " for blanks; comma: whether the decimal sign is a comma."""

    separator: bytes = b","
    comma: bool = False

    def cells(self, text: bytes) -> list[bytes]:
        """The cells of a line, without quotes; an empty cell after the last separator is dropped."""
        if b'"' in text and (quoted := _quoted(text, self.separator)) is not None:
            cells = quoted
        elif b'"' in text:
            csv.field_size_limit(LONGEST_ROW)
            mark = {b"\t": "\t", b" ": " "}.get(self.separator, self.separator.decode())
            found = next(csv.reader([text.decode("utf-8", "replace")], delimiter=mark, skipinitialspace=True))
            cells = [cell.strip().encode() for cell in found]
        elif self.separator == b" ":
            return text.split()
        else:
            cells = [cell.strip() for cell in text.split(self.separator)]
        return cells[:-1] if cells and not cells[-1] else cells

    def width(self, text: bytes) -> int:
        """The number of cells of a line."""
        if b'"' in text or self.separator == b" ":
            return len(self.cells(text))
        return text.count(self.separator) + (not text.rstrip().endswith(self.separator))

    def numbers(self, text: bytes) -> Floats | None:
        """All numbers of a line, NaN for empty cells; None if one of its words is not a number."""
        plain = b'"' not in text and (self.separator == b" " or not self._has_gaps(text))
        # Here a comma or a point may stand between thousands.
        if plain and not (b"." in text if self.comma else self.separator != b"," and b"," in text):
            values = all_numbers(self._plain(text))
            if values is not None:
                return values
        cells = self.cells(text)
        values = [self.number(cell) for cell in cells]
        return None if None in values else np.array(values, dtype=np.float64)

    def number(self, cell: bytes) -> float | None:
        """The number in a cell, NaN if it is empty, None if it holds something else."""
        if self.comma and b"." in cell and GERMAN.fullmatch(cell.strip()):
            cell = cell.replace(b".", b"")
        try:
            return number_of(cell.replace(b",", b".") if self.comma else cell)
        except ValueError:
            cell = cell.strip()
            if cell.lower() in MISSING or OF_WINDOWS.fullmatch(cell):
                return float("nan")
            number = _with_thousands(cell)
            return seconds_of(cell) if number is None else number

    def _plain(self, text: bytes) -> bytes:
        """The line with decimal points, and blanks between the numbers."""
        if self.comma:
            text = text.replace(self.separator, b" ") if self.separator != b" " else text
            return text.replace(b",", b".")
        return text.replace(self.separator, b" ") if self.separator not in b",; \t" else text

    def _has_gaps(self, text: bytes) -> bool:
        bare = text.strip(b" \r\n")
        mark = self.separator
        return mark * 2 in bare or bare.startswith(mark) or mark + b" " + mark in bare


def _with_thousands(cell: bytes) -> float | None:
    """A number with marks between its thousands; None for other text."""
    if ENGLISH.fullmatch(cell):
        return float(cell.replace(b",", b""))
    return float(THOUSANDS.sub(b"", cell).replace(b",", b".")) if SPACED.fullmatch(cell) else None


def _quoted(text: bytes, mark: bytes) -> list[bytes] | None:
    """The cells of a line with quotes around whole cells only; None if it takes the csv module, which is slower."""
    held = QUOTED.findall(text)
    bare = QUOTED.sub(b'"', text)
    cells = [cell.strip() for cell in bare.split(mark)]
    if b'""' in text or mark in b" \t" or not bare.count(b'"') == cells.count(b'"') == len(held):
        return None
    quoted = iter(held)
    return [next(quoted).strip() if cell == b'"' else cell for cell in cells]


def seconds_of(cell: bytes) -> float | None:
    """A date, a time of day or both, or a time with its unit, in seconds; None for other text.

    Without a zone, it is taken for UTC. Of a date such as 06/10/2024, which may begin with the day or the month, only
    the time of day is taken; NaN without one.
    """
    if (length := DURATION.fullmatch(cell)) is not None:
        return float(length[1]) * DURATIONS[length[2][:1].lower()]
    cell = DAY_FIRST.sub(rb"\3-\2-\1", cell)
    if (either := EITHER_FIRST.match(cell)) is not None:
        cell = cell[either.end() :]
        if not cell:
            return float("nan")
    found = TIME.fullmatch(cell) or TIME.fullmatch(cell + b" 00:00:00")
    if found is None:
        return None
    hours, minutes, seconds = int(found[4]), int(found[5]), float(found[6].replace(b",", b"."))
    if found[7] is not None:
        hours = hours % 12 + 12 * (found[7].upper() == b"P")
    if found[1] is None:
        return 3600.0 * hours + 60 * minutes + seconds
    try:
        day = datetime(int(found[1]), int(found[2]), int(found[3]), hours, minutes, tzinfo=UTC)
    except ValueError:
        return None
    ahead = 0 if found[8] is None else 3600 * int(found[8]) + int(found[8][:1] + found[9]) * 60
    return day.timestamp() + seconds - ahead


def text_of(cell: bytes) -> str:
    """A cell as text: UTF-8, or else what Windows writes in Japan or China, if that has an angle or a distance, or in
    Europe."""
    try:
        return cell.decode("utf-8")
    except UnicodeDecodeError:
        texts = [cell.decode(encoding, "replace") for encoding in ("shift_jis", "gb18030")]
        return next(filter(EASTERN.search, texts), cell.decode("cp1252", "replace"))


def dialect_of(lines: list[bytes]) -> Dialect:
    """The dialect of some lines, of which the first may be a header."""
    data = (lines if begins_with_number(lines[0]) else lines[1:]) or lines
    if _has_commas_alone(lines[0]) and len(data) < len(lines):
        # Its cells may hold lists with other marks.
        commas = lines[0].count(b",")
        if all(b'"' not in line and line.count(b",") == commas for line in data):
            return Dialect(b",")
    whole = b" ".join(data)
    for mark in (b";", b"\t", b"|"):
        if mark in whole and sum(mark in line for line in data) > len(data) / 2:
            return Dialect(mark, _decimal_commas([line.split(mark) for line in data]))
    if b"," not in whole:
        return Dialect(b" ")
    words = whole.split()
    if len(words) >= 2 * len(data) and all(EITHER.fullmatch(word) for word in words):
        return Dialect(b" ", comma=True)
    if len(words) >= 2 * len(data) and all(ENGLISH.fullmatch(word) or is_number(word) for word in words):
        return Dialect(b" ")
    # In quotes, a comma may be a decimal sign also where commas part the cells.
    return Dialect(b",", _decimal_commas([Dialect(b",").cells(line) for line in data if line.count(b'"') > 2]))


def _has_commas_alone(header: bytes) -> bool:
    return header.count(b",") > 1 and not any(mark in header for mark in (b";", b"\t", b"|"))


def begins_with_number(line: bytes) -> bool:
    return is_number(FIRST_WORD.match(line)[1])  # type: ignore[index] - it matches any line


def _decimal_commas(rows: list[list[bytes]]) -> bool:
    """Whether numbers have a decimal comma: some cells do, and none has a decimal point.

    A comma or a point before three digits may also stand between thousands, as others in its column show.
    """
    rows = [[cell.strip().strip(b'"') for cell in row] for row in rows]
    cells = [cell for row in rows for cell in row]
    commas = [cell for cell in cells if DECIMAL_COMMA.fullmatch(cell) or (b"," in cell and GERMAN.fullmatch(cell))]
    decimal = [cell for cell in commas if not ENGLISH.fullmatch(cell)]
    points = [cell for cell in cells if re.fullmatch(rb"[-+]?\d*\.\d+", cell)]
    if not commas or any(not GERMAN.fullmatch(cell) for cell in points):
        return False
    if decimal:
        return True
    columns = [cells] if len(cells) >= MANY_CELLS * len(rows) else list(zip_longest(*rows, fillvalue=b""))
    return not points and not any(
        any(ENGLISH.fullmatch(cell) for cell in column) and any(HUNDREDS.fullmatch(cell) for cell in column)
        for column in columns
    )


def is_list(line: bytes) -> bool:
    """Whether a line begins a list in brackets, perhaps after numbers or a name, and not a header with brackets."""
    brackets = b"[" in line or b"(" in line or b"{" in line
    return brackets and LIST.fullmatch(line.strip()) is not None and not IN_NAME.match(line)


def in_log(lines: list[bytes]) -> re.Pattern[bytes] | None:
    """What finds the list of numbers among the words of most lines, as logs of a node have; None without one."""
    if b"[" not in lines[0] and b"{" not in lines[0]:
        return None
    return next(
        (list_ for list_ in (LONG_LIST, LAST_LIST) if 2 * sum(map(bool, map(list_.search, lines))) > len(lines)), None
    )


def bracketed(rows: Iterable[Row], name: str) -> Iterator[Row]:
    """The innermost lists in brackets, which may span lines, with the numbers before them on their line.

    Raises ValueError for a list that its printer has shortened.
    """
    # What stands before the last bracket, that bracket, and the pieces after it.
    before, last, held, size, first = b"", b"", [b""], 0, 0
    for number, text in rows:
        if b"..." in text:
            raise ValueError(f"{name}:{number}: {LEFT_OUT}.")
        for word, plain in WORDS.items():
            text = re.sub(word, plain, text)
        head, *rest = BRACKET.split(text)
        held.append(head)
        size += len(text)
        for bracket, piece in zip(rest[::2], rest[1::2], strict=True):
            inner = b" ".join(held)
            if bracket in b"])}" and last and last in b"[({":
                for row in inner.split(b";"):  # MATLAB parts rows so
                    if row.strip() and not (INDEXED.search(before) and row.strip().isdigit()):
                        yield Row(first, b" ".join(FREE_NUMBER.findall(before)) + b" " + row.replace(b",", b" "))
            first = number if bracket in b"[({" else first
            before, last, held, size = inner, bracket, [piece], len(piece)
        if size > LONGEST_ROW:
            raise ValueError(f"{name}:{first or number}: a bracket is not closed.")


def labels_of(lines: list[bytes]) -> list[bytes] | None:
    """The names in lines such as "theta: 1.00 Dist: 3492.00 Q: 47"; None if the lines do not look like that."""
    found = [PAIR.findall(line) for line in lines if b":" in line or b"=" in line]
    found = [pairs for pairs in found if len(pairs) >= 2]
    if len(found) < 0.5 * len(lines) or not found:
        return None
    names = [_label(name, unit) for name, _, unit in found[-1]]
    alike = sum([_label(name, unit) for name, _, unit in pairs] == names for pairs in found)
    return names if alike > 0.8 * len(found) else None


def _label(name: bytes, unit: bytes) -> bytes:
    last = name.strip().split()[-1]
    return b"%s (%s)" % (last, unit) if unit else last


def unlabelled(rows: Iterable[Row], count: int) -> Iterator[Row]:
    """The numbers of labelled lines; lines without labels are passed over."""
    for number, text in rows:
        values = [value for _, value, _ in PAIR.findall(text)]
        if len(values) == count:
            yield Row(number, b" ".join(values))
