"""Logs of UrgBenri, the viewer of Hokuyo's lasers: settings, then a time and a line of ranges for each scan."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..scan import Floats, Recording, Topic
from .source import Reader, Source, Sweeps
from .tables.numbers import all_numbers

# Between beams, between the echoes of one, and between the distance and the intensity of an echo.
BEAM, ECHO, LEVEL = b";", b"&", b"|"
ANGLES = ("startStep", "frontStep", "totalSteps")


class UrgBenriLog(Reader):
    """Names in brackets, each with its value in the next line; ranges in millimetres."""

    format = "UrgBenri log"
    suffixes = (".ubh",)
    expects = "settings such as [startStep], then [timestamp] and [scan] for each scan"

    @staticmethod
    def recognises(head: bytes) -> bool:
        start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
        return start.startswith((b"[appName]", b"[captureMode]", b"[model]")) or (
            start.startswith(b"[timestamp]") and b"\n[scan]" in head
        )

    @staticmethod
    def read(source: Source) -> Recording:
        said: dict[str, str] = {}
        sweeps = Sweeps()
        key, low, step, least, most = "", 0.0, 0.0, 0.0, math.inf
        for number, line in source.lines():
            text = line.strip().removeprefix(b"\xef\xbb\xbf")
            if text.startswith(b"["):
                key = text.strip(b"[]").decode("utf-8", "replace")
            elif key == "scan":
                if not len(sweeps):
                    low, step = _angles(source, said)
                    least, most = _number(said, "minDistance") or 0.0, _number(said, "maxDistance") or math.inf
                try:
                    ranges = _ranges(text, source.reading.echo or 0)
                except ValueError as error:
                    source.notes.skip(f"{source.name}:{number}", str(error))
                else:
                    stamp = (_number(said, "timestamp") or 0.0) / 1000
                    sweeps.add(ranges, low, step, least, most, stamp, said.get("model", ""))
                key = ""
            elif key:
                said[key], key = text.decode("utf-8", "replace"), ""
        if not len(sweeps):
            source.notes.nothing_left()
            raise ValueError(f"{source.name} has no line of ranges; {UrgBenriLog.expects} are expected.")
        source.notes.found["unit"] = "mm"
        source.notes.stamps = "the log"
        topics = (Topic("scan", len(sweeps)),)
        return sweeps.recording(source, topic=source.choose(list(topics)), topics=topics, format=UrgBenriLog.format)


def _angles(source: Source, said: Mapping[str, str]) -> tuple[float, float]:
    """angle_min and angle_increment [rad]: steps count counter-clockwise, and frontStep looks ahead."""
    reading = source.reading
    if reading.angle_min is not None and reading.angle_increment is not None:
        return reading.angle_min, reading.angle_increment
    start, front, total = (_number(said, name) for name in ANGLES)
    if start is None or front is None or not total:
        lacks = ", ".join(f"[{name}]" for name in ANGLES if not _number(said, name) and name != "startStep")
        raise ValueError(f"{source.name} does not say {lacks or '[startStep]'}; give angle_min and angle_increment.")
    turn = 2 * math.pi / total
    return (start - front) * turn, turn * max(_number(said, "grouping") or 1.0, 1.0)


def _ranges(text: bytes, echo: int) -> Floats:
    """The ranges of a line, in its unit; NaN for a beam with fewer echoes. Raises ValueError for other words."""
    if ECHO in text or LEVEL in text:
        beams = [beam.split(ECHO) for beam in text.split(BEAM)]
        text = b" ".join(beam[echo].split(LEVEL)[0] if len(beam) > echo else b"nan" for beam in beams)
    elif echo:
        text = b" ".join([b"nan"] * (text.count(BEAM) + 1))
    values = all_numbers(text)
    if values is None or not len(values):
        raise ValueError(f"{text[:40].decode('utf-8', 'replace')!r} is no line of ranges")
    return np.asarray(values, np.float64)


def _number(said: Mapping[str, str], name: str) -> float | None:
    try:
        value = float(said.get(name, ""))
    except ValueError:
        return None
    return value if math.isfinite(value) else None
