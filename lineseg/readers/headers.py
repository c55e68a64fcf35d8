"""Names of columns, as exporters write them: with prefixes, dots, brackets, and units in parentheses."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from .reading import AngleUnit, Unit

ANGLES = (
    "angle", "angles", "ang", "theta", "thetas", "bearing", "bearings", "azimuth", "azimuths", "phi", "winkel", "alpha",
)  # fmt: skip
DISTANCES = (
    "distance", "distances", "dist", "dists", "range", "ranges", "rho", "r", "d", "radius", "depth", "depths",
    "distanz", "abstand", "entfernung", "länge", "laenge", "length",
)  # fmt: skip
STAMPS = ("stamp", "timestamp", "time", "t", "secs", "sec", "seconds", "zeit", "rosbagtimestamp", "datetime")
BEAMS = ("beam", "beam_id", "beam_index", "beam_number", "beam_no", "ray", "point_id", "index", "idx", "i", "step")
SCANS = ("scan", "scan_id", "scan_number", "frame", "sweep", "scan_index", "scan_no", "turn", "revolution", "rev")
LASERS = (
    "frame_id", "header_frame_id", "laser", "laser_id", "laser_name", "lidar", "lidar_id", "lidar_name", "sensor",
    "sensor_id", "sensor_name", "device", "device_id", "scanner", "scanner_id", "source", "topic",
)  # fmt: skip
LENGTHS: dict[str, Unit] = {
    "m": "m", "metre": "m", "metres": "m", "meter": "m", "meters": "m",
    "cm": "cm", "centimetre": "cm", "centimetres": "cm", "centimeter": "cm", "centimeters": "cm",
    "in": "in", "inch": "in", "inches": "in", "ft": "ft", "foot": "ft", "feet": "ft",
    "mm": "mm", "millimetre": "mm", "millimetres": "mm", "millimeter": "mm", "millimeters": "mm",
}  # fmt: skip
TURNS: dict[str, AngleUnit] = {
    "rad": "rad", "rads": "rad", "radian": "rad", "radians": "rad",
    "deg": "deg", "degs": "deg", "degree": "deg", "degrees": "deg", "°": "deg", "grad": "deg",
}  # fmt: skip
TIMES = {
    "s": 1.0, "sec": 1.0, "secs": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "milliseconds": 1e-3,
    "us": 1e-6, "µs": 1e-6, "microseconds": 1e-6, "ns": 1e-9, "nsec": 1e-9, "nsecs": 1e-9, "nanoseconds": 1e-9,
}  # fmt: skip
UNITS = {**LENGTHS, **TURNS, **TIMES}


class Name(NamedTuple):
    """A column's name in plain words joined by "_", its unit ("" if not said), and its element in an array, or −1."""

    plain: str
    unit: str = ""
    element: int = -1

    def ends(self, *known: str) -> bool:
        """Whether it is one of these names, perhaps after a prefix such as that of a topic."""
        return any(self.plain == name or self.plain.endswith(f"_{name}") for name in known)


@lru_cache(maxsize=4096)
def name_of(cell: str) -> Name:
    """`/scan/ranges[3]` → ranges of index 3; `Angle (deg)` → angle in deg; `field.header.stamp` → header_stamp."""
    text = cell.strip().strip("\"'%\ufeff ").replace("\N{DEGREE SIGN}", "°")
    unit = ""
    for found in re.finditer(r"[(\[{/]\s*([^()\[\]{}/\d]+?)\s*[)\]}]?\s*$", text):
        if found[1].lower() in UNITS:
            unit, text = found[1].lower(), text[: found.start()]
    index = re.search(r"(?:\[(\d+)\]|[._/ ](\d+)|(?<=[A-Za-z])(\d+))\s*$", text)
    if index:
        text = text[: index.start()]
    text = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", text)
    plain = "_".join(re.findall(r"[^\W_]+|°", text.lower()))
    plain = plain.removeprefix("field_")
    last = plain.rsplit("_", 1)
    if not unit and len(last) == 2 and last[1] in UNITS and last[0].split("_")[-1] not in ("stamp", "header"):
        plain, unit = last[0].removesuffix("_in"), last[1]
    number = next((int(group) for group in index.groups() if group), -1) if index else -1
    return Name(plain, unit, number)


def is_angle(name: Name) -> bool:
    words = name.plain.split("_")
    known = words[-1] in ANGLES or words[0] in ANGLES or words[0].startswith(("angul", "angel"))
    return name.element < 0 and known and not name.ends("angle_min", "angle_max", "angle_increment")


def is_distance(name: Name) -> bool:
    words = name.plain.split("_")
    known = words[0] in DISTANCES or words[-1] in DISTANCES
    return name.element < 0 and known and not name.ends("range_min", "range_max", "time")


def is_beam(name: Name) -> bool:
    """Whether a column numbers the beams of a scan."""
    return name.element < 0 and name.plain in BEAMS


def column_of(names: list[Name], test) -> int | None:
    """The first column whose name passes a test."""
    return next((at for at, name in enumerate(names) if test(name)), None)


def array_columns(names: list[Name]) -> list[int]:
    """The columns of the ranges if each beam has its own, in the order of their indices; [] if they are none."""
    stems: dict[str, list[tuple[int, int]]] = {}
    for at, name in enumerate(names):
        if name.element >= 0:
            stems.setdefault(name.plain, []).append((name.element, at))
    stems = {stem: found for stem, found in stems.items() if "intensit" not in stem}
    if not stems:
        return []
    of_ranges = [stem for stem in stems if stem.split("_")[-1] in ("ranges", "range")]
    stem = of_ranges[0] if of_ranges else max(stems, key=lambda stem: len(stems[stem]))
    found = sorted(stems[stem])
    return [at for _, at in found] if of_ranges or len(found) >= 8 else []
