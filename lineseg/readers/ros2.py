"""ROS 2 bags (a folder, or one of its files) and MCAP."""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO, Any, Protocol, cast
from urllib.parse import quote

from ..scan import Recording
from .bags import Stream, choose_streams, collect, guarded
from .bounded import expand, limit_of, unzstd
from .folder import storage_files
from .laser_scan import decode_cdr, decode_ros1
from .source import Reader, Source

SQLITE_MAGIC = b"SQLite format 3\0"
MCAP_MAGIC = b"\x89MCAP"
ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"


class Storage(Protocol):
    """One file of messages."""

    streams: list[Stream]

    def messages(self, streams: list[Stream]) -> Iterator[tuple[int, bytes]]: ...


class Ros2Bag(Reader):
    """A folder of .db3 or .mcap files, or one .db3. `metadata.yaml` is not needed, because the files say the same."""

    format = "ROS 2 bag"
    suffixes = (".db3",)
    expects = "an SQLite database with the tables `topics` and `messages`"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(SQLITE_MAGIC)

    @staticmethod
    def read(source: Source) -> Recording:
        return _read(source, storage_files(source.path) if source.path.is_dir() else [source.path], Ros2Bag.format)


class Mcap(Reader):
    """A bare MCAP file."""

    format = "MCAP"
    suffixes = (".mcap",)
    expects = "\\x89MCAP at its beginning"

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(MCAP_MAGIC)

    @staticmethod
    def read(source: Source) -> Recording:
        return _read(source, [source.path], Mcap.format)


def _read(source: Source, files: list[Path], format: str) -> Recording:
    hint = "`ros2 bag reindex` or `mcap recover` may repair it."
    with ExitStack() as stack:
        storages: list[Storage] = []
        for file in files:
            with guarded(source, format, hint):
                storages.append(stack.enter_context(_storage(file, stack)))
        streams = [stream for storage in storages for stream in storage.streams]
        topic, topics, chosen = choose_streams(source, streams)
        encodings = {stream.handle.encoding for stream in chosen}
        if not encodings <= {"cdr", "ros1"}:
            raise ValueError(
                f"{source.name}: {topic} is encoded as {', '.join(sorted(encodings))}; only cdr can be read."
            )

        def messages() -> Iterator[tuple[int, bytes]]:
            for storage in storages:
                wanted = [stream for stream in chosen if stream in storage.streams]
                with guarded(source, format, hint):
                    yield from storage.messages(wanted) if wanted else ()

        decode = decode_ros1 if encodings == {"ros1"} else lambda data: decode_cdr(_unpacked(data))
        total = sum(stream.messages for stream in chosen)
        return collect(source, messages(), total, decode, topic, topics, format)


@contextmanager
def _storage(file: Path, stack: ExitStack) -> Iterator[Storage]:
    with file.open("rb") as opened:
        magic = opened.read(16)
    if magic.startswith(ZSTD_MAGIC):
        file = _unpack_file(file, stack)
        with file.open("rb") as opened:
            magic = opened.read(16)
    if magic.startswith(MCAP_MAGIC):
        from rosbags.rosbag2.storage_mcap import McapReader

        reader = McapReader(file)
        reader.open()
        try:
            yield _McapFile(reader)
        finally:
            reader.close()
    elif magic.startswith(SQLITE_MAGIC):
        yield _Database(_connect(file, stack))
    else:
        raise ValueError(f"{file.name} begins with {magic[:8]!r}, which is neither SQLite nor MCAP")


class _Channel:
    """The id of a publisher in a storage file."""

    def __init__(self, id: Any, encoding: str) -> None:
        self.id, self.encoding = id, encoding


class _Database:
    """The `sqlite3` storage."""

    def __init__(self, database: sqlite3.Connection) -> None:
        self.database = database
        counts = dict(database.execute("SELECT topic_id, count(*) FROM messages GROUP BY topic_id"))
        rows = database.execute("SELECT id, name, type, serialization_format FROM topics ORDER BY id")
        self.streams = [
            Stream(name, type, counts.get(id, 0), _Channel(id, encoding or "cdr")) for id, name, type, encoding in rows
        ]

    def messages(self, streams: list[Stream]) -> Iterator[tuple[int, bytes]]:
        ids = [stream.handle.id for stream in streams]
        marks = ",".join("?" * len(ids))
        yield from self.database.execute(
            f"SELECT timestamp, data FROM messages WHERE topic_id IN ({marks}) ORDER BY timestamp, id", ids
        )


class _McapFile:
    """The `mcap` storage, through `rosbags`."""

    def __init__(self, reader: Any) -> None:
        self.reader = reader
        self.streams = [
            Stream(each.topic, each.msgtype, each.msgcount, _Channel(each, each.ext.serialization_format))
            for each in reader.connections
        ]

    def messages(self, streams: list[Stream]) -> Iterator[tuple[int, bytes]]:
        for _, nanoseconds, data in self.reader.messages([stream.handle.id for stream in streams]):
            yield nanoseconds, data


def _connect(file: Path, stack: ExitStack) -> sqlite3.Connection:
    """The database, opened such that no files are written next to it.

    An immutable database ignores the write-ahead log. If the log has messages (after an interrupted recording), a copy
    of both is opened instead.
    """
    log = file.with_name(f"{file.name}-wal")
    mode = "mode=ro&immutable=1"
    if log.exists() and log.stat().st_size:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="lineseg-")))
        for each in (file, log):
            shutil.copyfile(each, folder / each.name)
        file, mode = folder / file.name, "mode=rw"
    database = sqlite3.connect(f"file:{quote(str(file.resolve()))}?{mode}", uri=True)
    stack.callback(database.close)
    return database


def _unpack_file(file: Path, stack: ExitStack) -> Path:
    """An unpacked copy of a storage file that was compressed as a whole."""
    from rosbags.rosbag2.reader import zstd

    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="lineseg-")))
    unpacked = folder / file.name.removesuffix(".zstd")
    with zstd.open(file, "rb") as packed:
        expand(cast(IO[bytes], packed), unpacked, file.name, limit_of(file.stat().st_size))
    return unpacked


def _unpacked(data: bytes) -> bytes:
    """A message, decompressed if necessary; CDR never begins like zstd."""
    return unzstd(data) if data.startswith(ZSTD_MAGIC) else data
