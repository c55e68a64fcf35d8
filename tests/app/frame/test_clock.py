"""When the frames of a recording were taken."""

from __future__ import annotations

import numpy as np
import pytest
from lineseg_app.frame.clock import Clock

from lineseg import Recording, Scan


def stamped(*stamps: float) -> Recording:
    return Recording.from_scans([Scan.regular(np.ones(9), -0.4, 0.1, stamp=stamp) for stamp in stamps])


def test_time_counts_from_the_first_scan():
    assert Clock.of(stamped(1.7e9, 1.7e9 + 0.5, 1.7e9 + 2)).since.tolist() == [0, 0.5, 2]


@pytest.mark.parametrize(
    ("stamps", "trouble"),
    [
        ((0, 0, 0), "no stamps"),
        ((5, 5, 5), "stamps are equal"),
        ((1, 2, 1.5), "stamps run backwards"),
        ((1, 2, np.nan), "stamps are not numbers"),
        ((1, 2, 1.7e9), "stamps jump by years"),
        ((2**32 - 1, 2**32 - 0.5, 0.25), "stamps wrap"),
    ],
)
def test_stamps_that_cannot_be_times_give_none_and_a_word_why(stamps: tuple[float, ...], trouble: str):
    clock = Clock.of(stamped(*stamps))
    assert (clock.since, clock.trouble, clock.at(1)) == (None, trouble, None)
