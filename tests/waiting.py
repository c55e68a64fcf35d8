"""How long tests wait, and what they say if they waited in vain."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T")
# No test depends on how fast a machine is: this ends one that would never end. The first on a machine waits for the
# kernels to be compiled.
SECONDS = 480


def eventually(look: Callable[[], T], what: str, seen: Callable[[], Any] | None = None, every: float = 0.02) -> T:
    """The first value of `look` that is true. what: is waited for; seen: tells in the end what was there instead."""
    late = time.monotonic() + SECONDS
    while not (found := look()):
        if time.monotonic() > late:
            raise AssertionError(f"waited {SECONDS} s in vain for {what}; last seen: {seen() if seen else found!r}")
        time.sleep(every)
    return found
