"""`lineseg record`: writes a recording for rerun."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from .flag_types import Switch
from .progress import open_with_progress, progress_bar
from .reading import ReadingFlags, reading_of
from .thresholds import Choice, Flags


def record(
    file: Positional[Annotated[Path, arg(metavar="FILE")]],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    steps: Switch = False,
) -> None:
    """Write a recording for rerun.

    It contains the points, segments, decisions and scores of every frame.

    Args:
        file: recording to read.
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        reading: how to read the file.
        out: file to write, .rrd; open it with `rerun run.rrd`.
        steps: include every decision of every frame, on a timeline `step`.
    """
    if out.suffix.lower() != ".rrd":
        raise ValueError(f"{out}: use a name that ends in .rrd.")
    if not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    chosen = method.thresholds(threshold)
    from ..rerun.record import Run, save

    recording = open_with_progress(file, reading_of(reading))
    run = Run(recording, file.name, method.name, chosen, range(len(recording)), steps)
    with progress_bar("record", "scan") as advance:
        save(run, out, advance)
