"""The Reading: how a file is read. Each field is declared once, for flags, the page, links and exports."""

from __future__ import annotations

import math
import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Annotated, Any, Literal, NamedTuple, Self, get_args, get_type_hints

Unit = Literal["m", "cm", "mm", "0.1mm", "1/4mm", "um", "in", "ft"]
AngleUnit = Literal["rad", "deg", "gon", "mrad", "0.01deg", "1/64deg"]
Direction = Literal["counter-clockwise", "clockwise"]
Motion = Literal["kept", "removed"]
Walls = Literal["by-views", "none"]
Stamps = Literal["message", "unwrapped", "recorded", "none"]
METRES: dict[str, float] = {
    "m": 1.0, "cm": 0.01, "mm": 0.001, "0.1mm": 1e-4, "1/4mm": 0.25e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048,
}  # fmt: skip
RADIANS: dict[str, float] = {
    "rad": 1.0, "deg": math.pi / 180, "gon": math.pi / 200, "mrad": 1e-3, "0.01deg": math.pi / 18_000,
    "1/64deg": math.pi / 180 / 64,
}  # fmt: skip
# What a column may hold besides the ranges; "-" is a column to pass over.
COLUMN_WORDS = ("stamp", "angle", "distance", "x", "y", "ranges", "-")
MOST_TEXT = 400
LARGEST = sys.float_info.max


@dataclass(frozen=True)
class ReadingField:
    """The declaration of a field of the Reading, apart from its type.

    label, help: for people; unit: of its numbers; metavar: its form in the help of the command line.
    group: the heading under which the page shows it. least, most: allowed numbers; why: the reason for the bounds.
    only: the formats for which it makes sense, all if empty; elsewhere: what other formats say, for the refusal.
    form: "text", or what a text must be: a span FROM:TO of numbers or frames, or values.
    """

    label: str
    help: str
    group: Literal["scans", "numbers", "left out"]
    unit: str = ""
    metavar: str = ""
    least: float = -math.inf
    most: float = math.inf
    why: str = ""
    only: tuple[str, ...] = ()
    elsewhere: str = ""
    form: Literal["text", "span", "frames", "values", "columns"] = "text"


class Span(NamedTuple):
    """FROM:TO; either may be missing."""

    low: float
    high: float


TEXT_FORMATS = ("text", "JSON", "YAML", "XML", "MATLAB", "NPY", "NPZ")
BAG_FORMATS = ("ROS 1 bag", "ROS 2 bag", "MCAP")


@dataclass(frozen=True)
class Reading:
    """How to read a file; None: as the file says, or a guess, which `Recording.account` tells.

    A text file may give some of these values in comment lines such as `# angle_min = -2.356`.
    """

    topic: Annotated[
        str | None,
        ReadingField("topic", "stream of scans to read (default: the first that has scans)", "scans"),
    ] = None
    frame_id: Annotated[
        str | None,
        ReadingField(
            "frame_id", "laser to read if a topic carries several, by its frame_id (default: the first)", "scans"
        ),
    ] = None
    geometry: Annotated[
        int | None,
        ReadingField(
            "geometry",
            "laser to read if scans of several geometries alternate: its number, from 0 (default: 0)",
            "scans",
            least=0,
            most=99,
            why="geometries are numbered from 0",
        ),
    ] = None
    echo: Annotated[
        int | None,
        ReadingField(
            "echo",
            "echo to use if a beam has several: its number, from 0 (default: 0)",
            "scans",
            least=0,
            most=99,
            why="echoes are numbered from 0",
            only=(*BAG_FORMATS, "UrgBenri log", "SICK telegrams"),
            elsewhere="has one range for each beam",
        ),
    ] = None
    frames: Annotated[
        str | None,
        ReadingField(
            "frames", "scans from FIRST to the one before STOP, counted from 0; either may be left out", "scans",
            form="frames", metavar="FIRST:STOP",
        ),
    ] = None  # fmt: skip
    seconds: Annotated[
        str | None,
        ReadingField(
            "seconds", "scans from FROM until TO, counted from the first scan; either may be left out", "scans",
            "s", "FROM:TO", form="span",
        ),
    ] = None  # fmt: skip
    every_scan: Annotated[
        int | None,
        ReadingField("every n-th scan", "keep every n-th scan", "scans", least=1, why="1 keeps all of them"),
    ] = None
    stamps: Annotated[
        Stamps | None,
        ReadingField(
            "stamps",
            "where times come from: the message, the message counted on where it wraps at 2³², the recorder of a bag, "
            "or none at all (default: the message)",
            "scans",
        ),
    ] = None
    poses: Annotated[
        str | None,
        ReadingField(
            "trajectory",
            "file of the laser's poses: TUM rows, or a table with stamp, x, y and heading; a name without a folder is "
            "looked for beside the recording (default: the poses in the recording)",
            "scans",
            metavar="FILE",
        ),
    ] = None
    pose_topic: Annotated[
        str | None,
        ReadingField(
            "poses from",
            "topic of the robot's poses: /tf, or one of Odometry or Pose messages (default: the first that has them)",
            "scans",
            only=BAG_FORMATS,
            elsewhere="has no topics of poses",
        ),
    ] = None
    motion: Annotated[
        Motion | None,
        ReadingField(
            "motion in a sweep",
            "motion of the laser during a sweep: kept in the scan, or removed by its poses (default: kept)",
            "scans",
        ),
    ] = None
    walls: Annotated[
        Walls | None,
        ReadingField(
            "truth from poses",
            "where the file has no truth, the walls that many scans with poses agree on: by-views takes them, none "
            "never does (default: score, tune, sweep and compare take them unless they cannot be trusted)",
            "scans",
        ),
    ] = None
    time_increment: Annotated[
        float | None,
        ReadingField("time_increment", "time between two beams, instead of the file's", "scans", "s", least=0.0,
                     most=1.0, why="beams follow each other within 1 s"),
    ] = None  # fmt: skip
    unit: Annotated[Unit | None, ReadingField("unit of ranges", "unit of the ranges in the file", "numbers")] = None
    angle_unit: Annotated[
        AngleUnit | None, ReadingField("unit of angles", "unit of the angles in the file", "numbers")
    ] = None
    angle_min: Annotated[
        float | None, ReadingField("angle_min", "bearing of the first beam, instead of the file's", "numbers", "rad")
    ] = None
    angle_increment: Annotated[
        float | None,
        ReadingField("angle_increment", "angle between beams, instead of the file's", "numbers", "rad"),
    ] = None
    direction: Annotated[
        Direction | None,
        ReadingField(
            "direction",
            "sense in which angles of the file count; clockwise mirrors the scan, as for an upside-down laser",
            "numbers",
        ),
    ] = None
    skip_columns: Annotated[
        int | None,
        ReadingField(
            "columns to skip",
            "numbers before the ranges in a row",
            "numbers",
            least=0,
            most=10_000,
            why="a number of columns is never negative, give 0 or more",
            only=TEXT_FORMATS,
            elsewhere="has no columns",
        ),
    ] = None
    columns: Annotated[
        str | None,
        ReadingField(
            "columns",
            "what the columns hold, in order: stamp, angle, distance, x, y, - for others, ranges for all in between",
            "numbers",
            metavar="NAME,NAME,…",
            only=TEXT_FORMATS,
            elsewhere="has no columns",
            form="columns",
        ),
    ] = None
    no_return: Annotated[
        str | None,
        ReadingField(
            "no return",
            "ranges that mean no return: values and spans FROM:TO, separated by commas; none for no such value",
            "left out",
            "m",
            "VALUE,FROM:TO,…",
            form="values",
        ),
    ] = None
    range_min: Annotated[
        float | None,
        ReadingField("range_min", "shorter ranges are not returns, whatever the file says", "left out", "m"),
    ] = None
    range_max: Annotated[
        float | None,
        ReadingField("range_max", "ranges from this value on are not returns", "left out", "m"),
    ] = None
    sector: Annotated[
        str | None,
        ReadingField(
            "sector", "FROM:TO, counter-clockwise; beams outside it are left out", "left out", "°", "FROM:TO",
            form="span",
        ),
    ] = None  # fmt: skip
    every_beam: Annotated[
        int | None,
        ReadingField("every n-th beam", "keep every n-th beam of a scan", "left out", least=1, why="1 keeps all"),
    ] = None

    def __post_init__(self) -> None:
        for name, entry in self.declared().items():
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, _checked(name, value, self.type_of(name), entry))
        if self.angle_increment == 0:
            raise ValueError("angle_increment is 0, which would put all beams on one ray; give another value.")
        low, high = self.range_min or 0.0, math.inf if self.range_max is None else self.range_max
        if low >= high:
            raise ValueError(f"range_min {low:g} is not below range_max {high:g}, so no range would be left.")

    @classmethod
    @cache
    def declared(cls) -> dict[str, ReadingField]:
        """The declaration of each field, in order."""
        hints = get_type_hints(cls, include_extras=True)
        return {each.name: hints[each.name].__metadata__[0] for each in fields(cls)}

    @classmethod
    @cache
    def type_of(cls, name: str) -> Any:
        """str, int, float, or a Literal."""
        return get_args(get_type_hints(cls)[name])[0]

    @classmethod
    def choices(cls, name: str) -> tuple[str, ...]:
        """The allowed values of a field, () if any text or number is."""
        return get_args(cls.type_of(name))

    def but(self, /, **values: Any) -> Self:
        """A copy with some fields changed. Raises ValueError, listing the known names, for an unknown one."""
        for name in values:
            if name not in self.declared():
                raise ValueError(f"a Reading has no {name!r}; it has {', '.join(self.declared())}")
        return replace(self, **values) if values else self

    def given(self) -> dict[str, Any]:
        """The fields that are not None; `Reading(**given)` restores it, also from JSON."""
        return {name: value for name in self.declared() if (value := getattr(self, name)) is not None}

    def without(self, other: Reading) -> Self:
        """A copy without the fields that `other` gives."""
        return self.but(**dict.fromkeys(other.given()))

    def check_format(self, file: str, format: str) -> None:
        """Raises ValueError for a field that makes no sense for this format."""
        for name in self.given():
            entry = self.declared()[name]
            if entry.only and format not in entry.only:
                raise ValueError(
                    f"{file}: {name} cannot be used, because {_article(format)} {entry.elsewhere}; "
                    f"it is for {', '.join(entry.only)}."
                )


def as_flags(values: Mapping[str, Any]) -> str:
    """Fields of a Reading as flags of the command line."""
    return " ".join(_flag(name, str(value)) for name, value in values.items())


def _flag(name: str, value: str) -> str:
    flag = f"--{name.replace('_', '-')}"
    # A value that begins with a minus would be taken for a flag.
    return f"{flag}={shlex.quote(value)}" if value.startswith("-") else f"{flag} {shlex.quote(value)}"


def span_of(text: str) -> Span:
    """The numbers of FROM:TO. Raises ValueError for other text."""
    low, colon, high = text.partition(":")
    if not colon:
        raise ValueError(f"{text!r} is not a span; give FROM:TO, such as 10:20, 10: or :20")
    try:
        span = Span(float(low) if low.strip() else -math.inf, float(high) if high.strip() else math.inf)
    except ValueError:
        raise ValueError(f"{text!r} is not a span of numbers; give FROM:TO, such as 10:20, 10: or :20") from None
    if math.isnan(span.low) or math.isnan(span.high):
        raise ValueError(f"{text!r} is not a span of numbers; give FROM:TO, such as 10:20, 10: or :20")
    return span


def frames_of(text: str, frames: int) -> range:
    """The range FIRST:STOP out of `frames` frames. Raises ValueError for other text or an empty range."""
    first, colon, stop = text.partition(":")
    try:
        chosen = range(frames)[int(first) if first.strip() else None : int(stop) if stop.strip() else None]
    except ValueError:
        chosen, colon = range(0), ""
    if not colon:
        raise ValueError(f"frames is {text!r}; give FIRST:STOP, such as 100:200, 100: or :200.")
    if not chosen:
        raise ValueError(f"frames is {text!r}, which is empty; the recording has the frames 0 to {frames - 1}.")
    return chosen


def values_of(text: str) -> tuple[Span, ...]:
    """The values and spans of a list such as 65.535,9.9:10; () for none. Raises ValueError for other text."""
    if text.strip().lower() == "none":
        return ()
    spans = []
    for word in text.split(","):
        try:
            span = span_of(word if ":" in word else f"{word}:{word}")
        except ValueError:
            span = Span(math.nan, math.nan)
        if math.isnan(span.low) or (":" not in word and not math.isfinite(span.low)):
            raise ValueError(
                f"{text!r} is not a list of values; give numbers and spans, such as 65.535,9.9:10, or none"
            )
        spans.append(span)
    return tuple(spans)


def columns_of(text: str) -> tuple[str, ...]:
    """The words of a list of columns. Raises ValueError for one that cannot be."""
    words = tuple(word.strip().lower() for word in text.split(","))
    for word in words:
        if word not in COLUMN_WORDS:
            raise ValueError(f"{word!r} is not a column; choose from {', '.join(COLUMN_WORDS)}")
    for word in set(words) - {"-"}:
        if words.count(word) > 1:
            raise ValueError(f"{word} is named twice")
    beams = [pair for pair in (("angle", "distance"), ("x", "y")) if set(pair) <= set(words)]
    if "ranges" in words and not {*words} <= {"ranges", "stamp", "-"}:
        raise ValueError("beside ranges, which are all columns in between, only stamp and - can be named")
    if len(beams) + ("ranges" in words) != 1:
        raise ValueError("name angle and distance, or x and y, or ranges")
    return words


def around_ranges(words: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What the columns before the ranges hold, and those after them."""
    at = words.index("ranges")
    return words[:at], words[at + 1 :]


def _checked(name: str, value: Any, kind: Any, entry: ReadingField) -> Any:
    """The value of a field. Raises ValueError naming the field, the value, and what is allowed."""
    if choices := get_args(kind):
        if value not in choices:
            raise ValueError(f"{name} is {value!r:.60}; choose from {', '.join(choices)}.")
        return value
    if kind is str:
        return _checked_text(name, value, entry)
    number = not isinstance(value, bool) and isinstance(value, int | float) and abs(value) <= LARGEST
    if not number or (kind is int and value != int(value)):
        unit = {"rad": " of radians", "m": " of metres"}.get(entry.unit, "")
        raise ValueError(f"{name} is {value!r:.60}; it must be a {'whole' if kind is int else 'finite'} number{unit}.")
    if not entry.least <= value <= entry.most:
        raise ValueError(f"{name} is {value:g}; {entry.why}.")
    return kind(value)


def _checked_text(name: str, value: Any, entry: ReadingField) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > MOST_TEXT:
        raise ValueError(f"{name} is {value!r:.60}; it must be a text of 1 to {MOST_TEXT} characters.")
    checks = {"span": span_of, "values": values_of, "columns": columns_of, "frames": lambda text: text.index(":")}
    if entry.form in checks:
        try:
            checks[entry.form](value)
        except ValueError as error:
            form = "give FIRST:STOP, such as 100:200" if entry.form == "frames" else str(error)
            raise ValueError(f"{name} is {value!r:.60}; {form}.") from None
    return value


def _article(format: str) -> str:
    return f"{'an' if format[0] in 'AEIOMN' and format.isupper() else 'a'} {format}"
