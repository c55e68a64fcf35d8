"""The records of an MCAP file, read one after the other: no index is needed, and a file may break off.

Format: https://mcap.dev/spec. Checksums are checked where the file has them.
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Generator, Iterator
from dataclasses import dataclass
from os import SEEK_END
from typing import BinaryIO, NamedTuple
from zlib import crc32

from ..containers.bounded import MOST_MESSAGE, TooLargeError, limit_of, too_large, unzstd

MAGIC = b"\x89MCAP0\r\n"
SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, DATA_END, FOOTER = 3, 4, 5, 6, 7, 15, 2
CHUNK_INDEX, STATISTICS = 8, 11
HEAD = struct.Struct("<BQ")
MESSAGE_HEAD = struct.Struct("<HIQQ")
MOST_RECORD = 1 << 30
MOST_CHUNK = 8 * MOST_MESSAGE


class BrokenError(ValueError):
    """The file breaks off, or is damaged from here on."""


@dataclass
class LostChunk:
    """A chunk that cannot be read. at: its byte in the file; messages: those wanted, None if the file does not say."""

    at: int
    why: str
    messages: int | None = None

    def count(self, index: bytes, wanted: Collection[int] | None) -> None:
        """Add the messages of one channel, by their index, which follows the chunk."""
        channel, size = struct.unpack_from("<HI", index)
        self.messages = (self.messages or 0) + (size // 16 if wanted is None or channel in wanted else 0)


class McapChannel(NamedTuple):
    """A channel with its schema."""

    id: int
    topic: str
    encoding: str
    schema: str
    schema_encoding: str
    schema_data: bytes


class McapFile:
    """The channels of a file, the number of messages of each, and its messages.

    Known when all was read: broken: where and why the file breaks off, "" if it is whole; lost: chunks that were left
    out; doubt: which other checksum differs, "" if none does.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._at = 0
        self._size = file.seek(0, SEEK_END)
        file.seek(0)
        self.channels: dict[int, McapChannel] = {}
        self.counts: dict[int, int] = {}
        self.broken = self.doubt = ""
        self.lost: list[LostChunk] = []
        # Whether the data may have a checksum.
        self._summed = True
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        if self._file.read(len(MAGIC)) != MAGIC:
            raise BrokenError("it does not begin like MCAP")
        self._indexed = self._read_summary()
        if not self._indexed:
            for _ in self._scan(None):
                pass

    def messages(self, channels: Collection[int]) -> Generator[tuple[int, int, bytes], None, None]:
        """(channel, time of recording in nanoseconds, data) of these channels, chunk after chunk."""
        return self._scan(set(channels))

    def _read_summary(self) -> bool:
        """Whether the summary at the end names all channels and their counts."""
        try:
            self._file.seek(-(HEAD.size + 20 + len(MAGIC)), 2)
            opcode, _ = HEAD.unpack(self._exactly(HEAD.size))
            start, _, checksum = struct.unpack("<QQI", self._exactly(20))
            if opcode != FOOTER or self._file.read() != MAGIC or not 0 < start < self._size:
                return False
            self._at = self._file.seek(start)
            if checksum and crc32(self._file.read(self._size - start - 4 - len(MAGIC))) != checksum:
                self.doubt = "the checksum of its index differs, so the file was read without it"
                return False
            self._at = self._file.seek(start - HEAD.size - 4)
            opcode, _ = HEAD.unpack(self._exactly(HEAD.size))
            self._summed = opcode != DATA_END or any(self._exactly(4))
            self._at = self._file.seek(start)
            counted = False
            while (record := self._record()) is not None and record[0] != FOOTER:
                opcode, body = record
                self._learn(opcode, body)
                if opcode == STATISTICS:
                    counted = True
                    self.counts = dict(struct.iter_unpack("<HQ", body[46 : 46 + struct.unpack_from("<I", body, 42)[0]]))
        except (BrokenError, OSError, struct.error, UnicodeDecodeError):
            self.channels, self.counts = {}, {}
            return False
        return counted and self.counts.keys() <= self.channels.keys()

    def _scan(self, wanted: set[int] | None) -> Generator[tuple[int, int, bytes], None, None]:
        """The messages in file order; wanted: None to learn about channels and to count, without messages."""
        self._at = self._file.seek(len(MAGIC))
        self.lost, before, checksum, lost = [], self._at, crc32(MAGIC), None
        try:
            while (record := self._record()) is not None:
                opcode, body = record
                if opcode == DATA_END:
                    self._end(body, checksum)
                    return
                if self._summed:
                    checksum = crc32(body, crc32(HEAD.pack(opcode, len(body)), checksum))
                if opcode == CHUNK:
                    lost = yield from self._chunk(body, before, wanted)
                elif opcode == MESSAGE_INDEX:
                    if lost is not None:
                        lost.count(body, wanted)
                elif opcode == MESSAGE:
                    if (message := self._message(body, wanted)) is not None:
                        yield message
                else:
                    self._learn(opcode, body)
                before = self._at
            self.broken = "its end is missing"
        except (BrokenError, UnicodeDecodeError) as error:
            self.broken = str(error).rstrip(".")
        except struct.error:
            self.broken = f"a record before byte {self._at} is not whole"

    def _record(self) -> tuple[int, bytes] | None:
        """(opcode, content) of the next record; None at the end of the file. Raises BrokenError if it is not whole."""
        head = self._file.read(HEAD.size)
        self._at += len(head)
        if not head:
            return None
        if len(head) < HEAD.size:
            raise BrokenError(f"its last record breaks off at byte {self._size}")
        opcode, length = HEAD.unpack(head)
        left = self._size - self._at
        if length > left:
            if opcode != CHUNK:
                raise BrokenError(f"its last record breaks off at byte {self._size}")
            # A chunk may still have whole messages in the part that is there.
            length = left
        if length > MOST_RECORD:
            raise TooLargeError(too_large("a record", MOST_RECORD))
        return opcode, self._exactly(length)

    def _exactly(self, size: int) -> bytes:
        data = self._file.read(size)
        self._at += len(data)
        if len(data) < size:
            raise BrokenError(f"it breaks off at byte {self._size}")
        return data

    def _learn(self, opcode: int, body: bytes) -> None:
        if opcode == SCHEMA:
            (id,) = struct.unpack_from("<H", body)
            name, at = _text(body, 2)
            encoding, at = _text(body, at)
            size = struct.unpack_from("<I", body, at)[0]
            self._schemas[id] = (name, encoding, body[at + 4 : at + 4 + size])
        elif opcode == CHANNEL:
            id, schema = struct.unpack_from("<HH", body)
            topic, at = _text(body, 4)
            encoding, _ = _text(body, at)
            self.channels.setdefault(id, McapChannel(id, topic, encoding, *self._schemas.get(schema, ("", "", b""))))

    def _message(self, body: bytes | memoryview, wanted: set[int] | None) -> tuple[int, int, bytes] | None:
        channel, _, time, _ = MESSAGE_HEAD.unpack_from(body)
        if wanted is not None:
            return (channel, time, bytes(body[MESSAGE_HEAD.size :])) if channel in wanted else None
        self.counts[channel] = self.counts.get(channel, 0) + 1
        return None

    def _chunk(
        self, body: bytes, at: int, wanted: set[int] | None
    ) -> Generator[tuple[int, int, bytes], None, LostChunk | None]:
        """The messages of the chunk at byte `at`; returns it if it is lost.

        Raises BrokenError if the file breaks off in it.
        """
        try:
            data, cut = _expanded(body)
            records = list(_records(data, cut))
        except BrokenError as error:
            self.lost.append(LostChunk(at, str(error)))
            return self.lost[-1]
        for opcode, record in records:
            if opcode == MESSAGE:
                if (message := self._message(record, wanted)) is not None:
                    yield message
            elif not self._indexed:
                self._learn(opcode, bytes(record))
        if cut:
            raise BrokenError(cut)
        return None

    def _end(self, body: bytes, checksum: int) -> None:
        """Compare the checksum of all that was read with the one at its end; lost chunks are told already."""
        (expected,) = struct.unpack_from("<I", body)
        if expected not in (0, checksum) and not self.lost:
            self.doubt = "the checksum of its data differs, so some scans may be wrong"


def _records(data: bytes, cut: str) -> Iterator[tuple[int, memoryview]]:
    """(opcode, content) of the records in a chunk. cut: why it breaks off, "" if it is whole. Raises BrokenError."""
    records, at = memoryview(data), 0
    while at + HEAD.size <= len(records):
        opcode, length = HEAD.unpack_from(records, at)
        at += HEAD.size
        if at + length > len(records):
            if cut:
                return
            raise BrokenError("its last record is longer than it")
        yield opcode, records[at : at + length]
        at += length


def _text(body: bytes, at: int) -> tuple[str, int]:
    """The string at `at`, and where it ends."""
    (size,) = struct.unpack_from("<I", body, at)
    return body[at + 4 : at + 4 + size].decode(), at + 4 + size


def _expanded(body: bytes) -> tuple[bytes, str]:
    """The records of a chunk, as far as they are whole, and what is wrong with it. Raises TooLargeError."""
    _, _, size, checksum = struct.unpack_from("<QQQI", body)
    compression, at = _text(body, 28)
    (packed_size,) = struct.unpack_from("<Q", body, at)
    packed = body[at + 8 : at + 8 + packed_size]
    limit = min(limit_of(packed_size), MOST_CHUNK)
    if size > limit:
        raise TooLargeError(too_large("a chunk", limit))
    try:
        data = _expand(compression, packed, size)
    except Exception as error:  # each library has errors of its own
        raise BrokenError(f"it cannot be unpacked, {error or type(error).__name__}") from None
    if len(packed) < packed_size or len(data) < size:
        return data, "its last chunk breaks off"
    if len(data) != size:
        raise BrokenError("it is larger than it says")
    if checksum and crc32(data) != checksum:
        raise BrokenError("its checksum differs")
    return data, ""


def _expand(compression: str, packed: bytes, size: int) -> bytes:
    """At most one byte more than `size`, and less if `packed` breaks off."""
    if compression == "":
        return packed
    if compression == "zstd":
        return unzstd(packed, size + 1)
    if compression == "lz4":
        from lz4.frame import LZ4FrameDecompressor

        return LZ4FrameDecompressor().decompress(packed, max_length=size + 1)
    raise BrokenError(f"it is compressed with {compression!r}, which is not known")
