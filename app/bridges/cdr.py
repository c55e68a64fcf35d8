"""Writes CDR, the serialisation of ROS 2 messages."""

from __future__ import annotations

import struct

import numpy as np

LITTLE_ENDIAN = b"\x00\x01\x00\x00"


class CdrWriter:
    """Little-endian CDR. A number lies at a multiple of its size, counted from the end of the four bytes before."""

    def __init__(self) -> None:
        self._data = bytearray()

    def numbers(self, form: str, *values: float) -> None:
        """Numbers of one kind, such as "7f"."""
        self._align(struct.calcsize(form[-1]))
        self._data += struct.pack(f"<{form}", *values)

    def text(self, value: str) -> None:
        data = value.encode() + b"\0"
        self.numbers("I", len(data))
        self._data += data

    def same(self, data: bytes) -> None:
        """What another writer wrote from its beginning on, with no number of more than four bytes."""
        self._align(4)
        self._data += data

    def sequence(self, values: np.ndarray) -> None:
        """A sequence (n,) of numbers, or (n, k) of structures of k numbers."""
        self.numbers("I", len(values))
        if len(values):
            self._align(values.dtype.itemsize)
        self._data += values.astype(values.dtype.newbyteorder("<"), copy=False).tobytes()

    def bytes(self) -> bytes:
        return LITTLE_ENDIAN + self._data

    def body(self) -> bytes:
        """Without the four bytes before."""
        return bytes(self._data)

    def _align(self, size: int) -> None:
        self._data += bytes(-len(self._data) % size)
