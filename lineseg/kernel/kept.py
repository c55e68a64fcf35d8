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
        self._compiling: dict[Path, TextIO] = {}

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
        """The kernel for arguments of these types, or None: then numba compiles it, and others wait for it."""
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
        """Keep a kernel; where the folder cannot be written, every program compiles for itself."""
        path = self._path(signature, compiled.codegen)
        unfinished = path.with_suffix(f".{uuid.uuid4().hex}")
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            unfinished.write_bytes(dumps(compiled._reduce()))
            unfinished.replace(path)
            forget_the_unused(path.parent)
        self._let_others(path)

    def _let_others(self, path: Path) -> None:
        if lock := self._compiling.pop(path, None):
            Path(lock.name).unlink(missing_ok=True)
            lock.close()


def _read(path: Path) -> Any:
    """What a file holds; None if there is none, or if it was cut short."""
    try:
        return pickle.loads(path.read_bytes())
    except (OSError, EOFError, pickle.UnpicklingError):
        return None


def _locked(path: Path) -> TextIO:
    """A file that one process at a time holds, at the latest until it ends; or one that another holds for too long."""
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
    """Delete what no program has loaded for a long time. One that needs it after all compiles it again."""
    oldest = time.time() - _DAYS_UNUSED * 86400
    for file in folder.iterdir():
        # Another process may have been faster.
        with contextlib.suppress(OSError):
            if file.stat().st_mtime < oldest:
                file.unlink()
