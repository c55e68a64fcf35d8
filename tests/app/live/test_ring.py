"""The newest scans of a live source."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from lineseg_app.live.ring import Ring

from lineseg.readers.laser_scan import LaserScan


def scan(number: int, beams: int = 3) -> LaserScan:
    ranges = np.full(beams, float(number), np.float32)
    return LaserScan(number, 0, f"laser{number}", -1.0, 0.1, 0.0, 10.0, ranges)


@given(st.lists(st.integers(1, 9), max_size=60), st.integers(1, 7), st.integers(9, 30))
def test_the_ring_holds_the_newest_scans_that_fit(lengths, most, most_beams):
    ring, kept = Ring(most, most_beams), []
    for number, beams in enumerate(lengths):
        ring.add(scan(number, beams))
        kept.append((number, beams))
        while len(kept) > most or sum(beams for _, beams in kept) > most_beams:
            del kept[0]
        snapshot = ring.snapshot()
        assert [(int(each.stamp), len(each)) for each in snapshot] == kept
        assert [each.frame_id for each in snapshot] == [f"laser{number}" for number, _ in kept]
        assert all((each.ranges == each.stamp).all() for each in snapshot)
        assert (snapshot.first, snapshot.total, ring.total) == (kept[0][0], number + 1, number + 1)


def test_a_snapshot_stays_as_it_is_while_scans_go_on_arriving():
    ring = Ring(most=4)
    for number in range(4):
        ring.add(scan(number))
    before = ring.snapshot()
    for number in range(4, 40):
        ring.add(scan(number))
    assert [each.ranges.tolist() for each in before] == [[number] * 3 for number in range(4)]
    assert ring.snapshot().first == 36


def test_a_snapshot_is_made_once():
    ring = Ring()
    ring.add(scan(0))
    assert ring.snapshot() is ring.snapshot()


def test_a_scan_that_is_too_large_is_refused_and_nothing_is_lost():
    ring = Ring(most=4, most_beams=5)
    ring.add(scan(0))
    with pytest.raises(ValueError, match="the scan has 6 beams; send at most 5"):
        ring.add(scan(1, beams=6))
    assert ring.total == 1
