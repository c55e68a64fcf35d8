"""When the scans that were read so far are shown to who waits for a long file."""

from __future__ import annotations

import time
from collections.abc import Callable

from ..scan import Recording
from .account import Notes
from .reading import Reading

# Files that are read sooner [s] are shown as a whole.
FIRST = 0.2
# Another part is shown after this time [s], and when there are so many times as many scans as in the part before.
EVERY, GROWTH = 0.4, 1.25
# Where these are given, the frames of a part would be others than those of the whole file, or take long to make.
OF_THE_WHOLE = ("frames", "seconds", "sector", "every_beam", "motion", "walls")


class Parts:
    """show: called with a part, and with what was found out while it was read."""

    def __init__(self, show: Callable[[Recording, Notes], None]) -> None:
        self.show = show
        self._shown = 0
        self._next = time.monotonic() + FIRST

    def due(self, scans: int) -> bool:
        """Whether so many scans are to be shown now."""
        now = time.monotonic()
        if not scans or scans < GROWTH * self._shown or now < self._next:
            return False
        self._shown, self._next = scans, now + EVERY
        return True


def can_be_shown(reading: Reading) -> bool:
    """Whether the first scans of a file, read in this way, are the first scans of the whole."""
    return not set(OF_THE_WHOLE) & reading.given().keys()
