"""How far rates by many views are from the exact ones: python tests/benchmarks/truth_by_views.py [FIRST:STOP]

For each seed a laser and a room made at random (`unseen_lasers.py`), seen from 48 places with exact poses. Each method
is scored with the truth by many views and with the exact one. The table has, for TR, FR and completeness, the share of
worlds in which they differ by at most 2 points, the same of worlds whose truth is called near, and the medians of the
signed differences.
"""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import unseen_lasers
from numpy.typing import NDArray

from lineseg import Recording, agreements
from lineseg.extractors import EXTRACTORS
from lineseg.many_views import truth_by_many_views
from lineseg.truth import Agreement

PLACES, NEAR = 48, 2.0
RATES = ("true_rate", "false_rate", "completeness")


def rates(recording: Recording, method: str) -> NDArray[np.float64]:
    """TR, FR and completeness [%] of a method with its defaults."""
    found = agreements(recording, EXTRACTORS[method].params_type(), method)
    total = Agreement.of_all(each for each in found if each is not None)
    return 100 * np.array([getattr(total, name) for name in RATES])


def main(first: int, stop: int) -> None:
    unseen_lasers.FRAMES = PLACES
    rows, trusted = [], []
    for seed in range(first, stop):
        exact = unseen_lasers.recording_of(seed)
        try:
            found = truth_by_many_views(replace(exact, wall=None, walls=None))
        except ValueError as error:
            print(f"{exact.name}: {error}", flush=True)
            continue
        both = [[rates(each, method) for each in (found.recording, exact)] for method in EXTRACTORS]
        rows.append([made - true for made, true in both])
        trusted.append(found.trusted)
        said = "usable" if found.usable else "not usable"
        worst = np.abs(rows[-1]).max(axis=0).round(1)
        print(f"{exact.name}: {said}, trusted {found.trusted}, at most {worst} off; {found.text[:120]}", flush=True)
    off = np.array(rows)
    print(f"{len(off)} worlds, {sum(trusted)} trusted; within {NEAR:g} points, and medians of the differences:")
    for number, method in enumerate(EXTRACTORS):
        here = off[:, number]
        share = np.mean(np.abs(here) <= NEAR, axis=0)
        sure = np.mean(np.abs(here[trusted]) <= NEAR, axis=0) if any(trusted) else np.full(3, np.nan)
        print(f"{method:26}{share.round(2)} trusted {sure.round(2)} {np.nanmedian(here, axis=0).round(1)}")


if __name__ == "__main__":
    bounds = (sys.argv[1] if len(sys.argv) > 1 else "0:24").split(":")
    main(int(bounds[0]), int(bounds[1]))
