"""Compiled kernels are kept on disk, and found again by what they were compiled from.

numba's own cache looks at the one file that holds a kernel: it misses changes of what the kernel calls from elsewhere,
and compiles anew after any other change of the file.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import pickle
import sys
import time
import uuid
from functools import cached_property
from pathlib import Path
from typing import Any

import numba
from numba.core import config
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from .fingerprint import fingerprint

_DAYS_UNUSED = 60
# numba fills it in when it is imported.
_config: Any = config


def folder() -> Path:
    """Where compiled kernels are: under $NUMBA_CACHE_DIR if that is set, else among the user's caches."""
    if _config.CACHE_DIR:
        return Path(_config.CACHE_DIR) / "lineseg"
    import platformdirs

    return Path(platformdirs.user_cache_dir("lineseg", appauthor=False)) / "kernels"


class KeptKernel:
    """What numba asks for a kernel compiled before, and hands one to that it has compiled.

    A file holds one kernel for one choice of argument types, and its name says what it was compiled from. So it is
    never out of date and never rewritten with something else, and any number of programs and versions share the folder.
    """

    def __init__(self, kernel: Any) -> None:
        self._kernel = kernel

    @property
    def cache_path(self) -> str:
        return str(folder())

    @cached_property
    def _fingerprint(self) -> str:
        # Asked for at the first call: when a kernel is declared, those that it calls may not be.
        return fingerprint(self._kernel)

    def _path(self, signature: Any, codegen: Any) -> Path:
        told = self._fingerprint, numba.__version__, codegen.magic_tuple(), _config.BOUNDSCHECK, _config.OPT
        key = hashlib.sha256(f"{told} {signature}".encode()).hexdigest()[:32]
        return folder() / f"{self._kernel.py_func.__name__}.{sys.implementation.cache_tag}.{key}.pickle"

    def load_overload(self, signature: Any, target_context: Any) -> CompileResult | None:
        """The kernel for arguments of these types, or None."""
        target_context.refresh()
        path = self._path(signature, target_context.codegen())
        try:
            data = pickle.loads(path.read_bytes())
        except (OSError, EOFError, pickle.UnpicklingError):
            return None
        with contextlib.suppress(OSError):
            os.utime(path)
        return CompileResult._rebuild(target_context, *data)

    def save_overload(self, signature: Any, compiled: CompileResult) -> None:
        """Keep a kernel; where the folder cannot be written, every program compiles for itself."""
        path = self._path(signature, compiled.codegen)
        unfinished = path.with_suffix(f".{uuid.uuid4().hex}")
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            unfinished.write_bytes(dumps(compiled._reduce()))
            unfinished.replace(path)
            forget_the_unused(path.parent)


def forget_the_unused(folder: Path) -> None:
    """Delete what no program has loaded for a long time. One that needs it after all compiles it again."""
    oldest = time.time() - _DAYS_UNUSED * 86400
    for file in folder.iterdir():
        # Another process may have been faster.
        with contextlib.suppress(OSError):
            if file.stat().st_mtime < oldest:
                file.unlink()
