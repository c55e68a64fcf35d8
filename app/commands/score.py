"""`lineseg score`: compares segments with the truth."""

from __future__ import annotations

import csv as csv_format
import sys
from collections.abc import Callable, Iterator
from json import dumps
from math import isnan
from pathlib import Path

from tyro.conf import OmitArgPrefixes, Positional

from lineseg.knobs import Thresholds
from lineseg.scan import Recording
from lineseg.truth import Agreement

from .flag_types import Files, Switch, Unset
from .progress import counted, open_with_progress, open_with_truth
from .reading import ReadingFlags, each_file, files_of, reading_of
from .thresholds import Choice, Flags

RATES = ("true_rate", "false_rate", "neutral_false_rate", "completeness")


def score(
    files: Positional[Files[str]],
    method: OmitArgPrefixes[Choice],
    threshold: OmitArgPrefixes[Flags],  # type: ignore[valid-type]
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    *,
    truth: Unset[Path] = None,
    json: Switch = False,
    csv: Switch = False,
) -> None:
    """Compare the segments of recordings with their true lines.

    A neutral segment lies on a wall that misses P_min or L_min by at most 30 %. It counts as false in FR, and not at
    all in "FR without neutral".

    Args:
        files: recordings to read; * and ? stand for several.
        method: the method, and where its thresholds come from (default: the method's defaults).
        threshold: thresholds of region growing; they override --params.
        reading: how to read the files.
        truth: labels of one recording, .lineseg.json (default: the array `wall` of each recording, or the walls that
            its scans with poses agree on).
        json: write JSON instead of a table, a line for each recording, with its total and each frame.
        csv: write CSV instead of a table, with a row for each frame.
    """
    if json and csv:
        raise ValueError("--json and --csv cannot be combined; give one of them.")
    several = len(files_of(files)) > 1
    if truth is not None and several:
        raise ValueError("--truth has the labels of one recording; name one file.")
    chosen, how, name = method.thresholds(threshold), reading_of(reading), method.name
    totals: list[Agreement] = []

    def work(file: Path) -> None:
        recording = open_with_progress(file, how) if truth else open_with_truth(file, how)
        frames = _agreements(recording, chosen, name, truth)
        total = Agreement.of_all(frames.values())
        by_views = recording.wall_source if truth is None else ""
        if csv:
            _write_csv(recording.name if several else None, frames, header=not totals)
        elif json:
            report = {"file": recording.name, "reading": _used(recording), "method": name}
            report |= {"by_many_views": by_views} if by_views else {}
            report |= {"params": chosen.numbers(), **_numbers(total)}
            print(dumps(report | {"frames": [{"frame": frame, **_numbers(each)} for frame, each in frames.items()]}))
        else:
            what = f"{len(frames)} frames with true lines{' by many views' if by_views else ''}"
            _print_table(f"{recording.name}, {what}, {name}", total)
        totals.append(total)

    try:
        each_file(files, work)
    finally:
        if len(totals) > 1 and not (csv or json):
            _print_table(f"all {len(totals)} files, {name}", Agreement.of_all(totals))


def _agreements(recording: Recording, params: Thresholds, method: str, truth: Path | None) -> dict[int, Agreement]:
    """The agreement of each frame that has true lines, by its number in the file."""
    from lineseg import agreements

    known = () if truth is None else _labelled(truth, recording)
    if truth is None and recording.wall is None:
        raise ValueError(
            f"{recording.name} has no truth; give a file of labels with --truth, or an NPZ with `wall`; "
            "scans with poses need neither, if they agree on walls."
        )
    found = counted(agreements(recording, params, method, *known), len(recording), "score")
    return {recording.number(frame): each for frame, each in enumerate(found) if each is not None}


def _used(recording: Recording) -> dict[str, object]:
    return {} if recording.account is None else recording.account.used.given()


def _write_csv(file: str | None, frames: dict[int, Agreement], header: bool) -> None:
    named = {} if file is None else {"file": file}
    rows = [{**named, "frame": frame, **_numbers(each)} for frame, each in frames.items()]
    writer = csv_format.DictWriter(sys.stdout, rows[0], lineterminator="\n")
    if header:
        writer.writeheader()
    writer.writerows(rows)


def _print_table(title: str, total: Agreement) -> None:
    print(title)
    for name, value in _facts(total):
        print(f"{name:<24}{value:>10}")


def _labelled(file: Path, recording: Recording) -> tuple[Callable, Callable]:
    """The true lines of each labelled frame, and their endpoints."""
    from lineseg import FrameLabels, read_labels

    if not file.exists():
        raise FileNotFoundError(f"{file}: there is no such file.")
    labels = read_labels(file, recording)
    if all(each.lines is None for each in labels.values()):
        raise ValueError(f"{file}: no frame has true lines.")
    return (
        lambda frame: labels.get(recording.number(frame), FrameLabels()).truth(recording[frame]),
        lambda frame: labels[recording.number(frame)].ends,
    )


def _numbers(agreement: Agreement) -> dict[str, float | None]:
    """The numbers for JSON and CSV, with None for NaN."""
    numbers = {
        **{
            name: getattr(agreement, name)
            for name in ("true_lines", "segments", "matches", "neutral", "splits", "merges")
        },
        **{name: getattr(agreement, name) for name in RATES},
        "endpoint_error_median": agreement.endpoint_error(),
        "endpoint_error_p95": agreement.endpoint_error(95),
    }
    return {name: None if isnan(value) else value for name, value in numbers.items()}


def _facts(total: Agreement) -> Iterator[tuple[str, str]]:
    for name in ("true_lines", "segments", "matches", "neutral"):
        yield name.replace("_", " "), str(getattr(total, name))
    yield "true rate (TR)", f"{total.true_rate:.2%}"
    yield "false rate (FR)", f"{total.false_rate:.2%}"
    yield "FR without neutral", f"{total.neutral_false_rate:.2%}"
    yield "completeness", f"{total.completeness:.2%}"
    yield "lines split", str(total.splits)
    yield "segments merging lines", str(total.merges)
    yield "endpoint error, median", f"{total.endpoint_error():.4f} m"
    yield "endpoint error, 95 %", f"{total.endpoint_error(95):.4f} m"
