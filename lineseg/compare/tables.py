"""A comparison as Markdown, CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from ..truth import Agreement
from ..writers.finite import finite_or_none
from ..writers.segments import cell
from .comparison import OBJECTIVE, Row, Setting, score_of

SETTINGS: dict[Setting, str] = {"installed": "as installed", "proposed": "as proposed", "tuned": "tuned"}
NOTE = (
    "As installed: the defaults. As proposed: the best of the tried settings by the lines that fit the noise of the "
    "laser, without truth. Tuned: the best of as many settings by the truth. All are judged by the truth, on stretches "
    "of frames that no method was tuned on; true lines have the default P_min and L_min. Ranked by the harmonic mean "
    "of TR and 1 − FR, times completeness. Neutral: segments on walls that miss P_min or L_min by at most 30 % count "
    "neither as right nor as false. Times are for one core of one machine, with all methods alternating on every "
    "frame; × is the ratio to region growing with its defaults."
)


def numbers(row: Row) -> dict[str, Any]:
    """All numbers of a row, None if undefined."""
    return {
        "recording": row.recording,
        "method": row.method,
        "laser": row.about,
        "setting": row.setting,
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
    """A row for each method, recording and setting; thresholds as JSON in the last column."""
    table = [numbers(row) for group in groups(rows) for row in group]
    text = io.StringIO()
    writer = csv.DictWriter(text, table[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(
        {**row, "recording": cell(row["recording"]), "laser": cell(row["laser"]), "params": json.dumps(row["params"])}
        for row in table
    )
    return text.getvalue()


def to_markdown(rows: Sequence[Row]) -> str:
    """Scores of each recording in all settings; two tables for each setting, like Tables 4 and 3 of the paper; then all
    recordings together.
    """
    parts = [NOTE]
    for name in dict.fromkeys(row.recording for row in rows):
        own = [row for row in rows if row.recording == name]
        about = f" ({own[0].about})" if own[0].about else ""
        parts += [f"## {name}{about}", *_scores(own)]
        for group in groups(own):
            parts += [f"### {name}, {_kind(group[0])}", *_tables(group)]
    return "\n\n".join(parts + _together(rows)) + "\n"


def groups(rows: Sequence[Row]) -> list[list[Row]]:
    """The rows of each recording and setting, ranked."""
    keys = dict.fromkeys((row.recording, setting) for row in rows for setting in SETTINGS)
    found = ([row for row in rows if (row.recording, row.setting) == key] for key in keys)
    return [ranked(group) for group in found if group]


def _together(rows: Sequence[Row]) -> list[str]:
    """All recordings with truth together, if there are two or more."""
    sums = [each for setting in SETTINGS for each in total(rows, setting)]
    if not sums:
        return []
    count = len({row.recording for row in rows if row.agreement is not None})
    parts = [f"## All {count} recordings", *_scores(sums)]
    for group in groups(sums):
        parts += [f"### All {count} recordings, {_kind(group[0])}", *_tables(group)]
    return parts


def total(rows: Sequence[Row], setting: Setting) -> list[Row]:
    """A row for each method with all recordings that have truth together; none if a method lacks one of them."""
    rows = [row for row in rows if row.setting == setting and row.agreement is not None]
    by_method: dict[str, list[Row]] = {}
    for row in rows:
        by_method.setdefault(row.method, []).append(row)
    count = len({row.recording for row in rows})
    if count < 2 or any(len(each) != count for each in by_method.values()):
        return []
    sums = [Agreement.of_all(row.agreement for row in each if row.agreement) for each in by_method.values()]
    return [
        replace(each[0], recording=f"All {count} recordings", about="", agreement=found, times=None)
        for each, found in zip(by_method.values(), sums, strict=True)
    ]


def _scores(rows: Sequence[Row]) -> Iterator[str]:
    """The score of each method in each setting, the best as proposed first; nothing if there is only one setting."""
    settings: list[Setting] = [
        setting for setting in SETTINGS if any(row.setting == setting and row.agreement for row in rows)
    ]
    if len(settings) < 2:
        return
    by_method: dict[str, dict[Setting, Row]] = {}
    for row in rows:
        by_method.setdefault(row.label, {})[row.setting] = row
    order = sorted(by_method.items(), key=lambda entry: -_score(entry[1], settings[1]))
    lines = [
        [str(place), label, *(f"{found[each].score:.3f}" if each in found else "" for each in settings)]
        for place, (label, found) in enumerate(order, 1)
    ]
    yield _table(("", "method", *(SETTINGS[each] for each in settings)), lines)


def _score(found: dict[Setting, Row], setting: Setting) -> float:
    return _or(found[setting].score, -1.0) if setting in found else -1.0


QUALITY = (
    "", "method", "score", "TR", "FR", "completeness", "neutral: score", "FR", "splits", "merges",
    "endpoint error: median", "95 % [mm]",
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
    evaluations = f", {row.evaluations} settings tried" if row.evaluations else ""
    return f"{SETTINGS[row.setting]}{evaluations}"


def _quality(place: int, label: str, found: Agreement) -> list[str]:
    rates = [_percent(value) for value in (found.true_rate, found.false_rate)]
    ends = [f"{1000 * found.endpoint_error(share):.1f}" for share in (50, 95)]
    score, complete = f"{score_of(found):.3f}", f"{found.completeness:.3f}"
    neutral = [f"{score_of(found, neutral=True):.3f}", _percent(found.neutral_false_rate)]
    return [str(place), label, score, *rates, complete, *neutral, str(found.splits), str(found.merges), *ends]


def _time(row: Row) -> list[str]:
    times = _of_times(row)
    values = [f"{times[name]:.1f}" for name in ("mean_us", "std_us", "min_us", "max_us")]
    return [row.label, *values, f"{row.ratio:.1f}"]


def _table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    rule = ["---" if k < 2 and "method" in head[k : k + 1] else "--:" for k in range(len(head))]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (head, rule, *lines))


def _of_agreement(found: Agreement | None) -> dict[str, float | None]:
    counts = ("true_lines", "segments", "matches", "neutral", "splits", "merges")
    found_or_none = found or Agreement()
    values = {name: float(getattr(found_or_none, name)) for name in counts}
    names = ("true_rate", "false_rate", "neutral_false_rate", "completeness")
    rates = {name: getattr(found_or_none, name) for name in names}
    ends = {
        f"endpoint_error_{name}": found_or_none.endpoint_error(share) for name, share in (("median", 50), ("p95", 95))
    }
    row: dict[str, float | None] = {
        "score": finite_or_none(score_of(found_or_none)),
        "neutral_score": finite_or_none(score_of(found_or_none, neutral=True)),
    }
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
