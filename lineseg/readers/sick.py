"""Telegrams of SICK's lasers as text (CoLa A), as terminals and network tools save them.

Format: SICK, Telegram Listing for Ranging Sensors LMS1xx, LMS5xx, TiM2xx, TiM5xx, TiM7xx, LMS1000, MRS1000, 8014631.
"""

from __future__ import annotations

import re
import struct

import numpy as np

from ..scan import Recording, Topic
from .source import Reader, Source, Sweeps

TELEGRAM = re.compile(rb"s[RS][AN] LMDscandata ([^\x02\x03\r\n]*)")
# The time since the laser was started is this word [µs]; angles count in 1/10000°.
TIME_AT, TURN = 7, np.pi / 180 / 10_000
SCALE, OFFSET, START, STEP, COUNT, VALUES = range(1, 7)


class SickTelegrams(Reader):
    """Lines, or one stream, of answers to `sRN LMDscandata` in hexadecimal numbers; distances in millimetres."""

    format = "SICK telegrams"
    suffixes = ()
    expects = "telegrams such as `sSN LMDscandata 1 1 … DIST1 3F800000 00000000 FFF92230 1388 21D …`"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return b" LMDscandata " in head and b"\0" not in head and TELEGRAM.search(head) is not None

    @staticmethod
    def read(source: Source) -> Recording:
        sweeps = Sweeps()
        for number, found in enumerate(TELEGRAM.finditer(source.path.read_bytes())):
            words = found[1].split()
            try:
                ranges, low, step = _channel(words, b"DIST%d" % (1 + (source.reading.echo or 0)))
                stamp = _whole(words[TIME_AT]) * 1e-6
            except IndexError:
                source.notes.skip(f"{source.name}: telegram {number}", "it breaks off")
            except ValueError as error:
                source.notes.skip(f"{source.name}: telegram {number}", str(error))
            else:
                sweeps.add(ranges, low, step, stamp=stamp)
        if not len(sweeps):
            source.notes.nothing_left()
            raise ValueError(f"{source.name} has no telegram of a scan; {SickTelegrams.expects} are expected.")
        source.notes.found["unit"], source.notes.stamps = "mm", "the telegrams"
        source.notes.unstated.add("range_max")
        topics = (Topic("scan", len(sweeps)),)
        topic = source.choose(list(topics))
        return sweeps.recording(source, topic=topic, topics=topics, format=SickTelegrams.format)


def _channel(words: list[bytes], name: bytes) -> tuple[np.ndarray, float, float]:
    """(ranges [mm], first angle, step) of a channel such as DIST1. Raises ValueError if it is not whole."""
    if name not in words:
        raise ValueError(f"it has no {name.decode()}")
    at = words.index(name)
    count, values = _whole(words[at + COUNT]), words[at + VALUES :]
    if len(values) < count:
        raise ValueError(f"it announces {count} distances, but {len(values)} follow")
    scale, offset = _fraction(words[at + SCALE]), _fraction(words[at + OFFSET])
    ranges = np.array([_hexadecimal(word) for word in values[:count]], np.float64)
    first, step = _whole(words[at + START]), _whole(words[at + STEP])
    # Straight ahead is 90° in most of these lasers, and 0° in others.
    middle, ahead = first + step * (count - 1) / 2, 900_000
    ahead = ahead if abs(middle - ahead) < abs(middle) else 0
    return np.where(ranges > 0, ranges * scale + offset, np.nan), (first - ahead) * TURN, step * TURN


def _whole(word: bytes) -> int:
    """A whole number with a sign: hexadecimal in 32 bits, or decimal after a sign."""
    if word[:1] in (b"+", b"-"):
        return int(word)
    number = _hexadecimal(word)
    return number - (1 << 32) if number >= 1 << 31 and len(word) == 8 else number


def _hexadecimal(word: bytes) -> int:
    try:
        return int(word, 16)
    except ValueError:
        raise ValueError(f"{_shown(word)} is not a hexadecimal number") from None


def _fraction(word: bytes) -> float:
    """A number with a fraction, of 32 bits."""
    try:
        return struct.unpack(">f", bytes.fromhex(word.decode()))[0]
    except (ValueError, struct.error):
        raise ValueError(f"{_shown(word)} is not a number of 8 hexadecimal digits") from None


def _shown(word: bytes) -> str:
    return repr(word[:40].decode("ascii", "replace"))
