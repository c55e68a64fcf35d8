"""Whoever passes something of another kind than a function takes is told what to pass."""

from __future__ import annotations

import os

import numpy as np

from .knobs import Thresholds
from .scan import Recording, Scan

MAKE_SCAN = "Scan.regular(ranges, angle_min, angle_increment) makes one from ranges [m] and angles [rad]"
MAKE_RECORDING = "Recording.from_scans(scans) makes one from scans"


def need_scan(given: object) -> None:
    """Raises TypeError unless it is a Scan."""
    if isinstance(given, Scan):
        return
    hint = MAKE_SCAN
    if isinstance(given, Recording):
        hint = "recording[0] is its first one, and survey(recording) extracts from all"
    elif isinstance(given, str | os.PathLike):
        hint = "open_recording(path)[0] is the first of a file"
    raise TypeError(f"a Scan is needed, not {_kind(given)}; {hint}")


def need_recording(given: object) -> None:
    """Raises TypeError unless it is a Recording."""
    if isinstance(given, Recording):
        return
    hint = MAKE_RECORDING
    if isinstance(given, Scan):
        hint = "Recording.from_scans([scan]) makes one from a single scan"
    elif isinstance(given, str | os.PathLike):
        hint = "open_recording(path) reads one from a file"
    elif isinstance(given, np.ndarray):
        hint = f"{MAKE_RECORDING}, and {MAKE_SCAN}"
    raise TypeError(f"a Recording is needed, not {_kind(given)}; {hint}")


def need_path(given: object) -> None:
    """Raises TypeError unless it names a file or folder."""
    if isinstance(given, str | os.PathLike):
        return
    hint = f"{MAKE_SCAN}, and {MAKE_RECORDING}" if isinstance(given, np.ndarray) else "pass a str or a Path"
    raise TypeError(f"the path of a file or folder is needed, not {_kind(given)}; {hint}")


def need_thresholds(given: object, kind: type[Thresholds] = Thresholds) -> None:
    """Raises TypeError unless these are thresholds of a method, of the one method where it must be that."""
    if isinstance(given, kind):
        return
    wanted = "Params, or the thresholds of another method," if kind is Thresholds else kind.__name__
    hint = "EXTRACTORS has the params_type of each method"
    if isinstance(given, dict):
        hint = f"{'Params' if kind is Thresholds else kind.__name__}(**values) makes them from a dict"
    elif isinstance(given, type):
        hint = f"{given.__name__}() makes some with the defaults"
    raise TypeError(f"{wanted} are needed, not {_kind(given)}; {hint}")


def _kind(given: object) -> str:
    if isinstance(given, np.ndarray):
        return f"an array of shape {given.shape}"
    if isinstance(given, type):
        return f"the class {given.__name__}"
    return repr(given) if isinstance(given, str) else type(given).__name__
