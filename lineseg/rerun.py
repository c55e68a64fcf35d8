"""Logs extractions to a rerun recording (rerun.io), next to your other data, with one line of code per frame.

    import rerun as rr
    import lineseg, lineseg.rerun

    rr.init("my_robot")
    rr.save("run.rrd")
    for frame, scan in enumerate(lineseg.open_recording("sample_scans/hallway.npz")):
        rr.set_time("frame", sequence=frame)
        lineseg.rerun.log("laser", lineseg.extract(scan), scan)

Everything lies in the plane z = 0 of the entity that is logged to; a Transform3D there puts it where the laser is.
Importing this module needs rerun, the extra `laser-lineseg[rerun]`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .colours import SEGMENTS, segment_hues
from .installation import install_command
from .scan import Scan
from .segment import Dropped, Extraction, Segment

try:
    import rerun as rr
except ModuleNotFoundError:
    raise ModuleNotFoundError(f"rerun is not installed; `{install_command('rerun')}` installs it") from None

NO_LINE = (140, 145, 152)
# Negative radii are in screen pixels, not in metres.
POINT, LINE, THIN = -1.5, -1.5, -0.75


def log(
    entity: str, extraction: Extraction, scan: Scan | None = None, recording: rr.RecordingStream | None = None
) -> None:
    """Log the segments of a frame at `entity`/segments, and with its scan the points and the dropped candidates.

    recording: rerun's current recording by default.
    """
    rr.log(f"{entity}/segments", segments(extraction), recording=recording)
    if scan is not None:
        rr.log(f"{entity}/points", points(scan, extraction), recording=recording)
        rr.log(f"{entity}/dropped", dropped(scan, extraction.dropped), recording=recording)


def segments(extraction: Extraction) -> rr.LineStrips3D:
    """The segments, in the same colours as in the page."""
    found = extraction.segments
    colours = SEGMENTS[segment_hues(found)]
    labels = [f"beams {segment.first}–{segment.last}, {segment.length:.2f} m" for segment in found]
    return rr.LineStrips3D(segment_strips(found), colors=colours, radii=LINE, labels=labels, show_labels=False)


def points(scan: Scan, extraction: Extraction) -> rr.Points3D:
    """Every valid point, in the colour of its segment, grey if it has none."""
    hues = hue_of_beams(extraction)[scan.valid]
    colours = np.concatenate((np.array([NO_LINE], dtype=np.uint8), SEGMENTS))[hues]
    return rr.Points3D(raised(scan.xy[scan.valid]), colors=colours, radii=POINT)


def dropped(scan: Scan, candidates: Sequence[Dropped]) -> rr.LineStrips3D:
    """The candidates that were not kept, between their outermost points."""
    ends = dropped_strips(scan, candidates)
    return rr.LineStrips3D(ends, colors=[NO_LINE], radii=THIN)


def hues_of(extraction: Extraction) -> NDArray[np.uint16]:
    """(segments,): 1 + which of SEGMENTS each has."""
    return np.array(segment_hues(extraction.segments), dtype=np.uint16) + np.uint16(1)


def hue_of_beams(extraction: Extraction) -> NDArray[np.uint16]:
    """(beams,): as `hues_of`; 0 for a beam without a segment."""
    return np.append(hues_of(extraction), np.uint16(0))[extraction.labels]


def segment_strips(found: Sequence[Segment]) -> NDArray[np.float32]:
    """(n, 2, 3): each from its start to its end."""
    ends = [(segment.start, segment.end) for segment in found]
    return raised(np.array(ends, dtype=float).reshape(-1, 2, 2))


def dropped_strips(scan: Scan, candidates: Sequence[Dropped]) -> NDArray[np.float32]:
    """Candidates whose outermost beams have a return; some methods start at a beam without one."""
    beams = np.array([(candidate.first, candidate.last) for candidate in candidates], dtype=int).reshape(-1, 2)
    found = raised(scan.xy[beams])
    return found[np.isfinite(found).all(axis=(1, 2))]


def raised(xy: NDArray) -> NDArray[np.float32]:
    """(…, 2) → (…, 3) with z = 0."""
    xyz = np.zeros((*xy.shape[:-1], 3), np.float32)
    xyz[..., :2] = xy
    return xyz
