"""The trace of a frame as columns, sent once, for stepping through its decisions on the page."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..told.drawn import TraceColumns
from .findings import Findings

# More decisions would keep the page busy for seconds, and nobody steps through them.
MOST_DECISIONS = 50_000
LINE_DIGITS = 8
METRE_DIGITS = 6


def columns_of(found: Findings) -> TraceColumns:
    """The first MOST_DECISIONS decisions, and the points they refer to."""
    trace, scan = found.trace, found.scan
    vocabulary = trace.vocabulary
    rows = trace.log[:MOST_DECISIONS]
    line = rows["line"]
    placed = [number for number, kind in enumerate(vocabulary.kinds) if kind.effect == "placed"]
    return {
        "kinds": vocabulary.names,
        "checks": vocabulary.check_names,
        "phases": vocabulary.phases,
        "jumps": {name: _among(rows, trace.jump(name)) for name in vocabulary.jumps},
        "starts": {"phase": _among(rows, trace.starts("phase")), "line": _among(rows, trace.starts("line"))},
        "total": len(trace),
        "circle": scan.full_circle,
        "kind": rows["kind"].tolist(),
        "check": rows["check"].tolist(),
        "phase": trace.phases[:MOST_DECISIONS].tolist(),
        "direction": rows["direction"].tolist(),
        "candidate": rows["candidate"].tolist(),
        "first": trace.as_beams(rows["first"]).tolist(),
        "last": trace.as_beams(rows["last"]).tolist(),
        "beam": trace.as_beams(rows["beam"]).tolist(),
        "points": np.maximum(rows["last"] - rows["first"] + 1, 0).tolist(),
        "a": _rounded(line["a"], LINE_DIGITS),
        "b": _rounded(line["b"], LINE_DIGITS),
        "c": _rounded(line["c"], LINE_DIGITS),
        "others": _where(rows["partner"] >= 0, rows["other"], LINE_DIGITS),
        "ends": _where(np.isin(rows["kind"], placed), rows["ends"], METRE_DIGITS),
        "value": _rounded(rows["value"], METRE_DIGITS),
        "limit": _rounded(rows["limit"], METRE_DIGITS),
        "text": trace.texts(np.arange(len(rows))),
        "x": _rounded(np.where(scan.valid, scan.xy[:, 0], np.nan), METRE_DIGITS),
        "y": _rounded(np.where(scan.valid, scan.xy[:, 1], np.nan), METRE_DIGITS),
    }


def _among(rows: NDArray[np.void], indices: NDArray[np.integer]) -> list[int]:
    return indices[indices < len(rows)].tolist()


def _where(there: NDArray[np.bool_], rows: NDArray[np.void], digits: int) -> dict[int, Any]:
    """The rows with finite numbers only, by index."""
    found = {index: rows[index].item() for index in np.flatnonzero(there).tolist()}
    return {index: tuple(round(v, digits) for v in row) for index, row in found.items() if np.isfinite(row).all()}


def _rounded(values: NDArray, digits: int) -> list[float | None]:
    """JSON has no NaN and no infinity."""
    rounded = np.round(np.asarray(values, float), digits)
    return [value if finite else None for value, finite in zip(rounded.tolist(), np.isfinite(rounded), strict=True)]
