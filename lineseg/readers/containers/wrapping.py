"""Takes off what files are wrapped in: gzip, zstd, bzip2, xz, zip, tar, UTF-16, UTF-32; also one inside the other."""

from __future__ import annotations

import bz2
import codecs
import gzip
import io
import lzma
import tarfile
import zipfile
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path, PurePosixPath
from typing import IO, cast

from ...failing import reason
from ...unfinished import temporary_folder
from ..account import Notes
from ..source import known_suffixes
from .bounded import expand, file_name, limit_of, zstd_file
from .cut_zip import unpack_cut

LONGEST_PRINTED = 80
ZIP_MAGIC = b"PK\x03\x04"
# What each begins with, its name, and how it is opened.
STREAMS: dict[bytes, tuple[str, Callable[[IO[bytes]], IO[bytes]]]] = {
    b"\x1f\x8b": ("gzip", lambda raw: cast(IO[bytes], gzip.GzipFile(fileobj=raw))),
    b"\x28\xb5\x2f\xfd": ("zstd", zstd_file),
    b"BZh": ("bzip2", lambda raw: cast(IO[bytes], bz2.BZ2File(raw))),
    b"\xfd7zXZ\0": ("xz", lambda raw: cast(IO[bytes], lzma.LZMAFile(raw))),  # noqa: SIM115 - it ends with `raw`
}
STREAM_SUFFIXES = (".gz", ".zst", ".zstd", ".bz2", ".xz")
ARCHIVE_SUFFIXES = (".zip", ".tar", ".tgz")
TAR_MAGIC, TAR_AT = b"ustar", 257
# UTF-32 first, because its mark begins like that of UTF-16.
MARKS = {
    codecs.BOM_UTF32_LE: "utf-32", codecs.BOM_UTF32_BE: "utf-32", codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}  # fmt: skip
PLAIN = frozenset(b"\t\r\n" + bytes(range(32, 127)))
LATIN = PLAIN | frozenset(range(0xA0, 0x100)) | {0x1B}  # with ° and µ, and colours of a terminal
HEAD_BYTES = 1 << 13
MOST_LAYERS = 4
MOST_NAMED = 5
# Texts beside a recording.
ABOUT = ("readme", "license", "licence", "changelog")
BAG_PARTS = (".db3", ".mcap", ".db3.zstd", ".mcap.zstd")
# Offset of the name in the local header of a zip's first entry.
NAME_AT = 30

Progress = Callable[[int, int], None]


def suffixes_of_recordings() -> list[str]:
    """By which a recording is known among other files, also one that is packed."""
    return sorted({*known_suffixes(), *STREAM_SUFFIXES, *ARCHIVE_SUFFIXES})


def unwrapped(path: Path, stack: ExitStack, notes: Notes, progress: Progress) -> Path:
    """`path`, or an expanded copy that lives as long as `stack`: a file, or a folder for the parts of a bag.

    Raises ValueError if nothing can be expanded, if it would grow beyond the limit, or if it has several recordings.
    """
    name = path.name
    for _ in range(MOST_LAYERS):
        if path.is_dir():
            return path
        with path.open("rb") as file:
            head = file.read(HEAD_BYTES)
        if head.startswith(tuple(STREAMS)):
            path = _stream(path, head, name, stack, notes, progress)
        elif encoding := _encoding(head):
            path = _utf8(path, encoding, stack)
        elif head[TAR_AT : TAR_AT + len(TAR_MAGIC)] == TAR_MAGIC:
            path = _untarred(path, name, stack, notes)
        elif head.startswith(ZIP_MAGIC) and not _is_arrays(head):
            unzipped = _unzipped(path, name, stack, notes, progress)
            if unzipped is None:
                return path
            path = unzipped
        else:
            return path
    raise ValueError(f"{name} is compressed more than {MOST_LAYERS - 1} times; unpack it first.")


def _is_arrays(head: bytes) -> bool:
    """Whether a zip is one that a reader opens itself: a failure pack, or NPZ."""
    entry = head[NAME_AT : NAME_AT + int.from_bytes(head[26:28], "little")]
    return entry == b"lineseg.json" or entry.endswith(b".npy")


def _target(path: Path, stack: ExitStack, name: str | None = None) -> Path:
    return stack.enter_context(temporary_folder()) / (name or path.name)


def _stream(path: Path, head: bytes, name: str, stack: ExitStack, notes: Notes, progress: Progress) -> Path:
    size = path.stat().st_size
    bare = path.stem if path.suffix.lower() in STREAM_SUFFIXES else path.name
    target = _target(path, stack, bare or "unpacked")
    kind, opened = next(held for magic, held in STREAMS.items() if head.startswith(magic))
    with path.open("rb") as raw:
        why = expand(opened(raw), target, name, limit_of(size), lambda done: progress(raw.tell(), size))
    tell_break(why, target, name, kind, notes)
    return target


def tell_break(why: str, target: Path, name: str, kind: str, notes: Notes) -> None:
    """Notes why unpacking `target` broke off, if it did. Raises ValueError if nothing could be unpacked."""
    if why and not target.stat().st_size:
        raise ValueError(f"{name}: the {kind} data are incomplete or damaged ({why}); fetch the file again.")
    if why:
        text = f"The {kind} data are incomplete or damaged ({why}); what could be unpacked was read."
        notes.notice("breaks off", text)


def _encoding(head: bytes) -> str:
    """The encoding of text that is not UTF-8, "" for all else: by its mark, or by the NULs between plain characters."""
    marked = next((encoding for mark, encoding in MARKS.items() if head.startswith(mark)), "")
    first = head[:64]
    if marked or len(first) < 8:
        return marked
    for encoding, side in (("utf-16-le", 0), ("utf-16-be", 1)):
        if not any(first[1 - side :: 2]) and all(byte in LATIN for byte in first[side::2]):
            return encoding
    # Lines end with a carriage return alone on an old Mac, and in some tools.
    return "latin-1" if b"\r" in head and b"\n" not in head and all(byte in PLAIN for byte in first) else ""


def _utf8(path: Path, encoding: str, stack: ExitStack) -> Path:
    target = _target(path, stack)
    with path.open("rb") as raw:
        text = io.TextIOWrapper(raw, encoding=encoding, errors="replace", newline=None)
        packed = codecs.iterencode(iter(lambda: text.read(1 << 16), ""), "utf-8")
        with target.open("wb") as out:
            out.writelines(packed)
    return target


def _unzipped(path: Path, name: str, stack: ExitStack, notes: Notes, progress: Progress) -> Path | None:
    """The recording in a zip; None if it is not a whole zip, so that the reader of its suffix may say so."""
    try:
        archive = stack.enter_context(zipfile.ZipFile(path))
    except (zipfile.BadZipFile, OSError, NotImplementedError, ValueError) as error:
        return _cut(path, name, stack, notes, str(error).rstrip("."))
    entries = [entry for entry in archive.infolist() if not entry.is_dir() and not _is_hidden(entry.filename)]
    if any(entry.filename == "lineseg.json" for entry in entries):
        return None
    if any(entry.filename in ("[Content_Types].xml", "mimetype") for entry in entries):
        raise ValueError(f"{name} is a workbook or document; save its table as CSV.")
    parts = _chosen([entry.filename for entry in entries], name)
    folder = _target(path, stack, "bag")
    folder.mkdir()
    left = limit_of(path.stat().st_size)
    for entry in parts:
        target = folder / file_name(entry)
        try:
            with archive.open(entry) as packed:
                why = expand(packed, target, f"{_printed(entry)} in {name}", left)
            left -= target.stat().st_size
        except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError) as error:
            raise ValueError(f"{name}: {_printed(entry)} cannot be unpacked ({reason(error)}).") from None
        tell_break(why, target, f"{_printed(entry)} in {name}", "zip", notes)
    return folder if len(parts) > 1 else next(folder.iterdir())


def _printed(entry: str) -> str:
    """The name of an entry in a line, which may have any bytes."""
    return "".join(each if each.isprintable() else "?" for each in entry)[:LONGEST_PRINTED]


def _untarred(path: Path, name: str, stack: ExitStack, notes: Notes) -> Path:
    """The recording in a tar file, as far as it is there."""
    folder = _target(path, stack, "bag")
    folder.mkdir()
    with tarfile.open(path, "r:") as archive:
        members: list[tarfile.TarInfo] = []
        try:
            members.extend(archive)
        except (tarfile.TarError, OSError) as error:
            text = f"The tar file is incomplete or damaged ({reason(error)}); what could be unpacked was read."
            notes.notice("breaks off", text)
        # A file that is there twice has been replaced.
        entries = {entry.name: entry for entry in members if entry.isfile() and not _is_hidden(entry.name)}
        parts = _chosen(list(entries), name)
        left = limit_of(path.stat().st_size)
        for part in parts:
            packed = archive.extractfile(entries[part])
            assert packed is not None
            target = folder / file_name(part)
            why = expand(packed, target, f"{_printed(part)} in {name}", left)
            left -= target.stat().st_size
            tell_break(why, target, f"{_printed(part)} in {name}", "tar", notes)
    return folder if len(parts) > 1 else next(folder.iterdir())


def _cut(path: Path, name: str, stack: ExitStack, notes: Notes, why: str) -> Path | None:
    """The recording in a zip that breaks off, as far as it is there."""
    folder = _target(path, stack, "bag")
    folder.mkdir()
    found = {part.name: part for part in unpack_cut(path, folder, name) if not _is_hidden(part.name)}
    if any(entry.endswith(".npy") or entry == "lineseg.json" for entry in found) or path.suffix.lower() == ".npz":
        return None
    if not found:
        raise ValueError(f"{name}: a damaged zip file ({why}); fetch it again.")
    parts = [found[entry] for entry in _chosen(list(found), name)]
    for part in parts:
        tell_break(part.why, part.file, f"{_printed(part.name)} in {name}", "zip", notes)
    if len(parts) == 1:
        return parts[0].file
    for part in parts:
        part.file.rename(folder / part.file.name)
    return folder


def _is_hidden(name: str) -> bool:
    path = PurePosixPath(name)
    return path.stem.lower() in ABOUT or any(part.startswith((".", "__MACOSX")) for part in path.parts)


def _chosen(entries: list[str], name: str) -> list[str]:
    """The one recording among the names of entries: a file, or the parts of one bag."""
    bags = [entry for entry in entries if entry.lower().endswith(BAG_PARTS)]
    folders = {str(PurePosixPath(entry).parent) for entry in bags}
    if bags and len(folders) == 1:
        about = [entry for entry in entries if PurePosixPath(entry).name == "metadata.yaml"]
        return bags + [entry for entry in about if str(PurePosixPath(entry).parent) in folders]
    suffixes = (*known_suffixes(), *STREAM_SUFFIXES)
    known = [entry for entry in entries if entry.lower().endswith(suffixes)]
    found = known if known else entries
    if len(found) == 1:
        return found
    listed = ", ".join(found[:MOST_NAMED])
    more = f" and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
    what = f"has several files that may be recordings: {listed}{more}; unpack it and open one" if found else "is empty"
    raise ValueError(f"{name} {what}.")
