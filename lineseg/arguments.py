"""Checks of argument types, with errors that say what to pass instead."""

from __future__ import annotations

import os

import numpy as np

from .knobs import Thresholds
from .scan import Recording, Scan

MAKE_SCAN = "Scan.regular(ranges, angle_min, angle_increment) makes a scan from ranges [m] and angles [rad]"
MAKE_RECORDING = "Recording.from_scans(scans) makes a recording from scans"


def need_scan(given: object) -> None:
    """Raises TypeError if `given` is not a Scan."""
    if isinstance(given, Scan):
        return
    hint = MAKE_SCAN
    if isinstance(given, Recording):
        hint = "recording[0] is its first scan, and survey(recording) extracts from all scans"
    elif isinstance(given, str | os.PathLike):
        hint = "open_recording(path)[0] is the first scan of a file"
    raise TypeError(f"pass a Scan, not {_kind(given)}; {hint}")


def need_recording(given: object) -> None:
    """Raises TypeError if `given` is not a Recording."""
    if isinstance(given, Recording):
        return
    hint = MAKE_RECORDING
    if isinstance(given, Scan):
        hint = "Recording.from_scans([scan]) makes a recording from a single scan"
    elif isinstance(given, str | os.PathLike):
        hint = "open_recording(path) reads a recording from a file"
    elif isinstance(given, np.ndarray):
        hint = f"{MAKE_RECORDING}, and {MAKE_SCAN}"
    raise TypeError(f"pass a Recording, not {_kind(given)}; {hint}")


def need_path(given: object) -> None:
    """Raises TypeError if `given` is not a path."""
    if isinstance(given, str | os.PathLike):
        return
    hint = f"{MAKE_SCAN}, and {MAKE_RECORDING}" if isinstance(given, np.ndarray) else "pass a str or a Path"
    raise TypeError(f"pass the path of a file or folder, not {_kind(given)}; {hint}")


def need_thresholds(given: object, kind: type[Thresholds] = Thresholds) -> None:
    """Raises TypeError unless `given` holds the thresholds of a method, or of the one required method."""
    if isinstance(given, kind):
        return
    wanted = "Params or the thresholds of another method" if kind is Thresholds else kind.__name__
    hint = "EXTRACTORS has the params_type of each method"
    if isinstance(given, dict):
        hint = f"{'Params' if kind is Thresholds else kind.__name__}(**values) makes thresholds from a dict"
    elif isinstance(given, type):
        hint = f"{given.__name__}() makes thresholds with the defaults"
    raise TypeError(f"pass {wanted}, not {_kind(given)}; {hint}")


def _kind(given: object) -> str:
    if isinstance(given, np.ndarray):
        return f"an array of shape {given.shape}"
    if isinstance(given, type):
        return f"the class {given.__name__}"
    return repr(given) if isinstance(given, str) else type(given).__name__
