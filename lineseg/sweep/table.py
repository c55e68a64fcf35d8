"""Writes and reads a sweep as a table with a row for each file and setting."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from itertools import chain, islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..failing import named
from ..installation import install_command
from ..params import Params
from ..unfinished import whole_file
from ..writers.finite import finite_or_none
from ..writers.segments import cell, text_of_cell
from . import MEASURES, Sweep

ROWS_AT_ONCE = 50_000
# Largest table that is read for display.
MOST_ROWS = 100_000
LARGEST_UNPACKED = 1 << 28
LONGEST_NAME = 1000


@dataclass(frozen=True, eq=False)
class Table:
    """A table that was read: (rows,) the file of each row, and its numbers by name, NaN if missing."""

    files: NDArray[np.str_]
    numbers: dict[str, NDArray[np.float64]]

    @property
    def axes(self) -> dict[str, NDArray[np.float64]]:
        """The swept thresholds, with their values in rising order."""
        values = {name: np.unique(self.numbers[name]) for name, _, _ in Params.knobs()}
        return {name: each for name, each in values.items() if len(each) > 1}


def rows_of(result: Sweep) -> Iterator[dict[str, Any]]:
    """file, the thresholds, frames, and MEASURES; None if a measure is undefined, such as TR without truth."""
    measures = {name: result.totals.measure(name) for name in MEASURES}
    frames = result.totals.column("frames")
    for number, source in enumerate(result.sources):
        for k, params in enumerate(result.grid):
            values = {name: finite_or_none(column[number, k]) for name, column in measures.items()}
            yield {"file": source.file, **asdict(params), "frames": int(frames[number, k]), **values}


def write_table(result: Sweep, path: Path) -> None:
    """Write a sweep as .csv or .parquet; the file appears only when it is complete."""
    with whole_file(path) as unfinished:
        TABLE_WRITERS[path.suffix.lower()](result, unfinished)


def check_table_path(path: Path) -> None:
    """Raises ValueError or FileNotFoundError if the table cannot be written, before hours of work are spent."""
    if path.suffix.lower() not in TABLE_WRITERS:
        raise ValueError(f"{path}: use a name that ends in {' or '.join(TABLE_WRITERS)}")
    if not path.absolute().parent.is_dir():
        raise FileNotFoundError(f"{path}: the folder {path.parent} does not exist")
    if path.suffix.lower() == ".parquet":
        _pyarrow()


def read_table(content: bytes, name: str) -> Table:
    """Read the output of `write_table`. Raises ValueError, starting with `name`, for any other content."""
    suffix = Path(name).suffix.lower()
    if suffix not in TABLE_READERS:
        raise ValueError(f"{name}: the table of a sweep ends in {' or '.join(TABLE_READERS)}; rename the file")
    try:
        with named(""):
            columns = TABLE_READERS[suffix](content)
        wanted = ["file", *(field for field, _, _ in Params.knobs()), "frames", *MEASURES]
        if missing := [column for column in wanted if column not in columns]:
            raise ValueError(f"it has no column {missing[0]!r}; `lineseg sweep` writes {', '.join(wanted)}")
        rows = len(columns["file"])
        if not 0 < rows <= MOST_ROWS:
            raise ValueError(f"it has {rows:,} rows; the page shows 1 to {MOST_ROWS:,}, so sweep fewer values or files")
        numbers = {column: _column(column, columns[column]) for column in wanted[1:]}
        files = [str(cell) for cell in columns["file"]]
        # An array of text takes as much for each row as for the longest.
        if (longest := max(map(len, files))) > LONGEST_NAME:
            raise ValueError(f"a name in column 'file' has {longest:,} characters; allowed are {LONGEST_NAME}")
    except ValueError as error:
        raise ValueError(f"{name} is not the table of a sweep: {error}") from None
    return Table(np.array(files, dtype=np.str_), numbers)


def _column(name: str, cells: list[Any]) -> NDArray[np.float64]:
    numbers = np.empty(len(cells))
    for row, said in enumerate(cells):
        try:
            numbers[row] = np.nan if said is None or said == "" else float(said)
        except ValueError:
            raise ValueError(f"{name} of row {row + 1} is {str(said)[:40]!r}; it must be a number") from None
    if name not in MEASURES and not np.isfinite(numbers).all():
        raise ValueError(f"{name} of row {int(np.argmin(np.isfinite(numbers))) + 1} is missing")
    return numbers


def _read_csv(content: bytes) -> dict[str, list[str]]:
    try:
        rows = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), strict=True)
        head = next(rows, [])
        body = [row for row in islice(rows, MOST_ROWS + 1) if row]
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"it is not CSV: {error}") from None
    for number, row in enumerate(body):
        if len(row) != len(head):
            raise ValueError(f"row {number + 1} has {len(row)} cells, but the header has {len(head)}")
    columns = dict(zip(head, map(list, zip(*body, strict=True)), strict=True)) if body else {name: [] for name in head}
    return {
        name: [text_of_cell(each) for each in cells] if name == "file" else cells for name, cells in columns.items()
    }


def _read_parquet(content: bytes) -> dict[str, list[Any]]:
    arrow, parquet = _pyarrow()
    try:
        file = parquet.ParquetFile(arrow.BufferReader(content), read_dictionary=["file"])
        about = file.metadata
        if about.num_rows > MOST_ROWS:
            raise ValueError(f"it has {about.num_rows:,} rows; the page shows at most {MOST_ROWS:,}")
        groups = [about.row_group(number) for number in range(about.num_row_groups)]
        size = sum(
            group.column(number).total_uncompressed_size for group in groups for number in range(about.num_columns)
        )
        if size > LARGEST_UNPACKED:
            raise ValueError(f"it would have more than {LARGEST_UNPACKED >> 20} MB unpacked, which is not allowed")
        table = file.read(columns=[field.name for field in file.schema_arrow if _is_plain(arrow, field)])
        return {name: list(_cells(table[name])) for name in table.column_names}
    except (arrow.ArrowException, OSError) as error:
        raise ValueError(f"it is not Parquet: {error}") from None


def _is_plain(arrow: Any, field: Any) -> bool:
    """Whether a column can be one of ours: names of files, or numbers."""
    kinds = arrow.types
    if field.name == "file":
        return kinds.is_dictionary(field.type)
    return kinds.is_integer(field.type) or kinds.is_floating(field.type) or kinds.is_null(field.type)


def _cells(column: Any) -> Iterator[Any]:
    """The values of a column. A name that repeats is one object, however often it does."""
    for chunk in column.chunks:
        if not hasattr(chunk, "dictionary"):
            yield from chunk.to_pylist()
            continue
        names = chunk.dictionary.to_pylist()
        yield from (None if index is None else names[index] for index in chunk.indices.to_pylist())


def _write_csv(result: Sweep, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = rows_of(result)
        first = next(rows)
        writer = csv.DictWriter(file, first, lineterminator="\n")
        writer.writeheader()
        writer.writerows({**row, "file": cell(row["file"])} for row in chain([first], rows))


def _write_parquet(result: Sweep, path: Path) -> None:
    arrow, parquet = _pyarrow()
    schema = _schema(arrow)
    rows = rows_of(result)
    with parquet.ParquetWriter(path, schema) as writer:
        while block := list(islice(rows, ROWS_AT_ONCE)):
            writer.write_table(arrow.Table.from_pylist(block, schema))


def _schema(arrow: Any) -> Any:
    thresholds = [(name, arrow.int64() if kind is int else arrow.float64()) for name, kind, _ in Params.knobs()]
    measures = [(name, arrow.float64()) for name in MEASURES]
    return arrow.schema([("file", arrow.string()), *thresholds, ("frames", arrow.int64()), *measures])


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise ValueError(f"a .parquet file needs pyarrow; `{install_command('parquet')}` installs it") from None
    return pyarrow, pyarrow.parquet


TABLE_READERS: dict[str, Callable[[bytes], dict[str, list[Any]]]] = {".csv": _read_csv, ".parquet": _read_parquet}
TABLE_WRITERS: dict[str, Callable[[Sweep, Path], None]] = {".csv": _write_csv, ".parquet": _write_parquet}
