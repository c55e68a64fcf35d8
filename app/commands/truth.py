"""`lineseg truth`: writes a recording with the walls that its scans agree on."""

from __future__ import annotations

import json as json_format
import sys
from pathlib import Path
from typing import Annotated

import numpy as np
from tyro.conf import OmitArgPrefixes, Positional, arg

from .flag_types import Switch
from .progress import open_with_progress, progress_bar
from .reading import ReadingFlags, reading_of


def truth(
    file: Positional[Path],
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    out: Annotated[Path, arg(aliases=["-o"])],
    json: Switch = False,
) -> None:
    """Find the walls that many scans with poses agree on.

    The recording is written with the wall of each beam. Where too few scans from different places saw something, the
    truth is unknown (wall = -2), and scores leave these beams out. The poses are corrected a little where that makes
    the walls thinner.

    Args:
        file: recording to read; its scans need poses.
        reading: how to read the file.
        out: .npz file to write: ranges, poses, walls and wall. `score`, `tune`, `compare` and the page use it.
        json: print the report as JSON.
    """
    from lineseg.many_views import truth_by_many_views
    from lineseg.readers import save_npz

    if out.suffix.lower() != ".npz":
        raise ValueError(f"{out}: use a name that ends in .npz.")
    if not out.absolute().parent.is_dir():
        raise FileNotFoundError(f"{out}: the folder {out.parent} does not exist.")
    recording = open_with_progress(file, reading_of(reading))
    with progress_bar("truth", "step") as advance:
        found = truth_by_many_views(recording, advance)
    save_npz(found.recording, out)
    if json:
        report = {name: getattr(found, name) for name in ("thickness", "thickness_before", "explained", "unknown")}
        report |= {"shift_median": float(np.median(found.shift)), "shift_most": float(found.shift.max())}
        report |= {"turn_median": float(np.median(found.turn)), "turn_most": float(found.turn.max())}
        print(json_format.dumps(report | {"trusted": found.trusted, "reason": found.reason}))
    else:
        print(found.text)
    if not found.trusted:
        print(f"lineseg: {out}: {found.reason}", file=sys.stderr)
