"""Plain text: one scan per row, one beam per row, or a table with the ranges of each scan."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from itertools import chain, islice, pairwise
from typing import Any

from ...scan import Recording
from ..lasers import rows_of_one_laser
from ..reading import Reading, around_ranges, columns_of
from ..source import Reader, Source
from .beam_groups import groups_of, read_groups
from .beam_rows import check_angles, columns_beside, read_beams, table_of
from .dialect import (
    COMMENTS,
    OPENING,
    Dialect,
    Row,
    begins_with_number,
    bracketed,
    dialect_of,
    in_log,
    is_list,
    labels_of,
    text_of,
    unlabelled,
)  # fmt: skip
from .dressing import rows_of
from .headers import (
    LENGTHS,
    STAMPS,
    TURNS,
    Name,
    array_columns,
    column_of,
    field_of,
    geometry_in,
    is_angle,
    is_beam,
    is_distance,
    name_of,
    says_angle,
    says_distance,
    unit_of,
    units_as_names,
)
from .interleaved import angles_between, interleaved, read_angles_between, read_interleaved
from .labelled import of_one_label
from .long_table import widened
from .numbered import read_numbered
from .numbers import split
from .scan_columns import alike, first_echoes, named_columns, tell_columns
from .scan_rows import parsed, read_scans, scans_of
from .spanning import scans_over_lines
from .table import FIELDS, MANY_BEAMS, echo_columns, is_long_list, read_table

ECHO = re.compile(rb"%time[,;\t]field\.")  # the first line of `rostopic echo -p`
SETTING = re.compile(rb"(\w+)\s*[=:]\s*([^\s,;]+)")
# A setting in a line of its own, above a table.
SETTING_LINE = re.compile(
    rb"[#%/\s]*([A-Za-z][\w .()\[\]/\xb0\xc2]{0,60})[=:,;]\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*", re.IGNORECASE
)
TEXT_FORMS = "use one scan per row, or columns of angle and distance, or a table with a column named ranges."
# What the programs of its maker write, and how its driver calls raw angles.
OF_RPLIDAR = re.compile(
    rb"rplidar|slamtec|^[S ]*theta: *[\d.]+ +Dist: *[\d.]+ +Q:|angle_z?_?q\d", re.IGNORECASE | re.MULTILINE
)
# In which sense comments say that angles count.
SENSE = re.compile(rb"(?:counter|anti)?[- ]?clockwise", re.IGNORECASE)
# Its driver for ROS turns them.
OF_ROS = re.compile(rb"(?<![A-Za-z])ros|/scan\b|LaserScan", re.IGNORECASE)
# An angle as the name of a column, such as -134.5°.
ANGLE = re.compile(
    "([A-Za-z][A-Za-z_ ]*[@_ ])?([-+]?\\d+(?:[.,]\\d+)?)([\\s_]*(?:deg|rad|°)?)\\s*(?:[(\\[](\\w+)[)\\]])?".encode(),
    re.IGNORECASE,
)
MARK = re.compile(rb"[,;\t]")
MOST_NAMES = 4
NUMBERS = re.compile(rb"[-+.:\d]+")
# The column of numbers that a header leaves out.
UNNAMED = Name("index")
# With fewer rows, nothing is a title.
FEW_ROWS = 6
SAMPLE = 40
# Rows with fewer numbers than this are beams, if there are enough of them.
FEW_COLUMNS, MANY_ROWS = 9, 10


class Text(Reader):
    """The last reader to try: any file with lines of numbers."""

    format = "text"
    suffixes = (".csv", ".txt", ".dat", ".tsv", ".asc", ".xy")
    expects = "lines of numbers"

    @staticmethod
    def recognises(head: bytes) -> bool:
        # A power failure leaves NULs at the end.
        return bool(head.strip(b"\0 \t\r\n")) and b"\0" not in head.rstrip(b"\0")

    @staticmethod
    def read(source: Source) -> Recording:
        rows = (row for row in rows_of(source) if row.text)
        said: dict[str, str] = {}
        comments, first = [b""], next(rows, None)
        while first is not None and first.text.startswith(COMMENTS) and not ECHO.match(first.text):
            said.update((key.decode(), value.decode("utf-8", "replace")) for key, value in SETTING.findall(first.text))
            comments.append(first.text)
            first = next(rows, None)
        if first is None:
            raise ValueError(f"{source.name} has no line of numbers; {TEXT_FORMS}")
        reading = _with_settings(source, _with_comments(source, said), comments)
        above = b"\n".join([*comments, first.text])
        if OF_RPLIDAR.search(above) and not OF_ROS.search(above):
            source.notes.clockwise = "an RPLIDAR counts its angles so"
        elif {each.strip().lower() for each in SENSE.findall(b"\n".join(comments))} == {b"clockwise"}:
            source.notes.clockwise = "a comment says so"
        rest = (row for row in rows if not row.text.startswith(COMMENTS))
        head, rest = _without_headings(source, [first, *islice(rest, SAMPLE)], rest)
        below = _below_titles(source, head)
        reading = _with_settings(source, reading, [row.text for row in head[: len(head) - len(below)]])
        head = below
        recording = _read(source, reading, head, chain(head, rest), comments[-1])
        laser = source.notes.found.get("frame_id", "")
        return recording if any(recording.frame_ids) else replace(recording, frame_ids=(laser,) * len(recording))


def _without_headings(source: Source, head: list[Row], rest: Iterable[Row]) -> tuple[list[Row], Iterable[Row]]:
    """The rows without lines of the same words, such as "Scan 3 at 1.5 s", that stand above some of them."""
    words = _words(head[0].text)
    if not re.search(rb"[A-Za-z]", words) or is_list(head[0].text):
        return head, rest
    these = [_words(row.text) == words for row in head]
    if sum(these) < 2 or 2 * sum(these) > len(head):
        return head, rest
    below = [row.text for row, heading in zip(head[1:], these, strict=False) if heading]
    if not all(map(begins_with_number, below)) or _is_header_of(head[0].text, below[0]):
        return head, rest
    shown = text_of(head[0].text.strip()[:40])
    source.notes.notice("titles", f"Lines of words between the rows, such as {shown!r}, were passed over.")
    return [row for row in head if _words(row.text) != words], (row for row in rest if _words(row.text) != words)


def _is_header_of(line: bytes, below: bytes) -> bool:
    """Whether a line has a name for each of the numbers below it."""
    names = [name_of(text_of(word)) for word in split(line)]
    known = any(says_angle(name) or says_distance(name) or name.plain in ("x", "y") for name in names)
    return known and 1 < len(names) == len(split(below))


def _words(line: bytes) -> bytes:
    """The words of a line that does not begin with a number, without the numbers in it."""
    return b"" if begins_with_number(line) else NUMBERS.sub(b"", line)


def _below_titles(source: Source, head: list[Row]) -> list[Row]:
    """The first rows without the lines of words above the table, such as a program's greeting or the command sent."""
    lines = [row.text for row in head]
    if is_list(lines[0]) or labels_of(lines):
        return head
    titles = _titles(lines)
    if titles in (0, len(lines)):
        return head
    source.notes.notice(
        "titles", f"Words above the table, in {titles} line{'' if titles == 1 else 's'}, were passed over."
    )
    return head[titles:]


def _titles(lines: list[bytes]) -> int:
    """The number of lines of words above lists in brackets, or above the header of a table or its first row."""
    below = lines[len(lines) // 2 :]
    if 2 * sum(map(is_list, below)) >= len(below):
        first = next(at for at, line in enumerate(lines) if is_list(line))
        return 0 if any(MARK.search(line) for line in lines[:first]) else first
    if len(lines) < FEW_ROWS:
        return 0
    if begins_with_number(lines[0]):
        # How many rows follow, as point clouds in text have it.
        return int(lines[0].strip().isdigit() and not any(line.strip().isdigit() for line in lines[1:]))
    dialect = dialect_of(below)
    width = Counter(map(dialect.width, below)).most_common(1)[0][0]
    if width < 2:
        return 0

    def begins_with_a_word(line: bytes) -> bool:
        return dialect.number((dialect.cells(line) or [b"x"])[0] or b"x") is None

    def is_header(line: bytes) -> bool:
        names = dialect.cells(line)
        cells = len(names)
        # The last name may be that of all ranges.
        if 1 < cells < width - MANY_BEAMS and says_distance(name_of(text_of(names[-1]))):
            return True
        # A header of blanks may seem to have fewer cells than it names, or more.
        return cells == width if dialect.separator == b" " and not _names_beams(line) else cells >= width - (width > 2)

    words = next((at for at, line in enumerate(lines) if not begins_with_a_word(line)), 0)
    if words < 2 or dialect.numbers(lines[words]) is None:
        return words if words == 1 and not is_header(lines[0]) else 0
    # A header may have a row of units below it.
    units = 1 if len(dialect.cells(lines[words - 1])) == width and is_header(lines[words - 2]) else 0
    named = [at for at in range(words - 1 - units, words) if is_header(lines[at])]
    return named[0] if named else words


def _names_beams(line: bytes) -> bool:
    """Whether words name an angle and a distance, or x and y."""
    names = [name_of(text_of(word)) for word in re.split(rb"[\s,;]+", line.strip())]
    return (any(map(is_angle, names)) and any(map(is_distance, names))) or {"x", "y"} <= {each.plain for each in names}


def _with_comments(source: Source, said: dict[str, str]) -> Reading:
    """The given Reading, completed from the comment lines of the file."""
    found: dict[str, Any] = {}
    for name, entry in Reading.declared().items():
        if name in said and entry.group != "scans" and name != "columns" and getattr(source.reading, name) is None:
            try:
                kind, value = Reading.type_of(name), said[name]
                found[name] = kind(value) if kind in (int, float) else value
            except ValueError:
                raise ValueError(
                    f"{source.name}: its comments say {name} = {said[name]!r}; it must be a number."
                ) from None
    try:
        reading = source.reading.but(**found)
    except ValueError as error:
        raise ValueError(f"{source.name}: {error}") from None
    source.notes.found |= found
    return reading


def _with_settings(source: Source, reading: Reading, lines: list[bytes]) -> Reading:
    """The Reading, completed from lines such as "start angle [deg]: -135" above the table."""
    said = [(text_of(found[1]), found[2]) for line in lines if (found := SETTING_LINE.fullmatch(line))]
    found = {name: value for name, value in geometry_in(said).items() if getattr(reading, name) is None}
    source.notes.found |= found
    return reading.but(**found)


def _read(source: Source, reading: Reading, head: list[Row], rows: Iterable[Row], comment: bytes) -> Recording:
    """Decides what the rows hold, from the first of them."""
    lines = [row.text for row in head]
    source.notes.kind = "text"
    if not is_list(lines[0]) and (pattern := in_log(lines)) is not None:
        rows = of_one_label(source, rows, lines, pattern)
        lists = (Row(row.number, found[1]) for row in rows if (found := pattern.search(row.text)))
        head = list(islice(lists, SAMPLE))
        return _read_numbers(source, reading, head, chain(head, lists), Dialect(b","), None)
    if is_list(lines[0]):
        rows, dialect = bracketed(of_one_label(source, rows, lines, OPENING), source.name), Dialect(b" ")
        head = list(islice(rows, SAMPLE))
        if not head:
            raise ValueError(f"{source.name} has brackets, but no list of numbers in them; {TEXT_FORMS}")
        return _read_numbers(source, reading, head, chain(head, rows), dialect, None)
    if labels := labels_of(lines):
        names = [name_of(text_of(label)) for label in labels]
        return _read_named(source, reading, unlabelled(rows, len(names)), Dialect(b" "), names)
    dialect = dialect_of(lines)
    source.notes.kind = "CSV" if dialect.separator in b",;" else "text"
    cells = dialect.cells(lines[0])
    if column := echo_columns(dialect, head):
        return read_table(source, reading, rows, dialect, column)
    if len(head) > 1 and (row := _angles_in_names(source, dialect, cells)) is not None:
        head[0] = head[0]._replace(text=row)
        rows = chain(head[:1], islice(rows, 1, None))
        return _read_numbers(source, reading, head, rows, dialect, None)
    if (below := _of_column(dialect, head)) > 0:
        _take_unit(source, reading, name_of(text_of(head[below - 1].text)))
        return _read_numbers(source, reading, head[below:], islice(rows, below, None), dialect, None)
    if _is_header(dialect, cells):
        cells, above = _joined_levels(dialect, head)
        names = _names(dialect, head, cells) if above == 1 else [name_of(text_of(cell)) for cell in cells]
        if above == 1 and len(head) > 1 and (units := _units(dialect, head[1].text, names)) is not None:
            names, above = units, 2
        return _read_named(source, reading, islice(rows, above, None), dialect, names)
    names = [name_of(text_of(word)) for word in re.split(rb"[\s,;]+", comment.strip(b"#%/ ,;"))]
    named = len(names) == len(cells) and any(map(is_distance, names)) and any(map(is_angle, names))
    return _read_numbers(source, reading, head, rows, dialect, names if named else None)


def _is_header(dialect: Dialect, cells: list[bytes]) -> bool:
    """Whether a line has names: its first cell is no number, or is empty and followed by names."""
    cells = [cell for cell in cells if cell]
    return bool(cells) and dialect.number(cells[0]) is None


def _joined_levels(dialect: Dialect, head: list[Row]) -> tuple[list[bytes], int]:
    """The names in the first row, and 1; or those of several rows of names joined by points, and how many these are.

    In the upper of such rows, names recur, or stand once above several columns, as in tables of pandas and Excel.
    """
    names, levels, width = dialect.cells(head[0].text), 1, len(dialect.cells(head[-1].text))
    for row in head[1:-1]:
        cells = dialect.cells(row.text)
        cells += [b""] * (width - len(cells))
        if not _are_names(dialect, cells, dialect.cells(head[-1].text)):
            break
        if any(cells[1:]):
            upper = _filled(names + [b""] * (width - len(names)))
            if len({*upper}) == len(upper) or len(cells) != len(upper):
                break
            names = [b".".join(filter(None, pair)) for pair in zip(upper, cells, strict=True)]
        levels += 1
    return names, levels


def _filled(names: list[bytes]) -> list[bytes]:
    """Names, each also in the empty cells after it."""
    found = list(names)
    for at in range(1, len(found)):
        found[at] = found[at] or found[at - 1]
    return found


def _are_names(dialect: Dialect, cells: list[bytes], data: list[bytes]) -> bool:
    """Whether a row has a word where the data have a number, or only one word in front."""
    words = [bool(cell) and dialect.number(cell) is None for cell in cells]
    return any(word and (_has_number(dialect, data, at) or not any(cells[1:])) for at, word in enumerate(words))


def _has_number(dialect: Dialect, cells: list[bytes], at: int) -> bool:
    return at < len(cells) and bool(cells[at]) and dialect.number(cells[at]) is not None


def _of_column(dialect: Dialect, head: list[Row]) -> int:
    """The number of lines of words above a column of numbers; 0 if there are none, or what follows is no column."""
    words = next((at for at, row in enumerate(head) if begins_with_number(row.text)), 0)
    below = head[words:] if words else []
    alone = all(dialect.width(row.text) == 1 and begins_with_number(row.text) for row in below)
    return words if len(below) >= FEW_ROWS and alone else 0


def _take_unit(source: Source, reading: Reading, name: Name) -> None:
    if (unit := LENGTHS.get(name.unit)) and reading.unit is None:
        source.notes.found["unit"] = unit


def _angles_in_names(source: Source, dialect: Dialect, cells: list[bytes]) -> bytes | None:
    """The angles of the beams in a header, perhaps with their unit, after other names; None if it has none."""
    lead = next((at for at, cell in enumerate(cells[:MOST_NAMES]) if ANGLE.fullmatch(cell)), MOST_NAMES)
    found = [ANGLE.fullmatch(cell) for cell in cells[lead:]]
    units = {each[3].strip(b" _").lower() for each in found if each}
    words = {each[1] for each in found if each}
    signs = {each[2][:1] == b"-" for each in found if each}
    lengths = {each[4] for each in found if each}
    if (
        any(dialect.number(cell) is not None for cell in cells[:lead])
        or len(found) < MANY_ROWS
        or None in found
        or len(units) != 1
        or len(words) != 1
        or len(lengths) != 1
        # Otherwise these are numbers, or the indices of an array.
        or (units == {b""} and (lead == 0 if words == {None} else len(signs) < 2))
    ):
        return None
    if (unit := TURNS.get(text_of(units.pop()))) and source.reading.angle_unit is None:
        source.notes.found["angle_unit"] = unit
    if (length := lengths.pop()) and (of_ranges := LENGTHS.get(text_of(length))) and source.reading.unit is None:
        source.notes.found["unit"] = of_ranges
    angles = [each[2] if dialect.comma else each[2].replace(b",", b".") for each in found if each]
    return dialect.separator.join([*[b"nan"] * lead, *angles])


def _names(dialect: Dialect, head: list[Row], cells: list[bytes]) -> list[Name]:
    """The names in a header; one of blanks is cut at wider gaps if that fits the rows better."""
    if dialect.separator == b" " and len(head) > 1:
        width = len(dialect.cells(head[1].text))
        # A unit in brackets belongs to the name before it.
        cells = re.sub(rb"\s+(?=[(\[{])", b"", head[0].text.strip()).split()
        wide = re.split(rb"\t+| {2,}|\s*,\s*", head[0].text.strip())
        if len(cells) != width == len(wide):
            cells = wide
    names = units_as_names([name_of(text_of(cell)) for cell in cells])
    return [UNNAMED, *names] if _are_numbered(dialect, head[1:], len(names)) else names


def _are_numbered(dialect: Dialect, rows: list[Row], names: int) -> bool:
    """Whether rows begin with a number, or a name, that the header leaves out, as pandas and R print them."""
    cells = [dialect.cells(row.text) for row in rows[:SAMPLE]]
    cells = [row for row in cells if len(row) == names + 1]
    first = [dialect.number(row[0]) for row in cells]
    return len(cells) > 0.8 * len(rows) and all(
        after is None or (before is not None and after == before + 1) for before, after in pairwise(first)
    )


def _units(dialect: Dialect, line: bytes, names: list[Name]) -> list[Name] | None:
    """The names with the units of a second row of words, where it has any; None if the row is none of words."""
    cells = dialect.cells(line)
    if not 1 < len(cells) <= len(names) or any(cell and dialect.number(cell) is not None for cell in cells):
        return None
    units = [unit_of(text_of(cell).strip("()[]{} ")) for cell in cells]
    said = [name._replace(unit=unit[0], scale=unit[1]) if unit and not name.unit else name
            for name, unit in zip(names, units, strict=False)]  # fmt: skip
    return said + names[len(said) :]


def _read_named(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name]
) -> Recording:
    if reading.columns is not None:
        given = columns_of(reading.columns)
        return _read_columns(source, reading, rows, dialect, given)
    if [name.element for name in names if name.plain == "x"] == [1, 2]:
        raise ValueError(f"{source.name} has lines from one point to another, not scans; {TEXT_FORMS}")
    rows, names = widened(source, rows, dialect, names)
    if (groups := groups_of(names)) is not None:
        return read_groups(source, reading, rows, dialect, names, groups)
    if len(names) < FEW_COLUMNS:
        sample = list(islice(rows := iter(rows), FEW_ROWS))
        rows = chain(sample, rows)
        if 2 * sum(dialect.width(row.text) > len(names) + MANY_BEAMS for row in sample) > len(sample):
            return _read_open_ended(source, reading, rows, dialect, names)
    if (columns := named_columns(names)) is not None:
        rows = list(rows)
        if len(rows) > len(names):
            return _read_columns_of_scans(source, reading, rows, dialect, names, *columns)
    sample = list(islice(rows := iter(rows), FEW_ROWS))
    rows, names = chain(sample, rows), _with_lists(dialect, sample, names)
    ranges = column_of(names, lambda name: name.element < 0 and name.ends("ranges"))
    if ranges is not None and any(map(is_angle, names)):
        cells = [dialect.cells(row.text)[ranges : ranges + 1] for row in sample]
        # One number in a cell is the range of one beam.
        ranges = None if all(dialect.number(cell) is not None for row in cells for cell in row) else ranges
    beams = array_columns(names)
    if ranges is not None or beams:
        if column_of(names, lambda name: name.ends("frame_id")) is not None:
            return read_table(source, reading, rows, dialect, names)
        rows, frame_id = rows_of_one_laser(source, reading, rows, dialect, names, "scans")
        recording = read_table(source, reading, rows, dialect, names)
        return replace(recording, frame_ids=(frame_id,) * len(recording)) if frame_id else recording
    rows, frame_id = rows_of_one_laser(source, reading, rows, dialect, names)
    recording = _read_beams(source, reading, rows, dialect, names)
    return replace(recording, frame_ids=(frame_id,) * len(recording))


def _with_lists(dialect: Dialect, rows: list[Row], names: list[Name]) -> list[Name]:
    """The names, "ranges" for the column whose cells hold lists of many numbers, if it is called otherwise."""
    if column_of(names, lambda name: name.ends("ranges")) is not None:
        return names
    held = [dialect.cells(row.text) for row in rows]
    lists = [at for at, name in enumerate(names) if not is_angle(name) and "intens" not in name.plain
             and held and all(is_long_list(cells[at : at + 1]) for cells in held)]  # fmt: skip
    if not lists:
        return names
    at = next((at for at in lists if is_distance(names[at])), lists[0])
    return [*names[:at], names[at]._replace(plain="ranges"), *names[at + 1 :]]


def _read_open_ended(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name]
) -> Recording:
    """Rows that go on after the columns that a header names: the last name is that of all ranges."""
    lead = len(names) - 1
    rows = list(rows)
    if any(field_of(name) in FIELDS for name in names[:lead]):
        beams = max(dialect.width(row.text) for row in rows) - lead
        return read_table(
            source,
            reading,
            rows,
            dialect,
            [*names[:lead], *(names[-1]._replace(plain="ranges", element=at) for at in range(beams))],
        )

    def plain(row: Row) -> Row:
        cells = dialect.cells(row.text)
        before = [cell if dialect.number(cell) is not None else b"nan" for cell in cells[:lead]]
        return Row(row.number, dialect.separator.join([*before, *cells[lead:]]))

    if (unit := LENGTHS.get(names[-1].unit)) and reading.unit is None:
        source.notes.found["unit"] = unit
    at = column_of(names[:lead], lambda name: name.plain in STAMPS)
    before = lead if reading.skip_columns is None else reading.skip_columns
    words = tuple("stamp" if column == at else "-" for column in range(before))
    return read_scans(source, reading, map(plain, rows), dialect, words)


def _read_columns_of_scans(
    source: Source, reading: Reading, rows: list[Row], dialect: Dialect, names: list[Name], beam: int,
    columns: list[int],
) -> Recording:  # fmt: skip
    """A table with a scan in each column, beside the angles of the beams, or their numbers."""
    table = table_of(source, rows, dialect, names, (beam, *columns))
    first = names[columns[0]]
    if (unit := LENGTHS.get(first.unit)) and reading.unit is None:
        source.notes.found["unit"] = unit
    table[:, columns] *= first.scale
    if is_angle(names[beam]):
        check_angles(source, table, beam)
        if (turn := TURNS.get(names[beam].unit)) and reading.angle_unit is None:
            source.notes.found["angle_unit"] = turn
        table[:, beam] *= names[beam].scale
        columns = first_echoes(source, table, names, beam, columns)
        return columns_beside(source, reading, table, beam, columns)
    tell_columns(source.notes, len(columns))
    return scans_of(source, reading, list(range(len(columns))), list(table[:, columns].T), 0, ())


def _read_beams(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name]
) -> Recording:
    if any(map(is_distance, names)) and any(map(is_angle, names)):
        return read_beams(source, reading, rows, dialect, names)
    if {"x", "y"} <= {name.plain.split("_")[-1] for name in names}:
        return read_beams(source, reading, rows, dialect, names)
    if any(map(is_angle, names)) and len(names) > 2:
        angle = next(at for at, name in enumerate(names) if is_angle(name))
        columns = [at for at in range(len(names)) if at != angle]
        rows = list(rows)
        table = table_of(source, rows, dialect, names, (angle,))
        if alike(table[:, columns]):
            return _read_columns_of_scans(source, reading, rows, dialect, names, angle, columns)
    if any(map(is_distance, names)) and any(map(is_beam, names)):
        return read_numbered(source, reading, rows, dialect, names)
    shown = " ".join(name.plain for name in names[names[0] == UNNAMED :])[:60]
    sample = list(islice(rows, SAMPLE))
    if 2 * sum(_are_numbers(dialect, row) for row in sample) <= len(sample):
        raise ValueError(f"{source.name} begins with {shown!r}, and has no table of numbers below; {TEXT_FORMS}")
    raise ValueError(
        f"{source.name} begins with {shown!r}, which names no column angle; {TEXT_FORMS} "
        "The flag --columns says what the columns hold."
    )


def _are_numbers(dialect: Dialect, row: Row) -> bool:
    """Whether a row has two numbers or more."""
    numbers = [dialect.number(cell) for cell in dialect.cells(row.text)]
    return sum(number is not None and not math.isnan(number) for number in numbers) > 1


def _read_columns(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, given: tuple[str, ...]
) -> Recording:
    """Rows whose columns the Reading names."""
    if "ranges" in given:
        return read_scans(source, reading, rows, dialect, *around_ranges(given))
    return read_beams(source, reading, rows, dialect, [Name(word) for word in given], guess_direction=False)


def _read_numbers(
    source: Source, reading: Reading, head: list[Row], rows: Iterable[Row], dialect: Dialect, names: list[Name] | None
) -> Recording:
    """Rows of numbers without a header: of a scan or of a beam each."""
    if reading.columns is not None:
        return _read_columns(source, reading, rows, dialect, columns_of(reading.columns))
    if names is not None:
        return read_beams(source, reading, rows, dialect, names)
    width = max(dialect.width(row.text) for row in head)
    if reading.skip_columns is None and (spans := scans_over_lines(source, dialect, head, width)) is not None:
        return scans_of(source, reading, *spans, 0, None)
    few = width == 2 or (2 < width < FEW_COLUMNS and len(head) >= MANY_ROWS)
    if few and reading.skip_columns is None and source.reading.angle_increment is None:
        return read_beams(source, reading, rows, dialect, None)
    numbers, values, double = parsed(source, rows, dialect)
    if angles_between(values, reading):
        return read_angles_between(source, reading, values)
    if (beams := interleaved(values, reading)) is not None:
        return read_interleaved(source, reading, values, beams)
    return scans_of(source, reading, numbers, values, double, None)
