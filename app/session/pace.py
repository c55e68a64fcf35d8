"""How long drawing a View takes, and so in which thread and turn it is drawn."""

from __future__ import annotations

import os
import threading
from contextlib import AbstractContextManager

from lineseg import Recording

from ..view import View
from .turns import InOrder

# Threads of tabs draw one after the other. Python runs one at a time anyway: more would only make each other wait, and
# show older Views, because each takes the newest when its turn comes.
QUICK_TURN = InOrder()
# Scans of more beams take longer [beams].
QUICK_BEAMS = 2_000
# What may take long does not make the others wait; its kernels run beside Python.
SLOW_TURNS = threading.Semaphore(max(2, os.cpu_count() or 2))


def waits_for(view: View) -> tuple[str, bool, bool]:
    """What drawing it waits for: its recording, and its turn."""
    return view.place, view.live, takes_long(view)


def takes_long(view: View) -> bool:
    """Whether drawing it may take much longer than a few milliseconds: other methods do, and what Inspect computes."""
    if view.method != "region-growing" or view.mode == "inspect" or view.layers.verdicts or view.against is not None:
        return True
    # The poses of a bag take another pass over its file.
    return view.space == "world"


def turn_of(view: View) -> AbstractContextManager[object]:
    """Held by a thread while it draws the View."""
    return SLOW_TURNS if takes_long(view) else QUICK_TURN


def quick(recording: Recording) -> bool:
    """Whether its scans are small enough to be drawn in the thread that answers all tabs."""
    return recording.offsets[-1] <= QUICK_BEAMS * len(recording)
