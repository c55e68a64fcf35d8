"""The input of every reader (`Source`), and the collector of its scans (`Sweeps`)."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from ..failing import shown
from ..scan import Floats, Recording, Topic
from .account import Notes
from .laser_scan import LaserScan
from .parts import Parts
from .reading import Reading

Progress = Callable[[int, int], None]
LONGEST_LINE = 1 << 24
AT_ONCE = 1 << 18


class Cancelled(Exception):  # noqa: N818 - this is not an error
    """Raised by a progress callback to stop a reader; `open_recording` passes it on."""


@dataclass(frozen=True)
class Source:
    """One file to read, and how.

    path: the file, or its expanded copy; named: as the user named it. progress: called with (done, total) in bytes or
    messages; it may raise `Cancelled`. notes: what the reader finds out besides the scans. parts: who wants to see the
    scans before all are read.
    """

    path: Path
    reading: Reading = field(default_factory=Reading)
    progress: Progress = lambda done, total: None
    notes: Notes = field(default_factory=Notes)
    named: Path | None = None
    parts: Parts | None = None

    def offer(self, scans: int, part: Callable[[Source], Recording]) -> None:
        """Show the first scans of the file to who wants to see them, now and then.

        part: makes a Recording of this many scans, with the notes of the Source that it is given.
        """
        if self.parts is not None and self.parts.due(scans):
            so_far = replace(self, notes=self.notes.so_far())
            # What is wrong with the Reading is told in the end, about the whole.
            with suppress(ValueError, OSError):
                self.parts.show(part(so_far), so_far.notes)

    @property
    def name(self) -> str:
        path = self.named or self.path
        return shown(path.name or path)

    def lines(self) -> Iterator[tuple[int, bytes]]:
        """(number, line) of a text file; numbers count from 1; line ends, and NULs of a power failure, are removed."""
        total = max(self.path.stat().st_size, 1)
        number, done, rest = 0, 0, b""
        with self.path.open("rb") as file:
            while block := file.read(AT_ONCE):
                self.progress(done, total)
                done += len(block)
                # Whole blocks are looked at for what hardly any line has.
                plain = b"\r" not in block and b"\0" not in block and not rest.endswith((b"\r", b"\0"))
                *lines, rest = (rest + block).split(b"\n")
                for line in lines:
                    number += 1
                    yield number, line if plain else line.rstrip(b"\r").strip(b"\0")
                if len(rest) > LONGEST_LINE:
                    number += 1
                    yield number, rest
                    rest = b""
        if rest:
            yield number + 1, rest.rstrip(b"\r").strip(b"\0")
        self.progress(total, total)

    def choose(self, topics: list[Topic], what: str = "topic") -> str:
        """The wanted topic, or the first that has scans.

        Raises ValueError, listing the topics, if it does not exist.
        """
        names = [topic.name for topic in topics]
        wanted = self.reading.topic
        if wanted is None:
            first = next((topic.name for topic in topics if topic.scans), names[0])
            if first != names[0]:
                self.notes.notice("empty topic", f"{names[0]} has no scans, so {first} is shown.")
            return first
        if wanted not in names:
            raise ValueError(f"{self.name} has no laser {what} {wanted!r}; it has {', '.join(names)}.")
        return wanted


class Reader:
    """A format. format: its name; suffixes: in lower case; expects: the typical content, for messages.

    Compressed files are unpacked before a reader sees them.
    """

    format: ClassVar[str]
    suffixes: ClassVar[tuple[str, ...]]
    expects: ClassVar[str]

    @staticmethod
    def recognises(head: bytes) -> bool:
        """Whether a file that begins with `head` has this format."""
        raise NotImplementedError

    @staticmethod
    def recognises_folder(folder: Path) -> bool:
        """Whether a folder is a recording of this format."""
        return False

    @staticmethod
    def read(source: Source) -> Recording:
        """All scans of the chosen topic. Raises ValueError, with one sentence, if the file cannot be read."""
        raise NotImplementedError


def known_suffixes() -> tuple[str, ...]:
    """The suffixes of all readers, by which a recording is found in a folder or an archive."""
    return tuple(suffix for reader in Reader.__subclasses__() for suffix in reader.suffixes)


class Joined:
    """Arrays joined as they come, so that the message that each was part of can be forgotten."""

    def __init__(self) -> None:
        self.lengths = array("q")
        self._numbers: Floats = np.empty(0, np.float32)
        self._used = 0
        self._seen = False

    def reserve_for(self, arrays: int) -> None:
        """Make room for as many arrays like the first, so that nothing need be copied when more come."""
        # Memory that was never written to costs nothing. A damaged file may announce any number.
        with suppress(MemoryError, ValueError):
            room = np.empty(max(arrays * self.lengths[0], self._used), self._numbers.dtype)
            room[: self._used] = self._numbers[: self._used]
            self._numbers = room

    def append(self, numbers: Floats) -> None:
        stop = self._used + len(numbers)
        if numbers.dtype != self._numbers.dtype:
            common = np.result_type(numbers, self._numbers) if self._used else numbers.dtype.newbyteorder("=")
            self._numbers = self._numbers.astype(common, copy=False)
        if stop > len(self._numbers):
            self._grow(max(stop, len(self._numbers) + len(self._numbers) // 4))
        self._numbers[self._used : stop] = numbers
        self._used = stop
        self.lengths.append(len(numbers))

    def _grow(self, size: int) -> None:
        if self._seen:
            grown = np.empty(size, self._numbers.dtype)
            grown[: self._used] = self._numbers[: self._used]
            self._numbers, self._seen = grown, False
        else:
            # The system moves large arrays without a copy.
            self._numbers.resize(size, refcheck=False)

    def so_far(self) -> Floats:
        """All numbers by now, which stay as they are when more are appended."""
        self._seen = True
        return self._numbers[: self._used]

    def all(self) -> Floats:
        """Nothing can be appended afterwards."""
        if not self._seen:
            self._numbers.resize(self._used, refcheck=False)
        return self._numbers[: self._used]


class Sweeps:
    """Collects scans one by one and joins them into a Recording."""

    def __init__(self) -> None:
        self.ranges = Joined()
        self.geometry = array("d")
        self.frame_ids: list[str] = []
        self._names: dict[str, str] = {}
        self.time_increments = array("d")
        self.bearings: list[Floats] = []

    def __len__(self) -> int:
        return len(self.ranges.lengths)

    def add(
        self,
        ranges: Floats,
        angle_min: float,
        angle_increment: float,
        range_min: float = 0.0,
        range_max: float = np.inf,
        stamp: float = 0.0,
        frame_id: str = "",
        bearings: Floats | None = None,
        time_increment: float = 0.0,
    ) -> None:
        self.ranges.append(ranges)
        self.geometry.extend((angle_min, angle_increment, range_min, range_max, stamp))
        # One text for all scans.
        self.frame_ids.append(self._names.setdefault(frame_id, frame_id))
        self.time_increments.append(time_increment)
        if bearings is not None:
            self.bearings.append(bearings)

    def extend(self, scans: Sequence[LaserScan]) -> None:
        """Adds messages."""
        for each in scans:
            numbers = each.angle_min, each.angle_increment, each.range_min, each.range_max, each.stamp
            self.add(each.ranges, *numbers, each.frame_id, time_increment=each.time_increment)

    def recording(self, source: Source, *, partial: bool = False, **fields: Any) -> Recording:
        """All scans as one Recording, or those so far; `fields` override the collected values."""
        geometry = np.array(self.geometry).reshape(-1, 5)
        columns: dict[str, Any] = {
            "name": source.name,
            "ranges": self.ranges.so_far() if partial else self.ranges.all(),
            "offsets": np.concatenate(([0], np.cumsum(self.ranges.lengths, dtype=np.int64))),
            "angle_min": geometry[:, 0],
            "angle_increment": geometry[:, 1],
            "range_min": geometry[:, 2],
            "range_max": geometry[:, 3],
            "stamps": geometry[:, 4],
            "frame_ids": tuple(self.frame_ids),
            "bearings": np.concatenate(self.bearings) if self.bearings else None,
            "time_increment": np.array(self.time_increments) if any(self.time_increments) else None,
            "partial": partial,
        }
        return Recording(**(columns | fields))
