"""Writes the segments of all frames of a recording from the arrays of a survey: the text of `segments.py`, in bulk."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, TextIO

import msgspec

from ..scan import Recording
from ..survey.result import Survey
from .finite import finite_or_none
from .segments import COLLECTION_END, COLUMNS, About, cell, collection_head, suffix_of, write_lines

# Frames whose numbers are Python objects at a time: so few that the collector of cycles finds nothing to look through,
# which would take longer than all the rest.
CHUNK = 25


# What JSON and GeoJSON both say of a segment. Fields of a common base would stand before those of each.
SHARED = [
    ("first", int),
    ("last", int),
    ("line", tuple[float, float, float]),
    ("points", int),
    ("length", float),
    ("rms", float),
]
_POINT = tuple[float, float]

_Segment = msgspec.defstruct("_Segment", [("start", _POINT), ("end", _POINT), *SHARED])
_Properties = msgspec.defstruct(
    "_Properties", [("frame", int), ("stamp", float | None), ("frame_id", str), ("segment", int), *SHARED]
)


class _Ends(msgspec.Struct, tag_field="type", tag="LineString"):
    """The geometry of a segment in GeoJSON."""

    coordinates: tuple[_POINT, _POINT]


class _Feature(msgspec.Struct, tag_field="type", tag="Feature"):
    """A segment in GeoJSON."""

    geometry: _Ends
    properties: msgspec.Struct


class _Frame(NamedTuple):
    """A frame, and where its segments are in the columns of its chunk."""

    number: int
    stamp: float | None
    frame_id: str
    segments: slice


def survey_json_lines(recording: Recording, survey: Survey, about: About = None) -> Iterator[str]:
    """The same as `json_lines` of all frames, some thousand lines at a time."""
    encoder = msgspec.json.Encoder()
    for frames, column in _chunks(recording, survey):
        starts, ends = zip(column["x1"], column["y1"], strict=True), zip(column["x2"], column["y2"], strict=True)
        lines = zip(column["a"], column["b"], column["c"], strict=True)
        others = (column[name] for name in ("points", "length", "rms"))
        segments = list(map(_Segment, starts, ends, column["first"], column["last"], lines, *others))
        rows: list[dict[str, Any]] = [
            {"frame": number, "stamp": stamp, "frame_id": frame_id, "segments": segments[its]}
            for number, stamp, frame_id, its in frames
        ]
        if about:
            rows[0]["about"] = about
            about = None
        yield encoder.encode_lines(rows).decode()


def survey_geojson(recording: Recording, survey: Survey, about: About = None) -> Iterator[str]:
    """The same as `geojson` of all frames, the features of some frames at a time."""
    encoder = msgspec.json.Encoder()
    yield collection_head(about)
    separator = "\n"
    for frames, column in _chunks(recording, survey):
        starts, ends = zip(column["x1"], column["y1"], strict=True), zip(column["x2"], column["y2"], strict=True)
        lines = zip(column["a"], column["b"], column["c"], strict=True)
        others = (column[name] for name in ("points", "length", "rms"))
        fields = list(zip(column["first"], column["last"], lines, *others, strict=True))
        properties = (
            _Properties(number, stamp, frame_id, segment, *its_fields)
            for number, stamp, frame_id, its in frames
            for segment, its_fields in enumerate(fields[its])
        )
        features = list(map(_Feature, map(_Ends, zip(starts, ends, strict=True)), properties))
        if features:
            yield separator + encoder.encode_lines(features).decode()[:-1].replace("\n", ",\n")
            separator = ",\n"
    yield COLLECTION_END


def survey_csv_lines(recording: Recording, survey: Survey, about: About = None) -> Iterator[str]:
    """The same as `csv_lines` of all frames, the rows of a frame at a time."""
    yield _csv(COLUMNS) + "\n"
    places = ("x1", "y1", "x2", "y2", "first", "last", "a", "b", "c", "points", "length", "rms")
    for frames, column in _chunks(recording, survey):
        rows = list(zip(*(column[name] for name in places), strict=True))
        for number, stamp, frame_id, its in frames:
            head = _csv((number, "" if stamp is None else stamp, cell(frame_id)))
            yield from (f"{head},{row}\n" for row in _csv_rows(rows[its]))


def _csv_rows(rows: list[tuple[Any, ...]]) -> list[str]:
    """Each number as its `repr`; msgspec writes the same ten times as fast, unless `repr` needs an exponent."""
    text = msgspec.json.encode(rows).decode()
    if "0.0000" in text or "e" in text or "null" in text:
        return [",".join(map(repr, row)) for row in rows]
    return text[2:-2].split("],[") if rows else []


def _csv(fields: Iterable[Any]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="").writerow(fields)
    return text.getvalue()


SURVEY_WRITERS = {"jsonl": survey_json_lines, "csv": survey_csv_lines, "geojson": survey_geojson}


def write_survey(
    target: str | Path | TextIO, format: str | None, recording: Recording, survey: Survey, about: About = None
) -> None:
    """The same as `write_segments` of all frames, in a format of SURVEY_WRITERS."""
    write_lines(target, SURVEY_WRITERS[format or suffix_of(target)](recording, survey, about))


def _chunks(recording: Recording, survey: Survey) -> Iterator[tuple[list[_Frame], dict[str, list[Any]]]]:
    """The frames of each chunk, and the columns of their segments."""
    for start in range(0, len(survey), CHUNK):
        stop = min(start + CHUNK, len(survey))
        ends = survey.offsets[start : stop + 1]
        rows, ends = survey.segments[ends[0] : ends[-1]], (ends - ends[0]).tolist()
        stamps = map(finite_or_none, recording.stamps[start:stop].tolist())
        numbers = map(recording.number, range(start, stop))
        spans = map(slice, ends[:-1], ends[1:])
        frames = map(_Frame, numbers, stamps, recording.frame_ids[start:stop], spans)
        yield list(frames), {name: rows[name].tolist() for name in rows.dtype.names or ()}
