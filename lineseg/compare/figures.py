"""A comparison as pictures: the times over the frames (Fig. 9), and one frame by every method (Fig. 10)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..extractors import EXTRACTORS
from ..scan import Recording
from ..sweep.plot import figure_type
from ..unfinished import whole_file
from .comparison import Row


def write_figures(rows: Sequence[Row], recording: Recording, frames: Sequence[int], folder: Path) -> list[Path]:
    """Write NAME_times.svg, and NAME_lines.svg for the middle frame, both as installed."""
    rows = [row for row in rows if row.recording == recording.name and row.setting == "installed"]
    stem, kind = Path(recording.name).stem, figure_type()
    files = [folder / f"{stem}_times.svg", folder / f"{stem}_lines.svg"]
    for path, figure in zip(files, (_times(kind, rows, frames), _lines(kind, rows, recording, frames)), strict=True):
        with whole_file(path) as unfinished:
            figure.savefig(unfinished, format="svg")
    return files


def _times(kind: Any, rows: Sequence[Row], frames: Sequence[int]) -> Any:
    figure = kind(figsize=(9, 5), layout="constrained")
    plot = figure.subplots()
    for row in rows:
        if row.times is not None:
            plot.plot(frames, row.times, label=row.label, linewidth=1)
    plot.set(xlabel="frame", ylabel="time [µs]", yscale="log")
    plot.grid(alpha=0.3)
    plot.legend(fontsize=8)
    return figure


def _lines(kind: Any, rows: Sequence[Row], recording: Recording, frames: Sequence[int]) -> Any:
    frame = frames[len(frames) // 2]
    scan, across = recording[frame], min(len(rows), 5)
    figure = kind(figsize=(3.2 * across, 3.2 * -(-len(rows) // across)), layout="constrained")
    for place, row in enumerate(rows, 1):
        plot = figure.add_subplot(-(-len(rows) // across), across, place)
        plot.plot(*scan.xy[scan.valid].T, ".", color="0.7", markersize=1)
        for segment in EXTRACTORS[row.method].extract(scan, row.params).segments:
            plot.plot(*zip(segment.start, segment.end, strict=True), linewidth=1.5)
        plot.set_title(row.label, fontsize=8)
        plot.set_aspect("equal")
        plot.axis("off")
    figure.suptitle(f"{recording.name}, frame {recording.number(frame)}", fontsize=10)
    return figure
