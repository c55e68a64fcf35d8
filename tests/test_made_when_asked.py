"""The results of `extract`: made when they are asked for, and independent of what is extracted next."""

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lineseg import Extraction, Scan, extract, open_recording, trace

SAMPLES = Path(__file__).parents[1] / "sample_scans"
PARTS = "segments", "labels", "dropped"


def parts(found: Extraction) -> tuple:
    return found.segments, found.labels.tolist(), found.dropped


@pytest.fixture(scope="module")
def scans():
    samples = [open_recording(SAMPLES / f"{name}.npz") for name in ("hallway", "room_of_boards")]
    return [recording[frame] for recording in samples for frame in range(0, 40, 2)]


def test_no_part_is_made_before_it_is_asked_for(scans):
    for found in (extract(scans[0]), trace(scans[0]).extraction):
        assert not set(PARTS) & set(vars(found))
        assert found.segments
        assert set(PARTS) & set(vars(found)) == {"segments"}
        assert found.segments is found.segments


def test_rays_of_one_geometry_are_made_once(scans):
    ranges = scans[0].ranges
    one, other = (Scan.regular(ranges, -2.0, 0.004) for _ in range(2))
    assert one.rays is other.rays
    with pytest.raises(ValueError, match="read-only"):
        one.bearings[0] = 0.0


def test_a_result_stays_while_other_scans_are_extracted(scans):
    alone = [parts(extract(scan)) for scan in scans]
    kept = [extract(scan) for scan in scans]
    assert [parts(found) for found in kept] == alone
    with ThreadPoolExecutor(4) as threads:
        assert [parts(found) for found in threads.map(extract, scans * 4)] == alone * 4


def test_a_result_can_be_copied_and_pickled_before_and_after_it_was_looked_at(scans):
    found, again = extract(scans[0]), extract(scans[0])
    assert parts(pickle.loads(pickle.dumps(found))) == parts(found) == parts(pickle.loads(pickle.dumps(found)))
    assert replace(again, segments=()).dropped == found.dropped
    assert np.array_equal(replace(again, segments=()).labels, found.labels)
    with pytest.raises(AttributeError, match="no attribute 'lines'"):
        found.lines  # noqa: B018


def test_a_trace_keeps_its_decisions_and_knows_whose_lines_stand_at_the_end(scans):
    traces = [trace(scan) for scan in scans]
    kept = [each.log.tobytes() for each in traces]
    for scan, each, log in zip(scans, traces, kept, strict=True):
        assert trace(scan).log.tobytes() == log
        assert each.log.tobytes() == log
        assert each.candidates == tuple(line.candidate for line in each.lines_at(len(each) - 1))
