"""ROS 1 bags with an index: `rosbags` reads it, and this finds the messages that it points to."""

from __future__ import annotations

import heapq
import struct
from collections.abc import Iterator
from itertools import repeat

from rosbags.rosbag1.reader import Header, IndexData, Reader, RecordType, read_bytes, read_uint32

MESSAGE, CONNECTION = b"\4\0\0\0op=\2", b"\4\0\0\0op=\7"
SIZE = struct.Struct("<I")


class IndexedBag(Reader):
    """A reader that leaves the header of a message alone, because the index says the same.

    It computes the length of an index record from its number of entries: bags from 2010 announce 20 bytes per entry
    but contain 12.
    """

    def read_index_data(self, pos: int, indexes: dict[int, list[IndexData]]) -> None:
        assert self.bio
        header = Header.read(self.bio, RecordType.IDXDATA)
        read_uint32(self.bio)
        entries = read_bytes(self.bio, 12 * header.get_uint32("count"))
        indexes[header.get_uint32("conn")].extend(
            IndexData(seconds * 10**9 + nanoseconds, pos, offset)
            for seconds, nanoseconds, offset in struct.iter_unpack("<III", entries)
        )

    def in_order(self, connections: list[int]) -> Iterator[tuple[int, int, bytes]]:
        """(connection, time of recording in nanoseconds, data) of the messages of some connections."""
        assert self.bio
        at, chunk = -1, b""
        for entry, connection in heapq.merge(*(zip(self.indexes[each], repeat(each)) for each in connections)):
            if entry.chunk_pos != at:
                at, found = entry.chunk_pos, self.chunks[entry.chunk_pos]
                self.bio.seek(found.datapos)
                chunk = found.decompressor(read_bytes(self.bio, found.datasize))
            yield connection, entry.time, _message_at(chunk, entry.offset, connection)


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
