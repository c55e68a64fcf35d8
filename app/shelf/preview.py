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
MOST_LINES, LONGEST_LINE = 5, 160
HEAD_BYTES = 1 << 14
# Of a longer text only this much is read, so that a field can be tried out while typing.
MOST_TEXT = 1 << 20
FLAG = re.compile(r"(?<![\w`-])(flag )?--([a-z][a-z-]+)(?:=(\S*\w))?")
# Not the arguments of a call, as in numpy.savez(…, angle_min=0).
NAMED = re.compile(r"--([a-z][a-z-]+)|\b([a-z]+(?:_[a-z]+)+)\b(?!=)")


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


def for_the_page(sentence: str) -> str:
    """A sentence that names fields of a Reading as the page does, not as flags of the command line."""

    def field(found: re.Match[str]) -> str:
        declared = Reading.declared().get(found[2].replace("-", "_"))
        if declared is None:
            return found[0]
        return f"{'' if found[1] else 'the '}field “{declared.label}”{f': {found[3]}' if found[3] else ''}"

    return FLAG.sub(field, sentence)


def first_lines(path: Path) -> list[str]:
    """The first lines of a text file, cut if they are long; none of other files."""
    if not path.is_file():
        return []
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    wide = head.startswith((b"\xff\xfe", b"\xfe\xff"))
    if b"\0" in head and not wide:
        return []
    text = head.decode("utf-16", errors="replace") if wide else _decoded(head)
    lines = [line if len(line) <= LONGEST_LINE else f"{line[:LONGEST_LINE]}…" for line in text.splitlines()]
    return [
        "".join(char if char.isprintable() or char == "\t" else "�" for char in line) for line in lines[:MOST_LINES]
    ]


def _decoded(head: bytes) -> str:
    try:
        # The end may be in the middle of a character, but also of a line that is not shown.
        return head.rpartition(b"\n")[0].decode("utf-8-sig") if len(head) == HEAD_BYTES else head.decode("utf-8-sig")
    except UnicodeDecodeError:
        return head.decode("latin-1")


def _points(xy: np.ndarray[Any, Any]) -> list[tuple[float, float]]:
    there = xy[np.isfinite(xy).all(axis=1)]
    thinned = there[:: -(-len(there) // MOST_POINTS) or 1]
    return [(round(float(x), 3), round(float(y), 3)) for x, y in thinned]
