"""Compiles the kernels, or loads them from the cache, before the first tab needs them."""

from __future__ import annotations

import logging
import threading

import numpy as np

from lineseg import EXTRACTORS, Recording, Scan, extract, trace
from lineseg.baselines.authors import AuthorsParams
from lineseg.survey import survey
from lineseg.survey.committee import with_disputes

log = logging.getLogger(__name__)


class WarmUp:
    """`done` is set when region growing is ready, `surveyed` when its survey is. The very first start takes seconds.

    The other methods come last; choosing one earlier waits for that one only.
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
            # The first tab will get the same error and show it.
            log.exception("warming up failed")
        finally:
            self.done.set()
        try:
            # Recordings have single or double precision; compile the kernel of the survey for both.
            for kind in (np.float32, np.float64):
                same = Scan.regular(np.full(30, 2.0, dtype=kind), -0.1, 0.007)
                survey(Recording.from_scans([same, same]))
        except Exception:
            log.exception("warming up the survey failed")
        finally:
            self.surveyed.set()
        try:
            noisy = Recording.from_scans(_noisy_scans())
            with_disputes(noisy, survey(noisy))
            for method in EXTRACTORS.values():
                method.extract(wall, method.params_type())
                method.trace(wall, method.params_type())
            survey(Recording.from_scans([wall, wall]), AuthorsParams())
        except Exception:
            log.exception("warming up the other methods failed")


def _noisy_scans() -> list[Scan]:
    """Scans from which the noise can be told."""
    ranges = 2.0 + np.random.default_rng(0).normal(0.0, 0.01, (8, 400))
    return [Scan.regular(each, -1.0, 0.005) for each in ranges]
