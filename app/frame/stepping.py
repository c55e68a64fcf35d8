"""A frame's trace as the page steps through it: columns, sent once, from which the page tells every decision."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .findings import Findings

# Beyond this a page would be busy for seconds with what nobody steps through.
MOST_DECISIONS = 50_000
LINE_DIGITS = 8
METRE_DIGITS = 6


def columns_of(found: Findings) -> dict[str, Any]:
    """The first MOST_DECISIONS decisions as columns, one entry each, and the points they speak of.

    kinds, checks, phases: names of the numbers in the columns kind, check, phase. first, last, beam: beams, −1 none.
    text: the sentence of each. points: how many points lie from first to last.
    jumps, starts: indices to which each jump of the method leads, and at which each phase and each line begins.
    a, b, c: of the line; others, ends: of the few decisions that have them, by index: (a, b, c) of the partner's line,
    (x1, y1, x2, y2) of the endpoints.
    x, y: of every beam [m], null where it has no return.
    """
    trace, scan = found.trace, found.scan
    vocabulary = trace.vocabulary
    rows = trace.log[:MOST_DECISIONS]
    beams = {name: trace.as_beams(rows[name]).tolist() for name in ("first", "last", "beam")}
    numbers = {name: rows[name].tolist() for name in ("kind", "check", "direction", "candidate")}
    lines = {name: _rounded(rows["line"][name], LINE_DIGITS) for name in ("a", "b", "c")}
    placed = [number for number, kind in enumerate(vocabulary.kinds) if kind.effect == "placed"]
    return {
        "kinds": vocabulary.names,
        "checks": vocabulary.check_names,
        "phases": vocabulary.phases,
        "jumps": {name: _among(rows, trace.jump(name)) for name in vocabulary.jumps},
        "starts": {level: _among(rows, trace.starts(level)) for level in ("phase", "line")},
        "total": len(trace),
        "circle": scan.full_circle,
        **numbers,
        **beams,
        "phase": trace.phases[:MOST_DECISIONS].tolist(),
        "points": np.maximum(rows["last"] - rows["first"] + 1, 0).tolist(),
        **lines,
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


def _where(there: NDArray[np.bool_], rows: NDArray[np.void], digits: int) -> dict[int, list[float]]:
    """The rows that are there, by index; one with a number that is not finite is not."""
    found = {index: rows[index].item() for index in np.flatnonzero(there).tolist()}
    return {index: [round(v, digits) for v in row] for index, row in found.items() if np.isfinite(row).all()}


def _rounded(values: NDArray, digits: int) -> list[float | None]:
    """JSON has no NaN and no infinity."""
    rounded = np.round(np.asarray(values, float), digits)
    return [value if finite else None for value, finite in zip(rounded.tolist(), np.isfinite(rounded), strict=True)]
