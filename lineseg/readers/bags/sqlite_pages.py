"""The messages of a `.db3` that breaks off, page by page, because SQLite reaches rows through pages that may be gone.

Format: https://www.sqlite.org/fileformat2.html.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from pathlib import Path

from ..containers.bounded import MOST_MESSAGE

LEAF = 0x0D
# The columns of `messages`: id (kept as the number of the row), topic_id, timestamp, data.
COLUMNS = 4
INTEGERS = {1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 8: 0, 9: 0}


def scan_pages(path: Path) -> Iterator[tuple[int, int, int, bytes]]:
    """(row, topic id, time of recording in nanoseconds, data) of each whole message, in the order of the file."""
    with path.open("rb") as file:
        head = file.read(100)
        size = int.from_bytes(head[16:18], "big")
        size = 1 << 16 if size == 1 else size
        usable = size - head[20]
        file.seek(0)
        pages = path.stat().st_size // size if size >= 512 else 0

        def page(number: int) -> bytes:
            if not 0 < number <= pages:
                raise ValueError("a page is missing")
            file.seek((number - 1) * size)
            return file.read(size)

        for number in range(2, pages + 1):
            leaf = page(number)
            if leaf[0] != LEAF:
                continue
            for (at,) in struct.iter_unpack(">H", leaf[8 : 8 + 2 * int.from_bytes(leaf[3:5], "big")]):
                try:
                    row, payload = _payload(leaf, at, usable, page)
                    yield row, *_message(payload)
                except (ValueError, IndexError):
                    continue  # a row of another table, or one that is not whole


def _payload(leaf: bytes, at: int, usable: int, page: Callable[[int], bytes]) -> tuple[int, bytes]:
    """The number of a row, and the row, of which a part may lie on further pages."""
    length, at = _varint(leaf, at)
    row, at = _varint(leaf, at)
    if length > MOST_MESSAGE:
        raise ValueError("a row is too large")
    most, least = usable - 35, (usable - 12) * 32 // 255 - 23
    if length <= most:
        return row, leaf[at : at + length]
    here = least + (length - least) % (usable - 4)
    here = here if here <= most else least
    parts, left = [leaf[at : at + here]], length - here
    following = int.from_bytes(leaf[at + here : at + here + 4], "big")
    while left > 0:
        part = page(following)
        parts.append(part[4 : 4 + min(left, usable - 4)])
        left -= usable - 4
        following = int.from_bytes(part[:4], "big")
    return row, b"".join(parts)


def _message(row: bytes) -> tuple[int, int, bytes]:
    start, at = _varint(row, 0)
    kinds = []
    while at < start:
        kind, at = _varint(row, at)
        kinds.append(kind)
    blob = kinds[-1] >= 12 and kinds[-1] % 2 == 0
    if len(kinds) != COLUMNS or not blob or any(kind and kind not in INTEGERS for kind in kinds[:-1]):
        raise ValueError("a row of another table")
    numbers = []
    for kind in kinds[:-1]:
        width = INTEGERS.get(kind, 0)
        numbers.append(kind - 8 if kind >= 8 else int.from_bytes(row[at : at + width], "big", signed=True))
        at += width
    data = row[at : at + (kinds[-1] - 12) // 2]
    if len(data) < (kinds[-1] - 12) // 2:
        raise ValueError("a row is not whole")
    return numbers[1], numbers[2], data


def _varint(data: bytes, at: int) -> tuple[int, int]:
    value = 0
    for _ in range(8):
        byte = data[at]
        value, at = value << 7 | byte & 0x7F, at + 1
        if byte < 0x80:
            return value, at
    return value << 8 | data[at], at + 1
