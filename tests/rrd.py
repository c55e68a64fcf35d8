"""Recordings of rerun, read back with its own SDK."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

from rerun.chunk import RrdReader


def rows_of(file: Path, entity: str) -> list[dict[str, Any]]:
    """The rows of an entity in order: timelines by name, components by the last part of their name."""
    rows = []
    with warnings.catch_warnings():
        # One that is still being written ends without a table of contents.
        warnings.filterwarnings("ignore", "RRD file has no footer")
        reader = RrdReader(file)
    for chunk in reader.stream():
        if chunk.entity_path == entity:
            batch = chunk.to_record_batch()
            # Python's own times have no nanoseconds.
            batch = batch.drop_columns([name for name in ("log_time", "shown") if name in batch.schema.names])
            names = [name.split(":")[-1] for name in batch.schema.names]
            rows += [dict(zip(names, row.values(), strict=True)) for row in batch.to_pylist()]
    return rows
