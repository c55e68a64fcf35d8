"""Programs that have imported lineseg and done nothing else: each a process of its own, started in milliseconds."""

from __future__ import annotations

import importlib
import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numba

_FORKED = multiprocessing.get_context("forkserver")
_FORKED.set_forkserver_preload(["lineseg"])
# numba sets this at import.
_config: Any = numba.config


def programs(together: int = 1) -> ProcessPoolExecutor:
    """Runs each call in a program of its own, this many at the same time."""
    return ProcessPoolExecutor(together, mp_context=_FORKED, max_tasks_per_child=1)


def called_in(folder: Path, kept: Path) -> str:
    """What the module `entry` of this folder says when it is imported where compiled kernels are kept elsewhere."""
    _config.CACHE_DIR = str(kept)
    sys.path.insert(0, str(folder))
    sys.dont_write_bytecode = True
    return importlib.import_module("entry").said
