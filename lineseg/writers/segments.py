"""Writes segments as JSON lines (one line per scan, even without segments), CSV (one row per segment) and GeoJSON.

With the noise of the beams, each segment also has its (ρ, θ) and their covariance; see `lineseg.covariance`.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TextIO

import msgspec
import numpy as np

from ..covariance import Noise, covariances
from ..scan import Scan
from ..segment import Extraction, Segment
from ..unfinished import whole_file
from .finite import finite_or_none

Rows = Iterable[tuple[int, Scan, Extraction]]
About = Mapping[str, Any] | None
COLUMNS = (
    "frame", "stamp", "frame_id", "start_x", "start_y", "end_x", "end_y", "first", "last", "a", "b", "c", "points",
    "length", "rms",
)  # fmt: skip
# How what a spreadsheet computes begins.
FORMULAS = ("=", "+", "-", "@", "\t", "\r")
METRES = "metres in the frame of the laser, x ahead and y to the left; not degrees"
COLLECTION_END = "\n]}\n"
POLAR_COLUMNS = ("rho", "theta", "var_rho", "cov_rho_theta", "var_theta")


def json_lines(rows: Rows, noise: Noise | None = None, about: About = None) -> Iterator[str]:
    """One object per line: frame, stamp, frame_id, and segments of start, end, first, last, line, points, length, rms.

    With `noise` also rho, theta and covariance, [[var ρ, cov], [cov, var θ]]. One line for each scan; null for a stamp
    that is not finite and for an undefined covariance. about: how they were made, written into the first line.
    """
    for frame, scan, extraction in rows:
        segments = _segments(scan, extraction, noise)
        row = {"frame": frame, "stamp": finite_or_none(scan.stamp), "frame_id": scan.frame_id, "segments": segments}
        if about:
            row["about"] = about
            about = None
        yield _text(row) + "\n"


def geojson(rows: Rows, noise: Noise | None = None, about: About = None) -> Iterator[str]:
    """A FeatureCollection with a LineString for each segment; the other fields of `json_lines` are its properties.

    Coordinates are metres in the frame of the laser, not degrees, as its member `coordinates` says.
    """
    yield collection_head(about)
    separator = "\n"
    for frame, scan, extraction in rows:
        for number, fields in enumerate(_segments(scan, extraction, noise)):
            line = {"type": "LineString", "coordinates": [fields.pop("start"), fields.pop("end")]}
            about = {"frame": frame, "stamp": finite_or_none(scan.stamp), "frame_id": scan.frame_id, "segment": number}
            feature = {"type": "Feature", "geometry": line, "properties": about | fields}
            yield separator + _text(feature)
            separator = ",\n"
    yield COLLECTION_END


def collection_head(about: About) -> str:
    """What stands before the features of GeoJSON."""
    head = f'"about":{_text(about)},' if about else ""
    return f'{{"type":"FeatureCollection","coordinates":"{METRES}",{head}"features":['


def csv_lines(rows: Rows, noise: Noise | None = None, about: About = None) -> Iterator[str]:
    """A header and a row for each segment, with enough digits to restore every number exactly; no place for `about`."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS if noise is None else (*COLUMNS, *POLAR_COLUMNS))
    for frame, scan, extraction in rows:
        stamp = finite_or_none(scan.stamp)
        polars = [()] * len(extraction.segments) if noise is None else _polar(scan, extraction, noise)
        for segment, polar in zip(extraction.segments, polars, strict=True):
            place = (*segment.start, *segment.end, segment.first, segment.last)
            fit = (*segment.line, segment.points, segment.length, segment.rms)
            writer.writerow((frame, "" if stamp is None else stamp, cell(scan.frame_id), *place, *fit, *polar))
        yield text.getvalue()
        text.seek(0)
        text.truncate()
    yield text.getvalue()


def cell(text: str) -> str:
    """A text for CSV: a spreadsheet would compute what begins like a formula, so that has an apostrophe before it."""
    return f"'{text}" if text.startswith(FORMULAS) else text


def text_of_cell(written: str) -> str:
    """The text that `cell` wrote."""
    return written[1:] if written.startswith("'") and written[1:].startswith(FORMULAS) else written


# Suffix → writer: takes rows of (frame, scan, extraction), yields pieces of text.
SEGMENT_WRITERS: dict[str, Callable[[Rows, Noise | None, About], Iterator[str]]] = {
    "jsonl": json_lines,
    "csv": csv_lines,
    "geojson": geojson,
}


def segment_lines(format: str, rows: Rows, noise: Noise | None = None, about: About = None) -> Iterator[str]:
    """The text of `rows` in a format of SEGMENT_WRITERS, piece by piece; with covariances if the noise is given."""
    if format not in SEGMENT_WRITERS:
        raise ValueError(f"segments cannot be written as {format!r}; choose from {', '.join(SEGMENT_WRITERS)}.")
    return SEGMENT_WRITERS[format](rows, noise, about)


def write_segments(
    target: str | Path | TextIO, format: str | None, rows: Rows, noise: Noise | None = None, about: About = None
) -> None:
    """Write `rows` to a path or an open text file, row by row; format: None to use the path's suffix.

    noise: of the beams, to write covariances too. about: how the segments were made, where the format has a place.
    The file appears under its name when it is complete; an existing file stays until then.
    """
    write_lines(target, segment_lines(format or suffix_of(target), rows, noise, about))


def suffix_of(target: str | Path | TextIO) -> str:
    """The format that the name of a path tells; "jsonl" for an open file."""
    return Path(target).suffix.lstrip(".").lower() if isinstance(target, str | Path) else "jsonl"


def write_lines(target: str | Path | TextIO, lines: Iterable[str]) -> None:
    """Write text to an open file, or to a path, where it appears when it is complete."""
    if not isinstance(target, str | Path):
        target.writelines(lines)
        return
    with whole_file(Path(target)) as unfinished, unfinished.open("w", encoding="utf-8", newline="") as file:
        file.writelines(lines)


def _segments(scan: Scan, extraction: Extraction, noise: Noise | None) -> list[dict[str, object]]:
    """The fields of each segment for JSON."""
    segments = [_fields(segment) for segment in extraction.segments]
    if noise is not None:
        for fields, polar in zip(segments, _polar(scan, extraction, noise), strict=True):
            rho, theta, *matrix = polar
            var_rho, cov, var_theta = map(finite_or_none, matrix)
            fields |= {"rho": rho, "theta": theta, "covariance": [[var_rho, cov], [cov, var_theta]]}
    return segments


def _fields(segment: Segment) -> dict[str, object]:
    line, start, end, first, last, points, length, rms = segment
    return {
        "start": start,
        "end": end,
        "first": first,
        "last": last,
        "line": line,
        "points": points,
        "length": length,
        "rms": rms,
    }


def _text(value: object) -> str:
    """JSON; numpy's numbers, which an extractor of one's own may leave in a segment, are numbers in it."""
    return msgspec.json.encode(value, enc_hook=np.generic.item).decode()


def _polar(scan: Scan, extraction: Extraction, noise: Noise) -> list[tuple[float, ...]]:
    """POLAR_COLUMNS of each segment."""
    matrices = covariances(scan, extraction, noise)[:, (0, 0, 1), (0, 1, 1)].tolist()
    return [(segment.rho, segment.theta, *m) for segment, m in zip(extraction.segments, matrices, strict=True)]
