"""The checksums of an MCAP file, which `rosbags` leaves 0. https://mcap.dev/spec"""

from __future__ import annotations

import struct
from pathlib import Path
from zlib import crc32

from ..readers.bags.mcap_records import CHUNK, DATA_END, FOOTER, HEAD, MAGIC


def add_checksums(path: Path) -> None:
    """Write the checksums of a whole file with uncompressed chunks, in place: of its chunks, data and summary."""
    content = bytearray(path.read_bytes())
    at = len(MAGIC)
    while at < len(content) - len(MAGIC):
        opcode, length = HEAD.unpack_from(content, at)
        body = at + HEAD.size
        if opcode == CHUNK:
            # Times and size take 24 bytes; the checksum, an empty name of a compression and a length 16 more.
            struct.pack_into("<I", content, body + 24, crc32(content[body + 40 : body + length]))
        elif opcode == DATA_END:
            struct.pack_into("<I", content, body, crc32(content[:at]))
        elif opcode == FOOTER:
            (summary,) = struct.unpack_from("<Q", content, body)
            struct.pack_into("<I", content, body + 16, crc32(content[summary : body + 16]))
        at = body + length
    path.write_bytes(content)
