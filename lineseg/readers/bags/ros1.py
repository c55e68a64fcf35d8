"""ROS 1 bags of version 2.0, any compression."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

from ...scan import Recording
from ..source import Reader, Source
from .decoders import Decoder, is_laser
from .ros1_records import Connection, scan_records
from .topics import Stream, choose_streams, collect, cut_off, detail, tell_cut


class Ros1Bag(Reader):
    """`rosbags` finds the messages; this reader decodes the bytes of a LaserScan."""

    format = "ROS 1 bag"
    suffixes = (".bag", ".active")
    expects = "#ROSBAG V2.0 at its beginning"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith((b"#ROSBAG V", b"#ROSRECORD V"))

    @staticmethod
    def read(source: Source) -> Recording:
        _check_version(source)
        with ExitStack() as stack:
            try:
                bag = stack.enter_context(_with_index(source))
            except Exception as error:  # rosbags has errors of its own, and needs an index
                return _without_index(source, detail(error))
            streams = [Stream(each.topic, each.msgtype, bag.count(each.id), each, "ros1") for each in bag.connections]
            topic, laser, chosen = choose_streams(source, streams)
            return collect(source, _messages(source, bag, chosen), topic, (laser, chosen), Ros1Bag.format)


def messages_of(source: Source, wanted: Callable[[Stream], bool]) -> Iterator[tuple[Stream, int, bytes]]:
    """(stream, time of recording in nanoseconds, bytes) of the messages of all streams that are `wanted`."""
    hint = "`rosbag reindex` or `rosbag fix` may repair it."
    with ExitStack() as stack, cut_off(source, "ROS bag", hint):
        try:
            bag = stack.enter_context(_with_index(source))
        except Exception:  # rosbags has errors of its own, and needs an index
            for connection, nanoseconds, data in scan_records(source.path):
                stream = Stream(connection.topic, _modern(connection.type), 0, connection, "ros1")
                if wanted(stream):
                    yield stream, nanoseconds, data
            return
        streams = {
            each.id: Stream(each.topic, each.msgtype, bag.count(each.id), each, "ros1") for each in bag.connections
        }
        chosen = [stream.handle for stream in streams.values() if wanted(stream)]
        for connection, nanoseconds, data in bag.in_order([each.id for each in chosen]):
            yield streams[connection], nanoseconds, data


def _modern(type: str) -> str:
    """The name of a type as `rosbags` gives it."""
    return type if "/msg/" in type else type.replace("/", "/msg/")


def _check_version(source: Source) -> None:
    with source.path.open("rb") as file:
        first = file.readline(64).decode("ascii", "replace").strip()
    match = re.fullmatch(r"#ROS(?:BAG|RECORD) V(\d+\.\d+)", first)
    if match is None:
        raise ValueError(f"{source.name} begins with {first!r}; a ROS bag begins with #ROSBAG V2.0.")
    if float(match[1]) < 2:
        raise ValueError(
            f"{source.name}: a ROS bag of version {match[1]}; versions 2.0 and newer can be read. "
            "`rosbag migrate` upgrades it."
        )


def _with_index(source: Source) -> Any:
    from .indexed_bag import IndexedBag  # rosbags takes a while to import

    return IndexedBag(source.path)


def _messages(source: Source, bag: Any, streams: list[Stream]) -> Iterator[tuple[Decoder, int, bytes]]:
    decoders = {stream.handle.id: stream.decoder(source) for stream in streams}
    with cut_off(source, "ROS bag", "`rosbag fix` may save more of it."):
        for connection, nanoseconds, data in bag.in_order(list(decoders)):
            yield decoders[connection], nanoseconds, data


def _without_index(source: Source, why: str) -> Recording:
    """The scans of a bag that breaks off or was never closed, as far as it goes.

    Raises ValueError if there are none.
    """
    hint = "`rosbag reindex` or `rosbag fix` may repair it."
    found: dict[Connection, list[tuple[int, bytes]]] = {}
    with cut_off(source, "ROS bag", hint):
        for connection, nanoseconds, data in scan_records(source.path):
            messages = found.setdefault(connection, [])
            if is_laser(connection.type):
                messages.append((nanoseconds, data))
    if not any(found.values()):
        raise ValueError(f"{source.name}: a damaged ROS bag ({why}); {hint}")
    streams = [Stream(each.topic, each.type, len(messages), each, "ros1") for each, messages in found.items()]
    topic, laser, chosen = choose_streams(source, streams)
    if not any(notice.kind == "breaks off" for notice in source.notes.notices):
        tell_cut(source, "ROS bag", why, hint)
    decoders = [(stream.decoder(source), found[stream.handle]) for stream in chosen]
    rows = [(decoder, *row) for decoder, messages in decoders for row in messages]
    return collect(source, sorted(rows, key=lambda row: row[1]), topic, (laser, chosen), Ros1Bag.format)
