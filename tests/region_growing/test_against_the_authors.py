"""The authors' program, with its slips repaired, finds the same lines."""

import gzip
import json

import numpy as np
import pytest

from lineseg import Params, Scan, extract


@pytest.mark.parametrize("name", ["hallway", "lab"])
def test_index_ranges_equal_the_authors_and_endpoints_lie_within_a_millimetre(reference_dir, name):
    with np.load(reference_dir / f"{name}.npz", allow_pickle=False) as archive:
        recording = {key: archive[key] for key in archive.files}
    with gzip.open(reference_dir / f"{name}.authors_repaired.jsonl.gz", "rt") as lines:
        expected = [json.loads(line) for line in lines]
    assert len(expected) == len(recording["ranges"]) == 100
    for ranges, frame in zip(recording["ranges"], expected, strict=True):
        scan = Scan.regular(
            ranges,
            float(recording["angle_min"]),
            float(recording["angle_increment"]),
            range_max=float(recording["range_max"]),
        )
        segments = extract(
            scan, Params(max_dropout=0, merge_rms=0.0, max_occluder=0.0, max_void=0.0, epsilon_growth=0.0)
        ).segments
        assert [[s.first, s.last] for s in segments] == [row[4:] for row in frame]
        for segment, row in zip(segments, frame, strict=True):
            assert np.abs(np.subtract((*segment.start, *segment.end), row[:4])).max() < 1e-3
