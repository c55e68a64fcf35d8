"""Keeps compiled kernels on disk and finds them by what they were compiled from.

numba's own cache checks only the file that holds a kernel. So it misses changes in other files that the kernel calls,
and recompiles after any unrelated change in its own file.
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
from typing import Any, TextIO

import numba
from numba.core import config
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from .fingerprint import fingerprint

try:
    import fcntl
except ImportError:  # on Windows two programs may compile the same kernel at the same time
    fcntl = None

_DAYS_UNUSED = 60
_PATIENCE = 120.0  # [s]
# numba sets this at import.
_config: Any = config


def folder() -> Path:
    """The folder of compiled kernels: in $NUMBA_CACHE_DIR if set, otherwise in the user's cache folder."""
    if _config.CACHE_DIR:
        return Path(_config.CACHE_DIR) / "lineseg"
    import platformdirs

    return Path(platformdirs.user_cache_dir("lineseg", appauthor=False)) / "kernels"


class KeptKernel:
    """The cache that numba loads compiled kernels from and saves them to.

    Each file holds one kernel for one choice of argument types, and its name says what it was compiled from. So a file
    is never out of date or overwritten with other code, and any number of programs and versions share the folder.
    """

    def __init__(self, kernel: Any) -> None:
        self._kernel = kernel
        self._compiling: dict[Path, TextIO] = {}

    @property
    def cache_path(self) -> str:
        return str(folder())

    @cached_property
    def _fingerprint(self) -> str:
        # Computed at the first call: the kernels that this one calls may be declared after it.
        return fingerprint(self._kernel)

    def _path(self, signature: Any, codegen: Any) -> Path:
        told = self._fingerprint, numba.__version__, codegen.magic_tuple(), _config.BOUNDSCHECK, _config.OPT
        key = hashlib.sha256(f"{told} {signature}".encode()).hexdigest()[:32]
        return folder() / f"{self._kernel.py_func.__name__}.{sys.implementation.cache_tag}.{key}.pickle"

    def load_overload(self, signature: Any, target_context: Any) -> CompileResult | None:
        """The kernel for these argument types. None: numba compiles it while other processes wait."""
        target_context.refresh()
        path = self._path(signature, target_context.codegen())
        data = _read(path)
        if data is None and path not in self._compiling:
            with contextlib.suppress(OSError):
                self._compiling[path] = _locked(path.with_suffix(".lock"))
            data = _read(path)
        if data is None:
            return None
        self._let_others(path)
        with contextlib.suppress(OSError):
            os.utime(path)
        return CompileResult._rebuild(target_context, *data)

    def save_overload(self, signature: Any, compiled: CompileResult) -> None:
        """Save a kernel. If the folder is not writable, every program compiles for itself."""
        path = self._path(signature, compiled.codegen)
        unfinished = path.with_suffix(f".{uuid.uuid4().hex}")
        with contextlib.suppress(OSError):
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                unfinished.write_bytes(dumps(compiled._reduce()))
                unfinished.replace(path)
            finally:
                unfinished.unlink(missing_ok=True)
            forget_the_unused(path.parent)
        self._let_others(path)

    def _let_others(self, path: Path) -> None:
        if lock := self._compiling.pop(path, None):
            Path(lock.name).unlink(missing_ok=True)
            lock.close()


def _read(path: Path) -> Any:
    """The content of a file; None if it is missing or truncated."""
    try:
        return pickle.loads(path.read_bytes())
    except (OSError, EOFError, pickle.UnpicklingError):
        return None


def _locked(path: Path) -> TextIO:
    """Lock a file, at most until this process ends. Continues without it if another process holds it too long."""
    path.parent.mkdir(parents=True, exist_ok=True)
    file = path.open("w")
    late = time.monotonic() + _PATIENCE
    while fcntl and time.monotonic() < late:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            break
        except BlockingIOError:
            time.sleep(0.05)
    return file


def forget_the_unused(folder: Path) -> None:
    """Delete kernels that no program has loaded for a long time. A program that needs one compiles it again."""
    oldest = time.time() - _DAYS_UNUSED * 86400
    for file in folder.iterdir():
        # Another process may have deleted it first.
        with contextlib.suppress(OSError):
            if file.stat().st_mtime < oldest:
                file.unlink()
