"""`lineseg record`: writes a recording for rerun."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.readers import TextOptions

from .flag_types import Switch, Unset
from .progress import open_with_progress, progress_bar
from .thresholds import Choice


def record(
    file: Positional[Path],
    choice: OmitArgPrefixes[Choice],
    text: OmitArgPrefixes[TextOptions],
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    frames: str = ":",
    steps: Switch = False,
    topic: Unset[str] = None,
) -> None:
    """Write a recording for rerun: points, segments, decisions and scores of every frame.

    Args:
        file: recording to read.
        choice: method and thresholds (default: from --params, else the method's defaults).
        text: scan geometry that a plain text file does not contain.
        out: file to write, .rrd; open it with `rerun run.rrd`.
        frames: FIRST:STOP, counted from 0, without STOP; either may be left out (default: all).
        steps: include every decision of every frame, on a timeline `step`.
        topic: laser topic to use (default: the first).
    """
    if out.suffix.lower() != ".rrd":
        raise ValueError(f"{out}: use a name that ends in .rrd.")
    if not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    chosen = choice.thresholds
    from ..rerun.record import Run, save

    recording = open_with_progress(file, topic, text)
    run = Run(recording, file.name, choice.method, chosen, frames_of(frames, len(recording)), steps)
    with progress_bar("record", "scan") as advance:
        save(run, out, advance)


def frames_of(text: str, frames: int) -> range:
    """The range FIRST:STOP out of `frames` frames. Raises ValueError for other text or an empty range."""
    first, colon, stop = text.partition(":")
    try:
        chosen = range(frames)[int(first) if first else None : int(stop) if stop else None]
    except ValueError:
        chosen = range(0)
        colon = ""
    if not colon:
        raise ValueError(f"frames is {text!r}; give FIRST:STOP, such as 100:200, 100: or :200.")
    if not chosen:
        raise ValueError(f"frames is {text!r}, which is empty; the recording has the frames 0 to {frames - 1}.")
    return chosen
