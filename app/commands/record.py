"""`lineseg record`: a recording for rerun."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.readers import TextOptions

from .progress import open_with_progress, progress_bar
from .thresholds import Choice


def record(
    file: Positional[Path],
    choice: OmitArgPrefixes[Choice],
    text: OmitArgPrefixes[TextOptions],
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    frames: str = ":",
    steps: bool = False,
    topic: str | None = None,
) -> None:
    """Write a recording for rerun: points, segments, decisions and scores of every frame.

    Args:
        file: recording to read.
        choice: method and thresholds; what is not given is taken from --params, or is the default.
        text: what a plain text file does not say about itself.
        out: file to write, .rrd; `rerun run.rrd` opens it.
        frames: FIRST:STOP, counted from 0, the latter not included; either may be left out.
        steps: with every decision of every frame, on a timeline `step`.
        topic: laser topic to take; the first without.
    """
    if out.suffix.lower() != ".rrd":
        raise ValueError(f"{out}: a recording for rerun is written as .rrd.")
    if not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    chosen = choice.thresholds
    from ..rerun.record import Run, save

    recording = open_with_progress(file, topic, text)
    run = Run(recording, file.name, choice.method, chosen, frames_of(frames, len(recording)), steps)
    with progress_bar("record", "scan") as advance:
        save(run, out, advance)


def frames_of(text: str, frames: int) -> range:
    """The frames FIRST:STOP of so many; a ValueError if it is no such thing, or holds none."""
    first, colon, stop = text.partition(":")
    try:
        chosen = range(frames)[int(first) if first else None : int(stop) if stop else None]
    except ValueError:
        chosen = range(0)
        colon = ""
    if not colon:
        raise ValueError(f"frames is {text!r}; expected is FIRST:STOP, such as 100:200, 100: or :200.")
    if not chosen:
        raise ValueError(f"frames is {text!r}, which holds none; the recording has the frames 0 to {frames - 1}.")
    return chosen
