"""`lineseg info`: describes recordings."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from tyro.conf import OmitArgPrefixes, Positional

from lineseg.poses import said_of
from lineseg.proposal import Proposal, propose
from lineseg.scan import Recording, are_valid

from .flag_types import Files
from .progress import open_with_progress
from .reading import ReadingFlags, each_file, reading_of

# No laser scatters by less [m]; the walls of such a recording do not show how its laser does.
LEAST_NOISE = 5e-4
FRAMES_AT_ONCE = 1000


def info(files: Positional[Files[str]], reading: OmitArgPrefixes[ReadingFlags]) -> None:  # type: ignore[valid-type]
    """Describe recordings, and say what each file was taken for.

    Args:
        files: recordings to read; * and ? stand for several.
        reading: how to read the files.
    """
    how = reading_of(reading)
    told = 0

    def describe(file: Path) -> None:
        nonlocal told
        recording = open_with_progress(file, how, tell=False)
        if told:
            print()
        told += 1
        for name, value in _facts(recording):
            print(f"{name:<14}{value}")

    each_file(files, describe)


def _facts(recording: Recording) -> Iterator[tuple[str, object]]:
    account = recording.account
    assert account is not None
    yield "file", recording.name
    yield "taken for", account.line
    for guess in account.guesses:
        yield "guessed", guess.text
    for notice in account.notices:
        yield "noticed", notice.advice
    if account.skips:
        yield "skipped", account.skipped_text
    yield "format", recording.format
    for topic in recording.topics:
        scans = f"{topic.scans} scan{'' if topic.scans == 1 else 's'}"
        yield "topic", f"{topic.name} ({scans}){' *' if topic.name == recording.topic else ''}"
    yield "scans", len(recording)
    least, most = recording.beams
    yield "beams", least if least == most else f"{least} to {most}"
    views, steps = _bearings(recording)
    yield "field of view", f"{np.rad2deg(np.median(views)):.2f}°"
    yield "beam spacing", f"{np.rad2deg(np.median(steps)):.4f}°"
    valid, longest = _returns(recording)
    yield "invalid beams", f"{1 - valid / max(len(recording.ranges), 1):.2%}"
    yield "longest range", f"{max(longest, default=0.0):.3f} m"
    if account.believable:
        yield "duration", f"{np.ptp(recording.stamps):.3f} s"
    yield "poses", said_of(recording.poses, recording.pose_source)
    found = propose(recording)
    yield "noise", _noise(found, longest)
    yield "thresholds", found.text or "The defaults fit this recording."


def _bearings(recording: Recording) -> tuple[list[float], list[float]]:
    """The field of view and the mean beam spacing of each scan that has one [rad]."""
    views, steps = [], []
    last = None
    view = step = 0.0
    for scan in recording:
        # Scans of one geometry share their bearings.
        if scan.bearings is not last:
            last = scan.bearings
            view = float(np.ptp(last)) if len(scan) else 0.0
            step = float(np.abs(np.diff(last)).mean()) if len(scan) > 1 else 0.0
        views += [view] * (len(scan) > 0)
        steps += [step] * (len(scan) > 1)
    return views or [0.0], steps or [0.0]


def _returns(recording: Recording) -> tuple[int, list[float]]:
    """The number of valid beams, and the longest range of each scan that has any [m]."""
    number, longest = 0, []
    for first in range(0, len(recording), FRAMES_AT_ONCE):
        frames = slice(first, first + FRAMES_AT_ONCE)
        offsets = recording.offsets[first : frames.stop + 1]
        ranges, beams = recording.ranges[offsets[0] : offsets[-1]], np.diff(offsets)
        least, most = (
            np.repeat(limit[frames].astype(ranges.dtype), beams) for limit in (recording.range_min, recording.range_max)
        )
        valid = are_valid(ranges, least, most)
        number += int(np.count_nonzero(valid))
        starts = (offsets[:-1] - offsets[0])[beams > 0]
        farthest = np.maximum.reduceat(np.where(valid, ranges, 0), starts) if len(starts) else np.empty(0)
        longest += farthest[farthest > 0].tolist()
    return number, longest


def _noise(found: Proposal, longest: list[float]) -> str:
    noise = found.noise
    if not noise.known:
        return "unknown, because too few points lie on straight walls"
    near, far = noise.at(1.0), noise.at(np.median(longest))
    if near < LEAST_NOISE and far < LEAST_NOISE:
        return "cannot be told: ranges differ by less than 0.5 mm from smooth walls, as in computed or constant scans"
    text = f"{1e3 * near:.0f} mm"
    if far > 1.2 * near:
        text += f" at 1 m, {1e3 * far:.0f} mm at {np.median(longest):.0f} m"
    if found.bend > 0.5 * near:
        text += f"; walls deviate from a straight line by {1e3 * found.bend:.0f} mm more"
    return text
