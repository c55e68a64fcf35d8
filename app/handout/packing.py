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
TYPES = {"int32": "<i4", "uint32": "<u4", "uint8": "u1"}


def packed(content: Any, arrays: Mapping[str, NDArray]) -> str:
    """gzip of: the length of the head (uint32); the head, JSON with the content and the places of the arrays; these."""
    at, places, parts = 0, dict[str, tuple[str, int, int]](), list[bytes]()
    for name, array in arrays.items():
        kind = str(array.dtype)
        data = np.ascontiguousarray(array, TYPES[kind]).tobytes()
        places[name] = (kind, at, array.size)
        parts.append(data + bytes(-len(data) % ALIGNED))
        at += len(parts[-1])
    head = json.dumps({"content": content, "arrays": places}, ensure_ascii=False, allow_nan=False).encode()
    head += b" " * (-len(head) % ALIGNED)
    whole = len(head).to_bytes(ALIGNED, "little") + head + b"".join(parts)
    return base64.b64encode(gzip.compress(whole, 9, mtime=0)).decode()
