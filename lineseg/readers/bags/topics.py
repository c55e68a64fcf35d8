"""Shared by the readers of bags: choosing a topic and decoding its messages."""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...scan import Floats, Recording, Topic
from ..source import Source, Sweeps
from .decoders import MULTI_ECHO, POINT_CLOUDS, Decoder, decoder_of, is_laser

# Room for so many times as many scans as announced, because that may be an estimate.
ROOM = 1.25


@dataclass(eq=False)
class Stream:
    """The messages of one publisher; several may share a topic. `handle` identifies it for its reader.

    messages: their number, which may be an estimate until they were read. encoding, schema: of its messages.
    """

    topic: str
    type: str
    messages: int
    handle: Any
    encoding: str = "cdr"
    schema: bytes = b""

    def decoder(self, source: Source) -> Decoder:
        """Raises ValueError if its messages cannot be read."""
        return decoder_of(self.type, self.encoding, self.schema, source.reading.echo or 0)


class NotABagError(ValueError):
    """A file that is whole, but no bag."""


@contextmanager
def guarded(source: Source, what: str, hint: str) -> Iterator[None]:
    """Turns any error of a library over a damaged file into one sentence."""
    try:
        yield
    except NotABagError as error:
        raise ValueError(f"{source.name}: {error}.") from None
    except Exception as error:
        raise ValueError(f"{source.name}: a damaged {what} ({detail(error)}); {hint}") from None


@contextmanager
def cut_off(source: Source, what: str, hint: str) -> Iterator[None]:
    """Ends the reading at the first damage, and notes it: what came before stays."""
    try:
        yield
    except Exception as error:
        tell_cut(source, what, detail(error), hint)


def tell_cut(source: Source, what: str, why: str, hint: str) -> None:
    source.notes.notice("breaks off", f"A damaged {what} ({why}), read up to there; {hint}")


def detail(error: Exception) -> str:
    """An error of a library in one line."""
    return re.sub(r"\('(.*?)\.?',?\)", r"\1", str(error)).strip().rstrip(".") or type(error).__name__


def choose_streams(source: Source, streams: list[Stream]) -> tuple[str, list[Stream], list[Stream]]:
    """The topic to read, the streams of all laser topics, and those of the chosen one."""
    laser = [stream for stream in streams if is_laser(stream.type, stream.encoding, stream.schema)]
    if not laser:
        others = ", ".join(sorted({f"{stream.topic} ({_short(stream.type) or stream.encoding})" for stream in streams}))
        clouds = any(stream.type in POINT_CLOUDS for stream in streams)
        way = " A node such as pointcloud_to_laserscan makes scans of a point cloud." if clouds else ""
        if any(stream.encoding == "json" for stream in streams):
            way = " If its JSON has scans, `mcap cat --json FILE.mcap > scans.json` writes a file that can be opened."
        way = way if streams else " Record the topic of the laser again."
        sentence = f"{source.name} has no sensor_msgs/LaserScan topic; it has {others or 'no topic at all'}.{way}"
        raise ValueError(sentence)
    laser = _readable(source, laser)
    topic = source.choose(list(_topics_of(laser)))
    chosen = [stream for stream in laser if stream.topic == topic]
    if source.reading.echo is not None and not any(stream.type in MULTI_ECHO for stream in chosen):
        raise ValueError(f"{source.name}: echo cannot be used, because the beams of {topic} have one range each.")
    return topic, laser, chosen


def _topics_of(streams: list[Stream]) -> tuple[Topic, ...]:
    counts: dict[str, int] = {}
    for stream in streams:
        counts[stream.topic] = counts.get(stream.topic, 0) + stream.messages
    return tuple(Topic(name, count) for name, count in counts.items())


def _readable(source: Source, streams: list[Stream]) -> list[Stream]:
    """The streams that can be decoded; the others are told.

    Raises ValueError if there are none, or none of the wanted topic.
    """
    found: list[Stream] = []
    errors: dict[str, ValueError] = {}
    for stream in streams:
        try:
            stream.decoder(source)
        except ValueError as error:
            errors.setdefault(stream.topic, error)
        else:
            found.append(stream)
    there = {stream.topic for stream in found}
    for topic, error in errors.items():
        if not any(stream.messages for stream in found) or (topic == source.reading.topic and topic not in there):
            raise ValueError(f"{source.name}: {topic}: {error}.")
        some = "Some of the messages" if topic in there else "The messages"
        source.notes.notice("unreadable topic", f"{some} of {topic} were left out: {error}.")
    return found


def collect(
    source: Source,
    messages: Iterable[tuple[Decoder, int, bytes]],
    topic: str,
    streams: tuple[list[Stream], list[Stream]],
    format: str,
) -> Recording:
    """A Recording from (decoder, recording time in nanoseconds, bytes); messages that cannot be read are skipped.

    Each publisher has a decoder of its own. streams: those of all laser topics, and those of the chosen one.
    """
    laser, chosen = streams
    total = sum(stream.messages for stream in chosen)
    sweeps = Sweeps()
    recorded = array("d")
    publishers: list[Decoder] = []
    rising = True

    def part(source: Source) -> Recording:
        recording = sweeps.recording(source, partial=True, topic=topic, topics=_topics_of(laser), format=format)
        _note_times(source, recording, 1e-9 * np.array(recorded), publishers)
        return recording

    for done, (decode, nanoseconds, data) in enumerate(messages):
        if done % 64 == 0:
            source.progress(min(done, total), total)
            if rising:
                source.offer(len(sweeps), part)
        try:
            at = float(nanoseconds)
            sweeps.extend([decode(data)])
        except Exception as error:
            source.notes.skip(f"{source.name}: message {done} of {topic}", f"it cannot be read, {error}")
            continue
        # Scans that are to be sorted would be others under the same numbers.
        rising = rising and (not recorded or at >= recorded[-1])
        recorded.append(at)
        publishers.append(decode)
        if len(sweeps) == 1:
            sweeps.ranges.reserve_for(int(ROOM * total))
    source.progress(total, total)
    if not len(sweeps):
        source.notes.nothing_left()
        others = ", ".join(each.name for each in _topics_of(laser) if each.scans)
        way = f"choose one of {others}" if others else "no other topic of scans has any, so record it again"
        raise ValueError(f"{source.name}: the topic {topic} has no messages; {way}.")
    recording = sweeps.recording(source, topic=topic, topics=_topics_of(laser), format=format)
    times = 1e-9 * np.array(recorded)
    if (np.diff(times) < 0).any():
        order = np.argsort(times, kind="stable")
        recording, times, publishers = recording.only(order), times[order], [publishers[k] for k in order.tolist()]
    _note_times(source, recording, times, publishers)
    return recording


def _note_times(source: Source, recording: Recording, times: Floats, publishers: list[Decoder]) -> None:
    """Notes when and by whom each scan was published."""
    source.notes.recorded = times
    senders = np.fromiter(map(id, publishers), np.int64, len(publishers))
    source.notes.publishers = senders if (senders != senders[0]).any() else None
    source.notes.stamps = "the messages" if recording.stamps.any() else "the recorder"


def _short(type: str) -> str:
    """The name of a message type as users write it, without the "/msg/" of ROS 2."""
    return type.replace("/msg/", "/")
