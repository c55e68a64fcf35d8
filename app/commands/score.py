"""`lineseg score`: compares segments with the truth."""

from __future__ import annotations

import csv as csv_format
import sys
from collections.abc import Callable, Iterator
from json import dumps
from math import isnan
from pathlib import Path

from tyro.conf import OmitArgPrefixes, Positional

from lineseg.readers import TextOptions
from lineseg.scan import Recording
from lineseg.truth import Agreement

from .flag_types import Switch, Unset
from .progress import counted, open_with_progress
from .thresholds import Choice


def score(
    file: Positional[Path],
    choice: OmitArgPrefixes[Choice],
    text: OmitArgPrefixes[TextOptions],
    *,
    truth: Unset[Path] = None,
    json: Switch = False,
    csv: Switch = False,
    topic: Unset[str] = None,
) -> None:
    """Compare the segments of a recording with its true lines.

    Args:
        file: recording to read.
        choice: method and thresholds (default: from --params, else the method's defaults).
        text: scan geometry that a plain text file does not contain.
        truth: labels, .lineseg.json (default: the array `wall` of the recording).
        json: write JSON instead of a table, with the whole recording and each frame.
        csv: write CSV instead of a table, with a row for each frame.
        topic: laser topic to use (default: the first).
    """
    from lineseg import agreements

    if json and csv:
        raise ValueError("--json and --csv cannot be combined; give one of them.")
    chosen, method = choice.thresholds, choice.method
    recording = open_with_progress(file, topic, text)
    known = () if truth is None else _labelled(truth, recording)
    if truth is None and recording.wall is None:
        raise ValueError(
            f"{recording.name} has no truth; give a file of labels with --truth, or use an NPZ with `wall`."
        )
    found = counted(agreements(recording, chosen, method, *known), len(recording), "score")
    frames = {frame: each for frame, each in enumerate(found) if each is not None}
    total = Agreement.of_all(frames.values())
    if csv:
        rows = [{"frame": frame, **_numbers(each)} for frame, each in frames.items()]
        writer = csv_format.DictWriter(sys.stdout, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    elif json:
        report = {"file": recording.name, "method": method, "params": chosen.numbers(), **_numbers(total)}
        print(dumps(report | {"frames": [{"frame": frame, **_numbers(each)} for frame, each in frames.items()]}))
    else:
        print(f"{recording.name}, {len(frames)} frames with true lines, {method}")
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
        lambda frame: labels.get(frame, FrameLabels()).truth(recording[frame]),
        lambda frame: labels[frame].ends,
    )


def _numbers(agreement: Agreement) -> dict[str, float | None]:
    """The numbers for JSON and CSV, with None for NaN."""
    numbers = {
        **{name: getattr(agreement, name) for name in ("true_lines", "segments", "matches", "splits", "merges")},
        **{name: getattr(agreement, name) for name in ("true_rate", "false_rate", "completeness")},
        "endpoint_error_median": agreement.endpoint_error(),
        "endpoint_error_p95": agreement.endpoint_error(95),
    }
    return {name: None if isnan(value) else value for name, value in numbers.items()}


def _facts(total: Agreement) -> Iterator[tuple[str, str]]:
    for name in ("true_lines", "segments", "matches"):
        yield name.replace("_", " "), str(getattr(total, name))
    yield "true rate (TR)", f"{total.true_rate:.2%}"
    yield "false rate (FR)", f"{total.false_rate:.2%}"
    yield "completeness", f"{total.completeness:.2%}"
    yield "lines split", str(total.splits)
    yield "segments merging lines", str(total.merges)
    yield "endpoint error, median", f"{total.endpoint_error():.4f} m"
    yield "endpoint error, 95 %", f"{total.endpoint_error(95):.4f} m"
