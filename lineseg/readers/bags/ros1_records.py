"""The records of a ROS 1 bag, read one after the other: for bags without an index, or that break off.

Format: http://wiki.ros.org/Bags/Format/2.0.
"""

from __future__ import annotations

import bz2
import io
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from ..containers.bounded import MOST_MESSAGE, TooLargeError, limit_of, too_large

MESSAGE, CHUNK, CONNECTION = 2, 5, 7
MOST_CHUNK = 8 * MOST_MESSAGE


class Connection(NamedTuple):
    """A publisher."""

    id: int
    topic: str
    type: str


def scan_records(path: Path) -> Iterator[tuple[Connection, int, bytes]]:
    """(connection, time of recording in nanoseconds, data) of every message, up to where the bag breaks off."""
    connections: dict[int, Connection] = {}
    with path.open("rb") as file:
        file.readline()
        size = path.stat().st_size
        while (record := _record(file, size)) is not None:
            header, data = record
            if header.get("op") == bytes([CHUNK]):
                yield from _chunk(header, data, connections)
            else:
                yield from _message(header, data, connections)


def _record(file: BinaryIO, size: int) -> tuple[dict[str, bytes], bytes] | None:
    """The header and the data of the next record; None if it is not whole.

    The data of a chunk may be cut, because there are whole messages in it.
    """
    header = _part(file, size)
    fields = {} if header is None else _fields(header)
    data = None if header is None else _part(file, size, cut=fields.get("op") == bytes([CHUNK]))
    return None if data is None else (fields, data)


def _part(file: BinaryIO, size: int, cut: bool = False) -> bytes | None:
    length = file.read(4)
    if len(length) < 4:
        return None
    (wanted,) = struct.unpack("<I", length)
    return file.read(min(wanted, MOST_CHUNK)) if cut or wanted <= size - file.tell() else None


def _fields(header: bytes) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    at = 0
    while at + 4 <= len(header):
        (length,) = struct.unpack_from("<I", header, at)
        name, equals, value = header[at + 4 : at + 4 + length].partition(b"=")
        if not equals:
            break
        found[name.decode("ascii", "replace")] = value
        at += 4 + length
    return found


def _message(
    header: dict[str, bytes], data: bytes, connections: dict[int, Connection]
) -> Iterator[tuple[Connection, int, bytes]]:
    op = header.get("op")
    if op == bytes([CONNECTION]):
        (id,) = struct.unpack("<I", header["conn"])
        kind = _fields(data).get("type", b"").decode("utf-8", "replace")
        connections[id] = Connection(id, header["topic"].decode("utf-8", "replace"), kind)
    elif op == bytes([MESSAGE]):
        (id,) = struct.unpack("<I", header["conn"])
        seconds, nanoseconds = struct.unpack("<II", header["time"])
        if id in connections:
            yield connections[id], seconds * 10**9 + nanoseconds, data


def _chunk(
    header: dict[str, bytes], data: bytes, connections: dict[int, Connection]
) -> Iterator[tuple[Connection, int, bytes]]:
    (size,) = struct.unpack("<I", header["size"])
    limit = min(limit_of(len(data)), MOST_CHUNK)
    if size > limit:
        raise TooLargeError(too_large("a chunk", limit))
    records = io.BytesIO(_expand(header.get("compression", b"none"), data, size))
    while (record := _record(records, size)) is not None:
        yield from _message(*record, connections)


def _expand(compression: bytes, data: bytes, size: int) -> bytes:
    if compression == b"none":
        return data
    if compression == b"bz2":
        return bz2.BZ2Decompressor().decompress(data, max_length=size)
    from lz4.frame import LZ4FrameDecompressor

    return LZ4FrameDecompressor().decompress(data, max_length=size)
