"""ROS 1 bags with an index: `rosbags` reads it, and this finds the messages that it points to."""

from __future__ import annotations

import struct
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rosbags.rosbag1.reader import Header, IndexData, Reader, RecordType, read_bytes, read_uint32

MESSAGE, CONNECTION = b"\4\0\0\0op=\2", b"\4\0\0\0op=\7"
SIZE = struct.Struct("<I")
ENTRY = np.dtype([("seconds", "<u4"), ("nanoseconds", "<u4"), ("offset", "<u4")])
AT_ONCE = 4096


class IndexedBag(Reader):
    """A reader that leaves the header of a message alone, because the index says the same, and keeps the index packed.

    It computes the length of an index record from its number of entries: bags from 2010 announce 20 bytes per entry
    but contain 12.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        # Of each connection, (chunk, ENTRY of each message).
        self._entries: dict[int, list[tuple[int, bytes]]] = defaultdict(list)

    def read_index_data(self, pos: int, indexes: dict[int, list[IndexData]]) -> None:
        assert self.bio
        header = Header.read(self.bio, RecordType.IDXDATA)
        read_uint32(self.bio)
        entries = read_bytes(self.bio, ENTRY.itemsize * header.get_uint32("count"))
        self._entries[header.get_uint32("conn")].append((pos, entries))

    def count(self, connection: int) -> int:
        """The number of messages of a connection."""
        return sum(len(entries) for _, entries in self._entries[connection]) // ENTRY.itemsize

    def in_order(self, connections: list[int]) -> Iterator[tuple[int, int, bytes]]:
        """(connection, time of recording in nanoseconds, data) of the messages of some connections."""
        assert self.bio
        at, chunk = -1, b""
        columns = self._sorted(connections)
        for start in range(0, len(columns[0]), AT_ONCE):
            block = (column[start : start + AT_ONCE].tolist() for column in columns)
            for time, position, offset, connection in zip(*block, strict=True):
                if position != at:
                    at, found = position, self.chunks[position]
                    self.bio.seek(found.datapos)
                    chunk = found.decompressor(read_bytes(self.bio, found.datasize))
                yield connection, time, _message_at(chunk, offset, connection)

    def _sorted(self, connections: list[int]) -> tuple[NDArray[np.integer], ...]:
        """(messages,) each: time of recording [ns], chunk, offset in it, and connection of the messages, in order."""
        blocks = [(each, *block) for each in connections for block in self._entries[each]]
        entries = np.frombuffer(b"".join(packed for _, _, packed in blocks), ENTRY)
        lengths = [len(packed) // ENTRY.itemsize for _, _, packed in blocks]
        chunks = np.repeat(np.array([chunk for _, chunk, _ in blocks], np.int64), lengths)
        senders = np.repeat(np.array([each for each, _, _ in blocks], np.uint32), lengths)
        times = entries["seconds"] * np.int64(10**9) + entries["nanoseconds"]
        columns = times, chunks, entries["offset"], senders
        if (np.diff(times) > 0).all():
            return columns
        order = np.lexsort(columns[::-1])
        return tuple(column[order] for column in columns)


def _message_at(chunk: bytes, offset: int, connection: int) -> bytes:
    """The data of a message, before which descriptions of connections may stand. Raises ValueError without one."""
    while True:
        (size,) = SIZE.unpack_from(chunk, offset)
        head = chunk[offset + 4 : offset + 4 + size]
        (length,) = SIZE.unpack_from(chunk, offset + 4 + size)
        start = offset + 8 + size
        if CONNECTION not in head:
            break
        offset = start + length
    data = chunk[start : start + length]
    if MESSAGE not in head or b"conn=" + SIZE.pack(connection) not in head or len(data) < length:
        raise ValueError("the index points to no message of its connection")
    return data
