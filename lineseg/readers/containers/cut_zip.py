"""The entries of a zip that breaks off, one after the other: the list of them was at its end.

Format: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import IO, NamedTuple, cast

from .bounded import PIECE, expand, file_name, limit_of

# Signature, flags, method, sizes of the data packed and unpacked, and of the name and what follows it.
HEADER = struct.Struct("<4s2xHH8xIIHH")
SIGNATURE, STORED, DEFLATED, SIZE_FOLLOWS = b"PK\x03\x04", 0, 8, 8
# A size that is stated elsewhere.
LONG = 0xFFFFFFFF
# Behind data of a size that was not known before stand its sizes.
MOST_BETWEEN = 64


class Part(NamedTuple):
    """An entry: its name, where it was unpacked to, and why it breaks off, "" if it is whole."""

    name: str
    file: Path
    why: str


def unpack_cut(path: Path, folder: Path, name: str) -> list[Part]:
    """Unpacks what is there of the entries of a zip into `folder`. Raises TooLargeError."""
    parts: list[Part] = []
    left = limit_of(path.stat().st_size)
    with path.open("rb") as raw:
        while len(head := raw.read(HEADER.size)) == HEADER.size and head.startswith(SIGNATURE):
            _, flags, method, packed, _, *lengths = HEADER.unpack(head)
            entry = raw.read(lengths[0]).decode("utf-8", "replace")
            packed = _long_size(raw.read(lengths[1])) if packed == LONG else packed
            known = not flags & SIZE_FOLLOWS and packed != LONG
            if not entry or entry.endswith("/") or method not in (STORED, DEFLATED) or (method == STORED and not known):
                raw.seek(packed if known else 0, 1)
                continue
            data = _Data(raw, method == DEFLATED, packed if known else None)
            target = folder / f"{len(parts)}" / file_name(entry)
            target.parent.mkdir()
            why = expand(cast(IO[bytes], data), target, f"{entry} in {name}", left)
            left -= target.stat().st_size
            parts.append(Part(entry, target, why))
            behind = raw.read(MOST_BETWEEN)
            raw.seek(max(behind.find(SIGNATURE), 0) - len(behind), 1)
    return parts


def _long_size(extra: bytes) -> int:
    """The packed size that an entry states beside its header, as numpy does for all; LONG if it does not."""
    at = 0
    while at + 4 <= len(extra):
        kind, size = struct.unpack_from("<HH", extra, at)
        if kind == 1 and size >= 16 and at + 20 <= len(extra):
            return struct.unpack_from("<8xQ", extra, at + 4)[0]
        at += 4 + size
    return LONG


class _Data:
    """The data of an entry, unpacked while it is read. Raises ValueError where it breaks off."""

    def __init__(self, raw: IO[bytes], deflated: bool, packed: int | None) -> None:
        self._raw, self._left = raw, packed
        self._inflate = zlib.decompressobj(-zlib.MAX_WBITS) if deflated else None

    def read(self, _: int) -> bytes:
        while self._left != 0 and not (self._inflate and self._inflate.eof):
            piece = self._raw.read(PIECE if self._left is None else min(PIECE, self._left))
            if not piece:
                raise ValueError("its end is missing")
            self._left = None if self._left is None else self._left - len(piece)
            if self._inflate is None:
                return piece
            data = self._inflate.decompress(piece)
            if self._inflate.eof:
                self._raw.seek(-len(self._inflate.unused_data), 1)
            if data:
                return data
        return b""
