"""Applies a Reading to what a reader delivered: one place for every format, in the order of the fields."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scan import Recording, Scan
from .account import Account, Findings, Guess, Notes
from .guessing import guess_limit, guess_unit, no_return_codes, sampled
from .lasers import one_laser
from .plausible import noticed, oddness, trouble_in, trouble_of, unwrapped
from .poses.posing import with_poses
from .poses.sweeping import without_motion
from .reading import METRES, RADIANS, Reading, Span, frames_of, span_of, values_of
from .saying import line_of
from .walling import with_walls

SAME = 5e-4


def applied(
    recording: Recording, reading: Reading, notes: Notes, file: Path, progress: Callable[[int, int], None]
) -> Recording:
    """The recording as `reading` wants it, with its account. Raises ValueError if nothing would be left.

    file: as the user named it. progress: of what takes long.
    """
    recording = one_laser(recording, reading, notes)
    recording = _with_stamps(recording, reading, notes)
    recording, used = _in_metres_and_radians(recording, reading, notes)
    whole = _with_limits(recording, used, notes)
    guesses, used = _without_present(tuple(notes.guesses), whole, used)
    shown = with_poses(_chosen_frames(whole, used), reading, file)
    if reading.motion == "removed":
        shown = without_motion(shown, notes)
    shown = _chosen_beams(shown, used)
    if reading.walls == "by-views":
        shown = with_walls(shown, notes, progress)
    account = Account(
        given=reading,
        used=used,
        guesses=guesses,
        skipped=tuple(notes.skipped),
        skips=notes.skips,
        skipping=notes.skipping,
        lasers=notes.lasers,
        find=partial(_findings, whole, shown, used, guesses, notes),
    )
    # A copy does not keep the scans and beams that were left out.
    return replace(shown, account=account if shown.ranges is whole.ranges else copy(account))


def _findings(whole: Recording, shown: Recording, used: Reading, guesses: tuple[Guess, ...], notes: Notes) -> Findings:
    """What is told about the whole file, and the line about what is shown of it."""
    # Damaged numbers may be anything.
    with np.errstate(all="ignore"):
        odd = oddness(whole.stamps)
        notices = (*notes.notices, *noticed(whole, used, notes.recorded is not None, odd))
        return Findings(line_of(shown, used, guesses, notes), notices, trouble_in(whole.stamps, odd))


def _without_present(
    guesses: tuple[Guess, ...], recording: Recording, used: Reading
) -> tuple[tuple[Guess, ...], Reading]:
    """The guesses, without changes to what is there already; also returns the Reading with guessed angles."""
    sense = -1.0 if used.direction == "clockwise" else 1.0
    geometry = {name: sense * float(getattr(recording, name)[0]) for name in ("angle_min", "angle_increment")}
    if any(guess.field == "angle_min" for guess in guesses):
        used = used.but(**{name: round(value, 8) for name, value in geometry.items()})
    present = {**geometry, **used.given()}
    kept = [guess if any(_differs(present.get(name), value) for name, value in guess.change.items())
            else replace(guess, change={}) for guess in guesses]  # fmt: skip
    return tuple(kept), used


def _differs(one: Any, other: Any) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) > 1e-5
    return one != other


def _with_stamps(recording: Recording, reading: Reading, notes: Notes) -> Recording:
    if reading.stamps == "recorded" and notes.recorded is None:
        raise ValueError(f"{recording.name}: stamps cannot be the recorder's; only a bag has its recorder's times.")
    if reading.stamps == "none":
        return replace(recording, stamps=np.zeros(len(recording)))
    if reading.stamps == "unwrapped":
        return replace(recording, stamps=unwrapped(recording.stamps))
    wanted = reading.stamps == "recorded" or (reading.stamps is None and not recording.stamps.any())
    return replace(recording, stamps=notes.recorded) if wanted and notes.recorded is not None else recording


def _in_metres_and_radians(recording: Recording, reading: Reading, notes: Notes) -> tuple[Recording, Reading]:
    """Units, angles and direction; also returns the Reading completed with what was found."""
    unit = guess_unit(recording, reading, notes)
    angle_unit = reading.angle_unit or notes.found.get("angle_unit", "rad")
    direction = reading.direction or notes.found.get("direction", "counter-clockwise")
    used = Reading(**{**notes.found, **reading.given(), "unit": unit, "angle_unit": angle_unit, "direction": direction})
    changes: dict[str, Any] = {}
    if (scale := METRES[unit]) != 1:
        changes["ranges"] = recording.ranges * scale
        if not _limits_in_metres(recording):
            changes |= {name: getattr(recording, name) * scale for name in ("range_min", "range_max")}
    if angle_unit != "rad" and not notes.radians:
        changes |= _angles(recording, lambda angles: angles * RADIANS[angle_unit])
    recording = replace(recording, **changes)
    recording = _with_geometry(recording, reading)
    if direction == "clockwise":
        recording = replace(recording, **_angles(recording, np.negative))
    return recording, used


def _limits_in_metres(recording: Recording) -> bool:
    """Whether ranges in another unit stand beside limits in metres: then most of them lie beyond."""
    ranges = sampled(recording.ranges)
    return float(np.mean(ranges[ranges > 0] > np.median(recording.range_max))) > 0.5 if (ranges > 0).any() else False


def _angles(recording: Recording, change: Any) -> dict[str, Any]:
    bearings = None if recording.bearings is None else change(recording.bearings)
    return {
        "angle_min": change(recording.angle_min),
        "angle_increment": change(recording.angle_increment),
        "bearings": bearings,
    }


def _with_geometry(recording: Recording, reading: Reading) -> Recording:
    given = {name: reading.given()[name] for name in ("angle_min", "angle_increment") if name in reading.given()}
    if not given:
        return recording
    if recording.bearings is not None:
        raise ValueError(
            f"{recording.name}: {' and '.join(given)} cannot be used, because the file states the bearing of each beam."
        )
    frames = len(recording)
    return replace(recording, **{name: np.full(frames, value) for name, value in given.items()})


def _with_limits(recording: Recording, reading: Reading, notes: Notes) -> Recording:
    changes: dict[str, Any] = {}
    frames = len(recording)
    codes = [Span(code, code) for code in no_return_codes(recording, reading, notes)]
    if reading.no_return is not None:
        codes += values_of(reading.no_return)
    if reading.time_increment is not None:
        changes["time_increment"] = np.full(frames, reading.time_increment)
    if codes:
        ranges = recording.ranges.copy()
        for low, high in codes:
            ranges[(ranges >= low - SAME) & (ranges <= high + SAME)] = np.nan
        changes["ranges"] = ranges
    if "range_max" in notes.unstated and not codes:
        changes["range_max"] = np.full(frames, guess_limit(recording, reading, notes))
    for name in ("range_min", "range_max"):
        if getattr(reading, name) is not None:
            changes[name] = np.full(frames, float(getattr(reading, name)))
    return replace(recording, **changes) if changes else recording


# Filters


def _chosen_frames(recording: Recording, reading: Reading) -> Recording:
    keep = np.ones(len(recording), np.bool_)
    if reading.frames is not None:
        chosen = frames_of(reading.frames, len(recording))
        keep[: chosen.start] = keep[chosen.stop :] = False
    if reading.seconds is not None:
        keep &= _within(recording, span_of(reading.seconds), reading.seconds)
    if reading.every_scan is not None:
        keep[np.arange(len(recording)) % reading.every_scan != 0] = False
    if keep.all():
        return recording
    if not keep.any():
        raise ValueError(f"{recording.name}: no scan is left of {len(recording)}; choose other frames or seconds.")
    numbers = np.flatnonzero(keep)
    began = float(recording.stamps[0])
    return replace(recording.only(numbers), numbers=numbers, whole=len(recording), began=began)


def _within(recording: Recording, span: Span, text: str) -> NDArray[np.bool_]:
    if trouble := trouble_of(recording.stamps):
        has = f"it has {trouble}" if trouble == "no stamps" else f"its {trouble}"
        raise ValueError(f"{recording.name}: seconds cannot be used, because {has}; use frames.")
    since = recording.stamps - recording.stamps[0]
    keep = (since >= span.low) & (since < span.high)
    if not keep.any():
        raise ValueError(
            f"{recording.name}: seconds is {text!r}, which is empty; its stamps go from {since.min():g} to "
            f"{since.max():g} s after the first."
        )
    return keep


def _chosen_beams(recording: Recording, reading: Reading) -> Recording:
    if reading.sector is None and reading.every_beam in (None, 1):
        return recording
    span = None if reading.sector is None else span_of(reading.sector)
    scans = [_beams(scan, span, reading.every_beam or 1) for scan in recording]
    if not any(len(scan) for scan in scans):
        raise ValueError(f"{recording.name}: no beam is left in the sector {reading.sector}; choose another.")
    fresh = Recording.from_scans(scans, name=recording.name)
    names = ("ranges", "offsets", "angle_min", "angle_increment", "bearings", "wall")
    return replace(recording, time_increment=None, **{name: getattr(fresh, name) for name in names})


def _beams(scan: Scan, span: Span | None, step: int) -> Scan:
    """The beams within a sector [deg], in their order, without a gap where the scan's seam lies inside the sector."""
    order = np.arange(len(scan))
    bearings = scan.bearings
    if span is not None and len(scan):
        low = np.deg2rad(max(span.low, -180.0))
        width = np.deg2rad(min(span.high, 180.0)) - low
        width = width % (2 * np.pi) or 2 * np.pi if width <= 0 or width > 2 * np.pi else width
        # A beam on the border may lie a hair outside of it.
        since = (bearings - low + 1e-6) % (2 * np.pi) - 1e-6
        inside = np.flatnonzero(since <= width + 1e-6)
        falling = len(scan) > 1 and bearings[-1] < bearings[0]
        order = inside[np.argsort(-since[inside] if falling else since[inside], kind="stable")]
        bearings = since + low
    order = order[::step]
    wall = None if scan.wall is None else scan.wall[order]
    return replace(scan, ranges=scan.ranges[order], bearings=bearings[order], wall=wall, known=None)
