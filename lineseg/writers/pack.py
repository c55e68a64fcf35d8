"""Writes failure packs: one frame and its results, in a zip that opens again as a recording."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..arguments import need_recording
from ..extractors import method_of
from ..knobs import Thresholds
from ..params import Params
from ..readers import save_npz
from ..readers.pack import ABOUT, FORMAT, FRAME, VERSION
from ..scan import PackAbout, Recording, Scan
from ..tracing.decisions import Trace
from ..truth.labels import FrameLabels
from .figure import figure_svg, figure_title
from .segments import segment_lines

# A fixed date, so that equal packs have equal bytes.
STAMP = (1980, 1, 1, 0, 0, 0)


def write_pack(
    target: str | Path | BinaryIO,
    recording: Recording,
    frame: int,
    params: Thresholds | None = None,
    note: str = "",
    labels: FrameLabels | None = None,
) -> None:
    """Write a zip of the frame (frame.npz, frame.csv), its segments, the trace, a drawing, the thresholds and a note.

    labels: what is said of the frame, which lineseg.json holds beside how the file was read. `open_recording` opens
    the pack as a recording of one frame, `read_params` reads its lineseg.json. A pack made from a pack keeps the
    original source.
    """
    need_recording(recording)
    params = Params() if params is None else params
    method = method_of(params)
    alone = recording.only(np.array([frame]))
    scan = alone[0]
    traced = method.trace(scan, params)
    found = traced.extraction
    former = recording.pack
    name, number = (former.recording, former.frame) if former is not None else (recording.name, recording.number(frame))
    about = {"format": FORMAT, "version": VERSION} | asdict(
        PackAbout(name, number, method.name, params.numbers(), note, _said(labels))
    )
    if recording.account is not None and former is None:
        about["reading"] = recording.account.used.given()
    title = figure_title(recording, frame, method.label)
    given = None if recording.account is None else recording.account.given
    with zipfile.ZipFile(target, "w") as pack:
        # First, so that the first bytes identify the file.
        _add(pack, ABOUT, json.dumps(about, ensure_ascii=False, indent=2))
        _add(pack, FRAME, _npz(alone))
        _add(pack, "frame.csv", "".join(_beams(scan, found.labels)))
        _add(pack, "segments.jsonl", "".join(segment_lines("jsonl", [(number, scan, found)])))
        _add(pack, "trace.jsonl", "".join(_decisions(traced)))
        _add(pack, "picture.svg", figure_svg(scan, found, title, params, reading=given))
        _add(pack, "note.txt", note + "\n")


def _said(labels: FrameLabels | None) -> dict[str, Any] | None:
    """Labels for JSON; None if they say nothing."""
    if labels is None or (labels.lines is None and not labels.tags and not labels.note):
        return None
    return {name: value for name, value in asdict(labels).items() if name != "revision"}


def _add(pack: zipfile.ZipFile, name: str, content: str | bytes) -> None:
    # An NPZ is already compressed.
    kind = zipfile.ZIP_STORED if name == FRAME else zipfile.ZIP_DEFLATED
    pack.writestr(zipfile.ZipInfo(name, STAMP), content, kind)


def _npz(recording: Recording) -> bytes:
    content = io.BytesIO()
    save_npz(recording, content)
    return content.getvalue()


def _beams(scan: Scan, labels: np.ndarray) -> Iterator[str]:
    yield "beam,bearing,range,valid,segment\n"
    columns = (scan.bearings.tolist(), scan.ranges.tolist(), scan.valid.tolist(), labels.tolist())
    for beam, (bearing, distance, valid, label) in enumerate(zip(*columns, strict=True)):
        yield f"{beam},{bearing!r},{distance!r},{int(valid)},{label}\n"


def _decisions(traced: Trace) -> Iterator[str]:
    for decision in traced:
        fields: dict[str, Any] = asdict(decision)
        # JSON has neither NaN nor infinity.
        fields |= {name: None for name in ("value", "limit") if not np.isfinite(fields[name])}
        yield json.dumps(fields, ensure_ascii=False) + "\n"
