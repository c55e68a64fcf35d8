"""The finished work of a sweep, on disk, so that an interrupted sweep can resume."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from dataclasses import astuple
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..params import Params
from .chunks import Chunk, Task
from .totals import COLUMNS

# Guards against sums with another meaning.
MEANING = " ".join(COLUMNS)


class Journal:
    """The sums of each chunk for each setting; another grid over the same chunks reuses those it shares.

    Raises ValueError for a file that is not a journal, or has other sums.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._rows = sqlite3.connect(path)
            self._rows.execute("CREATE TABLE IF NOT EXISTS meaning (columns TEXT PRIMARY KEY)")
            self._rows.execute(
                "CREATE TABLE IF NOT EXISTS done (chunk TEXT, settings TEXT, sums BLOB, PRIMARY KEY (chunk, settings)) "
                "WITHOUT ROWID"
            )
            found = [columns for (columns,) in self._rows.execute("SELECT columns FROM meaning")]
        except sqlite3.OperationalError as error:
            raise _unwritten(path, error) from None
        except sqlite3.DatabaseError as error:
            raise _damaged(path, error) from None
        if found and found != [MEANING]:
            raise ValueError(f"{path}: this journal is from another version of lineseg; remove it to start again")
        self._write("INSERT OR IGNORE INTO meaning VALUES (?)", [(MEANING,)])

    def known(self, task: Task) -> dict[Params, NDArray[np.float64]]:
        """The sums of a task's settings that exist already. Raises ValueError if the file is damaged."""
        wanted = (_chunk_key(task.chunk, task.scored), *_ends([_key(params) for params in task.settings]))
        try:
            found = self._rows.execute(
                "SELECT settings, sums FROM done WHERE chunk = ? AND settings BETWEEN ? AND ?", wanted
            )
            known = {key: np.frombuffer(sums) for key, sums in found}
        except (sqlite3.DatabaseError, ValueError, TypeError) as error:
            raise _damaged(self._path, error) from None
        return {params: known[key] for params in task.settings if (key := _key(params)) in known}

    def add(self, task: Task, sums: NDArray[np.float64]) -> None:
        chunk = _chunk_key(task.chunk, task.scored)
        rows = [(chunk, _key(params), row.tobytes()) for params, row in zip(task.settings, sums, strict=True)]
        self._write("INSERT OR REPLACE INTO done VALUES (?, ?, ?)", rows)

    def _write(self, statement: str, rows: list[tuple]) -> None:
        """Raises OSError, such as for a full disk, and what was written before stays; ValueError if it is damaged."""
        try:
            with self._rows:
                self._rows.executemany(statement, rows)
        except sqlite3.OperationalError as error:
            raise _unwritten(self._path, error) from None
        except sqlite3.DatabaseError as error:
            raise _damaged(self._path, error) from None

    def close(self, remove: bool = False) -> None:
        """remove: whether to delete the file, because the sweep is complete. An empty journal is always deleted."""
        try:
            empty = self._rows.execute("SELECT 1 FROM done LIMIT 1").fetchone() is None
        except sqlite3.DatabaseError:
            # A file that is damaged is left to whoever is told so.
            empty = False
        self._rows.close()
        if remove or empty:
            self._path.unlink(missing_ok=True)


def _damaged(path: Path, error: Exception) -> ValueError:
    return ValueError(f"{path}: this is not the journal of a sweep ({error}); remove it to start again")


def _unwritten(path: Path, error: Exception) -> OSError:
    """SQLite says which: a full disk, a missing folder, another process."""
    return OSError(
        f"{path}: the journal of the sweep cannot be written: {error}. What it holds is kept; once there is space, the "
        "same command resumes"
    )


def _chunk_key(chunk: Chunk, scored: bool) -> str:
    return repr((astuple(chunk), scored))


def _key(params: Params) -> str:
    return repr(astuple(params))


def _ends(keys: Sequence[str]) -> tuple[str, str]:
    return min(keys), max(keys)
