"""A publisher of another vendor, as the packets of RTPS that it sends; its type is described as nobody else does.

Packets: https://www.omg.org/spec/DDSI-RTPS; type information: https://www.omg.org/spec/DDS-XTypes, 7.6.3.
"""

import os
import socket
import struct
from collections.abc import Iterator

VENDOR = b"\x01\x14"
GROUP = "239.255.0.1"
PARTICIPANT, WRITER = b"\0\0\1\xc1", b"\0\0\1\x03"
ANNOUNCES_ITSELF, ANNOUNCES_WRITERS = b"\0\1\0\xc2", b"\0\0\3\xc2"


class Publisher:
    """Of scans in `domain`; `tag` keeps it apart from every other program."""

    def __init__(self, domain: int, tag: str, topic: str) -> None:
        self._ports = 7400 + 250 * domain, 7401 + 250 * domain
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        self._prefix = VENDOR + os.urandom(10)
        here = struct.pack("<II", 1, self._socket.getsockname()[1]) + bytes(12) + socket.inet_aton("127.0.0.1")
        its_guid = (0x50, self._prefix + PARTICIPANT)
        self._itself = parameters(
            its_guid, (0x15, b"\2\4\0\0"), (0x16, VENDOR + bytes(2)), (0x02, struct.pack("<iI", 100, 0)), (0x31, here),
            (0x32, here), (0x58, struct.pack("<I", 0x3F)), (0x0F, struct.pack("<I", domain)), (0x4014, text(tag)),
        )  # fmt: skip
        self._writer = parameters(
            its_guid, (0x5A, self._prefix + WRITER), (0x05, text(f"rt{topic}")),
            (0x07, text("sensor_msgs::msg::dds_::LaserScan_")), (0x1A, struct.pack("<IiI", 1, 0, 0)),
            (0x1D, bytes(4)), (0x75, unknown_type()),
        )  # fmt: skip
        self._count = 0

    def send(self, scan: bytes) -> None:
        """Announce all of it once more, and send a scan in CDR."""
        self._count += 1
        self._to(0, data(ANNOUNCES_ITSELF, self._count, self._itself))
        beat = ANNOUNCES_WRITERS + struct.pack("<iIiII", 0, 1, 0, 1, self._count)
        self._to(0, submessage(0x07, 0x03, bytes(4) + beat))
        self._to(0, data(ANNOUNCES_WRITERS, 1, self._writer))
        self._to(1, data(WRITER, self._count, scan))

    def close(self) -> None:
        self._socket.close()

    def _to(self, port: int, packet: bytes) -> None:
        self._socket.sendto(b"RTPS\2\4" + VENDOR + self._prefix + packet, (GROUP, self._ports[port]))


def submessage(kind: int, flags: int, body: bytes) -> bytes:
    return struct.pack("<BBH", kind, flags, len(body)) + body


def data(writer: bytes, number: int, payload: bytes) -> bytes:
    return submessage(
        0x15, 0x05, struct.pack("<HH", 0, 16) + bytes(4) + writer + struct.pack("<iI", 0, number) + payload
    )


def parameters(*each: tuple[int, bytes]) -> bytes:
    listed: Iterator[bytes] = (struct.pack("<HH", id, len(value)) + value for id, value in each)
    return b"\0\3\0\0" + b"".join(listed) + struct.pack("<HH", 1, 0)


def text(value: str) -> bytes:
    padded = value.encode() + b"\0"
    return struct.pack("<I", len(padded)) + padded + bytes(-len(padded) % 4)


def sized(body: bytes) -> bytes:
    return struct.pack("<I", len(body)) + body


def unknown_type() -> bytes:
    """TypeInformation: the hashes of a minimal and of a complete definition, which this publisher never sends."""
    members = b""
    for id, kind in ((0x1001, b"\xf1"), (0x1002, b"\xf2")):
        hashed = sized(kind + os.urandom(14) + bytes(1) + struct.pack("<I", 100))
        member = sized(hashed + struct.pack("<i", 0) + sized(struct.pack("<I", 0)))
        members += struct.pack("<I", 4 << 28 | id) + sized(member)
    return sized(members)
