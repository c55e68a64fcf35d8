"""The first scans of a recording as a Reading would have them, for the panel in which people choose one."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lineseg import Recording
from lineseg.readers import Reading, format_of, open_recording
from lineseg.readers.reading import TEXT_FORMATS
from lineseg.unfinished import temporary_folder

from .library import Library

MOST_SCANS, MOST_POINTS = 4, 800
# Of a longer text only this much is read, so that a field can be tried out while typing.
MOST_TEXT = 1 << 20
NAMED = re.compile(r"--([a-z][a-z-]+)|\b([a-z]+(?:_[a-z]+)+)\b")


@dataclass(frozen=True, eq=False)
class Preview:
    """recording: as read, perhaps only its beginning; whole: whether it is all of it."""

    recording: Recording
    whole: bool

    def points(self) -> list[list[tuple[float, float]]]:
        """The valid points of the first scans [m], thinned."""
        return [_points(self.recording[frame].xy) for frame in range(min(MOST_SCANS, len(self.recording)))]


def preview(library: Library, id: str, reading: Reading, wanted: Callable[[], bool]) -> Preview:
    """Read a recording for a look. Raises Cancelled once it is not `wanted`, ValueError or OSError as the library."""
    path = library.path(id)
    long = path.is_file() and path.stat().st_size > MOST_TEXT
    if not long or reading.frames or reading.seconds or format_of(path) not in TEXT_FORMATS:
        return Preview(library.recording(id, reading, wanted=wanted), True)
    with temporary_folder() as folder:
        begin = Path(folder) / path.name
        with path.open("rb") as file:
            begin.write_bytes(file.read(MOST_TEXT).rpartition(b"\n")[0] + b"\n")
        return Preview(open_recording(begin, reading), False)


def named_in(sentence: str) -> list[str]:
    """The fields of a Reading that a sentence names, as in "give angle_increment" or "--unit mm"."""
    words = ((flag or name).replace("-", "_") for flag, name in NAMED.findall(sentence))
    return list(dict.fromkeys(word for word in words if word in Reading.declared()))


def _points(xy: np.ndarray[Any, Any]) -> list[tuple[float, float]]:
    there = xy[np.isfinite(xy).all(axis=1)]
    thinned = there[:: -(-len(there) // MOST_POINTS) or 1]
    return [(round(float(x), 3), round(float(y), 3)) for x, y in thinned]
