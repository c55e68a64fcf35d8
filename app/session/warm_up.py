"""The kernels, compiled or fetched from their cache before the first tab asks for them."""

from __future__ import annotations

import logging
import threading

import numpy as np

from lineseg import EXTRACTORS, Recording, Scan, extract, trace
from lineseg.baselines.authors import AuthorsParams
from lineseg.survey import survey

log = logging.getLogger(__name__)


class WarmUp:
    """Set once they ran: `done`, region growing; `surveyed`, its survey. An installation's first start takes seconds.

    The other methods come last; whoever chooses one before waits for that one only.
    """

    label = "Compiling the method, once for this installation"

    def __init__(self) -> None:
        self.done = threading.Event()
        self.surveyed = threading.Event()

    def start(self) -> None:
        threading.Thread(target=self._run, name="warm up", daemon=True).start()

    def _run(self) -> None:
        wall = Scan.regular(np.full(30, 2.0), -0.1, 0.007)
        try:
            extract(wall)
            trace(wall)
        except Exception:
            # The first tab will meet the same error, and show it.
            log.exception("warming up failed")
        finally:
            self.done.set()
        try:
            # A recording has single or double precision, and the kernel of the survey knows both.
            for kind in (np.float32, np.float64):
                same = Scan.regular(np.full(30, 2.0, dtype=kind), -0.1, 0.007)
                survey(Recording.from_scans([same, same]))
        except Exception:
            log.exception("warming up the survey failed")
        finally:
            self.surveyed.set()
        try:
            for method in EXTRACTORS.values():
                method.extract(wall, method.params_type())
                method.trace(wall, method.params_type())
            survey(Recording.from_scans([wall, wall]), AuthorsParams())
        except Exception:
            log.exception("warming up the other methods failed")
