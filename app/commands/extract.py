"""`lineseg extract`: writes segments to files."""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.covariance import Noise
from lineseg.extractors import EXTRACTORS
from lineseg.knobs import Thresholds
from lineseg.params import Params
from lineseg.scan import Recording
from lineseg.survey import survey
from lineseg.unfinished import write_whole
from lineseg.writers import SEGMENT_WRITERS, write_segments
from lineseg.writers.segments import suffix_of
from lineseg.writers.whole import SURVEY_WRITERS, write_survey

from ..made import about_of
from .flag_types import Files, Switch, Unset
from .noise import noise_of
from .progress import counted, open_with_progress, progress_bar
from .reading import ReadingFlags, each_file, files_of, reading_of
from .thresholds import Choice, Flags, suggested


def extract(
    files: Positional[Files[str]],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    out: Annotated[Unset[Path], arg(aliases=["-o"])] = None,
    range_noise: Unset[float] = None,
    bearing_noise: Unset[float] = None,
    suggest: Switch = False,
) -> None:
    """Write the segments of recordings as JSON lines, CSV or GeoJSON.

    The output also says how the recordings were read and extracted.

    Args:
        files: recordings to read; * and ? stand for several.
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        reading: how to read the files.
        out: file to write, .jsonl, .csv or .geojson; for several recordings a folder, where each gets a .jsonl file.
            A folder that is missing is made.
            Without it, JSON lines go to standard output. A .csv file gets a .csv.json beside it, with the reading
            and the thresholds.
        range_noise: standard deviation of a range [m]; adds (rho, theta) and their covariance to each segment.
        bearing_noise: standard deviation of a bearing [rad]; adds the covariance too.
        suggest: use thresholds that fit the noise of each recording, and print them.
    """
    chosen, how = method.thresholds(threshold), reading_of(reading)
    noise = noise_of(range_noise, bearing_noise)
    targets = _targets(files_of(files), out)

    def work(file: Path) -> None:
        recording = open_with_progress(file, how)
        used = suggested(recording, chosen, method.name) if suggest else chosen
        _write(recording, method.name, used, targets[file], noise)

    each_file(files, work)


def _targets(files: list[Path], out: Path | None) -> dict[Path, Path | None]:
    """The file to write for each recording; None: standard output."""
    if out is None:
        return dict.fromkeys(files)
    if out.is_dir():
        names = Counter(file.name for file in files)
        # Files of one name come from several folders.
        return {
            file: out / f"{f'{file.absolute().parent.name}_' if names[file.name] > 1 else ''}{file.name}.jsonl"
            for file in files
        }
    known = out.suffix.lower().removeprefix(".") in SEGMENT_WRITERS
    if len(files) > 1:
        if known or out.exists():
            raise ValueError(f"{out}: segments of {len(files)} recordings go into a folder; name a folder.")
        out.mkdir(parents=True)
        return _targets(files, out)
    if not known:
        raise ValueError(f"{out}: use a name that ends in {', '.join(f'.{format}' for format in SEGMENT_WRITERS)}.")
    if not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    return dict.fromkeys(files, out)


def _write(recording: Recording, method: str, params: Thresholds, target: Path | None, noise: Noise | None) -> None:
    about = about_of(recording, method, params)
    to = sys.stdout if target is None else target
    if isinstance(params, Params) and noise is None and suffix_of(to) in SURVEY_WRITERS:
        with progress_bar("extract", "scan") as advance:
            found = survey(recording, params, scores=False, progress=advance)
        write_survey(to, None, recording, found, about)
    else:
        extract_segments = EXTRACTORS[method].extract
        scans = counted(enumerate(recording), len(recording), "extract")
        rows = ((recording.number(frame), scan, extract_segments(scan, params)) for frame, scan in scans)
        write_segments(to, None, rows, noise, about)
    if target is not None and target.suffix.lower() == ".csv":
        write_whole(target.with_name(f"{target.name}.json"), json.dumps(about, indent=1) + "\n")
