"""Shared by the readers of bags: choosing a topic and decoding its messages."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scan import Recording, Topic
from . import laser_scan
from .laser_scan import LaserScan
from .source import Source, Sweeps


@dataclass(frozen=True)
class Stream:
    """The messages of one publisher; several may share a topic. `handle` identifies it for its reader."""

    topic: str
    type: str
    messages: int
    handle: Any


@contextmanager
def guarded(source: Source, what: str, hint: str) -> Iterator[None]:
    """Turns any error of a library over a damaged file into one sentence."""
    try:
        yield
    except Exception as error:
        detail = re.sub(r"\('(.*?)\.?',?\)", r"\1", str(error)).strip().rstrip(".") or type(error).__name__
        raise ValueError(f"{source.name}: a damaged {what} ({detail}); {hint}") from None


def choose_streams(source: Source, streams: list[Stream]) -> tuple[str, tuple[Topic, ...], list[Stream]]:
    """The topic to read, all laser topics, and the streams of the chosen one."""
    laser = [stream for stream in streams if stream.type in laser_scan.TYPES]
    if not laser:
        others = ", ".join(sorted({f"{stream.topic} ({_short(stream.type)})" for stream in streams}))
        raise ValueError(f"{source.name} has no sensor_msgs/LaserScan topic; it has {others or 'no topic at all'}.")
    counts: dict[str, int] = {}
    for stream in laser:
        counts[stream.topic] = counts.get(stream.topic, 0) + stream.messages
    topics = tuple(Topic(name, count) for name, count in counts.items())
    topic = source.choose(list(topics))
    return topic, topics, [stream for stream in laser if stream.topic == topic]


def collect(
    source: Source,
    messages: Iterable[tuple[int, bytes]],
    total: int,
    decode: Callable[[bytes], LaserScan],
    topic: str,
    topics: tuple[Topic, ...],
    format: str,
) -> Recording:
    """A Recording from (recording time in nanoseconds, bytes) pairs; these times are used if no message has a stamp."""
    sweeps = Sweeps()
    recorded: list[float] = []
    for done, (nanoseconds, data) in enumerate(messages):
        if done % 64 == 0:
            source.progress(done, total)
        try:
            scan = decode(data)
        except Exception as error:
            raise ValueError(f"{source.name}: message {done} of {topic} cannot be read: {error}.") from None
        recorded.append(1e-9 * nanoseconds)
        sweeps.add(
            scan.ranges, scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max, scan.stamp, scan.frame_id
        )  # fmt: skip
    source.progress(total, total)
    if not sweeps:
        raise ValueError(f"{source.name}: the topic {topic} has no messages; choose another topic.")
    recording = sweeps.recording(source, topic=topic, topics=topics, format=format)
    source.notes.recorded = np.array(recorded)
    return recording


def _short(type: str) -> str:
    """The name of a message type as users write it, without the "/msg/" of ROS 2."""
    return type.replace("/msg/", "/")
