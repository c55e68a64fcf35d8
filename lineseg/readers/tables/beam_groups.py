"""Tables with several beams in a row, each with its own pair of columns: an angle and a distance, or x and y."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...scan import Recording
from ..lasers import laser_of
from ..reading import Reading
from ..source import Source
from .beam_rows import beams_of, table_of
from .dialect import Dialect, Row
from .headers import STAMPS, Name, column_of, says_angle, says_distance

# With fewer groups, each is a scan, of which a row has a beam; with more, each row is a scan.
MANY_BEAMS = 10


class Groups(NamedTuple):
    """The columns of the angles, or of x, of the distances, or of y, and what each pair is called beside these words.

    words: what the pair holds.
    """

    firsts: list[int]
    seconds: list[int]
    labels: list[str]
    words: tuple[str, str]


def groups_of(names: list[Name]) -> Groups | None:
    """The pairs of columns, if a table has two or more with angles, or many with points."""
    return _pairs(names, says_angle, says_distance, ("angle", "distance"), 2) or _pairs(
        names, _is_axis("x"), _is_axis("y"), ("x", "y"), MANY_BEAMS
    )


def _is_axis(axis: str):
    return lambda name: name.plain.split("_")[-1] == axis


def _pairs(names: list[Name], is_first, is_second, words: tuple[str, str], least: int) -> Groups | None:
    firsts, seconds = ([at for at, name in enumerate(names) if test(name)] for test in (is_first, is_second))
    if len(firsts) != len(seconds) or len(firsts) < least:
        return None
    keys = [[(_label(names[at], test), names[at].element) for at in columns]
            for columns, test in ((firsts, is_first), (seconds, is_second))]  # fmt: skip
    alike = all(len({names[at] for at in columns}) == 1 for columns in (firsts, seconds))
    if not alike and (len({*keys[0]}) < len(firsts) or {*keys[0]} != {*keys[1]}):
        return None
    if not alike:
        seconds = [seconds[keys[1].index(key)] for key in keys[0]]
    return Groups(firsts, seconds, [label for label, _ in keys[0]], words)


def _label(name: Name, test) -> str:
    """A name without the words that say what it holds: "front" of front_angle."""
    return "_".join(word for word in name.plain.split("_") if not test(Name(word)))


def read_groups(
    source: Source, reading: Reading, rows: Iterable[Row], dialect: Dialect, names: list[Name], groups: Groups
) -> Recording:
    """The scans of such a table."""
    rows = list(rows)
    table = table_of(source, rows, dialect, names, (*groups.firsts, *groups.seconds))
    first, second = (np.stack([table[:, at] * names[at].scale for at in columns])
                     for columns in (groups.firsts, groups.seconds))  # fmt: skip
    frame_id, stamps = "", None
    if len(groups.firsts) < MANY_BEAMS:
        first, second, frame_id = _of_one_laser(source, reading, groups, first, second)
        what = f"Each of {len(first)} pairs of columns was read as a scan."
    else:
        first, second = first.T, second.T
        at = column_of(names, lambda name: name.element < 0 and name.plain in STAMPS)
        stamps = None if at is None else np.repeat(table[:, at], first.shape[1])
        what = f"Each row was read as a scan with {' and '.join(groups.words)} of {first.shape[1]} beams."
    source.notes.notice("beams", what)
    scan = np.repeat(np.arange(len(first), dtype=np.float64), first.shape[1])
    columns = [scan, first.ravel(), second.ravel()]
    kinds = [Name("scan"), *(Name(word, names[at].unit) for word, at in
                             zip(groups.words, (groups.firsts[0], groups.seconds[0]), strict=True))]  # fmt: skip
    if stamps is not None:
        columns.append(stamps)
        kinds.append(Name("stamp"))
    # A shorter scan ends in empty cells.
    beams = np.column_stack(columns)[np.isfinite(columns[1])]
    recording = beams_of(source, reading, beams, kinds)
    return replace(recording, frame_ids=(frame_id,) * len(recording)) if frame_id else recording


def _of_one_laser(source: Source, reading: Reading, groups: Groups, first: np.ndarray, second: np.ndarray):
    """The pairs of columns of one laser, and its name, if they are called after lasers; otherwise all, and ""."""
    lasers = dict.fromkeys(groups.labels)
    if len(lasers) < 2:
        return first, second, ""
    counts = {laser: groups.labels.count(laser) for laser in lasers}
    taken = laser_of(source, reading, counts, "scans", "the table")
    these = [label == taken for label in groups.labels]
    return first[these], second[these], taken
