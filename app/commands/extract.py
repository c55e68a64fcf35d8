"""`lineseg extract`: writes segments to a file."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.covariance import Noise
from lineseg.readers import TextOptions
from lineseg.writers import SEGMENT_WRITERS, write_segments

from .flag_types import Switch, Unset
from .progress import counted, open_with_progress
from .thresholds import Choice, suggested


def extract(
    file: Positional[Path],
    choice: OmitArgPrefixes[Choice],
    text: OmitArgPrefixes[TextOptions],
    *,
    out: Annotated[Unset[Path], arg(aliases=["-o"])] = None,
    topic: Unset[str] = None,
    range_noise: Unset[float] = None,
    bearing_noise: Unset[float] = None,
    suggest: Switch = False,
) -> None:
    """Write the segments of a recording as JSON lines, CSV or GeoJSON.

    Args:
        file: recording to read.
        choice: method and thresholds (default: from --params, else the method's defaults).
        text: scan geometry that a plain text file does not contain.
        out: file to write, .jsonl, .csv or .geojson (default: JSON lines on standard output).
        topic: laser topic to use (default: the first).
        range_noise: standard deviation of a range [m]; adds (rho, theta) and their covariance to each segment.
        bearing_noise: standard deviation of a bearing [rad]; adds the covariance too.
        suggest: use thresholds that fit the noise of this recording, and print them.
    """
    chosen = choice.thresholds
    noise = None
    if range_noise is not None or bearing_noise is not None:
        noise = Noise(range_noise or 0.0, bearing_noise or 0.0)
    if out is not None and out.suffix.lower().removeprefix(".") not in SEGMENT_WRITERS:
        raise ValueError(f"{out}: use a name that ends in {', '.join(f'.{format}' for format in SEGMENT_WRITERS)}.")
    if out is not None and not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    recording = open_with_progress(file, topic, text)
    if suggest:
        chosen = suggested(recording, chosen, choice.method)
    from lineseg import extract as extract_segments

    scans = counted(enumerate(recording), len(recording), "extract")
    rows = ((frame, scan, extract_segments(scan, chosen)) for frame, scan in scans)
    if out is None:
        write_segments(sys.stdout, "jsonl", rows, noise)
    else:
        write_segments(out, None, rows, noise)
