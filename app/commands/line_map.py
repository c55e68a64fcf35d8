"""`lineseg map`: merges the lines of all frames into a map."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from ..made import about_of
from .flag_types import Switch
from .progress import open_with_progress, progress_bar
from .reading import ReadingFlags, reading_of
from .thresholds import Choice, Flags, suggested


def line_map(
    file: Positional[Path],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    suggest: Switch = False,
    least_scans: int = 3,
) -> None:
    """Merge the lines of all frames into a map of the world.

    The poses of the recording place them. Lines are merged if they overlap and lie within the noise of the beams and of
    the poses. Prints how many returns lie on the map. For poses that were corrected, run `lineseg truth` first, and
    this on the file that it writes.

    Args:
        file: recording to read; its scans need poses.
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        reading: how to read the file.
        out: file to write, .geojson, .svg, .dxf (needs ezdxf) or .npz; coordinates are metres.
        suggest: use thresholds that fit the noise of the recording, and print them.
        least_scans: parts of lines that fewer scans saw are left out.
    """
    from lineseg.line_map import line_map as make
    from lineseg.writers.line_maps import check_map_path, write_map

    if least_scans < 1:
        raise ValueError(f"--least-scans is {least_scans}; give 1 or more.")
    chosen = method.thresholds(threshold)
    check_map_path(out)
    recording = open_with_progress(file, reading_of(reading))
    used = suggested(recording, chosen, method.name) if suggest else chosen
    with progress_bar("map", "%") as advance:
        found = make(recording, used, least=least_scans, progress=advance)
    write_map(found, out, f"{recording.name}, line map", about_of(recording, method.name, used))
    print(found.text)
