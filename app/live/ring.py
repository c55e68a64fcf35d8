"""The newest scans of a live source. Old ones make room; a snapshot stays as it is."""

from __future__ import annotations

import threading
from dataclasses import dataclass

import numpy as np

from lineseg import Recording
from lineseg.readers.laser_scan import LaserScan
from lineseg.scan import Topic

MOST_SCANS = 3000
# Room is for so many beams a scan on the average, and for some large scans in any case.
BEAMS_EACH = 2000
LEAST_ROOM = 1_000_000


@dataclass(frozen=True, eq=False)
class LiveRecording(Recording):
    """What a ring held at some moment. first: the number of its first scan, counted since the source began, from 0."""

    first: int = 0

    @property
    def total(self) -> int:
        """How many scans had arrived."""
        return self.first + len(self)


def first_of(recording: Recording) -> int:
    """The number of its first frame; 0 where none was ever dropped."""
    return recording.first if isinstance(recording, LiveRecording) else 0


class Ring:
    """The newest `most` scans, or fewer where they have more than `most_beams` together.

    They are appended to flat arrays of twice that room, of which nothing is ever overwritten; where they are full, the
    newest move on to new arrays. So a snapshot consists of views and costs nothing, however many scans come after it.
    """

    def __init__(self, most: int = MOST_SCANS, most_beams: int | None = None) -> None:
        self.most = most
        self.most_beams = max(BEAMS_EACH * most, LEAST_ROOM) if most_beams is None else most_beams
        self.topic = ""
        self.dropped = 0
        self._lock = threading.Lock()
        self._begin(np.empty(0, np.float32), np.zeros(1, np.int64), np.empty((0, 5)), [])
        self._snapshot: LiveRecording | None = None

    @property
    def total(self) -> int:
        """How many scans have arrived since the beginning."""
        with self._lock:
            return self.dropped + self._stop - self._start

    def add(self, scan: LaserScan) -> None:
        beams = len(scan.ranges)
        if beams > self.most_beams:
            raise ValueError(f"a scan of {beams} beams; {self.most_beams} are the most")
        with self._lock:
            if self._stop == len(self._geometry) or self._offsets[self._stop] + beams > len(self._ranges):
                self._move()
            end = int(self._offsets[self._stop])
            self._ranges[end : end + beams] = scan.ranges
            geometry = (scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.stamp)
            self._geometry[self._stop] = geometry
            self._frame_ids.append(scan.frame_id)
            self._stop += 1
            self._offsets[self._stop] = end + beams
            self._make_room()
            self._snapshot = None

    def snapshot(self, name: str = "") -> LiveRecording:
        with self._lock:
            if self._snapshot is None:
                self._snapshot = self._recording(name)
            return self._snapshot

    def _make_room(self) -> None:
        while (
            self._stop - self._start > self.most
            or self._offsets[self._stop] - self._offsets[self._start] > self.most_beams
        ):
            self._start += 1
            self.dropped += 1

    def _move(self) -> None:
        rows = slice(self._start, self._stop)
        first, end = self._offsets[self._start], self._offsets[self._stop]
        offsets = self._offsets[self._start : self._stop + 1] - first
        self._begin(self._ranges[first:end], offsets, self._geometry[rows], self._frame_ids[rows])

    def _begin(self, ranges: np.ndarray, offsets: np.ndarray, geometry: np.ndarray, frame_ids: list[str]) -> None:
        """New arrays that begin with these scans. Untouched room takes no memory."""
        scans = len(geometry)
        self._ranges = np.empty(2 * self.most_beams, np.float32)
        self._ranges[: len(ranges)] = ranges
        self._offsets = np.zeros(2 * self.most + 1, np.int64)
        self._offsets[: scans + 1] = offsets
        self._geometry = np.empty((2 * self.most, 5))
        self._geometry[:scans] = geometry
        self._frame_ids = frame_ids
        self._start, self._stop = 0, scans

    def _recording(self, name: str) -> LiveRecording:
        start, stop = self._start, self._stop
        first, end = self._offsets[start], self._offsets[stop]
        angle_min, increment, range_min, range_max, stamps = np.ascontiguousarray(self._geometry[start:stop].T)
        return LiveRecording(
            name=name,
            ranges=self._ranges[first:end],
            offsets=self._offsets[start : stop + 1] - first,
            angle_min=angle_min,
            angle_increment=increment,
            range_min=range_min,
            range_max=range_max,
            stamps=stamps,
            frame_ids=tuple(self._frame_ids[start:stop]),
            topic=self.topic,
            topics=(Topic(self.topic, stop - start),),
            format="live",
            first=self.dropped,
        )
