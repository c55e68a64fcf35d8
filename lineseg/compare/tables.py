"""A comparison as Markdown, CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from ..truth import Agreement
from ..writers.finite import finite_or_none
from .comparison import OBJECTIVE, Row, score_of

NOTE = (
    "Judged on stretches of frames that no method was tuned on; true lines have the default P_min and L_min. "
    "Ranked by the harmonic mean of TR and 1 − FR, times completeness. Times are for one core of one machine, "
    "with all methods alternating on every frame; × is the ratio to region growing with its defaults."
)


def numbers(row: Row) -> dict[str, Any]:
    """All numbers of a row, None if undefined."""
    return {
        "recording": row.recording,
        "method": row.method,
        "tuned": row.tuned,
        "evaluations": row.evaluations,
        **_of_agreement(row.agreement),
        **_of_times(row),
        "params": row.params.numbers(),
    }


def ranked(rows: Sequence[Row]) -> list[Row]:
    """Best first; if no truth is known, fastest first."""
    return sorted(rows, key=lambda row: (-_or(row.score, -1.0), _or(row.ratio, math.inf)))


def to_json(rows: Sequence[Row]) -> str:
    rows = [row for group in groups(rows) for row in group]
    return json.dumps({"objective": OBJECTIVE.text, "rows": [numbers(row) for row in rows]}, indent=2) + "\n"


def to_csv(rows: Sequence[Row]) -> str:
    """A row for each method, recording and half; thresholds as JSON in the last column."""
    table = [numbers(row) for group in groups(rows) for row in group]
    text = io.StringIO()
    writer = csv.DictWriter(text, table[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows({**row, "params": json.dumps(row["params"])} for row in table)
    return text.getvalue()


def to_markdown(rows: Sequence[Row]) -> str:
    """Two tables for each recording, like Tables 4 and 3 of the paper; then all recordings together."""
    parts = [NOTE]
    for group in groups(rows):
        parts += [f"## {group[0].recording}, {_kind(group[0])}", *_tables(group)]
    together = [total(rows, tuned) for tuned in (True, False)]
    parts += [part for each in together if each for part in each]
    return "\n\n".join(parts) + "\n"


def groups(rows: Sequence[Row]) -> list[list[Row]]:
    """The rows of each recording, ranked, the tuned ones first."""
    keys = dict.fromkeys((row.recording, tuned) for row in rows for tuned in (True, False))
    found = ([row for row in rows if (row.recording, row.tuned) == key] for key in keys)
    return [ranked(group) for group in found if group]


def total(rows: Sequence[Row], tuned: bool) -> list[str]:
    """All recordings with truth together, if there are two or more and every method has results for all."""
    rows = [row for row in rows if row.tuned == tuned and row.agreement is not None]
    by_method: dict[str, list[Row]] = {}
    for row in rows:
        by_method.setdefault(row.label, []).append(row)
    count = len({row.recording for row in rows})
    if count < 2 or any(len(each) != count for each in by_method.values()):
        return []
    sums = {
        label: Agreement.of_all(row.agreement for row in each if row.agreement) for label, each in by_method.items()
    }
    order = sorted(sums, key=lambda label: -_or(score_of(sums[label]), -1.0))
    lines = [_quality(place, label, sums[label]) for place, label in enumerate(order, 1)]
    return [f"## All {count} recordings, {_kind(rows[0])}", _table(QUALITY, lines)]


QUALITY = (
    "", "method", "score", "TR", "FR", "completeness", "splits", "merges", "endpoint error: median", "95 % [mm]",
)  # fmt: skip
TIME = ("method", "mean [µs]", "std", "min", "max", "×")


def _tables(group: list[Row]) -> Iterator[str]:
    judged = [row for row in group if row.agreement is not None]
    if judged:
        lines = [_quality(place, row.label, row.agreement) for place, row in enumerate(judged, 1) if row.agreement]
        yield _table(QUALITY, lines)
    else:
        yield "No truth is known: times only."
    timed = sorted((row for row in group if row.times is not None), key=lambda row: row.ratio)
    if timed:
        yield _table(TIME, [_time(row) for row in timed])


def _kind(row: Row) -> str:
    return f"tuned with {row.evaluations} evaluations" if row.tuned else "defaults"


def _quality(place: int, label: str, found: Agreement) -> list[str]:
    rates = [_percent(value) for value in (found.true_rate, found.false_rate)]
    ends = [f"{1000 * found.endpoint_error(share):.1f}" for share in (50, 95)]
    score, complete = f"{score_of(found):.3f}", f"{found.completeness:.3f}"
    return [str(place), label, score, *rates, complete, str(found.splits), str(found.merges), *ends]


def _time(row: Row) -> list[str]:
    times = _of_times(row)
    values = [f"{times[name]:.1f}" for name in ("mean_us", "std_us", "min_us", "max_us")]
    return [row.label, *values, f"{row.ratio:.1f}"]


def _table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    rule = ["---" if k < 2 and "method" in head[k : k + 1] else "--:" for k in range(len(head))]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (head, rule, *lines))


def _of_agreement(found: Agreement | None) -> dict[str, float | None]:
    counts = ("true_lines", "segments", "matches", "splits", "merges")
    found_or_none = found or Agreement()
    values = {name: float(getattr(found_or_none, name)) for name in counts}
    rates = {name: getattr(found_or_none, name) for name in ("true_rate", "false_rate", "completeness")}
    ends = {
        f"endpoint_error_{name}": found_or_none.endpoint_error(share) for name, share in (("median", 50), ("p95", 95))
    }
    row: dict[str, float | None] = {"score": finite_or_none(score_of(found_or_none))}
    row |= {name: finite_or_none(value) for name, value in (rates | ends).items()}
    return row | {name: int(value) if found else None for name, value in values.items()}


def _of_times(row: Row) -> dict[str, float | None]:
    if row.times is None:
        return dict.fromkeys(("mean_us", "std_us", "min_us", "max_us", "ratio"))
    times = row.times
    values = {"mean_us": times.mean(), "std_us": times.std(), "min_us": times.min(), "max_us": times.max()}
    return {**{name: round(float(value), 2) for name, value in values.items()}, "ratio": round(row.ratio, 3)}


def _percent(value: float) -> str:
    return f"{value:.1%}"


def _or(value: float, without: float) -> float:
    return without if math.isnan(value) else value


TABLE_WRITERS: dict[str, Callable[[Sequence[Row]], str]] = {".md": to_markdown, ".csv": to_csv, ".json": to_json}
