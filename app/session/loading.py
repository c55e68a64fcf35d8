"""Opening the recording of a View, and what is told where that fails."""

from __future__ import annotations

import os
from collections.abc import Callable

from lineseg import Recording

from ..shelf.library import DRAWN, Library
from ..shelf.preview import named_in
from ..told.messages import Loading, Refused
from ..view import View

# What takes long where the truth is to be made from poses.
WALLS = "Looking for the walls that many scans agree on"


def opened(
    library: Library,
    view: View,
    tell: Callable[[Loading], None],
    wanted: Callable[[], bool],
    so_far: Callable[[Recording], None] | None = None,
) -> Recording:
    """The recording of a View.

    tell: hears how far it is. wanted: whether to go on. so_far: as for `Library.recording`. Raises ValueError for one
    that cannot be shown.
    """
    if not view.recording:
        raise ValueError("there is no recording to show; drop a file on the page")
    label = library.label(view.recording)

    def progress(done: int, total: int) -> None:
        source = library.live.get(view.recording)
        note = source.note if source is not None else WALLS if view.reading.walls == "by-views" else ""
        tell(Loading(recording=view.recording, label=label, done=done, total=total, note=note))

    recording = library.recording(view.recording, view.read_as, progress, wanted, so_far)
    if not len(recording):
        raise ValueError(f"{label} holds no scans")
    return recording


def is_file(view: View) -> bool:
    """Whether the recording of a View is read from a file."""
    return bool(view.recording) and not view.recording.startswith(("live:", DRAWN))


def refused(library: Library, view: View, message: str) -> Refused | None:
    """What could not be read; None if it is no file that exists, or if no other Reading could help."""
    try:
        if not os.path.exists(library.path(view.recording)):  # noqa: PTH110 - this one raises nothing
            return None
    except ValueError:
        return None
    given, named = view.reading.given(), named_in(message)
    if not (given or named or view.topic):
        return None
    label = library.label(view.recording)
    return Refused(recording=view.recording, label=label, topic=view.topic, reading=given, named=named)
