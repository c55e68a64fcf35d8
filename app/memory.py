"""Gives memory back to the system."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import sys

# The number of this option in glibc's malloc.h.
M_ARENA_MAX = -8
ARENAS = 2
# New objects between two searches for garbage.
GARBAGE = 10_000


def keep_together() -> None:
    """Keep memory of all threads in two areas, not eight for each core, where little of it could be given back.

    To be called before there are threads.
    """
    _of_libc("mallopt", M_ARENA_MAX, ARENAS)


def settle() -> None:
    """Searches for garbage leave out what exists now, and are rarer: they took a seventh of the time of a picture.

    To be called once all is loaded.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(GARBAGE)


def give_back() -> None:
    """Free what only refers to itself, and what the allocator keeps of it. Nothing else runs for about 0.1 s."""
    gc.collect()
    _of_libc("malloc_trim", 0)


def _of_libc(name: str, *arguments: int) -> None:
    if sys.platform == "linux":
        # musl has no such function.
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None)[name](*arguments)
