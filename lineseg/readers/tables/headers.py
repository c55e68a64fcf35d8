"""Names of columns, as exporters write them: with prefixes, dots, brackets, and units in parentheses."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

from ..reading import RADIANS, AngleUnit, Unit

ANGLES = (
    "angle", "angles", "ang", "theta", "thetas", "bearing", "bearings", "azimuth", "azimuths", "az", "azi", "phi",
    "winkel", "alpha",
    "ángulo", "angulo", "angolo", "角度", "角", "方位", "方位角", "각도", "угол",
)  # fmt: skip
DISTANCES = (
    "distance", "distances", "dist", "dists", "range", "ranges", "rng", "rho", "r", "d", "radius", "depth", "depths",
    "distanz", "abstand", "entfernung", "länge", "laenge", "length",
    "distancia", "distanza", "距離", "距离", "거리", "расстояние",
)  # fmt: skip
# What turns a laser that looks one way; the angle of a robot, in a table with x and y.
SERVOS = ("yaw", "pan", "servo", "heading", "direction", "course")
# What a column beside them holds if its name has one of these words, such as range_min or angle_increment.
BESIDE = {
    "min", "max", "minimum", "maximum", "limit", "increment", "resolution", "start", "end", "std", "stddev", "sigma",
    "var", "variance", "err", "error", "noise", "rate", "valid", "quality", "type", "status", "time",
}  # fmt: skip
STAMPS = ("stamp", "timestamp", "time", "t", "secs", "sec", "seconds", "zeit", "rosbagtimestamp", "datetime",
          "sim_time", "simtime", "simulation_time", "elapsed", "elapsed_time")  # fmt: skip
BEAMS = (
    "beam", "beam_id", "beam_index", "beam_idx", "beam_number", "beam_no", "beam_nr", "ray", "ray_id", "ray_index",
    "point_id", "point_index", "point_idx", "point_number", "point_no", "point_nr", "index", "idx", "i", "step",
    "step_n", "step_no",
)  # fmt: skip
SCANS = (
    "scan",
    "scan_id",
    "scan_number",
    "frame",
    "sweep",
    "scan_index",
    "scan_no",
    "scan_nr",
    "scan_idx",
    "turn",
    "revolution",
    "rev",
)
# What the fields of a scan are called elsewhere.
NAMES = {
    "ranges": ("ranges", "distances", "range", "distance"),
    "angles": ("angles", "bearings", "thetas", "theta"),
    "angle_increment": ("angle_increment", "increment"),
    "stamp": ("stamp", "timestamp", "time", "t", "ts"),
    "frame_id": ("frame_id", "frame"),
}
FIELD = {name: field for field, names in NAMES.items() for name in names}
# What an angle is to a scan if its name has one of these words, and what a distance is.
OF_ANGLE = {
    **dict.fromkeys(("min", "minimum", "start", "starting", "first", "begin", "from"), "angle_min"),
    **dict.fromkeys(("max", "maximum", "end", "stop", "last", "to"), "angle_max"),
    **dict.fromkeys(("increment", "inc", "incr", "step", "resolution", "delta", "spacing"), "angle_increment"),
}
OF_DISTANCE = {"min": "range_min", "minimum": "range_min", "max": "range_max", "maximum": "range_max"}
LASERS = (
    "frame_id", "header_frame_id", "laser", "laser_id", "laser_name", "lidar", "lidar_id", "lidar_name", "sensor",
    "sensor_id", "sensor_name", "device", "device_id", "scanner", "scanner_id", "source", "topic",
)  # fmt: skip
# What tells the layers of a laser that sees several.
LAYERS = ("ring", "layer", "layer_id", "channel", "elevation", "el", "vertical_angle", "pitch")
# What SI puts before a unit, and what drivers count in, as a unit of the Reading and a factor.
SCALED = {
    "dm": ("m", 0.1), "decimetre": ("m", 0.1), "decimeter": ("m", 0.1), "km": ("m", 1000.0),
    "mdeg": ("deg", 1e-3), "millideg": ("deg", 1e-3), "cdeg": ("deg", 0.01), "centideg": ("deg", 0.01),
    "centidegree": ("deg", 0.01), "centidegrees": ("deg", 0.01), "urad": ("rad", 1e-6), "µrad": ("rad", 1e-6),
    "arcmin": ("deg", 1 / 60), "arcsec": ("deg", 1 / 3600), "turn": ("deg", 360.0), "turns": ("deg", 360.0),
}  # fmt: skip
LENGTHS: dict[str, Unit] = {
    "m": "m", "metre": "m", "metres": "m", "meter": "m", "meters": "m",
    "cm": "cm", "centimetre": "cm", "centimetres": "cm", "centimeter": "cm", "centimeters": "cm",
    "in": "in", "inch": "in", "inches": "in", "ft": "ft", "foot": "ft", "feet": "ft",
    "mm": "mm", "millimetre": "mm", "millimetres": "mm", "millimeter": "mm", "millimeters": "mm",
    "um": "um", "µm": "um", "micron": "um", "microns": "um", "micrometre": "um", "micrometres": "um",
    "micrometer": "um", "micrometers": "um",
}  # fmt: skip
TURNS: dict[str, AngleUnit] = {
    "rad": "rad", "rads": "rad", "radian": "rad", "radians": "rad",
    "deg": "deg", "degs": "deg", "degree": "deg", "degrees": "deg", "°": "deg", "grad": "deg",
    "度": "deg", "degrés": "deg", "degres": "deg", "grados": "deg", "gradi": "deg",
    "gon": "gon", "gons": "gon", "gradian": "gon", "gradians": "gon", "mrad": "mrad", "mrads": "mrad",
    "milliradian": "mrad", "milliradians": "mrad",
}  # fmt: skip
TIMES = {
    "s": 1.0, "sec": 1.0, "secs": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "milliseconds": 1e-3,
    "us": 1e-6, "µs": 1e-6, "microseconds": 1e-6, "ns": 1e-9, "nsec": 1e-9, "nsecs": 1e-9, "nanoseconds": 1e-9,
}  # fmt: skip
UNITS = {**LENGTHS, **TURNS, **TIMES, **SCALED}
# A unit in brackets or after a slash; one with its factor at the end of a name; a fixed-point format such as Q6.
IN_BRACKETS = re.compile(r"[(\[{]\s*([^()\[\]{}]+?)\s*[)\]}]?\s*$|\s/\s*([^()\[\]{}/\d]+)\s*$|(?<=\w)/([^\W\d]+|°)\s*$")
WITH_FACTOR = re.compile(r"(?<=[A-Za-z])[_ ]+(\d*[./]\d+[_ ]?[A-Za-zµ°]+)\s*$")
FIXED_POINT = re.compile(r"[_ ]q(\d\d?)(?:_?checkbit)?(?=\s*$)", re.IGNORECASE)
FACTOR = re.compile(r"(?:(\d+)\s*/\s*(\d+)|(\d*[.,]?\d+(?:e-?\d+)?))[\s_]*[x×*·]?\s*([^\W\d_]+|°)", re.IGNORECASE)


class Name(NamedTuple):
    """A column's name in plain words joined by "_", its unit ("" if not said), and its element in an array, or −1.

    scale: how many of this unit 1 in the column is, such as 0.1 for "1/10 mm".
    """

    plain: str
    unit: str = ""
    element: int = -1
    scale: float = 1.0

    def ends(self, *known: str) -> bool:
        """Whether it is one of these names, perhaps after a prefix such as that of a topic."""
        return any(self.plain == name or self.plain.endswith(f"_{name}") for name in known)


@lru_cache(maxsize=4096)
def name_of(cell: str) -> Name:
    """`/scan/ranges[3]` → ranges of index 3; `Angle (deg)` → angle in deg; `field.header.stamp` → header_stamp."""
    text = cell.strip().strip("\"'%\ufeff ").replace("\N{GREEK SMALL LETTER MU}", "µ")
    text, unit, scale = _without_unit(
        re.sub(r"(?<=(?i:xyz))\W?([012])\W?$", lambda found: "_" + "xyz"[int(found[1])], text)
    )
    if not unit and (after := re.search(r"(?<=\d)[_ ](mm|cm|m)$", text)):
        text, unit = text[: after.start()], after[1]
    index = re.search(r"(?:\[(\d+)\]|[._/ ](\d+)|(?<=[A-Za-z])(\d+))\s*$", text)
    if index:
        text = text[: index.start()]
    text = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", text)
    plain = "_".join(re.findall(r"[^\W_]+|°", text.lower()))
    plain = plain.removeprefix("field_")
    last = plain.rsplit("_", 1)
    if not unit and len(last) == 2 and last[1] in UNITS and last[0].split("_")[-1] not in ("stamp", "header"):
        plain, unit = last[0].removesuffix("_in"), last[1]
    if unit in SCALED:
        unit, factor = SCALED[unit]
        scale *= factor
    number = next((int(group) for group in index.groups() if group), -1) if index else -1
    return Name(plain, unit, number, scale)


def _without_unit(text: str) -> tuple[str, str, float]:
    """A name without the unit that it ends with, this unit ("" without one), and its scale."""
    unit, scale = "", 1.0
    for form in (IN_BRACKETS, WITH_FACTOR):
        found = form.search(text)
        said = unit_of(next(filter(None, found.groups()))) if found else None
        if found and said is not None:
            (unit, scale), text = said, text[: found.start()]
            break
    if found := FIXED_POINT.search(text):
        text = text[: found.start()]
        if not unit:
            # Q14 is a part of a quarter of a turn, as in RPLIDAR's nodes.
            turn = 90.0 if found[1] == "14" else 1.0
            unit, whole = ("deg", turn) if "ang" in text.lower() else ("mm", 1.0)
            text, scale = re.sub(r"[_ ]mm$", "", text), whole / 2 ** int(found[1])
    return text, unit, scale


def unit_of(text: str) -> tuple[str, float] | None:
    """The unit that a text names, and its factor: "1/16°" is ("°", 0.0625); None for other words."""
    text = text.strip().lower()
    if text in UNITS:
        return text, 1.0
    found = FACTOR.fullmatch(text)
    if found is None or found[4] not in UNITS:
        return None
    factor = int(found[1]) / int(found[2]) if found[1] and int(found[2]) else float((found[3] or "1").replace(",", "."))
    return found[4], factor


def is_angle(name: Name) -> bool:
    return name.element < 0 and says_angle(name)


def is_distance(name: Name) -> bool:
    return name.element < 0 and says_distance(name)


def says_angle(name: Name) -> bool:
    """Whether it is the name of an angle, or of one in an array of them."""
    words = name.plain.split("_")
    known = words[-1] in ANGLES or words[0] in ANGLES or words[0].startswith(("angul", "angel")) or words == ["a"]
    return known and words[-1] not in DISTANCES and not (BESIDE | OF_ANGLE.keys()) & {*words}


def says_distance(name: Name) -> bool:
    """Whether it is the name of a distance, or of one in an array of them."""
    words = name.plain.split("_")
    known = words[0] in DISTANCES or words[-1] in DISTANCES
    return known and words[-1] not in ANGLES and not BESIDE & {*words}


def distance_of(names: list[Name]) -> int | None:
    """The column of the distances: the first whose name ends so, such as raw_range, or else begins so."""
    ends = column_of(names, lambda name: is_distance(name) and name.plain.split("_")[-1] in DISTANCES)
    return column_of(names, is_distance) if ends is None else ends


def field_of(name: Name) -> str | None:
    """The field of a scan that a name stands for, such as angle_min for "Start angle [deg]"; None if it is none."""
    words = name.plain.split("_")
    if (field := FIELD.get(name.plain) or FIELD.get(name.plain.removeprefix("scan_"))) is not None:
        return field
    if name.unit in TURNS or any(word in ANGLES or word.startswith("ang") for word in words):
        return next((OF_ANGLE[word] for word in words if word in OF_ANGLE), None)
    if name.unit in LENGTHS or any(word in DISTANCES for word in words):
        return next((OF_DISTANCE[word] for word in words if word in OF_DISTANCE), None)
    return None


def geometry_in(said: Iterable[tuple[str, object]], beams: int = 0) -> dict[str, float]:
    """angle_min and angle_increment [rad] among names and their values, such as ("start angle [deg]", "-135").

    Without a unit, all are in degrees if one of them is too large for radians.
    beams: how many a scan has, if known, so that angle_max gives the increment.
    """
    found: dict[str, float] = {}
    units: set[AngleUnit] = set()
    for text, value in said:
        name = name_of(text)
        if (field := field_of(name)) in ("angle_min", "angle_max", "angle_increment"):
            try:
                found[field] = float(value) * name.scale  # type: ignore[arg-type]
            except (TypeError, ValueError):
                continue
            units |= {TURNS[name.unit]} if name.unit in TURNS else set()
    large = any(abs(value) > 2 * math.pi + 0.2 for value in found.values())
    usual: AngleUnit = "deg" if large else "rad"
    unit = next(iter(units), usual)
    high = found.pop("angle_max", None)
    if high is not None and beams > 1 and "angle_min" in found:
        found.setdefault("angle_increment", (high - found["angle_min"]) / (beams - 1))
    return {field: value * RADIANS[unit] for field, value in found.items()} if len(units) < 2 else {}


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
    # Of several echoes with one number, the first.
    first = dict(reversed(stems[stem]))
    found = [first[element] for element in sorted(first)]
    return found if of_ranges or len(found) >= 8 else []


def units_as_names(names: list[Name]) -> list[Name]:
    """The names, "angle" and "distance" for those that are only units, such as "deg,mm", or name what turns a laser."""
    turns = [at for at, name in enumerate(names) if name.element < 0 and name.plain in (*TURNS, *SERVOS)]
    if not turns and any(map(is_distance, names)):
        # What is counted in degrees is an angle, whatever it is called.
        turns = [at for at, name in enumerate(names)
                 if name.element < 0 and name.unit in TURNS and field_of(name) is None]  # fmt: skip
    lengths = [at for at, name in enumerate(names) if name.element < 0 and name.plain in LENGTHS and not name.unit]
    found: dict[int, str] = {}
    if len(turns) == 1 and not any(map(is_angle, names)):
        found[turns[0]] = "angle"
    if len(lengths) == 1 and not any(map(is_distance, names)):
        found[lengths[0]] = "distance"
    if not (found.keys() & {*turns} or any(map(is_angle, names))) or any(name.plain in ("x", "y") for name in names):
        return names
    return [Name(found[at], name.unit or (name.plain if name.plain in UNITS else ""), -1, name.scale) if at in found
            else name for at, name in enumerate(names)]  # fmt: skip
