"""CARMEN logs: the older FLASER and RLASER, the newer ROBOTLASER and RAWLASER, and LASER_READING of GMapping."""

from __future__ import annotations

import math
import re
from functools import partial
from itertools import islice
from typing import NamedTuple

import numpy as np

from ..poses import Found, PoseSource, Track
from ..scan import Floats, Recording, Topic
from .range_limits import longest_return
from .source import Reader, Source, Sweeps
from .tables.numbers import leading_numbers
from .tables.scan_rows import usual_angles

WORDS = (
    b"FLASER", b"RLASER", b"ROBOTLASER1", b"ROBOTLASER2", b"RAWLASER1", b"RAWLASER2", b"RAWLASER3", b"RAWLASER4",
    b"LASER1", b"LASER2", b"LASER_READING", b"PARAM", b"ODOM", b"SYNC", b"TRUEPOS", b"NEFF", b"VERTEX2", b"EDGE2",
)  # fmt: skip
ANY_LINE = re.compile(rb"^[ \t]*(?:" + b"|".join(WORDS) + rb")\s", re.MULTILINE)
# A laser line behind what a logger put before it, such as its number or a time.
BEHIND = re.compile(rb"[^\n]{1,60}?\s(?=(?:[FR]LASER|R(?:OBOT|AW)LASER[1-4]|LASER_READING|LASER[12])\s+\d)")
# The words before the stamp, after the ranges (and for the last two, the remissions).
TAILS = {"FLASER": 6, "RLASER": 6, "LASER_READING": 3, "ROBOTLASER": 11, "RAWLASER": 0, "LASER": 0}
WITHOUT_ANGLES = ("FLASER", "RLASER", "LASER_READING", "LASER1", "LASER2")
LASERS = {name.encode(): name for name in WITHOUT_ANGLES}
LASERS |= {f"{name}{n}".encode(): f"{name}{n}" for name in ("ROBOTLASER", "RAWLASER") for n in (1, 2, 3, 4)}
MOST_LINES = 100
MAXIMA = {"FLASER": b"robot_front_laser_max", "RLASER": b"robot_rear_laser_max"}
# Room for so many times as many lines as if all were as long as the first; a part is shown after as many lines.
ROOM, PART = 1.25, 64
# Lasers with these numbers of beams look over half a turn, as the format assumes of all.
HALF_TURN = (180, 181, 360, 361)


class Line(NamedTuple):
    """One decoded laser line; range_max: as stated in the line, None if not stated. pose: x, y, θ of
    the laser as it stands there, or what there is of it."""

    ranges: Floats
    angle_min: float
    angle_increment: float
    range_max: float | None
    stamp: float
    pose: bytes


class CarmenLog(Reader):
    """Lines of words, starting with the name of the message. For FLASER, the angles follow from the number of beams."""

    format = "CARMEN log"
    suffixes = (".log", ".clf", ".carmen", ".gfs")
    expects = "lines that begin with FLASER, RLASER, ROBOTLASER1 or ROBOTLASER2"

    @staticmethod
    def recognises(head: bytes) -> bool:
        # Tables of numbers are long, and passed over at once.
        numbers = re.match(rb"\s*[-+.\d]", head) is not None
        named = b"LASER" in head if numbers else any(word in head for word in WORDS)
        if not named or b"\0" in head.rstrip(b"\0"):
            return False
        return ANY_LINE.search(head) is not None or any(map(BEHIND.match, head.splitlines()[:MOST_LINES]))

    @staticmethod
    def read(source: Source) -> Recording:
        lasers: dict[str, Laser] = {}
        settings: dict[bytes, bytes] = {}
        with source.path.open("rb") as file:
            behind = any(map(BEHIND.match, islice(file, MOST_LINES)))
        for number, text in source.lines():
            if behind and (before := BEHIND.match(text)):
                text = text[before.end() :]
            word = text.split(None, 1)[:1]
            laser = LASERS.get(word[0]) if word else None
            if laser:
                decode, tail = DECODERS[laser]
                try:
                    line = decode(text, tail)
                except ValueError as error:
                    source.notes.skip(f"{source.name}:{number}", str(error))
                else:
                    found = lasers.setdefault(laser, Laser())
                    found.add(line, laser)
                    if len(found.poses) == 1:
                        found.sweeps.ranges.reserve_for(int(ROOM * source.path.stat().st_size / len(text)))
                    if len(found.poses) % PART == 0 and not laser.startswith("RAW"):
                        source.offer(len(found.poses), partial(_recording, lasers, settings, part=True))
            elif word == [b"PARAM"]:
                _, key, value, *_ = (*text.split(), b"", b"")
                settings[key] = value
        if not lasers:
            source.notes.nothing_left()
            first = next((line.strip() for _, line in source.lines() if line.strip()), b"")
            begins = f"it begins with {first[:40].decode('utf-8', 'replace')!r}; " if first else ""
            raise ValueError(f"{source.name} has no laser line; {begins}a CARMEN log has {CarmenLog.expects}.")
        return _recording(lasers, settings, source)


class Laser:
    """The lines of one laser, joined as they come."""

    def __init__(self) -> None:
        self.sweeps = Sweeps()
        self.poses: list[bytes] = []
        self.announced = 0.0

    def add(self, line: Line, topic: str) -> None:
        self.sweeps.add(line.ranges, line.angle_min, line.angle_increment, stamp=line.stamp, frame_id=topic.lower())
        self.poses.append(line.pose)
        self.announced = max(self.announced, line.range_max or 0.0)


def _recording(
    lasers: dict[str, Laser], settings: dict[bytes, bytes], source: Source, *, part: bool = False
) -> Recording:
    """The scans of the chosen laser, or those so far."""
    # What CARMEN's drivers publish raw, it publishes again with the robot's pose.
    names = sorted(lasers, key=lambda name: name.startswith("RAW"))
    topics = tuple(Topic(name, len(lasers[name].poses)) for name in names)
    topic = source.choose(list(topics), "message")
    laser = lasers[topic]
    source.notes.stamps = "the log"
    track = Track(partial(_found, list(laser.poses), topic))
    given = {"topic": topic, "topics": topics, "format": CarmenLog.format, "track": track}
    recording = laser.sweeps.recording(source, partial=part, **given)
    if topic in WITHOUT_ANGLES and (view := _view(source, int(recording.offsets[1]), settings, topic)) is not None:
        recording.angle_min[:], recording.angle_increment[:] = view
    announced = laser.announced or _number(settings.get(MAXIMA.get(topic, b"")))
    recording.range_max[:] = longest_return(recording.ranges, announced)
    return recording


def _found(words: list[bytes], topic: str) -> Found:
    """The poses of the lines, from their words."""
    poses = np.array([_pose(each.split()) for each in words])
    known = np.isfinite(poses).all(axis=1)
    if not known.any():
        return Found(poses, PoseSource(missing=f"{topic} lines have none"))
    missing = "" if known.all() else "other lines break off before it"
    return Found(poses, PoseSource(f"{topic} lines", missing=missing))


def _view(source: Source, beams: int, settings: dict[bytes, bytes], topic: str) -> tuple[float, float] | None:
    """The first angle of a laser with so many beams and the step between them [rad], a guess if no line says them.

    None for the numbers of beams of half a turn.
    """
    if beams in HALF_TURN or beams < 2:
        return None
    side = b"rear" if topic == "RLASER" else b"front"
    stated = (value for key, value in settings.items() if side in key and key.endswith(b"fov"))
    view = next((number for value in stated if (number := _number(value)) and 0 < number <= 360), None)
    usual = usual_angles(beams)
    if view is not None:
        low, step, where = -view / 2, view / (beams - 1), f"a PARAM line says {view:g}°"
    elif usual is not None:
        (low, step), where = usual, f"lasers with {beams} beams usually have it"
    else:
        (low, step), where = (-90.0, 180.0 / (beams - 1)), "the beams are spread over half a turn"
    text = f"{low:g}…{low + step * (beams - 1):g}°".replace("-", "−")
    why = f"{topic} lines do not say the field of view; {where}"
    # The other of half a turn and three quarters, which most lasers have.
    other = 270.0 if view is None and usual is None else 180.0
    change = {"angle_min": -other / 2, "angle_increment": other / (beams - 1)}
    source.notes.guess("angle_min", text, why, **{name: round(math.radians(each), 8) for name, each in change.items()})
    return float(np.deg2rad(low)), float(np.deg2rad(step))


def _decode_flaser(text: bytes, tail: int) -> Line:
    """FLASER n r₁ … rₙ x y θ odom_x odom_y odom_θ stamp host logger_stamp; of GMapping, x y θ stamp; LASER1 has no
    poses."""
    message, count, values = _words(text, 3)
    ranges, rest = _ranges(message, count, values)
    angle_min, angle_increment = flaser_angles(len(ranges))
    return Line(ranges, angle_min, angle_increment, None, _stamp(rest, tail), b" ".join(rest[:3]) if tail else b"")


def _decode_robotlaser(text: bytes, tail: int) -> Line:
    """ROBOTLASER1 type start field_of_view increment range_max accuracy remission_mode n r₁ … rₙ m s₁ … sₘ poses …
    stamp host logger_stamp; RAWLASER has no poses.
    The field of view is not used: logs state n·increment as well as (n − 1)·increment.
    """
    message, _, start, view, increment, longest, _, _, count, values = _words(text, 10)
    angle_min, step, range_max = (_float(word, message) for word in (start, increment, longest))
    ranges, rest = _ranges(message, count, values)
    if step == 0 and len(ranges) > 1:
        step = _float(view, message) / (len(ranges) - 1)
    remissions = int(rest[0]) if rest and rest[0].isdigit() else 0
    pose = b" ".join(rest[1 + remissions : 4 + remissions]) if tail else b""
    return Line(ranges, angle_min, step, range_max, _stamp(rest, 1 + remissions + tail), pose)


DECODERS = {
    laser: (_decode_flaser if laser in WITHOUT_ANGLES else _decode_robotlaser, TAILS[laser.rstrip("1234")])
    for laser in LASERS.values()
}


def flaser_angles(count: int) -> tuple[float, float]:
    """angle_min and angle_increment [rad] of `count` beams without angles: from −90° on, like a SICK LMS.

    180 and 181 beams are 1° apart, 360 and 361 are 0.5° apart; other numbers are spread over 180°.
    """
    step = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5}.get(count, 180.0 / max(count - 1, 1))
    return -np.pi / 2, np.deg2rad(step)


def _words(text: bytes, count: int) -> list[bytes]:
    """The first words of a line, followed by the rest of the line."""
    words = text.split(None, count - 1)
    if len(words) < count:
        raise ValueError(f"{_text(words[0])} breaks off after {len(words)} words; its ranges begin at word {count}.")
    return words


def _ranges(message: bytes, count: bytes, values: bytes) -> tuple[Floats, list[bytes]]:
    """The ranges at the start of `values`, and the words after them."""
    if not count.isdigit():
        raise ValueError(f"{_text(message)} has {_text(count)!r} instead of the number of its ranges.")
    wanted = int(count)
    if 2 * wanted > len(values) + 1:  # before allocating memory for ranges that cannot exist
        raise ValueError(_missing(message, wanted, len(values.split())))
    ranges, end = leading_numbers(values, wanted)
    rest = values[end:].split()
    if len(ranges) < wanted and rest:
        raise ValueError(f"{_text(message)} has {_text(rest[0])!r} among its ranges; they must be numbers.")
    if len(ranges) < wanted:
        raise ValueError(_missing(message, wanted, len(ranges)))
    return ranges, rest


def _missing(message: bytes, wanted: int, found: int) -> str:
    follow = "1 value follows" if found == 1 else f"{found} values follow"
    return f"{_text(message)} announces {wanted} ranges, but {follow}."


def _stamp(words: list[bytes], at: int) -> float:
    """Seconds; 0 if the line has none."""
    return _number(words[at] if at < len(words) else None) or 0.0


def _pose(words: list[bytes]) -> tuple[float, float, float]:
    """The pose of the laser, which comes first; NaN if the line has none."""
    numbers = [_number(word) for word in words[:3]]
    x, y, heading = (
        math.nan if value is None or not math.isfinite(value) else value for value in (*numbers, *3 * [None])[:3]
    )
    return x, y, heading


def _float(word: bytes, message: bytes) -> float:
    value = _number(word)
    if value is None or not np.isfinite(value):
        raise ValueError(f"{_text(message)} has {_text(word)!r} in its header; it must be a number.")
    return value


def _number(word: bytes | None) -> float | None:
    try:
        return None if word is None else float(word)
    except ValueError:
        return None


def _text(word: bytes) -> str:
    return word[:40].decode("ascii", "replace")
