"""One line that says what a file was taken for."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..scan import Recording
from .account import Guess, Notes
from .guessing import UNIT_NAMES
from .reading import Reading

GUESSED = " (guessed)"


def line_of(recording: Recording, used: Reading, guesses: Iterable[Guess], notes: Notes) -> str:
    """Such as "CSV · 3 scans × 181 beams · millimetres · −90…90° counter-clockwise · stamps from column 1"."""
    guessed = {guess.field for guess in guesses}
    kind = notes.kind or recording.format
    unit = UNIT_NAMES[used.unit or "m"] + (GUESSED if "unit" in guessed else "")
    turn = GUESSED if guessed & {"direction", "angle_min", "angle_increment", "angle_unit", "columns"} else ""
    parts = [kind, _size(recording), unit, f"{_angles(recording)}{turn}"]
    parts.append(f"stamps from {notes.stamps}" if notes.stamps and recording.stamps.any() else _stamps(recording))
    if notes.skips:
        parts.append(f"{notes.skips} skipped")
    return " · ".join(parts)


def _size(recording: Recording) -> str:
    least, most = recording.beams
    beams = f"{most}" if least == most else f"{least}–{most}"
    scans = len(recording)
    return f"{scans} scan{'' if scans == 1 else 's'} × {beams} beam{'' if most == 1 else 's'}"


def _angles(recording: Recording) -> str:
    """From the first beam to the last, and the sense."""
    bearings = recording[0].bearings
    if not len(bearings):
        return "no beams"
    first, last = (f"{_degrees(angle)}" for angle in np.rad2deg(bearings[[0, -1]]))
    return f"{first}…{last}° {'clockwise' if bearings[-1] < bearings[0] else 'counter-clockwise'}"


def _degrees(angle: float) -> str:
    return f"{round(float(angle), 1) + 0:g}".replace("-", "−")


def _stamps(recording: Recording) -> str:
    return "stamps" if recording.stamps.any() else "no stamps"
