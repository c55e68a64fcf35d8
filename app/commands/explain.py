"""`lineseg explain`: why a beam is in a line or in none, and why two beams are in one line or in two."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg import Thresholds, trace, what_if, why_apart
from lineseg.scan import Scan

from .flag_types import Unset
from .progress import open_with_progress
from .reading import ReadingFlags, reading_of
from .thresholds import Choice, Flags


def explain(
    file: Positional[Annotated[Path, arg(metavar="FILE")]],
    frame: Positional[Annotated[int, arg(metavar="FRAME")]],
    beam: Positional[Annotated[int, arg(metavar="BEAM")]],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    beside: Annotated[Unset[int], arg(metavar="BEAM")] = None,
) -> None:
    """Say why a beam is in a line or in none.

    Also says what would change that and, with --beside, why two beams are in one line or in two.

    Args:
        file: a recording.
        frame: the frame, from 0.
        beam: the beam, from 0.
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        reading: how to read the file.
        beside: another beam: why are both in one line, or not?
    """
    params = method.thresholds(threshold)
    recording = open_with_progress(file, reading_of(reading))
    if not recording.has(frame):
        raise ValueError(f"{file}: there is no frame {frame}; it has {len(recording)}, from {recording.number(0)}.")
    scan = recording[recording.position(frame)]
    for sentence in _sentences(scan, beam, beside, params, method.name):
        print(sentence)


def _sentences(scan: Scan, beam: int, beside: int | None, params: Thresholds, method: str) -> list[str]:
    if beside is not None:
        relation = why_apart(scan, beam, beside, params, method)
        return [relation.text, *(change.text for change in relation.changes)]
    changes = what_if(scan, beam, params, method)
    said = trace(scan, params).explain(beam).text
    return [said, *(change.text for change in changes if change.value is not None)]
