"""The newest scans of a live source. Old scans are dropped; a snapshot never changes."""

from __future__ import annotations

import threading
from dataclasses import dataclass

import numpy as np

from lineseg import Recording
from lineseg.readers.laser_scan import LaserScan
from lineseg.scan import Topic

MOST_SCANS = 3000
# The memory holds this many beams per scan on average, and always a few large scans.
BEAMS_EACH = 2000
LEAST_ROOM = 1_000_000


@dataclass(frozen=True, eq=False)
class LiveRecording(Recording):
    """The scans in a ring at one moment. first: the number of its first scan, counted from 0 since the source began."""

    first: int = 0

    @property
    def total(self) -> int:
        """Number of scans that had arrived."""
        return self.first + len(self)

    def number(self, frame: int) -> int:
        return self.first + frame

    def position(self, number: int) -> int:
        return super().position(number - self.first)


def numbering(recording: Recording) -> tuple[int, int]:
    """The number of the first frame in the file or source, counted from 0, and the step to the next."""
    first = recording.number(0)
    return first, recording.number(1) - first if len(recording) > 1 else 1


class Ring:
    """The newest `most` scans, or fewer if these have more than `most_beams` together.

    Scans are appended to flat arrays of twice that size, which are never overwritten; when they are full, the newest
    scans are copied to new arrays. A snapshot therefore consists of views and costs nothing.
    """

    def __init__(self, most: int = MOST_SCANS, most_beams: int | None = None) -> None:
        self.most = most
        self.most_beams = max(BEAMS_EACH * most, LEAST_ROOM) if most_beams is None else most_beams
        self.topic = ""
        self.dropped = 0
        self._first_stamp: float | None = None
        self._lock = threading.Lock()
        self._begin(np.empty(0, np.float32), np.zeros(1, np.int64), np.empty((0, 5)), [])
        self._snapshot: LiveRecording | None = None

    @property
    def total(self) -> int:
        """Number of scans that have arrived since the source began."""
        with self._lock:
            return self.dropped + self._stop - self._start

    def add(self, scan: LaserScan) -> None:
        beams = len(scan.ranges)
        if beams > self.most_beams:
            raise ValueError(f"the scan has {beams} beams; send at most {self.most_beams}")
        with self._lock:
            if self._stop == len(self._geometry) or self._offsets[self._stop] + beams > len(self._ranges):
                self._move()
            end = int(self._offsets[self._stop])
            self._ranges[end : end + beams] = scan.ranges
            geometry = (scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.stamp)
            self._geometry[self._stop] = geometry
            self._frame_ids.append(scan.frame_id)
            self._first_stamp = scan.stamp if self._first_stamp is None else self._first_stamp
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
        """New arrays that begin with these scans. Unused space takes no memory."""
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
            began=self._first_stamp,
        )
