"""Logs of Player: a line for each message, with its interface in the fourth word."""

from __future__ import annotations

from itertools import islice

import numpy as np

from ..scan import Recording, Topic
from .source import Reader, Source, Sweeps

# time, host, robot, interface, index, type, subtype; then the scan's id, first and last angle, step, …
WORDS_BEFORE = 7


class PlayerLog(Reader):
    """The `laser` messages of a log written by Player's writelog driver."""

    format = "Player log"
    suffixes = (".plog",)
    expects = "lines such as `100.0 16777343 6665 laser 00 001 000 …`"

    @staticmethod
    def recognises(head: bytes) -> bool:
        if head.lstrip().startswith(b"## Player version"):
            return True
        lines = (line for line in head.splitlines() if line.strip() and not line.startswith(b"#"))
        words = [line.split(None, 4) for line in islice(lines, 5)]
        return bool(words) and all(len(each) > 3 and each[3] in (b"laser", b"sync") for each in words)

    @staticmethod
    def read(source: Source) -> Recording:
        lasers: dict[str, Sweeps] = {}
        others: set[str] = set()
        for number, line in source.lines():
            words = line.split()
            if len(words) > 3 and words[3][:1].isalpha() and not words[0].startswith(b"#"):
                others.add(words[3].decode("ascii", "replace"))
            if len(words) <= WORDS_BEFORE or words[0].startswith(b"#") or words[3] != b"laser":
                continue
            if words[5].lstrip(b"0") not in (b"1", b"01"):
                continue
            try:
                low, step, ranges, limit = _scan(words)
                stamp = float(words[0])
            except ValueError as error:
                source.notes.skip(f"{source.name}:{number}", str(error))
                continue
            laser = f"laser {words[4].decode('ascii', 'replace')}"
            lasers.setdefault(laser, Sweeps()).add(ranges, low, step, 0.0, limit, stamp, laser)
        if not lasers:
            source.notes.nothing_left()
            has = f"it has {', '.join(sorted(others)[:8])}; " if others else ""
            raise ValueError(f"{source.name} has no laser message; {has}a Player log has {PlayerLog.expects}.")
        topics = tuple(Topic(name, len(sweeps)) for name, sweeps in lasers.items())
        topic = source.choose(list(topics), "device")
        source.notes.stamps = "the log"
        return lasers[topic].recording(source, topic=topic, topics=topics, format=PlayerLog.format)


def _scan(words: list[bytes]) -> tuple[float, float, np.ndarray, float]:
    """(first angle, step, ranges, longest range) of a message.

    Versions of Player differ in the numbers before the count of beams, so the count is the whole number that the rest
    of the line agrees with: a range for each beam, or a range and an intensity.
    """
    numbers = np.array([float(word) for word in words[WORDS_BEFORE:]])
    for at in range(3, min(len(numbers), 10)):
        count, rest = numbers[at], len(numbers) - at - 1
        if count >= 2 and count == int(count) and rest in (count, 2 * count):
            settings = numbers[:at]
            low = int(np.argmax(settings < 0)) if (settings < 0).any() else max(0, at - 4)
            first, last, step = numbers[low], numbers[low + 1], numbers[low + 2]
            if not 0 < abs(step) < 1 or abs(first + step * (count - 1) - last) > 3 * abs(step):
                step = (last - first) / (count - 1)
            limit = float(numbers[low + 3]) if low + 3 < at and numbers[low + 3] > 0 else np.inf
            return float(first), float(step), numbers[at + 1 :][:: int(rest // count)], limit
    raise ValueError("the number of its beams does not agree with the numbers that follow; is the line complete?")
