"""ROS 2 bags (a folder, or one of its files) and MCAP."""

from __future__ import annotations

import itertools
import shutil
import sqlite3
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Protocol
from urllib.parse import quote

from ...scan import Recording
from ...unfinished import temporary_folder
from ..account import Notes
from ..containers.bounded import MOST_MESSAGE, expand, limit_of, zstd_file
from ..containers.folder import missing_parts, storage_files
from ..containers.wrapping import tell_break
from ..source import Reader, Source
from .decoders import Decoder, is_laser, plain_type
from .mcap_records import McapChannel, McapFile
from .sqlite_pages import scan_pages
from .topics import NotABagError, Stream, choose_streams, collect, cut_off, detail, guarded, tell_cut

SQLITE_MAGIC = b"SQLite format 3\0"
MCAP_MAGIC = b"\x89MCAP"
ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
# The messages of a database are estimated from rows at some places.
PLACES, ROWS = 16, 256
# Steps of SQLite's machine; a row takes some 50.
STEPS_AT_ONCE, LEAST_STEPS, STEPS_A_BYTE = 100_000, 20_000_000, 20


class Storage(Protocol):
    """One file of messages."""

    streams: list[Stream]

    @property
    def broken(self) -> str:
        """Why the file breaks off, "" if it is whole, as far as it was read."""
        ...

    def tell(self, notes: Notes, name: str) -> None:
        """What else was wrong in the file, as far as it was read."""
        ...

    def messages(self, streams: list[Stream]) -> Iterator[tuple[Stream, int, bytes]]: ...


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
        if not source.path.is_dir():
            return _read(source, [source.path], Ros2Bag.format)
        files = storage_files(source.path)
        if missing := missing_parts(source.path, files):
            source.notes.notice(
                "missing part", f"Its metadata.yaml also names {', '.join(missing)}, not in the folder."
            )
        return _read(source, files, Ros2Bag.format)


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


def messages_of(source: Source, wanted: Callable[[Stream], bool]) -> Iterator[tuple[Stream, int, bytes]]:
    """(stream, time of recording in nanoseconds, bytes) of the messages of all streams that are `wanted`."""
    hint = "`ros2 bag reindex` or `mcap recover` may repair it."
    for file in storage_files(source.path) if source.path.is_dir() else [source.path]:
        with ExitStack() as stack, cut_off(source, "bag", hint):
            storage = stack.enter_context(_storage(file, stack, source.notes))
            chosen = [stream for stream in storage.streams if wanted(stream)]
            if chosen:
                yield from storage.messages(chosen)


def _read(source: Source, files: list[Path], format: str) -> Recording:
    hint = "`ros2 bag reindex` or `mcap recover` may repair it."
    with ExitStack() as stack:
        with guarded(source, format, hint):
            storages = _storages(source, files, stack)
        streams = [stream for storage in storages for stream in storage.streams]
        broken = next((storage.broken for storage in storages if storage.broken), "")
        if broken and not streams:
            raise ValueError(f"{source.name}: a damaged {format} ({broken}); {hint}")
        topic, laser, chosen = choose_streams(source, streams)
        decoders = {id(stream): stream.decoder(source) for stream in chosen}

        def messages() -> Iterator[tuple[Decoder, int, bytes]]:
            for storage in storages:
                wanted = [stream for stream in chosen if stream in storage.streams]
                with cut_off(source, format, hint):
                    for stream, nanoseconds, data in storage.messages(wanted) if wanted else ():
                        yield decoders[id(stream)], nanoseconds, data
                storage.tell(source.notes, source.name)
                if storage.broken:
                    tell_cut(source, format, storage.broken, hint)

        return collect(source, messages(), topic, (laser, chosen), format)


def _storages(source: Source, files: list[Path], stack: ExitStack) -> list[Storage]:
    """The files that can be opened; the others are told. Raises what the first of them raised if there are none."""
    found: list[Storage] = []
    failed: list[tuple[str, Exception]] = []
    for file in files:
        try:
            found.append(stack.enter_context(_storage(file, stack, source.notes)))
        except Exception as error:  # what a library over a damaged file may raise
            failed.append((file.name, error))
    for name, error in failed:
        if not found:
            raise error
        why = detail(error).removeprefix(f"{name} ")
        source.notes.notice("lost part", f"{name} was left out, because it cannot be opened ({why}).")
    return found


@contextmanager
def _storage(file: Path, stack: ExitStack, notes: Notes) -> Iterator[Storage]:
    with file.open("rb") as opened:
        magic = opened.read(16)
    if magic.startswith(ZSTD_MAGIC):
        file = _unpack_file(file, stack, notes)
        with file.open("rb") as opened:
            magic = opened.read(16)
    if magic.startswith(MCAP_MAGIC):
        yield _McapStorage(McapFile(stack.enter_context(file.open("rb"))))
    elif magic.startswith(SQLITE_MAGIC):
        yield _Database(_connect(file, stack), file)
    else:
        raise ValueError(f"{file.name} begins with {magic[:8]!r}, which is neither SQLite nor MCAP")


class _Database:
    """The `sqlite3` storage."""

    def __init__(self, database: sqlite3.Connection, file: Path) -> None:
        self.database, self.file = database, file
        self.broken = ""
        held = [name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        if not held and _has_log(file):
            raise NotABagError(
                f"it is an SQLite database without tables; its messages may be in {file.name}-wal, as while a bag is "
                "recorded, so copy both files"
            )
        if held and not {"topics", "messages"} & {str(name).lower() for name in held}:
            raise NotABagError(
                f"it is an SQLite database of {', '.join(map(str, held[:5]))}, not a ROS 2 bag; save its scans as CSV"
            )
        rows = database.execute("SELECT id, name, type, serialization_format FROM topics ORDER BY id").fetchall()
        if any(not isinstance(each, str) for row in rows for each in row[1:3]):
            raise ValueError("the names of its topics are lost")
        lasers = {id for id, _, type, encoding in rows if is_laser(plain_type(type), str(encoding or "cdr"), b"")}
        estimates = self._estimates()
        # To count them, all of the file must be read.
        self._counted = not lasers <= estimates.keys()
        counts = self._counts() if self._counted else estimates
        self.streams = [
            Stream(str(name), plain_type(str(type)), counts.get(id, 0), id, str(encoding or "cdr"))
            for id, name, type, encoding in rows
        ]

    def tell(self, notes: Notes, name: str) -> None:
        """SQLite has no checksums."""

    def _counts(self) -> dict[int, int]:
        """The number of messages of each topic, as far as they are whole."""
        try:
            return dict(self.database.execute("SELECT topic_id, count(*) FROM messages GROUP BY topic_id"))
        except sqlite3.DatabaseError as error:
            self.broken = str(error)
            return Counter(id for _, id, _, _ in scan_pages(self.file))

    def _estimates(self) -> dict[int, int]:
        """About how many messages the topics have that are seen at some places; none for a file that breaks off."""
        if _is_cut(self.file):
            return {}
        query = "SELECT topic_id FROM messages NOT INDEXED WHERE rowid >= ? ORDER BY rowid LIMIT ?"
        seen: Counter[int] = Counter()
        try:
            ((first, last),) = self.database.execute("SELECT min(rowid), max(rowid) FROM messages NOT INDEXED")
            if first is None:
                return {}
            step = (last - first) // PLACES + 1
            for start in range(first, last + 1, step):
                seen.update(id for (id,) in self.database.execute(query, (start, min(step, ROWS))))
        except sqlite3.DatabaseError:
            return {}
        share = (last - first + 1) / sum(seen.values())
        return {id: max(1, round(share * count)) for id, count in seen.items()}

    def messages(self, streams: list[Stream]) -> Iterator[tuple[Stream, int, bytes]]:
        by_id = {stream.handle: stream for stream in streams}
        if self.broken:
            yield from ((by_id[id], time, data) for _, id, time, data in scan_pages(self.file) if id in by_id)
        elif self._counted:
            marks = ",".join("?" * len(by_id))
            # The index of times may be missing from a cut file, so `collect` sorts.
            query = f"SELECT topic_id, timestamp, data FROM messages NOT INDEXED WHERE topic_id IN ({marks})"
            for id, nanoseconds, data in self.database.execute(query, list(by_id)):
                yield by_id[id], nanoseconds, data
        else:
            counts: Counter[int] = Counter()
            for id, nanoseconds, data in self._every_row(list(by_id)):
                counts[id] += 1
                if id in by_id:
                    yield by_id[id], nanoseconds, data
            for stream in self.streams:
                stream.messages = counts[stream.handle]

    def _every_row(self, wanted: list[int]) -> Iterator[tuple[int, int, bytes]]:
        """(topic id, time in nanoseconds, data if it is wanted) of the messages of all topics."""
        marks = ",".join("?" * len(wanted))
        wanted_data = f"CASE WHEN topic_id IN ({marks}) THEN data END"
        query = f"SELECT rowid, topic_id, timestamp, {wanted_data} FROM messages NOT INDEXED ORDER BY rowid"
        last = None
        try:
            for row, id, nanoseconds, data in self.database.execute(query, wanted):
                last = row
                yield id, nanoseconds, data
        except sqlite3.DatabaseError as error:
            self.broken = str(error)
            for row, id, nanoseconds, data in scan_pages(self.file):
                if last is None or row > last:
                    yield id, nanoseconds, data


class _McapStorage:
    """The `mcap` storage."""

    def __init__(self, file: McapFile) -> None:
        self._file = file
        self.streams = [
            Stream(
                each.topic,
                plain_type(each.schema),
                file.counts.get(each.id, 0),
                each.id,
                each.encoding,
                each.schema_data or self._example(each),
            )
            for each in list(file.channels.values())
        ]

    def _example(self, channel: McapChannel) -> bytes:
        """The first message of JSON without a schema, which shows its fields as a schema does."""
        if channel.encoding != "json" or not self._file.counts.get(channel.id):
            return b""
        with closing(self._file.messages({channel.id})) as messages:
            return next((data for _, _, data in messages), b"")

    @property
    def broken(self) -> str:
        lost = self._file.lost
        return self._file.broken or (
            f"the chunk at byte {lost[0].at}: {lost[0].why}" if lost and not self.streams else ""
        )

    def tell(self, notes: Notes, name: str) -> None:
        for chunk in self._file.lost:
            unknown = "" if chunk.messages is not None else "; how many scans it has is unknown"
            scans = 1 if chunk.messages is None else chunk.messages
            notes.skip(f"{name}: the chunk at byte {chunk.at}", f"{chunk.why}{unknown}", scans)
        if self._file.doubt:
            notes.notice("checksum", f"The file is damaged: {self._file.doubt}.")

    def messages(self, streams: list[Stream]) -> Iterator[tuple[Stream, int, bytes]]:
        by_id = {stream.handle: stream for stream in streams}
        for channel, nanoseconds, data in self._file.messages(by_id):
            yield by_id[channel], nanoseconds, data


def _connect(file: Path, stack: ExitStack) -> sqlite3.Connection:
    """The database, opened such that no files are written next to it.

    An immutable database ignores the write-ahead log. If the log has messages (after an interrupted recording), a copy
    of both is opened instead.
    """
    log = file.with_name(f"{file.name}-wal")
    mode = "mode=ro&immutable=1"
    if log.exists() and log.stat().st_size:
        folder = stack.enter_context(temporary_folder())
        for each in (file, log):
            shutil.copyfile(each, folder / each.name)
        file, mode = folder / file.name, "mode=rw"
    database = sqlite3.connect(f"file:{quote(str(file.resolve()))}?{mode}", uri=True)
    stack.callback(database.close)
    _restrict(database, file)
    return database


def _is_cut(file: Path) -> bool:
    """Whether a database is shorter than its header says."""
    with file.open("rb") as opened:
        head = opened.read(32)
    size = int.from_bytes(head[16:18], "big")
    return int.from_bytes(head[28:32], "big") * (1 << 16 if size == 1 else size) > file.stat().st_size


def _has_log(file: Path) -> bool:
    """Whether a database writes to a log beside it first; its header says so."""
    with file.open("rb") as opened:
        return opened.read(20)[18:19] == b"\2"


def _restrict(database: sqlite3.Connection, file: Path) -> None:
    """Only plain tables are read, in a number of steps that suits the size of the file, and no message is huge.

    A view, or pages that refer to each other, could keep a query busy for ever. Raises ValueError for a view.
    """
    most = max(LEAST_STEPS, STEPS_A_BYTE * file.stat().st_size)
    blocks = itertools.count()
    database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MOST_MESSAGE)
    database.set_progress_handler(lambda: next(blocks) * STEPS_AT_ONCE > most, STEPS_AT_ONCE)
    database.execute("PRAGMA trusted_schema = OFF")
    # Otherwise SQLite refuses a file that is shorter than its header says.
    database.execute("PRAGMA writable_schema = ON")
    tables = "SELECT name, type, sql FROM sqlite_master WHERE lower(name) IN ('topics', 'messages')"
    for name, kind, sql in database.execute(tables):
        if kind != "table" or str(sql).upper().startswith("CREATE VIRTUAL"):
            raise ValueError(f"{file.name}: {name} is a {kind} of another kind; a bag has a plain table there.")


def _unpack_file(file: Path, stack: ExitStack, notes: Notes) -> Path:
    """An unpacked copy of a storage file that was compressed as a whole."""
    folder = stack.enter_context(temporary_folder())
    unpacked = folder / file.name.removesuffix(".zstd")
    with file.open("rb") as raw, zstd_file(raw) as packed:
        why = expand(packed, unpacked, file.name, limit_of(file.stat().st_size))
    tell_break(why, unpacked, file.name, "zstd", notes)
    return unpacked
