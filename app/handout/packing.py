"""Numbers and text as one piece of base64, which static/handout/unpack.js reads."""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

ALIGNED = 4


def packed(content: Any, arrays: Mapping[str, NDArray]) -> str:
    """gzip of: the length of the head (uint32); the head, JSON with the content and the places of the arrays; these.

    Of 32-bit numbers, the differences of neighbours are stored, with their sign in the lowest bit: first the lowest
    byte of all, then the next ones. Most of these bytes are alike.
    """
    at, places, parts = 0, dict[str, tuple[str, int, int]](), list[bytes]()
    for name, array in arrays.items():
        kind = str(array.dtype)
        data = _planes(array.ravel()) if array.dtype.itemsize == ALIGNED else array.tobytes()
        places[name] = (kind, at, array.size)
        parts.append(data + bytes(-len(data) % ALIGNED))
        at += len(parts[-1])
    head = json.dumps({"content": content, "arrays": places}, ensure_ascii=False, allow_nan=False).encode()
    head += b" " * (-len(head) % ALIGNED)
    whole = len(head).to_bytes(ALIGNED, "little") + head + b"".join(parts)
    return base64.b64encode(gzip.compress(whole, 9, mtime=0)).decode()


def _planes(numbers: NDArray) -> bytes:
    steps = np.diff(numbers.view(np.int32), prepend=np.int32(0)).astype(np.int32)
    return ((steps << 1) ^ (steps >> 31)).astype("<i4").view(np.uint8).reshape(-1, ALIGNED).T.tobytes()
