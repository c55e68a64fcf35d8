"""`lineseg bench`: extraction times on this machine."""

from __future__ import annotations

from dataclasses import asdict
from json import dumps
from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from .flag_types import File, Switch, Unset
from .progress import open_with_progress
from .reading import ReadingFlags, reading_of
from .thresholds import Flags, changed


def bench(
    file: Positional[File[Path]] = None,
    *,
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    against: Annotated[Unset[str], arg(metavar="COMMAND")] = None,
    json: Switch = False,
) -> None:
    """Time the extraction, and the least work that it needs.

    Args:
        file: recording to use (default: the samples).
        threshold: thresholds of region growing.
        reading: how to read the file.
        against: command of another program to time on the same frames, such as "./peer --fast". For each frame it
            reads one line of JSON with bearings, ranges (null: no return), range_min and range_max, and writes one
            line: {"us": 12.5} for its own time in µs; after any other line, the time there and back counts.
        json: write JSON instead of a table.
    """
    from lineseg import Params
    from lineseg.bench import bench as measure
    from lineseg.bench import table
    from lineseg.survey import cores

    from ..places import data_folder

    params = changed(Params(), threshold)
    samples = data_folder("sample_scans")
    files = [samples / "hallway.npz", samples / "laboratory.npz"] if file is None else [file]
    reports = []
    for path in files:
        recording = open_with_progress(path, reading_of(reading))
        timings = measure(recording, params, against=against)
        facts = {
            "file": recording.name,
            "frames": len(recording),
            "beams": recording.beams,
            "cores": cores(),
            "against": against,
        }
        reports.append(facts | {"params": params.numbers(), "timings": [asdict(timing) for timing in timings]})
        if not json:
            print(f"{recording.name}, {recording.beams[1]} beams\n{table(timings)}", flush=True)
    if json:
        print(dumps(reports, indent=2))
